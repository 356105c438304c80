#include "framework/mesh/cell_sums.hpp"

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk {

SparseMatrix cell_sums(const Mesh& mesh, const SparseMatrix& faces, int components, int rank) {
  const int rows = mesh.cell_count() * components;
  SPREKK_EXPECT(faces.rows() == mesh.face_count() * components, faces.rows(), mesh.face_count(), components);
  SPREKK_EXPECT(is_well_formed(faces), faces.rows(), faces.cols());
  const int* outer = faces.outerIndexPtr();
  const int* inner = faces.innerIndexPtr();
  const double* values = faces.valuePtr();
  std::vector<int> result_outer{0}, result_inner;
  std::vector<double> result_values;
  result_outer.reserve(rows + 1);
  result_inner.reserve(faces.nonZeros());
  result_values.reserve(faces.nonZeros());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    for (int k = 0; k < components; ++k) {
      if (mesh.cell_rank[c] == rank) {
        // Merge of a few sorted rows.
        const int count = mesh.cell_faces[c].size();
        int at[6], end[6];  // a hexahedron has so many
        double sign[6];
        for (int j = 0; j < count; ++j) {
          const int face = mesh.cell_faces[c][j];
          at[j] = outer[face * components + k];
          end[j] = outer[face * components + k + 1];
          sign[j] = mesh.face_cells[face][0] == c ? 1.0 : -1.0;
        }
        for (;;) {
          int column = faces.cols();
          for (int j = 0; j < count; ++j)
            if (at[j] < end[j]) column = std::min(column, inner[at[j]]);
          if (column == faces.cols()) break;
          double sum = 0;
          for (int j = 0; j < count; ++j)
            if (at[j] < end[j] && inner[at[j]] == column) sum += sign[j] * values[at[j]++];
          result_inner.push_back(column);
          result_values.push_back(sum);
        }
      }
      result_outer.push_back(static_cast<int>(result_inner.size()));
    }
  }
  SparseMatrix result(rows, faces.cols());
  result.resizeNonZeros(result_inner.size());
  std::copy(result_outer.begin(), result_outer.end(), result.outerIndexPtr());
  std::copy(result_inner.begin(), result_inner.end(), result.innerIndexPtr());
  std::copy(result_values.begin(), result_values.end(), result.valuePtr());
  return result;
}

Vector cell_sums(const Mesh& mesh, const Vector& faces, int components) {
  SPREKK_EXPECT(faces.size() == mesh.face_count() * components, faces.size(), mesh.face_count(), components);
  Vector result = Vector::Zero(mesh.cell_count() * components);
  for (int k = 0; k < components; ++k) {
    const double* value = faces.data() + k;
    double* sums = result.data() + k;
    for (const auto& [from, to] : mesh.face_cells) {
      sums[from * components] += *value;
      if (to != none) sums[to * components] -= *value;
      value += components;
    }
  }
  return result;
}

SparseMatrix keep_rows(const SparseMatrix& matrix, const std::vector<char>& keep) {
  SPREKK_EXPECT(static_cast<Eigen::Index>(keep.size()) == matrix.rows(), keep.size(), matrix.rows());
  SparseMatrix kept(matrix.rows(), matrix.cols());
  kept.reserve(matrix.nonZeros());
  for (int r = 0; r < matrix.outerSize(); ++r) {
    kept.startVec(r);
    if (!keep[r]) continue;
    for (SparseMatrix::InnerIterator entry(matrix, r); entry; ++entry) kept.insertBack(r, entry.col()) = entry.value();
  }
  kept.finalize();
  return kept;
}

}  // namespace sprekk
