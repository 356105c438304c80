#include "framework/study/figure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/config/units.hpp"
#include "framework/no_value.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

Origin origin_of(const Node& map, const std::string& key) {
  const Node* value = map.find(key);
  return value ? value->origin : map.origin;
}

double value_at(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const double tolerance = times.empty() ? 0 : rounding::same * std::abs(times.back());
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::abs(times[i] - time) <= tolerance) return values[i];
    if (times[i] > time)
      return i == 0 ? no_value
                    : values[i - 1] + (values[i] - values[i - 1]) * (time - times[i - 1]) / (times[i] - times[i - 1]);
  }
  return no_value;
}

/// Cells may be empty: between two known values the history is linear in time, whatever lies between them.
double first_time_of(const std::vector<double>& times, const std::vector<double>& values, double level) {
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (values[i] == level) return times[i];
    if (before && (values[*before] < level) != (values[i] < level))
      return times[*before] + (times[i] - times[*before]) * (level - values[*before]) / (values[i] - values[*before]);
    before = i;
  }
  return no_value;
}

/// The integral over the steps whose value is known; none when there are no such steps.
double integral(const std::vector<double>& steps, const std::vector<double>& values) {
  double sum = no_value;
  for (std::size_t i = 0; i < values.size() && i < steps.size(); ++i)
    if (!std::isnan(values[i])) sum = (std::isnan(sum) ? 0 : sum) + steps[i] * values[i];
  return sum;
}

double mean(const std::vector<double>& steps, const std::vector<double>& values) {
  std::vector<double> known;
  for (const double value : values) known.push_back(std::isnan(value) ? no_value : 1.0);
  return integral(steps, values) / integral(steps, known);
}

double extreme(const std::vector<double>& values, const std::string& take) {
  const auto measure = [&](double value) {
    return take == "largest" ? value : take == "smallest" ? -value : std::abs(value);
  };
  double result = no_value;
  for (const double value : values)
    if (std::isfinite(value) && (std::isnan(result) || measure(value) > measure(result))) result = value;
  return result;
}

}  // namespace

Spec FigureOptions::spec() {
  Spec spec("figure", "One number of each run, from a column of its history.csv. Give one of at, reaches, take.");
  spec.text("of", of, {.doc = "The column; its unit may be left out.", .required = true});
  spec.text("at", at, {.doc = "'end', or a time: the value then, linear between steps."});
  spec.text("reaches", reaches,
            {.doc = "A value: the first time at which the column passes it, linear between steps."});
  spec.choice("take", take,
              {{"largest", "the largest value"},
               {"smallest", "the smallest value"},
               {"farthest_from_zero", "the value with the largest magnitude, with its sign"},
               {"mean", "the mean over time"},
               {"integral", "the integral over time"}},
              {.doc = "Which figure of all values."});
  spec.check([this](const Node& node) {
    of_origin = origin_of(node, "of");
    at_origin = origin_of(node, "at");
    reaches_origin = origin_of(node, "reaches");
    if (int(at.has_value()) + int(reaches.has_value()) + int(!take.empty()) != 1)
      throw InputError(origin, "the figure " + sprekk::quoted(name) + " is not defined",
                       "it needs one of 'at', 'reaches' and 'take'", "write for example {of: " + of + ", at: end}");
  });
  return spec;
}

std::string find_column(const ColumnNames& names, const std::string& wanted, const Origin& where) {
  ColumnNames allowed;
  for (const std::string& name : names) {
    const std::string quantity = column_name(name).quantity;
    if (wanted == name || wanted == quantity) return name;
    allowed.push_back(quantity);
  }
  throw unknown_name(where, "column of history.csv", wanted, allowed);
}

Figure::Figure(const FigureOptions& options, const ColumnNames& columns)
    : name_(options.name), column_(find_column(columns, options.of, options.of_origin)), take_(options.take) {
  unit_ = column_name(column_).unit;
  if (options.at && *options.at != "end") time_ = parse_quantity(*options.at, "s", options.at_origin, "at");
  if (options.reaches) {
    level_ = parse_quantity(*options.reaches, unit_, options.reaches_origin, "reaches");
    unit_ = "s";
  }
  if (take_ == "integral") unit_ += unit_.empty() ? "s" : "*s";
}

std::string Figure::heading() const { return labelled(name_, unit_); }

double Figure::of(const CsvTable& history) const {
  const std::vector<double> values = history.numbers(column_), times = history.numbers("time[s]");
  if (values.empty() || times.empty()) return no_value;
  if (level_) return first_time_of(times, values, *level_);
  if (time_) return value_at(times, values, *time_);
  if (take_.empty()) return values.back();
  const std::vector<double> steps = history.numbers("step[s]");
  if (take_ == "integral") return integral(steps, values);
  if (take_ == "mean") return mean(steps, values);
  return extreme(values, take_);
}

}  // namespace sprekk
