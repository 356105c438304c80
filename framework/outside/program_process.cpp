#include "framework/outside/program_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <thread>
#include <vector>

#include "framework/outside/outside_error.hpp"
#include "framework/parallel/environment_at_start.hpp"
#include "framework/parallel/interruption.hpp"

namespace sprekk {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// While it lives, writing to a pipe that nobody reads is an error of the call, and no signal.
class WithoutPipeSignal {
 public:
  WithoutPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutPipeSignal() {
    const timespec at_once{0, 0};
    while (sigtimedwait(&pipe_, nullptr, &at_once) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutPipeSignal(const WithoutPipeSignal&) = delete;
  WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};

/// A pipe whose own end is closed in started programs; both ends are closed when it goes.
struct Pipe {
  std::array<int, 2> ends{-1, -1};  ///< to read from, to write to
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw OutsideError("cannot be spoken to: " + std::string(strerror(errno)));
    constexpr int size = 1 << 20;  // bytes, what an unprivileged user may ask for; large fields pass in few turns
    fcntl(ends[1], F_SETPIPE_SZ, size);
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take(int which) {
    fcntl(ends[which], F_SETFL, O_NONBLOCK);
    return std::exchange(ends[which], -1);
  }
};

}  // namespace

ProgramProcess::ProgramProcess(const std::string& command) {
  Pipe to, from;
  std::vector<std::string> words = {"/bin/sh", "-c", command}, variables = parallel::environment_at_start();
  std::vector<char*> arguments, environment;
  for (std::string& word : words) arguments.push_back(word.data());
  for (std::string& variable : variables) environment.push_back(variable.data());
  arguments.push_back(nullptr);
  environment.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, to.ends[0], 0);
  posix_spawn_file_actions_adddup2(&actions, from.ends[1], 1);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int failure =
      posix_spawn(&process_, words[0].c_str(), &actions, &attributes, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) throw OutsideError("cannot be started (" + std::string(strerror(failure)) + ")");
  to_ = to.take(1);
  from_ = from.take(0);
}

ProgramProcess::~ProgramProcess() {
  close(to_);
  close(from_);
  constexpr milliseconds to_end_itself(2000), to_obey(1000);
  if (!has_ended(to_end_itself)) {
    kill(-process_, SIGTERM);
    if (!has_ended(to_obey)) kill(-process_, SIGKILL);
    if (!is_reaped_) waitpid(process_, &status_, 0);
  }
  kill(-process_, SIGKILL);  // what it has started itself and left
}

bool ProgramProcess::has_ended(milliseconds patience) {
  const auto end = steady_clock::now() + patience;
  constexpr milliseconds pause(2);  // between two looks
  while (!is_reaped_) {
    is_reaped_ = waitpid(process_, &status_, WNOHANG) == process_;
    if (is_reaped_ || steady_clock::now() >= end) break;
    std::this_thread::sleep_for(pause);
  }
  return is_reaped_;
}

std::string ProgramProcess::how_it_ended() {
  constexpr milliseconds patience(500);  // between closing a pipe and the end of a process
  if (!has_ended(patience)) return "has closed its standard input or output";
  if (WIFSIGNALED(status_)) return fmt::format("was ended by signal {}", WTERMSIG(status_));
  return fmt::format("has ended with exit code {}", WEXITSTATUS(status_));
}

void ProgramProcess::wait_for(int pipe, short event, steady_clock::time_point end) const {
  constexpr int look_up = 50;  // ms, between looks at Ctrl-C
  for (;;) {
    pollfd waiting{pipe, event, 0};
    if (poll(&waiting, 1, look_up) > 0) return;
    interruption::poll_alone();
    if (steady_clock::now() > end)
      throw OutsideError(fmt::format(
          "has not answered for {:.3g} s (it hangs, or needs longer) give the component a larger 'timeout' if it does",
          patience_));
  }
}

void ProgramProcess::send(const std::string& bytes, steady_clock::time_point end) {
  const WithoutPipeSignal guard;
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = write(to_, bytes.data() + sent, bytes.size() - sent);
    if (count > 0)
      sent += static_cast<std::size_t>(count);
    else if (errno == EAGAIN)
      wait_for(to_, POLLOUT, end);
    else if (errno != EINTR)
      throw OutsideError(how_it_ended());
  }
}

OutsideMessage ProgramProcess::receive(steady_clock::time_point end) {
  ArrivingMessage arriving;
  std::vector<char> buffer(1 << 20);  // bytes, as the pipe
  for (;;) {
    const ssize_t count = read(from_, buffer.data(), buffer.size());
    if (count > 0) {
      arriving.take(buffer.data(), static_cast<std::size_t>(count));
      if (arriving.is_complete()) return arriving.message();
    } else if (count == 0) {
      throw OutsideError(how_it_ended());
    } else if (errno == EAGAIN) {
      wait_for(from_, POLLIN, end);
    } else if (errno != EINTR) {
      throw OutsideError(how_it_ended());
    }
  }
}

OutsideMessage ProgramProcess::ask(const OutsideMessage& message, std::chrono::duration<double> patience) {
  patience_ = patience.count();
  const auto end = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(patience);
  send(message.bytes(), end);
  return receive(end);
}

}  // namespace sprekk
