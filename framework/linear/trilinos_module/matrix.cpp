#include "framework/linear/trilinos_module/matrix.hpp"

#include "framework/linear/trilinos_module/tpetra_conversion.hpp"

namespace sprekk {
namespace {

class TpetraMatrix final : public DistributedMatrix {
 public:
  TpetraMatrix(const SparseMatrix& rows, const std::vector<int>& row_ids, const std::vector<int>& column_ids,
               int row_count) {
    const auto row_map = tpetra::make_map(row_ids, row_count);
    const auto column_map = tpetra::make_map(column_ids, static_cast<int>(rows.cols()));
    matrix_ = tpetra::make_matrix(rows, row_map, column_map);
  }

  void subtract_product(const Vector& x, Vector& y) const override {
    tpetra::VectorOf operand(matrix_->getDomainMap(), false);
    tpetra::VectorOf product(matrix_->getRangeMap(), false);
    tpetra::copy(x, operand);
    matrix_->apply(operand, product);
    y -= tpetra::view(product);
  }

 private:
  Teuchos::RCP<tpetra::Matrix> matrix_;
};

}  // namespace

std::unique_ptr<DistributedMatrix> make_distributed_matrix(const SparseMatrix& rows, const std::vector<int>& row_ids,
                                                           const std::vector<int>& column_ids, int row_count) {
  return std::make_unique<TpetraMatrix>(rows, row_ids, column_ids, row_count);
}

}  // namespace sprekk
