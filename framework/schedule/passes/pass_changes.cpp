#include "framework/schedule/passes/pass_changes.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk {

namespace {

/// The least of the values from place `from` on, to the one before `to`.
double least(const std::vector<double>& values, std::size_t from, std::size_t to) {
  return *std::min_element(values.begin() + static_cast<std::ptrdiff_t>(from),
                           values.begin() + static_cast<std::ptrdiff_t>(to));
}

}  // namespace

void PassChanges::add(double size, double relative) {
  sizes_.push_back(size);
  relative_.push_back(relative);
}

bool PassChanges::only_grow() const {
  constexpr double clearly = 1.5;  // over all of them
  if (sizes_.size() <= watched || !(sizes_.back() > clearly * sizes_[sizes_.size() - 1 - watched])) return false;
  return std::is_sorted(sizes_.end() - watched - 1, sizes_.end());
}

bool PassChanges::explode() const {
  constexpr double fast = 10;  // growth by a pass, twice in a row, at which an iteration is given up
  const std::size_t n = sizes_.size();
  return n > 2 && sizes_[n - 1] > 1 && sizes_[n - 1] > fast * sizes_[n - 2] && sizes_[n - 2] > fast * sizes_[n - 3];
}

bool PassChanges::stay_large(std::size_t passes) const {
  constexpr double large = 0.1, hardly_less = 0.98;  // of the largest value; a factor of 0.998 a pass
  const std::size_t n = sizes_.size();
  if (n < begin_ + 2 * passes) return false;
  return least(relative_, n - passes, n) > large &&
         least(sizes_, n - passes, n) > hardly_less * least(sizes_, n - 2 * passes, n - passes);
}

bool PassChanges::are_round_off() const {
  constexpr double smallest = 1e-8, hardly_less = 0.9;  // as Newton's `update`; of the change ten passes before
  return sizes_.size() > begin_ + watched && *std::max_element(sizes_.end() - watched, sizes_.end()) < smallest &&
         sizes_.back() > hardly_less * sizes_[sizes_.size() - 1 - watched];
}

double PassChanges::factor() const {
  SPREKK_EXPECT(have_a_factor(), sizes_.size());
  return std::pow(sizes_.back() / sizes_[sizes_.size() - 1 - counted], 1.0 / counted);
}

}  // namespace sprekk
