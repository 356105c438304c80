#!/usr/bin/python3
"""narrow_square_test.py SPREKK: a run tells where the square of a tip has become smaller than a cell, beside a side of the rock that is
not one of its bounding box. On such a side itself the square ends, and nothing is lost."""

import unittest

from scene_runs import SceneRuns

SCENE = """
name: near_a_side
geometry:
  box: {x: [0 m, 1 m], y: [0 m, 1 m]}
  fractures: {main: {points: [[0.5 m, 0.6 m], [0.5 m, 0.98 m]]}}
mesh: {size: 0.2 m, fracture_size: 40 mm}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 30 GPa
    poisson_ratio: 0.25
    boundary:
      left: {displacement: [0 m, 0 m]}
      right: {normal_stress: 1 MPa, displacement_y: 0 m}
  contact: {type: contact/coulomb, friction: 0.5}
  tips: {type: fine_fracture/quarter_point, size: 0.3 m}
couplers:
  - {type: wall_traction, between: [rock, contact]}
  - {type: two_level, between: [rock, tips]}
schedule:
  - solve: [rock, contact]
  - {grow: tips, settle: [rock, contact]}
time: {end: 1 s, step: 1 s}
"""


class NarrowSquare(SceneRuns):
    def notes(self, *scenes):
        return [note["text"] for note in self.run_scene(scenes).record["notes"] if note["topic"].startswith("small square around")]

    def test_is_told_beside_a_slanted_side(self):
        scene = self.write(SCENE)
        self.assertEqual(self.notes(scene), [])
        self.assertEqual(self.notes(*self.turned(scene, 90)), [])
        for angle, mirror in ((45, False), (45, True), (-30, False)):
            found = self.notes(*self.turned(scene, angle, mirror=mirror))
            self.assertEqual(len(found), 1, angle)
            self.assertIn("tips.main_last", found[0])


if __name__ == "__main__":
    unittest.main()
