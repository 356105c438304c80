#!/usr/bin/python3
"""Scenes of tools/stress repeat by their number, and have what their families promise."""

import tempfile
import unittest
from pathlib import Path

import stress_state  # noqa: F401  pylint: disable=unused-import  (it tells where the suite is)
from stress_suite import fractures, heat, ranges, scene, swaps, twisted_mesh


class Swapped(unittest.TestCase):
    def test_a_scene_stays_as_it_is_but_for_its_components(self):
        for number in range(20):
            plain, swapped = ranges.draw(1, number), ranges.draw(1, number, swapped=True)
            self.assertEqual({k: v for k, v in plain.items() if k != "discretization"},
                             {k: v for k, v in swapped.items() if k not in ("discretization", "rock", "contact", "swapped")})

    def test_all_combinations_are_drawn(self):
        drawn = {tuple(swaps.draw(1, number, "separate").values()) for number in range(300)}
        self.assertEqual(len(drawn), len(swaps.FLOWS) * len(swaps.ROCKS) * len(swaps.CONTACTS))


class Buoyant(unittest.TestCase):
    def test_a_scene_stays_as_it_is_but_for_gravity_and_density(self):
        with tempfile.TemporaryDirectory() as temporary:
            for number in range(20):
                texts = []
                for buoyant in (False, True):
                    p = ranges.draw(1, number, "heat", buoyant=buoyant)
                    texts.append(scene.write(p, Path(temporary) / str(buoyant)).read_text().splitlines()[1:])
                more = [line for line in texts[1] if line not in texts[0]]
                self.assertEqual([line for line in texts[1] if line not in more], texts[0])
                self.assertEqual([line.split()[0].strip("-:{") or line.split()[2] for line in more],
                                 ["gravity", "fluid_density", "gravity", "fluid_density", "buoyancy,"])

    def test_densities_are_positive(self):
        for number in range(200):
            p = ranges.draw(1, number, "heat", buoyant=True)
            warmest = max(heat.given(p)) - p["temperature"]
            self.assertGreater(1 - p["buoyancy"]["expansion"] * warmest, 0.5)


class Scenes(unittest.TestCase):
    def test_a_number_gives_the_same_scene(self):
        with tempfile.TemporaryDirectory() as temporary:
            for family in ranges.FAMILIES:
                for number in range(8):
                    texts = [scene.write(ranges.draw(3, number, family), Path(temporary) / str(i)).read_text() for i in (0, 1)]
                    self.assertEqual(*texts)

    def test_ranges_are_those_of_the_task(self):
        drawn = [ranges.draw(1, number) for number in range(500)]
        for name, low, high in (("permeability", 1e-24, 1e-10), ("alpha", 0, 1), ("poisson", 0, 0.4999),
                                ("friction", 0, 2), ("dilation", 0, 20), ("aperture", 1e-6, 1e-2),
                                ("relative_step", 1e-6, 1e6)):
            values = [p[name] for p in drawn]
            self.assertGreaterEqual(min(values), low * (1 - 1e-12))
            self.assertLessEqual(max(values), high * (1 + 1e-12))
            self.assertLess(min(values), low + 0.05 * (high - low))

    def test_twisted_meshes_have_slivers_and_no_flat_cells(self):
        found = []
        for p in (ranges.draw(1, number) for number in range(60)):
            grid = twisted_mesh.Grid(p)
            self.assertGreater(twisted_mesh.areas(grid.points, grid.triangles).min(), 0)
            self.assertAlmostEqual(twisted_mesh.areas(grid.points, grid.triangles).sum() / (p["width"] * p["height"]), 1, 9)
            found.append(twisted_mesh.smallest_angle(grid.points, grid.triangles))
        self.assertLess(min(found), 6)

    def test_fractures_lie_in_the_box(self):
        for p in (ranges.draw(2, number, family) for number in range(200) for family in ranges.FAMILIES if family not in ranges.IN_SPACE):
            for a, b in fractures.segments(p).values():
                for x, y in (a, b):
                    self.assertTrue(-1e-9 <= x <= p["width"] * (1 + 1e-9) and 0 <= y <= p["height"], p["number"])

    def test_fractures_of_the_other_family_meet(self):
        alone = 0
        for p in (ranges.draw(1, number, "meeting") for number in range(200)):
            lines = list(fractures.segments(p).values())
            alone += len(lines) == 1
            (x0, y0), (x1, y1) = lines[0]
            for a, b in lines[1:]:
                sides = [(x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) for x, y in (a, b)]
                self.assertLess(min(sides) * max(sides), 1e-12 * max(map(abs, sides)) ** 2, p["number"])
        self.assertLess(alone, 10)

    def test_fractures_of_the_other_family_meet_in_twisted_meshes(self):
        for p in (ranges.draw(1, number, "meeting") for number in range(100)):
            grid = twisted_mesh.Grid(p)
            self.assertGreater(twisted_mesh.areas(grid.points, grid.triangles).min(), 0)
            edges = {frozenset(edge) for a, b, c in grid.triangles for edge in ((a, b), (b, c), (c, a))}
            for line in grid.lines.values():
                self.assertTrue(all(frozenset(edge) in edges for edge in zip(line, line[1:])), p["number"])
                self.assertTrue(set(line) & set(grid.lines["main"]), p["number"])


if __name__ == "__main__":
    unittest.main()
