// What does it cost to be general? Scenes, built and stepped by the framework, against programs of a page that are
// written for one problem each, with the same kernels: discretization, divergence, linear solver. Prints JSON;
// tools/benchmark/skip.py makes a table of it.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/command_line/keep_memory.hpp"
#include "framework/config/node.hpp"
#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/scene/model.hpp"
#include "tests/framework/assembly/small_mesh.hpp"

namespace {

using namespace sprekk;

// The unit square: pressures 1 and 0 on the left and right; rollers on the left and bottom, 1 Pa on the top. Shear
// modulus and Lame's lambda 1, mobility 1, storage 1.
constexpr double dt = 0.01;

/// Of the processor: others may use the machine too.
double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

int side_of(const Mesh& mesh, int face, const char* name) {
  return mesh.face_side[face] != none && mesh.side_names[mesh.face_side[face]] == name;
}

struct Flow {
  SparseMatrix outflow;  ///< of pressures
  Vector constant;       ///< outflow that the sides prescribe

  explicit Flow(const Mesh& mesh) {
    using matrix_flow::FlowCondition;
    std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
    Vector values = Vector::Zero(mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
      if (mesh.face_cells[f][1] != none) continue;
      const bool left = side_of(mesh, f, "left"), right = side_of(mesh, f, "right");
      conditions[f] = left || right ? FlowCondition::pressure : FlowCondition::flux;
      values[f] = left ? 1 : 0;
    }
    const std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
    const matrix_flow::FluxOperators operators = matrix_flow::discretize_mpfa(mesh, mobility, conditions);
    outflow = cell_sums(mesh, operators.flux_cell, 1, 0);
    constant = cell_sums(mesh, Vector(operators.flux_boundary * values), 1);
  }
};

struct Mechanics {
  SparseMatrix force, force_of_stress, volume, volume_of_stress;
  Vector force_constant, volume_constant;

  explicit Mechanics(const Mesh& mesh) {
    using poromechanics::MechanicalCondition;
    std::vector<poromechanics::FaceConditions> conditions(mesh.face_count());
    Vector values = Vector::Zero(2 * mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
      if (mesh.face_cells[f][1] != none) continue;
      conditions[f] = {MechanicalCondition::traction, MechanicalCondition::traction};
      if (side_of(mesh, f, "left")) conditions[f][0] = MechanicalCondition::displacement;
      if (side_of(mesh, f, "bottom")) conditions[f][1] = MechanicalCondition::displacement;
      if (side_of(mesh, f, "top")) values[2 * f + 1] = -mesh.face_measure[f];
    }
    const std::vector<poromechanics::Stiffness> stiffness(mesh.cell_count(), poromechanics::isotropic_stiffness(1, 1));
    poromechanics::StressOperators operators = poromechanics::discretize_mpsa(mesh, stiffness, conditions);
    force = cell_sums(mesh, operators.force_displacement, 2, 0);
    force_of_stress = cell_sums(mesh, operators.force_stress, 2, 0);
    force_constant = cell_sums(mesh, Vector(operators.force_boundary * values), 2);
    volume_constant = operators.volume_boundary * values;
    volume = std::move(operators.volume_displacement);
    volume_of_stress = std::move(operators.volume_stress);
  }
};

/// A system of one or two blocks, factorized.
class Solver {
 public:
  Solver(const SparseMatrix& matrix, std::vector<UnknownBlock> blocks) : solver_(make_linear_solver({})) {
    LinearSystem system;
    for (int i = 0; i < matrix.rows(); ++i) system.rows.push_back(i);
    system.local = matrix;
    system.blocks = std::move(blocks);
    if (!solver_->factor(system).solved) throw std::runtime_error("the minimal program's matrix is singular");
  }
  Vector solve(const Vector& right) {
    Vector x;
    if (!solver_->solve(right, x).solved) throw std::runtime_error("the minimal program's solve failed");
    return x;
  }

