// Values at nodes are those of linear fields, on both sides of a fracture.
#include "couplers/two_level/plane/nodal_values.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

using couplers::NodalValues;

TEST(NodalValues, OfNodesAreTakenAsTheyAre) {
  const Mesh mesh = fractured_square(mixed(0.1, 0.3));
  NodalValues values(mesh, NodalValues::From::cells_and_faces);
  Vector nodes(2 * mesh.node_count());
  for (int i = 0; i < mesh.node_count(); ++i)
    nodes.segment<2>(2 * i) = Point(3 - 2 * mesh.nodes[i][0] + 5 * mesh.nodes[i][1], mesh.nodes[i][0]);
  values.set_nodes(2, nodes);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Point x = 0.7 * mesh.cell_center[c] + 0.3 * mesh.nodes[mesh.cell_nodes[c][1]];
    EXPECT_LT((values.at<2>(c, x) - Point(3 - 2 * x[0] + 5 * x[1], x[0])).norm(), 1e-13);
  }
}

/// Two components that are linear in x.
Point linear(const Point& x) { return {3 - 2 * x[0] + 5 * x[1], -1 + 4 * x[0] + 0.5 * x[1]}; }

/// The same, with a jump of 2 and −3 and other gradients above the fracture `through` of split_square.
Point jumping(const Point& x, bool is_above) {
  return is_above ? Point(linear(x) + Point(2 + x[0] - 3 * x[1], -3 + 0.7 * x[0])) : linear(x);
}

/// An unstructured square that a fracture cuts in two.
Mesh split_square() {
  Geometry geometry = box(1, 1);
  geometry.fractures.emplace_back();
  geometry.fractures[0].name = "through";
  geometry.fractures[0].points = {Point(0, 0.45), Point(1, 0.6)};
  return generate_mesh(geometry, unstructured(0.1, 0.3));
}
bool is_above(const Point& x) { return x[1] > 0.45 + 0.15 * x[0]; }

/// Values of a function of place and of the cell that the place is seen from.
template <class Function>
void set(NodalValues& values, const Mesh& mesh, const Function& function) {
  Vector cells(2 * mesh.cell_count()), faces(2 * mesh.face_count());
  for (int i = 0; i < mesh.cell_count(); ++i) cells.segment<2>(2 * i) = function(mesh.cell_center[i], i);
  for (int i = 0; i < mesh.face_count(); ++i)
    faces.segment<2>(2 * i) = function(mesh.face_center[i], mesh.face_cells[i][0]);
  values.set(2, cells, faces);
}

/// The largest difference from the function at the corners and at random places of the cells that are asked for.
template <class Function, class Asked>
double largest_error(const NodalValues& values, const Mesh& mesh, const Function& function, const Asked& is_asked) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  double error = 0;
  for (int i = 0; i < mesh.cell_count(); ++i) {
    if (!is_asked(i)) continue;
    const Ring& corners = mesh.cell_nodes[i];
    const Point& a = mesh.nodes[corners[0]];
    for (int k = 1; k + 1 < corners.size(); ++k) {
      const Point &b = mesh.nodes[corners[k]], &c = mesh.nodes[corners[k + 1]];
      const double s = part(random), t = (1 - s) * part(random);
      for (const Point& x : {a, b, c, Point(a + s * (b - a) + t * (c - a))})
        error = std::max(error, (Point(values.at<2>(i, x)) - function(x, i)).norm());
    }
  }
  return error;
}

constexpr auto everywhere = [](int) { return true; };
constexpr double rounding = 1e-12;

TEST(NodalValues, CellsAndFacesGiveLinearFieldsExactly) {
  const auto function = [](const Point& x, int) { return linear(x); };
  for (const Mesh& mesh : {fractured_square(), fractured_rectangles(), fractured_square(mixed(0.1, 0.3))}) {
    NodalValues values(mesh, NodalValues::From::cells_and_faces);
    set(values, mesh, function);
    EXPECT_LT(largest_error(values, mesh, function, everywhere), rounding);
  }
}

TEST(NodalValues, CellsAndFacesGiveBothSidesOfAJumpExactly) {
  const Mesh mesh = split_square();
  const auto function = [&](const Point& x, int cell) { return jumping(x, is_above(mesh.cell_center[cell])); };
  NodalValues values(mesh, NodalValues::From::cells_and_faces);
  set(values, mesh, function);
  EXPECT_LT(largest_error(values, mesh, function, everywhere), rounding);
}

