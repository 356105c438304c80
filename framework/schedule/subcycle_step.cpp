#include "framework/schedule/subcycle_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "framework/assembly/heeds_stages.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

Spec SubcycleOptions::spec() {
  Spec spec("subcycle", "The steps inside take several smaller time steps; all other fields wait.");
  spec.integer("count", count, {.range = between(1, 1000000), .doc = "Substeps of each step.", .required = true});
  spec.choice("waiting", waiting,
              {{"held", "they keep their latest values"},
               {"linear",
                "they go from their values at the start of the step to the latest ones, which count at its "
                "end; in a step that begins where data jump, and with backward_euler in the first one, they are held"}},
              {.doc = "What the fields that wait do meanwhile."});
  return spec;
}

namespace {

/// Adds the cumulative balances that are accepted with these fields.
void add_balances(const FieldStore& store, std::vector<Field*>& fields) {
  const std::size_t solved = fields.size();
  for (const auto& field : store.all())
    for (std::size_t i = 0; i < solved; ++i)
      if (field->spec().accepted_with == fields[i]->name()) fields.push_back(field.get());
}

}  // namespace

SubcycleStep::SubcycleStep(const SubcycleOptions& options, TimeScheme scheme, std::unique_ptr<ScheduleStep> inside,
                           const ScheduleContext& context)
    : options_(options),
      scheme_(scheme),
      inside_(std::move(inside)),
      parts_(context.parts),
      start_time_(context.start_time),
      pass_(context.pass) {
  for (const Field* field : inside_->unknowns()) fields_.push_back(&context.fields.at(field->name()));
  solved_ = fields_.size();
  for (const auto& field : context.fields.all())
    if (field->is_solved() && std::ranges::count(fields_, field.get()) == 0) waiting_.push_back(field.get());
  add_balances(context.fields, fields_);
  add_balances(context.fields, waiting_);
}

std::string SubcycleStep::describe() const {
  return options_.is_implied ? inside_->describe() : fmt::format("subcycle {}", options_.count);
}

std::vector<const ScheduleStep*> SubcycleStep::children() const {
  return options_.is_implied ? inside_->children() : std::vector<const ScheduleStep*>{inside_.get()};
}

std::vector<SubcycleStep::Piece> SubcycleStep::pieces(const StepTime& step) const {
  std::vector<Piece> pieces;
  const int count = options_.count;
  for (int i = 0; i < count; ++i) {
    const double from = double(i) / count, to = i + 1 == count ? 1.0 : double(i + 1) / count;
    StepTime substep;
    substep.start = step.start + step.dt * i / count;
    substep.end = i + 1 == count ? step.end : step.start + step.dt * (i + 1) / count;
    substep.dt = step.dt / count;
    SPREKK_ASSERT(substep.end > substep.start && substep.end <= step.end, substep.start, substep.end, step.end);
    if (scheme_ == TimeScheme::backward_euler) {
      pieces.push_back({substep, from, to, false, true});
      continue;
    }
    const double part = sdirk2_share * substep.dt, share = sdirk2_share / count;
    pieces.push_back({{substep.start, part, substep.start + part}, from, from + share, false, false});
    pieces.push_back({{substep.end - part, part, substep.end}, to - share, to, true, true});
  }
  return pieces;
}

StepStatus SubcycleStep::run(const StepTime& step) {
  Values start;
  Course course{options_.waiting == "linear" && !begins_with_jump(step), {}, {}};
  for (const Field* field : fields_) start.push_back(field->accepted());
  for (const Field* field : waiting_) {
    course.from.push_back(field->accepted());
    course.to.push_back(field->now());
  }
  let_parts_take_stages(true);
  const auto put_back = [&] {
    let_parts_take_stages(false);
    SPREKK_ASSERT(start.size() == fields_.size(), start.size(), fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) fields_[i]->set_accepted(start[i]);
    if (!course.is_linear) return;
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      waiting_[i]->set(course.to[i]);
      waiting_[i]->set_accepted(course.from[i]);
    }
  };
  StepStatus status;
  try {
    status = take(pieces(step), course);
  } catch (...) {  // a datum has no value in a substep: fields are put back to the start of the step
    put_back();
    throw;
  }
  put_back();
  begin_step(parts_, step);
  return status;
}

