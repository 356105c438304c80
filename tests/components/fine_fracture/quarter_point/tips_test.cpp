// What tips ask of the coarse level: pressures of their own ends on walls that have grown, and whether they can be
// ruled out without a fine level.
#include "components/fine_fracture/quarter_point/quarter_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "framework/assembly/notes.hpp"
#include "framework/field/field.hpp"
#include "framework/meshing/generate_mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

using std::numbers::pi;

constexpr int state_size = 22;  // numbers that a checkpoint has of a tip without a path
constexpr double toughness = 1e6, half_box = 20, crack_half_length = 1, young = 40e9, poisson = 0.2;
constexpr double shear = young / (2 * (1 + poisson)), plane_modulus = young / (1 - poisson * poisson);

/// Rock that is held at rest far away and walls without traction, but for the fluid in what has grown.
class Fluid : public TipSurroundings {
 public:
  double pressure[2] = {0, 0};  ///< at the first and the last end
  double risen[2] = {0, 0};     ///< in the step
  double jump[2] = {1, 1};      ///< m
  std::optional<Sliding> law;   ///< of all walls
  std::uint64_t state = 1;

  void update() override {}
  std::uint64_t version() const override { return state; }
  int region(const Point&) const override { return 0; }
  LameParameters stiffness(const Point&) const override { return {2 * shear * poisson / (1 - 2 * poisson), shear}; }
  Point displacement(const Point&, const Point&) const override { return Point::Zero(); }
  StressOffsets stress_offsets(const std::vector<Point>& places, const std::vector<Point>&) const override {
    return [count = places.size()] { return Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, count)); };
  }
  BodyForces body_forces(const std::vector<Point>&) const override { return {}; }
  bool gives_jumps() const override { return false; }
  Point wall_traction(int, double) const override { return Point::Zero(); }
  std::optional<Sliding> sliding(int, double) const override { return law; }
  Point wall_jump(int, double) const override { return Point::Zero(); }
  double fluid_pressure(int, bool at_end) const override { return pressure[at_end]; }
  double accepted_fluid_pressure(int, bool at_end) const override { return pressure[at_end] - risen[at_end]; }
  double fluid_viscosity(int, bool) const override { return 0; }
  double filled_part(int, bool) const override { return 1; }
  double jump_at_tip(int, bool at_end) const override { return jump[at_end]; }
  std::optional<double> propagation_threshold() const override { return std::nullopt; }
};

/// A straight fracture of length 2 in the middle of a wide box.
struct Setting {
  explicit Setting(double angle, bool is_reversed = false, const QuarterPointOptions& options = Setting::options())
      : along((is_reversed ? -1 : 1) * std::cos(angle), (is_reversed ? -1 : 1) * std::sin(angle)),
        mesh(make_mesh(along)),
        tips({"tips", mesh, fields, 0, {}}, options) {
    tips.accept_surroundings(fluid);
  }
  static Mesh make_mesh(const Point& along) {
    Geometry geometry;
    geometry.box.low = Point(-half_box, -half_box);
    geometry.box.high = Point(half_box, half_box);
    FractureGeometry fracture;
    fracture.name = "main";
    fracture.points = {-crack_half_length * along, crack_half_length * along};
    geometry.fractures = {fracture};
    MeshOptions options;
    options.size = 8;
    options.fracture_size = 0.25;
    return generate_mesh(geometry, options);
  }
  static QuarterPointOptions options() {
    QuarterPointOptions options;
    options.size = 2 * half_box;
    options.toughness = toughness;
    options.growth.increment = 0.1;
    return options;
  }
  /// Lets the path grow straight on by this length, which the coarse level does not have, at these ends.
  void grow(double length, bool first, bool last) {
    const auto state = [&](bool has_grown, double sign) {
      Vector values = Vector::Zero(has_grown ? state_size + 2 : state_size);
      values[7] = 1;
      if (has_grown) values.tail<2>() = sign * (crack_half_length + length) * along;
      return values;
    };
    tips.restore({{"tips.main_first", state(first, -1)}, {"tips.main_last", state(last, 1)}});
  }
  double quantity(const std::string& name) const {
    std::vector<Quantity> quantities;
    tips.report(quantities);
    for (const Quantity& quantity : quantities)
      if (quantity.name == "tips." + name) return quantity.value;
    ADD_FAILURE() << "no quantity " << name;
    return 0;
  }

