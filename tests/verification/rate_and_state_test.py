#!/usr/bin/python3
"""rate_and_state_test.py SPREKK: friction of rate and state against solutions that are computed without Sprekk (references/rate_and_state.py): the
limit cycle of a block on a spring, velocity steps and their order in time, a fault that nucleates, slip under rising fluid pressure; the same turned,
mirrored, perturbed, on two processes, by other types and schedules, and after a restart; what has no meaning is refused."""

import csv
import math
import subprocess
import sys
import unittest

import numpy as np
from scene_runs import ROOT, SPREKK, SceneRuns, on_two_processes

sys.path.insert(0, str(ROOT / "tests/verification/references"))
import rate_and_state as reference  # noqa: E402  pylint: disable=wrong-import-position

SLIDER, FAULT = (ROOT / f"configs/verification/{name}.yaml" for name in ("spring_slider", "fault_nucleation"))
LAW, ROCK = "components.contact.rate_and_state", "components.rock"


def table(name):
    with open(ROOT / f"tests/verification/references/{name}.csv", encoding="utf8") as lines:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(line for line in lines if not line.startswith("#"))]


def pulled(rate):
    """Settings: both halves of the block move at half of this rate, an expression of t."""
    return (f'{ROCK}.boundary.top.displacement=["(0.5*({rate})) m", 0 m]', f'{ROCK}.boundary.bottom.displacement=["(-0.5*({rate})) m", 0 m]')


# A block in steady slip at 1 um/s from its start on: N mu = 6 MPa.
STEADY = (f"{LAW}.initial_slip_rate=1e-6 m/s", f"{LAW}.distance=1 mm", f"{ROCK}.initial_stress={{xx: -10 MPa, yy: -10 MPa, xy: 6 MPa}}",
          *pulled("1e-6*t + 9e-6*max(0, t - 2000)"), "time.end=2600 s", "output.times=[2000 s]")
PROBE = "output.probes={f: {of: contact.traction, at: [2.5 m, 0 m]}}"


