#!/usr/bin/python3
"""prescribed_fractures_test.py SPREKK [MPIEXEC]: what a fracture whose pressure is given lets in is injected fluid: the columns add up, whatever the
scheme, and a step that loses fluid elsewhere is not accepted."""

import unittest

from scene_runs import SceneRuns, on_two_processes

PLANE = """
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 8 m]}
  fractures: {given: {points: [[2 m, 3.1 m], [7 m, 5.3 m]]}, other: {points: [[4 m, 1 m], [5.5 m, 7 m]]}}
mesh: {size: 1 m, fracture_size: 0.5 m}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, boundary: {left: {pressure: 0 Pa}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4.5e-10 1/Pa
    initial_aperture: {fractures: {given: 0.1 mm, other: 0.3 mm}}
    prescribed: {p: {fracture: given, pressure: {value: 1 MPa, from: 20 s}}, q: {fracture: other, at: [4.2 m, 1.8 m], pressure: 0.4 MPa}}
couplers: [{type: wall_exchange, between: [pore, conduit]}]
schedule: [SOLVES]
time: {end: 100 s, step: 10 s}
output: {fields: false}
"""
SPACE = (PLANE.replace("y: [0 m, 8 m]", "y: [0 m, 8 m], z: [-6 m, 0 m]").replace("{size: 1 m, fracture_size: 0.5 m}", "{size: 2 m, fracture_size: 1 m}")
         .replace("[[2 m, 3.1 m], [7 m, 5.3 m]]", "[[2 m, 3.1 m, -5 m], [7 m, 5.3 m, -4.5 m], [7 m, 5.3 m, -1 m], [2 m, 3.1 m, -1.5 m]]")
         .replace("[[4 m, 1 m], [5.5 m, 7 m]]", "[[4 m, 1 m, -5.5 m], [5.5 m, 7 m, -5 m], [5.5 m, 7 m, -2 m], [4 m, 1 m, -1.2 m]]")
         .replace("at: [4.2 m, 1.8 m]", "at: [4.3 m, 2.2 m, -3 m]"))
SCHEMES = {"together": "{solve: [pore, conduit]}",
           "in turn": "{iterate: {until: {relative: 1e-12, at_most: 200}, accelerate: {anderson: 5}, steps: [{solve: pore}, {solve: conduit}]}}",
           "substeps": "{subcycle: {count: 3, steps: [{solve: [pore, conduit]}]}}"}


class PrescribedFractures(SceneRuns):
    def assert_adds_up(self, run, unit):
        injected, step = run[f"fluid_injected[{unit}]"], run["step[s]"]
        self.assertGreater(injected[-1], 0)
        self.assertLess(abs(run[f"fluid_balance_error[{unit}]"]).max(), 1e-8 * injected[-1])
        return (step * (run[f"conduit.p.rate[{unit}/s]"] + run[f"conduit.q.rate[{unit}/s]"])).sum() / injected[-1]

    def test_schemes(self):
        ends = {}
        for scheme, solves in SCHEMES.items():
            run = self.run_scene(self.write(PLANE.replace("SOLVES", solves)))
            passed = self.assert_adds_up(run, "m^2")
            if scheme != "substeps":  # there the columns have the rates of the last one
                self.assertAlmostEqual(passed, 1, delta=1e-8)
            ends[scheme] = run["fluid_injected[m^2]"][-1]
        self.assertAlmostEqual(ends["in turn"] / ends["together"], 1, delta=1e-8)

    def test_space_turned_and_second_order(self):
        self.assertAlmostEqual(self.assert_adds_up(self.run_scene(self.write(SPACE.replace("SOLVES", SCHEMES["together"]))), "m^3"), 1, delta=1e-9)
        path = self.write(PLANE.replace("SOLVES", SCHEMES["together"]), "plain.yaml")
        plain, turned, second = self.run_scene(path), self.run_scene(self.turned(path, 90)), self.run_scene(path, "time.scheme=sdirk2")
        for run in (turned, second):
            self.assert_adds_up(run, "m^2")
        self.assertAlmostEqual(second["fluid_injected[m^2]"][-1] / plain["fluid_injected[m^2]"][-1], 1, delta=0.1)

    @on_two_processes
    def test_two_processes(self):
        path = self.write(PLANE.replace("SOLVES", SCHEMES["together"]))
        one, two = (self.run_scene(path, processes=n) for n in (1, 2))
        self.assert_adds_up(two, "m^2")
        self.assertAlmostEqual(two["fluid_injected[m^2]"][-1] / one["fluid_injected[m^2]"][-1], 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
