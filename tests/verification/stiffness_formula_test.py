#!/usr/bin/python3
"""stiffness_formula_test.py SPREKK [MPIEXEC]: Young's modulus of rock as a formula of the state.

- Columns whose strain is known in closed form: pressed, drained, warmed, between unlike temperatures; with the iterations of Newton's method.
- A constant as a formula; one answer in every schedule, on two processes, after a restart; turned, mirrored; in space.
- What is refused."""

import csv
import math
import unittest

import numpy as np

import formula_scenes
from formula_scenes import put
from scene_runs import SceneRuns, on_two_processes

UNIAXIAL = 0.75 / (1.25 * 0.5)  # (lambda + 2 G)/E where nu = 1/4
COLUMN = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 2 m]}}
mesh: {size: 0.5 m}
components:
  rock:
    type: poromechanics/fem
    order: second
    young_modulus: "FORMULA"
    poisson_ratio: 0.25
    boundary: {left: {displacement_normal: 0 m}, right: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, top: {normal_stress: -30 MPa}}
PARTS
schedule: [{solve: [ALL]}]
time: {end: 2 s, step: 1 s}
output: {probes: {u: {of: rock.displacement, at: [0.5 m, 2 m]}, s: {of: rock.stress, at: [0.5 m, 1 m]}}}
"""
FLOW = """  pore: {type: matrix_flow/tpfa, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, boundary: {top: {pressure: 10 MPa}, bottom: {pressure: 10 MPa}}}
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0.6}]"""
HEAT = """  heat: {type: matrix_heat/tpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: 300 K, boundary: {top: {temperature: HOT K}, bottom: {temperature: 350 K}}}
couplers: [{type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}]"""
ROCK = {"ROCK": "poromechanics/fem\n    order: second", "WELLS": ""}  # of the fractured scene
SOFTENED = "10 GPa*(1 - 0.5*tanh(p/(3 MPa)) + 0.3*tanh(eps_v/1e-4))"



def column(formula, parts="", names="rock"):
    return put(COLUMN, FORMULA=formula, PARTS=parts, ALL=names)


def root(function, low, high):
    """Of a function that rises, by halving."""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if function(middle) > 0 else (middle, high)
    return low


class StiffnessFormula(SceneRuns):
    @staticmethod
    def last(run, quantity):
        return next(values[-1] for name, values in run.history.items() if name.split("[")[0] == quantity)

    def assert_displaced(self, run, strain, tolerance=1e-9):
        self.assertLess(abs(self.last(run, "u.y") / (2 * strain) - 1), tolerance)

    def test_a_pressed_column(self):
        """sigma = E(e) e times the uniaxial factor: rock that stiffens where it is pressed, and that softens."""
        for formula, modulus in (("10 GPa*exp(-eps_v/2e-3)", lambda e: 10e9 * math.exp(-e / 2e-3)), ("10 GPa*(1 + eps_v/0.02)", lambda e: 10e9 * (1 + e / 0.02))):
            known = root(lambda e, modulus=modulus: UNIAXIAL * modulus(e) * e + 30e6, -5e-3, 0)
            scene = self.write(column(formula))
            for settings in ((), ("time.scheme=sdirk2",), ("mesh={kind: structured, shape: quadrilaterals, cells: [2, 3]}",)):
                with self.subTest(formula=formula, settings=settings):
                    self.assert_displaced(self.run_scene(scene, *settings), known)

    def test_a_pressed_column_in_space(self):
        """It is 1 m high, along z."""
        known = root(lambda e: UNIAXIAL * 10e9 * math.exp(-e / 2e-3) * e + 30e6, -5e-3, 0)
        text = column("10 GPa*exp(-eps_v/2e-3)").replace("y: [0 m, 2 m]}", "y: [0 m, 2 m], z: [0 m, 1 m]}").replace("size: 0.5 m", "size: 1.5 m").replace("2 m]}, s: {of: rock.stress, at: [0.5 m, 1 m]}", "1 m, 1 m]}")
        text = text.replace("bottom: {displacement", "front: {displacement_normal: 0 m}, back: {displacement_normal: 0 m}, bottom: {displacement")
        self.assertLess(abs(self.last(self.run_scene(self.write(text)), "u.z") / known - 1), 1e-9)

    def test_newtons_method_converges_as_for_smooth_equations(self):
        run = self.run_scene(self.write(column("10 GPa*exp(-eps_v/2e-3)")), "time.step=2 s")
        with open(run.folder / "coupling.csv", encoding="utf-8") as file:
            residuals = [float(row["residual[1]"]) for row in csv.DictReader(file)]
        self.assertLessEqual(len(residuals), 8)
        for one, following in zip(residuals, residuals[1:]):
            if one < 0.1:
                self.assertLessEqual(following, one**2)

    def test_a_column_that_fluid_softens(self):
        """E(p) M/E e = −load + alpha (p − p_0)."""
        run = self.run_scene(self.write(column("10 GPa*(1 - p/(40 MPa))", FLOW, "pore, rock").replace("end: 2 s, step: 1 s", "end: 100 day, step: 20 day")))
        self.assert_displaced(run, (-30e6 + 0.6 * 10e6) / (UNIAXIAL * 10e9 * 0.75), 1e-7)

    def test_a_warmed_column(self):
        """E(T): M e = −load + 3 K a (T − T_0), both in proportion to E; and the stress across is that of the strain."""
        text = column("10 GPa*(1 - (T - 300 K)/(200 K))", put(HEAT, HOT=350), "heat, rock").replace("end: 2 s, step: 1 s", "end: 1000 day, step: 100 day")
        modulus = 10e9 * 0.75
        bulk = modulus / 1.5
        strain = (-30e6 + 3 * bulk * 1e-5 * 50) / (UNIAXIAL * modulus)
        run = self.run_scene(self.write(text))
        self.assert_displaced(run, strain, 1e-6)
        across = modulus * 0.25 / (1.25 * 0.5) * strain - 3 * bulk * 1e-5 * 50
        self.assertLess(abs(self.last(run, "s.xx") / across - 1), 1e-6)
        split = self.run_scene(self.write(text), "schedule=[{solve: heat}, {solve: rock}]")
        self.assertLess(self.largest_difference(split, run), 1e-8)

    def test_a_column_between_unlike_temperatures(self):
        """T = 350 K + 100 K y/H: layers in series shorten by the integral of load/M(T), and expand by that of 3 K a (T − T_0)/M. Of second order."""
        known = -30e6 / (UNIAXIAL * 10e9) * 2 / 0.4 * math.log(0.8 / 0.4) + 3 / 1.5 / UNIAXIAL * 1e-5 * 2 * 100
        errors = []
        for cells in (4, 8, 16):
            text = column("10 GPa*(1 - (T - 300 K)/(250 K))", put(HEAT, HOT=450), "heat, rock").replace("end: 2 s, step: 1 s", "end: 1000 day, step: 100 day")
            run = self.run_scene(self.write(text), f"mesh={{kind: structured, shape: quadrilaterals, cells: [1, {cells}]}}")
            errors.append(abs(self.last(run, "u.y") / known - 1))
        self.assertLess(errors[-1], 2e-3)
        self.assertGreater(math.log2(errors[-2] / errors[-1]), 1.8, msg=errors)

    def fractured(self, *settings, formula=SOFTENED, rate="3e-6", **more):
        return self.run_scene(self.write(formula_scenes.fractured((2.5, 0.7), rate, YOUNG=formula, **ROCK)), *settings, **more)

    def test_a_constant_as_a_formula(self):
        constant, formula = (self.fractured(formula=text) for text in ("10 GPa", "max(10 GPa, p*1e-6)"))
        self.assertLess(self.largest_difference(formula, constant), 1e-9)

    def test_schedules_have_one_answer(self):
        whole = self.fractured()
        split = "schedule=[{iterate: {fallback: none, until: {relative: 1e-10, at_most: 200}, accelerate: {anderson: 5}, steps: [{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}]}}]"
        for settings, tolerance in (((split,), 1e-6), (("solver.condense=false",), 1e-8)):
            with self.subTest(settings):
                self.assertLess(self.largest_difference(self.fractured(*settings), whole), tolerance)
        self.assertLess(self.largest_difference(self.fractured(rate=f"{3e-6 * (1 + 1e-9)!r}"), whole), 1e-7)
        self.assertGreater(self.largest_difference(self.fractured(formula="10 GPa"), whole), 1e-2)

    def test_turned_and_mirrored(self):
        scene = self.write(formula_scenes.fractured((2.5, 0.7), YOUNG=SOFTENED, **ROCK))
        one = self.run_scene(scene, "mesh.size=1.2 m", "mesh.fracture_size=0.35 m")
        for mirror in (False, True):
            other = self.run_scene(self.turned(scene, 35, "mesh.size=1.2 m", "mesh.fracture_size=0.35 m", mirror=mirror))
            self.assertLess(abs(self.last(other, "peak") / self.last(one, "peak") - 1), 2e-2)

    def test_a_restart_has_the_same_bits(self):
        whole = self.fractured()
        half = self.fractured("time.end=400 s")
        rest = self.fractured(restart=half.folder)
        self.assertEqual(self.largest_difference(rest, whole), 0)

    def test_second_order_in_time(self):
        runs = [self.fractured("time.scheme=sdirk2", f"time.step={step} s", rate="3e-6*sin(pi*t/(1200 s))^2") for step in (200, 100, 50)]
        for quantity in ("p", "u.x"):
            first, second, third = (self.last(run, quantity) for run in runs)
            self.assertGreater(math.log2(abs(first - second) / abs(second - third)), 1.8, msg=quantity)

    def test_a_start_that_is_settled(self):
        """Where nothing else happens, nothing moves after it."""
        run = self.fractured("start.settle=[pore, rock, conduit, contact]", "components.conduit.injection.well.rate=0 m^2/s")
        self.assertLess(np.abs(run["u.x[m]"]).max(), 1e-12)

    def test_a_settled_rock_is_the_one_from_which_its_strain_counts(self):
        """A column between two walls under its weight: with one modulus, E(0), the stress is 0 in its middle, and nothing moves."""
        text = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 20 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [1, 20]}
components:
  rock:
    type: poromechanics/fem
    order: second
    young_modulus: "1 GPa*(1 - 0.5*tanh(eps_v/1e-4))"
    poisson_ratio: 0.25
    rock_density: 2500 kg/m^3
    gravity: [0 m/s^2, -10 m/s^2]
    boundary: {left: {displacement_normal: 0 m}, right: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, top: {displacement_normal: WALL}}
start: {settle: [rock]}
schedule: [{solve: [rock]}]
time: {end: 2 s, step: 1 s}
output: {probes: {s: {of: rock.stress, at: [0.5 m, 19.5 m]}, below: {of: rock.stress, at: [0.5 m, 0.5 m]}, u: {of: rock.displacement, at: [0.5 m, 7 m]}}}
"""
        for wall in ("0 m", "0 m + 0 m/s*t"):
            run = self.run_scene(self.write(text.replace("WALL", wall)))
            for quantity, sign in (("s.yy", 1), ("below.yy", -1)):
                self.assertLess(abs(self.last(run, quantity) / (sign * 2500 * 10 * 9.5) - 1), 1e-9, (wall, quantity))
            self.assertLess(np.abs(run["u.y[m]"]).max(), 1e-12)

    def test_what_is_refused(self):
        formula = "10 GPa*exp(-eps_v/2e-3)"
        for text, message in ((column(formula).replace("/fem", "/mpsa").replace("    order: second\n", ""), "is taken as 'young_modulus' by poromechanics/fem"),
                              (column(formula).replace("order: second", "order: first"), "write 'order: second'"),
                              (column("10 GPa*(1 + p/(1 GPa))"), "a coupler biot with 'rock'"),
                              (column("10 GPa*T/(300 K)"), "a coupler thermal_stress with 'rock'"),
                              (column("10 GPa*(eps_v - 1)"), "'young_modulus' is -"),
                              (column("if(eps_v < -1e-4, 1 GPa, 2 GPa)"), "jumps from")):
            refused = self.call("check", self.write(text))
            self.assertEqual(refused.returncode, 2, msg=text)
            self.assertIn(message, refused.stderr)

    @on_two_processes
    def test_two_processes(self):
        one, two = (self.fractured(processes=processes) for processes in (1, 2))
        self.assertLess(self.largest_difference(two, one), 1e-7)


if __name__ == "__main__":
    unittest.main()
