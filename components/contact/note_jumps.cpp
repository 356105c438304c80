#include "components/contact/note_jumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/noticeable.hpp"

namespace sprekk::contact {

namespace {

/// The largest slip of cells that slide, and the largest that springs have before friction gives way, m.
struct Slips {
  double sliding = 0, of_springs = 0;
};

Slips largest_slips(const JumpsOfStep& step) {
  Slips largest;
  for (std::size_t i = 0; i < step.is_open.size(); ++i) {
    if (step.is_open[i]) continue;
    const auto tangential = [i](const Field& field) {
      return field.now().segment<dimension - 1>(dimension * static_cast<Eigen::Index>(i) + 1).norm();
    };
    if (step.slides[i]) largest.sliding = std::max(largest.sliding, tangential(step.jump));
    if (!step.springs.empty())
      largest.of_springs = std::max(largest.of_springs, step.springs[i] * tangential(step.traction));
  }
  return largest;
}

void note_slips(Notes& notes, const std::string& name, const JumpsOfStep& step) {
  constexpr double rounding = 1e-12;     // m, far below any slip
  constexpr double springs_show = 0.05;  // of the slip
  const Slips largest = largest_slips(step);
  const bool is_of_springs = largest.of_springs > step.slip_at_start / 2;
  if (step.slip_at_start > rounding && !is_of_springs)
    notes.add(
        name + " has slid at the start",
        fmt::format("walls have slid by up to {:.3g} m while the state at the start was settled (friction does not "
                    "hold them there, and their slip and opening are part of the results) check the initial stress and "
                    "the friction, if they were meant to stick",
                    step.slip_at_start),
        step.slip_at_start);
  if (largest.sliding > rounding && largest.of_springs > springs_show * largest.sliding)
    notes.add(name + " slips by springs",
              fmt::format("of a slip of up to {:.3g} m, up to {:.3g} m may be that of the springs between the walls "
                          "(with a penalty they give way before friction does) raise 'stiffness_factor', or take "
                          "contact/coulomb or contact/augmented_lagrangian",
                          largest.sliding, largest.of_springs),
              largest.of_springs / largest.sliding);
}

}  // namespace

void note_jumps(Notes& notes, const std::string& name, const Mesh& mesh, const JumpsOfStep& step) {
  SPREKK_EXPECT(static_cast<int>(step.is_open.size()) == mesh.fracture_cell_count(), step.is_open.size());
  note_slips(notes, name, step);
  for (const Fracture& fracture : mesh.fractures) {
    double measure = 0, jump = 0, sheared = 0, pressed = 0;
    bool all_open = true;
    for (int i = fracture.first_cell; i < fracture.first_cell + fracture.cell_count; ++i) {
      measure += mesh.fracture_cells[i].measure;
      jump = std::max(jump, step.jump.now().segment<dimension>(dimension * i).norm());
      all_open = all_open && step.is_open[i];
      const auto before = step.traction.accepted().segment<dimension>(dimension * i);
      if (before[0] < 0 && !mesh.fracture_cells[i].grown) {
        pressed = std::max(pressed, -before[0]);
        sheared = std::max(sheared, before.tail<dimension - 1>().norm());
      }
    }
    const double length = dimension == 2 ? measure : std::sqrt(measure);
    if (jump > step.large_jump * length)
      notes.add(name + " large jump of " + fracture.name,
                fmt::format("the walls of fracture '{}' have a jump of {:.3g} m, {:.2g} of its {} of "
                            "{:.3g} m (over {:.3g} is large: jumps are assumed to be small) check loads, stiffness and "
                            "how the rock is held",
                            fracture.name, jump, jump / length,
                            dimension == 2 ? "length" : "size, the root of its area,", length, step.large_jump),
                jump);
    // No note if cells were open from the start, or if there was no friction: then the fluid is meant to open the
    // fracture. Grown cells start closed.
    if (all_open && pressed > 0 && sheared > noticeable * pressed)
      notes.add(name + " all open: " + fracture.name,
                fmt::format("all {} cells of fracture '{}' have opened (the fluid carries the whole normal stress, and "
                            "no friction is left) check rates and pressures, if it was meant to slip",
                            fracture.cell_count, fracture.name));
  }
}

}  // namespace sprekk::contact
