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

bool same_number(std::uint64_t a, std::uint64_t b) { return a != 0 && a == b; }

}  // namespace

std::uint64_t new_system_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

Change LastSystem::compare_and_remember(const LinearSystem& system) {
  const SparseMatrix& a = system.local;
  SPREKK_EXPECT(a.isCompressed());
  const int* outer = a.outerIndexPtr();
  const int* inner = a.innerIndexPtr();
  const std::size_t nonzeros = a.nonZeros();
  const bool same_pattern =
      remembered_ && (same_number(pattern_number_, system.pattern_number) ||
                      (rows_ == system.rows && std::equal(outer_.begin(), outer_.end(), outer, outer + a.rows() + 1) &&
                       std::equal(inner_.begin(), inner_.end(), inner, inner + nonzeros)));
  const bool same_values =
      same_pattern && (same_number(number_, system.number) || (same_bits(values_.data(), a.valuePtr(), nonzeros) &&
                                                               same_stabilizations(stabilizations_, system.blocks)));
  pattern_number_ = system.pattern_number;
  number_ = system.number;
  const double change = parallel::max(same_values ? 0.0 : same_pattern ? 1.0 : 2.0);
  if (change == 0) return Change::nothing;

  if (!same_pattern) {
    rows_ = system.rows;
    outer_.assign(outer, outer + a.rows() + 1);
    inner_.assign(inner, inner + nonzeros);
  }
  values_.assign(a.valuePtr(), a.valuePtr() + nonzeros);
  stabilizations_.clear();
  for (const UnknownBlock& block : system.blocks) stabilizations_.push_back(block.stabilization);
  remembered_ = true;
  return change == 1 ? Change::values : Change::pattern;
}

}  // namespace sprekk
