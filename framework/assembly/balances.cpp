#include "framework/assembly/balances.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk {

Balances::Balances(std::size_t unknowns) : of_(unknowns) {}

bool Balances::Quantity::has(int unknown) const {
  return std::find(unknowns.begin(), unknowns.end(), unknown) != unknowns.end();
}

void Balances::declare(int unknown, const std::string& field, const std::string& quantity, const Vector& so_far) {
  SPREKK_EXPECT(is_index(unknown, static_cast<long>(of_.size())), unknown, of_.size());
  if (are_rows_of(unknown)) throw std::logic_error(field + " is a balance: this was said twice");
  of_[unknown].residual = of_[unknown].throughput = Vector::Zero(so_far.size());
  add(unknown, so_far);
  auto found = std::ranges::find(quantities_, quantity, &Quantity::name);
  if (found == quantities_.end()) found = quantities_.insert(quantities_.end(), {quantity, {}});
  found->unknowns.push_back(unknown);
}

void Balances::add(int unknown, const Vector& values) {
  if (!are_rows_of(unknown)) return;
  Rows& rows = of_[unknown];
  SPREKK_EXPECT(values.size() == rows.residual.size(), values.size(), rows.residual.size());
  rows.residual += values;
  const double size = values.lpNorm<1>();
  rows.magnitude = std::max(rows.magnitude, size);
  rows.round_off_base = std::max(rows.round_off_base, size);
}

void Balances::add_throughput(int unknown, const Vector& amounts) {
  SPREKK_EXPECT(!are_rows_of(unknown) || amounts.size() == of_[unknown].throughput.size(), amounts.size());
  if (are_rows_of(unknown)) of_[unknown].throughput += amounts.cwiseAbs();
}

void Balances::compare_round_off(int unknown, double largest) {
  SPREKK_EXPECT(!(largest < 0), unknown, largest);
  of_[unknown].round_off_base = std::max(of_[unknown].round_off_base, largest);
}

}  // namespace sprekk
