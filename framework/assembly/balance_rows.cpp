#include "framework/assembly/balance_rows.hpp"

#include "framework/invariants.hpp"

namespace sprekk {

BalanceRows::BalanceRows(Assembly& assembly, const Field& row)
    : assembly_(assembly), row_(row), unknown_(assembly.index_of(row)) {}

BalanceRows::BalanceRows(Assembly& assembly, const Field& row, const std::string& quantity)
    : BalanceRows(assembly, row) {
  SPREKK_EXPECT(!quantity.empty(), row.name());
  if (unknown_ >= 0) assembly.balances_.declare(unknown_, row.name(), quantity, assembly.residuals_[unknown_]);
}

void BalanceRows::store(const Vector& amounts, double largest) {
  SPREKK_EXPECT(amounts.size() == row_.size(), row_.name(), amounts.size(), row_.size());
  assembly_.add(row_, amounts);
  if (largest > 0) assembly_.compare_round_off(row_, largest);
  add_throughput(amounts);
}

void BalanceRows::supply(const Vector& amounts) {
  SPREKK_EXPECT(amounts.size() == row_.size(), row_.name(), amounts.size(), row_.size());
  assembly_.add(row_, -amounts);
  add_throughput(amounts);
}

void BalanceRows::exchange(const Vector& outflow, const Vector& leaving, double largest) {
  SPREKK_EXPECT(outflow.size() == row_.size(), row_.name(), outflow.size(), row_.size());
  SPREKK_EXPECT(leaving.size() == row_.size(), row_.name(), leaving.size(), row_.size());
  if (unknown_ < 0) return;
  assembly_.add(unknown_, outflow, leaving);
  assembly_.compare_round_off_of_rows(unknown_, largest);
  add_throughput(leaving);
}

void BalanceRows::add_throughput(const Vector& amounts) {
  SPREKK_EXPECT(amounts.size() == row_.size(), row_.name(), amounts.size(), row_.size());
  if (unknown_ >= 0) assembly_.balances_.add_throughput(unknown_, amounts);
}

}  // namespace sprekk
