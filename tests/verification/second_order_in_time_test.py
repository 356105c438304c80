#!/usr/bin/python3
"""second_order_in_time_test.py SPREKK: `time: {scheme: sdirk2}` multiplies a mode of the pressure by the factors of the scheme's formula, with
properties and steps that change; it is of second order for a column, a block and an opening fracture, where backward Euler is of first; split
schemes have the monolithic answer; fluid is conserved; a restart goes on to the bit; parts of first order are refused."""

import math
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns, on_two_processes

CONFIGS = ROOT / "configs"
TERZAGHI, MANDEL, FRACTURE = (CONFIGS / path for path in ("verification/terzaghi.yaml", "verification/mandel.yaml", "tutorial/first_scene.yaml"))
SDIRK2 = "time.scheme=sdirk2"
GAMMA = 1 - math.sqrt(0.5)
CELLS, LENGTH, RATE = 20, 10.0, 1e-3  # k/(mu S) at the start in m^2/s
MODE = f"""
geometry: {{box: {{x: [0 m, {LENGTH} m], y: [0 m, 1 m]}}}}
mesh: {{kind: structured, shape: quadrilaterals, cells: [{CELLS}, 2]}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: "(1e-16*(1 + t/7200)) m^2", viscosity: 1 mPa*s, storage: 1e-10 1/Pa,
         initial_pressure: "(cos(pi*x/{LENGTH})) MPa"}}
schedule: [{{solve: pore}}]
time: {{end: 4 h, step: 900 s}}
output: {{probes: {{p: {{of: pore.pressure, take: largest}}}}}}  # that of the first cells: a probe at their centre would be a fit
"""
# A column whose load comes and goes smoothly: q = 2 Pa sin^2(omega t) instead of 2 Pa at once.
OMEGA = math.pi / 0.2
SMOOTH_LOAD = 'components.rock.boundary.bottom={normal_stress: "(-2*sin(pi*t/0.2)^2) Pa"}'
PLATE = 'components.rock.boundary.top={displacement_y: "(-1e-4*sin(pi*t/20000)^2) m"}'


def iterated(steps, accelerate="anderson: 5", relative=1e-10):
    return f"schedule=[{{iterate: {{fallback: none, until: {{relative: {relative}, at_most: 100}}, accelerate: {{{accelerate}}}, steps: {steps}}}}}]"


