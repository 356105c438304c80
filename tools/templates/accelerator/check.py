#!/usr/bin/env python3
"""check.py SPREKK PLUGIN: the pressure in the scene is that of the closed form, and the right factor reaches it in few passes."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

program, plugin = sys.argv[1:3]


def pressure_and_passes(even):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", str(Path(__file__).parent / "scene.yaml"), "-q", "-o", folder, "--plugin", plugin, "--set", "plugins=null",
                        "--set", f"schedule.0.iterate.accelerate.__type__.even={even}"], check=True)
        with open(Path(folder) / "history.csv", encoding="utf-8") as file:
            row = list(csv.DictReader(file))[-1]
            return float(row["p[Pa]"]), int(row["iterations[1]"])


plain, passes = pressure_and_passes(1)
found, fewer = pressure_and_passes(2 / 3)
print(f"{found:.9g} Pa in {fewer} passes, {plain:.9g} Pa in {passes} without acceleration; closed form {2 / 3:.9g} Pa")
assert abs(found / (2 / 3) - 1) < 1e-7 and abs(plain / (2 / 3) - 1) < 1e-7
assert passes > 20 and fewer < 16
