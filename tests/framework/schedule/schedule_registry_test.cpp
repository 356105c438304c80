// Kinds of schedule steps that register themselves.
#include "framework/schedule/schedule_registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> told;  ///< by the steps that have run

struct TellOptions {
  double number = 0;
  Spec spec() {
    Spec spec("tell", "Tells a number.");
    spec.quantity("tell", number, {.doc = "The number.", .required = true});
    return spec;
  }
};

class Tell : public ScheduleStep {
 public:
  explicit Tell(double number) : number_(number) {}
  StepStatus run(const StepTime&) override {
    told.push_back(number_);
    StepStatus status;
    status.converged = true;
    return status;
  }
  std::vector<const Field*> unknowns() const override { return {}; }
  int systems_in_turn(const StepTime&) const override { return 0; }
  std::string describe() const override { return "tell"; }
  void add_counts(LinearCounts&) const override {}

 private:
  double number_;
};

ScheduleBuilder read_tell(const Node& node, const ScheduleReading& reading) {
  TellOptions options;
  options.spec().read(node, reading.read);
  return [options](const ScheduleContext&) { return std::make_unique<Tell>(options.number); };
}

const ScheduleKind tell = {"tell", read_tell, [] {
                             static TellOptions options;
                             return options.spec();
                           }};
const RegisterScheduleStep registration(tell);

TEST(ScheduleRegistry, AStepThatHasRegisteredItselfRunsAmongOthers) {
  const ScheduleBuilder build =
      read_schedule(parse_yaml("[{tell: 3}, {tell: 1}, {when: t > 5, steps: [{tell: 4}]}]", "scene.yaml"), {});
  Geometry geometry;
  geometry.box.high = Point(1, 1);
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {1, 1};
  const Mesh mesh = generate_mesh(geometry, options);
  FieldStore fields;
  const auto schedule = build({.mesh = mesh, .fields = fields, .parts = {}, .log = {}});
  told.clear();
  EXPECT_TRUE(schedule->run({0, 1, 1}).converged);
  EXPECT_THAT(told, ElementsAre(3, 1));
  EXPECT_TRUE(schedule->run({9, 1, 10}).converged);
  EXPECT_THAT(told, ElementsAre(3, 1, 3, 1, 4));
}

TEST(ScheduleRegistry, ItsKeyIsKnownToMessagesAndItsOptionsAreChecked) {
  EXPECT_THAT(input_error_of([] { read_schedule(parse_yaml("[{tel: 3}]", "scene.yaml"), {}); }), HasSubstr("tell"));
  EXPECT_THAT(input_error_of([] { read_schedule(parse_yaml("[{tell: 3, louder: 1}]", "scene.yaml"), {}); }),
              HasSubstr("louder"));
}

TEST(ScheduleRegistry, AKeyThatExistsIsRefused) {
  const std::size_t before = schedule_kinds().size();
  for (const char* key : {"tell", "solve"})
    EXPECT_THROW(RegisterScheduleStep({key, read_tell, tell.spec}), std::logic_error) << key;
  EXPECT_EQ(schedule_kinds().size(), before);
}

}  // namespace
}  // namespace sprekk
