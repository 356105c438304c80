#include "components/matrix_flow/mpfa/uncorrected_tips.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/matrix_flow/cells_around_tips.hpp"
#include "components/matrix_flow/mpfa/tip_flow.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "framework/discretization/nodes_around_end.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk::matrix_flow {
namespace {

bool has_material_of_tip(const Mesh& mesh, int node, const std::vector<Tensor>& mobility, const Tensor& rock) {
  return std::ranges::all_of(mesh.node_cells[node], [&](int cell) { return resembles(mobility[cell], rock); });
}

/// Why a tip has no correction; "" if it has one.
std::string why_uncorrected(const Mesh& mesh, int tip, const std::vector<int>& cells,
                            const std::vector<Tensor>& mobility) {
  const Tensor& rock = mobility[mesh.node_cells[tip][0]];
  if (const auto flow = TipFlow::find(mesh, tip, cells, mobility)) {
    for (const int node : nodes_around_end(mesh, tip, 1))
      if (!has_material_of_tip(mesh, node, mobility, flow->mobility()))
        return "the permeability of cells next to it differs by more than 20 %";
    return "";
  }
  if (!std::ranges::all_of(cells, [&](int cell) { return resembles(mobility[cell], rock); }))
    return "the permeability around it differs by more than 20 %";
  if (!std::ranges::all_of(mesh.node_cells[tip], [&](int cell) { return is_isotropic(mobility[cell]); }))
    return "the permeability is anisotropic";
  return "there are too few cells around it";
}

}  // namespace

UncorrectedEnds uncorrected_tips(const Mesh& mesh, const std::vector<Tensor>& mobility) {
  return uncorrected_ends(
      mesh, cells_around_tips(mesh, ends_nearby(mesh)),
      [&](int tip, const std::vector<int>& cells) { return why_uncorrected(mesh, tip, cells, mobility); });
}

void note_uncorrected_tips(Notes& notes, const std::string& name, const Mesh& mesh,
                           const std::vector<Tensor>& mobility) {
  const UncorrectedEnds found = uncorrected_tips(mesh, mobility);
  // In space a rim crosses borders of layers and has corners: only the larger part of the rims shows.
  if (found.uncorrected == 0 || (dimension == 3 && 2 * found.uncorrected < found.ends)) return;
  notes.add(name + ": tips without their singular flow",
            fmt::format("the correction of the flow around {} of {} tips of fractures in '{}' is switched off, the "
                        "first at {} ({}): the resistance to flow from or around a fracture is off by about 6, 3 and "
                        "1.5 % with 5, 10 and 20 cells on it. Use a smaller mesh.fracture_size",
                        found.uncorrected, found.ends, name, to_text(found.first), found.reason),
            found.uncorrected);
}

}  // namespace sprekk::matrix_flow
