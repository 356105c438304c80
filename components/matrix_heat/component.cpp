// matrix_heat/tpfa and matrix_heat/mpfa: heat in the matrix with these approximations of the conducted flux.
#include "components/matrix_heat/matrix_heat.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_heat {
namespace {

struct TpfaOptions : Options {
  Spec spec() {
    return Options::spec("matrix_heat/tpfa",
                         "Heat in the matrix: two-point flux approximation, monotone; consistent on orthogonal meshes "
                         "only.");
  }
};

struct MpfaOptions : Options {
  Spec spec() {
    return Options::spec("matrix_heat/mpfa",
                         "Heat in the matrix: multi-point flux approximation, exact for linear temperatures on any "
                         "mesh.");
  }
};

/// With the two-point flux of the flow in the matrix.
class Tpfa : public MatrixHeat {
 public:
  Tpfa(const ComponentContext& context, const TpfaOptions& options)
      : MatrixHeat(context, options, flux_discretization("tpfa")) {}
};

/// With its multi-point flux.
class Mpfa : public MatrixHeat {
 public:
  Mpfa(const ComponentContext& context, const MpfaOptions& options)
      : MatrixHeat(context, options, flux_discretization("mpfa")) {}
};

const RegisterComponent<Tpfa, TpfaOptions> tpfa("matrix_heat/tpfa");
const RegisterComponent<Mpfa, MpfaOptions> mpfa("matrix_heat/mpfa");

}  // namespace
}  // namespace sprekk::matrix_heat
