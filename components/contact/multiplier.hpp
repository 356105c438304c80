// What the three types of contact differ in.
#pragma once

namespace sprekk::contact {

/// What is between the walls. `present`: nothing; the conditions hold for gap and slip. `none`: springs of stiffness c,
/// so f = Pi(m + c (gap, slip)), with m = 0 in the normal direction and the traction from before the step along the
/// walls. `last`: the same springs, with m the traction of the iterate before, held while the next one is found, so
/// that the springs hold nothing in the end.
///
/// Springs are a compliance in series: f = Pi(m + c g) is the same as f = Pi(f + c' (g − (f − m)/c)) for every c' > 0.
/// Newton's method takes this form, with c' the stiffness of the rock as without springs. With the first form the walls
/// of a cell that slides back would pass from slip to slip in the other direction, since they stick only over the slip
/// that takes the friction from the stiff springs.
enum class Multiplier { present, last, none };

}  // namespace sprekk::contact
