#!/usr/bin/python3
"""ntpfa_network_test.py SPREKK: limited fluxes in a network of fractures in anisotropic, layered rock that is closed, where pressures even out within a step.
Many of the one-sided fluxes are then near the kinks of the limiter, and Newton's method alone goes to and fro between their pieces. The step is not cut,
takes at most ten times the iterations that linear fluxes take, and has the pressures that these have."""

import csv
import unittest

import numpy as np
from scene_runs import SceneRuns

LINES = [[(0.78, 0.39), (0.71, 0.54)], [(1.34, 1.48), (1.47, 1.60)], [(1.04, 1.23), (1.04, 1.45)], [(1.19, 0.86), (1.18, 1.11)],
         [(0.98, 0.65), (1.04, 0.77)], [(0.58, 0.83), (0.45, 0.99)], [(0.97, 1.18), (0.82, 1.39)], [(0.42, 0.29), (0.52, 0.51)]]


def scene(flow, factor=1.0, mirror=False):
    """`mirror`: left and right change places, and the load on the right stands on the left."""

    def x(value):
        return 2 - value if mirror else value

    fractures = ", ".join(f"f{k}: {{points: [[{x(a[0])}, {a[1]}], [{x(b[0])}, {b[1]}]]}}" for k, (a, b) in enumerate(LINES))
    angles = (91, 65) if mirror else (89, 115)
    fixed, loaded = ("right", "left") if mirror else ("left", "right")
    return f"""
geometry:
  box: {{x: [0, 2], y: [0, 2]}}
  fractures: {{{fractures}}}
  regions: {{layer: {{polygon: [[{x(0)}, 0.67], [{x(2)}, 0.65], [{x(2)}, 1.02], [{x(0)}, 1.09]]}}}}
mesh: {{size: 0.4, fracture_size: 0.07, growth: 0.8}}
materials:
  young_modulus: {{regions: {{layer: 1.24e+10 Pa, default: 2.9e+10 Pa}}}}
  poisson_ratio: 0.36
  biot_coefficient: 0.58
  porosity: 0.025
  fluid_compressibility: 3.3e-10 1/Pa
  permeability: {{regions: {{layer: {{along: 8.8e-15 m^2, across: 3.0e-15 m^2, angle: {angles[0]} deg}},
    default: {{along: {4.7e-15 * factor} m^2, across: 5.1e-16 m^2, angle: {angles[1]} deg}}}}}}
  viscosity: 0.00017 Pa*s
  friction: 0.385
  dilation_angle: 3.7 deg
components:
  pore: {{type: matrix_flow/{flow}, initial_pressure: 1.7e+06 Pa}}
  rock:
    type: poromechanics/mpsa
    boundary: {{{fixed}: {{displacement_x: 0}}, bottom: {{displacement_y: 0}}, {loaded}: {{normal_stress: -7 MPa}}, top: {{normal_stress: -15.6 MPa}}}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.24 mm
    initial_pressure: 1.7e+06 Pa
    injection: {{w: {{fracture: f0, rate: 2.75e-09 m^2/s}}}}
  contact: {{type: contact/coulomb}}
couplers:
  - {{type: biot, between: [pore, rock]}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [pore, rock, conduit, contact]}}]
time: {{end: 1 h, step: 1 h}}
output: {{probes: {{low: {{of: pore.pressure, take: smallest}}, high: {{of: pore.pressure, take: largest}}}}}}
"""


class NtpfaNetwork(SceneRuns):
    def solved(self, flow, **settings):
        """(iterations of all attempts, smallest and largest pressure)."""
        run = self.run_scene(self.write(scene(flow, **settings)))
        self.assertEqual(len(run.times), 1)  # the step is not cut
        with open(run.folder / "coupling.csv", encoding="utf8") as rows:
            iterations = sum(1 for _ in csv.reader(rows)) - 1
        return iterations, np.array([run["low[Pa]"][-1], run["high[Pa]"][-1]])

    def test_an_answer_within_ten_times_the_iterations_of_linear_fluxes(self):
        for settings in ({}, {"factor": 1 + 1e-9}, {"mirror": True}):
            with self.subTest(**settings):
                linear, known = self.solved("mpfa", **settings)
                limited, pressures = self.solved("ntpfa", **settings)
                self.assertLessEqual(limited, 10 * linear)
                self.assertLess(np.abs(pressures / known - 1).max(), 1e-4)


if __name__ == "__main__":
    unittest.main()
