// Boxes of bodies that are bent, and flows in them, for tests of flux discretizations.
#pragma once

#include <Eigen/SparseLU>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "components/capabilities/flux_discretization.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "tests/space/box_mesh.hpp"

namespace sprekk::test {

/// How the nodes of a box are moved.
enum class Bend { none, free_nodes, all };

/// A box of so many cells a side; with fractures, two rectangles that cross, one of which ends inside. `free_nodes`:
/// nodes that are on no side and no fracture are moved by some tenths of a cell; `all`: also sides and fractures are
/// bent, so that quadrilaterals are not flat.
inline Mesh bent_box(int count, Bodies bodies, Bend bend, bool has_fractures, unsigned seed = 1) {
  BoxMesh box({count, count, count}, bodies);
  if (has_fractures) {
    box.add_fracture({"first", 0, count / 2, {1, 0}, {count, count - 1}});
    box.add_fracture({"second", 2, count / 2, {1, 1}, {count - 1, count - 1}});
  }
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> amount(-0.15, 0.15);
  const auto by = [&] {
    const double x = amount(random), y = amount(random);
    return Point(x, y, amount(random));
  };
  if (bend != Bend::none) box.move_free_nodes(by);
  if (bend == Bend::all)
    for (Point& node : box.raw.nodes) {
      const Point x = node / count;
      node += 0.05 * count *
              Point(std::sin(3 * x[1] + x[2]), std::sin(2 * x[2] * x[0] + x[1]), std::cos(3 * x[0] - x[1] * x[2]));
    }
  for (Point& node : box.raw.nodes) node /= count;
  return build_mesh(box.raw);
}

/// Positive definite, with a ratio of at most about 100 between its principal values.
inline Tensor some_tensor() {
  Tensor root;
  root << 1, 0.7, -0.2, 0.1, 0.5, 0.3, -0.4, 0.2, 0.9;
  return root * root.transpose() + 0.05 * Tensor::Identity();
}

/// What is given on a face with one cell: the pressure on some sides, a flux on others and on walls.
inline std::vector<FlowCondition> mixed_conditions(const Mesh& mesh) {
  std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_cells[f][1] == none)
      conditions[f] =
          mesh.face_side[f] != none && mesh.face_side[f] % 2 == 0 ? FlowCondition::pressure : FlowCondition::flux;
  return conditions;
}

/// The pressure on all sides.
inline std::vector<FlowCondition> given_pressures(const Mesh& mesh) {
  std::vector<FlowCondition> conditions = mixed_conditions(mesh);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_side[f] != none) conditions[f] = FlowCondition::pressure;
  return conditions;
}

/// A pressure, and the flux density that it drives.
struct ExactFlow {
  std::function<double(const Point&)> pressure;
  std::function<Point(const Point&)> velocity;
  std::function<double(const Point&)> source = [](const Point&) { return 0.0; };
};

inline double flux_through(const Mesh& mesh, int face, const ExactFlow& flow) {
  return mesh.face_measure[face] * mesh.face_normal[face].dot(flow.velocity(mesh.face_center[face]));
}

/// Boundary values and changes of FluxOperators.
struct Given {
  Vector values, changes;
  Given(const Mesh& mesh, const std::vector<FlowCondition>& conditions, const ExactFlow& flow)
      : values(Vector::Zero(mesh.face_count())), changes(Vector::Zero(directions_of_faces * mesh.face_count())) {
    for (int f = 0; f < mesh.face_count(); ++f) {
      if (conditions[f] == FlowCondition::flux) values[f] = flux_through(mesh, f, flow);
      if (conditions[f] != FlowCondition::pressure) continue;
      const LinearOnFace linear = linear_on_face(mesh, f, flow.pressure);
      values[f] = linear.at_center;
      for (int k = 0; k < directions_of_faces; ++k) changes[directions_of_faces * f + k] = linear.changes[k];
    }
  }
};

/// Pressures of cells and of inner faces (none where these are no unknowns), and fluxes through all faces.
struct Solved {
  Vector pressure, face_pressure, fluxes;
};

/// The steady flow with given conditions: what flows out of each cell is the source in it.
inline Solved solve(const Mesh& mesh, const FluxOperators& operators, const Given& given,
                    const std::function<double(const Point&)>& source) {
  const int cells = mesh.cell_count(), faces = static_cast<int>(operators.faces.flux.rows());
  std::vector<Triplet> entries;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto [cell, other] = mesh.face_cells[f];
    entries.emplace_back(cell, f, 1.0);
    if (other != none) entries.emplace_back(other, f, -1.0);
  }
  SparseMatrix divergence(cells, mesh.face_count());
  divergence.setFromTriplets(entries.begin(), entries.end());
  const Vector constant = operators.flux_boundary * given.values + operators.flux_change * given.changes;
  Vector right = Vector::Zero(cells + faces);
  for (int c = 0; c < cells; ++c) right[c] = mesh.cell_measure[c] * source(mesh.cell_center[c]);
  right.head(cells) -= divergence * constant;
  entries.clear();
  const auto add = [&](const SparseMatrix& block, int row, int column) {
    for (int i = 0; i < block.outerSize(); ++i)
      for (SparseMatrix::InnerIterator entry(block, i); entry; ++entry)
        entries.emplace_back(row + static_cast<int>(entry.row()), column + static_cast<int>(entry.col()),
                             entry.value());
  };
  add(divergence * operators.flux_cell, 0, 0);
  if (faces > 0) {
    right.tail(faces) = -(operators.faces.continuity_boundary * given.values);
    add(divergence * operators.faces.flux, 0, cells);
    add(operators.faces.continuity_cell, cells, 0);
    add(operators.faces.continuity_face, cells, cells);
  }
  Eigen::SparseMatrix<double> matrix(cells + faces, cells + faces);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  const Vector unknowns = solver.solve(right);
  Solved solved{unknowns.head(cells), unknowns.tail(faces), {}};
  solved.fluxes = operators.flux_cell * solved.pressure + constant;
  if (faces > 0) solved.fluxes += operators.faces.flux * solved.face_pressure;
  return solved;
}

}  // namespace sprekk::test
