#include <cmath>

#include "components/matrix_flow/mpfa/tip_flow.hpp"

namespace sprekk::matrix_flow {
namespace {

/// The stream function: the flux through any line from the tip to x, to the left of the line, for a mobility of
/// 1 m^2/(Pa s), m^2/s.
TipFlow::Modes stream(const EndFrame& frame, const Point& x, int side) {
  const auto [radius, angle] = frame.polar(x, side);
  return std::sqrt(radius) * TipFlow::Modes(std::sin(0.5 * angle), -std::cos(0.5 * angle));
}

TipFlow::Modes through(const EndFrame& frame, const Mesh& mesh, int face, const Point& from, const Point& to,
                       int side) {
  const TipFlow::Modes to_left = stream(frame, to, side) - stream(frame, from, side);
  const Point along = to - from;
  return Point(-along.y(), along.x()).dot(mesh.face_normal[face]) > 0 ? to_left : TipFlow::Modes(-to_left);
}

}  // namespace

TipFlow::Modes TipFlow::flux(const Mesh& mesh, int face, int side) const {
  const auto& [a, b] = mesh.face_nodes[face];
  return through(frame_, mesh, face, mesh.nodes[a], mesh.nodes[b], side);
}

TipFlow::Modes TipFlow::flux_at_node(const Mesh& mesh, int face, int node, int side) const {
  return through(frame_, mesh, face, mesh.nodes[node], mesh.face_center[face], side);
}

}  // namespace sprekk::matrix_flow
