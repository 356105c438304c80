// matrix_flow/ntpfa: flow in the matrix with this flux approximation.
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/ntpfa/ntpfa.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct NtpfaOptions : Options {
  Spec spec() {
    return Options::spec("matrix_flow/ntpfa",
                         "Flow in the matrix (the paper's Eq. 6): nonlinear finite volumes, exact for linear pressures "
                         "and without overshoots, at any anisotropy; each solve takes several factorizations.");
  }
};

class Ntpfa : public MatrixFlow {
 public:
  Ntpfa(const ComponentContext& context, const NtpfaOptions& options)
      : MatrixFlow(context, options, discretize_ntpfa, Unknowns::on_cells, Fluxes::limited) {}
};

const RegisterComponent<Ntpfa, NtpfaOptions> registration("matrix_flow/ntpfa");

}  // namespace
}  // namespace sprekk::matrix_flow
