// The Schur complement of the unknowns that a split holds; it stabilizes the split (`stabilize: response`).
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
/// With `least`, no value is smaller than that, and the term is at most −least.
struct ResponseTerm {
  const Field *row, *column;
  SparseMatrix matrix;  ///< the rows that this process owns
  Vector least = {};    ///< the least change of each value of the row, or empty
};

/// The terms that a solve inside an iteration gets from the unknowns that wait, in the units of its equations.
struct Responses {
  std::vector<ResponseTerm> terms;
  /// residual(row) += values, the rows that this process owns: where the equations of waiting unknowns do not hold at
  /// the solve's start, these unknowns will change to fulfil them whatever the solve finds.
  std::map<const Field*, Vector> pending;
};

/// Adds `responses` and their derivatives to the rows that `assembly` has. `start`: the values at the solve's start of
/// the fields that are columns of terms.
void add_responses(Assembly& assembly, const Responses& responses, const std::map<const Field*, Vector>& start);

/// For which fields of a solve the Schur complement is added: pairs of row and column.
struct ResponseOptions {
  std::vector<Following> pairs;
  bool is_named = true;      ///< by a part, which knows bounds of the changes; fluxes have no copies
  bool has_pending = false;  ///< whether residuals of waiting unknowns count as well
  double settled = 0;        ///< nothing is pending where these residuals are smaller against their own terms
};

/// The unknowns w wait (are held) while a solve finds c and r; W and R are their equations. By its own equation, w
/// would follow c by dw = −(dW/dw)^-1 dW/dc dc. So the equation R gets the term (dR/dw) dw: a Schur complement, with
/// the derivatives of the present iterate. Without the term a pass may multiply an error of c by any factor, where R or
/// c alone hardly resists; with the term a pass is a step of Newton's method for c. At convergence dc = 0, so the term
/// changes no answer. Where more than two systems are solved in turn, W is not zero at the start of a solve: the
/// waiting unknowns will change by −(dW/dw)^-1 W as well. This is the pending part, which vanishes with convergence,
/// too. It is left out where steps of the iteration take substeps: the equations W then hold over other steps than that
/// of the solve.
///
/// Some of w are fluxes q on interfaces, which enter balances R and follow from the potentials on either side. A change
/// dc of a potential has the round-off of c, and where dq/dc is large the flux would have more round-off than a balance
/// may miss. So the solve has unknowns q' for these, with the equation q' = q + (dq/dc) dc + pending. R contains q'
/// with all of its digits, and the q' that the solve finds is the new q.
class WaitingResponse {
 public:
  /// `waiting`: the unknowns of the iteration that the solve does not solve for.
  WaitingResponse(const Mesh& mesh, std::vector<const Field*> waiting, std::vector<Part*> parts,
                  ResponseOptions options, const LinearOptions& linear);

  /// Copies of waiting unknowns that the solve finds, too; they have pending terms only. The first call makes
  /// them, at the values of the fields then. Collective.
  const std::vector<std::unique_ptr<Field>>& copies(const StepTime& step);
  /// The waiting unknowns that copies() are copies of, in the same order.
  const std::vector<const Field*>& copied() const { return copied_; }
  /// The terms at the present values of the fields; none for what has no response, or where waiting unknowns are not
  /// determined. Terms are kept as long as the derivatives hardly change. Collective.
  const Responses& update(const StepTime& step);
  /// Whether the waiting unknowns were determined when it was last looked, so that there is a response.
  bool is_determined() const { return is_determined_; }
  LinearCounts counts() const;

 private:
  bool has_changed(const LinearSystem& system);
  /// Sets the bounds of the terms, at the present values of the fields.
  void set_bounds();
  /// The derivatives of all equations at hand; the waiting unknowns come first.
  std::unique_ptr<Assembly> assemble_with_solved(const StepTime& step);
  /// d row / d waiting, for each row field, without those that have copies.
  std::map<const Field*, SparseMatrix> answering(const Assembly& assembly) const;
  /// d row / d copied, a term for each row that has one.
  void add_copies(const Assembly& assembly);
  /// The place among the copies of a waiting unknown, or -1.
  int copy_of(int waiting) const;
  /// The sum of the rows of a quantity's balances among W, without exchanges.
  struct WaitingBalance {
    Vector of_waiting;                          ///< its derivative by all waiting unknowns
    std::map<const Field*, Vector> of_columns;  ///< by the columns of pairs
    double residual = 0;
    double of_copies = 0;  ///< the sum of the squares of its derivatives by copied unknowns
  };
  std::vector<WaitingBalance> balances(const Assembly& assembly) const;
  /// Changes the copied unknowns of a solution so that the sum of balances holds to all digits, as the rows alone do
  /// not where they exchange any multiple of what they store. `rest`: the part of the sum that does not depend on the
  /// solution.
  void hold(const WaitingBalance& balance, double rest, Vector& solution) const;
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
  bool has_looked_for_copies_ = false;
  std::vector<const Field*> copied_;
  std::vector<std::unique_ptr<Field>> copies_;
  Vector known_;  ///< entries of the matrix that the terms were found with
  double known_dt_ = 0;
  bool is_determined_ = false;
  Responses responses_;
};

}  // namespace sprekk
