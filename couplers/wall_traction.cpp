// wall_traction: forces on the walls of fractures, and the jump that they leave (Eqs. 1 and 4 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/poroelastic_rock.hpp"
#include "components/capabilities/rock_state.hpp"
#include "couplers/contacts.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/rests_together.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/quality/network_shape.hpp"
#include "framework/round_off.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct WallTractionOptions {
  Data fracture_biot_coefficient = 1;
  Spec spec() {
    Spec spec(
        "wall_traction",
        "Contact traction and fluid pressure act on the walls of fractures (the paper's Eq. 4); the displacement "
        "jump of the "
        "rock acts on the contact. The contact, or the fluid, may be left out. Several contacts, each on some of the "
        "fractures, stand in one coupler.");
    spec.ignore("type").ignore("between");
    spec.data("fracture_biot_coefficient", fracture_biot_coefficient,
              {.range = between(0, 1),
               .doc = "Part of the fluid pressure that acts on the walls.",
               .source = "alpha_i of the paper's Eq. 4",
               .in_time = true});
    return spec;
  }
};

Tensor tensor_of(const SymmetricTensor& components) {
  Tensor tensor;
  for (int k = 0; k < symmetric_components; ++k) {
    const auto [i, j] = symmetric_axes[k];
    tensor(i, j) = tensor(j, i) = components[k];
  }
  return tensor;
}

/// Determines the wall traction T = f − alpha_i p_i n and the jump of the contact (Eqs. 4 and 1 of the paper). The rows
/// of T are multiplied by the compliance of the walls, and are then jumps (m), which a linear solver can distinguish
/// from zero.
///
/// At the start walls have the tractions of the initial stress sigma_0, and the jumps under these.
class WallTraction : public Coupler, public RestsTogether, public CountsFromHere {
 public:
  WallTraction(const CouplerContext& context, const WallTractionOptions& options)
      : Coupler(context.name),
        mesh_(context.mesh),
        options_(options),
        rock_(context.the<RockWalls>()),
        contacts_(context),
        fluid_(context.find<FractureFluid>()),
        rock_state_(context.find<RockState>()),
        fluid_left_out_(fluid_ ? "" : context.left_out<FractureFluid>()) {
    if (contacts_.empty() && !fluid_)
      throw InputError(context.origin, "coupler " + name() + " has nothing that acts on the walls",
                       "it joins the rock with a contact law, the fluid in the fractures, or both",
                       "name one of them in `between`");
    context.determine(rock_.wall_traction());
    contacts_.need_all_fractures(context);
    for (FractureContact* contact : contacts_) {
      context.determine(contact->jump());
      on_cells_.push_back(contacts_.are_several() ? cells_of(*contact) : Vector());
    }
    for (FractureContact* contact : contacts_) {
      if (!contact->needs_shear_modulus()) continue;
      context.the<RockState>();
      if (!shear_modulus())
        throw InputError(
            context.origin, "the shear modulus beside the fractures is unknown",
            "the friction of '" + contact->traction().spec().owner + "' needs it, and anisotropic rock has none",
            "give the rock beside fractures young_modulus and poisson_ratio");
    }
    if (!fluid_) return;
    alpha_ = Property(options_.fracture_biot_coefficient, fracture_cell_places(mesh_), context.start_time);
  }

  void evaluate_data(const StepTime& step) override { alpha_.evaluate(step); }

  void note_input(Notes& notes) const override {
    note_pockets(notes);
    if (fluid_left_out_.empty()) return;
    notes.add(name() + " without " + fluid_left_out_,
              fmt::format("the pressure of {0} does not push the walls of fractures apart ({0} is not in the `between` "
                          "of the coupler {1}) add it there, unless that is meant",
                          fluid_left_out_, name()));
  }

  std::vector<Dependence> dependences() const override {
    std::vector<Dependence> dependences;
    for (FractureContact* contact : contacts_)
      dependences.push_back({contact->jump().spec().owner, rock_.wall_traction().spec().owner,
                             "while the rock is held so is the jump, and walls that stick may then have any traction",
                             true});
    return dependences;
  }

