// fields: everything for ParaView.
#include "framework/frame_output/registry.hpp"
#include "framework/output/field_output.hpp"

namespace sprekk {

namespace {

class Fields : public FrameOutput {
 public:
  explicit Fields(const OutputPlace& place)
      : files_(place.continued_from ? FieldOutput::continued(place.folder, *place.continued_from)
                                    : FieldOutput(place.folder)) {}
  void write(const Frame& frame) override {
    files_.write(frame.time, frame.step, frame.mesh, frame.fields, frame.lines);
  }

 private:
  FieldOutput files_;
};

struct FieldsOptions {
  bool fields = true;
  void declare(Spec& output, const std::string& name) {
    output.flag(name, fields, {.doc = "Whether fields are written for ParaView."});
  }
  bool is_chosen() const { return fields; }
  std::unique_ptr<FrameOutput> build(const OutputPlace& place) const { return std::make_unique<Fields>(place); }
};

const RegisterFrameOutput<FieldsOptions> registration("fields");

}  // namespace

}  // namespace sprekk