  Point along;
  Mesh mesh;
  FieldStore fields;
  Fluid fluid;
  QuarterPoint tips;
};

/// Int of sqrt((a + x)/(a − x)) from one place to another.
double weight(double a, double from, double to) {
  const auto primitive = [a](double x) { return a * std::asin(x / a) - std::sqrt(a * a - x * x); };
  return primitive(to) - primitive(from);
}

TEST(Tips, GrownWallsCarryThePressureOfTheirOwnEnd) {
  // K_I = Int p(x) sqrt((a + x)/(a − x)) dx/sqrt(pi a) (Tada, Paris and Irwin), with p on the last 0.2 m of each end.
  const double grown = 0.2, a = crack_half_length + grown;
  const double own = weight(a, a - grown, a) / std::sqrt(pi * a), other = weight(a, -a, -a + grown) / std::sqrt(pi * a);
  for (const bool is_reversed : {false, true})
    for (const double angle : {0.0, 0.6, 0.6 + 1e-9}) {
      Setting setting(angle, is_reversed);
      setting.fluid.pressure[0] = 1e6;
      setting.fluid.pressure[1] = 3e6;
      setting.grow(grown, true, true);
      setting.tips.examine({});
      // A crack that is held at 20 times its half-length: 1 % at most.
      EXPECT_NEAR(setting.quantity("main_first.K_I") / (1e6 * own + 3e6 * other), 1, 0.01) << angle;
      EXPECT_NEAR(setting.quantity("main_last.K_I") / (3e6 * own + 1e6 * other), 1, 0.01) << angle;
    }
}

// A law by which the force between touching walls would pull them together has no state where the walls overlap.
TEST(Tips, TakeTheTractionsOfTheCoarseLevelWhereTheLawOfTheWallsHasNoState) {
  for (const bool is_reversed : {false, true})
    for (const double angle : {0.0, 0.6, 0.6 + 1e-9}) {
      double factor[3];
      for (const int law : {0, 1, 2}) {
        Setting setting(angle, is_reversed);
        // From plus, to the left of the path, to minus.
        const Point normal(setting.along[1], -setting.along[0]);
        // 0: walls keep the tractions of the coarse level, which are zero here. 1: without friction, and apart by less
        // than they open. 2: what touches is pulled together, and there is a gap to be closed everywhere.
        if (law == 1) setting.fluid.law = TipSurroundings::Sliding{Point::Zero(), normal, normal, -1e-2};
        if (law == 2) setting.fluid.law = TipSurroundings::Sliding{Point::Zero(), -normal, normal, 1e-2};
        setting.fluid.pressure[0] = setting.fluid.pressure[1] = 1e6;
        setting.grow(0.2, true, true);
        setting.tips.examine({});
        factor[law] = setting.quantity("main_first.K_I");
        Notes notes;
        setting.tips.note_step(notes, {});
        const bool is_told = std::ranges::any_of(notes.all(), [](const Notes::Note& note) {
          return note.topic == "no state of contact around tips.main_first";
        });
        EXPECT_EQ(is_told, law == 2) << law;
      }
      EXPECT_GT(factor[0], 0);
      EXPECT_NEAR(factor[1], factor[0], 1e-9 * factor[0]);
      EXPECT_NEAR(factor[2], factor[0], 1e-9 * factor[0]);
    }
}

TEST(Tips, AreRuledOutByTheJumpBesideThem) {
  // The jump (8/E') sqrt(r/(2 pi)) K_II at r = 0.125 m behind the tip, where K_eq is 1.1547 K_II (estimated: 1.25). A
  // tip is ruled out while twice its K_eq is below half of the toughness: K_II below 0.2 of it.
  const double jump = 8 / plane_modulus * std::sqrt(0.125 / (2 * pi)) * toughness;
  for (const double part : {0.1, 0.19, 0.21, 0.5, 0.95}) {
    Setting setting(0.6);
    setting.fluid.jump[0] = part * jump;
    setting.fluid.jump[1] = (1.15 - part) * jump;
    const Growing::Load load = setting.tips.examine({});
    const bool has_first = !std::isnan(setting.quantity("main_first.K_eq"));
    const bool has_last = !std::isnan(setting.quantity("main_last.K_eq"));
    EXPECT_EQ(has_first, part > 0.2) << part;
    EXPECT_EQ(has_last, 1.15 - part > 0.2) << part;
    EXPECT_EQ(setting.tips.counts().at("tips: ruled out"), int(!has_first) + int(!has_last)) << part;
    EXPECT_LT(load.now, 0.25);  // fine levels without a load have no factors
  }
}