  std::vector<Dependence> dependences_at_rest() const override {
    std::vector<Dependence> dependences;
    for (FractureContact* contact : contacts_)
      dependences.push_back({rock_.wall_traction().spec().owner, contact->traction().spec().owner,
                             "the tractions of the contact would be held, and walls would part or overlap"});
    return dependences;
  }

  /// Where the rock was not settled with them, walls have the tractions of its initial stress.
  void count_from_here(const SettledFields& settled) override {
    if (settled.contain(rock_.wall_traction())) return;
    const bool is_of_fluid = fluid_ && settled.contain(fluid_->pressure());
    if (!settled.fields.empty() && !is_of_fluid) return;
    load_with_initial_stress(settled.fields.empty() ? Reference::initial : Reference::settled);
  }

  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {
    Vector compliance = rock_.wall_compliance();
    exchange(mesh_, Location::fracture_cell, dimension, compliance);
    compliance_ = positive(std::move(compliance));
    for (FractureContact* contact : contacts_) {
      contact->set_wall_stiffness(compliance_.cwiseInverse());
      if (const auto modulus = shear_modulus()) contact->set_shear_modulus(*modulus);
    }
    SPREKK_ASSERT(compliance_.minCoeff() > 0, compliance_.minCoeff());
    if (loaded_with_ != alpha_.version()) load_with_fluid();
  }

  /// Notes suction, a pressure below zero. It pulls the walls together, since the wall traction contains the pressure
  /// itself and not its change. Viscous fluid that fills a fracture up to its tip has no lowest pressure there (Spence
  /// and Sharp, Proc. R. Soc. A 400 (1985) 289), so the smaller the cell at a tip is, the lower is its pressure.
  void note_step(Notes& notes, const StepTime&) const override {
    if (contacts_.empty()) note_overlaps(notes);
    if (!fluid_) return;
    Vector pressure = fluid_->pressure().now();
    for (const Ridge& point : mesh_.ridges)
      if (point.kind == Ridge::Kind::tip && fluid_->viscosity_between_walls(point.cells[0]) > 0)
        pressure[point.cells[0]] = std::max(pressure[point.cells[0]], 0.0);
    Eigen::Index lowest = 0;
    const double suction = -pressure.minCoeff(&lowest);
    if (suction <= rounding::far_above * pressure.maxCoeff() || suction <= 0 || alpha_[lowest] == 0) return;
    notes.add(fluid_->pressure().name() + " suction",
              fmt::format("{} falls to {:.3g} Pa at {} (suction: it pulls the walls of the fracture together, but a "
                          "real fluid would boil) check what is extracted there, whether fluid can reach a fracture "
                          "that opens, and the size of the steps",
                          fluid_->pressure().name(), -suction, to_text(mesh_.fracture_cells[lowest].center)),
              suction);
  }

  std::vector<double> switch_times() const override { return options_.fracture_biot_coefficient.switch_times(); }

  void assemble(Assembly& assembly, const StepTime&) const override {
    const Field& traction = rock_.wall_traction();
    if (assembly.has_row(traction)) {
      assembly.add(traction, compliance_.cwiseProduct(traction.now()));
      assembly.diagonal(traction, traction, compliance_);
      for (FractureContact* contact : contacts_) {
        assembly.add(traction, -compliance_.cwiseProduct(contact->traction().now()));
        assembly.diagonal(traction, contact->traction(), -compliance_);
      }
      if (fluid_) assembly.linear(traction, normal_load_, fluid_->pressure(), 1, &compliance_);
    }
    std::size_t k = 0;
    for (FractureContact* contact : contacts_) {
      const Vector& here = on_cells_[k++];
      const Field& jump = contact->jump();
      if (!assembly.has_row(jump)) continue;
      assembly.add(jump, jump.now());
      assembly.diagonal(jump, jump, Vector::Ones(jump.size()));
      assembly.linear(jump, rock_.displacement_jump(), -1, here.size() > 0 ? &here : nullptr);
    }
  }

