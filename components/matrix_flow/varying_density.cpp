// The flow of a fluid whose weight follows a density that varies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/leaky_sides.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {
namespace {

/// Of the rate r at most, times the step: cells as wide as high grow with r/2, less what conduction takes from them,
/// and backward Euler multiplies what grows with the rate s by 1/(1 − s dt): it is damped from s dt = 2 on.
constexpr double most_growth = 4;
/// Share of the velocity that the whole range of densities would drive; convection that has begun reaches some tenths
/// of it.
constexpr double hardly_moves = 0.01;

}  // namespace

void MatrixFlow::accept_density(const FluidDensity& in_rock, const FluidDensity* in_fractures) {
  SPREKK_EXPECT(has_gravity() && !buoyancy_, name());
  refuse_with_formula("the density of its fluid varies",
                      "what the weight adds to fluxes would follow the state as well");
  if (has_open_border()) refuse_density_at_border();
  buoyancy_ = std::make_unique<Buoyancy>(mesh_, options_.gravity, options_.fluid_density, in_rock, in_fractures);
}

void MatrixFlow::use_density() {
  if (!buoyancy_) return;
  if (operators_of_buoyancy_ != operators_made_)
    buoyancy_->discretize(operators_, conditions_, leaky_sides_ ? leaky_sides_->faces() : std::vector<char>());
  operators_of_buoyancy_ = operators_made_;
  buoyancy_->begin_step(conditions_, boundary_values_ + gravity_potential_face_);
  versions_at_walls_ = {};
  forget_flow();
}

const LinearExpression& MatrixFlow::wall_pressure() const {
  if (!linearized_.empty()) return wall_pressure_by_state_;
  if (!buoyancy_ || operators_of_buoyancy_ == 0) return wall_pressure_;
  if (const auto versions = buoyancy_->wall_versions(); versions != versions_at_walls_) {
    wall_pressure_by_density_ = wall_pressure_;
    buoyancy_->add_to_walls(wall_pressure_by_density_);
    versions_at_walls_ = versions;
  }
  return wall_pressure_by_density_;
}

std::vector<std::pair<const Field*, SparseMatrix>> MatrixFlow::fluxes_by_density(const Flow& flow) const {
  SparseMatrix of_density = buoyancy_->flux().cells;
  if (is_limited_ && !is_sealed_)
    of_density += limited_derivative(flow, buoyancy_->limited()[0].cells, buoyancy_->limited()[1].cells);
  std::vector<std::pair<const Field*, SparseMatrix>> derivatives;
  for (const FluidDensity::Derivative& by : buoyancy_->derivatives())
    derivatives.emplace_back(by.field, of_density * by.values.asDiagonal());
  return derivatives;
}

void MatrixFlow::note_heavy_above(Notes& notes, const StepTime& step) const {
  const Vector density = buoyancy_->excess(FluidDensity::State::now), &fluxes = face_fluxes();
  // An excess of the density moves fluid with M g d, which brings density from above: d' = M g d drho/dz, and a little
  // more where the rock stores less heat than the fluid.
  double growth = 0, speed = 0, driven = 0;
  const double range = density.maxCoeff() - density.minCoeff();
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const auto [cell, other] = mesh_.face_cells[f];
    if (mesh_.cell_rank[cell] != parallel::rank()) continue;
    speed = std::max(speed, std::abs(fluxes[f]) / mesh_.face_measure[f]);
    if (other == none) continue;
    const Point gravity = options_.gravity.at({mesh_.face_center[f], 0, 0});
    const double conducts = gravity.dot(mobility_[cell] * gravity) / gravity.squaredNorm();
    const Point between = mesh_.cell_center[other] - mesh_.cell_center[cell];
    growth =
        std::max(growth, conducts * (density[cell] - density[other]) * between.dot(gravity) / between.squaredNorm());
    driven = std::max(driven, conducts * gravity.norm() * range);
  }
  growth = step.dt * parallel::max(growth);
  if (growth > most_growth && parallel::max(speed) < hardly_moves * parallel::max(driven))
    notes.add(
        name() + ": heavy fluid stays above lighter fluid",
        fmt::format("heavier fluid of '{}' lies above lighter one and hardly moves, in a step {:.2g} times as long "
                    "as the time in which convection could grow (so long a step suppresses convection) take steps "
                    "below {:.2g} s until fluid moves, if convection is expected",
                    name(), growth, step.dt / growth),
        growth);
}

void MatrixFlow::assemble_density(Assembly& assembly, const Flow& flow, double dt) const {
  if (!assembly.wants_derivatives()) return;
  std::vector<char> is_outer(mesh_.face_count()), is_inner(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) is_inner[f] = !(is_outer[f] = mesh_.face_cells[f][1] == none);
  for (const auto& [field, of_faces] : fluxes_by_density(flow)) {
    if (!assembly.has_row(*field)) continue;
    const auto outflow = [&](const std::vector<char>& faces) {
      return cell_sums(mesh_, SparseMatrix(dt * keep_rows(of_faces, faces)), 1, parallel::rank());
    };
    assembly.exchange_derivative(pressure_, *field, outflow(is_inner));
    assembly.derivative(pressure_, *field, outflow(is_outer));
  }
}

void MatrixFlow::assemble_density_on_faces(Assembly& assembly, double dt) const {
  if (!assembly.wants_derivatives()) return;
  const Buoyancy::Rows& rows = buoyancy_->continuity();
  for (const FluidDensity::Derivative& by : buoyancy_->derivatives())
    assembly.derivative(*face_pressure_, *by.field, SparseMatrix(dt * (rows.cells * by.values.asDiagonal())));
}

}  // namespace sprekk::matrix_flow
