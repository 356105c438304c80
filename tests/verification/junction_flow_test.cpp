// Flow through places where fractures cross and touch.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/part.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

const std::string cross = "{a: {points: [[-1, 0.2], [1, 0.2]]}, b: {points: [[0.1, -1], [0.1, 1]]}}";

/// So thin that nothing lies in crossings.
const std::string thin = "1e-13 m";

/// Fractures alone in a box of 2 m, in units without any scale.
std::string network(const std::string& fractures, const std::string& conduit,
                    const std::string& mesh = "{size: 0.4, fracture_size: 0.1}", const std::string& width = "1 m") {
  return "{geometry: {box: {x: [-1, 1], y: [-1, 1]}, fractures: " + fractures + "}, mesh: " + mesh +
         ", components: {conduit: {type: fracture_flow/tpfa, viscosity: 1 Pa*s, initial_aperture: " + width +
         ", transmissivity: constant, " + conduit + "}}, schedule: [{solve: conduit}], time: {end: 1 s, step: 1 s}}";
}

/// The same in rock with a mobility of 1.
std::string in_rock(const std::string& fractures, const std::string& conduit, const std::string& pore,
                    const std::string& mesh) {
  return "{geometry: {box: {x: [-1, 1], y: [-1, 1]}, fractures: " + fractures + "}, mesh: " + mesh +
         ", components: {pore: {type: matrix_flow/mpfa, viscosity: 1 Pa*s, permeability: 1 m^2, storage: 0 1/Pa, " +
         pore + "}, conduit: {type: fracture_flow/tpfa, viscosity: 1 Pa*s, initial_aperture: " + thin +
         ", fluid_compressibility: 0 1/Pa, transmissivity: constant, normal_permeability: constant, " + conduit +
         "}}, couplers: [{type: wall_exchange, between: [pore, conduit]}], schedule: [{solve: [pore, conduit]}], time: "
         "{end: 1 s, step: 1 s}}";
}

TEST(Junctions, DivideFlowsLikeAStarOfResistances) {
  // Four arms with other transmissivities and pressures at their ends on the sides.
  SceneRun run = SceneRun::from_text(
      network(cross,
              "fluid_compressibility: 0 1/Pa, transmissivity_value: \"(if(abs(y-0.2) < 1e-9, if(x < "
              "0.1, 1, 2), if(y < 0.2, 3, 5))) m^3\", boundary: {left: {pressure: 4 Pa}, right: "
              "{pressure: 1 Pa}, bottom: {pressure: -2 Pa}, top: {pressure: 0.5 Pa}}",
              "{size: 0.4, fracture_size: 0.1}", thin));
  run.run();
  struct Arm {
    Point direction;
    double length, transmissivity, pressure;
  };
  const std::vector<Arm> arms = {
      {{-1, 0}, 1.1, 1, 4}, {{1, 0}, 0.9, 2, 1}, {{0, -1}, 1.2, 3, -2}, {{0, 1}, 0.8, 5, 0.5}};
  double conductance = 0, weighted = 0;
  for (const Arm& arm : arms) {
    conductance += arm.transmissivity / arm.length;
    weighted += arm.transmissivity / arm.length * arm.pressure;
  }
  const Point middle(0.1, 0.2);
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const Point x = run.mesh().fracture_cells[i].center - middle;
    for (const Arm& arm : arms) {
      if (arm.direction.dot(x) < 1e-9) continue;
      EXPECT_NEAR(run.field("conduit.pressure")[i],
                  weighted / conductance + (arm.pressure - weighted / conductance) * x.norm() / arm.length, 1e-12);
    }
  }
  const Mesh& mesh = run.mesh();
  for (std::size_t k = 0; k < mesh.ridges.size(); ++k) {
    const Ridge& point = mesh.ridges[k];
    if (point.kind != Ridge::Kind::on_boundary) continue;
    for (const Arm& arm : arms) {
      if (arm.direction.dot(point.center - middle) < 1e-9) continue;
      EXPECT_NEAR(run.field("conduit.flux")[k],
                  arm.transmissivity / arm.length * (weighted / conductance - arm.pressure), 1e-12);
    }
  }
}

