// The tips of all fractures, each with a fine level of its own around it (secs. 2.5, 3.1, 4.3 of the paper).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/fracture_tips.hpp"
#include "components/fine_fracture/fine_level/fine_domain.hpp"
#include "components/fine_fracture/fine_level/fine_level.hpp"
#include "components/fine_fracture/growth/anisotropy.hpp"
#include "components/fine_fracture/growth/arc.hpp"
#include "components/fine_fracture/growth/grow_tips.hpp"
#include "components/fine_fracture/tips/beside_arcs.hpp"
#include "framework/assembly/counts_work.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/tells_events.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"
#include "framework/schedule/growing.hpp"

namespace sprekk::fine_fracture {

/// Parameters of tips with fine levels of any kind.
struct TipsOptions {
  double size = 0;                ///< m, l of sec. 4.3 of the paper
  std::optional<Data> toughness;  ///< K_IC, Pa m^0.5
  Anisotropy anisotropy;
  std::string meeting = "join";
  double cavity = 4;           ///< radius in coarse mesh sizes
  double cavity_growth = 0.3;  ///< of edges in it, m per m: as `mesh.growth`
  double skip_below = 0.5;     ///< of the toughness: tips with a smaller estimate are not evaluated
  GrowthOptions growth;
  void declare_size(Spec& spec);
  void declare_growth(Spec& spec);
};

/// The component of tips. It has no unknowns in the coarse level: it reads the state of the coarse level around each
/// tip (TipSurroundings), computes the stress-intensity factors on the fine level, and lets tips grow. A path that is
/// too short for the coarse level stays in the fine level, until it is long enough to be passed on.
class Tips : public Component,
             public KeepsState,
             public FollowsMesh,
             public CountsWork,
             public TellsEvents,
             public FractureTips,
             public MovingTips,
             public Growing {
 public:
  Tips(const ComponentContext& context, const TipsOptions& options, std::unique_ptr<const FineLevelMaker> maker);

  void begin_step(const StepTime& step) override { step_ = step; }
  void assemble(Assembly&, const StepTime&) const override {}
  void accepted() override;
  void rewound() override;
  void carry_over(const Part& before, const MeshChange& change) override;
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;
  void report(std::vector<Quantity>& quantities) const override;
  std::map<std::string, long> counts() const override;
  std::vector<Profile::Entry> efforts() const override;
  void note_input(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  /// Jumps: an event for each tip; those of one jump have the same time.
  std::vector<Quantity> event_figures() const override;
  std::vector<Event> events(const StepTime& step) const override;

  /// Throws InputError for jumps on walls where the fine level takes none.
  void accept_surroundings(TipSurroundings& surroundings) override;
  void require_loads() const override;

  Load examine(const StepTime& step) override { return examine(step, false); }
  void examine_followed(const StepTime& step) override { examine(step, true); }
  Growth grow(const StepTime& step) override;
  bool may_grow_within_steps() const override;
  void grow_within_steps() override;
  void hold(bool is_held) override { is_held_ = is_held; }
  bool is_far_above() const override;
  bool grows_on() const override;
  double longest_step() const override;
  std::unique_ptr<FrontSearch> search_front(const StepTime& step, bool may_shrink, bool goes_on) override;
  std::vector<MovingTips::Tip> moving_tips() const override;
  void prepare(Growing& other) const override;
  std::vector<PendingPath> pending_paths() const override;
  CavityOptions cavity() const override;
  std::uint64_t topology() const override;
  /// With cells held closed, UMFPACK loses digits that MUMPS keeps.
  bool settling_costs_digits() const override { return true; }

 private:
  friend class TipsFront;  // it sets the state of the tips of trial models
  /// The state of a tip that a step may change and a rewind restores.
  struct State {
    TipPath path;               ///< the part of the path that the coarse mesh does not have yet
    Sifs sifs;                  ///< valid if is_evaluated
    double sif_error = 0;       ///< Pa m^0.5, the estimated error by the mesh of the fine level
    bool is_evaluated = false;  ///< whether the factors have been computed for this state
    double load = 0;            ///< K_eq over the toughness, or the estimate by which a fine level was skipped
    double grown = 0;           ///< m, length that the coarse mesh has taken over
    bool has_started = false;   ///< whether the tip has begun to grow: its onset is over
    WarmStart warm_start;       ///< of the last increment
    bool is_extendable =
        false;         ///< whether the last cell of the fracture is the last segment, which growth may replace
    double speed = 0;  ///< m/s, of growth in the last step
    /// Pa sqrt(m), K_eq of a viscous tip by its speed in the last step; 0: the toughness. For results alone.
    double apparent_toughness = 0;
    double turning = 0;                           ///< rad/m, of the last segment by growth in the last step
    double speed_before = 0, turning_before = 0;  ///< the same, of the step before that
    double lasted = 0, lasted_before = 0;         ///< s, these two steps; 0: not known
    /// Whether growth within a step has laid the last segment: it has K_II = 0 at its end.
    bool was_laid = false;
    /// The direction of the path at the beginning of the last segment. With one the fine level has an arc in place of
    /// the segment.
    std::optional<Point> segment_start;
    double pressure_rate = 0;  ///< Pa/s, of the fluid in the last cell, in the last step
    bool is_stopped = false;   ///< for good, at or before another fracture, or before the boundary
  };
  /// A tip, its state, and what is kept of its fine level.
  struct Tip {
    TipEnd end;
    std::string name;
    double coarse_size;  ///< m, Delta H: the length of the original cell at this end
    State now, accepted;
    double length_at_start = 0;        ///< m, what had grown at the start of the step that was examined last
    std::optional<double> taken_over;  ///< s, start of the step in which the mesh took growth over last
    /// The factors for `level`, `domain` and one state of the coarse level.
    struct KeptFactors {
      std::uint64_t version;  ///< of the surroundings
      Sifs sifs;
      double error;  ///< Pa m^0.5, estimated
    };
    // A factorization is reused while geometry and rock stay the same, the factors while the coarse level does, too.
    std::unique_ptr<const FineLevel> level;
    TipSurroundings::StressOffsets offsets;   ///< at the places of the level, found when they are first asked for
    TipSurroundings::BodyForces body_forces;  ///< the same
    FineDomain domain;
    std::optional<KeptFactors> kept_factors;
    bool lacks_contact = false;  ///< walls around it carry the tractions of the coarse level: they have no other state
    std::uint64_t evaluated_for = 0;
    /// What trials within a step have in common, so that factors depend smoothly on the advance.
    std::shared_ptr<const KeptLevel> pattern;
    bool has_pattern = false;         ///< whether `level` was made with it
    std::optional<Point> next_start;  ///< State::segment_start on the trial meshes of this step
    std::uint64_t topology = 0;       ///< of the mesh of the last fine level that was made
  };

  /// An end of a fracture at another fracture; it may have been a tip.
  struct Joint {
    TipEnd end;
    std::string name;
    double grown = 0;            ///< m
    double length_at_start = 0;  ///< m, as that of a tip
  };

  /// What results tell of the growth at an end of a fracture.
  struct EndGrowth {
    Point position;                  ///< m
    double length, length_at_start;  ///< m, of what has grown
    double toughness;                ///< K_IC there, Pa m^0.5; 0 where tips do not grow
    double equivalent;               ///< K_eq, Pa m^0.5
  };
  void report_end(const std::string& end, const State& state, const EndGrowth& growth,
                  std::vector<Quantity>& quantities) const;
  /// Where a step is examined for the first time, also by the models of its trials and repetitions.
  void note_start(const StepTime& step);
  Load examine(const StepTime& step, bool followed_only);
  void check_size(const Tip& tip) const;      ///< throws InputError where the square is too small for the coarse mesh
  void check_shortest(const Tip& tip) const;  ///< throws InputError where increments are far below the mesh
  void check_longest() const;                 ///< throws InputError where a tip could not grow at all
  void check_increment() const;               ///< throws InputError where an increment would leave the square
  void check_anisotropy() const;              ///< throws InputError where tips have no direction
  const FractureCell& last_cell(const TipEnd& end) const;
  Point position(const Tip& tip, const TipPath& path) const;
  Point direction(const Tip& tip) const;  ///< of the last cell
  Point end_direction(
      const Tip& tip) const;  ///< of the path in the fine level that the mesh has taken over, at its end
  /// m; none where the fine level has no arc in its place.
  std::optional<Point> corner_of_last_segment(const Tip& tip) const;
  BesideArcs arcs_of_last_segments() const;
  std::vector<FracturePath> paths_with(const std::vector<TipPath>& added) const;
  std::vector<TipPath> paths_now() const;
  FineRock rock_around(const Point& center) const;
  Sifs evaluate(std::size_t tip, const std::vector<TipPath>& paths);
  /// Throws UnsuitableRock.
  void check_rock(const Tip& tip) const;
  InputError refusal(const UnsuitableRock& rock) const;
  void check_stiffness(const FineDomain& domain, const LameParameters& rock) const;
  FineLoads loads_of(const Tip& tip) const;
  /// Sets their estimated error, and keeps the factors for this state of the coarse level.
  Sifs keep_factors(Tip& tip, const TipFactors& factors) const;
  /// The load as estimated from the displacement jump of the coarse level beside the tip, without a fine level.
  double estimated_load(const Tip& tip) const;
  /// K_IC of rock that this end of a fracture grows into, across the direction of its anisotropy, Pa m^0.5. Throws
  /// DataError.
  double toughness(const TipEnd& end, const Point& x) const;
  /// K_IC for growth straight ahead, Pa m^0.5.
  double toughness(const Tip& tip, const TipPath& path) const {
    return toughness(tip.end, position(tip, path)) * options_.anisotropy.toughness(ahead(tip, path));
  }
  double toughness(const Tip& tip) const { return toughness(tip, tip.now.path); }
  double ahead(const Tip& tip,
               const TipPath& path) const;  ///< rad from the x axis, the direction at the end of the path
  /// The factors as the criterion takes them (felt_sifs).
  Sifs felt(const Tip& tip, const TipPath& path, const Sifs& sifs) const {
    return felt_sifs(sifs, ahead(tip, path), options_.anisotropy);
  }
  Sifs felt(const Tip& tip) const { return felt(tip, tip.now.path, tip.now.sifs); }
  /// Whether the fluid at the tip holds it back by its viscosity.
  bool is_viscous(const Tip& tip) const;
  /// K_eq (Pa sqrt(m)) of a viscous tip that the mesh follows and that moves with a speed (m/s): with the pressure that
  /// its last cell has, uniform, the opening of this cell has the volume of the tip solution.
  double apparent_toughness(const Tip& tip, double speed) const;
  double apparent_toughness(const Tip& tip, double speed, double at_rest) const;  ///< with the K_IC `at_rest`
  /// K_eq of a tip at the end of this path, to which it grows in this step, Pa sqrt(m). Before the mesh follows a tip,
  /// its fluid holds it back, too; the paper's procedure knows the toughness alone.
  double resistance(const Tip& tip, const TipPath& path) const;
  void set_factors(Tip& tip, const Sifs& sifs) const;
  void leave_last_segment(Tip& tip, const TipPath& path);
  void note_end(const Tip& tip, const TipOutcome& outcome, bool has_joined);
  void note_narrow_square(const Tip& tip, Notes& notes) const;
  void note_shear(const Tip& tip, Notes& notes) const;
  /// How far each tip grows with the state held. Tips that the mesh follows stay.
  std::vector<TipOutcome> find_outcomes();
  /// Stops tips whose path the mesh cannot take: they stay for good where they were at the start of the step.
  void stop_refused(std::vector<PathExtension>& extensions, const std::vector<TipOutcome>& outcomes);
  /// Whether the path of a tip is so long that the mesh follows it.
  bool is_long_enough(const Tip& tip, const TipPath& path) const;
  /// Whether the mesh follows the tip within steps: its growth is not found by the fine level alone.
  bool is_followed(const Tip& tip) const {
    return grows_within_steps_ && !is_held_ && (tip.now.is_extendable || is_long_enough(tip, tip.now.path));
  }
  /// Whether the path of a tip turns so sharply that it begins anew at the tip: what has parted stays where it is.
  bool turns_sharply(const Tip& tip) const;
  /// By which part the load of a tip that has come to rest may exceed 1.
  double rest_tolerance() const;
  double growth_load(const Tip& tip) const;
  double threshold(const Tip& tip) const;
  /// The longest path that a tip may have in the fine level alone, m.
  double longest_path(const Tip& tip) const;
  /// Whether an increment of the other tip affects this tip at once; farther increments do so from the next step on.
  bool is_near(const Tip& tip, const Tip& other) const;
  double free_distance(const Tip& tip, const TipPath& path, const Point& to) const;
  /// A path that ends at another fracture.
  struct Joining {
    PathExtension extension;
    int other;  ///< the fracture that is joined
  };
  /// The last piece from a blocked tip to another fracture, if the mesh can take this piece beside the other
  /// extensions, and it does not close a ring of fractures. `joined`: pairs of fractures that join at the same time.
  std::optional<Joining> find_joining(const Tip& tip, const TipOutcome& outcome,
                                      const std::vector<PathExtension>& others,
                                      const std::vector<std::pair<int, int>>& joined) const;
  bool continues_elsewhere(const Ridge& point) const;

  const Mesh& mesh_;
  Origin origin_;  ///< of the component in the scene
  TipsOptions options_;
  std::unique_ptr<const FineLevelMaker> maker_;
  TipSurroundings* surroundings_ = nullptr;
  std::vector<Tip> tips_;
  std::vector<Joint> joints_;
  bool grows_within_steps_ = false;
  bool is_held_ = false;            ///< in this step tips grow with the state held all the same
  StepTime step_;                   ///< the present one
  std::optional<double> examined_;  ///< s, start of the step that was examined last
  Eigen::MatrixXd slopes_;          ///< Front::slopes of the last search
  /// A note on how growth has ended.
  struct EndNote {
    std::string topic, text;
    double measure;                   ///< how bad it is: of several notes on one topic the worst is kept
    std::optional<Event> event = {};  ///< that it tells of; when and where, events() says
  };
  std::vector<EndNote> notes_;                                      ///< of the growth in this step
  std::shared_ptr<Profile> profile_ = std::make_shared<Profile>();  ///< of all fine levels
  long solves_ = 0, meshes_ = 0, kept_ = 0, skipped_ = 0, increments_ = 0;
};

}  // namespace sprekk::fine_fracture
