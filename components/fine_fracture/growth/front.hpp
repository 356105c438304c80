// The search for the advance of all tips in one time step, whatever computes their stress intensity factors.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "components/fine_fracture/growth/learnt_slopes.hpp"
#include "components/fine_fracture/growth/mixed_mode.hpp"
#include "components/fine_fracture/growth/most_equal_front.hpp"
#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// A tip at the start of a step. Its last segment begins at the anchor. It is straight, and as long as it has not
/// reached its full length, growth makes it longer and may turn it.
struct FrontTip {
  Point anchor = Point::Zero();  ///< m
  double covered = 0;            ///< m, length of the segment at the start of the step; 0 where a new one begins
  double angle = 0;              ///< rad, of the segment from the x axis; of the direction ahead where a new one begins
  double toughness = 0;          ///< K_IC, Pa sqrt(m)
  double longest = 0;            ///< m, most that the segment may become in this step
  double size = 0;               ///< m, length of the fracture of the tip; 0: not known
  double least = 0;              ///< m, of a new segment: what has parted in earlier steps does not heal
  double speed = 0;              ///< m/s, of the last step; 0 where the tip did not grow
  /// rad from the x axis: of the path at the tip, and not of a segment that was divided; for a bent one its chord
  double ahead = 0;
  double turning = 0;  ///< rad/m, of `ahead` by the growth in the last step
  bool is_bent =
      false;  ///< whether the direction at its beginning is fixed: then its end turns twice as much as its chord
  Point start = Point::Zero();  ///< unit vector, this direction
  bool goes_on = false;         ///< grows in the first trial, whatever its load
  /// m and rad, of the first trial; a tip that has them grows in it, whatever its load. Otherwise a length of 0.
  double first_length = 0, first_angle = 0;
  /// Whether the length, or the angle, of the first trial is given: then it is not searched for.
  bool has_length = false, has_angle = false;
  double largest_turn = 1.5;  ///< rad, of a new segment from `angle`
};

/// What is known of the tips after a trial step: the factors in the frame of the last segment.
struct FrontState {
  Sifs sifs;
  double load = 0;           ///< K_eq over K_IC; all that counts for a tip that does not grow
  bool is_evaluated = true;  ///< whether the factors are known; otherwise the load is an estimate that rules growth out
  /// What has to vanish where the tip grows, with the sign of K_eq - K_IC; without it that is ln(load).
  std::optional<double> excess = {};
};

/// Tolerances and limits of the search.
struct FrontOptions {
  double mesh_error = 1e-3;  ///< of ln K between tips, see most_equal_front.hpp; 0: each K is the toughness
  /// |ln(K_eq/K_IC)|, or the excess, of growing tips: far below the errors of the meshes.
  double load_tolerance = 1e-7;
  double direction_tolerance = 1e-6;                              ///< |K_II/K_I| of growing tips
  double increment = 0;                                           ///< m, the scale of advances
  double shortest = 0;                                            ///< m, of a new segment
  double longest_jump = std::numeric_limits<double>::infinity();  ///< m, of a tip in one step
  int most_trials = 20;                                           ///< of a step, before it is cut: 8 to 10 are needed
  /// Whether all but the tip is held: one tip and one increment. A tip above its toughness at its longest length is
  /// accepted, since its next increment is another search.
  bool holds_state = false;
};

/// Finds lengths and directions of the last segments of all tips with which, in the state at the end of the step,
///   K_eq = K_IC and K_II = 0 at tips that grow,    K_eq <= K_IC at tips that do not,
/// by a quasi-Newton method for the tips that grow; which do is decided anew after each trial. K of several tips is
/// known to the error of the mesh only: of all fronts within this error the one with the most equal advances is sought
/// (most_equal_front.hpp). Of several solutions it seeks the one nearest to the start of the step.
///
/// With the state held it finds one increment of one tip (IncrementSearch). The load at length 0 is known, so the
/// length is bracketed: it lies between one that is too short and one that is too long.
///
///   Front front(…, states of the trial without growth, …);
///   while (front.verdict() == again) front.learn(states of the trial with lengths(), angles());
class Front {
 public:
  /// What follows from the last trial: another one, the end, or why there is none.
  enum class Verdict { again, found, too_far, failed };
  /// `without_growth`: the states of the step without growth; for tips that go on, those at its start. `slopes`: what
  /// an earlier search has learnt (see slopes()), or an empty matrix.
  Front(std::vector<FrontTip> tips, const std::vector<FrontState>& without_growth, const FrontOptions& options,
        double dt, const Eigen::MatrixXd& slopes = {});

