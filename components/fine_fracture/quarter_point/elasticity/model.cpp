#include "components/fine_fracture/quarter_point/elasticity/model.hpp"

#include <optional>
#include <stdexcept>

#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/elasticity/cut_elements.hpp"
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "components/fine_fracture/quarter_point/elasticity/sliding_walls.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

using ElementVector = Eigen::Matrix<double, 12, 1>;

ElementMatrix element_stiffness(const FineMesh& mesh, const FineMesh::Element& element, const FineRock& rock) {
  ElementMatrix stiffness = ElementMatrix::Zero();
  // Exact for straight elements. In quarter-point elements the usual rule misses a little of the energy, which makes
  // them less stiff and their stress-intensity factors better than exact integration (2 x 3 polar points) does.
  const bool is_rosette = element.tip != none;
  std::optional<Elasticity> of_rosette;
  if (is_rosette) of_rosette = rosette_stiffness(mesh, element, rock);
  for (const TrianglePoint& place : is_rosette ? triangle_rule(5) : element_rule(mesh, element, rock, 2)) {
    const ShapePoint p = shape_point(mesh, element, place.xi, place.eta);
    const double factor = place.weight * p.jacobian;
    const auto [lambda, shear] = is_rosette ? *of_rosette : rock.at(p.x);
    for (int a = 0; a < 6; ++a) {
      const double ax = factor * p.gradient(a, 0), ay = factor * p.gradient(a, 1);
      for (int b = 0; b < 6; ++b) {
        const double bx = p.gradient(b, 0), by = p.gradient(b, 1);
        const double xx = ax * bx, yy = ay * by;
        stiffness(2 * a, 2 * b) += (lambda + 2 * shear) * xx + shear * yy;
        stiffness(2 * a + 1, 2 * b + 1) += (lambda + 2 * shear) * yy + shear * xx;
        stiffness(2 * a, 2 * b + 1) += lambda * ax * by + shear * ay * bx;
        stiffness(2 * a + 1, 2 * b) += lambda * ay * bx + shear * ax * by;
      }
    }
  }
  return stiffness;
}

std::vector<ElementMatrix> stiffness_by_element(const FineMesh& mesh, const FineRock& rock) {
  std::vector<ElementMatrix> stiffness;
  stiffness.reserve(mesh.elements.size());
  for (const auto& element : mesh.elements) stiffness.push_back(element_stiffness(mesh, element, rock));
  return stiffness;
}

auto timed(Profile& profile, const char* name, const auto& work) {
  const ScopedTimer timer(profile, name);
  return work();
}

ElementVector gather(const FineMesh::Element& element, const Vector& values) {
  ElementVector local;
  for (int k = 0; k < 6; ++k) local.segment<2>(2 * k) = values.segment<2>(2 * element.nodes[k]);
  return local;
}

}  // namespace

FineModel::FineModel(FineGeometry geometry, const FineMeshOptions& options, FineRock rock,
                     const std::optional<TipPlace>& wanted, std::shared_ptr<Profile> profile,
                     TriangulationKeeper* keeper, std::shared_ptr<const EliminationOrder> known)
    : profile_(std::move(profile)),
      geometry_(std::move(geometry)),
      rock_(std::move(rock)),
      mesh_(timed(*profile_, "mesh",
                  [&] { return std::make_shared<const FineMesh>(make_fine_mesh(geometry_, options, keeper)); })),
      unknowns_(geometry_, *mesh_),
      stiffness_(timed(*profile_, "assembly", [&] { return stiffness_by_element(*mesh_, rock_); })),
      factors_(*mesh_, unknowns_, stiffness_, *profile_, std::move(known)),
      volume_forces_(timed(*profile_, "loads", [&] { return VolumeForces(*mesh_, rock_); })) {
  for (const char* name : {"ordering", "factorization", "back-solves"}) profile_->at(name).is_solver = true;
  const ScopedTimer timer(*profile_, "factors");
  offset_places_ = volume_forces_.places();
  for (const FineMesh::Tip& tip : mesh_->tips) {
    if (wanted && (tip.room.crack != wanted->crack || tip.room.is_last != wanted->is_last)) continue;
    const std::vector<Point>& places = tips_.emplace_back(*mesh_, rock_, tip).offset_places();
    offset_places_.insert(offset_places_.end(), places.begin(), places.end());
  }
}

