#!/usr/bin/python3
"""flow_benchmarks_test.py SPREKK [MPIEXEC]: cases 1, 3 and 4 of Flemisch and others, Adv. Water Resour. 111 (2018) 239 (case 2, the
regular network, is in junction_flow_test.cpp), against the paper's reference (3) and finite elements (1, 4) in tests/verification/references.

Errors are relative to the range of the pressures of the reference. Twins: turned and mirrored, with values that are disturbed by 1e-9,
and on two processes."""

import sys
import unittest

import numpy as np

from scene_runs import ROOT, SceneRuns, on_two_processes

CONFIGS = ROOT / "configs/verification"
FROM_THE_TOP = ["components.pore.boundary=", "components.pore.boundary={top: {pressure: 4 Pa}, bottom: {pressure: 1 Pa}}"]


def reference(name):
    return np.loadtxt(ROOT / f"tests/verification/references/{name}.csv", delimiter=",")


class FlowBenchmarks(SceneRuns):
    def pressures(self, name, places, *settings, processes=1, turn=None):
        """The pressures of the rock at places, and the results of the run. `turn`: an angle (degrees), and whether it is mirrored."""
        scene = CONFIGS / f"{name}.yaml"
        probes = ", ".join(f"p{i}: {{of: pore.pressure, at: [{float(x)!r} m, {float(y)!r} m]}}" for i, (x, y) in enumerate(places))
        if turn:
            whole = self.write(f"{scene.read_text()}\noutput: {{fields: false, probes: {{{probes}}}}}\n")
            results = self.run_scene(self.turned(whole, turn[0], mirror=turn[1]))
        else:
            results = self.run_scene(scene, "output.fields=false", f"output.probes={{{probes}}}", *settings, processes=processes)
        topics = {note["topic"] for note in results.record["notes"]} - {"too few unknowns for several processes"}
        if name != "outcrop_network":  # which has pockets and sharp angles
            self.assertEqual(topics, {"scene without dimensions"} if name == "complex_network" else set())
        return np.array([results.history[f"p{i}[Pa]"][-1] for i in range(len(places))]), results

    def errors(self, found, wanted):
        difference = np.abs(found - wanted) / (wanted.max() - wanted.min())
        print(f"{self.id().split('.')[-1]}: root mean square {np.sqrt((difference**2).mean()):.2e}, largest {difference.max():.2e}", file=sys.stderr)
        return np.sqrt((difference**2).mean()), difference.max()

    def test_two_zones_below_valleys(self):
        rows = reference("hydrocoin")
        found, results = self.pressures("hydrocoin", [(x, -200.0) for x in rows[:, 0]])
        # Zones without width leave rock in their place, and heads fall by what passes the wall (a third of 1.2e-6 m^2/s over 700 m of
        # each wall) times 4 to 7 m over 1e-8 m/s: by 0.2 to 0.4 m of 12 m.
        self.assertLess(self.errors(found, rows[:, 1])[1], 0.03)
        # The same without width.
        mean, largest = self.errors(found, rows[:, 2])
        self.assertLess(mean, 0.003)
        self.assertLess(largest, 0.005)
        self.assertLess(abs(results.history["fluid_balance_error[m^2]"][-1]), 1e-16)

    def complex_network(self, *settings, **how):
        rows = reference("complex_network")
        found, _ = self.pressures("complex_network", [(x, 0.5 + 0.4 * x) for x in rows[:, 0]], *settings, **how)
        return found, rows

    def test_barriers_and_conductors_from_left_to_right(self):
        found, rows = self.complex_network()
        mean, largest = self.errors(found, rows[:, 2])
        self.assertLess(mean, 0.005)
        self.assertLess(largest, 0.015)

    def test_barriers_and_conductors_from_top_to_bottom(self):
        found, rows = self.complex_network(*FROM_THE_TOP)
        mean, largest = self.errors(found, rows[:, 1])
        self.assertLess(mean, 0.005)
        self.assertLess(largest, 0.015)

    def test_a_conductor_that_goes_through_is_another_answer(self):
        found, rows = self.complex_network("components.conduit.crossings={a: {between: [barrier_1, f10], through: f10}, b: {between: [barrier_2, "
                                           "f7], through: f7}, c: {between: [barrier_2, f8], through: f8}}")
        self.assertGreater(self.errors(found, rows[:, 2])[1], 0.1)

    def test_an_outcrop(self):
        rows = reference("outcrop_network")
        found, results = self.pressures("outcrop_network", rows[:, :2])
        mean, largest = self.errors(found, rows[:, 2])
        self.assertLess(mean, 0.005)
        self.assertLess(largest, 0.03)
        flow = results.history["pore.right.outflow[m^2/s]"][-1] + results.history["conduit.right.outflow[m^2/s]"][-1]
        self.assertLess(abs(flow / 6.34956e-5 - 1), 0.02)
        self.assertLess(abs(results.history["fluid_balance_error[m^2]"][-1]), 1e-9 * flow)

    def test_disturbed(self):
        found, rows = self.complex_network()
        disturbed, _ = self.complex_network("components.conduit.transmissivity_value={fractures: {barrier_1: 1.000000001e-8 m^3, barrier_2: "
                                            "1.000000002e-8 m^3, f7: 1.000000001 m^3, default: 1 m^3}}")
        self.assertLess(np.abs(found - disturbed).max(), 1e-8)

    def test_turned_and_mirrored(self):
        plain, _ = self.complex_network()
        for turn in ((30, False), (77, True)):
            self.assertLess(np.abs(self.complex_network(turn=turn)[0] - plain).max(), 1e-8, turn)

    @on_two_processes
    def test_two_processes(self):
        one, two = (self.complex_network(processes=n)[0] for n in (1, 2))
        self.assertLess(np.abs(one - two).max(), 1e-10)


if __name__ == "__main__":
    unittest.main()
