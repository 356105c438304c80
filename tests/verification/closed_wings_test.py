#!/usr/bin/python3
"""closed_wings_test.py SPREKK: a fracture grows straight under the pressure of its fluid, closes when fluid is drawn out, and is sheared.
Grown walls then have the friction of their fracture, and the factors of the whole crack are those of the closed form."""

import math
import unittest

import numpy as np
from scene_runs import SceneRuns

FRICTION, ANGLE, TOUGHNESS = 0.3, math.radians(40), 0.7e6
SHEARED = 6900  # s, before growth goes on
SCENE = """
name: closed_wings
geometry:
  box: {x: [-2 m, 2 m], y: [-2 m, 2 m]}
  fractures:
    main: {center: [0 m, 0 m], length: 0.1 m, angle: 40 deg}
mesh: {size: 0.4 m, fracture_size: 10 mm, growth: 0.25}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 40 GPa
    poisson_ratio: 0.2
    initial_stress: {xx: -10 MPa, yy: -10 MPa, xy: 0 MPa}
    boundary:
      left: {displacement_x: 0 m}
      bottom: {displacement_y: 0 m}
      right: {normal_stress: "(t < 5400 ? -10 : -10 - 4.5*(t-5400)/1800) MPa"}
      top: {normal_stress: -10 MPa}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1.0e-4 Pa*s
    fluid_compressibility: 4.0e-8 1/Pa
    initial_aperture: 0.1 mm
    initial_pressure: 10 MPa
    transmissivity: constant
    transmissivity_value: 1.0e-6 m^3
    injection:
      well: {fracture: main, rate: [{value: 1.5e-9 m^2/s, from: 0 s, to: 1500 s}, {value: -8.0e-10 m^2/s, from: 1800 s, to: 5400 s}]}
  contact:
    type: contact/coulomb
    friction: 0.3
    dilation_angle: 0 deg
  tips:
    type: fine_fracture/quarter_point
    size: 0.5 m
    toughness: 0.7 MPa*m^0.5
    skip_below: 0
    growth: {increment: 10 mm}
couplers:
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
  - {type: two_level,     between: [rock, conduit, tips]}
schedule:
  - solve: [rock, conduit, contact]
  - grow: tips
    settle: [rock, contact]
    update: after_step
time: {end: 7200 s, step: 150 s}
output:
  every: 2 h
  times: [5400 s, 6900 s]
  probes:
    fracture_pressure: {of: conduit.pressure, at: [0 m, 0 m]}
"""
TIPS = ("tips.main_first.", "tips.main_last.")


class ClosedWings(SceneRuns):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        results = cls.run_scene(cls.write(SCENE))
        cls.rows, cls.notes = results.rows, results.record["notes"]
        cls.written = {time: results.fractures(time).grid for time in results.written("fractures")}
        cls.sheared = next(row for row in cls.rows if row["time"] == SHEARED)

    def test_walls_that_touch_have_no_opening_mode(self):
        closed = next(row for row in self.rows if row["time"] == 5400)
        for tip in TIPS:
            self.assertGreater(closed[tip + "length"], 0.03)
            self.assertLess(abs(closed[tip + "K_I"]), 1e-3 * TOUGHNESS)
            self.assertLess(abs(self.sheared[tip + "K_I"]), 5e-3 * TOUGHNESS)

    def test_grown_walls_have_the_friction_of_their_fracture(self):
        cells = self.written[SHEARED].cell_data
        normal, shear = cells["contact.traction.normal[Pa]"], cells["contact.traction.tangential[Pa]"]
        self.assertGreater(len(normal), 14)  # ten of which were there
        self.assertLess(normal.max(), -1e6)
        np.testing.assert_allclose(np.abs(shear), FRICTION * np.abs(normal), rtol=1e-6)
        # A straight crack in wide rock: K_II = (tau - mu (N - p)) sqrt(pi c).
        more = 4.5e6 * (SHEARED - 5400) / 1800  # Pa, of the stress along x
        tau, pressed = more * math.sin(ANGLE) * math.cos(ANGLE), 10e6 + more * math.sin(ANGLE) ** 2
        drop = tau - FRICTION * (pressed - self.sheared["fracture_pressure"])
        half = 0.5 * (0.1 + sum(self.sheared[tip + "length"] for tip in TIPS))
        for tip in TIPS:
            self.assertAlmostEqual(abs(self.sheared[tip + "K_II"]) / (drop * math.sqrt(math.pi * half)), 1, delta=0.01)

    def test_a_sheared_wing_turns_out_of_its_plane_and_a_note_tells_what_is_not_modelled(self):
        last = self.rows[-1]
        for tip in TIPS:
            self.assertGreater(last[tip + "length"], self.sheared[tip + "length"])
            way = math.atan2(*(last[tip + c] - self.sheared[tip + c] for c in "yx"))
            turn = (way - ANGLE + 0.5 * math.pi) % math.pi - 0.5 * math.pi  # along either direction of the fracture
            self.assertAlmostEqual(abs(turn), math.radians(70), delta=0.12)
        self.assertTrue(any("closed and sheared" in note["topic"] and "is not modelled" in note["text"] for note in self.notes))


class WithinSteps(SceneRuns):
    def test_a_sheared_wing_at_rest_leaves_what_has_parted_where_it_is(self):
        changes = """
components: {conduit: {injection: {well: {rate: [{value: 1.5e-9 m^2/s, from: 0 s, to: 1010 s}, {value: -8.0e-10 m^2/s, from: 1010 s, to: 4000 s}]}}},
  rock: {boundary: {right: {normal_stress: "(t < 5400 ? -10 : -10 - 8*(t-5400)/1800) MPa"}}}}
couplers: [{type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]},
  {type: two_level, between: [rock, conduit, tips], propagation_threshold: 0.25}]
schedule: [{solve: [rock, conduit, contact]}, {grow: tips, settle: [rock, contact], update: within_step}]
time: {step: 300 s}
"""
        rows = self.run_scene([self.write(SCENE), self.write(changes, "within.yaml")]).rows
        last, tip = rows[-1], TIPS[1]  # the one that has grown before
        before = next(row for row in rows if row["time"] == 5400)
        self.assertGreater(before[tip + "length"], 0.005)
        self.assertGreater(last[tip + "length"], before[tip + "length"] + 1e-3)
        self.assertEqual(last[tip + "grows"], 1)
        self.assertAlmostEqual(last[tip + "K_eq"] / TOUGHNESS, 1, delta=2e-7)
        self.assertLess(abs(last[tip + "K_II"]), 2e-6 * last[tip + "K_I"])
        # The wing goes on from where it was: its advance is the way between the two places.
        way = [last[tip + c] - before[tip + c] for c in "xy"]
        self.assertAlmostEqual(math.hypot(*way) / (last[tip + "length"] - before[tip + "length"]), 1, delta=0.02)
        self.assertAlmostEqual(abs(math.atan2(way[1], way[0]) - ANGLE), math.radians(70), delta=0.12)


if __name__ == "__main__":
    unittest.main()
