#include "components/fine_fracture/boundary_element/boundary_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "components/fine_fracture/boundary_element/places_of_offset.hpp"
#include "components/fine_fracture/fine_level/contact_forces.hpp"
#include "components/fine_fracture/fine_level/outline.hpp"
#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/topology_hash.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr int n = element_nodes;
constexpr int force_places_across = 4;  ///< of the square around a place for which a body force is the mean
constexpr int outline_places = 192;     ///< on the whole outline, about

Point point(Complex x) { return {x.real(), x.imag()}; }

/// (N, S) on a line along `along` of a traction on the plus wall, whose normal points to the right of the line.
Point components(const Point& traction, Complex along) {
  const Complex turned = -number(traction) * std::conj(along);
  return {turned.imag(), turned.real()};
}
/// The traction (N, S) of a stress on that line.
Point components(const Tensor& stress, Complex along) {
  const Point right(along.imag(), -along.real());
  return components(Point(stress * right), along);
}

RegularField regular_field(const FineGeometry& geometry, int degree, const Elasticity& rock) {
  Point low = geometry.outline[0], high = low;
  for (const Point& x : geometry.outline) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return {number(0.5 * (low + high)), 0.5 * (high - low).norm(), degree, rock};
}

/// An element whose walls slide. Where they touch, their traction is that of the fluid plus f t, with f linear along
/// the element; gaps are weighted with the same functions.
struct SlidingElement {
  int first_node;
  TipSurroundings::Sliding law;
  Point traction;  ///< t as (N, S)
};
double hat(Eigen::Index end, double t) { return end == 0 ? 1 - t : t; }

}  // namespace

BoundaryModel::BoundaryModel(FineGeometry geometry, const BoundaryOptions& options, const Elasticity& rock,
                             const TipPlace& wanted, std::shared_ptr<Profile> profile, const BoundaryPattern* pattern)
    : profile_(std::move(profile)),
      geometry_(std::move(geometry)),
      rock_(rock),
      wanted_(wanted),
      regular_(regular_field(geometry_, options.degree, rock)) {
  validate(geometry_);
  for (const CrackPath& crack : geometry_.cracks)
    SPREKK_EXPECT(std::ranges::count(crack.walls, CrackPath::Walls::jump) == 0);
  {
    const ScopedTimer timer(*profile_, "elements");
    if (pattern && !fits(pattern->divisions, geometry_)) pattern = nullptr;
    divisions_ = pattern ? pattern->divisions : divisions(geometry_, wanted_, options.sizes);
    elements_ = crack_elements(geometry_, divisions_);
    for (int e = 0; e < element_count(); ++e)
      for (int j = 0; j < n; ++j) {
        const double t = element_places()[j];
        nodes_.push_back({e, j, elements_[e].place(t), elements_[e].along(), elements_[e].parameter(t)});
      }
    for (std::size_t piece = 0; piece < geometry_.beyond.size(); ++piece) {
      const std::vector<Point>& points = geometry_.beyond[piece];
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        for (CrackElement element : beyond_elements(geometry_.outline, points[i], points[i + 1])) {
          element.crack = static_cast<int>(piece);
          element.segment = static_cast<int>(i);
          beyond_.push_back(element);
        }
    }
    place_outline();
  }
  const ScopedTimer timer(*profile_, "assembly");
  if (options.spacing > 0)
    offset_.emplace(pattern ? pattern->offset_places : places_of_offset(geometry_, options.spacing), rock_);
  const auto rows = static_cast<Eigen::Index>(2 * outline_.size()), size = static_cast<Eigen::Index>(2 * nodes_.size());
  Eigen::MatrixXd outline_by_regular(rows, regular_.count());
  outline_by_jumps_.resize(rows, size);
  outline_by_beyond_.resize(rows, 2 * n * beyond_.size());
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const OutlinePlace& place = outline_[i];
    const Complex z = number(place.position);
    outline_by_regular.middleRows<2>(2 * i) =
        place.weight * (geometry_.side(place.edge) == FineGeometry::Side::displacement
                            ? regular_.displacement(z)
                            : Eigen::Matrix2Xd(stress_scale() * regular_.stress(z, edge_direction(place.edge))));
    for (int e = 0; e < element_count(); ++e)
      outline_by_jumps_.block<2, 2 * n>(2 * i, 2 * n * e) = outline_rows(place, ElementField(elements_[e], rock_, z));
    for (std::size_t e = 0; e < beyond_.size(); ++e)
      outline_by_beyond_.block<2, 2 * n>(2 * i, 2 * n * e) = outline_rows(place, ElementField(beyond_[e], rock_, z));
  }
  fit_ = LeastSquares(outline_by_regular);
  walls_by_regular_.resize(size, regular_.count());
  walls_by_beyond_.resize(size, 2 * n * beyond_.size());
  matrix_.resize(size, size);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    // Rows are (N, S); a field gives N + i S.
    walls_by_regular_.middleRows<2>(2 * i) = regular_.stress(node.place, node.along);
    const auto add = [&](const std::vector<CrackElement>& elements, Eigen::MatrixXd& matrix) {
      for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
        const bool is_own = &elements == &elements_ && e == node.element;
        const ElementField field = is_own ? ElementField(elements[e], rock_, element_places()[node.index])
                                          : ElementField(elements[e], rock_, node.place);
        for (int j = 0; j < n; ++j) matrix.block<2, 2>(2 * i, 2 * n * e + 2 * j) = field.stress(j, node.along);
      }
    };
    add(elements_, matrix_);
    add(beyond_, walls_by_beyond_);
  }
  matrix_ -= walls_by_regular_ * fit_.solve_columns(outline_by_jumps_);
  const ScopedTimer factorizing(*profile_, "factorization");
  factorized_ = DenseLu(matrix_);
}

