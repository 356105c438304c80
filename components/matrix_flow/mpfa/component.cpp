// matrix_flow/mpfa: flow in the matrix with the multi-point flux approximation.
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/mpfa/by_mobility.hpp"
#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/matrix_flow/mpfa/uncorrected_tips.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct MpfaOptions : Options {
  Spec spec() {
    return Options::spec("matrix_flow/mpfa",
                         "Flow in the matrix (the paper's Eq. 6): multi-point flux approximation, exact for "
                         "linear pressures on any mesh.",
                         true);
  }
};

FluxOperators discretize_alike_in_region(const Mesh& mesh, const std::vector<Tensor>& mobility,
                                         const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  MpfaLimits limits;
  limits.alike_in_region = true;
  return discretize_mpfa_with(limits, mesh, mobility, conditions, nodes);
}

class Mpfa : public MatrixFlow {
 public:
  Mpfa(const ComponentContext& context, const MpfaOptions& options)
      : MatrixFlow(context, options, discretize_mpfa, Unknowns::on_cells, Fluxes::linear, differentiate_mpfa) {
    if (mobility_follows_state()) discretize_with(discretize_alike_in_region);
  }

  void note_input(Notes& notes) const override {
    MatrixFlow::note_input(notes);
    if (is_permeable() && !mobility_follows_state()) note_uncorrected_tips(notes, name(), mesh(), mobility());
  }
};

const RegisterComponent<Mpfa, MpfaOptions> registration("matrix_flow/mpfa");
const RegisterFluxDiscretization discretization("mpfa", discretize_mpfa);

}  // namespace
}  // namespace sprekk::matrix_flow
