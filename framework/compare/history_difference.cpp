#include "framework/compare/history_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "framework/compare/scale.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Whether a column describes the time steps, not results.
bool tells_of_steps(const std::string& column) {
  return column == "time[s]" || column == "step[s]" || column == "iterations[1]";
}

bool nearly_same(double time, double other) {
  return std::abs(time - other) <= rounding::same * std::max(std::abs(time), std::abs(other));
}

/// A column against time.
class TimeCurve {
 public:
  TimeCurve(const std::vector<double>& times, std::vector<double> values) : times_(times), values_(std::move(values)) {}

  bool has_row_at(double time) const {
    const std::size_t next = row_from(time);
    return next < times_.size() && nearly_same(times_[next], time);
  }
  /// NaN where a row beside it has no value.
  double at(double time) const {
    const std::size_t next = row_from(time);
    if (next == times_.size()) return std::numeric_limits<double>::quiet_NaN();
    if (next == 0 || nearly_same(times_[next], time)) return values_[next];
    const double share = (time - times_[next - 1]) / (times_[next] - times_[next - 1]);
    return values_[next - 1] + share * (values_[next] - values_[next - 1]);
  }
  ValueRange range(const CommonTime& common) const {
    ValueRange range;
    for (std::size_t i = 0; i < times_.size(); ++i)
      if (times_[i] >= common.first && times_[i] <= common.last) range.add(values_[i]);
    range.add(at(common.first));
    range.add(at(common.last));
    return range;
  }

 private:
  /// The first row that is not before `time`.
  std::size_t row_from(double time) const {
    const double tolerated = time - rounding::same * std::abs(time);
    return static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), tolerated) - times_.begin());
  }

  const std::vector<double>& times_;
  std::vector<double> values_;
};

bool has_numbers(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// The rows of both within the common time.
std::vector<double> rows_within(const CommonTime& common, const std::vector<double>& one,
                                const std::vector<double>& other) {
  std::vector<double> times;
  for (const std::vector<double>* all : {&one, &other})
    for (const double time : *all)
      if (time >= common.first && time <= common.last) times.push_back(time);
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

CommonTime common_time(const CsvTable& one, const CsvTable& other) {
  const std::vector<double> times = one.numbers("time[s]"), others = other.numbers("time[s]");
  if (times.empty() || others.empty()) return {1, 0};
  return {std::max(times.front(), others.front()), std::min(times.back(), others.back())};
}

std::vector<HistoryDifference> history_differences(const CsvTable& one, const CsvTable& other) {
  const CommonTime common = common_time(one, other);
  std::vector<HistoryDifference> differences;
  if (common.first > common.last) return differences;
  const std::vector<double> times = one.numbers("time[s]"), others = other.numbers("time[s]");
  const std::vector<double> all_times = rows_within(common, times, others);
  std::vector<ValueRange> ranges;
  std::map<std::string, double> widest;  // of a family
  for (const std::string& column : one.columns()) {
    const int there = other.find(column);
    if (tells_of_steps(column) || there < 0) continue;
    const std::vector<double> values = one.numbers(one.find(column)), other_values = other.numbers(there);
    if (!has_numbers(values) && !has_numbers(other_values)) continue;
    const TimeCurve curve(times, values), other_curve(others, other_values);
    ValueRange range = curve.range(common);
    range.add(other_curve.range(common));
    ranges.push_back(range);
    widest[scale_family(column)] = std::max(widest[scale_family(column)], range.width());
    HistoryDifference difference{column, 0, common.first, 0};
    for (const double time : all_times) {
      const double value = curve.at(time), other_value = other_curve.at(time);
      double apart = std::abs(value - other_value);
      const bool is_missing_once = std::isfinite(value) != std::isfinite(other_value);
      if (is_missing_once && curve.has_row_at(time) && other_curve.has_row_at(time))
        apart = std::numeric_limits<double>::infinity();
      if (!(apart > difference.largest)) continue;
      difference.largest = apart;
      difference.time = time;
    }
    differences.push_back(difference);
  }
  for (std::size_t i = 0; i < differences.size(); ++i)
    differences[i].scale = scale_of(widest[scale_family(differences[i].column)], ranges[i].size());
  return differences;
}

}  // namespace sprekk
