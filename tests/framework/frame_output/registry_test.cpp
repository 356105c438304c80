// Outputs that register themselves.
#include "framework/frame_output/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/output/vtu_writer.hpp"
#include "framework/scene/scene.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::vector<double> told;  ///< times of frames

class Tell : public FrameOutput {
 public:
  explicit Tell(double shift) : shift_(shift) {}
  void write(const Frame& frame) override { told.push_back(frame.time + shift_); }

 private:
  double shift_;
};

struct TellOptions {
  double shift = 0;
  Spec spec() {
    Spec spec("tell", "Tells the time.");
    spec.quantity("shift", shift, {.unit = "s", .doc = "Added to it.", .required = true});
    return spec;
  }
  std::unique_ptr<FrameOutput> build(const OutputPlace&) const { return std::make_unique<Tell>(shift); }
};

const RegisterFrameOutput<TellOptions> registration("tell");

std::vector<std::string> chosen(const std::string& yaml) {
  OutputOptions options;
  options.spec().read(parse_yaml(yaml, "scene.yaml"), {});
  std::vector<std::string> names;
  for (const FrameOutputChoice& output : options.chosen_outputs()) names.push_back(output.name);
  return names;
}

TEST(FrameOutputRegistry, AnOutputIsWrittenIfTheSceneNamesIt) {
  EXPECT_THAT(chosen("{}"), testing::ElementsAre("fields"));
  EXPECT_THAT(chosen("{fields: false}"), testing::IsEmpty());
  EXPECT_THAT(chosen("{tell: {shift: 2 s}}"), testing::ElementsAre("fields", "tell"));
  EXPECT_THAT(chosen("{fields: false, lines: {a: {of: b.c, from: [0 m, 0 m], to: [1 m, 0 m]}}}"),
              testing::ElementsAre("lines"));
}

TEST(FrameOutputRegistry, AnOutputIsBuiltFromItsParameters) {
  OutputOptions options;
  options.spec().read(parse_yaml("{fields: false, tell: {shift: 2 min}}", "scene.yaml"), {});
  const std::vector<FrameOutputChoice> outputs = options.chosen_outputs();
  ASSERT_EQ(outputs.size(), 1U);
  const Mesh mesh;
  told.clear();
  outputs[0].build({})->write({3, 1, mesh, {}, {}});
  EXPECT_THAT(told, testing::ElementsAre(123));
}

TEST(FrameOutputRegistry, ItsKeyAndItsParametersAreChecked) {
  EXPECT_THAT(input_error_of([] { chosen("{tel: {shift: 2 s}}"); }), HasSubstr("tell"));
  EXPECT_THAT(input_error_of([] { chosen("{tell: {shift: 2 m}}"); }), HasSubstr("shift"));
  EXPECT_THAT(input_error_of([] { chosen("{tell: {}}"); }), HasSubstr("shift"));
}

TEST(FrameOutputRegistry, ANameThatExistsIsRefused) {
  const std::size_t before = FrameOutputRegistry::instance().types().size();
  for (const char* name : {"tell", "fields"})
    EXPECT_THROW(RegisterFrameOutput<TellOptions>{name}, std::logic_error) << name;
  EXPECT_EQ(FrameOutputRegistry::instance().types().size(), before);
}

}  // namespace
}  // namespace sprekk
