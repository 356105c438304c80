#!/usr/bin/python3
"""young_kink_test.py SPREKK: the first growth of an open crack under a slowly rising pressure, from its onset to a kink of 1 mm.
It starts where the largest tangential stress around the tip reaches the toughness, with K_I = (p - s_n) sqrt(pi a) and K_II = t
sqrt(pi a) of a slanted crack in an infinite plate, and goes on continuously, at its toughness, from a few thousandths of a
millimetre on."""

import math
import unittest

from scene_runs import SceneRuns

TOUGHNESS, HALF_LENGTH = 0.7e6, 0.05  # Pa m^0.5, m
LARGER, SMALLER = 20e6, 10e6  # Pa, the compressions along x and y
SCENE = """
name: young_kink
geometry:
  box: {{x: [-3 m, 3 m], y: [-3 m, 3 m]}}
  fractures:
    main: {{center: [0 m, 0 m], length: 0.1 m, angle: {angle} deg}}
mesh: {{size: 0.4 m, fracture_size: 10 mm, growth: 0.2}}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 40 GPa
    poisson_ratio: 0.2
    initial_stress: {{xx: -20 MPa, yy: -10 MPa, xy: 0 MPa}}
    boundary:
      left: {{displacement: [0 m, 0 m]}}
      right: {{displacement: [0 m, 0 m]}}
      bottom: {{displacement: [0 m, 0 m]}}
      top: {{displacement: [0 m, 0 m]}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1.0e-4 Pa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 1.0 mm
    transmissivity: constant
    transmissivity_value: 1.0e-6 m^3
    prescribed:
      everywhere: {{fracture: main, pressure: "({start} + t/3600) MPa"}}
  contact: {{type: contact/coulomb, friction: 0.5, dilation_angle: 1 deg}}
  tips:
    type: fine_fracture/quarter_point
    size: 1.0 m
    toughness: 0.7 MPa*m^0.5
    growth: {{increment: 10 mm}}
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: two_level,     between: [rock, conduit, tips, contact]}}
schedule:
  - solve: [rock, conduit, contact]
  - {{grow: tips, settle: [rock, contact]}}
time:
  end: 2 h
  step: 0.1 h
  stop: {{of: tips.main_last.length, reaches: 0.001 m}}
output:
  every: 10 h
  probes:
    p: {{of: conduit.pressure, fracture: main, take: mean}}
"""


def equivalent(k1, k2):
    angle = 2 * math.atan2(-2 * k2, k1 + math.hypot(k1, math.sqrt(8) * k2))
    return math.cos(angle / 2) * (k1 * math.cos(angle / 2) ** 2 - 1.5 * k2 * math.sin(angle))


def onset(degrees):
    """Pa, of the pressure."""
    angle, root = math.radians(degrees), math.sqrt(math.pi * HALF_LENGTH)
    normal = LARGER * math.sin(angle) ** 2 + SMALLER * math.cos(angle) ** 2
    shear = 0.5 * (LARGER - SMALLER) * math.sin(2 * angle)
    low, high = normal, normal + 5e6
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if equivalent((middle - normal) * root, shear * root) > TOUGHNESS else (middle, high)
    return low


class YoungKink(SceneRuns):
    timeout = 300

    def test_starts_at_its_onset_and_goes_on_continuously(self):
        for angle in (5, -8):
            scene = SCENE.format(angle=angle, start=onset(angle) * 1e-6 - 0.35)
            rows = self.run_scene([self.write(scene, f"kink_{angle}.yaml")]).rows
            grown = [row for row in rows if row["tips.main_last.length"] > 0]
            self.assertLess(abs(grown[0]["p"] / onset(angle) - 1), 1e-3, angle)
            self.assertLess(grown[0]["tips.main_last.length"], 0.05e-3)
            self.assertGreater(len(grown), 5)
            for row in grown:
                for tip in ("tips.main_first.", "tips.main_last."):
                    self.assertLess(abs(row[tip + "K_eq"] / TOUGHNESS - 1), 5e-3, (angle, row["p"]))


if __name__ == "__main__":
    unittest.main()
