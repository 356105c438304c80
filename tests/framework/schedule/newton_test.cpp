// Newton's method where full steps lead nowhere.
#include "framework/schedule/newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/mesh/generate_mesh.hpp"
#include "framework/mesh/partition.hpp"

namespace sprekk {
namespace {

/// atan x = 1/2 in every cell. From x = 10 full steps go to -88, then 1e4, …
class ArcTangent : public Part {
 public:
  explicit ArcTangent(const Field& x) : x_(x) {}
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime&) const override {
    const Eigen::ArrayXd x = x_.now().array();
    assembly.add(x_, x.atan().matrix());
    assembly.add(x_, Vector::Constant(x.size(), -0.5));
    assembly.diagonal(x_, x_, (1 / (1 + x * x)).matrix());
  }

 private:
  const Field& x_;
};

struct Equation {
  Equation() {
    Geometry geometry;
    geometry.box.high = Point(1, 1);
    MeshOptions options;
    options.kind = MeshOptions::Kind::structured;
    options.cells = {1, 1};
    mesh = generate_mesh(geometry, options);
    partition(mesh, 1);
    x.set_both(Vector::Constant(2, 10));
  }

  StepStatus solve(int undamped, IterationLog log = {}) {
    NewtonOptions options;
    options.undamped = undamped;
    return Newton(mesh, {&x}, {&part}, {}, options, "solve", std::move(log)).solve({0, 1, 1});
  }

  Mesh mesh;
  Field x{{.owner = "a", .name = "x", .location = Location::cell, .unit = "", .doc = ""}, 2};
  ArcTangent part{x};
};

TEST(Newton, DescentLeadsWhereFullStepsDoNot) {
  Equation equation;
  EXPECT_TRUE(equation.solve(0).converged);
  EXPECT_NEAR(equation.x.now()[0], std::tan(0.5), 1e-10);
}

TEST(Newton, ASecondAttemptStartsFromTheSamePlaceAndAsksForDescent) {
  Equation equation;
  int starts = 0, iterations = 0;
  const StepStatus status = equation.solve(1000, [&](const IterationRecord& entry) {
    starts += entry.iteration == 0;
    iterations = entry.iteration;
  });
  EXPECT_TRUE(status.converged) << status.reason;
  EXPECT_NEAR(equation.x.now()[1], std::tan(0.5), 1e-10);
  EXPECT_EQ(starts, 2);
  EXPECT_GT(status.iterations, iterations);  // those of both
}

}  // namespace
}  // namespace sprekk
