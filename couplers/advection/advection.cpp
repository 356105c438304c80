// heat_advection, tracer_advection: flowing fluid carries heat, or a tracer, through the matrix, along fractures and
// through their walls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "components/capabilities/cold.hpp"
#include "components/capabilities/concentration.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_border.hpp"
#include "components/capabilities/temperature.hpp"
#include "couplers/advection/dispersion.hpp"
#include "couplers/advection/fluid_contents.hpp"
#include "couplers/advection/held_flow.hpp"
#include "couplers/advection/options.hpp"
#include "couplers/advection/streams.hpp"
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

/// Notes components that stand between no such coupler. `Matrix`, `Fracture`: the capabilities of what is carried.
template <class Matrix, class Fracture>
void note_not_carried(const Carried& carried, const std::vector<Component*>& components, Notes& notes) {
  const std::string coupler = carried.quantity + "_advection";
  for (const Component* flow : components)
    for (const Component* other : components) {
      const bool in_rock = dynamic_cast<const MatrixFluxes*>(flow) && dynamic_cast<const Matrix*>(other);
      const bool in_fractures = dynamic_cast<const FractureFluxes*>(flow) && dynamic_cast<const Fracture*>(other);
      if (!in_rock && !in_fractures) continue;
      notes.add("no " + coupler + " between " + flow->name() + " and " + other->name(),
                "the fluid of " + flow->name() + " carries no " + carried.quantity + " of " + other->name() +
                    " (no coupler " + coupler +
                    " stands between them) add one, with both in `between`, unless that is meant");
    }
}

/// Adds to the balance of each cell what streams of fluid carry (Stream). With the fluid m that has entered the cell
/// since the start (m^2), by the same streams, it stores c (m T − m_old T_old), and what enters is c dt q T of where it
/// comes from: T is the temperature and c the heat capacity of the fluid, or T the concentration of a tracer and c one.
/// Together with m = m_old + dt (sum of q) this is
///   c m_old (T − T_old) + c dt (sum over what enters of q (T − T_from)),
/// so that a uniform value stays uniform whatever the fluxes are, and nothing is lost or made: the amount is conserved
/// in each schedule, also where the streams are those of a flow that is solved before or after. What has entered by the
/// start of the step decays at the rate of the cell, c dt r m_old T: a uniform value stays uniform then, too.
class Advection : public Coupler, public KeepsState, public FollowsMesh, public KeepsTotals, public CountsAmounts {
 public:
  Advection(const CouplerContext& context, const Carried& carried, const AdvectionOptions& options,
            MatrixCarried* in_rock, FractureCarried* in_fractures)
      : Coupler(context.name),
        mesh_(context.mesh),
        carried_(carried),
        options_(options),
        origin_(context.origin),
        in_rock_(in_rock),
        in_fractures_(in_fractures) {
    matrix_ = context.find<MatrixFluxes>();
    fracture_ = context.find<FractureFluxes>();
    walls_ = context.find<MatrixWalls>();
    flow_in_rock_ = context.find<MatrixFluid>();
    if (!(matrix_ && in_rock_) && !(fracture_ && in_fractures_))
      throw InputError(
          context.origin, "coupler " + name() + " has no flow that carries " + carried_.quantity,
          "it needs the flow and the " + carried_.quantity + " of the matrix, of the fractures, or of both",
          "name such components in `between`, or remove the coupler for conduction alone");
    if (in_rock_ && matrix_) rock_ = contents(context, *in_rock_, Location::cell, "rock");
    if (in_fractures_ && fracture_)
      fractures_ = contents(context, *in_fractures_, Location::fracture_cell, "fractures");
    if (auto* formulas = dynamic_cast<TakesState*>(fracture_); formulas && fractures_.value && carried_.in_formulas)
      formulas->offer_state(carried_.in_formulas, {fractures_.value});
    find_wells(context);
    for (const FluidContents* place : {&rock_, &fractures_})
      if (place->value) at_start_.push_back(place->value->now());
    if (fractures_.value) compare_apertures(context);
    flow_.emplace(context,
                  CarryingFlow{rock_.value ? matrix_ : nullptr, flow_in_rock_ ? &flow_in_rock_->pressure() : nullptr,
                               walls_, fracture_, wells_.wells});
  }

