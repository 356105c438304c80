// The singular field around the tip of a crack.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "components/poromechanics/mpsa/limits.hpp"
#include "components/poromechanics/stiffness.hpp"
#include "framework/discretization/end_frame.hpp"

namespace sprekk::poromechanics {

/// Whether a stiffness is isotropic, to 1e-9 of its entries.
bool is_isotropic(const Stiffness& stiffness);

/// Whether the entries of two stiffnesses differ by at most `alike` times the largest entry of `other`.
bool resembles(const Stiffness& rock, const Stiffness& other, double alike = MpsaLimits().alike);

/// Displacement and stress of modes I and II around the tip of a straight crack with free walls, in even isotropic rock
/// under plane strain: Williams' terms of the orders r^(1/2) and r^(3/2), by Muskhelishvili's potentials phi = a z^o
/// and psi = (conj(a) - o a) z^o with 2 a = 1 (mode I) and -i (mode II), in 2 G u = kappa phi - z conj(phi') -
/// conj(psi) for 2 G = 1. So those of order r^(1/2) have stress-intensity factors of 2 G sqrt(2 pi). The amounts of the
/// modes follow from the displacements of the cells near the tip, by a least-squares fit of the modes and of linear
/// displacements. `side`: see EndFrame.
class TipField {
 public:
  /// (x, y) of modes I and II of order r^(1/2), and of those of order r^(3/2).
  static constexpr int terms = 4;
  using Modes = Eigen::Matrix<double, 2, terms>;
  using Amounts = Eigen::Matrix<double, 1, terms>;  ///< one value each

  /// The field around a tip (a node). `cells`: those near the tip (EndZones::cells). std::nullopt unless the rock at
  /// the tip is isotropic and nearly the same all around (resembles), and there are enough cells to tell the modes from
  /// linear displacements. If the cells determine only the modes of order r^(1/2), the others are taken to be zero.
  static std::optional<TipField> find(const Mesh& mesh, int tip, std::span<const int> cells,
                                      const std::vector<Stiffness>& stiffness, const MpsaLimits& limits = {});

  const EndFrame& frame() const { return frame_; }
  /// The displacement, m.
  Modes displacement(const Point& x, int side) const;
  /// The force across any line from the tip to x, exerted by the left side on the right side, N/m.
  Modes force(const Point& x, int side) const;
  /// The force across lines from the tip, integrated over their ends x from a to b, N.
  Modes integrated_force(const Point& a, const Point& b, int side) const;
  /// div u integrated over a quadrilateral, m^2.
  Amounts volume_change(const std::array<Point, 4>& corners, int side) const;

  int tip() const { return tip_; }                          ///< the node
  const std::vector<int>& cells() const { return cells_; }  ///< the cells of the fit, ascending
  /// The amounts of the modes in displacements (x, y each) of these cells.
  const Eigen::Matrix<double, terms, Eigen::Dynamic>& share() const { return share_; }
  const Stiffness& rock() const { return rock_; }  ///< the mean of those at the tip

 private:
  TipField(const Mesh& mesh, int tip, std::vector<int> cells, const Stiffness& rock);
  bool fit(const Mesh& mesh, int count_of_terms, double well_posed);

  int tip_;
  std::vector<int> cells_;
  Stiffness rock_;
  double shear_, poisson_;  ///< Pa, 1
  EndFrame frame_;
  Eigen::Matrix<double, terms, Eigen::Dynamic> share_;
};

}  // namespace sprekk::poromechanics
