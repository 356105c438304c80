// matrix_exchange: fluid passes between two flows in the same rock, as between blocks and the cracks around them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/capabilities/matrix_border.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/property.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct MatrixExchangeOptions {
  Data exchange;  ///< 1/(Pa s)
  Spec spec() {
    Spec spec("matrix_exchange",
              "Fluid passes between two flows in the same rock, driven by the difference of their pressures: double "
              "porosity, if only one of them conducts, or double permeability.");
    spec.ignore("type").ignore("between");
    spec.data("exchange", exchange,
              {.unit = "1/(Pa*s)",
               .range = non_negative(),
               .doc = "Rate of fluid per volume of rock and difference of pressure: sigma k/mu with the shape factor "
                      "sigma of blocks of the permeability k.",
               .source = "Barenblatt, Zheltov and Kochina 1960; Warren and Root 1963",
               .required = true,
               .in_time = true});
    return spec;
  }
};

/// Adds q V dt to the balance of the first flow, and −q V dt to that of the second, q = exchange (p_1 − p_2), at the
/// end of the step.
class MatrixExchange : public Coupler {
 public:
  MatrixExchange(const CouplerContext& context, const MatrixExchangeOptions& options)
      : Coupler(context.name), mesh_(context.mesh), switch_times_(options.exchange.switch_times()) {
    const std::vector<MatrixFluid*> flows = context.all<MatrixFluid>();
    for (MatrixFluid* flow : flows) pressures_.push_back(&flow->pressure());
    if (pressures_.size() != 2)
      throw InputError(
          context.origin,
          "coupler " + name() + " stands between " + std::to_string(pressures_.size()) + " flows in the rock",
          "fluid passes from one to another", "name two components of the kind matrix_flow");
    for (const Field* pressure : pressures_)
      if (!pressure->spec().role.is_unknown())
        throw InputError(context.origin, pressure->name() + " is prescribed",
                         "it has no balance that fluid could enter", "take a flow that determines its pressure");
    in_both_.resize(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c)
      in_both_[c] = flows[0]->is_in_cell(c) && flows[1]->is_in_cell(c) ? mesh_.cell_measure[c] : 0;
    if (std::ranges::count(in_both_, 0.0) == mesh_.cell_count())
      throw InputError(context.origin, "coupler " + name() + " passes nothing",
                       "no cell has both flows: it exchanges fluid within rock, not across the border of regions",
                       "let both live in the same regions, or take border_exchange");
    for (MatrixFluid* flow : flows)
      if (auto* border = dynamic_cast<MatrixBorder*>(flow)) border->share_cells();
    exchange_ = Property(options.exchange, cell_places(mesh_), context.start_time);
  }

  void evaluate_data(const StepTime& step) override { exchange_.evaluate(step); }
  void begin_step(const StepTime& step) override {
    if (used_ == std::pair(exchange_.version(), step.dt)) return;
    conductance_ = Vector(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c) conductance_[c] = step.dt * exchange_[c] * in_both_[c];
    of_difference_ = Operator::between_fields(diagonal_matrix(conductance_));
    used_ = {exchange_.version(), step.dt};
  }

  void assemble(Assembly& assembly, const StepTime& step) const override {
    const double longer = step.dt / used_.second;  // not 1 while the start is settled
    for (const int side : {0, 1}) {
      const Field& row = *pressures_[side];
      if (!assembly.has_row(row)) continue;
      for (const int column : {0, 1})
        assembly.linear(row, of_difference_, *pressures_[column], side == column ? longer : -longer);
    }
  }

  bool allows_stages() const override { return true; }
  std::vector<double> switch_times() const override { return switch_times_; }

  std::vector<Dependence> dependences() const override {
    const std::string first = pressures_[0]->spec().owner, second = pressures_[1]->spec().owner;
    const std::string because = "fluid that leaves the one enters the other in the same step";
    return {{first, second, because}, {second, first, because}};
  }

  /// Flows in one rock between which nothing passes.
  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    std::vector<std::pair<std::string, MatrixFluid*>> flows;
    for (Component* component : components)
      if (auto* flow = dynamic_cast<MatrixFluid*>(component); flow && flow->pressure().spec().role.is_unknown())
        flows.emplace_back(component->name(), flow);
    for (std::size_t i = 1; i < flows.size(); ++i) {
      const auto& [first, one] = flows[i - 1];
      const auto& [second, other] = flows[i];
      bool share = false;
      for (int c = 0; c < one->pressure().size() && !share; ++c) share = one->is_in_cell(c) && other->is_in_cell(c);
      if (!share) continue;
      notes.add("nothing passes between " + first + " and " + second,
                fmt::format("no fluid passes between '{}' and '{}', which flow in the same rock (no coupler "
                            "stands between them) add matrix_exchange, unless that is meant",
                            first, second));
    }
  }

 private:
  const Mesh& mesh_;
  std::vector<Field*> pressures_;
  Property exchange_;
  Vector in_both_;      ///< the volume of each cell with both flows, m^2
  Vector conductance_;  ///< exchange V dt, m^2/Pa
  Operator of_difference_;
  std::pair<std::uint64_t, double> used_;
  std::vector<double> switch_times_;
};

const RegisterCoupler<MatrixExchange, MatrixExchangeOptions> registration("matrix_exchange");

}  // namespace
}  // namespace sprekk::couplers
