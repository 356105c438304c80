// Fractures in space do not grow: no component there has any that could.
#include "framework/run/mesh_growth.hpp"

#include <limits>

namespace sprekk {

MeshGrowth::MeshGrowth(std::unique_ptr<Model>& model, StepController& controller, IterationLog log, Observer retire)
    : model_(model), controller_(controller), log_(std::move(log)), retire_(std::move(retire)) {}

StepStatus MeshGrowth::attempt(const StepTime& step) { return model_->attempt(step); }

MeshGrowth::Outcome MeshGrowth::before_acceptance() { return Outcome::nothing; }

MeshGrowth::Outcome MeshGrowth::after_acceptance() { return Outcome::nothing; }

double MeshGrowth::longest_step() const { return std::numeric_limits<double>::infinity(); }

}  // namespace sprekk
