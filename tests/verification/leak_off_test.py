#!/usr/bin/python3
"""leak_off_test.py SPREKK: a hydraulic fracture in permeable rock that has lost half of its fluid by Carter's leak-off follows the
semi-analytic answer (tests/verification/references/kgd_leak_off.csv). Without leak-off it would be 60 % longer. On longer fractures, with
more cells: tools/benchmark/kgd_leak_off.py."""

import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/benchmark"))
import kgd_leak_off  # noqa: E402

CELLS, SIZE, DEPTH = 9, 0.5, 0.7  # of one wing at the end; m; m: fluid goes 1.4 cells into the rock
COARSE = ["mesh.growth=0.25"]


class LeakOff(unittest.TestCase):
    def test_where_viscosity_rules(self):
        with tempfile.TemporaryDirectory() as folder:
            rows, table, log = kgd_leak_off.run(SPREKK, "viscosity", CELLS, SIZE, DEPTH, COARSE, folder, steps=10, box=30)
        late = rows[:, 0] > 0.85 * CELLS * SIZE
        self.assertGreater(np.count_nonzero(late), 1, log)
        grown, right, pressure, opening = rows[late].T
        self.assertLess(np.max(abs(grown / right - 1)), 0.03)
        self.assertLess(np.max(abs(pressure - 1)), 0.05)
        self.assertLess(np.max(abs(opening - 1)), 0.04)
        # The tip moves on faster than fluid goes through a cell: a note tells it once, with figures.
        told = re.findall(r"moves at (\S+) m/s, .* diffusivity (\S+) m\^2/s: leak-off behind the tip reaches (\S+) m into cells of (\S+) m", log)
        self.assertEqual(len(told), 1, log)
        speed, diffusivity, reach, cell = map(float, told[0])
        self.assertAlmostEqual(reach, diffusivity / speed, delta=0.02 * reach)
        self.assertAlmostEqual(diffusivity, DEPTH**2 / table["time"][-1], delta=0.02 * diffusivity)
        self.assertLess(reach, cell)
        # What is injected is in the fracture and in the pores.
        self.assertLess(abs(table["fluid_balance_error"][-1]), 1e-9 * table["fluid_injected"][-1])


if __name__ == "__main__":
    unittest.main()
