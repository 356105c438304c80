#include "components/matrix_flow/leaky_sides.hpp"

#include <algorithm>
#include <cmath>

#include "framework/discretization/changes_along_face.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {

LeakySides::LeakySides(const Mesh& mesh, const std::map<std::string, SideCondition>& sides,
                       const std::vector<char>& inside)
    : mesh_(mesh), sides_(sides), is_leaky_(mesh.face_count(), 0) {
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face_side[f] == none || (!inside.empty() && !inside[mesh.face_cells[f][0]])) continue;
    const auto found = sides.find(mesh.side_names[mesh.face_side[f]]);
    if (found == sides.end() || !found->second.is_leaky()) continue;
    is_leaky_[f] = 1;
    faces_.push_back(f);
    side_of_.push_back(&found->second);
    only_out_ = only_out_ || found->second.only_out;
  }
}

void LeakySides::evaluate(const StepTime& step) {
  outside_.clear();
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const int f = faces_[i];
    const SideCondition& side = *side_of_[i];
    const Place center{mesh_.face_center[f], mesh_.cell_region[mesh_.face_cells[f][0]], 0};
    const auto at = [&](const Data& data, const Point& x) { return value_in_step(data, {x, center.region, 0}, step); };
    OutsideOfRock& here = outside_.emplace_back();
    here.only_out = side.only_out;
    here.pressure =
        side.outer_pressure->depends_on_space()
            ? linear_on_face(mesh_, f, [&](const Point& x) { return at(*side.outer_pressure, x); }).at_center
            : at(*side.outer_pressure, center.x);
    if (side.conductance) here.conductance = at(*side.conductance, center.x);
    SPREKK_ASSERT(std::isfinite(here.pressure), f, here.pressure);
  }
}

double LeakySides::largest_pressure() const {
  double largest = 0;
  for (const OutsideOfRock& here : outside_) largest = std::max(largest, std::abs(here.pressure));
  return largest;
}

LeakySides::Rows LeakySides::rows(const Field& outflow, const LinearExpression& trace) const {
  SPREKK_EXPECT(outside_.size() == faces_.size() && outflow.size() == mesh_.face_count(), outside_.size());
  const int faces = mesh_.face_count();
  Vector resistance = Vector::Zero(faces), now = trace.now();
  for (const LinearExpression::Term& term : trace.terms)
    if (term.field == &outflow)
      for (const int f : faces_) resistance[f] = std::abs(term.matrix.entries().coeff(f, f));
  // Elsewhere q = 0.
  Rows rows{Vector::Ones(faces), Vector::Zero(faces), -outflow.now()};
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const int f = faces_[i];
    if (!is_owned(mesh_, Location::face, f)) continue;
    const OutsideOfRock& here = outside_[i];
    SPREKK_ASSERT(resistance[f] > 0 && std::isfinite(resistance[f]), f, resistance[f]);
    const double whole = here.conductance ? 1 + *here.conductance * resistance[f] : 1;
    rows.of_flux[f] = here.conductance ? 1 / whole : 0;
    rows.of_trace[f] = here.conductance ? *here.conductance / whole : 1 / resistance[f];
    rows.drive[f] = rows.of_trace[f] * (now[f] - here.pressure) - rows.of_flux[f] * outflow.now()[f];
  }
  return rows;
}

void LeakySides::assemble(Assembly& assembly, const Field& outflow, const LinearExpression& trace) const {
  if (!assembly.has_row(outflow)) return;
  Rows rows = this->rows(outflow, trace);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const int f = faces_[i];
    if (!outside_[i].only_out || outflow.now()[f] + rows.drive[f] >= 0) continue;
    rows.of_flux[f] = 1;
    rows.of_trace[f] = 0;
    rows.drive[f] = -outflow.now()[f];
  }
  assembly.add(outflow, -rows.drive);
  assembly.compare_with(outflow, outflow.now().lpNorm<Eigen::Infinity>());
  assembly.compare_with(outflow, outflow.accepted().lpNorm<Eigen::Infinity>());
  // Pressures on both sides may be nearly equal: their difference has the round-off of either.
  assembly.compare_round_off(outflow, rows.of_trace.lpNorm<Eigen::Infinity>() * largest_pressure());
  for (const LinearExpression::Term& term : trace.terms)
    assembly.compare_round_off(
        outflow, rows.of_trace.cwiseProduct(term.matrix.entries().cwiseAbs() * term.field->now().cwiseAbs())
                     .lpNorm<Eigen::Infinity>());
  if (!assembly.wants_derivatives()) return;
  assembly.diagonal(outflow, outflow, rows.of_flux);
  const Vector factors = -rows.of_trace;
  for (const LinearExpression::Term& term : trace.terms)
    assembly.derivative(outflow, *term.field, SparseMatrix(factors.asDiagonal() * term.matrix.entries()));
}

LeakySides::Correction LeakySides::correction(const Field& outflow, const LinearExpression& trace) const {
  Rows rows = this->rows(outflow, trace);
  Correction correction{Vector::Zero(mesh_.face_count()), Vector::Zero(mesh_.face_count()),
                        Vector::Zero(mesh_.face_count())};
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const int f = faces_[i];
    if (outside_[i].only_out || !is_owned(mesh_, Location::face, f)) continue;
    correction.value[f] = rows.drive[f];
    correction.of_flux[f] = rows.of_flux[f];
    correction.of_trace[f] = rows.of_trace[f];
  }
  return correction;
}

std::uint64_t LeakySides::passing_state(const Field& outflow, const LinearExpression& trace) const {
  Vector drive = rows(outflow, trace).drive;
  exchange(mesh_, Location::face, 1, drive);
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i)
    if (outside_[i].only_out) hash = hash * 1000003 + (outflow.now()[faces_[i]] + drive[faces_[i]] >= 0 ? 1 : 2);
  return hash;
}

}  // namespace sprekk::matrix_flow
