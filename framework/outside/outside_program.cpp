#include "framework/outside/outside_program.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

#include "framework/outside/outside_error.hpp"
#include "framework/parallel/interruption.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

/// The bytes of the first process, on all.
std::string shared(const std::string& bytes) {
  if (parallel::size() == 1) return bytes;
  // The length, and then the bytes, as numbers: what they mean is not looked at.
  std::vector<double> numbers;
  if (parallel::is_root()) {
    numbers.resize(1 + (bytes.size() + sizeof(double) - 1) / sizeof(double));
    numbers[0] = static_cast<double>(bytes.size());
    std::memcpy(numbers.data() + 1, bytes.data(), bytes.size());
  }
  numbers = parallel::gather(numbers);
  std::string all(static_cast<std::size_t>(numbers[0]), '\0');
  std::memcpy(all.data(), numbers.data() + 1, all.size());
  return all;
}

/// What `act` returns on the first process, on all of them; an OutsideError there is thrown everywhere.
std::string on_first_process(const std::string& name, const std::function<std::string()>& act) {
  constexpr char is_answer = 'a', is_error = 'e', is_interruption = 'i';
  std::string result;
  if (parallel::is_root()) {
    try {
      result = is_answer + act();
    } catch (const OutsideError& error) {
      result = is_error + std::string("the program of '" + name + "' ") + error.what();
    } catch (const Interrupted&) {
      result = is_interruption;
    }
  }
  result = shared(result);
  if (result[0] == is_interruption) throw Interrupted{};
  if (result[0] == is_error) throw OutsideError(result.substr(1));
  return result.substr(1);
}

}  // namespace

OutsideProgram::OutsideProgram(std::string name, const std::string& command, double timeout)
    : name_(std::move(name)), timeout_(timeout) {
  on_first_process(name_, [&] {
    process_ = std::make_unique<ProgramProcess>(command);
    return std::string();
  });
}

OutsideMessage OutsideProgram::ask(const OutsideMessage& message, const std::string& expected) {
  constexpr double to_start = 60;  // s: on a crowded machine interpreters and their packages take tens of seconds
  const double patience = has_answered_ ? timeout_ : std::max(timeout_, to_start);
  const auto start = std::chrono::steady_clock::now();
  try {
    OutsideMessage answer;
    const std::string bytes = on_first_process(name_, [&] {
      answer = process_->ask(message, std::chrono::duration<double>(patience));
      if (answer.word != expected && answer.word != "failed")
        throw OutsideError("answers '" + answer.word + "' to '" + message.word + "', not '" + expected + "'");
      return parallel::size() > 1 ? answer.bytes() : std::string();
    });
    if (!parallel::is_root()) {
      ArrivingMessage arriving;
      arriving.take(bytes.data(), bytes.size());
      arriving.is_complete();
      answer = arriving.message();
    }
    has_answered_ = true;
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return answer;
  } catch (...) {
    has_failed_ = true;
    process_.reset();
    throw;
  }
}

}  // namespace sprekk
