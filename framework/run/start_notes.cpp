#include "framework/run/start_notes.hpp"

#include <fmt/format.h>

#include <numbers>

#include "framework/linear/direct/blas_memory.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

/// Degrees; what tools/stress has found to be harmless.
constexpr double least_good_angle = 5;
/// Unknowns. Measured: with 44,000 in two dimensions each of two processes is as busy as one alone.
constexpr long worth_sharing = 50'000;

}  // namespace

Notes start_notes(const Model& model, const MeshQuality& quality, long unknowns) {
  Notes notes = model.input_notes();
  if (blas_in_use().is_reference)
    notes.add("reference BLAS",
              "the reference BLAS is in use, which makes sparse factorizations several times slower: "
              "install libopenblas0-pthread");
  if (const double angle = quality.smallest_angle * 180 / std::numbers::pi; angle < least_good_angle)
    notes.add("small angle of the mesh",
              fmt::format("the mesh has an angle of {:.2g} degrees, where multi-point discretizations may overshoot "
                          "(lines that meet at a small angle, or a gap narrower than mesh.gap_size)",
                          angle));
  if (parallel::size() > 1 && unknowns < worth_sharing)
    notes.add(
        "too few unknowns for several processes",
        fmt::format("the run shares {} unknowns among {} processes, which as a rule takes longer than one alone (below "
                    "about {} each is as busy as one would be, and waits for the others) start it without mpirun",
                    unknowns, parallel::size(), worth_sharing));
  return notes;
}

}  // namespace sprekk
