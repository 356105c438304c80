// border_exchange: fluid passes between two flows whose regions touch.
#include <algorithm>
#include <cmath>
#include <optional>

#include "components/capabilities/matrix_border.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "couplers/passed_amounts.hpp"
#include "couplers/wall_fluxes.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/rests_together.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct BorderExchangeOptions {
  Data resistance;  ///< Pa s/m
  Spec spec() {
    Spec spec(
        "border_exchange",
        "Fluid passes between two flows across the border of their regions: what leaves the one enters the other, "
        "and their pressures there are equal, or differ by what a thin layer between them resists.");
    spec.ignore("type").ignore("between");
    spec.data("resistance", resistance,
              {.unit = "Pa*s/m",
               .range = non_negative(),
               .doc = "Of a thin layer at the border: thickness times viscosity over permeability.",
               .source = "Darcy's law across the layer",
               .in_time = true});
    return spec;
  }
};

/// Determines the flux q through every face of the border, from the first flow into the second (m/s):
///   r q = tr p_1 − tr p_2 ,
/// with traces that are linear functions of the pressures of cells and of q. Its row is divided by r and the resistance
/// of the rock on both sides, and so is well scaled. Elsewhere q = 0. The field belongs to the first flow. What the
/// first flow has let into cells of the second, the second counts when it is solved.
class BorderExchange : public Coupler, public KeepsState, public CountsAmounts, public RestsTogether {
 public:
  BorderExchange(const CouplerContext& context, const BorderExchangeOptions& options)
      : Coupler(context.name), mesh_(context.mesh), switch_times_(options.resistance.switch_times()) {
    const std::vector<MatrixFluid*> flows = context.all<MatrixFluid>();
    const std::vector<MatrixBorder*> borders = context.all<MatrixBorder>();
    if (flows.size() != 2 || borders.size() != 2)
      throw InputError(context.origin,
                       "coupler " + name() + " stands between " + std::to_string(borders.size()) +
                           " flows that solve for the pressure of rock",
                       "fluid passes from one to another", "name two components of the kind matrix_flow");
    pressures_ = {&flows[0]->pressure(), &flows[1]->pressure()};
    borders_ = {borders[0], borders[1]};
    find_faces(context, *flows[0], *flows[1]);

    flux_ = &context.fields.add(mesh_, {.owner = pressures_[0]->spec().owner,
                                        .name = "flux_to_" + pressures_[1]->spec().owner,
                                        .location = Location::face,
                                        .role = Role::input(BlockKind::interface),
                                        .unit = "m/s",
                                        .doc = "Flux across the border of the regions of both flows"});
    context.determine(*flux_);
    passed_.emplace(context.fields, mesh_, context.name, Location::cell, *flux_, *pressures_[1], "second flow",
                    "second flow");
    borders_[0]->open_border(*flux_, 1, at_border_);
    borders_[1]->open_border(*flux_, -1, at_border_);

    std::vector<Place> places;
    for (const int face : faces_)
      places.push_back({mesh_.face_center[face], mesh_.cell_region[mesh_.face_cells[face][0]], 0});
    resistance_ = Property(options.resistance, places, context.start_time);
  }

  bool allows_stages() const override { return true; }
  std::vector<double> switch_times() const override { return switch_times_; }
  void evaluate_data(const StepTime& step) override { resistance_.evaluate(step); }
  void begin_step(const StepTime&) override {}

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const Field& second = *pressures_[1];
    if (assembly.has_row(second)) {
      const Vector uncounted = assembly.has_row(*flux_) ? passed_->uncounted_at_start()
                                                        : Vector(passed_->uncounted_now() - passing(step.dt));
      BalanceRows(assembly, second).store(-uncounted);
    }
    if (assembly.has_row(*flux_)) assemble_flux(assembly);
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override {
    passed_->after_solve(solved, [&] { return passing(step.dt); });
  }
  void accepted() override { passed_->accepted(); }
  void count_amounts_from_here(const SettledFields&) override { passed_->begin(); }

  std::vector<Dependence> dependences_at_rest() const override {
    const std::string &first = pressures_[0]->spec().owner, &second = pressures_[1]->spec().owner;
    return {{second, first, "what crosses the border is an unknown of '" + first + "', which would be held"}};
  }

  /// What the first flow has let out and the second has not counted yet is stored in neither.
  void balance(std::map<std::string, Balance>& balances) const override {
    balances["fluid"].stored += passed_->sum_uncounted();
  }

  void report(std::vector<Quantity>& quantities) const override {
    double rate = 0;
    for (const int face : faces_)
      if (is_owned(mesh_, Location::face, face)) rate += mesh_.face_measure[face] * flux_->now()[face];
    quantities.push_back({name() + ".rate", volume_rate_unit, parallel::sum(rate)});
  }

