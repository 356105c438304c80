// Goal: the limits by which the discretization of the stress decides what is near a tip, and how strongly rotations are
// coupled, may be changed by factors of two and more without errors larger than those of the mesh. References: a crack
// in an infinite plate, and a rigid disc in one, by Muskhelishvili's potentials. Turned cracks and discs have other
// meshes.
#include "components/poromechanics/mpsa/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "tests/components/poromechanics/biot_step.hpp"
#include "tests/components/poromechanics/crack.hpp"

namespace sprekk::poromechanics {
namespace {

using Change = std::function<void(MpsaLimits&)>;

struct Case {
  const char* name;
  Change change;
};

MpsaLimits changed(const Change& change) {
  MpsaLimits limits;
  change(limits);
  return limits;
}

constexpr double lambda = 0.5;

/// Displacements of the walls of a crack, in rock whose stiffness changes by exp(grade x). Around it the rock is moved
/// as in even rock.
Vector displacements_of_walls(const Mesh& mesh, double angle, const MpsaLimits& limits, double grade = 0) {
  const test::Crack crack{angle, lambda};
  test::BiotStep step(mesh);
  step.time_step = 0;
  step.alpha = 0;
  step.storage = 1;
  step.mechanical_limits = limits;
  step.stiffness.assign(mesh.cell_count(), isotropic_stiffness(lambda, test::shear));
  for (int c = 0; c < mesh.cell_count(); ++c) step.stiffness[c] *= std::exp(grade * mesh.cell_center[c].x());
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!test::is_outer(mesh, f)) continue;
    step.flow_conditions[f] = matrix_flow::FlowCondition::flux;
    const bool is_wall = test::is_wall(mesh, f);
    const auto condition = is_wall ? MechanicalCondition::traction : MechanicalCondition::displacement;
    step.mechanical_conditions[f] = {condition, condition};
    step.mechanical_boundary.segment<2>(2 * f) =
        is_wall ? crack.wall_force(test::face_vector(mesh, f)) : test::mean_displacement(mesh, f, crack);
  }
  return test::BiotSystem(step).solve(step).walls;
}

/// The L2 error of the displacement of a crack's walls, relative, in even rock.
double error_of_walls(const Mesh& mesh, double angle, const MpsaLimits& limits) {
  const test::Crack crack{angle, lambda};
  const Point along(std::cos(angle), std::sin(angle));
  const Vector walls = displacements_of_walls(mesh, angle, limits);
  double error = 0, norm = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!test::is_wall(mesh, f)) continue;
    // On the line of the crack, and a little inside the rock: the potentials have their cut along the crack.
    const Point place = mesh.face_center[f].dot(along) * along - 1e-12 * mesh.face_normal[f];
    const Point exact = crack.displacement(place);
    error += mesh.face_measure[f] * (walls.segment<2>(2 * f) - exact).squaredNorm();
    norm += mesh.face_measure[f] * exact.squaredNorm();
  }
  return std::sqrt(error / norm);
}

