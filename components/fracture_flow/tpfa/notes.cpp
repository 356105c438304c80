// The notes of the flow in fractures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "components/capabilities/fluid_at_start.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/noticeable.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fracture_flow {

namespace {

/// The sides that meet at the end of a fracture, as indices into Mesh::side_names: those of the outer faces, beside
/// both walls of its last cell, that have the end as one of their ridges.
std::set<int> sides_at(const Mesh& mesh, const Ridge& end) {
  std::set<int> sides;
  for (const int wall : mesh.fracture_cells[end.cells[0]].faces)
    for (const int node : mesh.face_nodes[wall])
      for (const int face : mesh.node_faces[node]) {
        const FaceNodes& nodes = mesh.face_nodes[face];
        for (int k = 0; k < static_cast<int>(nodes.size()) && mesh.face_side[face] != none; ++k)
          if (ridge_geometry(mesh.nodes, ridge_of(nodes, k)).center == end.center) sides.insert(mesh.face_side[face]);
      }
  return sides;
}

}  // namespace

void FractureFlow::note_input(Notes& notes) const {
  const auto note = [&](const std::string& what, const Origin& where, const std::string& text) {
    notes.add(name() + "." + what + " without effect", where.text() + ": " + text);
  };
  for (const auto& [key, injection] : options_.injections) {
    const std::vector<int> cells = cells_of(injection.where);
    const auto lost = std::count_if(cells.begin(), cells.end(), [&](int cell) { return is_prescribed_[cell] != 0; });
    if (lost == 0 || injection.rate.is_zero()) continue;
    note("injection." + key, injection.where.origin,
         fmt::format("injection '{}' has no effect in {} of its {} fracture cells, and is not counted there (their "
                     "pressure is prescribed: it lets in or out what it takes) remove one of the two",
                     key, lost, cells.size()));
  }
  for (const auto& [side, origin] : options_.boundary_origins) {
    const bool has_end = std::any_of(mesh_.ridges.begin(), mesh_.ridges.end(), [&](const auto& p) {
      return p.kind == Ridge::Kind::on_boundary && mesh_.side_names[p.side] == side && is_in_fracture_cell(p.cells[0]);
    });
    if (!has_end)
      note("boundary." + side, origin,
           "the end of '" + name() + "' on side '" + side +
               "' has no effect (no fracture ends there) remove it, or let a fracture reach this side");
  }
  if constexpr (dimension == 3)
    if (const long count = drops_.is_empty() ? MimeticDrops::cells_that_need_them(mesh_) : 0; count > 0)
      notes.add(name() + ": two-point fluxes",
                fmt::format("two-point fluxes along fractures are not exact for linear pressures in {} of {} fracture "
                            "cells (their error there does not vanish with the size of cells) take fracture_flow/mfd",
                            count, mesh_.fracture_cell_count()));
  for (const auto& [key, given] : options_.prescribed)
    if (dimension == 3 && given.where.at && !given.where.radius)
      notes.add(
          name() + ".prescribed." + key + " without a radius",
          fmt::format("{}: the rate of '{}' depends on the size of cells (they have its pressure, which at a point "
                      "of a surface has no bound) give the 'radius' of its bore hole",
                      given.where.origin.text(), key));
  for (const auto& [side, end] : options_.ends)
    if (end.is_as_rock && !rock_fluid_)
      note("boundary." + side + ".as_rock", options_.boundary_origins.at(side),
           "'as_rock' of '" + name() + "' on side '" + side +
               "' has no effect (no wall_exchange joins it to a flow in the rock, and its ends are closed) give it a "
               "pressure, or add the coupler");
  note_ends_on_two_sides(notes);
  note_ends(notes);
  options_.crossings.note_input(mesh_, name(), notes);
  note_crossings(notes);
  if (!options_.gravity.is_zero() && options_.fluid_density == 0)
    note("gravity", origin_,
         "gravity has no effect on the flow of '" + name() +
             "' (its fluid_density is 0) give a density, or remove the gravity");
  if (has_inertia() && options_.fluid_density == 0)
    note("inertia", origin_,
         "the inertia of the law of '" + name() +
             "' has no effect (its fluid_density is 0) give a density, or remove the inertia");
  if (options_.transmissivity_value && !options_.is_constant())
    note("transmissivity_value", origin_,
         "'transmissivity_value' of '" + name() +
             "' has no effect (the transmissivity follows the cubic law) write 'transmissivity: constant', or remove "
             "it");
  if (options_.normal_permeability_value && options_.wall_permeability[0] && options_.wall_permeability[1])
    note("normal_permeability_value", origin_,
         "'normal_permeability_value' of '" + name() +
             "' has no effect (both walls have a value under wall_permeability) remove one of the two");
  else if (options_.normal_permeability_value && options_.normal_permeability != "constant")
    note("normal_permeability_value", origin_,
         "'normal_permeability_value' of '" + name() +
             "' has no effect (it follows the cubic law) write 'normal_permeability: constant', or remove it");
}

