#include <array>
#include <cmath>
#include <complex>
#include <span>

#include "components/matrix_flow/mpfa/tip_flow.hpp"

namespace sprekk::matrix_flow {
namespace {

using Complex = std::complex<double>;

/// The flux through a polygon whose corners turn counter-clockwise as seen from where it flows to. With the stream
/// function s of the plane across the rim, and t along the rim, grad p = curl (s t): the flux is minus the circulation
/// of s t. With z linear along an edge, the mean of sqrt(z) is 2/3 (a^2 + a b + b^2)/(a + b), with a, b at its ends.
TipFlow::Modes through(const EndFrame& frame, const Tensor& axes, std::span<const Point> corners, int side) {
  std::array<Complex, 4> roots;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [radius, angle] = frame.polar(corners[k], side, axes);
    roots[k] = std::polar(std::sqrt(radius), 0.5 * angle);
  }
  TipFlow::Modes flux = TipFlow::Modes::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t next = k + 1 == corners.size() ? 0 : k + 1;
    const Complex a = roots[k], b = roots[next];
    if (a == 0.0 && b == 0.0) continue;
    const Complex mean = 2.0 / 3 * (a * a + a * b + b * b) / (a + b);
    flux -= axes.col(2).dot(corners[next] - corners[k]) * TipFlow::Modes(mean.imag(), -mean.real());
  }
  return flux;
}

}  // namespace

TipFlow::Modes TipFlow::flux(const Mesh& mesh, int face, int side) const {
  const FaceNodes& nodes = mesh.face_nodes[face];
  std::array<Point, 4> corners;
  for (int k = 0; k < nodes.size(); ++k) corners[k] = mesh.nodes[nodes[k]];
  return through(frame_, frame_.axes_near(mesh.face_center[face]), {corners.data(), std::size_t(nodes.size())}, side);
}

TipFlow::Modes TipFlow::flux_at_node(const Mesh& mesh, int face, int node, int side) const {
  const FaceNodes& nodes = mesh.face_nodes[face];
  Point mean = Point::Zero();
  int at = 0;
  for (int k = 0; k < nodes.size(); ++k) {
    mean += mesh.nodes[nodes[k]] / nodes.size();
    if (nodes[k] == node) at = k;
  }
  const auto middle_to = [&](int other) { return Point(0.5 * (mesh.nodes[node] + mesh.nodes[other])); };
  const std::array<Point, 4> corners = {mesh.nodes[node], middle_to(nodes.after(at)), mean,
                                        middle_to(nodes.before(at))};
  return through(frame_, frame_.axes_near(mesh.face_center[face]), corners, side);
}

}  // namespace sprekk::matrix_flow
