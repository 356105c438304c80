// Discretizations of a flux that is driven by a potential, and the linear operators that they give.
#pragma once

#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/types.hpp"

namespace sprekk {

// Written for Darcy flow in a plane: pressure p (Pa), mobility (m^2/(Pa s)), flux (m^2/s; in space m^3/s). Conduction
// of heat has the same operators: temperature (K), conductivity (W/(m K)), heat flux (W/m; in space W).

/// What is prescribed on a face: nothing on inner faces, the pressure, or the flux, as on walls of fractures.
enum class FlowCondition { none, pressure, flux };

/// What a discretization has in addition if the pressures h of inner faces are unknowns beside those of the cells.
/// There is one h for each face (Pa); those of other faces are not used. Without such unknowns the matrices have no
/// rows.
///   flux through every face (m^2/s): … + flux h
///   pressure at the centre of every boundary and wall face (Pa): … + trace h
///   the equations of h, one for each face (m^2/s): continuity_cell p + continuity_face h + continuity_boundary b = 0
/// The equation of an inner face says that as much leaves one cell as enters the other. On other faces it says that h
/// is the trace, times a conductance.
struct FacePressureOperators {
  SparseMatrix flux;                 ///< faces × faces
  SparseMatrix trace;                ///< faces × faces; rows of inner faces are empty
  SparseMatrix continuity_cell;      ///< faces × cells
  SparseMatrix continuity_face;      ///< faces × faces
  SparseMatrix continuity_boundary;  ///< faces × faces

  void swap(FacePressureOperators& other) {
    flux.swap(other.flux);
    trace.swap(other.trace);
    continuity_cell.swap(other.continuity_cell);
    continuity_face.swap(other.continuity_face);
    continuity_boundary.swap(other.continuity_boundary);
  }
};

/// One of two approximations of the same flux through every inner face (m^2/s): cell p + boundary b + change s.
/// A discretization without a second approximation has matrices without rows.
struct OneSidedFluxOperators {
  SparseMatrix cell;      ///< faces × cells
  SparseMatrix boundary;  ///< faces × faces
  SparseMatrix change;    ///< faces × directions of faces

  void swap(OneSidedFluxOperators& other) {
    cell.swap(other.cell);
    boundary.swap(other.boundary);
    change.swap(other.change);
  }
};

/// Fluxes and traces as linear functions of
/// - pressures p, one for each cell, Pa;
/// - boundary values b, one for each face: the pressure at the face centre (Pa) on `pressure` faces, the outward flux
///   integrated over the face (m^2/s) on `flux` faces; ignored inside;
/// - changes s of the prescribed pressure along `pressure` faces, in the directions of each (AlongFace; those of a
///   face follow one another), Pa; ignored elsewhere.
///
/// They are
/// - the flux through every face, out of face_cells[f][0], integrated over it (m^2/s):
///   flux_cell p + flux_boundary b + flux_change s;
/// - the pressure at the centre of every boundary and wall face (Pa):
///   trace_cell p + trace_boundary b + trace_change s.
struct FluxOperators {
  SparseMatrix flux_cell;       ///< faces × cells
  SparseMatrix flux_boundary;   ///< faces × faces
  SparseMatrix flux_change;     ///< faces × directions of faces
  SparseMatrix trace_cell;      ///< faces × cells; rows of inner faces are empty
  SparseMatrix trace_boundary;  ///< faces × faces; rows of inner faces are empty
  SparseMatrix trace_change;    ///< the same
  /// faces × faces, diagonal: counts the nodes around which fluxes are not exact for linear pressures, each in equal
  /// parts on its faces, so that the sum is their number (with two-point fluxes: of such faces)
  SparseMatrix blended_nodes;
  FacePressureOperators faces = {};
  /// What is added to the flux through every inner face, as approximated from its first and from its second cell: a
  /// nonlinear mean of the two, which the component takes.
  std::array<OneSidedFluxOperators, 2> limited = {};

  /// Eigen copies sparse matrices when they are moved; swap does not.
  void swap(FluxOperators& other) {
    flux_cell.swap(other.flux_cell);
    flux_boundary.swap(other.flux_boundary);
    flux_change.swap(other.flux_change);
    trace_cell.swap(other.trace_cell);
    trace_boundary.swap(other.trace_boundary);
    trace_change.swap(other.trace_change);
    blended_nodes.swap(other.blended_nodes);
    faces.swap(other.faces);
    for (const int side : {0, 1}) limited[side].swap(other.limited[side]);
  }
};

/// A discretization of the flux: the operators for a mesh, a mobility of each cell, a condition on each face, and the
/// nodes whose surroundings are to be discretized (none for all; rows of faces with another end are then incomplete).
using DiscretizeFlux = FluxOperators (*)(const Mesh&, const std::vector<Tensor>&, const std::vector<FlowCondition>&,
                                         const std::vector<char>&);

/// The discretizations by name, each with unknowns on cells alone, for all components with fluxes of this kind.
inline std::map<std::string, DiscretizeFlux>& flux_discretizations() {
  static std::map<std::string, DiscretizeFlux> known;
  return known;
}

/// Throws std::logic_error where no component of the program has registered the name.
inline DiscretizeFlux flux_discretization(const std::string& name) {
  const auto found = flux_discretizations().find(name);
  if (found == flux_discretizations().end()) throw std::logic_error("there is no discretization of fluxes " + name);
  return found->second;
}

/// Registers a discretization when it is constructed.
struct RegisterFluxDiscretization {
  RegisterFluxDiscretization(const std::string& name, DiscretizeFlux discretize) {
    flux_discretizations()[name] = discretize;
  }
};

}  // namespace sprekk