TEST(Tips, HandOverPathsOfHalfAnEdge) {
  // Edges are 0.25 m long, and an increment is 0.1 m. A path of 0.95 of half an edge is as good as one of a half.
  QuarterPointOptions options = Setting::options();
  options.growth.length = "fixed";
  options.growth.at_most = 1;
  for (const double angle : {0.0, 0.6})
    for (const auto& [length, is_handed_over] : {std::pair(0.94, false), {0.9501, true}, {1.01, true}}) {
      Setting setting(angle, false, options);
      setting.fluid.pressure[0] = setting.fluid.pressure[1] = 5e7;
      setting.grow(length * 0.125 - 0.1, true, true);
      setting.tips.examine({});
      ASSERT_GT(setting.quantity("main_first.K_eq"), 1.1 * toughness);
      EXPECT_EQ(setting.tips.grow({}).extensions.size(), is_handed_over ? 2u : 0u) << length;
    }
}

/// Fluid in what has grown from the last end of the first fracture alone.
class FluidInTheFirst : public Fluid {
 public:
  double fluid_pressure(int fracture, bool at_end) const override { return fracture == 0 && at_end ? 1e8 : 0; }
};

/// Two fractures of length 2 on one line. The last tip of the first one has grown by 0.1 m, and is at this distance (m)
/// from the first tip of the other one, whose toughness is given.
struct TwoFractures {
  TwoFractures(double distance, double angle, double other_toughness)
      : along(std::cos(angle), std::sin(angle)),
        half_gap((distance + grown) / 2),
        mesh(make_mesh()),
        tips({"tips", mesh, fields, 0, {}}, options(other_toughness)) {
    tips.accept_surroundings(fluid);
    Vector rest = Vector::Zero(state_size), path = Vector::Zero(state_size + 2);
    rest[7] = path[7] = 1;
    path.tail<2>() = (grown - half_gap) * along;
    tips.restore(
        {{"tips.left_first", rest}, {"tips.left_last", path}, {"tips.right_first", rest}, {"tips.right_last", rest}});
    tips.examine({});
  }
  Mesh make_mesh() const {
    Geometry geometry;
    geometry.box.low = Point(-half_box, -half_box);
    geometry.box.high = Point(half_box, half_box);
    for (const auto& [name, from, to] :
         {std::tuple("left", -half_gap - 2, -half_gap), std::tuple("right", half_gap, half_gap + 2)}) {
      FractureGeometry fracture;
      fracture.name = name;
      fracture.points = {from * along, to * along};
      geometry.fractures.push_back(fracture);
    }
    MeshOptions options;
    options.size = 8;
    options.fracture_size = 0.25;
    return generate_mesh(geometry, options);
  }
  static QuarterPointOptions options(double other_toughness) {
    QuarterPointOptions options = Setting::options();
    options.toughness =
        Data([=](const Place& place) { return place.fracture == 1 ? other_toughness : toughness; }, false, true);
    options.growth.length = "fixed";
    options.growth.at_most = 1;
    return options;
  }
  double quantity(const std::string& name) const {
    std::vector<Quantity> quantities;
    tips.report(quantities);
    for (const Quantity& quantity : quantities)
      if (quantity.name == "tips." + name) return quantity.value;
    ADD_FAILURE() << "no quantity " << name;
    return 0;
  }

  static constexpr double grown = 0.1;
  Point along;
  double half_gap;
  Mesh mesh;
  FieldStore fields;
  FluidInTheFirst fluid;
  QuarterPoint tips;
};

