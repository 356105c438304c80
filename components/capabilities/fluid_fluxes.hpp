// Capabilities of flow: the fluxes of fluid, for what the fluid carries with it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "components/capabilities/flux_discretization.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// Fluid that enters from outside of rock and fractures at a named place of the scene (or with a negative rate leaves).
struct FluidSource {
  std::string name;
  std::vector<std::pair<int, double>> rates;  ///< cells, and m^2/s (in space m^3/s)
  /// Whether the rates are shares of one rate, at a point or along a line. Some may have the other sign: shares are
  /// those of a linear pressure. Otherwise each cell has a rate of its own.
  bool is_shared = false;
};

/// A named place whose pressure is prescribed: what enters there makes up for what flows away.
struct FluidReservoir {
  std::string name;
  std::vector<int> cells;
};

/// Whether fluid that enters at a point may be shared among two cells with these permeabilities, or mobilities.
inline bool conduct_alike(const Tensor& one, const Tensor& other) {
  constexpr double most = 2;  // of permeabilities: fluid that enters less permeable rock would be trapped there
  const double ratio = other.trace() / one.trace();
  return ratio > 1 / most && ratio < most;
}

/// Capability: gives the fluxes of fluid in the matrix. To be used after Part::begin_step of all parts.
class MatrixFluxes {
 public:
  static constexpr const char* promise = "gives the fluxes of fluid in the matrix";
  virtual ~MatrixFluxes() = default;
  /// The present flux through every face, out of face_cells[f][0], integrated over it, m^2/s (in space m^3/s); right on
  /// the faces of the cells that the process owns.
  virtual const Vector& face_fluxes() const = 0;
  /// The largest sum of the absolute values of the products that make up a flux, m^2/s (in space m^3/s). The round-off
  /// of fluxes is relative to this number.
  virtual double round_off_base_of_fluxes() const = 0;
  /// A derivative of face_fluxes: faces × values of the field. It stays until the next step begins.
  struct Derivative {
    const Field* field;
    const SparseMatrix* matrix;
  };
  virtual std::vector<Derivative> face_flux_derivatives() const = 0;
  /// Whether the mobility follows the state within a step.
  virtual bool mobility_follows_state() const { return false; }
  /// The mobility of each cell, m^2/(Pa s).
  virtual const std::vector<Tensor>& mobility() const = 0;
  /// The fluxes in rock of one mobility without fluxes through sides and walls, as this flow discretizes them: right on
  /// faces with both ends among the nodes (one flag a node).
  virtual FluxOperators fluxes_around(const std::vector<char>& nodes, const Tensor& mobility) const = 0;
  /// What enters cells in this step.
  virtual std::vector<FluidSource> fluid_sources() const = 0;
};

/// Capability: gives the fluxes of fluid along fractures. To be used after Part::begin_step of all parts.
class FractureFluxes {
 public:
  static constexpr const char* promise = "gives the fluxes of fluid along the fractures";
  virtual ~FractureFluxes() = default;
  /// The flux through every ridge, from its first to its second cell, or out of its only cell, m^2/s (in space m^3/s).
  virtual const Field& flux() const = 0;
  /// What enters fracture cells in this step, without those of reservoirs.
  virtual std::vector<FluidSource> fluid_sources() const = 0;
  virtual std::vector<FluidReservoir> fluid_reservoirs() const = 0;
};

}  // namespace sprekk
