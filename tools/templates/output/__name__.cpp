// __type__: an output of a run. A start for one of your own: here the smallest and the largest value of a field, as a
// table __name__.csv with a row for each time of output.
#include <algorithm>
#include <memory>

#include "framework/frame_output/registry.hpp"
#include "framework/output/table_writer.hpp"

namespace __name__ {

using namespace sprekk;

/// The field of this name; nullptr where there is none.
const OutputField* find(const Frame& frame, const std::string& name) {
  for (const OutputField& field : frame.fields)
    if (field.name == name) return &field;
  return nullptr;
}

/// Writes one row a frame. It lives on the first process only, which has all values.
class __Class__ : public FrameOutput {
 public:
  __Class__(std::string of, const OutputPlace& place)
      : of_(std::move(of)),
        // A run that goes on continues its table.
        table_(place.continued_from ? TableWriter::continued(place.folder / "__name__.csv", *place.continued_from)
                                    : TableWriter(place.folder / "__name__.csv")) {}
  void write(const Frame& frame) override {
    const OutputField& field = *find(frame, of_);
    table_.append(frame.time, {{"smallest[" + field.unit + "]", field.values.minCoeff()},
                               {"largest[" + field.unit + "]", field.values.maxCoeff()}});
  }

 private:
  std::string of_;
  TableWriter table_;
};

/// The parameters: what a scene writes under `output: {__type__: {…}}`.
struct Options {
  std::string of;
  Spec spec() {
    Spec spec("__type__", "The smallest and the largest value of a field, in a table.");
    spec.text("of", of, {.doc = "The field.", .required = true});
    return spec;
  }
  /// Before the run: what cannot be written is refused.
  void check(const Frame& start) const {
    if (!find(start, of))
      throw InputError({"output.__type__"}, "there is no field '" + of + "'", "", "write one of those of the scene");
  }
  std::unique_ptr<FrameOutput> build(const OutputPlace& place) const { return std::make_unique<__Class__>(of, place); }
};

const RegisterFrameOutput<Options> registration("__type__");

}  // namespace __name__
