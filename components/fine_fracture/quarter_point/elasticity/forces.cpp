#include "components/fine_fracture/quarter_point/elasticity/forces.hpp"

#include "components/fine_fracture/fine_level/elasticity.hpp"
#include "components/fine_fracture/fine_level/outline.hpp"
#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/elasticity/cut_elements.hpp"
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "components/fine_fracture/quarter_point/elasticity/sliding_walls.hpp"
#include "components/fine_fracture/quarter_point/elasticity/wall_place.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr int edge_points = 4;

void add_edge_force(const EdgeNodes& nodes, const EdgePoint& p, const Point& force, Vector& f) {
  for (int k = 0; k < 3; ++k) f.segment<2>(2 * nodes[k]) += p.value[k] * force;
}

void add_outline_tractions(const FineGeometry& geometry, const FineMesh& mesh, const FineLoads& loads, Vector& f) {
  for (const FineMesh::OutlineEdge& edge : mesh.outline_edges) {
    if (geometry.side(edge.edge) != FineGeometry::Side::traction) continue;
    const Segment side = outline_edge(geometry.outline, edge.edge);
    const Point along = (side.to - side.from).normalized(), normal(along.y(), -along.x());
    for (const LinePoint& place : line_rule(edge_points)) {
      const EdgePoint p = edge_point(mesh, edge.nodes, place.t);
      add_edge_force(edge.nodes, p, place.weight * p.jacobian * loads.boundary_traction(p.x, normal), f);
    }
  }
}

void add_wall_tractions(const FineMesh& mesh, const FineLoads& loads, Vector& f) {
  for (const FineMesh::WallEdge& edge : mesh.wall_edges) {
    SPREKK_EXPECT(is_unit(edge.normal), edge.normal.norm());
    if (edge.walls != CrackPath::Walls::traction) continue;
    const auto sliding = sliding_of(mesh, edge, loads);
    for (const LinePoint& place : wall_rule(mesh, edge, edge_points)) {
      const EdgePoint p = edge_point(mesh, edge.nodes[0], place.t);
      const WallPlace wall = wall_place(mesh, edge, p.x);
      const Point force = place.weight * p.jacobian *
                          (sliding ? sliding->fluid : loads.wall_traction(edge.crack, wall.segment, wall.s));
      add_edge_force(edge.nodes[0], p, force, f);
      add_edge_force(edge.nodes[1], p, -force, f);
    }
  }
}

}  // namespace

Vector traction_forces(const FineGeometry& geometry, const FineMesh& mesh, const FineLoads& loads) {
  Vector f = Vector::Zero(2 * mesh.node_count());
  if (loads.boundary_traction) add_outline_tractions(geometry, mesh, loads, f);
  if (loads.wall_traction) add_wall_tractions(mesh, loads, f);
  return f;
}

VolumeForces::VolumeForces(const FineMesh& mesh, const FineRock& rock) {
  constexpr int degree = 4, along_rays = 3, across = 4;
  const std::size_t likely = triangle_rule(degree).size() * mesh.elements.size();
  places_.reserve(likely);
  shares_.reserve(likely);
  for (const FineMesh::Element& element : mesh.elements) {
    for (const TrianglePoint& place :
         element.tip == none ? element_rule(mesh, element, rock, degree) : polar_rule(along_rays, across)) {
      const ShapePoint p = shape_point(mesh, element, place.xi, place.eta);
      SPREKK_ASSERT(p.jacobian > 0, p.jacobian, place.xi, place.eta);
      places_.push_back(p.x);
      shares_.push_back({element.nodes, place.weight * p.jacobian * p.gradient, place.weight * p.jacobian * p.value});
    }
  }
}

void VolumeForces::subtract_offsets(Vector& forces, const Eigen::Ref<const Eigen::Matrix3Xd>& offsets) const {
  SPREKK_EXPECT(offsets.cols() == static_cast<Eigen::Index>(shares_.size()), offsets.cols(), shares_.size());
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const Tensor s = symmetric(offsets.col(i));
    for (int k = 0; k < 6; ++k)
      forces.segment<2>(2 * shares_[i].nodes[k]) -= s * shares_[i].gradient.row(k).transpose();
  }
}

void VolumeForces::add_body_forces(Vector& forces, const Eigen::Ref<const Eigen::Matrix2Xd>& body_forces) const {
  SPREKK_EXPECT(body_forces.cols() == static_cast<Eigen::Index>(shares_.size()), body_forces.cols(), shares_.size());
  for (std::size_t i = 0; i < shares_.size(); ++i)
    for (int k = 0; k < 6; ++k) forces.segment<2>(2 * shares_[i].nodes[k]) += shares_[i].value[k] * body_forces.col(i);
}

}  // namespace sprekk::fine_fracture
