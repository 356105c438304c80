// Keeps freed memory in the process, because it is soon needed again.
#pragma once

#include <malloc.h>

namespace sprekk {

/// Sets limits of the C library for freed memory. Matrices are made and freed in every step. By default the C library
/// returns their memory to the system, which clears every page before the next matrices get it: 5 to 10 % of a run with
/// growing fractures. With these limits up to 512 MB stay in the process, and only blocks above 32 MB (the most that
/// glibc allows) are returned at once.
inline void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
#endif
}

}  // namespace sprekk
