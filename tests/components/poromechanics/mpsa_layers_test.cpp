// Layers of different rock, stress and load: uniform fields in each are exact, whatever the angle and the contrast.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "tests/components/layers.hpp"
#include "tests/components/poromechanics/exact_values.hpp"

namespace sprekk::poromechanics {
namespace {

using test::anisotropic_stiffness;
using test::compare;
using test::Comparison;
using test::is_outer;
using test::linear_gradient;
using test::mixed_conditions;

/// Layers, `contrast` times as stiff below y = 1/2 as above, under a uniform strain along them and a uniform stress
/// across them; s jumps too.
class MpsaLayers : public testing::TestWithParam<double> {};

TEST_P(MpsaLayers, AreExact) {
  const double contrast = GetParam(), lambda = 1.2, shear = 0.7;
  const Mesh mesh = test::two_layers();
  const auto is_lower = [&](int c) { return mesh.cell_center[c][1] < 0.5; };
  std::vector<Stiffness> stiffness(mesh.cell_count(), isotropic_stiffness(lambda, shear));
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (is_lower(c)) stiffness[c] *= contrast;

  // Across: (lambda + 2 G) e_yy - s = 1 in the layer of unit stiffness; s is 0.3 below.
  const double s_lower = 0.3, s_upper = -0.2;
  const double lower_strain = (1 + s_lower) / (contrast * (lambda + 2 * shear));
  const double upper_strain = (1 + s_upper) / (lambda + 2 * shear);
  const auto strain = [&](bool lower_side) { return lower_side ? lower_strain : upper_strain; };
  const auto errors = compare(
      mesh, stiffness, mixed_conditions(mesh),
      [&](const Point& x) { return Point(0, strain(x[1] < 0.5) * (x[1] - 0.5)); },
      [&](int c) { return (Tensor() << 0, 0, 0, strain(is_lower(c))).finished(); },
      [&](int c) { return is_lower(c) ? s_lower : s_upper; });
  EXPECT_LT(errors.force, 1e-12);
  EXPECT_LT(errors.trace, 1e-12 * std::max(1.0, 1 / contrast));
  EXPECT_LT(errors.volume, 1e-13 * std::max(1.0, 1 / contrast));
}

INSTANTIATE_TEST_SUITE_P(Contrasts, MpsaLayers, testing::Values(1e-10, 1e-3, 1e3, 1e10));

/// Layers of very different stiffness, inclined, in simple shear: each keeps its own strain, up to the contrast.
TEST(Mpsa, ShearedLayersKeepTheirStrains) {
  const double contrast = 1e10, slope = 0.4;
  const Point along = Point(1, slope).normalized(), across(-along[1], along[0]), middle(0.5, 0.5);
  Geometry geometry = test::box(1, 1);
  RegionGeometry lower;
  lower.name = "lower";
  lower.polygon = {Point(0, 0), Point(1, 0), Point(1, 0.5 + slope / 2), Point(0, 0.5 - slope / 2)};
  geometry.regions = {lower};
  const Mesh mesh = generate_mesh(geometry, test::unstructured(0.09));
  const auto shear_modulus = [&](const Point& x) { return across.dot(x - middle) < 0 ? contrast : 1; };
  std::vector<Stiffness> stiffness;
  for (const Point& center : mesh.cell_center) {
    const double shear = shear_modulus(center);
    stiffness.push_back(isotropic_stiffness(shear, shear));
  }
  const auto errors = compare(
      mesh, stiffness, mixed_conditions(mesh),
      [&](const Point& x) -> Point { return along * across.dot(x - middle) / shear_modulus(x); },
      [&](int c) -> Tensor { return along * across.transpose() / shear_modulus(mesh.cell_center[c]); },
      [](int) { return 0.0; });
  EXPECT_LT(errors.force, 1 / contrast);
  EXPECT_LT(errors.trace, 1e-12);
  EXPECT_LT(errors.volume, 1e-13);
}

/// Two layers in contact along a line through the middle of the unit square, each with a uniform gradient, stress s and
/// stiffness of its own, and a load on the line.
struct Layers {
  Point along, across;
  Stiffness stiffness[2];
  Tensor gradient[2];
  double isotropic_stress[2] = {0.3, -0.9};
  bool is_loaded = false;

  Point middle() const { return {0.5, 0.5}; }
  int at(const Point& x) const { return across.dot(x - middle()) < 0 ? 0 : 1; }
  Point displacement(const Point& x) const { return Point(0.1, -0.2) + gradient[at(x)] * (x - middle()); }

