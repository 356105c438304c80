// poromechanics/mpsa: deformation with the multi-point stress approximation.
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "components/poromechanics/mpsa/rediscretize.hpp"
#include "components/poromechanics/mpsa/uncorrected_tips.hpp"
#include "components/poromechanics/rock.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::poromechanics {
namespace {

struct MpsaOptions : Options {
  Spec spec() {
    return Options::spec(
        "poromechanics/mpsa",
        dimension == 2 ? "Quasi-static deformation of the rock (the paper's Eqs. 5, 7), linear elastic in plane "
                         "strain: multi-point stress approximation with weak symmetry."
                       : "Quasi-static deformation of the rock (the paper's Eqs. 5, 7), linear elastic: multi-point "
                         "stress approximation with weak symmetry.");
  }
};

StressOperators discretize_inputs(const StressInputs& inputs, const std::vector<char>& nodes) {
  return discretize_mpsa(inputs.mesh, inputs.stiffness, inputs.conditions, nodes);
}

class Mpsa : public Rock {
 public:
  Mpsa(const ComponentContext& context, const MpsaOptions& options)
      : Rock(context, options, {discretize_inputs, rediscretize_mpsa}) {
    const bool has_springs = std::ranges::any_of(options.boundary, [](const auto& s) { return s.second.has_spring(); });
    if (dimension == 3 && has_springs)
      throw InputError(context.origin, "'" + name() + "' takes no springs in space",
                       "edges and corners of the rock would not be held by them",
                       "take poromechanics/fem, or hold the side");
  }

  void note_input(Notes& notes) const override {
    Rock::note_input(notes);
    note_uncorrected_tips(notes, name(), mesh(), stiffness_of_cells());
  }
};

const RegisterComponent<Mpsa, MpsaOptions> registration("poromechanics/mpsa");

}  // namespace
}  // namespace sprekk::poromechanics
