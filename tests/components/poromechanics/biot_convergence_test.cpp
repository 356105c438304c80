// Goal: the order of convergence of MPFA and MPSA together, and errors that do not exceed those of PorePy.
// Reference: the manufactured solution of Nordbotten 2016, sec. 5: unit square, lambda = G = k/mu = 1, alpha = 0.5,
// S = 0.12, one backward-Euler step of 1 from rest, Dirichlet data; p = x(1-x) sin 2 pi y, u = (p, sin 2 pi x sin 2 pi
// y).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "framework/mesh/cell_mean.hpp"
#include "tests/components/poromechanics/biot_step.hpp"

namespace sprekk {
namespace {

constexpr double two_pi = 2 * std::numbers::pi, alpha = 0.5, storage = 0.12;

struct Exact {
  double p, px, py, v;
  Tensor gradient;  ///< of u
  Point body_force;
  double fluid_source;

  explicit Exact(const Point& at) {
    const double x = at[0], y = at[1], hat = x * (1 - x);
    const double sx = std::sin(two_pi * x), cx = std::cos(two_pi * x);
    const double sy = std::sin(two_pi * y), cy = std::cos(two_pi * y);
    const double k2 = two_pi * two_pi;
    p = hat * sy, px = (1 - 2 * x) * sy, py = hat * two_pi * cy;
    const double pxx = -2 * sy, pyy = -k2 * p, pxy = (1 - 2 * x) * two_pi * cy;
    v = sx * sy;
    const double vx = two_pi * cx * sy, vy = two_pi * sx * cy, vxx = -k2 * v, vyy = -k2 * v, vxy = k2 * cx * cy;
    gradient << px, py, vx, vy;
    // div sigma = G lap u + (lambda + G) grad div u - alpha grad p, balanced by the body force.
    body_force[0] = -(pxx + pyy + 2 * (pxx + vxy) - alpha * px);
    body_force[1] = -(vxx + vyy + 2 * (pxy + vyy) - alpha * py);
    fluid_source = storage * p + alpha * (px + vy) - (pxx + pyy);
  }
  Point displacement() const { return {p, v}; }
  Point force(const Point& face) const {
    const double pressure_part = gradient.trace() - alpha * p;  // lambda = 1
    return (gradient + gradient.transpose()) * face + pressure_part * face;
  }
  double flux(const Point& face) const { return -Point(px, py).dot(face); }
};

struct Errors {
  int cells;
  double pressure, displacement, flux, force;
};

/// The mean over a face by Gauss' rule with two points.
template <typename Function>
auto face_mean(const Mesh& mesh, int face, const Function& value) {
  const auto& ends = mesh.face_nodes[face];
  const Point arm = (mesh.nodes[ends[1]] - mesh.nodes[ends[0]]) / std::sqrt(12);
  using Value = decltype(value(Exact(arm)));
  return Value((value(Exact(mesh.face_center[face] - arm)) + value(Exact(mesh.face_center[face] + arm))) / 2);
}

/// Relative L2 errors. Values in cells, at their centres, are weighted with the cells' areas; fluxes and forces,
/// integrated over faces, with the areas of the triangles between a face and its neighbours' centres (Nordbotten and
/// Keilegavlen, two-point stress approximation, Eq. A1.12), as PorePy does.
Errors solve(const Mesh& mesh, const poromechanics::MpsaLimits& limits = {}) {
  using poromechanics::MechanicalCondition;
  test::BiotStep step(mesh);
  step.alpha = alpha;
  step.mechanical_limits = limits;
  step.storage = storage;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!test::is_outer(mesh, f)) continue;
    step.flow_conditions[f] = matrix_flow::FlowCondition::pressure;
    step.mechanical_conditions[f] = {MechanicalCondition::displacement, MechanicalCondition::displacement};
    const Exact exact(mesh.face_center[f]);
    step.flow_boundary[f] = exact.p;
    step.flow_change[f] = Exact(mesh.nodes[mesh.face_nodes[f][1]]).p - Exact(mesh.nodes[mesh.face_nodes[f][0]]).p;
    step.mechanical_boundary.segment<2>(2 * f) = exact.displacement();
  }
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto force = [](const Point& at) { return Exact(at).body_force; };
    const auto source = [](const Point& at) { return Exact(at).fluid_source; };
    step.force.segment<2>(2 * c) = mesh.cell_measure[c] * cell_mean(mesh, c, force);
    step.source[c] = mesh.cell_measure[c] * cell_mean(mesh, c, source);
  }
  const auto state = test::BiotSystem(step).solve(step);

  double p = 0, p_norm = 0, u = 0, u_norm = 0, flux = 0, flux_norm = 0, force = 0, force_norm = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Exact exact(mesh.cell_center[c]);
    const double area = mesh.cell_measure[c];
    p += area * std::pow(state.pressure[c] - exact.p, 2);
    p_norm += area * std::pow(exact.p, 2);
    u += area * (state.displacement.segment<2>(2 * c) - exact.displacement()).squaredNorm();
    u_norm += area * exact.displacement().squaredNorm();
  }
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Point face = test::face_vector(mesh, f);
    const double exact_flux = face_mean(mesh, f, [&](const Exact& exact) { return exact.flux(face); });
    const Point exact_force = face_mean(mesh, f, [&](const Exact& exact) { return exact.force(face); });
    double area = 0;
    for (const int c : mesh.face_cells[f])
      if (c != none) area += 0.5 * std::abs(face.dot(mesh.face_center[f] - mesh.cell_center[c]));
    flux += area * std::pow(state.fluxes[f] - exact_flux, 2);
    flux_norm += area * std::pow(exact_flux, 2);
    force += area * (state.forces.segment<2>(2 * f) - exact_force).squaredNorm();
    force_norm += area * exact_force.squaredNorm();
  }
  return {mesh.cell_count(), std::sqrt(p / p_norm), std::sqrt(u / u_norm), std::sqrt(flux / flux_norm),
          std::sqrt(force / force_norm)};
}

