// The response of waiting unknowns, which stabilizes a split.
#pragma once

#include <memory>
#include <vector>

#include "framework/assembly/block_system.hpp"
#include "framework/assembly/follows_waiting.hpp"
#include "framework/assembly/part.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// A term of a solve inside an iteration: residual(row) += matrix · (value − value at the solve's start) of column.
struct ResponseTerm {
  const Field *row, *column;
  SparseMatrix matrix;  ///< the rows that this process owns
};

/// With w the unknowns that wait while a solve finds c and r, and W, R their equations: w is held, although it follows
/// c by dw = −(dW/dw)^-1 dW/dc dc. The term of the equation R is (dR/dw) dw. Its derivatives are those of the present
/// iterate. Without it a pass answers an error of c by one that may be any multiple of it, where R or c alone hardly
/// resists; with it a pass is a step of Newton's method for c. At convergence dc = 0, so the term changes no answer.
class WaitingResponse {
 public:
  /// `waiting`: the unknowns of the iteration that the solve does not solve for.
  WaitingResponse(const Mesh& mesh, std::vector<const Field*> waiting, std::vector<Part*> parts,
                  std::vector<Following> pairs, const LinearOptions& linear);

  /// The terms at the present values of the fields; none for what has no response, or where waiting unknowns are not
  /// determined. Terms are kept as long as the derivatives hardly change. Collective.
  const std::vector<ResponseTerm>& update(const StepTime& step);
  LinearCounts counts() const;

 private:
  bool has_changed(const LinearSystem& system);
  ResponseTerm respond(const Following& pair, const StepTime& step);

  const Mesh& mesh_;
  std::vector<const Field*> waiting_;
  std::vector<Part*> parts_;
  std::vector<Following> pairs_;
  BlockSystem system_;
  std::unique_ptr<LinearSolver> linear_;
  Products products_;
  Vector known_;  ///< entries of the matrix that the terms were found with
  double known_dt_ = 0;
  std::vector<ResponseTerm> terms_;
};

}  // namespace sprekk
