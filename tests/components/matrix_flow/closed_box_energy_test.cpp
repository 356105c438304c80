// Fluid in a closed box only loses energy, whatever the rock, the mesh and the fractures in it.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::matrix_flow {
namespace {

/// Random geometry and rock: a fracture that crosses the edge of a region at any angle, another that may touch it, an
/// open end, tensors of up to 1e4:1 in any direction, of another size in each region.
class RandomRock {
 public:
  RandomRock(unsigned seed, const MeshOptions& options) : random_(seed) {
    Geometry geometry = test::box(1, 1);
    RegionGeometry lower;
    lower.name = "lower";
    const double left = between(0.35, 0.65), right = between(0.35, 0.65);
    lower.polygon = {Point(0, 0), Point(1, 0), Point(1, right), Point(0, left)};
    geometry.regions = {lower};
    const Point center(between(0.35, 0.65), 0);
    const double height = left + (right - left) * center.x(), length = between(0.1, 0.4);
    const Point arm = 0.5 * length * direction(between(0, std::numbers::pi));
    const Point middle = center + Point(0, height + between(-0.03, 0.03));
    FractureGeometry across, other, open;
    open.name = "open";
    open.points = {Point(0, 0.1), Point(0.2, 0.2)};
    across.name = "across";
    across.points = {middle - arm, middle + arm};
    other.name = "other";
    other.points = {middle, middle + between(0.1, 0.3) * direction(std::atan2(arm.y(), arm.x()) + between(0.7, 2.4))};
    geometry.fractures = {across};
    if (between(0, 1) < 0.4) geometry.fractures.push_back(other);
    if (between(0, 1) < 0.3) geometry.fractures.push_back(open);
    MeshOptions with_size = options;
    if (options.kind == MeshOptions::Kind::unstructured) {
      with_size.size = between(0.2, 0.4);
      with_size.fracture_size = between(0.08, 0.2);
      with_size.growth = between(0.1, 0.5);
    } else {
      geometry.fractures.resize(1);
      geometry.fractures[0].points = {Point(0.25, 0.5), Point(0.5, 0.5)};
      geometry.regions[0].polygon = {Point(0, 0), Point(0.375, 0), Point(0.375, 1), Point(0, 1)};
      with_size.distortion = between(0, options.distortion);
    }
    mesh = generate_mesh(geometry, with_size);
    const bool is_even = between(0, 1) < 0.2;  // as corrected around tips
    const std::array<Tensor, 2> tensors = {tensor(is_even), tensor(is_even)};
    for (int c = 0; c < mesh.cell_count(); ++c) mobility.push_back(tensors[is_even ? 0 : mesh.cell_region[c]]);
  }

  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Mesh mesh;
  std::vector<Tensor> mobility;
  std::string text;

 private:
  static Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

  Tensor tensor(bool is_isotropic) {
    const double size = std::pow(10, between(-2, 2)), ratio = is_isotropic ? 1 : std::pow(10, between(-4, 0));
    const Point along = direction(between(0, std::numbers::pi)), across(-along.y(), along.x());
    text += " " + std::to_string(size) + " x " + std::to_string(ratio) + " at " +
            std::to_string(std::atan2(along.y(), along.x()) * 180 / std::numbers::pi);
    return size * (along * along.transpose() + ratio * across * across.transpose());
  }

