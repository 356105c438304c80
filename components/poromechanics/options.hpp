// The parameters of the deformation of the rock.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/poromechanics/excavation.hpp"
#include "components/poromechanics/face_conditions.hpp"
#include "components/poromechanics/pinned_points.hpp"
#include "framework/assembly/step_time.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::poromechanics {

/// The condition on one side: a displacement or a traction in each direction; a direction without either is free of
/// traction. Normal and shear stress act in addition to tractions. Displacements are either along the coordinates or
/// along the normal and the tangent of each face (ConditionAxes); in space tangents have no names.
struct SideCondition {
  Origin origin;
  std::optional<VectorData> displacement;                           ///< m
  std::array<std::optional<Data>, dimension> displacement_along;    ///< m; displacement_x, displacement_y, …
  std::array<std::optional<Data>, dimension> displacement_of_face;  ///< m; displacement_normal, displacement_tangential
  std::optional<VectorData> traction;                               ///< Pa
  std::array<std::optional<Data>, dimension> traction_along;        ///< Pa
  std::optional<Data> normal_stress;                                ///< Pa, tension positive
  std::optional<Data> shear_stress;                                 ///< Pa, along the tangent of a plane
  std::optional<Data> spring_normal, spring_tangential;             ///< Pa/m, see Springs

  ConditionAxes axes() const;
  /// The displacement of a direction of axes(), if it is prescribed.
  const Data* displacement_of(int direction) const;
  /// The total traction during a step on a face with this outward unit normal (Pa).
  Point traction_in(const StepTime& step, const Place& place, const Point& normal) const;
  bool depends_on_time() const;
  bool has_spring() const { return spring_normal || spring_tangential; }
  /// The resistance against displacements on a face with this outward unit normal, Pa/m.
  Tensor spring_at(const Place& place, const Point& normal) const;
  /// All that is given, but for springs.
  std::vector<const Data*> data() const;
};

/// Stiffness of an anisotropic rock, in plane strain or in space, Pa: rows and columns as a Stiffness has them.
struct AnisotropicStiffness {
  static constexpr int entries = symmetric_components * (symmetric_components + 1) / 2;
  /// Entry (row, column), row <= column, is number_of(row, column): the diagonal, then row by row what is to its right.
  std::array<Data, entries> entry;
  static constexpr int number_of(int row, int column) {
    if (row == column) return row;
    int number = symmetric_components;
    for (int above = 0; above < row; ++above) number += symmetric_components - 1 - above;
    return number + column - row - 1;
  }
};

/// Parameters of the deformation of the rock.
struct Options {
  std::optional<Data> young_modulus;  ///< Pa
  std::optional<Data> poisson_ratio;
  AnisotropicStiffness stiffness;
  bool is_anisotropic = false;
  std::optional<Data> bulk_modulus;  ///< Pa, of an anisotropic rock
  Data rock_density;                 ///< kg/m^3
  VectorData gravity;                ///< m/s^2
  VectorData body_force;             ///< N/m^3
  TensorData initial_stress;         ///< Pa
  std::map<std::string, SideCondition> boundary;
  PinnedPoints pinned;
  ExcavatedRegions excavation;
  double large_strain = 0.01;  ///< from where on a note says that the theory of small strains ends
  /// The data of all loads but the initial stress: those of the boundary, body force, density and gravity.
  std::vector<const Data*> loads() const;
  bool loads_depend_on_time() const;
  bool has_body_force() const;
  /// The weight and the body force of rock that is whole, during a step, N/m^3.
  Point body_force_in(const StepTime& step, const Place& place) const;
  /// The initial stress at a place, Pa.
  SymmetricTensor initial_stress_at(const Place& place) const;
  /// `type`, `doc`: of the component with its discretization.
  Spec spec(const std::string& type, const std::string& doc);

 private:
  void declare_stiffness(Spec& spec);
};

}  // namespace sprekk::poromechanics
