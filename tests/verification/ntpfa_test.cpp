// matrix_flow/ntpfa in scenes: orders, bounds where MPFA leaves them, closed forms through the couplers, twins.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "tests/verification/mandel_solution.hpp"
#include "tests/verification/mesh_file.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using std::numbers::pi;
const Override ntpfa = {"components.pore.type", "matrix_flow/ntpfa"};

Vector areas(const Mesh& mesh) { return Eigen::Map<const Vector>(mesh.cell_measure.data(), mesh.cell_count()); }

const Vector& fluxes_of(SceneRun& run) {
  for (Part* part : run.model().parts())
    if (const auto* flow = dynamic_cast<const matrix_flow::MatrixFlow*>(part)) return flow->face_fluxes();
  throw std::logic_error("no flow in the matrix");
}

/// A permeability of 1 along `degrees`, and of `ratio` across.
struct Rock {
  double ratio, degrees;
  Tensor tensor() const {
    const double angle = degrees * pi / 180;
    const Point along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    return along * along.transpose() + ratio * across * across.transpose();
  }
};

/// Relative, of the pressures at the centres of cells, and of the fluxes through faces per length (L2 over the cells).
struct Errors {
  double pressure, flux;
};

/// Steady flow with the pressure 1 + sin(pi x) sin(pi y), with the source that it needs.
Errors manufactured_errors(const Rock& rock, const std::string& mesh_text) {
  const Tensor k = rock.tensor();
  const std::string exact = "(1 + sin(pi*x)*sin(pi*y)) Pa";
  SceneRun run = SceneRun::from_text(fmt::format(
      R"(
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}
mesh: {0}
components:
  pore:
    type: matrix_flow/ntpfa
    permeability: {{along: 1 m^2, across: {1} m^2, angle: {2} deg}}
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    source: (pi^2*({3:.16g}*sin(pi*x)*sin(pi*y) - {4:.16g}*cos(pi*x)*cos(pi*y))) 1/s
    boundary: {{left: {{pressure: {5}}}, right: {{pressure: {5}}}, bottom: {{pressure: {5}}}, top: {{pressure: {5}}}}}
schedule: [{{solve: pore}}]
time: {{end: 1 s, step: 1 s}}
)",
      mesh_text, rock.ratio, rock.degrees, k.trace(), 2 * k(0, 1), exact));
  run.run();
  const Mesh& mesh = run.mesh();
  Vector pressure(mesh.cell_count()), flux(mesh.face_count()), weights = Vector::Zero(mesh.face_count());
  for (int c = 0; c < mesh.cell_count(); ++c)
    pressure[c] = 1 + std::sin(pi * mesh.cell_center[c][0]) * std::sin(pi * mesh.cell_center[c][1]);
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Point& x = mesh.face_center[f];
    const Point gradient =
        pi * Point(std::cos(pi * x[0]) * std::sin(pi * x[1]), std::sin(pi * x[0]) * std::cos(pi * x[1]));
    flux[f] = -mesh.face_normal[f].dot(k * gradient);
    for (const int cell : mesh.face_cells[f])
      if (cell != none) weights[f] += mesh.cell_measure[cell];
  }
  const Vector lengths = Eigen::Map<const Vector>(mesh.face_measure.data(), mesh.face_count());
  return {relative_error(areas(mesh), run.field("pore.pressure"), pressure),
          relative_error(weights, fluxes_of(run).cwiseQuotient(lengths), flux)};
}

/// From one mesh to that of a quarter of the size, for each of the two halvings.
void expect_orders(const Rock& rock, double order, const std::string& coarse_mesh, const std::string& fine_mesh) {
  const Errors coarse = manufactured_errors(rock, coarse_mesh), fine = manufactured_errors(rock, fine_mesh);
  const double of_pressure = std::log2(coarse.pressure / fine.pressure) / 2,
               of_flux = std::log2(coarse.flux / fine.flux) / 2;
  ::testing::Test::RecordProperty(
      fmt::format("orders_{}_{}_{}", rock.ratio, rock.degrees, fine_mesh),
      fmt::format("p {:.3g} ({:.2f}), flux {:.3g} ({:.2f})", fine.pressure, of_pressure, fine.flux, of_flux));
  EXPECT_GT(of_pressure, order) << coarse.pressure << " " << fine.pressure;
  EXPECT_GT(of_flux, 0.9) << coarse.flux << " " << fine.flux;
  EXPECT_LT(fine.pressure, 7e-4);
}

