// The contact on a mesh that has changed.
#include <utility>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/jump_on_changed_mesh.hpp"
#include "components/contact/rate_and_state_walls.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::contact {

void FrictionalContact::carry_over(const Part& part, const MeshChange& change) {
  SPREKK_EXPECT(static_cast<int>(change.fracture_cell.size()) == mesh_.fracture_cell_count(),
                change.fracture_cell.size());
  const auto& before = dynamic_cast<const FrictionalContact&>(part);
  const Vector covered = covered_parts(change, mesh_);
  // Where a new cell covers no old one, it begins closed and without slip, and the old cells are not held. With
  // friction of rate and state, slip takes time, so cells keep their slip.
  const bool holds_all = rate_and_state_ || (covered.size() > 0 && covered.minCoeff() > 0);
  if (rate_and_state_) rate_and_state_->carry_over(*before.rate_and_state_);
  if (history_) history_->hold(true);
  bonded_.resize(change.fracture_cell.size());
  for (std::size_t i = 0; i < bonded_.size(); ++i) bonded_[i] = holds_all || change.fracture_cell[i] == none;
  Vector jump = jump_on_changed_mesh(change, {mesh_, jump_.accepted()}, {before.mesh_, before.jump_.accepted()});
  bonded_jump_ = jump;
  jump_.set_both(std::move(jump));
  if (change.is_at_rest) carried_traction_ = traction_.accepted();
}

void FrictionalContact::settled(const MeshChange& change) {
  if (change.is_at_rest) traction_.set_both(std::exchange(carried_traction_, {}));
  if (history_) history_->hold(false);
  bonded_.clear();
  bonded_jump_.resize(0);
}

}  // namespace sprekk::contact