TEST(Junctions, LetBranchesWithoutAnOutletRest) {
  // From left to right through two junctions; a T, and one with two branches that end in the rock.
  SceneRun run =
      SceneRun::from_text(network("{a: {points: [[-1, 0], [1, 0]]}, t: {points: [[-0.5, 0], [-0.3, 0.6]]}, u: {points: "
                                  "[[0.8, 0.5], [0.4, 0]]}, v: {points: [[0.4, 0], [0.1, -0.7]]}}",
                                  "fluid_compressibility: 0 1/Pa, transmissivity_value: 2 m^3, boundary: {left: "
                                  "{pressure: 3 Pa}, right: {pressure: -1 Pa}}"));
  run.run();
  const Mesh& mesh = run.mesh();
  ASSERT_EQ(mesh.junctions.size(), 2u);
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const std::string& name = mesh.fractures[mesh.fracture_cells[i].fracture].name;
    const double x = name == "a" ? mesh.fracture_cells[i].center.x() : name == "t" ? -0.5 : 0.4;
    EXPECT_NEAR(run.field("conduit.pressure")[i], 1 - 2 * x, 1e-12) << name;
  }
  EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-13);
}

TEST(Junctions, LeaveASealedBranchAlone) {
  SceneRun run = SceneRun::from_text(
      network(cross,
              "initial_pressure: 7 Pa, fluid_compressibility: 1e-3 1/Pa, transmissivity_value: "
              "\"(if(y > 0.2 + 1e-9, 0, 2)) m^3\", boundary: {left: {pressure: 4 Pa}, right: {pressure: "
              "1 Pa}, bottom: {pressure: -2 Pa}, top: {pressure: 100 Pa}}"));
  run.run();
  double leaving = 0;
  for (std::size_t k = 0; k < run.mesh().ridges.size(); ++k)
    if (run.mesh().ridges[k].center.y() > 0.2 + 1e-9) leaving += std::abs(run.field("conduit.flux")[k]);
  EXPECT_EQ(leaving, 0);
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    if (run.mesh().fracture_cells[i].center.y() < 0.2 + 1e-9) continue;
    EXPECT_NEAR(run.field("conduit.pressure")[i], 7, 1e-12);
  }
  EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-12);
}

TEST(Junctions, HoldFluidAtRestUnderGravity) {
  SceneRun run = SceneRun::from_text(
      network("{a: {points: [[-0.5, -0.6], [0.7, 0.5]]}, b: {points: [[-0.4, 0.6], [0.3, -0.8]]}, c: {points: [[0, "
              "0.9], [0.1, -0.05]]}}",
              "fluid_compressibility: 0 1/Pa, transmissivity_value: \"(1 + x*x) m^3\", gravity: [3 m/s^2, -10 m/s^2], "
              "fluid_density: 1000 kg/m^3, prescribed: {one: {at: [-0.5, -0.6], pressure: 5e4 Pa}}"));
  run.run();
  const Mesh& mesh = run.mesh();
  ASSERT_EQ(mesh.junctions.size(), 2u);
  const Point datum(-0.5, -0.6);  // where the pressure is prescribed, at an end
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    EXPECT_NEAR(run.field("conduit.pressure")[i], 5e4 + 1000 * Point(3, -10).dot(mesh.fracture_cells[i].center - datum),
                1e-10 * 5e4);
  }
  EXPECT_LT(run.field("conduit.flux").lpNorm<Eigen::Infinity>(), 1e-10 * 1e4);
}