  std::mt19937 random_;
};

/// The power that is lost is a quadratic form of the pressures of cells and of what flows out through the boundary: of
/// the flows out of the cells times their pressures, less what leaves times the pressure there.
Eigen::MatrixXd dissipation(const Mesh& mesh, const FluxOperators& operators,
                            const std::vector<FlowCondition>& conditions) {
  std::vector<int> outer;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (conditions[f] == FlowCondition::flux) outer.push_back(f);
  const int cells = mesh.cell_count(), size = cells + static_cast<int>(outer.size());
  const SparseMatrix divergence = test::divergence(mesh, 1);
  const Eigen::MatrixXd of_cells = divergence * operators.flux_cell, of_sides = divergence * operators.flux_boundary;
  const Eigen::MatrixXd trace_cells = operators.trace_cell, trace_sides = operators.trace_boundary;
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(size, size);
  form.topLeftCorner(cells, cells) = of_cells;
  for (int i = 0; i < static_cast<int>(outer.size()); ++i) {
    form.col(cells + i).head(cells) = of_sides.col(outer[i]);
    form.row(cells + i).head(cells) = -trace_cells.row(outer[i]);
    for (int j = 0; j < static_cast<int>(outer.size()); ++j)
      form(cells + i, cells + j) = -trace_sides(outer[i], outer[j]);
  }
  return form;
}

std::vector<FlowCondition> conditions_of(const Mesh& mesh, bool is_closed) {
  std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (test::is_outer(mesh, f))
      conditions[f] =
          is_closed || test::is_wall(mesh, f) || mesh.face_side[f] > 1 ? FlowCondition::flux : FlowCondition::pressure;
  return conditions;
}

/// Of the symmetric part, with scaled unknowns.
double smallest_eigenvalue(const Eigen::MatrixXd& form) {
  const Eigen::MatrixXd symmetric = 0.5 * (form + form.transpose());
  const Eigen::VectorXd scale = symmetric.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * symmetric * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

/// SPREKK_RANDOM_CASES=5000 looks at as many.
int cases(int usual) {
  const char* asked = std::getenv("SPREKK_RANDOM_CASES");
  return asked ? std::atoi(asked) : usual;
}

/// What is left of the energy after a step of any length with fluid in the fractures, too: a dense system of the
/// pressures of cells, of lambda at the walls and of the pressures in the fractures.
double energy_left(RandomRock& rock, const FluxOperators& operators) {
  const Mesh& mesh = rock.mesh;
  const int cells = mesh.cell_count(), walls = mesh.wall_count(), fracture_cells = mesh.fracture_cell_count();
  const double dt = std::pow(10, rock.between(-4, 4)), kappa = std::pow(10, rock.between(-4, 4)),
               along = std::pow(10, rock.between(-4, 4)), storage = std::pow(10, rock.between(-3, 0));
  const SparseMatrix divergence = test::divergence(mesh, 1);
  const Eigen::MatrixXd outflow = divergence * operators.flux_cell, of_sides = divergence * operators.flux_boundary;
  const Eigen::MatrixXd trace_cells = operators.trace_cell, trace_sides = operators.trace_boundary;
  const int size = cells + walls + fracture_cells;
  Eigen::VectorXd capacity = Eigen::VectorXd::Zero(size), before(size);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size, size);
  for (int c = 0; c < cells; ++c) capacity[c] = mesh.cell_measure[c];
  system.topLeftCorner(cells, cells) = dt * outflow;
  for (int w = 0; w < walls; ++w) {
    const int face = mesh.wall_face(w), row = cells + w, in = cells + walls + w / 2;
    const double length = mesh.face_measure[face];
    system.col(row).head(cells) = -dt * length * of_sides.col(face);
    // lambda / kappa + trace = pressure in the fracture
    system.row(row).head(cells) = trace_cells.row(face);
    for (int v = 0; v < walls; ++v)
      system(row, cells + v) = -trace_sides(face, mesh.wall_face(v)) * mesh.face_measure[mesh.wall_face(v)];
    system(row, row) += 1 / kappa;
    system(row, in) = -1;
    system(in, row) += dt * length;
    capacity[in] = storage * length;
  }
  for (const Ridge& point : mesh.ridges)
    if (point.cells.size() == 2)
      for (int i = 0; i < 2; ++i) {
        system(cells + walls + point.cells[i], cells + walls + point.cells[i]) += dt * along;
        system(cells + walls + point.cells[i], cells + walls + point.cells[1 - i]) -= dt * along;
      }
  system.diagonal() += capacity;
  for (double& value : before) value = rock.between(-1, 1);
  const Eigen::VectorXd stored = capacity.cwiseProduct(before), after = system.partialPivLu().solve(stored);
  return after.dot(capacity.cwiseProduct(after)) / before.dot(stored);
}

/// `more`: seeds beside the first ones.
void look_at(const MeshOptions& options, int count, const std::vector<int>& more = {}) {
  std::vector<int> seeds = more;
  for (int seed = 1; seed <= count; ++seed) seeds.push_back(seed);
  for (const int seed : seeds) {
    RandomRock rock(seed, options);
    for (const bool is_closed : {true, false}) {
      const auto conditions = conditions_of(rock.mesh, is_closed);
      const FluxOperators operators = discretize_mpfa(rock.mesh, rock.mobility, conditions);
      EXPECT_GE(smallest_eigenvalue(dissipation(rock.mesh, operators, conditions)), -1e-10) << seed << rock.text;
      if (!is_closed) continue;
      EXPECT_LE(energy_left(rock, operators), 1 + 1e-9) << seed << rock.text;
    }
  }
}

TEST(ClosedBoxEnergy, TrianglesLoseIt) {
  // Flows around tips gained energy with these.
  look_at(test::unstructured(0.2), cases(30), {195, 470, 1204});
}
TEST(ClosedBoxEnergy, RectanglesLoseIt) { look_at(test::rectangles(8, 8), cases(30)); }
TEST(ClosedBoxEnergy, DistortedQuadrilateralsLoseIt) { look_at(test::rectangles(8, 8, 0.4), cases(30)); }
TEST(ClosedBoxEnergy, MixedCellsLoseIt) { look_at(test::mixed(0.2), cases(30)); }

}  // namespace
}  // namespace sprekk::matrix_flow
