#include "components/matrix_flow/mpfa/tips.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "components/matrix_flow/cells_around_tips.hpp"
#include "components/matrix_flow/mpfa/tip_correction.hpp"
#include "components/matrix_flow/mpfa/tip_energy.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace around_tips {

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
      const auto is_alike = [&](int cell) {
        return limits.alike_in_region ? mesh.cell_region[cell] == mesh.cell_region[mesh.node_cells[tips[node]][0]]
                                      : resembles(mobility[cell], found->second.mobility(), limits.alike);
      };
      // A rim in space may meet a side, whose given pressure knows nothing of the flow around the rim.
      const auto is_free = [&](int face) {
        return mesh.face_side[face] == none || conditions[face] == FlowCondition::flux;
      };
      if (std::ranges::all_of(mesh.node_cells[node], is_alike) && std::ranges::all_of(mesh.node_faces[node], is_free))
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

  /// See Tips: those at the node, and those from which the flow around its tip is fitted.
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
  void assign(std::span<const int> own, std::span<const int> cells, const TipFlow& flow) {
    flow_ = &flow;
    const auto places = [&](std::span<const int> some, std::vector<int>& places) {
      places.clear();
      for (const int cell : some)
        places.push_back(static_cast<int>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin()));
    };
    places(own, own_);
    places(flow.cells(), of_flow_);
    SPREKK_ASSERT(are_indices(own_, static_cast<long>(cells.size())) &&
                  are_indices(of_flow_, static_cast<long>(cells.size())));
    values_.resize(cells.size());
  }

  /// `own`: of the node's cells; `modes`: with respect to the amounts of the flow around the tip.
  const double* with(const double* own, const TipFlow::Modes& modes) {
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

}  // namespace around_tips

using namespace around_tips;

struct Tips::Content {
  const std::vector<Tensor>& mobility;
  const std::vector<FlowCondition>& conditions;
  TipFlows flows;
  Adjacency cells_of_nodes;
  CellColumns columns = {};
  std::optional<TipCorrection> correction = {};
};

Tips::Tips(const MpfaLimits& limits, const Mesh& mesh, const std::vector<Tensor>& mobility,
           const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes)
    : mesh_(mesh) {
  const auto is_wanted = [&](int node) { return nodes.empty() || nodes[node]; };
  TipFlows flows(mesh, mobility, conditions, is_wanted, limits);
  Adjacency cells = flows.cells_of_nodes(mesh);
  content_.reset(new Content{mobility, conditions, std::move(flows), std::move(cells)});
}

const Adjacency& Tips::cells_of_nodes() const { return content_->cells_of_nodes; }

void Tips::assign(int node, const InteractionRegion& region, const LocalFluxes& local) {
  local_ = &local;
  auto& [mobility, conditions, flows, cells_of_nodes, columns, correction] = *content_;
  const TipFlow* flow = flows.at(node);
  correction.reset();
  if (!flow) return;
  correction.emplace(*flow, mesh_, region, local, node, mobility, conditions);
  columns.assign(mesh_.node_cells[node], cells_of_nodes[node], *flow);
}

const double* Tips::flux(int subface) {
  const double* own = local_->flux(subface);
  return content_->correction ? content_->columns.with(own, content_->correction->of_flux(subface)) : own;
}

const double* Tips::pressure(int subface) {
  const double* own = local_->pressure(subface);
  return content_->correction ? content_->columns.with(own, content_->correction->of_pressure(subface)) : own;
}

}  // namespace sprekk::matrix_flow
