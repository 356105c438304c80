// What the three types of contact differ in.
#pragma once

namespace sprekk::contact {

/// The traction to which c times the gap and the slip of the step are added (the trial). `present`: that of the
/// iterate, an unknown like the jump. `last`: that of the iterate before, held while the next one is found. `none`: no
/// normal traction, and the tangential one from before the step: c is a stiffness of the walls then, and they overlap.
enum class Multiplier { present, last, none };

}  // namespace sprekk::contact
