#!/usr/bin/python3
"""converge_test.py SPREKK: the errors that `sprekk converge` states are those against closed forms; it reaches a wanted error with
the setting that it chooses, keeps runs that are done, and says what it cannot do."""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools"))
from converge_suite.problems import converge, judged, problems  # noqa: E402

EVERY = problems()


class Converge(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.folder = Path(self.holder.name)

    def tearDown(self):
        self.holder.cleanup()

    def test_stated_errors_hold_the_true_ones(self):
        places, beyond = 0, []
        for name in ("terzaghi", "mandel", "fracture_inflow", "biot_manufactured", "single_mode"):
            verdict = judged(SPREKK, EVERY[name], self.folder / name)
            self.assertGreater(verdict.times_too_large, 1, name)
            self.assertLess(verdict.times_too_large, 5, name)
            places += len(verdict.errors)
            beyond += verdict.beyond
        self.assertLessEqual(10 * len(beyond), places, beyond)

    def test_the_coarsest_level_scales_the_error_and_the_stated_one(self):
        # Backward Euler is of first order, and the step makes most of the error: levels that are half as coarse halve it.
        problem, true = EVERY["terzaghi"], {}
        for coarsest in (1, 2, 4):
            found = converge(SPREKK, problem, self.folder / str(coarsest), "--set", "time.step=0.01 s", "--coarsest",
                             str(coarsest))["quantities"][0]
            true[coarsest] = abs(found["value"] - problem.answer)
            self.assertLess(true[coarsest], found["error"], coarsest)
            self.assertLess(found["error"], 5 * true[coarsest], coarsest)
        for coarsest in (2, 4):
            self.assertGreater(true[coarsest] / true[coarsest / 2], 1.4)
            self.assertLess(true[coarsest] / true[coarsest / 2], 2.2)

    def test_a_wanted_error_is_reached_and_runs_are_kept(self):
        problem = EVERY["terzaghi"]
        arguments = ("--set", "time.step=0.0025 s", "--to", "0.5%")
        found = converge(SPREKK, problem, self.folder / "out", *arguments)
        chosen = found["chosen"]
        self.assertTrue(chosen["reached"])
        self.assertLessEqual(abs(chosen["quantities"][0]["value"] - problem.answer), 0.005 * problem.answer)
        self.assertIn("mesh.cells: [", chosen["setting"])
        # Backward Euler is of first order.
        mesh, step = found["quantities"][0]["parameters"]
        self.assertEqual((mesh["name"], step["name"]), ("mesh", "step"))
        self.assertTrue(step["regular"])
        self.assertAlmostEqual(step["order"], 1, delta=0.1)
        written = (self.folder / "out/middle/run.json").stat().st_mtime_ns
        converge(SPREKK, problem, self.folder / "out", *arguments)
        self.assertEqual((self.folder / "out/middle/run.json").stat().st_mtime_ns, written)

    def test_the_table_names_quantities_and_parameters(self):
        scene = ROOT / "configs/verification/terzaghi.yaml"
        done = subprocess.run([SPREKK, "converge", scene, "--of", "p_closed", "--of", "p_middle@0.05 s", "--of", "p_middle@largest",
                               "--set", "mesh.cells=[1, 10]", "-o", self.folder / "out"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"quantity +value +± error +of it +extrapolated +as given +by mesh +by step")
        for name in ("p_closed", "p_middle@0.05 s", "p_middle@largest"):
            self.assertRegex(done.stdout, rf"(?m)^{re.escape(name)} ")
        record = json.loads((self.folder / "out/converge.json").read_text())
        self.assertEqual([one["quantity"] for one in record["quantities"]], ["p_closed", "p_middle@0.05 s", "p_middle@largest"])

    def test_a_section_may_be_replaced(self):
        scene = ROOT / "configs/verification/terzaghi.yaml"
        for settings in (["--set", "mesh.cells=[1, 10]"], ["--set", "mesh=", "--set", "mesh={kind: structured, cells: [1, 10], shape: quadrilaterals}"]):
            done = subprocess.run([SPREKK, "converge", scene, "--of", "p_closed", *settings, "-o", self.folder / str(len(settings))],
                                  capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
        one, other = (json.loads((self.folder / folder / "converge.json").read_text())["quantities"][0]["value"] for folder in "24")
        self.assertEqual(one, other)

    def test_mistakes_are_told(self):
        scene = ROOT / "configs/verification/terzaghi.yaml"
        for arguments, code, message in ((["--of", "p_close"], 2, "did you mean 'p_closed'?"),
                                         (["--of", "p_closed", "--to", "much"], 2, "--to much: this is no error that could be reached"),
                                         (["--of", "p_closed", "--refine", "mush"], 2, "unknown value 'mush'"),
                                         (["--of", "p_closed", "--set", "x"], 2, "'x' sets nothing"),
                                         ([], 2, "--of is required"),
                                         (["--of", "p_closed@1 h"], 2, "has no such value")):
            done = subprocess.run([SPREKK, "converge", scene, "-q", "-o", self.folder / "out", *arguments], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
