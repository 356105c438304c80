// The singular field at the tip of a crack in an interaction region.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/mesh/interaction_region.hpp"

namespace sprekk::poromechanics {

/// Displacement and stress of modes I and II next to the tip of a straight crack with free walls, in even isotropic
/// rock under plane strain: Williams' terms of order sqrt(r) (Anderson, Fracture Mechanics, Tables 2.1 and 2.2), for
/// stress-intensity factors of 2 G sqrt(2 pi).
///
/// A local problem with linear displacements takes the traction ahead of the tip from a place half a cell away, where
/// it is half of its mean: the crack behaves like a longer one, slipping by 0.4 edge lengths at each end. So what the
/// local problem returns is corrected by what it misses of these two fields; how much of them there is, the
/// displacements of the cells around tell. Linear displacements contain none of them and stay exact.
class TipField {
 public:
  /// None unless the node of the region is the tip of one crack in rock that is isotropic and the same all around, with
  /// cells enough to tell the fields from linear displacements. `cells`: of the region, in its order.
  static std::optional<TipField> find(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
                                      const std::vector<Stiffness>& stiffness);

  /// To the coefficients of a quantity with respect to the displacements (x, y) of the cells adds what makes it exact
  /// for both fields, for which its values are `exact`.
  void correct(double* coefficients, const Point& exact) const;

  /// Of both modes: a component of the force on a subface, with the normal out of its first cell, N/m.
  Point force(int subface, int component) const;
  /// Of both modes, a column each: the displacement of a subcell's centre, m.
  Eigen::Matrix2d displacement(int subcell) const;

 private:
  TipField(const Mesh& mesh, const InteractionRegion& region, const Stiffness& stiffness, int node, int wall);
  bool fit(std::span<const int> cells);

  const Mesh& mesh_;
  const InteractionRegion& region_;
  double shear_, poisson_;     ///< Pa, 1
  Point tip_;                  ///< m
  Eigen::Matrix2d axes_;       ///< columns: ahead of the tip, and that turned by +90 degrees
  double size_;                ///< m, of the wall at the tip
  Eigen::MatrixX2d at_cells_;  ///< displacements of the fields
  Eigen::Matrix2Xd share_;     ///< of the fields in given displacements
};

}  // namespace sprekk::poromechanics
