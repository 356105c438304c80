// fields: everything, or what is chosen, for ParaView.
#include <algorithm>

#include "framework/config/input_error.hpp"
#include "framework/frame_output/registry.hpp"
#include "framework/output/field_series.hpp"

namespace sprekk {

namespace {

/// Whether a field is meant by its name, or by that of its part, "rock.*".
bool means(const std::string& chosen, const std::string& field) {
  return chosen == field || (chosen.ends_with(".*") && field.starts_with(chosen.substr(0, chosen.size() - 1)));
}

class Fields : public FrameOutput {
 public:
  Fields(const OutputPlace& place, std::vector<std::string> only, PointData points)
      : only_(std::move(only)),
        points_(points),
        files_(place.continued_from ? FieldSeries::continued(place.folder, *place.continued_from)
                                    : FieldSeries(place.folder)) {}
  void write(const Frame& frame) override {
    if (only_.empty()) {
      files_.write(frame.time, frame.step, frame.mesh, frame.fields, frame.lines, points_);
      return;
    }
    std::vector<OutputField> chosen;
    for (const OutputField& field : frame.fields)
      if (std::ranges::any_of(only_, [&](const std::string& name) { return means(name, field.name); }))
        chosen.push_back(field);
    files_.write(frame.time, frame.step, frame.mesh, chosen, frame.lines, points_);
  }

 private:
  std::vector<std::string> only_;
  PointData points_;
  FieldSeries files_;
};

struct FieldsOptions {
  bool fields = true, point_data = false;
  std::vector<std::string> only;
  Origin only_origin;
  void declare(Spec& output, const std::string& name) {
    output.flag(name, fields, {.doc = "Whether fields are written for ParaView."});
    output.flag("point_data", point_data,
                {.doc = "Whether fields of cells are written at points, too, as filters for contours, streamlines and "
                        "warped pictures need them: exact where they are linear, with a value for each side of a "
                        "fracture."});
    output.texts("only", only,
                 {.doc = "The fields that are written, by name, or all of a part, PART.*; by "
                         "default all."});
    output.check([this](const Node& node) {
      if (const Node* const given = node.find("only")) only_origin = given->origin;
      for (const auto& [key, is_given] : {std::pair("point_data", point_data), {"only", !only.empty()}})
        if (is_given && !fields)
          throw InputError(node.origin, "'" + std::string(key) + "' has no effect", "no fields are written",
                           "remove 'fields: false'");
    });
  }
  bool has_nothing_to_check() const { return only.empty(); }
  void check(const Frame& start) const {
    for (const std::string& name : only) {
      std::vector<std::string> known;
      for (const OutputField& field : start.fields) known.push_back(field.name);
      if (std::ranges::none_of(known, [&](const std::string& field) { return means(name, field); }))
        throw unknown_name(only_origin, "field", name, known);
    }
  }
  bool is_chosen() const { return fields; }
  std::unique_ptr<FrameOutput> build(const OutputPlace& place) const {
    return std::make_unique<Fields>(place, only,
                                    point_data ? PointData::of_cells_too : PointData::only_fields_on_nodes);
  }
};

const RegisterFrameOutput<FieldsOptions> registration("fields");

}  // namespace

}  // namespace sprekk
