#!/usr/bin/python3
"""diverging_split_test.py SPREKK: a drained split of Terzaghi's column that hardly conducts contracts by alpha^2/(M_v S). Above 1 it is
seen to diverge, with that factor, long before its passes are used up; below 1, however slow, it converges."""

import csv
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
SPLIT = "[{iterate: {until: {at_most: 400}, steps: [{solve: [pore]}, {solve: [rock]}]}}]"
COUPLED = 0.5  # 1/Pa: alpha^2/M_v of the scene


class DivergingSplit(unittest.TestCase):
    def run_split(self, factor, folder, *settings):
        return subprocess.run([SPREKK, "run", "-q", ROOT / "configs/verification/terzaghi.yaml", "-o", folder, "--set", f"schedule={SPLIT}",
                               "--set", f"components.pore.storage={COUPLED / factor!r} 1/Pa", "--set", "components.pore.permeability=1e-9 m^2",
                               "--set", "mesh.cells=[2, 40]", "--set", "time.end=0.01 s", "--set", "time.smallest=0.004 s",
                               *(word for setting in settings for word in ("--set", setting))],
                              capture_output=True, text=True, timeout=60)

    def passes(self, folder):
        with open(Path(folder) / "coupling.csv", newline="", encoding="utf-8") as file:
            return [int(row["iteration[1]"]) for row in csv.DictReader(file) if row["schedule"] == "iterate"]

    def test_a_factor_above_one_is_named_early(self):
        for factor in (1.1, 1.3, 3.0):
            with tempfile.TemporaryDirectory() as folder:
                run = self.run_split(factor, folder + "/out")
                self.assertEqual(run.returncode, 1, run.stderr)
                found = re.search(r"diverges: each pass changes (\S+) ([\d.]+) times as much as the one before", run.stderr)
                self.assertTrue(found, run.stderr)
                self.assertIn(found.group(1), ("pore.pressure", "rock.displacement"))
                self.assertAlmostEqual(float(found.group(2)) / factor, 1, delta=0.02, msg=run.stderr)
                self.assertLessEqual(max(self.passes(folder + "/out")), 15)

    def test_a_factor_below_one_converges(self):
        with tempfile.TemporaryDirectory() as folder:
            run = self.run_split(0.9, folder + "/out")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertGreater(max(self.passes(folder + "/out")), 100)  # 0.9^n below 1e-8


if __name__ == "__main__":
    unittest.main()
