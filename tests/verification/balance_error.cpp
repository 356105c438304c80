#include "tests/verification/balance_error.hpp"

#include <cmath>
#include <limits>
#include <map>

#include "framework/assembly/part.hpp"

namespace sprekk::testing {

double balance_error(SceneRun& run, const std::string& quantity) {
  std::map<std::string, Balance> balances;
  for (const Part* part : run.model().parts()) part->balance(balances);
  const Balance& balance = balances.at(quantity);
  if (balance.throughput <= 0) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(balance.stored + balance.outflow - balance.injected) / balance.throughput;
}

}  // namespace sprekk::testing