/// At 1000:1, the strips where limited fluxes change their sign are not yet narrow against the cells, and random meshes
/// scatter, as with the linear mean of both sides.
TEST(Ntpfa, PressureIsOfSecondOrderAndFluxOfFirst) {
  for (const Rock& rock : {Rock{1, 0}, Rock{0.1, 30}, Rock{1e-3, 30}, Rock{1e-3, 67.5}}) {
    const bool is_strong = rock.ratio < 0.01;
    expect_orders(rock, is_strong ? 1.8 : 1.9, "{size: 0.05 m}", "{size: 0.0125 m}");
    expect_orders(rock, is_strong ? 1.8 : 1.9, "{kind: structured, cells: [20, 20]}",
                  "{kind: structured, cells: [80, 80]}");
    expect_orders(rock, is_strong ? 1.8 : 1.9, "{kind: structured, shape: quadrilaterals, cells: [20, 20]}",
                  "{kind: structured, shape: quadrilaterals, cells: [80, 80]}");
    expect_orders(rock, is_strong ? 1.45 : 1.85, "{size: 0.05 m, shape: quadrilaterals}",
                  "{size: 0.0125 m, shape: quadrilaterals}");
  }
}

/// The unit square without the square from 4/9 to 5/9: cells of 1/27 m, squares or halves of them.
RawMesh square_with_a_hole(bool triangles) {
  constexpr int n = 27, low = 12, high = 15;
  RawMesh raw;
  raw.region_names = {"rock"};
  raw.side_names = {"outside", "hole"};
  std::vector<int> numbers((n + 1) * (n + 1), none);
  const auto node = [&](int i, int j) {
    int& number = numbers[i + (n + 1) * j];
    if (number == none) {
      number = static_cast<int>(raw.nodes.size());
      raw.nodes.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n);
    }
    return number;
  };
  const auto is_hole = [](int i, int j) { return i >= low && i < high && j >= low && j < high; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (is_hole(i, j)) continue;
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (!triangles)
        raw.cells.push_back({a, b, c, d});
      else if ((i + j) % 2 == 0)
        raw.cells.insert(raw.cells.end(), {Ring(a, b, c), Ring(a, c, d)});
      else
        raw.cells.insert(raw.cells.end(), {Ring(a, b, d), Ring(b, c, d)});
    }
  raw.regions.assign(raw.cells.size(), 0);
  for (const auto& [first, end, side] : {std::array{0, n, 0}, std::array{low, high, 1}})
    for (int k = first; k < end; ++k) {
      raw.boundary_faces.push_back({{node(k, first), node(k + 1, first)}, side});
      raw.boundary_faces.push_back({{node(k, end), node(k + 1, end)}, side});
      raw.boundary_faces.push_back({{node(first, k), node(first, k + 1)}, side});
      raw.boundary_faces.push_back({{node(end, k), node(end, k + 1)}, side});
    }
  return raw;
}

/// The lowest and the highest pressure between a square hole at 2 Pa and the sides at 0 Pa, in rock of 1000:1 at 30
/// degrees (Lipnikov, Shashkov, Svyatskiy and Vassilevski, J. Comput. Phys. 227 (2007) 492, section 5). The solution
/// lies between the two; so it does after every step that begins there.
std::pair<double, double> bounds_around_a_hole(const std::string& flow, bool triangles, double storage) {
  const std::string file = write_msh(square_with_a_hole(triangles), turned_by(0), Point(0, 0),
                                     fmt::format("hole_{}_{}_{}", flow, triangles, storage));
  SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{file: {1}}}
components:
  pore:
    type: matrix_flow/{0}
    permeability: {{along: 1000 m^2, across: 1 m^2, angle: 30 deg}}
    viscosity: 1 Pa*s
    storage: {2} 1/Pa
    boundary: {{outside: {{pressure: 0 Pa}}, hole: {{pressure: 2 Pa}}}}
schedule: [{{solve: pore}}]
newton: {{at_most: 100}}
time: {{end: 1 s, step: 1 s}}
)",
                                                 flow, file, storage));
  run.run();
  const Vector& p = run.field("pore.pressure");
  return {p.minCoeff(), p.maxCoeff()};
}

TEST(Ntpfa, KeepsBoundsAroundAHoleWhereMpfaDoesNot) {
  for (const bool triangles : {true, false})
    for (const double storage : {0.0, 1e4}) {
      const auto [low, high] = bounds_around_a_hole("ntpfa", triangles, storage);
      EXPECT_GE(low, -1e-12) << triangles << storage;
      EXPECT_LE(high, 2 + 1e-12) << triangles << storage;
      const auto [mpfa_low, mpfa_high] = bounds_around_a_hole("mpfa", triangles, storage);
      RecordProperty(fmt::format("bounds_{}_{}", triangles, storage),
                     fmt::format("{:.3g} {:.3g}, mpfa {:.3g} {:.3g}", low, high, mpfa_low, mpfa_high));
      EXPECT_LT(mpfa_low, -1e-3) << triangles << storage;
    }
}

