#include "framework/run/checkpoints.hpp"

#include "framework/output/progress.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/run/checkpoint_interval.hpp"

namespace sprekk {

Checkpoints::Checkpoints(const SimulationState& state, RunOutput& output, std::string fingerprint)
    : state_(state),
      output_(output),
      fingerprint_(std::move(fingerprint)),
      begin_of_step_(now()),
      began_(Progress::steady_seconds()),
      last_(began_) {}

Checkpoints::Moment Checkpoints::now() const {
  Moment moment{{}, output_.rows()};
  state_.controller.save(moment.steps);
  return moment;
}

void Checkpoints::step_begins() { begin_of_step_ = now(); }

void Checkpoints::write() { write(now()); }

void Checkpoints::write_begin_of_step() { write(begin_of_step_); }

void Checkpoints::write_if_due() {
  const double time = Progress::steady_seconds();
  const double due = checkpoint_interval(state_.model->scene().output.checkpoint_every, time - began_, cost_);
  if (parallel::any(time - last_ > due)) write();
}

void Checkpoints::write(const Moment& moment) {
  const double begin = Progress::steady_seconds();
  std::map<std::string, Vector> extra = state_.model->extra_state();
  state_.balance.save(extra);
  state_.splitting_error.save(*state_.model, extra);
  extra.insert(moment.steps.begin(), moment.steps.end());
  output_.write_checkpoint(*state_.model, state_.notes, moment.rows, std::move(extra), fingerprint_);
  last_ = Progress::steady_seconds();
  cost_ = last_ - begin;
}

}  // namespace sprekk
