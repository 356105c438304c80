// aperture: the opening of a fracture makes room for fluid and lets it flow (below Eq. 8 of the paper).
#include <fmt/format.h>

#include <algorithm>

#include "components/capabilities/fracture_fluid.hpp"
#include "couplers/contacts.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/follows_waiting.hpp"
#include "framework/assembly/stabilizes.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/matrix_of.hpp"
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

/// Determines the aperture. If the flow is solved while the walls wait, the aperture does not depend on the pressure,
/// and the pressure of fluid trapped in an open fracture is unbounded. With the stabilization fixed_stress the aperture
/// responds to the pressure as the walls do.
class Aperture : public Coupler, public FollowsMesh, public Stabilizes, public FollowsWaiting, public CountsAmounts {
 public:
  Aperture(const CouplerContext& context, const ApertureOptions&)
      : Coupler(context.name), mesh_(context.mesh), contacts_(context), fluid_(context.the<FractureFluid>()) {
    if (contacts_.empty()) context.the<FractureContact>();  // says what is missing
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      if (!contacts_.at(i) && fluid_.is_in_fracture_cell(i)) left_out_ = context.left_out<FractureContact>();
    context.determine(fluid_.aperture());
    if (auto* formulas = dynamic_cast<TakesState*>(&fluid_))
      for (FractureContact* contact : contacts_) formulas->offer_state("sigma_n", {&contact->traction(), 0, -1});
    const int cells = context.mesh.fracture_cell_count();
    std::vector<Triplet> entries;
    for (int i = 0; i < cells; ++i) entries.emplace_back(i, dimension * i, 1.0);
    normal_ = Operator(matrix_of(cells, dimension * cells, entries));
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
    const Vector jump = contacts_.jump();
    // An aperture closes by half in a pass at most: it stays positive.
    for (Eigen::Index i = 0; i < least.size(); ++i) {
      const double opening = jump[dimension * i];
      least[i] = -std::max({opening, 0.5 * (initial[i] + opening), 0.0});
    }
    return least;
  }

  /// The pressure holds the fracture open, and what opens stores fluid.
  void assemble(Assembly& assembly, const StepTime&) const override {
    const Field& aperture = fluid_.aperture();
    if (!assembly.has_row(aperture)) return;
    assembly.add(aperture, aperture.now());
    assembly.diagonal(aperture, aperture, Vector::Ones(aperture.size()));
    assembly.add(aperture, -fluid_.initial_aperture());
    for (FractureContact* contact : contacts_) assembly.linear(aperture, normal_, contact->jump(), -1);
  }

  /// Fluid that was held while walls have opened or closed fills what they leave.
  void count_amounts_from_here(const SettledFields& settled) override {
    if (settled.contain(fluid_.aperture())) return;
    fluid_.aperture().set_both(fluid_.initial_aperture() + normal_.entries() * contacts_.jump());
  }

  /// Cells that replace an old one share its opening as the contact has shared its jump. With equal shares fluid would
  /// have to flow between them at once.
  void carry_over(const Part& part, const MeshChange& change) override {
    const Vector old_jump = dynamic_cast<const Aperture&>(part).contacts_.accepted_jump();
    const Vector jump = contacts_.accepted_jump();
    Vector evenly = Vector::Zero(fluid_.aperture().size());
    for (const ReplacedPart& replaced : change.replaced_parts)
      evenly[replaced.cell] +=
          replaced.length / mesh_.fracture_cells[replaced.cell].measure * old_jump[dimension * replaced.old_cell];
    Vector aperture = fluid_.aperture().accepted();
    for (Eigen::Index i = 0; i < aperture.size(); ++i)
      if (change.fracture_cell[i] == none) aperture[i] += jump[dimension * i] - evenly[i];
    fluid_.aperture().set_both(std::move(aperture));
  }

  void note_input(Notes& notes) const override {
    if (left_out_.empty()) return;
    notes.add(name() + " without " + left_out_,
              fmt::format("the aperture in {0} stays what it is at the start where '{1}' opens or dilates ({1} is not "
                          "in the `between` of the coupler {2}) add it there, unless that is meant",
                          fluid_.pressure().spec().owner, left_out_, name()));
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
  Contacts contacts_;
  FractureFluid& fluid_;
  std::string left_out_;  ///< a contact of the scene that the coupler does not stand between
  Operator normal_;       ///< fracture cells × `dimension` fracture cells: picks the opening
};

const RegisterCoupler<Aperture, ApertureOptions> registration("aperture");

}  // namespace
}  // namespace sprekk::couplers
