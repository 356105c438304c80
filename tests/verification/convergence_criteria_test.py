#!/usr/bin/python3
"""convergence_criteria_test.py SPREKK: conditions of `until:` compose as they say (all: the latest, any: the first, at least n passes), a
bound of the change, or of the residual, bounds the error by what theory says, `order: jacobi` has the square root of the factor of Gauss and Seidel's order,
and contradictions are refused."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402  pylint: disable=wrong-import-position

TERZAGHI = ROOT / "configs/verification/terzaghi.yaml"
# A column that hardly conducts: the drained split multiplies errors by -alpha^2/(M_v S) = -0.8.
FACTOR = 0.8
COLUMN = (f"components.pore.storage={0.5 / FACTOR!r} 1/Pa", "components.pore.permeability=1e-9 m^2", "mesh.cells=[2, 10]", "time.end=0.01 s",
          "time.smallest=0.009 s")


def iterated(until, order="gauss_seidel", steps="[{solve: pore}, {solve: rock}]"):
    return f"schedule=[{{iterate: {{fallback: none, until: {{{until}}}, order: {order}, steps: {steps}}}}}]"


class ConvergenceCriteria(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name) / "out"

    def call(self, *words, settings=COLUMN):
        return subprocess.run([SPREKK, *words, *(word for setting in settings for word in ("--set", setting))], capture_output=True, text=True,
                              timeout=60)

    def run_scene(self, *settings):
        subprocess.run(["rm", "-rf", self.folder], check=True)
        run = self.call("run", "-q", TERZAGHI, "-o", self.folder, settings=(*COLUMN, *settings))
        self.assertEqual(run.returncode, 0, run.stderr)
        return sprekk.Results(self.folder)

    def passes(self, until):
        return int(self.run_scene(iterated("at_most: 300, " + until))["iterations[1]"][-1])

    def test_conditions_compose(self):
        residual, pressure = "{residual: 1e-7}", "{change_of: pore.pressure, relative: 1e-4}"
        displacement = "{change_of: rock.displacement, relative: 1e-5}"
        alone = {condition: self.passes(f"all: [{condition}]") for condition in (residual, pressure, displacement)}
        self.assertEqual(len(set(alone.values())), 3, alone)
        self.assertEqual(self.passes("relative: 1e-7"), alone[residual])
        for first, second in ((residual, pressure), (displacement, pressure), (pressure, residual)):
            self.assertEqual(self.passes(f"all: [{first}, {second}]"), max(alone[first], alone[second]))
            self.assertEqual(self.passes(f"any: [{first}, {second}]"), min(alone[first], alone[second]))
        self.assertEqual(self.passes(f"all: [{pressure}], any: [{residual}, {displacement}]"),
                         max(alone[pressure], min(alone[residual], alone[displacement])))
        self.assertEqual(self.passes(f"relative: 1e-7, all: [{pressure}]"), max(alone[residual], alone[pressure]))
        for least in (2, alone[pressure], alone[pressure] + 7):
            self.assertEqual(self.passes(f"at_least: {least}, all: [{pressure}]"), max(least, alone[pressure]))

    def test_the_residual_of_one_equation(self):
        # Of this split only the flow has a residual behind a pass: the rock is solved last.
        of_flow, of_rock = "{residual_of: pore.pressure, relative: 1e-7}", "{residual_of: rock.displacement, relative: 1e-7}"
        self.assertEqual(self.passes(f"all: [{of_flow}]"), self.passes("relative: 1e-7"))
        self.assertEqual(self.passes(f"all: [{of_rock}]"), 1)
        self.assertEqual(self.passes(f"relative: 1e-4, all: [{of_flow}]"), self.passes("relative: 1e-7"))

    def test_contact_has_a_bound_of_its_own(self):
        steps = "[{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}]"
        tight = "relative: 1e-6, at_most: 100, all: [{residual_of: contact.traction, relative: 1e-10}, {residual_of: contact.jump, relative: 1e-10}]"
        run = self.call("run", "-q", ROOT / "configs/tutorial/first_scene.yaml", "-o", self.folder, settings=(iterated(tight, steps=steps), "time.end=8 h"))
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.folder / "coupling.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["schedule"] == "iterate"]
        for row, following in zip(rows, [*rows[1:], None]):
            if following is None or following["iteration[1]"] == "1":  # the last pass of a step
                for field in ("traction", "jump"):
                    self.assertLessEqual(float(row[f"residual.contact.{field}[1]"]), 1e-10)

    def test_a_change_bounds_the_error(self):
        # Errors of p alternate and shrink by 0.8: behind a change d is an error 0.8 d/1.8.
        truth = self.run_scene()["p_closed"][-1]
        for bound in (1e-2, 1e-3):
            found = self.run_scene(iterated(f"at_most: 300, all: [{{change_of: pore.pressure, absolute: {bound} Pa}}]"))["p_closed"][-1]
            self.assertLess(abs(found - truth), 1.02 * FACTOR / (1 + FACTOR) * bound)
            self.assertGreater(abs(found - truth), 0.98 * FACTOR ** 2 / (1 + FACTOR) * bound)
        self.assertEqual(self.passes("all: [{change_of: pore.pressure, absolute: 2e-3 Pa}]"),
                         self.passes("all: [{change_of: pore.pressure, absolute: 2e-9 MPa}]"))

    def test_a_residual_bounds_the_error(self):
        # Undrained, what storage takes up for p is what the strain displaces. With an error e of p the residual is e + 0.8 e of it, so behind
        # a residual r, of the terms, p is off by r/1.8 of itself, and by 1/0.8 times as much in the pass before, which was not accepted.
        truth = self.run_scene()["p_closed"][-1]
        for bound in (1e-2, 1e-4, 1e-6):
            found = self.run_scene(iterated(f"at_most: 300, relative: {bound}"))["p_closed"][-1]
            error = abs(found / truth - 1)
            self.assertLess(error, 1.02 * bound / (1 + FACTOR))
            self.assertGreater(error, 0.98 * FACTOR * bound / (1 + FACTOR))

    def test_the_factor_of_jacobi_is_the_square_root(self):
        factors = {}
        for order in ("gauss_seidel", "jacobi"):
            ours = self.run_scene(iterated("relative: 1e-9, at_most: 400", order), "mesh.cells=[2, 40]")
            with open(self.folder / "coupling.csv", newline="", encoding="utf-8") as file:
                changes = [float(row["update[1]"]) for row in csv.DictReader(file) if row["schedule"] == "iterate"][1:]
            middle = len(changes) // 2  # changes of two passes of Jacobi's order belong together
            factors[order] = (changes[middle + 10] / changes[middle]) ** 0.1
            self.assertAlmostEqual(ours["p_closed"][-1], self.run_scene("mesh.cells=[2, 40]")["p_closed"][-1], delta=1e-7)
        self.assertAlmostEqual(factors["gauss_seidel"] / FACTOR, 1, delta=0.01)
        self.assertAlmostEqual(factors["jacobi"] ** 2 / factors["gauss_seidel"], 1, delta=1e-3)

    def test_the_order_of_solves_does_not_matter_to_jacobi(self):
        counts = {self.run_scene(iterated("relative: 1e-9, at_most: 400", "jacobi", steps))["iterations[1]"][-1]
                  for steps in ("[{solve: pore}, {solve: rock}]", "[{solve: rock}, {solve: pore}]")}
        self.assertEqual(len(counts), 1)

    def test_contradictions_are_refused(self):
        change = "{change_of: pore.pressure, relative: 1e-4}"
        for until, words in (("at_least: 5, at_most: 4", "'at_least' is larger"),
                             ("at_least: 0", "at_least"),
                             ("all: [{}]", "bounds nothing"),
                             ("all: [{residual: 1e-6, change_of: pore.pressure}]", "one condition bounds"),
                             ("all: [{residual: 1e-6, relative: 1e-6}]", "no effect"),
                             ("all: [{change_of: pore.pressure}]", "has no bound"),
                             ("all: [{change_of: pore.pressure, relative: 1e-4, absolute: 1 Pa}]", "two bounds"),
                             ("all: [{change_of: pore.presure, relative: 1e-4}]", "pore.pressure"),
                             ("all: [{change_of: pore.pressure, absolute: 1 m}]", "Pa"),
                             ("all: [{change_of: pore.pressure, absolute: 0 Pa}]", "never seen"),
                             (f"at_most: 1, all: [{change}]", "no change to be seen"),
                             (f"at_most: 1, any: [{change}]", "no change to be seen"),
                             ("relative: 1e-8, any: [{residual: 1e-7}, " + change + "]", "no effect"),
                             ("relative: 1e-8, all: [{residual: 1e-7}]", "two bounds"),
                             ("all: [{residual_of: pore.pressure}]", "has not one bound"),
                             ("all: [{residual_of: pore.pressure, absolute: 1 Pa, relative: 1e-8}]", "has not one bound"),
                             ("all: [{residual_of: pore.presure, relative: 1e-8}]", "pore.pressure"),
                             ("relative: 1e-8, all: [{residual_of: pore.pressure, relative: 1e-7}]", "no effect"),
                             ("all: [{residual: 2}]", "residual")):
            answer = self.call("check", TERZAGHI, "--set", iterated(until))
            self.assertEqual(answer.returncode, 2, until)
            self.assertIn(words, answer.stderr, until)
        answer = self.call("check", TERZAGHI, "--set", iterated("relative: 1e-8", "jacobi", "[{solve: [pore, rock]}]"))
        self.assertEqual(answer.returncode, 2)
        self.assertIn("'order: jacobi' has no effect", answer.stderr)
        self.assertEqual(self.call("check", TERZAGHI, "--set", iterated(f"at_least: 2, relative: 1e-8, all: [{change}]")).returncode, 0)
        loose = "[{solve: pore, newton: {residual: 1e-7}}, {solve: rock}]"
        self.assertIn("'newton: residual' is larger",
                      self.call("check", TERZAGHI, "--set", iterated("all: [{residual: 1e-8}]", steps=loose)).stderr)


if __name__ == "__main__":
    unittest.main()
