#include "components/poromechanics/mpsa/tips.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "components/poromechanics/mpsa/plane/tip_correction.hpp"
#include "framework/discretization/plane/end_zones.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

struct Tips::Content {
  const Mesh& mesh;
  MpsaLimits limits;
  EndZones zones;
  std::map<int, std::optional<TipField>> fields = {};

  /// Null where there is none, or the rock is not like the tip's.
  const TipField* at(int node, const std::vector<Stiffness>& stiffness) {
    const int tip = zones.end[node];
    if (tip == none) return nullptr;
    const auto [found, is_new] = fields.try_emplace(tip);
    if (is_new) found->second = TipField::find(mesh, tip, zones.cells.at(tip), stiffness, limits);
    if (!found->second) return nullptr;
    for (const int cell : mesh.node_cells[node])
      if (!resembles(stiffness[cell], found->second->rock(), limits.alike)) return nullptr;
    return &*found->second;
  }
};

Tips::Tips(const Mesh& mesh, const MpsaLimits& limits)
    : content_(new Content{mesh, limits, end_zones(mesh, limits.zones)}) {
  SPREKK_EXPECT(static_cast<int>(content_->zones.end.size()) == mesh.node_count(), mesh.node_count());
}

std::span<const int> Tips::cells_near(int node) const {
  const int tip = content_->zones.end[node];
  if (tip == none) return {};
  return content_->zones.cells.at(tip);
}

bool Tips::has_same_zone(int node, const Tips& other, int node_of_other) const {
  const EndZones &zones = content_->zones, &others = other.content_->zones;
  const int tip = zones.end[node], other_tip = others.end[node_of_other];
  if (tip == none || other_tip == none) return tip == other_tip;
  return zones.weight[node] == others.weight[node_of_other] &&
         content_->mesh.nodes[tip] == other.content_->mesh.nodes[other_tip];
}

void Tips::correct(int node, const InteractionRegion& region, std::span<const int> cells,
                   const std::vector<Stiffness>& stiffness, LocalStresses& local, std::vector<Triplet>& moments) {
  const TipField* tip = content_->at(node, stiffness);
  if (!tip) return;
  const auto& [mesh, limits, zones, fields] = *content_;
  const TipCorrection correction(*tip, zones.weight[node], mesh, region, node, cells, stiffness);
  local.correct(region, correction);
  // The moments of both halves about the centre of a face belong together: one alone is mostly that of its middle.
  for (int f = 0; f < region.subface_count(); ++f) {
    const auto& ends = mesh.face_nodes[region.faces[f]];
    if (region.is_inner(f) && content_->at(ends[ends[0] == node ? 1 : 0], stiffness) == tip)
      correction.add_moment(moments, f, std::min(zones.weight[ends[0]], zones.weight[ends[1]]));
  }
}

void LocalStresses::correct(const InteractionRegion& region, const TipCorrection& tip) {
  for (int f = 0; f < subfaces_; ++f)
    for (int c = 0; c < 2; ++c)
      if (region.is_inner(f))
        tip.of_force(forces_.data() + (2 * f + c) * columns_, f, c);
      else
        tip.of_displacement(system_.data() + (2 * f + c) * width_ + 2 * subfaces_, f, c);
  for (int k = 0; k < subcells_; ++k) tip.of_volume_change(volumes_.data() + k * columns_, k);
}

}  // namespace sprekk::poromechanics
