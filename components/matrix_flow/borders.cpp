// Fluid that crosses the border of the regions of a flow.
#include <algorithm>

#include "components/matrix_flow/leaky_sides.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {

namespace {

constexpr const char* one_flow = "take one flow whose parameters differ by region";

}  // namespace

void MatrixFlow::open_border(const Field& outflow, double sign, const std::vector<char>& faces) {
  SPREKK_EXPECT(static_cast<int>(faces.size()) == mesh_.face_count() && !inside_.empty(), name(), faces.size());
  SPREKK_EXPECT(discretized_mesh_ == 0, name());
  if (is_limited_)
    throw InputError(origin_, "no fluid can cross the border of '" + name() + "'",
                     "its limited fluxes keep bounds from the cells around them, which the flow beside it has not",
                     std::string(one_flow) + ", or another type");
  refuse_with_formula("fluid crosses the border of its regions", "the pressure there would follow the state as well");
  if (buoyancy_) refuse_density_at_border();
  open_faces_.resize(mesh_.face_count(), 0);
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (faces[f]) {
      const auto [cell, other] = mesh_.face_cells[f];
      SPREKK_EXPECT(other != none && is_in_cell(cell) != is_in_cell(other), f, cell, other);
      open_faces_[f] = 1;
    }
  borders_.push_back({&outflow, sign, faces, {}, {}, {}, {}});
}

void MatrixFlow::refuse_density_at_border() const {
  throw InputError(origin_, "no fluid whose density varies can cross the border of '" + name() + "'",
                   "the weight at the border would need the density of the flow beside it", one_flow);
}

const LinearExpression& MatrixFlow::border_pressure(const Field& outflow) const {
  const auto found = std::ranges::find_if(borders_, [&](const OpenBorder& one) { return one.outflow == &outflow; });
  SPREKK_EXPECT(found != borders_.end() && is_discretized(), outflow.name());
  return found->pressure;
}

void MatrixFlow::use_borders() {
  const int faces = mesh_.face_count();
  for (OpenBorder& border : borders_) {
    std::vector<Triplet> values;
    for (int f = 0; f < faces; ++f)
      if (border.faces[f]) values.emplace_back(f, f, border.sign * mesh_.face_measure[f]);
    border.boundary = matrix_of(faces, faces, values);
    border.flux = operators_.flux_boundary * border.boundary;
    const auto sums = [&](const SparseMatrix& fluxes) {
      const SparseMatrix of_cells = cell_sums(mesh_, fluxes, 1, parallel::rank());
      return inside_.empty() ? of_cells : keep_rows(of_cells, inside_);
    };
    std::vector<char> leaves(faces);  // these cells: across this border, or through a side near it
    for (int f = 0; f < faces; ++f) leaves[f] = border.faces[f] || mesh_.face_cells[f][1] == none;
    border.of_cells = Operator(sums(border.flux), sums(keep_rows(border.flux, leaves)));
    if (face_pressure_) border.continuity = Operator(operators_.faces.continuity_boundary * border.boundary);
    if (is_limited_ && !is_sealed_)
      for (const int side : {0, 1}) border.limited[side] = operators_.limited[side].boundary * border.boundary;
  }

  if (borders_.empty()) return;
  make_border_traces();
  // Each border changes the pressure at all of them, and at walls.
  for (OpenBorder& border : borders_) {
    const auto at_border = [&](const SparseMatrix& trace) { return Operator(keep_rows(trace, border.faces)); };
    border.pressure.terms = {{&pressure_, at_border(border_traces_.cell)}};
    for (const OpenBorder& other : borders_)
      border.pressure.terms.push_back({other.outflow, at_border(border_traces_.boundary * other.boundary)});
    if (wall_flux_)
      border.pressure.terms.push_back({wall_flux_, at_border(border_traces_.boundary * boundary_of_wall_flux_)});
    if (face_pressure_) border.pressure.terms.push_back({face_pressure_, at_border(border_traces_.face)});
  }
}

void MatrixFlow::make_border_traces() {
  const int faces = mesh_.face_count();
  std::vector<char> owned(faces, 0), owned_of_sides(faces, 0);
  for (int f = 0; f < faces; ++f) {
    if (!is_owned(mesh_, Location::face, f)) continue;
    owned_of_sides[f] = leaky_sides_ && leaky_sides_->faces()[f];
    owned[f] = (!open_faces_.empty() && open_faces_[f]) || owned_of_sides[f];
  }
  border_traces_ = {keep_rows(operators_.trace_cell, owned), keep_rows(operators_.trace_boundary, owned),
                    keep_rows(operators_.trace_change, owned), SparseMatrix(faces, faces)};
  if (!face_pressure_) return;
  // The equation of the face's own pressure, solved for it: so the flux through the face is in its trace.
  const FacePressureOperators& equations = operators_.faces;
  Vector factors = Vector::Zero(faces);
  std::vector<Triplet> others;
  for (int f = 0; f < faces; ++f) {
    if (!owned[f] || owned_of_sides[f]) continue;
    factors[f] = -1 / equations.continuity_face.coeff(f, f);
    for (SparseMatrix::InnerIterator entry(equations.continuity_face, f); entry; ++entry)
      if (entry.col() != f) others.emplace_back(f, entry.col(), factors[f] * entry.value());
  }
  border_traces_.face.setFromTriplets(others.begin(), others.end());
  // On sides the discretization has traces.
  border_traces_.cell =
      SparseMatrix(factors.asDiagonal() * equations.continuity_cell) + keep_rows(operators_.trace_cell, owned_of_sides);
  border_traces_.boundary = SparseMatrix(factors.asDiagonal() * equations.continuity_boundary) +
                            keep_rows(operators_.trace_boundary, owned_of_sides);
  border_traces_.change = keep_rows(operators_.trace_change, owned_of_sides);
  border_traces_.face += keep_rows(equations.trace, owned_of_sides);
}

void MatrixFlow::apply_boundary_at_borders() {
  if (borders_.empty()) return;
  const Vector constant = border_traces_.boundary * boundary_values_ + border_traces_.change * boundary_changes_ -
                          border_traces_.cell * gravity_potential_cell_ -
                          border_traces_.face * gravity_potential_face_ + gravity_potential_face_;
  for (OpenBorder& border : borders_) {
    border.pressure.constant = constant;
    for (int f = 0; f < mesh_.face_count(); ++f)
      if (!border.faces[f]) border.pressure.constant[f] = 0;
  }
}

void MatrixFlow::open_conditions() {
  for (int f = 0; f < static_cast<int>(open_faces_.size()); ++f)
    if (open_faces_[f]) conditions_[f] = FlowCondition::flux;
}

}  // namespace sprekk::matrix_flow
