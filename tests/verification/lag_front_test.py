#!/usr/bin/python3
"""lag_front_test.py SPREKK: a hydraulic fracture whose fluid lags behind its tips (`cavitation`) grows within steps as the self-similar answer
(tests/verification/references/kgd_lag.csv) within the error of its cells: twice as fast as one full of fluid. Its tip is at its toughness,
and no fluid is lost. A bound that never binds changes nothing, and neither does a rate that is larger by 1e-9."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tools/benchmark"), str(ROOT / "tools/python")]
import kgd  # noqa: E402
from sprekk import read_table  # noqa: E402

NUMBER = 0.5  # toughness
CELLS = 9  # of one wing at the end; 5 at the start
COARSE = ["mesh.growth=0.25", "components.tips.sectors=8"]
BOUND = "components.conduit.cavitation="  # Pa


class LagFront(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        lines = (kgd.REFERENCES / "kgd_lag.csv").read_text().splitlines()
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        self.answer = {key: float(value) for row in rows if float(row["K"]) == NUMBER for key, value in row.items()}

    def tearDown(self):
        self.holder.cleanup()

    def run_of(self, name, gamma, settings):
        """Until a fracture with this gamma has CELLS cells."""
        folder = Path(self.holder.name) / name
        folder.mkdir()
        end = (CELLS * kgd.SIZE / gamma) ** 1.5 / (kgd.PLANE_MODULUS * kgd.RATE**3 / (12 * kgd.VISCOSITY)) ** 0.25
        scene = folder / "kgd.yaml"
        scene.write_text(kgd.SCENE.format(
            start=kgd.FIRST * kgd.SIZE, far=4 * CELLS * kgd.SIZE, growth=0.25, box=40 * CELLS * kgd.SIZE, size=kgd.SIZE, viscosity=kgd.VISCOSITY,
            half_rate=kgd.RATE / 2, toughness=kgd.toughness_of(NUMBER), increment=kgd.SIZE, end=end, step=end / 40) + kgd.WITHIN_STEP)
        command = [SPREKK, "run", ROOT / "configs/verification/kgd.yaml", scene, "-q", "-o", folder / "run", "--set", "output.fields=false"]
        for setting in (*COARSE, *settings):
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("more fluid than there is", done.stderr)
        return {key.partition("[")[0]: np.array(values, float) for key, values in read_table(str(folder / "run/history.csv")).items()}

    def assert_same(self, one, other, tolerance, of_length):
        for name in ("time", "tips.main_last.length", "pressure", "opening.n"):
            np.testing.assert_allclose(one[name], other[name], rtol=of_length if name.endswith("length") else tolerance, atol=1e-12)

    def test_a_fracture_with_a_lag(self):
        table = self.run_of("lag", self.answer["gamma"], [BOUND + "0 Pa"])
        time, length = table["time"], kgd.FIRST * kgd.SIZE + table["tips.main_last.length"]
        late = length > 0.8 * CELLS * kgd.SIZE
        self.assertGreater(np.count_nonzero(late), 8)
        unit = (kgd.PLANE_MODULUS * kgd.RATE**3 * time**4 / (12 * kgd.VISCOSITY)) ** (1 / 6)
        small = (12 * kgd.VISCOSITY / (kgd.PLANE_MODULUS * time)) ** (1 / 3)
        right = self.answer["gamma"] * unit
        # The front is in one cell or the next: the pressure at the well goes up and down with it.
        self.assertLess(np.max(abs(length / right - 1)[late]), 0.04)
        self.assertLess(abs(np.mean((length / right)[late]) - 1), 0.015)
        # In the middle of the first cell; at the well -W^3 dPi/dxi = int W = 1/(2 gamma^2).
        gamma, opening = self.answer["gamma"], self.answer["opening"]
        pressure = self.answer["pressure"] - 0.5 * kgd.SIZE / right / (2 * gamma**2 * (opening / gamma) ** 3)
        self.assertLess(abs(np.mean((table["pressure"] / (small * kgd.PLANE_MODULUS * pressure))[late]) - 1), 0.02)
        self.assertLess(np.max(abs(table["opening.n"] / (small * unit * self.answer["opening"]) - 1)[late]), 0.015)
        # A third and more of the volume is beyond the front. No fluid that holds the tip back is near it.
        self.assertGreater(np.min(table["conduit.empty_volume"][late] / table["fluid_injected"][late]), 0.1)
        np.testing.assert_allclose(table["tips.main_last.K_eq"][late], kgd.toughness_of(NUMBER), rtol=2e-7)
        self.assertLess(np.max(abs(table["fluid_balance_error"])), 1e-10 * table["fluid_injected"][-1])
        more = f"components.conduit.injection.well.rate={kgd.RATE / 2 * (1 + 1e-9):.17g} m^2/s"
        self.assert_same(table, self.run_of("twin", self.answer["gamma"], [BOUND + "0 Pa", more]), 1e-6, 1e-6)

    def test_a_bound_that_never_binds(self):
        gamma = kgd.SelfSimilar(NUMBER).gamma * 1.3  # a shorter run
        precise = "components.tips.growth.front_tolerance=1e-9"  # of K: lengths and pressures have no other error
        without = self.run_of("without", gamma, [precise])
        bound = self.run_of("bound", gamma, [precise, BOUND + "-1 GPa"])
        self.assertEqual(np.max(bound["conduit.empty_volume"]), 0)
        self.assert_same(without, bound, 1e-9, 1e-9)


if __name__ == "__main__":
    unittest.main()
