// The elastic problem of a fine level by boundary elements.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "components/fine_fracture/boundary_element/crack_elements.hpp"
#include "components/fine_fracture/boundary_element/offset_field.hpp"
#include "components/fine_fracture/boundary_element/regular_field.hpp"
#include "components/fine_fracture/fine_level/fine_level.hpp"
#include "framework/dense/least_squares.hpp"
#include "framework/dense/lu.hpp"
#include "framework/output/profile.hpp"

namespace sprekk::fine_fracture {

/// Parameters of a boundary-element model.
struct BoundaryOptions {
  ElementSizes sizes;
  int degree = 12;  ///< degree of the regular field
  /// M, distance between the places where stress offset and body force are taken; 0: both are zero.
  double spacing = 0;
};

/// The division into elements, and the places of the stress offset. Models of nearly equal geometries that share them
/// have factors that depend continuously on the geometry.
struct BoundaryPattern {
  Divisions divisions;
  std::vector<Point> offset_places;  ///< m
};

/// Plane-strain elasticity in a homogeneous isotropic domain with cracks, div (C eps(u) + s) + b = 0 with the loads of
/// FineLoads, as the sum of
///   - the fields of the jumps on the cracks in an infinite plane, from the tractions of their walls at the nodes;
///   - the fields of the known jumps beyond the outline;
///   - a particular solution for the stress offset s and the body force b;
///   - a regular field, by least squares on the outline.
/// Stress intensity factors follow from the jump in the element at the tip, which varies like the square root of the
/// distance from the tip.
class BoundaryModel : public FineLevel {
 public:
  /// Walls of all cracks have tractions. Takes over the `pattern` of another model where the geometry has as many
  /// cracks and segments.
  BoundaryModel(FineGeometry geometry, const BoundaryOptions& options, const Elasticity& rock, const TipPlace& wanted,
                std::shared_ptr<Profile> profile = std::make_shared<Profile>(),
                const BoundaryPattern* pattern = nullptr);

  FineRock rock() const override { return rock_; }
  std::uint64_t topology() const override;
  const std::vector<Point>& offset_places() const override;
  /// Several places around each of offset_places(). The force at a place is the mean over its surroundings, so that
  /// layers of different weight have their exact weight wherever the border between them lies.
  std::vector<Point> body_force_places() const override;
  /// Throws std::runtime_error where the result is not finite.
  TipFactors solve(const FineLoads& loads) const override;

  BoundaryPattern pattern() const { return {divisions_, offset_places()}; }
  int element_count() const { return static_cast<int>(elements_.size()); }

 private:
  /// A node of an element.
  struct Node {
    int element, index;
    Complex place, along;  ///< m; unit, along the path
    double s;              ///< parameter on the segment
  };
  struct OutlinePlace {
    Point position, inside;  ///< m
    int edge;
    double weight;  ///< square root of the share of the outline that the point stands for
  };
  /// Right-hand sides that follow from the loads.
  struct Given {
    Vector outline;  ///< rows of the outline, weighted
    Vector walls;    ///< rows of the nodes: (N, S) of the walls
    std::optional<OffsetField::Solution> offset;
    Vector beyond;  ///< m, jumps at the nodes beyond the outline
  };
  void place_outline();
  double stress_scale() const;
  Complex edge_direction(int edge) const;
  Eigen::Matrix2Xd outline_rows(const OutlinePlace& place, const ElementField& field) const;
  Given given(const FineLoads& loads) const;
  /// The jumps at the nodes, m. Where walls may slide, their jumps are unknown, too, and follow from their tractions
  /// and gaps.
  Vector jumps(const FineLoads& loads, const Given& given) const;
  TipFactors factors(const FineLoads& loads, const Given& given, const Vector& jumps) const;

  std::shared_ptr<Profile> profile_;
  FineGeometry geometry_;
  Elasticity rock_;
  TipPlace wanted_;
  Divisions divisions_;
  std::vector<CrackElement> elements_, beyond_;
  std::vector<Node> nodes_;
  std::vector<OutlinePlace> outline_;
  RegularField regular_;
  std::optional<OffsetField> offset_;
  Eigen::MatrixXd outline_by_jumps_, outline_by_beyond_, walls_by_beyond_, walls_by_regular_, matrix_;
  LeastSquares fit_;
  DenseLu factorized_;
};

}  // namespace sprekk::fine_fracture