  /// Whether the tip has an advance in the trial.
  bool grows(int tip) const { return grows_[tip]; }
  /// Whether its last segment is laid anew in the trial: it grows, or has come back to where it was. K_eq differs from
  /// mesh to mesh, so a tip that was found to rest stays on the mesh on which it was.
  bool is_laid(int tip) const { return is_laid_[tip]; }
  double length(int tip) const { return length_[tip]; }  ///< m, of the last segment, covered part included
  double angle(int tip) const { return angle_[tip]; }    ///< rad, from the x axis
  bool any_grows() const;

  /// The tip stays where it was at the start of the step, whatever its load.
  void stop(int tip);
  /// A tip that has no segment in the trials yet begins with this one (m, rad from the x axis) once it is to grow.
  void begin_with(int tip, double length, double angle);
  /// The next states are those of a mesh with another topology than the last one: K differs by the error of a mesh.
  void change_mesh() { is_other_mesh_ = true; }
  void learn(const std::vector<FrontState>& states);
  /// After a front was found: the states of the same trial, with those of tips that were not evaluated before. If one
  /// of these has to grow, the search goes on.
  void learn_of_others(const std::vector<FrontState>& states);
  static double excess(const FrontState& state);  ///< ln(load), or what takes its place
  Verdict verdict() const { return verdict_; }
  int trials() const { return trials_; }
  /// Whether a front was found to 1e-5 of K and 1e-4 of K_II/K_I only, since trials came no nearer to it.
  bool is_rough() const { return is_rough_; }
  /// The largest residual of the load of a growing tip in the last trial; of a tip alone |ln(K_eq/K_IC)|.
  double worst() const { return worst_; }
  double worst_shear() const { return worst_shear_; }  ///< the largest |K_II/K_I| of a growing tip there
  const std::string& reason() const { return reason_; }
  /// The derivative of (ln(K/K_IC), K_II/K_I) by (length/increment, angle), per tip, as it was learnt, without the
  /// parts that depend on the lengths of segments and fractures; for the next step.
  Eigen::MatrixXd slopes() const;

