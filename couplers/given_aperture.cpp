// given_aperture: the aperture of fractures is what another component gives.
#include <fmt/format.h>

#include <cmath>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/given_on_fractures.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/round_off.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct GivenApertureOptions {
  Spec spec() {
    Spec spec("given_aperture", "The aperture of the fractures of a flow is what another component gives.");
    spec.ignore("type").ignore("between");
    return spec;
  }
};

/// Determines the aperture: a = x, with the given x.
class GivenAperture : public Coupler {
 public:
  GivenAperture(const CouplerContext& context, const GivenApertureOptions&)
      : Coupler(context.name),
        aperture_(context.the<FractureFluid>().aperture()),
        given_(context.the<GivesAperture>().given_aperture()) {
    context.determine(aperture_);
    const Vector& initial = context.the<FractureFluid>().initial_aperture();
    for (Eigen::Index i = 0; i < initial.size(); ++i)
      if (std::abs(given_.accepted()[i] - initial[i]) > rounding::same * initial[i])
        throw InputError(context.origin,
                         fmt::format("{} starts with {:.6g} m, and the aperture with {:.6g} m, at {}", given_.name(),
                                     given_.accepted()[i], initial[i], to_text(context.mesh.fracture_cells[i].center)),
                         "fluid would have to fill the difference at once", "give both the same initial value");
  }
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime&) const override {
    if (!assembly.has_row(aperture_)) return;
    assembly.add(aperture_, aperture_.now());
    assembly.diagonal(aperture_, aperture_, Vector::Ones(aperture_.size()));
    assembly.add(aperture_, -given_.now());
  }

 private:
  Field& aperture_;
  const Field& given_;
};

const RegisterCoupler<GivenAperture, GivenApertureOptions> registration("given_aperture");

}  // namespace
}  // namespace sprekk::couplers