class SecondOrderInTime(SceneRuns):
    def assert_order(self, expected, errors, within=0.15):
        orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
        for order in orders:
            self.assertAlmostEqual(order, expected, delta=within, msg=f"{errors} {orders}")

    def final_pressures(self, scene, steps, *settings, field="pore.pressure", kind="matrix"):
        """At the end of runs with these steps."""
        return [np.asarray(self.run_scene(scene, f"time.step={step!r} s", *settings).fields(kind=kind)[field]) for step in steps]

    def test_a_mode_decays_by_the_factors_of_the_formula(self):
        # On equal cells a cosine is an eigenvector of the fluxes.
        h = LENGTH / CELLS
        eigenvalue = 2 * (1 - math.cos(math.pi * h / LENGTH)) / (h * h)
        start = 1e6 * math.cos(math.pi * 0.25 / LENGTH)
        run = self.run_scene(self.write(MODE), SDIRK2, "time.step=100 s", "time.adaptive={largest: 2000 s, grow: 1.7}")
        times = [0.0, *run.times]
        lengths = np.diff(times)
        self.assertGreater(max(lengths) / min(lengths), 5)
        value, exact = start, start
        for begin, end, found in zip(times, times[1:], run["p[Pa]"]):
            step = end - begin
            slope = [-RATE * eigenvalue * (1 + t / 7200) for t in (begin + GAMMA * step, end)]
            first = slope[0] * value / (1 - GAMMA * step * slope[0])
            value = (value + (1 - GAMMA) * step * first) / (1 - GAMMA * step * slope[1])
            self.assertAlmostEqual(found / start, value / start, delta=1e-10)
            exact = start * math.exp(-RATE * eigenvalue * (end + end * end / 14400))
        self.assertAlmostEqual(value / start, exact / start, delta=0.01)

    def test_a_mode_is_of_second_order(self):
        h = LENGTH / CELLS
        eigenvalue = 2 * (1 - math.cos(math.pi * h / LENGTH)) / (h * h)
        exact = 1e6 * math.cos(math.pi * 0.25 / LENGTH) * math.exp(-RATE * eigenvalue * (14400 + 14400**2 / 14400))
        for settings, order in (((), 1), ((SDIRK2,), 2)):
            errors = [abs(self.run_scene(self.write(MODE), f"time.step={step} s", *settings)["p[Pa]"][-1] - exact) for step in (900, 450, 225)]
            self.assert_order(order, errors)

    def test_a_column(self):
        steps = [0.1 / n for n in (16, 32, 64)]
        reference, = self.final_pressures(TERZAGHI, [0.1 / 512], SMOOTH_LOAD, SDIRK2, "mesh.cells=[1, 40]")
        for settings, order in (((), 1), ((SDIRK2,), 2)):
            found = self.final_pressures(TERZAGHI, steps, SMOOTH_LOAD, *settings, "mesh.cells=[1, 40]")
            self.assert_order(order, [np.linalg.norm(p - reference) for p in found])
        # The closed form, mode by mode; on 40 cells the error in space is of the order (pi h)^2/12.
        p_closed = self.run_scene(TERZAGHI, "time.step=0.001 s", SMOOTH_LOAD, SDIRK2)["p_closed[Pa]"][-1]
        exact, t = 0, 0.1
        for k in range(200):
            n = (k + 0.5) * math.pi
            size = OMEGA / (n**4 + 4 * OMEGA**2) * (n * n * math.sin(2 * OMEGA * t) - 2 * OMEGA * (math.cos(2 * OMEGA * t) - math.exp(-n * n * t)))
            exact += 2 / n * math.sin(n) * size
        self.assertAlmostEqual(p_closed, exact, delta=2e-3 * abs(exact))

    def test_a_block(self):
        settings = (PLATE, "mesh.size=0.2 m", "time.end=8000 s")
        reference, = self.final_pressures(MANDEL, [31.25], *settings, SDIRK2)
        for more, order in (((), 1), ((SDIRK2,), 2)):
            found = self.final_pressures(MANDEL, [1000, 500, 250], *settings, *more)
            self.assert_order(order, [np.linalg.norm(p - reference) for p in found])

    def test_split_schemes_have_the_monolithic_answer(self):
        settings = (SDIRK2, "time.end=3237 s", "mesh.size=0.1 m")
        truth = self.run_scene(MANDEL, *settings).fields()["pore.pressure"]
        for steps in ("[{solve: pore, stabilize: fixed_stress}, {solve: rock}]", "[{solve: rock}, {solve: pore}]"):
            found = self.run_scene(MANDEL, *settings, iterated(steps)).fields()["pore.pressure"]
            self.assertLess(np.abs(found - truth).max(), 1e-7 * np.abs(truth).max())

    def test_fluid_is_conserved_and_a_restart_goes_on_to_the_bit(self):
        settings = (SDIRK2, "mesh.size=0.8 m")
        whole = self.run_scene(FRACTURE, *settings, "time.end=8 h")
        injected = np.abs(whole["fluid_injected[m^2]"]).max()
        self.assertGreater(injected, 0)
        self.assertLess(np.abs(whole["fluid_balance_error[m^2]"]).max(), 1e-9 * injected)
        parts = self.run_scene(FRACTURE, *settings, "time.end=4 h")
        parts = self.run_scene(FRACTURE, *settings, "time.end=8 h", restart=parts.folder)
        self.assert_same_bits(parts, whole)

    @on_two_processes
    def test_on_two_processes(self):
        settings = (SDIRK2, "time.end=8 h", "mesh.size=1 m")
        one, two = (self.run_scene(FRACTURE, *settings, processes=processes) for processes in (1, 2))
        for column in ("injection_pressure[Pa]", "slip.t[m]", "fluid_stored[m^2]", "fluid_outflow[m^2]"):
            self.assertLess(np.abs(one[column] - two[column]).max(), 1e-8 * np.abs(one[column]).max(), column)

    def test_parts_of_first_order_are_refused(self):
        answer = self.call("check", CONFIGS / "paper/wing_cracks.yaml", SDIRK2)
        self.assertEqual(answer.returncode, 2)
        self.assertIn("is of first order in time", answer.stderr)


if __name__ == "__main__":
    unittest.main()
