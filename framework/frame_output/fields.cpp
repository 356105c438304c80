// fields: everything for ParaView.
#include "framework/frame_output/registry.hpp"
#include "framework/output/field_series.hpp"

namespace sprekk {

namespace {

class Fields : public FrameOutput {
 public:
  Fields(const OutputPlace& place, PointData points)
      : points_(points),
        files_(place.continued_from ? FieldSeries::continued(place.folder, *place.continued_from)
                                    : FieldSeries(place.folder)) {}
  void write(const Frame& frame) override {
    files_.write(frame.time, frame.step, frame.mesh, frame.fields, frame.lines, points_);
  }

 private:
  PointData points_;
  FieldSeries files_;
};

struct FieldsOptions {
  bool fields = true, point_data = false;
  void declare(Spec& output, const std::string& name) {
    output.flag(name, fields, {.doc = "Whether fields are written for ParaView."});
    output.flag("point_data", point_data,
                {.doc = "Whether fields of cells are written at points, too, as filters for contours, streamlines and "
                        "warped pictures need them: exact where they are linear, with a value for each side of a "
                        "fracture."});
    output.check([this](const Node& node) {
      if (point_data && !fields)
        throw InputError(node.origin, "'point_data' has no effect", "no fields are written", "remove 'fields: false'");
    });
  }
  bool is_chosen() const { return fields; }
  std::unique_ptr<FrameOutput> build(const OutputPlace& place) const {
    return std::make_unique<Fields>(place, point_data ? PointData::of_cells_too : PointData::only_fields_on_nodes);
  }
};

const RegisterFrameOutput<FieldsOptions> registration("fields");

}  // namespace

}  // namespace sprekk
