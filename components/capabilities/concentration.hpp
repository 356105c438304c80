// Capabilities of a dissolved tracer in the matrix and in the fractures.
#pragma once

#include "components/capabilities/carried.hpp"
#include "framework/config/usual_range.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk {

/// Coefficients of diffusion, m^2/s: from the narrow ways through tight rock to ions in free water.
inline UsualRange usual_diffusion() {
  constexpr double in_tight_rock = 1e-14, of_fast_ions = 1e-8;  // m^2/s
  return {in_tight_rock, of_fast_ions, "Li and Gregory 1974; Ohlsson and Neretnieks 1995"};
}

/// A tracer: concentrations in kg per m^3 of fluid, amounts in kg/m (in space kg). A capacity is a volume of pores
/// times the retardation factor, in m^2 (in space m^3).
inline const Carried carried_tracer = {
    "tracer",
    "matrix_transport",
    "concentration",
    "kg/m^3",
    "kg/(m^2*s)",
    dimension == 2 ? "kg/m" : "kg",
    "diffusion",
    "retarded volume of pores",
    volume_unit,
    "1 kg/m^3",
    "give '{}' the porosity or the aperture of the flow, and the flow a storage of this "
    "porosity",
    nullptr,
    non_negative(),
    0.0,  // other fluid has no tracer
    false};

/// Capability: determines the concentration of a tracer in the matrix.
class MatrixConcentration : public virtual MatrixCarried {
 public:
  static constexpr const char* promise = "determines the concentration of a tracer in the matrix";
};

/// Capability: accepts a flux of tracer through the walls of fractures, and gives the concentration there.
class TracerWalls : public virtual CarriedWalls {
 public:
  static constexpr const char* promise = "accepts a flux of tracer through the walls of fractures";
};

/// Capability: determines the concentration of a tracer in the fractures.
class FractureConcentration : public virtual FractureCarried {
 public:
  static constexpr const char* promise = "determines the concentration of a tracer in the fractures";
};

}  // namespace sprekk
