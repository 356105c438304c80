#include "components/poromechanics/fem/face_functions.hpp"

#include <array>
#include <cmath>

#include "components/poromechanics/fem/gauss_points.hpp"

namespace sprekk::poromechanics {

namespace {

constexpr double mean_of_own = 2.0 / 3;  // wherever the middle node is

/// The means of the functions of both ends.
std::array<double, 2> means_of_ends(const Mesh& mesh, const std::vector<int>& tips, int face) {
  const int tip = tips.empty() ? none : tips[face];
  if (tip == none) return {1.0 / 2, 1.0 / 2};
  // At the part s of the face from the tip the functions are 1 − sqrt(s) and sqrt(s).
  if (mesh.face_nodes[face][0] == tip) return {1.0 / 3, 2.0 / 3};
  return {2.0 / 3, 1.0 / 3};
}

}  // namespace

std::vector<FaceFunction> face_functions(const RawDisplacement& raw, const std::vector<int>& tips, int face) {
  const std::array<double, 2> means = means_of_ends(raw.mesh, tips, face);
  const Point normal = raw.mesh.face_measure[face] * raw.mesh.face_normal[face];
  std::vector<FaceFunction> functions;
  for (int end = 0; end < 2; ++end)
    functions.push_back({raw.of_node(raw.mesh.face_nodes[face][end]), means[end], means[end] * normal});
  functions.push_back({raw.of_face(face), mean_of_own, mean_of_own * normal});
  return functions;
}

std::vector<FacePoint> face_points(const RawDisplacement& raw, int face) {
  const Mesh& mesh = raw.mesh;
  const auto& [from, to] = mesh.face_nodes[face];
  std::vector<FacePoint> points;
  for (const auto& [at, weight] : gauss_points())
    points.push_back({(1 - at) * mesh.nodes[from] + at * mesh.nodes[to],
                      weight * mesh.face_measure[face],
                      mesh.face_normal[face],
                      {1 - at, at, 4 * at * (1 - at)}});
  return points;
}

Point middle_of_face(const RawDisplacement& raw, int face) { return raw.mesh.face_center[face]; }

std::vector<int> edges_of_face(const RawDisplacement& /*raw*/, int /*face*/) { return {}; }

double edge_in_middle(const Mesh& /*mesh*/, int /*face*/) { return 0; }

Point displacement_of_middle(const RawDisplacement& raw, const std::vector<int>& tips, const Vector& coefficients,
                             int face) {
  // The function of the second end in the centre; from a tip on it is the root of the part of the way.
  const int tip = tips[face];
  const auto& [from, to] = raw.mesh.face_nodes[face];
  const double share = tip == none ? 0.5 : tip == from ? std::sqrt(0.5) : 1 - std::sqrt(0.5);
  return (1 - share) * coefficients.segment<dimension>(raw.of_node(from)) +
         share * coefficients.segment<dimension>(raw.of_node(to)) +
         4 * share * (1 - share) * coefficients.segment<dimension>(raw.of_face(face));
}

Tensor mean_gradient(const RawDisplacement& raw, const std::vector<int>& tips, const Vector& coefficients, int cell) {
  const Mesh& mesh = raw.mesh;
  Tensor gradient = Tensor::Zero();
  for (const int face : mesh.cell_faces[cell]) {
    Point mean = mean_of_own * coefficients.segment<dimension>(raw.of_face(face));
    const std::array<double, 2> means = means_of_ends(mesh, tips, face);
    for (int end = 0; end < 2; ++end)
      mean += means[end] * coefficients.segment<dimension>(raw.of_node(mesh.face_nodes[face][end]));
    const double out = mesh.face_cells[face][0] == cell ? 1 : -1;
    gradient += out * mesh.face_measure[face] / mesh.cell_measure[cell] * mean * mesh.face_normal[face].transpose();
  }
  return gradient;
}

}  // namespace sprekk::poromechanics
