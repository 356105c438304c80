#include "components/matrix_flow/rt0/tip_terms.hpp"

#include <algorithm>

#include "components/matrix_flow/cells_around_tips.hpp"
#include "components/matrix_flow/mpfa/tip_energy.hpp"
#include "framework/dense/cholesky.hpp"
#include "framework/discretization/ends_nearby.hpp"

namespace sprekk::matrix_flow {
namespace {

TipTerm term_of(const TipFlow& flow, const Mesh& mesh, int cell, const std::vector<Tensor>& mobility,
                const FluxMass& mass) {
  const CellFaces& faces = mesh.cell_faces[cell];
  const int side = flow.frame().side_of_cell(mesh, cell);
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most_faces, 2> fluxes(faces.size(), 2), drops(faces.size(), 2);
  for (int k = 0; k < faces.size(); ++k) {
    double conductance = 0, cells = 0;
    for (const int at : mesh.face_cells[faces[k]])
      if (at != none) {
        conductance += mobility[at].trace() / dimension;
        ++cells;
      }
    const double out = mesh.face_cells[faces[k]][0] == cell ? 1 : -1;
    fluxes.row(k) = conductance / cells * out * flow.flux(mesh, faces[k], side);
    drops.row(k) = flow.pressure(mesh.cell_center[cell], side) - flow.pressure(mesh.face_center[faces[k]], side);
  }
  return {&flow, mass * fluxes - drops};
}

/// The power that is lost in the cells of a tip, as a form of the pressures of cells and faces and of the fluxes
/// through walls.
class Power {
 public:
  Power(const TipFlow& flow, const Mesh& mesh, const std::vector<int>& cells,
        const std::vector<FlowCondition>& conditions)
      : flow_(flow), mesh_(mesh), conditions_(conditions) {
    const auto number = [](std::map<int, int>& numbers, int item, int next) { numbers.emplace(item, next); };
    for (const int cell : flow.cells()) number(cells_, cell, size());
    for (const int cell : cells) number(cells_, cell, size());
    for (const int cell : cells)
      for (const int face : mesh.cell_faces[cell]) number(faces_, face, size());
    linear_ = added_ = Eigen::MatrixXd::Zero(size(), size());
  }

  /// The share of the power of a cell in linear pressures, and all of what `term` adds (null: nothing).
  void add(int cell, const FluxMass& mass, double share, const TipTerm* term) {
    std::vector<int> free, given;
    const CellFaces& faces = mesh_.cell_faces[cell];
    for (int k = 0; k < faces.size(); ++k) (conditions_[faces[k]] == FlowCondition::flux ? given : free).push_back(k);
    // Rows: the drops p − h and the fluxes of all faces, by the unknowns; of linear pressures, and by the modes.
    const int count = faces.size();
    Eigen::MatrixXd drops = Eigen::MatrixXd::Zero(count, size()), fluxes = drops;
    Eigen::MatrixXd modes_of_drops = Eigen::MatrixXd::Zero(count, 2), modes_of_fluxes = modes_of_drops;
    for (const int k : free) {
      drops(k, cells_.at(cell)) = 1;
      drops(k, faces_.at(faces[k])) = -1;
    }
    for (const int k : given) fluxes(k, faces_.at(faces[k])) = 1;
    if (!free.empty()) {
      const Eigen::MatrixXd free_mass = mass(free, free), coupling = mass(free, given);
      const DenseCholesky factors(free_mass);
      const Eigen::MatrixXd of_free =
          factors.solve_columns(drops(free, Eigen::all) - coupling * fluxes(given, Eigen::all));
      fluxes(free, Eigen::all) = of_free;
      if (term) {
        const Eigen::MatrixXd of_modes = factors.solve_columns(term->missing(free, Eigen::all));
        modes_of_fluxes(free, Eigen::all) = of_modes;
      }
    }
    if (!given.empty()) {
      drops(given, Eigen::all) = mass(given, Eigen::all) * fluxes;
      if (term)
        modes_of_drops(given, Eigen::all) =
            mass(given, Eigen::all) * modes_of_fluxes - term->missing(given, Eigen::all);
    }
    linear_ += share * drops.transpose() * fluxes;
    if (!term) return;
    Eigen::MatrixXd amounts = Eigen::MatrixXd::Zero(2, size());
    for (std::size_t i = 0; i < flow_.cells().size(); ++i)
      amounts.col(cells_.at(flow_.cells()[i])) = flow_.share().col(i);
    // A prescribed flux has no modes, and a drop that is a difference of unknowns has none, so there is no square of
    // amounts.
    added_ += drops.transpose() * modes_of_fluxes * amounts + fluxes.transpose() * modes_of_drops * amounts;
  }

  double dissipative_part() const { return sprekk::matrix_flow::dissipative_part(linear_, added_); }

 private:
  int size() const { return static_cast<int>(cells_.size() + faces_.size()); }

  const TipFlow& flow_;
  const Mesh& mesh_;
  const std::vector<FlowCondition>& conditions_;
  std::map<int, int> cells_, faces_;
  Eigen::MatrixXd linear_, added_;
};

}  // namespace

TipTerms::TipTerms(const Mesh& mesh, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions,
                   const std::vector<FluxMass>& masses) {
  const MpfaLimits limits;
  const std::vector<int> tips = ends_nearby(mesh, limits.near);
  for (const auto& [tip, cells] : cells_around_tips(mesh, tips))
    if (const auto flow = TipFlow::find(mesh, tip, cells, mobility, limits)) flows_.emplace(tip, *flow);
  std::map<int, std::vector<int>> cells_of, reached;
  std::vector<int> tips_of(mesh.cell_count(), 0);  ///< that reach a cell
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    if (const int tip = end_of_cell(mesh, cell, tips); flows_.count(tip) > 0) cells_of[tip].push_back(cell);
  for (auto& [tip, cells] : cells_of) {
    const TipFlow& flow = flows_.at(tip);
    std::erase_if(cells, [&](int cell) {
      return !resembles(mobility[cell], flow.mobility(), limits.alike) ||
             std::ranges::any_of(mesh.cell_faces[cell],
                                 [&](int face) { return conditions[face] == FlowCondition::pressure; });
    });
    reached[tip] = cells;
    reached[tip].insert(reached[tip].end(), flow.cells().begin(), flow.cells().end());
    std::ranges::sort(reached[tip]);
    reached[tip].erase(std::unique(reached[tip].begin(), reached[tip].end()), reached[tip].end());
    for (const int cell : reached[tip]) ++tips_of[cell];
    for (const int cell : cells) terms_.emplace(cell, term_of(flow, mesh, cell, mobility, masses[cell]));
  }
  // The terms of a tip act on the pressures in all cells that its flow is fitted to, which those of its neighbours on a
  // rim may change as well: each of them has a share in the power of such a cell.
  for (auto& [tip, cells] : reached) {
    TipFlow& flow = flows_.at(tip);
    Power power(flow, mesh, cells, conditions);
    for (const int cell : cells) {
      const TipTerm* term = of(cell);
      power.add(cell, masses[cell], 1.0 / tips_of[cell], term && term->flow == &flow ? term : nullptr);
    }
    if (const double part = power.dissipative_part(); part < 1) flow.scale(part);
  }
}

const TipTerm* TipTerms::of(int cell) const {
  const auto found = terms_.find(cell);
  return found == terms_.end() ? nullptr : &found->second;
}

}  // namespace sprekk::matrix_flow
