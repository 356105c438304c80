// Errors from runs on three levels of each parameter, by Richardson's extrapolation with observed orders.
//
// A value Q depends on parameters (mesh size, time step …) by Q = Q0 + sum over i of c_i x_i^p_i, and by mixed terms.
// With three levels x, x/2, x/4 of one parameter, p = log2 of the ratio of both differences (Richardson 1911; Roache,
// J. Fluids Eng. 116 (1994) 405). The levels here are 2, 1, 1/2 times the middle one.
#pragma once

#include <vector>

namespace sprekk {

/// The error that a value owes to one parameter.
struct ParameterError {
  double error = 0;                ///< of the fine level
  double correction = 0;           ///< what extrapolation adds to the value of the fine level; 0 if not regular
  double order = 0;                ///< observed, within 1/2 and 2; 1 where it is not regular
  bool is_regular = true;          ///< false where the differences do not shrink, or change their sign
  bool is_zero = false;            ///< the value does not depend on the parameter except for round-off
  double at(double factor) const;  ///< the error at this factor of the middle level
};

/// From the values on the levels 2, 1 and 1/2. `scale`: a size of the value, by which round-off is recognized.
ParameterError parameter_error(double coarse, double middle, double fine, double scale);

/// The error of a value that depends on several parameters.
struct ValueError {
  double value = 0;         ///< with all parameters on the fine level
  double extrapolated = 0;  ///< the value with what regular errors add
  double mixed = 0;         ///< the mixed term of all parameters at the fine level
  std::vector<ParameterError> parameters;

  /// The error that is stated for these factors of all parameters.
  double stated(const std::vector<double>& factors) const;
  /// The share of a parameter in the error of the value.
  double share(std::size_t parameter) const;
};

/// `coarse`, `fine`: values with one parameter on that level and all others on the middle one. `middle`, `all_fine`:
/// all on that level.
ValueError value_error(const std::vector<double>& coarse, const std::vector<double>& fine, double middle,
                       double all_fine);

}  // namespace sprekk
