#include "components/fine_fracture/quarter_point/elasticity/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/elasticity/auxiliary_field.hpp"
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

using Coefficients = Eigen::Matrix<double, 6, 3>;  ///< of a quadratic polynomial for xx, yy, xy

Eigen::Vector3d components(const Tensor& t) { return {t(0, 0), t(1, 1), t(0, 1)}; }

class Recovery {
 public:
  explicit Recovery(const FineSolution& solution)
      : solution_(solution), mesh_(*solution.mesh), node_elements_(mesh_.corner_count) {
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      for (int k = 0; k < 3; ++k) node_elements_[mesh_.elements[e].nodes[k]].push_back(static_cast<int>(e));
    }
    for (int n = 0; n < mesh_.corner_count; ++n) patches_.push_back(fit(n));
  }

  /// The recovered stress in an element.
  Eigen::Vector3d stress(const FineMesh::Element& element, const TrianglePoint& place, const Point& x) const {
    std::array<double, 3> share = {1 - place.xi - place.eta, place.xi, place.eta};
    if (element.tip != none) share = {0, place.xi / (place.xi + place.eta), place.eta / (place.xi + place.eta)};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Patch& patch = patches_[element.nodes[k]];
      if (share[k] == 0) continue;
      sum += share[k] * (patch.coefficients.transpose() * patch.basis(x) + singular(patch.tip, x));
    }
    return sum;
  }

 private:
  struct Patch {
    Point center = Point::Zero();
    double size = 1;
    int tip = none;  ///< the tip whose singular fields are subtracted
    Coefficients coefficients = Coefficients::Zero();

    Eigen::Matrix<double, 6, 1> basis(const Point& x) const {
      const Point d = (x - center) / size;
      Eigen::Matrix<double, 6, 1> b;
      b << 1, d.x(), d.y(), d.x() * d.x(), d.x() * d.y(), d.y() * d.y();
      return b;
    }
  };

  Eigen::Vector3d singular(int tip, const Point& x) const {
    if (tip == none) return Eigen::Vector3d::Zero();
    const TipIntensities& t = solution_.tips[tip];
    Tensor frame;
    frame << t.direction.x(), -t.direction.y(), t.direction.y(), t.direction.x();
    const Point local = frame.transpose() * (x - t.position);
    const double r = local.norm(), theta = std::atan2(local.y(), local.x());
    const Elasticity rock = solution_.rock.at(t.position);
    const Tensor stress = t.K.x() * auxiliary_point(Auxiliary::opening, rock, r, theta).stress +
                          t.K.y() * auxiliary_point(Auxiliary::sliding, rock, r, theta).stress;
    return components(frame * stress * frame.transpose());
  }

  /// The elements outside of rosettes around a node, with their neighbours if they are too few for a fit.
  std::vector<int> samples(int node) const {
    std::vector<int> found, corners{node};
    constexpr std::size_t enough = 4;  // elements: three determine a plane exactly, and leave nothing to average
    for (int ring = 0; ring < 3 && found.size() < enough; ++ring) {
      std::vector<int> next;
      for (const int n : corners) {
        for (const int e : node_elements_[n]) {
          if (mesh_.elements[e].tip != none || std::find(found.begin(), found.end(), e) != found.end()) continue;
          found.push_back(e);
          next.insert(next.end(), mesh_.elements[e].nodes.begin(), mesh_.elements[e].nodes.begin() + 3);
        }
      }
      corners = std::move(next);
    }
    return found;
  }

  Patch fit(int node) const {
    SPREKK_EXPECT(is_index(node, mesh_.corner_count), node, mesh_.corner_count);
    Patch patch;
    patch.center = mesh_.nodes[node];
    for (std::size_t t = 0; t < solution_.tips.size(); ++t) {
      const double r = (patch.center - solution_.tips[t].position).norm();
      if (r == 0) return patch;  // no samples at the tip itself
      if (r < solution_.tips[t].domain_radius) patch.tip = static_cast<int>(t);
    }
    const std::vector<int> elements = samples(node);
    patch.size = 0;
    for (const int e : elements) {
      for (int k = 0; k < 3; ++k) {
        patch.size = std::max(patch.size, (mesh_.nodes[mesh_.elements[e].nodes[k]] - patch.center).norm());
      }
    }
    const auto& rule = triangle_rule(2);
    Eigen::MatrixXd rows(elements.size() * rule.size(), 6), values(elements.size() * rule.size(), 3);
    int row = 0;
    for (const int e : elements) {
      for (const TrianglePoint& place : rule) {
        const Point x = shape_point(mesh_, mesh_.elements[e], place.xi, place.eta).x;
        rows.row(row) = patch.basis(x);
        values.row(row++) = components(solution_.elastic_stress_at({e, place.xi, place.eta})) - singular(patch.tip, x);
      }
    }
    patch.coefficients = LeastSquares(rows).solve_columns(values);
    return patch;
  }

  const FineSolution& solution_;
  const FineMesh& mesh_;
  std::vector<std::vector<int>> node_elements_;
  std::vector<Patch> patches_;
};

}  // namespace

ErrorEstimate estimate_error(const FineModel& model, const FineSolution& solution) {
  const FineMesh& mesh = *solution.mesh;
  const Recovery recovery(solution);
  SPREKK_EXPECT(solution.displacement.size() == 2 * mesh.node_count(), solution.displacement.size(), mesh.node_count());
  ErrorEstimate estimate{{}, 0, 0};
  constexpr int degree = 4, along_rays = 3, across = 4;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const FineMesh::Element& element = mesh.elements[e];
    double squared = 0;
    for (const TrianglePoint& place : element.tip == none ? triangle_rule(degree) : polar_rule(along_rays, across)) {
      const ShapePoint p = shape_point(mesh, element, place.xi, place.eta);
      const Tensor here = solution.elastic_stress_at({static_cast<int>(e), place.xi, place.eta});
      const Tensor difference = symmetric(recovery.stress(element, place, p.x)) - here;
      squared += place.weight * p.jacobian * difference.cwiseProduct(solution.rock.at(p.x).strain(difference)).sum();
    }
    SPREKK_ASSERT(squared >= 0, e, squared);
    estimate.elements.push_back(std::sqrt(squared));
    estimate.total += squared;
  }
  estimate.total = std::sqrt(estimate.total);
  const double scale = std::sqrt(2 * model.strain_energy(solution));
  estimate.relative = scale > 0 ? estimate.total / scale : 0;
  return estimate;
}

}  // namespace sprekk::fine_fracture
