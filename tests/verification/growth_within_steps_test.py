#!/usr/bin/python3
"""growth_within_steps_test.py SPREKK: wings that grow within steps rest at their toughness in the state at the end of each
step, with the fluid that is there, and a run that is interrupted and goes on has the same bits."""

import signal
import subprocess
import time
import unittest

from scene_runs import SceneRuns, sprekk
from wings import SCENE, TAKEN_OVER, VALUES_OF_PAPER, WITHIN_STEPS

TOUGHNESS = 0.7e6  # Pa m^0.5, of the scene


class GrowthWithinSteps(SceneRuns):
    def test_tips_rest_at_their_toughness(self):
        scenes, settings = [SCENE, self.write(WITHIN_STEPS, "within.yaml")], (*VALUES_OF_PAPER, "time.end=4 h", "schedule.1.overshoot=2e-3")
        results = self.run_scene(scenes, *settings)
        rows = results.rows
        followed = [row for row in rows if min(row["tips.main_first.length"], row["tips.main_last.length"]) > TAKEN_OVER]
        self.assertGreater(len(followed), 4)
        tips = ("tips.main_first.", "tips.main_last.")
        for row in followed:
            # The advances take the energy that they release; each tip has its toughness to the error of the mesh. Tips whose loads differ by
            # less than two errors advance alike. (Where a segment is divided, the column of the speed has the change of the path, too.)
            excess = [row[tip + "K_eq"] / row[tip + "apparent_toughness"] - 1 for tip in tips]
            speeds = [row[tip + "speed"] for tip in tips]
            difference = abs(excess[0] - excess[1])
            self.assertLess(difference, 2.5e-3)
            if difference < 1.99e-3:
                self.assertAlmostEqual(speeds[0] / speeds[1], 1, delta=3e-3)
                speeds = [1, 1]
            self.assertAlmostEqual(sum(e * v for e, v in zip(excess, speeds)) / sum(speeds), 0, delta=2e-7 + max(map(abs, excess)) ** 2)
            for tip in tips:
                # Viscosity has no part at this speed.
                self.assertAlmostEqual(row[tip + "apparent_toughness"] / TOUGHNESS, 1, delta=1e-4)
                self.assertLess(abs(row[tip + "K_II"]), 2e-6 * row[tip + "K_I"])
        # Both wings of the point-symmetric fracture differ by the error of a mesh that is not symmetric.
        self.assertLess(abs(rows[-1]["tips.main_first.length"] / rows[-1]["tips.main_last.length"] - 1), 0.01)
        # The wings take no fluid at once: the pressure rises all the time.
        pressures = [row["fracture_pressure"] for row in rows]
        self.assertTrue(all(after > before for before, after in zip(pressures, pressures[1:])), pressures)
        for row in rows:
            self.assertLess(abs(row["fluid_balance_error"]), 1e-9 * row["fluid_injected"])
        # An interrupted run that goes on has the same bits.
        run = subprocess.Popen(self.command(["run", "-q", "-o", self.folder / "again"], scenes, *settings), stderr=subprocess.DEVNULL)
        history = self.folder / "again/history.csv"
        for _ in range(2000):
            if run.poll() is not None or (history.exists() and len(history.read_text().splitlines()) > 14):
                break
            time.sleep(0.05)
        run.send_signal(signal.SIGINT)
        run.wait(timeout=100)
        self.assertLess(len(sprekk.Results(self.folder / "again").times), len(rows))
        self.run_scene(scenes, *settings, restart=self.folder / "again")
        self.assertEqual(history.read_text(), (results.folder / "history.csv").read_text())


if __name__ == "__main__":
    unittest.main()
