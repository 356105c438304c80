#include "components/outside/conversation.hpp"

#include <utility>

#include "framework/config/state.hpp"
#include "framework/outside/outside_error.hpp"

namespace sprekk::outside {

namespace {

constexpr int protocol_version = 1;

bool are_same_bits(const OutsideMessage& one, const OutsideMessage& other) { return one.bytes() == other.bytes(); }

}  // namespace

Conversation::Conversation(const std::string& name, const std::string& command, double timeout,
                           const OutsideMessage& hello, std::map<std::string, Vector> kept)
    : name_(name), program_(name, command, timeout), kept_(std::move(kept)) {
  OutsideMessage greeting = hello;
  greeting.word = "hello";
  greeting.ints.insert(greeting.ints.begin(), {"version", {protocol_version}});
  const OutsideMessage answer = ask(std::move(greeting), "ready");
  const std::vector<int>* version = answer.integers("version");
  if (version == nullptr || version->size() != 1 || version->front() != protocol_version)
    throw OutsideError("the program of '" + name + "' speaks version " +
                       (version && version->size() == 1 ? std::to_string(version->front()) : "?") +
                       " of the protocol, not " + std::to_string(protocol_version));
  if (kept_.empty()) return;
  OutsideMessage restore{.word = "restore"};
  for (const auto& [item, values] : kept_) restore.reals.emplace_back(item, values);
  ask(std::move(restore), "restored");
}

OutsideMessage Conversation::ask(OutsideMessage message, const std::string& expected) {
  OutsideMessage answer = program_.ask(message, expected);
  if (answer.word == expected) return answer;
  const std::string* why = answer.text("why");
  throw OutsideError("the program of '" + name_ + "' cannot " + message.word + (why ? ": " + *why : ""));
}

void Conversation::go_to(const StepTime& step, const std::function<void(OutsideMessage&)>& tell_start) {
  if (has_begun_ && step.start == step_.start && step.dt == step_.dt && step.end == step_.end) return;
  if (has_begun_ && step.start != step_.start) {
    if (has_solved_ && step.start == step_.end) {  // a substep follows the last one
      ask({.word = "advance"}, "advanced");
      is_base_accepted_ = false;
    } else if (!is_base_accepted_) {
      rewind();
    }
  }
  OutsideMessage begin{.word = "begin"};
  begin.reals.emplace_back("step", Vector::Zero(3));
  begin.reals.back().second << step.start, step.dt, step.end;
  tell_start(begin);
  ask(std::move(begin), "begun");
  step_ = step;
  has_begun_ = true;
  has_solved_ = false;
}

OutsideMessage Conversation::solve(const StepTime& step, const std::function<void(OutsideMessage&)>& tell_start,
                                   OutsideMessage fields) {
  const double before = program_.seconds();
  go_to(step, tell_start);
  fields.word = "solve";
  OutsideMessage answer = program_.ask(fields, "solved");
  ++solves_;
  seconds_of_solves_ += program_.seconds() - before;
  if (answer.word == "failed") {
    const std::string* why = answer.text("why");
    throw StateError("the program of '" + name_ + "' cannot take the step" + (why ? ": " + *why : ""));
  }
  // A repeated question must have the same answer: asked once in a run.
  if (solves_ == 1) repeats_bits_ = are_same_bits(answer, program_.ask(fields, "solved"));
  has_solved_ = true;
  return answer;
}

void Conversation::accept() {
  if (program_.has_failed() || !has_solved_) return;
  const OutsideMessage answer = ask({.word = "accept"}, "accepted");
  kept_.clear();
  for (const auto& [name, values] : answer.reals) kept_[name] = values;
  has_begun_ = has_solved_ = false;
  is_base_accepted_ = true;
}

void Conversation::rewind() {
  if (program_.has_failed()) return;
  if (!is_base_accepted_) ask({.word = "rewind"}, "rewound");
  has_begun_ = has_solved_ = false;
  is_base_accepted_ = true;
}

}  // namespace sprekk::outside