double order(double coarse, double fine, const Errors& a, const Errors& b) {
  return std::log(coarse / fine) / (0.5 * std::log(static_cast<double>(b.cells) / a.cells));
}

// PorePy 1.3, unstructured triangles: cells, then the errors of pressure, displacement, flux and traction.
const std::vector<Errors> porepy = {{248, 2.05e-2, 3.58e-2, 1.46e-2, 3.33e-2},
                                    {944, 5.56e-3, 9.51e-3, 4.64e-3, 1.13e-2},
                                    {3712, 1.41e-3, 2.37e-3, 1.53e-3, 3.99e-3},
                                    {14788, 3.53e-4, 5.97e-4, 5.27e-4, 1.44e-3}};

void print(const Errors& e) {
  std::printf("%6d cells: p %.2e, u %.2e, flux %.2e, traction %.2e\n", e.cells, e.pressure, e.displacement, e.flux,
              e.force);
}

void expect_orders(const Errors& coarse, const Errors& fine) {
  EXPECT_GT(order(coarse.pressure, fine.pressure, coarse, fine), 1.9);
  EXPECT_GT(order(coarse.displacement, fine.displacement, coarse, fine), 1.9);
  EXPECT_GT(order(coarse.flux, fine.flux, coarse, fine), 0.9);
  EXPECT_GT(order(coarse.force, fine.force, coarse, fine), 0.9);
}

/// The mean over meshes of about one size, each scaled to `cells` with the order that is measured below.
Errors mean_near(double size, int cells) {
  Errors mean{cells, 0, 0, 0, 0};
  for (const double factor : {0.99, 1., 1.01}) {
    const Errors e = solve(generate_mesh(test::box(1, 1), test::unstructured(factor * size)));
    const double part = static_cast<double>(e.cells) / cells;
    mean.pressure += e.pressure * part / 3;
    mean.displacement += e.displacement * part / 3;
    mean.flux += e.flux * std::pow(part, 0.75) / 3;
    mean.force += e.force * std::pow(part, 0.75) / 3;
  }
  return mean;
}

