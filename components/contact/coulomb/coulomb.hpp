// Frictional contact with dilation (Eqs. 2 and 3 of the paper), cell by cell.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "components/capabilities/fracture_contact.hpp"
#include "framework/assembly/property.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::contact {

struct Options {
  Data friction;        ///< mu_s
  Data dilation_angle;  ///< psi, rad
  Spec spec();
};

enum class State { stick, slip, open };

/// Unknown: the contact traction f of every fracture cell, (normal, tangential), from the jump [u] across it. With the
/// gap h = [u]_n − |[u]_t| tan psi, the slip of the step d = [u]_t − [u]_t,old, and the stiffness c of the walls:
///   f_n = min(0, f_n + c_n h)                                                      (Eq. 2 of the paper)
///   f_t = projection of f_t + c_t d onto [−b, b],  b = −mu_s min(0, f_n + c_n h)   (Eq. 3 of the paper)
/// which hold for any c > 0 exactly when the conditions do (Alart and Curnier 1991; Hüeber, Stadler, Wohlmuth 2008),
/// and divided by c (so that every residual is a length), are solved by a semismooth Newton method. f acts on the plus
/// wall, [u] = u(minus) − u(plus), so friction makes f_t point along the slip: power −f·[u]' ≤ 0 is drawn from the
/// walls. (Eq. 3 of the paper has the opposite sign.)
///
/// mu_s and psi are those of the end of the step. The gap knows the slip and not its history: where psi falls, a
/// fracture that has slipped closes.
///
/// A wall that slides back comes down from what it has climbed by dilation. The fracture closes, the fluid in it is
/// pressed together where it cannot leave, the walls are pushed apart and hold less shear: there may be no state
/// between its slip and none in which friction balances the load, and Newton's method, which finds the one where slip
/// goes the wrong way, and sticking return to each other forever. The state that balances it lies beyond the kink of
/// |[u]_t|. So a cell for which sliding back has led to slip in the wrong direction takes the derivatives, and the
/// residual of the update, from the piece of |[u]_t| beyond the kink. What a solution is does not change.
class Coulomb : public Component, public FractureContact {
 public:
  Coulomb(const ComponentContext& context, const Options& options);

  void evaluate_data(const StepTime& step) override;
  void begin_step(const StepTime&) override { back_slip_.clear(); }
  /// Cells that have grown hold together, [u] = 0, until the state without them has been found on the new mesh.
  void carry_over(const Part& before, const MeshChange& change) override;
  void settled(const MeshChange& change) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  std::uint64_t discrete_state() const override;
  void look_for_solution(Look look) override {
    is_careful_ = look != Look::freely;
    follows_pieces_ = is_careful_ && look != Look::carefully;
  }
  void loosen() override;
  std::vector<double> switch_times() const override;
  void report(std::vector<Quantity>& quantities) const override;
  void output(std::vector<OutputField>& fields) const override;
  void note_step(Notes& notes, const StepTime& step) const override;

  Field& traction() override { return traction_; }
  Field& jump() override { return jump_; }
  /// Along the tangent it is taken for that of the whole fracture, which answers slip of all cells as many times more
  /// softly as it is longer. When a load goes back, the derivatives of slip make all cells slide back at once, over the
  /// whole fracture; with the stiffness of a cell alone they would be taken to slip back by friction, then to and fro,
  /// where they only stick.
  /// The stiffness along the normal is limited to half of that along the tangent over mu_s tan psi. Walls that slide
  /// freely while open, by d, overlap by |d| tan psi; with more than that limit they would be taken to stick, come back
  /// to where they were, open, and so on. With less they are taken to slip.
  void set_wall_stiffness(const Vector& stiffness) override;

  State state(int cell) const;
  bool is_bonded(int cell) const { return !bonded_.empty() && bonded_[cell]; }

 private:
  const Vector& stiffness() const { return is_careful_ ? stiffness_of_walls_ : stiffness_of_fractures_; }
  struct Trial {
    double gap, normal, tangential, bound;
    double slip_sign;  ///< of d gap / d [u]_t
    bool is_open() const { return normal > 0; }
    bool sticks() const { return std::abs(tangential) <= bound; }
    /// Slides towards the place where it has not slipped.
    bool slides_back() const { return !is_open() && !sticks() && tangential * slip_sign < 0; }
  };
  Trial trial(int cell) const;
  /// A number for the state of a cell, and when pieces are followed for the piece of |[u]_t| too.
  int piece(int cell) const;

  /// Slip of a cell against the slip that it has, as Newton's method has tried it in this step.
  struct BackSlip {
    enum class Piece { none, before_kink, beyond_kink } taken = Piece::none;  ///< of |[u]_t|, by the last update
    double direction = 0;                                                     ///< of the slip at that update
    bool is_beyond = false;                                                   ///< the solution is not before the kink
  };
  /// Of the update, for which the piece may be another than that of the present values.
  Trial trial_of_update(int cell) const;
  void follow_back_slip() const;

  const Mesh& mesh_;
  Field& traction_;
  Field& jump_;
  Options options_;
  Property friction_, dilation_angle_;               ///< mu_s, psi
  Vector dilation_;                                  ///< tan psi
  std::vector<char> bonded_;                         ///< empty for none
  mutable std::vector<BackSlip> back_slip_;          ///< empty before the first update of a step
  mutable std::array<std::uint64_t, 2> followed_{};  ///< versions of traction and jump that it has followed last
  bool is_careful_ = false;                          ///< after Newton's method has failed
  bool follows_pieces_ = false;                      ///< as they are: no guess of what lies beyond the kink
  std::vector<double> fracture_length_;              ///< m
  /// c, Pa/m, (normal, tangential) of each cell: that of its walls, and with the tangential one of all of its fracture.
  /// Newton's method takes the second at first, with which cells that unload together stick at once. Where it fails it
  /// takes the first: with the second it may go to and fro between pieces that differ in single cells.
  Vector stiffness_of_walls_, stiffness_of_fractures_;
};

}  // namespace sprekk::contact
