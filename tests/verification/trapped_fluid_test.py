#!/usr/bin/python3
"""trapped_fluid_test.py SPREKK: fluid that cannot leave an open fracture, solved in turn: flow, then rock and contact. The fluid alone
hardly resists (its compressibility), so a pass would answer an error by hundreds of times as much. With the response of the walls the
first pass finds the pressure of Sneddon's crack, and the iteration that of the monolithic scheme."""

import math
import unittest

from scene_runs import SceneRuns, on_two_processes

TOGETHER = "[{{solve: [{all}]}}]"
IN_TURN = ("[{{iterate: {{fallback: none, until: {{relative: {until}, at_most: 60}}, accelerate: {{anderson: {anderson}}}, steps: "
           "[{{solve: [{flow}], stabilize: {stabilize}}}, {{solve: [rock, contact]}}]}}}}]")

LENGTH, RATE, STEP, MODULUS = 1.0, 1e-6, 10.0, 32e9  # half-length, m; m^2/s; s; E', Pa
CRACK = """
name: crack
geometry:
  box: {{x: [-20, 20], y: [-20, 20]}}
  fractures: {{main: {{points: [[{x0!r}, {y0!r}], [{x1!r}, {y1!r}]]}}}}
mesh: {{size: 6, fracture_size: {size!r}, growth: 0.3}}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 30 GPa
    poisson_ratio: 0.25
    boundary: {{left: {{displacement_x: 0}}, bottom: {{displacement_y: 0}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.1 mm
    injection: {{well: {{fracture: main, rate: {rate!r} m^2/s}}}}
  contact: {{type: contact/coulomb, friction: 0.5}}
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: {schedule}
time: {{end: {end!r} s, step: {step!r} s}}
output:
  fields: false
  probes: {{pressure: {{of: conduit.pressure, take: mean}}, opening: {{of: contact.jump, take: mean}}}}
"""

# Three fractures in a rock that hardly conducts, one of which is injected into until it opens within seconds of an hour.
LAYERED = """
name: layered
geometry:
  box: {x: [0, 2], y: [0, 2]}
  fractures:
    f0: {points: [[1.214414, 0.720660], [1.269563, 0.877142]]}
    f1: {points: [[0.754484, 1.269785], [0.595455, 1.272732]]}
    f2: {points: [[0.782787, 0.963451], [0.939415, 1.246234]]}
  regions:
    layer: {polygon: [[0, 0.2730], [2, 0.2037], [2, 0.5701], [0, 0.7269]]}
mesh: {size: 0.289, fracture_size: 0.0630, growth: 0.34}
materials:
  young_modulus: {regions: {layer: 9.47915e+09 Pa, default: 8.49e+09 Pa}}
  poisson_ratio: {regions: {layer: 0.280, default: 0.110}}
  biot_coefficient: 0.422
  porosity: 0.099
  fluid_compressibility: 4.59398e-10 1/Pa
  permeability: {regions: {layer: {along: 2.34051e-21 m^2, across: 2.00833e-21 m^2, angle: 133.5 deg}, default: {along: 1.38552e-19 m^2, across: 1.31407e-20 m^2, angle: 99.8 deg}}}
  viscosity: 0.000687523 Pa*s
  friction: 0.494
components:
  pore: {type: matrix_flow/mpfa, initial_pressure: 0 Pa}
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {displacement_x: 0}
      bottom: {displacement_y: 0}
      right: {normal_stress: -3.35308e+06 Pa}
      top: {normal_stress: -3.19656e+06 Pa}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.00029775 m
    initial_pressure: 0 Pa
    injection: {w: {fracture: f0, rate: 6.67394e-09 m^2/s}}
  contact: {type: contact/coulomb}
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
schedule: SCHEDULE
time: {end: 3 h, step: 1 h}
output:
  fields: false
  probes:
    pore_smallest: {of: pore.pressure, take: smallest}
    pore_largest: {of: pore.pressure, take: largest}
    conduit_smallest: {of: conduit.pressure, take: smallest}
    conduit_largest: {of: conduit.pressure, take: largest}
"""


