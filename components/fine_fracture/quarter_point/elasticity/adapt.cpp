#include "components/fine_fracture/quarter_point/elasticity/adapt.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "framework/mesh/mesh.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fine_fracture {
namespace {

/// The edge lengths that follow from the error estimate on the last mesh.
class WantedSizes {
 public:
  WantedSizes(const FineSolution& solution, const ErrorEstimate& estimate, double tolerance)
      : mesh_(solution.mesh), locator_(*mesh_) {
    const double count = static_cast<double>(mesh_->elements.size());
    const double allowed = tolerance * estimate.total / estimate.relative / std::sqrt(count);
    for (std::size_t e = 0; e < mesh_->elements.size(); ++e) {
      const auto& nodes = mesh_->elements[e].nodes;
      const Point a = mesh_->nodes[nodes[1]] - mesh_->nodes[nodes[0]],
                  b = mesh_->nodes[nodes[2]] - mesh_->nodes[nodes[0]];
      const double edge = std::sqrt(2 * std::abs(a.x() * b.y() - a.y() * b.x()) / std::sqrt(3.0));
      const double excess = allowed / std::max(estimate.elements[e], rounding::above_zero);
      // Where the stress is smooth, the error of a quadratic element is proportional to the third power of its size.
      constexpr double smallest = 0.3, smallest_of_tip = 0.4;  // largest reduction in one round
      const double shrink = std::clamp(std::cbrt(excess), smallest, 1.0);
      sizes_.push_back(edge * shrink);
      expected_elements_ += 1 / (shrink * shrink);
      // The error in a rosette is proportional to the square root of its radius.
      if (mesh_->elements[e].tip != none) tip_shrink_ = std::min(tip_shrink_, std::clamp(excess, smallest_of_tip, 1.0));
    }
  }
  double at(const Point& x) const {
    const auto place = locator_.find(x);
    return place ? sizes_[place->element] : *std::max_element(sizes_.begin(), sizes_.end());
  }
  double tip_shrink() const { return tip_shrink_; }
  double expected_elements() const { return expected_elements_; }

 private:
  std::shared_ptr<const FineMesh> mesh_;
  ElementLocator locator_;
  std::vector<double> sizes_;
  double tip_shrink_ = 1, expected_elements_ = 0;
};

}  // namespace

Adapted adapt(const FineGeometry& geometry, const FineMeshOptions& options, const FineRock& rock,
              const FineLoads& loads, const AdaptOptions& adapt_options, const std::shared_ptr<Profile>& profile) {
  FineMeshOptions sizes = options;
  for (int meshes = 1;; ++meshes) {
    FineModel model(geometry, sizes, rock, {}, profile);
    FineSolution solution = model.solve(loads);
    ErrorEstimate estimate = estimate_error(model, solution);
    const bool is_converged = estimate.relative <= adapt_options.tolerance;
    const auto wanted =
        is_converged ? nullptr : std::make_shared<WantedSizes>(solution, estimate, adapt_options.tolerance);
    if (is_converged || meshes >= adapt_options.at_most || wanted->expected_elements() > adapt_options.most_elements) {
      return {std::move(model), std::move(solution), std::move(estimate), meshes, is_converged};
    }
    const double largest_tip = [&] {
      double radius = 0;
      for (const FineMesh::Tip& tip : solution.mesh->tips) radius = std::max(radius, tip.room.radius);
      return solution.mesh->tips.empty() ? sizes.tip_size : radius;
    }();
    sizes.tip_size = std::min(sizes.tip_size, largest_tip) * wanted->tip_shrink();
    sizes.size_limit = [wanted, given = options.size_limit](const Point& x) {
      return given ? std::min(given(x), wanted->at(x)) : wanted->at(x);
    };
  }
}

}  // namespace sprekk::fine_fracture
