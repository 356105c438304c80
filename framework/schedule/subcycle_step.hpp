// subcycle: the steps inside take several smaller time steps, or the stages of one, while all other fields wait.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

/// Parameters of a `subcycle` step.
struct SubcycleOptions {
  int count = 2;
  std::string waiting = "held";
  bool is_implied = false;  ///< by the scheme in time: the schedule of the scene does not name it
  Spec spec();
};

/// Fields that are not solved for inside wait: they are held at their latest values, or are linear in time, from their
/// accepted values to the latest ones at the end of the step, unless the step begins with a jump of the data. After
/// each substep the fields inside, and the cumulative balances kept of them, are accepted, so that a change of
/// something outside counts once, in the first substep where it is held. At the end the accepted values of the start
/// are put back: the step as a whole is accepted by the step controller.
///
/// With two stages (TimeScheme::sdirk2) each substep is two of backward Euler. The second one starts from accepted
/// values that are extrapolated from what the first one has changed, except for fields that depend on their path
/// (FieldSpec::is_path_dependent).
///
/// Inside an iteration every pass takes all substeps anew, against the latest course of the waiting fields (waveform
/// iteration). Each substep then begins from its own values in the pass before. So a stabilization, which counts from
/// there, vanishes with convergence.
class SubcycleStep : public ScheduleStep {
 public:
  SubcycleStep(const SubcycleOptions& options, TimeScheme scheme, std::unique_ptr<ScheduleStep> inside,
               const ScheduleContext& context);
  StepStatus run(const StepTime& step) override;
  std::vector<const Field*> unknowns() const override { return inside_->unknowns(); }
  int systems_in_turn(const StepTime& step) const override { return inside_->systems_in_turn(step); }
  bool solves(const Field& field, const StepTime& step) const override { return inside_->solves(field, step); }
  std::vector<const Field*> solved_first(const StepTime& step) const override { return inside_->solved_first(step); }
  void iterate_with(const std::vector<const Field*>& unknowns) override { inside_->iterate_with(unknowns); }
  double largest_imbalance() const override { return inside_->largest_imbalance(); }
  double summed_errors() const override;
  void check() const override { inside_->check(); }
  void require_held(const StepTime& step) const override { inside_->require_held(step); }
  std::string describe() const override;
  bool has_own_clock() const { return !options_.is_implied && options_.count > 1; }
  std::vector<const ScheduleStep*> children() const override;
  void note_step(Notes& notes, const StepTime& step) const override { inside_->note_step(notes, step); }
  void add_counts(LinearCounts& counts) const override { inside_->add_counts(counts); }

 private:
  using Values = std::vector<Vector>;
  /// One step of backward Euler inside: a substep, or a stage of it. `begin` and `end` are shares of the whole step.
  struct Piece {
    StepTime time;
    double begin, end;
    bool is_second_stage, ends_substep;
  };
  /// The course of the waiting fields over the whole step, from its start to its end.
  struct Course {
    bool is_linear;  ///< otherwise they are held at the end
    Values from, to;
  };
  /// Whether waiting fields may have jumped at the start of the step, because data jump there, or because the run
  /// begins and its loads act at once. Then they do not vary linearly between their values at both ends.
  bool begins_with_jump(const StepTime& step);
  std::vector<Piece> pieces(const StepTime& step) const;
  StepStatus take(const std::vector<Piece>& pieces, const Course& course);
  /// Tells the parts where the stages of the scheme begin and end (HeedsStages).
  void let_parts_take_stages(bool are_stages);
  void let_wait(const Course& course, const Piece& piece);
  /// Puts the fields to where they were at the end of this piece in the pass before, moved with the start of the piece.
  void begin_from_last_pass(std::size_t piece, double begin, double end);
  bool has_last_pass() const { return pass_ && *pass_ > 1; }

  SubcycleOptions options_;
  TimeScheme scheme_;
  std::unique_ptr<ScheduleStep> inside_;
  std::vector<Part*> parts_;
  double start_time_;                          ///< s, of the run
  std::optional<std::vector<double>> jumps_;   ///< s, times at which data jump; found in the first step
  std::vector<Field*> fields_;                 ///< solved for inside, and the cumulative balances kept of them
  std::size_t solved_ = 0;                     ///< how many of them are solved for
  std::vector<Field*> waiting_;                ///< solved for outside, and the cumulative balances kept of them
  std::shared_ptr<const int> pass_;            ///< of the iteration around it, nullptr without one
  std::vector<Values> last_begin_, last_end_;  ///< of each piece: where it began and ended in the last pass
  Values moved_;  ///< changes of the fields since the end of the last pass, by an accelerator for example
};

}  // namespace sprekk
