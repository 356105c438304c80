#!/usr/bin/python3
"""viscous_front_test.py SPREKK: a hydraulic fracture between toughness and viscosity, a few cells long, follows the self-similar answer
(tests/verification/references/kgd_self_similar.csv) within the error of its cells, and its tip is at the apparent toughness. With K alone
for a criterion its length is 8 % off."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/benchmark"))
import kgd  # noqa: E402

CELLS = 8  # of one wing at the end; 5 at the start


class ViscousFront(unittest.TestCase):
    def check(self, toughness, *settings):
        with tempfile.TemporaryDirectory() as folder:
            rows, table, log = kgd.run(SPREKK, toughness, CELLS, "within_step", settings, [], folder)
        late = rows[:, 0] > 0.85 * CELLS * kgd.SIZE
        self.assertGreater(np.count_nonzero(late), 3, log)
        grown, right, pressure, opening, load = rows[late].T
        self.assertLess(np.max(abs(grown / right - 1)), 0.02)
        self.assertLess(np.max(abs(pressure - 1)), 0.03)
        self.assertLess(np.max(abs(opening - 1)), 0.02)
        apparent = table["tips.main_last.apparent_toughness"][late] / kgd.toughness_of(toughness)
        np.testing.assert_allclose(load, apparent, rtol=2e-7)
        return apparent

    def test_between_toughness_and_viscosity(self):
        apparent = self.check(1)
        self.assertGreater(np.min(apparent), 1.3)


if __name__ == "__main__":
    unittest.main()
