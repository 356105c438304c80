// matrix_flow/tpfa: flow in the matrix with this flux approximation.
#include "components/capabilities/state_of_cells.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct TpfaOptions : Options {
  Spec spec() {
    Spec spec = Options::spec("matrix_flow/tpfa",
                              "Flow in the matrix (the paper's Eq. 6): two-point flux approximation, monotone; "
                              "consistent on orthogonal meshes only.");
    may_be_formula(spec.name(), "permeability", rock_variables());
    may_be_formula(spec.name(), "porosity", rock_variables());
    return spec;
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
