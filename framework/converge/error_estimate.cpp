#include "framework/converge/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr double fine_level = 0.5;  // of the middle one: halving is usual for Richardson's extrapolation
constexpr double least_order = 0.5, most_order = 2;  // that are trusted: methods here are of second order at most
constexpr double safety = 1.5;                       // factor on an extrapolation with an observed order
constexpr double cancelled = 0.25;                   // share of the errors that counts where they cancel one another

}  // namespace

double ParameterError::at(double factor) const { return error * std::pow(factor / fine_level, order); }

ParameterError parameter_error(double coarse, double middle, double fine, double scale) {
  ParameterError found;
  const double first = middle - coarse, second = fine - middle;
  if (std::max(std::abs(first), std::abs(second)) <= rounding::same * scale) {
    found.is_zero = true;
    found.order = 1;
    return found;
  }
  const double observed = second == 0 ? std::numeric_limits<double>::infinity() : std::log2(first / second);
  found.is_regular = observed >= least_order;  // NaN where the sign changes
  found.order = found.is_regular ? std::min(observed, most_order) : 1;
  const double ratio = std::pow(2, found.order);  // of the errors of two levels
  if (found.is_regular) {
    found.correction = found.error = second / (ratio - 1);
    // Beyond the highest order the last difference is small by chance: the first one says how large the error may be.
    if (observed > most_order) found.error = first / (ratio * (ratio - 1));
  } else {
    double error = std::max(std::abs(first), std::abs(second));
    if (first * second > 0) {
      // The value still changes in one direction. An observed order below least_order is chance: an order of one is
      // assumed, with the safety factor of an observed one.
      error = safety * std::abs(second);
    } else if (std::abs(second) < std::abs(first)) {
      // The sizes shrink with an order of two at most, as above: a smaller last one is chance.
      error = std::max(std::abs(second), std::abs(first) / std::pow(2, most_order));
    }
    found.error = std::copysign(error, second);
  }
  return found;
}

double ValueError::stated(const std::vector<double>& factors) const {
  double sum = 0, sizes = 0, irregular = 0, common = std::abs(mixed);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double error = parameters[i].at(factors[i]);
    (parameters[i].is_regular ? sum : irregular) += parameters[i].is_regular ? error : std::abs(error);
    if (parameters[i].is_regular) sizes += std::abs(error);
    if (!parameters[i].is_zero) common *= std::pow(factors[i] / fine_level, parameters[i].order);
  }
  return safety * std::abs(sum) + cancelled * (sizes - std::abs(sum)) + irregular + common;
}

double ValueError::share(std::size_t parameter) const {
  double all = 0;
  for (const ParameterError& one : parameters) all += std::abs(one.error);
  return all > 0 ? std::abs(parameters[parameter].error) / all : 0;
}

ValueError value_error(const std::vector<double>& coarse, const std::vector<double>& fine, double middle,
                       double all_fine) {
  ValueError found;
  found.value = found.extrapolated = all_fine;
  const double scale = std::max(std::abs(middle), std::abs(all_fine));
  double apart = all_fine - middle, growth = 1;
  int acting = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const ParameterError one = parameter_error(coarse[i], middle, fine[i], scale);
    found.extrapolated += one.correction;
    apart -= fine[i] - middle;
    if (!one.is_zero) {
      growth *= std::pow(2, one.order) - 1;
      ++acting;
    }
    found.parameters.push_back(one);
  }
  if (acting > 1) found.mixed = apart / growth;
  return found;
}

}  // namespace sprekk
