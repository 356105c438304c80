// Cracks that touch and cross: factors of their tips, and jumps and stresses where they meet.
#include <functional>
#include <random>

#include "components/fine_fracture/fine_level/fine_domain.hpp"
#include "components/fine_fracture/quarter_point/elasticity/adapt.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "tests/components/fine_fracture/quarter_point/cases.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

/// Cracks of length 1 from the origin outward at equal angles, as paths through the origin where two lie opposite.
std::vector<CrackPath> star(int arms, double turn, Walls walls = Walls::traction) {
  std::vector<CrackPath> cracks;
  const auto end = [&](int k) {
    const double angle = turn + 2 * std::numbers::pi * k / arms;
    return Point(std::cos(angle), std::sin(angle));
  };
  if (arms % 2 == 0)
    for (int k = 0; k < arms / 2; ++k) cracks.push_back({{-end(k), {0, 0}, end(k)}, true, true, {walls, walls}});
  else
    for (int k = 0; k < arms; ++k) cracks.push_back({{{0, 0}, end(k)}, false, true, {walls}});
  return cracks;
}

FineLoads pressure_in(const FineGeometry& geometry, double p) {
  return {.wall_traction = [=](int crack, int segment, double) -> Point {
    const auto& points = geometry.cracks[crack].points;
    const Point along = (points[segment + 1] - points[segment]).normalized();
    return -p * Point(along.y(), -along.x());
  }};
}

/// K_I / (p sqrt(pi a)) of `arms` equal cracks from one point under a pressure p, infinite plane.
///
/// In a wedge of half-angle beta = pi / arms between two cracks the Mellin transforms of the stress and of the slope of
/// the wall are in the ratio G(s) = (s sin 2 beta + sin 2 beta s) / (cos 2 beta s - cos 2 beta). The Wiener-Hopf
/// method gives F = exp(-1/pi int_0^oo ln H(y) / (1 + y^2) dy), H(y) = G(iy) / G_2(iy) with G_2 that of two arms: they
/// are Griffith's crack. For four F is 0.8635.
double star_factor(int arms) {
  const double beta = std::numbers::pi / arms;
  const auto H = [&](double y) {
    if (y > 60) return 1.0;
    return (y * std::sin(2 * beta) + std::sinh(2 * beta * y)) /
           ((std::cosh(2 * beta * y) - std::cos(2 * beta)) * std::tanh(std::numbers::pi * y / 2));
  };
  constexpr int count = 20000;
  constexpr double step = std::numbers::pi / 2 / count;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += std::log(H(std::tan((i + 0.5) * step))) * step;
  return std::exp(-sum / std::numbers::pi);
}

TEST(Junction, StarsUnderPressureHaveTheirClosedForm) {
  for (const int arms : {3, 4, 5, 6}) {
    FineGeometry geometry{rectangle(-60, -60, 60, 60), star(arms, 0.2), std::vector(4, Side::traction)};
    const FineModel model(geometry, {.tip_size = 0.1, .far_size = 20}, table_1_rock);
    const FineSolution solution = model.solve(pressure_in(geometry, 1e6));
    ASSERT_EQ(static_cast<int>(solution.tips.size()), arms);
    const double unit = 1e6 * std::sqrt(std::numbers::pi), K = star_factor(arms) * unit;
    EXPECT_LT(worst_error(solution, {K, 0}, std::to_string(arms) + " arms"), 3e-4);
    for (const TipIntensities& tip : solution.tips) {
      EXPECT_LT(relative_error(tip.K_extrapolated, {K, 0}, "extrapolated"), 5e-3);
    }
  }
  // Rooke and Sneddon 1969.
  EXPECT_NEAR(star_factor(4), 0.8640, 6e-4);
  EXPECT_NEAR(star_factor(2), 1, 1e-12);
}