/// One step of backward Euler from rest on four arms of length 1, one of which is held at a pressure of 1 at its end:
/// p − l^2 p'' = 0, and fluxes add up to zero at the junction.
double error_after_one_step(double size) {
  const double compressibility = 0.5;
  SceneRun run = SceneRun::from_text(network("{a: {points: [[-1, 0], [0.9, 0]]}, b: {points: [[0, -0.9], [0, 0.9]]}}",
                                             "fluid_compressibility: 0.5 1/Pa, transmissivity_value: \"(if(abs(x) < "
                                             "1e-9, 2e-9, 1e-9)) m^3\", boundary: {left: {pressure: 1 Pa}}",
                                             "{size: 0.4, fracture_size: " + fmt::format("{}", size) + "}", "1e-9 m"));
  run.run();
  const auto length = [&](double transmissivity) { return std::sqrt(transmissivity / compressibility); };
  const double l = length(1), m = length(2), arm = 0.9;
  // At the junction P: closed arms take T/l P tanh(arm/l); the held one brings T/l (1/sinh(1/l) − P coth(1/l)).
  const double taken = std::tanh(arm / l) / l + 2 * 2 * std::tanh(arm / m) / m;
  const double middle = 1 / l / std::sinh(1 / l) / (taken + 1 / (l * std::tanh(1 / l)));
  double error = 0;
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const Point& x = run.mesh().fracture_cells[i].center;
    const double s = x.norm();
    double exact = middle * std::cosh((arm - s) / l) / std::cosh(arm / l);
    if (std::abs(x.x()) < 1e-9) exact = middle * std::cosh((arm - s) / m) / std::cosh(arm / m);
    if (x.x() < -1e-9) exact = (middle * std::sinh((1 - s) / l) + std::sinh(s / l)) / std::sinh(1 / l);
    error = std::max(error, std::abs(run.field("conduit.pressure")[i] - exact));
  }
  EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-14);
  return error;
}

TEST(Junctions, AreOfSecondOrderWithStorage) {
  const double coarse = error_after_one_step(0.1), fine = error_after_one_step(0.05);
  EXPECT_LT(fine, 0.1 * 0.05 * 0.05);  // p'' is up to 1/2
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

TEST(Junctions, HaveSymmetricFieldsInASymmetricCross) {
  // Equal arms, squares, and as much injected everywhere: a quarter turn changes nothing.
  SceneRun run = SceneRun::from_text(in_rock(
      "{a: {points: [[-0.5, 0], [0.5, 0]]}, b: {points: [[0, -0.5], [0, 0.5]]}}",
      "transmissivity_value: 10 m^3, normal_permeability_value: 3 m/(Pa*s), injection: {all: {rate: 1 m^2/s}}",
      "boundary: {left: {pressure: 0 Pa}, right: {pressure: 0 Pa}, bottom: {pressure: 0 Pa}, top: {pressure: 0 Pa}}",
      "{kind: structured, shape: quadrilaterals, cells: [16, 16]}"));
  run.run();
  const Mesh& mesh = run.mesh();
  const auto compare = [](const Vector& values, const auto& center, int count) {
    int pairs = 0;
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        const Point turned(-center(i).y(), center(i).x());
        if ((turned - center(j)).norm() > 1e-9) continue;
        EXPECT_NEAR(values[i], values[j], 1e-13 * values.maxCoeff());
        ++pairs;
      }
    EXPECT_EQ(pairs, count);
  };
  compare(
      run.field("pore.pressure"), [&](int i) { return mesh.cell_center[i]; }, mesh.cell_count());
  compare(
      run.field("conduit.pressure"), [&](int i) { return mesh.fracture_cells[i].center; }, mesh.fracture_cell_count());
}

const std::string sharp =
    "{a: {points: [[-1, 0], [1, 0]]}, b: {points: [[-1, -0.35], [1, 0.38]]}, c: {points: [[0, 1], [0, 0]]}}";

