#include "components/fine_fracture/boundary_element/crack_elements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

CrackElement element_between(int crack, int segment, const Point& from, const Point& to, double first, double last) {
  const Point way = to - from;
  const double length = way.norm();
  return {crack,
          segment,
          first,
          last,
          number(from + first * way),
          number(way) / length,
          (last - first) * length,
          1,
          Density::polynomial};
}

/// The same element, with t counted from its other end.
CrackElement reversed(CrackElement element) {
  element.start = element.place(1);
  element.direction = -element.direction;
  element.sign = -element.sign;
  return element;
}

struct Piece {
  int crack, segment;
  Point from, to;
  bool tip_first, tip_last;
  bool sharp_first = false, sharp_last = false;  ///< whether a sharp corner is there
};

/// A place where jumps are not smooth.
struct Corner {
  Point position;
  double sharpness;  ///< rad, of the bend of the path there, at most 1; 1 where more happens than a bend
  bool is_sharp() const {
    constexpr double sharp = 0.2;  // rad: powers of gentler ones are near 1
    return sharpness > sharp;
  }
};

std::vector<Corner> corners_of(const FineGeometry& geometry) {
  std::vector<Corner> corners;
  for (const CrackPath& crack : geometry.cracks)
    for (std::size_t i = 0; i < crack.points.size(); ++i) {
      const bool is_first = i == 0, is_last = i + 1 == crack.points.size();
      double sharpness = (is_first && crack.first_is_tip) || (is_last && crack.last_is_tip) ? 1 : 0;
      if (!is_first && !is_last) {
        const Point before = crack.points[i] - crack.points[i - 1], after = crack.points[i + 1] - crack.points[i];
        const double bend = std::abs(std::atan2(cross(before, after), before.dot(after)));
        sharpness = std::min(1.0, bend);
      }
      corners.push_back({crack.points[i], sharpness});
    }
  for (const CrackJunction& junction : junctions(geometry)) corners.push_back({junction.position, 1});
  return corners;
}

/// Where a straight piece is divided.
class Division {
 public:
  Division(const Piece& piece, const std::vector<Corner>& corners, const std::vector<Segment>& others,
           const Point& wanted, const ElementSizes& sizes)
      : piece_(piece), corners_(corners), others_(others), wanted_(wanted), sizes_(sizes) {}

  std::vector<double> stops() {
    stops_ = {0};
    divide(0, 1);
    return stops_;
  }

 private:
  Point at(double part) const { return piece_.from + part * (piece_.to - piece_.from); }
  /// The root of a crack's tip is in the element that ends there: the tip is no corner for this element.
  bool is_own_tip(const Point& x, double from, double to) const {
    return (piece_.tip_first && from == 0 && x == piece_.from) || (piece_.tip_last && to == 1 && x == piece_.to);
  }
  double allowed(double from, double to) const {
    const Point middle = at(0.5 * (from + to));
    const double away = (middle - wanted_).norm();
    double allowed = std::max(sizes_.largest, most_ * away);
    for (const Corner& corner : corners_) {
      if (is_own_tip(corner.position, from, to)) continue;
      // A gentle bend hardly disturbs jumps. On a path of 20 pieces that turns by 0.9 rad in all the square changes K
      // by 5e-6.
      const double part = std::min(most_, sizes_.smallest / std::max(std::pow(corner.sharpness, 2), sizes_.smallest));
      const double least = std::max(part * (corner.position - wanted_).norm(), sizes_.smallest * sizes_.largest);
      allowed = std::min(allowed, std::max(least, sizes_.growth * (corner.position - middle).norm()));
    }
    for (const Segment& other : others_)
      allowed = std::min(allowed, std::max(sizes_.smallest * (away + sizes_.largest),
                                           sizes_.growth * sprekk::distance(middle, other)));
    return allowed;
  }

