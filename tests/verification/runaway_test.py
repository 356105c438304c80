#!/usr/bin/python3
"""runaway_test.py SPREKK [MPIEXEC]: slip that runs away, where walls lose strength faster than the rock unloads them, is told with its time, place and
length. A block between two walls runs away where its stiffness k is below the weakening W (k_c = W), at the time of its strength; slip under a load with
one maximum does so at the half length 0.579 mu*/W (Uenishi and Rice, J. Geophys. Res. 108 (2003) 2042). Also turned, mirrored, perturbed and on two
processes; and slip that is stable is told of nowhere. Cohesion
without weakening slips as Mohr and Coulomb say."""

import re
import time
import unittest

import numpy as np
from scene_runs import SceneRuns, on_two_processes, sprekk

TOLD = re.compile(r"(slip|opening) runs away at ([\d.e+-]+) s: along ([\d.e+-]+) m of fracture '(\w+)' around \(([^,]+), ([^)]+)\) walls lose "
                  r"([\d.e+-]+) Pa/m of \w+, and the rock takes ([\d.e+-]+) Pa/m off them")
SHEAR = 40e9 / 2.4  # Pa
PRESSURE, STRENGTH, DISTANCE = 10e6, 6e6, 1e-4
HALF = 0.25  # m, of the height of the block
STIFFNESS = SHEAR / (2 * HALF)  # Pa/m


def block(ratio, *, upright=False, sign=1, factor=1.0, cells=(4, 6), start=5.47e6):
    """A block of 0.4 m, cut along its middle, whose two halves are sheared at 0.1 MPa/s. `ratio`: k over W."""
    weakening = STIFFNESS / ratio
    lost = weakening * DISTANCE / PRESSURE
    rate = sign * factor * 0.5e5 / STIFFNESS
    ends, low, high, along, across, other = ("left", "right"), "bottom", "top", "x", "y", "yy"
    if upright:
        ends, low, high, along, across, other = ("bottom", "top"), "right", "left", "y", "x", "xx"

    def sheared(by):
        values = [f'"({by}*t) m"', "0 m"]
        return "{displacement: [" + ", ".join(values[::-1] if upright else values) + "]}"

    box = {along: "[0 m, 0.4 m]", across: f"[{-HALF} m, {HALF} m]"}
    points = "[[0 m, 0 m], [0.4 m, 0 m]]" if not upright else "[[0 m, 0 m], [0 m, 0.4 m]]"
    end = f"{{displacement_{across}: 0 m, traction_{along}: 0 Pa}}"
    return f"""
geometry: {{box: {{x: {box['x']}, y: {box['y']}}}, fractures: {{fault: {{points: {points}}}}}}}
mesh: {{kind: structured, cells: [{', '.join(map(str, cells[::-1] if upright else cells))}], shape: quadrilaterals}}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: {40 * factor} GPa
    poisson_ratio: 0.2
    initial_stress: {{{'xx' if other == 'yy' else 'yy'}: 0 Pa, {other}: -10 MPa, xy: {(1 if not upright else -1) * sign * start} Pa}}
    boundary: {{{ends[0]}: {end}, {ends[1]}: {end}, {high}: {sheared(rate)}, {low}: {sheared(-rate)}}}
  contact:
    type: contact/coulomb
    friction: 0.6
    weakening: {{distance: 0.1 mm, friction: {0.6 - lost}}}
couplers: [{{type: wall_traction, between: [rock, contact]}}]
schedule: [{{solve: [rock, contact]}}]
time: {{end: 8 s, step: 1 s}}
"""


def peaked(angle=0.0, sign=1, factor=1.0, size=0.1):
    """A fault of 6 m in a large body whose strength has a minimum in its middle, under rising shear: in units of the shear modulus, W = 0.8."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turn = np.array([[c, -s], [s, c]])

    def u(k):
        fixed = turn @ np.array([[0, sign * 0.01206 * factor], [0, -0.02 / 3]]) @ turn.T
        rising = turn @ np.array([[0, sign * 1e-4], [0, 0]]) @ turn.T
        return f'"({fixed[k, 0]} + ({rising[k, 0]})*t)*x + ({fixed[k, 1]} + ({rising[k, 1]})*t)*y"'

    side = f"{{displacement: [{u(0)}, {u(1)}]}}"
    place = f"(({c})*x + ({s})*y)"
    ends = ", ".join(f"[{e * 3 * c}, {e * 3 * s}]" for e in (-1, 1))
    return f"""