void FractureFlow::note_start(Notes& notes) const {
  note_start_at_walls(notes);
  if (options_.gravity.is_zero()) return;
  double worst = 0;
  std::string text;
  const double small = density_ ? part_that_may_vary : noticeable;
  const Vector& pressure = pressure_.now();
  for (const Link& link : links_) {
    if (link.second == none) continue;
    const Point &from = mesh_.fracture_cells[link.second].center, &to = mesh_.fracture_cells[link.first].center;
    const double length = (to - from).norm(), rise = (pressure[link.first] - pressure[link.second]) / length;
    const double wanted = link.gravity / length, misfit = std::abs(rise - wanted);
    if (misfit <= small * options_.fluid_density * options_.gravity.at({from, 0, 0}).norm() || misfit <= worst)
      continue;
    worst = misfit;
    const double sign = wanted < 0 ? -1 : 1;
    text = fmt::format(
        "the fluid of '{}' is out of balance at the start by {:.3g} Pa/m in the fracture '{}' at {}: along it, down, "
        "its initial_pressure grows by {:.4g} Pa/m, and its weight asks for {:.4g} Pa/m (it flows at once, although "
        "nothing is injected) let 'start: settle' find the equilibrium, or give a pressure that grows with depth, as "
        "in the rock",
        name(), misfit, mesh_.fractures[mesh_.fracture_cells[link.first].fracture].name, to_text(to), sign * rise + 0.0,
        sign * wanted);
  }
  if (worst > 0) notes.add(name() + " out of balance at the start", text, worst);
}

void FractureFlow::note_start_at_walls(Notes& notes) const {
  if (!rock_fluid_) return;
  const Vector& in_rock = rock_fluid_->initial_pressure();
  const NormalPermeability walls = normal_permeability();
  double worst = 0;
  std::string text;
  for (int wall = 0; wall < mesh_.wall_count(); ++wall) {
    const int cell = wall / 2, behind = mesh_.face_cells[mesh_.wall_face(wall)][0];
    if (!is_in_fracture_cell(cell) || !rock_fluid_->is_in_cell(behind) || is_prescribed_[cell] ||
        walls.value[wall] == 0)
      continue;
    const FractureCell& at = mesh_.fracture_cells[cell];
    const double own = pressure_.now()[cell], rock = in_rock[behind];
    const double weight = weight_between(mesh_.cell_center[behind], at.center), misfit = std::abs(own - rock - weight);
    // Where the rock's pressure varies, that of its cell is another than that at the wall.
    const double around = std::abs(in_rock[mesh_.face_cells[mesh_.wall_face(wall ^ 1)][0]] - rock);
    if (misfit <= noticeable * std::max(std::abs(own), std::abs(rock)) + std::abs(weight) + around || misfit <= worst)
      continue;
    worst = misfit;
    text = fmt::format(
        "the fluid of '{}' begins with {:.4g} Pa in the fracture '{}' at {}, and that of the rock beside it with "
        "{:.4g} "
        "Pa (it flows through the walls at once, although nothing is injected) give '{}' the initial_pressure of the "
        "rock, unless that is meant",
        name(), own, mesh_.fractures[at.fracture].name, to_text(at.center), rock, name());
  }
  if (worst > 0) notes.add(name() + " and the rock out of balance at the start", text, worst);
}

void FractureFlow::note_ends_on_two_sides(Notes& notes) const {
  for (const Ridge& end : mesh_.ridges) {
    if (end.kind != Ridge::Kind::on_boundary || options_.ends.count(mesh_.side_names[end.side]) > 0) continue;
    for (const int other : sides_at(mesh_, end)) {
      const std::string &side = mesh_.side_names[end.side], &said = mesh_.side_names[other];
      if (!options_.is_open(said)) continue;
      notes.add(name() + ".boundary." + said + " beside " + side,
                fmt::format("{}: the fracture '{}' ends at {} where the sides '{}' and '{}' meet, and belongs to '{}': "
                            "the pressure at '{}' has no effect there, and nothing flows out (what holds at '{}' is "
                            "not said) give '{}' under 'boundary' a pressure for '{}' too, or 'closed: true'",
                            options_.boundary_origins.at(said).text(),
                            mesh_.fractures[mesh_.fracture_cells[end.cells[0]].fracture].name, to_text(end.center),
                            side, said, side, said, side, name(), side));
    }
  }
}