  void divide(double from, double to) {
    // An element has singular functions for one of its ends only.
    const bool has_both =
        from == 0 && to == 1 && (piece_.tip_first || piece_.sharp_first) && (piece_.tip_last || piece_.sharp_last);
    if (has_both || (to - from) * (piece_.to - piece_.from).norm() > allowed(from, to)) {
      divide(from, 0.5 * (from + to));
      divide(0.5 * (from + to), to);
    } else {
      stops_.push_back(to);
    }
  }

  /// How long elements may be far from the wanted tip, over their distance from it.
  static constexpr double most_ = 0.25;

  const Piece& piece_;
  const std::vector<Corner>& corners_;
  const std::vector<Segment>& others_;
  const Point& wanted_;
  const ElementSizes& sizes_;
  std::vector<double> stops_;
};

std::vector<Piece> pieces_of(const FineGeometry& geometry, const std::vector<Corner>& corners) {
  std::vector<Piece> pieces;
  for (int c = 0; c < static_cast<int>(geometry.cracks.size()); ++c) {
    const CrackPath& crack = geometry.cracks[c];
    const int last = static_cast<int>(crack.points.size()) - 2;
    for (int i = 0; i <= last; ++i)
      pieces.push_back(
          {c, i, crack.points[i], crack.points[i + 1], i == 0 && crack.first_is_tip, i == last && crack.last_is_tip});
  }
  for (Piece& piece : pieces)
    for (const Corner& corner : corners) {
      piece.sharp_first = piece.sharp_first || (corner.is_sharp() && corner.position == piece.from);
      piece.sharp_last = piece.sharp_last || (corner.is_sharp() && corner.position == piece.to);
    }
  return pieces;
}

}  // namespace

Divisions divisions(const FineGeometry& geometry, const TipPlace& wanted, const ElementSizes& sizes) {
  const std::vector<Corner> corners = corners_of(geometry);
  const std::vector<Piece> pieces = pieces_of(geometry, corners);
  const CrackPath& own = geometry.cracks[wanted.crack];
  const Point tip = wanted.is_last ? own.points.back() : own.points.front();
  Divisions divisions(geometry.cracks.size());
  for (const Piece& piece : pieces) {
    std::vector<Segment> others;  // that do not touch the piece
    for (const Piece& other : pieces) {
      const Segment segment{other.from, other.to};
      const bool is_next = other.crack == piece.crack && std::abs(other.segment - piece.segment) <= 1;
      if (!is_next && sprekk::distance(segment, Segment{piece.from, piece.to}) > 0) others.push_back(segment);
    }
    divisions[piece.crack].push_back(Division(piece, corners, others, tip, sizes).stops());
  }
  return divisions;
}

bool fits(const Divisions& divisions, const FineGeometry& geometry) {
  return std::ranges::equal(divisions, geometry.cracks, [](const auto& segments, const CrackPath& crack) {
    return segments.size() + 1 == crack.points.size();
  });
}

std::vector<CrackElement> crack_elements(const FineGeometry& geometry, const Divisions& divisions) {
  std::vector<CrackElement> elements;
  for (const Piece& piece : pieces_of(geometry, corners_of(geometry))) {
    const std::vector<double>& stops = divisions[piece.crack][piece.segment];
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      CrackElement element = element_between(piece.crack, piece.segment, piece.from, piece.to, stops[i], stops[i + 1]);
      const bool is_first = i == 0, is_last = i + 2 == stops.size();
      const bool begins = is_first && (piece.tip_first || piece.sharp_first),
                 ends = is_last && (piece.tip_last || piece.sharp_last);
      const bool has_tip = (is_first && piece.tip_first) || (is_last && piece.tip_last);
      // Where one end is a tip and the other a corner, the tip counts.
      if (ends && !(begins && piece.tip_first)) element = reversed(element);
      if (begins || ends) element.density = has_tip ? Density::root : Density::corner;
      elements.push_back(element);
    }
  }
  return elements;
}

