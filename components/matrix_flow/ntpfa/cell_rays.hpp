// Vectors from the centre of a cell to points with known pressures, and conormals as sums of such vectors.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "components/matrix_flow/flux_operators.hpp"

namespace sprekk::matrix_flow {

/// A vector from the centre of a cell to a point, and by how much the pressure there exceeds that of the cell:
///   own · (pressure of the cell) + of_cell · (pressure of `cell`) + of_boundary · b + of_change · s of `face`,
/// with b and s of FluxOperators. Exact for linear pressures, across a face at which the mobility jumps, too. Without
/// prescribed fluxes the excess is a nonnegative multiple of the difference from another pressure.
struct Ray {
  Point arrow;  ///< m
  double own = 0;
  int cell = none, face = none;
  double of_cell = 0;                     ///< nondimensional
  double of_boundary = 0, of_change = 0;  ///< nondimensional, or of a flux: Pa s/m^2
};

/// A sum of rays, with weights that are not negative.
using RaySum = std::vector<std::pair<double, Ray>>;

/// The rays of one cell: through its faces, and more where these do not suffice.
///
/// - Through an inner face: to its harmonic averaging point (Agélas, Eymard and Herbin, C. R. Acad. Sci. Paris, Ser. I
///   347 (2009) 673), where the pressure is a mean of those of both cells, with positive weights. If the mobility is
///   the same on both sides, that is the point between the centres of the cells, and no pressure is interpolated.
/// - To the centre of a face with a prescribed pressure.
/// - Along the conormal to the line of a face with a prescribed flux: this flux is the change of pressure there.
///
/// Where no two of these enclose the vector, further rays are used:
/// - to the ends of faces with a pressure, and against the conormals of faces with a flux;
/// - to the centres of cells that share a node and have a similar mobility, and of their faces with a pressure;
/// - at last to the centres of all cells that share a node.
class CellRays {
 public:
  CellRays(const Mesh& mesh, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions,
           int cell);

  /// The vector as the sum of two rays, or nothing where there are no such rays. Of all pairs it takes the one with the
  /// least sum of weighted lengths, in which distant points count more: as a rule the rays next to the vector on both
  /// sides.
  std::optional<RaySum> sum(const Point& vector) const;
  /// The same sum without rays against the conormal of `face`.
  std::optional<RaySum> sum_without_return(const Point& vector, int face) const;

 private:
  std::optional<RaySum> find(const Point& vector, int face_without_return) const;
  void add_ends();
  void add_cells();

  const Mesh& mesh_;
  const std::vector<Tensor>& mobility_;
  const std::vector<FlowCondition>& conditions_;
  int cell_;
  std::vector<Ray> near_, ends_, alike_, others_;
};

}  // namespace sprekk::matrix_flow
