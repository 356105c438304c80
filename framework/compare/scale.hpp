// What differences of a quantity are measured against.
#pragma once

#include <string>

namespace sprekk {

/// The lowest and the highest of some values.
class ValueRange {
 public:
  void add(double value);  ///< values that are not finite are left out
  void add(const ValueRange& other);
  double width() const { return high_ - low_; }
  double size() const;  ///< the largest absolute value

 private:
  double low_ = 0, high_ = 0;
  bool is_empty_ = true;
};

/// The scale for values with a range of this width: the width, or, where that is mere round-off of the values, their
/// size.
double scale_of(double width, double size);

/// What columns (or arrays) "quantity[unit]" have in common that are measured against one scale: the components of a
/// vector or tensor, both sides of a fracture, and the amounts of a balance with its error. The name itself for others.
std::string scale_family(const std::string& column);

/// A difference as a share of a scale; 0 for no difference, infinite where the scale is 0.
double relative(double difference, double scale);

}  // namespace sprekk
