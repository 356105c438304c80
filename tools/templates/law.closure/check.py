#!/usr/bin/env python3
"""check.py SPREKK PLUGIN: the closure is that of the closed form at each time, and the law as a formula gives the same in as many iterations."""

import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

program, plugin = sys.argv[1:3]
AS_FORMULA = ["components.walls.closure={law: formula, __type__: null, closure: \"0.1 mm*log(1 + sigma_n/(2 MPa))\"}"]


def run(*changes):
    """The rows of the history."""
    with tempfile.TemporaryDirectory() as folder:
        settings = [word for change in ("plugins=null", *changes) for word in ("--set", change)]
        subprocess.run([program, "run", str(Path(__file__).parent / "scene.yaml"), "-q", "-o", folder, "--plugin", plugin, *settings], check=True)
        with open(Path(folder) / "history.csv", encoding="utf-8") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


rows, twins = run(), run(*AS_FORMULA)
assert len(rows) == len(twins) == 4
for row, twin in zip(rows, twins):
    expected = 1e-4 * math.log1p(6 * row["time[s]"] / 2)
    print(f"{row['time[s]']} s: closure {-row['jump.n[m]']:.9g} m, closed form {expected:.9g} m")
    assert abs(-row["jump.n[m]"] / expected - 1) < 1e-10
    assert row["iterations[1]"] == twin["iterations[1]"]
    for key, value in twin.items():
        assert abs(row[key] - value) <= 1e-11 * max(abs(value), 1e-3), (key, row[key], value)
