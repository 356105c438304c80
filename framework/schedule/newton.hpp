// Semismooth Newton's method for one simultaneous system.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/block_system.hpp"
#include "framework/assembly/part.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/schedule/residual_check.hpp"
#include "framework/schedule/schedule_step.hpp"

namespace sprekk {

struct NewtonOptions {
  double residual = 1e-10;  ///< largest residual of an equation over the largest of its terms
  double update = 1e-8;     ///< largest change of a field over its largest value
  int at_most = 30;         ///< iterations
  int undamped = 8;         ///< iterations before the line search asks for descent
  int pieces = 300;         ///< that the path of the last attempt may have, 0 for no such attempt
};

/// Converged means: every residual is small against its own terms, and the next (simplified) Newton update, which costs
/// a back-solve and no factorization, is small against the fields. Full steps at first, as active sets settle by
/// themselves; descent on the sum of squares of the relative residuals when they have not after `undamped` iterations,
/// or as soon as the discrete state cycles. When that fails, a second attempt from the same start asks for descent from
/// its first iteration: full steps may have led to where no descent comes back from.
///
/// When that fails too, and the discrete state has changed, a third attempt follows a path. Contact is piecewise
/// linear, so residual(x) = s residual(x0) is a line that bends where the state changes. It is followed from s = 1 down
/// to 0, each piece with its own derivatives, up to the place where the piece ends. Where the next piece has a
/// determinant of the other sign, s grows until the path turns again. Full steps and descent can cycle or end in a
/// minimum; the path can only run to a solution, to infinity, or back to where it was (Katzenelson 1965 for monotone
/// functions; Ralph 1994, "path search"; the turns are those of Lemke's method, with which Klarbring (1986) solved
/// frictional contact). Coefficients that are not constant within a piece (the cubic law) are held, and ordinary
/// iterations from the end of the path correct them; when that does not converge, the path is followed with all
/// derivatives, as far as it goes.
///
/// Repeating a call from the same fields gives the same bits.
class Newton {
 public:
  Newton(const Mesh& mesh, std::vector<Field*> unknowns, std::vector<Part*> parts, const LinearOptions& linear,
         const NewtonOptions& options, std::string name, IterationLog log);
  ~Newton();

  /// `stabilization`: diagonals times the change since the start of this call, added to the residuals.
  StepStatus solve(const StepTime& step, const Stabilization& stabilization = {});

  /// What assembly and linear solver did since the start.
  LinearCounts counts() const;
  void set_preconditioner_stabilization(const Stabilization& stabilization);

 private:
  std::unique_ptr<Assembly> assemble(const StepTime& step);
  /// Assembles the state that the fields have now, derivatives too: most states that are looked at are gone on from,
  /// and derivatives of linear terms cost nothing.
  ResidualCheck look(const StepTime& step);
  std::uint64_t discrete_state() const;
  std::vector<Vector> values() const;
  void move(const std::vector<Vector>& from, const Vector& update, double length);
  /// Minus the residual of the owned rows, of the last matrix; zero for equations that hold to round-off. So the bulk,
  /// whose equations are linear, is solved for once a step by a solver that condenses it.
  Vector right_hand_side(const ResidualCheck& check) const;
  /// The largest change of a field over its largest value. Fields whose equation holds to round-off already are left
  /// out: where nothing flows, a flux is nothing but round-off.
  double relative_size(const Vector& update, const ResidualCheck& check) const;
  /// Of each unknown: whether it is to stay, as far as its equation and the sums that it is in can tell.
  std::vector<char> is_settled(const ResidualCheck& check) const;
  /// end: of all iterations. search: until a line search would begin, where the discrete state has changed meanwhile.
  enum class Until { end, search };
  /// Without a line search for the first `undamped` iterations.
  StepStatus attempt(const StepTime& step, int undamped, Until until = Until::end);
  /// The third attempt (path_search.cpp).
  StepStatus follow_path(const StepTime& step, Look look);
  /// From the end of a path with held coefficients, from one where they are released a little to the next.
  StepStatus release_coefficients(const StepTime& step, const std::vector<Vector>& start);
  /// Releases what Part::hold_coefficients holds as far as `share`, and attempts.
  StepStatus attempt_with_share(const StepTime& step, double share);
  void set(const std::vector<Vector>& values);
  void step_off_kinks(const LinearSystem& system, const Vector& update);
  /// Whether the next update is as small as it has to be, too.
  bool is_solution(const ResidualCheck& check);
  ResidualCheck take_step(const StepTime& step, const Vector& update, bool ask_for_descent, double& length);

  std::vector<Field*> unknowns_;
  std::vector<Part*> parts_;
  NewtonOptions options_;
  std::string name_;
  IterationLog log_;
  BlockSystem system_;
  std::unique_ptr<LinearSolver> linear_;
  Products products_;
  std::unique_ptr<Assembly> assembly_;  ///< of the state that was looked at last
  int assemblies_ = 0;
  std::vector<ResidualCheck> recent_;  ///< the last states
  bool state_has_changed_ = false;     ///< the discrete one, in this solve
  bool was_singular_ = false;          ///< the system that the last attempt ended with
  bool was_left_ = false;              ///< the last attempt, as it came to Until::search
  StepTime last_failed_path_;          ///< its step; a path is not followed again for one that is hardly shorter
  const Stabilization* stabilization_ = nullptr;
  std::map<const Field*, Vector> start_;
};

}  // namespace sprekk
