// Discretizations of a mesh whose fractures grow: put together from what stays and what is new, and made as a whole.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/matrix_flow/rediscretize.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "components/poromechanics/mpsa/rediscretize.hpp"
#include "framework/remeshing/extend_fractures.hpp"
#include "framework/remeshing/move_tips.hpp"
#include "tests/components/meshes.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"

namespace sprekk::test {
namespace {

using matrix_flow::FlowCondition;
using matrix_flow::FluxOperators;
using poromechanics::FaceConditions;
using poromechanics::MechanicalCondition;
using poromechanics::Stiffness;
using poromechanics::StressOperators;

template <class T>
bool same_bytes(const T* a, const T* b, Eigen::Index count) {
  return count == 0 || std::memcmp(a, b, count * sizeof(T)) == 0;
}

bool same_bits(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         same_bytes(a.outerIndexPtr(), b.outerIndexPtr(), a.rows() + 1) &&
         same_bytes(a.innerIndexPtr(), b.innerIndexPtr(), a.nonZeros()) &&
         same_bytes(a.valuePtr(), b.valuePtr(), a.nonZeros());
}

void expect_same(const FluxOperators& a, const FluxOperators& b) {
  EXPECT_TRUE(same_bits(a.flux_cell, b.flux_cell));
  EXPECT_TRUE(same_bits(a.flux_boundary, b.flux_boundary));
  EXPECT_TRUE(same_bits(a.flux_change, b.flux_change));
  EXPECT_TRUE(same_bits(a.trace_change, b.trace_change));
  EXPECT_TRUE(same_bits(a.trace_cell, b.trace_cell));
  EXPECT_TRUE(same_bits(a.trace_boundary, b.trace_boundary));
  EXPECT_TRUE(same_bits(a.blended_nodes, b.blended_nodes));
}

void expect_same(const StressOperators& a, const StressOperators& b) {
  EXPECT_TRUE(same_bits(a.force_displacement, b.force_displacement));
  EXPECT_TRUE(same_bits(a.force_stress, b.force_stress));
  EXPECT_TRUE(same_bits(a.force_boundary, b.force_boundary));
  EXPECT_TRUE(same_bits(a.trace_displacement, b.trace_displacement));
  EXPECT_TRUE(same_bits(a.trace_stress, b.trace_stress));
  EXPECT_TRUE(same_bits(a.trace_boundary, b.trace_boundary));
  EXPECT_TRUE(same_bits(a.volume_displacement, b.volume_displacement));
  EXPECT_TRUE(same_bits(a.volume_stress, b.volume_stress));
  EXPECT_TRUE(same_bits(a.volume_boundary, b.volume_boundary));
  EXPECT_TRUE(same_bits(a.moment_displacement, b.moment_displacement));
}

/// Coefficients and conditions that follow from places only, so that they are the same on all meshes.
struct Rock {
  Mesh mesh;
  std::vector<Tensor> mobility;
  std::vector<FlowCondition> flow_conditions;
  std::vector<Stiffness> stiffness;
  std::vector<FaceConditions> stress_conditions;

