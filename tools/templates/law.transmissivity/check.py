#!/usr/bin/env python3
"""check.py SPREKK PLUGIN: the pressure in the scene is that of the closed form."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

program, plugin = sys.argv[1:3]


def pressure(mismatch):
    """Pa, in the middle of the fracture, for walls with this mismatch (m)."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", str(Path(__file__).parent / "scene.yaml"), "-q", "-o", folder, "--plugin", plugin, "--set", "plugins=null",
                        "--set", f"components.conduit.law.__type__.mismatch={mismatch} m"], check=True)
        with open(Path(folder) / "history.csv", encoding="utf-8") as file:
            return float(list(csv.DictReader(file))[-1]["p[Pa]"])


smooth, mated_badly = pressure(0), pressure(1e-4)
expected = 12 * 1e-3 * 1e-5 * 1 / (8 * 2e-4**3)
print(f"smooth walls {smooth:.6g} Pa, closed form {expected:.6g} Pa; ratio {mated_badly / smooth:.9g}, closed form {1.5**3:.9g}")
assert abs(smooth / expected - 1) < 2e-3  # of the mesh
assert abs(mated_badly / smooth / 1.5**3 - 1) < 1e-8
