// aperture: the opening of a fracture makes room for fluid and lets it flow (below Eq. 8 of the paper).
#include "components/capabilities/fracture_contact.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct ApertureOptions {
  Spec spec() {
    Spec spec(
        "aperture",
        "The normal displacement jump opens the aperture of the fracture, a = a0 + [u]_n (below the paper's Eq. 8).");
    spec.ignore("type").ignore("between");
    return spec;
  }
};

class Aperture : public Coupler {
 public:
  Aperture(const CouplerContext& context, const ApertureOptions&)
      : Coupler(context.name), contact_(context.the<FractureContact>()), fluid_(context.the<FractureFluid>()) {
    context.determine(fluid_.aperture());
    const int cells = context.mesh.fracture_cell_count();
    std::vector<Triplet> entries;
    for (int i = 0; i < cells; ++i) entries.emplace_back(i, dimension * i, 1.0);
    SparseMatrix normal(cells, dimension * cells);
    normal.setFromTriplets(entries.begin(), entries.end());
    normal_ = Operator(std::move(normal));
  }

  void begin_step(const StepTime&) override {}

  /// The pressure holds the fracture open, and what opens stores fluid.
  void hold_constants(ConstantModes& modes) const override { modes.hold(fluid_.pressure()); }

  void assemble(Assembly& assembly, const StepTime&) const override {
    const Field& aperture = fluid_.aperture();
    if (!assembly.has_row(aperture)) return;
    assembly.add(aperture, aperture.now());
    assembly.diagonal(aperture, aperture, Vector::Ones(aperture.size()));
    assembly.add(aperture, -fluid_.initial_aperture());
    assembly.linear(aperture, normal_, contact_.jump(), -1);
  }

  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    for (const Component* contact : components) {
      if (!dynamic_cast<const FractureContact*>(contact)) continue;
      for (const Component* fluid : components) {
        const auto* capable = dynamic_cast<const FractureFluid*>(fluid);
        if (!capable || !capable->follows_aperture()) continue;
        notes.add("no aperture between " + contact->name() + " and " + fluid->name(),
                  "the aperture in " + fluid->name() + " stays what it is at the start, however far " +
                      contact->name() +
                      " opens or dilates (no coupler aperture stands between them) add '- {type: aperture, between: [" +
                      contact->name() + ", " + fluid->name() + "]}' to 'couplers:', unless that is meant");
      }
    }
  }

 private:
  FractureContact& contact_;
  FractureFluid& fluid_;
  Operator normal_;  ///< fracture cells × `dimension` fracture cells: picks the opening
};

const RegisterCoupler<Aperture, ApertureOptions> registration("aperture");

}  // namespace
}  // namespace sprekk::couplers