TEST(Junctions, PassALinearPressureUnchanged) {
  // Walls without resistance. Along a straight fracture a linear pressure drives a constant flux, so fractures that
  // cross, here at 20 degrees, may have any transmissivity; the one that ends in the junction has none.
  for (const char* shape : {"triangles", "quadrilaterals"}) {
    SceneRun run = SceneRun::from_text(in_rock(
        sharp,
        "transmissivity_value: \"(if(abs(x) < 1e-9, 0, if(abs(y) < 1e-9, 2, 0.5))) m^3\", normal_permeability_value: "
        "1e9 m/(Pa*s), crossings: {open: {permeability: 1e14 m^2}}, boundary: {left: {pressure: \"(2*x - y) Pa\"}, "
        "right: "
        "{pressure: \"(2*x - y) Pa\"}}",
        "boundary: {left: {pressure: \"(2*x - y) Pa\"}, right: {pressure: \"(2*x - y) Pa\"}, bottom: {pressure: \"(2*x "
        "- "
        "y) Pa\"}, top: {pressure: \"(2*x - y) Pa\"}}",
        std::string("{size: 0.2, shape: ") + shape + "}"));
    run.run();
    const Mesh& mesh = run.mesh();
    for (int c = 0; c < mesh.cell_count(); ++c)
      EXPECT_NEAR(run.field("pore.pressure")[c], 2 * mesh.cell_center[c].x() - mesh.cell_center[c].y(), 1e-8) << shape;
    for (int i = 0; i < mesh.fracture_cell_count(); ++i)
      EXPECT_NEAR(run.field("conduit.pressure")[i],
                  2 * mesh.fracture_cells[i].center.x() - mesh.fracture_cells[i].center.y(), 1e-8)
          << shape;
  }
}

TEST(Junctions, OfSealedFracturesPartTheRock) {
  // Each sector has the pressure of its own outer boundary.
  const std::string pressure = "\"(if(y > 0.365*x, if(y < 0, 1, if(x < 0, 2, 3)), if(y < 0, 4, 5))) Pa\"";
  const std::string lines =
      "{a: {points: [[-1, 0], [1, 0]]}, b: {points: [[-1, -0.365], [1, 0.365]]}, c: {points: [[0, 1], [0, 0.2]]}, d: "
      "{points: [[0, 0.2], [0, 0]]}}";
  SceneRun run = SceneRun::from_text(in_rock(
      lines, "transmissivity_value: 0 m^3, normal_permeability_value: 0 m/(Pa*s), prescribed: {all: {pressure: 0 Pa}}",
      "boundary: {left: {pressure: " + pressure + "}, right: {pressure: " + pressure +
          "}, bottom: {pressure: " + pressure + "}, top: {pressure: " + pressure + "}}",
      "{size: 0.1}"));
  run.run();
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    const Point& x = run.mesh().cell_center[c];
    const double side = 0.365 * x.x();
    const double exact = x.y() > side ? (x.y() < 0 ? 1 : x.x() < 0 ? 2 : 3) : x.y() < 0 ? 4 : 5;
    EXPECT_NEAR(run.field("pore.pressure")[c], exact, 1e-11) << x.transpose();
  }
}

