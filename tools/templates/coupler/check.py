#!/usr/bin/env python3
"""check.py SPREKK PLUGIN: the scene gives the closed form, the error of backward Euler is halved with the step, and no fluid is lost."""

import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

program, plugin = sys.argv[1:3]


def error(step):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", str(Path(__file__).parent / "scene.yaml"), "-q", "-o", folder,
                        "--plugin", plugin, "--set", "plugins=null", "--set", f"time.step={step} s"], check=True)
        with open(Path(folder) / "history.csv", encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
    lost = float(last["fluid_balance_error[m^2]"])
    assert abs(lost) < 1e-12 * 1e-4, f"{lost} m^2 of 1e-4 m^2 are lost"  # c p_0 times the area
    return abs(float(last["p[Pa]"]) / 1e6 - math.exp(-float(last["time[s]"]) / 100))


coarse, fine = error(2), error(1)
print(f"errors {coarse:.2e} and {fine:.2e}: order {math.log2(coarse / fine):.2f}")
# Leading error of backward Euler after a time of c/a: a dt/(2 c) exp(-1).
assert abs(coarse / (0.01 * math.exp(-1)) - 1) < 0.05 and 1.9 < coarse / fine < 2.1
