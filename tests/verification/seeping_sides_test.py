#!/usr/bin/python3
"""seeping_sides_test.py SPREKK: sides that let fluid out and not in. A face that seeps everywhere, one that seeps below some height, and one that opens
at a known time."""

import unittest

import numpy as np

from leaky_column import HEIGHT, K, KINDS, LENGTH, MU, column
from scenes_in_space import SpaceRuns


class SeepingSides(SpaceRuns):
    def test_a_face_that_seeps_everywhere(self):
        """Water of level h1 far above the block on its left, of level h2 on its right: k rho g (h1 H − (H^2 + h2^2)/2)/(mu L), by Green's formula with the
        function x, since the top and the bottom are closed."""
        level, low, weight = 10 * HEIGHT, 0.3 * HEIGHT, 9810.0
        sides = f"left: {{pressure: ({weight}*({level} - y/m)) Pa}}, right: {{outer_pressure: \"({weight}*max(0, {low} - y/m)) Pa\", only_out: true}}"
        exact = K / MU * weight * (level * HEIGHT - (HEIGHT**2 + low**2) / 2) / LENGTH
        for kind in KINDS:
            text = column(kind, sides, 20).replace(", 2]", ", 10]").replace("    boundary", "    gravity: [0, -9.81 m/s^2]\n    boundary")
            self.assertLess(abs(self.run_text(text)["pore.right.outflow"][-1] / exact - 1), 1e-10, kind)

    def test_a_face_that_seeps_below_some_height(self):
        """Water as high as the block on its left: against the same two-point fluxes by numpy, with the one set of open faces for which all let out and no
        closed one exceeds the pressure outside."""
        cells, rows, low, weight = 20, 10, 0.3 * HEIGHT, 9810.0
        y = (np.arange(rows) + 0.5) * HEIGHT / rows
        outer = weight * np.maximum(0, low - y) + weight * y  # heads times the weight
        along, across = K / MU * (HEIGHT / rows) / (LENGTH / cells), K / MU * (LENGTH / cells) / (HEIGHT / rows)
        answers = []
        for is_open in ([k < count for k in range(rows)] for count in range(rows + 1)):
            matrix, loads = np.zeros((cells * rows, cells * rows)), np.zeros(cells * rows)
            for i, j in np.ndindex(cells, rows):
                one = i * rows + j
                for other, t in ((one + rows, along) if i + 1 < cells else (one, 0), (one + 1, across) if j + 1 < rows else (one, 0)):
                    matrix[[one, other], [one, other]] += t
                    matrix[[one, other], [other, one]] -= t
                for here, head in ((i == 0, weight * HEIGHT), (i == cells - 1 and is_open[j], outer[j])):
                    matrix[one, one] += 2 * along * here
                    loads[one] += 2 * along * head * here
            heads = np.linalg.solve(matrix, loads).reshape(cells, rows)
            flows = 2 * along * (heads[-1] - outer) * is_open
            if flows.min() >= 0 and np.all((heads[-1] <= outer) | is_open):
                answers.append((flows.sum(), (heads - weight * y).mean()))
        self.assertEqual(len(answers), 1)
        sides = f"left: {{pressure: ({weight}*({HEIGHT} - y/m)) Pa}}, right: {{outer_pressure: \"({weight}*max(0, {low} - y/m)) Pa\", only_out: true}}"
        text = column("tpfa", sides, cells).replace(", 2]", f", {rows}]").replace("    boundary", "    gravity: [0, -9.81 m/s^2]\n    boundary")
        for initial in ("0 Pa", "1 MPa", "-1 MPa"):
            results = self.run_text(text, f"components.pore.initial_pressure={initial}")
            self.assertLess(abs(results["pore.right.outflow"][-1] / answers[0][0] - 1), 1e-10, initial)
            self.assertLess(abs(results["p"][-1] / answers[0][1] - 1), 1e-10, initial)

    def test_a_side_that_opens_at_a_known_time(self):
        """A source fills a closed column evenly, p = s t/S, until p is what stands outside; in the end all of the source leaves, and p is a parabola. Then
        the source draws, and nothing enters."""
        storage, source, outer = 0.1, 0.8, 2.0
        for kind in KINDS:
            for more, extra in (("", 0), (", conductance: 5e-3 m/(Pa*s)", source * LENGTH / 5e-3)):
                text = column(kind, f"right: {{outer_pressure: {outer} Pa, only_out: true{more}}}", 6, storage, 0.0, "0.03125 s")
                text = text.replace("    boundary", f"    source: {source} 1/s\n    boundary")
                results = self.run_text(text)
                filled = results.times <= outer * storage / source + 1e-12  # 0.25 s
                self.assertEqual(filled.sum(), 8)
                self.assertLess(np.abs(results["p"][filled] - source * results.times[filled] / storage).max(), 1e-12)
                self.assertLess(np.abs(results["pore.right.outflow"][filled]).max(), 1e-12)
                self.assertGreater(results["pore.right.outflow"][~filled].min(), 1e-4)
                self.assertLess(np.abs(results.history["fluid_balance_error[m^2]"]).max(), 1e-12)
                steady = self.run_text(text, "time={end: 1e5 s, step: 1e4 s}")
                self.assertLess(abs(steady["pore.right.outflow"][-1] / (source * LENGTH * HEIGHT) - 1), 1e-9)
                exact = outer + extra + source * MU / K * LENGTH**2 / 3
                self.assertLess(abs(steady["p"][-1] / exact - 1), 0.03)  # six cells
                drawn = self.run_text(text, "components.pore.source=if(t < 0.5*s, 0.8, -3) 1/s")
                self.assertGreaterEqual(drawn["pore.right.outflow"].min(), 0)
                self.assertEqual(drawn["pore.right.outflow"][-1], 0)
                self.assertLess(np.abs(drawn.history["fluid_balance_error[m^2]"]).max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
