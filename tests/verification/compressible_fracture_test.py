#!/usr/bin/python3
"""compressible_fracture_test.py SPREKK MPIEXEC: strongly compressible fluid in a fracture of elastic rock that lets no fluid in.

The mass of the fluid is rho V, rho proportional to exp(c p), and a rate is a volume at the pressure where it enters: V' + V c p' = q. The open
fracture has one pressure and yields linearly, V = V_0 + k (p - p_0), so
  k P + c (V_0 P + k P^2/2) = q t,  P = p - p_0,
with k from the volume and the pressure of the same run (Sneddon's for a crack in an infinite body is 2 pi b^2/E'). Without a rate, rho V stays."""

import unittest

import numpy as np
from scene_runs import SceneRuns, on_two_processes

COMPRESSIBILITY, PRESSURE, RATE, LENGTH, APERTURE = 1e-7, 10e6, 1e-4, 0.2, 1e-3
YOUNG, POISSON = 1e9, 0.2
SCENE = """
name: compressible
geometry: {box: {x: [-1 m, 1 m], y: [-1 m, 1 m]}, fractures: {main: {center: [0 m, 0 m], length: 0.2 m, angle: ANGLE deg}}}
mesh: {size: 0.3 m, fracture_size: 20 mm, growth: 0.2}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 1 GPa
    poisson_ratio: 0.2
    initial_stress: {xx: -10 MPa, yy: -10 MPa, xy: 0 MPa}
    boundary: {left: {displacement: [0 m, 0 m]}, right: {displacement: [0 m, 0 m]}, bottom: {displacement: [0 m, 0 m]}, top: {normal_stress: "TOP"}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1.0e-4 Pa*s
    fluid_compressibility: 1.0e-7 1/Pa
    initial_aperture: 1 mm
    initial_pressure: 10 MPa
    transmissivity: constant
    transmissivity_value: 1.0e-6 m^3
    injection: {well: {fracture: main, rate: "RATE"}}
  contact: {type: contact/coulomb, friction: 0.5}
couplers: [{type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}]
schedule: [{solve: [rock, conduit, contact]}]
time: {end: 8 s, step: 8 s}
output: {fields: false, probes: {p: {of: conduit.pressure, fracture: main, take: mean}, V: {of: contact.jump, fracture: main, take: integral}}}
"""
MIRRORED = "geometry.fractures.main={center: [0 m, 0 m], length: 0.2 m, angle: -30 deg}"
CHANGING = "components.conduit.fluid_compressibility=(1.0e-7*(1 + t)) 1/Pa"


def scene(rate="1.0e-4 m^2/s", angle=0, top="-10 MPa"):
    return SCENE.replace("ANGLE", str(angle)).replace("RATE", rate).replace("TOP", top)


class CompressibleFracture(SceneRuns):
    def ends(self, text, *settings, processes=1):
        """Pressures and volumes of the fracture after each step."""
        run = self.run_scene(self.write(text), *settings, processes=processes)
        self.assertEqual(run.record["counters"]["steps rejected"], 0, settings)
        volume = LENGTH * APERTURE + run["V.n[m*m]"]
        return run["p[Pa]"], volume, run

    def assert_exact(self, text, *settings, steps=1, rate=RATE, processes=1, delta=1e-9):
        pressures, volumes, run = self.ends(text, f"time.step={8 / steps} s", *settings, processes=processes)
        rise, opening, first = pressures[-1] - PRESSURE, volumes[-1] - LENGTH * APERTURE, LENGTH * APERTURE
        stored = opening + COMPRESSIBILITY * rise * (first + opening / 2)
        self.assertAlmostEqual(stored / (rate * 8), 1, delta=delta, msg=(steps, settings))
        self.assertAlmostEqual(opening / rise / (2 * np.pi * 0.1**2 * (1 - POISSON**2) / YOUNG), 1, delta=0.05)
        self.assertLess(abs(run["fluid_balance_error[m^2]"][-1]), 1e-10 * rate * 8)
        return pressures[-1]

    def test_the_pressure_does_not_depend_on_the_steps(self):
        pressures = [self.assert_exact(scene(), steps=steps) for steps in (1, 4, 16)]
        for pressure in pressures:
            self.assertAlmostEqual(pressure / pressures[0], 1, delta=1e-9)

    def test_twins(self):
        self.assert_exact(scene(angle=30), steps=2)
        self.assert_exact(scene(angle=30), MIRRORED, steps=2)
        rate = RATE * (1 + 1e-9)
        self.assert_exact(scene(rate=f"{rate!r} m^2/s"), rate=rate)

    @on_two_processes
    def test_two_processes(self):
        self.assert_exact(scene(angle=30), processes=2)

    def test_two_stages_are_of_second_order(self):
        exact = self.assert_exact(scene())
        errors = [abs(self.ends(scene(), f"time.step={8 / steps} s", "time.scheme=sdirk2")[0][-1] - exact) for steps in (8, 16, 32)]
        for coarse, fine in zip(errors, errors[1:]):
            self.assertGreater(np.log2(coarse / fine), 1.8, errors)

    def test_what_is_injected_comes_out_again(self):
        for steps in (2, 6):
            pressures, volumes, _ = self.ends(scene(rate="(if(t < 4.1, 1, -1)*1.0e-4) m^2/s"), f"time.step={8 / steps} s")
            self.assertGreater(pressures[steps // 2 - 1], 1.3 * PRESSURE)
            self.assertAlmostEqual(pressures[-1] / PRESSURE, 1, delta=1e-9, msg=steps)
            self.assertAlmostEqual(volumes[-1] / (LENGTH * APERTURE), 1, delta=1e-9, msg=steps)

    def test_mass_stays_under_loads_that_come_and_go(self):
        """In one step there and one back, or in five of each: nothing is left of the cycle."""
        load = "(-10e6 + 8e6*(4 - abs(t - 4))/4) Pa"
        for steps in (2, 10):
            pressures, volumes, _ = self.ends(scene(rate="0 m^2/s", top=load), f"time.step={8 / steps} s")
            self.assertLess(min(pressures), 0.9 * PRESSURE)
            mass = volumes * np.exp(COMPRESSIBILITY * (pressures - PRESSURE)) / (LENGTH * APERTURE)
            for part in mass:
                self.assertAlmostEqual(part, 1, delta=1e-7, msg=(steps, mass))
            self.assertAlmostEqual(pressures[-1] / PRESSURE, 1, delta=1e-7, msg=steps)

    def test_fluid_at_rest_stays_at_rest_when_its_compressibility_changes(self):
        for scheme in ("backward_euler", "sdirk2"):
            pressures, _, _ = self.ends(scene(rate="0 m^2/s"), CHANGING, "time.step=1 s", f"time.scheme={scheme}")
            for pressure in pressures:
                self.assertAlmostEqual(pressure / PRESSURE, 1, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
