#include "components/poromechanics/mpsa/uncorrected_tips.hpp"

#include <algorithm>

#include "components/poromechanics/mpsa/tip_field.hpp"
#include "framework/discretization/nodes_around_end.hpp"
#include "framework/discretization/plane/end_zones.hpp"

namespace sprekk::poromechanics {
namespace {

bool has_material_of_tip(const Mesh& mesh, int node, const std::vector<Stiffness>& stiffness, const Stiffness& rock) {
  return std::ranges::all_of(mesh.node_cells[node], [&](int cell) { return resembles(stiffness[cell], rock); });
}

/// Why a tip has no correction; "" if it has one.
std::string why_uncorrected(const Mesh& mesh, int tip, const std::vector<int>& cells,
                            const std::vector<Stiffness>& stiffness) {
  if (const auto field = TipField::find(mesh, tip, cells, stiffness)) {
    for (const int node : nodes_around_end(mesh, tip, 1))
      if (!has_material_of_tip(mesh, node, stiffness, field->rock()))
        return "the stiffness of cells next to it differs by more than 20 %";
    return "";
  }
  if (!has_material_of_tip(mesh, tip, stiffness, stiffness[mesh.node_cells[tip][0]]))
    return "the stiffness around it differs by more than 20 %";
  if (!std::ranges::all_of(mesh.node_cells[tip], [&](int cell) { return is_isotropic(stiffness[cell]); }))
    return "the rock is anisotropic";
  return "there are too few cells around it";
}

}  // namespace

UncorrectedEnds uncorrected_tips(const Mesh& mesh, const std::vector<Stiffness>& stiffness) {
  return uncorrected_ends(mesh, end_zones(mesh).cells, [&](int tip, const std::vector<int>& cells) {
    return why_uncorrected(mesh, tip, cells, stiffness);
  });
}

}  // namespace sprekk::poromechanics