geometry: {{box: {{x: [-30 m, 30 m], y: [-30 m, 30 m]}}, fractures: {{fault: {{points: [{ends}]}}}}}}
mesh: {{size: 6 m, fracture_size: {size}, growth: 0.2}}
components:
  rock: {{type: poromechanics/mpsa, young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {{left: {side}, right: {side}, bottom: {side}, top: {side}}}}}
  contact: {{type: contact/coulomb, friction: "0.6 + 0.02*{place}^2", weakening: {{distance: 5 mm, friction: "0.4 + 0.02*{place}^2"}}}}
couplers: [{{type: wall_traction, between: [rock, contact]}}]
schedule: [{{solve: [rock, contact]}}]
time: {{end: 1 s, step: 0.05 s}}
"""


def injected(diffusivity=10.0, angle=0.0, sign=1, factor=1.0, schedule="{solve: [rock, contact, conduit]}"):
    """Fluid enters the middle of a fault of 6 m under uniform shear, which it lets slip and lose its cohesion: in units of the shear modulus, W = 0.8,
    whatever the pressure. The wider the diffusivity (m^2/s), the wider the peak of the pressure."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turn = np.array([[c, -s], [s, c]])
    held = turn @ np.array([[0, sign * 0.013 * factor], [0, -0.02 / 3]]) @ turn.T
    side = "{displacement: [" + ", ".join(f'"({row[0]})*x + ({row[1]})*y"' for row in held) + "]}"
    ends = ", ".join(f"[{e * 3 * c}, {e * 3 * s}]" for e in (-1, 1))
    # A rate q into both halves has q/K sqrt(D t/pi) at its place: 0.012 at 1 s.
    rate = 0.012 * 1e-3 * diffusivity / np.sqrt(diffusivity / np.pi)
    return f"""
geometry: {{box: {{x: [-30 m, 30 m], y: [-30 m, 30 m]}}, fractures: {{fault: {{points: [{ends}]}}}}}}
mesh: {{size: 6 m, fracture_size: 0.1, growth: 0.2}}
components:
  rock: {{type: poromechanics/mpsa, young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {{left: {side}, right: {side}, bottom: {side}, top: {side}}}}}
  contact: {{type: contact/coulomb, friction: 0.6, cohesion: 4e-3 Pa, weakening: {{distance: 5 mm, friction: 0.6}}}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 1 mm
    law: {{type: constant, transmissivity: {1e-3 * diffusivity} m^3}}
    viscosity: 1 Pa*s
    fluid_compressibility: 1 1/Pa
    initial_pressure: 0 Pa
    injection: {{well: {{fracture: fault, at: [0 m, 0 m], rate: {rate} m^2/s}}}}
couplers: [{{type: wall_traction, between: [rock, contact, conduit]}}]
schedule: [{schedule}]
time: {{end: 0.6 s, step: 0.05 s}}
"""


CRITICAL = 1.158 * (1 / (1 - 0.25)) / (0.2 * 0.02 / 5e-3)  # m