double SubcycleStep::summed_errors() const {
  const double of_stages = scheme_ == TimeScheme::backward_euler ? 1 : sdirk2_extrapolation + 1;
  return options_.count * of_stages * inside_->summed_errors();
}

void SubcycleStep::let_parts_take_stages(bool are_stages) {
  if (scheme_ == TimeScheme::backward_euler) return;  // substeps of a stage around it start where the stage does
  for (Part* part : parts_)
    if (auto* follower = dynamic_cast<HeedsStages*>(part)) follower->take_stages(are_stages);
}

bool SubcycleStep::begins_with_jump(const StepTime& step) {
  if (!jumps_) {
    jumps_.emplace();
    // With one stage, fields that are held cost no order, and loads may be there at once when the run begins.
    if (scheme_ == TimeScheme::backward_euler) jumps_->push_back(start_time_);
    for (const Part* part : parts_) std::ranges::copy(part->switch_times(), std::back_inserter(*jumps_));
  }
  return std::ranges::any_of(*jumps_,
                             [&](double time) { return std::abs(time - step.start) <= rounding::same * step.dt; });
}

void SubcycleStep::let_wait(const Course& course, const Piece& piece) {
  if (!course.is_linear) return;
  SPREKK_ASSERT(course.from.size() == waiting_.size(), course.from.size(), waiting_.size());
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const Vector change = course.to[i] - course.from[i];
    waiting_[i]->set(piece.end == 1 ? course.to[i] : Vector(course.from[i] + piece.end * change));
    waiting_[i]->set_accepted(course.from[i] + piece.begin * change);
  }
}

void SubcycleStep::begin_from_last_pass(std::size_t piece, double begin, double end) {
  SPREKK_ASSERT(piece < last_end_.size(), piece, last_end_.size());
  for (std::size_t i = 0; i < solved_; ++i)
    fields_[i]->set(last_end_[piece][i] + fields_[i]->accepted() - last_begin_[piece][i] + (end - begin) * moved_[i]);
}

StepStatus SubcycleStep::take(const std::vector<Piece>& pieces, const Course& course) {
  const bool begins_anew = pieces.size() == 1 || !has_last_pass() || last_end_.size() != pieces.size();
  if (begins_anew) {
    last_begin_.assign(pieces.size(), Values(solved_));
    last_end_ = last_begin_;
  }
  moved_.resize(solved_);
  for (std::size_t i = 0; i < solved_ && !begins_anew; ++i) moved_[i] = fields_[i]->now() - last_end_.back()[i];

  StepStatus status{true, "", 0};
  Values start;  // of the substep
  for (std::size_t k = 0; k < pieces.size() && status.converged; ++k) {
    const Piece& piece = pieces[k];
    if (!piece.is_second_stage) {
      start.clear();
      for (const Field* field : fields_) start.push_back(field->accepted());
    } else {
      for (std::size_t i = 0; i < fields_.size(); ++i)
        if (!fields_[i]->spec().is_path_dependent)
          fields_[i]->set_accepted(start[i] + sdirk2_extrapolation * (fields_[i]->now() - start[i]));
    }
    let_wait(course, piece);
    if (!begins_anew) begin_from_last_pass(k, piece.begin, piece.end);
    begin_step(parts_, piece.time);
    const StepStatus inner = inside_->run(piece.time);
    status.iterations = std::max(status.iterations, inner.iterations);
    status.of_newton = std::max(status.of_newton, inner.effort());
    status.converged = inner.converged;
    status.is_hopeless = inner.is_hopeless && (options_.is_implied || inner.lost_at);
    status.lost_at = inner.lost_at;
    if (!inner.converged)
      status.reason = options_.count > 1
                          ? fmt::format("substep {}: {}", k * options_.count / pieces.size() + 1, inner.reason)
                          : inner.reason;
    for (std::size_t i = 0; i < solved_ && pass_; ++i) {
      last_begin_[k][i] = fields_[i]->accepted();
      last_end_[k][i] = fields_[i]->now();
    }
    if (piece.ends_substep)
      for (Field* field : fields_) field->accept();
  }
  return status;
}

}  // namespace sprekk
