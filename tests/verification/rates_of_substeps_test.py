#!/usr/bin/python3
"""rates_of_substeps_test.py SPREKK [MPIEXEC]: what fluid carries, and what flows out, belong to the part of the step for which the flow was solved.
Heat that enters with the fluid is the sum over the substeps of the flow, in every schedule; steady flow leaves where it enters."""

import itertools
import unittest

import numpy as np
from scene_runs import SceneRuns, on_two_processes

CAPACITY, STEP, END = 4e6, 2e5, 8e5  # J/(m^3 K), s
COLUMN = """
name: column
geometry: {box: {x: [0 m, 10 m], y: [0 m, 1 m]}}
mesh: {kind: structured, cells: [10, 1], shape: quadrilaterals}
materials: {conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), fluid_heat_capacity: 4e6 J/(m^3*K), viscosity: 1 mPa*s}
components:
  pore: {type: matrix_flow/tpfa, permeability: 1e-13 m^2, storage: 0 1/Pa, boundary: {left: {flux: "(-1e-6*(1+t/8e5)) m/s"}, right: {pressure: 0 Pa}}}
  heat: {type: matrix_heat/tpfa, initial_temperature: 0 K, boundary: {left: {temperature: 1 K}}}
couplers: [{type: heat_advection, between: [pore, heat]}]
schedule: [{solve: [pore, heat]}]
time: {end: 8e5 s, step: 2e5 s}
output: {fields: false}
"""
# Fluid is injected into the middle of a fracture, and leaves through the rock around it.
FRACTURE = """
name: fracture
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 10 m]}
  fractures: {f: {points: [[2 m, 5 m], [8 m, 5 m]]}}
mesh: {kind: structured, cells: [10, 10], shape: quadrilaterals}
materials: {conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), fluid_heat_capacity: 4e6 J/(m^3*K), viscosity: 1 mPa*s}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-13 m^2, storage: 1e-9 1/Pa, boundary: {left: {pressure: 0 Pa}, right: {pressure: 0 Pa}}}
  conduit:
    type: fracture_flow/tpfa
    fluid_compressibility: 0 1/Pa
    initial_aperture: 1 mm
    law: {type: constant, transmissivity: 1e-11 m^3}
    injection: {pump: {fracture: f, at: [5 m, 5 m], rate: "(1e-6*(1+t/8e5)) m^2/s"}}
  heat: {type: matrix_heat/tpfa, initial_temperature: 300 K}
  water: {type: fracture_heat/tpfa, aperture: 1 mm, initial_temperature: 300 K, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K)}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: heat_exchange, between: [heat, water]}
  - {type: heat_advection, between: [pore, conduit, heat, water], injected: {pump: {temperature: 350 K}}}
schedule: [{solve: [pore, conduit, heat, water]}]
time: {end: 8e5 s, step: 2e5 s}
output: {fields: false, probes: {low: {of: heat.temperature, take: smallest}, high: {of: water.temperature, take: largest}}}
"""


PIPE = """
name: pipe
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 2 m]}
  fractures: {f: {points: [[0 m, 1 m], [10 m, 1 m]]}}
mesh: {kind: structured, cells: [10, 2], shape: quadrilaterals}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: 1 mm
    law: {type: constant, transmissivity: 1e-12 m^3}
    prescribed: {inlet: {fracture: f, at: [0.5 m, 1 m], pressure: 1 MPa}}
    boundary: {right: {pressure: 0 Pa}}
schedule: [{solve: conduit}]
time: {end: 2 s, step: 1 s}
output: {fields: false}
"""


def carried(flow_substeps, first_step=0):
    """The fluid (m^2) that the flow lets in with this number of substeps, by hand: the rate at the end of each."""
    length = STEP / flow_substeps
    times = [first_step * STEP + (k + 1) * length for k in range(round((END - first_step * STEP) / length))]
    return sum(1e-6 * (1 + t / END) * length for t in times)