/// Makes stresses on the outline comparable with displacements.
double BoundaryModel::stress_scale() const { return outline_extent(geometry_.outline) / (2 * rock_.shear); }

Complex BoundaryModel::edge_direction(int edge) const {
  const Segment segment = outline_edge(geometry_.outline, edge);
  return number(segment.to - segment.from) / segment.length();
}

void BoundaryModel::place_outline() {
  double perimeter = 0;
  Point center = Point::Zero();
  const int edges = static_cast<int>(geometry_.outline.size());
  for (int k = 0; k < edges; ++k) {
    perimeter += outline_edge(geometry_.outline, k).length();
    center += geometry_.outline[k] / edges;
  }
  constexpr double inward = 1e-6;  // of the way to the centre: above round-off of coordinates
  for (int k = 0; k < edges; ++k) {
    const Segment edge = outline_edge(geometry_.outline, k);
    const int points = std::max(2, static_cast<int>(std::lround(outline_places * edge.length() / perimeter)));
    for (const LinePoint& p : line_rule(points)) {
      const Point x = edge.from + p.t * (edge.to - edge.from);
      outline_.push_back({x, x + inward * (center - x), k, std::sqrt(p.weight * edge.length() / perimeter)});
    }
  }
}

Eigen::Matrix2Xd BoundaryModel::outline_rows(const OutlinePlace& place, const ElementField& field) const {
  Eigen::Matrix2Xd rows(2, 2 * n);
  for (int j = 0; j < n; ++j)
    rows.middleCols<2>(2 * j) =
        place.weight * (geometry_.side(place.edge) == FineGeometry::Side::displacement
                            ? field.displacement(j)
                            : Pair(stress_scale() * field.stress(j, edge_direction(place.edge))));
  return rows;
}

const std::vector<Point>& BoundaryModel::offset_places() const {
  static const std::vector<Point> nowhere;
  return offset_ ? offset_->places() : nowhere;
}

std::vector<Point> BoundaryModel::body_force_places() const {
  const std::vector<Point>& places = offset_places();
  std::vector<Point> around;
  for (const Point& place : places) {
    double next = std::numeric_limits<double>::infinity();
    for (const Point& other : places)
      if (&other != &place) next = std::min(next, (other - place).norm());
    for (int i = 0; i < force_places_across; ++i)
      for (int k = 0; k < force_places_across; ++k) {
        const Point way = Point(i + 0.5, k + 0.5) / force_places_across - Point(0.5, 0.5), x = place + next * way;
        around.push_back(depth_inside(x, geometry_.outline) > 0 ? x : place);
      }
  }
  return around;
}

std::uint64_t BoundaryModel::topology() const {
  TopologyHash hash;
  for (const CrackElement& element : elements_) hash.add(element.crack), hash.add(element.segment);
  return hash.value();
}

