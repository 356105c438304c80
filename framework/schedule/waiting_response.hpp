// The response of waiting unknowns, which stabilizes a split.
#pragma once

#include <map>
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

/// What a solve inside an iteration knows of the answers of unknowns that wait, in the units of its equations.
struct Responses {
  std::vector<ResponseTerm> terms;
  /// residual(row) += values, the rows that this process owns: what waits has equations that do not hold at the solve's
  /// start, and will change to fulfil them whatever the solve finds.
  std::map<const Field*, Vector> pending;
};

/// Which fields of a solve get the response: pairs of row and column.
struct ResponseOptions {
  std::vector<Following> pairs;
  bool has_pending = false;  ///< whether residuals of what waits count as well
  double settled = 0;        ///< nothing is pending where these residuals are smaller against their own terms
};

/// With w the unknowns that wait while a solve finds c and r, and W, R their equations: w is held, although it follows
/// c by dw = −(dW/dw)^-1 dW/dc dc. The term of the equation R is (dR/dw) dw. Its derivatives are those of the present
/// iterate. Without it a pass answers an error of c by one that may be any multiple of it, where R or c alone hardly
/// resists; with it a pass is a step of Newton's method for c. At convergence dc = 0, so the term changes no answer.
/// Where more than two systems are solved in turn, W is not zero at the start of a solve: the unknowns that wait will
/// also change by −(dW/dw)^-1 W, which is what is pending. It vanishes with convergence as well.
class WaitingResponse {
 public:
  /// `waiting`: the unknowns of the iteration that the solve does not solve for.
  WaitingResponse(const Mesh& mesh, std::vector<const Field*> waiting, std::vector<Part*> parts,
                  ResponseOptions options, const LinearOptions& linear);

  /// The terms at the present values of the fields; none for what has no response, or where waiting unknowns are not
  /// determined. Terms are kept as long as the derivatives hardly change. Collective.
  const Responses& update(const StepTime& step);
  /// Whether the waiting unknowns were determined when it was last looked, so that there is a response.
  bool is_determined() const { return is_determined_; }
  LinearCounts counts() const;

 private:
  bool has_changed(const LinearSystem& system);
  /// The derivatives of all equations at hand; the waiting unknowns come first.
  std::unique_ptr<Assembly> assemble_with_solved(const StepTime& step);
  /// d row / d waiting, for each row field.
  std::map<const Field*, SparseMatrix> answering(const Assembly& assembly) const;
  /// d waiting / d column, transposed: a row for each value of the column field.
  SparseMatrix driving(const Assembly& assembly, const Field& column) const;
  void respond(const Assembly& assembly, const std::map<const Field*, SparseMatrix>& answers);
  int place_in_all(const Field& field) const;

  const Mesh& mesh_;
  std::vector<const Field*> waiting_;
  std::vector<Part*> parts_;
  ResponseOptions options_;
  std::vector<const Field*> all_;  ///< the waiting fields, then rows and columns of pairs
  BlockSystem system_;
  std::unique_ptr<LinearSolver> linear_;
  Products products_;
  Vector known_;  ///< entries of the matrix that the terms were found with
  double known_dt_ = 0;
  bool is_determined_ = false;
  Responses responses_;
};

}  // namespace sprekk
