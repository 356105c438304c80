// Semismooth Newton's method for one simultaneous system.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/assembly/block_system.hpp"
#include "framework/assembly/part.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/assembly/softening.hpp"
#include "framework/assembly/stabilizes.hpp"
#include "framework/linear/condensed_eigenpair.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/schedule/residual_check.hpp"
#include "framework/schedule/schedule_step.hpp"
#include "framework/schedule/waiting_response.hpp"

namespace sprekk {

/// Tolerances (relative) and limits of Newton's method.
struct NewtonOptions {
  double residual = 1e-10;  ///< largest residual of an equation over the largest of its terms
  double update = 1e-8;     ///< largest change of a field over its largest value: quadratic convergence squares it
  int at_most = 30;         ///< iterations
  int undamped = 8;         ///< iterations before the line search asks for descent
  int pieces = 300;         ///< most pieces of the path of the last attempt; 0: no such attempt
};

/// Solves the equations of the given unknowns. Converged means: every residual is small against its own terms, and the
/// next (simplified) Newton update, which costs a back-solve and no factorization, is small against the fields.
///
/// The first attempt takes full steps, as active sets usually settle by themselves. If they have not after `undamped`
/// iterations, or as soon as the discrete state cycles, a line search asks for descent of the sum of squares of the
/// relative residuals. If the first attempt fails, a second one from the same start asks for descent from its first
/// iteration, since no descent may lead back from where full steps have led.
///
/// If the second attempt fails, and the discrete state has changed or a part is nonlinear in pieces, a third attempt
/// follows a path. Contact is piecewise linear, so residual(x) = s residual(x0) is a polygonal line that bends where
/// the discrete state changes. The path is followed from s = 1 to 0, each piece with its own derivatives to its end.
/// Where the determinant changes its sign from one piece to the next, s grows until the path turns again. Full steps
/// and descent can cycle or end in a minimum; the path can only run to a solution, to infinity, or back to its start
/// (Katzenelson 1965 for monotone functions; Ralph 1994, "path search"; the turns are those of Lemke's method, with
/// which Klarbring (1986) solved frictional contact). Coefficients that are not constant within a piece (the cubic law)
/// are held, and ordinary iterations from the end of the path correct them. If these do not converge, the coefficients
/// are released in stages; then the path is followed with all derivatives, as far as it exists.
///
/// A step may have several solutions, and Newton's method may miss the one that follows continuously from the start of
/// the step. So if parts say that cells have left their states by a jump (PiecewiseSmooth::keep_states), the step is
/// solved once more with these states kept. States whose conditions are violated are released, until none is. The
/// result is taken as the solution.
///
/// With softening (Softening) the path also tells whether equilibria lead from the accepted state to the solution. As
/// the load of the step is applied, s falls from 1 to 0; where s first turns, equilibria end, because the stiffness
/// condensed to the free values gets a negative eigenvalue. A step without a solution then fails with that reason
/// (StepStatus::is_hopeless), and a solution beyond this point is accepted with a note.
///
/// A repeated call from the same fields gives the same bits.
class Newton {
 public:
  Newton(const Mesh& mesh, std::vector<Field*> unknowns, std::vector<Part*> parts, const LinearOptions& linear,
         const NewtonOptions& options, std::string name, IterationLog log);
  ~Newton();

  /// `stabilization`: diagonals; each, times the change of its field since the start of this call, is added to the
  /// residual of that field. `responses`: Schur complements of unknowns outside of the call.
  StepStatus solve(const StepTime& step, const Stabilization& stabilization = {}, const Responses& responses = {});

  /// Counts of assemblies and of the linear solver since the start.
  LinearCounts counts() const;
  /// Makes a call iterate at least once, even if the residuals are small from the start: in an iteration of several
  /// solves a residual may be small against its own terms but large against a balance of another solve.
  void iterate_at_least_once() { least_iterations_ = 1; }
  /// Whether the last call has used up its iterations. The fields then have the values of the last attempt with
  /// descent, or of the only attempt.
  bool has_used_up_iterations() const { return is_used_up_; }
  void set_preconditioner_stabilization(const Stabilization& stabilization);
  /// Adds notes on a step that is about to be accepted.
  void note_step(Notes& notes, const StepTime& step) const;

