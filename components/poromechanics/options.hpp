// The parameters of the deformation of the rock.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/poromechanics/excavation.hpp"
#include "components/poromechanics/face_conditions.hpp"
#include "framework/assembly/step_time.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::poromechanics {

/// The condition on one side: a displacement or a traction in each direction; a direction without either is free of
/// traction. Normal and shear stress act in addition to tractions. Displacements are either along x and y or along the
/// normal and the tangent of each face (ConditionAxes).
struct SideCondition {
  Origin origin;
  std::optional<VectorData> displacement;                   ///< m
  std::array<std::optional<Data>, 2> displacement_along;    ///< m; displacement_x, displacement_y
  std::array<std::optional<Data>, 2> displacement_of_face;  ///< m; displacement_normal, displacement_tangential
  std::optional<VectorData> traction;                       ///< Pa
  std::array<std::optional<Data>, 2> traction_along;        ///< Pa
  std::optional<Data> normal_stress;                        ///< Pa, tension positive
  std::optional<Data> shear_stress;                         ///< Pa, along the tangent

  ConditionAxes axes() const;
  /// The displacement of a direction of axes(), if it is prescribed.
  const Data* displacement_of(int direction) const;
  /// The total traction during a step on a face with this outward unit normal (Pa).
  Point traction_in(const StepTime& step, const Place& place, const Point& normal) const;
  bool depends_on_time() const;
  /// All that is given.
  std::vector<const Data*> data() const;
};

/// Plane-strain stiffness of an anisotropic rock, Pa.
struct AnisotropicStiffness {
  Data xxxx, yyyy, xyxy, xxyy, xxxy, yyxy;
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
  ExcavatedRegions excavation;
  double large_strain = 0.01;  ///< from where on a note says that the theory of small strains ends
  /// The data of all loads but the initial stress: those of the boundary, body force, density and gravity.
  std::vector<const Data*> loads() const;
  bool loads_depend_on_time() const;
  bool has_body_force() const;
  /// The weight and the body force of rock that is whole, during a step, N/m^3.
  Point body_force_in(const StepTime& step, const Place& place) const;
  /// The initial stress at a place, Pa, (xx, yy, xy).
  SymmetricTensor initial_stress_at(const Place& place) const;
  /// `type`, `doc`: of the component with its discretization.
  Spec spec(const std::string& type, const std::string& doc);

 private:
  void declare_stiffness(Spec& spec);
};

}  // namespace sprekk::poromechanics
