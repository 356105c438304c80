#include "components/matrix_flow/mpfa/tips.hpp"

namespace sprekk::matrix_flow {

Tips::Tips(const MpfaLimits&, const Mesh& mesh, const std::vector<Tensor>&, const std::vector<FlowCondition>&,
           const std::vector<char>&)
    : mesh_(mesh) {}

const Adjacency& Tips::cells_of_nodes() const { return mesh_.node_cells; }
void Tips::assign(int, const InteractionRegion&, const LocalFluxes& local) { local_ = &local; }
const double* Tips::flux(int subface) { return local_->flux(subface); }
const double* Tips::pressure(int subface) { return local_->pressure(subface); }

}  // namespace sprekk::matrix_flow
