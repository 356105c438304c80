#include "framework/report/report.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "framework/output/atomic_file.hpp"
#include "framework/output/build_info.hpp"
#include "framework/picture/line_plot.hpp"
#include "framework/report/page_files.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {
namespace {

/// Links to the sections that are not empty.
std::string navigation(const std::string& body) {
  static const std::array<std::pair<const char*, const char*>, 8> sections = {{{"summary", "Summary"},
                                                                               {"history", "Against time"},
                                                                               {"tips", "Tips"},
                                                                               {"maps", "Fields"},
                                                                               {"fractures", "Along the fractures"},
                                                                               {"convergence", "Convergence"},
                                                                               {"effort", "Time and effort"},
                                                                               {"parameters", "Parameters"}}};
  std::string links;
  for (const auto& [id, title] : sections)
    if (body.find(std::string("<section id=\"") + id + "\"") != std::string::npos)
      links += std::string("<a href=\"#") + id + "\">" + title + "</a>\n";
  return "<nav>\n" + links + "</nav>\n";
}

}  // namespace

std::string report_page(const RunResults& results) {
  const auto record = nlohmann::json::parse(results.record);
  const std::string name = escaped_markup(record.value("/scene/name"_json_pointer, std::string("run")));
  const std::string body = summary_section(results) + history_section(results) + tip_section(results) +
                           map_section(results) + fracture_section(results) + convergence_section(results) +
                           effort_section(results) + parameter_section(results);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         name + "</title>\n<style>\n" + page_style + "</style>\n</head>\n<body>\n<header>\n<h1>" + name + "</h1>\n" +
         navigation(body) + "</header>\n<main>\n" + body + "</main>\n<footer>Written by sprekk " +
         escaped_markup(build_info().version + " " + build_info().git_commit) + "</footer>\n<script>\n" + page_script +
         "</script>\n</body>\n</html>\n";
}

std::filesystem::path write_report(const std::filesystem::path& folder) {
  const RunResults results = read_results(folder);
  const std::filesystem::path file = folder / "report.html";
  write_atomically(file, report_page(results));
  return file;
}

}  // namespace sprekk