// The increment of 0.1 m brings the other tip above its toughness. Up to ten increments away it grows at once, beyond
// that in the next step, with the same K.
TEST(Tips, GrowByIncrementsOfOthersAtOnceUpToADistanceOfTen) {
  constexpr double between = 1.1e6;
  for (const double angle : {0.0, 0.6, 0.6 + 1e-9})
    for (const double distance : {0.99, 1.01}) {
      TwoFractures setting(distance, angle, between);
      EXPECT_LT(setting.quantity("right_first.K_eq"), 0.6 * between);
      setting.tips.grow({});
      EXPECT_NEAR(setting.quantity("left_last.length"), 0.2, 1e-12);
      EXPECT_EQ(setting.quantity("right_first.length") > 0, distance < 1) << angle;
      if (distance < 1) continue;
      setting.fluid.state = 2;
      setting.tips.examine({});
      EXPECT_GT(setting.quantity("right_first.K_eq"), 1.5 * between);
      setting.tips.grow({});
      EXPECT_GT(setting.quantity("right_first.length"), 0) << angle;
    }
}

TEST(Tips, AskForEdgesThatGrowAsTheSceneSays) {
  EXPECT_EQ(Setting(0.3).tips.cavity().growth, 0.3);
  QuarterPointOptions options = Setting::options();
  options.cavity_growth = 0.7;
  EXPECT_EQ(Setting(0.3, false, options).tips.cavity().growth, 0.7);
}

/// A pressure that rises as in the step before is settled for growth with the state held, whatever its rate. One that
/// falls back after the step with growth is not.
TEST(Tips, AreUnevenWherePressuresDoNotGoOn) {
  for (const auto& [second, length, uneven] : {std::tuple(0.2e6, 20.0, 0.0), std::tuple(0.1e6, 20.0, 0.1e6),
                                               std::tuple(0.1e6, 10.0, 0.0), std::tuple(-0.1e6, 10.0, 0.1e6)}) {
    Setting setting(0.3);
    const auto examine = [&](double risen, const StepTime& step) {
      setting.fluid.pressure[1] += risen;
      setting.fluid.risen[1] = risen;
      ++setting.fluid.state;
      return setting.tips.examine(step);
    };
    setting.fluid.pressure[1] = 2e6;
    const Growing::Load first = examine(0.1e6, {0, 10, 10});
    EXPECT_NEAR(first.unsettled, 0.1 / 2.1, 1e-12);
    EXPECT_NEAR(first.uneven, 0.1 / 2.1, 1e-12);
    setting.tips.accepted();
    const Growing::Load load = examine(second, {10, length, 10 + length});
    const double size = std::max(2.1e6, 2.1e6 + second);
    EXPECT_NEAR(load.unsettled, std::abs(second) / size, 1e-12);
    EXPECT_NEAR(load.uneven, uneven / size, 1e-12) << second << ", " << length;
  }
}

TEST(Tips, SaveEachValueThatTheyWereRestoredFrom) {
  // Factors, growth, flags (stopped, started, evaluated, extendable, laid), an error, a warm start, a load, a speed, a
  // turning, the start of a segment, both of the step before, the lengths of these two steps, a rate of the pressure
  // and a path of one point.
  constexpr std::array flags = {4, 5, 9, 11, 14};
  for (int set = 0; set < 32; ++set) {
    Vector first(state_size + 2), last(state_size);
    for (int i = 0; i < first.size(); ++i) first[i] = 1.1 + 0.1 * i;
    for (std::size_t k = 0; k < flags.size(); ++k) first[flags[k]] = (set >> k) & 1;
    last = -first.head(state_size);
    for (std::size_t k = 0; k < flags.size(); ++k) last[flags[k]] = 1 - first[flags[k]];
    Setting setting(0.3);
    setting.tips.restore({{"tips.main_first", first}, {"tips.main_last", last}});
    std::map<std::string, Vector> saved;
    setting.tips.save(saved);
    EXPECT_EQ(saved.at("tips.main_first"), first) << set;
    EXPECT_EQ(saved.at("tips.main_last"), last) << set;
  }
}

