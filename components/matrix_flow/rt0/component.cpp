// matrix_flow/rt0: flow in the matrix with mixed-hybrid finite elements of lowest order.
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/rt0/rt0.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct Rt0Options : Options {
  Spec spec() {
    return Options::spec("matrix_flow/rt0",
                         "Flow in the matrix (the paper's Eq. 6): mixed-hybrid finite elements of lowest order, exact "
                         "for linear pressures on any mesh; the pressures of faces are unknowns, too.");
  }
};

class Rt0 : public MatrixFlow {
 public:
  Rt0(const ComponentContext& context, const Rt0Options& options)
      : MatrixFlow(context, options, discretize_rt0, Unknowns::on_cells_and_faces) {}
};

const RegisterComponent<Rt0, Rt0Options> registration("matrix_flow/rt0");

}  // namespace
}  // namespace sprekk::matrix_flow
