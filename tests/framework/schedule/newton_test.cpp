// Newton's method where full steps lead nowhere.
#include "framework/schedule/newton.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/piecewise_smooth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "framework/mesh/partition.hpp"
#include "framework/meshing/generate_mesh.hpp"

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
    options.cells = {2, 1};
    options.shape = MeshOptions::Shape::quadrilaterals;
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
  Field x{{.owner = "a",
           .name = "x",
           .location = Location::cell,
           .role = Role::unknown(BlockKind::interface),
           .unit = "",
           .doc = ""},
          2};
  ArcTangent part{x};
};

TEST(Newton, DescentLeadsWhereFullStepsDoNot) {
  Equation equation;
  EXPECT_TRUE(equation.solve(0).converged);
  EXPECT_NEAR(equation.x.now()[0], std::tan(0.5), 1e-10);
}

TEST(Newton, FurtherAttemptsStartFromTheSamePlaceAndTheLastOneAsksForDescent) {
  Equation equation;
  int starts = 0, iterations = 0;
  const StepStatus status = equation.solve(1000, [&](const IterationRecord& entry) {
    starts += entry.iteration == 0;
    iterations = entry.iteration;
  });
  EXPECT_TRUE(status.converged) << status.reason;
  EXPECT_NEAR(equation.x.now()[1], std::tan(0.5), 1e-10);
  // Full steps until the line search would begin, full steps and a line search, and descent from the first step on.
  EXPECT_EQ(starts, 3);
  EXPECT_GT(status.iterations, iterations);  // those of all
}

/// 1 - 1 + c (x^2 - 2) = 0: the residual is small against its terms long before x is the root of 2.
class HiddenRoot : public Part {
 public:
  explicit HiddenRoot(const Field& x) : x_(x) {}
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime&) const override {
    constexpr double c = 1e-8;
    const Eigen::ArrayXd x = x_.now().array();
    assembly.add(x_, Vector::Ones(x.size()));
    assembly.add(x_, (c * (x * x - 2) - 1).matrix());
    assembly.diagonal(x_, x_, (2 * c * x).matrix());
  }

 private:
  const Field& x_;
};

// A residual of 1e-10 leaves 2e-3 of x open. What the next update would change does not: 1e-8 of x, squared by then.
TEST(Newton, GoesOnUntilTheNextUpdateIsSmall) {
  Equation equation;
  HiddenRoot part(equation.x);
  const StepStatus status =
      Newton(equation.mesh, {&equation.x}, {&part}, {}, NewtonOptions(), "solve", {}).solve({0, 1, 1});
  EXPECT_TRUE(status.converged) << status.reason;
  for (const double x : equation.x.now()) EXPECT_NEAR(x, std::sqrt(2), 1e-6);
}

/// Newton's iterates for x^2 = 2 from 10, which are Heron's: x -> (x + 2/x)/2.
double heron(int iteration) {
  double x = 10;
  for (int i = 0; i < iteration; ++i) x = (x + 2 / x) / 2;
  return x;
}

/// x and the number of iterations with which HiddenRoot is accepted, from 10.
std::pair<double, int> accepted(const NewtonOptions& options) {
  Equation equation;
  HiddenRoot part(equation.x);
  const StepStatus status = Newton(equation.mesh, {&equation.x}, {&part}, {}, options, "solve", {}).solve({0, 1, 1});
  EXPECT_TRUE(status.converged) << status.reason;
  return {equation.x.now()[0], status.iterations};
}

// The residual of an iterate x is 1e-8 (x^2 - 2) against terms of about 1: the first one below the tolerance is taken.
TEST(Newton, TakesTheFirstIterateWithinTheResidual) {
  NewtonOptions options;
  options.update = 1e9;
  for (const int iteration : {3, 4, 5}) {
    const double residual = 1e-8 * (std::pow(heron(iteration), 2) - 2);
    for (const auto& [factor, last] : {std::pair(1.01, iteration), {0.99, iteration + 1}}) {
      options.residual = factor * residual;
      const auto [x, iterations] = accepted(options);
      EXPECT_EQ(iterations, last) << factor;
      EXPECT_NEAR(x, heron(last), 1e-6) << factor;  // round-off of 1e-16 over 1e-8
    }
  }
}

// The next update with the derivative of the last one is (x^2 - 2)/(2 x_before), measured against the 10 of the start.
TEST(Newton, TakesTheFirstIterateWhoseNextUpdateIsSmall) {
  NewtonOptions options;
  options.residual = 1e-7;  // holds from the second iterate on
  for (const int iteration : {3, 4, 5}) {
    const double update = (std::pow(heron(iteration), 2) - 2) / (2 * heron(iteration - 1)) / 10;
    for (const auto& [factor, last] : {std::pair(1.01, iteration), {0.99, iteration + 1}}) {
      options.update = factor * update;
      const auto [x, iterations] = accepted(options);
      EXPECT_EQ(iterations, last) << factor;
      EXPECT_NEAR(x, heron(last), 1e-6) << factor;
    }
  }
}

