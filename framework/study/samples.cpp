#include "framework/study/samples.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "framework/study/sample_points.hpp"

namespace sprekk {
namespace {

/// A number with what stands behind it.
struct Amount {
  double number;
  std::string unit;
};

Amount amount(const std::string& text, const Origin& origin) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(number))
    throw InputError(origin, quoted(text) + " is no number", "values are drawn between numbers",
                     "write a number with its unit, '1e-17 m^2'");
  const std::string rest(end);
  const std::size_t first = rest.find_first_not_of(' ');
  return {number, first == std::string::npos ? "" : rest.substr(first)};
}

}  // namespace

Spec DistributionOptions::spec() {
  Spec spec("distribution", "An uncertain value of the scene: uniform between two bounds, or normal.");
  spec.text("from", from, {.doc = "The lower bound, with its unit."});
  spec.text("to", to, {.doc = "The upper bound."});
  spec.flag("log", log,
            {.doc = "The logarithm is uniform, or normal around that of the mean: `deviation` is then a "
                    "number, that of the natural logarithm."});
  spec.text("mean", mean, {.doc = "The mean of a normal distribution, with its unit."});
  spec.text("deviation", deviation, {.doc = "Its standard deviation."});
  spec.check([this](const Node& node) {
    origin = node.origin;
    if ((from && to) == (mean && deviation) || from.has_value() != to.has_value() ||
        mean.has_value() != deviation.has_value())
      throw InputError(origin, "the distribution is not known", "it has two bounds, or a mean and a deviation",
                       "write '{from: 0.4, to: 0.8}' or '{mean: 0.6, deviation: 0.1}'");
    value_at(0.5);
  });
  return spec;
}

std::string DistributionOptions::value_at(double share) const {
  const Amount first = amount(from ? *from : *mean, origin), second = amount(to ? *to : *deviation, origin);
  const bool is_factor = log && mean;
  if (first.unit != second.unit && !(is_factor && second.unit.empty()))
    throw InputError(origin, quoted(first.unit) + " and " + quoted(second.unit) + " are two units",
                     "values are drawn between numbers of one unit", "give both the same");
  if (from && first.number >= second.number)
    throw InputError(origin, "'from' is not below 'to'", "no value lies between them", "exchange them");
  if (mean && second.number <= 0)
    throw InputError(origin, "'deviation' is not positive", "all values would be the mean", "raise it");
  if (log && first.number <= 0)
    throw InputError(origin, "a logarithm is drawn of values that are not positive", "it has none",
                     "raise them, or remove 'log'");
  const double a = log ? std::log(first.number) : first.number;
  const double b = log && from ? std::log(second.number) : second.number;
  const double drawn = from ? a + share * (b - a) : a + b * normal_quantile(share);
  const std::string number = fmt::format("{:.12g}", log ? std::exp(drawn) : drawn);
  return first.unit.empty() ? number : number + " " + first.unit;
}

Spec SampleOptions::spec() {
  Spec spec("samples", "Runs with values that are drawn from distributions, and quantiles of what they give.");
  spec.integer("count", count, {.range = between(2, 10000), .doc = "How many.", .required = true});
  spec.choice("method", method,
              {{"sobol", "Sobol's sequence, shifted at random: the most even; best with a power of two"},
               {"latin_hypercube", "each value alone is spread evenly"},
               {"random", "independent"}},
              {.doc = "How values are drawn."});
  spec.integer("seed", seed, {.range = between(0, 1000000000), .doc = "Another one draws other values."});
  static DistributionOptions example;
  spec.named_sections("of", example.spec(),
                      [this](const std::string& key, const Origin& origin) {
                        of.emplace_back();
                        of.back().path = key;
                        of.back().origin = origin;
                        return of.back().spec();
                      },
                      {.doc = "The uncertain values, by path.", .required = true});
  spec.check([this](const Node& node) {
    if (of.empty())
      throw InputError(node.origin, "nothing is drawn", "'of' names no values",
                       "write 'of: {time.step: {from: 1 h, to: 2 h}}'");
    if (method == "sobol" && of.size() > static_cast<std::size_t>(most_sobol_dimensions))
      throw InputError(node.find("of")->origin,
                       "there are more than " + std::to_string(most_sobol_dimensions) + " values",
                       "Sobol's sequence is known here for so many", "write 'method: latin_hypercube'");
  });
  return spec;
}

std::vector<std::vector<std::string>> SampleOptions::draw() const {
  const int dimensions = static_cast<int>(of.size());
  const auto its_seed = static_cast<std::uint64_t>(seed);
  const SamplePoints points = method == "sobol"             ? sobol_points(count, dimensions, its_seed)
                              : method == "latin_hypercube" ? latin_hypercube(count, dimensions, its_seed)
                                                            : random_points(count, dimensions, its_seed);
  std::vector<std::vector<std::string>> samples;
  for (const std::vector<double>& point : points) {
    samples.emplace_back();
    auto share = point.begin();
    for (const DistributionOptions& distribution : of) samples.back().push_back(distribution.value_at(*share++));
  }
  return samples;
}

}  // namespace sprekk
