#include "framework/linear/trilinos_module/gmres.hpp"

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <algorithm>

#include "framework/linear/trilinos_module/tpetra_conversion.hpp"

namespace sprekk {
namespace {

using Teuchos::RCP;
using Teuchos::rcp;

class Preconditioner final : public tpetra::Operator {
 public:
  Preconditioner(RCP<const tpetra::Map> map, std::function<void(const Vector&, Vector&)> precondition)
      : map_(std::move(map)), precondition_(std::move(precondition)) {}

  RCP<const tpetra::Map> getDomainMap() const override { return map_; }
  RCP<const tpetra::Map> getRangeMap() const override { return map_; }
  void apply(const tpetra::MultiVector& x, tpetra::MultiVector& y, Teuchos::ETransp, double, double) const override {
    Vector z;
    for (std::size_t column = 0; column < x.getNumVectors(); ++column) {
      precondition_(tpetra::view(x, static_cast<int>(column)), z);
      tpetra::copy(z, y, static_cast<int>(column));
    }
  }

 private:
  RCP<const tpetra::Map> map_;
  std::function<void(const Vector&, Vector&)> precondition_;
};

class BelosGmres final : public Gmres {
 public:
  BelosGmres(const SparseMatrix& rows, const std::vector<int>& ids,
             std::function<void(const Vector&, Vector&)> precondition, int basis)
      : map_(tpetra::make_map(ids, static_cast<int>(rows.cols()))),
        matrix_(tpetra::make_matrix(rows, map_, map_)),
        preconditioner_(rcp(new Preconditioner(map_, std::move(precondition)))),
        basis_(basis) {}

  Result solve(const Vector& b, double tolerance, int max_iterations) const override {
    const auto right_hand_side = rcp(new tpetra::VectorOf(map_));
    tpetra::copy(b, *right_hand_side);
    const auto x = rcp(new tpetra::VectorOf(map_));
    using Problem = Belos::LinearProblem<double, tpetra::MultiVector, tpetra::Operator>;
    const auto problem = rcp(new Problem(matrix_, x, right_hand_side));
    problem->setRightPrec(preconditioner_);
    problem->setProblem();
    const auto parameters = rcp(new Teuchos::ParameterList);
    parameters->set("Convergence Tolerance", tolerance);
    parameters->set("Maximum Iterations", max_iterations);
    parameters->set("Num Blocks", basis_);
    parameters->set("Maximum Restarts", max_iterations);
    parameters->set("Verbosity", static_cast<int>(Belos::Errors));
    Belos::BlockGmresSolMgr<double, tpetra::MultiVector, tpetra::Operator> gmres(problem, parameters);
    gmres.solve();
    return {tpetra::view(*x), gmres.getNumIters()};
  }

 private:
  RCP<const tpetra::Map> map_;
  RCP<tpetra::Matrix> matrix_;
  RCP<Preconditioner> preconditioner_;
  int basis_;
};

}  // namespace

std::unique_ptr<Gmres> make_gmres(const SparseMatrix& rows, const std::vector<int>& ids,
                                  std::function<void(const Vector&, Vector&)> precondition, int basis) {
  return std::make_unique<BelosGmres>(rows, ids, std::move(precondition), basis);
}

}  // namespace sprekk