 private:
  std::unique_ptr<Assembly> assemble(const StepTime& step);
  /// Assembles residual and derivatives at the current values of the fields, and checks the residual. Derivatives are
  /// always included: most evaluated states are accepted, and derivatives of linear terms cost nothing.
  ResidualCheck evaluate(const StepTime& step);
  /// The same at values for which formulas may have no value; the residual is not finite then.
  ResidualCheck evaluate_trial(const StepTime& step);
  std::uint64_t discrete_state() const;
  std::vector<Vector> values() const;
  void move(const std::vector<Vector>& from, const Vector& update, double length);
  /// Minus the residual in the owned rows of the last matrix; zero for equations that hold to round-off. Zeros in the
  /// linear equations of the bulk let a condensing solver solve for the bulk only once a step.
  Vector right_hand_side(const ResidualCheck& check) const;
  /// The largest change of a field over its largest value. Fields whose equation already holds to round-off are left
  /// out: where nothing flows, a flux is round-off alone.
  double relative_size(const Vector& update, const ResidualCheck& check) const;
  /// For each unknown: whether its equation and the sums that contain the equation ask for no further update.
  std::vector<char> is_settled(const ResidualCheck& check) const;
  /// Lets sums of balances replace rows also if other unknowns of the bulk respond to their constant mode, unless they
  /// do already, and checks the residual again. To be tried for a singular system, since it may be singular only
  /// because round-off hides what determines the constant mode. The equations stay equivalent.
  bool take_coupled_sums(ResidualCheck& check);
  bool may_take_coupled_sums() const;
  /// When an attempt ends. `end`: after all iterations. `search`: where a line search would begin, if the discrete
  /// state has changed by then.
  enum class Until { end, search };
  // newton_rungs.cpp: all attempts, until one converges, and what they consist of.
  StepStatus search(const StepTime& step, const std::vector<Vector>& start);
  StepStatus attempt_also_without_conditions(const StepTime& step, const std::vector<Vector>& start, Until until);
  StepStatus finish_with_own_derivatives(const StepTime& step, StepStatus status);
  bool is_nonlinear_in_pieces() const;
  StepStatus follow_paths(const StepTime& step, const std::vector<Vector>& start, StepStatus status);
  /// Looks for a solution with states that the present solution has left (keep_states.cpp). Returns the number of
  /// iterations.
  int keep_states(const StepTime& step, const std::vector<Vector>& start);
  /// Iterates, without a line search in the first `undamped` iterations.
  StepStatus iterate(const StepTime& step, int undamped, Until until = Until::end);
  struct Seen;
  bool is_small(ResidualCheck& check, int iteration, Seen& seen);
  bool is_settled_solution(const StepTime& step, const ResidualCheck& check, int iteration, bool has_factors);
  std::string find_update(ResidualCheck& check, Vector& update);
  /// The third attempt (path_search.cpp).
  StepStatus follow_path(const StepTime& step, SearchMode mode);
  /// Releases held coefficients in small shares from the end of a path, with an attempt at each share.
  StepStatus release_coefficients(const StepTime& step, const std::vector<Vector>& start);
  /// A loss of stability.
  struct Loss {
    Softening* part;  ///< whose places move
    double time;      ///< s
    std::string told;
  };
  /// Whether the free values of all parts are unstable, also in a step so short that nothing flows. To be called when
  /// the derivatives at the present values are factorized; afterwards those of that short step may be. `time`: when, s.
  std::optional<Loss> find_loss(const StepTime& step, double time);
  /// The same with the derivatives that are factorized already.
  std::optional<Loss> find_loss(double time);
  /// Nothing where they are not among the unknowns.
  std::optional<CondensedUnknowns> condensed_to(const FreeValues& values) const;
  /// After a solution in which parts have lost strength: false where all states between the start of the step and the
  /// solution are known to be stable.
  bool may_have_passed_loss(const StepTime& step);
  /// After a solution: checks whether a path leads to it. If the path leads to another solution, that one is taken.
  void follow_softening(const StepTime& step);
  /// Whether the present values are another solution than these.
  bool is_elsewhere(const std::vector<Vector>& solution) const;
  void set(const std::vector<Vector>& values);
  void step_off_kinks(const LinearSystem& system, const Vector& update);
  /// Whether the residuals have converged and the next update is below its tolerance.
  bool is_solution(const ResidualCheck& check);
  ResidualCheck take_step(const StepTime& step, const Vector& update, bool ask_for_descent, double& length);

  std::vector<Field*> unknowns_;
  std::vector<Part*> parts_;
  std::vector<PiecewiseSmooth*> pieces_;  ///< those of the parts that are so
  NewtonOptions options_;
  std::string name_;
  IterationLog log_;
  BlockSystem system_;
  std::unique_ptr<LinearSolver> linear_;
  Products products_;
  std::unique_ptr<Assembly> assembly_;  ///< the equations at the last values that were checked
  int assemblies_ = 0;
  int least_iterations_ = 0;
  std::vector<ResidualCheck> recent_;  ///< the checks of the last iterates, oldest first
  bool state_has_changed_ = false;     ///< whether the discrete state has changed in this solve
  bool was_singular_ = false;          ///< whether the last attempt ended with a singular system
  bool is_used_up_ = false;            ///< whether the last attempt has used up its iterations
  bool was_left_ = false;              ///< whether the last attempt ended at Until::search
  bool is_path_stuck_ = false;         ///< whether the last path has ended because it gained nothing
  std::optional<Loss> lost_;           ///< where the last path has ended
  std::optional<Loss> passed_;         ///< by the solution of the step `passed_in_`
  StepTime passed_in_;
  const Stabilization* stabilization_ = nullptr;
  const Responses* responses_ = nullptr;
  std::map<const Field*, Vector> start_;
};

}  // namespace sprekk
