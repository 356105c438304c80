#!/usr/bin/env python3
"""check.py SPREKK PLUGIN: the scene gives the closed form u = exp(-t), and the error of backward Euler is halved with the step."""

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
    return abs(float(last["u[1]"]) - math.exp(-float(last["time[s]"])))


coarse, fine = error(0.02), error(0.01)
print(f"errors {coarse:.2e} and {fine:.2e}: order {math.log2(coarse / fine):.2f}")
# Leading error of backward Euler after a time of 1/r: r dt/2 exp(-1).
assert abs(coarse / (0.01 * math.exp(-1)) - 1) < 0.05 and 1.9 < coarse / fine < 2.1