  /// Two flows that touch, and between which nothing passes.
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    std::vector<std::pair<std::string, MatrixFluid*>> flows;
    for (Component* component : components)
      if (auto* flow = dynamic_cast<MatrixFluid*>(component); flow && flow->pressure().spec().role.is_unknown())
        flows.emplace_back(component->name(), flow);
    for (std::size_t i = 0; i < flows.size(); ++i)
      for (std::size_t j = i + 1; j < flows.size(); ++j) {
        const auto& [first, one] = flows[i];
        const auto& [second, other] = flows[j];
        bool share = false;
        for (int c = 0; c < one->pressure().size() && !share; ++c) share = one->is_in_cell(c) && other->is_in_cell(c);
        if (share) continue;
        notes.add("nothing passes between " + first + " and " + second,
                  "no fluid passes between '" + first + "' and '" + second +
                      "' (each ends at the border of its regions, which is sealed) add '- {type: border_exchange, "
                      "between: [" +
                      first + ", " + second + "]}' to 'couplers:', unless that is meant");
      }
  }

 private:
  void find_faces(const CouplerContext& context, const MatrixFluid& first, const MatrixFluid& second) {
    at_border_.assign(mesh_.face_count(), 0);
    for (int cell = 0; cell < mesh_.cell_count(); ++cell)
      if (first.is_in_cell(cell) && second.is_in_cell(cell))
        throw InputError(
            context.origin,
            "both flows of coupler " + name() + " live in region '" + mesh_.region_names[mesh_.cell_region[cell]] + "'",
            "fluid that passes within rock, not across a border, is passed by matrix_exchange",
            "give them regions of their own, or take matrix_exchange");
    for (int face = 0; face < mesh_.face_count(); ++face) {
      const auto [cell, other] = mesh_.face_cells[face];
      if (other == none) continue;
      const bool to_second = first.is_in_cell(cell) && second.is_in_cell(other);
      if (!to_second && !(second.is_in_cell(cell) && first.is_in_cell(other))) continue;
      at_border_[face] = 1;
      faces_.push_back(face);
      into_.push_back(to_second ? other : cell);
    }
    if (faces_.empty())
      throw InputError(context.origin, "coupler " + name() + " passes nothing", "the regions of its flows do not touch",
                       "remove it, or let the regions touch");
  }

  /// What flows into each cell of the second flow in a time, with the present flux, m^2.
  Vector passing(double dt) const {
    Vector amounts = Vector::Zero(mesh_.cell_count());
    for (std::size_t i = 0; i < faces_.size(); ++i)
      amounts[into_[i]] += dt * mesh_.face_measure[faces_[i]] * flux_->now()[faces_[i]];
    return amounts;
  }

  void assemble_flux(Assembly& assembly) const {
    const std::array<const LinearExpression*, 2> traces = {&borders_[0]->border_pressure(*flux_),
                                                           &borders_[1]->border_pressure(*flux_)};
    Vector of_flux = Vector::Ones(mesh_.face_count()), of_trace = Vector::Zero(mesh_.face_count());
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const int face = faces_[i];
      double resistance = resistance_[static_cast<int>(i)];
      for (const LinearExpression* trace : traces)
        for (const LinearExpression::Term& term : trace->terms)
          if (term.field == flux_) resistance += std::abs(term.matrix.entries().coeff(face, face));
      if (!is_owned(mesh_, Location::face, face)) continue;
      SPREKK_ASSERT(std::isfinite(resistance) && resistance > 0, face, resistance);
      of_trace[face] = 1 / resistance;
      of_flux[face] = resistance_[static_cast<int>(i)] / resistance;
    }
    assembly.add(*flux_, of_flux.cwiseProduct(flux_->now()));
    assembly.diagonal(*flux_, *flux_, of_flux);
    // Pressures of the two sides are nearly equal: their difference has the round-off of either.
    add_trace(assembly, *flux_, *traces[0], -of_trace);
    add_trace(assembly, *flux_, *traces[1], of_trace);
  }

  const Mesh& mesh_;
  std::array<const Field*, 2> pressures_ = {};
  std::array<MatrixBorder*, 2> borders_ = {};
  std::vector<int> faces_;       ///< of the border
  std::vector<int> into_;        ///< the cell of the second flow at each of them
  std::vector<char> at_border_;  ///< one flag a face of the mesh
  Property resistance_;          ///< one for each of `faces_`
  Field* flux_ = nullptr;
  std::optional<PassedAmounts> passed_;  ///< into each cell of the second flow
  std::vector<double> switch_times_;
};

const RegisterCoupler<BorderExchange, BorderExchangeOptions> registration("border_exchange");

}  // namespace
}  // namespace sprekk::couplers