BoundaryModel::Given BoundaryModel::given(const FineLoads& loads) const {
  Given given;
  if (offset_ && (loads.stress_offset || loads.body_force)) {
    Eigen::Matrix3Xd offsets;
    Eigen::Matrix2Xd body_forces;
    if (loads.stress_offset) offsets = loads.stress_offset(offset_->places());
    if (loads.body_force) {
      constexpr int around = force_places_across * force_places_across;
      const Eigen::Matrix2Xd forces = loads.body_force(body_force_places());
      body_forces.resize(2, forces.cols() / around);
      for (Eigen::Index i = 0; i < body_forces.cols(); ++i) {
        const auto here = forces.middleCols<around>(around * i);
        const Point first = here.col(0);
        body_forces.col(i) = first + (here.colwise() - first).rowwise().mean();
      }
    }
    given.offset = offset_->solution(offsets, body_forces);
    constexpr double round_off = 1e-6;  // of the largest offset: nodal means of the coarse level have some of it
    if (offsets.cols() > 0 && given.offset->remainder() > round_off * offsets.cwiseAbs().maxCoeff())
      throw UnsuitableRock("the initial stress is not linear in the square around a tip",
                           "boundary elements take an initial stress that is linear there, and any pore pressure");
  }
  given.beyond = Vector::Zero(2 * n * static_cast<Eigen::Index>(beyond_.size()));
  if (loads.jump_beyond)
    for (std::size_t e = 0; e < beyond_.size(); ++e)
      for (int j = 0; j < n; ++j)
        given.beyond.segment<2>(2 * (n * e + j)) =
            -loads.jump_beyond(beyond_[e].crack, beyond_[e].segment, beyond_[e].parameter(element_places()[j]));
  given.outline = Vector::Zero(2 * static_cast<Eigen::Index>(outline_.size()));
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const OutlinePlace& place = outline_[i];
    Point value = Point::Zero();
    if (geometry_.side(place.edge) == FineGeometry::Side::displacement) {
      if (loads.boundary_displacement) value = loads.boundary_displacement(place.position, place.inside);
      if (given.offset) value -= given.offset->displacement(place.position);
    } else {
      const Complex along = edge_direction(place.edge);
      const Point normal(along.imag(), -along.real());
      if (loads.boundary_traction) value = loads.boundary_traction(place.position, normal);
      if (given.offset) value -= given.offset->stress(place.position) * normal;
      value = stress_scale() * components(value, along);
    }
    given.outline.segment<2>(2 * i) = place.weight * value;
  }
  given.outline -= outline_by_beyond_ * given.beyond;
  const Vector regular = fit_.solve(given.outline);
  given.walls = -walls_by_beyond_ * given.beyond - walls_by_regular_ * regular;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const CrackElement& element = elements_[node.element];
    if (loads.wall_traction)
      given.walls.segment<2>(2 * i) +=
          components(loads.wall_traction(element.crack, element.segment, node.s), node.along);
    if (given.offset) given.walls.segment<2>(2 * i) -= components(given.offset->stress(point(node.place)), node.along);
  }
  return given;
}

