// matrix_flow/mpfa: flow in the matrix with the multi-point flux approximation.
#include <fmt/format.h>

#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/matrix_flow/mpfa/uncorrected_tips.hpp"
#include "framework/mesh/planar.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct MpfaOptions : Options {
  Spec spec() {
    return Options::spec("matrix_flow/mpfa",
                         "Flow in the matrix (the paper's Eq. 6): multi-point flux approximation, exact for linear "
                         "pressures on any mesh.");
  }
};

class Mpfa : public MatrixFlow {
 public:
  Mpfa(const ComponentContext& context, const MpfaOptions& options) : MatrixFlow(context, options, discretize_mpfa) {}

  void note_input(Notes& notes) const override {
    MatrixFlow::note_input(notes);
    if (!is_permeable()) return;
    const UncorrectedEnds found = uncorrected_tips(mesh(), mobility());
    if (found.uncorrected == 0) return;
    notes.add(name() + ": tips without their singular flow",
              fmt::format("'{}' takes the pressure for linear around {} of {} tips of fractures, the first at {} ({}): "
                          "the resistance to flow from or around a fracture comes out too small or too large, by some "
                          "6, 3 and 1.5 % with 5, 10 and 20 cells on it; use a smaller mesh.fracture_size",
                          name(), found.uncorrected, found.ends, to_text(found.first), found.reason),
              found.uncorrected);
  }
};

const RegisterComponent<Mpfa, MpfaOptions> registration("matrix_flow/mpfa");

}  // namespace
}  // namespace sprekk::matrix_flow
