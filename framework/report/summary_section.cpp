#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/output/note_record.hpp"
#include "framework/output/progress.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/report/html.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {
namespace {

using nlohmann::json;

json part(const json& whole, const char* key) { return whole.contains(key) ? whole[key] : json::object(); }

std::string joined(const json& texts) {
  std::string result;
  for (const json& text : texts)
    if (text.is_string()) result += (result.empty() ? "" : ", ") + text.get<std::string>();
  return result;
}

std::string exit_text(const json& exit) {
  const int code = exit.value("code", -1);
  const std::string reason = exit.value("reason", "");
  const char* const badge = code == 0 ? "good" : code == -1 ? "open" : "bad";
  const std::string text = code == -1 ? "still running, or ended without a word" : reason;
  return fmt::format("<p><span class=\"badge {}\">{}</span>{}</p>\n", badge, escaped_markup(text),
                     code > 0 ? " exit code " + std::to_string(code) : "");
}

std::string mesh_at_the_end(const RunResults& results, long changes) {
  const std::string text = fmt::format("{} change{}", changes, changes == 1 ? "" : "s");
  if (results.written.empty()) return text;
  const RunResults::Written& last = results.written.back();
  return fmt::format("{} cells, {} fracture cells, ", last.matrix.cell_count(), last.fractures.cell_count()) + text;
}

std::string facts(const RunResults& results, const json& record) {
  const json scene = part(record, "scene"), program = part(record, "program"), host = part(record, "host"),
             counters = part(record, "counters");
  const std::vector<double> times = results.history.numbers("time[s]");
  const bool has_ended =
      part(record, "exit").value("code", -1) != -1;  // the record of a run that is not over has no totals yet
  std::vector<std::vector<std::string>> rows = {{"scene", joined(part(scene, "files"))},
                                                {"folder", results.folder.string()}};
  if (has_ended) rows.push_back({"wall time", duration_text(record.value("seconds", 0.0))});
  rows.push_back({"mesh at the start", fmt::format("{} cells, {} fracture cells", counters.value("mesh: cells", 0L),
                                                   counters.value("mesh: fracture cells", 0L))});
  const long changes = counters.value("changes of the mesh", 0L);
  if (changes > 0) rows.push_back({"mesh at the end", mesh_at_the_end(results, changes)});
  rows.push_back({"unknowns at the start", std::to_string(counters.value("unknowns", 0L))});
  rows.push_back(
      {"steps", has_ended ? fmt::format("{} accepted, {} rejected, {} iterations", counters.value("steps accepted", 0L),
                                        counters.value("steps rejected", 0L), counters.value("iterations", 0L))
                          : fmt::format("{} accepted", times.size())});
  if (!times.empty()) rows.push_back({"simulated until", display_text(times.back(), "s")});
  std::string libraries;
  const json versions = part(program, "libraries");
  for (const auto& [name, version] : versions.items())
    libraries += (libraries.empty() ? "" : ", ") + name + " " + (version.is_string() ? version.get<std::string>() : "");
  rows.push_back({"program", "sprekk " + program.value("version", "") + " " + program.value("git_commit", "") + ", " +
                                 program.value("compiler", "") + ", " + program.value("build_type", "")});
  rows.push_back({"libraries", libraries});
  rows.push_back({"BLAS", program.value("blas", "")});
  rows.push_back({"host", fmt::format("{}, {} cores, {} process(es)", host.value("processor", ""),
                                      host.value("cores", 0), host.value("processes", 1))});
  return html_table(rows, 9, false);
}

std::string figures(const json& results) {
  std::vector<std::vector<std::string>> rows = {{"quantity", "last value", "in SI units"}};
  for (const auto& [name, value] : results.items()) {
    if (!value.is_number()) continue;
    const ColumnName column = column_name(name);
    rows.push_back(
        {column.quantity, display_text(value, column.unit),
         fmt::format("{:.8g}", value.get<double>()) + (column.unit.empty() ? "" : " " + pretty_unit(column.unit))});
  }
  return rows.size() == 1 ? "" : "<h3>Result figures</h3>\n" + html_table(rows);
}

std::string noted(const json& notes) {
  std::string text;
  for (const json& note : notes) {
    if (!note.is_object()) continue;
    const NoteRecord read{note.value("topic", ""), note.value("text", ""), note.value("first_time", 0.0),
                          note.value("last_time", 0.0), note.value("steps", 0L)};
    text += "<p class=\"warning\">" + escaped_markup(described(read)) + "</p>\n";
  }
  return text;
}

}  // namespace

std::string summary_section(const RunResults& results) {
  const json record = json::parse(results.record);
  std::string text = exit_text(part(record, "exit"));
  text += noted(part(record, "notes"));
  for (const std::string& problem : results.problems)
    text += "<p class=\"warning\">" + escaped_markup(problem) + "</p>\n";
  return html_section("summary", "Summary",
                      text + "<div class=\"columns\">\n<div>" + facts(results, record) + "</div>\n<div>" +
                          figures(part(record, "results")) + "</div>\n</div>\n");
}

std::string parameter_section(const RunResults& results) {
  const json record = json::parse(results.record);
  std::vector<std::vector<std::string>> rows = {{"parameter", "value", "origin"}};
  const json parameters = part(part(record, "scene"), "parameters");
  for (const auto& [path, parameter] : parameters.items())
    rows.push_back({path, parameter.value("value", ""), parameter.value("origin", "")});
  if (rows.size() == 1) return "";
  return html_section("parameters", "Parameters",
                      fmt::format("<details><summary>{} parameters with their origins</summary>\n", rows.size() - 1) +
                          html_table(rows, 9) + "</details>\n");
}

}  // namespace sprekk
