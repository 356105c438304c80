// The geometry of a scene, and the options of its mesh.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/config/parameter.hpp"
#include "framework/mesh/partition.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// An axis-parallel rectangle, or box in space, from `low` to `high`, m.
struct Box {
  Point low = Point::Zero(), high = Point::Zero();
  Origin origin;
  Point size() const { return high - low; }
};

/// A flat ellipse in space, m. Its normal is one_axis × other_axis.
struct Ellipse {
  Point center, one_axis, other_axis;  ///< half axes at right angles
};

/// A fracture. In a plane it is a polyline, whose plus side is to the left on the way from the first point to the last.
/// In space it is a flat simple polygon, or an ellipse; the plus side is that from which its points turn clockwise, so
/// that the normal of the polygon points to the minus side.
struct FractureGeometry {
  std::string name;
  std::vector<Point> points;                  ///< m; none of an ellipse
  std::optional<double> size = std::nullopt;  ///< length of its cells, m; default MeshOptions::fracture_size
  Origin origin;
  std::vector<ColumnValue> values = {};           ///< further columns of its table
  std::optional<Ellipse> ellipse = std::nullopt;  ///< in space, instead of points
};

/// What lies on the side of a plane into which `normal` (of any length) points. `point` (m) is on the plane.
struct HalfSpace {
  Point point, normal;
};

/// A part of the box with a name, for properties of its own. In a plane it is a polygon; in space it is the
/// intersection of its half-spaces with the layer between its surfaces.
struct RegionGeometry {
  std::string name;
  std::vector<Point> polygon;  ///< m, simple, either orientation, not closed by a repeated point
  Origin origin;
  std::vector<HalfSpace> half_spaces = {};  ///< in space; the mesh conforms to their planes
  /// In space the height z (m) of its bottom and of its top at (x, y), or null; the mesh does not conform to them.
  std::function<double(double, double)> bottom = nullptr, top = nullptr;
};

/// The sides of a box, in the order of their axes: that of the smallest coordinate, then that of the largest.
inline constexpr auto box_sides = [] {
  if constexpr (dimension == 2)
    return std::array<const char*, 4>{"left", "right", "bottom", "top"};
  else
    return std::array<const char*, 6>{"left", "right", "front", "back", "bottom", "top"};
}();

/// A rectangle on a side of a box in space, with a name and conditions of its own.
struct SidePart {
  std::string name;
  int side = 0;     ///< index into box_sides
  Point low, high;  ///< m; along the axis of the side not used
  Origin origin;
  std::optional<double> size = std::nullopt;  ///< edge length on it, m; default as away from fractures
};

/// A box with fractures and regions in it, or a mesh file that holds everything. Region 0 of a box is what no region
/// covers; its name is medium_name(). Where regions overlap, the later one counts.
struct Geometry {
  Box box;
  std::string file;  ///< a mesh that gmsh reads, or "" for a box
  Origin file_origin;
  std::vector<FractureGeometry> fractures;
  std::vector<RegionGeometry> regions;
  std::vector<SidePart> side_parts;  ///< in space; their sides are those of what is left. They do not overlap
  /// Lines and points of a box that are nearer to one another are joined, m; default snap_length().
  std::optional<double> snap = std::nullopt;
  Origin snap_origin = {};

  bool is_imported() const { return !file.empty(); }
};

/// Parameters of a scene's `mesh:`.
struct MeshOptions {
  /// Triangles or tetrahedra by gmsh, or a grid.
  enum class Kind { unstructured, structured };
  Kind kind = Kind::unstructured;
  /// The shape of the cells.
  enum class Shape { triangles, quadrilaterals, tetrahedra, wedges, hexahedra };
  /// Unstructured quadrilaterals leave some triangles between them.
  Shape shape = dimension == 2 ? Shape::triangles : Shape::tetrahedra;
  /// Edge length away from fractures, m; default a fiftieth of the longer side, a twentieth in space.
  std::optional<double> size = std::nullopt;
  std::optional<double> fracture_size = std::nullopt;  ///< edge length at fractures, m; default `size`
  std::optional<double> tip_size = std::nullopt;  ///< edge length at fracture ends, m; default that of the fracture
  double growth = 0.3;                            ///< by how many m the edge length grows per m of distance
  /// Unstructured: in a gap between a fracture and another line, the edge length is at most the width of the gap over
  /// this; 0 does not refine in gaps. With 0.5, angles at ends stay above 18 degrees.
  double gap_edges = 0.5;
  double gap_length = 2;  ///< gaps between parallel walls are not refined if longer than so many times their width
  /// Least edge length in gaps, m; default a 500th of the shortest size, a 20th in space.
  std::optional<double> gap_size = std::nullopt;
  std::array<int, dimension> cells = {};  ///< structured: along each axis; 0: as many as `size` gives
  double distortion = 0;  ///< moves inner nodes by up to this part of the shortest edge at the node, 0 to 0.4
  int seed = 1;           ///< of the random distortion
  Division division = Division::compact;  ///< among processes
  Origin origin = {};
};

/// The edge length away from fractures, with the default resolved.
double far_size(const Geometry& geometry, const MeshOptions& options);

/// The edge length that the options ask for at a fracture, m.
double size_at(const FractureGeometry& fracture, const Geometry& geometry, const MeshOptions& options);

/// The shortest edge length that the options ask for, m, except for gaps.
double shortest_size(const Geometry& geometry, const MeshOptions& options);

/// Lines and points that are nearer to one another are joined, m: as the geometry says, by default a hundredth of the
/// shortest size.
double snap_length(const Geometry& geometry, const MeshOptions& options);

/// The longest distance between two points of a fracture, or the longer axis of an ellipse, m.
double extent_of(const FractureGeometry& fracture);

/// Points nearer than this are one point.
double point_tolerance(const Box& box);

}  // namespace sprekk