Vector BoundaryModel::jumps(const FineLoads& loads, const Given& given) const {
  if (!loads.sliding) return factorized_.solve(given.walls);
  // given.walls has the tractions of the coarse level. Where walls slide, the traction of the fluid takes their place.
  Vector open = given.walls;
  std::vector<SlidingElement> sliding;
  for (int e = 0; e < element_count(); ++e) {
    const CrackElement& element = elements_[e];
    if (element.density == Density::root) continue;
    const auto law = loads.sliding(element.crack, element.segment, element.parameter(0.5));
    if (!law) continue;
    SlidingElement contact{n * e, *law, components(law->traction, element.along())};
    for (int j = 0; j < n; ++j) {
      const Node& node = nodes_[n * e + j];
      // The pressure may vary along the element; the law is evaluated in its middle.
      const auto here = loads.sliding(element.crack, element.segment, node.s);
      Point more = components(here ? here->fluid : law->fluid, node.along);
      if (loads.wall_traction)
        more -= components(loads.wall_traction(element.crack, element.segment, node.s), node.along);
      open.segment<2>(2 * (n * e + j)) += more;
    }
    sliding.push_back(contact);
  }
  const Vector without = factorized_.solve(open);
  if (sliding.empty()) return without;
  const auto count = static_cast<Eigen::Index>(2 * sliding.size());
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(open.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SlidingElement& contact = sliding[i / 2];
    for (int j = 0; j < n; ++j)
      units.block<2, 1>(2 * (contact.first_node + j), i) = hat(i % 2, element_places()[j]) * contact.traction;
  }
  const auto gaps = [&](const Vector& jumps, bool with_opening) {
    Vector gaps = Vector::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const SlidingElement& contact = sliding[i / 2];
      for (int j = 0; j < n; ++j) {
        const double gap = -contact.law.gap.dot(jumps.segment<2>(2 * (contact.first_node + j))) -
                           (with_opening ? contact.law.opening : 0);
        gaps[i] += line_rule(n)[j].weight * hat(i % 2, element_places()[j]) * gap;
      }
    }
    return gaps;
  };
  const Vector gaps_without = gaps(without, true);
  if (gaps_without.minCoeff() >= 0) return without;  // all open
  const Eigen::MatrixXd by_units = factorized_.solve_columns(units);
  Eigen::MatrixXd compliance(count, count);
  for (Eigen::Index i = 0; i < count; ++i) compliance.col(i) = gaps(by_units.col(i), false);
  return without + by_units * contact_forces(compliance, gaps_without);
}

TipFactors BoundaryModel::factors(const FineLoads& loads, const Given& given, const Vector& jumps) const {
  int tip = -1;
  for (int e = 0; e < element_count(); ++e) {
    const CrackElement& element = elements_[e];
    if (element.density == Density::root && element.crack == wanted_.crack && (element.sign < 0) == wanted_.is_last)
      tip = e;
  }
  if (tip < 0) throw std::logic_error("the fine level has lost its tip");
  const CrackElement& element = elements_[tip];
  const auto intensity = [&](const std::array<double, n>& rise) {
    Point sum = Point::Zero();
    for (int j = 0; j < n; ++j) sum += rise[j] * jumps.segment<2>(2 * (n * tip + j));
    const Complex turned = number(sum) * std::conj(element.along());
    const double factor = std::sqrt(2 * std::numbers::pi / element.length) * rock_.plane_modulus() / 8;
    return Point(factor * turned.imag(), factor * turned.real());
  };
  const Point K = intensity(rise_at_tip()), fewer = intensity(rise_at_tip(true));
  // sigma_11 + sigma_22 behind the tip, the mean of both walls.
  const Vector regular = fit_.solve(given.outline - outline_by_jumps_ * jumps);
  double trace = regular_.trace(element.start) * regular;
  for (int e = 0; e < element_count(); ++e)
    if (e != tip) {
      const ElementField field(elements_[e], rock_, element.start);
      for (int j = 0; j < n; ++j) trace += field.trace(j) * jumps.segment<2>(2 * (n * e + j));
    }
  for (std::size_t e = 0; e < beyond_.size(); ++e) {
    const ElementField field(beyond_[e], rock_, element.start);
    for (int j = 0; j < n; ++j) trace += field.trace(j) * given.beyond.segment<2>(2 * (n * e + j));
  }
  const ElementField own = ElementField::at_tip(element, rock_);
  for (int j = 0; j < n; ++j) trace += own.trace(j) * jumps.segment<2>(2 * (n * tip + j));
  if (given.offset) trace += given.offset->stress(point(element.start)).trace();
  double across = 0;
  if (loads.wall_traction)
    across = components(loads.wall_traction(element.crack, element.segment, element.parameter(0)), element.along())[0];
  if (!std::isfinite(K.sum() + trace)) throw std::runtime_error("fine level: the factors are not finite");
  return {{K[0], K[1], trace - 2 * across}, (K - fewer).norm()};
}

TipFactors BoundaryModel::solve(const FineLoads& loads) const {
  const Given known = [&] {
    const ScopedTimer timer(*profile_, "loads");
    return given(loads);
  }();
  const Vector found = [&] {
    const ScopedTimer timer(*profile_, "back-solves");
    return jumps(loads, known);
  }();
  const ScopedTimer timer(*profile_, "factors");
  return factors(loads, known, found);
}

}  // namespace sprekk::fine_fracture
