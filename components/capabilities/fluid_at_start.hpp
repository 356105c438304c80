// What notes on the fluid compare with, in rock and in fractures.
#pragma once

namespace sprekk {

/// Of the weight of the fluid at the start, where its density follows temperature and pressure: what may be missing.
inline constexpr double part_that_may_vary = 1e-1;
/// Pa, thirty times what the deepest borehole has above it.
inline constexpr double beyond_every_load = 1e10;

}  // namespace sprekk
