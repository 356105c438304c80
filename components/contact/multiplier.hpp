// What distinguishes the three types of contact.
#pragma once

namespace sprekk::contact {

/// How the contact conditions are enforced. `present`: exactly, for gap and slip themselves. `none`, a penalty method:
/// springs of stiffness c lie between the walls, so f = Pi(m + c (gap, slip)), where m is 0 in the normal direction and
/// the traction before the step along the walls. `last`, an augmented Lagrangian method: the same springs, with m the
/// traction of the previous iterate, which stays while the next one is found. So each residual, which is that of an
/// iterate, is without springs, and its derivatives are with them.
///
/// Springs are a compliance in series: f = Pi(m + c g) is the same as f = Pi(f + c' (g − (f − m)/c)) for every c' > 0.
/// Newton's method takes this form, with c' the stiffness of the rock as without springs. In the first form walls stick
/// only over the very short slip over which stiff springs lose their friction: walls whose slip turns round would jump
/// from slip in one direction to slip in the other.
enum class Multiplier { present, last, none };

}  // namespace sprekk::contact
