# shellcheck shell=bash disable=SC2034
# Sourced by the other tools: what every run and test needs around it. Sets `root` to the folder of the project.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# One BLAS thread: a second one gained nothing for sparse factorizations, and slows runs beside each other.
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}

# Open MPI: allow root (containers) and more processes than cores, whose waiting ones then yield.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1

# A compiler cache, where one is in use, knows precompiled headers only with these.
for leniency in pch_defines time_macros; do
  case ",${CCACHE_SLOPPINESS:-}," in
    *",$leniency,"*) ;;
    *) export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:+$CCACHE_SLOPPINESS,}$leniency ;;
  esac
done

build_folder=${SPREKK_BUILD:-$root/build/release}
# nproc counts threads of OpenMP; a script that was called from another one would see one processor only.
jobs=${SPREKK_JOBS:-$(env -u OMP_NUM_THREADS nproc)}

# seconds_since START: whole seconds on a clock that started at START (a value of $SECONDS).
seconds_since() { echo $((SECONDS - $1)); }
