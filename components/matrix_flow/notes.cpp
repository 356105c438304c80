// The notes of the flow in the matrix.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "components/capabilities/fluid_at_start.hpp"
#include "components/capabilities/overshoots.hpp"
#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/leaky_sides.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/start_balance.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk::matrix_flow {

namespace {

/// Whether a point lies between the ends of a fracture cell, or inside of its edges, as seen along its normal. `away`:
/// from its centre, in its frame.
bool is_beside(const Mesh& mesh, const FractureCell& cell, const Point& away) {
  if constexpr (dimension == 2) return std::abs(away[1]) < (0.5 + rounding::far_above) * cell.measure;
  const FaceNodes& nodes = mesh.face_nodes[cell.faces[0]];
  const int count = static_cast<int>(nodes.size());
  for (int k = 0; k < count; ++k) {
    const Point from = cell.to_local(mesh.nodes[nodes[k]] - cell.center);
    const Point edge = cell.to_local(mesh.nodes[nodes[(k + 1) % count]] - cell.center) - from, way = away - from;
    if (edge[1] * way[dimension - 1] - edge[dimension - 1] * way[1] < -rounding::far_above * cell.measure) return false;
  }
  return true;
}

/// The name of the fracture on which a point lies, or "".
std::string fracture_at(const Mesh& mesh, const Point& at) {
  for (const FractureCell& cell : mesh.fracture_cells) {
    const Point away = cell.to_local(at - cell.center);
    const double size = dimension == 2 ? cell.measure : std::sqrt(cell.measure);
    if (std::abs(away[0]) < rounding::far_above * size && is_beside(mesh, cell, away))
      return mesh.fractures[cell.fracture].name;
  }
  return "";
}

/// The names of the fractures on which a point lies, or the middle of a part of a line.
std::set<std::string> fractures_along(const Mesh& mesh, const std::vector<Point>& path) {
  std::set<std::string> names;
  if (path.size() == 1) names.insert(fracture_at(mesh, path[0]));
  for (std::size_t k = 1; k < path.size(); ++k) names.insert(fracture_at(mesh, 0.5 * (path[k - 1] + path[k])));
  names.erase("");
  return names;
}

/// Where, why, and what to do; {} is a number of places.
const char* where_inexact(MatrixFlow::Fluxes kind) {
  switch (kind) {
    case MatrixFlow::Fluxes::two_point:
      return "through {} faces two-point fluxes are not exact for linear pressures (permeability and faces are not "
             "orthogonal there, and the error does not vanish with the size of cells); take matrix_flow/mpfa";
    case MatrixFlow::Fluxes::limited:
      return "through {} faces fluxes, or at walls pressures, are not exact for linear pressures (a corner of the "
             "rock, "
             "or rock that is too anisotropic for the cells there, leaves no neighbours in the direction of the flux); "
             "use smaller cells there";
    case MatrixFlow::Fluxes::linear:
      break;
  }
  return dimension == 2 ? "around {} nodes fluxes are not exact for linear pressures (the rock is too anisotropic for "
                          "the quadrilaterals there; exact fluxes would gain energy); use triangles"
                        : "around {} nodes fluxes are not exact for linear pressures (the rock is too anisotropic for "
                          "the cells there; exact fluxes would gain energy); use tetrahedra, or matrix_flow/rt0";
}

}  // namespace

void MatrixFlow::note_input(Notes& notes) const {
  if (!options_.gravity.is_zero() && options_.fluid_density == 0)
    notes.add(name() + ".gravity without effect",
              origin_.text() + ": gravity has no effect on the flow of '" + name() +
                  "' (its fluid_density is 0) give a density, or remove the gravity");
  for (const auto& [well, given] : options_.wells)
    for (const std::string& fracture : fractures_along(mesh_, given.path()))
      notes.add(name() + "." + well + " on a fracture",
                fmt::format("{}: well '{}' of '{}' lies on the fracture '{}', and feeds the rock at one of its walls "
                            "(which one is an accident of the mesh) move it into the rock, or give the fracture an "
                            "injection",
                            given.origin.text(), well, name(), fracture));
  for (const auto& [key, instead] : options_.without_effect)
    notes.add(name() + "." + key + " without effect",
              origin_.text() + ": '" + key + "' of '" + name() + "' has no effect (" + instead + ") remove it");
}

