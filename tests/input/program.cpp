#include "tests/input/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sprekk::testing {

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "sprekk_input_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Program::Program(const std::vector<std::string>& arguments, const std::filesystem::path& working_directory) {
  const std::string out = output_ / "out", err = output_ / "err";
  std::vector<char*> words = {const_cast<char*>(SPREKK_PROGRAM)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no new process");
  if (process_ > 0) return;
  const int out_file = open(out.c_str(), O_WRONLY | O_CREAT, 0600),
            err_file = open(err.c_str(), O_WRONLY | O_CREAT, 0600);
  if (chdir(working_directory.c_str()) == 0 && dup2(out_file, STDOUT_FILENO) >= 0 && dup2(err_file, STDERR_FILENO) >= 0)
    execv(SPREKK_PROGRAM, words.data());
  _exit(127);
}

void Program::interrupt() const { signal(SIGINT); }

void Program::signal(int number) const { kill(process_, number); }

bool Program::is_running() {
  if (!ended_) ended_ = waitpid(process_, &status_, WNOHANG) == process_;
  return !ended_;
}

Outcome Program::wait() {
  if (!ended_) waitpid(process_, &status_, 0);
  ended_ = true;
  const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  return {code, text_of(output_ / "out"), text_of(output_ / "err")};
}

Outcome sprekk_command(const std::vector<std::string>& arguments, const std::filesystem::path& working_directory) {
  return Program(arguments, working_directory).wait();
}

Outcome shell_command(const std::string& line, const std::filesystem::path& working_directory) {
  const Folder output;
  const std::string whole = "cd '" + working_directory.string() + "' && sprekk='" + SPREKK_PROGRAM + "' && (" + line +
                            ") >'" + (output / "out").string() + "' 2>'" + (output / "err").string() + "'";
  const int status = std::system(whole.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {code, text_of(output / "out"), text_of(output / "err")};
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace sprekk::testing
