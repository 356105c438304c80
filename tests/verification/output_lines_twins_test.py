#!/usr/bin/python3
"""output_lines_twins_test.py SPREKK MPIEXEC: tables along lines (output: lines) in a turned and in a mirrored scene, with a rate of
1 + 1e-9, and on two processes have the scalars of the scene, its vectors and its tensors, turned or mirrored.

The scene is configs/tutorial/first_scene.yaml: cells have values of their own on both sides of its fracture, which the lines cross."""

import csv
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns, on_two_processes

SCENE = ROOT / "configs/tutorial/first_scene.yaml"
PLACE = "from: [1.03 m, 4.9 m], to: [8.7 m, 1.2 m], points: 38"  # crosses the fracture between two points
FIELDS = {"pressure": "pore.pressure", "flow": "pore.velocity", "motion": "rock.displacement", "load": "rock.stress"}
LINES = "  fields: false\n  lines:\n" + "".join(f"    {name}: {{of: {field}, {PLACE}}}\n" for name, field in FIELDS.items())


def rotation(angle, mirror):
    c, s = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    return np.array([[c, -s], [s, c]]) @ np.diag([-1.0 if mirror else 1.0, 1.0])


def table(results, name):
    """Places and values of a line at the last time, a row for each point."""
    with open(results.folder / f"line_{name}.csv", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    values = np.array(rows, dtype=float)
    last = values[values[:, 0] == values[-1, 0]]
    x, y = header.index("x[m]"), header.index("y[m]")
    return last[:, [x, y]], last[:, y + 1:]


def moved(values, turn):
    """Scalars, vectors (x, y) or tensors (xx, yy, xy) after a turn."""
    if values.shape[1] == 2:
        return values @ turn.T
    if values.shape[1] == 3:
        tensors = turn @ values[:, [0, 2, 2, 1]].reshape(-1, 2, 2) @ turn.T
        return tensors.reshape(-1, 4)[:, [0, 3, 1]]
    return values


class LinesOfTwins(SceneRuns):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.write(SCENE.read_text().replace("end: 2 day", "end: 12 h").replace("output:\n", "output:\n" + LINES))
        cls.base = cls.run_scene(cls.scene)

    def assert_same(self, other, turn, delta):
        middle = np.array([5.0, 3.0])
        for name in FIELDS:
            places, values = table(self.base, name)
            twin_places, twin_values = table(other, name)
            self.assertEqual(len(values), 38)
            self.assertGreater(np.ptp(values[:, 0]), 0)
            self.assertLessEqual(np.abs((places - middle) @ turn.T + middle - twin_places).max(), 1e-12, name)
            worst = np.abs(moved(values, turn) - twin_values).max() / np.abs(values).max()
            print(f"{self.id().rpartition('.')[2]} {name}: {worst:.1e}", flush=True)
            self.assertLessEqual(worst, delta, name)

    def test_turned_and_mirrored(self):
        for angle, mirror in ((37.0, False), (90.0, False), (0.0, True), (-17.0, True)):
            with self.subTest(angle=angle, mirror=mirror):
                scenes = self.turned(self.scene, angle, mirror=mirror)
                self.assert_same(self.run_scene(scenes), rotation(angle, mirror), 1e-10)

    def test_rate_that_differs_in_the_ninth_digit(self):
        other = self.run_scene(self.scene, "components.conduit.injection.well.rate=1.000000001e-7 m^2/s")
        self.assert_same(other, np.eye(2), 1e-8)

    @on_two_processes
    def test_two_processes(self):
        self.assert_same(self.run_scene(self.scene, processes=2), np.eye(2), 1e-8)


if __name__ == "__main__":
    unittest.main()
