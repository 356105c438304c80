#include "framework/parallel/row_exchange.hpp"

#include <mpi.h>

#include <numeric>
#include <unordered_map>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::parallel {
namespace {

template <class Value>
MPI_Datatype type_of() {
  return std::is_same_v<Value, int> ? MPI_INT : MPI_DOUBLE;
}

/// What this process gets from each process, where it gives `given[p]` to process p. The lengths are known.
template <class Value>
std::vector<std::vector<Value>> exchanged(const std::vector<std::vector<Value>>& given,
                                          const std::vector<int>& got_counts) {
  const int processes = size();
  SPREKK_EXPECT(static_cast<int>(given.size()) == processes, given.size(), processes);
  std::vector<int> given_counts, given_starts(processes), got_starts(processes);
  std::vector<Value> given_flat;
  for (const std::vector<Value>& values : given) {
    given_counts.push_back(static_cast<int>(values.size()));
    given_flat.insert(given_flat.end(), values.begin(), values.end());
  }
  std::exclusive_scan(given_counts.begin(), given_counts.end(), given_starts.begin(), 0);
  std::exclusive_scan(got_counts.begin(), got_counts.end(), got_starts.begin(), 0);
  std::vector<Value> got_flat(got_starts.back() + got_counts.back());
  MPI_Alltoallv(given_flat.data(), given_counts.data(), given_starts.data(), type_of<Value>(), got_flat.data(),
                got_counts.data(), got_starts.data(), type_of<Value>(), MPI_COMM_WORLD);
  std::vector<std::vector<Value>> got;
  for (int p = 0; p < processes; ++p)
    got.emplace_back(got_flat.begin() + got_starts[p], got_flat.begin() + got_starts[p] + got_counts[p]);
  return got;
}

std::vector<std::vector<int>> exchanged(const std::vector<std::vector<int>>& given) {
  std::vector<int> given_counts, got_counts(size());
  for (const std::vector<int>& values : given) given_counts.push_back(static_cast<int>(values.size()));
  MPI_Alltoall(given_counts.data(), 1, MPI_INT, got_counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  return exchanged(given, got_counts);
}

}  // namespace

// Process number % size knows who has a row. It tells those that have rows who wants them.
RowExchange::RowExchange(const std::vector<int>& have, const std::vector<int>& want)
    : wanted_(static_cast<int>(want.size())) {
  const int processes = size();
  std::vector<std::vector<int>> had(processes), asked(processes), wishes(processes);
  for (const int row : have) had[row % processes].push_back(row);
  for (const int row : want) asked[row % processes].push_back(row);
  had = exchanged(had);
  asked = exchanged(asked);
  std::unordered_map<int, int> owner;
  for (int p = 0; p < processes; ++p)
    for (const int row : had[p]) owner[row] = p;
  for (int p = 0; p < processes; ++p)
    for (const int row : asked[p]) {
      const auto found = owner.find(row);
      SPREKK_EXPECT(found != owner.end(), row);
      wishes[found->second].insert(wishes[found->second].end(), {row, p});
    }
  wishes = exchanged(wishes);
  std::unordered_map<int, int> place;
  for (std::size_t i = 0; i < have.size(); ++i) place[have[i]] = static_cast<int>(i);
  std::vector<std::vector<int>> numbers(processes);
  sent_.resize(processes);
  for (const std::vector<int>& pairs : wishes)
    for (std::size_t k = 0; k < pairs.size(); k += 2) {
      sent_[pairs[k + 1]].push_back(place.at(pairs[k]));
      numbers[pairs[k + 1]].push_back(pairs[k]);
    }
  received_ = exchanged(numbers);
  place.clear();
  for (std::size_t i = 0; i < want.size(); ++i) place[want[i]] = static_cast<int>(i);
  for (std::vector<int>& rows : received_)
    for (int& row : rows) row = place.at(row);
}

Eigen::MatrixXd RowExchange::moved(const Eigen::Ref<const Eigen::MatrixXd>& rows) const {
  std::vector<std::vector<double>> given;
  std::vector<int> got_counts;
  for (std::size_t p = 0; p < sent_.size(); ++p) {
    std::vector<double> values;
    values.reserve(sent_[p].size() * rows.cols());
    for (Eigen::Index column = 0; column < rows.cols(); ++column)
      for (const int place : sent_[p]) values.push_back(rows(place, column));
    given.push_back(std::move(values));
    got_counts.push_back(static_cast<int>(received_[p].size() * rows.cols()));
  }
  const std::vector<std::vector<double>> got = exchanged(given, got_counts);
  Eigen::MatrixXd result(wanted_, rows.cols());
  for (std::size_t p = 0; p < got.size(); ++p) {
    std::size_t k = 0;
    for (Eigen::Index column = 0; column < rows.cols(); ++column)
      for (const int place : received_[p]) result(place, column) = got[p][k++];
  }
  return result;
}

}  // namespace sprekk::parallel