/// A crack along x with another one across it or up to it at (0.01, 0), whose walls carry what Griffith's field has
/// there: nothing but that field may come out.
FineGeometry crossed(bool touches, Walls own, Walls other) {
  FineGeometry geometry = paper_box();
  const Point at(0.01, 0), along(0.02, 0.05);
  geometry.cracks[0] = {{{-0.05, 0}, at, {0.05, 0}}, true, true, {own, own}};
  geometry.cracks.push_back(touches ? CrackPath{{at + along, at}, true, false, {other}}
                                    : CrackPath{{at - along, at, at + along}, true, true, {other, other}});
  return geometry;
}

FineLoads loads_of_first_crack(const FineGeometry& geometry, const Griffith& exact) {
  FineLoads loads = exact_outline(exact);
  const auto place = [geometry](int crack, int segment, double s) -> Point {
    const auto& points = geometry.cracks[crack].points;
    return points[segment] + s * (points[segment + 1] - points[segment]);
  };
  loads.wall_traction = [=](int crack, int segment, double s) -> Point {
    if (crack == 0) return Point::Zero();
    const auto& points = geometry.cracks[crack].points;
    const Point along = (points[segment + 1] - points[segment]).normalized();
    return exact.stress(place(crack, segment, s)) * Point(along.y(), -along.x());
  };
  loads.wall_jump = [=](int crack, int segment, double s) -> Point {
    return crack == 0 ? exact.jump(place(crack, segment, s).x()) : Point(0, 0);
  };
  return loads;
}

TEST(Junction, ACrackThatCarriesWhatIsThereChangesNothing) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  for (const bool touches : {false, true})
    for (const Walls own : {Walls::traction, Walls::jump})
      for (const Walls other : {Walls::traction, Walls::jump}) {
        const FineGeometry geometry = crossed(touches, own, other);
        const FineModel model(geometry, paper_mesh(), table_1_rock);
        const FineSolution solution = model.solve(loads_of_first_crack(geometry, exact));
        ASSERT_EQ(solution.tips.size(), touches ? 3u : 4u);
        for (const TipIntensities& tip : solution.tips) {
          Point K = tip.crack == 0 ? exact.K() : Point(0, 0);
          // Of prescribed jumps sqrt(r (2a - r)) extrapolation leaves what is known.
          const double part = solution.mesh->tips[&tip - solution.tips.data()].room.radius / exact.a;
          if (tip.crack == 0 && own == Walls::jump) K *= (4 * std::sqrt(1 - part / 8) - std::sqrt(1 - part / 2)) / 3;
          const double tolerance = (tip.crack == 0 ? own : other) == Walls::jump ? 1e-9 : 3e-4;
          EXPECT_LT((tip.K - K).norm(), tolerance * exact.K().norm()) << touches << " " << tip.crack;
        }
      }
}

TEST(Junction, ABlockThatCracksCutOutChangesNothingElse) {
  // Three cracks beside the first one enclose a triangle.
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const Point a(-0.02, 0.03), b(0.04, 0.03), c(0.01, 0.08);
  const auto over = [](const Point& from, const Point& to) { return Point(to + 0.2 * (to - from)); };
  for (const Walls walls : {Walls::traction, Walls::jump}) {
    FineGeometry geometry = paper_box();
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      geometry.cracks.push_back({{over(to, from), from, to, over(from, to)}, true, true, {walls, walls, walls}});
    ASSERT_EQ(junctions(geometry).size(), 3u);
    const FineModel model(geometry, paper_mesh(), table_1_rock);
    const FineSolution solution = model.solve(loads_of_first_crack(geometry, exact));
    ASSERT_EQ(solution.tips.size(), 8u);
    for (const TipIntensities& tip : solution.tips) {
      const Point K = tip.crack == 0 ? exact.K() : Point(0, 0);
      EXPECT_LT((tip.K - K).norm(), 4e-4 * exact.K().norm()) << tip.crack;
    }
  }
}

TEST(Junction, LimitsTheRoomOfATip) {
  // The other crack crosses 5 mm behind the tip.
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  FineGeometry geometry = crossed(false, Walls::traction, Walls::traction);
  const Point at(0.045, 0), along(0, 0.02);
  geometry.cracks[0].points[1] = at;
  geometry.cracks[1].points = {at - along, at, at + along};
  const FineModel model(geometry, paper_mesh(), table_1_rock);
  const FineSolution solution = model.solve(loads_of_first_crack(geometry, exact));
  const TipIntensities& tip = solution.tips[1];
  EXPECT_NEAR(model.mesh().tips[1].room.radius, 0.005 / 3, 1e-12);
  EXPECT_NEAR(tip.domain_radius, 0.75 * 0.005, 1e-12);
  EXPECT_LT(relative_error(tip.K, exact.K(), "K"), 1e-3);
}

