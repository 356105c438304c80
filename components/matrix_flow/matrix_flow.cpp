#include "components/matrix_flow/matrix_flow.hpp"

#include <algorithm>
#include <utility>

#include "components/capabilities/formula_of_cells.hpp"
#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/history_of_cells.hpp"
#include "components/matrix_flow/leaky_sides.hpp"
#include "components/matrix_flow/storage_formula.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {

MatrixFlow::MatrixFlow(const ComponentContext& context, const Options& options, Discretize discretize,
                       Unknowns unknowns, Fluxes fluxes, DifferentiateFluxes differentiate)
    : Component(context.name),
      mesh_(context.mesh),
      options_(options),
      origin_(context.origin),
      discretize_(discretize),
      pressure_(context.fields.add(mesh_, {.owner = context.name,
                                           .name = "pressure",
                                           .location = Location::cell,
                                           .role = Role::unknown(BlockKind::bulk_elliptic),
                                           .unit = "Pa",
                                           .doc = "Fluid pressure of the matrix"})),
      cumulative_(context.fields.add(
          mesh_, amounts_with(pressure_, context.name, "cumulative_balance", volume_unit,
                              "Fluid stored, injected, and flowed out through the outer boundary", 3))),
      differentiate_(std::move(differentiate)),
      kind_of_fluxes_(fluxes),
      is_limited_(fluxes == Fluxes::limited) {
  if (mesh_.wall_count() > 0)
    wall_flux_ =
        &context.fields.add(mesh_, {.owner = context.name,
                                    .name = "wall_flux",
                                    .location = Location::wall,
                                    .role = Role::input(BlockKind::interface),
                                    .unit = "m/s",
                                    .doc = "Flux from the fracture into the matrix (lambda of the paper's Eq. 9)"});
  if (unknowns == Unknowns::on_cells_and_faces)
    face_pressure_ = &context.fields.add(mesh_, {.owner = context.name,
                                                 .name = "face_pressure",
                                                 .location = Location::face,
                                                 .role = Role::unknown(BlockKind::bulk_elliptic),
                                                 .unit = "Pa",
                                                 .doc = "Mean fluid pressure on the faces of the mesh"});
  find_regions();
  const std::vector<Place> places = cell_places(mesh_);
  const auto property = [&](const Data& data) { return Property(data, places, context.start_time); };
  initial_pressure_ = property(options_.initial_pressure).values();
  pressure_.set_both(initial_pressure_);
  history_ = HistoryOfCells::find(options_.history, mesh_, inside_);
  find_state_permeability();
  find_pores(context);
  find_history(context);
  if (!by_state_) std::ranges::transform(options_.permeability.component, permeability_.begin(), property);
  viscosity_ = property(options_.viscosity);
  if (options_.porosity && !pores_) porosity_ = property(*options_.porosity);
  if (options_.storage) {
    if (!stores_) storage_ = property(*options_.storage);
  } else {
    compressibility_ = property(*options_.fluid_compressibility);
  }
  for (const Data* data : properties()) properties_change_ = properties_change_ || data->depends_on_time();
  use_properties();
  check_sides();
  open_leaky_sides(context);

  gravity_potential_cell_.resize(mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c) gravity_potential_cell_[c] = gravity_potential(mesh_.cell_center[c]);
  gravity_potential_face_.resize(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) gravity_potential_face_[f] = gravity_potential(mesh_.face_center[f]);
  if (face_pressure_) start_face_pressure();
}

MatrixFlow::~MatrixFlow() = default;

double MatrixFlow::gravity_potential(const Point& x) const {
  return options_.gravity.is_zero() ? 0.0 : options_.fluid_density * options_.gravity.at({x, 0, 0}).dot(x);
}

void MatrixFlow::begin_step(const StepTime& step) {
  evaluate_data(step);
  if (history_) history_->begin_step(step);
  if (by_state_) take_permeability();
  if (stores_by_state()) take_pores(evaluated_for_);
  linearized_.clear();
  observed_mobility_.clear();
  takes_derivatives_ = true;
  discretize();
  use_storage();
  apply_boundary();
  use_density();
}

