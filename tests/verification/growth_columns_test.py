#!/usr/bin/python3
"""growth_columns_test.py SPREKK: what history.csv tells of tips that grow, and the paths in the pictures, fit to one another: lengths
are those of the lines that are drawn, tips are at their ends, and advance by speed times step."""

import math
import unittest

from scene_runs import SceneRuns, sprekk
from wings import SCENE, VALUES_OF_PAPER, WITHIN_STEPS

FRACTURE = 0.1  # m, before growth
TIPS = ("tips.main_first", "tips.main_last")


def segments(grid):
    """[(x, y), (x, y)] of each line of a file."""
    return [[tuple(grid.points[point][:2]) for point in cell] for cell in grid.cells]


class GrowthColumns(SceneRuns):
    def check(self, overlay, *settings):
        scenes = [SCENE, self.write(overlay, "overlay.yaml")] if overlay else [SCENE]
        results = self.run_scene(scenes, *VALUES_OF_PAPER, "time.end=2.5h", "output.every=15min", *settings)
        for column, unit in (("x", "m"), ("y", "m"), ("speed", "m/s"), ("grows", "1")):
            for tip in TIPS:
                self.assertIn(f"{tip}.{column}[{unit}]", results.history)
        for tip in TIPS:
            self.advance_is_speed_times_step(results.rows, tip)
        return self.lengths_are_those_of_lines(results.folder, results.rows)

    def advance_is_speed_times_step(self, rows, tip):
        sign = 1 if tip.endswith("last") else -1
        before = [1 + sign * FRACTURE / 2 * math.sqrt(0.5)] * 2
        length, grown = 0, 0
        for row in rows:
            here = [row[tip + ".x"], row[tip + ".y"]]
            moved, advance = math.dist(here, before), row[tip + ".speed"] * row["step"]
            self.assertEqual(row[tip + ".grows"], float(row[tip + ".speed"] > 0))
            if row[tip + ".grows"]:
                # A step bends the path a little, and the mesh straightens paths that it takes over.
                self.assertAlmostEqual(moved / advance, 1, delta=0.05)
                self.assertAlmostEqual((row[tip + ".length"] - length) / advance, 1, delta=0.05)
                grown += 1
            else:
                self.assertEqual(moved, 0)
            before, length = here, row[tip + ".length"]
        self.assertGreater(grown, 5)
        self.assertGreater(length, 0.01)

    def lengths_are_those_of_lines(self, folder, rows):
        """Returns at how many times there were paths beyond the mesh, and at how many the mesh had grown."""
        fractures, paths = (dict(sprekk.read_pvd(folder / f"{name}.pvd")) for name in ("fractures", "paths"))
        beyond = taken_over = 0
        for row in rows:
            if row["time"] not in fractures:
                continue
            lines = segments(sprekk.read_vtu(fractures[row["time"]]))
            in_mesh = len(lines)
            if row["time"] in paths:
                lines += segments(sprekk.read_vtu(paths[row["time"]]))
            beyond += len(lines) > in_mesh
            taken_over += in_mesh > 5
            self.assertAlmostEqual(sum(math.dist(*line) for line in lines) - FRACTURE,
                                   sum(row[tip + ".length"] for tip in TIPS), delta=1e-12)
            ends = [end for line in lines for end in line]
            for tip in TIPS:
                self.assertEqual(ends.count((row[tip + ".x"], row[tip + ".y"])), 1, tip)
        return beyond, taken_over

    def test_of_the_held_procedure(self):
        beyond, taken_over = self.check("", "schedule.1.update=after_step")
        self.assertGreater(beyond, 3)
        self.assertGreater(taken_over, 0)

    def test_within_steps(self):
        beyond, taken_over = self.check(WITHIN_STEPS)
        self.assertGreater(beyond, 1)
        self.assertGreater(taken_over, 3)

    def test_of_repeated_steps(self):
        self.check("", "schedule.1.update=repeat_step", "time.end=3h")


if __name__ == "__main__":
    unittest.main()
