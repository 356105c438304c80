// heat_advection: flowing fluid carries heat through the matrix, along fractures and through their walls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "components/capabilities/cold.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_border.hpp"
#include "couplers/heat_advection/carried_heat.hpp"
#include "couplers/heat_advection/held_flow.hpp"
#include "couplers/heat_advection/options.hpp"
#include "couplers/heat_advection/streams.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

constexpr double rounding_of_aperture = 1e-2;  // of the larger one of two that are to be the same

/// Adds to the heat balance of each cell what streams of fluid carry (Stream). With the fluid m that has entered the
/// cell since the start (m^2), by the same streams, it stores c (m T − m_old T_old), and what enters is c dt q T of
/// where it comes from. Together with m = m_old + dt (sum of q) this is
///   c m_old (T − T_old) + c dt (sum over what enters of q (T − T_from)),
/// so that a uniform temperature stays uniform whatever the fluxes are, and nothing is lost or made: heat is conserved
/// in each schedule, also where the streams are those of a flow that is solved before or after.
class HeatAdvection : public Coupler, public KeepsState, public FollowsMesh, public KeepsTotals, public CountsAmounts {
 public:
  HeatAdvection(const CouplerContext& context, const HeatAdvectionOptions& options)
      : Coupler(context.name), mesh_(context.mesh), options_(options), origin_(context.origin) {
    matrix_ = context.find<MatrixFluxes>();
    fracture_ = context.find<FractureFluxes>();
    walls_ = context.find<MatrixWalls>();
    flow_in_rock_ = context.find<MatrixFluid>();
    rock_heat_ = context.find<MatrixTemperature>();
    fracture_heat_ = context.find<FractureTemperature>();
    if (!(matrix_ && rock_heat_) && !(fracture_ && fracture_heat_))
      throw InputError(context.origin, "coupler " + name() + " has no flow that carries heat",
                       "it needs the flow and the heat of the matrix, of the fractures, or of both",
                       "name such components in `between`, or remove the coupler for conduction alone");
    const double c = options_.fluid_heat_capacity;
    if (rock_heat_ && matrix_) rock_ = {context, rock_heat_->temperature(), Location::cell, "rock", c};
    if (fracture_heat_ && fracture_)
      fractures_ = {context, fracture_heat_->temperature(), Location::fracture_cell, "fractures", c};
    if (auto* formulas = dynamic_cast<TakesState*>(fracture_); formulas && fracture_heat_)
      formulas->offer_state("T", {&fracture_heat_->temperature()});
    find_wells(context);
    for (const CarriedHeat* place : {&rock_, &fractures_})
      if (place->temperature) at_start_.push_back(place->temperature->now());
    if (fractures_.temperature) compare_apertures(context);
    flow_.emplace(context,
                  CarryingFlow{rock_.temperature ? matrix_ : nullptr,
                               flow_in_rock_ ? &flow_in_rock_->pressure() : nullptr, walls_, fracture_, wells_.wells});
  }

  /// Heat that is carried through the walls in a step is the same for both sides.
  std::vector<Dependence> dependences() const override {
    if (!rock_.temperature || !fractures_.temperature) return {};
    const std::string rock = rock_.temperature->spec().owner, fracture = fractures_.temperature->spec().owner;
    const std::string because = "what the fluid carries out of the one it carries into the other in the same step";
    return {{rock, fracture, because}, {fracture, rock, because}};
  }

