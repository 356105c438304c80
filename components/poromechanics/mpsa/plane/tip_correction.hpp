// Corrects a local problem for the singular field at the tip of a crack.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "components/poromechanics/mpsa/plane/tip_field.hpp"
#include "framework/discretization/interaction_region.hpp"

namespace sprekk::poromechanics {

/// The difference between the singular field (TipField) and what a local problem with linear displacements makes of it.
/// A local problem takes the traction ahead of a tip from a place half a cell away, where the traction is half of its
/// mean. So the crack behaves like one that is longer by 0.4 edge lengths at each end, and the tractions of walls
/// nearby oscillate. Therefore this difference, times a weight (EndZones), is added to the results of a local problem.
/// The amount of the field is fitted to the displacements of the cells near the tip. The difference vanishes for linear
/// displacements, for which the method stays exact.
class TipCorrection {
 public:
  /// `cells`: the local cells that the coefficients belong to, ascending; the cells of the field are among them.
  TipCorrection(const TipField& field, double weight, const Mesh& mesh, const InteractionRegion& region, int node,
                std::span<const int> cells, const std::vector<Stiffness>& stiffness);

  // These functions add to the coefficients of a quantity, with respect to the displacements (x, y) of the cells, the
  // terms that make the quantity exact for the singular field.
  void of_force(double* coefficients, int subface, int component) const;
  void of_displacement(double* coefficients, int subface, int component) const;  ///< on walls
  void of_volume_change(double* coefficients, int subcell) const;

  /// Adds the moment of the field's traction on an inner subface (StressOperators::moment_displacement).
  void add_moment(std::vector<Triplet>& moments, int subface, double weight) const;

 private:
  /// The sign of the force by the left side of a line from the node, as a force on the face.
  double sign_of(int face) const;
  void add_missing(double* coefficients, const TipField::Amounts& exact) const;

  const TipField& field_;
  double weight_;
  const Mesh& mesh_;
  const InteractionRegion& region_;
  Point node_;
  int side_ = 0;                        ///< of the region; 0 at the tip itself
  double shear_ratio_ = 0;              ///< of the region's shear modulus to the tip's
  std::vector<int> own_, at_tip_;       ///< columns (of x) of the region's cells, and of the tip's
  std::vector<TipField::Modes> modes_;  ///< of the region's cells: their displacements
};

}  // namespace sprekk::poromechanics
