// The part of gmsh that Sprekk uses: triangles between lines in the plane, tetrahedra between surfaces in space.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace sprekk {

/// Lines that meet at their ends only. All numbers count from 0.
struct PlanarLines {
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<int, 2>> lines;          ///< numbers of the two points of each
  std::vector<int> outline;                       ///< numbers of the lines around the whole, one after the other
  std::vector<int> inner;                         ///< numbers of the other lines
  std::function<double(double, double)> size_at;  ///< the wanted length of edges at (x, y), in the unit of the points
  double random_factor = 1e-9;                    ///< gmsh's Mesh.RandomFactor: how far points are moved, of the whole
};

/// Triangles between lines, in the unit of the points. All numbers count from 0.
struct PlanarTriangles {
  std::vector<std::array<double, 2>> nodes;
  std::vector<std::array<int, 3>> triangles;  ///< numbers of nodes
  std::vector<std::vector<int>> line_nodes;   ///< the nodes on each line with its ends, in any order
  std::vector<int> point_nodes;               ///< the node at each point
};

/// A flat surface in space: a polygon, or an ellipse where it has no corners.
struct FlatSurface {
  std::vector<std::array<double, 3>> corners;
  std::array<double, 3> center{}, one_axis{}, other_axis{};  ///< of the ellipse; half axes at right angles
};

/// An axis-parallel box with surfaces in it that may cross and touch, but are not outside of it.
struct CutBox {
  std::array<double, 3> low, high;
  std::vector<FlatSurface> surfaces;
  std::function<double(double, double, double)> size_at;  ///< the wanted length of edges, in the unit of the points
  /// Where a corner of a surface, or a point at which surfaces cross, is near to another one or to an edge, edges there
  /// are as long as the distance between the two over this number, but no shorter than `least_size`; away from there
  /// they grow by `growth` times the distance. With 0, no edges are shortened.
  double gap_edges = 0;
  double least_size = 0, growth = 0.5;
};

/// Tetrahedra between surfaces, in the unit of the points. All numbers count from 0.
struct Tetrahedra {
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::array<int, 4>> tetrahedra;
  std::vector<std::vector<std::array<int, 3>>> triangles;  ///< of each surface
};

/// The module "gmsh": gmsh loads a hundred libraries of geometry and windows.
class GmshModule {
 public:
  virtual ~GmshModule() = default;
  /// Frontal-Delaunay triangles (gmsh's algorithm 6); all lines are edges of the mesh. Throws std::runtime_error
  /// "gmsh failed to <what> (<gmsh's words>)".
  virtual PlanarTriangles triangles(const PlanarLines& lines) const = 0;
  /// Delaunay tetrahedra (gmsh's algorithm 1); all surfaces are faces of the mesh, and nodes at the rim of an ellipse
  /// lie on it. Throws std::runtime_error as above.
  virtual Tetrahedra tetrahedra(const CutBox& box) const = 0;
};

}  // namespace sprekk
