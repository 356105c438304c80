#include "framework/linear/trilinos_module/trilinos_module.hpp"

#include "framework/linear/trilinos_module/gmres.hpp"
#include "framework/linear/trilinos_module/matrix.hpp"
#include "framework/linear/trilinos_module/multigrid.hpp"
#include "framework/module/define_module.hpp"

namespace sprekk {
namespace {

class Module final : public TrilinosModule {
 public:
  std::unique_ptr<DistributedMatrix> matrix(const SparseMatrix& rows, const std::vector<int>& row_ids,
                                            const std::vector<int>& column_ids, int row_count) const override {
    return make_distributed_matrix(rows, row_ids, column_ids, row_count);
  }
  std::unique_ptr<Multigrid> multigrid(const SparseMatrix& rows, const std::vector<int>& ids,
                                       const UnknownBlock& block) const override {
    return make_multigrid(rows, ids, block);
  }
  std::unique_ptr<Gmres> gmres(const SparseMatrix& rows, const std::vector<int>& ids,
                               std::function<void(const Vector&, Vector&)> precondition, int basis) const override {
    return make_gmres(rows, ids, std::move(precondition), basis);
  }
};

}  // namespace
}  // namespace sprekk

SPREKK_DEFINE_MODULE(sprekk::TrilinosModule, sprekk::Module)
