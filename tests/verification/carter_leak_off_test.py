#!/usr/bin/python3
"""carter_leak_off_test.py SPREKK [MPIEXEC]: fluid that leaves fractures by Carter's law, against closed forms: a fracture of fixed length at a constant
rate, exact for any steps; a hydraulic fracture that grows within steps, where toughness rules, with and without spurt loss, against an integral equation
for its length. Mirrored, perturbed, on two processes; what has no meaning is refused."""

import math
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns, on_two_processes


KGD, TUTORIAL = ROOT / "configs/verification/kgd.yaml", ROOT / "configs/tutorial/carter_leak_off.yaml"
HALF_RATE, MODULUS, FIRST, TOUGHNESS = 0.5e-4, 32e9, 10.0, 1e6  # m^2/s, Pa, m, Pa m^0.5
LEAK_OFF, BEFORE = 4.5e-6, 20.0  # m/s^0.5, s from the exposure to the start


def carter(coefficient=LEAK_OFF, spurt=0.0, since=-BEFORE, update="within_step"):
    return f"""
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture,      between: [contact, conduit]}}
  - {{type: two_level,     between: [rock, conduit, tips], propagation_threshold: 0.25}}
  - {{type: carter_leak_off, between: [conduit], leak_off_coefficient: {coefficient!r} m/s^0.5, spurt_loss: {spurt!r} m, exposed_since: {since!r} s}}
schedule:
  - solve: [rock, conduit, contact]
  - grow: tips
    settle: [rock, contact]
    update: {update}
"""


MIRRORED = ("geometry.box.x=[-400 m, 0 m]", "geometry.fractures.main.points=[[-10 m, 0 m], [0 m, 0 m]]",
            "components.rock.boundary={right: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, left: {normal_stress: -1 MPa}}")


def lengths(coefficient, spurt, end):
    """Times and half-lengths of a fracture that has its toughness from the length FIRST on: the fluid of one wing is pi p l^2/E', p = K/sqrt(pi l), and
    what has left through both walls."""
    grid = np.linspace(FIRST, 1.8 * FIRST, 601)
    volume = math.pi * TOUGHNESS / np.sqrt(math.pi * grid) * grid**2 / MODULUS
    times = np.zeros_like(grid)
    for i in range(len(grid)):
        middle = 0.5 * (times[1:i] + times[: i - 1]) if i > 1 else np.zeros(0)

        def excess(time):
            old = FIRST * (math.sqrt(time + BEFORE) - math.sqrt(BEFORE))
            new = (grid[1] - grid[0]) * np.sqrt(np.maximum(0, time - middle)).sum()
            return HALF_RATE * time - volume[i] - 4 * coefficient * (old + new) - 2 * spurt * (grid[i] - FIRST)

        low = times[i - 1] if i else 0
        high = low + (end if i == 0 else 5)
        for _ in range(45):
            mid = 0.5 * (low + high)
            low, high = (mid, high) if excess(mid) < 0 else (low, mid)
        times[i] = high
        if high > end:
            break
    return times[: i + 1], grid[: i + 1]


