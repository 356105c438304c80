// Frictional contact with dilation (Eqs. 2 and 3 of the paper), cell by cell.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "components/capabilities/fracture_contact.hpp"
#include "components/capabilities/given_on_fractures.hpp"
#include "components/contact/laws/formulas.hpp"
#include "components/contact/laws/strength.hpp"
#include "components/contact/multiplier.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/heeds_stages.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/lives_in_part.hpp"
#include "framework/assembly/notes_start.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/softening.hpp"
#include "framework/assembly/tells_events.hpp"
#include "framework/scene/component.hpp"
#include "framework/schedule/limits_step.hpp"

namespace sprekk::contact {

class Closure;
class RateAndStateWalls;
struct SlippingWalls;
struct Options;

/// Unknown: the contact traction f of every fracture cell, (normal, tangential), from the jump [u] across it. In space
/// the tangential part has two components, |·| is its norm and the interval [−b, b] a disk (return_map.hpp). With the
/// gap h = [u]_n − |[u]_t| tan psi, the slip of the step d = [u]_t − [u]_t,old, and the stiffness c of the walls:
///   f_n = min(0, f_n + c_n h)                                                      (Eq. 2 of the paper)
///   f_t = projection of f_t + c_t d onto [−b, b],  b = −mu_s min(0, f_n + c_n h)   (Eq. 3 of the paper)
/// For any c > 0 these are equivalent to the conditions (Alart and Curnier 1991; Hüeber, Stadler, Wohlmuth 2008).
/// Divided by c, so that every residual is a length, they are solved by a semismooth Newton method. f acts on the plus
/// wall, [u] = u(minus) − u(plus), so friction makes f_t point along the slip: the power −f·[u]' that it supplies to
/// the walls is not positive. (The paper's Eq. 3 has the opposite sign.)
///
/// With laws (components/contact/laws) the same equations hold for the gap
///   h = [u]_n − g(|[u]_t|) + c(−f_n),  g(s) = min(s, s_max) tan psi,
/// with the closure c of walls under pressure, and for the strength that the walls have left at the path q of slip and
/// opening: f_n = min(T(q), f_n + c_n h), b = C(q) − mu(q) min(0, f_n + c_n h).
///
/// Where friction depends on slip rate and state (RateAndStateLaw), walls under shear always creep. The trial then
/// returns to the solution of
///   f_t = tau(|d|/dt, theta, −min(0, f_n + c_n h)) d/|d| with f_t + c_t d held at the trial,
/// which is smooth where walls touch: there is no cone, and walls never stick. `State` is `slip` where V is above V_0.
///
/// mu_s and psi are those at the end of the step. The gap depends on the present slip and psi, not on their history:
/// where psi falls, a fracture that has slipped closes.
///
/// With Options::fractures the contact is on these fractures only. Elsewhere f = 0, the coupler makes [u] = 0, and
/// parameters are not needed.
///
/// A wall that slides back loses the opening by dilation. The fracture closes and compresses trapped fluid, whose
/// pressure reduces the contact traction and so the shear that the walls hold. So friction may balance the load in no
/// state between the present slip and zero slip. Newton's method then cycles between sticking and slip in the wrong
/// direction, because the solution lies beyond the kink of |[u]_t| at zero. Therefore, once sliding back has led to
/// slip in the wrong direction, the update of this cell takes residual and derivatives from the piece of |[u]_t| beyond
/// the kink. This does not change the solutions. Cells without friction never take that piece: they do not dilate, and
/// their f_t is round-off, which has no direction.
class FrictionalContact : public Component,
                          public PiecewiseSmooth,
                          public KeepsState,
                          public KeepsTotals,
                          public FollowsMesh,
                          public FractureContact,
                          public AcceptsFriction,
                          public CountsFromHere,
                          public NotesStart,
                          public HeedsStages,
                          public LivesInPart,
                          public Softening,
                          public TellsEvents,
                          public LimitsStep {
 public:
  /// `stiffness_factor`: stiffness of the springs between the walls (Multiplier) over the stiffness of the rock against
  /// a jump of the cell. Throws InputError where the scene has no fractures, and for a formula of friction together
  /// with another law of friction.
  FrictionalContact(const ComponentContext& context, const Options& options,
                    Multiplier multiplier = Multiplier::present, double stiffness_factor = 1);
  ~FrictionalContact() override;

  void evaluate_data(const StepTime& step) override;
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override;
  /// New cells are bonded, [u] = 0, until the equilibrium on the new mesh has been found. Cells that replace cells of
  /// the old mesh are held meanwhile at the jumps of these, with the same volume. If tips have only moved in this way,
  /// all other cells are held, too: then the change of the mesh makes no walls slide or open, which friction would make
  /// irreversible.
  void carry_over(const Part& before, const MeshChange& change) override;
  void settled(const MeshChange& change) override;
  /// Throws InputError for friction that depends on the slip rate: such walls creep under any load.
  void require_countable() const override;
  /// Jumps are not reset, since friction and dilation depend on them; a note tells of walls that have slid.
  void count_from_here(const SettledFields& settled) override;
  void observe_iterate(const std::vector<Field*>& unknowns) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  std::uint64_t discrete_state() const override;
  void set_search_mode(SearchMode mode) override;
  void deactivate_conditions() override;
  /// Keeps cells that have slid back over their asperities in the state stick. Sliding back closes the fracture, which
  /// reduces the contact pressure and so friction. So a second solution may exist in which walls slide far back. Small
  /// increments of the load lead to the solution in which they stick: while no cell changes its state, tractions are
  /// linear in the load, so they are within the (convex) cone of friction during the whole step if they are at its
  /// start and end.
  int keep_states() override;
  int release_violated() override;
  void release_kept() override { kept_.clear(); }
  std::vector<double> switch_times() const override;
  void report(std::vector<Quantity>& quantities) const override;
  void output(std::vector<OutputField>& fields) const override;
  void note_input(Notes& notes) const override;
  /// Adds a note on walls that slide or open in the first step under the initial stress alone.
  void note_start(Notes& notes) const override;
  std::string loss_of_one_stage() const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  void accepted() override;
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;
  void begin_totals() override;
  /// The walls that have weakened by slip or opening in this step (runaway.cpp).
  Softened softened() const override;
  /// The slip of cells that slip, and the opening of cells that open against their tensile strength.
  FreeValues free_values() const override;
  std::string tell_loss(const LossOfStability& loss) const override;
  void note_passed(const std::string& told, Notes& notes) override;
  /// Events of fast slip, where friction depends on the rate; else slip that has run away (runaway.cpp).
  std::vector<Quantity> event_figures() const override;
  std::vector<Event> events(const StepTime& step) const override;
  double longest_step(double start) const override;
  std::optional<StepTooLong> too_long(const StepTime& step) const override;

  Field& traction() override { return traction_; }
  bool is_on_fracture_cell(int cell) const override { return here_.empty() || here_[cell]; }
  const std::vector<char>& inhabited_cells() const override { return here_; }
  bool lives_on_fractures() const override { return true; }
  Field& jump() override { return jump_; }
  double opening_under(int cell, double normal_traction) const override;
  /// The tangential stiffness of a cell is replaced by that of its whole fracture, which is smaller by the ratio of the
  /// size of the cell to that of the fracture. When a load decreases, the derivatives of slip make all cells of a
  /// fracture slide back at once. With the stiffness of single cells these cells, which stick, would be found to slip
  /// back, then forth again.
  ///
  /// The normal stiffness is limited to half of the tangential one over mu_s tan psi. Walls that slide freely by d
  /// while open overlap by |d| tan psi. With a larger normal stiffness they would be found to stick and to open in
  /// turn; with the limit they are found to slip.
  void set_wall_stiffness(const Vector& stiffness) override;
  std::string accept_friction_factor(const Field& factor) override;
  bool needs_shear_modulus() const override { return rate_and_state_ != nullptr; }
  void set_shear_modulus(const Vector& modulus) override;
  std::optional<SlidingWalls> sliding(int cell) const override;

  State state(int cell) const;
  bool is_bonded(int cell) const { return !bonded_.empty() && bonded_[cell]; }

 private:
  /// The stiffness c of the trial. It changes the iterates of Newton's method, but not the solution.
  const Vector& stiffness() const { return is_without_shortcuts_ ? stiffness_of_walls_ : stiffness_of_fractures_; }
  /// The compliance of the springs between the walls of a cell, m/Pa, (normal, tangential); 0 without springs. With a
  /// penalty, the compliance is part of the answer; so it must not depend on the stiffness c of the trial.
  Point compliance(int cell) const;
  Trial trial(int cell) const;
  /// The traction that friction of rate and state gives for the trial.
  Trial::AtRate at_rate(int cell, const Trial& trial) const;
  Vector slips() const;  ///< m, now, along the tangents of each cell
  SlippingWalls slipping_walls() const;
  /// The change of length of the springs, m, which adds to the gap: negative where they are shortened. Zero with
  /// Multiplier::last, whose springs have no force at the traction of the present iterate.
  double overlap(int cell) const;
  /// The slip of the springs in the step, m, before friction acts; zero with Multiplier::last.
  TangentialVector elastic_slip(int cell) const;
  /// The opening by dilation, m, after slip of this size, and its derivative.
  /// Throws DataError where a formula of closure is not 0 without pressure, or falls there.
  void check_closure() const;
  double dilated(int cell, double slip) const;
  double dilation_at(int cell, double slip) const;
  double closure(int cell, double normal_traction) const;              ///< m
  double closure_by_traction(int cell, double normal_traction) const;  ///< its derivative, m/Pa
  /// Checks formulas of closure and dilation, and takes the derivative of dilation at zero slip.
  void evaluate_formulas();
  /// The state of the walls for History: at the end of the step if it `has_moved`, else at its start.
  History::StateAt state_remembered(bool has_moved) const;
  /// The coefficient of friction by this law. Throws DataError where it is negative or not finite.
  OfWalls friction_by_law(int cell, const FrictionLaw& law, const WallState& state) const;
  /// The strength of the walls in this state, with derivatives, by their own laws.
  Strength strength_by_laws(int cell, const WallState& state) const;
  /// The same, with the factor of friction from another component.
  Strength strength(int cell, const WallState& state) const;
  /// The state of the walls with this path (m) at the end of the step, this slip in the step and this pressure (Pa).
  WallState wall_state(int cell, double path, const SlipOfStep& step, double pressure) const;
  /// The strength at the start of the step, under this normal traction (Pa).
  Strength strength_before(int cell, double normal_traction) const;
  bool may_weaken() const { return weakening_.is_on() || formulas_->may_weaken(); }
  /// The slip over which the walls lose all of their present strength, m.
  double distance_of_loss(const Strength& strength, double normal_traction) const;
  double gap(int cell, const Vector& traction, const Vector& jump) const;
  double pressure_beside(int cell) const;
  /// By how much the traction exceeds the strength of the walls, Pa; negative below it.
  double excess(int cell) const;
  /// mu_d; mu_s where friction does not weaken.
  double dynamic_friction(int cell) const;
  /// The path q of slip and opening at the end of the step, m, with the gap of the cell then and the size of the slip
  /// in the step.
  double path(int cell, double gap, double slip) const;
  TangentialVector moved(int cell) const;  ///< the slip in the step, m
  /// Its size. In space, its part along the trial traction: both are equal in each solution, in which walls slide along
  /// it, and this part is also differentiable at zero slip. Not with springs between the walls, which also move along
  /// the change of the traction.
  SlipOfStep slip_of_step(int cell, const TangentialVector& trial) const;
  void go_on_below_zero(const SlipOfStep& step, Strength& strength) const;
  static TangentialVector tangential(const Vector& values, int cell);
  /// A number for the state of a cell and, with friction, for the direction of its slip; while pieces are followed also
  /// for the piece of |[u]_t|.
  int piece(int cell) const;

  /// The last update by Newton's method in this step of a cell that slides back towards zero slip.
  struct BackSlip {
    enum class Piece { none, before_kink, beyond_kink } taken = Piece::none;  ///< of |[u]_t|, by the last update
    TangentialVector direction = TangentialVector::Zero();                    ///< of the slip at that update
    bool is_beyond = false;                                                   ///< the solution is not before the kink
  };
  /// The trial state for the update, whose piece may differ from that of the present values.
  Trial trial_of_update(int cell) const;

  const Mesh& mesh_;
  Origin origin_;
  Field& traction_;
  Field& jump_;
  Field* path_ = nullptr;  ///< q, m; null without weakening
  std::unique_ptr<const Options> options_;
  std::vector<char> here_;                ///< one flag a fracture cell; none where the contact is on all fractures
  std::optional<double> dilation_limit_;  ///< m
  Weakening weakening_;
  Multiplier multiplier_;
  double stiffness_factor_;                            ///< of the springs over c
  std::unique_ptr<Closure> closure_;                   ///< null for hard walls
  std::unique_ptr<RateAndStateWalls> rate_and_state_;  ///< null where friction does not depend on the rate
  std::unique_ptr<History> history_;                   ///< nullptr where nothing is remembered
  std::unique_ptr<Formulas> formulas_;
  Property friction_, dilation_angle_;       ///< mu_s, psi; of formulas, values without slip
  const Field* friction_factor_ = nullptr;   ///< where another component gives one
  Property dynamic_friction_;                ///< mu_d, where friction weakens
  Vector dilation_;                          ///< tan psi
  std::vector<char> bonded_;                 ///< empty for none
  Vector bonded_jump_;                       ///< m, of all cells; empty where none is bonded
  Vector carried_traction_;                  ///< Pa, of the state that is being settled on other cells; otherwise empty
  std::vector<char> kept_;                   ///< stick as long as they touch; empty for none
  std::vector<BackSlip> back_slip_;          ///< empty before the first update of a step
  double slip_at_start_ = 0;                 ///< m, the largest, of the state that was settled
  std::string passed_;                       ///< the text on a loss of stability that this step has passed
  Vector shear_modulus_;                     ///< Pa, of the rock beside each cell; empty where it is not known
  bool is_solved_for_ = false;               ///< whether the present solve determines the traction
  std::array<std::uint64_t, 2> followed_{};  ///< last versions of traction and jump in observe_iterate
  double dt_ = 0;                            ///< s, of the step
  bool is_without_shortcuts_ = false;        ///< after Newton's method has failed
  bool follows_pieces_ = false;              ///< derivatives of the present piece, no guess of the next
  std::vector<double> fracture_size_;        ///< m, as FractureCell::size
  /// c, Pa/m, (normal, tangential) of each cell: with the tangential stiffness of the cell's walls, and with that of
  /// its whole fracture. Newton's method first uses the stiffness of the fracture, with which cells that unload
  /// together stick at once. After a failure it uses that of the cell's walls, since with the other one it may cycle
  /// between states that differ in single cells.
  Vector stiffness_of_walls_, stiffness_of_fractures_;
  Vector stiffness_of_springs_;  ///< Pa/m, as that of fractures without the limit by friction: penalties
};

}  // namespace sprekk::contact
