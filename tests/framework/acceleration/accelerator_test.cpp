#include "framework/acceleration/accelerator.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "framework/acceleration/registry.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

/// The accelerator of `accelerate: {name: {…}}`, given as keys and numbers.
std::unique_ptr<Accelerator> make(const std::string& name,
                                  const std::vector<std::pair<std::string, std::string>>& set) {
  Node inner;
  inner.kind = Node::Kind::map;
  for (const auto& [key, value] : set) {
    Node number;
    number.kind = Node::Kind::scalar;
    number.scalar = value;
    inner.entries.push_back({key, {}, number});
  }
  Node outer;
  outer.kind = Node::Kind::map;
  outer.entries.push_back({name, {}, inner});
  AccelerationOptions options;
  options.spec().read(outer, {});
  return options.build();
}

/// x → M x + b, with eigenvalues of M of which some are beyond -1 and 1: the plain iteration diverges.
struct Affine {
  Eigen::MatrixXd m;
  Vector b;
  Vector operator()(const Vector& x) const { return m * x + b; }
  Vector solution() const { return (Eigen::MatrixXd::Identity(b.size(), b.size()) - m).partialPivLu().solve(b); }
};

Affine random_map(int size, int seed, double radius) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Affine map{Eigen::MatrixXd(size, size), Vector(size)};
  for (double& entry : map.m.reshaped()) entry = radius * normal(random) / std::sqrt(size);
  for (double& entry : map.b) entry = normal(random);
  return map;
}

/// How many evaluations of G the iteration needs until |G(x) − x| is below `until`.
int passes(Accelerator& accelerator, const Affine& map, const Vector& scale, double until, int at_most) {
  accelerator.begin(scale);
  Vector x = Vector::Zero(map.b.size());
  for (int pass = 1; pass <= at_most; ++pass) {
    const Vector image = map(x);
    if ((image - x).norm() < until) return pass;
    x = accelerator.next(x.cwiseQuotient(scale), image.cwiseQuotient(scale)).cwiseProduct(scale);
  }
  return at_most + 1;
}

TEST(Accelerators, QuasiNewtonMethodsSolveALinearProblemInOnePassMoreThanItsUnknowns) {
  for (const char* name : {"iqn_ils", "iqn_imvj"})
    for (const int size : {1, 2, 5, 9})
      for (const int seed : {1, 2, 3, 4}) {
        const auto accelerator = make(name, {{"filter_limit", "1e-13"}});
        const Affine map = random_map(size, seed, 1.7);
        // n differences are known after n + 1 evaluations: the next iterate is the answer, which one more confirms.
        EXPECT_LE(passes(*accelerator, map, Vector::Ones(size), 1e-9, 50), size + 2)
            << name << " " << size << " " << seed;
      }
}

TEST(Accelerators, AntisymmetricScalesChangeNoIterateOfALinearProblem) {
  // The combination with the least residual depends on the scales, except where the residual becomes zero.
  const int size = 4;
  const Affine map = random_map(size, 7, 1.2);
  Vector scale(size);
  scale << 1e-9, 3.0, 1e7, 0.02;
  Affine scaled = map;
  scaled.m = scale.asDiagonal() * map.m * scale.cwiseInverse().asDiagonal();
  scaled.b = scale.asDiagonal() * map.b;
  for (const char* name : {"iqn_ils", "iqn_imvj"}) {
    const auto one = make(name, {}), other = make(name, {});
    one->begin(Vector::Ones(size));
    other->begin(scale);
    Vector x = Vector::Zero(size), y = Vector::Zero(size);
    for (int pass = 0; pass < 4; ++pass) {
      x = one->next(x, map(x));
      y = other->next(y, scaled(scale.cwiseProduct(y)).cwiseQuotient(scale));
      EXPECT_LT((x - y).norm(), 1e-9 * x.norm()) << name << " " << pass;
    }
  }
}