/// Whether there are three cells, not on one line, at each corner of the cell: what a linear function needs.
bool has_enough_cells(const Mesh& mesh, int cell) {
  for (const int node : mesh.cell_nodes[cell])
    if (mesh.node_cells[node].size() < 3) return false;
  return true;
}

TEST(NodalValues, CellsAloneGiveLinearFieldsExactly) {
  for (const Mesh& mesh : {fractured_square(), split_square()}) {
    const auto function = [](const Point& x, int) { return linear(x); };
    NodalValues values(mesh, NodalValues::From::cells);
    set(values, mesh, function);
    const auto is_asked = [&](int cell) { return has_enough_cells(mesh, cell); };
    EXPECT_LT(largest_error(values, mesh, function, is_asked), rounding);
  }
}

TEST(NodalValues, CellsAloneGiveBothSidesOfAJumpExactly) {
  const Mesh mesh = split_square();
  const auto function = [&](const Point& x, int cell) { return jumping(x, is_above(mesh.cell_center[cell])); };
  NodalValues values(mesh, NodalValues::From::cells);
  set(values, mesh, function);
  const auto is_asked = [&](int cell) { return has_enough_cells(mesh, cell); };
  EXPECT_LT(largest_error(values, mesh, function, is_asked), rounding);
}

TEST(NodalValues, ConstantsAreExactAlsoInCornersOfOneOrTwoCells) {
  const auto function = [](const Point&, int) { return Point(2, -7); };
  for (const Mesh& mesh : {square_with_single_corners(4), fractured_square(), fractured_rectangles(), split_square()})
    for (const auto from :
         {NodalValues::From::cells_and_faces, NodalValues::From::cells, NodalValues::From::mean_of_cells}) {
      NodalValues values(mesh, from);
      set(values, mesh, function);
      EXPECT_LT(largest_error(values, mesh, function, everywhere), rounding);
    }
}

TEST(NodalValues, MeansOfCellsAreOffAtWallsByTheStrainTimesTheDistance) {
  // Squares of h with diagonals that alternate. At a wall a node has the triangles of two whole squares, whose centroid
  // is h/2 away from it, or one half of each, together a triangle of height h, whose centroid is h/3 away.
  Geometry geometry = box(1, 1);
  geometry.fractures.emplace_back();
  geometry.fractures[0].name = "flat";
  geometry.fractures[0].points = {Point(0.25, 0.5), Point(0.75, 0.5)};
  const Mesh mesh = generate_mesh(geometry, structured(8, 8));
  const double h = 1.0 / 8;
  NodalValues values(mesh, NodalValues::From::mean_of_cells);
  set(values, mesh, [](const Point& x, int) { return linear(x); });
  const Point strain(5, 0.5);  // the derivatives of `linear` along y
  int halves = 0, thirds = 0;
  for (const FractureCell& cell : mesh.fracture_cells)
    for (const int side : {0, 1}) {
      const int face = cell.faces[side], rock = mesh.face_cells[face][0];
      for (const int node : mesh.face_nodes[face]) {
        if (mesh.node_cells[node].size() > 4) continue;  // a tip, which is inside of the rock
        const Point& x = mesh.nodes[node];
        const double into_rock = mesh.cell_center[rock][1] > 0.5 ? 1 : -1;
        const double away = mesh.node_cells[node].size() == 4 ? h / 2 : h / 3;
        (mesh.node_cells[node].size() == 4 ? halves : thirds) += 1;
        EXPECT_LT((Point(values.at<2>(rock, x)) - linear(x) - into_rock * away * strain).norm(), rounding);
      }
    }
  EXPECT_GT(halves, 0);
  EXPECT_GT(thirds, 0);
}

TEST(NodalValues, MeansOfCellsWeighByArea) {
  const Mesh mesh = fractured_square();
  NodalValues values(mesh, NodalValues::From::mean_of_cells);
  set(values, mesh, [](const Point& x, int) { return linear(x); });
  // The mean of a linear field over the cells at a node is its value at their common centroid.
  for (int i = 0; i < mesh.cell_count(); ++i)
    for (const int node : mesh.cell_nodes[i]) {
      Point centroid = Point::Zero();
      double area = 0;
      for (const int cell : mesh.node_cells[node]) {
        centroid += mesh.cell_measure[cell] * mesh.cell_center[cell];
        area += mesh.cell_measure[cell];
      }
      EXPECT_LT((Point(values.at<2>(i, mesh.nodes[node])) - linear(centroid / area)).norm(), rounding);
    }
}

}  // namespace
}  // namespace sprekk::test
