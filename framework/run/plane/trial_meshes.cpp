#include "framework/run/plane/trial_meshes.hpp"

#include <algorithm>
#include <limits>

#include "framework/remeshing/continued_mesh.hpp"
#include "framework/remeshing/move_tips.hpp"

namespace sprekk {
namespace {

bool has_same_ends(const std::vector<PathExtension>& one, const std::vector<PathExtension>& other) {
  return std::ranges::equal(one, other, [](const PathExtension& a, const PathExtension& b) {
    return a.fracture == b.fracture && a.at_end == b.at_end && a.replaced == b.replaced &&
           a.points.size() == b.points.size();
  });
}

/// Whether the path divides the last cell of its fracture.
bool divides(const PathExtension& path) { return path.divides && path.points.size() == 2; }

/// Whether all paths go on from the last cells of their fractures.
bool go_on(const std::vector<PathExtension>& paths) {
  return std::ranges::all_of(paths, [](const PathExtension& path) {
    return path.replaced == 1 && path.whole_segments && (path.points.size() == 1 || divides(path));
  });
}

/// Whether the tips of this mesh can be moved to the ends of the paths.
bool can_follow(const Mesh& mesh, const std::vector<PathExtension>& paths, const CavityOptions& cavity) {
  const std::optional<GrownMesh> same = continued_mesh(mesh, paths, cavity);
  return same && move_tips(mesh, *same, paths, cavity);
}

const Point& tip_of(const Mesh& mesh, const PathExtension& path) {
  const Fracture& fracture = mesh.fractures[path.fracture];
  const int last = path.at_end ? fracture.first_cell + fracture.cell_count - 1 : fracture.first_cell;
  return mesh.ridges[mesh.fracture_cells[last].ridges[path.at_end ? 1 : 0]].center;
}

}  // namespace

TrialMeshes::TrialMeshes(Model& accepted, std::size_t grow_step, double time, IterationLog log, Observer retire)
    : accepted_(accepted),
      grow_step_(grow_step),
      data_{time - accepted.scene().time.step, accepted.scene().time.step, time},
      log_(std::move(log)),
      retire_(std::move(retire)),
      smallest_angle_(std::numeric_limits<double>::infinity()) {}

/// Forgets the mesh with tips at rest, and the meshes that were made from it.
void TrialMeshes::drop() {
  if (at_rest_ && retire_) retire_(*at_rest_, nullptr);
  at_rest_.reset();
  made_.reset();
  is_anew_ = false;
}

MeshChangeResult TrialMeshes::change(const Model& model, GrownMesh mesh) const {
  return change_mesh(model, grow_step_, std::move(mesh), data_, log_);
}

/// The mesh with tips at rest has both parts of divided cells already, so paths on it begin behind the first part.
std::vector<PathExtension> TrialMeshes::paths_from_rest(std::vector<PathExtension> paths) {
  for (PathExtension& path : paths)
    if (divides(path)) path.points.erase(path.points.begin());
  return paths;
}

std::vector<PathExtension> TrialMeshes::paths_from_base(const std::vector<PathExtension>& paths) const {
  return at_rest_ ? paths_from_rest(paths) : paths;
}

bool TrialMeshes::rest(const std::vector<PathExtension>& paths, Cells cells) {
  const CavityOptions cavity = cavity_of(accepted_, grow_step_);
  std::vector<PathExtension> resting = paths;
  for (PathExtension& path : resting) path.points.back() = tip_of(accepted_.mesh(), path);
  drop();
  is_anew_ = cells == Cells::anew;
  try {
    std::optional<GrownMesh> grown;
    if (is_anew_) {
      grown = grow_mesh(accepted_, grow_step_, resting);
    } else if (const std::optional<GrownMesh> same = continued_mesh(accepted_.mesh(), resting, cavity)) {
      grown = move_tips(accepted_.mesh(), *same, resting, cavity);
      if (grown && !can_follow(grown->mesh, paths_from_rest(paths), cavity)) grown.reset();
    }
    if (!grown) return false;
    grown->change.is_at_rest = true;
    MeshChangeResult changed = change(accepted_, std::move(*grown));
    if (!changed.settling.converged) return false;
    smallest_angle_ = std::min(smallest_angle_, changed.smallest_angle);
    at_rest_ = std::move(changed.model);
  } catch (const std::runtime_error&) {
    return false;
  }
  return true;
}

/// The mesh of the last trial, or at first that of the base, with moved tips.
std::optional<GrownMesh> TrialMeshes::moved(const std::vector<PathExtension>& paths) {
  const CavityOptions cavity = cavity_of(accepted_, grow_step_);
  const std::vector<PathExtension> from = paths_from_base(paths);
  if (!made_)
    if (std::optional<GrownMesh> same = continued_mesh(base().mesh(), from, cavity))
      made_ = Made{from, std::move(*same)};
  if (!made_ || !has_same_ends(made_->paths, from)) return std::nullopt;
  return move_tips(base().mesh(), made_->mesh, from, cavity);
}

MeshChangeResult TrialMeshes::model_with(const std::vector<PathExtension>& paths) {
  if (!has_same_ends(paths_, paths)) {
    drop();
    paths_ = paths;
    if (go_on(paths) && std::ranges::any_of(paths, divides) && !rest(paths, Cells::same)) rest(paths, Cells::anew);
  }
  std::optional<GrownMesh> mesh = moved(paths);
  if (!mesh && go_on(paths) && !is_anew_ && rest(paths, Cells::anew)) mesh = moved(paths);
  if (!mesh) {
    made_ = Made{paths_from_base(paths), grow_mesh(base(), grow_step_, paths_from_base(paths))};
    mesh = made_->mesh;
  }
  if (at_rest_) accepted_.growing()[grow_step_]->component().prepare(at_rest_->growing()[grow_step_]->component());
  MeshChangeResult result = change(base(), std::move(*mesh));
  result.smallest_angle = std::min(result.smallest_angle, smallest_angle_);
  return result;
}

}  // namespace sprekk
