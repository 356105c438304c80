// The singular field around the tip of a crack.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/mesh/tip_frame.hpp"

namespace sprekk::poromechanics {

/// Whether the entries of a stiffness are those of the other to 20 % of its largest.
bool resembles(const Stiffness& rock, const Stiffness& other);

/// Displacement and stress of modes I and II around the tip of a straight crack with free walls, in even isotropic rock
/// under plane strain: Williams' terms of order sqrt(r) (Anderson, Fracture Mechanics, Tables 2.1 and 2.2), for
/// stress-intensity factors of 2 G sqrt(2 pi). How much of them there is, the displacements of the cells at the tip
/// tell: by least squares, beside linear displacements.
/// `side`: see TipFrame.
class TipField {
 public:
  /// Of both modes, a column each.
  using Modes = Eigen::Matrix2d;

  /// None unless the rock at the tip (a node) is isotropic and nearly the same all around (resembles), with cells
  /// enough to tell the fields from linear displacements.
  static std::optional<TipField> find(const Mesh& mesh, int tip, const std::vector<Stiffness>& stiffness);

  const TipFrame& frame() const { return frame_; }
  /// The displacement, m.
  Modes displacement(const Point& x, int side) const;
  /// What the left of any line from the tip to x exerts on its right, N/m.
  Modes force(const Point& x, int side) const;
  /// That force integrated over the line from a to b, N.
  Modes integrated_force(const Point& a, const Point& b, int side) const;
  /// div u integrated over a quadrilateral, m^2.
  Eigen::RowVector2d volume_change(const std::array<Point, 4>& corners, int side) const;

  std::span<const int> cells() const { return cells_; }  ///< those at the tip, ascending
  /// The modes in displacements (x, y each) of these cells.
  const Eigen::Matrix2Xd& share() const { return share_; }
  const Stiffness& rock() const { return rock_; }  ///< the mean of the tip's cells

 private:
  TipField(const Mesh& mesh, int tip, const Stiffness& rock);
  bool fit(const Mesh& mesh);

  std::span<const int> cells_;
  Stiffness rock_;
  double shear_, poisson_;  ///< Pa, 1
  TipFrame frame_;
  Eigen::Matrix2Xd share_;
};

}  // namespace sprekk::poromechanics
