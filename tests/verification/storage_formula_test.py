#!/usr/bin/python3
"""storage_formula_test.py SPREKK [MPIEXEC]: the specific storage of rock, and Carter's coefficient of leak-off, as formulas of the state.

- What closed rock stores is the integral of its storage over the pressure, whatever the steps were: closed forms, also with rock that is pressed.
- A fracture that leaks as its pressure says: a closed form, with its order in time; a constant as a formula has the answer of the constant.
- Schedules, restarts, two processes, space; what is refused."""

import math
import unittest

import numpy as np
from formula_scenes import fractured, put
from scene_runs import SceneRuns, on_two_processes

CLOSED = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.5 m}
components:
  pore: {type: matrix_flow/KIND, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: "FORMULA", initial_pressure: 3 MPa, source: SOURCE}
schedule: [{solve: pore}]
time: {end: 1000 s, step: 200 s}
output: {fields: false, probes: {p: {of: pore.pressure, take: largest}, lowest: {of: pore.pressure, take: smallest}}}
"""
LINEAR = "1e-10 1/Pa*(1 + p/(10 MPa))"
PRESSED = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.5 m}
components:
  pore: {type: matrix_flow/KIND, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: "1e-10 1/Pa*exp(300*eps_v + p/(40 MPa))"}
  rock:
    type: poromechanics/ROCK
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    boundary: {left: {displacement_normal: 0 m}, right: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, top: {normal_stress: -30 MPa}}
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0.8}]
schedule: [{solve: [pore, rock]}]
time: {end: 2 s, step: 1 s}
output: {fields: false, probes: {p: {of: pore.pressure, take: largest}}}
"""
# A fracture in rock without flow, whose fluid leaks.
LEAKING = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 2 m]}, fractures: {f: {points: [[1 m, 1 m], [3 m, 1 m]]}}}
mesh: {size: 1 m, fracture_size: 0.5 m}
components:
  conduit: {type: fracture_flow/tpfa, viscosity: 1 mPa*s, initial_aperture: 1 mm, initial_pressure: 1 MPa, fluid_compressibility: 1e-9 1/Pa}
