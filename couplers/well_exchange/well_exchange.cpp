// well_exchange: fluid flows between wells and the rock or the fractures in which they are open.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/capabilities/bore_holes.hpp"
#include "components/capabilities/fluid_density.hpp"
#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/wells.hpp"
#include "couplers/well_exchange/early_resistance.hpp"
#include "couplers/well_exchange/rock_openings.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/discretization/principal_axes.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct WellExchangeOptions {
  Spec spec() {
    Spec spec("well_exchange",
              "Flow between wells and the rock or the fractures in which they are open, driven by the difference of "
              "their pressures.");
    spec.ignore("type").ignore("between");
    return spec;
  }
};

/// Determines the rate q of each place of the wells, out of the well: R q = p_well − p, with the pressure p of the
/// cells at the place, among which the rate is shared (point_source, FractureFluid::shares_at). In rock R =
/// (ln(r_e/r_w) + skin)/(2 pi sqrt(det M)), Peaceman's index, and what a rate that changes adds to it
/// (EarlyResistance): weight_k m_k/(2 pi sqrt(det M)), dm_k/dt = dq/dt − m_k c/scale_k. In a fracture R is that of the
/// fracture between the place and the centres of cells (FractureFluid::rise_at), which is zero in the middle of a cell;
/// in space that around a bore hole (BoreHolesInFractures).
/// R = 1/index where the scene gives one. The rows are pressures: as rates, a place with a small index would be judged
/// by what flows at one with a large index. The terms of the rock are constant, whichever limit of the well binds: what
/// switches is on the side of the wells.
class WellExchange : public Coupler, public FollowsMesh {
 public:
  WellExchange(const CouplerContext& context, const WellExchangeOptions&)
      : Coupler(context.name),
        mesh_(context.mesh),
        wells_(context.the<WellPressures>()),
        rock_(context.find<MatrixFluid>()),
        fluxes_(context.find<MatrixFluxes>()),
        fracture_(context.find<FractureFluid>()),
        bores_(context.find<BoreHolesInFractures>()),
        rock_weight_(context.find<BuoyantMatrix>()),
        fracture_weight_(context.find<BuoyantFractures>()),
        places_(wells_.places()),
        cells_(places_.size(), none),
        around_(places_.size()),
        log_of_radii_(Vector::Zero(count())),
        early_(places_.size()),
        diffusivity_(Vector::Zero(count())),
        memory_(context.fields.add(mesh_, memory_spec(context, wells_.rate(), count()))),
        resistance_(Vector::Zero(count())),
        level_(Vector::Zero(count())),
        weight_(Vector::Zero(count())) {
    context.determine(wells_.rate());
    std::vector<Triplet> of_wells;
    for (int k = 0; k < count(); ++k) {
      of_wells.emplace_back(k, places_[k].well, -1.0);
      places_[k].fracture ? open_to_fracture(k, context) : check_rock(k);
    }
    open_to_rock();
    of_wells_ = operator_of(of_wells, wells_.pressure().size());
    find_weights();
    use(around_);
    Vector around = level_ - weight_;
    if (rock_) around += of_rock_.entries() * rock_->initial_pressure();
    if (fracture_) around += of_fracture_.entries() * fracture_->pressure().now();
    wells_.begin_with(around);
  }

  bool allows_stages() const override { return true; }

  /// Wells and the cells around them must be solved together, or a rate would count differently on both sides.
  std::vector<Dependence> dependences() const override {
    std::vector<Dependence> pairs;
    const std::string wells = wells_.rate().spec().owner;
    const auto need = [&](Field& pressure) {
      const std::string because = "what leaves a well enters what is around it in the same step";
      pairs.push_back({wells, pressure.spec().owner, because});
      pairs.push_back({pressure.spec().owner, wells, because});
    };
    if (rock_) need(rock_->pressure());
    if (fracture_) need(fracture_->pressure());
    return pairs;
  }

