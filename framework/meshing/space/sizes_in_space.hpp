// The wanted edge length of a mesh in space, as a function of place.
#pragma once

#include <vector>

#include "framework/meshing/space/flat_shape.hpp"

namespace sprekk {

/// The wanted edge length, m. It is the smallest of
/// - the far size;
/// - for each fracture, and each part of a side, its size plus growth times the distance from it;
/// - for the rim of each fracture, where it lies inside of the box, the tip size plus growth times the distance.
class SizesInSpace {
 public:
  /// The geometry is that of a box and valid, except that sizes may still be absurdly small.
  SizesInSpace(const Geometry& geometry, const MeshOptions& options);

  double at(const Point& x) const;
  double smallest() const;  ///< the smallest edge length anywhere, m
  /// About as many tetrahedra as the size field asks for: the integral of 6 sqrt(2) / h^3.
  double estimated_cells() const;

 private:
  struct Source {
    FlatShape shape;
    double size, rim_size;
    std::vector<Line> rim;  ///< edges that lie inside of the box, where they ask for another size
    Point low, high;        ///< of the bounding box of the shape
    int layers;             ///< of cells, on both sides of a fracture, or on the one inside of the box
  };
  Box box_;
  double far_size_, growth_;
  std::vector<Source> sources_;
};

}  // namespace sprekk
