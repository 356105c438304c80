// `start: settle` with every list of components that `check` accepts: each is put into the closed form of its
// equilibrium, and a fractured box of two layers with a water table and a geothermal gradient stays there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/config/input_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double year = 31557600, table = -50, border = -400;  // s; m
const std::vector<std::string> names = {"pore", "conduit", "rock", "contact", "heat", "slot"};

using List = std::vector<std::string>;

/// The box, upright, or turned by a right angle to the left: then up is −x, and across is y.
struct Box {
  std::string name, pore, rock, heat, mesh;
  double stress = 0;  ///< bound of the error of settled stresses, of the largest: first order in the cells at walls
  bool turned = false;
  std::string point(double across, double up) const {
    return turned ? fmt::format("[{} m, {} m]", -up, across) : fmt::format("[{} m, {} m]", across, up);
  }
  std::string up() const { return turned ? "(-x)" : "y"; }
  std::string side(const std::string& what) const {
    if (!turned) return what;
    return what == "top" ? "left" : what == "left" ? "bottom" : what == "bottom" ? "right" : "top";
  }
  int axis_up() const { return turned ? 0 : 1; }
};

double pressure_at(double up) { return -1e4 * (up - table); }
double temperature_at(double up) { return up > border ? 283 - 0.03 * up : 283 - 0.03 * border - 0.015 * (up - border); }
double poisson_at(double up) { return up > border ? 0.3 : 0.2; }
double modulus_at(double up) { return up > border ? 10e9 : 40e9; }
double weight_above(double up) { return up > border ? 22000 * up : 22000 * border + 26000 * (up - border); }

constexpr double alpha = 0.8, expansion = 1e-5;

/// The total stress across: nu/(1 − nu) of the effective stress, which counts what pore pressure and heating have
/// added since there was no stress.
double across(double up, double pressure, double heating) {
  const double nu = poisson_at(up), bulk = modulus_at(up) / (3 * (1 - 2 * nu));
  const double pore = alpha * pressure + 3 * bulk * expansion * heating;
  return nu / (1 - nu) * (weight_above(up) + pore) - pore;
}

bool has(const List& list, const std::string& name) { return std::ranges::count(list, name) > 0; }

