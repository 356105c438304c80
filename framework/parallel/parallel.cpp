#include "framework/parallel/parallel.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "framework/invariants.hpp"
#include "framework/parallel/alone.hpp"

namespace sprekk::parallel {
namespace {

int alone = 0;  ///< objects of Alone

bool launched_by_mpirun() {
  static const bool launched = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
  return launched;
}

bool is_running() {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  return initialized != 0 && finalized == 0;
}

void finalize_at_exit() {
  if (is_running()) MPI_Finalize();
}

// A single process without MPI answers at once and never pays for its start.
bool several() { return size() > 1; }

template <class Value>
std::vector<Value> gather_values(const std::vector<Value>& mine, MPI_Datatype type) {
  if (!several()) return mine;
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(size()), starts(size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  SPREKK_ASSERT(counts[rank()] == count, rank(), count);
  std::vector<Value> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), starts.data(), type, MPI_COMM_WORLD);
  return all;
}

}  // namespace

void start_mpi() {
  if (is_running()) return;
  if (!launched_by_mpirun()) {
    // A process of its own has nobody to communicate with. Without a daemon and without networks Open MPI starts in
    // 0.03 s instead of 0.4 s.
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_mpi_yield_when_idle", "0", 1);
    // Nor does it need a session folder: all runs of a user have theirs in one folder, which the first to end removes.
    setenv("OMPI_MCA_btl", "self", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
  MPI_Init(nullptr, nullptr);
  std::atexit(finalize_at_exit);
}

Alone::Alone() { ++alone; }
Alone::~Alone() { --alone; }

int rank() {
  if (alone > 0) return 0;
  if (launched_by_mpirun()) start_mpi();
  if (!is_running()) return 0;
  int value = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &value);
  SPREKK_ASSERT(value >= 0, value);
  return value;
}

int size() {
  if (alone > 0) return 1;
  if (launched_by_mpirun()) start_mpi();
  if (!is_running()) return 1;
  int value = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &value);
  SPREKK_ASSERT(value >= 1, value);
  return value;
}

bool is_root() { return rank() == 0; }

double sum(double value) {
  if (several()) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return value;
}

double max(double value) {
  if (several()) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return value;
}

bool any(bool value) { return max(value ? 1.0 : 0.0) > 0; }

void sum(Vector& values) {
  if (!several()) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
}

void max(Vector& values) {
  if (!several()) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

std::vector<int> gather(const std::vector<int>& mine) { return gather_values(mine, MPI_INT); }
std::vector<double> gather(const std::vector<double>& mine) { return gather_values(mine, MPI_DOUBLE); }

bool is_same_everywhere(const std::vector<double>& values) {
  if (!several()) return true;
  std::vector<double> first = values;
  unsigned long long count = values.size();
  MPI_Bcast(&count, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
  first.resize(count);
  MPI_Bcast(first.data(), static_cast<int>(count), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  const bool is_same = std::equal(values.begin(), values.end(), first.begin(), first.end(),
                                  [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
  return !any(!is_same);
}

void barrier() {
  if (several()) MPI_Barrier(MPI_COMM_WORLD);
}

void abort_all(int exit_code) {
  std::fflush(nullptr);
  if (several()) MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::exit(exit_code);
}

}  // namespace sprekk::parallel
