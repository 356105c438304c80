// When an iteration over the steps of a schedule has converged.
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// One condition of `until:`: a bound of the coupled residual, of that of one equation, or of the change of a field by
/// a pass.
struct CriterionOptions {
  std::optional<double> residual, relative;
  std::optional<std::string> change_of, residual_of, absolute;
  /// The bound of the residual of all equations or of one; empty for a condition on changes.
  std::optional<double> of_residual() const { return residual_of ? relative : residual; }
  Origin origin, field_origin, absolute_origin;
  Spec spec();
};

/// Parameters of `until:`.
struct UntilOptions {
  double relative = 1e-8;  ///< as Newton's `update`
  bool is_relative_given = false;
  int at_most = 60, at_least = 1;
  std::list<CriterionOptions> all, any;
  Spec spec();
  /// The smallest bound of the residual among the conditions; `relative` if there is none.
  double tightest() const;
  /// The largest bound of the residual with which an iteration may end; only where `bounds_residual`.
  double loosest() const;
  /// Whether each iteration ends with a bounded residual of all equations.
  bool bounds_residual() const;
  /// Throws InputError for conditions on a residual, which an iteration over substeps does not have.
  void require_changes() const;
};

/// The conditions of one iteration: all of `all`, and one of `any` where there are some.
class ConvergenceCriteria {
 public:
  /// `fields`: those that are solved inside. Throws InputError for others, and for amounts that are not positive or in
  /// another unit than the field's.
  ConvergenceCriteria(const UntilOptions& options, const std::vector<Field*>& fields);
  /// Whether the iteration has converged after a pass. `residual_holds`: whether the coupled residual is below a bound.
  /// `residuals`: of each equation, over its largest term. `before`: the values of all fields before the pass.
  /// Conditions on changes never hold in the first pass, after which nothing is known of how changes fall.
  bool hold(int pass, const std::function<bool(double)>& residual_holds,
            const std::vector<std::pair<std::string, double>>& residuals, const std::vector<Vector>& before) const;
  bool need_changes() const { return need_changes_; }

 private:
  struct Criterion {
    double bound = 0;
    const Field* field = nullptr;  ///< nullptr for the residual
    std::size_t place = 0;         ///< of the field
    bool is_relative = true;
    bool is_residual = false;  ///< of the field's equation
  };
  static std::vector<Criterion> made(const std::list<CriterionOptions>& options, const std::vector<Field*>& fields);
  static bool holds(const Criterion& criterion, int pass, const std::function<bool(double)>& residual_holds,
                    const std::vector<std::pair<std::string, double>>& residuals, const std::vector<Vector>& before);

  int at_least_;
  bool need_changes_ = false;
  std::vector<Criterion> all_, any_;
};

}  // namespace sprekk