class Runaway(SceneRuns):
    def told(self, scene, processes=1):
        """What is told of a run: (exit code, the match or None)."""
        folder = self.folder / str(next(self.numbers))
        run = self.call(["run", "-o", folder], self.write(scene, f"{folder.name}.yaml"), processes=processes)
        notes = " ".join(note["text"] for note in sprekk.Results(folder).record["notes"])
        return run.returncode, TOLD.search(run.stderr + notes), folder

    def test_a_block_runs_away_below_the_critical_stiffness(self):
        for settings in ({}, {"sign": -1}, {"upright": True}, {"upright": True, "sign": -1}, {"factor": 1 + 1e-9}, {"cells": (1, 2)}):
            for ratio in (0.999, 0.9, 0.6):
                with self.subTest(ratio=ratio, **settings):
                    _, told, _ = self.told(block(ratio, **settings))
                    self.assertIsNotNone(told)
                    kind, at, length, fracture, x, y, weakening, stiffness = told.groups()
                    self.assertEqual((kind, fracture), ("slip", "fault"))
                    self.assertAlmostEqual(float(at), 5.3, delta=1e-3)
                    self.assertAlmostEqual(float(weakening) / (STIFFNESS / ratio), 1, delta=1e-3)
                    self.assertLess(float(stiffness), float(weakening))
                    self.assertLessEqual(float(length), 0.4 + 1e-9)
                    if ratio < 0.9:
                        continue  # a part of the block that slips first is too long already
                    self.assertAlmostEqual(float(length), 0.4, delta=1e-9)
                    centre = (0, 0.2) if settings.get("upright") else (0.2, 0)
                    self.assertAlmostEqual(float(x), centre[0], delta=1e-6)
                    self.assertAlmostEqual(float(y), centre[1], delta=1e-6)
                    self.assertAlmostEqual(float(stiffness) / STIFFNESS, 1, delta=2e-3)

    def test_a_block_above_it_slips_steadily(self):
        for settings in ({}, {"sign": -1}, {"upright": True}):
            for ratio in (1.001, 1.1, 2.0):
                with self.subTest(ratio=ratio, **settings):
                    code, told, folder = self.told(block(ratio, **settings) + "output: {probes: {s: {of: contact.jump, at: [" + (
                        "0 m, 0.15 m" if settings.get("upright") else "0.15 m, 0 m") + "]}}}\n")
                    self.assertEqual(code, 0)
                    self.assertIsNone(told)
                    slip = sprekk.Results(folder)["s.t[m]"]
                    # Beyond the strength of 6 MPa the load rises by 0.1 MPa/s: k s = load − 6 MPa + W min(s, D).
                    load = np.maximum(0, 1e5 * (sprekk.Results(folder).times - 5.3))
                    weakening = STIFFNESS / ratio
                    known = np.minimum(load / (STIFFNESS - weakening), (load + weakening * DISTANCE) / STIFFNESS)
                    self.assertLess(np.abs(np.abs(slip) - known).max(), 1e-8 * max(known.max(), 1e-6))

    def test_slip_under_a_peak_runs_away_at_the_length_of_uenishi_and_rice(self):
        for settings in ({}, {"angle": 30}, {"sign": -1}, {"factor": 1 + 1e-9}):
            with self.subTest(**settings):
                _, told, _ = self.told(peaked(**settings))
                self.assertIsNotNone(told)
                self.assertAlmostEqual(float(told.group(3)), CRITICAL, delta=0.2)  # whole cells, at both ends
                self.assertLess(np.hypot(float(told.group(5)), float(told.group(6))), 0.06)
                self.assertLess(float(told.group(8)), float(told.group(7)))

    def test_injection_into_a_weakening_fault_runs_away_at_the_same_length(self):
        """That length is the same for every shape of the load: with wide and narrow peaks of the pressure."""
        begins = []
        for settings in ({}, {"diffusivity": 1.0}, {"angle": 30, "sign": -1}, {"factor": 1 + 1e-9},
                         {"schedule": "{iterate: {steps: [{solve: [conduit]}, {solve: [rock, contact]}], fallback: none}}"}):
            with self.subTest(**settings):
                _, told, folder = self.told(injected(**settings))
                self.assertIsNotNone(told)
                slipping = np.array(sprekk.Results(folder)["contact.cells_slip[1]"])
                self.assertTrue((np.diff(slipping) >= 0).all() and np.unique(slipping).size > 3)  # slip spreads before
                self.assertEqual((told.group(1), told.group(4)), ("slip", "fault"))
                self.assertAlmostEqual(float(told.group(3)), CRITICAL, delta=0.2)  # whole cells, at both ends
                self.assertLess(np.hypot(float(told.group(5)), float(told.group(6))), 0.06)
                self.assertAlmostEqual(float(told.group(7)), 0.8, delta=1e-9)
                self.assertLess(float(told.group(8)), 0.8)
                begins.append(float(told.group(2)))
        # Twins run away at one time; in turn, steps end elsewhere, within which the pressure counts as linear.
        self.assertAlmostEqual(begins[3] / begins[0], 1, delta=1e-5)
        self.assertAlmostEqual(begins[2] / begins[0], 1, delta=0.02)
        self.assertAlmostEqual(begins[4] / begins[0], 1, delta=0.02)

    def test_a_jump_that_is_accepted_is_told(self):
        """A block that has lost all of its weakening at once: k s = load - 6 MPa + W D, from rest."""
        for settings in ({}, {"sign": -1}, {"upright": True}, {"factor": 1 + 1e-9}):
            with self.subTest(**settings):
                code, told, folder = self.told(block(0.999, **settings))
                self.assertEqual(code, 0)
                self.assertIsNotNone(told)
                note, = [note for note in sprekk.Results(folder).record["notes"] if "run away" in note["topic"]]
                jump = float(re.match(r"walls jump by ([\d.e+-]+) m to another equilibrium", note["text"]).group(1))
                self.assertAlmostEqual(jump / ((0.07e6 + STIFFNESS / 0.999 * DISTANCE) / STIFFNESS), 1, delta=5e-3)

    def test_cohesion_without_weakening_is_that_of_mohr_and_coulomb(self):
        for kind in ("coulomb", "augmented_lagrangian"):
            for settings in ({}, {"sign": -1}, {"upright": True}, {"factor": 1 + 1e-9}):
                with self.subTest(kind=kind, **settings):
                    scene = re.sub(r"friction: 0.6\n +weakening: .*", "friction: 0.4\n    cohesion: 2 MPa", block(1, **settings))
                    place = "0 m, 0.15 m" if settings.get("upright") else "0.15 m, 0 m"
                    scene = scene.replace("coulomb", kind) + f"output: {{probes: {{s: {{of: contact.jump, at: [{place}]}}}}}}\n"
                    code, told, folder = self.told(scene)
                    self.assertEqual((code, told), (0, None))
                    slip = np.abs(sprekk.Results(folder)["s.t[m]"])
                    # 0.4 times 10 MPa and 2 MPa hold 6 MPa; what the load is above it, slip takes off.
                    known = np.maximum(0, 1e5 * (sprekk.Results(folder).times - 5.3)) / STIFFNESS
                    self.assertLess(np.abs(slip - known).max(), 1e-8 * known.max())

    @on_two_processes
    def test_two_processes_tell_the_same(self):
        for scene in (block(0.9), block(0.999), peaked(), injected()):
            one, two = (self.told(scene, processes=n) for n in (1, 2))
            self.assertEqual(one[0], two[0])
            self.assertEqual(one[1].group(0), two[1].group(0))

    def test_a_run_that_cannot_go_on_ends_at_once(self):
        """With all unknowns together in the step in which it happens; in turn, the step is repeated once, over most of the way up to there."""
        flow = ("  conduit: {type: fracture_flow/tpfa, initial_aperture: 0.1 mm, initial_pressure: 0 MPa, viscosity: 1 mPa*s, fluid_compressibility: 4.5e-10 1/Pa}\n"
                "couplers: [{type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}]\n")
        in_turn = [("solve: [rock, contact, conduit]", 1), ("iterate: {steps: [{solve: [conduit]}, {solve: [rock, contact]}]}", 1),
                   ("iterate: {steps: [{solve: [conduit]}, {solve: [rock, contact]}], fallback: none}", 2),
                   ("iterate: {steps: [{solve: [rock, contact]}, {solve: [conduit]}], fallback: none}", 2),
                   ("iterate: {steps: [{subcycle: {steps: [{solve: [conduit]}], count: 3}}, {solve: [rock, contact]}]}", 2)]
        for schedule, attempts in in_turn:
            with self.subTest(schedule=schedule):
                scene = re.sub("couplers: .*\n", lambda _: flow, block(0.9)).replace("solve: [rock, contact]", schedule)
                begin = time.monotonic()
                code, told, folder = self.told(scene)
                self.assertLess(time.monotonic() - begin, 10)
                self.assertEqual(code, 1)
                self.assertAlmostEqual(float(told.group(2)), 5.3, delta=1e-3)
                self.assertEqual(sprekk.Results(folder).record["counters"]["steps rejected"], attempts)
                self.assertLess(len((folder / "coupling.csv").read_text().splitlines()), 400)


if __name__ == "__main__":
    unittest.main()
