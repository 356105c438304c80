#include "framework/schemes/atlas_tables.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/schemes/factor_curves.hpp"

namespace sprekk {

namespace {

using Json = nlohmann::ordered_json;

std::string factor_text(const std::optional<double>& factor) { return factor ? fmt::format("{:.3g}", *factor) : "–"; }

Json number_or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

Json json_of(const SchemeResult& result) {
  return {{"name", result.run},
          {"groups", result.scheme.groups},
          {"order", result.scheme.is_monolithic() ? "monolithic"
                    : result.scheme.is_jacobi     ? "jacobi"
                                                  : "gauss_seidel"},
          {"stabilization", result.scheme.all_stabilizations()},
          {"acceleration", result.scheme.acceleration},
          {"converged", result.is_done},
          {"reason", result.reason},
          {"passes", result.passes},
          {"processor", result.processor},
          {"measured", number_or_null(result.measured)},
          {"predicted", number_or_null(result.predicted)},
          {"difference", number_or_null(result.difference)}};
}

/// The smallest factor of a map, and for which values; null where there is none, or all are alike.
Json json_of(const AtlasMap& map, SchemeResult::Factor factor) {
  const std::optional<Optimum> best = optimum(map, factor);
  return best ? Json{{"factor", best->factor}, {"at", map.values_at(best->place)}} : Json(nullptr);
}

std::string csv_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(const std::optional<double>& number) { return number ? fmt::format("{:.6g}", *number) : ""; }

void add_csv(const SchemeResult& result, const std::vector<std::string>& values, std::string& text) {
  std::string at;
  for (const std::string& value : values) at += (at.empty() ? "" : "; ") + value;
  text += fmt::format("{},{},{},{},{},{},{},{},{:.6g},{},{},{},{}\n", csv_quoted(result.run),
                      csv_quoted(result.scheme.split()), result.scheme.is_jacobi ? "jacobi" : "gauss_seidel",
                      csv_quoted(result.scheme.all_stabilizations()), csv_quoted(result.scheme.acceleration),
                      csv_quoted(at), result.is_done ? 1 : 0, result.total_passes(), result.processor,
                      csv_number(result.measured), csv_number(result.predicted), csv_number(result.difference),
                      csv_quoted(result.reason));
}

}  // namespace

const SchemeResult* cheapest(const std::vector<SchemeResult>& results, bool split) {
  const SchemeResult* best = nullptr;
  for (const SchemeResult& result : results)
    if (result.is_done && !(split && result.scheme.is_monolithic()) && (!best || result.processor < best->processor))
      best = &result;
  return best;
}

std::vector<std::vector<std::string>> result_rows(const std::vector<SchemeResult>& results) {
  std::vector<std::vector<std::string>> rows = {
      {"scheme", "acceleration", "passes", "factor of a pass", "predicted", "processor", "difference", ""}};
  for (const SchemeResult& result : results) {
    std::string passes;
    for (const int count : result.passes) passes += (passes.empty() ? "" : " ") + std::to_string(count);
    std::string ending = result.is_done ? "" : "does not converge";
    if (&result == cheapest(results, false))
      ending = "cheapest";
    else if (&result == cheapest(results, true))
      ending = "cheapest split";
    rows.push_back({result.scheme.split(), result.scheme.acceleration.empty() ? "–" : result.scheme.acceleration,
                    passes.empty() ? "–" : passes, factor_text(result.measured), factor_text(result.predicted),
                    fmt::format("{:.3g} s", result.processor),
                    result.difference ? fmt::format("{:.1g}", *result.difference) : "–", ending});
  }
  return rows;
}

std::string atlas_csv(const std::vector<SchemeResult>& results, const std::vector<AtlasMap>& maps) {
  std::string text =
      "name,split,order,stabilization,acceleration,at,converged,passes,processor[s],measured,predicted,difference,"
      "reason\n";
  for (const SchemeResult& result : results) add_csv(result, {}, text);
  for (const AtlasMap& map : maps)
    for (std::size_t k = 0; k < map.results.size(); ++k) add_csv(map.results[k], map.values_at(k), text);
  return text;
}

std::string atlas_json(const std::vector<SchemeResult>& results, const std::vector<AtlasMap>& maps) {
  Json whole = {{"schemes", Json::array()}, {"maps", Json::array()}};
  for (const SchemeResult& result : results) whole["schemes"].push_back(json_of(result));
  for (const AtlasMap& map : maps) {
    Json its = {{"scheme", map.scheme}, {"axes", Json::array()}, {"results", Json::array()}};
    for (const auto& [path, values] : map.axes) its["axes"].push_back({{"path", path}, {"values", values}});
    for (const SchemeResult& result : map.results) its["results"].push_back(json_of(result));
    its["smallest_measured"] = json_of(map, &SchemeResult::measured);
    its["smallest_predicted"] = json_of(map, &SchemeResult::predicted);
    whole["maps"].push_back(its);
  }
  return whole.dump(2) + "\n";
}

}  // namespace sprekk
