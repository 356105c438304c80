#include "components/poromechanics/mpsa/tip_field.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <complex>

namespace sprekk::poromechanics {
namespace {

constexpr int linear_terms = 6, terms = linear_terms + 2;
/// Of the fit's smallest singular value to its largest; below, fields and linear displacements are too alike.
constexpr double well_posed = 1e-3;

bool is_isotropic(const Stiffness& c) {
  const double near = 1e-9 * c(0, 0);
  return std::abs(c(0, 0) - c(1, 1)) < near && std::abs(c(0, 2)) < near && std::abs(c(1, 2)) < near &&
         std::abs(c(0, 0) - c(0, 1) - 2 * c(2, 2)) < near;
}

}  // namespace

bool resembles(const Stiffness& rock, const Stiffness& other) {
  return (rock - other).lpNorm<Eigen::Infinity>() <= 0.2 * other.lpNorm<Eigen::Infinity>();
}

std::optional<TipField> TipField::find(const Mesh& mesh, int tip, const std::vector<Stiffness>& stiffness) {
  const auto cells = mesh.node_cells[tip];
  if (2 * cells.size() < terms + 2) return std::nullopt;
  Stiffness rock = Stiffness::Zero();
  for (const int cell : cells) rock += stiffness[cell] / static_cast<double>(cells.size());
  for (const int cell : cells)
    if (!resembles(stiffness[cell], rock)) return std::nullopt;
  if (!is_isotropic(rock)) return std::nullopt;
  TipField field(mesh, tip, rock);
  if (!field.fit(mesh)) return std::nullopt;
  return field;
}

TipField::TipField(const Mesh& mesh, int tip, const Stiffness& rock)
    : cells_(mesh.node_cells[tip]),
      rock_(rock),
      shear_(rock(2, 2)),
      poisson_(0.5 * rock(0, 1) / (rock(0, 1) + rock(2, 2))),
      frame_(mesh, tip) {}

bool TipField::fit(const Mesh& mesh) {
  const int count = static_cast<int>(cells_.size());
  const double size = frame_.size();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(2 * count, terms);
  for (int k = 0; k < count; ++k) {
    const Point& center = mesh.cell_center[cells_[k]];
    const Eigen::RowVector3d linear(1, (center.x() - frame_.tip().x()) / size, (center.y() - frame_.tip().y()) / size);
    basis.block<1, 3>(2 * k, 0) = basis.block<1, 3>(2 * k + 1, 3) = linear;
    basis.block<2, 2>(2 * k, linear_terms) = displacement(center, 0) / std::sqrt(size);
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(basis, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (svd.singularValues()[terms - 1] < well_posed * svd.singularValues()[0]) return false;
  const Eigen::MatrixXd inverse = svd.solve(Eigen::MatrixXd::Identity(2 * count, 2 * count));
  share_ = inverse.bottomRows<2>() / std::sqrt(size);
  return true;
}

TipField::Modes TipField::displacement(const Point& x, int side) const {
  const auto [radius, angle] = frame_.polar(x, side);
  const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle), kolosov = 3 - 4 * poisson_;
  Modes modes;
  modes << c * (kolosov - 1 + 2 * s * s), s * (kolosov + 1 + 2 * c * c),  //
      s * (kolosov + 1 - 2 * c * c), -c * (kolosov - 1 - 2 * s * s);
  return std::sqrt(radius) * (frame_.axes() * modes);
}

TipField::Modes TipField::force(const Point& x, int side) const {
  const auto [radius, angle] = frame_.polar(x, side);
  const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
  const double c3 = std::cos(1.5 * angle), s3 = std::sin(1.5 * angle);
  const Point n(-std::sin(angle), std::cos(angle));
  // Stress times sqrt(r) / (2 G), integrated along the ray from the tip.
  Modes modes;
  modes.col(0) = Point(c * (1 - s * s3) * n.x() + c * s * c3 * n.y(), c * s * c3 * n.x() + c * (1 + s * s3) * n.y());
  modes.col(1) =
      Point(-s * (2 + c * c3) * n.x() + c * (1 - s * s3) * n.y(), c * (1 - s * s3) * n.x() + s * c * c3 * n.y());
  return 4 * shear_ * std::sqrt(radius) * (frame_.axes() * modes);
}

TipField::Modes TipField::integrated_force(const Point& a, const Point& b, int side) const {
  // Gauss's rule for x = a + s^2 (b - a), in which sqrt(r) is smooth for a tip at a: exact there. Elsewhere r is at
  // least half the length, and the error some 1e-7.
  constexpr double place[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  Modes sum = Modes::Zero();
  for (int i = 0; i < 4; ++i)
    for (const int sign : {-1, 1}) {
      const double s = 0.5 * (1 + sign * place[i]);
      sum += weight[i] * s * force(a + s * s * (b - a), side);
    }
  return (b - a).norm() * sum;
}

Eigen::RowVector2d TipField::volume_change(const std::array<Point, 4>& corners, int side) const {
  // div u = 2 (1 - 2 nu) (Re, Im) 1/sqrt(z), and the integral of f' is i/2 times that of f along the boundary, d conj
  // z.
  using Complex = std::complex<double>;
  const auto primitive = [&](const Point& x) {  // of sqrt(z)
    const auto [radius, angle] = frame_.polar(x, side);
    return std::polar(2.0 / 3 * std::pow(radius, 1.5), 1.5 * angle);
  };
  Complex integral = 0;
  double area = 0;
  for (int i = 0; i < 4; ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % 4];
    const Point edge = frame_.axes().transpose() * (b - a);
    const Complex step(edge.x(), edge.y());
    integral += Complex(0, 1) * std::conj(step) / step * (primitive(b) - primitive(a));
    area += a.x() * b.y() - a.y() * b.x();
  }
  const double factor = 2 * (1 - 2 * poisson_) * (area < 0 ? -1 : 1);
  return factor * Eigen::RowVector2d(integral.real(), integral.imag());
}

}  // namespace sprekk::poromechanics
