#!/usr/bin/python3
"""carried_by_wells_test.py SPREKK [MPIEXEC]: what wells in the rock carry beside sides and corners, where some of the shares of their rates are
negative: the tracer and the heat that enter are rate times value times time, values stay within those of rock and fluid, and a uniform value stays."""

import unittest

from scene_runs import SceneRuns, on_two_processes

RATE, TIME = 1e-5, 864000.0  # m^2/s (in space m^3/s), s
PLANE = """
geometry: {box: {x: [0 m, 100 m], y: [0 m, 80 m]}}
mesh: {kind: structured, shape: SHAPE, cells: [10, 8]}
materials: {permeability: 1e-13 m^2, porosity: 0.2, fluid_compressibility: 4.5e-10 1/Pa, viscosity: 1 mPa*s}
components:
  pore:
    type: matrix_flow/mpfa
    boundary: {right: {pressure: 0 Pa}, top: {pressure: 0 Pa}}
    wells: {low: {at: [2 m, 2.5 m], rate: RATE}, side: {points: [[1.5 m, 41 m], [4 m, 46 m]], rate: RATE}}
  salt: {type: matrix_transport/mpfa, diffusion: 1e-9 m^2/s}
  heat: {type: matrix_heat/mpfa, initial_temperature: 300 K, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K)}
couplers:
  - {type: tracer_advection, between: [pore, salt], injected: {low: {concentration: 1 kg/m^3}, side: {concentration: 0.5 kg/m^3}}}
  - {type: heat_advection, between: [pore, heat], fluid_heat_capacity: 4e6 J/(m^3*K), injected: {low: {temperature: 310 K}, side: {temperature: 290 K}}}
schedule: [{solve: pore}, {solve: salt}, {solve: heat}]
time: {end: 10 day, step: 1 day}
output:
  fields: false
  probes:
    least: {of: salt.concentration, take: smallest}
    most: {of: salt.concentration, take: largest}
    cold: {of: heat.temperature, take: smallest}
    hot: {of: heat.temperature, take: largest}
"""
SPACE = (PLANE.replace("y: [0 m, 80 m]", "y: [0 m, 80 m], z: [-60 m, 0 m]").replace("[10, 8]", "[5, 4, 3]")
         .replace("at: [2 m, 2.5 m]", "at: [3 m, 3.5 m, -3 m]").replace("[[1.5 m, 41 m], [4 m, 46 m]]", "[[2 m, 3 m, -57 m], [3 m, 44 m, -52 m]]"))
SHAPES = {PLANE: ("triangles", "quadrilaterals"), SPACE: ("tetrahedra", "hexahedra")}


def scene(text, shape, rate=RATE):
    return text.replace("SHAPE", shape).replace("rate: RATE", f"rate: {rate} " + ("m^2/s" if "z: [" not in text else "m^3/s"))


