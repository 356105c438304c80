// carter_leak_off: fluid leaves fractures into rock that has no flow of its own, by Carter's law.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "components/capabilities/concentration.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/temperature.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

constexpr const char* size_unit = dimension == 2 ? "m" : "m^2";

/// What a formula of the coefficient may name.
const StateVariables& leak_off_variables() {
  static const StateVariables variables = {{"p", "Pa", "pressure of the fluid in the fracture"},
                                           {"a", "m", "aperture"}};
  return variables;
}

struct CarterOptions {
  Data coefficient;                     ///< C_L, m/s^0.5
  Data spurt = 0;                       ///< m
  std::optional<double> exposed_since;  ///< s
  Spec spec() {
    Spec spec(
        "carter_leak_off",
        "Fluid leaves fractures into rock that has no flow of its own: through each wall, and per area of it, 2 C_L "
        "sqrt(t - t_0) and the spurt loss since fluid has come there at t_0. Both walls leak, so a fracture loses "
        "twice that. What has fluid at the start of the run has had its spurt.");
    spec.ignore("type").ignore("between");
    spec.data("leak_off_coefficient", coefficient,
              {.unit = "m/s^0.5",
               .range = non_negative(),
               .doc = "C_L of one wall: its leak-off velocity is C_L/sqrt(t - t_0).",
               .source = "Howard and Fast 1957 (appendix by Carter)",
               .required = true,
               .material = true});
    may_be_formula(spec.name(), "leak_off_coefficient", leak_off_variables());
    spec.data("spurt_loss", spurt,
              {.unit = "m",
               .range = non_negative(),
               .doc = "Volume per area of one wall that leaves when fluid comes to it.",
               .source = "Howard and Fast 1957 (appendix by Carter)",
               .material = true});
    spec.quantity(
        "exposed_since", exposed_since,
        {.unit = "s",
         .doc = "t_0 of walls that have fluid at the start of the run, not after it; without it, the start. Not read "
                "where walls come from another run, `start: from`."});
    return spec;
  }
};

/// Subtracts the leak-off through both walls in the step from the balance of each fracture cell, exactly for the mean
/// time of exposure of the cell. The part of a cell that becomes wet in the step (a tip has passed, or fluid has filled
/// it) does so at a constant rate over the step. A coefficient that is a formula is that of the state at the end of the
/// step, for all walls that are exposed then.
class CarterLeakOff : public Coupler, public FollowsMesh, public CountsAmounts, public KeepsTotals {
 public:
  CarterLeakOff(const CouplerContext& context, const CarterOptions& options)
      : Coupler(context.name),
        mesh_(context.mesh),
        origin_(context.origin),
        fluid_(context.the<FractureFluid>()),
        rock_left_out_(context.left_out<MatrixFluid>()),
        is_age_given_(options.exposed_since.has_value()),
        age_at_start_(context.start_time - options.exposed_since.value_or(context.start_time)),
        coefficient_(options.coefficient, leak_off_variables(), fracture_cell_places(mesh_)),
        spurt_(options.spurt, fracture_cell_places(mesh_), context.start_time),
        wet_(add(context, "wet", size_unit, "Size of the part that fluid has come to")),
        wet_age_(add(context, "wet_age", std::string(size_unit) + "*s",
                     "The same times the mean time for which it has been there")),
        leaked_(add(context, "leaked", volume_unit, "Fluid that has left through both walls since the start")) {
    if (age_at_start_ < 0)
      throw InputError(origin_, "'exposed_since' is after the start of the run",
                       "walls that have fluid at the start have had it by then", "give a time up to time.start");
    refuse_carried<FractureTemperature>(context, carried_heat);
    refuse_carried<FractureConcentration>(context, carried_tracer);
    begin();
  }

  void count_amounts_from_here(const SettledFields&) override {
    if (!continues_) begin();
  }
  /// If ages differ from those that this run would give at the start, they come from another run, and are kept.
  void begin_totals() override {
    continues_ = continues_ || wet_age_.accepted() != age_at_start_ * wet_.accepted();
    leaked_.set_both(Vector::Zero(leaked_.size()));
  }

  /// Cells that have grown become wet in the first step in which they are in the mesh.
  void carry_over(const Part&, const MeshChange& change) override {
    if (change.is_at_start) return;
    const Vector covered = covered_parts(change, mesh_);
    for (Field* amount : {&wet_, &wet_age_, &leaked_}) {
      Vector values = amount->accepted();
      for (int i = 0; i < values.size(); ++i)
        if (covered[i] == 0) values[i] = 0;
      amount->set_both(std::move(values));
    }
  }