  void begin_step(const StepTime&) override {
    Vector of_wells(count());
    std::vector<AroundWell> around = around_;
    for (int k = 0; k < count(); ++k) {
      if (places_[k].fracture) around[k].shares = fracture_->shares_at(cells_[k], places_[k].at);
      if (places_[k].index)
        resistance_[k] = 1 / *places_[k].index;
      else if (!places_[k].fracture)
        use_rock(k);
      double scale = resistance_[k];
      if (scale == 0) {
        const double conductance = fracture_->conductance(cells_[k]);
        scale = conductance > 0 ? 1 / conductance : 1;  // what bore holes add does not vary by much
      }
      of_wells[k] = scale;
      SPREKK_ASSERT(std::isfinite(scale) && scale > 0, k, scale);
    }
    wells_.scale(of_wells);
    use(std::move(around));
  }

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const Field& rate = wells_.rate();
    if (rock_) supply(assembly, rock_->pressure(), into_rock_, step.dt);
    if (fracture_) supply(assembly, fracture_->pressure(), into_fracture_, step.dt);
    if (!assembly.has_row(rate)) return;
    assembly.linear(rate, of_wells_, wells_.pressure());
    if (rock_) assembly.linear(rate, of_rock_, rock_->pressure());
    if (fracture_) assembly.linear(rate, of_fracture_, fracture_->pressure());
    Vector of_rate = resistance_;
    add_early(assembly, step, of_rate);
    add_rise(assembly, of_rate);
    assembly.add(rate, of_rate.cwiseProduct(rate.now()));
    if (const Vector known = level_ - weight_; !known.isZero(0)) assembly.add(rate, known);
    assembly.diagonal(rate, rate, of_rate);
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override {
    const Field& rate = wells_.rate();
    if (std::ranges::find(solved, &rate) == solved.end()) return;
    Vector memory = memory_.accepted();
    const Vector change = rate.now() - rate.accepted();
    for (int k = 0; k < count(); ++k)
      for (int i = 0; i < early_terms; ++i) {
        double& value = memory[early_terms * k + i];
        value = kept(k, i, step.dt) * (value + change[k]);
      }
    memory_.set(std::move(memory));
  }

  /// Where the well is in another cell than before, the flow around it counts as steady.
  void carry_over(const Part& part, const MeshChange&) override {
    const auto& before = dynamic_cast<const WellExchange&>(part);
    Vector memory = memory_.now();
    for (int k = 0; k < count(); ++k)
      if (early_[k].scales != before.early_[k].scales) memory.segment<early_terms>(early_terms * k).setZero();
    memory_.set_both(std::move(memory));
  }

  void note_input(Notes& notes) const override {
    if ((!rock_weight_ || !rock_weight_->density_varies()) &&
        (!fracture_weight_ || !fracture_weight_->density_varies()))
      return;
    for (int k = 0; k < count(); ++k)
      if (weight_[k] != 0)
        notes.add(name() + ": fluid in wells has one density",
                  "the fluid between the places of well '" + places_[k].name +
                      "' has the constant density of the flow (a density that follows temperature and pressure counts "
                      "around wells, not in them) make a well of each place where that matters",
                  std::abs(weight_[k]));
  }

 private:
  int count() const { return static_cast<int>(places_.size()); }

  static Operator operator_of(const std::vector<Triplet>& entries, int rows, int columns) {
    return Operator(matrix_of(rows, columns, entries));
  }
  Operator operator_of(const std::vector<Triplet>& entries, int columns) const {
    return operator_of(entries, count(), columns);
  }
  /// The pressure at the places, and the same transposed: what rates bring.
  void use(const std::vector<Triplet>& weights, int cells, Operator& of_cells, Operator& into_cells) const {
    std::vector<Triplet> transposed;
    for (const Triplet& entry : weights) transposed.emplace_back(entry.col(), entry.row(), entry.value());
    of_cells = operator_of(weights, cells);
    into_cells = operator_of(transposed, cells, count());
  }

