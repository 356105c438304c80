// A discretization of the flux in some of the cells, with a boundary around them.
#pragma once

#include <vector>

#include "components/matrix_flow/rediscretize.hpp"

namespace sprekk::matrix_flow {

/// The operators that `discretize` gives for the cells `inside` (one flag a cell) alone, independent of all other
/// cells. `separated` is the mesh cut along the faces between inside and outside (separated_mesh), `nodes` the nodes of
/// it that the process discretizes (none for all). Rows and columns are those of `flow.mesh`; those of other cells are
/// empty. The mobility of other cells is not used. No flux passes a face of the cut, unless it is `open` (one flag a
/// face, or none for none): then its boundary value is the flux out of `inside`, and it has traces.
FluxOperators discretize_inside(Discretize discretize, const FlowInputs& flow, const Mesh& separated,
                                const std::vector<char>& inside, const std::vector<char>& open,
                                const std::vector<char>& nodes);

}  // namespace sprekk::matrix_flow
