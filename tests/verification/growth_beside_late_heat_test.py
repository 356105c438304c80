#!/usr/bin/python3
"""growth_beside_late_heat_test.py SPREKK [MPIEXEC]: rock that a source warms by 1 K a step, whose fluid expands, around a fracture that grows.
Solved after the flow, the temperature is counted one step late, also while the mesh follows the tips: nothing is lost, nothing comes twice."""

import unittest

import numpy as np
from scene_runs import SceneRuns, on_two_processes

STEP = 150.0  # s
SCENE = """
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 2 m]}
  fractures: {main: {center: [0.9 m, 1.05 m], length: 0.2 m, angle: 40 deg}}
mesh: {size: 0.4 m, fracture_size: 50 mm, growth: 0.4}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, biot_coefficient: 0.8, porosity: 0.01, fluid_compressibility: 4e-10 1/Pa,
            permeability: 5e-20 m^2, viscosity: 1e-4 Pa*s, friction: 0.5, dilation_angle: 1 deg}
components:
  pore: {type: matrix_flow/mpfa}
  rock:
    type: poromechanics/mpsa
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, right: {normal_stress: -20 MPa}, top: {normal_stress: -10 MPa}}
  conduit: {type: fracture_flow/tpfa, initial_aperture: 1 mm, injection: {well: {fracture: main, rate: 6e-9 m^2/s}}}
  contact: {type: contact/coulomb}
  tips: {type: fine_fracture/quarter_point, size: 0.7 m, toughness: 0.7 MPa*m^0.5, growth: {increment: 40 mm, front_tolerance: 1e-4}}
  heat: {type: matrix_heat/mpfa, conductivity: 3 W/(m*K), heat_capacity: 2.4e6 J/(m^3*K), initial_temperature: 300 K, source: 16 kW/m^3}
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
  - {type: two_level, between: [rock, conduit, tips, contact]}
  - EXPANSION
schedule: [SOLVES, {grow: tips, settle: [rock, contact], update: UPDATE}]
time: {end: 900 s, step: 150 s}
output: {fields: false, probes: {far: {of: pore.pressure, at: [1.7 m, 1.7 m]}, most: {of: pore.pressure, take: largest}}}
"""
COUPLED = "{type: thermal_pressurization, between: [pore, heat], fluid_expansion: 1e-3 1/K}"
BY_PORES = "{type: heat_advection, between: [pore, heat], fluid_heat_capacity: 1 kJ/(m^3*K)}"
PORES = 'components.pore.porosity="0.01 + 0.8*eps_v + p/(28.13 GPa) - 1e-5*(T - 300 K)/(1 K)"'
FLOW, HEAT = "{solve: [pore, rock, conduit, contact]}", "{solve: heat}"


class GrowthBesideLateHeat(SceneRuns):
    def late_and_in_time(self, expansion, update, *settings, processes=1):
        text = SCENE.replace("EXPANSION", expansion).replace("UPDATE", update)
        return [self.run_scene(self.write(text.replace("SOLVES", ", ".join(solves))), *settings, processes=processes)
                for solves in ((FLOW, HEAT), (HEAT, FLOW))]

    def assert_one_step_late(self, late, in_time):
        """What a kelvin does to the pressure far away is 0.16 MPa; the rest follows the injection and the growth."""
        self.assertGreater(in_time["tips.main_first.length[m]"][-1], in_time["tips.main_first.length[m]"][0])
        times, pressures = in_time["time[s]"], in_time["far[Pa]"]
        per_second = (pressures[-1] - pressures[0]) / (times[-1] - times[0])
        self.assertAlmostEqual(per_second * STEP, 0.16e6, delta=0.02e6)
        start = pressures[0] - per_second * times[0]
        counted_until = np.insert(late["time[s]"], 0, 0)[:-1]
        for time, value in zip(counted_until, late["far[Pa]"]):
            expected = np.interp(time, np.insert(times, 0, 0), np.insert(pressures, 0, start))
            self.assertAlmostEqual(value, expected, delta=0.1 * per_second * STEP, msg=time)
        self.assertLess(late["most[Pa]"].max(), 1.02 * in_time["most[Pa]"].max())
        self.assertLess(abs(late["fluid_balance_error[m^2]"]).max(), 1e-12)

    def test_fluid_that_expands(self):
        self.assert_one_step_late(*self.late_and_in_time(COUPLED, "within_step"))

    def test_pores_that_follow_the_temperature(self):
        self.assert_one_step_late(*self.late_and_in_time(BY_PORES, "after_step", PORES))

    @on_two_processes
    def test_two_processes(self):
        self.assert_one_step_late(*self.late_and_in_time(COUPLED, "after_step", processes=2))


if __name__ == "__main__":
    unittest.main()