 private:
  int count() const { return static_cast<int>(tips_.size()); }
  bool is_new(int tip) const { return tips_[tip].covered == 0; }
  double shortest(int tip) const { return std::max(options_.shortest, tips_[tip].least); }
  /// The length of a last segment that does not grow.
  double least(int tip) const { return is_new(tip) ? shortest(tip) : tips_[tip].covered; }
  double first_advance(int tip, const FrontState& state) const;
  void begin(int tip, const FrontState& state);
  void set_turn_slope(int tip, const Sifs& sifs);
  bool learns_from_start() const;
  void weigh_differences();
  void make_jacobian();
  void forget();
  double size_of(int tip) const;
  /// Puts the parts of the derivatives that depend on the lengths of segments and fractures in, or takes them out
  /// (`inverse`). `states`: those at which the slopes of turns are taken.
  void scale(Eigen::MatrixXd& jacobian, const std::vector<FrontState>& states, bool inverse) const;
  /// d(K_II/K_I)/d angle of the last segment of a tip, of this length (m), by the expansion of a kink.
  double turn_slope_of(int tip, const Sifs& sifs, double length) const;
  /// (ln(K/K_IC), K_II/K_I), per tip. For a tip that grows K² = K_I² + K_II², the energy release rate: its roots are
  /// those of K_eq, and it depends less on squares of the error of a direction. For others K = K_eq.
  Eigen::VectorXd residual(const std::vector<FrontState>& states) const;
  Eigen::VectorXd place() const;
  void update_jacobian(const Eigen::VectorXd& residual);
  void leave_mesh(const Eigen::VectorXd& residual);
  bool may_start(int tip) const { return !grows_[tip] && !is_stopped_[tip] && last_[tip].is_evaluated; }
  std::vector<int> front_tips() const;
  double advance(int tip) const;                                 ///< in increments
  Eigen::VectorXd advances(const std::vector<int>& tips) const;  ///< in increments
  static Eigen::VectorXd loads(const std::vector<int>& tips, const Eigen::VectorXd& residual);
  /// The equations of the tips of front_tips().
  FrontEquations equations(const Eigen::VectorXd& residual) const;
  /// The residual with these equations in the place of the loads.
  Eigen::VectorXd count_loads(const Eigen::VectorXd& residual, const FrontEquations& front) const;
  bool has_equal_advances(const Eigen::VectorXd& residual) const;
  double load_at_rest(int tip, const Eigen::VectorXd& residual) const;
  bool free_tips(const Eigen::VectorXd& residual);
  void begin_beside_front(int tip);
  /// Newton's step in the unknowns `free`.
  Eigen::VectorXd newton_step(const std::vector<int>& free, const Eigen::VectorXd& residual);
  bool is_at_longest(int tip, const Eigen::VectorXd& residual) const;
  /// Whether the unknown (2 tip: length, 2 tip + 1: angle) stays as it is, whatever its residual.
  bool is_held(int unknown, const Eigen::VectorXd& residual) const;
  /// Whether the residual says if the length is too short or too long.
  bool tells_of_length(int tip, const Eigen::VectorXd& residual) const;
  /// The unknowns that stay in the next step.
  std::vector<int> held_unknowns(const Eigen::VectorXd& residual) const;
  /// Newton's step in the unknowns `free` but for these, which stay.
  Eigen::VectorXd step_without(const std::vector<int>& held, const std::vector<int>& free,
                               const Eigen::VectorXd& residual);
  std::optional<Eigen::VectorXd> step_to_linear_front(const std::vector<int>& free,
                                                      const Eigen::VectorXd& residual) const;
  bool shorten_closed(const std::vector<FrontState>& states);
  bool may_shorten(int tip) const;
  void shorten(int tip, double part, double excess);
  void forget_angles(int tip);
  bool turn_between(int tip, double tried);
  void step_between(int tip, std::optional<double> excess);
  bool has_bracket(int tip) const { return options_.holds_state && is_new(tip); }
  void learn_length(int tip, double excess);
  double length_between(int tip) const;
  void turn_with_length(int tip, double length);
  double norm(const Eigen::VectorXd& residual) const;
  bool is_met_but_for_noise(const Eigen::VectorXd& residual) const;
  /// The residual to go on from: that of the last trial, or of the best one if the last was much worse.
  Eigen::VectorXd return_to_best(const Eigen::VectorXd& residual);
  void step(const Eigen::VectorXd& residual);

  std::vector<FrontTip> tips_;
  FrontOptions options_;
  double dt_;
  std::vector<char> grows_, is_laid_, is_stopped_;
  std::vector<char> was_unstable_;  ///< tips that were pushed on once, since their load did not fall with their length
  std::vector<double> length_, angle_;
  std::vector<FrontState> last_, start_;
  LearntSlopes slopes_;  ///< of residual() by (length/increment, angle), per tip
  Eigen::VectorXd before_place_, before_residual_;
  /// The best trial so far with the tips that grow now.
  struct Best {
    Eigen::VectorXd place, residual;
    double norm;
    std::vector<int> held;
  };
  std::optional<Best> best_;
  /// With the state held: a length (m) of a new segment and the excess at its end, in the right direction.
  struct Length {
    double length, excess;
  };
  struct Turn {
    double angle, k2;  ///< rad, and K_II at the end, Pa sqrt(m); 0: not known
  };
  struct Bracket {
    Length shorter;
    std::optional<Length> longer, third;
    Turn left, right;  ///< between them K_II vanishes with the present length
  };
  std::vector<Bracket> brackets_;
  bool is_warm_ = false;  ///< whether the Jacobian comes from an earlier search: a warm start
  bool is_other_mesh_ = false, is_rough_ = false;
  static constexpr double most_of_difference = 30;  ///< slopes of loads, 0.3, over those of H, 0.01
  double of_difference_ = most_of_difference;       ///< the weight of differences of advances in norm()
  double part_ = 1;                                 ///< of steps, smaller after trials that were worse
  Verdict verdict_ = Verdict::again;
  int trials_ = 0, last_gain_ = 0;
  double worst_ = 0, worst_shear_ = 0;
  std::string reason_;
};

}  // namespace sprekk::fine_fracture