void FractureFlow::note_ends(Notes& notes) const {
  if (!rock_fluid_) return;
  for (const Ridge& ridge : mesh_.ridges) {
    if (ridge.kind != Ridge::Kind::on_boundary || !rock_fluid_->is_open(ridge.side)) continue;
    const int cell = ridge.cells[0];
    const std::string& side = mesh_.side_names[ridge.side];
    const bool holds_pressure =
        is_prescribed_[cell] || std::ranges::count(prescribed_points_, cell, &OpenPoint::cell) > 0;
    const auto is_wet = [&](int wall_face) { return rock_fluid_->is_in_cell(mesh_.face_cells[wall_face][0]); };
    if (options_.ends.count(side) > 0 || holds_pressure || transmissivity(cell).value == 0 ||
        std::ranges::none_of(mesh_.fracture_cells[cell].faces, is_wet))
      continue;
    notes.add(
        name() + ".boundary." + side + " unsaid",
        fmt::format("{}: nothing flows out of the fracture '{}' at the side '{}', where the rock is open (what holds "
                    "at its end is not said) give '{}' under 'boundary' a pressure for '{}', 'as_rock: true', or "
                    "'closed: true'",
                    origin_.text(), mesh_.fractures[mesh_.fracture_cells[cell].fracture].name, side, name(), side));
  }
}

void FractureFlow::note_crossings(Notes& notes) const {
  if (!rock_fluid_) return;  // the walls let nothing through anyway
  const NormalPermeability walls = normal_permeability();
  const auto tighter_wall = [&](int cell) { return std::min(walls.value[2 * cell], walls.value[2 * cell + 1]); };
  for (std::size_t j = 0; j < mesh_.junctions.size(); ++j) {
    if (crossing_fills_[j].is_said()) continue;
    const Junction& junction = mesh_.junctions[j];
    std::vector<JunctionFluxes::Half> halves =
        options_.is_constant() ? given_halves(junction) : halves_by_opening(junction);
    pass_crossing(j, {}, halves);
    const auto fracture_of = [&](int cell) { return mesh_.fracture_cells[cell].fracture; };
    const auto goes_on = [&](int cell) {
      return std::ranges::count_if(junction.cells,
                                   [&](int other) { return fracture_of(other) == fracture_of(cell); }) == 2;
    };
    for (std::size_t i = 0; i < junction.cells.size(); ++i)
      for (const int barrier : junction.cells) {
        const int cell = junction.cells[i];
        if (fracture_of(barrier) == fracture_of(cell) || !goes_on(cell) || !goes_on(barrier)) continue;
        const double through_wall = tighter_wall(barrier) * initial_aperture_[cell];
        if (!is_in_fracture_cell(cell) || !is_in_fracture_cell(barrier) || halves[i].value == 0 ||
            through_wall > noticeable * halves[i].value || tighter_wall(barrier) > noticeable * tighter_wall(cell))
          continue;
        const std::string &passing = mesh_.fractures[fracture_of(cell)].name,
                          &passed = mesh_.fractures[fracture_of(barrier)].name;
        notes.add(
            name() + ".crossings unsaid",
            fmt::format("fluid of '{}' in the fracture '{}' passes '{}' at {} as if '{}' had no walls (what fills "
                        "the crossing is not said) write 'crossings: {{NAME: {{between: [{}, {}], through: {}}}}}' "
                        "in '{}', or give it a permeability",
                        name(), passing, passed, to_text(mesh_.ridges[junction.ridges.front()].center), passed, passed,
                        passing, passed, name()),
            1 - through_wall / halves[i].value);
      }
  }
}

void FractureFlow::note_step(Notes& notes, const StepTime&) const {
  Eigen::Index largest = 0;
  const double most = pressure_.now().cwiseAbs().maxCoeff(&largest);
  if (most > beyond_every_load)
    notes.add(pressure_.name() + " beyond every load",
              fmt::format("{} reaches {:.3g} Pa at {} (no rock sustains 10 GPa) check transmissivity and rates there",
                          pressure_.name(), pressure_.now()[largest], to_text(mesh_.fracture_cells[largest].center)),
              most);
  Eigen::Index least = 0;
  if (const double narrowest = aperture_.now().minCoeff(&least); narrowest < 0)
    notes.add(
        aperture_.name() + " below zero",
        fmt::format("{} is {:.3g} m at {}, so its cell has a negative volume of fluid (its walls overlap by more than "
                    "the initial aperture) raise initial_aperture, or let walls in contact approach each other less: "
                    "the 'closure' of the contact, or the 'stiffness_factor' of contact/penalty",
                    aperture_.name(), narrowest, to_text(mesh_.fracture_cells[least].center)),
        -narrowest);
  if (!empty_) return;
  Eigen::Index worst = 0;
  const double lacking = (empty_->now() - aperture_.now()).maxCoeff(&worst);
  if (lacking > rounding::far_above * aperture_.now().maxCoeff())
    notes.add(
        empty_->name() + " below nothing",
        fmt::format("{:.3g} m more fluid than there is leave the fracture of '{}' at {} (its pressure is held at the "
                    "bound, but the cells around it still draw fluid from it) raise 'cavitation' to the lowest "
                    "pressure around, or let less fluid out there",
                    lacking, name(), to_text(mesh_.fracture_cells[worst].center)),
        lacking);
}

}  // namespace sprekk::fracture_flow