class CarterLeakOff(SceneRuns):
    timeout = 300

    def test_a_fracture_of_fixed_length_loses_the_closed_form(self):
        found = []
        for settings in (("time.step=1 s",), ("time.step=8 s",), ("time.step=40 s",), ("time.step=8 s", *MIRRORED),
                         ("time.step=8 s", "components.rock.young_modulus=30.00000003 GPa")):
            run = self.run_scene([KGD, self.write(carter(spurt=1e-3))], *settings, "time.end=40 s", "components.tips.toughness=100 MPa*m^0.5")
            leaked = 4 * LEAK_OFF * FIRST * (np.sqrt(run.times + BEFORE) - math.sqrt(BEFORE))  # of both walls; the spurt is gone
            self.assertLess(np.abs(run["carter_leak_off.leaked[m^2]"] / leaked - 1).max(), 1e-11, settings)
            pressure = (HALF_RATE * run.times - leaked) * MODULUS / (math.pi * FIRST**2)
            self.assertLess(abs(run["pressure[Pa]"][-1] / pressure[-1] - 1), 0.01, settings)
            self.assertLess(abs(run["fluid_balance_error[m^2]"][-1]), 1e-10 * run["fluid_injected[m^2]"][-1])
            found.append(run["pressure[Pa]"][-1])
        one, *others, mirrored, perturbed = found
        self.assertLess(max(abs(np.array([*others, perturbed]) / one - 1)), 1e-6)
        self.assertLess(abs(mirrored / one - 1), 1e-3)  # another mesh

    def test_a_run_that_continues_another_one_keeps_the_age_of_walls(self):
        # Two fractures of which one leaks faster; 400 s and then 600 s, on any clock, lose what 1000 s lose.
        scene = self.write("""
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 6 m]}
  fractures: {f: {points: [[2 m, 2 m], [6 m, 4 m]]}, g: {points: [[7 m, 1 m], [8 m, 4 m]]}}
mesh: {size: 2 m, fracture_size: 0.7 m}
components:
  conduit: {type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 1e-6 1/Pa, initial_aperture: 0.3 mm, initial_pressure: 1 MPa,
            injection: {a: {fracture: f, at: [4 m, 3 m], rate: 4e-6 m^2/s}}}
couplers:
  - {type: carter_leak_off, between: [conduit], leak_off_coefficient: {fractures: {f: 2e-6 m/s^0.5, g: 5e-6 m/s^0.5}}, exposed_since: -50 s}
schedule: [{solve: conduit}]
time: {end: 1000 s, step: 100 s}
output: {fields: false}
""")
        lengths = math.hypot(4, 2), math.hypot(1, 3)

        def leaked(time):
            return 4 * (2e-6 * lengths[0] + 5e-6 * lengths[1]) * (math.sqrt(time + 50) - math.sqrt(50))

        def last(run):
            return run["carter_leak_off.leaked[m^2]"][-1], run["conduit.a.pressure[Pa]"][-1]

        whole, first = self.run_scene(scene), self.run_scene(scene, "time.end=400 s")
        self.assertLess(abs(last(whole)[0] / leaked(1000) - 1), 1e-12)
        for start in (400, 0, -500, 1e6):
            second = self.run_scene(scene, f"start={{from: '{first.folder}'}}", f"time.start={start} s", f"time.end={start + 600} s",
                                    "couplers.0.exposed_since=null" if start == -500 else "time.step=100 s")
            self.assertLess(abs(last(second)[0] / (leaked(1000) - leaked(400)) - 1), 1e-11, start)
            self.assertLess(abs(last(second)[1] / last(whole)[1] - 1), 1e-9, start)
            self.assertLess(abs(second["fluid_balance_error[m^2]"][-1]), 1e-12 * second["fluid_injected[m^2]"][-1], start)
            self.assertEqual(any("'exposed_since' is not read" in note for note in second.notes), start in (0, 1e6), start)

    def test_growth_where_toughness_rules(self):
        ends = []
        for spurt in (0.0, 1e-4):
            run = self.run_scene(TUTORIAL, f"couplers.3.spurt_loss={spurt!r} m")
            times, known = lengths(LEAK_OFF, spurt, 67)
            grown = run["tips.main_last.length[m]"]
            # The first increment is found by the fine level alone, with the state held.
            late = grown > 0.5
            self.assertGreater(late.sum(), 4)
            self.assertLess(np.abs((FIRST + grown[late]) / np.interp(run.times[late], times, known) - 1).max(), 5e-3)
            self.assertGreater(run["carter_leak_off.leaked[m^2]"][-1], 0.25 * run["fluid_injected[m^2]"][-1])
            self.assertLess(abs(run["fluid_balance_error[m^2]"][-1]), 1e-10 * run["fluid_injected[m^2]"][-1])
            ends.append(FIRST + grown[-1])
        self.assertLess(ends[1], ends[0] - 0.02)

    def test_apertures_in_formulas_are_not_below_their_floor(self):
        """In cells that have just grown, and where walls touch: a/max(a, floor) is 1 in all of them."""
        constant, formula = (self.run_scene(TUTORIAL, f"couplers.3.leak_off_coefficient={LEAK_OFF!r}*m/s^0.5{words}") for words in ("", "*a/max(a, 1e-7*m)"))
        self.assertGreater(constant["tips.main_last.length[m]"][-1], 0.5)
        for column in ("carter_leak_off.leaked[m^2]", "tips.main_last.length[m]"):
            np.testing.assert_allclose(formula[column], constant[column], rtol=1e-9)

    @on_two_processes
    def test_on_two_processes(self):
        settings = ("time.step=8 s", "time.end=40 s", "components.tips.toughness=100 MPa*m^0.5")
        one, two = (self.run_scene([KGD, self.write(carter())], *settings, processes=n) for n in (1, 2))
        for column in ("carter_leak_off.leaked[m^2]", "pressure[Pa]"):
            self.assertAlmostEqual(one[column][-1] / two[column][-1], 1, delta=1e-8, msg=column)

    def test_what_has_no_meaning_is_refused(self):
        pore = """
components: {pore: {type: matrix_flow/mpfa, permeability: 1e-18 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa}}
schedule:
  - solve: [rock, conduit, contact, pore]
"""
        flow = carter().replace("couplers:\n", "couplers:\n  - {type: wall_exchange, between: [pore, conduit]}\n")
        for text, more, message in ((carter(since=1.0), "", "'exposed_since' is after the start"), (carter(coefficient=-1e-6), "", "leak_off_coefficient"),
                                    (carter(spurt=-1e-6), "", "spurt_loss"), (flow.partition("schedule")[0], pore, "fluid leaves 'conduit' twice")):
            answer = self.call(["check"], [KGD, self.write(text, "leaks.yaml"), *([self.write(more, "more.yaml")] if more else [])])
            self.assertEqual(answer.returncode, 2, message)
            self.assertIn(message, answer.stderr)
        water = """
components:
  water: {type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: 350 K}
"""
        for between in ("[conduit]", "[conduit, water]"):
            text = carter().partition("schedule")[0].replace("carter_leak_off, between: [conduit]", f"carter_leak_off, between: {between}")
            answer = self.call(["check"], [KGD, self.write(text, "leaks.yaml"), self.write(water, "more.yaml")])
            self.assertEqual(answer.returncode, 2, between)
            self.assertIn("would leave its heat behind", answer.stderr)
        answer = self.call(["check"], [KGD, self.write(carter().partition("schedule")[0], "leaks.yaml"), self.write(pore, "more.yaml")])
        self.assertIn("Carter's law stands for the flow in the rock", answer.stdout + answer.stderr)


if __name__ == "__main__":
    unittest.main()