TEST(MpsaLimits, WallsOfACrackHardlyDependOnThem) {
  const std::vector<Case> cases = {
      {"two layers", [](MpsaLimits& l) { l.zones.near.layers = 2; }},
      {"four layers", [](MpsaLimits& l) { l.zones.near.layers = 4; }},
      {"nearer to one end", [](MpsaLimits& l) { l.zones.near.clearly = 0.75; }},
      {"as near to both ends", [](MpsaLimits& l) { l.zones.near.clearly = 0.99; }},
      {"narrow zones", [](MpsaLimits& l) { l.zones.half_width /= 2; }},
      {"wide zones", [](MpsaLimits& l) { l.zones.half_width *= 2; }},
      {"sharp ends of zones", [](MpsaLimits& l) { l.zones.fading_part /= 3; }},
      {"smooth ends of zones", [](MpsaLimits& l) { l.zones.fading_part *= 3; }},
      {"sharp meeting of zones", [](MpsaLimits& l) { l.zones.joining_part /= 10; }},
      {"smooth meeting of zones", [](MpsaLimits& l) { l.zones.joining_part *= 10; }},
      {"fits that are worse", [](MpsaLimits& l) { l.well_posed /= 10; }},
      {"fits that are better", [](MpsaLimits& l) { l.well_posed *= 10; }},
      {"loose rotations", [](MpsaLimits& l) { l.rotation_strength /= 2; }},
      {"stiff rotations", [](MpsaLimits& l) { l.rotation_strength *= 2; }},
  };
  // No change adds more than the error of the mesh itself. Few cells, where the zones of both ends meet within some
  // edges, and many, where zones are narrower than long.
  struct Setting {
    double angle, size, bound;
  };
  for (const auto& [angle, size, bound] :
       {Setting{0.3, 0.5, 0.06}, Setting{1.2, 0.5, 0.06}, Setting{0.3, 0.2, 0.015}, Setting{1.2, 0.06, 0.015}}) {
    MeshOptions options = test::unstructured(2.2);
    options.fracture_size = size;
    options.growth = 0.5;
    const Mesh mesh = test::around_crack(angle, options);
    const double usual = error_of_walls(mesh, angle, {});
    EXPECT_LT(usual, bound) << "angle " << angle << ", size " << size;
    for (const auto& [name, change] : cases) {
      const double e = error_of_walls(mesh, angle, changed(change));
      EXPECT_LT(e, 2 * usual) << name << ", angle " << angle << ", size " << size;
    }
  }
}

// A crack that is straight up to 0.4 %: its zones may end at the bend or not. The jumps are those of a straight one up
// to the angle of the bend.
TEST(MpsaLimits, ACrackThatIsNearlyStraightHardlyDependsOnThem) {
  for (const double angle : {0.3, 1.2})
    for (const double size : {0.2, 0.1}) {
      Geometry geometry = test::box(16, 16);
      geometry.box.low = Point(-8, -8);
      geometry.box.high = Point(8, 8);
      FractureGeometry crack;
      crack.name = "crack";
      const Point end(std::cos(angle), std::sin(angle)), aside(-end.y(), end.x());
      crack.points = {-end, 0.4 * end + 0.0024 * aside, end};
      geometry.fractures = {crack};
      MeshOptions options = test::unstructured(2.2);
      options.fracture_size = size;
      options.growth = 0.5;
      const Mesh mesh = generate_mesh(geometry, options);
      const double usual = error_of_walls(mesh, angle, {});
      EXPECT_LT(usual, 0.03) << "angle " << angle << ", size " << size;
      for (const double off_line : {1e-5, 1e-4, 1e-2, 1e-1, 1.0}) {
        MpsaLimits limits;
        limits.zones.off_line = off_line;
        const double e = error_of_walls(mesh, angle, limits);
        EXPECT_LT(e, 1.25 * usual) << off_line << ", angle " << angle << ", size " << size;
      }
    }
}

/// The volume of a crack, and its moment along the x axis.
Point volume_of_crack(const Mesh& mesh, const Vector& walls) {
  Point sums = Point::Zero();
  for (int f = 0; f < mesh.face_count(); ++f)
    if (test::is_wall(mesh, f))
      sums +=
          mesh.face_measure[f] * walls.segment<2>(2 * f).dot(mesh.face_normal[f]) * Point(1, mesh.face_center[f].x());
  return sums;
}

