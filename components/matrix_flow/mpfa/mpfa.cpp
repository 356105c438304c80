#include "components/matrix_flow/mpfa/mpfa.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "components/matrix_flow/cells_around_tips.hpp"
#include "components/matrix_flow/check_conditions.hpp"
#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "components/matrix_flow/mpfa/tip_correction.hpp"
#include "components/matrix_flow/mpfa/tip_energy.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "framework/discretization/interaction_region.hpp"
#include "framework/discretization/node_stencil.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace {

/// The flows around all tips, for the nodes near them.
class TipFlows {
 public:
  /// `is_wanted`: whether a node is discretized; only the flows at such nodes are needed.
  template <class IsWanted>
  TipFlows(const Mesh& mesh, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions,
           const IsWanted& is_wanted, const MpfaLimits& limits)
      : of_node_(mesh.node_count()) {
    const std::vector<int> tips = ends_nearby(mesh, limits.near);
    for (const auto& [tip, cells] : cells_around_tips(mesh, tips))
      if (const auto flow = TipFlow::find(mesh, tip, cells, mobility, limits)) flows_.emplace(tip, *flow);
    for (int node = 0; node < mesh.node_count(); ++node) {
      const auto found = flows_.find(tips[node]);
      if (found == flows_.end()) continue;
      const auto& cells = mesh.node_cells[node];
      if (std::all_of(cells.begin(), cells.end(),
                      [&](int cell) { return resembles(mobility[cell], found->second.mobility(), limits.alike); }))
        of_node_[node] = &found->second;
    }
    std::map<const TipFlow*, std::vector<int>> nodes;
    for (int node = 0; node < mesh.node_count(); ++node)
      if (of_node_[node]) nodes[of_node_[node]].push_back(node);
    for (auto& [tip, flow] : flows_) {
      const std::vector<int>& corrected = nodes[&flow];
      if (std::none_of(corrected.begin(), corrected.end(), is_wanted)) continue;
      const double part = dissipative_share(flow, mesh, corrected, mobility, conditions);
      if (part < 1) flow.scale(part);
    }
  }

  const TipFlow* at(int node) const { return of_node_[node]; }  ///< null where there is none

  /// The cells whose pressures enter the local problem of each node, ascending: those at the node, and those from which
  /// the flow around its tip is fitted.
  Adjacency cells_of_nodes(const Mesh& mesh) const {
    Adjacency all;
    std::vector<int> of_node;
    for (int node = 0; node < mesh.node_count(); ++node) {
      of_node.assign(mesh.node_cells[node].begin(), mesh.node_cells[node].end());
      if (at(node)) of_node.insert(of_node.end(), at(node)->cells().begin(), at(node)->cells().end());
      all.append_set(of_node);
    }
    return all;
  }

 private:
  std::map<int, TipFlow> flows_;  ///< by tip
  std::vector<const TipFlow*> of_node_;
};

/// Coefficients with respect to the pressures of the cells that enter the local problem of a node.
class CellColumns {
 public:
  void assign(std::span<const int> own, std::span<const int> cells, const TipFlow* flow) {
    flow_ = flow;
    if (!flow) return;
    const auto places = [&](std::span<const int> some, std::vector<int>& places) {
      places.clear();
      for (const int cell : some)
        places.push_back(static_cast<int>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin()));
    };
    places(own, own_);
    places(flow->cells(), of_flow_);
    SPREKK_ASSERT(are_indices(own_, static_cast<long>(cells.size())) &&
                  are_indices(of_flow_, static_cast<long>(cells.size())));
    values_.resize(cells.size());
  }

  /// `own`: of the node's cells; `modes`: with respect to the amounts of the flow around the tip, if there is one.
  const double* with(const double* own, const TipFlow::Modes& modes) {
    if (!flow_) return own;
    std::fill(values_.begin(), values_.end(), 0);
    for (std::size_t i = 0; i < own_.size(); ++i) values_[own_[i]] = own[i];
    for (std::size_t i = 0; i < of_flow_.size(); ++i) values_[of_flow_[i]] += modes.dot(flow_->share().col(i));
    return values_.data();
  }

 private:
  const TipFlow* flow_ = nullptr;
  std::vector<int> own_, of_flow_;
  std::vector<double> values_;
};

/// The faces of every node at which the pressure is prescribed, in ascending order.
Adjacency pressure_faces_of_nodes(const Mesh& mesh, const std::vector<FlowCondition>& conditions) {
  Adjacency faces;
  faces.offsets.reserve(mesh.node_count() + 1);
  for (int node = 0; node < mesh.node_count(); ++node) {
    for (const int face : mesh.node_faces[node])
      if (conditions[face] == FlowCondition::pressure) faces.items.push_back(face);
    faces.offsets.push_back(static_cast<int>(faces.items.size()));
  }
  return faces;
}

/// Coefficients with respect to the changes of prescribed pressures along their faces, from those with respect to the
/// pressures at the continuity points.
class ChangeColumns {
 public:
  void assign(const Mesh& mesh, int node, const InteractionRegion& region, const LocalFluxes& local,
              const std::vector<FlowCondition>& conditions) {
    columns_.clear();
    int column = region.subcell_count();
    for (int f = 0; f < region.subface_count(); ++f) {
      if (region.is_inner(f)) continue;
      const int face = region.faces[f];
      if (conditions[face] == FlowCondition::pressure)
        columns_.emplace_back(column, 0.5 * (mesh.face_nodes[face][0] == node ? -1 : 1) * local.towards_node(f));
      ++column;
    }
    values_.resize(columns_.size());
  }