/// The jump of a solution at the places of its nodes.
std::function<Point(int, int, double)> jump_of(const FineGeometry& geometry, const FineSolution& solution) {
  return [&](int crack, int segment, double s) {
    const auto& points = geometry.cracks[crack].points;
    const Point x = points[segment] + s * (points[segment + 1] - points[segment]);
    const Point middle = 0.5 * (points[segment] + points[segment + 1]);
    double least = 1e30;
    Point jump;
    for (const FineMesh::WallEdge& edge : solution.mesh->wall_edges) {
      const Point center = solution.mesh->nodes[edge.nodes[0][2]];
      // Of edges on this segment alone.
      const Segment whole{points[segment], points[segment + 1]};
      if (edge.crack != crack || distance(center, whole) > 1e-9 || (center - middle).norm() > 0.5 * whole.length())
        continue;
      for (int k = 0; k < 3; ++k) {
        const double away = (solution.mesh->nodes[edge.nodes[0][k]] - x).norm();
        if (away >= least) continue;
        least = away;
        jump = solution.displacement.segment<2>(2 * edge.nodes[1][k]) -
               solution.displacement.segment<2>(2 * edge.nodes[0][k]);
      }
    }
    EXPECT_LT(least, 1e-9);
    return jump;
  };
}

TEST(Junction, TheJumpsOfASolutionGiveItBack) {
  for (const int arms : {3, 4, 5}) {
    FineGeometry geometry{rectangle(-4, -4, 4, 4), star(arms, 0.2)};
    const FineMeshOptions sizes{.tip_size = 0.1, .far_size = 1};
    const FineSolution open = FineModel(geometry, sizes, table_1_rock).solve(pressure_in(geometry, 1e6));
    FineGeometry held{geometry.outline, star(arms, 0.2, Walls::jump)};
    const FineModel model(held, sizes, table_1_rock);
    const FineSolution again = model.solve({.wall_jump = jump_of(geometry, open)});
    ASSERT_EQ(again.displacement.size(), open.displacement.size());
    EXPECT_LT((again.displacement - open.displacement).cwiseAbs().maxCoeff(),
              1e-9 * open.displacement.cwiseAbs().maxCoeff())
        << arms;
  }
}

/// Four blocks, parted by cracks through the whole domain along the axes, each with a
/// linear displacement of its own: what acts between them is the same on both sides.
struct Blocks {
  double alpha_p[4] = {2e6, -1e6, 5e6, 0};  ///< by quadrant
  Point shift[4] = {{0, 0}, {1e-4, -3e-4}, {2e-4, 2e-4}, {-5e-4, 1e-4}};
  int of(const Point& x) const { return x.y() > 0 ? (x.x() > 0 ? 0 : 1) : (x.x() > 0 ? 3 : 2); }
  Tensor stress(int block) const {
    Tensor s;
    const double xx = block < 2 ? 3e6 : -4e6, yy = block == 0 || block == 3 ? 1e6 : 7e6, xy = 2e6;
    s << xx, xy, xy, yy;
    return s;
  }
  Tensor strain(int block) const { return table_1_rock.strain(stress(block) + alpha_p[block] * Tensor::Identity()); }
  Point displacement(const Point& x, const Point& inside) const { return strain(of(inside)) * x + shift[of(inside)]; }
};