/// Cells that store c x each and exchange very much more with one another, into which a source flows.
class Exchange : public Part {
 public:
  Exchange(const Field& x, double exchanged, bool tells) : x_(x), tells_(tells) {
    SparseMatrix entries(2, 2), leaving(2, 2);
    const std::vector<Triplet> both = {{0, 0, exchanged}, {0, 1, -exchanged}, {1, 0, -exchanged}, {1, 1, exchanged}};
    entries.setFromTriplets(both.begin(), both.end());
    exchange_ = Operator(entries, leaving);
  }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime&) const override {
    BalanceRows rows(assembly, x_, "quantity");
    const Vector stored = capacity * (x_.now() - x_.accepted()), source = Vector::Unit(2, 0);
    if (tells_) {
      rows.store(stored);
      rows.supply(source);
    } else {
      assembly.add(x_, stored);
      assembly.add(x_, -source);
    }
    assembly.diagonal(x_, x_, Vector::Constant(2, capacity));
    assembly.linear(x_, exchange_, x_);
    // Stands for a circulating flow, which does not change, and cancels in every sum.
    assembly.compare_with(x_, 1e12);
  }
  static constexpr double capacity = 2;

 private:
  const Field& x_;
  bool tells_;
  Operator exchange_;
};

// All of what flows in is 1e-12 of what the equation is compared with. It is stored none the less: c (x0 + x1) = 1.
TEST(Newton, BalancesHoldAgainstWhatIsStoredAndBroughtIn) {
  for (const double exchanged : {1.0, 1e3}) {
    Equation equation;
    equation.x.set_both(Vector::Constant(2, 3));
    Exchange part(equation.x, exchanged, true);
    const StepStatus status =
        Newton(equation.mesh, {&equation.x}, {&part}, {}, NewtonOptions(), "solve", {}).solve({0, 1, 1});
    EXPECT_TRUE(status.converged) << status.reason;
    EXPECT_EQ(status.iterations, 1);
    const Vector change = equation.x.now() - equation.x.accepted();
    EXPECT_NEAR(Exchange::capacity * change.sum(), 1, 1e-8);
    EXPECT_NEAR((Exchange::capacity + 2 * exchanged) * (change[0] - change[1]), 1, 1e-8 * (1 + exchanged));
  }
}

/// Cells that store x^2 each, into which 91 flows; the equation is compared with something much larger.
class Filling : public Part {
 public:
  explicit Filling(const Field& x) : x_(x) {}
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime&) const override {
    const Eigen::ArrayXd x = x_.now().array(), before = x_.accepted().array();
    BalanceRows rows(assembly, x_, "quantity");
    rows.store((x * x - before * before).matrix());
    rows.supply(Vector::Constant(x.size(), 91));
    assembly.diagonal(x_, x_, (2 * x).matrix());
    assembly.compare_with(x_, 1e12);
  }

 private:
  const Field& x_;
};

// From 3, x^2 = 100 is approached by x -> (x + 100/x)/2. The error of a balance, |x^2 - 100| of each cell, is accepted
// up to a hundred times the tolerance of the throughput, x^2 - 9 + 91.
TEST(Newton, BalancesMayBeAHundredTimesLooserThanResiduals) {
  double x = 3;
  for (int iteration = 1; iteration <= 4; ++iteration) {
    x = (x + 100 / x) / 2;
    const double error = (x * x - 100) / (x * x + 82);
    for (const auto& [factor, last] : {std::pair(1.01, iteration), {0.99, iteration + 1}}) {
      Equation equation;
      equation.x.set_both(Vector::Constant(2, 3));
      Filling part(equation.x);
      NewtonOptions options;
      options.update = 1e9;
      options.residual = factor * error / 100;
      const StepStatus status =
          Newton(equation.mesh, {&equation.x}, {&part}, {}, options, "solve", {}).solve({0, 1, 1});
      EXPECT_TRUE(status.converged) << status.reason;
      EXPECT_EQ(status.iterations, last) << factor;
    }
  }
}

// A part that does not tell its throughput has rows that hold against their own terms all the same.
TEST(Newton, WithoutThroughputRowsHoldAgainstTheirOwnTerms) {
  Equation equation;
  equation.x.set_both(Vector::Constant(2, 3));
  Exchange part(equation.x, 1, false);
  const StepStatus status =
      Newton(equation.mesh, {&equation.x}, {&part}, {}, NewtonOptions(), "solve", {}).solve({0, 1, 1});
  EXPECT_TRUE(status.converged);
  EXPECT_EQ(status.iterations, 1);
  const Vector change = equation.x.now() - equation.x.accepted();
  EXPECT_NEAR(Exchange::capacity * change.sum(), 1, 1e-8);
}