void MatrixFlow::note_start(Notes& notes) const {
  Vector density = Vector::Constant(mesh_.cell_count(), options_.fluid_density);
  if (buoyancy_) density += buoyancy_->excess(FluidDensity::State::now);
  note_start_imbalance(
      notes, {mesh_, options_, inside_, mobility_, std::move(density), buoyancy_ != nullptr, evaluated_for_.start},
      name());
}

void MatrixFlow::note_step(Notes& notes, const StepTime& step) const {
  note_fluxes(notes, step);
  if (buoyancy_) note_heavy_above(notes, step);
  const Vector& pressure = pressure_.now();
  Eigen::Index lowest = 0, largest = 0;
  const double smallest = pressure.minCoeff(&lowest), most = pressure.cwiseAbs().maxCoeff(&largest);
  // Pressures that begin above zero everywhere are absolute; others may be relative to any reference.
  const double initial = initial_pressure_.minCoeff();
  if (initial > 0 && smallest < -rounding::far_above * initial)
    notes.add(pressure_.name() + " below zero",
              fmt::format("{} falls to {:.3g} Pa at {} (it began above zero everywhere, and no fluid sustains tension) "
                          "check what is extracted and the size of the steps",
                          pressure_.name(), smallest, to_text(mesh_.cell_center[lowest])),
              -smallest);
  if (most > beyond_every_load)
    notes.add(pressure_.name() + " beyond every load",
              fmt::format("{} reaches {:.3g} Pa at {} (no rock sustains 10 GPa) check permeability and rates there",
                          pressure_.name(), pressure[largest], to_text(mesh_.cell_center[largest])),
              most);
}

void MatrixFlow::note_fluxes(Notes& notes, const StepTime& step) const {
  if (is_sealed_) return;
  double own = 0;
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (mesh_.cell_rank[mesh_.face_cells[f][0]] == parallel::rank()) own += operators_.blended_nodes.coeff(f, f);
  const double blended = std::round(parallel::sum(own));
  if (blended > 0)
    notes.add(name() + ": fluxes that are not exact for linear pressures",
              name() + ": " + fmt::format(fmt::runtime(where_inexact(kind_of_fluxes_)), blended), blended);
  if (buoyancy_) return;  // fluid of another weight than around it needs no higher potential to move
  const std::string remedy = is_limited_ || dimension == 3
                                 ? "smaller cells"
                                 : "smaller cells, or matrix_flow/ntpfa, which keeps bounds at the cost of "
                                   "several factorizations a step";
  const std::string cause = is_limited_
                                ? "walls of fractures and faces without neighbours in the direction of the flux "
                                  "are exempt from its bounds"
                                : "where rock is anisotropic or cells are flat, such fluxes keep no bounds";
  const Overshoots found = find_overshoots(
      {mesh_, conditions_, pressure_.now() - gravity_potential_cell_, pressure_.accepted() - gravity_potential_cell_,
       boundary_values_, boundary_changes_, face_fluxes(), capacity_, step.dt,
       std::max(pressure_.now().lpNorm<Eigen::Infinity>(), gravity_potential_cell_.lpNorm<Eigen::Infinity>())});
  if (found.cells == 0) return;
  notes.add(
      name() + ".pressure beyond its surroundings",
      fmt::format("{}.pressure is higher or lower than all around it in {} cells without a source, by up to {:.3g} "
                  "Pa, {:.2g} % of the range of pressures ({}); use {}",
                  name(), found.cells, found.largest, 100 * found.largest / found.range, cause, remedy),
      found.largest);
}

double MatrixFlow::largest_given_pressure() const {
  double largest = initial_pressure_.lpNorm<Eigen::Infinity>();
  if (leaky_sides_) largest = std::max(largest, leaky_sides_->largest_pressure());
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (conditions_.size() > 0 && conditions_[f] == FlowCondition::pressure)
      largest = std::max(largest, std::abs(boundary_values_[f] + gravity_potential_face_[f]));
  return largest;
}

}  // namespace sprekk::matrix_flow
