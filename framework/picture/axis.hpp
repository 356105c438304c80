// The range of an axis and its ticks.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// A tick of an axis and its label.
struct Tick {
  double value;
  std::string text;
};

/// A range of numbers with ticks, linear or logarithmic.
class Axis {
 public:
  /// How numbers map to positions.
  enum class Scale { linear, logarithmic };

  /// An axis that holds all finite `values` (on a logarithmic one: all positive ones), with about `tick_count` ticks at
  /// round numbers. Equal values get a range around them.
  Axis(const std::vector<double>& values, Scale scale, int tick_count);
  /// A linear axis over a given range.
  Axis(double low, double high, int tick_count);

  double low() const { return low_; }
  double high() const { return high_; }
  const std::vector<Tick>& ticks() const { return ticks_; }
  /// The position of a value: 0 at the low end, 1 at the high end; NaN for values that a logarithmic axis cannot show.
  double fraction(double value) const;

 private:
  void make_linear_ticks(int count);
  void make_decades(int count);

  Scale scale_;
  double low_ = 0, high_ = 1;
  std::vector<Tick> ticks_;
};

}  // namespace sprekk
