#!/usr/bin/python3
"""all_physics_in_space_test.py SPREKK [MPIEXEC]: flow, rock, contact, heat and a tracer in space, with all of their couplers and two unlike faults
that cross: the same answer when solved together and in turn, on two processes, and with a disturbed rate; all balances close."""

import unittest

from scene_runs import SceneRuns, on_two_processes

SCENE = """
geometry:
  box: {x: [-80 m, 80 m], y: [-80 m, 80 m], z: [-80 m, 80 m]}
  fractures:
    fault: {center: [0 m, 0 m, 0 m], strike: 30 deg, dip: 60 deg, length: 60 m, height: 50 m}
    cut: {center: [10 m, 5 m, 5 m], strike: 100 deg, dip: 80 deg, length: 60 m, height: 40 m}
mesh: {size: 150 m, fracture_size: 40 m, growth: 2}
materials: {biot_coefficient: 0.8, porosity: 0.05, fluid_compressibility: 4.5e-10 1/Pa}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-15 m^2
    viscosity: 1 mPa*s
    initial_pressure: 15 MPa
    boundary:
      left: {pressure: 16 MPa}
      right: {pressure: 15 MPa}
  rock:
    type: poromechanics/fem
    young_modulus: 20 GPa
    poisson_ratio: 0.2
    initial_stress: {xx: -26 MPa, yy: -34 MPa, zz: -45 MPa, xy: 1 MPa, yz: 2 MPa, xz: -1 MPa}
    boundary:
      left: {displacement: [0 m, 0 m, 0 m]}
      right: {displacement: [0 m, 0 m, 0 m]}
      front: {displacement: [0 m, 0 m, 0 m]}
      back: {displacement: [0 m, 0 m, 0 m]}
      bottom: {displacement: [0 m, 0 m, 0 m]}
      top: {displacement: [0 m, 0 m, 0 m]}
  conduit:
    type: fracture_flow/mfd
    viscosity: 1 mPa*s
    initial_aperture: {fractures: {fault: 0.1 mm, cut: 0.2 mm}}
    initial_pressure: 15 MPa
    injection: {well: {fracture: fault, at: [0 m, 0 m, 0 m], rate: RATE m^3/s}}
  contact: {type: contact/coulomb, friction: {fractures: {fault: 0.4, cut: 0.6}}, dilation_angle: 2 deg}
  heat:
    type: matrix_heat/mpfa
    conductivity: 2.5 W/(m*K)
    heat_capacity: 2.4e6 J/(m^3*K)
    initial_temperature: 350 K
    boundary: {left: {temperature: 345 K}}
  warm:
    type: fracture_heat/tpfa
    aperture: {fractures: {fault: 0.1 mm, cut: 0.2 mm}}
    conductivity: 0.6 W/(m*K)
    heat_capacity: 4.2e6 J/(m^3*K)
    initial_temperature: 350 K
  solute: {type: matrix_transport/mpfa, diffusion: 1e-9 m^2/s, decay: 1e-6 1/s, retardation: 1.3, initial_concentration: 0.2 kg/m^3}
  dye:
    type: fracture_transport/tpfa
    aperture: {fractures: {fault: 0.1 mm, cut: 0.2 mm}}
    diffusion: 1e-9 m^2/s
    decay: 1e-6 1/s
    initial_concentration: 0.2 kg/m^3
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
  - {type: heat_exchange, between: [heat, warm]}
  - {type: heat_advection, between: [pore, conduit, heat, warm], fluid_heat_capacity: 4.2e6 J/(m^3*K), injected: {well: {temperature: 320 K}}}
  - {type: tracer_exchange, between: [solute, dye]}
  - type: tracer_advection
    between: [pore, conduit, solute, dye]
    injected: {well: {concentration: 1 kg/m^3}}
    longitudinal_dispersivity: 0.5 m
    transverse_dispersivity: 0.05 m
  - {type: thermal_viscosity, between: [pore, conduit, heat, warm], law: water}
  - {type: thermal_stress, between: [rock, heat], expansion: 1e-5 1/K}
  - {type: thermal_pressurization, between: [pore, conduit, heat, warm], fluid_expansion: 4e-4 1/K}
schedule: [SCHEDULE]
time: {end: 2 day, step: 1 day}
output: {every: 1 day}
"""
TOGETHER = "{solve: [pore, conduit, rock, contact, heat, warm]}, {solve: [solute, dye]}"
IN_TURN = "{iterate: {until: {relative: 1e-10}, steps: [{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}, {solve: [heat, warm]}, {solve: [solute, dye]}]}}"


COLUMNS = ("conduit.well.pressure[Pa]", "pore.left.outflow[m^3/s]", "contact.cells_slip[1]", "fluid_stored[m^3]", "heat_stored[J]", "tracer_stored[kg]")


class AllPhysicsInSpace(SceneRuns):
    @classmethod
    def scene(cls, schedule=TOGETHER, rate=4e-5):
        return cls.write(SCENE.replace("SCHEDULE", schedule).replace("RATE", repr(rate)), f"{len(schedule)}_{rate!r}.yaml")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.together = cls.run_scene(cls.scene())

    def test_walls_slip_and_everything_moves(self):
        def value(name):
            return abs(self.together[name][-1])

        self.assertGreater(value("contact.cells_slip"), 0)
        for quantity in ("fluid", "heat", "tracer"):
            self.assertLess(value(f"{quantity}_balance_error"), 1e-9 * value(f"{quantity}_injected"), quantity)

    def test_in_turn(self):
        self.assertLess(self.largest_difference(self.run_scene(self.scene(IN_TURN)), self.together, COLUMNS), 1e-6)

    @on_two_processes
    def test_two_processes(self):
        self.assertLess(self.largest_difference(self.run_scene(self.scene(), processes=2), self.together, COLUMNS), 1e-8)

    def test_a_disturbed_rate(self):
        self.assertLess(self.largest_difference(self.run_scene(self.scene(rate=4e-5 * (1 + 1e-9))), self.together, COLUMNS), 1e-6)


if __name__ == "__main__":
    unittest.main()
