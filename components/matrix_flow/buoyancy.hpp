// The weight of a fluid whose density varies, in fluxes and in pressures at walls.
#pragma once

#include <array>
#include <vector>

#include "components/capabilities/fluid_density.hpp"
#include "components/matrix_flow/flux_operators.hpp"
#include "framework/assembly/linear_expression.hpp"
#include "framework/config/data.hpp"

namespace sprekk::matrix_flow {

/// The contribution of the excess d of a density over a constant one to the fluxes and traces of FluxOperators. Each
/// row of these matrices is applied to pressures minus the pressure of a fluid at rest, relative to a place y,
///   P(x) = (d(y) + d(x))/2 g·(x − y),
/// whose density is linear between y and x. y is the midpoint of the centres of the two cells at a face, or the centre
/// of its only cell; d(y) is the mean of d in these cells. So a fluid at rest whose density is linear with height stays
/// at rest to round-off, on every mesh and with every discretization; others have an error of second order. All terms
/// are linear in the densities of cells, at prescribed pressures and at walls.
class Buoyancy {
 public:
  Buoyancy(const Mesh& mesh, const VectorData& gravity, double constant_density, const FluidDensity& in_rock,
           const FluidDensity* in_fractures);

  /// Computes the matrices again for operators that have changed. `leaky_sides`: one flag a face, or none.
  void discretize(const FluxOperators& operators, const std::vector<FlowCondition>& conditions,
                  const std::vector<char>& leaky_sides);
  /// Evaluates the density at sides whose pressures are given (one a face, Pa).
  void begin_step(const std::vector<FlowCondition>& conditions, const Vector& boundary_pressure);

  /// The contribution of the excess d to a quantity on faces: cells · d + of_boundaries.
  struct Rows {
    SparseMatrix cells;         ///< faces × cells
    SparseMatrix boundaries;    ///< faces × faces, applied to d at prescribed pressures
    SparseMatrix walls;         ///< faces × fracture cells, applied to d at walls
    Vector of_boundaries = {};  ///< boundaries · d, in this step
  };
  const Rows& flux() const { return flux_; }                       ///< m^2/s
  const std::array<Rows, 2>& limited() const { return limited_; }  ///< of FluxOperators::limited, m^2/s
  const Rows& continuity() const { return continuity_; }           ///< of FacePressureOperators, m^2/s

  Vector excess(FluidDensity::State state) const;  ///< d, kg/m^3, one a cell
  FluidDensity::Version version(FluidDensity::State state) const { return in_rock_.version(state); }
  std::vector<FluidDensity::Derivative> derivatives() const { return in_rock_.derivatives(); }

  /// Adds what the density contributes to the pressure at walls (one a wall), linearized about the current state:
  /// values and derivatives are right as long as `wall_versions` stays the same.
  void add_to_walls(LinearExpression& expression) const;
  std::array<FluidDensity::Version, 2> wall_versions() const;
  /// The same for the pressure at leaky sides, one a face of the mesh.
  void add_to_sides(LinearExpression& expression, const std::vector<char>& leaky_sides) const;

 private:
  class RowMaker;
  void add_linearized(LinearExpression& expression, const SparseMatrix& matrix, const FluidDensity& density) const;

  const Mesh& mesh_;
  VectorData gravity_;
  double constant_density_;
  const FluidDensity& in_rock_;
  const FluidDensity* in_fractures_;
  Rows flux_, continuity_, trace_;
  std::array<Rows, 2> limited_;
};

}  // namespace sprekk::matrix_flow
