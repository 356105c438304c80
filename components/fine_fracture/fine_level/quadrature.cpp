#include "components/fine_fracture/fine_level/quadrature.hpp"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "framework/dense/symmetric_eigen.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {
namespace {

/// Golub and Welsch 1969: nodes are the eigenvalues of the Jacobi matrix of the Legendre polynomials.
std::vector<LinePoint> gauss_legendre(int n) {
  SPREKK_EXPECT(n > 0, n);
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int i = 1; i < n; ++i) jacobi(i, i - 1) = jacobi(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
  const SymmetricEigen eigen = symmetric_eigen(jacobi);
  std::vector<LinePoint> rule;
  for (int i = 0; i < n; ++i) {
    rule.push_back({0.5 * (1 + eigen.values[i]), std::pow(eigen.vectors(0, i), 2)});
  }
  return rule;
}

/// The three points that permute the barycentric coordinates (a, a, 1 - 2a). Weights are relative to the area.
void add_three(std::vector<TrianglePoint>& rule, double a, double weight) {
  SPREKK_EXPECT(a > 0 && a < 0.5, a, weight);
  for (const auto& [xi, eta] : {std::array{a, a}, std::array{a, 1 - 2 * a}, std::array{1 - 2 * a, a}}) {
    rule.push_back({xi, eta, 0.5 * weight});
  }
}

void add_six(std::vector<TrianglePoint>& rule, double a, double b, double weight) {
  const double c = 1 - a - b;
  for (const auto& [xi, eta] :
       {std::array{a, b}, std::array{b, a}, std::array{a, c}, std::array{c, a}, std::array{b, c}, std::array{c, b}}) {
    rule.push_back({xi, eta, 0.5 * weight});
  }
}

std::vector<TrianglePoint> dunavant(int degree) {
  std::vector<TrianglePoint> rule;
  if (degree == 2) {
    add_three(rule, 1.0 / 6, 1.0 / 3);
  } else if (degree == 4) {
    add_three(rule, 0.445948490915965, 0.223381589678011);
    add_three(rule, 0.091576213509771, 0.109951743655322);
  } else if (degree == 5) {
    const double root = std::sqrt(15.0);
    rule.push_back({1.0 / 3, 1.0 / 3, 0.5 * 9 / 40});
    add_three(rule, (6 - root) / 21, (155 - root) / 1200);
    add_three(rule, (6 + root) / 21, (155 + root) / 1200);
  } else if (degree == 6) {
    add_three(rule, 0.249286745170910, 0.116786275726379);
    add_three(rule, 0.063089014491502, 0.050844906370207);
    add_six(rule, 0.053145049844817, 0.310352451033784, 0.082851075618374);
  } else {
    throw std::invalid_argument("there is no triangle rule of degree " + std::to_string(degree));
  }
  return rule;
}

}  // namespace

const std::vector<LinePoint>& line_rule(int n) {
  static thread_local std::map<int, std::vector<LinePoint>> rules;
  auto& rule = rules[n];
  if (rule.empty()) rule = gauss_legendre(n);
  return rule;
}

const std::vector<TrianglePoint>& triangle_rule(int degree) {
  static thread_local std::map<int, std::vector<TrianglePoint>> rules;
  auto& rule = rules[degree];
  if (rule.empty()) rule = dunavant(degree);
  return rule;
}

const std::vector<TrianglePoint>& polar_rule(int along, int across) {
  SPREKK_EXPECT(along > 0 && across > 0, along, across);
  static thread_local std::map<std::pair<int, int>, std::vector<TrianglePoint>> rules;
  auto& rule = rules[{along, across}];
  if (rule.empty()) {
    for (const LinePoint& a : line_rule(along)) {
      for (const LinePoint& b : line_rule(across)) {
        rule.push_back({a.t * (1 - b.t), a.t * b.t, a.weight * b.weight * a.t});
      }
    }
  }
  return rule;
}

}  // namespace sprekk::fine_fracture