TEST(Junctions, ConductAnyAmountBetterThanTheRock) {
  // In the limit the pressure is even in all fractures. What is injected at one end leaves through the sides.
  std::vector<Vector> pressures;
  const std::string lines =
      "{a: {points: [[-0.6, 0], [0.7, 0]]}, b: {points: [[0, -0.5], [0.1, 0.6]]}, c: {points: [[0.4, 0], [0.7, "
      "-0.5]]}}";
  const std::vector<double> transmissivities = {1e6, 1e9, 1e12, 1e15, 1e18, 1e24};
  for (const double transmissivity : transmissivities) {
    SceneRun run = SceneRun::from_text(in_rock(
        lines,
        fmt::format("transmissivity_value: {} m^3, normal_permeability_value: 1e3 m/(Pa*s), injection: {{one: {{at: "
                    "[-0.6, 0], rate: 1 m^2/s}}}}",
                    transmissivity),
        "boundary: {left: {pressure: 0 Pa}, right: {pressure: 0 Pa}, bottom: {pressure: 0 Pa}, top: {pressure: 0 Pa}}",
        "{size: 0.2, fracture_size: 0.1}"));
    run.run();
    EXPECT_LE(run.iterations(), 2) << transmissivity;
    EXPECT_NEAR(run.quantity("fluid_outflow"), 1, 1e-11) << transmissivity;
    EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-11) << transmissivity;
    const Vector& pressure = run.field("conduit.pressure");
    EXPECT_LE(pressure.maxCoeff() - pressure.minCoeff(), 2 / transmissivity + 1e-12) << transmissivity;
    pressures.push_back(run.field("pore.pressure"));
    // What a cell of the fracture loses to the rock, it gets through its points.
    const Mesh& mesh = run.mesh();
    Vector rest = Vector::Zero(mesh.fracture_cell_count());
    for (std::size_t k = 0; k < mesh.ridges.size(); ++k) {
      const auto& cells = mesh.ridges[k].cells;
      if (cells.size() < 2) continue;
      rest[cells[0]] += run.field("conduit.flux")[k];
      rest[cells[1]] -= run.field("conduit.flux")[k];
    }
    for (int i = 0; i < mesh.fracture_cell_count(); ++i)
      for (const int wall : {2 * i, 2 * i + 1})
        rest[i] += mesh.fracture_cells[i].measure * run.field("pore.wall_flux")[wall];
    EXPECT_NEAR(rest.maxCoeff(), 1, 1e-11) << transmissivity;
    EXPECT_NEAR(rest.cwiseAbs().sum(), 1, 1e-11) << transmissivity;
  }
  for (std::size_t k = 0; k + 1 < pressures.size(); ++k)
    EXPECT_LE((pressures[k] - pressures.back()).lpNorm<Eigen::Infinity>(), 1 / transmissivities[k] + 1e-12);
}

/// All rows of a component with the cubic law by all its fields, against central differences.
void expect_derivatives(const std::string& width, const std::string& more) {
  SceneRun run = SceneRun::from_text(
      "{geometry: {box: {x: [-1, 1], y: [-1, 1]}, fractures: {a: {points: [[-1, 0], [0.7, 0]]}, b: {points: [[0, "
      "-0.5], [0.1, 0.6]]}, c: {points: [[0.4, 0], [0.7, -0.5]]}}}, mesh: {size: 0.5, fracture_size: 0.3}, components: "
      "{conduit: {type: fracture_flow/tpfa, viscosity: 1 Pa*s, fluid_compressibility: 0.1 1/Pa, initial_aperture: " +
      width + ", gravity: [0 m/s^2, -1 m/s^2], fluid_density: 2 kg/m^3, boundary: {left: {pressure: 1 Pa}}" + more +
      "}}, schedule: [{solve: conduit}], time: {end: 1 s, step: 1 s}}");
  run.run();
  FieldStore& fields = run.model().fields();
  const std::vector<const Field*> unknowns = {&fields.at("conduit.pressure"), &fields.at("conduit.flux"),
                                              &fields.at("conduit.aperture")};
  unsigned state = 1;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) / 4294967296.0; };
  for (const char* name : {"conduit.pressure", "conduit.flux", "conduit.aperture"}) {
    Field& field = fields.at(name);
    Vector values = field.now();
    for (double& value : values) value = 0.5 + random();
    field.set(values);
  }
  const StepTime step{0, 1, 1};
  const auto assemble = [&](Assembly& assembly) {
    for (const Part* part : run.model().parts()) part->assemble(assembly, step);
  };
  Assembly assembly(unknowns, Assembly::Request::residual_and_derivatives);
  assemble(assembly);
  std::vector<std::vector<Eigen::MatrixXd>> analytic(3), differences(3);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      analytic[row].emplace_back(Eigen::MatrixXd::Zero(unknowns[row]->size(), unknowns[column]->size()));
  differences = analytic;
  for (const Assembly::Block& block : assembly.blocks()) {
    Eigen::MatrixXd entries = block.factor * Eigen::MatrixXd(*block.matrix);
    if (block.weights) entries = block.weights->asDiagonal() * entries;
    analytic[block.row][block.column] += entries;
  }
  constexpr double h = 1e-5;
  for (int column = 0; column < 3; ++column) {
    Field& field = fields.at(unknowns[column]->name());
    const Vector values = field.now();
    for (int i = 0; i < field.size(); ++i) {
      std::vector<Vector> residuals[2];
      for (const int sign : {0, 1}) {
        Vector moved = values;
        moved[i] += sign ? h : -h;
        field.set(moved);
        Assembly there(unknowns, Assembly::Request::residual);
        assemble(there);
        for (int row = 0; row < 2; ++row) residuals[sign].push_back(there.residual(row));
      }
      for (int row = 0; row < 2; ++row)
        differences[row][column].col(i) = (residuals[1][row] - residuals[0][row]) / (2 * h);
    }
    field.set(values);
  }
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const double largest = analytic[row][column].lpNorm<Eigen::Infinity>();
      EXPECT_LE((analytic[row][column] - differences[row][column]).lpNorm<Eigen::Infinity>(), 1e-8 * largest)
          << row << " by " << column;
      EXPECT_GT(largest, 1e-2);
    }
}