  void evaluate_data(const StepTime& step) override {
    const auto* border = dynamic_cast<const MatrixBorder*>(matrix_);
    if (border && border->has_open_border())
      throw DataError(InputError(origin_, "the fluid of coupler " + name() + " crosses the border to another flow",
                                 "heat is carried by one flow, which has all the fluid of the rock",
                                 "take one flow whose parameters differ by region")
                          .what());
    injected_.clear();
    for (const auto& [name, given] : options_.injected)
      injected_.emplace_back(name, value_in_step(given.temperature, Place{}, step));
    check_names();
    wells_.injected = injected_by_wells();
    wells_.check(name());
    if (rock_.temperature) rock_.check(rock_heat_->heat_capacity(), name());
    if (fractures_.temperature) fractures_.check(fracture_heat_->heat_capacity(), name());
  }
  void begin_step(const StepTime&) override {}

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const auto has_row = [&](const Field& field) { return assembly.has_row(field); };
    const bool is_in_rock = rock_.temperature && has_row(*rock_.temperature);
    const bool is_in_fractures = fractures_.temperature && has_row(*fractures_.temperature);
    if (!is_in_rock && !is_in_fractures) return;
    // As long as no solve has found the flow, heat that is solved before it is not carried: the fluxes of initial
    // values are no flow, and may drain a cell of many times what it holds.
    const auto is_solved = [&](const Field* field) { return has_row(*field); };
    if (!flow_->has_flowed() && std::ranges::none_of(flow_->fields(), is_solved)) return;
    const FlowRates rates = flow_->rates(has_row, step);
    const Mixtures wells = wells_.mixtures(rates.wells);
    if (is_in_rock)
      add(assembly, rock_, streams_of_rock(sources(), rates, flow_->fluxes_in_rock(has_row, step)), wells, step);
    if (is_in_fractures) add(assembly, fractures_, streams_of_fractures(sources(), rates), wells, step);
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override {
    const auto has = [&](const Field& field) {
      return std::ranges::any_of(solved, [&](const Field* each) { return each == &field; });
    };
    flow_->take(has, step);
    if (!flow_->has_flowed()) return;
    const bool is_in_rock = rock_.temperature && has(*rock_.temperature);
    const bool is_in_fractures = fractures_.temperature && has(*fractures_.temperature);
    if (!is_in_rock && !is_in_fractures) return;
    const FlowRates rates = flow_->rates(has, step);
    const Mixtures wells = wells_.mixtures(rates.wells);
    if (is_in_rock) count(rock_, streams_of_rock(sources(), rates, flow_->fluxes_in_rock(has, step)), wells, step);
    if (is_in_fractures) count(fractures_, streams_of_fractures(sources(), rates), wells, step);
  }

  void carry_over(const Part& before, const MeshChange&) override {
    flow_->carry_over(*dynamic_cast<const HeatAdvection&>(before).flow_);
  }
  void accepted() override { flow_->accepted(); }
  void rewound() override { flow_->rewound(); }
  void save(std::map<std::string, Vector>& state) const override { flow_->save(state); }
  void restore(const std::map<std::string, Vector>& state) override { flow_->restore(state); }

  void begin_totals() override {
    flow_->begin(true);
    for (const CarriedHeat* place : {&rock_, &fractures_})
      if (place->temperature) place->cumulative->set_both(Vector::Zero(place->cumulative->size()));
  }

  /// The heat capacity of cells is that with the fluid that they have in the settled state.
  void count_amounts_from_here(const SettledFields& settled) override {
    const auto is_settled = [&](const Field* field) { return settled.contain(*field); };
    flow_->begin(std::ranges::any_of(flow_->fields(), is_settled));
    for (const CarriedHeat* place : {&rock_, &fractures_})
      if (place->temperature) place->received->set_both(Vector::Zero(place->received->size()));
  }

  void balance(std::map<std::string, Balance>& balances) const override {
    Balance& heat = balances["heat"];
    heat.unit = energy_unit;
    for (const CarriedHeat* place : {&rock_, &fractures_})
      if (place->temperature) place->add_to(heat);
  }

  /// The temperature of the fluid that leaves at each named place of the flow, or of that which enters.
  void report(std::vector<Quantity>& quantities) const override {
    const auto mean = [&](const std::string& place, const Vector& temperature, auto&& rates) {
      double rate = 0, sum = 0;
      for (const auto& [cell, each] : rates) {
        rate += std::abs(each);
        sum += std::abs(each) * temperature[cell];
      }
      quantities.push_back({name() + "." + place + ".temperature", "K", rate > 0 ? sum / rate : 0.0});
    };
    const FlowRates now = flow_->rates([](const Field&) { return true; }, {});
    const Mixtures fluid = wells_.mixtures(now.wells);
    for (std::size_t well = 0; well < fluid.size(); ++well)
      if (fluid[well])
        quantities.push_back(
            {name() + "." + wells_.wells->names()[well] + ".temperature", "K", fluid[well]->temperature});
    if (rock_.temperature)
      for (const FluidSource& source : matrix_->fluid_sources())
        if (source.name != "source") mean(source.name, rock_.temperature->now(), source.rates);
    if (!fractures_.temperature) return;
    const Vector& temperature = fractures_.temperature->now();
    for (const FluidSource& source : fracture_->fluid_sources()) mean(source.name, temperature, source.rates);
    for (const FluidReservoir& reservoir : fracture_->fluid_reservoirs()) {
      std::vector<std::pair<int, double>> rates;
      for (const Stream& stream : streams_of_fractures(sources(), now))
        if (stream.flux == Stream::Flux::none && std::ranges::count(reservoir.cells, stream.cell))
          rates.emplace_back(stream.cell, stream.rate);
      mean(reservoir.name, temperature, rates);
    }
  }

