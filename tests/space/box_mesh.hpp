// Boxes of hexahedra, wedges or tetrahedra with fractures on the planes of their grid.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk::test {

enum class Bodies { hexahedra, wedges, tetrahedra, hexahedra_and_wedges };

/// A rectangle of faces on a plane of the grid: across axis `across` at grid line `at`, between the grid lines `from`
/// and `to` along the two axes that follow it (y, z for x; z, x for y; x, y for z).
struct GridRectangle {
  std::string name;
  int across, at;
  std::array<int, 2> from, to;
};

/// The unit cells of a grid of so many cells, as one kind of bodies, with a side for each of the six directions (x−,
/// x+, y−, y+, z−, z+) and one region.
class BoxMesh {
 public:
  BoxMesh(const std::array<int, 3>& count, Bodies bodies) : count_(count) {
    for (int k = 0; k <= count[2]; ++k)
      for (int j = 0; j <= count[1]; ++j)
        for (int i = 0; i <= count[0]; ++i) raw.nodes.push_back(Point(i, j, k));
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) add_cell(i, j, k, bodies);
    raw.region_names = {"rock"};
    raw.regions.assign(raw.cells.size(), 0);
    raw.side_names = {"left", "right", "front", "back", "bottom", "top"};
    for (int axis = 0; axis < 3; ++axis)
      for (const int at : {0, count[axis]}) {
        const GridRectangle side{"", axis, at, {0, 0}, {count[(axis + 1) % 3], count[(axis + 2) % 3]}};
        for (const FaceNodes& face : faces_on(side)) raw.boundary_faces.push_back({face, 2 * axis + (at > 0)});
      }
  }

  void add_fracture(const GridRectangle& rectangle) { raw.fractures.push_back({rectangle.name, faces_on(rectangle)}); }

  int node(int i, int j, int k) const { return i + (count_[0] + 1) * (j + (count_[1] + 1) * k); }

  /// Moves the nodes that lie on no fracture and not on the outer boundary.
  void move_free_nodes(const std::function<Point()>& by) {
    std::vector<char> is_held(raw.nodes.size(), 0);
    for (const auto& fracture : raw.fractures)
      for (const FaceNodes& face : fracture.faces)
        for (const int held : face) is_held[held] = 1;
    for (const auto& face : raw.boundary_faces)
      for (const int held : face.nodes) is_held[held] = 1;
    for (std::size_t i = 0; i < raw.nodes.size(); ++i)
      if (!is_held[i]) raw.nodes[i] += by();
  }

  void turn(const Eigen::AngleAxisd& rotation) {
    for (Point& node : raw.nodes) node = rotation * node;
  }

  RawMesh raw;

 private:
  void add_cell(int i, int j, int k, Bodies bodies) {
    const std::array<int, 8> c{
        node(i, j, k),     node(i + 1, j, k),     node(i + 1, j + 1, k),     node(i, j + 1, k),
        node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)};
    const bool mixed = bodies == Bodies::hexahedra_and_wedges;
    if (bodies == Bodies::hexahedra || (mixed && (i + j) % 2 == 0)) {
      raw.cells.push_back({c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
    } else if (bodies == Bodies::wedges || mixed) {
      raw.cells.push_back({c[0], c[1], c[2], c[4], c[5], c[6]});
      raw.cells.push_back({c[0], c[2], c[3], c[4], c[6], c[7]});
    } else {
      // Along the diagonal from c[0] to c[6], by the order in which the axes are passed (Kuhn).
      for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
        raw.cells.push_back({c[0], c[a], c[b], c[6]});
    }
  }

  /// The faces of cells that lie in a rectangle, in the order in which the cells have them.
  std::vector<FaceNodes> faces_on(const GridRectangle& at) const {
    const auto is_in = [&](int number) {
      const std::array<int, 3> place{number % (count_[0] + 1), number / (count_[0] + 1) % (count_[1] + 1),
                                     number / ((count_[0] + 1) * (count_[1] + 1))};
      bool in = place[at.across] == at.at;
      for (int k = 0; k < 2; ++k) {
        const int along = place[(at.across + 1 + k) % 3];
        in = in && along >= at.from[k] && along <= at.to[k];
      }
      return in;
    };
    std::vector<FaceNodes> faces;
    for (const CellNodes& cell : raw.cells)
      for (int k = 0; k < faces_to_number(cell).size(); ++k) {
        const FaceNodes face = nodes_of_face(cell, k);
        bool lies = true, is_known = false;
        for (const int corner : face) lies = lies && is_in(corner);
        for (const FaceNodes& other : faces) is_known = is_known || have_same_nodes(other, face);
        if (lies && !is_known) faces.push_back(face);
      }
    return faces;
  }

  std::array<int, 3> count_;
};

}  // namespace sprekk::test
