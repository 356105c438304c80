// matrix_flow/mpfa: flow in the matrix with this flux approximation.
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct MpfaOptions : Options {
  Spec spec() {
    return Options::spec(
        "matrix_flow/mpfa",
        "Flow in the matrix (Eq. 6): multi-point flux approximation, exact for linear pressures on any mesh.");
  }
};

class Mpfa : public MatrixFlow {
 public:
  Mpfa(const ComponentContext& context, const MpfaOptions& options) : MatrixFlow(context, options, discretize_mpfa) {}
};

const RegisterComponent<Mpfa, MpfaOptions> registration("matrix_flow/mpfa");

}  // namespace
}  // namespace sprekk::matrix_flow