TEST(Junction, BlocksPartedByCracksHaveStatesOfTheirOwn) {
  const Blocks blocks;
  for (const Walls first : {Walls::traction, Walls::jump})
    for (const Walls second : {Walls::traction, Walls::jump}) {
      FineGeometry geometry{rectangle(-1, -1, 1, 1), {}};
      geometry.cracks.push_back({{{-1, 0}, {0, 0}, {1, 0}}, false, false, {first, first}});
      geometry.cracks.push_back({{{0, 1}, {0, 0}, {0, -1}}, false, false, {second, second}});
      const FineModel model(geometry, {.tip_size = 0.1, .far_size = 0.3}, table_1_rock);
      const auto sides = [&](int crack, int segment, double s) {
        const auto& points = geometry.cracks[crack].points;
        const Point x = points[segment] + s * (points[segment + 1] - points[segment]);
        const Point along = (points[segment + 1] - points[segment]).normalized(), normal(along.y(), -along.x());
        const Point middle = 0.5 * (points[segment] + points[segment + 1]);
        return std::tuple(x, normal, Point(middle - 0.1 * normal), Point(middle + 0.1 * normal));  // plus, minus
      };
      FineLoads loads;
      loads.boundary_displacement = [&](const Point& x, const Point& inside) { return blocks.displacement(x, inside); };
      loads.wall_traction = [&](int crack, int segment, double s) -> Point {
        const auto [x, normal, plus, minus] = sides(crack, segment, s);
        return blocks.stress(blocks.of(plus)) * normal;
      };
      loads.wall_jump = [&](int crack, int segment, double s) -> Point {
        const auto [x, normal, plus, minus] = sides(crack, segment, s);
        return blocks.displacement(x, minus) - blocks.displacement(x, plus);
      };
      loads.stress_offset = at_each_place([&](const Point& x) {
        const double p = blocks.alpha_p[blocks.of(x)];
        return Eigen::Vector3d(-p, -p, 0);
      });
      const FineSolution solution = model.solve(loads);
      double largest = 0;
      for (const FineMesh::Element& element : solution.mesh->elements) {
        const auto& n = element.nodes;
        const Point center = (solution.mesh->nodes[n[0]] + solution.mesh->nodes[n[1]] + solution.mesh->nodes[n[2]]) / 3;
        for (const int node : n)
          largest = std::max(largest, (solution.displacement.segment<2>(2 * node) -
                                       blocks.displacement(solution.mesh->nodes[node], center))
                                          .norm());
      }
      EXPECT_LT(largest, 1e-12 * blocks.shift[3].norm());
      // The recovered stress takes nothing from the other side of a wall.
      EXPECT_LT(estimate_error(model, solution).relative, 1e-10);
    }
}

TEST(Junction, RefinementToAToleranceFindsTheClosedForm) {
  FineGeometry geometry{rectangle(-60, -60, 60, 60), star(4, 0.2), std::vector(4, Side::traction)};
  const Adapted adapted = adapt(geometry, {.tip_size = 0.3, .far_size = 20}, table_1_rock, pressure_in(geometry, 1e6),
                                {.tolerance = 1e-2, .at_most = 5});
  ASSERT_TRUE(adapted.is_converged);
  EXPECT_GT(adapted.meshes, 1);
  const double K = star_factor(4) * 1e6 * std::sqrt(std::numbers::pi);
  EXPECT_LT(worst_error(adapted.solution, {K, 0}), 5e-4);
}

/// Fractures at random in a box of 2 m x 1 m, each of which begins on the one before, at a point inside of it, or
/// crosses it.
Mesh network(int seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  Geometry geometry = box(2, 1);
  const int count = 2 + seed % 4;
  for (int i = 0; i < count; ++i) {
    FractureGeometry& fracture = geometry.fractures.emplace_back();
    fracture.name = std::to_string(i);
    Point middle(uniform(0.6, 1.4), uniform(0.3, 0.7));
    double angle = uniform(0, std::numbers::pi);
    if (i > 0) {
      const auto& before = geometry.fractures[i - 1].points;
      middle = before[0] + uniform(0.2, 0.8) * (before[1] - before[0]);
      angle = std::atan2(before[1].y() - before[0].y(), before[1].x() - before[0].x()) + uniform(0.35, 2.8);
    }
    const Point along(std::cos(angle), std::sin(angle));
    const bool touches = i > 0 && uniform(0, 1) < 0.4;
    fracture.points = {middle - (touches ? 0 : uniform(0.05, 0.25)) * along, middle + uniform(0.05, 0.25) * along};
    for (Point& x : fracture.points) x = x.cwiseMax(Point(0.02, 0.02)).cwiseMin(Point(1.98, 0.98));
  }
  return generate_mesh(geometry, unstructured(0.08));
}

