#!/usr/bin/python3
"""settled_systems_test.py SPREKK: steady systems whose rows and columns have very different scales are solved, and not taken for singular ones: a
fracture with closed ends in space, and heat that flow carries past sides that leak."""

import unittest

import numpy as np
from scene_runs import SceneRuns

FAULT = """
geometry: {box: {x: [0 m, 40 m], y: [0 m, 40 m], z: [0 m, 40 m]},
           fractures: {f: {points: [[20 m, 0 m, 0 m], [20 m, 40 m, 0 m], [20 m, 40 m, 40 m], [20 m, 0 m, 40 m]]}}}
mesh: {kind: structured, shape: tetrahedra, cells: [4, 2, 2]}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 4.5e-11 1/Pa, initial_pressure: 10 MPa, boundary: {left: {pressure: 10.5 MPa}}}
  conduit: {type: fracture_flow/mfd, viscosity: 1 mPa*s, fluid_compressibility: 4.5e-10 1/Pa, initial_aperture: 0.3 mm, initial_pressure: 10 MPa}
  rock:
    type: poromechanics/fem
    order: second
    young_modulus: 20 GPa
    poisson_ratio: 0.2
    initial_stress: {xx: -30 MPa, yy: -24 MPa, zz: -38 MPa, xy: 1 MPa, yz: 0 Pa, xz: 0 Pa}
    boundary: {left: {displacement: [0 m, 0 m, 0 m]}, right: {displacement: [0 m, 0 m, 0 m]}, back: {displacement_normal: 0 m},
               front: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, top: {normal_stress: -38 MPa}}
  contact: {type: contact/coulomb, friction: 0.6, dilation_angle: 3 deg, closure: {law: linear, stiffness: 1e12 Pa/m}}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: biot, between: [pore, rock], biot_coefficient: 0.8}
  - {type: wall_traction, between: [rock, contact, conduit], fracture_biot_coefficient: 0.9}
  - {type: aperture, between: [contact, conduit]}
schedule: [{solve: [pore, conduit, rock, contact]}]
time: {end: 1 day, step: 1 day}
start: {settle: [pore, conduit, rock, contact]}
output: {fields: false, probes: {least: {of: pore.pressure, take: smallest}, most: {of: pore.pressure, take: largest}, within: {of: conduit.pressure, take: mean}}}
"""
DOUBLET = """
geometry:
  box: {x: [0 m, 60 m], y: [0 m, 40 m]}
  regions: {block: {polygon: [[35 m, 20 m], [60 m, 20 m], [60 m, 40 m], [35 m, 40 m]]}}
  fractures: {a: {points: [[10 m, 15 m], [50 m, 15 m]]}, b: {points: [[30 m, 5 m], [30 m, 40 m]]}, c: {points: [[45 m, 15 m], [45 m, 30 m]]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [12, 8]}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: {regions: {block: 3e-16 m^2, default: 5e-15 m^2}}
    viscosity: 0.8 mPa*s
    porosity: 0.06
    fluid_compressibility: 4.5e-9 1/Pa
    initial_pressure: 5.5 MPa
    boundary:
      left: {pressure: 7 MPa}
      right: {outer_pressure: 4 MPa, conductance: 3e-12 m/(Pa*s), only_out: true}
      top: {outer_pressure: 5 MPa, conductance: 1e-12 m/(Pa*s)}
      bottom: {flux: (1e-9*x/60) m/s}
    wells: {w: {at: [17.5 m, 27.5 m], rate: 4e-6 m^2/s}, v: {at: [52 m, 33 m], rate: -2e-7 m^2/s}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 0.8 mPa*s
    fluid_compressibility: 4.5e-9 1/Pa
    initial_aperture: {fractures: {a: 0.3 mm, b: 0.1 mm, c: 0.2 mm}}
    initial_pressure: 5.5 MPa
    boundary: {top: {as_rock: true}}
  heat:
    type: matrix_heat/mpfa
    conductivity: {xx: 3 W/(m*K), yy: 2 W/(m*K), xy: 0 W/(m*K)}
    heat_capacity: 2.3e6 J/(m^3*K)
    initial_temperature: (340 - 0.1*y/m + 0.02*x/m) K
    boundary: {left: {temperature: (330 - 0.1*y/m) K}, top: {temperature: 335 K}, bottom: {heat_flux: -1 W/m^2}}
  warm:
    type: fracture_heat/tpfa
    aperture: {fractures: {a: 0.3 mm, b: 0.1 mm, c: 0.2 mm}}
    conductivity: 0.6 W/(m*K)
    heat_capacity: 4.2e6 J/(m^3*K)
    initial_temperature: (340 - 0.1*y/m + 0.02*x/m) K
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: heat_exchange, between: [heat, warm]}
  - {type: heat_advection, between: [pore, conduit, heat, warm], fluid_heat_capacity: 4.2e6 J/(m^3*K), injected: {w: {temperature: 300 K}}}
schedule: [{solve: [pore, conduit, heat, warm]}]
time: {end: END, step: STEP}
START
output: {fields: false, probes: {p: {of: pore.pressure, take: mean}, least: {of: heat.temperature, take: smallest}, T: {of: heat.temperature, take: mean}, Tf: {of: warm.temperature, take: mean}}}
"""
SETTLED = "start: {settle: [pore, conduit, heat, warm]}"


class SettledSystems(SceneRuns):
    def test_a_fracture_with_closed_ends(self):
        # Nothing flows: the pressure is that of the only side that has one.
        for settings in ((), ("components.pore.permeability=1e-12 m^2",), ("components.conduit.initial_aperture=1 mm",), ("mesh.cells=[4, 2, 3]",)):
            run = self.run_scene(self.write(FAULT), *settings)
            for name in ("least", "most", "within"):
                self.assertAlmostEqual(run[f"{name}[Pa]"][-1] / 10.5e6, 1, delta=1e-8, msg=settings)

    def test_heat_that_flow_carries(self):
        # A settled state is that of a very long step, and stays; both direct solvers find it.
        settled = {solver: self.run_scene(self.write(DOUBLET.replace("END", "4 day").replace("STEP", "1 day").replace("START", SETTLED)),
                                          f"solver={{type: {solver}}}") for solver in ("umfpack", "mumps")}
        long = self.run_scene(self.write(DOUBLET.replace("END", "1e9 year").replace("STEP", "1e9 year").replace("START", "")))
        for name in ("p[Pa]", "T[K]", "Tf[K]", "least[K]"):
            for run in settled.values():
                self.assertAlmostEqual(np.ptp(run[name]) / run[name][0], 0, delta=1e-9, msg=name)
                self.assertAlmostEqual(run[name][-1] / long[name][-1], 1, delta=1e-7, msg=name)

    def test_closed_sides(self):
        # Fluid is kept: the pressure is the mean of that at the start, also where nothing stores fluid but pores and a
        # fracture that it opens.
        closed = FAULT.replace(", boundary: {left: {pressure: 10.5 MPa}}", "").replace("initial_pressure: 10 MPa", "initial_pressure: (10e6 + 1e4*x/m) Pa")
        without_storage = closed.replace("storage: 4.5e-11", "storage: 0").replace("fluid_compressibility: 4.5e-10", "fluid_compressibility: 0")
        for text in (closed, without_storage):
            run = self.run_scene(self.write(text))
            for name in ("least", "most", "within"):
                self.assertAlmostEqual(run[f"{name}[Pa]"][-1] / 10.2e6, 1, delta=1e-8)


if __name__ == "__main__":
    unittest.main()
