#!/usr/bin/env python3
"""same_bits_test.py: tools/same_bits accepts two programs with the same results, and sees one digit, a file that is missing and a
program that fails."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "same_bits"

PROGRAM = """#!/bin/sh
[ {status} = 0 ] || exit {status}
mkdir -p "$5"                       # run SCENE -q -o FOLDER …
echo "time[s],p[Pa]\n1,{value}" > "$5/history.csv"
echo "seconds of $$" > "$5/run.json" # differs from run to run, and does not count
{more}
"""


def main():
    problems = []
    with tempfile.TemporaryDirectory() as scratch:
        def program(name, value="2.5", status=0, more=""):
            path = Path(scratch) / name
            path.write_text(PROGRAM.format(value=value, status=status, more=more))
            os.chmod(path, 0o755)
            return path

        as_it_is = program("as_it_is")
        for other, accepted, said in ((program("same"), True, "wing_cracks: 1 files, the same bits"),
                                      (program("digit", "2.5000000000000004"), False, "onset: differs in history.csv"),
                                      (program("file", more='touch "$5/fields.vtu"'), False, "differs in fields.vtu"),
                                      (program("fails", status=1), False, "does not run")):
            done = subprocess.run([TOOL, as_it_is, other], capture_output=True, text=True)
            if (done.returncode == 0) != accepted or said not in done.stdout + done.stderr:
                problems.append(f"{other.name}: exit code {done.returncode}, {done.stdout}{done.stderr}")
    print(*problems, f"{len(problems)} problems", sep="\n")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