class TrappedFluid(SceneRuns):
    def crack(self, schedule, size, angle=0.0, steps=3):
        x, y = LENGTH * math.cos(angle), LENGTH * math.sin(angle)
        return self.write(CRACK.format(x0=-x, y0=-y, x1=x, y1=y, size=size, rate=RATE, step=STEP, end=steps * STEP, schedule=schedule))

    def test_a_pass_finds_the_pressure_of_a_crack_that_holds_all_of_the_fluid(self):
        # V = 2 pi l^2 p/E' (Sneddon 1946), and the fluid's own compressibility: 1/2000 of that.
        for size, angle, steps in ((0.2, 0.0, 2), (0.05, 0.0, 2), (0.1, 0.5, 2)):
            split = IN_TURN.format(until=1e-9, anderson=0, flow="conduit", stabilize="fixed_stress")
            rows = self.run_scene(self.crack(split, size, angle, steps)).rows
            self.assertEqual(len(rows), steps)  # none was cut
            for row in rows:
                pressure = RATE * row["time"] * MODULUS / (2 * math.pi * LENGTH**2)
                self.assertAlmostEqual(row["pressure"] / pressure, 1, delta=0.3 * size + 0.01)
                self.assertAlmostEqual(row["opening.n"] / (RATE * row["time"] / (2 * LENGTH)), 1, delta=1e-3)
                # The crack is open from the first pass on; two more passes correct what the cubic law adds, and check it.
                self.assertLessEqual(row["iterations"], 4)
            expected = self.run_scene(self.crack(TOGETHER.format(all="conduit, rock, contact"), size, angle, steps)).rows
            for row, other in zip(rows, expected):
                self.assertAlmostEqual(row["pressure"] / other["pressure"], 1, delta=1e-7)
                self.assertAlmostEqual(row["opening.n"] / other["opening.n"], 1, delta=1e-7)

    def test_without_the_response_a_pass_answers_an_error_by_a_multiple(self):
        # pi l/E' of the mean opening over c a of the fluid: 2400, so nothing converges.
        scene = self.crack(IN_TURN.format(until=1e-9, anderson=0, flow="conduit", stabilize="none"), 0.2)
        self.assertEqual(self.call(["run", "-q", "-o", "out"], scene).returncode, 1)

    def layered(self, schedule, processes=1, move=0.0):
        text = LAYERED.replace("SCHEDULE", schedule).replace("1.214414", repr(1.214414 * (1 + move)))
        rows = self.run_scene(self.write(text), processes=processes).rows
        self.assertEqual(len(rows), 3)  # none was cut
        return rows

    def expect_same(self, rows, expected):
        for row, other in zip(rows, expected):
            for name in ("pore_smallest", "pore_largest", "conduit_smallest", "conduit_largest"):
                self.assertAlmostEqual(row[name] / other[name], 1, delta=1e-7, msg=name)
            for name in ("contact.cells_stick", "contact.cells_slip", "contact.cells_open"):
                self.assertEqual(row[name], other[name])

    def test_a_fracture_that_opens_within_the_first_step(self):
        together = TOGETHER.format(all="pore, rock, conduit, contact")
        expected = self.layered(together)
        self.assertGreater(expected[0]["contact.cells_open"], 0)
        for anderson in (0, 5):
            split = IN_TURN.format(until=1e-9, anderson=anderson, flow="pore, conduit", stabilize="fixed_stress")
            self.expect_same(self.layered(split), expected)
        self.expect_same(self.layered(split, move=1e-9), self.layered(together, move=1e-9))

    @on_two_processes
    def test_on_two_processes(self):
        split = IN_TURN.format(until=1e-9, anderson=5, flow="pore, conduit", stabilize="fixed_stress")
        self.expect_same(self.layered(split, processes=2), self.layered(split))


if __name__ == "__main__":
    unittest.main()