  void evaluate_data(const StepTime&) override {
    if (fluid_.rock_fluid())
      throw InputError(origin_, "fluid leaves '" + fluid_.pressure().spec().owner + "' twice",
                       "a coupler wall_exchange lets it into the flow in the rock",
                       "remove one of the two couplers, " + name() + " or wall_exchange");
    if (!coefficient_.is_formula()) return;
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)  // a value out of its range is refused at the start
      if (fluid_.is_in_fracture_cell(i)) coefficient_at(i);
  }

  void begin_step(const StepTime&) override { wet_at_end_ = wet_sizes().cwiseMax(wet_.accepted()); }

  void assemble(Assembly& assembly, const StepTime& step) const override {
    if (!assembly.has_row(fluid_.pressure())) return;
    const Leaking leaking = leaking_in(step);
    BalanceRows(assembly, fluid_.pressure()).exchange(leaking.amount, leaking.amount);
    if (!assembly.wants_derivatives() || !coefficient_.is_formula()) return;
    assembly.diagonal(fluid_.pressure(), fluid_.pressure(), leaking.by_pressure);
    assembly.diagonal(fluid_.pressure(), fluid_.aperture(), leaking.by_aperture);
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override {
    if (std::ranges::count(solved, &fluid_.pressure()) == 0) return;
    const Vector fresh = wet_at_end_ - wet_.accepted();
    wet_.set(wet_at_end_);
    wet_age_.set(wet_age_.accepted() + step.dt * wet_.accepted() + step.dt / 2 * fresh);
    leaked_.set(leaked_.accepted() + leaking_in(step).amount);
  }

  void balance(std::map<std::string, Balance>& balances) const override {
    const double leaked = sum_owned(mesh_, Location::fracture_cell, leaked_.now());
    balances["fluid"].outflow += leaked;
    balances["fluid"].throughput += leaked;
  }

  void report(std::vector<Quantity>& quantities) const override {
    quantities.push_back({name() + ".leaked", volume_unit, sum_owned(mesh_, Location::fracture_cell, leaked_.now())});
  }

  void note_input(Notes& notes) const override {
    if (continues_ && is_age_given_)
      notes.add(name() + ": exposed_since",
                "'exposed_since' is not read (walls keep their age from the run from which this one starts) "
                "remove it");
    if (!rock_left_out_.empty())
      notes.add(name() + " beside " + rock_left_out_,
                fmt::format("what leaves the fractures by '{}' does not come to the fluid of '{}' (Carter's law stands "
                            "for the flow in the rock) take wall_exchange in its place, unless that is meant",
                            name(), rock_left_out_));
  }

 private:
  template <class InFractures>
  void refuse_carried(const CouplerContext& context, const Carried& carried) const {
    if (context.find<InFractures>() || !context.left_out<InFractures>().empty())
      throw InputError(origin_, "the fluid that leaks off would leave its " + carried.quantity + " behind",
                       "no coupler carries " + carried.quantity + " with it, and the fractures have a " + carried.value,
                       "take flow and " + carried.quantity + " in the rock with wall_exchange and " + carried.quantity +
                           "_advection, or remove the " + carried.quantity);
  }

  /// All fluid of the present state has the age of the start.
  void begin() {
    wet_.set_both(wet_sizes());
    wet_age_.set_both(age_at_start_ * wet_.now());
    leaked_.set_both(Vector::Zero(leaked_.size()));
  }

  Field& add(const CouplerContext& context, const std::string& name, const std::string& unit, const std::string& doc) {
    return context.fields.add(mesh_, amounts_with(fluid_.pressure(), context.name, name, unit, doc));
  }

  /// m (in space m^2), of the part of each cell that has fluid now.
  Vector wet_sizes() const {
    Vector sizes(mesh_.fracture_cell_count());
    for (int i = 0; i < sizes.size(); ++i)
      sizes[i] = fluid_.is_in_fracture_cell(i) ? mesh_.fracture_cells[i].measure * fluid_.filled_part(i) : 0;
    return sizes;
  }

  /// m/s^0.5, with its derivatives by the variables that a formula may name.
  struct Coefficient {
    double value;
    std::array<double, 2> by{};
  };
  Coefficient coefficient_at(int cell) const {
    Coefficient result{};
    const double aperture = fluid_.aperture().now()[cell], least = fluid_.least_aperture();
    const std::array state{fluid_.pressure().now()[cell], std::max(aperture, least)};
    result.value = coefficient_.at(cell, state, result.by);
    if (aperture < least) result.by[1] = 0;
    return result;
  }

  /// What leaves each cell in the step, through both walls, and its derivatives.
  struct Leaking {
    Vector amount, by_pressure, by_aperture;
  };
  Leaking leaking_in(const StepTime& step) const {
    const Vector none = Vector::Zero(mesh_.fracture_cell_count());
    Leaking leaking{none, none, none};
    for (int i = 0; i < none.size(); ++i) {
      if (!fluid_.is_in_fracture_cell(i)) continue;
      const double wet = wet_.accepted()[i], fresh = wet_at_end_[i] - wet;
      const double age = wet > 0 ? wet_age_.accepted()[i] / wet : 0;
      // The mean of sqrt(t - t_0) over arrivals in the step is 2/3 sqrt(dt).
      const double roots = wet * (std::sqrt(age + step.dt) - std::sqrt(age)) + fresh * (2.0 / 3) * std::sqrt(step.dt);
      const auto [coefficient, by] = coefficient_at(i);
      leaking.amount[i] = 2 * (2 * coefficient * roots + spurt_[i] * fresh);
      leaking.by_pressure[i] = 4 * roots * by[0];
      leaking.by_aperture[i] = 4 * roots * by[1];
    }
    return leaking;
  }

  const Mesh& mesh_;
  Origin origin_;
  FractureFluid& fluid_;
  std::string rock_left_out_;  ///< a flow in the rock that the coupler does not stand between
  bool is_age_given_;          ///< by `exposed_since`
  bool continues_ = false;     ///< whether walls are those of another run
  double age_at_start_;        ///< s, of what has fluid at the start
  StateFormula coefficient_;   ///< C_L, m/s^0.5
  Property spurt_;
  Field &wet_, &wet_age_, &leaked_;
  Vector wet_at_end_;  ///< of the step
};

const RegisterCoupler<CarterLeakOff, CarterOptions> registration("carter_leak_off");

}  // namespace
}  // namespace sprekk::couplers
