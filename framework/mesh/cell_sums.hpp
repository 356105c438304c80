// The divergence: signed sums over the faces of each cell.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Row c·components + k of the result is the sum over the faces f of cell c of ± row f·components + k of `faces`. The
/// sign is plus where c is face_cells[f][0]: values of a face point out of that cell. Rows of cells that another rank
/// than `rank` owns stay empty.
SparseMatrix cell_sums(const Mesh& mesh, const SparseMatrix& faces, int components, int rank);
Vector cell_sums(const Mesh& mesh, const Vector& faces, int components);  ///< the same of values, for all cells

/// The rows of `matrix` that `keep` marks; the others are empty.
SparseMatrix keep_rows(const SparseMatrix& matrix, const std::vector<char>& keep);

}  // namespace sprekk
