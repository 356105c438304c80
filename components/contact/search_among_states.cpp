// How Newton's method finds its way among the states of the cells.
#include <algorithm>
#include <array>
#include <utility>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/rate_and_state_walls.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk::contact {

void FrictionalContact::set_search_mode(SearchMode mode) {
  is_without_shortcuts_ = mode != SearchMode::with_shortcuts;
  follows_pieces_ = is_without_shortcuts_ && mode != SearchMode::without_shortcuts;
}

void FrictionalContact::observe_iterate(const std::vector<Field*>& unknowns) {
  is_solved_for_ = std::find(unknowns.begin(), unknowns.end(), &traction_) != unknowns.end();
  if (follows_pieces_ || !is_solved_for_) return;
  const std::array<std::uint64_t, 2> values{traction_.version(), jump_.version()};
  if (!back_slip_.empty() && values == followed_) return;  // this update has been considered already
  followed_ = values;
  back_slip_.resize(mesh_.fracture_cell_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i)) continue;
    BackSlip& cell = back_slip_[i];
    const Trial t = trial(i);
    SPREKK_ASSERT(is_index(i, static_cast<long>(back_slip_.size())), i, back_slip_.size());
    TangentialVector direction = TangentialVector::Zero();
    if (t.state() == State::slip) direction = direction_of<dimension - 1>(t.tangential);
    const bool slides_back = dilation_[i] > 0 && t.slides_back();
    if (cell.taken == BackSlip::Piece::before_kink && direction.dot(cell.direction) <= 0) {
      const TangentialVector slip = tangential(jump_.now(), i) - tangential(jump_.accepted(), i);
      cell.is_beyond = cell.is_beyond || slip.dot(cell.direction) < 0;
    } else if (cell.taken == BackSlip::Piece::beyond_kink && slides_back) {
      cell.is_beyond = false;  // the kink was not reached, or no solution lies beyond it
    }
    cell.taken = !slides_back     ? BackSlip::Piece::none
                 : cell.is_beyond ? BackSlip::Piece::beyond_kink
                                  : BackSlip::Piece::before_kink;
    cell.direction = direction;
  }
}

State FrictionalContact::state(int i) const {
  const State state = trial(i).state();
  return rate_and_state_ && state == State::stick && rate_and_state_->slips(i) ? State::slip : state;
}

namespace {

/// In a plane: whether slip has the positive direction. In space the direction changes without a kink, and all
/// directions are one piece.
bool is_forward(const TangentialVector& vector) { return dimension == 2 && vector[0] > 0; }

}  // namespace

int FrictionalContact::piece(int i) const {
  if (!is_on_fracture_cell(i)) return 0;
  const Trial t = trial(i);
  const State now = t.state();
  const bool knows_direction = now == State::slip && (friction_[i] > 0 || weakening_.cohesion > 0);
  const int piece = 2 * static_cast<int>(now) + (knows_direction && is_forward(t.tangential));
  if (!follows_pieces_) return piece;
  if (is_bonded(i)) return 0;
  const bool has_kink = dilation_[i] > 0 && now != State::open;
  const bool is_worn = has_kink && t.dilation == 0;
  const int kink = 3 * piece + (is_worn ? 2 : has_kink && is_forward(t.slip_direction));
  if (!may_weaken() || now == State::stick) return kink;
  // What is left of the strength depends on the size of the slip in the step, and ends where all is lost.
  const Strength& s = t.strength;
  const bool is_spent =
      weakening_.is_on() ? t.path >= weakening_.distance : lost_by_slip(s, std::min(0.0, t.normal), dt_) == 0;
  return 3 * kink + (is_spent ? 2 : is_forward(path_ ? t.path_by_slip : t.slip_direction));
}

/// Opens all cells by a very small amount. The amount makes no difference, since the conditions of open cells are
/// linear.
void FrictionalContact::deactivate_conditions() {
  Vector traction = traction_.now(), jump = jump_.now();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (is_bonded(i) || !is_on_fracture_cell(i)) continue;
    traction.segment<dimension>(dimension * i).setZero();
    const double least = dilated(i, magnitude<dimension - 1>(tangential(jump, i))) - closure(i, 0);
    jump[dimension * i] = std::max(jump[dimension * i], least + rounding::same * mesh_.fracture_cells[i].size());
  }
  traction_.set(std::move(traction));
  jump_.set(std::move(jump));
}

int FrictionalContact::keep_states() {
  if (!is_solved_for_ || rate_and_state_) return 0;
  kept_.assign(mesh_.fracture_cell_count(), 0);
  int count = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i)) continue;
    const TangentialVector before = tangential(jump_.accepted(), i), slip = tangential(jump_.now(), i) - before;
    const bool slides_back = dilation_[i] > 0 && friction_[i] > 0 && slip.dot(before) < 0;
    const double small = rounding::far_above * jump_.now().lpNorm<Eigen::Infinity>();
    if (is_bonded(i) || !slides_back ||
        std::min(magnitude<dimension - 1>(slip), magnitude<dimension - 1>(before)) < small)
      continue;
    if (state(i) == State::open || traction_.accepted()[dimension * i] >= 0) continue;
    kept_[i] = 1;
    ++count;
  }
  if (count == 0) kept_.clear();
  return count;
}

int FrictionalContact::release_violated() {
  int count = 0;
  const std::vector<char> kept = std::exchange(kept_, {});
  std::vector<char> rest = kept;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i] || state(static_cast<int>(i)) == State::stick) continue;
    rest[i] = 0;
    ++count;
  }
  kept_ = std::move(rest);
  return count;
}

std::uint64_t FrictionalContact::discrete_state() const {
  std::uint64_t hash = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) hash = hash * 1000003 + piece(i);
  return hash;
}

}  // namespace sprekk::contact
