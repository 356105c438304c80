// What distinguishes the three types of contact.
#pragma once

namespace sprekk::contact {

/// How the contact conditions are enforced. `present`: exactly, for gap and slip themselves. `none`, a penalty method:
/// springs of stiffness c lie between the walls, so f = Pi(m + c (gap, slip)), where m is 0 in the normal direction and
/// the traction before the step along the walls. `last`, an augmented Lagrangian method: the same springs, with m the
/// traction of the previous iterate, which is held while the next one is computed. So the residual at an iterate is
/// that without springs, but its derivatives are those with springs.
///
/// Springs are a compliance in series: f = Pi(m + c g) is the same as f = Pi(f + c' (g − (f − m)/c)) for every c' > 0.
/// Newton's method uses the second form, with c' the stiffness of the rock as without springs. With the stiff c of the
/// first form, walls stick only over a very short slip, so an iterate would jump over sticking where slip reverses.
enum class Multiplier { present, last, none };

}  // namespace sprekk::contact
