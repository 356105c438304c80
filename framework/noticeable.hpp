// From where on an effect is worth a note.
#pragma once

namespace sprekk {

/// Of what an effect is compared with: a larger one could be seen in a figure, and is more than what rounded data
/// leave.
inline constexpr double noticeable = 1e-2;

}  // namespace sprekk
