#include "components/matrix_flow/ntpfa/cell_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace {

// Sine of the angle of two rays that are parallel: the weights would be round-off.
constexpr double parallel = 1e-10;
constexpr double negative = 1e-12;     // part of a vector: a weight that is not below zero except for round-off
constexpr double for_distance = 1e-3;  // by how much a far point costs more than a near one in the same direction
constexpr double alike = 0.01;         // relative difference of mobilities

double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Across an inner face, from `cell`.
Ray harmonic_ray(const Mesh& mesh, const std::vector<Tensor>& mobility, int cell, int face) {
  const bool is_first = mesh.face_cells[face][0] == cell;
  const int other = mesh.face_cells[face][is_first ? 1 : 0];
  const Point normal = is_first ? mesh.face_normal[face] : Point(-mesh.face_normal[face]);
  const Point &here = mesh.cell_center[cell], &there = mesh.cell_center[other], &on = mesh.face_center[face];
  const Point conormal = mobility[cell] * normal, other_conormal = mobility[other] * normal;
  const double across = normal.dot(conormal), other_across = normal.dot(other_conormal);
  const double distance = normal.dot(on - here), other_distance = normal.dot(there - on);
  SPREKK_ASSERT(distance > 0 && other_distance > 0, cell, face, distance, other_distance);
  const double sum = across * other_distance + other_across * distance;
  const double weight = other_across * distance / sum;  // of the other cell
  const Point foot = here + distance * normal, other_foot = there - other_distance * normal;
  const Point tangential = conormal - across * normal, other_tangential = other_conormal - other_across * normal;
  const Point point =
      foot + weight * (other_foot - foot) + distance * other_distance / sum * (tangential - other_tangential);
  Ray ray{point - here};
  ray.own = -weight;
  ray.cell = other;
  ray.of_cell = weight;
  return ray;
}

/// Along the conormal of a face with a prescribed flux b: K n · grad p = −b / |f|.
Ray conormal_ray(const Mesh& mesh, const Tensor& mobility, int cell, int face) {
  const Point& normal = mesh.face_normal[face];
  const Point conormal = mobility * normal;
  const double part = normal.dot(mesh.face_center[face] - mesh.cell_center[cell]) / normal.dot(conormal);
  Ray ray{part * conormal};
  ray.face = face;
  ray.of_boundary = -part / mesh.face_measure[face];
  return ray;
}

Ray pressure_ray(const Mesh& mesh, int cell, int face, double along) {
  const auto [first, second] = mesh.face_nodes[face];
  Ray ray{mesh.face_center[face] + along * (mesh.nodes[second] - mesh.nodes[first]) - mesh.cell_center[cell]};
  ray.own = -1;
  ray.face = face;
  ray.of_boundary = 1;
  ray.of_change = along;
  return ray;
}

Ray turned(Ray ray) {
  ray.arrow = -ray.arrow;
  ray.of_boundary = -ray.of_boundary;
  return ray;
}

}  // namespace

CellRays::CellRays(const Mesh& mesh, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions,
                   int cell)
    : mesh_(mesh), mobility_(mobility), conditions_(conditions), cell_(cell) {
  for (const int face : mesh.cell_faces[cell]) switch (conditions[face]) {
      case FlowCondition::none:
        near_.push_back(harmonic_ray(mesh, mobility, cell, face));
        break;
      case FlowCondition::pressure:
        near_.push_back(pressure_ray(mesh, cell, face, 0));
        break;
      case FlowCondition::flux:
        near_.push_back(conormal_ray(mesh, mobility[cell], cell, face));
        break;
    }
  add_ends();
  add_cells();
}

void CellRays::add_ends() {
  for (const int face : mesh_.cell_faces[cell_]) {
    if (conditions_[face] == FlowCondition::pressure)
      for (const double along : {-0.5, 0.5}) ends_.push_back(pressure_ray(mesh_, cell_, face, along));
    if (conditions_[face] == FlowCondition::flux)
      ends_.push_back(turned(conormal_ray(mesh_, mobility_[cell_], cell_, face)));
  }
}

void CellRays::add_cells() {
  std::set<int> around;
  for (const int node : mesh_.cell_nodes[cell_])
    for (const int other : mesh_.node_cells[node])
      if (other != cell_) around.insert(other);
  for (const int other : around) {
    Ray ray{mesh_.cell_center[other] - mesh_.cell_center[cell_]};
    ray.own = -1;
    ray.cell = other;
    ray.of_cell = 1;
    const bool is_alike = (mobility_[other] - mobility_[cell_]).norm() <= alike * mobility_[cell_].norm();
    std::vector<Ray>& rays = is_alike ? alike_ : others_;
    rays.push_back(ray);
    for (const int face : mesh_.cell_faces[other]) {
      if (conditions_[face] != FlowCondition::pressure) continue;
      Ray to_face{mesh_.face_center[face] - mesh_.cell_center[cell_]};
      to_face.own = -1;
      to_face.face = face;
      to_face.of_boundary = 1;
      rays.push_back(to_face);
    }
  }
}

std::optional<RaySum> CellRays::sum(const Point& vector) const { return find(vector, none); }

std::optional<RaySum> CellRays::sum_without_return(const Point& vector, int face) const { return find(vector, face); }

std::optional<RaySum> CellRays::find(const Point& vector, int face_without_return) const {
  const double length = vector.norm(), size = std::sqrt(mesh_.cell_measure[cell_]);
  std::vector<Ray> rays;
  for (const std::vector<Ray>* more : {&near_, &ends_, &alike_, &others_}) {
    for (const Ray& ray : *more)
      if (more != &ends_ || face_without_return == none || ray.face != face_without_return) rays.push_back(ray);
    std::optional<RaySum> best;
    double least = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
      for (std::size_t j = i + 1; j < rays.size(); ++j) {
        const Point &one = rays[i].arrow, &two = rays[j].arrow;
        const double area = cross(one, two), lengths[] = {one.norm(), two.norm()};
        if (std::abs(area) <= parallel * lengths[0] * lengths[1]) continue;
        const double weights[] = {cross(vector, two) / area, cross(one, vector) / area};
        if (weights[0] * lengths[0] < -negative * length || weights[1] * lengths[1] < -negative * length) continue;
        double cost = 0;
        for (const int k : {0, 1}) cost += std::abs(weights[k]) * lengths[k] * (1 + for_distance * lengths[k] / size);
        if (best && cost >= least) continue;
        least = cost;
        best = RaySum{{std::max(0.0, weights[0]), rays[i]}, {std::max(0.0, weights[1]), rays[j]}};
      }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace sprekk::matrix_flow