  const double* of(const double* local) {
    for (std::size_t i = 0; i < columns_.size(); ++i) values_[i] = columns_[i].second * local[columns_[i].first];
    return values_.data();
  }

 private:
  std::vector<std::pair<int, double>> columns_;  ///< columns of the local problem, and positions along the face
  std::vector<double> values_;
};

}  // namespace

FluxOperators discretize_mpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                              const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  return discretize_mpfa_with({}, mesh, mobility, conditions, nodes);
}

FluxOperators discretize_mpfa_with(const MpfaLimits& limits, const Mesh& mesh, const std::vector<Tensor>& mobility,
                                   const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  check_conditions(mesh, mobility, conditions, nodes);
  SPREKK_EXPECT(static_cast<int>(mobility.size()) == mesh.cell_count(), mobility.size(), mesh.cell_count());
  SPREKK_EXPECT(static_cast<int>(conditions.size()) == mesh.face_count(), conditions.size(), mesh.face_count());
  SPREKK_EXPECT(nodes.empty() || static_cast<int>(nodes.size()) == mesh.node_count(), nodes.size(), mesh.node_count());
  SPREKK_EXPECT(std::ranges::all_of(mobility, [](const Tensor& m) { return m.allFinite(); }));
  const auto is_wanted = [&](int node) { return nodes.empty() || nodes[node]; };
  const Adjacency all = contributing_nodes(mesh.face_nodes, [&](int, int node) { return is_wanted(node); });
  const Adjacency outer = contributing_nodes(
      mesh.face_nodes, [&](int face, int node) { return mesh.face_cells[face][1] == none && is_wanted(node); });
  const TipFlows flows(mesh, mobility, conditions, is_wanted, limits);
  const Adjacency node_cells = flows.cells_of_nodes(mesh);
  const Adjacency outer_faces = outer_faces_of_nodes(mesh);
  const NodeStencil face_cells(all, node_cells), face_outer(all, outer_faces);
  const NodeStencil outer_cells(outer, node_cells), outer_outer(outer, outer_faces);
  const Adjacency pressure_faces = pressure_faces_of_nodes(mesh, conditions);
  const NodeStencil face_changes(all, pressure_faces), outer_changes(outer, pressure_faces);
  StencilMatrix flux_cell(face_cells, 1, mesh.cell_count(), 1), flux_boundary(face_outer, 1, mesh.face_count(), 1);
  StencilMatrix trace_cell(outer_cells, 1, mesh.cell_count(), 1), trace_boundary(outer_outer, 1, mesh.face_count(), 1);
  StencilMatrix flux_change(face_changes, 1, mesh.face_count(), 1),
      trace_change(outer_changes, 1, mesh.face_count(), 1);

  InteractionRegion region;
  LocalFluxes local;
  CellColumns columns;
  ChangeColumns changes;
  std::vector<int> cell_slots, outer_slots, change_slots;
  std::vector<Triplet> blended;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!is_wanted(node)) continue;
    region.assign(mesh, node);
    SPREKK_ASSERT(region.subcell_count() > 0, node);
    SPREKK_ASSERT(are_indices(region.faces, mesh.face_count()), node);
    if (local.solve(mesh, node, region, mobility, conditions) == LocalFluxes::Stabilizer::blend)
      for (const int face : region.faces) blended.emplace_back(face, face, 1.0 / region.subface_count());
    changes.assign(mesh, node, region, local, conditions);
    const TipFlow* flow = flows.at(node);
    std::optional<TipCorrection> tip;
    if (flow) tip.emplace(*flow, mesh, region, local, node, mobility, conditions);
    columns.assign(mesh.node_cells[node], node_cells[node], flow);
    const TipFlow::Modes nothing = TipFlow::Modes::Zero();
    int outer_index = 0;
    for (int f = 0; f < region.subface_count(); ++f) {
      const int face = region.faces[f];
      face_outer.find_slots(face, node, outer_slots);
      if (conditions[face] == FlowCondition::flux) {
        flux_boundary.add(face, 0, outer_slots[outer_index], 0, 0.5);
      } else {
        face_cells.find_slots(face, node, cell_slots);
        flux_cell.add(face, 0, cell_slots, columns.with(local.flux(f), tip ? tip->of_flux(f) : nothing), 1);
        flux_boundary.add(face, 0, outer_slots, local.flux(f) + region.subcell_count(), 1);
        face_changes.find_slots(face, node, change_slots);
        flux_change.add(face, 0, change_slots, changes.of(local.flux(f)), 1);
      }
      if (region.is_inner(f)) continue;
      ++outer_index;
      outer_cells.find_slots(face, node, cell_slots);
      outer_outer.find_slots(face, node, outer_slots);
      trace_cell.add(face, 0, cell_slots, columns.with(local.pressure(f), tip ? tip->of_pressure(f) : nothing), 0.5);
      trace_boundary.add(face, 0, outer_slots, local.pressure(f) + region.subcell_count(), 0.5);
      outer_changes.find_slots(face, node, change_slots);
      trace_change.add(face, 0, change_slots, changes.of(local.pressure(f)), 0.5);
    }
  }
  SparseMatrix blended_nodes(mesh.face_count(), mesh.face_count());
  blended_nodes.setFromTriplets(blended.begin(), blended.end());
  return {flux_cell.take(),      flux_boundary.take(), flux_change.take(),      trace_cell.take(),
          trace_boundary.take(), trace_change.take(),  std::move(blended_nodes)};
}

}  // namespace sprekk::matrix_flow
