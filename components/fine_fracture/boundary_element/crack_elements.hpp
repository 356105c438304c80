// Straight elements on cracks, and the fields of the jumps on them (displacement discontinuities).
#pragma once

#include <array>
#include <vector>

#include "components/fine_fracture/boundary_element/density_integrals.hpp"
#include "components/fine_fracture/fine_level/elasticity.hpp"
#include "components/fine_fracture/fine_level/geometry.hpp"
#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// A straight piece of a crack. The jump D on it, u(plus) − u(minus), in m, is given by its values at the nodes: a
/// polynomial, times the root of the distance from a tip where the element is at one.
struct CrackElement {
  int crack, segment;  ///< of the geometry; none for pieces outside of it
  double from, to;     ///< where the element begins and ends: parameters on the segment
  Complex start;       ///< m, where t = 0; for an element at a tip this is the tip
  Complex direction;   ///< unit, from there
  double length;       ///< m
  double sign;         ///< 1 along the path, −1 against it
  Density density;

  Complex place(double t) const { return start + t * length * direction; }
  /// The parameter on the segment of the place t on the element.
  double parameter(double t) const { return sign > 0 ? from + t * (to - from) : to + t * (from - to); }
  Complex along() const { return sign * direction; }  ///< unit, along the path
};

/// How long elements are.
struct ElementSizes {
  double largest;          ///< m, at the wanted tip
  double smallest = 3e-4;  ///< at kinks and other such places, over their distance from the wanted tip
  /// Largest ratio of an element's length to the distance of its middle from the nearest of these places.
  double growth = 0.7;
};

/// Where the segments of cracks are divided: parameters from 0 to 1, by crack and segment.
using Divisions = std::vector<std::vector<std::vector<double>>>;
/// Elements are short where jumps are not smooth: at kinks, at junctions, where the kind of the walls changes and
/// beside other cracks; and longer far from the wanted tip.
Divisions divisions(const FineGeometry& geometry, const TipPlace& wanted, const ElementSizes& sizes);
/// Whether the divisions have as many cracks and segments as the geometry.
bool fits(const Divisions& divisions, const FineGeometry& geometry);
std::vector<CrackElement> crack_elements(const FineGeometry& geometry, const Divisions& divisions);
/// Divides a straight piece outside of a convex outline, in elements that are short beside it, with polynomial jumps.
std::vector<CrackElement> beyond_elements(const std::vector<Point>& outline, const Point& from, const Point& to);

/// The complex number with the components of a vector as its real and its imaginary part.
using Pair = Eigen::Matrix2d;

/// The fields in an infinite plane of the jumps on an element (Crouch, Int. J. Numer. Methods Eng. 10 (1976) 301; with
/// the potentials of Muskhelishvili 1953), for each of its nodes.
class ElementField {
 public:
  /// The field at z, which is not on the element.
  ElementField(const CrackElement& element, const Elasticity& rock, Complex z);
  /// The field at the place t of the element itself; displacements are the mean of both sides.
  ElementField(const CrackElement& element, const Elasticity& rock, double t);
  /// The field at t = 0 of an element with a tip there: the limit along the element. Only the trace of the stress is
  /// valid.
  static ElementField at_tip(const CrackElement& element, const Elasticity& rock);
  /// The displacement (m) that a jump (m) makes.
  Pair displacement(int node) const;
  /// (sigma_nn, sigma_tn), Pa, on a line in the direction `along` (unit), n to its left, t along it, that a jump (m)
  /// makes.
  Pair stress(int node, Complex along) const;
  /// sigma_xx + sigma_yy, Pa, that a jump (m) makes.
  Eigen::RowVector2d trace(int node) const;

 private:
  ElementField(const CrackElement& element, const Elasticity& rock, const DensityIntegrals& integrals)
      : element_(element), rock_(rock), integrals_(integrals), height_(0) {}

  CrackElement element_;
  Elasticity rock_;
  DensityIntegrals integrals_;
  double height_;  ///< distance of the place from the line of the element, over the length of the element
};

}  // namespace sprekk::fine_fracture
