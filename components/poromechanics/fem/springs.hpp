// Springs on sides of the rock.
#pragma once

#include <Eigen/Core>
#include <map>

#include "components/poromechanics/fem/raw_displacement.hpp"
#include "components/poromechanics/options.hpp"

namespace sprekk::poromechanics {

/// The stiffness of the springs on the outer faces of cells, N/m per m (N/m in space), by cell; rows and columns as
/// those of CellStiffness::of_unknowns. A spring gives the side the traction
///   −k_n (u·n) n − k_t (u − (u·n) n) .
using Springs = std::map<int, Eigen::MatrixXd>;
Springs springs_of_cells(const Options& options, const RawDisplacement& raw);

}  // namespace sprekk::poromechanics
