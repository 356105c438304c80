// The conforming mixed-dimensional mesh: the cells of the matrix, the cells of the fractures that lie on its faces, and
// the two walls of every fracture cell.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/mesh/adjacency.hpp"
#include "framework/mesh/shapes.hpp"
#include "framework/types.hpp"

namespace sprekk {

inline constexpr int none = -1;

/// The two sides of a fracture, as seen by its normal, which points from `plus` to `minus` (sec. 2.2 of the paper).
enum class Wall { plus = 0, minus = 1 };

/// One cell of a fracture grid. The matrix is split along the cell, which has two matrix faces with equal corners.
struct FractureCell {
  int fracture;              ///< index into Mesh::fractures
  std::array<int, 2> faces;  ///< the matrix faces that are its walls, by Wall; each has one cell, face_cells[f][0]
  /// What is around the cell, as indices into Mesh::ridges: in a plane its ends along the direction of the polyline, in
  /// space its edges, in their order around it. At a junction it is the ridge between this cell and its neighbour in
  /// its fracture; where the fracture ends at the junction, the first ridge there that belongs to this cell.
  FaceRidges ridges;
  Point center;
  double measure;  ///< length, m (area in three dimensions, m^2)
  Point normal;    ///< unit, from the plus to the minus side
  /// Unit; (normal, tangents) is a right-handed frame, see tangents_of. In a plane from ridges[0] to ridges[1].
  Tangents tangents;
  bool grown = false;  ///< whether the cell has grown during the run

  /// m: its length, in space the side of a square of its area.
  double size() const { return dimension == 2 ? measure : std::sqrt(measure); }

  /// A vector in the frame of the cell, (normal, tangential), as fields on fracture cells have them.
  Point to_local(const Point& global) const {
    Point local;
    for (int k = 0; k < dimension; ++k) {
      const double* axis = k == 0 ? normal.data() : tangents.data() + (k - 1) * dimension;
      double along = global[0] * axis[0];
      for (int i = 1; i < dimension; ++i) along += global[i] * axis[i];
      local[k] = along;
    }
    return local;
  }
  /// The reverse.
  Point to_global(const Point& local) const {
    Point global;
    for (int i = 0; i < dimension; ++i) {
      double along = local[0] * normal[i];
      for (int k = 1; k < dimension; ++k) along += local[k] * tangents.data()[(k - 1) * dimension + i];
      global[i] = along;
    }
    return global;
  }
};

/// What lies between two fracture cells, or ends a fracture: a point in a plane, an edge in space.
struct Ridge {
  /// inside: between neighbours in a fracture; tip: an end in the rock; on_boundary: an end on the outer boundary;
  /// junction: between two of the cells that meet where fractures touch or cross.
  enum class Kind { inside, tip, on_boundary, junction };
  Point center;
  double measure;          ///< length, m; 1 for a point
  std::vector<int> cells;  ///< one for tip and on_boundary, else two, in ascending order
  Kind kind;
  int side;  ///< the boundary side (index into Mesh::side_names) for on_boundary, else none
};

/// A place where fractures touch or cross. It has a ridge for each pair of its cells, so that each flux from one cell
/// to another belongs to one ridge; all of them are at the same place.
struct Junction {
  std::vector<int> cells;   ///< the fracture cells that meet here, in ascending order; at least two
  std::vector<int> ridges;  ///< indices into Mesh::ridges
};

/// A fracture: fracture cells with consecutive numbers, in a plane those of a polyline.
struct Fracture {
  std::string name;
  int first_cell;  ///< its cells are first_cell … first_cell + cell_count - 1; in a plane along the polyline
  int cell_count;
};

/// All of the topology and geometry that discretizations read. Lengths in m.
struct Mesh {
  // Matrix. Nodes, faces and cells are numbered from 0; nodes on fractures exist once per side (tips exist once).
  std::vector<Point> nodes;
  std::vector<CellNodes> cell_nodes;           ///< the corners, in the order of the shape (see Shape)
  std::vector<CellFaces> cell_faces;           ///< in the order of the shape
  std::vector<FaceNodes> face_nodes;           ///< as the shape of face_cells[f][0] has them
  std::vector<std::array<int, 2>> face_cells;  ///< [1] is none on the outer boundary and on walls
  std::vector<Point> cell_center;              ///< the centre of gravity
  std::vector<double> cell_measure;            ///< areas, m^2 (volumes in three dimensions, m^3)
  std::vector<Point> face_center;
  std::vector<double> face_measure;  ///< lengths, m (of area vectors in three dimensions, m^2)
  std::vector<Point> face_normal;    ///< unit, out of face_cells[f][0]; times the measure, the area vector
  Adjacency node_cells;              ///< the cells at a node, in ascending order
  Adjacency node_faces;              ///< the faces at a node, in ascending order

  std::vector<int> face_side;  ///< index into side_names on the outer boundary; none inside and on walls
  std::vector<std::string> side_names;
  std::vector<int> cell_region;  ///< index into region_names
  std::vector<std::string> region_names;

  // Fractures.
  std::vector<Fracture> fractures;
  std::vector<FractureCell> fracture_cells;
  std::vector<Ridge> ridges;
  std::vector<Junction> junctions;
  std::vector<int> face_fracture_cell;  ///< the fracture cell whose wall the face is, or none

  // Distribution: the rank that owns (assembles the rows of) each cell. All 0 in a single process.
  std::vector<int> cell_rank;

  std::uint64_t version = 0;  ///< changes whenever the mesh does

  int node_count() const { return static_cast<int>(nodes.size()); }
  int cell_count() const { return static_cast<int>(cell_nodes.size()); }
  int face_count() const { return static_cast<int>(face_nodes.size()); }
  int fracture_cell_count() const { return static_cast<int>(fracture_cells.size()); }
  /// Walls are numbered 2 i + side for fracture cell i.
  int wall_count() const { return 2 * fracture_cell_count(); }
  int wall_face(int wall) const { return fracture_cells[wall / 2].faces[wall % 2]; }
  /// A fracture cell belongs to the rank of the matrix cell on its plus side.
  int fracture_cell_rank(int i) const { return cell_rank[face_cells[fracture_cells[i].faces[0]][0]]; }
};

}  // namespace sprekk
