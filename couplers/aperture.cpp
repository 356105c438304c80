// aperture: the opening of a fracture makes room for fluid and lets it flow (below Eq. 8 of the paper).
#include <algorithm>

#include "components/capabilities/fracture_contact.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "framework/assembly/follows_waiting.hpp"
#include "framework/mesh/mesh_change.hpp"
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

/// Determines the aperture. Where the flow is solved while the walls wait, the aperture would stay whatever the
/// pressure is, and fluid that cannot leave an open fracture would get a pressure of any size: with the stabilization
/// fixed_stress the aperture follows the pressure as the walls do.
class Aperture : public Coupler, public FollowsWaiting {
 public:
  Aperture(const CouplerContext& context, const ApertureOptions&)
      : Coupler(context.name),
        mesh_(context.mesh),
        contact_(context.the<FractureContact>()),
        fluid_(context.the<FractureFluid>()) {
    context.determine(fluid_.aperture());
    const int cells = context.mesh.fracture_cell_count();
    std::vector<Triplet> entries;
    for (int i = 0; i < cells; ++i) entries.emplace_back(i, dimension * i, 1.0);
    SparseMatrix normal(cells, dimension * cells);
    normal.setFromTriplets(entries.begin(), entries.end());
    normal_ = Operator(std::move(normal));
  }

  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {}

  std::vector<std::string> stabilizations() const override { return {"fixed_stress"}; }
  std::vector<Following> following(const std::string& stabilization) const override {
    if (stabilization != "fixed_stress" || !fluid_.follows_aperture()) return {};
    return {{&fluid_.aperture(), &fluid_.pressure()}};
  }

  /// Walls that close touch at the initial aperture, or compress each other: in one pass not by more than half.
  Vector least_change(const Field& row) const override {
    if (&row != &fluid_.aperture()) return {};
    const Vector& initial = fluid_.initial_aperture();
    Vector least(initial.size());
    constexpr double half = 0.5;
    for (Eigen::Index i = 0; i < least.size(); ++i) {
      const double opening = contact_.jump().now()[dimension * i];
      least[i] = -std::max({opening, half * (initial[i] + opening), 0.0});
    }
    return least;
  }

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

  /// Cells in the place of a replaced one share its opening as the contact has shared its jump, not evenly: otherwise
  /// fluid would have to flow between them at once.
  void carry_over(const Part& part, const MeshChange& change) override {
    const Vector& old_jump = dynamic_cast<const Aperture&>(part).contact_.jump().accepted();
    Vector evenly = Vector::Zero(fluid_.aperture().size());
    for (const ReplacedPart& replaced : change.replaced_parts)
      evenly[replaced.cell] +=
          replaced.length / mesh_.fracture_cells[replaced.cell].measure * old_jump[dimension * replaced.old_cell];
    Vector aperture = fluid_.aperture().accepted();
    for (Eigen::Index i = 0; i < aperture.size(); ++i)
      if (change.fracture_cell[i] == none) aperture[i] += contact_.jump().accepted()[dimension * i] - evenly[i];
    fluid_.aperture().set_both(std::move(aperture));
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
  const Mesh& mesh_;
  FractureContact& contact_;
  FractureFluid& fluid_;
  Operator normal_;  ///< fracture cells × `dimension` fracture cells: picks the opening
};

const RegisterCoupler<Aperture, ApertureOptions> registration("aperture");

}  // namespace
}  // namespace sprekk::couplers
