// The divergence: signed sums over the faces of each cell.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Row c·components + k of the result is the sum over the faces f of cell c of ± row f·components + k of `faces`; plus
/// where c is face_cells[f][0], out of which the face's values point. Rows of cells that are owned by another rank than
/// `rank` stay empty.
SparseMatrix cell_sums(const Mesh& mesh, const SparseMatrix& faces, int components, int rank);
Vector cell_sums(const Mesh& mesh, const Vector& faces, int components);

/// The rows of `matrix` that `keep` marks; the others are empty.
SparseMatrix keep_rows(const SparseMatrix& matrix, const std::vector<char>& keep);

}  // namespace sprekk