TEST(Accelerators, AMatrixOfAllStepsSolvesLaterStepsAtOnce) {
  const int size = 6;
  Affine map = random_map(size, 5, 1.5);
  for (const auto& [name, key] : {std::pair("iqn_imvj", "rank"), std::pair("iqn_ils", "reuse")}) {
    const auto accelerator = make(name, {{key, "6"}, {"filter_limit", "1e-13"}});
    EXPECT_GT(passes(*accelerator, map, Vector::Ones(size), 1e-9, 50), size);
    accelerator->accepted();
    // Another load and other scales: the answer follows from the first residual.
    map.b = Vector::LinSpaced(size, -3, 2);
    EXPECT_EQ(passes(*accelerator, map, Vector::LinSpaced(size, 1, 50), 1e-7, 50), 2) << name;
  }
}

TEST(Accelerators, WhatIsTakenBackIsForgotten) {
  const int size = 6;
  const Affine map = random_map(size, 5, 1.5);
  for (const auto& [name, key] : {std::pair("iqn_imvj", "rank"), std::pair("iqn_ils", "reuse")}) {
    const auto accelerator = make(name, {{key, "6"}});
    const int first = passes(*accelerator, map, Vector::Ones(size), 1e-9, 50);
    accelerator->rewound();
    accelerator->accepted();
    EXPECT_EQ(passes(*accelerator, map, Vector::Ones(size), 1e-9, 50), first) << name;
  }
}

TEST(Accelerators, StepsThatLeadAwayCanBeForgotten) {
  constexpr int size = 6;
  const Affine map = random_map(size, 3, 1.7), other = random_map(size, 4, 1.7);
  for (const auto& [name, key] : {std::pair("iqn_imvj", "rank"), std::pair("iqn_ils", "reuse")}) {
    const auto accelerator = make(name, {{key, "20"}});
    const auto first_pass = [&] {
      accelerator->begin(Vector::Ones(size));
      return accelerator->next(Vector::Zero(size), other(Vector::Zero(size)));
    };
    passes(*accelerator, map, Vector::Ones(size), 1e-9, 50);
    accelerator->accepted();
    EXPECT_GT((first_pass() - other.b).norm(), 0.1 * other.b.norm()) << name;
    EXPECT_TRUE(accelerator->forget_steps()) << name;
    EXPECT_EQ(first_pass(), other.b) << name;  // a plain pass
    EXPECT_FALSE(accelerator->forget_steps()) << name;
    EXPECT_LE(passes(*accelerator, other, Vector::Ones(size), 1e-9, 50), size + 2) << name;
  }
}

TEST(Accelerators, ARestoredHistoryGoesOnToTheBit) {
  const int size = 7;
  Affine map = random_map(size, 11, 0.9);
  for (const auto& [name, key] : {std::pair("iqn_imvj", "rank"), std::pair("iqn_ils", "reuse")}) {
    const auto accelerator = make(name, {{key, "3"}}), restored = make(name, {{key, "3"}});
    for (int step = 0; step < 4; ++step) {
      map.b *= 1.3;
      passes(*accelerator, map, Vector::LinSpaced(size, 1, 2 + step), 1e-4, 50);
      accelerator->accepted();
    }
    std::map<std::string, Vector> state;
    accelerator->save(state);
    restored->restore(state);
    const Vector scale = Vector::LinSpaced(size, 0.3, 1), x = Vector::LinSpaced(size, -1, 1);
    accelerator->begin(scale);
    restored->begin(scale);
    const Vector next = accelerator->next(x, map(x)), same = restored->next(x, map(x));
    EXPECT_TRUE(next == same) << name;
    EXPECT_GT((next - map(x)).norm(), 1e-3) << name << " has learned nothing";
  }
}

