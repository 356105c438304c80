#!/usr/bin/python3
"""stress_pairs_test.py SPREKK: pairs of features of `tools/stress --family pairs` that once had a wrong answer or none, and what the suite itself
must see."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from stress_suite.pairs import answers, features, frame, matrix, unanswered  # noqa: E402

SPREKK = Path(sys.argv.pop(1)).resolve()
NAMED = {feature.name: feature for feature in features.FEATURES}
LIMIT = 60.0  # s, for a run
# The states that walls had in a second look for the answer stayed in the residual of `augmented_lagrangian`: passes ended in cut steps.
MULTIPLIERS = tuple((scheme, "augmented_lagrangian") for scheme in ("iterate", "aitken", "iqn_imvj", "jacobi"))
# A matrix of accelerated steps, learned in steps of another length, led to states in which an equation has no solution.
MATRICES = tuple(("iqn_imvj", other) for other in ("subcycle flow held", "rate and state"))
# Steps that friction of rate and state limits: compared in the same steps.
STEPS = (("restart", "rate and state"), ("iterate", "rate and state"), ("subcycle all", "rate and state"), ("restart", "growth"))
# A tracer that hardly diffuses in a step: the multigrid had nothing for its coarse level.
ALONE = (("belos", "tracer"),)


class StressPairs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.runs = answers.Runs(SPREKK, folder.name, LIMIT, keep=False)

    def test_pairs_that_once_failed(self):
        for names in (*MULTIPLIERS, *MATRICES, *STEPS, *ALONE):
            with self.subTest(pair=names):
                report = matrix.examine(self.runs, 0, *(NAMED[name] for name in names))
                self.assertEqual((report["outcome"], report["failures"]), ("answer", []))

    def test_multipliers_have_the_answer_of_coulomb(self):
        """In turn and together, in the four steps of the scene: none is cut."""
        coulomb = self.runs.of(())
        for names in (("augmented_lagrangian",), *MULTIPLIERS):
            with self.subTest(features=names):
                answer = self.runs.of(tuple(NAMED[name] for name in names))
                self.assertTrue(answers.same_times(answer, coulomb))
                self.assertLess(answers.difference(answer, coulomb)[0], 1e-8)
                self.assertGreater(answer.figures["slip.t[m]"][-1], 1e-5)

    def test_multipliers_in_turn_have_twins(self):
        pair = tuple(NAMED[name] for name in MULTIPLIERS[1])
        answer = self.runs.of(pair)
        for twin in ({"where": frame.Mirrored}, {"where": frame.Turned}, {"scale": matrix.DISTURBED}):
            self.assertLess(answers.difference(self.runs.of(pair, **twin), answer)[0], 1e-8, twin)
        self.assertLess(answers.difference(self.runs.of((*pair, NAMED["two processes"])), answer)[0], 1e-8)

    def test_what_has_no_answer_says_what_would_help(self):
        """Parted walls and a fluid that is hardly compressible: nothing is proposed that the scene has already."""
        for scheme, is_stabilized in (("iterate", False), ("subcycle flow linear", True)):
            with self.subTest(scheme=scheme):
                pair = NAMED[scheme], NAMED["opening"]
                report = matrix.examine(self.runs, 0, *pair)
                self.assertEqual((report["outcome"], report["failures"]), ("unanswered", []))
                said = self.runs.of(pair).failed
                self.assertEqual("stabilize" in said, not is_stabilized, said)
                self.assertNotIn("anderson", said)

    def test_a_pair_that_should_have_an_answer_must(self):
        said = "exit code 1: the iteration does not converge: solve them in one 'solve', or give one of them 'stabilize: response' or 'fixed_stress'"
        self.assertTrue(unanswered.reason(("iterate", "opening"), said))
        self.assertIsNone(unanswered.reason(("fixed stress", "opening"), said))
        self.assertIsNone(unanswered.reason(("iterate", "crossing"), said))
        self.assertIsNone(unanswered.reason(("iterate", "opening"), "exit code 1: singular system"))
        self.assertIsNone(unanswered.reason(("iterate", "opening"), said.replace("exit code 1", "exit code -11")))
        self.assertIsNone(unanswered.reason(("iterate", "opening"), "exit code 1: the iteration does not converge: solve them in one 'solve'"))


class Comparison(unittest.TestCase):
    """What is compared: an answer against one of other steps."""
    coarse = answers.Answer({"time[s]": np.array([1.0, 2.0]), "slip.t[m]": np.array([1e-5, 2e-5])})

    def test_rows_of_the_same_times(self):
        fine = answers.Answer({"time[s]": np.array([0.5, 1.0, 1.5, 2.0]), "slip.t[m]": np.array([9e-5, 1e-5, 9e-5, 2e-5])})
        self.assertEqual(answers.difference(self.coarse, fine)[0], 0)
        fine.figures["slip.t[m]"][1] = 1.5e-5
        self.assertAlmostEqual(answers.difference(self.coarse, fine)[0], 0.5e-5 / 9e-5)

    def test_the_end_where_times_differ(self):
        other = answers.Answer({"time[s]": np.array([0.7, 2.0]), "slip.t[m]": np.array([9e-5, 2e-5])})
        self.assertFalse(answers.same_times(self.coarse, other))
        self.assertEqual(answers.difference(self.coarse, other)[0], 0)


if __name__ == "__main__":
    unittest.main()
