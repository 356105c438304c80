// The flux of fluid through the faces of the rock while the flow is held.
#pragma once

#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::couplers {

/// The flux through each face of the rock, m^2/s, as the last solve of the flow found it. Evaluated with the data of a
/// new step (a viscosity that follows the temperature, a prescribed pressure that has changed), the same pressures
/// would give fluxes that do not balance: cells would gain or lose many times the fluid that they hold.
class HeldFlux {
 public:
  HeldFlux(const CouplerContext& context, const MatrixFluxes& fluxes, const Field& pressure);

  /// To be called after each solve of the flow.
  void take();
  const Vector& now() const { return is_taken_ ? flux_->now() : fluxes_->face_fluxes(); }

  /// On another mesh fluxes are those of the pressures that have been found there, until the flow is solved again.
  void forget() { is_taken_ = was_taken_ = false; }
  void accepted() { was_taken_ = is_taken_; }
  void rewound() { is_taken_ = was_taken_; }
  void save(std::map<std::string, Vector>& state) const;
  void restore(const std::map<std::string, Vector>& state);

 private:
  const Mesh* mesh_;
  const MatrixFluxes* fluxes_;
  Field* flux_;
  bool is_taken_ = false, was_taken_ = false;  // now, and when the last step was accepted
};

}  // namespace sprekk::couplers
