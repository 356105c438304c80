// Values that need no curve: a sentence names them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sprekk {

/// The largest absolute value of each unit, of values that are finite.
class SizesOfUnits {
 public:
  void add(const std::string& unit, const std::vector<double>& values);
  /// Whether values are so far below others of their unit that they may be round-off. Never without a unit, nor if all
  /// are zero.
  bool are_far_below(const std::string& unit, const std::vector<double>& values) const;

 private:
  std::map<std::string, double> largest_;
};

/// The largest absolute value that is finite; 0 without any.
double largest_size(const std::vector<double>& values);

/// Collects what is not drawn.
class QuietValues {
 public:
  /// `sizes`: of all values beside which these stand.
  explicit QuietValues(SizesOfUnits sizes) : sizes_(std::move(sizes)) {}
  /// Takes values in time that need no curve, since they do not change, or are far below others; told() names them.
  /// Returns whether it has.
  bool take(const std::string& name, const std::string& unit, const std::vector<double>& values);
  /// HTML paragraphs; "" where all is drawn.
  std::string told() const;

 private:
  SizesOfUnits sizes_;
  std::vector<std::string> constant_, far_below_;
};

}  // namespace sprekk
