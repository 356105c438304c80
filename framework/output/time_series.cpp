#include "framework/output/time_series.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "framework/config/input_error.hpp"
#include "framework/output/atomic_file.hpp"
#include "framework/output/xml_escape.hpp"

namespace sprekk {
namespace {

/// The value of attribute `name` in an element that we wrote, false if it is not there.
bool attribute(const std::string& line, const std::string& name, std::string& value) {
  const std::string opening = " " + name + "=\"";
  const std::size_t begin = line.find(opening);
  if (begin == std::string::npos) return false;
  const std::size_t first = begin + opening.size();
  const std::size_t last = line.find('"', first);
  if (last == std::string::npos) return false;
  value = xml_unescaped(line.substr(first, last - first));
  return true;
}

}  // namespace

TimeSeries TimeSeries::continued(std::filesystem::path pvd, double time) {
  TimeSeries series(std::move(pvd));
  if (!std::filesystem::exists(series.pvd_)) return series;
  std::ifstream stream(series.pvd_);
  std::string line;
  bool is_whole = false;
  while (std::getline(stream, line)) {
    if (line.find("</VTKFile>") != std::string::npos) is_whole = true;
    std::string entry_time, file;
    if (!attribute(line, "timestep", entry_time) || !attribute(line, "file", file)) continue;
    const Entry entry{std::strtod(entry_time.c_str(), nullptr), file};
    if (entry.time <= time) series.entries_.push_back(entry);
  }
  if (!is_whole)
    throw InputError("cannot continue " + series.pvd_.string() +
                     " (it is not a complete .pvd file) move it away and restart again");
  return series;
}

void TimeSeries::add(double time, const std::string& file) {
  while (!entries_.empty() && entries_.back().time >= time) entries_.pop_back();
  entries_.push_back({time, file});
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const Entry& entry : entries_)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, xml_escaped(entry.file));
  text +=
      "  </Collection>\n"
      "</VTKFile>\n";
  write_atomically(pvd_, text);
}

}  // namespace sprekk
