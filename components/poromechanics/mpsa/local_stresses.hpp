// The forces around one node: the local problem of the MPSA-W method with pressure.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "components/poromechanics/mpsa/limits.hpp"
#include "components/poromechanics/mpsa/volume_exchange.hpp"
#include "components/poromechanics/mpsa/weak_symmetry.hpp"
#include "components/poromechanics/stress_operators.hpp"
#include "framework/discretization/interaction_region.hpp"

namespace sprekk::poromechanics {

class TipCorrection;

/// Nodes with more cells than this have enough of them to hold their rotations, whatever is given on their faces.
inline constexpr int few_subcells = dimension == 2 ? 1 : 3;

/// The cells of a node with few cells, and cells nearby whose displacements theirs continue: in a plane those across
/// the faces that do not touch the node, if any; in space as far through faces as it takes for the centres to determine
/// a gradient. Ascending.
std::vector<int> cells_and_beyond(const Mesh& mesh, int node, const MpsaLimits& limits = {});

/// Solves the local problem of an interaction region (Nordbotten 2016, sec. 3). The displacement is linear in every
/// subcell. Displacements agree at the continuity points; forces, (C : grad u − s I) times the normal, agree on the
/// subfaces, or differ by the load on the face. Coefficients are with respect to, in this order: the displacements of
/// the local cells (all components of each), their isotropic stresses s, and the boundary values of the subfaces with
/// one cell or a load (one for each direction of their conditions; for whole faces).
///
/// With a symmetric stress alone, the rotations of subcells are not determined well. They are coupled by an energy
/// ½ strength |rho|^2 for each inner subface. rho (see RotationJump) is the jump of the rotation, without the jump that
/// two rocks in contact have in equilibrium. rho is zero for displacements that are linear in each of two layers, for
/// any stiffness, pressure and direction of these, and does not depend on the direction of the axes. Each face acts on
/// its two subcells by opposite couples, so the moments of the forces around a node are those of symmetric stresses.
/// (Keilegavlen and Nordbotten 2017 use the mean of the transposed gradient around the node, which is not exact for
/// such layers.)
///
/// The volume change of a subcell is that of these displacements, plus what it exchanges with its neighbours (see
/// VolumeExchange). The exchange does not enter forces and displacements.
///
/// Near the tip of a crack the displacement is not linear but like sqrt(r): see Tips.
///
/// In a plane, a region of a single subcell has only the conditions on its two faces. These may leave a rotation or
/// shear open, or determine a stress by the difference of nearly equal forces: at a corner between a roller and the
/// chord of a loaded curved side, the error of the chord's normal would determine the stress along the side. Components
/// of the gradient that the conditions do not determine well continue the displacement of the cells across (one for a
/// triangle, two for a quadrilateral), which keeps the method exact for linear displacements. In a cell without any
/// neighbour they are zero.
///
/// In space, a single subcell may turn freely, and two or three subcells together about the line through their centres,
/// where tractions are given on their faces, or rollers. Rotations that move no prescribed displacement are coupled to
/// that of the linear displacement that fits the displacements of the cells nearby best (HeldTurn), which is exact for
/// linear displacements.
class LocalStresses {
 public:
  explicit LocalStresses(const MpsaLimits& limits = {}) : limits_(limits) {}

  /// Throws std::runtime_error if the local system is singular for another reason.
  void solve(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
             const std::vector<Stiffness>& stiffness, const std::vector<FaceConditions>& conditions);
  /// In a plane: adds the correction for a tip nearby. To be called after `solve`, for a crack with traction on its
  /// walls.
  void correct(const InteractionRegion& region, const TipCorrection& tip);

  int stress_column() const { return dimension * cells_; }
  int boundary_column() const { return (dimension + 1) * cells_; }

  /// A component of the displacement at the continuity point of a subface (m).
  const double* displacement(int subface, int component) const {
    return system_.data() + (dimension * subface + component) * width_ + dimension * subfaces_;
  }
  /// A component of the force on a subface, with the normal out of its first cell (N/m; N in space).
  const double* force(int subface, int component) const {
    return forces_.data() + (dimension * subface + component) * columns_;
  }
  /// div u integrated over a subcell (m^2; m^3 in space), after exchange with its neighbours.
  const double* volume_change(int subcell) const { return volumes_.data() + subcell * columns_; }

 private:
  void find_jumps(const InteractionRegion& region, const std::vector<Stiffness>& stiffness, double least_strength);
  void find_axes(const Mesh& mesh, const InteractionRegion& region, const std::vector<FaceConditions>& conditions);
  /// The row of the system for a direction of the conditions on a subface: that of the axis which is nearest. So no
  /// diagonal is small, and rows are exchanged for the rock's sake only (see eliminate).
  int row_of(int subface, int direction) const { return dimension * subface + row_[subface][direction]; }
  /// Turns the balance of a subface from the axes into the directions of its conditions.
  void turn_balance(int subface);
  void assemble(const InteractionRegion& region, const std::vector<FaceConditions>& conditions);
  /// Adds to a row of the system a function of a subcell's gradient. What stands at the columns of given values is on
  /// the other side of the equation.
  void add_gradient(const InteractionRegion& region, double* row, int subcell, const GradientRow& function) const;
  void add_held(const InteractionRegion& region, const HeldTurn& held);
  /// For a region of at most `few_subcells`.
  void solve_few(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
                 const std::vector<Stiffness>& stiffness, const std::vector<FaceConditions>& conditions);
  void find_gradients(const InteractionRegion& region);
  void find_forces(const InteractionRegion& region, const std::vector<Stiffness>& stiffness);
  /// Values that are prescribed along a face's own axes hold exactly, whatever the local problem gives.
  void prescribe_forces(const InteractionRegion& region, const std::vector<FaceConditions>& conditions);
  void exchange_volumes(const Mesh& mesh, const InteractionRegion& region, const std::vector<Stiffness>& stiffness);

  /// Adds factor times the jump across an inner subface to a row of coefficients. After find_gradients.
  void add_jump(const InteractionRegion& region, int subface, const GradientJump& jump, double factor,
                double* row) const;

  /// The force on a subface of a subcell from the stress that a unit jump of a rotation across another one causes
  /// there.
  Point couple_on(const InteractionRegion& region, int subface, int rotation, int subcell,
                  const Point& half_face) const;

  int column(int subcell) const { return column_[subcell]; }

  MpsaLimits limits_;
  int subcells_ = 0, cells_ = 0, subfaces_ = 0, columns_ = 0, width_ = 0;
  std::vector<int> column_;             ///< of the subcells: places of their cells among the local ones
  std::vector<GradientMap> stress_;     ///< of the subcells
  std::vector<RotationJump> jump_;      ///< of the subfaces; of inner ones only
  std::vector<GradientJump> dilation_;  ///< likewise
  VolumeExchange exchange_;
  std::vector<int> load_column_;                 ///< of the subfaces: place of their boundary values, or none
  std::vector<Tensor> axes_;                     ///< of the subfaces: the directions of their conditions, in columns
  std::vector<std::array<int, dimension>> row_;  ///< of the subfaces: see row_of
  std::vector<HeldTurn> held_;
  std::vector<double> system_;             ///< the rows of [A B], then of [I A^-1 B]
  std::vector<double> gradients_;          ///< a row for each entry of each subcell
  std::vector<double> turns_;              ///< rho of the subfaces, a row for each component
  std::vector<double> jumps_, exchanged_;  ///< y of the exchange, and E y
  std::vector<double> forces_, volumes_;
};

}  // namespace sprekk::poromechanics