void MatrixFlow::assemble(Assembly& assembly, const StepTime& step) const {
  if (face_pressure_ && assembly.has_row(*face_pressure_)) assemble_face_pressure(assembly, step);
  if (side_outflow_) leaky_sides_->assemble(assembly, *side_outflow_, side_pressure());
  if (!assembly.has_row(pressure_)) return;
  SPREKK_EXPECT(step.dt > 0, step.dt);
  SPREKK_EXPECT(is_discretized() && boundary_applied_, name());
  SPREKK_ASSERT(capacity_.size() == mesh_.cell_count() && source_.size() == mesh_.cell_count(), capacity_.size());
  BalanceRows fluid(assembly, pressure_, "fluid");
  if (stores_by_state()) {
    assemble_stored_by_state(assembly, fluid);
  } else {
    fluid.store(capacity_.cwiseProduct(pressure_.now() - pressure_.accepted()),
                capacity_.cwiseProduct(pressure_.now()).lpNorm<Eigen::Infinity>());
    assembly.derivative(pressure_, pressure_, capacity_of_pressure_);
  }
  // Fluxes depend on differences of pressure only, so their terms are added together and compared with the fluxes
  // through faces: single terms of the pressure would hide them where the pressure is high everywhere. Where all terms
  // vanish, the residual is compared with the flow before the step.
  const double largest_before = flow(State::accepted).largest_outflow;
  const Flow& flows = flow(State::now);
  fluid.exchange(step.dt * flows.outflow, step.dt * flows.leaving,
                 step.dt * largest_conductance_ * pressure_.now().lpNorm<Eigen::Infinity>());
  assembly.derivative(pressure_, pressure_, outflow_of_pressure_, step.dt);
  if (face_pressure_) assembly.derivative(pressure_, *face_pressure_, outflow_of_face_pressure_, step.dt);
  if (is_limited_ && !is_sealed_) assemble_limited(assembly, flows, step.dt);
  if (buoyancy_) assemble_density(assembly, flows, step.dt);
  if (by_state_) assemble_by_state(assembly, step.dt);
  assembly.compare_with(pressure_, step.dt * face_fluxes().lpNorm<Eigen::Infinity>());
  assembly.compare_with(pressure_, step.dt * largest_before);
  if (wall_flux_) assembly.linear(pressure_, outflow_of_wall_flux_, *wall_flux_, step.dt);
  for (const OpenBorder& border : borders_) assembly.linear(pressure_, border.of_cells, *border.outflow, step.dt);
  if (side_outflow_) {
    fluid.add_throughput(step.dt * leaking());
    assemble_leak(assembly, fluid, step.dt);
  }
  if (!source_.isZero(0)) fluid.supply(step.dt * source_);
}

void MatrixFlow::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::find(solved.begin(), solved.end(), &pressure_) == solved.end()) return;
  Vector fluxes = face_fluxes();
  if (side_outflow_) correct_leak(fluxes);
  if (stores_by_state()) count_content();
  if (history_) history_->remember(evaluated_for_);
  const Vector stored =
      stores_by_state() ? stored_by_state() : Vector(capacity_.cwiseProduct(pressure_.now() - pressure_.accepted()));
  Vector sums = cumulative_.accepted();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    if (is_in_cell(c)) sums[3 * c] += stored[c];
    sums[3 * c + 1] += step.dt * source_[c];
  }
  for (const auto& [face, cell] : outer_faces_) sums[3 * cell + 2] += step.dt * fluxes[face];
  exchange(mesh_, Location::cell, 3, sums);
  cumulative_.set(std::move(sums));
  solved_fluxes_ = std::move(fluxes);
}

void MatrixFlow::balance(std::map<std::string, Balance>& balances) const {
  Balance& fluid = balances["fluid"];
  fluid.unit = volume_unit;
  add_totals(fluid, mesh_, cumulative_);
}

bool MatrixFlow::stores_nothing_somewhere() const {
  for (int c = 0; c < mesh_.cell_count(); ++c)
    if (is_in_cell(c) && storage_[c] == 0) return true;
  return false;
}

}  // namespace sprekk::matrix_flow
