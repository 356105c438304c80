// Domains, cracks and comparisons that the tests of the fine level share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "components/fine_fracture/quarter_point/elasticity/model.hpp"
#include "tests/components/fine_fracture/quarter_point/griffith.hpp"

namespace sprekk::test {

using namespace fine_fracture;
using Walls = CrackPath::Walls;
using Side = FineGeometry::Side;

inline const Elasticity table_1_rock{11.111e9, 16.667e9};

inline std::vector<Point> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A straight crack with both ends inside.
inline CrackPath inner_crack(const Point& from, const Point& to, Walls walls = Walls::traction) {
  return {{from, to}, true, true, {walls}};
}

/// The piece of rock of the paper: 0.5 m wide around a crack of 0.1 m, with meshes as at its resolution.
inline FineGeometry paper_box(Walls walls = Walls::traction) {
  return {rectangle(-0.25, -0.25, 0.25, 0.25), {inner_crack({-0.05, 0}, {0.05, 0}, walls)}};
}
inline FineMeshOptions paper_mesh() { return {.tip_size = 0.02, .far_size = 0.1}; }

inline Griffith paper_crack(double normal, double shear, double along = 0) {
  return {.a = 0.05, .normal = normal, .shear = shear, .along = along, .rock = table_1_rock};
}

inline FineLoads exact_outline(const Griffith& exact) {
  return {
      .boundary_displacement = [exact](const Point& x, const Point& inside) { return exact.displacement(x, inside); }};
}

/// The largest relative error of (K_I, K_II), each relative to |K|; also written to the test's record.
inline double relative_error(const Point& K, const Point& exact, const std::string& name) {
  const double error = (K - exact).cwiseAbs().maxCoeff() / exact.norm();
  testing::Test::RecordProperty(name, std::to_string(error));
  return error;
}

inline double worst_error(const FineSolution& solution, const Point& exact, const std::string& name = "K") {
  double worst = 0;
  for (const TipIntensities& tip : solution.tips) worst = std::max(worst, relative_error(tip.K, exact, name));
  testing::Test::RecordProperty(name, std::to_string(worst));
  return worst;
}

}  // namespace sprekk::test
