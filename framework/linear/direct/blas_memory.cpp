#include "framework/linear/direct/blas_memory.hpp"

#include <sys/mman.h>
#include <sys/resource.h>

#include <cstddef>
#include <stdexcept>

extern "C" void dtrsv_(const char* uplo, const char* trans, const char* diag, const int* n, const double* a,
                       const int* lda, double* x, const int* incx);

namespace sprekk {

void reserve_blas_memory() {
  struct rlimit limit {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  constexpr std::size_t needed = std::size_t{192} << 20;  // OpenBLAS takes up to 128 MiB at once
  void* const memory =
      mmap(nullptr, needed, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED)
    throw std::runtime_error(
        "the memory limit is too small (ulimit -v leaves less than the 192 MB that factorizations work in) raise it");
  munmap(memory, needed);
  const int one = 1;
  const double a = 1;
  double x = 1;
  dtrsv_("L", "N", "N", &one, &a, &one, &x, &one);  // OpenBLAS allocates its memory here, and keeps it
}

}  // namespace sprekk
