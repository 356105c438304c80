"""Runs the program on one scene, for a limited time, and in its own process group so that nothing is left behind."""

import os
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path


# As in tools/environment.sh: root (containers), and more processes than cores, whose waiting ones then yield.
OF_MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
          "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_mpi_yield_when_idle": "1"}


@dataclass
class Ended:
    folder: Path      # of the results
    code: int         # negative: the signal that ended it
    stderr: str
    timed_out: bool
    seconds: float


def run(program, scene, folder, limit, processes=1, more=(), command="run"):
    command = [str(program), command, str(scene), *(("-o", str(folder)) if folder else ()), *more]
    if processes > 1:
        command = ["mpirun", "-n", str(processes), *command]
    environment = {**os.environ, **OF_MPI, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1",
                   "ASAN_OPTIONS": "detect_leaks=0", "UBSAN_OPTIONS": "print_stacktrace=1"}
    began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace",
                               env=environment, start_new_session=True)
    timed_out = False
    try:
        _, stderr = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        timed_out = True
        os.killpg(process.pid, signal.SIGKILL)
        _, stderr = process.communicate()
    return Ended(Path(folder) if folder else None, process.returncode, stderr, timed_out, time.monotonic() - began)
