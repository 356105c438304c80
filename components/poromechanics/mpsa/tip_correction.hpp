// What a local problem misses of the field at the tip of a crack.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "components/poromechanics/mpsa/tip_field.hpp"
#include "framework/discretization/interaction_region.hpp"

namespace sprekk::poromechanics {

/// A local problem with linear displacements takes the traction ahead of a tip from a place half a cell away, where it
/// is half of its mean: the crack behaves like a longer one, slipping by 0.4 edge lengths at each end, and the
/// tractions of walls nearby zigzag. So to what a local problem returns is added what it misses of the field at the
/// tip, whose amount the displacements of the cells near the tip tell, or the part of it that the weight says
/// (TipZones). Linear displacements contain none of it and stay exact.
class TipCorrection {
 public:
  /// `cells`: the local ones, which the coefficients belong to, ascending; the field's are among them.
  TipCorrection(const TipField& field, double weight, const Mesh& mesh, const InteractionRegion& region, int node,
                std::span<const int> cells, const std::vector<Stiffness>& stiffness);

  // To the coefficients of a quantity with respect to the displacements (x, y) of the cells these add what makes it
  // exact for the field.
  void of_force(double* coefficients, int subface, int component) const;
  void of_displacement(double* coefficients, int subface, int component) const;  ///< on walls
  void of_volume_change(double* coefficients, int subcell) const;

  /// Adds the moment of the field's traction on an inner subface (StressOperators::moment_displacement).
  void add_moment(std::vector<Triplet>& moments, int subface, double weight) const;

 private:
  double sign_of(int face) const;  ///< of forces of the left of lines from the node, seen as those on the face
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
