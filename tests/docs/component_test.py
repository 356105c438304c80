#!/usr/bin/env python3
"""component_test.py SPREKK FOLDER: the scene of docs/write_a_component.md gives the closed form, at second order, alone and
split, and its mistakes are answered. FOLDER holds the files of the page."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])


def call(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True)


def error(out, cells, *settings):
    """Runs the scene and the page's check; returns the error that the check prints."""
    settings = (f"mesh.cells=[{cells // 10}, {cells}]", *settings)
    run = call("run", str(folder / "heated_column.yaml"), "-q", "-o", str(out), *[a for s in settings for a in ("--set", s)])
    assert run.returncode == 0, run.stderr
    assert "note:" not in run.stdout + run.stderr, f"a note on a scene without mistakes: {run.stdout}{run.stderr}"
    check = subprocess.run([sys.executable, str(folder / "check.py"), str(out / "history.csv"), str(cells)],
                           capture_output=True, text=True)
    assert check.returncode == 0, check.stdout + check.stderr
    return float(re.search(r"error (\S+)", check.stdout)[1])


with tempfile.TemporaryDirectory() as scratch:
    coarse, fine = error(Path(scratch) / "coarse", 40), error(Path(scratch) / "fine", 80)
    assert coarse / fine > 2**1.8, f"not of second order: {coarse} {fine}"
    split = error(Path(scratch) / "split", 40, "schedule=[{solve: heat}, {solve: rock}]")
    assert abs(split / coarse - 1) < 1e-3, f"the split gives another answer: {split} {coarse}"
    print(f"errors {coarse:.2e} and {fine:.2e}")

explained = call("explain", "heat_flow/tpfa")
assert explained.returncode == 0 and "Conductivity of the rock." in explained.stdout, explained
wrong = call("check", str(folder / "heated_column.yaml"), "--set", "components.heat.conductivity=3 W/m")
assert wrong.returncode == 2 and "conductivity" in wrong.stderr, wrong
unjoined = call("check", str(folder / "heated_column.yaml"), "--set", "couplers=[{type: heating_stress, between: [rock], expansion: 1e-5 1/K}]")
assert unjoined.returncode == 2 and "determines the temperature of the matrix" in unjoined.stderr, unjoined
