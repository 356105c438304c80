// Memory that is given back is wanted again at once.
#pragma once

#include <malloc.h>

namespace sprekk {

/// Matrices come and go with every step. By default the C library hands their memory back to the system, which clears
/// it page by page when the next ones take it: 5 to 10 % of a run with growing fractures. Now up to 512 MB stay with
/// the process, and only blocks above 32 MB (the most that glibc allows) are handed back at once.
inline void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
#endif
}

}  // namespace sprekk
