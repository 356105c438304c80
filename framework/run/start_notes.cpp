#include "framework/run/start_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "framework/assembly/heeds_stages.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/linear/direct/blas_memory.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/quality/network_shape.hpp"
#include "framework/meshing/regions.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/run/unchanging_data.hpp"

namespace sprekk {

namespace {

/// Degrees; what tools/stress has found to be harmless.
constexpr double least_good_angle = 5;
/// Cells of a pocket. A triangle with three edges on each side has this number; with fewer cells, values in a pocket
/// hardly vary.
constexpr int few_cells = 9;
/// Unknowns. Measured: with 44,000 in two dimensions each of two processes is as busy as one alone.
constexpr long worth_sharing = 50'000;

std::string names_of(const Mesh& mesh, const std::vector<int>& fractures) {
  std::string names;
  for (const int fracture : fractures) names += (names.empty() ? "'" : ", '") + mesh.fractures[fracture].name + "'";
  return names;
}

std::string others(std::size_t count, const char* what) {
  return count == 0 ? "" : fmt::format("; {} more {}", count, what);
}

/// Notes fractures that meet at a small angle, the smallest with its names.
void note_angles(const Mesh& mesh, Notes& notes) {
  std::vector<FractureAngle> small = angles_of_junctions(mesh);
  const auto in_degrees = [](const FractureAngle& angle) { return angle.angle * 180 / std::numbers::pi; };
  std::erase_if(small, [&](const FractureAngle& angle) { return in_degrees(angle) >= least_good_angle; });
  if (small.empty()) return;
  const FractureAngle& worst = *std::ranges::min_element(small, {}, &FractureAngle::angle);
  notes.add("small angle between fractures",
            fmt::format("fractures {} meet at {:.2g} degrees at {}{} (cells between them are as flat as the angle, and "
                        "multi-point discretizations may overshoot there) let one end on the other at a larger angle, "
                        "or make one fracture of both",
                        names_of(mesh, {worst.one, worst.other}), in_degrees(worst), to_text(worst.at),
                        others(small.size() - 1, "junctions have small angles")));
}

/// Notes parts of the rock between fractures that have few cells, the one with the fewest with its names.
void note_pockets(const Mesh& mesh, Notes& notes) {
  std::vector<Pocket> small = pockets(mesh);
  std::erase_if(small, [](const Pocket& pocket) { return pocket.cells >= few_cells; });
  if (small.empty()) return;
  const Pocket& worst = small.front();
  notes.add(
      "small pocket between fractures",
      fmt::format(
          "fractures {} enclose {:.2g} {} with {} cells at {}{} (so few do not resolve how values vary there) lower "
          "mesh.fracture_size or the size of these fractures, or move one of them",
          names_of(mesh, worst.fractures), worst.measure, volume_unit, worst.cells, to_text(worst.center),
          others(small.size() - 1, "pockets have few")));
}

/// Notes regions without a cell: their values have no effect.
void note_empty_regions(const Mesh& mesh, Notes& notes) {
  std::vector<bool> has_cell(mesh.region_names.size(), false);
  for (const int region : mesh.cell_region) has_cell[region] = true;
  std::vector<std::string> empty;
  for (std::size_t i = 0; i < has_cell.size(); ++i)
    if (!has_cell[i] && mesh.region_names[i] != medium_name()) empty.push_back(mesh.region_names[i]);
  if (empty.empty()) return;
  notes.add(
      "region without cells",
      fmt::format("no cell belongs to {}: what is given there has no effect (it lies outside of the box or "
                  "between the centres of cells, or later regions cover it) move it, use smaller cells, or give the "
                  "smaller region after the larger one",
                  listed(empty)));
}

/// Notes regions of which the later one covers a part of the earlier one, and has other cells as well. A region that
/// lies in another one is meant.
void note_overlapping_regions(const Geometry& geometry, const Mesh& mesh, Notes& notes) {
  const std::vector<RegionGeometry>& regions = geometry.regions;
  if (!geometry.file.empty()) return;
  const auto number_of = [&](const std::string& name) {
    return static_cast<int>(std::ranges::find(mesh.region_names, name) - mesh.region_names.begin());
  };
  for (std::size_t later = 1; later < regions.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const int own = number_of(regions[later].name), other = number_of(regions[earlier].name);
      int inside = 0, outside = 0, left = 0;
      Point at = Point::Zero();
      for (int c = 0; c < mesh.cell_count(); ++c) {
        left += mesh.cell_region[c] == other ? 1 : 0;
        if (mesh.cell_region[c] != own) continue;
        const bool is_in_both = is_inside(mesh.cell_center[c], regions[earlier]);
        if (is_in_both && inside == 0) at = mesh.cell_center[c];
        ++(is_in_both ? inside : outside);
      }
      if (inside == 0 || outside == 0 || left == 0) continue;
      notes.add("regions that overlap: " + regions[earlier].name + " and " + regions[later].name,
                fmt::format("regions '{}' and '{}' overlap in {} cells, as at {} (there the values of '{}' hold, which "
                            "is given later) change their order for the other values, or let them end at one another",
                            regions[earlier].name, regions[later].name, inside, to_text(at), regions[later].name));
    }
}

/// Recommends two stages to a run with one, where all parts allow them.
void note_stages(const Model& model, Notes& notes) {
  if (model.scene().time.scheme != TimeScheme::backward_euler) return;
  if (!std::ranges::all_of(model.parts(), &Part::allows_stages)) return;
  for (const Part* part : model.parts()) {
    const auto* gains = dynamic_cast<const HeedsStages*>(part);
    const std::string loss = gains ? gains->loss_of_one_stage() : "";
    if (!loss.empty())
      notes.add("one stage where two are far better",
                "with backward_euler " + loss + " set time.scheme to sdirk2, which every part of this scene allows");
  }
}

RunExtent extent_of(const Model& model) {
  const TimeOptions& time = model.scene().time;
  RunExtent extent{time.start, std::min(time.step, time.end - time.start), time.end};
  const std::vector<Point>& nodes = model.mesh().nodes;
  if (nodes.empty()) return extent;
  extent.lowest = extent.highest = nodes.front();
  for (const Point& node : nodes) {
    extent.lowest = extent.lowest.cwiseMin(node);
    extent.highest = extent.highest.cwiseMax(node);
  }
  return extent;
}

}  // namespace

Notes start_notes(const Model& model, const MeshQuality& quality, long unknowns) {
  Notes notes = model.input_notes();
  note_angles(model.mesh(), notes);
  note_pockets(model.mesh(), notes);
  note_empty_regions(model.mesh(), notes);
  note_overlapping_regions(model.scene().geometry, model.mesh(), notes);
  note_stages(model, notes);
  note_unchanging_data(notes, model.scene().whole, extent_of(model));
  if (blas_in_use().is_reference)
    notes.add("reference BLAS",
              "the reference BLAS is in use, which makes sparse factorizations several times slower: "
              "install libopenblas0-pthread");
  if (const double angle = quality.smallest_angle * 180 / std::numbers::pi; angle < least_good_angle)
    notes.add("small angle of the mesh",
              "the mesh has " + flatness_text(model.mesh(), quality.flattest_cell) +
                  ", where multi-point discretizations may overshoot (lines that meet at a small angle, or a gap "
                  "narrower than mesh.gap_size) move lines apart or join them");
  if (parallel::size() > 1 && unknowns < worth_sharing)
    notes.add(
        "too few unknowns for several processes",
        fmt::format(
            "the run shares {} unknowns among {} processes, which as a rule takes longer than one alone (below about "
            "{} each process does as much work as one alone would, and waits for the others) start it without mpirun",
            unknowns, parallel::size(), worth_sharing));
  return notes;
}

}  // namespace sprekk
