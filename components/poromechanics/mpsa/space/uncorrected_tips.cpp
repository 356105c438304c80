#include "components/poromechanics/mpsa/uncorrected_tips.hpp"

#include <fmt/format.h>

#include "framework/discretization/nodes_around_end.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk::poromechanics {

void note_uncorrected_tips(Notes& notes, const std::string& name, const Mesh& mesh, const std::vector<Stiffness>&) {
  int count = 0, first = none;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!is_fracture_end(mesh, node)) continue;
    if (count++ == 0) first = node;
  }
  if (count == 0) return;
  notes.add(name + ": rims without their singular field",
            fmt::format("displacements in '{}' are taken to be linear around the rims of fractures, the first node of "
                        "which is at {}: a disc with 4 or 8 cells on its radius opens about 7 or 4 % too far, and "
                        "slips 16 or 6 % too far. Use a smaller mesh.fracture_size, or "
                        "poromechanics/fem with 'order: second'",
                        name, to_text(mesh.nodes[first])),
            count);
}

}  // namespace sprekk::poromechanics
