// The working memory of BLAS.
#pragma once

namespace sprekk {

/// Under a limit of the address space (`ulimit -v`), makes BLAS allocate its working memory now: an allocation that
/// fails later is repeated by OpenBLAS without end. Throws std::runtime_error when the limit leaves no memory.
void reserve_blas_memory();

}  // namespace sprekk
