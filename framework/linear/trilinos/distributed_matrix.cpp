#include "framework/linear/trilinos/distributed_matrix.hpp"

#include "framework/linear/trilinos/tpetra_conversion.hpp"

namespace sprekk {

struct DistributedMatrix::Data {
  Teuchos::RCP<tpetra::Matrix> matrix;
};

DistributedMatrix::DistributedMatrix(const SparseMatrix& rows, const std::vector<int>& row_ids,
                                     const std::vector<int>& column_ids, int row_count)
    : data_(std::make_unique<Data>()) {
  const auto row_map = tpetra::make_map(row_ids, row_count);
  const auto column_map = tpetra::make_map(column_ids, static_cast<int>(rows.cols()));
  data_->matrix = tpetra::make_matrix(rows, row_map, column_map);
}

DistributedMatrix::~DistributedMatrix() = default;
DistributedMatrix::DistributedMatrix(DistributedMatrix&&) noexcept = default;
DistributedMatrix& DistributedMatrix::operator=(DistributedMatrix&&) noexcept = default;

void DistributedMatrix::subtract_product(const Vector& x, Vector& y) const {
  tpetra::VectorOf operand(data_->matrix->getDomainMap(), false);
  tpetra::VectorOf product(data_->matrix->getRangeMap(), false);
  tpetra::copy(x, operand);
  data_->matrix->apply(operand, product);
  y -= tpetra::view(product);
}

}  // namespace sprekk
