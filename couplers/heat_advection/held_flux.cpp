#include "couplers/heat_advection/held_flux.hpp"

#include "framework/field/ownership.hpp"

namespace sprekk::couplers {

HeldFlux::HeldFlux(const CouplerContext& context, const MatrixFluxes& fluxes, const Field& pressure)
    : mesh_(&context.mesh),
      fluxes_(&fluxes),
      flux_(&context.fields.add(context.mesh, {.owner = context.name,
                                               .name = "flux_in_rock",
                                               .location = Location::face,
                                               .role = Role::derived(),
                                               .unit = "m^2/s",
                                               .doc = "Flux of fluid through each face as the flow was last solved",
                                               .accepted_with = pressure.name()})) {}

void HeldFlux::take() {
  Vector fluxes = fluxes_->face_fluxes();
  replicate(*mesh_, Location::face, 1, fluxes);
  flux_->set(std::move(fluxes));
  is_taken_ = true;
}

void HeldFlux::save(std::map<std::string, Vector>& state) const {
  state[flux_->name() + ".is_taken"] = Vector::Constant(1, was_taken_ ? 1 : 0);
}

void HeldFlux::restore(const std::map<std::string, Vector>& state) {
  is_taken_ = was_taken_ = state.at(flux_->name() + ".is_taken")[0] != 0;
}

}  // namespace sprekk::couplers
