// The memory that BLAS works in.
#pragma once

namespace sprekk {

/// Under a limit of the address space (`ulimit -v`): lets BLAS take its working memory now. Later OpenBLAS would ask
/// for it again and again, without end. Throws std::runtime_error when the limit leaves none.
void reserve_blas_memory();

}  // namespace sprekk