def schedules(flow, heat):
    """Schedules, each with the substeps of the flow in it and the number of steps before the heat is carried."""
    def cycle(count, *steps):
        return f"{{subcycle: {{count: {count}, steps: [{', '.join(steps)}]}}}}"

    def linear(count, step):
        return f"{{subcycle: {{count: {count}, waiting: linear, steps: [{step}]}}}}"
    solve_flow, solve_heat, together = f"{{solve: {flow}}}", f"{{solve: {heat}}}", f"{{solve: [{flow.strip('[]')}, {heat.strip('[]')}]}}"
    return {
        f"[{together}]": 1,
        f"[{solve_flow}, {solve_heat}]": 1,
        f"[{cycle(3, solve_flow)}, {solve_heat}]": 3,
        f"[{cycle(1, solve_flow)}, {solve_heat}]": 1,
        f"[{solve_flow}, {cycle(4, solve_heat)}]": 1,
        f"[{solve_flow}, {linear(4, solve_heat)}]": 1,
        f"[{solve_flow}, {cycle(1, solve_heat)}]": 1,
        f"[{cycle(3, solve_flow)}, {cycle(2, solve_heat)}]": 3,
        f"[{cycle(3, solve_flow, solve_heat)}]": 3,
        f"[{cycle(4, together)}]": 4,
        f"[{{iterate: {{steps: [{solve_flow}, {solve_heat}]}}}}]": 1,
        f"[{{iterate: {{steps: [{cycle(3, solve_flow)}, {solve_heat}]}}}}]": 3,
        f"[{{iterate: {{order: jacobi, steps: [{cycle(3, solve_flow)}, {cycle(2, solve_heat)}]}}}}]": 3,
        f"[{{iterate: {{steps: [{cycle(2, solve_heat)}, {cycle(3, solve_flow)}]}}}}]": 3,
    }


