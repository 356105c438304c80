#include "components/contact/note_jumps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk::contact {

void note_jumps(Notes& notes, const std::string& name, const Mesh& mesh, const JumpsOfStep& step) {
  SPREKK_EXPECT(static_cast<int>(step.is_open.size()) == mesh.fracture_cell_count(), step.is_open.size());
  for (const Fracture& fracture : mesh.fractures) {
    double length = 0, jump = 0;
    bool all_open = true, was_in_contact = false;
    for (int i = fracture.first_cell; i < fracture.first_cell + fracture.cell_count; ++i) {
      const double cell = mesh.fracture_cells[i].measure;
      length += cell;
      jump = std::max(jump, step.jump.now().segment<dimension>(dimension * i).norm());
      all_open = all_open && step.is_open[i];
      if (step.traction.accepted()[dimension * i] < 0 && !mesh.fracture_cells[i].grown) was_in_contact = true;
    }
    if (jump > step.large_jump * length)
      notes.add(
          name + " large jump of " + fracture.name,
          fmt::format("the walls of fracture '{}' are {:.3g} m apart from where they were, {:.2g} of its length of "
                      "{:.3g} m (over {:.3g} is large: its place and its shape are taken to stay) look at loads, "
                      "stiffness and what holds the rock",
                      fracture.name, jump, jump / length, length, step.large_jump),
          jump);
    // No note where cells were open from the start. Cells that have grown start closed.
    if (all_open && was_in_contact)
      notes.add(name + " all open: " + fracture.name,
                fmt::format("all {} cells of fracture '{}' have opened (the fluid carries all that pressed its walls "
                            "together, and friction holds nothing any more) look at rates and pressures, if it was "
                            "meant to slip",
                            fracture.cell_count, fracture.name));
  }
}

}  // namespace sprekk::contact