TEST(Junctions, HaveTheDerivativesOfTheirEquations) {
  expect_derivatives("1 m", "");
  expect_derivatives("0.1 m", ", crossings: {plug: {permeability: 0.02 m^2}}");
}

/// Root mean square of the errors of mean pressures of squares, over the difference of the pressures there are.
double network_error(bool is_blocking, const std::string& mesh_text) {
  const auto reference =
      read_numbers(std::string(SPREKK_SOURCE_DIR) + "/tests/verification/references/regular_network.csv");
  const int squares = static_cast<int>(std::lround(std::sqrt(reference.size())));
  std::vector<Override> overrides = {{"mesh", mesh_text}};
  if (is_blocking) {
    overrides.push_back({"components.conduit.transmissivity_value", "1e-8 m^3"});
    overrides.push_back({"components.conduit.normal_permeability_value", "2 m/(Pa*s)"});
  }
  SceneRun run("verification/regular_network.yaml", overrides);
  run.run();
  EXPECT_EQ(run.mesh().junctions.size(), 9u);
  const Mesh& mesh = run.mesh();
  Vector mean = Vector::Zero(reference.size()), area = mean;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Point place = squares * mesh.cell_center[c];
    const int square = static_cast<int>(place.y()) * squares + static_cast<int>(place.x());
    mean[square] += mesh.cell_measure[c] * run.field("pore.pressure")[c];
    area[square] += mesh.cell_measure[c];
  }
  double sum = 0, least = 1, most = 1;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double wanted = reference[i][is_blocking ? 3 : 2];
    sum += std::pow(mean[i] / area[i] - wanted, 2);
    least = std::min(least, wanted);
    most = std::max(most, wanted);
  }
  return std::sqrt(sum / reference.size()) / (most - least);
}

TEST(RegularNetwork, HasThePressuresOfAnEquidimensionalSolution) {
  for (const bool is_blocking : {false, true})
    for (const std::string shape : {"quadrilaterals", "triangles"}) {
      const auto error = [&](int cells) {
        return network_error(is_blocking,
                             fmt::format("{{kind: structured, shape: {0}, cells: [{1}, {1}]}}", shape, cells));
      };
      // Fractures without thickness: right to about their aperture, 1e-4.
      const double coarse = error(24), fine = error(48);
      EXPECT_LT(coarse, 1e-3) << shape;
      EXPECT_LT(error(96), 1e-4) << shape;
      EXPECT_GT(std::log2(coarse / fine), 1.5) << shape << ": " << coarse << " " << fine;
    }
}

}  // namespace
}  // namespace sprekk::testing