/// Components that are settled begin with values that are no equilibrium, all others with those of the closed form.
std::string scene(const Box& box, const List& settled, double more = 1) {
  const std::string up = box.up();
  const bool rock = has(settled, "rock");
  const auto layers = [&](const std::string& lower, const std::string& upper) {
    return "{regions: {lower: " + lower + ", default: " + upper + "}}";
  };
  // Expressions of the closed forms.
  const std::string pressure = fmt::format("(-1e4*({}+50)) Pa", up);
  const std::string temperature =
      layers(fmt::format("(283+12-0.015*({}+400)) K", up), fmt::format("(283-0.03*{}) K", up));
  const auto stress = [&](bool upper) {
    const double nu = upper ? 0.3 : 0.2, k0 = nu / (1 - nu);
    const std::string weight = upper ? fmt::format("(22000*{})", up) : fmt::format("(-8.8e6+26000*({}+400))", up);
    const std::string beside = fmt::format("({0:.17g}*{1}-{2:.17g}*(-1e4*({3}+50)))", k0, weight, alpha * (1 - k0), up);
    const std::string xx = box.turned ? weight : beside, yy = box.turned ? beside : weight;
    return std::pair(xx + " Pa", yy + " Pa");
  };
  std::string initial_stress;
  if (!rock)
    initial_stress = "initial_stress: {xx: " + layers(stress(false).first, stress(true).first) +
                     ", yy: " + layers(stress(false).second, stress(true).second) + ", xy: 0 Pa}";
  std::string list;
  for (const std::string& name : settled) list += (list.empty() ? "" : ", ") + name;
  return fmt::format(R"(
geometry:
  box: {{x: {0}, y: {1}}}
  regions: {{lower: {{polygon: [{2}, {3}, {4}, {5}]}}}}
  fractures: {{f: {{points: [{6}, {7}]}}}}
mesh: {{{8}}}
materials: {{gravity: {9}, fluid_density: 1000 kg/m^3}}
components:
  pore:
    type: {10}
    permeability: {11}
    viscosity: 1 mPa*s
    storage: 1e-10 1/Pa
    initial_pressure: {12}
    boundary: {{{13}: {{pressure: {14:.17g} MPa}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 1 mm
    initial_pressure: {15}
  rock:
    type: {16}
    young_modulus: {17}
    poisson_ratio: {18}
    rock_density: {19}
    {20}
    boundary: {{{21}: {{displacement_normal: 0 m}}, {22}: {{displacement_normal: 0 m}}, {23}: {{displacement_normal: 0 m}}}}
  contact: {{type: contact/coulomb, friction: 0.6}}
  heat:
    type: {24}
    conductivity: {25}
    heat_capacity: 2e6 J/(m^3*K)
    initial_temperature: {26}
    boundary: {{{13}: {{temperature: 283 K}}, {23}: {{heat_flux: -0.06 W/m^2}}}}
  slot: {{type: fracture_heat/tpfa, aperture: 1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4.2e6 J/(m^3*K), initial_temperature: {27}}}
couplers:
  - {{type: aperture, between: [contact, conduit]}}
  - {{type: biot, between: [pore, rock], biot_coefficient: 0.8}}
  - {{type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: heat_exchange, between: [heat, slot], conductance: 1e12 W/(m^2*K)}}
  - {{type: heat_advection, between: [pore, conduit, heat, slot], fluid_heat_capacity: 4.2e6 J/(m^3*K)}}
start: {{settle: [{28}]}}
schedule: [{{solve: [pore, conduit, rock, contact]}}, {{solve: [heat, slot]}}]
time: {{end: 10 year, step: 5 year}}
)",
                     box.turned ? "[0 m, 1000 m]" : "[0 m, 100 m]", box.turned ? "[0 m, 100 m]" : "[-1000 m, 0 m]",
                     box.point(0, -1000), box.point(100, -1000), box.point(100, border), box.point(0, border),
                     box.point(25, -600), box.point(75, -600), box.mesh,
                     box.turned ? "[10 m/s^2, 0]" : "[0, -10 m/s^2]", box.pore, layers("1e-17 m^2", "1e-15 m^2"),
                     has(settled, "pore") ? "0 Pa" : pressure, box.side("top"), -0.5 * more,
                     has(settled, "conduit") ? "0 Pa" : pressure, box.rock, layers("40 GPa", "10 GPa"),
                     layers("0.2", "0.3"), layers("2600 kg/m^3", "2200 kg/m^3"), initial_stress, box.side("left"),
                     box.side("right"), box.side("bottom"), box.heat, layers("4 W/(m*K)", "2 W/(m*K)"),
                     has(settled, "heat") ? "300 K" : temperature, has(settled, "slot") ? "300 K" : temperature, list);
}

Vector stress_of(SceneRun& run) {
  for (const OutputField& field : run.model().output())
    if (field.name == "rock.stress") return field.values;
  throw std::logic_error("no stress");
}

struct Errors {
  double pressure = 0, temperature = 0, stress = 0;  ///< of the largest value
  double traction = 0;                               ///< of the contact, of the largest stress
};

Errors errors_of(SceneRun& run, const Box& box, const List& settled) {
  Errors errors;
  const auto larger = [](double& error, double value) { error = std::max(error, std::abs(value)); };
  const int up = box.axis_up();
  const auto height = [&](const Point& x) { return box.turned ? -x[0] : x[1]; };
  const bool has_rock = has(settled, "rock"), has_heat = has(settled, "heat");
  const Vector stress = stress_of(run);
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    const double y = height(run.mesh().cell_center[c]);
    larger(errors.pressure, (run.field("pore.pressure")[c] - pressure_at(y)) / pressure_at(-1000));
    larger(errors.temperature, (run.field("heat.temperature")[c] - temperature_at(y)) / temperature_at(-1000));
    const double heating = has_rock && has_heat ? temperature_at(y) - 300 : 0;
    // Rock that is settled with a pressure that is held has its stress without that pressure.
    const double pressure = has_rock && !has(settled, "pore") ? 0 : pressure_at(y);
    larger(errors.stress, (stress[3 * c + up] - weight_above(y)) / weight_above(-1000));
    larger(errors.stress, (stress[3 * c + 1 - up] - across(y, pressure, heating)) / weight_above(-1000));
    larger(errors.stress, stress[3 * c + 2] / weight_above(-1000));
  }
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const double y = height(run.mesh().fracture_cells[i].center);
    larger(errors.pressure, (run.field("conduit.pressure")[i] - pressure_at(y)) / pressure_at(-1000));
    larger(errors.temperature, (run.field("slot.temperature")[i] - temperature_at(y)) / temperature_at(-1000));
    larger(errors.traction,
           (run.field("contact.traction")[2 * i] - weight_above(y) - pressure_at(y)) / weight_above(-1000));
    larger(errors.traction, run.field("contact.traction")[2 * i + 1] / weight_above(-1000));
  }
  return errors;
}

