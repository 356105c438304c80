// biot: pore pressure loads the rock, and the rock's volume change stores fluid (Eqs. 5-7 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/poroelastic_rock.hpp"
#include "components/capabilities/rest_of_balances.hpp"
#include "components/capabilities/rock_state.hpp"
#include "components/capabilities/rock_stress.hpp"
#include "couplers/biot_options.hpp"
#include "couplers/found_modulus.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/counts_later.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/stabilizes.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

/// Adds alpha (div u − div u_old) V to the fluid balance of each cell, the compressibility of the grains (alpha −
/// phi)/K to its storage, and −alpha (p − p_0) I to the stress.
///
/// The "old" volume is the volume that the fluid balance has counted last (`counted_volume`). So a split scheme that is
/// not iterated counts every change of volume once, if late. One that is iterated counts the volume with which each
/// balance holds: what remains of it after the last pass is counted in the next step.
///
/// With `one_way` the first of these terms is left out, and nothing of the rock enters the balance of the fluid. Where
/// the pores of the fluid are a formula of the state, both terms of the balance are left out, since it has them.
///
/// alpha and the compressibility of the grains are taken at the end of the step. They multiply changes of the state: a
/// change of alpha or of the compressibility alone moves no fluid.
class Biot : public Coupler,
             public KeepsState,
             public FollowsMesh,
             public Stabilizes,
             public KeepsTotals,
             public CountsAmounts,
             public CountsLater {
 public:
  Biot(const CouplerContext& context, const BiotOptions& options)
      : Coupler(context.name),
        mesh_(context.mesh),
        fluid_(context.the<MatrixFluid>()),
        rock_(context.the<PoroelasticRock>()),
        stress_(context.find<RockStress>()),
        state_(context.find<RockState>()),
        counted_volume_(
            context.fields.add(mesh_, amounts_with(fluid_.pressure(), context.name, "counted_volume", volume_unit,
                                                   "Change of volume that the fluid balance has counted"))),
        stored_(context.fields.add(mesh_, amounts_with(fluid_.pressure(), context.name, "fluid_stored", volume_unit,
                                                       "Fluid stored by the change of volume and of grains"))),
        origin_(context.origin),
        options_(options) {
    if (auto* formulas = dynamic_cast<TakesExpressions*>(&fluid_))
      formulas->offer_expression(
          "eps_v", {&rock_.volume_change(),
                    Eigen::Map<const Vector>(mesh_.cell_measure.data(), mesh_.cell_count()).cwiseInverse()});
    if (auto* formulas = dynamic_cast<TakesState*>(&rock_)) formulas->offer_state("p", StateField{&fluid_.pressure()});
    alpha_ = Property(options.biot_coefficient, cell_places(mesh_), context.start_time);
    decoupled_ = alpha_.values().isZero(0) && !alpha_.depends_on_time();
    use_alpha();
    use_grains();
    if (decoupled_) return;
    check_pores();
    if (rock_.bulk_modulus().values().minCoeff() <= 0)
      throw InputError(context.origin, "coupler " + name() + " does not know the bulk modulus of the rock",
                       "its stiffness is anisotropic", "give 'bulk_modulus' to the component");
    tell_storage();
    rock_.accept_pore_pressure(fluid_.pressure(), alpha_in_fluid_, fluid_.initial_pressure());
    if (options_.fixed_stress_modulus != "bulk" && (state_ == nullptr || !state_->stiffness(0)))
      throw InputError(options_.modulus_origin, "coupler " + name() + " does not know lambda and G of the rock",
                       "its stiffness is anisotropic",
                       "leave out 'fixed_stress_modulus', or give 'fixed_stress_value'");
  }

  void evaluate_data(const StepTime& step) override {
    const std::uint64_t before = alpha_.version();
    alpha_.evaluate(step);
    if (alpha_.version() != before) {
      use_alpha();
      rock_.change_alpha(fluid_.pressure(), alpha_in_fluid_);
    }
    use_grains();
    tell_storage();
  }

  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override { found_.begin_step(); }
  void accepted() override { found_.accepted(); }
  void rewound() override { found_.rewound(); }
  void carry_over(const Part& part, const MeshChange& change) override {
    const auto& before = dynamic_cast<const Biot&>(part);
    found_.restore(before.found_.share());
    if (stores_volume() && !change.is_at_start)
      uncounted_ = shared_in_cells(change, before.mesh_, before.volume_now() - before.counted_volume_.accepted());
  }
  void save(std::map<std::string, Vector>& state) const override {
    if (finds_modulus()) state[key_of_found()] = Vector::Constant(1, found_.share());
  }
  void restore(const std::map<std::string, Vector>& state) override {
    if (const auto kept = state.find(key_of_found()); kept != state.end() && kept->second.size() == 1)
      found_.restore(kept->second[0]);
  }

  void assemble(Assembly& assembly, const StepTime&) const override {
    const Field& pressure = fluid_.pressure();
    if (!assembly.has_row(pressure)) return;
    if (decoupled_) return;
    BalanceRows fluid(assembly, pressure);
    if (has_grains_) {
      fluid.store(grain_capacity_.cwiseProduct(pressure.now() - pressure.accepted()),
                  grain_capacity_.cwiseProduct(pressure.now()).lpNorm<Eigen::Infinity>());
      assembly.derivative(pressure, pressure, grains_);
    }
    if (!stores_volume()) return;
    assembly.linear(pressure, rock_.volume_change(), 1, &alpha_in_fluid_);
    SPREKK_EXPECT(rock_.volume_change().constant.size() == mesh_.cell_count(), rock_.volume_change().constant.size());
    assembly.add(pressure, -alpha_in_fluid_.cwiseProduct(counted_volume_.accepted()));
    Vector change = rock_.volume_change().constant - counted_volume_.accepted();
    for (const LinearExpression::Term& term : rock_.volume_change().terms)
      change += assembly.product(term.matrix, *term.field);
    fluid.add_throughput(alpha_in_fluid_.cwiseProduct(change));
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime&) override {
    const Field& pressure = fluid_.pressure();
    if (std::find(solved.begin(), solved.end(), &pressure) == solved.end()) {
      if (finds_modulus()) look_at_rock(solved);
      return;
    }
    Vector stored = stored_.accepted() + grain_capacity_.cwiseProduct(pressure.now() - pressure.accepted());
    if (stores_volume()) {
      Vector volume = rock_.volume_change().now();
      exchange(mesh_, Location::cell, 1, volume);
      stored += alpha_in_fluid_.cwiseProduct(volume - counted_volume_.accepted());
      counted_volume_.set(std::move(volume));
    }
    stored_.set(std::move(stored));
  }

  void count_rest_later(const Assembly& assembly) override {
    if (!assembly.has_row(fluid_.pressure()) || !stores_volume()) return;
    const Vector rest =
        rest_of_balances(assembly, fluid_.pressure(), mesh_, [&](int cell) { return alpha_in_fluid_[cell] > 0; });
    Vector volume = counted_volume_.now();
    for (int c = 0; c < mesh_.cell_count(); ++c)
      if (alpha_in_fluid_[c] > 0) volume[c] -= rest[c] / alpha_in_fluid_[c];
    counted_volume_.set(std::move(volume));
    stored_.set(stored_.now() - rest);
  }

  /// A change of the mesh must not change the fluid in the pores: the counted volume becomes the volume of the same
  /// state on the new mesh, less the part that had not been counted before. The difference of both totals is spread
  /// evenly over the new cells, so that the total of the fluid stays to the last digit.
  void settled(const MeshChange& change) override {
    if (!stores_volume() || change.is_at_start) return;
    Vector volume = volume_now() - uncounted_;
    double difference = 0, area = 0;
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      difference += alpha_in_fluid_[c] * (volume[c] - counted_volume_.accepted()[c]);
      if (change.cell[c] == none) area += alpha_in_fluid_[c] * mesh_.cell_measure[c];
    }
    for (int c = 0; c < mesh_.cell_count(); ++c)
      if (change.cell[c] == none && area > 0) volume[c] -= difference / area * mesh_.cell_measure[c];
    counted_volume_.set_both(std::move(volume));
  }

  /// Where displacements are zero, any change of volume is round-off.
  void count_amounts_from_here(const SettledFields& settled) override {
    if (!stores_volume() || settled.fields.empty()) return;
    counted_volume_.set_both(volume_now());
  }

  void begin_totals() override { stored_.set_both(Vector::Zero(stored_.size())); }
  /// Biot's effective stress, sigma + alpha p I with the stress sigma (tension positive) and the pressure p.
  void output(std::vector<OutputField>& fields) const override {
    if (decoupled_ || stress_ == nullptr) return;
    Vector effective = stress_->mean_stress();
    const Vector load = alpha_in_fluid_.cwiseProduct(fluid_.pressure().now());
    for (int c = 0; c < mesh_.cell_count(); ++c)
      effective.segment<dimension>(symmetric_components * c).array() += load[c];
    fields.push_back({name() + ".effective_stress", "Pa", Location::cell, symmetric_components, std::move(effective)});
  }

  void balance(std::map<std::string, Balance>& balances) const override {
    balances["fluid"].stored += sum_owned(mesh_, Location::cell, stored_.now());
  }

  /// The constant mode of the pressure loads the rock, and the grains store fluid.
  void note_input(Notes& notes) const override {
    if (decoupled_ || !options_.one_way) return;
    notes.add(
        "coupled one way",
        fmt::format("the rock of the coupler {} moves without storing fluid ('one_way: true'): the balance of fluid "
                    "assumes a constant volume of pores, and misses alpha times the change of the rock's volume",
                    name()));
  }

  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    for (const Component* fluid : components)
      for (const Component* rock : components) {
        if (!dynamic_cast<const MatrixFluid*>(fluid) || !dynamic_cast<const PoroelasticRock*>(rock)) continue;
        const std::string both = fluid->name() + " and " + rock->name();
        notes.add("no biot between " + both,
                  "the pressure of " + fluid->name() + " does not load " + rock->name() +
                      ", and its deformation moves no fluid (there is no coupler biot between them) add '- {type: "
                      "biot, between: [" +
                      fluid->name() + ", " + rock->name() + "]}' to 'couplers:', unless that is meant");
      }
  }

  void note_step(Notes& notes, const StepTime&) const override {
    constexpr double much = 2;  // times all that is given: rock would open before
    const double load = rock_.largest_load(), given = fluid_.largest_given_pressure();
    Eigen::Index largest = 0;
    const double pressure = fluid_.pressure().now().maxCoeff(&largest);
    if (decoupled_ || load == 0 || pressure <= much * std::max(load, given)) return;
    notes.add(fluid_.pressure().name() + " beyond the loads",
              fmt::format("{} reaches {:.3g} Pa at {} (the largest stress that is given is {:.3g} Pa, and the largest "
                          "pressure {:.3g} Pa: rock would fracture before) check permeability and rates there",
                          fluid_.pressure().name(), pressure, to_text(mesh_.cell_center[largest]), load, given),
              pressure);
  }

  std::vector<double> switch_times() const override { return options_.biot_coefficient.switch_times(); }

  std::vector<std::string> stabilizations() const override {
    return options_.one_way ? std::vector<std::string>{} : std::vector<std::string>{"fixed_stress", undrained};
  }
  void stabilize(const std::string& scheme, Stabilization& stabilization) const override {
    if (decoupled_ || options_.one_way || scheme != "fixed_stress") return;
    SPREKK_ASSERT(rock_.bulk_modulus().values().minCoeff() > 0, rock_.bulk_modulus().values().minCoeff());
    Vector diagonal(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c)
      diagonal[c] =
          mesh_.cell_measure[c] * (options_.fixed_stress_value ? *options_.fixed_stress_value
                                                               : options_.fixed_stress_factor * alpha_in_fluid_[c] *
                                                                     alpha_in_fluid_[c] / fixed_stress_modulus(c));
    const auto [place, fresh] = stabilization.try_emplace(&fluid_.pressure(), diagonal);
    if (!fresh) place->second += diagonal;
  }
  /// The undrained split (Kim, Tchelepi and Juanes 2011): the rock is solved for with the mass of fluid in each cell
  /// held, so its stiffness is the undrained one.
  std::vector<const Field*> holds_amounts_of(const std::string& scheme) const override {
    if (decoupled_ || options_.one_way || scheme != undrained) return {};
    for (int c = 0; c < mesh_.cell_count(); ++c)
      if (fluid_.is_in_cell(c) && alpha_[c] > 0 && std::isinf(fluid_.diffusivity(c)) && grain_capacity_[c] == 0)
        throw InputError(origin_, "'stabilize: undrained' needs fluid that is stored",
                         "without storage rock whose fluid stays in it would not change its volume: cell at " +
                             to_text(mesh_.cell_center[c]),
                         "give a storage, or use 'stabilize: fixed_stress' in the solve of the flow");
    return {&fluid_.pressure()};
  }
  void stabilize_preconditioner(Stabilization& stabilization) const override {
    stabilize("fixed_stress", stabilization);
  }

 private:
  static constexpr const char* undrained = "undrained";  ///< the name of a stabilization

  /// The change of volume of each cell in the present state. Collective.
  Vector volume_now() const {
    Vector volume = rock_.volume_change().now();
    exchange(mesh_, Location::cell, 1, volume);
    return volume;
  }
  /// Whether a change of the rock's volume is added to the balance of the fluid.
  bool stores_volume() const { return !decoupled_ && !options_.one_way && !fluid_.has_pores_by_formula(); }

  void check_pores() const {
    if (!fluid_.has_pores_by_formula() || options_.one_way != fluid_.porosity_depends_on("eps_v")) return;
    const std::string flow = fluid_.pressure().spec().owner;
    if (options_.one_way)
      throw InputError(origin_, "'one_way' contradicts the porosity of '" + flow + "'",
                       "its formula names 'eps_v', so that the rock's change of volume stores fluid",
                       "remove 'one_way', or 'eps_v' from the formula");
    throw InputError(origin_, "the pores of '" + flow + "' do not follow the volume of the rock",
                     "the formula of its 'porosity' is all that they hold, and does not name 'eps_v'",
                     "add Biot's coefficient times 'eps_v' to the formula, or write 'one_way: true' here");
  }

  /// Rock without a flow in it is dry.
  void use_alpha() {
    alpha_in_fluid_ = alpha_.values();
    for (int c = 0; c < mesh_.cell_count(); ++c)
      if (!fluid_.is_in_cell(c)) alpha_in_fluid_[c] = 0;
  }

  /// The stiffness against a change of the volume of a cell by alpha p, Pa.
  double fixed_stress_modulus(int cell) const {
    if (options_.fixed_stress_modulus == "bulk") return rock_.bulk_modulus()[cell];
    const auto [uniaxial, in_plane] = moduli(cell);
    if (options_.fixed_stress_modulus == "uniaxial") return uniaxial;
    const double share = finds_modulus() ? found_.share() : 0.5;
    return 1 / ((1 - share) / uniaxial + share / in_plane);
  }
  /// For rock that shortens along one axis, and for rock under a pressure that is the same everywhere, Pa.
  std::pair<double, double> moduli(int cell) const {
    const LameParameters stiffness = *state_->stiffness(cell);
    return {stiffness.lambda + 2 * stiffness.shear, stiffness.lambda + 2 * stiffness.shear / dimension};
  }

  bool finds_modulus() const { return !decoupled_ && !options_.one_way && options_.fixed_stress_modulus == "found"; }
  std::string key_of_found() const { return name() + ".found_modulus"; }

  /// The modulus can be found where the rock has been solved for while the flow waits.
  void look_at_rock(const std::vector<Field*>& solved) {
    const LinearExpression& volume = rock_.volume_change();
    if (std::ranges::none_of(volume.terms, [&](const LinearExpression::Term& term) {
          return std::ranges::find(solved, term.field) != solved.end();
        }))
      return;
    Vector stored = volume.now();
    exchange(mesh_, Location::cell, 1, stored);
    Vector least(mesh_.cell_count()), most(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      const double alpha = alpha_in_fluid_[c], square = alpha * alpha * mesh_.cell_measure[c];
      const auto [uniaxial, in_plane] = moduli(c);
      stored[c] *= alpha;
      least[c] = square / uniaxial;
      most[c] = square / in_plane;
    }
    found_.rock_is_solved(fluid_.pressure().now(), stored, least, most);
  }

  /// As for a pressure that differs between neighbouring cells: rock around them shortens along one axis.
  void tell_storage() {
    const std::uint64_t version = alpha_.version() + rock_.bulk_modulus().version() + grains_version_;
    if (decoupled_ || version == told_version_) return;
    told_version_ = version;
    Vector storage(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      const bool knows_stiffness = state_ != nullptr && state_->stiffness(c);
      const double modulus = knows_stiffness ? moduli(c).first : rock_.bulk_modulus()[c];
      storage[c] = grain_capacity_[c] / mesh_.cell_measure[c];
      if (!options_.one_way) storage[c] += alpha_in_fluid_[c] * alpha_in_fluid_[c] / modulus;
    }
    fluid_.accept_rock_storage(storage);
  }

  void use_grains() {
    const Property* porosity = fluid_.porosity_for_storage();
    const std::uint64_t version =
        alpha_.version() + rock_.bulk_modulus().version() + (porosity ? porosity->version() : 0);
    if (version == grains_version_) return;
    grain_capacity_ = Vector::Zero(mesh_.cell_count());
    SPREKK_EXPECT(rock_.bulk_modulus().values().size() == mesh_.cell_count(), rock_.bulk_modulus().values().size());
    if (porosity && !decoupled_)
      for (int c = 0; c < mesh_.cell_count(); ++c) {
        if (!fluid_.is_in_cell(c)) continue;
        if (alpha_[c] < (*porosity)[c])
          throw DataError(InputError(origin_, "Biot's coefficient is below the porosity",
                                     "the grains would have a negative compressibility, (alpha - phi)/K",
                                     "raise biot_coefficient, or give 'storage' to the flow in the matrix")
                              .what());
        grain_capacity_[c] = (alpha_[c] - (*porosity)[c]) / rock_.bulk_modulus()[c] * mesh_.cell_measure[c];
      }
    has_grains_ = !grain_capacity_.isZero(0);
    grains_ = Operator(diagonal_matrix(grain_capacity_));
    grains_version_ = version;  // at the end: values may be refused
  }

  const Mesh& mesh_;
  MatrixFluid& fluid_;
  PoroelasticRock& rock_;
  const RockStress* stress_;  ///< nullptr where the rock does not give it
  const RockState* state_;    ///< the same
  Field& counted_volume_;
  Vector uncounted_;  ///< m^3 (m^2): of the change of volume, on a mesh that has changed: a later solve counts it
  Field& stored_;
  Origin origin_;
  BiotOptions options_;
  FoundModulus found_;
  Property alpha_;
  Vector alpha_in_fluid_;  ///< the same where there is a flow, 0 elsewhere
  Vector grain_capacity_;  ///< (alpha − phi)/K V
  std::uint64_t grains_version_ = 0, told_version_ = 0;
  Operator grains_;  ///< grain_capacity_ as a diagonal
  bool decoupled_ = false, has_grains_ = false;
};

const RegisterCoupler<Biot, BiotOptions> registration("biot");

}  // namespace
}  // namespace sprekk::couplers
