// Conversion of our vectors and matrices to Tpetra's. Only the sources of this folder include this header.
#pragma once

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <vector>

#include "framework/types.hpp"

namespace sprekk::tpetra {

using Map = Tpetra::Map<>;
using Matrix = Tpetra::CrsMatrix<double>;
using MultiVector = Tpetra::MultiVector<double>;
using VectorOf = Tpetra::Vector<double>;
using Operator = Tpetra::Operator<double>;
using Id = Map::global_ordinal_type;

/// Starts Tpetra once, and ends it at exit. MPI must run.
void start();
/// The entries that this process holds of `count` in all.
Teuchos::RCP<const Map> make_map(const std::vector<int>& ids, int count);
/// This process's rows, with global columns.
Teuchos::RCP<Matrix> make_matrix(const SparseMatrix& rows, const Teuchos::RCP<const Map>& row_map,
                                 const Teuchos::RCP<const Map>& domain_map);

inline Eigen::Map<const Vector> view(const MultiVector& v, int column = 0) {
  return {v.getData(column).getRawPtr(), static_cast<Eigen::Index>(v.getLocalLength())};
}
inline void copy(const Vector& from, MultiVector& to, int column = 0) {
  const Teuchos::ArrayRCP<double> data = to.getDataNonConst(column);
  std::copy(from.data(), from.data() + from.size(), data.getRawPtr());
}

}  // namespace sprekk::tpetra