  /// With several contacts, the jumps and contact tractions of all fractures together; without any, the jumps of the
  /// walls.
  void output(std::vector<OutputField>& fields) const override {
    if (contacts_.empty()) fields.push_back({name() + ".jump", "m", Location::fracture_cell, dimension, free_jump()});
    if (!contacts_.are_several()) return;
    fields.push_back({name() + ".jump", "m", Location::fracture_cell, dimension, contacts_.jump()});
    fields.push_back({name() + ".contact_traction", "Pa", Location::fracture_cell, dimension, contacts_.traction()});
  }

 private:
  enum class Reference { initial, settled };
  /// 1 for each value of a fracture cell that the contact is on, 0 elsewhere.
  Vector cells_of(const FractureContact& contact) const {
    Vector flags = Vector::Zero(dimension * mesh_.fracture_cell_count());
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      if (contact.is_on_fracture_cell(i)) flags.segment<dimension>(dimension * i).setOnes();
    return flags;
  }

  /// The jump of walls that no contact holds apart, m, on every process; zero before the first step.
  Vector free_jump() const {
    if (rock_.displacement_jump().terms.empty()) return Vector::Zero(rock_.wall_traction().size());
    Vector jump = rock_.displacement_jump().now();
    exchange(mesh_, Location::fracture_cell, dimension, jump);
    return jump;
  }

  void note_overlaps(Notes& notes) const {
    const Vector jump = free_jump();
    int deepest = 0;
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      if (jump[dimension * i] < jump[dimension * deepest]) deepest = i;
    if (jump.size() == 0 || jump[dimension * deepest] >= -rounding::far_above * jump.lpNorm<Eigen::Infinity>()) return;
    notes.add("overlapping walls of " + rock_.wall_traction().spec().owner,
              fmt::format("walls of fractures overlap by {:.3g} m at {} (no contact keeps them apart) add a contact to "
                          "the scene and to the coupler",
                          -jump[dimension * deepest], to_text(mesh_.fracture_cells[deepest].center)),
              -jump[dimension * deepest]);
  }

  /// Rock between fractures that is held by nothing but tractions on its walls, which are zero at the start.
  void note_pockets(Notes& notes) const {
    if (contacts_.empty() || !rock_state_) return;
    for (int w = 0; w < mesh_.wall_count(); ++w) {
      const int face = mesh_.wall_face(w);
      if (!rock_state_->initial_stress(mesh_.face_cells[face][0], mesh_.face_center[face]).isZero(0)) return;
    }
    const std::vector<Pocket> enclosed = pockets(mesh_);
    if (enclosed.empty()) return;
    notes.add(
        "rock between fractures without stress",
        fmt::format("fractures cut off {} parts of the rock, the smallest at {}, and their walls carry no stress at "
                    "the start (while all walls of such a part are open nothing holds it, and a step may fail with a "
                    "singular system) give the rock an initial_stress that balances the loads",
                    enclosed.size(), to_text(enclosed.front().center)));
  }

