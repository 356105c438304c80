#!/usr/bin/python3
"""wings_within_steps_test.py SPREKK: the path of wings that grow within steps in sealed rock, and the pressure that they need,
against boundary elements (references/sealed_wings.csv), for a fracture and its mirror image."""

import csv
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/python"))

import sprekk  # noqa: E402

SPREKK = Path(sys.argv.pop(1)).resolve()
TIP = 0.05 * math.sqrt(0.5)  # m, x and y of the fracture's tip
FOLLOWED = 3.5e-3, 6.5e-3  # m: the mesh begins to follow the wings; it follows both
CHANGES = {
    """    prescribed:
      everywhere: {fracture: main, pressure: "(t/3600) MPa"}""": "    injection: {well: {fracture: main, rate: {value: 2.6e-10 m^2/s}}}",
    "  - {type: two_level,     between: [rock, conduit, tips]}":
        "  - {type: aperture, between: [contact, conduit]}\n"
        "  - {type: two_level, between: [rock, conduit, tips, contact], propagation_threshold: 0.25}",
    "    update: after_step": "    update: within_step",
    "fracture_size: 10 mm": "fracture_size: 20 mm",
    "start: 7.5 h": "start: 0 h",
    "step: 0.05 h": "step: 0.4 h",
    "reaches: 0.25 m": "reaches: 0.05 m",
}


def boundary_elements(scene, increment):
    """Rows of a scene, as numbers by column; `limit`, 0: of short increments."""
    lines = [line for line in (ROOT / "tests/verification/references/sealed_wings.csv").read_text().splitlines() if line[0] != "#"]
    return [{key: float(value) for key, value in row.items() if key != "scene"}
            for row in csv.DictReader(lines)
            if row["scene"] == scene and float(row["increment_m"]) == increment and float(row["length_m"]) > 0]


def through(points, x):
    """The cubic through the four points (x, y) around x."""
    first = min(max(sum(at <= x for at, _ in points) - 2, 0), len(points) - 4)
    near = points[first:first + 4]
    return sum(y * math.prod((x - other) / (at - other) for other, _ in near if other != at) for at, y in near)


class WingsWithinSteps(unittest.TestCase):
    def run_scene(self, folder, angle):
        scene = (ROOT / "configs/verification/wings_sealed.yaml").read_text()
        for old, new in {**CHANGES, "angle: 45 deg": f"angle: {angle} deg"}.items():
            self.assertEqual(scene.count(old), 1, old)
            scene = scene.replace(old, new)
        (Path(folder) / "scene.yaml").write_text(scene)
        run = subprocess.run([SPREKK, "run", Path(folder) / "scene.yaml", "-q", "-o", Path(folder) / "run"],
                             capture_output=True, text=True, timeout=600)
        self.assertEqual(run.returncode, 0, run.stderr)
        return sprekk.Results(Path(folder) / "run").rows

    def test_wings_are_those_of_boundary_elements(self):
        limit = boundary_elements("limit", 0)
        kinks = [(math.log(row["length_m"]), row["direction_deg"]) for row in boundary_elements("45", 0.01)]
        pressures = [(math.log(row["length_m"]), row["pressure_MPa"]) for row in limit]
        lengths_along_x = [(math.log(row["x_m"] - TIP), row["y_m"]) for row in limit]
        for angle in (45, -45):
            with tempfile.TemporaryDirectory() as folder, self.subTest(angle=angle):
                rows = self.run_scene(folder, angle)
                followed = [row for row in rows if row["tips.main_last.length"] > FOLLOWED[1]]
                self.assertGreater(len(followed), 3)
                for row in followed:
                    length = 0.5 * (row["tips.main_first.length"] + row["tips.main_last.length"])
                    needed = 1e6 * through(pressures, math.log(length))
                    self.assertLess(abs(row["fracture_pressure"] / needed - 1), 3e-3, length)
                    # Both wings are equal but for the error of a mesh that is not symmetric.
                    self.assertLess(abs(row["tips.main_first.length"] / row["tips.main_last.length"] - 1), 2e-3, length)
                    for tip, sign in (("first", -1), ("last", 1)):
                        x, y = (sign * row[f"tips.main_{tip}.{axis}"] for axis in "xy")
                        off = math.copysign(1, angle) * y - through(lengths_along_x, math.log(x - TIP))
                        self.assertLess(abs(off), 5e-4, length)
                self.assertGreater(rows[-1]["tips.main_last.x"], TIP + 0.045)
                # The kink where the mesh begins to follow it has the direction of a straight one of its length.
                first = next(row for row in rows if row["tips.main_last.length"] > FOLLOWED[0])
                chord = math.degrees(math.atan2(math.copysign(1, angle) * first["tips.main_last.y"] - TIP,
                                                first["tips.main_last.x"] - TIP))
                self.assertLess(abs(chord - through(kinks, math.log(first["tips.main_last.length"]))), 1)


if __name__ == "__main__":
    unittest.main()
