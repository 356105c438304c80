#!/usr/bin/python3
"""growth_schemes_test.py SPREKK: growth within steps in every scheme: an iterated scheme finds the advance of the monolithic one, and
substeps tend to the same answer with the step, and a step in which a `when` leaves `grow` out has no growth."""

import unittest

from scene_runs import SceneRuns
from wings import COUPLERS, SCENE, VALUES_OF_PAPER

HOUR = 3600
SWITCH, END = 4400, 6400  # s: both wings have grown within steps before, and the step in between is not cut
TOGETHER = "[{solve: [pore, rock, conduit, contact]}]"
FIXED_STRESS = """[{iterate: {fallback: none, until: {relative: 1e-8}, accelerate: {anderson: 5}, steps: [{solve: [pore, conduit], stabilize: fixed_stress},
  {solve: [rock, contact]}]}}]"""
SUBSTEPS = "[{subcycle: {count: 4, steps: [{solve: [pore, rock, conduit, contact]}]}}]"
GROW = "{grow: tips, settle: [rock, contact], update: within_step}"
LENGTHS = ("tips.main_first.length", "tips.main_last.length")


def then(first, second):
    """A schedule that is `first` before the switch and `second` from then on."""
    return f"{{when: 't < {SWITCH}', steps: {first}}}, {{when: 't >= {SWITCH}', steps: {second}}}"


class GrowthSchemes(SceneRuns):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.together = cls.rows(f"{then(TOGETHER, TOGETHER)}, {GROW}")
        cls.first = next(i for i, row in enumerate(cls.together) if row["time"] > SWITCH)

    @classmethod
    def rows(cls, schedule, end=END, at=()):
        """history.csv of a run with this schedule; steps end `at` these times (s), too."""
        times = ", ".join(f"{time} s" for time in (SWITCH, *at))
        scheme = f"{COUPLERS}schedule: [{schedule}]\ntime: {{end: {end} s}}\noutput: {{fields: false, times: [{times}]}}\n"
        return cls.run_scene([SCENE, cls.write(scheme, "scheme.yaml")], *VALUES_OF_PAPER).rows

    def test_an_iterated_scheme_finds_the_advance_of_the_monolithic_one(self):
        together, first = self.together, self.first
        iterated = self.rows(f"{then(TOGETHER, FIXED_STRESS)}, {GROW}")
        # From the same state on: afterwards meshes of the fine levels may differ in their topology.
        self.assertEqual(together[:first], iterated[:first])
        one, other = together[first], iterated[first]
        self.assertEqual(one["time"], other["time"])
        self.assertNotEqual(one["iterations"], other["iterations"])
        for length in LENGTHS:
            advance = one[length] - together[first - 1][length]
            self.assertGreater(advance, 1e-3)
            # The front is found to 1e-7 in K_eq, the coupled state to 1e-8.
            self.assertLess(abs(other[length] - one[length]), 1e-5 * advance)
        self.assertLess(abs(other["fracture_pressure"] / one["fracture_pressure"] - 1), 1e-6)
        for tip in ("tips.main_first.", "tips.main_last."):
            self.assertLess(abs(other[tip + "K_eq"] / one[tip + "K_eq"] - 1), 2e-7)

    def test_an_iterated_scheme_from_the_start(self):
        # To 4 h: both wings grow from the second hour on, in steps that both schemes find.
        together, iterated = (self.rows(f"{scheme[1:-1]}, {GROW}", end=4 * HOUR) for scheme in (TOGETHER, FIXED_STRESS))
        self.assertEqual(len(together), len(iterated))
        for one, other in zip(together, iterated):
            self.assertLess(abs(other["fracture_pressure"] / one["fracture_pressure"] - 1), 1e-5)
        for length in LENGTHS:
            self.assertGreater(together[-1][length], 0.01)
            self.assertLess(abs(iterated[-1][length] / together[-1][length] - 1), 1e-5)

    def test_substeps_tend_to_the_same_answer(self):
        # Over the same time in one step and in two, with and without substeps: a difference of first order in the step is halved.
        self.assertEqual(len(self.together), self.first + 1)
        half = [0.5 * (SWITCH + END)]
        pairs = [(self.together, self.rows(f"{then(TOGETHER, SUBSTEPS)}, {GROW}")),
                 (self.rows(f"{then(TOGETHER, TOGETHER)}, {GROW}", at=half), self.rows(f"{then(TOGETHER, SUBSTEPS)}, {GROW}", at=half))]
        for whole, parts in pairs:
            self.assertEqual([row["time"] for row in whole], [row["time"] for row in parts])
        self.assertEqual(len(pairs[1][0]), self.first + 2)
        apart = [abs(parts[-1]["fracture_pressure"] - whole[-1]["fracture_pressure"]) for whole, parts in pairs]
        self.assertGreater(apart[0], 1e3)  # Pa
        self.assertLess(apart[1], 0.75 * apart[0])

    def test_nothing_grows_where_growth_is_left_out(self):
        rows = self.rows(f"{{solve: [pore, rock, conduit, contact]}}, {{when: 't < {SWITCH}', steps: [{GROW}]}}", 2 * HOUR)
        self.assertEqual(rows[-1]["time"], 2 * HOUR)
        before, after = ([row for row in rows if (row["time"] - 0.5 * row["step"] < SWITCH) == early] for early in (True, False))
        self.assertGreater(len(after), 0)
        for tip in ("tips.main_first.", "tips.main_last."):
            self.assertGreater(before[-1][tip + "grows"], 0)
            for row in after:
                self.assertEqual(row[tip + "length"], before[-1][tip + "length"])
                self.assertEqual((row[tip + "grows"], row[tip + "speed"]), (0, 0))


class RulesOfTheHeldProcedure(SceneRuns):
    def test_they_are_refused(self):
        for update, option, is_refused in (("within_step", "length=fixed", True), ("within_step", "direction=explicit", True),
                                           ("after_step", "length=fixed", False), ("within_step", "length=arrest", False)):
            schedule = f"schedule=[{{solve: [pore, rock, conduit, contact]}}, {{grow: tips, settle: [rock, contact], update: {update}}}]"
            check = self.call("check", SCENE, schedule, f"components.tips.growth.{option}")
            name, _, value = option.partition("=")
            self.assertEqual(f"'growth.{name}: {value}' has no meaning" in check.stderr, is_refused, check.stderr)
            self.assertEqual(check.returncode != 0, is_refused)


if __name__ == "__main__":
    unittest.main()
