// Finds the elements that hold points.
#pragma once

#include <optional>
#include <vector>

#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// A place in an element, see shape_point.
struct ElementPlace {
  int element;
  double xi, eta;
};

/// Finds the element of a point in constant time, by square buckets.
class ElementLocator {
 public:
  /// The mesh must outlive the locator.
  explicit ElementLocator(const FineMesh& mesh);
  /// The place of x in its element; std::nullopt outside of the domain. For x on a crack it may be on either side.
  std::optional<ElementPlace> find(const Point& x) const;

 private:
  std::optional<ElementPlace> place_in(int element, const Point& x) const;
  std::array<int, 2> bucket_of(const Point& x) const;

  const FineMesh& mesh_;
  Point low_;
  double width_;
  std::array<int, 2> counts_;
  std::vector<std::vector<int>> buckets_;
};

}  // namespace sprekk::fine_fracture
