// The stabilization of a solve by balances that keep their amounts while their fields wait.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/schedule/waiting_response.hpp"

namespace sprekk {

/// A field p waits while a solve finds c; its balance stores s p + b c in each cell, besides exchanges between cells.
/// With this amount held, p would change by dp = −b dc/s. So each equation R of the solve that contains p gets the term
/// −(dR/dp)(b/s) dc, local in c, which vanishes with convergence. s has the row sums of the derivatives of the balances
/// by p, without exchanges (Operator::leaving): the storage and outflow of each cell for a uniform change of p.
class HeldAmounts {
 public:
  /// `held`: the fields p; `solved`: those of the solve.
  HeldAmounts(const Mesh& mesh, std::vector<const Field*> held, std::vector<const Field*> solved,
              std::vector<Part*> parts);
  /// The terms at the present values of the fields, with products of matrices that are kept while these stay.
  /// Collective.
  const std::vector<ResponseTerm>& update(const StepTime& step);

 private:
  /// The factors of one product (dR/dp)(b/s), as they were when it was made.
  struct Factors {
    SparseMatrix by_held, following;
  };
  std::vector<const Field*> held_, solved_, all_;  ///< all: the solved ones, then the held ones
  std::vector<Part*> parts_;
  BlockSystem system_;  ///< rows of all fields, and which process owns them
  Products products_;
  std::vector<Factors> factors_;
  std::vector<ResponseTerm> terms_;
};

}  // namespace sprekk