/// A continuous, piecewise linear function of the first value, given by its corners, and of slope `slope` behind the
/// last one.
class Polyline : public Part, public PiecewiseSmooth {
 public:
  Polyline(const Field& x, std::vector<Point> corners, double slope)
      : x_(x), corners_(std::move(corners)), slope_(slope) {}
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime&) const override {
    const std::size_t k = discrete_state();
    const Point& from = corners_[k];
    const double slope = k + 1 == corners_.size() ? slope_ : tangent(k);
    Vector value(2), derivative(2);
    value << from.y() + slope * (x_.now()[0] - from.x()), x_.now()[1];
    derivative << slope, 1;
    assembly.add(x_, value);
    assembly.compare_with(x_, 1);
    assembly.diagonal(x_, x_, derivative);
  }
  std::uint64_t discrete_state() const override {
    std::uint64_t k = 0;
    while (k + 1 < corners_.size() && x_.now()[0] >= corners_[k + 1].x()) ++k;
    return k;
  }

 private:
  double tangent(std::size_t k) const {
    const Point along = corners_[k + 1] - corners_[k];
    return along.y() / along.x();
  }
  const Field& x_;
  std::vector<Point> corners_;
  double slope_;
};

struct PolylineEquation : Equation {
  StepStatus solve(std::vector<Point> corners, double slope, double start, int pieces, IterationLog log = {}) {
    Polyline polyline(x, std::move(corners), slope);
    x.set_both(Vector::Constant(2, start));
    NewtonOptions options;
    options.pieces = pieces;
    return Newton(mesh, {&x}, {&polyline}, {}, options, "solve", std::move(log)).solve({0, 1, 1});
  }
};

TEST(PathSearch, PassesAHillThatNeitherFullStepsNorDescentPass) {
  // Up to -0.2 at 1, down to -0.6 at 2, and through zero at 3.2: steps go to and fro between the first two pieces.
  const std::vector<Point> corners = {{-10, -9}, {1, -0.2}, {2, -0.6}};
  PolylineEquation equation;
  EXPECT_FALSE(equation.solve(corners, 0.5, 0, 0).converged);
  std::vector<double> lengths;
  const StepStatus status =
      equation.solve(corners, 0.5, 0, 10, [&](const IterationRecord& entry) { lengths.push_back(entry.step_length); });
  EXPECT_TRUE(status.converged) << status.reason;
  EXPECT_NEAR(equation.x.now()[0], 3.2, 1e-12);
  EXPECT_NEAR(equation.x.now()[1], 0, 1e-12);
  EXPECT_LT(*std::min_element(lengths.begin(), lengths.end()), 0);  // over the hill the residual grows
}

TEST(PathSearch, SaysThatItLeadsToInfinity) {
  PolylineEquation equation;
  const StepStatus status = equation.solve({{-10, -9}, {1, -0.2}, {2, -0.6}}, -0.1, 0, 10);
  EXPECT_FALSE(status.converged);
  EXPECT_NE(status.reason.find("infinity"), std::string::npos) << status.reason;
}

TEST(PathSearch, EndsWhereItGainsNothing) {
  // Hills of the same height one behind the other, before the line rises through zero: each has two pieces.
  const auto solve = [](PolylineEquation& equation, int hills, double lower) {
    std::vector<Point> corners = {{-10, -9}, {1, -0.2}};
    for (int k = 0; k < hills; ++k) {
      corners.emplace_back(2 * k + 2, -0.6);
      corners.emplace_back(2 * k + 3, -0.2 + (k + 1) * lower);
    }
    corners.emplace_back(2 * hills + 2, -0.6);
    return equation.solve(corners, 0.5, 0, 300);
  };
  for (const int hills : {12, 17}) {
    PolylineEquation equation;
    const StepStatus status = solve(equation, hills, 0);
    EXPECT_EQ(status.converged, hills == 12) << status.reason;
    EXPECT_EQ(status.reason.find("gained nothing") != std::string::npos, hills == 17) << status.reason;
  }
  // Each hill is higher than the one before: the path gains a little at each, and goes on.
  PolylineEquation equation;
  const StepStatus status = solve(equation, 100, 1e-3);
  EXPECT_TRUE(status.converged) << status.reason;
  EXPECT_NEAR(equation.x.now()[0], 203.2, 1e-10);
}

TEST(PathSearch, LooksALongWayForTheNextPieceButNotForEver) {
  // Behind the hill at 1 the line falls by 0.4 to a valley that is `lengths` updates away, and rises by 0.5 from there
  // on.
  const auto valley = [](double lengths) { return Point(1 + 0.5 * lengths, -0.2 - 0.2 * lengths); };
  const auto solve = [&](PolylineEquation& equation, double lengths) {
    return equation.solve({{-10, -9}, {1, -0.2}, valley(lengths)}, 0.5, 0, 10);
  };
  for (const double lengths : {2.0, 1e3, 1e6}) {
    PolylineEquation equation;
    const StepStatus status = solve(equation, lengths);
    EXPECT_TRUE(status.converged) << lengths << ": " << status.reason;
    const double root = valley(lengths).x() - 2 * valley(lengths).y();
    EXPECT_NEAR(equation.x.now()[0], root, 1e-12 * root);
  }
  // From 1e9 updates on a ray counts as one without a further piece.
  for (const double lengths : {4e8, 2.5e9}) {
    PolylineEquation equation;
    const StepStatus status = solve(equation, lengths);
    EXPECT_EQ(status.reason.find("infinity") != std::string::npos, lengths > 1e9) << lengths << ": " << status.reason;
  }
}

}  // namespace
}  // namespace sprekk