class RatesOfSubsteps(SceneRuns):
    def assert_heat(self, scenes, flow, heat, temperature, only=None, **options):
        found = []
        for schedule, substeps in itertools.islice(schedules(flow, heat).items(), only):
            run = self.run_scene(scenes, f"schedule={schedule}", **options)
            self.assertAlmostEqual(run["heat_injected[J/m]"][-1] / (CAPACITY * temperature * carried(substeps)), 1, delta=1e-9, msg=schedule)
            self.assertAlmostEqual(run["fluid_injected[m^2]"][-1] if "conduit" in flow else -run["fluid_outflow[m^2]"][-1] + carried(substeps),
                                   carried(substeps), delta=1e-9 * carried(substeps), msg=schedule)
            self.assertLess(np.abs(run["heat_balance_error[J/m]"]).max(), 1e-9 * run["heat_injected[J/m]"][-1], schedule)
            found.append(run)
        return found

    def test_heat_in_a_column(self):
        self.assert_heat(self.write(COLUMN, "column.yaml"), "pore", "heat", 1)

    def test_heat_in_a_column_that_is_mirrored_or_disturbed(self):
        mirrored = COLUMN.replace("left:", "swap:").replace("right:", "left:").replace("swap:", "right:")
        self.assert_heat(self.write(mirrored, "mirrored.yaml"), "pore", "heat", 1)
        disturbed = COLUMN.replace("1e-13 m^2", "1.000000001e-13 m^2")
        self.assert_heat(self.write(disturbed, "disturbed.yaml"), "pore", "heat", 1)

    def test_heat_in_a_fracture(self):
        runs = self.assert_heat(self.write(FRACTURE, "fracture.yaml"), "[pore, conduit]", "[heat, water]", 350)
        for run in runs:
            self.assertGreater(run["low[K]"].min(), 300 - 1e-9)
            self.assertLess(run["high[K]"].max(), 350 + 1e-9)

    @on_two_processes
    def test_heat_on_two_processes(self):
        self.assert_heat(self.write(FRACTURE, "fracture.yaml"), "[pore, conduit]", "[heat, water]", 350, only=4, processes=2)

    def test_heat_before_the_flow_is_not_carried_in_the_first_step(self):
        # Also not in its substeps: no solve has found the flow yet. From then on it is carried by the last fluxes.
        scene = self.write(COLUMN, "column.yaml")
        for heat in ("{solve: heat}", "{subcycle: {count: 4, steps: [{solve: heat}]}}"):
            run = self.run_scene(scene, f"schedule=[{heat}, {{solve: pore}}]")
            expected = CAPACITY * sum(1e-6 * (1 + k * STEP / END) * STEP for k in range(1, 4))
            self.assertEqual(run["heat_injected[J/m]"][0], 0)
            self.assertAlmostEqual(run["heat_injected[J/m]"][-1] / expected, 1, delta=1e-9)

    def test_a_restart_goes_on_to_the_bit(self):
        scene = self.write(COLUMN, "column.yaml")
        for schedule in ("[{solve: heat}, {solve: pore}]", "[{subcycle: {count: 3, steps: [{solve: pore}]}}, {solve: heat}]"):
            whole = self.run_scene(scene, f"schedule={schedule}")
            parts = self.run_scene(scene, f"schedule={schedule}", "time.end=4e5 s")
            self.assert_same_bits(self.run_scene(scene, f"schedule={schedule}", restart=parts.folder), whole)

    def test_outflow_and_velocity_are_those_of_the_last_substep(self):
        # Without storage as much leaves as enters, at any time, while warm water becomes less viscous.
        viscous = COLUMN.replace('left: {flux: "(-1e-6*(1+t/8e5)) m/s"}', "left: {pressure: 1 MPa}").replace("initial_temperature: 0 K", "initial_temperature: 293.15 K")
        viscous = viscous.replace("left: {temperature: 1 K}", "left: {temperature: 373.15 K}").replace(
            "between: [pore, heat]}]", "between: [pore, heat]}, {type: thermal_viscosity, between: [pore, heat], law: water}]")
        viscous = viscous.replace("fields: false", "fields: true")
        scene = self.write(viscous, "viscous.yaml")
        plain = self.run_scene(scene, "time.step=5e4 s")
        for schedule in ("[{subcycle: {count: 4, steps: [{solve: [pore, heat]}]}}]", "[{subcycle: {count: 4, steps: [{iterate: {steps: [{solve: pore}, {solve: heat}]}}]}}]"):
            run = self.run_scene(scene, f"schedule={schedule}")
            left, right = run["pore.left.outflow[m^2/s]"], run["pore.right.outflow[m^2/s]"]
            self.assertLess(np.abs(left + right).max(), 1e-12 * np.abs(right).max())
            expected = plain["pore.right.outflow[m^2/s]"][3::4]
            self.assertLess(np.abs(right / expected - 1).max(), 1e-7)
            velocity = np.asarray(run.fields()["pore.velocity"])
            self.assertLess(np.abs(velocity[:, 0] / right[-1] - 1).max(), 1e-10)

    def test_what_a_prescribed_pressure_lets_in(self):
        # Steady flow of a fluid that is not compressible: as much enters as leaves at the end.
        scene = self.write(PIPE, "pipe.yaml")
        for settings in ((), ("schedule=[{subcycle: {count: 3, steps: [{solve: conduit}]}}]",), ("time.scheme=sdirk2",)):
            run = self.run_scene(scene, *settings)
            leaves = run["conduit.right.outflow[m^2/s]"][-1]
            self.assertAlmostEqual(leaves, 1e-12 / 1e-3 * 1e6 / 9.5, delta=1e-9 * leaves)
            self.assertAlmostEqual(run["conduit.inlet.rate[m^2/s]"][-1], leaves, delta=1e-9 * leaves, msg=settings)


if __name__ == "__main__":
    unittest.main()