// How much rock around a tip may vary if the field there is to be corrected as in homogeneous rock. Reference: a mesh
// with cells of a fifth. Measured: with more errors are the same or smaller, down to 0.17 times; with less the field at
// a tip is not corrected, and they are up to 5.5 times as large, but no larger than without any correction.
TEST(MpsaLimits, RockThatChangesAroundTipsMayBeTakenForEvenOrNot) {
  const double angle = 0.3;
  const auto around = [&](double size) {
    MeshOptions options = test::unstructured(2.2);
    options.fracture_size = size;
    options.growth = 0.3;
    return test::around_crack(angle, options);
  };
  const Mesh fine = around(0.04), coarse = around(0.2);
  for (const auto& [grade, bound] : {std::pair(0.3, 0.02), {1.0, 0.03}, {3.0, 0.2}}) {
    const Point exact = volume_of_crack(fine, displacements_of_walls(fine, angle, {}, grade));
    const auto error = [&](double alike) {
      MpsaLimits limits;
      limits.alike = alike;
      const Point volume = volume_of_crack(coarse, displacements_of_walls(coarse, angle, limits, grade));
      return (volume - exact).norm() / exact.norm();
    };
    const double usual = error(MpsaLimits().alike), uncorrected = error(0);
    EXPECT_LT(usual, bound) << grade;
    EXPECT_LT(error(0.4), 1.1 * usual) << grade;
    EXPECT_LT(error(0.8), 1.1 * usual) << grade;
    EXPECT_LT(error(0.1), 1.1 * uncorrected) << grade;
    EXPECT_LT(error(0.1), 8 * usual) << grade;
  }
}

/// A rigid disc that is bonded to rock under pure shear, from 2 G u = kappa phi − z conj(phi') − conj(psi) = 0 at its
/// edge: phi = a/z, psi = −z + a R^2/z^3, a = −R^2/kappa. For G = 1/2, and unit shear.
struct Disc {
  static constexpr double radius = 1, lambda = 0.5, shear = 0.5;

  Point displacement(const Point& x) const {
    using test::Complex;
    const Complex z(x[0], x[1]);
    if (std::abs(z) <= radius) return Point::Zero();
    const double kappa = 3 - 2 * lambda / (lambda + shear), a = -radius * radius / kappa;
    const Complex u = kappa * a / z + z * std::conj(a / (z * z)) - std::conj(-z + a * radius * radius / (z * z * z));
    return {u.real(), u.imag()};
  }
};

/// The L2 error of displacements, relative, with cells as stiff as `contrast` in the disc.
double error_of_disc(const Mesh& mesh, double contrast, const MpsaLimits& limits) {
  const Disc disc;
  test::BiotStep step(mesh);
  step.time_step = 0;
  step.alpha = 0;
  step.storage = 1;
  step.mechanical_limits = limits;
  step.stiffness.assign(mesh.cell_count(), isotropic_stiffness(Disc::lambda, Disc::shear));
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (mesh.cell_center[c].norm() < Disc::radius) step.stiffness[c] *= contrast;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!test::is_outer(mesh, f)) continue;
    step.flow_conditions[f] = matrix_flow::FlowCondition::flux;
    step.mechanical_conditions[f] = {MechanicalCondition::displacement, MechanicalCondition::displacement};
    step.mechanical_boundary.segment<2>(2 * f) = disc.displacement(mesh.face_center[f]);
  }
  const Vector u = test::BiotSystem(step).solve(step).displacement;
  double error = 0, norm = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Point exact = disc.displacement(mesh.cell_center[c]);
    error += mesh.cell_measure[c] * (u.segment<2>(2 * c) - exact).squaredNorm();
    norm += mesh.cell_measure[c] * exact.squaredNorm();
  }
  return std::sqrt(error / norm);
}

TEST(MpsaLimits, AStiffDiscInSoftRockHardlyDependsOnThem) {
  Geometry geometry = test::box(4, 4);
  geometry.box.low = Point(-2, -2);
  geometry.box.high = Point(2, 2);
  const Mesh mesh = generate_mesh(geometry, test::unstructured(0.15, 0.2));
  for (const double contrast : {1e7, 1e12}) {
    const double usual = error_of_disc(mesh, contrast, {});
    EXPECT_LT(usual, 0.1) << contrast;
    for (const double factor : {0.1, 0.3, 3.0, 10.0}) {
      MpsaLimits held, turns;
      held.held_by_soft *= factor;
      turns.turns_freely *= factor * factor;
      const double a = error_of_disc(mesh, contrast, held), b = error_of_disc(mesh, contrast, turns);
      EXPECT_LT(a, 1.1 * usual) << contrast << ", held " << factor;
      EXPECT_LT(b, 1.1 * usual) << contrast << ", turns " << factor;
    }
  }
}

}  // namespace
}  // namespace sprekk::poromechanics