  /// Shares change where fractures open; the operators of the rock stay.
  void use(std::vector<AroundWell> around) {
    const auto is_same = [](const AroundWell& one, const AroundWell& other) { return one.shares == other.shares; };
    if (has_operators_ && std::ranges::equal(around, around_, is_same)) return;
    around_ = std::move(around);
    wells_.accept_surroundings(around_);
    std::vector<Triplet> of_rock, of_fracture;
    for (int k = 0; k < count(); ++k) {
      const bool in_fracture = places_[k].fracture.has_value();
      level_[k] = 0;
      for (const auto& [cell, share] : around_[k].shares) {
        (in_fracture ? of_fracture : of_rock).emplace_back(k, cell, share);
        if (in_fracture) level_[k] += share * weight_between(k, mesh_.fracture_cells[cell].center, middle(k));
      }
    }
    if (rock_ && !has_operators_) use(of_rock, mesh_.cell_count(), of_rock_, into_rock_);
    if (fracture_) use(of_fracture, mesh_.fracture_cell_count(), of_fracture_, into_fracture_);
    has_operators_ = true;
  }

  /// Adds the resistance of fractures between places and the centres of cells.
  void add_rise(Assembly& assembly, Vector& of_rate) const {
    if (!fracture_) return;
    std::vector<Triplet> by_aperture;
    for (int k = 0; k < count(); ++k) {
      if (!places_[k].fracture || places_[k].index) continue;
      const FractureFluid::Rise rise = dimension == 2 ? fracture_->rise_at(cells_[k], places_[k].at)
                                                      : bores_->rise_at_bore(cells_[k], log_of_radii_[k]);
      of_rate[k] += rise.value;
      for (const auto& [cell, by] : rise.by_aperture) by_aperture.emplace_back(k, cell, by * wells_.rate().now()[k]);
    }
    if (by_aperture.empty() || !assembly.wants_derivatives()) return;
    assembly.derivative(wells_.rate(), fracture_->aperture(),
                        matrix_of(count(), mesh_.fracture_cell_count(), by_aperture));
  }

  void supply(Assembly& assembly, const Field& pressure, const Operator& into, double dt) const {
    if (!assembly.has_row(pressure)) return;
    assembly.linear(pressure, into, wells_.rate(), -dt);
    BalanceRows(assembly, pressure).add_throughput(dt * (into.entries() * wells_.rate().now()));
  }

  double weight_between(int place, const Point& from, const Point& to) const {
    if (places_[place].fracture) return fracture_weight_ ? fracture_weight_->weight_between(from, to) : 0;
    return rock_weight_ ? rock_weight_->weight_between(from, to) : 0;
  }
  /// The point for the pressure around a place: in rock the mean of the centres of cells, weighted by their shares of
  /// the rate.
  Point middle(int place) const {
    if (places_[place].fracture) return fracture_->point_at(cells_[place], places_[place].at);
    Point mean = Point::Zero();
    for (const auto& [cell, share] : around_[place].shares) mean += share * mesh_.cell_center[cell];
    return mean;
  }

  /// The higher end of a piece of a line, or else middle(place).
  Point highest_point(int place) const {
    const std::optional<WellPlace::Piece>& piece = places_[place].piece;
    if (!piece) return middle(place);
    return weight_between(place, piece->from, piece->to) < 0 ? piece->to : piece->from;
  }

  /// A column of fluid at rest stands in each well; the pressure of the well is that at its highest place.
  void find_weights() {
    std::vector<std::optional<Point>> highest(wells_.pressure().size());
    for (int k = 0; k < count(); ++k) {
      std::optional<Point>& best = highest[places_[k].well];
      const Point point = highest_point(k);
      if (!best || weight_between(k, *best, point) < 0) best = point;
    }
    for (int k = 0; k < count(); ++k) weight_[k] = weight_between(k, *highest[places_[k].well], middle(k));
  }