  void note_input(Notes& notes) const override {
    std::vector<const Data*> given;
    for (const auto& [place, injected] : options_.injected) given.push_back(&injected.temperature);
    for (const Vector& at_start : at_start_) note_cold(notes, name(), at_start, given);
    if (!other_aperture_.empty()) notes.add(name() + ": another aperture for heat", other_aperture_);
  }
  void note_step(Notes& notes, const StepTime&) const override { wells_.note(name(), notes); }

  std::vector<double> switch_times() const override {
    std::vector<const Data*> data;
    for (const auto& [name, given] : options_.injected) data.push_back(&given.temperature);
    return merged_switch_times(data);
  }

  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    for (const Component* flow : components)
      for (const Component* heat : components) {
        const bool in_rock = dynamic_cast<const MatrixFluxes*>(flow) && dynamic_cast<const MatrixTemperature*>(heat);
        const bool in_fractures =
            dynamic_cast<const FractureFluxes*>(flow) && dynamic_cast<const FractureTemperature*>(heat);
        if (!in_rock && !in_fractures) continue;
        notes.add("no heat_advection between " + flow->name() + " and " + heat->name(),
                  "the fluid of " + flow->name() + " carries no heat of " + heat->name() +
                      " (no coupler heat_advection stands between them) add one, with both in `between`, unless that "
                      "is meant");
      }
  }

 private:
  StreamSources sources() const {
    StreamSources sources{mesh_, fracture_};
    sources.matrix_heat = rock_.temperature ? rock_heat_ : nullptr;
    sources.fracture_heat = fractures_.temperature ? fracture_heat_ : nullptr;
    sources.injected = injected_;
    sources.wells = wells_.wells;
    sources.rock_pressure = wells_.rock.pressure;
    sources.fracture_pressure = wells_.fractures.pressure;
    return sources;
  }

  /// Looks for fracture cells whose heat is stored in another thickness than their fluid.
  void compare_apertures(const CouplerContext& context) {
    const FractureFluid* fluid = context.find<FractureFluid>();
    const Vector* of_heat = fracture_heat_->thickness();
    if (!fluid || !of_heat) return;
    const Vector& of_fluid = fluid->initial_aperture();
    double worst = rounding_of_aperture;
    for (int i = 0; i < of_heat->size(); ++i) {
      const double larger = std::max(of_fluid[i], (*of_heat)[i]), difference = std::abs(of_fluid[i] - (*of_heat)[i]);
      if (of_fluid[i] <= 0 || difference <= worst * larger) continue;
      worst = difference / larger;
      const FractureCell& cell = mesh_.fracture_cells[i];
      other_aperture_ = fmt::format(
          "the fracture '{}' is {:.4g} m wide for its heat and {:.4g} m for its fluid at {} (so it stores the heat of "
          "another amount of fluid than flows in it) give 'aperture' of '{}' the initial_aperture of the flow",
          mesh_.fractures[cell.fracture].name, (*of_heat)[i], of_fluid[i], to_text(cell.center),
          fracture_heat_->temperature().spec().owner);
    }
  }

  void find_wells(const CouplerContext& context) {
    const std::string left_out = context.left_out<WellPressures>();
    if (!left_out.empty())
      throw InputError(context.origin, "coupler " + name() + " leaves out '" + left_out + "'",
                       "the fluid of these wells carries heat, too", "name '" + left_out + "' in 'between'");
    wells_.wells = context.find<WellPressures>();
    if (!wells_.wells) return;
    if (auto* fluid = context.find<MatrixFluid>()) wells_.rock = {&fluid->pressure(), rock_.temperature};
    if (auto* fluid = context.find<FractureFluid>()) wells_.fractures = {&fluid->pressure(), fractures_.temperature};
  }

  /// Of what comes into wells from outside.
  std::vector<std::optional<double>> injected_by_wells() const {
    std::vector<std::optional<double>> temperatures;
    if (wells_.wells)
      for (const std::string& well : wells_.wells->names()) {
        const auto given = std::ranges::find(injected_, well, &std::pair<std::string, double>::first);
        temperatures.push_back(given == injected_.end() ? std::nullopt : std::optional(given->second));
      }
    return temperatures;
  }

  /// Throws DataError for a temperature of a place that the flow does not have.
  void check_names() const {
    std::vector<std::string> known;
    if (rock_.temperature)
      for (const FluidSource& source : matrix_->fluid_sources()) known.push_back(source.name);
    if (fractures_.temperature) {
      for (const FluidSource& source : fracture_->fluid_sources()) known.push_back(source.name);
      for (const FluidReservoir& reservoir : fracture_->fluid_reservoirs()) known.push_back(reservoir.name);
    }
    if (wells_.wells) known.insert(known.end(), wells_.wells->names().begin(), wells_.wells->names().end());
    for (const auto& [name, given] : options_.injected)
      if (!std::ranges::count(known, name))
        throw DataError(unknown_name(given.origin, "place where the flow lets fluid in", name, known).what());
  }

  double temperature_of(const CarriedHeat& place, const Stream& stream, const Mixtures& wells) const {
    const double own = place.temperature->now()[stream.cell];
    if (stream.rate <= 0) return own;
    switch (stream.from) {
      case Stream::From::given:
        return stream.temperature;
      case Stream::From::well:
        return wells[stream.index]->temperature;
      case Stream::From::rock_cell:
        return rock_.temperature->now()[stream.index];
      case Stream::From::fracture_cell:
        return fractures_.temperature->now()[stream.index];
      case Stream::From::own:
        break;
    }
    return own;
  }

  void add(Assembly& assembly, const CarriedHeat& place, const std::vector<Stream>& streams, const Mixtures& wells,
           const StepTime& step) const {
    const Field& temperature = *place.temperature;
    const double scale = options_.fluid_heat_capacity * step.dt;
    const Vector capacity = options_.fluid_heat_capacity * place.received->accepted();
    Vector carried = Vector::Zero(temperature.size()), through_sides = carried;
    double largest = 0, largest_rate = 0, largest_difference = 0;
    std::vector<Triplet> own, of_rock, of_fractures;
    std::array<std::vector<Triplet>, 4> by_flux;  // by Stream::Flux
    for (const Stream& stream : streams) {
      SPREKK_ASSERT(std::isfinite(stream.rate), stream.cell, stream.rate);
      if (stream.rate <= 0 || stream.from == Stream::From::own) continue;
      const double difference = temperature.now()[stream.cell] - temperature_of(place, stream, wells);
      const double amount = scale * stream.rate * difference;
      carried[stream.cell] += amount;
      if (stream.is_outside) through_sides[stream.cell] += std::abs(amount);
      largest = std::max(largest, std::abs(amount));
      largest_rate = std::max(largest_rate, stream.rate);
      if (stream.flux == Stream::Flux::face || stream.flux == Stream::Flux::wall)
        largest_difference = std::max(largest_difference, std::abs(difference));
      own.emplace_back(stream.cell, stream.cell, scale * stream.rate);
      if (stream.from == Stream::From::rock_cell) of_rock.emplace_back(stream.cell, stream.index, -scale * stream.rate);
      if (stream.from == Stream::From::fracture_cell)
        of_fractures.emplace_back(stream.cell, stream.index, -scale * stream.rate);
      if (stream.from == Stream::From::well) {
        const WellMixture& well = *wells[stream.index];
        const double amount_by_temperature = -scale * stream.rate;
        for (const auto& [cell, value] : well.by_rock)
          of_rock.emplace_back(stream.cell, cell, amount_by_temperature * value);
        for (const auto& [cell, value] : well.by_fractures)
          of_fractures.emplace_back(stream.cell, cell, amount_by_temperature * value);
        for (const auto& [place_of_well, value] : well.by_rate)
          by_flux[static_cast<int>(Stream::Flux::well)].emplace_back(stream.cell, place_of_well,
                                                                     amount_by_temperature * value);
      }
      if (stream.flux != Stream::Flux::none)
        by_flux[static_cast<int>(stream.flux)].emplace_back(stream.cell, stream.flux_index,
                                                            scale * stream.by_flux * difference);
    }
    assembly.add(temperature, capacity.cwiseProduct(temperature.now() - temperature.accepted()));
    assembly.add(temperature, carried);
    assembly.compare_with(temperature, largest);
    assembly.compare_round_off(temperature, scale * largest_rate * temperature.now().lpNorm<Eigen::Infinity>());
    if (largest_difference > 0)  // fluxes through faces and walls are differences of larger numbers
      assembly.compare_round_off(temperature, scale * largest_difference * matrix_->round_off_base_of_fluxes());
    BalanceRows(assembly, temperature).add_throughput(through_sides);
    if (!assembly.wants_derivatives()) return;
    const auto block = [&](const std::vector<Triplet>& entries, int columns) {
      SparseMatrix matrix(temperature.size(), columns);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    };
    assembly.diagonal(temperature, temperature, capacity);
    std::vector<Triplet>& same = place.location == Location::cell ? of_rock : of_fractures;
    same.insert(same.end(), own.begin(), own.end());
    for (const auto& [other, entries] : {std::pair{&rock_, &of_rock}, std::pair{&fractures_, &of_fractures}})
      if (other->temperature && !entries->empty())
        assembly.derivative(temperature, *other->temperature, block(*entries, other->temperature->size()));
    const auto entries_of = [&](Stream::Flux flux) -> const std::vector<Triplet>& {
      return by_flux[static_cast<int>(flux)];
    };
    if (const auto& entries = entries_of(Stream::Flux::face); !entries.empty()) {
      const SparseMatrix of_faces = block(entries, mesh_.face_count());
      for (const MatrixFluxes::Derivative& derivative : matrix_->face_flux_derivatives())
        if (assembly.has_row(*derivative.field))
          assembly.derivative(temperature, *derivative.field, SparseMatrix(of_faces * *derivative.matrix));
    }
    if (const auto& entries = entries_of(Stream::Flux::wall); !entries.empty())
      assembly.derivative(temperature, walls_->wall_flux(), block(entries, mesh_.wall_count()));
    if (const auto& entries = entries_of(Stream::Flux::ridge); !entries.empty())
      assembly.derivative(temperature, fracture_->flux(), block(entries, fracture_->flux().size()));
    if (const auto& entries = entries_of(Stream::Flux::well); !entries.empty())
      assembly.derivative(temperature, wells_.wells->rate(), block(entries, wells_.wells->rate().size()));
  }

  void count(CarriedHeat& place, const std::vector<Stream>& streams, const Mixtures& wells, const StepTime& step) {
    std::vector<double> temperatures;
    for (const Stream& stream : streams) temperatures.push_back(temperature_of(place, stream, wells));
    const Vector& capacity = &place == &rock_ ? rock_heat_->heat_capacity() : fracture_heat_->heat_capacity();
    place.count(streams, temperatures, capacity, matrix_ ? matrix_->round_off_base_of_fluxes() : 0, step.dt);
  }

  const Mesh& mesh_;
  HeatAdvectionOptions options_;
  Origin origin_;
  MatrixFluxes* matrix_ = nullptr;
  FractureFluxes* fracture_ = nullptr;
  MatrixFluid* flow_in_rock_ = nullptr;
  MatrixWalls* walls_ = nullptr;
  MatrixTemperature* rock_heat_ = nullptr;
  FractureTemperature* fracture_heat_ = nullptr;
  HeatOfWells wells_;
  std::string other_aperture_;    ///< a note, or ""
  std::vector<Vector> at_start_;  ///< temperatures of the cells that fluid reaches, K
  CarriedHeat rock_, fractures_;
  std::optional<HeldFlow> flow_;
  std::vector<std::pair<std::string, double>> injected_;  ///< K, in this step
};

const RegisterCoupler<HeatAdvection, HeatAdvectionOptions> registration("heat_advection");

}  // namespace
}  // namespace sprekk::couplers
