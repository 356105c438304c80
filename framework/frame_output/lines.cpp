// lines: values of fields along straight lines, as tables.
#include <algorithm>
#include <map>

#include "framework/discretization/quadratic_fit.hpp"
#include "framework/field/component_names.hpp"
#include "framework/field/weights_in_cell.hpp"
#include "framework/frame_output/registry.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/output/table_writer.hpp"
#include "framework/output/vtu_writer.hpp"

namespace sprekk {

namespace {

struct LineOptions {
  Origin origin;
  std::string of;
  Point from = Point::Zero(), to = Point::Zero();
  int points = 101;
  Spec spec() {
    Spec spec("line", "Values of a field at equal distances along a straight line, in the table line_NAME.csv.");
    spec.text("of", of,
              {.doc = "A field in cells, on nodes or on faces, or what a part writes beside "
                      "its fields.",
               .required = true});
    spec.point("from", from, {.unit = "m", .doc = "The first point.", .required = true});
    spec.point("to", to, {.unit = "m", .doc = "The last point.", .required = true});
    spec.integer("points", points, {.range = between(2, 100000), .doc = "The number of points."});
    spec.check([this](const Node& node) {
      if ((to - from).norm() == 0)
        throw InputError(node.origin, "the line has no length", "'from' and 'to' are one point", "write a probe");
    });
    return spec;
  }
  Point point(int i) const { return from + (to - from) * (static_cast<double>(i) / (points - 1)); }
};

const OutputField* find(const Frame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.fields, name, &OutputField::name);
  return found == frame.fields.end() ? nullptr : &*found;
}

/// Entities and weights: the value of the field at x is the sum of weight · value. Empty outside of the mesh.
std::vector<std::pair<int, double>> weights_at(const Mesh& mesh, const PointLocation& cells, Location location,
                                               const Point& x) {
  const int home = cells.cell_at(x);
  if (home == none) return {};
  return location == Location::cell ? quadratic_fit(mesh, home, x) : weights_in_cell(mesh, location, home, x);
}

/// The table of one line: each time of output adds a row for each point.
class LineTable {
 public:
  LineTable(const std::string& name, const LineOptions& options, const OutputPlace& place)
      : options_(options), table_(open(place.folder / ("line_" + name + ".csv"), place)) {}

  void write(const Frame& frame) {
    const OutputField* const field = find(frame, options_.of);
    SPREKK_EXPECT(field, options_.of);
    const PointLocation cells(frame.mesh);
    for (int i = 0; i < options_.points; ++i) {
      const Point x = options_.point(i);
      TableWriter::Row row = {{"distance[m]", (x - options_.from).norm()}};
      for (int k = 0; k < dimension; ++k) row.emplace_back(component_names(dimension)[k] + "[m]", x[k]);
      const std::vector<std::string> names = component_names(field->components);
      const auto weights = weights_at(frame.mesh, cells, field->location, x);
      for (int k = 0; k < field->components; ++k) {
        double value = 0;
        for (const auto& [entity, weight] : weights) value += weight * field->values[entity * field->components + k];
        const std::string name = field->components == 1 ? field->name : field->name + "." + names[k];
        row.emplace_back(labelled(name, field->unit), value);
      }
      table_.append(frame.time, row);
    }
  }
  std::string loss() const { return table_.loss(); }

 private:
  static TableWriter open(const std::filesystem::path& file, const OutputPlace& place) {
    return place.continued_from ? TableWriter::continued(file, *place.continued_from) : TableWriter(file);
  }

  LineOptions options_;
  TableWriter table_;
};

class Lines : public FrameOutput {
 public:
  Lines(const std::map<std::string, LineOptions>& lines, const OutputPlace& place) {
    for (const auto& [name, options] : lines) tables_.emplace_back(name, options, place);
  }
  void write(const Frame& frame) override {
    for (LineTable& table : tables_) table.write(frame);
  }
  std::string loss() const override {
    for (const LineTable& table : tables_)
      if (const std::string loss = table.loss(); !loss.empty()) return loss;
    return "";
  }

 private:
  std::vector<LineTable> tables_;
};

void check_line(const LineOptions& line, const Frame& start) {
  const OutputField* const field = find(start, line.of);
  if (!field) {
    std::vector<std::string> names;
    for (const OutputField& other : start.fields) names.push_back(other.name);
    throw unknown_name(line.origin, "field", line.of, names);
  }
  if (!is_in_cells(field->location))
    throw InputError(line.origin, "the field " + line.of + " has no values along this line",
                     "it does not live in the " + medium_name(), "choose another field, or write a probe");
  const PointLocation cells(start.mesh);
  for (int i = 0; i < line.points; ++i)
    if (cells.cell_at(line.point(i)) == none)
      throw InputError(line.origin, "the line leaves the " + medium_name(),
                       "there is no cell at its point " + std::to_string(i + 1), "make it shorter");
}

struct LinesOptions {
  std::map<std::string, LineOptions> lines;
  void declare(Spec& output, const std::string& name) {
    static LineOptions example;
    output.named_sections(name, example.spec(),
                          [this](const std::string& key, const Origin& origin) {
                            for (const char letter : key)
                              if (letter == '/' || letter == '\\')
                                throw InputError(origin, "the name of a line has a '" + std::string(1, letter) + "'",
                                                 "its table is a file of this name", "choose another name");
                            constexpr std::size_t longest_name = 200;  // that of a file has at most 255 bytes
                            if (key.size() > longest_name)
                              throw InputError(origin, "the name of a line is too long",
                                               "its table is a file of this name", "choose a shorter name");
                            lines[key].origin = origin;
                            return lines[key].spec();
                          },
                          {.doc = "Tables of values along straight lines by name, at the times of output."});
  }
  bool is_chosen() const { return !lines.empty(); }
  void check(const Frame& start) const {
    for (const auto& [name, line] : lines) check_line(line, start);
  }
  std::unique_ptr<FrameOutput> build(const OutputPlace& place) const { return std::make_unique<Lines>(lines, place); }
};

const RegisterFrameOutput<LinesOptions> registration("lines");

}  // namespace

}  // namespace sprekk
