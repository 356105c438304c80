// Cracks that meet and cross, by boundary elements.
#include <numbers>

#include "tests/components/fine_fracture/boundary_element/cases.hpp"

namespace sprekk::test {
namespace {

/// Equal cracks of length 1 from one point.
std::vector<CrackPath> star(int arms, double turn) {
  std::vector<CrackPath> cracks;
  for (int i = 0; i < arms; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / arms;
    cracks.push_back({{{0, 0}, {std::cos(angle), std::sin(angle)}}, false, true, {Walls::traction}});
  }
  return cracks;
}

FineLoads pressure_in(const FineGeometry& geometry, double p) {
  return {.wall_traction = [=](int crack, int segment, double) -> Point {
    const auto& points = geometry.cracks[crack].points;
    const Point along = (points[segment + 1] - points[segment]).normalized();
    return -p * Point(along.y(), -along.x());
  }};
}

TEST(BoundaryJunctions, StarsUnderPressureHaveTheirClosedForm) {
  // K_I / (p sqrt(pi a)) by the Wiener-Hopf method, see tests/components/fine_fracture/quarter_point/junction_test.cpp;
  // of four arms also Rooke and Sneddon 1969.
  for (const auto& [arms, factor] : {std::pair{2, 1.0}, std::pair{4, 0.8636}})
    for (const double turn : {0.0, 0.2}) {
      const FineGeometry geometry{rectangle(-60, -60, 60, 60), star(arms, turn), std::vector(4, Side::traction)};
      for (int tip = 0; tip < arms; ++tip) {
        const TipFactors found = boundary_factors(geometry, table_1_rock, {tip, true}, pressure_in(geometry, 1e6), 0.3);
        const double K = factor * 1e6 * std::sqrt(std::numbers::pi);
        RecordProperty(std::to_string(arms) + " arms", std::to_string(found.sifs.k1 / K - 1));
        EXPECT_LT(relative_error(intensities_of(found), {K, 0}, "K"), 5e-4) << arms << " arms, tip " << tip;
      }
    }
}

/// A crack along x with another one across it or up to it at (0.01, 0), whose walls carry what Griffith's field has
/// there: nothing but that field may come out.
TEST(BoundaryJunctions, ACrackThatCarriesWhatIsThereChangesNothing) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  for (const bool touches : {false, true}) {
    FineGeometry geometry = paper_box();
    const Point at(0.01, 0), along(0.02, 0.05);
    geometry.cracks[0] = {{{-0.05, 0}, at, {0.05, 0}}, true, true, {Walls::traction, Walls::traction}};
    geometry.cracks.push_back(
        touches ? CrackPath{{at + along, at}, true, false, {Walls::traction}}
                : CrackPath{{at - along, at, at + along}, true, true, {Walls::traction, Walls::traction}});
    FineLoads loads = exact_outline(exact);
    loads.wall_traction = [&](int crack, int segment, double s) -> Point {
      if (crack == 0) return Point::Zero();
      const auto& points = geometry.cracks[crack].points;
      const Point way = points[segment + 1] - points[segment], unit = way.normalized();
      return exact.stress(points[segment] + s * way) * Point(unit.y(), -unit.x());
    };
    for (const TipPlace& tip : {TipPlace{0, false}, TipPlace{0, true}, TipPlace{1, false}}) {
      const Point K = tip.crack == 0 ? exact.K() : Point(0, 0);
      const TipFactors found = boundary_factors(geometry, table_1_rock, tip, loads, 0.02);
      EXPECT_LT((intensities_of(found) - K).norm(), 3e-4 * exact.K().norm()) << touches << " " << tip.crack;
    }
  }
}

}  // namespace
}  // namespace sprekk::test
