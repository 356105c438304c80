// The notes of the contact.
#include <fmt/format.h>

#include "components/contact/frictional_contact.hpp"

namespace sprekk::contact {

void FrictionalContact::note_step(Notes& notes, const StepTime&) const {
  for (const Fracture& fracture : mesh_.fractures) {
    double length = 0, jump = 0;
    bool all_open = true, was_in_contact = false;
    for (int i = fracture.first_cell; i < fracture.first_cell + fracture.cell_count; ++i) {
      const double cell = mesh_.fracture_cells[i].measure;
      length += cell;
      jump = std::max(jump, jump_.now().segment<dimension>(dimension * i).norm());
      all_open = all_open && state(i) == State::open;
      if (traction_.accepted()[dimension * i] < 0 && !mesh_.fracture_cells[i].grown) was_in_contact = true;
    }
    if (jump > options_.large_jump * length)
      notes.add(
          name() + " large jump of " + fracture.name,
          fmt::format("the walls of fracture '{}' are {:.3g} m apart from where they were, {:.2g} of its length of "
                      "{:.3g} m (over {:.3g} is large: its place and its shape are taken to stay) look at loads, "
                      "stiffness and what holds the rock",
                      fracture.name, jump, jump / length, length, options_.large_jump),
          jump);
    // No note where cells were open from the start. Cells that have grown start closed.
    if (all_open && was_in_contact)
      notes.add(name() + " all open: " + fracture.name,
                fmt::format("all {} cells of fracture '{}' have opened (the fluid carries all that pressed its walls "
                            "together, and friction holds nothing any more) look at rates and pressures, if it was "
                            "meant to slip",
                            fracture.cell_count, fracture.name));
  }
}

}  // namespace sprekk::contact