  void open_to_fracture(int k, const CouplerContext& context) {
    cells_[k] = fracture_cell(places_[k], context);
    around_[k] = {&fracture_->pressure(), {{cells_[k], 1.0}}};
    const WellPlace& place = places_[k];
    if (dimension == 2 || place.index) return;
    if (!bores_)
      throw InputError(place.origin, "the index of well '" + place.name + "' is not known",
                       "this flow in fractures does not tell what a bore hole feels", "give its 'index'");
    log_of_radii_[k] = bores_->log_of_radii(cells_[k], place.at, widened_radius(place), place.origin);
    log_of_radii_[k] += skin_beside_radius(place);
  }

  int fracture_cell(const WellPlace& place, const CouplerContext& context) const {
    if (!fracture_)
      throw InputError(place.origin, "well '" + place.name + "' is open to a fracture without fluid",
                       "coupler " + context.name + " stands between no flow in fractures",
                       "name the flow in fractures in its `between`, or remove 'fracture'");
    const int fracture = find_fracture(mesh_, *place.fracture);
    std::vector<std::string> names;
    for (const Fracture& each : mesh_.fractures) names.push_back(each.name);
    if (fracture == none) throw unknown_name(place.origin, "fracture", *place.fracture, names);
    const int nearest = nearest_fracture_cell(
        mesh_, place.at, [&](int cell) { return mesh_.fracture_cells[cell].fracture == fracture; });
    const FractureCell& cell = mesh_.fracture_cells[nearest];
    const double away = (cell.center - place.at).norm(), size = cell.size();
    if (away > size)
      throw InputError(place.origin, "well '" + place.name + "' is not on fracture '" + *place.fracture + "'",
                       fmt::format("the nearest cell is {:.3g} m away and only {:.3g} m long", away, size),
                       "move it onto the fracture");
    if (!fracture_->is_in_fracture_cell(nearest))
      throw InputError(place.origin, "well '" + place.name + "' is open to a fracture without fluid",
                       "the flow does not live on fracture '" + *place.fracture + "'",
                       "name the fracture in 'fractures' of the flow, or move the well");
    return nearest;
  }

  static FieldSpec memory_spec(const CouplerContext& context, const Field& rate, int count) {
    return {.owner = context.name,
            .name = "memory",
            .location = Location::listed,
            .components = early_terms,
            .listed = count,
            .role = Role::derived(),
            .unit = volume_rate_unit,
            .doc = "Rates that have changed a while ago and still change the resistance of the rock around wells",
            .accepted_with = rate.name()};
  }

  double conductance_of_rock(int k) const {
    return 2 * std::numbers::pi * open_length(places_[k]) * mobility_across(places_[k], mobility_at(k));
  }
  const Tensor& mobility_at(int k) const { return fluxes_->mobility()[cells_[k]]; }

  /// The resistance of a place in rock, and the diffusivity around it in the metric of its index.
  void use_rock(int k) {
    resistance_[k] = log_of_radii_[k] / conductance_of_rock(k);
    const double largest = principal_axes(mobility_at(k)).values.maxCoeff();
    diffusivity_[k] = rock_->diffusivity(cells_[k]) * mobility_across(places_[k], mobility_at(k)) / largest;
  }

  /// The factor by which a step of backward Euler reduces m_k.
  double kept(int k, int term, double dt) const {
    const double scale = early_[k].scales[term];
    return scale > 0 ? 1 / (1 + diffusivity_[k] * dt / scale) : 0;
  }

  /// Adds the resistance at early times: to the factors of the rates, and its known part to the rows.
  void add_early(Assembly& assembly, const StepTime& step, Vector& of_rate) const {
    const Field& rate = wells_.rate();
    Vector known = Vector::Zero(count());
    for (int k = 0; k < count(); ++k)
      for (int i = 0; i < early_terms; ++i) {
        const double weight = early_[k].weights[i];
        if (weight == 0) continue;
        const double factor = weight * kept(k, i, step.dt) / conductance_of_rock(k);
        of_rate[k] += factor;
        known[k] += factor * (memory_.accepted()[early_terms * k + i] - rate.accepted()[k]);
      }
    if (!known.isZero(0)) assembly.add(rate, known);
  }

