#!/usr/bin/python3
"""late_counting_test.py SPREKK: what the passes of an iteration leave of the balance of fluid is counted in the next step. So fluid is
conserved to round-off however early passes end, and their errors do not add up from step to step: after any number of steps the
pressure of a sealed block with a source, p = Q t/(S + alpha^2/(lambda + G)), is off by what one step leaves."""

import unittest

from scene_runs import ROOT, SceneRuns, on_two_processes

MANDEL, FRICTION = ROOT / "configs/verification/mandel.yaml", ROOT / "configs/tutorial/first_scene.yaml"
SMALL_MANDEL = ("mesh.size=0.1 m",)
SMALL_FRICTION = ("mesh={size: 1 m, fracture_size: 0.25 m}",)
EARLY = 1e-3  # passes end here
SAME = 1e-6  # of twins: solves inside of passes end at updates of 1e-8
IN_TWO = {
    "fixed stress": ("{{solve: {flow}, stabilize: fixed_stress}}, {{solve: {rock}}}", ""),
    "fixed stress, rock first": ("{{solve: {rock}}}, {{solve: {flow}, stabilize: fixed_stress}}", ""),
    "fixed stress, anderson": ("{{solve: {flow}, stabilize: fixed_stress}}, {{solve: {rock}}}", "accelerate: {anderson: 5}, "),
    "fixed stress, jacobi": ("{{solve: {flow}, stabilize: fixed_stress}}, {{solve: {rock}}}", "order: jacobi, "),
    "drained": ("{{solve: {rock}}}, {{solve: {flow}}}", ""),
    "strain held": ("{{solve: {flow}}}, {{solve: {rock}}}", ""),
    "undrained": ("{{solve: {rock}, stabilize: undrained}}, {{solve: {flow}}}", ""),
}
YOUNG, POISSON, ALPHA, STORAGE, SOURCE = 10e9, 0.25, 0.9, 1e-10, 1e-7
IN_PLANE = YOUNG / (2 * (1 + POISSON) * (1 - 2 * POISSON))  # lambda + G
SEALED = f"""
name: sealed
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}
mesh: {{size: 0.3 m}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-17 m^2, viscosity: 1 mPa*s, storage: {STORAGE} 1/Pa, source: {SOURCE} 1/s}}
  rock: {{type: poromechanics/mpsa, young_modulus: {YOUNG} Pa, poisson_ratio: {POISSON},
         boundary: {{left: {{displacement_x: 0 m}}, bottom: {{displacement_y: 0 m}}}}}}
couplers: [{{type: biot, between: [pore, rock], biot_coefficient: {ALPHA}}}]
schedule: [{{solve: [pore, rock]}}]
time: {{end: 100 s, step: 1 s}}
output: {{probes: {{p: {{of: pore.pressure, at: [0.4 m, 0.6 m]}}}}}}
"""


def iterated(name, flow, rock, until=EARLY):
    steps, options = IN_TWO[name]
    steps = steps.format(flow=flow, rock=rock)
    return f"schedule=[{{iterate: {{fallback: none, until: {{relative: {until}, at_most: 200}}, {options}steps: [{steps}]}}}}]"


class LateCounting(SceneRuns):
    def expect_all_fluid(self, run, at_most=1e-12):
        moved = sum(abs(run[f"fluid_{name}"]).max() for name in ("stored", "injected", "outflow"))
        found = abs(run["fluid_balance_error"]).max() / moved
        print(f"    {found:.1e} of the fluid, {int(max(run['iterations[1]']))} passes at most", flush=True)
        self.assertLessEqual(found, at_most)

    def test_fluid_is_conserved_however_early_passes_end(self):
        for scene, settings, flow, rock in ((MANDEL, SMALL_MANDEL, "pore", "rock"),
                                            (FRICTION, SMALL_FRICTION, "[pore, conduit]", "[rock, contact]")):
            truth = self.run_scene(scene, *settings)
            right = truth.fields()["pore.pressure"]
            for name in IN_TWO:
                with self.subTest(scene=scene.stem, scheme=name):
                    print(f"\n  {scene.stem}: {name}", flush=True)
                    run = self.run_scene(scene, *settings, iterated(name, flow, rock))
                    self.expect_all_fluid(run)
                    # The passes have left something.
                    self.assertGreater(abs(run.fields()["pore.pressure"] - right).max(), 1e-7 * abs(right).max())

    def test_errors_of_steps_do_not_add_up(self):
        # Passes end where residuals are a hundredth of the largest of their terms. Errors of the pressure stay below that share of it.
        scene = self.write(SEALED)
        exact = SOURCE / (STORAGE + ALPHA ** 2 / IN_PLANE)
        self.assertAlmostEqual(self.run_scene(scene)["p"][-1] / (100 * exact), 1, delta=1e-9)
        for name in ("fixed stress", "fixed stress, rock first", "strain held", "drained"):
            run = self.run_scene(scene, iterated(name, "pore", "rock", until=1e-2))
            errors = abs(run["p"] / (exact * run.times) - 1)
            print(f"    {name}: {errors[0]:.1e} after the first step, {errors[-1]:.1e} after {len(errors)}", flush=True)
            self.assertGreater(errors.max(), 1e-5)
            self.assertLess(errors.max(), 1e-2)
            self.expect_all_fluid(run)

    def test_twins(self):
        schedule = iterated("fixed stress", "[pore, conduit]", "[rock, contact]")
        straight = self.run_scene(FRICTION, *SMALL_FRICTION, schedule)
        for files in (self.turned(FRICTION, 37, *SMALL_FRICTION), self.turned(FRICTION, 0, *SMALL_FRICTION, mirror=True)):
            run = self.run_scene(files, *SMALL_FRICTION[1:], schedule)
            self.expect_all_fluid(run)
            columns = ["injection_pressure[Pa]", "fluid_stored[m^2]", "fluid_outflow[m^2]"]
            self.assertLess(self.largest_difference(run, straight, columns), SAME)
        other = self.run_scene(FRICTION, *SMALL_FRICTION, schedule, f"components.rock.boundary.top.normal_stress={-12e6 * (1 + 1e-9)!r} Pa")
        self.expect_all_fluid(other)
        self.assertLess(self.largest_difference(other, straight, ["injection_pressure[Pa]", "fluid_stored[m^2]"]), SAME)

    def test_a_restart_has_the_same_bits(self):
        schedule = iterated("fixed stress", "[pore, conduit]", "[rock, contact]")
        whole = self.run_scene(FRICTION, *SMALL_FRICTION, schedule, "time.end=1 day")
        parts = self.run_scene(FRICTION, *SMALL_FRICTION, schedule, "time.end=8 h")
        self.assert_same_bits(self.run_scene(FRICTION, *SMALL_FRICTION, schedule, "time.end=1 day", restart=parts.folder), whole)

    @on_two_processes
    def test_on_two_processes(self):
        schedule = iterated("fixed stress", "[pore, conduit]", "[rock, contact]")
        one, two = (self.run_scene(FRICTION, *SMALL_FRICTION, schedule, "time.end=12 h", processes=count) for count in (1, 2))
        self.expect_all_fluid(two)
        self.assertLess(self.largest_difference(two, one, ["injection_pressure[Pa]", "fluid_stored[m^2]"]), SAME)


if __name__ == "__main__":
    unittest.main()