  /// What is carried through the walls in a step is the same for both sides.
  std::vector<Dependence> dependences() const override {
    if (!rock_.value || !fractures_.value) return {};
    const std::string rock = rock_.value->spec().owner, fracture = fractures_.value->spec().owner;
    const std::string because = "what the fluid carries out of the one it carries into the other in the same step";
    return {{rock, fracture, because}, {fracture, rock, because}};
  }

  void evaluate_data(const StepTime& step) override {
    const auto* border = dynamic_cast<const MatrixBorder*>(matrix_);
    if (border && border->has_open_border())
      throw DataError(InputError(origin_, "the fluid of coupler " + name() + " crosses the border to another flow",
                                 carried_.quantity + " is carried by one flow, which has all the fluid of the rock",
                                 "take one flow whose parameters differ by region")
                          .what());
    injected_.clear();
    for (const auto& [name, given] : options_.injected)
      injected_.emplace_back(name, value_in_step(given.value, Place{}, step));
    check_names();
    wells_.injected = injected_by_wells();
    wells_.check(name());
    if (rock_.value) rock_.check(in_rock_->capacity(), name());
    if (fractures_.value) fractures_.check(in_fractures_->capacity(), name());
    disperse(true, true);
  }
  void begin_step(const StepTime&) override {}

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const auto has_row = [&](const Field& field) { return assembly.has_row(field); };
    const bool is_in_rock = rock_.value && has_row(*rock_.value);
    const bool is_in_fractures = fractures_.value && has_row(*fractures_.value);
    if (!is_in_rock && !is_in_fractures) return;
    // As long as no solve has found the flow, what is solved before it is not carried: the fluxes of initial
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
    const bool is_in_rock = rock_.value && has(*rock_.value);
    const bool is_in_fractures = fractures_.value && has(*fractures_.value);
    disperse(rock_.value && flow_in_rock_ && !is_in_rock && has(flow_in_rock_->pressure()),
             fractures_.value && !is_in_fractures && has(fracture_->flux()));
    if (!is_in_rock && !is_in_fractures) return;
    disperses_late_ = !options_.dispersivity.is_zero() &&
                      std::ranges::any_of(flow_->fields(), [&](const Field* field) { return has(*field); });
    const FlowRates rates = flow_->rates(has, step);
    const Mixtures wells = wells_.mixtures(rates.wells);
    if (is_in_rock) count(rock_, streams_of_rock(sources(), rates, flow_->fluxes_in_rock(has, step)), wells, step);
    if (is_in_fractures) count(fractures_, streams_of_fractures(sources(), rates), wells, step);
  }

  void carry_over(const Part& before, const MeshChange&) override {
    flow_->carry_over(*dynamic_cast<const Advection&>(before).flow_);
  }
  void accepted() override { flow_->accepted(); }
  void rewound() override { flow_->rewound(); }
  void save(std::map<std::string, Vector>& state) const override { flow_->save(state); }
  void restore(const std::map<std::string, Vector>& state) override { flow_->restore(state); }

  void begin_totals() override {
    flow_->begin(true);
    for (const FluidContents* place : {&rock_, &fractures_})
      if (place->value) place->cumulative->set_both(Vector::Zero(place->cumulative->size()));
  }

  /// The capacity of cells is that with the fluid that they have in the settled state.
  void count_amounts_from_here(const SettledFields& settled) override {
    const auto is_settled = [&](const Field* field) { return settled.contain(*field); };
    flow_->begin(std::ranges::any_of(flow_->fields(), is_settled));
    for (const FluidContents* place : {&rock_, &fractures_})
      if (place->value) place->received->set_both(Vector::Zero(place->received->size()));
  }

  void balance(std::map<std::string, Balance>& balances) const override {
    Balance& balance = balances[carried_.quantity];
    balance.unit = carried_.amount_unit;
    for (const FluidContents* place : {&rock_, &fractures_})
      if (place->value) place->add_to(balance);
  }

  /// The value of the fluid that leaves at each named place of the flow, or of that which enters.
  void report(std::vector<Quantity>& quantities) const override {
    const auto mean = [&](const std::string& place, const Vector& value, auto&& rates) {
      double rate = 0, sum = 0;
      for (const auto& [cell, each] : rates) {
        rate += std::abs(each);
        sum += std::abs(each) * value[cell];
      }
      quantities.push_back({name() + "." + place + "." + carried_.value, carried_.unit, rate > 0 ? sum / rate : 0.0});
    };
    const FlowRates now = flow_->rates([](const Field&) { return true; }, {});
    const Mixtures fluid = wells_.mixtures(now.wells);
    for (std::size_t well = 0; well < fluid.size(); ++well)
      if (fluid[well])
        quantities.push_back(
            {name() + "." + wells_.wells->names()[well] + "." + carried_.value, carried_.unit, fluid[well]->value});
    if (rock_.value)
      for (const FluidSource& source : matrix_->fluid_sources())
        if (source.name != "source") mean(source.name, rock_.value->now(), source.rates);
    if (!fractures_.value) return;
    const Vector& value = fractures_.value->now();
    for (const FluidSource& source : fracture_->fluid_sources()) mean(source.name, value, source.rates);
    for (const FluidReservoir& reservoir : fracture_->fluid_reservoirs()) {
      std::vector<std::pair<int, double>> rates;
      for (const Stream& stream : streams_of_fractures(sources(), now))
        if (stream.flux == Stream::Flux::none && std::ranges::count(reservoir.cells, stream.cell))
          rates.emplace_back(stream.cell, stream.rate);
      mean(reservoir.name, value, rates);
    }
  }

  void note_input(Notes& notes) const override {
    std::vector<const Data*> given;
    for (const auto& [place, injected] : options_.injected) given.push_back(&injected.value);
    if (carried_.has_absolute_zero)
      for (const Vector& at_start : at_start_) note_cold(notes, name(), at_start, given);
    if (!other_aperture_.empty()) notes.add(name() + ": another aperture for " + carried_.quantity, other_aperture_);
  }
  void note_step(Notes& notes, const StepTime&) const override {
    wells_.note(name(), notes);
    if (disperses_late_)
      notes.add(name() + ": dispersion of the step before",
                "the dispersion of '" + name() +
                    "' is that of the flow of the step before, and none in the first step (" + carried_.quantity +
                    " and flow are in one 'solve') solve the flow before, in a step of its own");
  }

  std::vector<double> switch_times() const override {
    std::vector<const Data*> data;
    for (const auto& [name, given] : options_.injected) data.push_back(&given.value);
    return merged_switch_times(data);
  }

 private:
  /// Gives dispersion, where there is any, by the flow as it was last solved.
  void disperse(bool in_rock, bool in_fractures) {
    if (options_.dispersivity.is_zero() || !flow_->has_flowed()) return;
    if (const Vector* fluxes = flow_->last_fluxes_in_rock(); fluxes && in_rock && rock_.value)
      in_rock_->add_conductivity(dispersion_in_rock(mesh_, *fluxes, options_.dispersivity));
    if (in_fractures && fractures_.value)
      in_fractures_->add_conductivity(dispersion_in_fractures(mesh_, fracture_->flux().now(), options_.dispersivity));
  }

  StreamSources sources() const {
    StreamSources sources{mesh_, fracture_};
    sources.in_rock = rock_.value ? in_rock_ : nullptr;
    sources.in_fractures = fractures_.value ? in_fractures_ : nullptr;
    sources.unknown = carried_.of_unknown_fluid;
    sources.injected = injected_;
    sources.wells = wells_.wells;
    sources.rock_pressure = wells_.rock.pressure;
    sources.fracture_pressure = wells_.fractures.pressure;
    return sources;
  }

  template <class Medium>
  FluidContents contents(const CouplerContext& context, Medium& medium, Location location, const char* where) const {
    return {context, carried_, medium.value(), location, where, options_.per_volume, medium.decay()};
  }

  /// Looks for fracture cells that hold what is carried in another thickness than their fluid.
  void compare_apertures(const CouplerContext& context) {
    const FractureFluid* fluid = context.find<FractureFluid>();
    const Vector* of_carried = in_fractures_->thickness();
    if (!fluid || !of_carried) return;
    const Vector& of_fluid = fluid->initial_aperture();
    double worst = rounding_of_aperture;
    for (int i = 0; i < of_carried->size(); ++i) {
      const double larger = std::max(of_fluid[i], (*of_carried)[i]),
                   difference = std::abs(of_fluid[i] - (*of_carried)[i]);
      if (of_fluid[i] <= 0 || difference <= worst * larger) continue;
      worst = difference / larger;
      const FractureCell& cell = mesh_.fracture_cells[i];
      other_aperture_ = fmt::format(
          "the fracture '{}' is {:.4g} m wide for its {} and {:.4g} m for its fluid at {} (so it stores the {} of "
          "another amount of fluid than flows in it) give 'aperture' of '{}' the initial_aperture of the flow",
          mesh_.fractures[cell.fracture].name, (*of_carried)[i], carried_.quantity, of_fluid[i], to_text(cell.center),
          carried_.quantity, in_fractures_->value().spec().owner);
    }
  }

  void find_wells(const CouplerContext& context) {
    const std::string left_out = context.left_out<WellPressures>();
    if (!left_out.empty())
      throw InputError(context.origin, "coupler " + name() + " leaves out '" + left_out + "'",
                       "the fluid of these wells carries " + carried_.quantity + ", too",
                       "name '" + left_out + "' in 'between'");
    wells_.wells = context.find<WellPressures>();
    wells_.carried = &carried_;
    if (!wells_.wells) return;
    if (auto* fluid = context.find<MatrixFluid>()) wells_.rock = {&fluid->pressure(), rock_.value};
    if (auto* fluid = context.find<FractureFluid>()) wells_.fractures = {&fluid->pressure(), fractures_.value};
  }

  /// Of what comes into wells from outside.
  std::vector<std::optional<double>> injected_by_wells() const {
    std::vector<std::optional<double>> values;
    if (wells_.wells)
      for (const std::string& well : wells_.wells->names()) {
        const auto given = std::ranges::find(injected_, well, &std::pair<std::string, double>::first);
        values.push_back(given == injected_.end() ? carried_.of_unknown_fluid : std::optional(given->second));
      }
    return values;
  }

  /// Throws DataError for a value of a place that the flow does not have.
  void check_names() const {
    std::vector<std::string> known;
    if (rock_.value)
      for (const FluidSource& source : matrix_->fluid_sources()) known.push_back(source.name);
    if (fractures_.value) {
      for (const FluidSource& source : fracture_->fluid_sources()) known.push_back(source.name);
      for (const FluidReservoir& reservoir : fracture_->fluid_reservoirs()) known.push_back(reservoir.name);
    }
    if (wells_.wells) known.insert(known.end(), wells_.wells->names().begin(), wells_.wells->names().end());
    for (const auto& [name, given] : options_.injected)
      if (!std::ranges::count(known, name))
        throw DataError(unknown_name(given.origin, "place where the flow lets fluid in", name, known).what());
  }

  double value_of(const FluidContents& place, const Stream& stream, const Mixtures& wells) const {
    const double own = place.value->now()[stream.cell];
    if (stream.rate <= 0) return own;
    switch (stream.from) {
      case Stream::From::given:
        return stream.value;
      case Stream::From::well:
        return wells[stream.index]->value;
      case Stream::From::rock_cell:
        return rock_.value->now()[stream.index];
      case Stream::From::fracture_cell:
        return fractures_.value->now()[stream.index];
      case Stream::From::own:
        break;
    }
    return own;
  }

  void add(Assembly& assembly, const FluidContents& place, const std::vector<Stream>& streams, const Mixtures& wells,
           const StepTime& step) const {
    const Field& unknown = *place.value;
    const double scale = options_.per_volume * step.dt;
    const Vector capacity = place.capacity_at_start();
    Vector carried = Vector::Zero(unknown.size()), through_sides = carried;
    double largest = 0, largest_rate = 0, largest_difference = 0;
    std::vector<Triplet> own, of_rock, of_fractures;
    std::array<std::vector<Triplet>, 4> by_flux;  // by Stream::Flux
    for (const Stream& stream : streams) {
      SPREKK_ASSERT(std::isfinite(stream.rate), stream.cell, stream.rate);
      if (stream.rate <= 0 || stream.from == Stream::From::own) continue;
      const double difference = unknown.now()[stream.cell] - value_of(place, stream, wells);
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
        const double amount_by_value = -scale * stream.rate;
        for (const auto& [cell, value] : well.by_rock) of_rock.emplace_back(stream.cell, cell, amount_by_value * value);
        for (const auto& [cell, value] : well.by_fractures)
          of_fractures.emplace_back(stream.cell, cell, amount_by_value * value);
        for (const auto& [place_of_well, value] : well.by_rate)
          by_flux[static_cast<int>(Stream::Flux::well)].emplace_back(stream.cell, place_of_well,
                                                                     amount_by_value * value);
      }
      if (stream.flux != Stream::Flux::none)
        by_flux[static_cast<int>(stream.flux)].emplace_back(stream.cell, stream.flux_index,
                                                            scale * stream.by_flux * difference);
      for (const auto& [ridge, by_flux_there] : stream.by_ridges)
        by_flux[static_cast<int>(Stream::Flux::ridge)].emplace_back(stream.cell, ridge,
                                                                    scale * by_flux_there * difference);
    }
    assembly.add(unknown, capacity.cwiseProduct(unknown.now() - unknown.accepted()));
    assembly.add(unknown, carried);
    const Vector decaying = place.decay.size() > 0 ? Vector(step.dt * place.decay.cwiseProduct(capacity)) : Vector();
    if (decaying.size() > 0) BalanceRows(assembly, unknown).supply(-decaying.cwiseProduct(unknown.now()));
    assembly.compare_with(unknown, largest);
    assembly.compare_round_off(unknown, scale * largest_rate * unknown.now().lpNorm<Eigen::Infinity>());
    if (largest_difference > 0)  // fluxes through faces and walls are differences of larger numbers
      assembly.compare_round_off(unknown, scale * largest_difference * matrix_->round_off_base_of_fluxes());
    BalanceRows(assembly, unknown).add_throughput(through_sides);
    if (!assembly.wants_derivatives()) return;
    const auto block = [&](const std::vector<Triplet>& entries, int columns) {
      SparseMatrix matrix(unknown.size(), columns);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    };
    assembly.diagonal(unknown, unknown, capacity);
    if (decaying.size() > 0) assembly.diagonal(unknown, unknown, decaying);
    std::vector<Triplet>& same = place.location == Location::cell ? of_rock : of_fractures;
    same.insert(same.end(), own.begin(), own.end());
    for (const auto& [other, entries] : {std::pair{&rock_, &of_rock}, std::pair{&fractures_, &of_fractures}})
      if (other->value && !entries->empty())
        assembly.derivative(unknown, *other->value, block(*entries, other->value->size()));
    const auto entries_of = [&](Stream::Flux flux) -> const std::vector<Triplet>& {
      return by_flux[static_cast<int>(flux)];
    };
    if (const auto& entries = entries_of(Stream::Flux::face); !entries.empty()) {
      const SparseMatrix of_faces = block(entries, mesh_.face_count());
      for (const MatrixFluxes::Derivative& derivative : matrix_->face_flux_derivatives())
        if (assembly.has_row(*derivative.field))
          assembly.derivative(unknown, *derivative.field, SparseMatrix(of_faces * *derivative.matrix));
    }
    if (const auto& entries = entries_of(Stream::Flux::wall); !entries.empty())
      assembly.derivative(unknown, walls_->wall_flux(), block(entries, mesh_.wall_count()));
    if (const auto& entries = entries_of(Stream::Flux::ridge); !entries.empty())
      assembly.derivative(unknown, fracture_->flux(), block(entries, fracture_->flux().size()));
    if (const auto& entries = entries_of(Stream::Flux::well); !entries.empty())
      assembly.derivative(unknown, wells_.wells->rate(), block(entries, wells_.wells->rate().size()));
  }

  void count(FluidContents& place, const std::vector<Stream>& streams, const Mixtures& wells, const StepTime& step) {
    std::vector<double> values;
    for (const Stream& stream : streams) values.push_back(value_of(place, stream, wells));
    const Vector& capacity = &place == &rock_ ? in_rock_->capacity() : in_fractures_->capacity();
    place.count(streams, values, capacity, matrix_ ? matrix_->round_off_base_of_fluxes() : 0, step.dt);
  }

  const Mesh& mesh_;
  const Carried& carried_;
  AdvectionOptions options_;
  Origin origin_;
  MatrixCarried* in_rock_;
  FractureCarried* in_fractures_;
  MatrixFluxes* matrix_ = nullptr;
  FractureFluxes* fracture_ = nullptr;
  MatrixFluid* flow_in_rock_ = nullptr;
  MatrixWalls* walls_ = nullptr;
  ValuesOfWells wells_;
  std::string other_aperture_;    ///< a note, or ""
  std::vector<Vector> at_start_;  ///< values of the cells that fluid reaches
  FluidContents rock_, fractures_;
  std::optional<HeldFlow> flow_;
  std::vector<std::pair<std::string, double>> injected_;  ///< values in this step
  bool disperses_late_ = false;  ///< whether the last solve had a flow with which dispersion could not go
};

