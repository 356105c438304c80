#!/usr/bin/python3
"""inexact_solves_test.py SPREKK: inside an `iterate` that looks at the residual of all equations a `solve` may end after one iteration: the
answer is the monolithic one. Where the iteration looks at changes alone such a solve is refused as one that did not converge."""

import csv
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

# Walls slip in the first step: with all in one `solve` it takes three iterations and more.
SCENE = ROOT / "configs/tutorial/first_scene.yaml"
SETTINGS = ("time.end=12 h",)


def schedule(until, newton=", newton: {at_most: 1}"):
    return (f"schedule=[{{iterate: {{fallback: none, until: {{{until}}}, steps: [{{solve: [pore, conduit], stabilize: fixed_stress{newton}}}, "
            f"{{solve: [rock, contact]{newton}}}]}}}}]")


class InexactSolves(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def call(self, name, *settings, before=()):
        return subprocess.run([*before, SPREKK, "run", "-q", SCENE, "-o", self.folder / name,
                               *(word for setting in (*SETTINGS, *settings) for word in ("--set", setting))],
                              capture_output=True, text=True, timeout=100)

    def results(self, name, *settings, before=()):
        run = self.call(name, *settings, before=before)
        self.assertEqual(run.returncode, 0, run.stderr)
        return sprekk.Results(self.folder / name)

    def expect_same(self, ours, truth):
        self.assertEqual(len(ours.rows), len(truth.rows))  # none was cut
        for field in ("conduit.pressure[Pa]", "conduit.aperture[m]"):
            right = truth.fields(kind="fractures")[field.split("[")[0]]
            found = ours.fields(kind="fractures")[field.split("[")[0]]
            self.assertLessEqual(np.abs(found - right).max(), 1e-7 * np.abs(right).max(), field)

    def test_one_iteration_in_each_pass_finds_the_monolithic_answer(self):
        truth = self.results("together")
        self.assertGreater(truth.rows[-1]["contact.cells_slip"], 0)
        inexact = self.results("inexact", schedule("relative: 1e-10, at_most: 100"))
        self.expect_same(inexact, truth)
        with open(inexact.folder / "coupling.csv", newline="", encoding="utf-8") as file:
            iterations = {int(row["iteration[1]"]) for row in csv.DictReader(file) if row["schedule"].startswith("solve")}
        self.assertEqual(iterations, {0, 1})

    @unittest.skipUnless(shutil.which("mpirun"), "no mpirun")
    def test_on_two_processes(self):
        one = self.results("one", schedule("relative: 1e-10, at_most: 100"))
        two = self.results("two", schedule("relative: 1e-10, at_most: 100"), before=("mpirun", "-n", "2", "--oversubscribe"))
        self.expect_same(two, one)

    def test_changes_alone_do_not_see_it(self):
        run = self.call("changes", schedule("at_most: 100, all: [{change_of: pore.pressure, relative: 1e-8}]"), "time.smallest=30 min")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("no convergence in 1 iterations", run.stderr)


if __name__ == "__main__":
    unittest.main()
