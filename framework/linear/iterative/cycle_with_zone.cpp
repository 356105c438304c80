#include "framework/linear/iterative/cycle_with_zone.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/linear/gather_entries.hpp"

namespace sprekk {

CycleWithZone::CycleWithZone(const SparseMatrix& rows, const std::vector<int>& ids, std::vector<int> zone,
                             std::unique_ptr<Multigrid> cycle)
    : cycle_(std::move(cycle)),
      matrix_(trilinos().matrix(rows, ids, ids, static_cast<int>(rows.cols()))),
      zone_size_(static_cast<int>(zone.size())) {
  SPREKK_EXPECT(is_ascending(zone) && are_indices(zone, rows.cols()), zone_size_, rows.cols());
  const auto place_of = [&](Eigen::Index id) {
    const auto found = std::lower_bound(zone.begin(), zone.end(), id);
    return found != zone.end() && *found == id ? static_cast<int>(found - zone.begin()) : -1;
  };
  std::vector<Triplet> entries;
  for (std::size_t row = 0; row < ids.size(); ++row) {
    const int place = place_of(ids[row]);
    if (place < 0) continue;
    owned_.push_back(place);
    owners_.push_back(static_cast<int>(row));
    for (SparseMatrix::InnerIterator entry(rows, static_cast<int>(row)); entry; ++entry)
      if (const int column = place_of(entry.col()); column >= 0) entries.emplace_back(place, column, entry.value());
  }
  whole_zone_ = parallel::WholeVectors(owned_, zone_size_);
  LinearSystem alone;
  alone.local = gather_entries(entries, zone_size_, zone_size_);
  alone.rows.resize(zone_size_);
  std::iota(alone.rows.begin(), alone.rows.end(), 0);
  const LinearReport report = zone_.factor(alone);
  if (!report.solved)
    throw std::invalid_argument("the preconditioner cannot solve for what is beside fractures (" + report.reason + ")");
}

void CycleWithZone::add_answer_of_zone(const Vector& r, Vector& x) const {
  Vector whole = whole_zone_.whole(r(owners_));
  zone_.solve_unchecked(whole);
  x(owners_) += whole(owned_);
}

void CycleWithZone::apply(const Vector& b, Vector& x) const {
  x = Vector::Zero(b.size());
  add_answer_of_zone(b, x);
  Vector r = b, step;
  matrix_->subtract_product(x, r);
  cycle_->apply(r, step);
  x += step;
  r = b;
  matrix_->subtract_product(x, r);
  add_answer_of_zone(r, x);
}

}  // namespace sprekk