TEST(Accelerators, AValueOfAnotherShapeIsForgotten) {
  for (const char* name : {"iqn_imvj", "iqn_ils"}) {
    const auto accelerator = make(name, {});
    accelerator->restore({{"a", Vector::Ones(5)},
                          {"b", Vector::Ones(4)},
                          {"rank", Vector::Ones(1) * 2},
                          {"columns", Vector::Ones(1) * 2},
                          {"values", Vector::Ones(5)}});
    accelerator->begin(Vector::Ones(3));
    EXPECT_TRUE(accelerator->next(Vector::Zero(3), Vector::Ones(3)) == Vector::Ones(3)) << name;
  }
}

TEST(Accelerators, AMatrixOfSmallRankConvergesAsWell) {
  const int size = 12;
  Affine map = random_map(size, 21, 0.8);
  const auto accelerator = make("iqn_imvj", {{"rank", "4"}});
  for (int step = 0; step < 6; ++step) {
    map.b *= -1.2;
    EXPECT_LE(passes(*accelerator, map, Vector::Ones(size), 1e-9, 50), size + 2) << step;
    accelerator->accepted();
  }
  std::map<std::string, Vector> state;
  accelerator->save(state);
  EXPECT_EQ(state["rank"][0], 4);
  EXPECT_EQ(state["a"].size(), 4 * size);
}

TEST(Accelerators, FiltersLeaveOutWhatIsNoNews) {
  // The map has one direction only, so that all differences after the first are its round-off.
  for (const char* filter : {"qr1", "qr2", "none"}) {
    const auto accelerator = make("iqn_ils", {{"filter", filter}});
    Affine map{Eigen::MatrixXd::Constant(5, 5, -0.4), Vector::LinSpaced(5, 1, 2)};
    EXPECT_LE(passes(*accelerator, map, Vector::Ones(5), 1e-11, 50), 4) << filter;
  }
}

TEST(Accelerators, AitkenSolvesOneUnknownInThreePasses) {
  const Affine map = random_map(1, 3, 5);
  EXPECT_LE(passes(*make("aitken", {}), map, Vector::Ones(1), 1e-9, 50), 3);
}

TEST(Accelerators, AFactorIsKeptWithinItsBounds) {
  // The slope is -9: Aitken's factor would be 0.1 at once.
  const Affine map{Eigen::MatrixXd::Constant(1, 1, -9), Vector::Ones(1)};
  const auto accelerator = make("aitken", {{"least", "0.15"}, {"first", "0.15"}});
  accelerator->begin(Vector::Ones(1));
  Vector x = Vector::Zero(1);
  x = accelerator->next(x, map(x));
  EXPECT_DOUBLE_EQ(x[0], 0.15);
  const double residual = map(x)[0] - x[0];
  EXPECT_DOUBLE_EQ(accelerator->next(x, map(x))[0], x[0] + 0.15 * residual);
}

TEST(Accelerators, AConstantFactorIsTheShareOfThePass) {
  const auto accelerator = make("constant", {{"factor", "0.25"}});
  accelerator->begin(Vector::Ones(2));
  const Vector next = accelerator->next(Vector::Constant(2, 4), Vector::Constant(2, 8));
  EXPECT_TRUE(next == Vector::Constant(2, 5));
}

TEST(Accelerators, MistakesAreRefused) {
  const auto message = [](const auto& build) -> std::string {
    try {
      build();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message([] { make("iqn", {}); }), HasSubstr("iqn_ils"));
  EXPECT_THAT(message([] { make("aitken", {{"least", "2"}, {"most", "1"}}); }), HasSubstr("'least' is larger"));
  EXPECT_THAT(message([] { make("iqn_ils", {{"filter", "qr3"}}); }), HasSubstr("qr2"));
  EXPECT_THAT(message([] { make("constant", {}); }), HasSubstr("factor"));
}

TEST(Accelerators, AnExistingNameIsRefused) {
  EXPECT_THROW(AcceleratorRegistry::instance().add({"aitken", {}}), std::logic_error);
}

}  // namespace
}  // namespace sprekk