// Some of them have tips of others near by, whose rosettes are no part of the domain of an integral.
TEST(Junction, NetworksHoldALinearDisplacement) {
  Tensor gradient;
  gradient << 1e-4, -3e-4, 2e-4, 5e-5;
  const Tensor stress = table_1_rock.stress(gradient);
  std::size_t meetings = 0;
  for (const int seed : {2, 3, 9}) {
    const Mesh mesh = network(seed);
    std::vector<FracturePath> paths;
    for (int i = 0; i < static_cast<int>(mesh.fractures.size()); ++i) paths.push_back(fracture_path(mesh, i, {}, {}));
    for (int f = 0; f < static_cast<int>(paths.size()); ++f)
      for (const bool at_end : {false, true}) {
        if (!(at_end ? paths[f].last_is_tip : paths[f].first_is_tip)) continue;
        const Point center = at_end ? paths[f].points.back() : paths[f].points.front();
        for (const Walls walls : {Walls::traction, Walls::jump})
          for (const double size : {0.1, 0.3}) {
            const FineDomain domain = fine_domain(mesh, paths, {f, at_end}, center, size, 0.04, walls);
            meetings += junctions(domain.geometry).size();
            const FineModel model(domain.geometry, {.tip_size = 0.04, .far_size = 0.1}, table_1_rock,
                                  TipPlace{domain.crack, domain.is_last});
            FineLoads loads;
            loads.boundary_displacement = [&](const Point& x, const Point&) -> Point { return gradient * x; };
            loads.wall_traction = [&](int crack, int segment, double) -> Point {
              const auto& points = domain.geometry.cracks[crack].points;
              const Point along = (points[segment + 1] - points[segment]).normalized();
              return stress * Point(along.y(), -along.x());
            };
            const TipIntensities tip = model.solve(loads).tips.at(0);
            EXPECT_LT(tip.K.norm(), 1e-7 * stress.norm() * std::sqrt(0.1)) << seed << " " << f << " " << size;
          }
      }
  }
  EXPECT_GT(meetings, 100u);
}

// Geometries.

void expect_refused(const std::vector<CrackPath>& cracks, const std::string& why) {
  const FineGeometry geometry{rectangle(-1, -1, 1, 1), cracks};
  try {
    validate(geometry);
    ADD_FAILURE() << "not refused: " << why;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(Junction, CracksMeetInPointsOfBothOrAreRefused) {
  const auto one = Walls::traction;
  const CrackPath through{{{-0.5, 0}, {0, 0}, {0.5, 0}}, true, true, {one, one}};
  const FineGeometry good{rectangle(-1, -1, 1, 1), {through, {{{0, 0}, {0, 0.5}}, false, true, {one}}}};
  EXPECT_NO_THROW(validate(good));
  ASSERT_EQ(junctions(good).size(), 1u);
  EXPECT_EQ(junctions(good)[0].vertices.size(), 2u);
  expect_refused({through, {{{0.1, -0.5}, {0.1, 0.5}}, true, true, {one}}}, "meet");
  expect_refused({through, {{{0.1, 0}, {0.1, 0.5}}, false, true, {one}}}, "neither on the outline");
  expect_refused({through, {{{0, 0}, {0, 0.5}}, true, true, {one}}}, "a tip lies at another crack");
  // Along the same way from a point that they share.
  expect_refused({through, {{{0, 0}, {0.3, 0}}, false, true, {one}}}, "meet");
  // Through a second point of the other one that is no point of its own.
  expect_refused({through, {{{0, 0}, {0, 0.5}, {0.3, -0.5}}, false, true, {one, one}}}, "meet");
  // On the outline.
  expect_refused({{{{-1, 0}, {0, 0}}, false, true, {one}}, {{{-1, 0}, {0, 0.5}}, false, true, {one}}}, "inside");
}

}  // namespace
}  // namespace sprekk::test
