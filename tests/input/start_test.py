#!/usr/bin/env python3
"""start_test.py PROGRAM: what only some runs use is not loaded at each start."""

import resource
import subprocess
import sys

SELDOM = ("gmsh", "vtk", "trilinos", "X11", "GL.so", "TKernel")
MOST_LIBRARIES = 80  # 66 on Debian 12; it was 217 with everything
MOST_SECONDS = 0.1  # of processor time; 0.014 s measured, 0.2 to 0.34 s with everything


def seconds_of(*command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    program = sys.argv[1]
    loaded = [line.split()[0] for line in subprocess.run(["ldd", program], check=True, capture_output=True,
                                                         text=True).stdout.splitlines() if line.strip()]
    problems = [f"{library} is loaded at each start (open it by a module)"
                for library in loaded if any(word in library for word in SELDOM)]
    if len(loaded) > MOST_LIBRARIES:
        problems.append(f"{len(loaded)} libraries are loaded at each start (at most {MOST_LIBRARIES})")
    sanitized = any("libasan" in library for library in loaded)
    seconds = min(seconds_of(program, "--version") for _ in range(5))
    if seconds > MOST_SECONDS and not sanitized:
        problems.append(f"--version takes {seconds:.3f} s of processor time (at most {MOST_SECONDS})")
    print(f"{len(loaded)} libraries, {seconds:.3f} s")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