  /// T = sigma_0 n on the plus wall, and f = T + alpha_i p_i n. Nothing for rock without stress.
  void load_with_initial_stress(Reference reference) {
    if (!rock_state_) return;
    const Vector of_rock = initial_tractions();
    if (of_rock.isZero(0)) return;
    Vector jumps = Vector::Zero(of_rock.size());
    std::vector<Vector> of_contacts(on_cells_.size(), Vector::Zero(of_rock.size()));
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
      const double fluid = fluid_ ? alpha_[i] * fluid_->pressure().now()[i] : 0;
      std::size_t k = 0;
      for (FractureContact* contact : contacts_) {
        Vector& tractions = of_contacts[k++];
        if (!contact->is_on_fracture_cell(i)) continue;
        auto own = tractions.segment<dimension>(dimension * i);
        own = of_rock.segment<dimension>(dimension * i);
        own[0] += fluid;
        jumps[dimension * i] = contact->opening_under(i, std::min(0.0, own[0]));
      }
    }
    rock_.wall_traction().set_both(of_rock);
    std::size_t k = 0;
    for (FractureContact* contact : contacts_) {
      const Vector& here = on_cells_[k];
      contact->traction().set_both(std::move(of_contacts[k++]));
      contact->jump().set_both(here.size() > 0 ? Vector(here.cwiseProduct(jumps)) : jumps);
    }
    // Settled ones may take the place of others.
    if (!contacts_.empty() && (reference == Reference::settled || !jumps.isZero(0))) rock_.count_jumps_from(jumps);
  }

  /// sigma_0 n on the plus walls, Pa, (normal, tangential) of each fracture cell.
  Vector initial_tractions() const {
    Vector tractions(dimension * mesh_.fracture_cell_count());
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
      const FractureCell& cell = mesh_.fracture_cells[i];
      const SymmetricTensor stress =
          rock_state_->initial_stress(mesh_.face_cells[cell.faces[0]][0], mesh_.face_center[cell.faces[0]]);
      tractions.segment<dimension>(dimension * i) = cell.to_local(tensor_of(stress) * cell.normal);
    }
    return tractions;
  }

  /// The shear modulus of the rock beside each fracture cell, Pa: twice that of both sides in series. Nothing where
  /// rock is anisotropic.
  std::optional<Vector> shear_modulus() const {
    if (!rock_state_) return std::nullopt;
    Vector modulus(mesh_.fracture_cell_count());
    for (int i = 0; i < modulus.size(); ++i) {
      double compliance = 0;
      for (const int face : mesh_.fracture_cells[i].faces) {
        const std::optional<LameParameters> stiffness = rock_state_->stiffness(mesh_.face_cells[face][0]);
        if (!stiffness) return std::nullopt;
        compliance += 0.5 / stiffness->shear;
      }
      modulus[i] = 1 / compliance;
    }
    return modulus;
  }

  /// On rough meshes (two fractures one cell apart) a wall may move against its own traction while the cells around it
  /// do not move. The compliance is used as a scale, and by the contact as stiffness of walls, so it must be positive:
  /// at least a tenth of the mean compliance, in proportion to the length of the cell.
  Vector positive(Vector compliance) const {
    SPREKK_EXPECT(compliance.size() == dimension * mesh_.fracture_cell_count(), compliance.size());
    constexpr double least = 0.1;  // of the mean compliance
    double mean[dimension] = {};
    const int cells = mesh_.fracture_cell_count();
    for (int i = 0; i < dimension * cells; ++i)
      mean[i % dimension] += std::abs(compliance[i]) / mesh_.fracture_cells[i / dimension].measure / cells;
    for (int i = 0; i < dimension * cells; ++i)
      compliance[i] =
          std::max(compliance[i], least * mean[i % dimension] * mesh_.fracture_cells[i / dimension].measure);
    return compliance;
  }

  void load_with_fluid() {
    loaded_with_ = alpha_.version();
    SPREKK_ASSERT(alpha_.values().size() == mesh_.fracture_cell_count(), alpha_.values().size());
    std::vector<Triplet> entries;
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i) entries.emplace_back(dimension * i, i, alpha_[i]);
    normal_load_ = Operator(matrix_of(dimension * mesh_.fracture_cell_count(), mesh_.fracture_cell_count(), entries));
  }

  const Mesh& mesh_;
  WallTractionOptions options_;
  RockWalls& rock_;
  Contacts contacts_;
  std::vector<Vector> on_cells_;  ///< of each contact: 1 for values of its fracture cells; none for all
  FractureFluid* fluid_;
  const RockState* rock_state_;  ///< nullptr where the rock does not tell its state
  std::string fluid_left_out_;   ///< a component of the scene that the coupler does not stand between
  Property alpha_;               ///< alpha_i of Eq. 4 of the paper, with a fluid
  std::uint64_t loaded_with_ = 0;
  Vector compliance_;     ///< m/Pa, (normal, tangential): how a cell's traction closes its own jump
  Operator normal_load_;  ///< `dimension` fracture cells × fracture cells: pressure pushes the plus wall along −n
};

const RegisterCoupler<WallTraction, WallTractionOptions> registration("wall_traction");

}  // namespace
}  // namespace sprekk::couplers
