#include "components/matrix_flow/rt0/tip_terms.hpp"

namespace sprekk::matrix_flow {

TipTerms::TipTerms(const Mesh&, const std::vector<Tensor>&, const std::vector<FlowCondition>&,
                   const std::vector<FluxMass>&) {}

const TipTerm* TipTerms::of(int) const { return nullptr; }

}  // namespace sprekk::matrix_flow
