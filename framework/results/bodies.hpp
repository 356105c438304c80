// The bodies of a grid in space, and values between their centres.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "framework/output/vtk_module/vtk_module.hpp"

namespace sprekk {

/// The tetrahedra, wedges and hexahedra of a grid, as its file has them, and what they touch. A face with four corners
/// is taken for the triangles between its edges and the mean of its corners, so that bent faces leave no gap. The grid
/// must outlive this object.
class Bodies {
 public:
  explicit Bodies(const GridData& grid);

  int count() const { return grid_.cell_count(); }
  const Eigen::Vector3d& centre(int body) const { return centres_[body]; }  ///< of gravity, m
  double volume(int body) const { return volumes_[body]; }                  ///< m^3
  /// The body that holds a place; nothing outside of all.
  std::optional<int> holding(const Eigen::Vector3d& place) const;
  /// The value at a place of a body, from those of all bodies at their centres: with the gradient that fits the bodies
  /// around best (least squares). Not across fractures, at which bodies share no nodes, nor into another region.
  double value_at(const std::vector<double>& values, int body, const Eigen::Vector3d& place) const;

 private:
  using Corners = std::array<Eigen::Vector3d, 4>;
  std::vector<Corners> tetrahedra_of(int body) const;
  void join_bodies();
  void fill_boxes();
  std::array<int, 3> box_at(const Eigen::Vector3d& place) const;
  std::vector<int> around(int body) const;

  const GridData& grid_;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<double> volumes_;
  std::vector<std::vector<int>> beside_;
  // Boxes that cover the grid, with the bodies that touch each.
  Eigen::Vector3d low_, box_;
  std::array<int, 3> boxes_{};
  std::vector<std::vector<int>> in_box_;
};

}  // namespace sprekk
