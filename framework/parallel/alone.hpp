// What every process computes by itself.
#pragma once

namespace sprekk::parallel {

/// While one exists, this process is the only one: size() is 1, and sums and maxima are its own. For work on data of
/// which every process has all, such as a system of the unknowns on fractures. Nothing inside may start MPI.
class Alone {
 public:
  Alone();
  ~Alone();
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;
};

}  // namespace sprekk::parallel
