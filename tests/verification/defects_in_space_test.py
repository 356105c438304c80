#!/usr/bin/python3
"""defects_in_space_test.py SPREKK: geometries in space that are refused: mesh files whose cells lie on one another or are missing, and
ellipses that nearly touch others. Each as drawn, and turned about no axis."""

import unittest

import numpy as np

from hexahedra import TURN, mesh_file
from scene_runs import SceneRuns

ROCK = """
components: {pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, boundary: {SIDE: {pressure: 0 Pa}}}}
schedule: [{solve: [pore]}]
time: {end: 1 s, step: 1 s}
"""


def tetrahedron(at, size):
    return np.array(at) + size * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])


def frame(strike, dip):
    """Along strike, up dip, and the normal, of a plane."""
    (s, c), (sd, cd) = ((np.sin(a), np.cos(a)) for a in np.radians([strike, dip]))
    along, up = np.array([s, c, 0]), np.array([-c * cd, s * cd, sd])
    return along, up, np.cross(along, up)


class DefectsInSpace(SceneRuns):
    def said_of(self, text, code):
        called = self.call("check", self.write(text, f"scene_{next(self.numbers)}.yaml"))
        self.assertEqual(called.returncode, code, called.stdout + called.stderr)
        return called.stdout + called.stderr

    def of_mesh(self, code, turn=TURN, **mesh):
        name = f"mesh_{next(self.numbers)}.msh"
        self.write(mesh_file(turn, **mesh), name)
        return self.said_of(f"geometry: {{file: {name}}}" + ROCK.replace("SIDE", "west"), code)

    def test_cells_on_other_cells(self):
        """Inside of one cell, across several, and out of the mesh; beside it there is nothing wrong with a body."""
        for turn in (np.eye(3), TURN):
            for at, size in (([0.1, 0.1, 0.1], 0.03), ([0.13, 0.15, 0.17], 0.3), ([0.8, 0.8, 0.8], 0.5)):
                with self.subTest(at=at):
                    self.assertIn("they lie on other cells at", self.of_mesh(2, turn, bodies=[tetrahedron(at, size)]))
            said = self.of_mesh(2, turn, bodies=[tetrahedron([0.1, 0.1, 0.1], 0.03)])
            place = "(" + ", ".join(f"{x:.6g}" for x in turn @ [0.1, 0.1, 0.1]) + ")"
            self.assertIn(f"at 1 place, as at {place}", said)
        self.of_mesh(0, bodies=[tetrahedron([1.2, 0, 0], 0.5)])

    def test_missing_cells(self):
        for turn in (np.eye(3), TURN):
            self.assertIn("cells are missing: a hole of 6 faces around (", self.of_mesh(2, turn, cells=(6, 3, 3), moved=0.03, without=[(1, 1, 1)]))
            self.assertIn("cells are missing: a hole of 10 faces around (", self.of_mesh(2, turn, cells=(8, 3, 3), moved=0.02, without=[(1, 1, 1), (2, 1, 1)]))
        larger = [(i, j, k) for i in (1, 2, 3) for j in (1, 2) for k in (1, 2)]
        self.assertIn("has a hole of 32 faces around (", self.of_mesh(0, cells=(10, 4, 4), moved=0.02, without=larger))

    def of_fractures(self, one, other, more=""):
        fractures = "".join(f"    {name}: {{{text}}}\n" for name, text in (("one", one), ("other", other)) if text)
        return ("geometry:\n  box: {x: [0 m, 4 m], y: [0 m, 4 m], z: [0 m, 4 m]}\n" + more + "  fractures:\n" + fractures + "mesh: {size: 1 m}" +
                ROCK.replace("SIDE", "left"))

    @staticmethod
    def ellipse(center, strike, dip, radius):
        place = ", ".join(f"{x!r} m" for x in map(float, center))
        return f"center: [{place}], strike: {strike} deg, dip: {dip} deg, radius: [{radius[0]} m, {radius[1]} m]"

    @staticmethod
    def polygon(points):
        return "points: [" + ", ".join("[" + ", ".join(f"{x!r} m" for x in map(float, point)) + "]" for point in points) + "]"

    def test_ellipses_that_nearly_touch(self):
        """At a known width, which the message says: a corner above, an edge beside and a plane before the rim, rims beside and above one another."""
        center = np.array([2, 2, 2])
        for strike, dip, radius in ((0, 0, (0.8, 0.8)), (90, 90, (0.8, 0.6)), (37, 25, (0.8, 0.8)), (311, 62, (0.8, 0.6))):
            along, up, normal = frame(strike, dip)
            disc = self.ellipse(center, strike, dip, radius)

            def beside(way, gap, across, reach=radius[0]):
                """A rectangle along `way` whose edge is at the end of the first half axis."""
                at = center + (reach + gap) * along
                return self.polygon([at - 0.3 * across, at + 0.3 * across, at + 0.3 * across + 0.4 * way, at - 0.3 * across + 0.4 * way])
            # A wall before the rim may be passed by the rim, too: then a small part of the disc is behind it.
            def wall(gap):
                at = center + (radius[0] + gap) * along
                return self.polygon([at + x * 0.5 * up + y * 0.3 * normal for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
            corner = center + 0.3 * along + 0.1 * up
            for kind, make in (("corner", lambda g, corner=corner: self.polygon([corner + g * normal, corner + 0.5 * normal, corner + 0.5 * normal + 0.4 * along])),
                               ("edge", lambda g: beside(along, g, up)), ("wall", wall), ("passed", lambda g: wall(-g)),
                               ("rims", lambda g: self.ellipse(center + (radius[0] + 0.5 + g) * along, strike, dip, (0.5, 0.5))),
                               ("above", lambda g: self.ellipse(center + g * normal, strike, dip, (0.5, 0.5)))):
                with self.subTest(kind=kind, strike=strike):
                    for gap in (3.25e-7, 2.5e-6):
                        self.assertIn(f"they are {gap:.3g} m apart", self.said_of(self.of_fractures(disc, make(gap)), 2))
                    self.assertIn("they are 0.002 m apart", self.said_of(self.of_fractures(disc, make(0.002), "  snap: 1 cm\n"), 2))
                    self.said_of(self.of_fractures(disc, make(0.1), "  snap: 1 cm\n"), 0)

    def test_ellipses_that_nearly_touch_sides(self):
        for gap in (2e-6, 0.004):
            disc = self.ellipse([2, 0.8 + gap, 2], 0, 90, (0.8, 0.6))
            said = self.said_of(self.of_fractures(disc, "", "  snap: 1 cm\n"), 2)
            self.assertIn("nearly touches the boundary with its rim", said)
            self.assertIn(f"it is {gap:.3g} m inside", said)
        self.said_of(self.of_fractures(self.ellipse([2, 0.804, 2], 0, 90, (0.8, 0.6)), ""), 0)

    def test_discs_that_overlap_by_little(self):
        along = frame(37, 25)[0]
        discs = [self.ellipse(np.array([2, 2, 2]) + way * (0.5 - 1e-6) * along, 37, 25, (0.5, 0.5)) for way in (-1, 1)]
        self.assertIn("overlaps", self.said_of(self.of_fractures(*discs), 2))


if __name__ == "__main__":
    unittest.main(verbosity=2)