 private:
  std::unique_ptr<LinearSolver> solver_;
};

UnknownBlock block(const char* name, int first, int cells, int components) {
  UnknownBlock block;
  block.name = name;
  block.first = first;
  block.entities = cells;
  block.components = components;
  block.kind = components == 2 ? BlockKind::bulk_elastic : BlockKind::bulk_elliptic;
  return block;
}

SparseMatrix with_diagonal(const SparseMatrix& matrix, const Vector& diagonal, double factor) {
  SparseMatrix sum(matrix.rows(), matrix.cols());
  std::vector<Triplet> entries;
  for (int i = 0; i < diagonal.size(); ++i) entries.emplace_back(i, i, diagonal[i]);
  sum.setFromTriplets(entries.begin(), entries.end());
  return SparseMatrix(sum + factor * matrix);
}

Vector areas(const Mesh& mesh) { return Eigen::Map<const Vector>(mesh.cell_measure.data(), mesh.cell_count()); }

Vector minimal_flow(const Mesh& mesh, int steps) {
  const Flow flow(mesh);
  const Vector storage = areas(mesh);
  Solver solver(with_diagonal(flow.outflow, storage, dt), {block("p", 0, mesh.cell_count(), 1)});
  Vector p = Vector::Zero(mesh.cell_count());
  for (int step = 0; step < steps; ++step) p = solver.solve(storage.cwiseProduct(p) - dt * flow.constant);
  return p;
}

Vector minimal_mechanics(const Mesh& mesh) {
  const Mechanics mechanics(mesh);
  Solver solver(mechanics.force, {block("u", 0, mesh.cell_count(), 2)});
  return solver.solve(-mechanics.force_constant);
}

/// The pressure after so many steps; without `flow`, of sealed rock.
Vector minimal_biot(const Mesh& mesh, int steps, bool with_flow) {
  constexpr double alpha = 0.5;
  const int cells = mesh.cell_count();
  const Mechanics mechanics(mesh);
  const Vector storage = areas(mesh);
  SparseMatrix outflow(cells, cells);
  Vector outflow_constant = Vector::Zero(cells);
  if (with_flow) {
    Flow flow(mesh);
    outflow = std::move(flow.outflow);
    outflow_constant = std::move(flow.constant);
  }
  std::vector<Triplet> entries;
  const auto place = [&](const SparseMatrix& matrix, int row, int column, double factor) {
    for (int i = 0; i < matrix.outerSize(); ++i)
      for (SparseMatrix::InnerIterator it(matrix, i); it; ++it)
        entries.emplace_back(row + static_cast<int>(it.row()), column + static_cast<int>(it.col()),
                             factor * it.value());
  };
  place(with_diagonal(outflow, storage, dt), 0, 0, 1);
  place(mechanics.volume_of_stress, 0, 0, alpha * alpha);
  place(mechanics.volume, 0, cells, alpha);
  place(mechanics.force_of_stress, cells, 0, -alpha);
  place(mechanics.force, cells, cells, -1);
  SparseMatrix matrix(3 * cells, 3 * cells);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Solver solver(matrix, {block("p", 0, cells, 1), block("u", cells, cells, 2)});
  Vector p = Vector::Zero(cells), counted = Vector::Zero(cells), right(3 * cells);
  right.tail(2 * cells) = mechanics.force_constant;
  for (int step = 0; step < steps; ++step) {
    right.head(cells) = storage.cwiseProduct(p) - dt * outflow_constant - alpha * (mechanics.volume_constant - counted);
    const Vector x = solver.solve(right);
    p = x.head(cells);
    counted =
        mechanics.volume * x.tail(2 * cells) + alpha * (mechanics.volume_of_stress * p) + mechanics.volume_constant;
  }
  return p;
}

const std::string pore =
    "pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, boundary: {left: "
    "{pressure: 1 Pa}, "
    "right: {pressure: 0 Pa}}}";
const std::string rock =
    "rock: {type: poromechanics/mpsa, young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {left: {displacement_x: 0 "
    "m}, "
    "bottom: {displacement_y: 0 m}, top: {normal_stress: -1 Pa}}}";

Vector framework(const Mesh& mesh, const std::string& scene, int steps, const std::string& result) {
  const std::string text = fmt::format(
      "{{geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}, mesh: {{size: 1 m}}, time: {{end: 1 s, "
      "step: {} s}}, {}}}",
      dt, scene);
  Model model(read_scene(parse_yaml(text, "minimal"), "."), mesh);
  for (int step = 0; step < steps; ++step) {
    const StepStatus status = model.attempt({step * dt, dt, (step + 1) * dt});
    if (!status.converged) throw std::runtime_error(status.reason);
    model.accept();
  }
  return model.fields().at(result).now();
}

struct Pair {
  std::string name;
  std::function<Vector()> general, minimal;
};

/// Measures both in turn, under the same load of the machine; prints the difference of their answers.
void compare(const Pair& pair, int repeats, bool last) {
  std::vector<double> ratios, general, minimal;
  double difference = 0;
  for (int i = 0; i <= repeats; ++i) {
    Vector x, y;
    const double one = seconds([&] { x = pair.general(); }), other = seconds([&] { y = pair.minimal(); });
    difference = (x - y).lpNorm<Eigen::Infinity>() / y.lpNorm<Eigen::Infinity>();
    if (i == 0) continue;  // libraries start up
    general.push_back(one);
    minimal.push_back(other);
    ratios.push_back(one / other);
  }
  const auto median = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
  std::printf(
      "{\"name\": \"%s\", \"general\": %.4g, \"minimal\": %.4g, \"ratio\": %.4g, \"lowest\": %.4g, \"highest\": %.4g, "
      "\"difference\": %.2g}%s\n",
      pair.name.c_str(), median(general), median(minimal), median(ratios), *low, *high, difference, last ? "" : ",");
  std::fflush(stdout);
}

}  // namespace

