#include "components/poromechanics/mpsa/plane/tip_field.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <utility>

#include "framework/dense/svd.hpp"

namespace sprekk::poromechanics {
namespace {

using Complex = std::complex<double>;

constexpr int linear_terms = 6;

double order(int term) { return term < 2 ? 0.5 : 1.5; }
/// a of phi = a z^o.
Complex amplitude(int term) { return term % 2 == 0 ? Complex(0.5, 0) : Complex(0, -0.5); }

}  // namespace

bool is_isotropic(const Stiffness& c) {
  constexpr double rounding = 1e-9;  // relative difference of given components with which rock is isotropic
  const double near = rounding * c(0, 0);
  return std::abs(c(0, 0) - c(1, 1)) < near && std::abs(c(0, 2)) < near && std::abs(c(1, 2)) < near &&
         std::abs(c(0, 0) - c(0, 1) - 2 * c(2, 2)) < near;
}

bool resembles(const Stiffness& rock, const Stiffness& other, double alike) {
  return (rock - other).lpNorm<Eigen::Infinity>() <= alike * other.lpNorm<Eigen::Infinity>();
}

std::optional<TipField> TipField::find(const Mesh& mesh, int tip, std::span<const int> cells,
                                       const std::vector<Stiffness>& stiffness, const MpsaLimits& limits) {
  const auto at_tip = mesh.node_cells[tip];
  Stiffness rock = Stiffness::Zero();
  for (const int cell : at_tip) rock += stiffness[cell] / static_cast<double>(at_tip.size());
  for (const int cell : at_tip)
    if (!resembles(stiffness[cell], rock, limits.alike)) return std::nullopt;
  if (!is_isotropic(rock)) return std::nullopt;
  std::vector<int> of_fit;
  std::ranges::copy_if(cells, std::back_inserter(of_fit),
                       [&](int cell) { return resembles(stiffness[cell], rock, limits.alike); });
  TipField field(mesh, tip, std::move(of_fit), rock);
  for (const int count : {terms, terms / 2})
    if (field.fit(mesh, count, limits.well_posed)) return field;
  return std::nullopt;
}

TipField::TipField(const Mesh& mesh, int tip, std::vector<int> cells, const Stiffness& rock)
    : tip_(tip),
      cells_(std::move(cells)),
      rock_(rock),
      shear_(rock(2, 2)),
      poisson_(0.5 * rock(0, 1) / (rock(0, 1) + rock(2, 2))),
      frame_(mesh, tip) {}

bool TipField::fit(const Mesh& mesh, int count_of_terms, double well_posed) {
  const int count = static_cast<int>(cells_.size()), all = linear_terms + count_of_terms;
  if (2 * count < all + 2) return false;
  const double size = frame_.size();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(2 * count, all);
  Amounts unit;
  for (int k = 0; k < terms; ++k) unit[k] = std::pow(size, order(k));
  for (int k = 0; k < count; ++k) {
    const Point& center = mesh.cell_center[cells_[k]];
    const Eigen::RowVector3d linear(1, (center.x() - frame_.origin().x()) / size,
                                    (center.y() - frame_.origin().y()) / size);
    basis.block<1, 3>(2 * k, 0) = basis.block<1, 3>(2 * k + 1, 3) = linear;
    const Modes modes = displacement(center, frame_.side_of_cell(mesh, cells_[k]));
    basis.block(2 * k, linear_terms, 2, count_of_terms) =
        (modes.array().rowwise() / unit.array()).leftCols(count_of_terms).matrix();
  }
  const DenseSvd svd(basis, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (svd.singularValues()[all - 1] < well_posed * svd.singularValues()[0]) return false;
  const Eigen::MatrixXd inverse = svd.solve(Eigen::MatrixXd::Identity(2 * count, 2 * count));
  share_.setZero(terms, 2 * count);
  for (int k = 0; k < count_of_terms; ++k) share_.row(k) = inverse.row(linear_terms + k) / unit[k];
  return true;
}

TipField::Modes TipField::displacement(const Point& x, int side) const {
  const auto [radius, angle] = frame_.polar(x, side);
  const double kolosov = 3 - 4 * poisson_;
  Modes modes;
  for (int k = 0; k < terms; ++k) {
    const double o = order(k);
    const Complex a = amplitude(k), power = std::polar(std::pow(radius, o), o * angle);
    // z conj(phi') = o conj(a) conj(z^o) z / conj(z)
    const Complex u = kolosov * a * power - o * std::conj(a * power) * std::polar(1.0, 2 * angle) -
                      std::conj((std::conj(a) - o * a) * power);
    modes.col(k) << u.real(), u.imag();
  }
  return frame_.axes() * modes;
}

TipField::Modes TipField::force(const Point& x, int side) const {
  const auto [radius, angle] = frame_.polar(x, side);
  Modes modes;
  for (int k = 0; k < terms; ++k) {
    const double o = order(k);
    const Complex a = amplitude(k), power = std::polar(std::pow(radius, o), o * angle);
    const Complex f = Complex(0, 1) * (a * power + o * std::conj(a * power) * std::polar(1.0, 2 * angle) +
                                       std::conj((std::conj(a) - o * a) * power));
    modes.col(k) << f.real(), f.imag();
  }
  return 2 * shear_ * (frame_.axes() * modes);
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

TipField::Amounts TipField::volume_change(const std::array<Point, 4>& corners, int side) const {
  // div u = (1 - 2 nu) 4 Re phi', and the integral of phi' is i/2 times that of phi along the boundary, d conj z.
  std::array<std::array<Complex, terms>, 4> primitive;  // of z^o
  for (int i = 0; i < 4; ++i) {
    const auto [radius, angle] = frame_.polar(corners[i], side);
    for (int k = 0; k < terms; ++k) {
      const double next = order(k) + 1;
      primitive[i][k] = std::polar(std::pow(radius, next) / next, next * angle);
    }
  }
  Amounts sum = Amounts::Zero();
  double area = 0;
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    const Point &a = corners[i], &b = corners[j];
    const Point edge = frame_.axes().transpose() * (b - a);
    const Complex step(edge.x(), edge.y());
    for (int k = 0; k < terms; ++k)
      sum[k] += (amplitude(k) * Complex(0, 1) * std::conj(step) / step * (primitive[j][k] - primitive[i][k])).real();
    area += a.x() * b.y() - a.y() * b.x();
  }
  return 2 * (1 - 2 * poisson_) * (area < 0 ? -1 : 1) * sum;
}

}  // namespace sprekk::poromechanics