  /// Finds the cell of a place in rock.
  void check_rock(int k) {
    const WellPlace& place = places_[k];
    if (!rock_ || !fluxes_)
      throw InputError(place.origin, "well '" + place.name + "' is open to rock without fluid",
                       "its coupler stands between no flow in the matrix",
                       "name the flow in the matrix in `between`, or the fracture in which it is open");
    const int home = place.piece ? place.piece->cell : PointLocation(mesh_).cell_at(place.at);
    if (home == none)
      throw InputError(place.origin, "well '" + place.name + "' lies outside the " + medium_name(),
                       "there is no cell at its position", "move it inside");
    if (!rock_->is_in_cell(home))
      throw InputError(place.origin, "well '" + place.name + "' is open to rock without fluid",
                       "the flow does not live in the region " + mesh_.region_names[mesh_.cell_region[home]],
                       "move the well, or name the region in 'regions' of the flow");
    cells_[k] = home;
    if (fluxes_->mobility_follows_state()) {
      if (!place.index)
        throw InputError(place.origin, "the index of well '" + place.name + "' is not known",
                         "the permeability of its rock follows the state, and the index would follow it as well",
                         "give its 'index', or a permeability that does not depend on the state");
    } else if (!(mobility_at(k).determinant() > 0)) {
      throw InputError(place.origin, "well '" + place.name + "' is open to rock that lets no fluid through",
                       "its permeability is zero", "give it a permeability, or move the well");
    }
  }

  /// The cells of all places in rock, and their indices.
  void open_to_rock() {
    if (!rock_ || !fluxes_) return;
    std::vector<int> cells = cells_;
    for (int k = 0; k < count(); ++k)
      if (places_[k].fracture) cells[k] = none;
    const std::vector<RockOpening> openings = rock_openings(mesh_, *rock_, *fluxes_, places_, cells);
    for (int k = 0; k < count(); ++k) {
      if (places_[k].fracture) continue;
      around_[k] = {&rock_->pressure(), openings[k].shares};
      early_[k] = openings[k].early;
      log_of_radii_[k] = early_[k].log_of_radii;
    }
  }

  const Mesh& mesh_;
  WellPressures& wells_;
  MatrixFluid* rock_;
  MatrixFluxes* fluxes_;
  FractureFluid* fracture_;
  const BoreHolesInFractures* bores_;
  const BuoyantMatrix* rock_weight_;
  const BuoyantFractures* fracture_weight_;
  const std::vector<WellPlace>& places_;
  std::vector<int> cells_;          ///< in which places lie, of the rock or of the fracture
  std::vector<AroundWell> around_;  ///< what shares the rate of each place
  Vector log_of_radii_;             ///< ln(r_e/r_w) + skin without a given index; of places in fractures in space only
  std::vector<EarlyResistance> early_;  ///< one a place; of the others zero
  Vector diffusivity_;                  ///< around places in rock without a given index, m^2/s
  Field& memory_;                       ///< m_k of every place, m^2/s
  Vector resistance_;                   ///< R of a steady flow, Pa s/m^2, one a place
  Vector level_;                        ///< of a place above the mean of the cells around it, as a pressure, Pa
  Vector weight_;                       ///< of the fluid in the well between its reference and each place, Pa
  Operator of_wells_;                   ///< places × wells: −1
  Operator of_rock_, into_rock_, of_fracture_, into_fracture_;
  bool has_operators_ = false;
};

const RegisterCoupler<WellExchange, WellExchangeOptions> registration("well_exchange");

}  // namespace
}  // namespace sprekk::couplers
