#!/usr/bin/python3
"""unstressed_pocket_test.py SPREKK: check says that rock which fractures enclose is held by nothing at the start, unless there is an
initial stress, or no such rock."""

import unittest

from scene_runs import SceneRuns

SCENE = """
name: pocket
geometry:
  box: {x: [0 m, 3 m], y: [0 m, 3 m]}
  fractures:
    one: {points: [[0.6 m, 1 m], [2.4 m, 1 m]]}
    two: {points: [[0.9 m, 0.6 m], [1.7 m, 2.2 m]]}
    three: {points: [[2.1 m, 0.6 m], [1.3 m, 2.2 m]]}
mesh: {size: 0.3 m, fracture_size: 0.15 m}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, friction: 0.6, dilation_angle: 0 deg}
components:
  rock:
    type: poromechanics/mpsa
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, top: {normal_stress: -10 MPa}}
  contact: {type: contact/coulomb}
couplers: [{type: wall_traction, between: [rock, contact]}]
schedule: [{solve: [rock, contact]}]
time: {end: 1 s, step: 1 s}
"""
NOTE = "cut off 1 parts of the rock"


class UnstressedPocket(SceneRuns):
    def said(self, *settings):
        done = self.call("check", self.write(SCENE), *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout + done.stderr

    def test_check_tells_of_it(self):
        self.assertIn(NOTE, self.said())
        self.assertIn("initial_stress", self.said())

    def test_not_with_an_initial_stress_nor_without_a_pocket(self):
        self.assertNotIn(NOTE, self.said("components.rock.initial_stress={xx: 0 MPa, yy: -10 MPa, xy: 0 MPa}"))
        self.assertNotIn(NOTE, self.said("geometry.fractures.three.points=[[2.1 m, 2.3 m], [1.9 m, 2.6 m]]"))


if __name__ == "__main__":
    unittest.main()
