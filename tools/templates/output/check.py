#!/usr/bin/env python3
"""check.py SPREKK PLUGIN: the table has the values of the closed form at each time of output, and an unknown field is refused."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

program, plugin = sys.argv[1:3]
scene = str(Path(__file__).parent / "scene.yaml")

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([program, "run", scene, "-q", "-o", folder, "--plugin", plugin, "--set", "plugins=null"], check=True)
    with open(Path(folder) / "__name__.csv", encoding="utf-8") as file:
        rows = [[float(row[key]) for key in ("time[s]", "smallest[Pa]", "largest[Pa]")] for row in csv.DictReader(file)]
print(rows)
assert [row[0] for row in rows] == [0, 2, 4]
for time, smallest, largest in rows[1:]:
    assert abs(smallest - (1 + time) / 16) < 1e-12 and abs(largest - (1 + time) * 15 / 16) < 1e-12
refused = subprocess.run([program, "check", scene, "--plugin", plugin, "--set", "plugins=null", "--set", "output.__type__.of=pore.presure"],
                         capture_output=True, text=True, check=False)
assert refused.returncode == 2 and "pore.presure" in refused.stderr, refused
