#include "components/contact/jump_on_changed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/invariants.hpp"

namespace sprekk::contact {

namespace {

/// The part of the integral of the jump in a cell at a tip that lies between `from` and `to` (shares of the length,
/// from the other end). The jump falls with the square root of the distance to the tip.
double part_at_tip(double from, double to) {
  const auto beyond = [](double place) { return (1 - place) * std::sqrt(1 - place); };
  return beyond(from) - beyond(to);
}

bool is_at_tip(const Mesh& mesh, int cell) {
  return std::ranges::any_of(mesh.fracture_cells[cell].ridges,
                             [&](int point) { return mesh.ridges[point].kind == Ridge::Kind::tip; });
}

}  // namespace

Vector jump_on_changed_mesh(const MeshChange& change, const JumpsOnMesh& carried, const JumpsOnMesh& before) {
  SPREKK_EXPECT(carried.jump.size() == dimension * static_cast<long>(change.fracture_cell.size()), carried.jump.size());
  Vector jump = carried.jump;
  for (std::size_t i = 0; i < change.fracture_cell.size(); ++i)
    if (change.fracture_cell[i] == none) jump.segment<dimension>(dimension * i).setZero();
  // The volume of a replaced cell stays. The parts of each follow one another towards the tip.
  std::map<int, double> place;  // in an old cell, where its next part begins
  for (const ReplacedPart& replaced : change.replaced_parts) {
    SPREKK_EXPECT(is_index(replaced.old_cell, before.mesh.fracture_cell_count()), replaced.old_cell);
    const FractureCell& old = before.mesh.fracture_cells[replaced.old_cell];
    double& from = place[replaced.old_cell];
    const double to = std::min(1.0, from + replaced.share);
    const double share = is_at_tip(before.mesh, replaced.old_cell) ? part_at_tip(from, to) : to - from;
    jump.segment<dimension>(dimension * replaced.cell) += share * old.measure /
                                                          carried.mesh.fracture_cells[replaced.cell].measure *
                                                          before.jump.segment<dimension>(dimension * replaced.old_cell);
    from = to;
  }
  return jump;
}

}  // namespace sprekk::contact