Vector FineModel::right_hand_side(const FineLoads& loads, const Eigen::Matrix3Xd& offsets,
                                  const Eigen::Matrix2Xd& body_forces, const Vector& u) const {
  Vector f = traction_forces(geometry_, *mesh_, loads);
  // Behind those of the elements stand those of the tips' evaluation.
  const auto of_elements = static_cast<Eigen::Index>(volume_forces_.places().size());
  if (offsets.cols() > 0) volume_forces_.subtract_offsets(f, offsets.leftCols(of_elements));
  if (body_forces.cols() > 0) volume_forces_.add_body_forces(f, body_forces.leftCols(of_elements));
  for (std::size_t e = 0; e < stiffness_.size(); ++e) {
    const auto& element = mesh_->elements[e];
    const ElementVector local = gather(element, u);
    if (local.isZero(0)) continue;
    const ElementVector force = stiffness_[e] * local;
    for (int k = 0; k < 6; ++k) f.segment<2>(2 * element.nodes[k]) -= force.segment<2>(2 * k);
  }
  Vector b = Vector::Zero(unknowns_.count());
  for (int i = 0; i < f.size(); ++i) {
    if (unknowns_.of(i) != none) b[unknowns_.of(i)] += f[i];
  }
  return b;
}

Vector FineModel::back_solve(const Vector& b) const {
  const ScopedTimer timer(*profile_, "back-solves");
  const Vector x = factors_.solve(b);
  if (!x.allFinite()) throw std::runtime_error("fine level: the displacements are not finite");
  return x;
}

Eigen::MatrixXd FineModel::responses_within(const std::vector<int>& components, const Eigen::MatrixXd& forces) const {
  const ScopedTimer timer(*profile_, "back-solves");
  std::vector<int> unknowns;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (unknowns_.of(components[i]) == none) continue;
    unknowns.push_back(unknowns_.of(components[i]));
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
  u(rows, Eigen::all) = factors_.solve_within(unknowns, forces(rows, Eigen::all));
  if (!u.allFinite()) throw std::runtime_error("fine level: the displacements are not finite");
  return u;
}

Vector FineModel::response(const std::vector<int>& components, const Vector& forces) const {
  Vector b = Vector::Zero(unknowns_.count());
  for (std::size_t i = 0; i < components.size(); ++i)
    if (unknowns_.of(components[i]) != none) b[unknowns_.of(components[i])] += forces[i];
  const Vector x = back_solve(b);
  Vector u = Vector::Zero(2 * mesh_->node_count());
  for (int i = 0; i < u.size(); ++i)
    if (unknowns_.of(i) != none) u[i] = x[unknowns_.of(i)];
  return u;
}

FineSolution FineModel::solve(const FineLoads& loads) const {
  FineSolution solution{mesh_, rock_, {}, {}};
  Vector& u = solution.displacement;
  Vector b;
  Eigen::Matrix3Xd offsets;
  Eigen::Matrix2Xd body_forces;
  {
    const ScopedTimer timer(*profile_, "loads");
    if (loads.stress_offset) offsets = loads.stress_offset(offset_places_);
    if (loads.body_force) body_forces = loads.body_force(offset_places_);
    u = unknowns_.prescribed_values(*mesh_, loads);
    b = right_hand_side(loads, offsets, body_forces, u);
  }
  const Vector x = back_solve(b);
  for (int i = 0; i < u.size(); ++i) {
    if (unknowns_.of(i) != none) u[i] += x[unknowns_.of(i)];
  }
  if (loads.sliding) {
    const SlidingContact contact(*mesh_, loads);
    const std::vector<int>& at = contact.components();
    const auto within = [&](const Eigen::MatrixXd& forces) { return responses_within(at, forces); };
    const std::optional<Vector> forces = contact.is_empty() ? std::nullopt : contact.forces(u, within);
    if (forces) u += response(at, *forces);
  }
  const ScopedTimer timer(*profile_, "factors");
  Eigen::Index first = static_cast<Eigen::Index>(volume_forces_.places().size());
  for (const TipEvaluation& tip : tips_) {
    const auto count = static_cast<Eigen::Index>(tip.offset_places().size());
    const auto of_tip = [&](const auto& values) {
      return values.cols() > 0 ? values.middleCols(first, count) : values.middleCols(0, 0);
    };
    solution.tips.push_back(tip.of(loads, of_tip(offsets), of_tip(body_forces), u));
    first += count;
  }
  return solution;
}

double FineModel::strain_energy(const FineSolution& solution) const {
  double energy = 0;
  for (std::size_t e = 0; e < stiffness_.size(); ++e) {
    const ElementVector local = gather(mesh_->elements[e], solution.displacement);
    energy += 0.5 * local.dot(stiffness_[e] * local);
  }
  return energy;
}

}  // namespace sprekk::fine_fracture