TEST(Tips, WithAPathOfTheirOwnAreNeverRuledOut) {
  // The jump beside the coarse tip is no measure for the path that has grown from it.
  Setting setting(0.3);
  setting.fluid.jump[0] = setting.fluid.jump[1] = 0;
  setting.fluid.pressure[1] = 3e6;
  setting.grow(0.1, false, true);
  const Growing::Load load = setting.tips.examine({});
  EXPECT_TRUE(std::isnan(setting.quantity("main_first.K_eq")));
  const double a = 1.05;  // of the crack that is longer at one end
  EXPECT_NEAR(setting.quantity("main_last.K_I"), 3e6 * weight(a, a - 0.1, a) / std::sqrt(pi * a), 0.01e6);
  EXPECT_NEAR(load.now * toughness, setting.quantity("main_last.K_eq"), 1);
}

TEST(Tips, ThatTurnBackStopWhereTheyWereAndSaySo) {
  // The path of the fine level turns by 100 degrees: the mesh refuses it when it is long enough to be handed over.
  Setting setting(0.3);
  setting.fluid.jump[0] = 0;
  setting.fluid.pressure[1] = 30e6;
  setting.grow(0.1, false, true);
  Vector values = Vector::Zero(state_size + 2);
  values[7] = 1;
  const double turn = 100 * pi / 180;
  const Point tip = crack_half_length * setting.along;
  values.tail<2>() =
      tip + 0.1 * (std::cos(turn) * setting.along + std::sin(turn) * Point(-setting.along.y(), setting.along.x()));
  setting.tips.restore({{"tips.main_last", values}});
  ASSERT_GT(setting.tips.examine({}).now, 1);
  const Growing::Growth growth = setting.tips.grow({});
  for (const PathExtension& extension : growth.extensions) EXPECT_FALSE(extension.at_end);
  EXPECT_EQ(setting.quantity("main_last.stopped"), 1);
  EXPECT_EQ(setting.quantity("main_first.stopped"), 0);
  EXPECT_NEAR(setting.quantity("main_last.length"), 0.1, 1e-12);
  Notes notes;
  setting.tips.note_step(notes, {});
  const auto is_said = [](const Notes::Note& note) {
    return note.text.find("main_last") != std::string::npos && note.text.find("turns back") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(notes.all().begin(), notes.all().end(), is_said), 1);
  // The next step starts without that path.
  setting.tips.accepted();
  setting.fluid.state = 2;
  setting.tips.examine({});
  EXPECT_TRUE(std::isnan(setting.quantity("main_last.K_I")));
  Notes later;
  setting.tips.note_step(later, {});
  EXPECT_TRUE(later.empty());
}

TEST(Tips, ThatTheOutlineStopsAboveTheirToughnessSaySo) {
  // One increment would do to leave the box.
  QuarterPointOptions options = Setting::options();
  options.growth.increment = 25;
  for (const std::string length : {"fixed", "arrest"}) {
    SCOPED_TRACE(length);
    options.growth.length = length;
    Setting setting(0.3, false, options);
    setting.fluid.jump[0] = 0;
    setting.fluid.pressure[1] = 30e6;
    setting.grow(0.1, false, true);
    ASSERT_GT(setting.tips.examine({}).now, 1);
    setting.tips.grow({});
    EXPECT_EQ(setting.quantity("main_last.stopped"), 1);
    Notes notes;
    setting.tips.note_step(notes, {});
    const auto is_said = [](const Notes::Note& note) {
      return note.text.find("main_last stops at K_eq/K_IC = ") != std::string::npos &&
             note.text.find("no free length") != std::string::npos;
    };
    EXPECT_EQ(std::count_if(notes.all().begin(), notes.all().end(), is_said), 1);
  }
}

TEST(Tips, AreEmptyAgainOnceTheyAreRuledOut) {
  Setting setting(0.3);
  setting.tips.examine({});
  setting.tips.accepted();
  EXPECT_FALSE(std::isnan(setting.quantity("main_last.K_II")));
  setting.fluid.jump[1] = 0;
  setting.fluid.state = 2;
  setting.tips.examine({});
  for (const std::string name : {"K_I", "K_II", "K_eq", "K_error_fine_mesh"}) {
    EXPECT_FALSE(std::isnan(setting.quantity("main_first." + name))) << name;
    EXPECT_TRUE(std::isnan(setting.quantity("main_last." + name))) << name;
  }
  EXPECT_EQ(setting.quantity("main_last.length"), 0);
}

}  // namespace
}  // namespace sprekk::fine_fracture
