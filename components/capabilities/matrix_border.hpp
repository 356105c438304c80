// Capability of a flow in the rock: fluid may pass to another flow, across the border of its regions or within cells.
#pragma once

#include <vector>

#include "framework/assembly/linear_expression.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// Capability: lets fluid through faces at which the flow ends, and gives the pressure there.
class MatrixBorder {
 public:
  static constexpr const char* promise = "lets fluid through the border of its regions and gives the pressure there";
  virtual ~MatrixBorder() = default;
  /// Opens faces between a cell with and a cell without this flow (one flag a face of the mesh): `outflow` (one a face,
  /// m/s) crosses them, out of this flow, or into it with `sign` −1. Until it is opened, a border is sealed. To be
  /// called in the constructor of a coupler, once for each border; the flow keeps a reference to the field.
  /// Fluxes through these faces are among MatrixFluxes::face_fluxes of both flows. Throws InputError where the flow
  /// cannot be open there, saying why.
  virtual void open_border(const Field& outflow, double sign, const std::vector<char>& faces) = 0;
  /// Says that fluid passes to another flow within cells. To be called in the constructor of a coupler.
  virtual void share_cells() = 0;
  /// Whether fluid passes to another flow: what it carries would be left behind.
  virtual bool shares_fluid() const = 0;
  /// The pressure at the centre of each face of the border that `outflow` crosses, Pa; rows of other faces are empty.
  /// To be used after Part::begin_step of the flow.
  virtual const LinearExpression& border_pressure(const Field& outflow) const = 0;
};

}  // namespace sprekk