class CarriedByWells(SceneRuns):
    def assert_right(self, run, lets_in_by_wells_alone=True):
        unit = "kg" if "tracer_injected[kg]" in run.history else "kg/m"
        salt = RATE * TIME * (1 + 0.5)
        self.assertAlmostEqual(run[f"tracer_injected[{unit}]"][-1] / salt, 1, delta=1e-9)
        heat = next(name for name in run.history if name.startswith("heat_injected["))
        if lets_in_by_wells_alone:
            self.assertAlmostEqual(run[heat][-1] / (4e6 * RATE * TIME * (310 + 290)), 1, delta=1e-12)
        self.assertLess(abs(run[f"tracer_balance_error[{unit}]"][-1]), 1e-10 * salt)
        for low, value, high in ((0, "least", 1), (0, "most", 1)):
            self.assertGreater(run[f"{value}[kg/m^3]"].min(), low - 1e-9)
            self.assertLess(run[f"{value}[kg/m^3]"].max(), high + 1e-9)
        self.assertGreater(run["cold[K]"].min(), 290 - 1e-7)
        self.assertLess(run["hot[K]"].max(), 310 + 1e-7)

    def test_what_is_injected(self):
        for text, shapes in SHAPES.items():
            for shape in shapes:
                run = self.run_scene(self.write(scene(text, shape)))
                self.assert_right(run, shape != "tetrahedra")  # their fluxes through open sides have both signs
                again = self.run_scene(self.write(scene(text, shape, RATE * (1 + 1e-9))))
                for name in ("most[kg/m^3]", "hot[K]"):
                    self.assertAlmostEqual(again[name][-1] / run[name][-1], 1, delta=1e-7)

    def test_uniform_values_stay_where_wells_extract(self):
        for text, shapes in SHAPES.items():
            for shape in shapes:
                path = self.write(scene(text, shape, -RATE))
                run = self.run_scene(path, "components.salt.initial_concentration=1 kg/m^3", *(
                    f"components.{component}.boundary={{{side}}}" for component, side in (
                        ("salt", "right: {concentration: 1 kg/m^3}, top: {concentration: 1 kg/m^3}"),
                        ("heat", "right: {temperature: 300 K}, top: {temperature: 300 K}"))))
                for name in ("least[kg/m^3]", "most[kg/m^3]"):
                    self.assertLess(abs(run[name] - 1).max(), 1e-9, shape)
                for name in ("cold[K]", "hot[K]"):
                    self.assertLess(abs(run[name] - 300).max(), 1e-7, shape)

    def test_substeps_of_the_flow(self):
        schedule = "schedule=[{subcycle: {count: 2, steps: [{solve: pore}]}}, {solve: salt}, {solve: heat}]"
        for shape in SHAPES[PLANE]:
            plain, substeps = (self.run_scene(self.write(scene(PLANE, shape)), *settings) for settings in ((), (schedule,)))
            self.assert_right(substeps)
            for name in ("most[kg/m^3]", "hot[K]"):
                self.assertAlmostEqual(substeps[name][-1] / plain[name][-1], 1, delta=1e-3, msg=name)  # of the first step's storage

    def test_what_leaves_is_told(self):
        # The low well alone extracts, and nothing leaves elsewhere: its column times its rate is all that leaves.
        text = PLANE[:PLANE.index(", side: {points")] + PLANE[PLANE.index("}\n  salt"):]
        text = text[:text.index(", injected: {low")] + text[text.index("}\n  - {type: heat"):]
        text = text[:text.index(", injected: {low")] + text[text.index("}\nschedule"):]
        for shape in SHAPES[PLANE]:
            run = self.run_scene(self.write(scene(text, shape, -RATE)), 'components.salt.initial_concentration="(1 + x/(30*m) + y/(100*m)) kg/m^3"')
            told = (run["tracer_advection.low.concentration[kg/m^3]"] * RATE * TIME / 10).sum()
            self.assertAlmostEqual(told / run["tracer_outflow[kg/m]"][-1], 1, delta=1e-9, msg=shape)

    def test_a_source_that_is_spread_does_not_mix(self):
        # 1e-7 (1 - x/50) for each m^2: what enters at the left has the given values, what leaves at the right is another place's.
        text = scene(PLANE, "quadrilaterals")
        for of_wells, of_source in (("{low: {concentration: 1 kg/m^3}, side: {concentration: 0.5 kg/m^3}}", "{source: {concentration: 1 kg/m^3}}"),
                                    ("{low: {temperature: 310 K}, side: {temperature: 290 K}}", "{source: {temperature: 310 K}}")):
            self.assertIn(of_wells, text)
            text = text.replace(of_wells, of_source)
        run = self.run_scene(self.write(text), "components.pore.wells=null", 'components.pore.source="(1e-7*(1 - x/50)) 1/s"')
        entering = 1e-7 * 0.5 * 50 * 80 * TIME
        self.assertAlmostEqual(run["tracer_injected[kg/m]"][-1] / entering, 1, delta=1e-9)
        self.assertGreater(run["most[kg/m^3]"][-1], 0.05)
        self.assertGreaterEqual(run["least[kg/m^3]"].min(), -1e-9)

    def test_turned_and_mirrored(self):
        plain = self.run_scene(self.write(scene(PLANE, "quadrilaterals")))
        for angle, mirror in ((0, True), (90, False)):
            path = self.write(scene(PLANE, "quadrilaterals"), "plain.yaml")
            other = self.run_scene(self.turned(path, angle, mirror=mirror))
            self.assert_right(other)
            for name in ("most[kg/m^3]", "hot[K]", "cold[K]"):
                self.assertAlmostEqual(other[name][-1] / plain[name][-1], 1, delta=1e-9, msg=(name, angle, mirror))

    @on_two_processes
    def test_two_processes(self):
        for text in SHAPES:
            path = self.write(scene(text, SHAPES[text][0]))
            one, two = (self.run_scene(path, processes=n) for n in (1, 2))
            self.assert_right(two, text == PLANE)
            self.assertAlmostEqual(two["most[kg/m^3]"][-1] / one["most[kg/m^3]"][-1], 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
