// Capabilities of the flow in the fractures.
#pragma once

#include <utility>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

class MatrixFluid;
class MatrixWalls;

/// Capability: determines the pressure in the fractures from a balance of fluid volume, and accepts their aperture.
class FractureFluid {
 public:
  static constexpr const char* promise = "determines the pressure in the fractures";
  virtual ~FractureFluid() = default;
  /// The pressure of each fracture cell, Pa. Its equation is the volume that the cell stores during the step, less the
  /// volume that entered (m^2, in space m^3).
  virtual Field& pressure() = 0;
  /// Input: the aperture of each fracture cell, m; the initial aperture a0 (below Eq. 8 of the paper) unless a coupler
  /// determines it.
  virtual Field& aperture() = 0;
  virtual const Vector& initial_aperture() const = 0;
  /// The aperture below which a fracture is taken to be as wide as that, m: of walls that touch.
  virtual double least_aperture() const = 0;

  /// The permeability normal to the fracture, kappa = 2 K/(mu a^2) (below Eq. 9 of the paper), m/(Pa s), for each wall
  /// at the current aperture, and its derivative by the aperture.
  struct NormalPermeability {
    Vector value, by_aperture;
  };
  virtual NormalPermeability normal_permeability() const = 0;

  /// Replaces the viscosity of the scene, Pa s, one a fracture cell. To be called by Part::evaluate_data, in every
  /// step.
  virtual void change_viscosity(const Vector& viscosity) = 0;

  /// The viscosity in a fracture cell whose transmissivity follows from its opening (w^3/(12 mu) where it is wide),
  /// Pa s; 0 where the transmissivity does not depend on the opening.
  virtual double viscosity_between_walls(int cell) const = 0;
  /// The conductance of a fracture cell at the current aperture: in a plane that from end to end, m^2/(Pa s); in space
  /// transmissivity over viscosity, m^3/(Pa s). To be used after Part::evaluate_data of all parts.
  virtual double conductance(int cell) const = 0;
  /// The cells among which fluid that enters at a point of a fracture cell is shared, and their shares, which add up to
  /// 1: the flow from the point to the centres along fractures, at the current apertures. The shares of a step are
  /// those at its start: to be called by Part::begin_step.
  virtual std::vector<std::pair<int, double>> shares_at(int cell, const Point& at) const = 0;
  /// By how much the pressure at the point exceeds the mean of these cells' pressures, weighted by their shares, for
  /// each unit of a rate at the point: Pa s/m^2 (in space Pa s/m^3), at the current aperture, with derivatives by the
  /// apertures of cells.
  struct Rise {
    double value = 0;
    std::vector<std::pair<int, double>> by_aperture = {};
  };
  virtual Rise rise_at(int cell, const Point& at) const = 0;
  /// The part of the aperture of a fracture cell that has fluid in it: 1, unless the pressure has a lower bound.
  virtual double filled_part(int cell) const = 0;
  /// Whether there is a flow in a fracture cell. Where there is none, the fracture is dry: its pressure is zero,
  /// nothing passes through its walls, and no part may add anything to the row of the cell.
  virtual bool is_in_fracture_cell(int /*cell*/) const { return true; }
  /// Whether the pressure follows the aperture: not with a given transmissivity, nor where all of it is prescribed.
  virtual bool follows_aperture() const = 0;
  /// The fluid of the rock, which leaves and enters through the walls, and its pressure there; nullptr where they are
  /// sealed. To be accepted while the scene is built; both must outlive this object.
  virtual void accept_rock_fluid(MatrixFluid& rock_fluid, const MatrixWalls& walls) = 0;
  virtual MatrixFluid* rock_fluid() const = 0;
  virtual const MatrixWalls* rock_walls() const = 0;
  /// The place that shares_at and rise_at use for a point, m: beyond the last centre before an end it is that centre.
  virtual Point point_at(int cell, const Point& at) const = 0;
};

}  // namespace sprekk
