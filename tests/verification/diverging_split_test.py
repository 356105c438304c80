#!/usr/bin/python3
"""diverging_split_test.py SPREKK: a drained split of Terzaghi's column that hardly conducts contracts by alpha^2/(M_v S), in either order.
Above 1 it is seen to diverge, with that factor, long before its passes are used up; below 1, however slow, it converges. Splits of fractures that
cannot work say so within a few attempts."""

import csv
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
ORDERS = ("{solve: pore}, {solve: rock}", "{solve: rock}, {solve: pore}")  # with the strain held, and with the pressure held (drained)
COUPLED = 0.5  # 1/Pa: alpha^2/M_v of the scene


class DivergingSplit(unittest.TestCase):
    def run_split(self, factor, folder, order=ORDERS[0]):
        split = f"[{{iterate: {{fallback: none, until: {{at_most: 400}}, steps: [{order}]}}}}]"
        return subprocess.run([SPREKK, "run", "-q", ROOT / "configs/verification/terzaghi.yaml", "-o", folder, "--set", f"schedule={split}",
                               "--set", f"components.pore.storage={COUPLED / factor!r} 1/Pa", "--set", "components.pore.permeability=1e-9 m^2",
                               "--set", "mesh.cells=[2, 40]", "--set", "time.end=0.01 s"],
                              capture_output=True, text=True, timeout=60)

    def passes(self, folder):
        with open(Path(folder) / "coupling.csv", newline="", encoding="utf-8") as file:
            return [int(row["iteration[1]"]) for row in csv.DictReader(file) if row["schedule"] == "iterate"]

    def test_a_factor_above_one_is_named_early(self):
        for factor, order in ((1.1, ORDERS[0]), (1.3, ORDERS[1]), (3.0, ORDERS[0]), (20.0, ORDERS[1])):
            with tempfile.TemporaryDirectory() as folder:
                run = self.run_split(factor, folder + "/out", order)
                self.assertEqual(run.returncode, 1, run.stderr)
                found = re.search(r"diverges: each pass changes (\S+) ([\d.]+) times as much as the one before", run.stderr)
                self.assertTrue(found, run.stderr)
                self.assertIn(found.group(1), ("pore.pressure", "rock.displacement"))
                self.assertAlmostEqual(float(found.group(2)) / factor, 1, delta=0.02, msg=run.stderr)
                # A shorter step has less diffusion to help: after two cuts the run ends.
                self.assertIn("shorter steps do no better", run.stderr)
                passes = self.passes(folder + "/out")
                self.assertLessEqual(max(passes), 15 if factor < 10 else 5)
                self.assertEqual(passes.count(1), 3)

    def test_fractures_apart_from_what_they_act_on_too_strongly(self):
        # The fluid in a fracture apart from its walls, or from the rock around it: factors of 100 and more (docs/schemes.md), which the first
        # passes show; later ones meet walls that close, and go on without end.
        small = "mesh={size: 0.3 m, fracture_size: 0.02 m, growth: 0.35}"
        for scene, steps, fields in (
                ("paper/onset_coarse", "{solve: conduit}, {solve: [pore, rock, contact]}", r"conduit\.|pore\.wall_flux|rock\.wall_traction"),
                ("paper/onset_coarse", "{solve: [rock, contact, conduit]}, {solve: pore}", r"conduit\.|pore\."),
                ("verification/kgd", "{solve: [rock, contact]}, {solve: conduit}", r"conduit\.")):
            with tempfile.TemporaryDirectory() as folder:
                split = f"schedule=[{{iterate: {{fallback: none, until: {{at_most: 60}}, steps: [{steps}]}}}}]"
                words = [word for setting in ([split, small] if "paper" in scene else [split]) for word in ("--set", setting)]
                run = subprocess.run([SPREKK, "run", "-q", ROOT / f"configs/{scene}.yaml", "-o", folder + "/out", *words],
                                     capture_output=True, text=True, timeout=100)
                passes = self.passes(folder + "/out")
                print(f"    {scene} {steps}: {passes.count(1)} attempts, {len(passes)} passes: {run.stderr[:300]}", flush=True)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertRegex(run.stderr, rf"(each pass|each one still) changes ({fields})\S* .* times as much as the one before")
                self.assertIn("solve them in one 'solve', give one of them 'stabilize: response' or 'fixed_stress'", run.stderr)
                self.assertIn(", or accelerate with 'anderson'", run.stderr)
                self.assertLessEqual(max(passes), 25)
                self.assertLessEqual(passes.count(1), 12)

    def test_a_factor_below_one_converges(self):
        with tempfile.TemporaryDirectory() as folder:
            run = self.run_split(0.9, folder + "/out")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertGreater(max(self.passes(folder + "/out")), 100)  # 0.9^n below 1e-8
            with open(Path(folder) / "out/coupling.csv", newline="", encoding="utf-8") as file:
                changes = [float(row["update[1]"]) for row in csv.DictReader(file) if row["schedule"] == "iterate"]
            for before, after in list(zip(changes, changes[1:]))[10:100]:
                self.assertAlmostEqual(after / before / 0.9, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