/// A closed box whose left half is at 1 Pa: pressures stay between those at the start, and nothing is lost.
TEST(Ntpfa, KeepsBoundsInAClosedBox) {
  for (const char* mesh : {"{size: 0.08 m}", "{size: 0.08 m, shape: quadrilaterals}"})
    for (const double step : {1e-6, 1e-3, 2e-2}) {
      SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}
mesh: {0}
components:
  pore:
    type: matrix_flow/ntpfa
    permeability: {{along: 1 m^2, across: 1e-3 m^2, angle: 67.5 deg}}
    viscosity: 1 Pa*s
    storage: 1 1/Pa
    initial_pressure: (if(x < 0.5, 1, 0)) Pa
schedule: [{{solve: pore}}]
newton: {{at_most: 100}}
time: {{end: {2} s, step: {1} s}}
)",
                                                     mesh, step, 4 * step));
      const double amount = areas(run.mesh()).dot(run.field("pore.pressure"));
      run.run_until(4 * step, [&] {
        EXPECT_GE(run.field("pore.pressure").minCoeff(), -1e-12) << mesh << step;
        EXPECT_LE(run.field("pore.pressure").maxCoeff(), 1 + 1e-12) << mesh << step;
      });
      EXPECT_NEAR(areas(run.mesh()).dot(run.field("pore.pressure")), amount, 1e-12) << mesh << step;
    }
}

/// The same box in steps far beyond the diffusion time, after which all one-sided fluxes are nearly zero and each face
/// is at a kink of the limited one: no step is shortened.
TEST(Ntpfa, ComesToRestInLongSteps) {
  for (const char* mesh : {"{size: 0.08 m}", "{size: 0.08 m, shape: quadrilaterals}"})
    for (const char* angle : {"67.5", "22.5", "-67.5"})
      for (const double along : {1.0, 1 + 1e-9}) {
        SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}
mesh: {0}
components:
  pore:
    type: matrix_flow/ntpfa
    permeability: {{along: {2:.17g} m^2, across: 1e-2 m^2, angle: {1} deg}}
    viscosity: 1 Pa*s
    storage: 1 1/Pa
    initial_pressure: (if(x < 0.5, 1, 0)) Pa
schedule: [{{solve: pore}}]
time: {{end: 400 s, step: 100 s}}
)",
                                                       mesh, angle, along));
        const double mean = areas(run.mesh()).dot(run.field("pore.pressure"));
        run.run();
        EXPECT_EQ(run.steps(), 4) << mesh << angle;
        // No mode falls slower than with the least permeability along a side, and half of 1 Pa is the first deviation.
        const Vector deviation = run.field("pore.pressure").array() - mean;
        EXPECT_LT(std::sqrt(areas(run.mesh()).dot(deviation.cwiseAbs2())), 0.5 * std::pow(1 + pi * pi, -4))
            << mesh << angle;
      }
}

double terzaghi_error(int cells) {
  SceneRun run("verification/terzaghi.yaml",
               {{"mesh.cells", "[" + std::to_string(cells / 10) + ", " + std::to_string(cells) + "]"}, ntpfa});
  run.run();
  Vector exact(run.mesh().cell_count());
  for (int c = 0; c < exact.size(); ++c) {
    double sum = 0;
    for (int k = 0; k < 2000; ++k) {
      const double n = (k + 0.5) * pi;
      sum += 2 / n * std::sin(n * run.mesh().cell_center[c][1]) * std::pow(1 + 0.01 * n * n, -run.steps());
    }
    exact[c] = sum;
  }
  return relative_error(areas(run.mesh()), run.field("pore.pressure"), exact);
}

TEST(Ntpfa, TerzaghiIsOfSecondOrder) {
  const double coarse = terzaghi_error(20), fine = terzaghi_error(40);
  EXPECT_LT(fine, 1.5e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

double mandel_error(const std::string& mesh, const std::vector<Override>& more, double imbalance = 1e-12) {
  std::vector<Override> settings = {{"mesh", mesh}, ntpfa};
  settings.insert(settings.end(), more.begin(), more.end());
  SceneRun run("verification/mandel.yaml", settings);
  run.run();
  EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, imbalance * run.quantity("fluid_outflow"));
  const Mandel exact;
  Vector p(run.mesh().cell_count());
  for (int c = 0; c < p.size(); ++c) p[c] = exact.pressure(run.mesh().cell_center[c][0], run.time(), run.steps());
  return relative_error(areas(run.mesh()), run.field("pore.pressure"), p);
}

TEST(Ntpfa, MandelIsOfSecondOrderAtOnceAndInTurn) {
  const double coarse = mandel_error("{size: 0.1 m}", {}), fine = mandel_error("{size: 0.05 m}", {});
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
  const double in_turn = mandel_error("{size: 0.05 m}",
                                      {{"schedule",
                                        "[{iterate: {fallback: none, until: {at_most: 60}, steps: [{solve: pore, "
                                        "stabilize: fixed_stress}, {solve: rock}]}}]"}},
                                      1e-5);
  EXPECT_NEAR(in_turn, fine, 1e-5);
}

}  // namespace
}  // namespace sprekk::testing
