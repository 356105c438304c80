#include "framework/linear/trilinos_module/tpetra_conversion.hpp"

#include <cstdlib>

namespace sprekk::tpetra {

void start() {
  static const bool started = [] {
    if (!Tpetra::isInitialized()) {
      // Tpetra::initialize needs arguments, and keeps pointers to them.
      static char name[] = "sprekk";
      static char* arguments[] = {name, nullptr};
      static char** argument_vector = arguments;
      static int argument_count = 1;
      Tpetra::initialize(&argument_count, &argument_vector);
      // This handler is registered after the one that finalizes MPI, so it runs before it.
      std::atexit([] { Tpetra::finalize(); });
    }
    return true;
  }();
  (void)started;
}

Teuchos::RCP<const Map> make_map(const std::vector<int>& ids, int count) {
  start();
  const std::vector<Id> wide(ids.begin(), ids.end());
  return Teuchos::rcp(new Map(static_cast<Tpetra::global_size_t>(count),
                              Teuchos::ArrayView<const Id>(wide.data(), wide.size()), 0, Tpetra::getDefaultComm()));
}

Teuchos::RCP<Matrix> make_matrix(const SparseMatrix& rows, const Teuchos::RCP<const Map>& row_map,
                                 const Teuchos::RCP<const Map>& domain_map) {
  std::vector<std::size_t> lengths(rows.rows());
  for (int row = 0; row < rows.rows(); ++row) lengths[row] = rows.outerIndexPtr()[row + 1] - rows.outerIndexPtr()[row];
  const auto matrix =
      Teuchos::rcp(new Matrix(row_map, Teuchos::ArrayView<const std::size_t>(lengths.data(), lengths.size())));
  std::vector<Id> columns;
  for (int row = 0; row < rows.rows(); ++row) {
    const int begin = rows.outerIndexPtr()[row], end = rows.outerIndexPtr()[row + 1];
    if (begin == end) continue;
    columns.assign(rows.innerIndexPtr() + begin, rows.innerIndexPtr() + end);
    matrix->insertGlobalValues(row_map->getGlobalElement(row), end - begin, rows.valuePtr() + begin, columns.data());
  }
  matrix->fillComplete(domain_map, row_map);
  return matrix;
}

}  // namespace sprekk::tpetra
