#!/usr/bin/python3
"""sealed_pockets_test.py SPREKK MPIEXEC: rock without storage behind a fracture that lets nothing through has no pressure of its own.

A fracture across a box seals its upper half. Whatever the solver, the flow, the schedule and the number of processes, check and run refuse it, and
say where; before the pressure of the pocket, divided by round-off, was 1e15 times the others. Walls that let a little through hold the pocket: with the
flux q down through both walls and k/mu = 1 the pressure at height y above the fracture is p_0 + q y + 2 q/kappa."""

import unittest

from scene_runs import SceneRuns, on_two_processes

SCENE = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 2 m]}, fractures: {a: {points: [[0 m, 1 m], [2 m, 1 m]]}}}
mesh: {size: 0.3 m}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 0 1/Pa, boundary: {bottom: {pressure: 1 Pa}, top: {flux: -1 m/s}}}
  conduit: {type: fracture_flow/tpfa, viscosity: 1 Pa*s, fluid_compressibility: 1 1/Pa, initial_aperture: 1 mm, transmissivity: constant,
    transmissivity_value: 1 m^3, normal_permeability: constant, normal_permeability_value: 0 m/(Pa*s)}
couplers: [{type: wall_exchange, between: [pore, conduit]}]
schedule: [{solve: [pore, conduit]}]
time: {end: 1 s, step: 1 s}
output: {fields: false, probes: {up: {of: pore.pressure, at: [1 m, 1.5 m]}, lo: {of: pore.pressure, at: [1 m, 0.5 m]}}}
"""
KAPPA = "components.conduit.normal_permeability_value"
FLOWS = ["tpfa", "rt0", "ntpfa"]
TILTED = "geometry.fractures.a.points=[[0 m, 0.7 m], [2 m, 1.3 m]]"
MIRRORED = "geometry.fractures.a.points=[[0 m, 1.3 m], [2 m, 0.7 m]]"
PERTURBED = "geometry.fractures.a.points=[[0 m, 0.7000000007 m], [2 m, 1.3 m]]"
TRIANGLE = ("geometry.fractures={a: {points: [[0.3 m, 0.5 m], [1.7 m, 0.5 m]]}, b: {points: [[0.4 m, 0.3 m], [1.2 m, 1.7 m]]}, "
            "c: {points: [[1.6 m, 0.3 m], [0.8 m, 1.7 m]]}}")
FRACTURE = ["components.conduit.fluid_compressibility=0 1/Pa", "components.conduit.injection={w: {rate: 1 m^2/s}}", "components.pore.storage=1 1/Pa"]
SPLIT = "schedule=[{iterate: {steps: [{solve: conduit}, {solve: pore}]}}]"


class SealedPockets(SceneRuns):
    def assert_refused(self, *settings, field="pore.pressure", processes=1, by_check=True):
        scene = self.write(SCENE)
        done = self.call(["run", "-q", "-o", self.folder / str(next(self.numbers))], scene, *settings, processes=processes)
        self.assertEqual(done.returncode, 2 if by_check else 1, (settings, done.stderr))
        self.assertIn(f"nothing holds {field} around (", done.stderr, settings)
        checked = self.call(["check"], scene, *settings, processes=processes)
        self.assertEqual(checked.returncode, 2 if by_check else 0, (settings, checked.stderr))
        if by_check:
            self.assertRegex(checked.stderr, rf"error: (\S+:\d+|--set schedule): nothing holds {field} around \(.*\) \(.*\) let something be stored there, or give a value")
        return done.stderr

    def test_with_every_flow(self):
        self.assertIn("balances of fluid store nothing", self.assert_refused())
        for flow in FLOWS:
            self.assert_refused(f"components.pore.type=matrix_flow/{flow}")

    def test_with_every_solver_and_schedule(self):
        for setting in ("solver.condense=false", "solver.type=mumps", "solver.type=belos", SPLIT, "time.scheme=sdirk2"):
            self.assert_refused(setting)
        self.assert_refused("solver.condense=false", "components.pore.type=matrix_flow/rt0")

    def test_twins(self):
        for setting in (TILTED, MIRRORED, PERTURBED):
            self.assert_refused(setting)

    @on_two_processes
    def test_two_processes(self):
        self.assert_refused(TILTED, processes=2)
        self.assert_refused(*FRACTURE, MIRRORED, field="conduit.pressure", processes=2)

    def test_a_well_in_a_pocket_between_three_fractures(self):
        self.assert_refused(TRIANGLE, "components.pore.wells={w: {at: [1 m, 0.8 m], rate: 1 m^2/s}}")

    def test_a_fracture_without_storage(self):
        for flow in ["mpfa", *FLOWS]:
            self.assert_refused(*FRACTURE, f"components.pore.type=matrix_flow/{flow}", field="conduit.pressure")
        for setting in (TILTED, MIRRORED, PERTURBED):
            self.assert_refused(*FRACTURE, setting, field="conduit.pressure")

    def test_a_pocket_at_rest(self):
        """Nothing is pushed into it, and its pressure stays."""
        still = ["components.pore.boundary=", "components.pore.boundary={bottom: {pressure: 0 Pa}}"]
        self.assertEqual(self.call(["check"], self.write(SCENE), *still).returncode, 0)
        self.assertEqual(self.run_scene(self.write(SCENE), *still)["up[Pa]"][-1], 0)

    def test_walls_that_close_later(self):
        self.assertIn("from 0.5 s", self.assert_refused(f"{KAPPA}=(if(t < 0.6, 1, 0)) m/(Pa*s)", "time.step=0.5 s", by_check=False))

    def test_a_pocket_that_something_holds(self):
        for kappa in (1, 1e-3, 1e-9):
            for flow in ("mpfa", "rt0"):  # exact for a linear pressure on triangles
                # Incompressible, so that the first step is steady.
                run = self.run_scene(self.write(SCENE), f"{KAPPA}={kappa!r} m/(Pa*s)", f"components.pore.type=matrix_flow/{flow}",
                                     "components.conduit.fluid_compressibility=0 1/Pa")
                self.assertAlmostEqual(run["lo[Pa]"][-1], 1.5, delta=1e-7, msg=(kappa, flow))
                self.assertAlmostEqual(run["up[Pa]"][-1] / (2.5 + 2 / kappa), 1, delta=1e-9, msg=(kappa, flow))
        run = self.run_scene(self.write(SCENE), "components.pore.storage=1e-12 1/Pa")
        self.assertAlmostEqual(run["up[Pa]"][-1] * 1e-12, 1, delta=1e-6)  # 2 m^2 into 2 m^2


if __name__ == "__main__":
    unittest.main()
