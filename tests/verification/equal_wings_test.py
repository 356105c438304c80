#!/usr/bin/env python3
"""equal_wings_test.py SPREKK: both wings of a fracture in the middle of a point-symmetric rock, on a point-symmetric mesh, grow alike
within steps, and round-off chooses no leader."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
# Along the diagonal of 32 by 32 squares, all sides held: rollers on two sides are not point-symmetric.
CHANGES = {
    "box: {x: [-3 m, 3 m], y: [-3 m, 3 m]}": "box: {x: [-0.4 m, 0.4 m], y: [-0.4 m, 0.4 m]}",
    "length: 0.1 m": "length: 0.28284271247461900976 m",
    "mesh: {size: 0.4 m, fracture_size: 10 mm, growth: 0.2}": "mesh: {kind: structured, cells: [32, 32]}",
    "left: {displacement_x: 0 m}": "left: {displacement: [0 m, 0 m]}",
    "bottom: {displacement_y: 0 m}": "bottom: {displacement: [0 m, 0 m]}",
    "right: {normal_stress: -20 MPa}": "right: {displacement: [0 m, 0 m]}",
    "top: {normal_stress: -10 MPa}": "top: {displacement: [0 m, 0 m]}",
    """    prescribed:
      everywhere: {fracture: main, pressure: "(t/3600) MPa"}""": "    injection: {well: {fracture: main, rate: {value: 2.6e-10 m^2/s}}}",
    "    size: 1 m": "    size: 0.31 m\n    skip_below: 0\n    cavity: 2",
    "  - {type: two_level,     between: [rock, conduit, tips]}":
        "  - {type: aperture, between: [contact, conduit]}\n"
        "  - {type: two_level, between: [rock, conduit, tips, contact], propagation_threshold: 0.25}",
    "    update: after_step": "    update: within_step",
    "start: 7.5 h": "start: 0 h",
    "step: 0.05 h": "step: 0.4 h",
    "reaches: 0.25 m": "reaches: 0.08 m",
}


class EqualWings(unittest.TestCase):
    def test_both_wings_grow_alike(self):
        scene = (ROOT / "configs/verification/wings_sealed.yaml").read_text()
        for old, new in CHANGES.items():
            self.assertEqual(scene.count(old), 1, old)
            scene = scene.replace(old, new)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "scene.yaml").write_text(scene)
            run = subprocess.run([SPREKK, "run", Path(folder) / "scene.yaml", "-q", "-o", Path(folder) / "run"],
                                 capture_output=True, text=True, timeout=300)
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(Path(folder) / "run/history.csv") as file:
                rows = [{key.split("[")[0]: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(file)]
        self.assertGreater(rows[-1]["tips.main_last.length"], 0.08)
        for row in rows:
            first, last = row["tips.main_first.length"], row["tips.main_last.length"]
            # Equal loads have equal advances, so that the tolerance of the search does not part them; the directions of
            # their segments are left to it.
            self.assertLess(abs(first - last), 1e-9, row["time"])
            for axis in "xy":
                self.assertAlmostEqual(row["tips.main_first." + axis], -row["tips.main_last." + axis], delta=1e-8)


if __name__ == "__main__":
    unittest.main()