couplers: [{type: carter_leak_off, between: [conduit], leak_off_coefficient: "COEFFICIENT", exposed_since: 0 s}]
schedule: [{solve: conduit}]
time: {end: 100 s, step: 10 s, start: 0 s}
output: {fields: false, probes: {p: {of: conduit.pressure, take: largest}, lowest: {of: conduit.pressure, take: smallest}}}
"""


def root(function, low, high):
    """Of a function that rises, by halving."""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if function(middle) > 0 else (middle, high)
    return low


class StorageFormula(SceneRuns):
    def assert_conserved(self, run, share=1e-10):
        moved = max(np.abs(values).max() for name, values in run.history.items() if name.startswith(("fluid_injected", "fluid_stored", "fluid_outflow")))
        self.assertLess(np.abs(run["fluid_balance_error[m^2]"]).max(), share * moved)

    def test_what_closed_rock_stores(self):
        """1e-10 ((p − p_0) + (p² − p_0²)/(20 MPa)) = q t."""
        known = root(lambda p: 1e-10 * (p - 3e6 + (p * p - 9e12) / 20e6) - 1e-3, 0, 30e6)
        for kind in ("mpfa", "tpfa"):
            scene = self.write(put(CLOSED, KIND=kind, FORMULA=LINEAR, SOURCE="1e-6 1/s"))
            for settings in ((), ("time.step=1000 s",), ("time.step=170 s",), ("time.scheme=sdirk2",), ("schedule=[{subcycle: {count: 3, steps: [{solve: pore}]}}]",)):
                run = self.run_scene(scene, *settings)
                for probe in ("p[Pa]", "lowest[Pa]"):
                    self.assertLess(abs(run[probe][-1] / known - 1), 1e-9, msg=(kind, settings))
                self.assert_conserved(run)
        run = self.run_scene(scene, "geometry.box.z=[0 m, 1 m]", "mesh.size=1 m")
        self.assertLess(abs(run["p[Pa]"][-1] / known - 1), 1e-9)

    def test_a_kink_and_a_cycle(self):
        """A storage that grows from 5 MPa on; what comes in and goes leaves the pressure as it was."""
        kinked = "1e-10 1/Pa*(1 + max(0, p/MPa - 5))"
        for source, known in (("1e-6 1/s", 5e6 + 1e6 * (math.sqrt(1 + 2 * 8) - 1)), ("[{value: 2e-6 1/s, to: 500 s}, {value: -2e-6 1/s, from: 500 s}]", 3e6)):
            run = self.run_scene(self.write(put(CLOSED, KIND="mpfa", FORMULA=kinked, SOURCE=source)), "time.step=100 s")
            self.assertLess(abs(run["p[Pa]"][-1] / known - 1), 1e-3 if known > 3e6 else 1e-10)
            self.assert_conserved(run)

    def test_a_constant_as_a_formula(self):
        for text in (put(CLOSED, KIND="mpfa", SOURCE="1e-6 1/s"),):
            data, formula = (self.run_scene(self.write(put(text, FORMULA=storage))) for storage in ("2e-10 1/Pa", "2e-10 1/Pa + 0*p/Pa^2"))
            self.assertLess(self.largest_difference(formula, data), 1e-12)

    def test_pressed_rock(self):
        """M e − alpha p = −load, and zeta + alpha e = 0 with zeta = 1e-10 exp(300 e) P (exp(p/P) − 1)."""
        stiffness = 10e9 * 0.75 / (1.25 * 0.5)

        def holds(p):
            e = (0.8 * p - 30e6) / stiffness
            return 1e-10 * math.exp(300 * e) * 40e6 * (math.exp(p / 40e6) - 1) + 0.8 * e

        known = root(holds, 0, 40e6)
        for kind, rock in (("mpfa", "mpsa"), ("tpfa", "fem")):
            scene = self.write(put(PRESSED, KIND=kind, ROCK=rock))
            for settings in ((), ("time.scheme=sdirk2",), ("schedule=[{iterate: {fallback: none, until: {relative: 1e-11, at_most: 60}, steps: [{solve: pore, stabilize: fixed_stress}, {solve: rock}]}}]",)):
                run = self.run_scene(scene, *settings)
                self.assertLess(abs(run["p[Pa]"][-1] / known - 1), 1e-8, msg=(kind, settings))

    def acting(self, *settings, **more):
        text = fractured((2, 0.6), "3e-6").replace('porosity: "0.1"\n    fluid_compressibility: 4e-10 1/Pa\n    boundary', 'storage: "4e-11 1/Pa*exp(p/(5 MPa) + 500*eps_v)"\n    boundary')
        return self.run_scene(self.write(text), *settings, **more)

    def test_schedules_and_restarts(self):
        whole = self.acting()
        self.assert_conserved(whole)
        self.assertLess(whole["iterations"].max(), 12)
        split = "schedule=[{iterate: {fallback: none, until: {relative: 1e-10, at_most: 200}, accelerate: {anderson: 5}, steps: [{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}]}}]"
        for settings, tolerance in (((split,), 1e-6), (("solver.condense=false",), 1e-8)):
            self.assertLess(self.largest_difference(self.acting(*settings), whole), tolerance, msg=settings)
        self.assert_conserved(self.acting("schedule=[{solve: [pore, conduit]}, {solve: [rock, contact]}]"))
        half = self.acting("time.end=400 s")
        self.assertEqual(self.largest_difference(self.acting(restart=half.folder), whole), 0)

    @on_two_processes
    def test_two_processes(self):
        one, two = (self.acting(processes=processes) for processes in (1, 2))
        self.assertLess(self.largest_difference(two, one), 1e-7)

    def test_a_fracture_leaks_as_its_pressure_says(self):
        """a c p' = −2 k p/sqrt(t): p = P exp(−4 k sqrt(t)/(a c)), to first order; the fluid is compressed by 1e-3."""
        scene = self.write(put(LEAKING, COEFFICIENT="2e-8 m/s^0.5*p/(1 MPa)"))
        known = 1e6 * math.exp(-4 * 2e-14 * math.sqrt(100) / (1e-3 * 1e-9))
        errors = []
        for step in (2, 1, 0.5):
            run = self.run_scene(scene, f"time.step={step} s")
            errors.append(abs(run["p[Pa]"][-1] / known - 1))
            self.assertLess(abs(run["lowest[Pa]"][-1] / run["p[Pa]"][-1] - 1), 1e-9)
            self.assert_conserved(run)
        self.assertLess(errors[-1], 5e-3)
        self.assertGreater(math.log2(errors[1] / errors[2]), 0.8, msg=errors)

    def test_a_constant_coefficient_as_a_formula(self):
        data, formula, twin = (self.run_scene(self.write(put(LEAKING, COEFFICIENT=text))) for text in ("2e-8 m/s^0.5", "2e-8 m/s^0.5*(1 + 0*p/Pa + 0*a/m)", f"{2e-8 * (1 + 1e-9)!r} m/s^0.5*(1 + 0*p/Pa)"))
        self.assertLess(self.largest_difference(formula, data), 1e-12)
        self.assertLess(self.largest_difference(twin, data), 1e-8)
        leaked = 4 * 2e-8 * np.sqrt(formula.times) * 2
        np.testing.assert_allclose(formula["carter_leak_off.leaked[m^2]"], leaked, rtol=1e-9)

    def test_what_is_refused(self):
        for text, message in ((put(CLOSED, KIND="rt0", FORMULA=LINEAR, SOURCE="0 1/s"), "is taken as 'storage' by matrix_flow/mpfa, matrix_flow/tpfa"),
                              (put(CLOSED, KIND="mpfa", FORMULA="1e-10 1/Pa*(1 + eps_v)", SOURCE="0 1/s"), "names 'eps_v'"),
                              (put(CLOSED, KIND="mpfa", FORMULA="1e-10 1/Pa + p", SOURCE="0 1/s"), "has another unit"),
                              (put(CLOSED, KIND="mpfa", FORMULA="if(p < 1 MPa, 1e-10 1/Pa, 2e-10 1/Pa)", SOURCE="0 1/s"), "jumps from"),
                              (put(CLOSED, KIND="mpfa", FORMULA="1e-10 1/Pa*(1 - p/(1 MPa))", SOURCE="0 1/s"), "'storage' is -2e-10"),
                              (put(LEAKING, COEFFICIENT="1e-8 m/s^0.5*(1 - p/(0.5 MPa))"), "'leak_off_coefficient' is -1e-08"),
                              (put(LEAKING, COEFFICIENT="1e-8 m/s^0.5*T/K"), "unknown name in the expression")):
            with self.subTest(text=text):
                refused = self.call("check", self.write(text))
                self.assertEqual(refused.returncode, 2, msg=refused.stderr)
                self.assertIn(message, refused.stderr)


if __name__ == "__main__":
    unittest.main()
