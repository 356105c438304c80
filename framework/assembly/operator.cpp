#include "framework/assembly/operator.hpp"

#include <atomic>

namespace sprekk {

Operator::Operator(SparseMatrix entries) {
  static std::atomic<std::uint64_t> made{0};
  entries.makeCompressed();
  entries_ = std::make_shared<const SparseMatrix>(std::move(entries));
  number_ = ++made;
}

}  // namespace sprekk