class RateAndState(SceneRuns):
    timeout = 300

    def events(self, run):
        """(begin, greatest slip rate) of each."""
        numbers = run["contact.events[1]"]
        rows = [np.flatnonzero(numbers == n)[-1] for n in range(1, int(numbers[-1]) + 1)]
        return np.array([(run["contact.event_begin[s]"][i], run["contact.event_peak_slip_rate[m/s]"][i]) for i in rows])

    def assert_same(self, one, other, tolerance, columns=("contact.event_begin[s]", "contact.event_moment[N]", "contact.event_peak_slip_rate[m/s]")):
        for column in columns:
            self.assertAlmostEqual(one[column][-1] / other[column][-1], 1, delta=tolerance, msg=column)

    def test_the_limit_cycle(self):
        known = np.array([(row["begin_s"], row["peak_slip_rate_m_s"]) for row in table("rate_and_state")])
        for settings, first, period, peak in (((), 1e-5, 2e-5, 1e-3), (("time.scheme=backward_euler", f"{LAW}.state_change=0.05"), 3e-3, 0.01, 0.05)):
            found = self.events(self.run_scene(SLIDER, *settings))
            self.assertEqual(len(found), 3)
            self.assertAlmostEqual(found[0, 0] / known[0, 0], 1, delta=first)
            self.assertAlmostEqual((found[2, 0] - found[1, 0]) / (known[2, 0] - known[1, 0]), 1, delta=period)
            for i in range(3):
                self.assertAlmostEqual(found[i, 1] / known[i, 1], 1, delta=peak)

    def test_a_run_that_continues_another_one_counts_its_own_events(self):
        # The second event of the whole run is the first one of a run that starts, with a clock of its own, from 7e6 s.
        whole, first = self.run_scene(SLIDER, "time.end=11e6 s"), self.run_scene(SLIDER, "time.end=7e6 s")
        second = self.run_scene(SLIDER, f"start={{from: '{first.folder}'}}", "time.end=4e6 s", *pulled("1e-9*(t + 7e6)"))
        self.assertEqual([run["contact.events[1]"][-1] for run in (whole, first, second)], [2, 1, 1])
        self.assertEqual(second["contact.events[1]"][0], 0)
        self.assertAlmostEqual((second["contact.event_begin[s]"][-1] + 7e6) / whole["contact.event_begin[s]"][-1], 1, delta=1e-5)
        self.assert_same(second, whole, 1e-3, ("contact.event_moment[N]", "contact.event_peak_slip_rate[m/s]"))

    def test_an_event_is_recorded_with_its_moment_and_length(self):
        run = self.run_scene(SLIDER, "time.end=7e6 s", PROBE)
        slip = run["contact.largest_slip_rate[m/s]"] > 1e-3
        begin, end = (run.times[np.flatnonzero(slip)[i]] for i in (0, -1))
        self.assertLess(run["contact.event_begin[s]"][-1], begin)
        self.assertGreater(run["contact.event_end[s]"][-1], end)
        self.assertEqual(run["contact.event_length[m]"][-1], 10)
        # The spring, of G/100 m, is unloaded by k slip; it is pulled by 0.2 nm meanwhile.
        traction = np.abs(run["f.t[Pa]"])
        before, after = (traction[run.times == run[f"contact.event_{which}[s]"][-1]][0] for which in ("begin", "end"))
        self.assertAlmostEqual(run["contact.event_moment[N]"][-1] / (10 * 100 * (before - after)), 1, delta=1e-6)
        jump = np.abs(run.fields(kind="fractures")["contact.jump.tangential"])
        self.assertLess(np.ptp(jump), 1e-9 * jump.max())
        note = next(note for note in run.record["notes"] if "contact events" in note["topic"])
        self.assertIn("event 1", note["text"])

    def test_velocity_steps_are_of_the_order_of_the_scheme(self):
        known = {row["time_s"]: row["traction_Pa"] for row in table("velocity_step")}
        for settings, order in ((("time.scheme=backward_euler",), 1), ((), 2)):
            errors = []
            for step in (10, 5, 2.5):
                run = self.run_scene(SLIDER, *STEADY, *settings, f"time.step={step} s", f"{LAW}.state_change=0.5",
                                     PROBE)
                traction = {round(time, 6): -value for time, value in zip(run.times, run["f.t[Pa]"])}
                errors.append(max(abs(traction[time] - known[time]) for time in known if time in traction and time > 2010))
            for coarse, fine in zip(errors, errors[1:]):
                self.assertAlmostEqual(math.log2(coarse / fine), order, delta=0.25, msg=f"{errors}")
        self.assertLess(errors[-1], 1e-5 * 6e6)

    def test_a_stiff_block_shows_the_direct_effect_and_the_steady_state(self):
        run = self.run_scene(SLIDER, *STEADY, "geometry.box.y=[-0.5 m, 0.5 m]", "time.step=1 s", f"{LAW}.state_change=0.02",
                             PROBE)
        friction = (-run["f.t[Pa]"] - 5e6 * run["contact.largest_slip_rate[m/s]"]) / 10e6  # without radiation damping
        self.assertAlmostEqual(friction[run.times <= 2000][-1], 0.6, delta=1e-9)
        self.assertAlmostEqual(friction.max() - 0.6, 0.010 * math.log(10), delta=0.04 * 0.010 * math.log(10))
        # (a - b) ln 10 after slip of many L; 6 L here, over which the state falls from L/(1 um/s) to nearly L/(10 um/s)
        state = 0.1 + 0.9 * math.exp(-6)
        self.assertAlmostEqual(friction[-1] - 0.6, 0.010 * math.log(10) + 0.015 * math.log(state), delta=0.002 * 0.005 * math.log(10))

    def test_a_fault_nucleates_when_the_integral_equation_says(self):
        known = table("fault_nucleation")[-1]["extrapolated_s"]
        begin = {(size, step): self.run_scene(FAULT, f"mesh.fracture_size={size} m", f"mesh.growth={0.075 * size}", f"time.step={2e5 * step} s",
                                              f"{LAW}.state_change={step}")["contact.event_begin[s]"][-1]
                 for size, step in ((8, 0.2), (8, 0.1), (8, 0.05), (4, 0.1), (2, 0.2))}
        errors = {key: time / known - 1 for key, time in begin.items()}
        self.assertGreater(math.log2(errors[8, 0.1] / errors[4, 0.1]), 1.6, errors)
        self.assertLess(abs(errors[4, 0.1]), 5e-4)
        self.assertLess(abs(errors[2, 0.2]), 1e-4)
        self.assertAlmostEqual(math.log2((begin[8, 0.2] - begin[8, 0.1]) / (begin[8, 0.1] - begin[8, 0.05])), 2, delta=0.3, msg=begin)

    def injection(self, *settings):
        """A block under less shear than it holds, whose fluid pressure rises by 0.5 Pa/s."""
        scene = self.folder / "injection.yaml"
        scene.write_text("""
components:
  conduit:
    {type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, initial_aperture: 0.1 mm, transmissivity: constant,
     transmissivity_value: 1e-10 m^3, prescribed: {well: {at: [2.5 m, 0 m], pressure: "(0.5*t) Pa"}}}
couplers: [{type: wall_traction, between: [rock, contact, conduit]}]
""")
        still = pulled("0")
        return self.run_scene([SLIDER, scene], *still, "schedule=[{solve: [rock, contact, conduit]}]", "time.end=7e6 s", *settings)

    def test_injection_brings_the_event_of_the_equations(self):
        friction = reference.Friction(**dict(reference.FAULT, damping=5e6))

        class Injected(reference.Slider):
            def log_rate(self, time, y):
                self.friction.normal = 10e6 - 0.5 * time
                return super().log_rate(time, y)

        known = reference.events(Injected(friction, 3e8, 5e6, lambda t: 0.0).run(1e5, 7e6, 1e-9), 1e-3)
        found = self.events(self.injection())
        self.assertEqual(len(known), len(found))
        self.assertAlmostEqual(found[0, 0] / known[0, 0], 1, delta=1e-5)
        self.assertAlmostEqual(found[0, 1] / known[0, 1], 1, delta=2e-3)

    def test_split_schemes_and_substeps(self):
        whole = self.injection()
        both = "[{solve: conduit}, {solve: [rock, contact]}]"
        iterated = f"schedule=[{{iterate: {{fallback: none, until: {{relative: 1e-10, at_most: 60}}, steps: {both}}}}}]"
        self.assert_same(self.injection(iterated), whole, 1e-6)
        substeps = "schedule=[{subcycle: {count: 2, steps: [{solve: [rock, contact, conduit]}]}}]"
        self.assert_same(self.injection(substeps), whole, 1e-3)

    def test_twins(self):
        end = "time.end=7e6 s"
        first = self.run_scene(SLIDER, end)
        mirrored = self.run_scene(SLIDER, end, *pulled("-1e-9*t"), f"{ROCK}.initial_stress={{xx: -10 MPa, yy: -10 MPa, xy: -5 MPa}}")
        self.assert_same(mirrored, first, 1e-6)
        reversed_line = self.run_scene(SLIDER, end, "geometry.fractures.fault.points=[[10 m, 0 m], [0 m, 0 m]]")
        self.assert_same(reversed_line, first, 1e-6)
        perturbed = self.run_scene(SLIDER, end, f"{ROCK}.young_modulus=75.000000075 GPa")
        self.assert_same(perturbed, first, 1e-5)
        for setting in ("components.contact.type=contact/augmented_lagrangian", f"{ROCK}.type=poromechanics/fem"):
            self.assert_same(self.run_scene(SLIDER, end, setting), first, 1e-4)
        distorted = self.folder / "distorted.yaml"
        distorted.write_text(SLIDER.read_text().replace("{kind: structured, shape: quadrilaterals, cells: [2, 20]}",
                                                        "{size: 10 m, fracture_size: 3 m, distortion: 0.1}"))
        self.assert_same(self.run_scene(distorted, end), first, 1e-4)

    def test_turned(self):
        scene = self.folder / "fixed.yaml"
        fixed = SLIDER.read_text().replace('"(0.5e-9*t) m"', "1e-3 m").replace('"(-0.5e-9*t) m"', "-1e-3 m")
        scene.write_text(fixed.replace("schema=../", "schema=" + str(ROOT / "configs") + "/"))
        done = subprocess.run([ROOT / "tools/turn_scene", scene, self.folder / "turned", "--angle", "37", "--program", SPREKK], capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        turned = self.folder / "turned/turned.yaml"
        moved = [f'{ROCK}.boundary.{side}.displacement_tangential="(-0.5e-9*t) m"' for side in ("top", "bottom")]
        self.assert_same(self.run_scene([scene, turned], *moved, "time.end=7e6 s"), self.run_scene(SLIDER, "time.end=7e6 s"), 1e-5)

    @on_two_processes
    def test_on_two_processes(self):
        settings = ("mesh.fracture_size=8 m", "time.step=8e4 s", f"{LAW}.state_change=0.4")
        one, two = (self.run_scene(FAULT, *settings, processes=processes) for processes in (1, 2))
        self.assert_same(two, one, 1e-6)

    def test_a_restart_goes_on_to_the_bit(self):
        # The first part ends 200 s before slip runs away, within an event that begins at 10 nm/s.
        begins, middle = f"{LAW}.event_slip_rate=1e-8 m/s", 6.0775e6
        whole = self.run_scene(SLIDER, begins, "time.end=11e6 s", f"output.times=[{middle} s]")
        parts = self.run_scene(SLIDER, begins, f"time.end={middle} s", f"output.times=[{middle} s]")
        self.assertGreater(parts["contact.largest_slip_rate[m/s]"][-1], 1e-8)
        self.assertEqual(parts["contact.events[1]"][-1], 1)
        parts = self.run_scene(SLIDER, begins, "time.end=11e6 s", f"output.times=[{middle} s]", restart=parts.folder)
        self.assertEqual(parts["contact.events[1]"][-1], 2)
        self.assert_same_bits(parts, whole)

    def test_what_has_no_meaning_is_refused(self):
        for setting, message in ((f"{LAW}.a=0", "a"), (f"{LAW}.a=-0.01", "a"), (f"{LAW}.b=-0.01", "b"), (f"{LAW}.distance=0 m", "distance"),
                                 (f"{LAW}.reference_rate=-1 m/s", "reference_rate"), (f"{LAW}.initial_slip_rate=0 m/s", "initial_slip_rate"),
                                 (f"{LAW}.initial_state=1 s", "given twice"), ("components.contact.friction=0", "'friction' of 'contact' is 0"),
                                 ("components.contact.friction={fractures: {fault: 0}}", "'friction' of 'contact' is 0"),
                                 ('components.contact.friction="0.6 - t/1e7"', "friction"),
                                 ("components.contact.weakening={distance: 1 mm, friction: 0.1}", "exclude each other"),
                                 ("components.contact.type=contact/penalty", "contact/penalty has no 'rate_and_state'"),
                                 (f"{LAW}.state_change=2", "state_change"), (f"{LAW}.radiation_damping.wave_speed=0 m/s", "wave_speed")):
            answer = self.call("check", SLIDER, setting)
            self.assertEqual(answer.returncode, 2, setting)
            self.assertIn(message, answer.stderr, setting)
        scene = self.folder / "without.yaml"
        for line, message in (("      initial_slip_rate: 1e-9 m/s\n", "the state at the start is missing"), ("      distance: 0.1 mm\n", "distance"),
                              ("      a: 0.010\n", "'a'")):
            scene.write_text(SLIDER.read_text().replace(line, ""))
            answer = self.call("check", scene)
            self.assertEqual(answer.returncode, 2, line)
            self.assertIn(message, answer.stderr)
        scene.write_text(SLIDER.read_text().replace("      radiation_damping: {wave_speed: 3 km/s}\n", ""))
        self.assertIn("nothing limits its rate", (answer := self.call("check", scene)).stdout + answer.stderr)
        self.assertEqual(answer.returncode, 0)

    def test_two_stages_are_recommended(self):
        for setting, is_noted in (("time.scheme=sdirk2", False), ("time.scheme=backward_euler", True)):
            answer = self.call(["check"], SLIDER, setting)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            self.assertEqual("set time.scheme to sdirk2" in answer.stdout + answer.stderr, is_noted, answer.stdout + answer.stderr)


if __name__ == "__main__":
    unittest.main()
