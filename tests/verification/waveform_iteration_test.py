#!/usr/bin/python3
"""waveform_iteration_test.py SPREKK: `subcycle` inside `iterate` on a smooth problem, against monolithic runs with small steps: the order of the
scheme in time is kept, with fields that wait held (first) or linear in time (first and second), whatever is subcycled; fluid is conserved; a
restart goes on to the bit; mistakes are refused."""

import math
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns

MANDEL = ROOT / "configs/verification/mandel.yaml"
SMOOTH = ('components.rock.boundary.top={displacement_y: "(-1e-4*sin(pi*t/20000)^2) m"}', "mesh.size=0.25 m", "time.end=8000 s")
SDIRK2 = "time.scheme=sdirk2"
STEPS = (1000, 500, 250)


def schedule(flow, rock, waiting, until="relative: 1e-10", flow_first=True):
    """With `flow` and `rock` substeps."""
    def substeps(count, steps):
        return f"{{subcycle: {{count: {count}, waiting: {waiting}, steps: [{steps}]}}}}" if count > 1 else steps
    solves = [substeps(flow, "{solve: pore, stabilize: fixed_stress}"), substeps(rock, "{solve: rock}")]
    steps = ", ".join(solves if flow_first else solves[::-1])
    return f"schedule=[{{iterate: {{until: {{{until}, at_most: 100}}, accelerate: {{anderson: 5}}, steps: [{steps}]}}}}]"


class WaveformIteration(SceneRuns):
    def errors(self, reference, *settings):
        truth = np.asarray(reference.fields()["pore.pressure"])
        found = [np.asarray(self.run_scene(MANDEL, *SMOOTH, f"time.step={step} s", *settings).fields()["pore.pressure"]) for step in STEPS]
        return [np.abs(p - truth).max() / np.abs(truth).max() for p in found]

    def test_orders(self):
        reference = self.run_scene(MANDEL, *SMOOTH, SDIRK2, "time.step=31.25 s")
        for flow, rock, waiting, flow_first, settings, order in ((4, 1, "held", True, (), 1), (4, 1, "linear", True, (), 1),
                                                                 (4, 1, "linear", True, (SDIRK2,), 2), (3, 2, "linear", True, (SDIRK2,), 2),
                                                                 (2, 4, "linear", False, (SDIRK2,), 2)):
            with self.subTest(flow=flow, rock=rock, waiting=waiting, order=order):
                errors = self.errors(reference, schedule(flow, rock, waiting, flow_first=flow_first), *settings)
                orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
                for found in orders:
                    self.assertGreater(found, order - 0.15, (errors, orders))
                    if order == 2:
                        self.assertLess(found, 2.15, (errors, orders))
                # Two stages and a linear course are better than one.
                self.assertLess(errors[-1], 0.3 if order == 1 else 0.005)

    def test_fluid_is_conserved_and_a_restart_goes_on_to_the_bit(self):
        settings = (SDIRK2, schedule(4, 1, "linear"), "time.step=1000 s")
        whole = self.run_scene(MANDEL, *SMOOTH, *settings)
        self.assertLess(np.abs(whole["fluid_balance_error[m^2]"]).max(), 1e-10 * np.abs(whole["fluid_outflow[m^2]"]).max())
        self.assertLess(max(whole["iterations[1]"]), 40)
        parts = self.run_scene(MANDEL, *SMOOTH, *settings, "time.end=4000 s")
        parts = self.run_scene(MANDEL, *SMOOTH, *settings, restart=parts.folder)
        self.assert_same_bits(parts, whole)

    def test_the_error_of_the_iteration_is_below_its_bound(self):
        found = {bound: np.asarray(self.run_scene(MANDEL, *SMOOTH, schedule(4, 1, "linear", f"relative: {bound}"), "time.step=2000 s").fields()["pore.pressure"])
                 for bound in (1e-4, 1e-6, 1e-11)}
        for bound in (1e-4, 1e-6):
            # Of four steps; errors of one are passed on to the next.
            self.assertLess(np.abs(found[bound] - found[1e-11]).max(), 4 * bound * np.abs(found[1e-11]).max())

    def test_mistakes(self):
        nested = ("schedule=[{iterate: {steps: [{subcycle: {count: 2, steps: [{subcycle: {count: 2, steps: [{solve: pore}]}}]}}, "
                  "{solve: rock}]}}]")
        for setting, words in ((schedule(4, 1, "linear", "all: [{residual: 1e-8}]"), "there is no residual"), (nested, "stands inside of another one"),
                               (schedule(4, 1, "quadratic"), "waiting")):
            answer = self.call("check", MANDEL, *SMOOTH, setting)
            self.assertEqual(answer.returncode, 2, answer.stdout)
            self.assertIn(words, answer.stderr)
        # What does not converge says which field.
        answer = self.call(["run", "-q", "-o", self.folder / "stops"], MANDEL, *SMOOTH, schedule(4, 1, "linear", "relative: 1e-9").replace("at_most: 100", "at_most: 3"),
                           "time.smallest=900 s", "time.step=1000 s")
        self.assertEqual(answer.returncode, 1)
        self.assertIn("no convergence in 3 passes: the last change of ", answer.stderr)


if __name__ == "__main__":
    unittest.main()
