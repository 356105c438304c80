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


if __name__ == "__main__":
    unittest.main(verbosity=2)
