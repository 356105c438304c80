#include "framework/parallel/gathered.hpp"

#include <mpi.h>

#include <algorithm>
#include <numeric>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::parallel {
Vector gathered(const Vector& mine, const std::vector<int>& counts) {
  if (size() == 1) return mine;
  SPREKK_EXPECT(static_cast<int>(counts.size()) == size(), counts.size(), size());
  SPREKK_EXPECT(counts[rank()] == mine.size(), counts[rank()], mine.size());
  std::vector<int> starts(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  Vector all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), counts[rank()], MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                 MPI_COMM_WORLD);
  return all;
}

void broadcast(void* bytes, std::size_t count) {
  if (size() == 1) return;
  constexpr std::size_t most = 1 << 30;  // at once: MPI counts with int
  for (std::size_t begin = 0; begin < count; begin += most)
    MPI_Bcast(static_cast<char*>(bytes) + begin, static_cast<int>(std::min(most, count - begin)), MPI_BYTE, 0,
              MPI_COMM_WORLD);
}

void broadcast(Vector& values) { broadcast(values.data(), values.size() * sizeof(double)); }

WholeVectors::WholeVectors(const std::vector<int>& mine, int size) {
  if (parallel::size() == 1) return;
  counts_ = gather(std::vector<int>{static_cast<int>(mine.size())});
  places_ = gather(mine);
  for (int& place : places_)
    if (place >= size) place = -1;
  SPREKK_EXPECT(std::ranges::count_if(places_, [](int place) { return place >= 0; }) == size, places_.size(), size);
}

Vector WholeVectors::whole(const Vector& mine) const {
  if (parallel::size() == 1) return mine;
  const Vector all = gathered(mine, counts_);
  SPREKK_ASSERT(all.size() == static_cast<Eigen::Index>(places_.size()), all.size(), places_.size());
  Vector result(all.size() - std::ranges::count(places_, -1));
  for (Eigen::Index k = 0; k < all.size(); ++k)
    if (places_[k] >= 0) result[places_[k]] = all[k];
  return result;
}

}  // namespace sprekk::parallel
