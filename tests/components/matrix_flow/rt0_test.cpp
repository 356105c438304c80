#include "components/matrix_flow/rt0/rt0.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "components/matrix_flow/rt0/flux_mass.hpp"
#include "components/matrix_flow/rt0/tip_terms.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "tests/components/matrix_flow/flow_set_ups.hpp"

namespace sprekk::matrix_flow {
namespace {

using test::is_lower;
using test::is_outer;
using test::mixed_conditions;
using OfPoint = std::function<double(const Point&)>;

/// With the pressures at the centres of cells and faces, and the fluxes of faces, of an exact solution: all operators
/// give the same fluxes and traces, and the equations of the faces hold.
void expect_exact(const Mesh& mesh, const std::vector<Tensor>& mobility, const OfPoint& pressure,
                  const std::function<double(int)>& flux, double tolerance, double share = 0) {
  const auto conditions = mixed_conditions(mesh);
  const FluxOperators operators =
      discretize_rt0_for_short_steps(mesh, mobility, conditions, std::vector<double>(mesh.cell_count(), share));
  Vector p(mesh.cell_count()), h(mesh.face_count()), b = Vector::Zero(mesh.face_count());
  for (int c = 0; c < mesh.cell_count(); ++c) p[c] = pressure(mesh.cell_center[c]);
  for (int f = 0; f < mesh.face_count(); ++f) {
    h[f] = pressure(mesh.face_center[f]);
    if (conditions[f] == FlowCondition::pressure) b[f] = h[f];
    if (conditions[f] == FlowCondition::flux) b[f] = flux(f);
  }
  const Vector fluxes = operators.flux_cell * p + operators.faces.flux * h + operators.flux_boundary * b;
  const Vector traces = operators.trace_cell * p + operators.faces.trace * h + operators.trace_boundary * b;
  const Vector errors = operators.faces.continuity_cell * p + operators.faces.continuity_face * h +
                        operators.faces.continuity_boundary * b;
  const double largest = h.lpNorm<Eigen::Infinity>();
  for (int f = 0; f < mesh.face_count(); ++f) {
    EXPECT_NEAR(fluxes[f], flux(f), tolerance) << "face at " << mesh.face_center[f].transpose();
    EXPECT_NEAR(traces[f], is_outer(mesh, f) ? h[f] : 0, tolerance * std::max(1.0, largest));
    EXPECT_NEAR(errors[f], 0, tolerance * std::max(1.0, operators.faces.continuity_face.coeff(f, f) * largest));
  }
}

std::vector<Mesh> meshes() {
  std::vector<Mesh> all = test::various_meshes();
  all.push_back(generate_mesh(test::box(2, 1), test::rectangles(7, 5, 0.4)));
  return all;
}

TEST(Rt0, IsExactForLinearPressuresInAnisotropicRock) {
  Tensor mobility;
  mobility << 3, 1.2, 1.2, 0.7;
  const Point gradient(1.3, -0.4);
  for (const double share : {0.0, 0.6, 1.0})
    for (const Mesh& mesh : meshes())
      expect_exact(
          mesh, std::vector<Tensor>(mesh.cell_count(), mobility), [&](const Point& x) { return 2 + gradient.dot(x); },
          [&](int f) { return -test::face_vector(mesh, f).dot(mobility * gradient); }, 1e-11, share);
}

/// Layers of mobility k below and 1 above y = 1/2. The pressure y / k has the flux (0, -1).
TEST(Rt0, IsExactAcrossLayers) {
  const Mesh mesh = test::two_layers();
  for (const double contrast : {1e-10, 1e-3, 1e3, 1e10}) {
    expect_exact(
        mesh, test::mobility_of_layers(mesh, contrast),
        [&](const Point& x) { return is_lower(x) ? (x[1] - 0.5) / contrast : x[1] - 0.5; },
        [&](int f) { return -test::face_vector(mesh, f)[1]; }, 1e-11);
  }
}

TEST(Rt0, PrescribedFluxesAreKeptToTheLastDigit) {
  for (const Mesh& mesh : meshes()) {
    const auto conditions = mixed_conditions(mesh);
    const auto operators = discretize_rt0(mesh, std::vector<Tensor>(mesh.cell_count(), Tensor::Identity()), conditions);
    const Vector p = Vector::Random(mesh.cell_count()), b = Vector::Random(mesh.face_count());
    const Vector fluxes = operators.flux_cell * p + operators.faces.flux * Vector::Random(mesh.face_count()) +
                          operators.flux_boundary * b;
    for (int f = 0; f < mesh.face_count(); ++f)
      if (conditions[f] == FlowCondition::flux) {
        EXPECT_EQ(fluxes[f], b[f]);
      }
  }
}

/// A mesh of one cell.
Mesh mesh_of(const std::vector<Point>& corners) {
  RawMesh raw;
  raw.nodes = corners;
  const int count = static_cast<int>(corners.size());
  raw.cells = {count == 3 ? Ring(0, 1, 2) : Ring(0, 1, 2, 3)};
  raw.regions = {0};
  raw.region_names = {"rock"};
  raw.side_names = {"around"};
  for (int k = 0; k < count; ++k) raw.boundary_faces.push_back({{k, (k + 1) % count}, 0});
  return build_mesh(raw);
}

TEST(FluxMass, OfTheUnitSquareAndOfARightTriangleIsThatOfTheTextbook) {
  // v = (x, 0) and so on: 1/3 on the diagonal, and −1/6 between opposite faces.
  const FluxMass square =
      flux_mass(mesh_of({Point(0, 0), Point(1, 0), Point(1, 1), Point(0, 1)}), 0, Tensor::Identity());
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(square(i, j), i == j ? 1.0 / 3 : (i + j) % 2 == 0 ? -1.0 / 6 : 0, 1e-15);
  // v_i = x − (opposite corner): the integrals over the triangle (0,0), (1,0), (0,1).
  const Mesh mesh = mesh_of({Point(0, 0), Point(1, 0), Point(0, 1)});
  const FluxMass triangle = flux_mass(mesh, 0, 2 * Tensor::Identity());
  const auto face_at = [&](const Point& x) {
    for (int k = 0; k < 3; ++k)
      if ((mesh.face_center[mesh.cell_faces[0][k]] - x).norm() < 1e-12) return k;
    return -1;
  };
  const int hypotenuse = face_at(Point(0.5, 0.5)), left = face_at(Point(0, 0.5)), bottom = face_at(Point(0.5, 0));
  EXPECT_NEAR(2 * triangle(hypotenuse, hypotenuse), 1.0 / 6, 1e-15);
  EXPECT_NEAR(2 * triangle(left, left), 1.0 / 3, 1e-15);
  EXPECT_NEAR(2 * triangle(bottom, bottom), 1.0 / 3, 1e-15);
  EXPECT_NEAR(2 * triangle(left, bottom), -1.0 / 6, 1e-15);
  EXPECT_NEAR(2 * triangle(left, hypotenuse), 0, 1e-15);
}

TEST(FluxMass, TurnsWithTheCellAndIsPositiveDefinite) {
  Tensor mobility;
  mobility << 3, 1.2, 1.2, 0.7;
  for (const std::vector<Point>& corners : {std::vector<Point>{{0, 0}, {1, 0.1}, {0.2, 0.7}},
                                            {{0, 0}, {1, 0.2}, {1.4, 1.1}, {0.4, 0.9}},
                                            {{0, 0}, {1, -0.3}, {1.6, 1.3}, {0.1, 0.5}},
                                            {{0, 0}, {1, 0}, {0.51, 0.51}, {0, 1}}}) {
    const FluxMass mass = flux_mass(mesh_of(corners), 0, mobility);
    EXPECT_LT((mass - mass.transpose()).norm(), 1e-14 * mass.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(mass).eigenvalues()[0], 1e-3 * mass.norm());
    for (const double angle : {0.3, 1.9, 4.0}) {
      const Tensor turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
      std::vector<Point> turned;
      for (const Point& x : corners) turned.push_back(turn * x);
      EXPECT_LT((flux_mass(mesh_of(turned), 0, turn * mobility * turn.transpose()) - mass).norm(), 1e-13 * mass.norm());
    }
  }
}

TEST(FluxMass, OfAParallelogramStaysWhenItIsBentByRoundOff) {
  Tensor mobility;
  mobility << 3, 1.2, 1.2, 0.7;
  const auto of_corner = [&](double bend) {
    return flux_mass(mesh_of({Point(0, 0), Point(1, 0.2), Point(1.4 + bend, 1.1), Point(0.4, 0.9)}), 0, mobility);
  };
  EXPECT_LT((of_corner(1e-9) - of_corner(0)).norm(), 1e-8 * of_corner(0).norm());
  EXPECT_GT((of_corner(0.1) - of_corner(0)).norm(), 1e-3 * of_corner(0).norm());
}

TEST(LumpedFluxMass, OfAnAcuteTriangleIsTheCotangentsAndExactFromTheCircumcentre) {
  Tensor mobility;
  mobility << 3, 1.2, 1.2, 0.7;
  // Half the cotangent of 60 degrees.
  const auto equilateral =
      lumped_flux_mass(mesh_of({Point(0, 0), Point(1, 0), Point(0.5, std::sqrt(0.75))}), 0, 2 * Tensor::Identity());
  EXPECT_EQ(equilateral.share, 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(equilateral.mass(i, j), i == j ? 0.25 / std::sqrt(3.0) : 0, 1e-15);
  // Of constant velocities, drops are those from one point to the faces, whatever the tensor and the share.
  for (const std::vector<Point>& corners :
       {std::vector<Point>{{0, 0}, {1, 0.1}, {0.4, 0.9}}, {{0, 0}, {3, 0}, {1.6, 1}}, {{0, 0}, {3, 0}, {2.9, 0.3}}}) {
    const Mesh mesh = mesh_of(corners);
    const LumpedFluxMass lumped = lumped_flux_mass(mesh, 0, mobility);
    Eigen::Matrix<double, 3, 2> fluxes, drops;
    for (int k = 0; k < 3; ++k) {
      fluxes.row(k) = (mobility * test::face_vector(mesh, mesh.cell_faces[0][k])).transpose();
      drops.row(k) = (mesh.face_center[mesh.cell_faces[0][k]] - mesh.cell_center[0]).transpose();
    }
    const Eigen::Matrix<double, 3, 2> offset = lumped.mass * fluxes - drops;
    for (int k = 1; k < 3; ++k) EXPECT_LT((offset.row(k) - offset.row(0)).norm(), 1e-13);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(lumped.mass).eigenvalues()[0], 0);
  }
  // An obtuse triangle stays as it is, also the right one.
  for (const Point& apex : {Point(0.5, 0.1), Point(0.5, 0.5)}) {
    const Mesh mesh = mesh_of({Point(0, 0), Point(1, 0), apex});
    const LumpedFluxMass lumped = lumped_flux_mass(mesh, 0, Tensor::Identity());
    EXPECT_LT(lumped.share, 1e-13);
    EXPECT_LT((lumped.mass - flux_mass(mesh, 0, Tensor::Identity())).norm(), 1e-12);
  }
}

// By the smallest cotangent: wholly from 0.1 on, not at all from a right angle on, and in proportion between.
TEST(LumpedFluxMass, GoesOverToTheOtherBeforeARightAngle) {
  for (const double cotangent : {0.02, 0.05, 0.08, 0.098, 0.102, 0.2, 0.5}) {
    const Point apex(0.5, 0.5 / std::tan(std::atan2(1, cotangent) / 2));
    for (const double scale : {1.0, 1e-3}) {
      const Mesh mesh = mesh_of({Point(0, 0), Point(scale, 0), scale * apex});
      EXPECT_NEAR(lumped_flux_mass(mesh, 0, 1e-12 * Tensor::Identity()).share, std::min(1.0, cotangent / 0.1), 1e-12)
          << cotangent;
    }
  }
}

/// The largest entry off the diagonal of the matrix that is left for the pressures of faces when the flow and the
/// balance of a cell are eliminated in a step with this dt/(S V), over the largest on it.
double largest_off_diagonal(const Mesh& mesh, const Tensor& mobility, double step) {
  const MassForShortSteps more = mass_for_short_steps(mesh, 0, mobility);
  Eigen::MatrixXd mass = flux_mass(mesh, 0, mobility) + share_for(step, more.until) * more.added;
  mass.array() += step;
  Eigen::MatrixXd inverse = mass.inverse();
  const double scale = inverse.diagonal().maxCoeff();
  inverse.diagonal().setConstant(-scale);
  return inverse.maxCoeff() / scale;
}

TEST(MassForShortSteps, LeavesNoPositiveEntryInAcuteTriangles) {
  const Mesh equilateral = mesh_of({Point(0, 0), Point(1, 0), Point(0.5, std::sqrt(0.75))});
  const MassForShortSteps more = mass_for_short_steps(equilateral, 0, 2 * Tensor::Identity());
  const FluxMass lumped = lumped_flux_mass(equilateral, 0, 2 * Tensor::Identity()).mass;
  EXPECT_LT((flux_mass(equilateral, 0, 2 * Tensor::Identity()) + more.added - lumped).norm(), 1e-14);
  // dt/(S V) for a step of the 48th part of the side squared over the diffusivity k/S.
  EXPECT_NEAR(more.until, 1 / (48 * 2 * equilateral.cell_measure[0]), 1e-14);
  Tensor mobility;
  mobility << 3, 0.4, 0.4, 2;
  for (const Mesh& mesh : {equilateral, mesh_of({Point(0, 0), Point(1, 0.1), Point(0.4, 0.9)}),
                           mesh_of({Point(0, 0), Point(1, 0.3), Point(0.3, 0.9)})}) {
    const double until = mass_for_short_steps(mesh, 0, mobility).until;
    for (const double step : {0.0, 0.3, 0.9, 1.0, 1.1, 30.0})
      EXPECT_LT(largest_off_diagonal(mesh, mobility, step * until), 1e-13) << step;
    Eigen::MatrixXd exact = flux_mass(mesh, 0, mobility).inverse();
    exact.diagonal().setZero();
    EXPECT_GT(exact.maxCoeff(), 0.01 * mobility.trace());
  }
}

/// The resistance is at most three times that of all faces together, and steady flow does not notice it.
TEST(MassForShortSteps, IsBoundedFromARightAngleOnAndLeavesSteadyFluxes) {
  for (const double degrees : {60.0, 70.0, 85.0, 89.0, 90.0, 91.0, 120.0, 170.0}) {
    const double half = degrees * std::numbers::pi / 360;
    const Mesh mesh = mesh_of({Point(0, 0), Point(1, 0), Point(0.5, 0.5 / std::tan(half))});
    const MassForShortSteps more = mass_for_short_steps(mesh, 0, Tensor::Identity());
    const double all = flux_mass(mesh, 0, Tensor::Identity()).inverse().sum();
    EXPECT_LE(more.until * all, 3 + 1e-12) << degrees;
    EXPECT_EQ(more.until * all > 3 - 1e-9, degrees > 80) << degrees;
    EXPECT_LT((more.added * Eigen::Vector3d(1, 2, -3)).norm(), 1e-14) << degrees;
  }
}

TEST(MassForShortSteps, OfASquareIsTheLumpedOneUntilASixthOfItsDiffusionTime) {
  const Mesh square = mesh_of({Point(0, 0), Point(2, 0), Point(2, 2), Point(0, 2)});
  const MassForShortSteps more = mass_for_short_steps(square, 0, 5 * Tensor::Identity());
  const FluxMass lumped = lumped_flux_mass(square, 0, 5 * Tensor::Identity()).mass;
  EXPECT_LT((flux_mass(square, 0, 5 * Tensor::Identity()) + more.added - lumped).norm(), 1e-14);
  EXPECT_NEAR(more.until, 1 / (6 * 5.0), 1e-14);  // dt/(S V) for dt = S V/(6 k)
  EXPECT_EQ(share_for(more.until, more.until), 0);
  EXPECT_NEAR(share_for(more.until / 4, more.until), 0.75, 1e-14);
}

TEST(Rt0, LumpedOnRectanglesIsTheTwoPointFlux) {
  const Mesh mesh = generate_mesh(test::box(2, 1), test::rectangles(7, 5));
  Tensor mobility;
  mobility << 3, 0, 0, 0.2;
  const std::vector<Tensor> all(mesh.cell_count(), mobility);
  const auto conditions = mixed_conditions(mesh);
  const FluxOperators lumped = discretize_lumped_rt0(mesh, all, conditions);
  const FluxOperators two_point = discretize_tpfa(mesh, all, conditions);
  const Vector p = Vector::Random(mesh.cell_count()), b = Vector::Random(mesh.face_count());
  const Eigen::SparseMatrix<double> faces = lumped.faces.continuity_face;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(faces);
  const Vector h = factors.solve(Vector(-(lumped.faces.continuity_cell * p + lumped.faces.continuity_boundary * b)));
  const Vector fluxes = lumped.flux_cell * p + lumped.faces.flux * h + lumped.flux_boundary * b;
  EXPECT_LT((fluxes - two_point.flux_cell * p - two_point.flux_boundary * b).lpNorm<Eigen::Infinity>(), 1e-12);
}

/// A fracture from the left to the middle of a square: the pressures Re sqrt z and Im sqrt z, with z from its tip, and
/// their conjugate functions Im sqrt z and −Re sqrt z.
TEST(Rt0, IsExactForTheSingularFlowAroundATip) {
  for (const double angle : {0.0, 0.7, 2.0}) {
    Geometry geometry = test::box(1, 1);
    FractureGeometry fracture;
    fracture.name = "inside";
    const Point tip(0.5, 0.5), ahead(std::cos(angle), std::sin(angle));
    fracture.points = {tip - 0.35 * ahead, tip};
    geometry.fractures = {fracture};
    const Mesh mesh = generate_mesh(geometry, test::unstructured(0.05));
    const std::vector<Tensor> mobility(mesh.cell_count(), 2 * Tensor::Identity());
    std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
    std::vector<FluxMass> masses;
    for (int f = 0; f < mesh.face_count(); ++f)
      if (is_outer(mesh, f)) conditions[f] = FlowCondition::flux;
    for (int c = 0; c < mesh.cell_count(); ++c) masses.push_back(flux_mass(mesh, c, mobility[c]));
    const TipTerms terms(mesh, mobility, conditions, masses);
    const auto root = [&](const Point& x, int cell) {  // continuous in the cell
      const auto local = [&](const Point& at) {
        return std::complex<double>((at - tip).dot(ahead), (at - tip).dot(Point(-ahead.y(), ahead.x())));
      };
      std::complex<double> z = local(x);
      const bool is_behind = std::abs(z.imag()) < 1e-9 && z.real() < 0;
      if (is_behind) z = {z.real(), std::copysign(0.0, local(mesh.cell_center[cell]).imag())};
      return std::sqrt(z);
    };
    for (const int mode : {0, 1}) {
      const std::complex<double> turn = mode == 0 ? std::complex<double>(1, 0) : std::complex<double>(0, -1);
      const auto pressure = [&](const Point& x, int cell) { return (turn * root(x, cell)).real(); };
      const auto flux = [&](int f) {
        const auto& [from, to] = mesh.face_nodes[f];
        const int cell = mesh.face_cells[f][0];
        return 2 * ((turn * root(mesh.nodes[from], cell)).imag() - (turn * root(mesh.nodes[to], cell)).imag());
      };
      Vector p(mesh.cell_count()), h(mesh.face_count()), b = Vector::Zero(mesh.face_count());
      for (int c = 0; c < mesh.cell_count(); ++c) p[c] = pressure(mesh.cell_center[c], c);
      for (int f = 0; f < mesh.face_count(); ++f) {
        h[f] = pressure(mesh.face_center[f], mesh.face_cells[f][0]);
        if (is_outer(mesh, f)) b[f] = flux(f);
      }
      const FluxOperators operators = discretize_rt0(mesh, mobility, conditions);
      const Vector fluxes = operators.flux_cell * p + operators.faces.flux * h + operators.flux_boundary * b;
      const Vector traces = operators.trace_cell * p + operators.faces.trace * h + operators.trace_boundary * b;
      int exact = 0;
      for (int f = 0; f < mesh.face_count(); ++f) {
        const auto [cell, other] = mesh.face_cells[f];
        const TipTerm* const term = terms.of(cell);
        if (!term || (other != none && !terms.of(other)) || (term->flow->frame().origin() - tip).norm() > 1e-9)
          continue;
        ++exact;
        EXPECT_NEAR(fluxes[f], flux(f), 1e-11) << mesh.face_center[f].transpose();
        if (other == none) {
          EXPECT_NEAR(traces[f], h[f], 1e-11);
        }
      }
      EXPECT_GT(exact, 20);
    }
  }
}

TEST(Rt0, RefusesConditionsThatDoNotFitTheMesh) {
  const Mesh mesh = test::square_with_single_corners(2);
  const std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
  EXPECT_THROW(discretize_rt0(mesh, {}, mixed_conditions(mesh)), std::invalid_argument);
  EXPECT_THROW(discretize_rt0(mesh, mobility, {}), std::invalid_argument);
  const std::vector<Tensor> zero(mesh.cell_count(), Tensor::Zero());
  EXPECT_THROW(discretize_rt0(mesh, zero, mixed_conditions(mesh)), std::runtime_error);
  EXPECT_THROW(discretize_lumped_rt0(mesh, zero, mixed_conditions(mesh)), std::runtime_error);
}

}  // namespace
}  // namespace sprekk::matrix_flow
