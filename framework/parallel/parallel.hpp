// The processes of a run. MPI is started only when the program was launched by mpirun, or by the first solver that
// needs it.
#pragma once

#include <string>
#include <vector>

#include "framework/types.hpp"

namespace sprekk::parallel {

int rank();      ///< of this process, from 0
int size();      ///< the number of processes
bool is_root();  ///< rank() == 0

double sum(double value);  ///< over all ranks; all these are collective
double max(double value);  ///< over all ranks
bool any(bool value);      ///< on any rank
void sum(Vector& values);  ///< entrywise over all ranks
void max(Vector& values);  ///< entrywise over all ranks
/// The vectors of all ranks, one after the other in order of rank. Their lengths may differ.
std::vector<int> gather(const std::vector<int>& mine);
std::vector<double> gather(const std::vector<double>& mine);
/// Whether all ranks give the same numbers, to the bit or both not a number. Collective.
bool is_same_everywhere(const std::vector<double>& values);
void barrier();    ///< waits for all ranks
void start_mpi();  ///< idempotent; solvers that always need MPI call it
/// Ends every process of the run after an error on one of them.
[[noreturn]] void abort_all(int exit_code);

}  // namespace sprekk::parallel