  /// The gradient on one side is given; on the other it differs by a ⊗ n, so that the tractions agree, or differ by
  /// `load`.
  Layers(double angle, const Stiffness& lower, const Stiffness& upper, const Point& load)
      : along(std::cos(angle), std::sin(angle)), across(-along[1], along[0]), stiffness{lower, upper} {
    is_loaded = !load.isZero(0);
    const bool is_upper_stiff = upper.trace() > lower.trace();
    const int given = is_upper_stiff ? 0 : 1, found = 1 - given;
    gradient[given] = linear_gradient;
    const double jump = isotropic_stress[found] - isotropic_stress[given];
    // traction(found) − traction(given) on the normal `across` = ± load
    const Point missing = traction(stiffness[given], linear_gradient) - traction(stiffness[found], linear_gradient) +
                          jump * across + (found == 1 ? -1 : 1) * load;
    Tensor acoustic;
    for (int i = 0; i < 2; ++i) acoustic.col(i) = traction(stiffness[found], Point::Unit(i) * across.transpose());
    gradient[found] = linear_gradient + acoustic.inverse() * missing * across.transpose();
  }
  Point traction(const Stiffness& c, const Tensor& g) const {
    const Eigen::Vector3d sigma = c * Eigen::Vector3d(g(0, 0), g(1, 1), g(0, 1) + g(1, 0));
    return {sigma[0] * across[0] + sigma[2] * across[1], sigma[2] * across[0] + sigma[1] * across[1]};
  }

  Mesh mesh(const MeshOptions& options) const {
    Geometry geometry = test::box(1, 1);
    // The square below the line: its corners, and where the line leaves it.
    RegionGeometry lower;
    lower.name = "lower";
    const std::vector<Point> corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < 4; ++i) {
      const Point &a = corners[i], &b = corners[(i + 1) % 4];
      const double from = across.dot(a - middle()), to = across.dot(b - middle());
      if (from < 0) lower.polygon.push_back(a);
      if (from * to < 0) lower.polygon.push_back(a + from / (from - to) * (b - a));
    }
    geometry.regions = {lower};
    return generate_mesh(geometry, options);
  }

  Comparison compare_on(const Mesh& mesh) const {
    const auto of_cell = [&](int c) { return at(mesh.cell_center[c]); };
    std::vector<Stiffness> rock;
    for (int c = 0; c < mesh.cell_count(); ++c) rock.push_back(stiffness[of_cell(c)]);
    std::vector<FaceConditions> conditions = mixed_conditions(mesh);
    if (is_loaded)
      for (int f = 0; f < mesh.face_count(); ++f)
        if (!is_outer(mesh, f) && of_cell(mesh.face_cells[f][0]) != of_cell(mesh.face_cells[f][1]))
          conditions[f] = {MechanicalCondition::load, MechanicalCondition::load};
    return compare(
        mesh, rock, conditions, [&](const Point& x) { return displacement(x); },
        [&](int c) { return gradient[of_cell(c)]; }, [&](int c) { return isotropic_stress[of_cell(c)]; });
  }
};

constexpr double layer_angles[] = {0, 1e-6, 0.3, 0.7, 1.1, std::numbers::pi / 2, 2.2};

/// s alone jumps: the gradient does by a multiple of n ⊗ n.
TEST(MpsaInclinedLayers, AJumpOfPressureIsExact) {
  for (const double angle : layer_angles)
    for (const Stiffness& c : {isotropic_stiffness(1.4, 0.8), anisotropic_stiffness()}) {
      const Layers layers(angle, c, c, Point::Zero());
      for (const MeshOptions& options : {test::unstructured(0.12, 0.3), test::mixed(0.12, 0.2)}) {
        const Comparison errors = layers.compare_on(layers.mesh(options));
        EXPECT_LT(errors.force, 1e-12) << angle;
        EXPECT_LT(errors.trace, 1e-12) << angle;
        EXPECT_LT(errors.volume, 1e-13) << angle;
      }
    }
}

/// Layers are sheared, stretched and turned, s jumps, and there is a load on the line between them.
TEST(MpsaInclinedLayers, AnyContrastIsExact) {
  for (const double angle : layer_angles)
    for (const double contrast : {1 + 1e-9, 0.5, 3.0, 1e-3, 1e4, 1e10})
      for (const Point& load : {Point(0, 0), Point(0.4, -0.7)})
        for (const Stiffness& c : {isotropic_stiffness(0.2, 0.9), anisotropic_stiffness()}) {
          const Layers layers(angle, isotropic_stiffness(1.4, 0.8), contrast * c, load);
          for (const MeshOptions& options : {test::unstructured(0.25, 0.3), test::mixed(0.25, 0.2)}) {
            const Comparison errors = layers.compare_on(layers.mesh(options));
            // Relative to the terms of the stress along the layers.
            const double softest = std::max(1.0, 1 / contrast), stiffest = std::max(1.0, contrast);
            EXPECT_LT(errors.force, 1e-12 * stiffest) << "angle " << angle << ", contrast " << contrast;
            EXPECT_LT(errors.trace, 1e-12 * softest) << "angle " << angle << ", contrast " << contrast;
            EXPECT_LT(errors.volume, 1e-12 * softest) << "angle " << angle << ", contrast " << contrast;
          }
        }
}

}  // namespace
}  // namespace sprekk::poromechanics
