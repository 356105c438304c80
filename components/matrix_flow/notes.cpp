// What the flow in the matrix tells beside its answer.
#include <fmt/format.h>

#include <algorithm>

#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk::matrix_flow {

namespace {

constexpr double beyond_every_load = 1e10;  // Pa, thirty times what the deepest borehole has above it
constexpr double rounding = 1e-6;           // of the initial pressure

}  // namespace

void MatrixFlow::note_input(Notes& notes) const {
  if (!options_.gravity.is_zero() && options_.fluid_density == 0)
    notes.add(name() + ".gravity without effect",
              origin_.text() + ": gravity has no effect on the flow of '" + name() +
                  "' (its fluid_density is 0) give a density, or remove the gravity");
  for (const auto& [key, instead] : options_.without_effect)
    notes.add(name() + "." + key + " without effect",
              origin_.text() + ": '" + key + "' of '" + name() + "' has no effect (" + instead + ") remove it");
}

void MatrixFlow::note_step(Notes& notes, const StepTime&) const {
  const Vector& pressure = pressure_.now();
  Eigen::Index lowest = 0, largest = 0;
  const double smallest = pressure.minCoeff(&lowest), most = pressure.cwiseAbs().maxCoeff(&largest);
  // Pressures that begin above zero everywhere count from that of the air; others may count from any level.
  const double initial = initial_pressure_.minCoeff();
  if (initial > 0 && smallest < -rounding * initial)
    notes.add(
        pressure_.name() + " below zero",
        fmt::format("{} falls to {:.3g} Pa at {} (it began above zero everywhere, and no fluid bears to be pulled: "
                    "the flow would stop there) look at what is extracted and at the size of the steps",
                    pressure_.name(), smallest, to_text(mesh_.cell_center[lowest])),
        -smallest);
  if (most > beyond_every_load)
    notes.add(pressure_.name() + " beyond every load",
              fmt::format("{} reaches {:.3g} Pa at {} (no rock bears 10 GPa) look at permeability and rates there",
                          pressure_.name(), pressure[largest], to_text(mesh_.cell_center[largest])),
              most);
}

double MatrixFlow::largest_given_pressure() const {
  double largest = initial_pressure_.lpNorm<Eigen::Infinity>();
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (conditions_.size() > 0 && conditions_[f] == FlowCondition::pressure)
      largest = std::max(largest, std::abs(boundary_values_[f] + gravity_potential_face_[f]));
  return largest;
}

}  // namespace sprekk::matrix_flow
