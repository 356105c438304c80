#include "framework/scene/plane/change_mesh.hpp"

#include <algorithm>
#include <map>

#include "framework/assembly/follows_mesh.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/partition.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/scene/plane/transfer_in_cells.hpp"
#include "framework/scene/plane/transferred_cells.hpp"

namespace sprekk {

namespace {

/// Copies the values of kept cells; each cell has `parts` entities of the field (two walls for a fracture cell).
void copy_kept(const Field& old, const std::vector<int>& origin, int parts, Vector& values) {
  const int width = parts * old.spec().components;
  SPREKK_EXPECT(values.size() == static_cast<Eigen::Index>(origin.size()) * width, old.name(), values.size(), width);
  SPREKK_EXPECT(std::ranges::all_of(origin, [&](int i) { return i == none || is_index(i, old.size() / width); }));
  for (int i = 0; i < static_cast<int>(origin.size()); ++i)
    if (origin[i] != none) values.segment(i * width, width) = old.accepted().segment(origin[i] * width, width);
}

/// New entities on fractures that cover old ones: the sums of shares of amounts, and means of densities over what is
/// covered.
void share_replaced(const Field& old, const MeshChange& change, int parts, Vector& values) {
  const int width = parts * old.spec().components;
  std::map<int, double> covered;  // m, by new cell
  for (const ReplacedPart& part : change.replaced_parts) {
    if (covered.emplace(part.cell, 0).second) values.segment(part.cell * width, width).setZero();
    covered[part.cell] += part.length;
    values.segment(part.cell * width, width) +=
        (old.spec().is_amount ? part.share : part.length) * old.accepted().segment(part.old_cell * width, width);
  }
  if (old.spec().is_amount) return;
  for (const auto& [cell, length] : covered) values.segment(cell * width, width) /= length;
}

}  // namespace

void transfer_fields(const FieldStore& before, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh,
                     FieldStore& after, const std::vector<Part*>& old_parts) {
  const bool has_new_cells = std::ranges::find(change.cell, none) != change.cell.end();
  for (const auto& field : after.all()) {
    const Field& old = before.at(field->name());
    Vector values = field->accepted();
    switch (field->spec().location) {
      case Location::cell: {
        KnownWithinCells known;
        if (has_new_cells && !old.spec().is_amount)
          for (const auto* part : parts_with<FollowsMesh>(old_parts)) part->add_known_within_cells(old, known);
        values = transferred_cells(old, change, old_mesh, new_mesh, known);
        break;
      }
      case Location::fracture_cell:
        copy_kept(old, change.fracture_cell, 1, values);
        share_replaced(old, change, 1, values);
        break;
      case Location::wall:
        copy_kept(old, change.fracture_cell, 2, values);
        share_replaced(old, change, 2, values);
        break;
      case Location::ridge:
        copy_kept(old, change.ridge, 1, values);
        break;
      case Location::node:
      case Location::face:
        values = transferred_in_cells(old, change, old_mesh, new_mesh);
        break;
      case Location::listed:
        values = old.accepted();
        break;
    }
    field->set_both(std::move(values));
  }
}

CavityOptions cavity_of(const Model& before, std::size_t grow_step) {
  SPREKK_EXPECT(grow_step < before.growing().size(), grow_step, before.growing().size());
  CavityOptions cavity = before.growing()[grow_step]->cavity();
  cavity.gap_edges = before.scene().mesh.gap_edges;
  return cavity;
}

GrownMesh grow_mesh(const Model& before, std::size_t grow_step, const std::vector<PathExtension>& extensions) {
  SPREKK_EXPECT(!extensions.empty());
  return extend_fractures(before.mesh(), extensions, cavity_of(before, grow_step));
}

MeshChangeResult change_mesh(const Model& before, std::size_t grow_step, GrownMesh grown, const StepTime& data,
                             IterationLog log) {
  partition(grown.mesh, parallel::size(), before.scene().mesh.division);
  MeshChangeResult result{
      std::make_unique<Model>(before.scene(), std::move(grown.mesh), std::move(log)), grown.smallest_angle, {}};
  Model& model = *result.model;
  SPREKK_ASSERT(model.parts().size() == before.parts().size(), model.parts().size(), before.parts().size());
  grown.change.is_at_start = data.end <= before.scene().time.start;
  if (!grown.change.is_at_start) {
    // Parts tell what they know of the accepted state: not with the data of a step that was tried since.
    begin_step(before.parts(), data);
    transfer_fields(before.fields(), grown.change, before.mesh(), model.mesh(), model.fields(), before.parts());
  }
  for (Part* part : model.parts()) part->evaluate_data(data);
  for (std::size_t i = 0; i < model.parts().size(); ++i)
    if (auto* follower = dynamic_cast<FollowsMesh*>(model.parts()[i]))
      follower->carry_over(*before.parts()[i], grown.change);
  begin_step(model.parts(), data);
  result.settling = grown.change.is_at_start ? StepStatus{true, "", 0} : model.growing()[grow_step]->settle(data);
  for (auto* follower : parts_with<FollowsMesh>(model.parts())) follower->settled(grown.change);
  model.accept();
  return result;
}

}  // namespace sprekk