/// Flowing fluid carries heat.
class HeatAdvection : public Advection {
 public:
  HeatAdvection(const CouplerContext& context, const HeatAdvectionOptions& options)
      : Advection{context, carried_heat, options, context.find<MatrixTemperature>(),
                  context.find<FractureTemperature>()} {}
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    note_not_carried<MatrixTemperature, FractureTemperature>(carried_heat, components, notes);
  }
};

/// Flowing fluid carries a tracer.
class TracerAdvection : public Advection {
 public:
  TracerAdvection(const CouplerContext& context, const TracerAdvectionOptions& options)
      : Advection{context, carried_tracer, options, context.find<MatrixConcentration>(),
                  context.find<FractureConcentration>()} {}
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    note_not_carried<MatrixConcentration, FractureConcentration>(carried_tracer, components, notes);
    bool flows = false;
    for (const Component* each : components)
      flows = flows || dynamic_cast<const MatrixFluxes*>(each) || dynamic_cast<const FractureFluxes*>(each);
    for (const Component* each : components)
      if (!flows &&
          (dynamic_cast<const MatrixConcentration*>(each) || dynamic_cast<const FractureConcentration*>(each)))
        notes.add("nothing carries the tracer of " + each->name(),
                  "nothing carries the tracer of '" + each->name() +
                      "' (the scene has no flow) it diffuses alone; add a flow and a coupler tracer_advection, unless "
                      "that is meant");
  }
};

const RegisterCoupler<HeatAdvection, HeatAdvectionOptions> heat_registration("heat_advection");
const RegisterCoupler<TracerAdvection, TracerAdvectionOptions> tracer_registration("tracer_advection");

}  // namespace
}  // namespace sprekk::couplers
