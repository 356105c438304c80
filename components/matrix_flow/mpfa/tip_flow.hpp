// The singular flow around the tip of a fracture.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "components/matrix_flow/flux_operators.hpp"
#include "components/matrix_flow/mpfa/limits.hpp"
#include "framework/discretization/end_frame.hpp"
#include "framework/mesh/adjacency.hpp"

namespace sprekk::matrix_flow {

/// Steady flow around the end of a straight fracture, with conjugate functions of z from the tip (Muskat, The Flow of
/// Homogeneous Fluids through Porous Media, 1937, ch. IV), two modes:
///   to a fracture along which the pressure is constant: p = Re sqrt(z), with a flux through its walls like 1/sqrt(r);
///   around a fracture that nothing flows through: p = Im sqrt(z), with a jump like sqrt(r).
/// In space these are flows in planes normal to the rim, constant along it. The amounts of the modes follow from the
/// pressures of the cells around the tip, by a least-squares fit of the modes and of linear pressures.
class TipFlow {
 public:
  /// One value for each of the two modes.
  using Modes = Eigen::RowVector2d;

  /// The flow around a tip (a node; in space of a rim). std::nullopt unless the rock at the tip is isotropic and nearly
  /// homogeneous (resembles), and the fit has enough cells to distinguish the modes from linear pressures. `cells`: the
  /// cells of the fit (cells_around_tips).
  static std::optional<TipFlow> find(const Mesh& mesh, int tip, const std::vector<int>& cells,
                                     const std::vector<Tensor>& mobility, const MpfaLimits& limits = {});

  const EndFrame& frame() const { return frame_; }
  Modes pressure(const Point& x, int side) const;  ///< Pa, for amounts of 1 Pa/m^0.5
  /// The flux through a face out of its first cell, for a mobility of 1 m^2/(Pa s), m^2/s (m^3/s in space).
  Modes flux(const Mesh& mesh, int face, int side) const;
  /// The same through the part of the face that is next to one of its nodes.
  Modes flux_at_node(const Mesh& mesh, int face, int node, int side) const;

  const Tensor& mobility() const { return mobility_; }      ///< the mean of the tip's cells
  const std::vector<int>& cells() const { return cells_; }  ///< of the fit, ascending
  /// Reduces the amounts of the modes to this part of the fitted ones.
  void scale(double part) { share_ *= part; }
  const Eigen::Matrix2Xd& share() const { return share_; }  ///< amounts of the modes by the cells' pressures, 1/m^0.5

 private:
  TipFlow(const Mesh& mesh, int tip, const std::vector<int>& cells, const Tensor& mobility);
  /// Of the modes beside linear functions of so many coordinates (ahead, to the left, along).
  bool fit(const Mesh& mesh, const MpfaLimits& limits, int coordinates);

  EndFrame frame_;
  Tensor mobility_;
  std::vector<int> cells_;
  Eigen::Matrix2Xd share_;
};

/// Whether a mobility is isotropic, to 1e-9 of its trace; false where it is zero.
bool is_isotropic(const Tensor& mobility);

/// Whether the entries of two mobilities differ by at most `alike` times the largest entry of `other`.
bool resembles(const Tensor& mobility, const Tensor& other, double alike = MpfaLimits().alike);

}  // namespace sprekk::matrix_flow
