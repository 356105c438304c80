// matrix_flow/tpfa: flow in the matrix with this flux approximation.
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct TpfaOptions : Options {
  Spec spec() {
    return Options::spec("matrix_flow/tpfa",
                         "Flow in the matrix (the paper's Eq. 6): two-point flux approximation, monotone; "
                         "consistent on orthogonal meshes only.",
                         true);
  }
};

class Tpfa : public MatrixFlow {
 public:
  Tpfa(const ComponentContext& context, const TpfaOptions& options)
      : MatrixFlow(context, options, discretize_tpfa, Unknowns::on_cells, Fluxes::two_point, differentiate_tpfa) {}
};

const RegisterComponent<Tpfa, TpfaOptions> registration("matrix_flow/tpfa");
const RegisterFluxDiscretization discretization("tpfa", discretize_tpfa);

}  // namespace
}  // namespace sprekk::matrix_flow
