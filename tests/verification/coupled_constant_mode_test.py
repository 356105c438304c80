#!/usr/bin/python3
"""coupled_constant_mode_test.py SPREKK MPIEXEC: fluid in a closed box of porous rock that conducts 1e15 times in a step what it stores.

The pressure is the same everywhere. Loads p_x and p_y on the free sides raise it by B (p_x + p_y)/2, B = alpha/(alpha^2 + S (lambda + G)),
and fluid V by V/(area (S + alpha^2/(lambda + G))). Rounded, the balances of cells do not hold it, whatever the deformation stores: their
sum does. No step is cut."""

import unittest

from scene_runs import SceneRuns, on_two_processes

SCENE = """
name: closed_porous_box
geometry: {box: {x: [0 m, 10 m], y: [0 m, 10 m]}}
mesh: {size: 1 m}
materials: {young_modulus: 30 GPa, poisson_ratio: 0.25, biot_coefficient: 0.9, permeability: 2e-9 m^2, viscosity: 1 mPa*s}
components:
  pore: {type: matrix_flow/mpfa, storage: 2e-10 1/Pa, initial_pressure: 1 MPa, wells: {well: {at: [3 m, 4 m], rate: 1e-15 m^2/s}}}
  rock:
    type: poromechanics/mpsa
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, right: {normal_stress: -1 MPa}, top: {normal_stress: -2 MPa}}
couplers: [{type: biot, between: [pore, rock]}]
schedule: [{solve: [pore, rock]}]
time: {end: 6e10 s, step: 3e10 s}
output: {every: 3e10 s, probes: {p: {of: pore.pressure, at: [8 m, 8 m]}}}
"""
YOUNG, POISSON, ALPHA, STORAGE, FLUID, AREA = 30e9, 0.25, 0.9, 2e-10, 1e-15 * 3e10, 100
MODULUS = YOUNG / (2 * (1 + POISSON) * (1 - 2 * POISSON))  # lambda + G
LOADED = ALPHA / (ALPHA**2 + STORAGE * MODULUS) * 1.5e6
INJECTED = FLUID / (AREA * (STORAGE + ALPHA**2 / MODULUS))
ROCK = "components.rock.boundary"
MIRRORED = (f"{ROCK}.left={{displacement_x: null, normal_stress: -1 MPa}}", f"{ROCK}.right={{normal_stress: null, displacement_x: 0 m}}")
TURNED = (f"{ROCK}.right={{normal_stress: -2 MPa}}", f"{ROCK}.top={{normal_stress: -1 MPa}}")


class CoupledConstantMode(SceneRuns):
    def assert_exact(self, *settings, injected=1.0, processes=1):
        run = self.run_scene(self.write(SCENE, "scene.yaml"), *settings, processes=processes)
        self.assertEqual(run.record["counters"]["steps rejected"], 0, settings)
        self.assertEqual(len(run.times), 2)
        for step, pressure in enumerate(run["p[Pa]"], 1):
            self.assertAlmostEqual((pressure - 1e6 - LOADED) / INJECTED, step * injected, delta=1e-6, msg=settings)

    def test_the_pressure_is_that_of_what_loads_and_wells_bring(self):
        for permeability in ("2e-9 m^2", "2e-6 m^2"):
            self.assert_exact(f"materials.permeability={permeability}")

    def test_with_other_components_and_solvers(self):
        for setting in ("components.pore.type=matrix_flow/tpfa", "components.rock.type=poromechanics/fem", "solver.type=mumps"):
            self.assert_exact(setting)

    def test_twins(self):
        self.assert_exact(*MIRRORED)
        self.assert_exact(*TURNED)
        rate = 1 + 1e-9
        self.assert_exact(f"components.pore.wells.well.rate={1e-15 * rate!r} m^2/s", injected=rate)

    @on_two_processes
    def test_two_processes(self):
        self.assert_exact(processes=2)


if __name__ == "__main__":
    unittest.main()