/// bench_minimal [SIZE [REPEATS [NAME [general|minimal]]]]: of triangles (m), and of measurements; of pairs, those
/// whose names begin so. With the last argument, one half of them runs and nothing is measured: for a profiler.
int main(int count, char** arguments) {
  keep_memory();  // as sprekk does; for both halves
  const double size = count > 1 ? std::atof(arguments[1]) : 0.015;
  const int repeats = count > 2 ? std::atoi(arguments[2]) : 7;
  const Mesh mesh = test::small_mesh(size);
  const auto scene = [](const std::string& components, const std::string& rest) {
    return "components: {" + components + "}, " + rest;
  };
  const std::string flow = scene(pore, "schedule: [{solve: pore}]");
  const std::string mechanics = scene(rock, "schedule: [{solve: rock}]");
  const auto biot = [&](const std::string& alpha) {
    return "couplers: [{type: biot, between: [pore, rock], biot_coefficient: " + alpha +
           "}], schedule: [{solve: [pore, rock]}]";
  };
  std::string sealed = pore;
  sealed.replace(sealed.find("1 m^2"), 5, "0 m^2");
  std::vector<Pair> pairs = {
      {"flow, 20 steps", [&] { return framework(mesh, flow, 20, "pore.pressure"); },
       [&] { return minimal_flow(mesh, 20); }},
      {"mechanics, 1 step", [&] { return framework(mesh, mechanics, 1, "rock.displacement"); },
       [&] { return minimal_mechanics(mesh); }},
      {"Biot, 20 steps", [&] { return framework(mesh, scene(pore + ", " + rock, biot("0.5")), 20, "pore.pressure"); },
       [&] { return minimal_biot(mesh, 20, true); }},
      {"Biot with alpha = 0, 20 steps",
       [&] { return framework(mesh, scene(pore + ", " + rock, biot("0")), 20, "pore.pressure"); },
       [&] {
         minimal_mechanics(mesh);
         return minimal_flow(mesh, 20);
       }},
      {"Biot with k = 0, 20 steps",
       [&] { return framework(mesh, scene(sealed + ", " + rock, biot("0.5")), 20, "pore.pressure"); },
       [&] { return minimal_biot(mesh, 20, false); }},
  };
  const std::string name = count > 3 ? arguments[3] : "", half = count > 4 ? arguments[4] : "";
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.name.rfind(name, 0) != 0; }),
              pairs.end());
  if (!half.empty()) {
    for (int i = 0; i < repeats; ++i)
      for (const Pair& pair : pairs) (half == "general" ? pair.general : pair.minimal)();
    return 0;
  }
  std::printf("{\"cells\": %d, \"repeats\": %d, \"pairs\": [\n", mesh.cell_count(), repeats);
  for (std::size_t i = 0; i < pairs.size(); ++i) compare(pairs[i], repeats, i + 1 == pairs.size());
  std::printf("]}\n");
}
