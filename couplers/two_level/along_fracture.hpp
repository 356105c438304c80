// Values of fracture cells as a function of the length along the fracture.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// Between the centres of cells on one straight piece of a fracture values are linear; beyond the outermost ones of a
/// piece they are constant, so that nothing is mixed across a kink.
class AlongFracture {
 public:
  AlongFracture(const Mesh& mesh, int fracture);

  /// The (normal, tangential) values of all fracture cells of the mesh, at s (m), in global components.
  Point at(double s, const Vector& values) const;
  /// The same, for values that vanish at the ends that are tips: linear to 0 there, and 0 beyond.
  Point vanishing_at_tips(double s, const Vector& values) const;

 private:
  struct Cell {
    int index;
    double begin, end;  ///< m
    bool continues;     ///< whether the next cell has its direction
    Point normal, tangent;
  };
  Point global(const Cell& cell, const Point& local) const { return local[0] * cell.normal + local[1] * cell.tangent; }
  std::size_t cell_at(double s) const;

  std::vector<Cell> cells_;
  bool tip_at_first_, tip_at_last_;
};

}  // namespace sprekk::couplers
