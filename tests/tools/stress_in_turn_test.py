#!/usr/bin/python3
"""stress_in_turn_test.py SPREKK: scenes of tools/stress with flow and rock solved in turn that once gave up. Each must answer without a
cut; what it answers is checked by tools/stress (contact, momentum, balances)."""

import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
# Passes that cycle between states of contact; balances that a solve with small residuals had not looked at.
SCENES = (("fixed_stress", 19), ("fixed_stress", 34), ("accelerated", 19))


class StressInTurn(unittest.TestCase):
    def test_scenes_that_gave_up(self):
        for scheme, number in SCENES:
            run = subprocess.run([ROOT / "tools/stress", "--scheme", scheme, "--seed", "7", "--only", str(number), "--jobs", "1",
                                  "--program", SPREKK], capture_output=True, text=True, timeout=100)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertTrue(run.stdout.startswith("answer: 0 cuts"), run.stdout)


if __name__ == "__main__":
    unittest.main()