std::vector<CrackElement> beyond_elements(const std::vector<Point>& outline, const Point& from, const Point& to) {
  const double extent = outline_extent(outline), length = (to - from).norm();
  // Of the outline's extent; of the distance from it: their jumps are those of the coarse level.
  constexpr double shortest = 0.02, growth = 0.5;
  std::vector<CrackElement> elements;
  const auto divide = [&](const auto& self, double first, double last) -> void {
    const Point middle = from + 0.5 * (first + last) * (to - from);
    const double away = std::max(0.0, -depth_inside(middle, outline));
    if ((last - first) * length > std::max(shortest * extent, growth * away)) {
      self(self, first, 0.5 * (first + last));
      self(self, 0.5 * (first + last), last);
    } else {
      elements.push_back(element_between(none, none, from, to, first, last));
    }
  };
  divide(divide, 0, 1);
  return elements;
}

namespace {

/// The matrix of a function that is linear in the real and the imaginary part: its values for 1 and i are the columns.
Pair pair(Complex of_one, Complex of_i) {
  Pair matrix;
  matrix << of_one.real(), of_i.real(), of_one.imag(), of_i.imag();
  return matrix;
}

Complex local(const CrackElement& element, Complex z) {
  return (z - element.start) * std::conj(element.direction) / element.length;
}

}  // namespace

ElementField::ElementField(const CrackElement& element, const Elasticity& rock, Complex z)
    : element_(element),
      rock_(rock),
      integrals_(density_integrals(element.density, local(element, z))),
      height_(local(element, z).imag()) {}

ElementField::ElementField(const CrackElement& element, const Elasticity& rock, double t)
    : element_(element), rock_(rock), integrals_(density_integrals_on(element.density, t)), height_(0) {}

ElementField ElementField::at_tip(const CrackElement& element, const Elasticity& rock) {
  DensityIntegrals integrals{};
  const std::array<double, element_nodes> slopes = slopes_at_tip();
  for (int j = 0; j < element_nodes; ++j) integrals.slope[j] = slopes[j];
  return {element, rock, integrals};
}

Pair ElementField::displacement(int node) const {
  // 2 G u = kappa phi − conj(conj(z) phi' + psi) with phi = Int c D/(w − t) dt.
  const Complex value = integrals_.value[node], slope = -integrals_.slope[node];
  const Complex turn = std::conj(element_.direction * element_.direction);
  const auto by = [&](Complex jump) {
    const Complex c = element_.sign * imaginary_unit * jump / (2 * std::numbers::pi * (rock_.kolosov() + 1));
    return rock_.kolosov() * c * value -
           std::conj(std::conj(c) * value + 2.0 * imaginary_unit * height_ * turn * c * slope);
  };
  return pair(by(1), by(imaginary_unit));
}

Pair ElementField::stress(int node, Complex along) const {
  const Complex square = -integrals_.slope[node], cube = 0.5 * integrals_.curvature[node];
  const Complex back = std::conj(element_.direction), turn = back * back * back;
  const double factor = rock_.shear / (std::numbers::pi * (rock_.kolosov() + 1) * element_.length);
  // N + i S of the jump 1. That of the jump i follows from it: terms with the jump are multiplied by i, terms with its
  // conjugate by −i.
  const Complex c = element_.sign * factor * imaginary_unit, forward = along * along;
  const Complex phi = -back * c * square,
                with = forward * turn * c * (square - 2.0 * imaginary_unit * (2 * height_) * cube),
                without = -forward * back * std::conj(c) * square;
  return pair(2 * phi.real() + with + without, -2 * phi.imag() + imaginary_unit * with - imaginary_unit * without);
}

Eigen::RowVector2d ElementField::trace(int node) const {
  const double factor = rock_.shear / (std::numbers::pi * (rock_.kolosov() + 1) * element_.length);
  const Complex by =
      4 * element_.sign * factor * std::conj(element_.direction) * imaginary_unit * integrals_.slope[node];
  return {by.real(), (by * imaginary_unit).real()};
}

}  // namespace sprekk::fine_fracture
