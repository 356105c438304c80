// Values of fracture cells as a function of the length along the fracture.
#pragma once

#include <array>
#include <optional>

#include "couplers/two_level/plane/jump_at_junction.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// Interpolates values of cells along a fracture. On a straight piece of the fracture values are linear between the
/// centres of cells; beyond the outermost centres of a piece they are constant, so that values are not mixed across a
/// kink or a junction with other fractures.
class AlongFracture {
 public:
  AlongFracture(const Mesh& mesh, int fracture);

  /// The (normal, tangential) values of all fracture cells of the mesh, at s (m), in global components.
  Point at(double s, const Vector& values) const;
  int index_at(double s) const { return cells_[cell_at(s)].index; }  ///< of the fracture cell at s (m)
  /// As `at`, for displacement jumps: they decrease linearly to 0 at tips, and are 0 beyond. Towards a junction they
  /// change linearly to their value there (JumpAtJunction).
  Point jump(double s, const Vector& values) const;

 private:
  /// A cell of the fracture in the order along it.
  struct Cell {
    int index;
    double begin, end;   ///< m
    bool continues;      ///< whether the next cell has the same direction
    FractureCell frame;  ///< the cell, for its normal and tangent
    /// At its beginning and its end, where that is a junction.
    std::array<std::optional<JumpAtJunction>, 2> at_junction;
  };
  Point vanishing_at_tips(double s, const Vector& values) const;
  std::size_t cell_at(double s) const;

  std::vector<Cell> cells_;
  bool tip_at_first_, tip_at_last_;
};

}  // namespace sprekk::couplers
