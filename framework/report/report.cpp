#include "framework/report/report.hpp"

#include <nlohmann/json.hpp>

#include "framework/output/atomic_file.hpp"
#include "framework/report/html.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {
namespace {

const SectionTitles sections = {{"summary", "Summary"},
                                {"history", "Against time"},
                                {"tips", "By tip, side and other place"},
                                {"events", "Events"},
                                {"maps", "Fields"},
                                {"fractures", "Along the fractures"},
                                {"convergence", "Convergence"},
                                {"effort", "Time and effort"},
                                {"parameters", "Parameters"}};

}  // namespace

std::string report_page(const RunResults& results) {
  const auto record = nlohmann::json::parse(results.record);
  const std::string name = record.value("/scene/name"_json_pointer, std::string("run"));
  const std::string body = summary_section(results) + history_section(results) + tip_section(results) +
                           events_section(results) + map_section(results) + fracture_section(results) +
                           convergence_section(results) + effort_section(results) + parameter_section(results);
  return html_page(name, sections, body);
}

std::filesystem::path write_report(const std::filesystem::path& folder) {
  const RunResults results = read_results(folder);
  const std::filesystem::path file = folder / "report.html";
  write_atomically(file, report_page(results));
  return file;
}

}  // namespace sprekk