  explicit Rock(Mesh a_mesh, bool is_even = false) : mesh(std::move(a_mesh)) {
    for (const Point& x : mesh.cell_center) {
      const double contrast = is_even ? (x.y() > 0.5 ? 1.1 : 1) : x.x() > 0.5 ? 30 : 1 + x.y();
      // Even rock has the flows and stresses of tips, for which it has to be isotropic.
      mobility.push_back(contrast *
                         (is_even ? Tensor(2 * Tensor::Identity()) : (Tensor() << 2, 0.3, 0.3, 1).finished()));
      stiffness.push_back(poromechanics::isotropic_stiffness(2 * contrast, contrast));
    }
    for (int f = 0; f < mesh.face_count(); ++f) {
      const bool is_inner = mesh.face_cells[f][1] != none, is_left = !is_inner && mesh.face_center[f].x() < 1e-9;
      flow_conditions.push_back(is_inner  ? FlowCondition::none
                                : is_left ? FlowCondition::pressure
                                          : FlowCondition::flux);
      const auto along = [&](bool is_held) {
        return is_inner  ? MechanicalCondition::none
               : is_held ? MechanicalCondition::displacement
                         : MechanicalCondition::traction;
      };
      stress_conditions.push_back({along(is_left), along(is_left || mesh.face_center[f].y() < 1e-9)});
      if (!is_inner && mesh.face_center[f].y() > 1 - 1e-9)
        stress_conditions.back() = {MechanicalCondition::displacement, MechanicalCondition::traction,
                                    poromechanics::ConditionAxes::of_face};
    }
  }
  matrix_flow::FlowInputs flow() const { return {mesh, mobility, flow_conditions}; }
  poromechanics::StressInputs stress() const { return {mesh, stiffness, stress_conditions}; }
  FluxOperators fluxes(matrix_flow::Discretize discretize) const {
    return discretize(mesh, mobility, flow_conditions, {});
  }
  StressOperators stresses() const { return discretize_mpsa(mesh, stiffness, stress_conditions); }
};

/// Compares everything on `after` with what is put together from `before`; returns the regions of MPSA and MPFA.
std::array<int, 2> expect_the_same_bits(const Rock& before, const Rock& after, const MeshChange& change) {
  for (const matrix_flow::Discretize discretize : {matrix_flow::discretize_mpfa, matrix_flow::discretize_tpfa})
    expect_same(rediscretize(discretize, before.flow(), before.fluxes(discretize), after.flow(), change).operators,
                after.fluxes(discretize));
  const auto stresses = rediscretize_mpsa(before.stress(), before.stresses(), after.stress(), change);
  expect_same(stresses.operators, after.stresses());
  const auto fluxes = rediscretize(matrix_flow::discretize_mpfa, before.flow(),
                                   before.fluxes(matrix_flow::discretize_mpfa), after.flow(), change);
  return {stresses.regions, fluxes.regions};
}

/// No change at all, as a change.
MeshChange identity(const Mesh& mesh) {
  const auto count_up = [](int count) {
    std::vector<int> numbers(count);
    for (int i = 0; i < count; ++i) numbers[i] = i;
    return numbers;
  };
  MeshChange change;
  change.cell = count_up(mesh.cell_count());
  change.face = count_up(mesh.face_count());
  change.fracture_cell = count_up(mesh.fracture_cell_count());
  change.ridge = count_up(static_cast<int>(mesh.ridges.size()));
  return change;
}

TEST(Rediscretize, GivesTheBitsOfAWholeDiscretizationAfterEachOfManyChanges) {
  for (const bool is_even : {true, false}) {
    Rock rock(fractured_square(), is_even);
    double kept = 0, kept_flux = 0;
    for (int event = 0; event < 8; ++event) {
      const int fracture = event % 3 == 2 ? 1 : 0;
      const bool at_end = fracture == 1 || event % 2 == 0;
      // Short and long increments, with cells that are finer and coarser than those before.
      const double length = 0.02 + 0.01 * (event % 3), size = event % 4 == 3 ? 0.06 : 0.02;
      GrownMesh grown = extend_fractures(rock.mesh, {straight(rock.mesh, fracture, at_end, length, 0.3 - 0.1 * event)},
                                         {2.5 * length, size, 0.3});
      Rock after(std::move(grown.mesh), is_even);
      const auto [stress_regions, flux_regions] = expect_the_same_bits(rock, after, grown.change);
      EXPECT_LT(stress_regions, after.mesh.node_count()) << "nothing was kept in event " << event;
      // All nodes of a tip are computed anew together.
      kept_flux += 1 - static_cast<double>(flux_regions) / after.mesh.node_count();
      kept += 1 - static_cast<double>(stress_regions) / after.mesh.node_count();
      rock = std::move(after);
    }
    EXPECT_GT(kept / 8, 0.3);
    EXPECT_GT(kept_flux / 8, 0.3);
  }
}

TEST(Rediscretize, GivesTheSameBitsWhereCellsAreReplacedAndTipsMove) {
  constexpr CavityOptions cavity{0.05, 0.02, 0.3};
  for (const bool is_even : {true, false}) {
    Rock rock(fractured_square(), is_even);
    for (int event = 0; event < 5; ++event) {
      // The last cell becomes longer and turns, then the mesh made for this is moved.
      const int replaced = event == 0 || event == 3 ? 0 : event == 4 ? 2 : 1;
      std::vector<PathExtension> path{replacing(rock.mesh, 0, true, replaced, replaced == 0 ? 0.015 : 0.005, 0.1)};
      const GrownMesh grown = extended(rock.mesh, path, cavity);
      path[0].points[0] += Point(0.003, -0.002);
      std::optional<GrownMesh> moved = move_tips(rock.mesh, grown, path, cavity);
      ASSERT_TRUE(moved) << event;
      const Rock made(grown.mesh, is_even);
      expect_the_same_bits(rock, made, grown.change);
      Rock after(std::move(moved->mesh), is_even);
      expect_the_same_bits(rock, after, moved->change);
      rock = std::move(after);
    }
  }
}

TEST(Rediscretize, GivesTheSameBitsWhereCellsGetOtherNumbers) {
  // With fewer cells than before the last ones move to free numbers.
  Geometry geometry = box(1, 1);
  FractureGeometry crack;
  crack.name = "crack";
  crack.points = {Point(0.4, 0.45), Point(0.6, 0.55)};
  geometry.fractures = {crack};
  const Rock before(generate_mesh(geometry, unstructured(0.03)));
  GrownMesh grown = extend_fractures(before.mesh, {straight(before.mesh, 0, true, 0.1)}, {0.15, 0.1, 1});
  int moved = 0;
  for (int c = 0; c < grown.mesh.cell_count(); ++c) moved += grown.change.cell[c] != none && grown.change.cell[c] != c;
  ASSERT_GT(moved, 0);
  const Rock after(std::move(grown.mesh));
  EXPECT_LT(expect_the_same_bits(before, after, grown.change)[0], after.mesh.node_count());
}

TEST(Rediscretize, GivesTheSameBitsThroughQuadrilaterals) {
  // Corners of the square and of the bent fracture have a single cell, whose local problem reads two more.
  Rock rock(fractured_rectangles());
  for (const double angle : {0.4, -0.3}) {
    GrownMesh grown = extend_fractures(rock.mesh, {straight(rock.mesh, 0, true, 0.06, angle)}, {0.1, 0.03, 0.3});
    Rock after(std::move(grown.mesh));
    EXPECT_LT(expect_the_same_bits(rock, after, grown.change)[0], after.mesh.node_count());
    rock = std::move(after);
  }
}

// Permeability that changes with time is discretized anew around the cells that it changes in, step by step.
TEST(Rediscretize, CountsNodesWithBlendedFluxesOnce) {
  const Mesh mesh = generate_mesh(box(1, 1), rectangles(8, 8, 0.4));
  const std::vector<FlowCondition> conditions = [&] {
    std::vector<FlowCondition> made;
    for (const auto& cells : mesh.face_cells)
      made.push_back(cells[1] == none ? FlowCondition::flux : FlowCondition::none);
    return made;
  }();
  const double angle = 0.5, across = 1e-4;
  const Tensor turn = (Tensor() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
  std::vector<Tensor> mobility(mesh.cell_count(), turn * Point(1, across).asDiagonal() * turn.transpose());
  const auto whole = [&] { return matrix_flow::discretize_mpfa(mesh, mobility, conditions, {}); };

  FluxOperators operators = whole();
  int one_by_one = 0;
  for (int node = 0; node < mesh.node_count(); ++node) {
    std::vector<char> only(mesh.node_count(), 0);
    only[node] = 1;
    one_by_one += matrix_flow::discretize_mpfa(mesh, mobility, conditions, only).blended_nodes.nonZeros() > 0;
  }
  EXPECT_GT(one_by_one, 0);
  EXPECT_NEAR(operators.blended_nodes.sum(), one_by_one, 1e-9);

  for (int step = 0; step < 20; ++step) {
    const std::vector<Tensor> before = mobility;
    mobility[mesh.cell_count() / 2 + step % 3] *= 1.5;
    auto made = matrix_flow::rediscretize(matrix_flow::discretize_mpfa, {mesh, before, conditions}, operators,
                                          {mesh, mobility, conditions}, identity(mesh));
    EXPECT_LT(made.regions, mesh.node_count());
    expect_same(made.operators, whole());
    operators.swap(made.operators);
  }
}

TEST(Rediscretize, SolvesNoLocalProblemWhereNothingHasChanged) {
  const Rock rock(fractured_square());
  EXPECT_EQ(expect_the_same_bits(rock, rock, identity(rock.mesh)), (std::array{0, 0}));
}

TEST(Rediscretize, NoticesAnyInputThatDiffers) {
  const Rock before(fractured_square());
  const MeshChange change = identity(before.mesh);
  const int cell = before.mesh.cell_count() / 2, face = before.mesh.face_count() / 3;
  const auto regions = [&](const Rock& after) { return expect_the_same_bits(before, after, change); };

  Rock stiffer = before;
  stiffer.stiffness[cell] *= 1 + 1e-15;
  EXPECT_GT(regions(stiffer)[0], 0);
  EXPECT_EQ(regions(stiffer)[1], 0);
  Rock permeable = before;
  permeable.mobility[cell] *= 1 + 1e-15;
  EXPECT_EQ(regions(permeable)[0], 0);
  EXPECT_GT(regions(permeable)[1], 0);

  Rock held = before;
  for (int f = 0; f < before.mesh.face_count(); ++f)
    if (before.mesh.face_side[f] != none && held.stress_conditions[f][0] == MechanicalCondition::traction) {
      held.stress_conditions[f][0] = MechanicalCondition::displacement;
      held.flow_conditions[f] = FlowCondition::pressure;
      break;
    }
  EXPECT_GT(regions(held)[0], 0);
  EXPECT_GT(regions(held)[1], 0);
  Rock turned = before;
  for (int f = 0; f < before.mesh.face_count(); ++f)
    if (turned.stress_conditions[f].axes == poromechanics::ConditionAxes::of_face) {
      turned.stress_conditions[f].axes = poromechanics::ConditionAxes::of_space;
      break;
    }
  EXPECT_GT(regions(turned)[0], 0);
  EXPECT_EQ(regions(turned)[1], 0);

  // Geometry, one number after the other.
  const std::vector<std::function<void(Mesh&)>> shifts = {
      [&](Mesh& mesh) { mesh.cell_center[cell].x() += 1e-9; }, [&](Mesh& mesh) { mesh.face_center[face].y() += 1e-9; },
      [&](Mesh& mesh) { mesh.face_measure[face] *= 1 + 1e-9; },
      [&](Mesh& mesh) { mesh.face_normal[face] = -mesh.face_normal[face]; },
      [&](Mesh& mesh) { mesh.nodes[mesh.face_nodes[face][0]].x() += 1e-9; }};
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    Rock shifted = before;
    shifts[i](shifted.mesh);
    EXPECT_GT(regions(shifted)[0], 0) << i;
    EXPECT_GT(regions(shifted)[1], 0) << i;
  }
}

TEST(Rediscretize, NoticesCellsAcrossFromCornersOfASingleCell) {
  // The local problem of such a corner reads the cell across, which is none of its own.
  Rock before(square_with_single_corners(4), true);
  const MeshChange change = identity(before.mesh);
  for (int node = 0; node < before.mesh.node_count(); ++node) {
    if (before.mesh.node_cells[node].size() != 1) continue;
    const int corner = before.mesh.node_cells[node][0];
    for (const int face : before.mesh.cell_faces[corner]) {
      const auto [cell, other] = before.mesh.face_cells[face];
      if (other == none) continue;
      Rock after = before;
      after.mesh.cell_center[cell == corner ? other : cell] += Point(0.01, 0.02);
      expect_the_same_bits(before, after, change);
    }
  }
}

TEST(Rediscretize, WorkOfAChangeDoesNotDependOnTheSizeOfTheMesh) {
  std::array<int, 2> cells{}, regions{}, all{};
  for (int i = 0; i < 2; ++i) {
    Geometry geometry = box(i == 0 ? 1 : 4, i == 0 ? 1 : 4);
    FractureGeometry crack;
    crack.name = "crack";
    crack.points = {Point(0.4, 0.45), Point(0.6, 0.55)};
    geometry.fractures = {crack};
    const Rock before(generate_mesh(geometry, unstructured(0.04)));
    GrownMesh grown = extend_fractures(before.mesh, {straight(before.mesh, 0, true, 0.03, 0.5)}, {0.1, 0.03, 0.3});
    const Rock after(std::move(grown.mesh));
    expect_the_same_bits(before, after, grown.change);
    const auto result = rediscretize_mpsa(before.stress(), before.stresses(), after.stress(), grown.change);
    cells[i] = result.cells;
    regions[i] = result.regions;
    all[i] = after.mesh.cell_count();
    // The cavity's cells, and some rings of cells around it: nodes whose cells changed, those that share a row with
    // one, and the cells that touch these.
    const double edge = 0.04, radius = 0.1 + 0.03 + 5 * edge, of_cell = std::sqrt(3) / 4 * edge * edge;
    EXPECT_LT(cells[i], M_PI * radius * radius / of_cell);
    EXPECT_GT(regions[i], 0);
  }
  EXPECT_GT(all[1], 10 * all[0]);
  EXPECT_LT(std::abs(cells[1] - cells[0]), 0.3 * cells[0]) << cells[0] << " of " << all[0] << ", " << cells[1];
}

}  // namespace
}  // namespace sprekk::test