/// Why `check` refuses the list; empty where it does not.
std::string refusal(const Box& box, const List& list) {
  try {
    SceneRun run = SceneRun::from_text(scene(box, list));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

List list_of(unsigned subset) {
  List list;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (subset & (1u << k)) list.push_back(names[k]);
  return list;
}

const std::string squares = "kind: structured, shape: quadrilaterals, cells: ";
const std::vector<Box> boxes = {
    {"mpfa, mpsa", "matrix_flow/mpfa", "poromechanics/mpsa", "matrix_heat/mpfa", squares + "[4, 10]", 0.06},
    {"tpfa, fem", "matrix_flow/tpfa", "poromechanics/fem", "matrix_heat/tpfa", squares + "[4, 10]", 0.015},
    {"rt0, mpsa", "matrix_flow/rt0", "poromechanics/mpsa", "matrix_heat/mpfa", squares + "[4, 10]", 0.06},
    {"ntpfa, fem", "matrix_flow/ntpfa", "poromechanics/fem", "matrix_heat/mpfa", squares + "[4, 10]", 0.015},
    {"triangles, fem", "matrix_flow/mpfa", "poromechanics/fem", "matrix_heat/mpfa", "size: 60 m", 0.003},
    {"finer", "matrix_flow/mpfa", "poromechanics/mpsa", "matrix_heat/mpfa", squares + "[4, 20]", 0.03},
    {"turned", "matrix_flow/mpfa", "poromechanics/mpsa", "matrix_heat/mpfa", squares + "[10, 4]", 0.06, true}};

/// References: hydrostatic pressure below the water table, conduction through layers, the integral of the weight, and
/// rock that cannot widen. Pressure and temperature are linear within layers, and so exact in each discretization; the
/// displacement by which the rock has settled is quadratic, and MPSA of first order at walls.
void expect_rest(const Box& box, const List& list) {
  std::string text = box.name + ":";
  for (const std::string& name : list) text += " " + name;
  SceneRun run = SceneRun::from_text(scene(box, list));
  const Vector traction = run.field("contact.traction"), stress = stress_of(run);
  const Errors at_start = errors_of(run, box, list);
  double moved = 0;
  run.run_until(10 * year, [&] {
    moved = std::max({moved, run.field("rock.displacement").lpNorm<Eigen::Infinity>(),
                      run.field("contact.jump").lpNorm<Eigen::Infinity>()});
  });
  const Errors later = errors_of(run, box, list);
  std::printf("%-60s p %.1e %.1e T %.1e %.1e stress %.1e %.1e f %.1e %.1e moved %.1e m\n", text.c_str(),
              at_start.pressure, later.pressure, at_start.temperature, later.temperature, at_start.stress, later.stress,
              at_start.traction, later.traction, moved);
  for (const Errors& errors : {at_start, later}) {
    EXPECT_LT(errors.pressure, 1e-11) << text;
    EXPECT_LT(errors.temperature, 1e-11) << text;
    const double bound = has(list, "rock") ? box.stress : 1e-10;
    EXPECT_LT(errors.stress, bound) << text;
    EXPECT_LT(errors.traction, bound) << text;
  }
  const double scale = -weight_above(-1000);
  EXPECT_LT((run.field("contact.traction") - traction).lpNorm<Eigen::Infinity>(), 1e-10 * scale) << text;
  EXPECT_LT((stress_of(run) - stress).lpNorm<Eigen::Infinity>(), 1e-10 * scale) << text;
  EXPECT_LT(moved, 1e-11) << text;  // the weight shortens the box by half a metre
}

TEST(SettledLists, EachListIsAtRestOrRefused) {
  int accepted = 0;
  for (unsigned subset = 1; subset < 1u << names.size(); ++subset) {
    const List list = list_of(subset);
    const std::string why = refusal(boxes[0], list);
    const bool has_sense = has(list, "rock") == has(list, "contact") && has(list, "heat") == has(list, "slot") &&
                           (!has(list, "conduit") || has(list, "pore"));
    EXPECT_EQ(why.empty(), has_sense) << why;
    if (!why.empty()) {
      EXPECT_NE(why.find("without"), std::string::npos) << why;
      continue;
    }
    ++accepted;
    expect_rest(boxes[0], list);
  }
  EXPECT_EQ(accepted, 11);
}

TEST(SettledLists, AllDiscretizationsAgree) {
  for (std::size_t k = 1; k < boxes.size(); ++k)
    for (const List& list : {names, List{"pore", "conduit"}, List{"rock", "contact"}}) {
      // Beside tips in triangles, a stress that is given and varies is in balance up to the error of elements only.
      const bool is_given = !has(list, "rock");
      if (boxes[k].mesh == "size: 60 m" && is_given) continue;
      expect_rest(boxes[k], list);
    }
}

}  // namespace
}  // namespace sprekk::testing
