#!/usr/bin/python3
"""wells_heat_processes_test.py SPREKK MPIEXEC: a doublet of wells with heat, and a shut well through two fractures and the rock, on two
processes: the figures of history.csv are those of one, in turn and in one solve."""

import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
from scene_runs import ROOT, SceneRuns, on_two_processes  # noqa: E402

IDLE = ("components.wells.wells.idle={rate: 0 m^2/s, radius: 0.1 m, places: {upper: {at: [54 m, 62 m], fracture: upper}, "
        "dead: {at: [38 m, 81 m], fracture: dead}, rock: {at: [120 m, 15 m]}}}")
NOT_ANSWERS = ("iterations", "balance_error", "splitting_error", "coupled_residual")


@on_two_processes
class Processes(SceneRuns):
    def compare(self, *settings):
        settings = ("time.end=240 day", "time.step=30 day", "output.fields=false", IDLE, *settings)
        one, two = (self.run_scene(ROOT / "configs/tutorial/heat_doublet.yaml", *settings, processes=n).history for n in (1, 2))
        self.assertEqual(list(one), list(two))
        rates = max(abs(one["wells.inlet.rate[m^2/s]"]))
        self.assertGreater(max(abs(one["wells.idle.dead.rate[m^2/s]"])), 1e-6 * rates)  # fluid passes the shut well
        for column, values in one.items():
            if any(word in column for word in NOT_ANSWERS):
                continue
            size = rates if "m^2/s" in column else max(abs(values))
            self.assertLessEqual(max(abs(values - two[column])), 1e-8 * size, column)
        temperatures = one["heat_advection.idle.temperature[K]"]
        self.assertTrue(all(330 - 1e-9 <= value <= 430 + 1e-9 for value in temperatures))

    def test_in_turn(self):
        self.compare()

    def test_in_one_solve(self):
        self.compare("schedule=[{solve: [pore, conduit, wells, heat, water]}]")


if __name__ == "__main__":
    unittest.main()
