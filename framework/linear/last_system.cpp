#include "framework/linear/last_system.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

bool same_bits(const double* a, const double* b, std::size_t n) {
  return n == 0 || std::memcmp(a, b, n * sizeof(double)) == 0;
}

bool same_stabilizations(const std::vector<Vector>& kept, const std::vector<UnknownBlock>& blocks) {
  return std::equal(kept.begin(), kept.end(), blocks.begin(), blocks.end(), [](const Vector& a, const UnknownBlock& b) {
    return a.size() == b.stabilization.size() && same_bits(a.data(), b.stabilization.data(), a.size());
  });
}

constexpr std::uint64_t telling = std::uint64_t{1} << 63;  ///< the bit of numbers that tell systems apart

bool same_number(std::uint64_t a, std::uint64_t b) { return a != 0 && a == b; }

}  // namespace

std::uint64_t new_system_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::uint64_t new_telling_number() { return telling | new_system_number(); }

bool have_same_places(const LinearSystem& a, const LinearSystem& b) {
  const SparseMatrix &left = a.local, &right = b.local;
  SPREKK_EXPECT(left.isCompressed() && right.isCompressed());
  return a.rows == b.rows && left.nonZeros() == right.nonZeros() &&
         std::equal(left.outerIndexPtr(), left.outerIndexPtr() + left.rows() + 1, right.outerIndexPtr()) &&
         std::equal(left.innerIndexPtr(), left.innerIndexPtr() + left.nonZeros(), right.innerIndexPtr());
}

bool have_same_bits(const LinearSystem& a, const LinearSystem& b) {
  return have_same_places(a, b) && same_bits(a.local.valuePtr(), b.local.valuePtr(), a.local.nonZeros()) &&
         std::ranges::equal(a.blocks, b.blocks, [](const UnknownBlock& x, const UnknownBlock& y) {
           return x.stabilization.size() == y.stabilization.size() &&
                  same_bits(x.stabilization.data(), y.stabilization.data(), x.stabilization.size());
         });
}

bool LastSystem::Copy::has_pattern_of(const LinearSystem& system) const {
  const SparseMatrix& a = system.local;
  return rows == system.rows && static_cast<Eigen::Index>(inner.size()) == a.nonZeros() &&
         std::equal(outer.begin(), outer.end(), a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1) &&
         std::equal(inner.begin(), inner.end(), a.innerIndexPtr());
}

bool LastSystem::Copy::has_values_of(const LinearSystem& system) const {
  return same_bits(values.data(), system.local.valuePtr(), values.size()) &&
         same_stabilizations(stabilizations, system.blocks);
}

Change LastSystem::compare_and_remember(const LinearSystem& system) {
  const SparseMatrix& a = system.local;
  SPREKK_EXPECT(a.isCompressed());
  const bool by_number = (system.number & telling) != 0 && system.pattern_number != 0;
  const bool can_compare = copy_ && !by_number;
  const bool same_pattern = remembered_ && (same_number(pattern_number_, system.pattern_number) ||
                                            (can_compare && copy_->has_pattern_of(system)));
  const bool same_values =
      same_pattern && (same_number(number_, system.number) || (can_compare && copy_->has_values_of(system)));
  pattern_number_ = system.pattern_number;
  number_ = system.number;
  const double change = parallel::max(same_values ? 0.0 : same_pattern ? 1.0 : 2.0);
  if (change == 0) return Change::nothing;

  if (by_number) copy_.reset();
  if (!by_number) {
    const bool has_pattern = copy_ && same_pattern;
    if (!copy_) copy_.emplace();
    if (!has_pattern) {
      copy_->rows = system.rows;
      copy_->outer.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1);
      copy_->inner.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
    }
    copy_->values.assign(a.valuePtr(), a.valuePtr() + a.nonZeros());
    copy_->stabilizations.clear();
    for (const UnknownBlock& block : system.blocks) copy_->stabilizations.push_back(block.stabilization);
  }
  remembered_ = true;
  return change == 1 ? Change::values : Change::pattern;
}

}  // namespace sprekk