TEST(BiotConvergence, OrdersAndErrorsOnUnstructuredTriangles) {
  std::vector<Errors> errors;
  const std::vector<double> sizes = {0.1, 0.05, 0.025, 0.0125};
  for (const double size : sizes) errors.push_back(solve(generate_mesh(test::box(1, 1), test::unstructured(size))));
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Errors& e = errors[i];
    print(e);
    // Forces scatter by 10 % from mesh to mesh: over seven meshes of 14,412 to 15,382 cells they are 0.84 to 1.008
    // times the last reference, scaled to their size, 0.90 in the mean; the mesh here is the worst of them.
    EXPECT_LT(e.force, 1.01 * porepy[i].force);
    const Errors near = mean_near(sizes[i], porepy[i].cells);
    // Third points on sides keep flow from gaining energy, and halve the error of fluxes (0.8 to 1 times PorePy's with
    // the middle of sides). For that pressures are a tenth worse on the coarsest mesh, a twentieth on the finest.
    EXPECT_LT(near.pressure, (i == 0 ? 0.66 : 0.645) * porepy[i].pressure);
    EXPECT_LT(near.displacement, 0.75 * porepy[i].displacement);
    EXPECT_LT(near.flux, 0.56 * porepy[i].flux);
    EXPECT_LT(near.force, porepy[i].force);
    if (i > 0) expect_orders(errors[i - 1], e);
  }
}

/// No more cells than PorePy has triangles.
TEST(BiotConvergence, ErrorsOnSquaresAreNoLargerThanOnTriangles) {
  const std::vector<int> columns = {15, 30, 60, 121};
  std::vector<Errors> errors;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    errors.push_back(solve(generate_mesh(test::box(1, 1), test::rectangles(columns[i], columns[i]))));
    const Errors& e = errors[i];
    print(e);
    ASSERT_LE(e.cells, porepy[i].cells);
    EXPECT_LT(e.pressure, porepy[i].pressure);
    EXPECT_LT(e.displacement, porepy[i].displacement);
    EXPECT_LT(e.flux, porepy[i].flux);
    EXPECT_LT(e.force, porepy[i].force);
    if (i > 0) expect_orders(errors[i - 1], e);
  }
}

TEST(BiotConvergence, OrdersOnDistortedQuadrilaterals) {
  for (const auto& meshes :
       {std::vector{test::rectangles(16, 16, 0.25), test::rectangles(32, 32, 0.25), test::rectangles(64, 64, 0.25)},
        std::vector{test::mixed(0.06), test::mixed(0.03), test::mixed(0.015)}}) {
    std::vector<Errors> errors;
    for (const MeshOptions& options : meshes) {
      errors.push_back(solve(generate_mesh(test::box(1, 1), options)));
      print(errors.back());
      if (errors.size() > 1) expect_orders(errors[errors.size() - 2], errors.back());
    }
  }
}

TEST(BiotConvergence, OrdersOnDistortedTriangles) {
  std::vector<Errors> errors;
  for (const int n : {16, 32, 64})
    errors.push_back(solve(generate_mesh(test::box(1, 1), test::structured(n, n, 0.25))));
  for (std::size_t i = 1; i < errors.size(); ++i) expect_orders(errors[i - 1], errors[i]);
}

/// How strongly rotations are coupled, and how much volume subcells exchange, matters less than the mesh.
/// Forces are those that notice most: up to 28 % with rotations that are coupled twice as strongly.
TEST(BiotConvergence, ErrorsHardlyDependOnStrengths) {
  for (const MeshOptions& options : {test::unstructured(0.05, 0.3), test::rectangles(20, 20, 0.3)}) {
    const Mesh mesh = generate_mesh(test::box(1, 1), options);
    const Errors usual = solve(mesh);
    for (const double factor : {0.5, 2.0}) {
      poromechanics::MpsaLimits rotations, exchange;
      rotations.rotation_strength *= factor;
      exchange.exchange *= factor;
      for (const poromechanics::MpsaLimits& limits : {rotations, exchange}) {
        const Errors errors = solve(mesh, limits);
        EXPECT_LT(errors.pressure, 1.3 * usual.pressure) << factor;
        EXPECT_LT(errors.displacement, 1.3 * usual.displacement) << factor;
        EXPECT_LT(errors.flux, 1.3 * usual.flux) << factor;
        EXPECT_LT(errors.force, 1.3 * usual.force) << factor;
      }
    }
  }
}

}  // namespace
}  // namespace sprekk
