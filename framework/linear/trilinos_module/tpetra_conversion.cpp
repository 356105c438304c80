#include "framework/linear/trilinos_module/tpetra_conversion.hpp"

#include <Tpetra_Details_makeColMap.hpp>
#include <Tpetra_Import_Util2.hpp>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

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
  // Tpetra's own way, insertGlobalValues and fillComplete, takes five times as long.
  std::vector<int> place(rows.cols(), -1);
  const int entries = static_cast<int>(rows.nonZeros());
  for (int k = 0; k < entries; ++k) place[rows.innerIndexPtr()[k]] = 0;
  const std::size_t used = std::count(place.begin(), place.end(), 0);
  Kokkos::View<Id*, Map::node_type::memory_space> columns("columns", used);
  for (int column = 0, k = 0; column < rows.cols(); ++column)
    if (place[column] == 0) columns[k++] = column;
  Teuchos::RCP<const Map> column_map;
  if (Tpetra::Details::makeColMap(column_map, domain_map, columns) != 0)
    throw std::logic_error("columns of a matrix that no process has");
  for (std::size_t k = 0; k < used; ++k) place[column_map->getGlobalElement(static_cast<int>(k))] = static_cast<int>(k);

  const Teuchos::ArrayRCP<std::size_t> starts(rows.rows() + 1);
  const Teuchos::ArrayRCP<int> places(entries);
  const Teuchos::ArrayRCP<double> values(entries);
  std::copy_n(rows.outerIndexPtr(), rows.rows() + 1, starts.begin());
  for (int k = 0; k < entries; ++k) places[k] = place[rows.innerIndexPtr()[k]];
  std::copy_n(rows.valuePtr(), entries, values.begin());
  Tpetra::Import_Util::sortCrsEntries(starts(), places(), values());
  const auto matrix = Teuchos::rcp(new Matrix(row_map, column_map, starts, places, values));
  matrix->expertStaticFillComplete(domain_map, row_map);
  return matrix;
}

}  // namespace sprekk::tpetra
