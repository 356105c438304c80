#!/usr/bin/python3
"""point_injection_test.py SPREKK [MPIEXEC]: fluid that is injected at a point of a fracture comes from there, not from the centre of a cell:
the cells around share it. Steady flow to both ends of a fracture from side to side, whose pressure falls linearly from the well to each
end: p(s) = Q μ/K s (L - s_w)/L before the well, and with s and s_w counted from the other end behind it."""

import math
import unittest

from scene_runs import MPIEXEC, ROOT, SceneRuns, on_two_processes

RATE, MOBILITY = 1e-6, 1e-9 / 1e-3  # m^2/s; K/μ, m^3/(Pa s)
SCENE = """
name: point_injection
geometry:
  box: {{x: [-1 m, 1 m], y: [-1 m, 1 m]}}
  fractures: {{main: {{points: [{start}, {end}]}}}}
mesh: {{size: 0.4 m, fracture_size: {size!r} m}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: 1 mm
    transmissivity: constant
    transmissivity_value: 1e-9 m^3
    injection: {{well: {{at: {well}, rate: {rate!r} m^2/s}}}}
    boundary: {{left: {{pressure: 0 Pa}}, right: {{pressure: 0 Pa}}}}
schedule: [{{solve: conduit}}]
time: {{end: 1 s, step: 1 s}}
output:
  fields: false
  probes: {{{probes}}}
"""
CROSS = """
name: crossing
geometry:
  box: {{x: [-1 m, 1 m], y: [-1 m, 1 m]}}
  fractures: {{one: {{points: {ends[0]}}}, two: {{points: {ends[1]}}}}}
mesh: {{size: 0.4 m, fracture_size: 0.1 m}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.1 mm
    initial_pressure: 0 Pa
    injection: {{well: {{at: {well}, rate: {rate!r} m^2/s}}}}
schedule: [{{solve: conduit}}]
time: {{end: 1 s, step: 0.1 s}}
output:
  fields: false
  probes: {{{probes}}}
"""
PLACES = (0.13, 0.22, 0.31, 0.7, 0.79, 0.9)  # of the fracture: at least a cell and a half from all wells


class PointInjection(SceneRuns):
    def pressures(self, rise, well, size=0.1, processes=1):
        """At PLACES of the fracture from (-1, -rise) to (1, rise), and at the well, which is at a part of its length."""
        def at(part):
            return f"[{2 * part - 1!r} m, {rise * (2 * part - 1)!r} m]"
        probes = ", ".join(f"p{i}: {{of: conduit.pressure, at: {at(part)}}}" for i, part in enumerate(PLACES))
        scene = SCENE.format(start=at(0), end=at(1), size=size, well=at(well), rate=RATE, probes=probes)
        table = self.run_scene(self.write(scene), processes=processes).history
        return [table[f"p{i}[Pa]"][-1] for i in range(len(PLACES))] + [table["conduit.well.pressure[Pa]"][-1]]

    def exact(self, rise, well):
        length = 2 * math.hypot(1, rise)
        return [RATE / MOBILITY * length * min(part, well) * (1 - max(part, well)) for part in (*PLACES, well)]

    def test_wells_anywhere_in_a_cell(self):
        for rise in (0.0, 0.37, -0.8):
            for well in (0.5, 0.5 + 1e-9, 0.5 - 1e-9, 0.51, 0.533, 0.487, 0.46):
                for ours, exact in zip(self.pressures(rise, well), self.exact(rise, well)):
                    self.assertAlmostEqual(ours / exact, 1, delta=1e-9, msg=f"rise {rise}, well at {well}")

    def test_a_symmetric_well_feeds_both_sides_alike(self):
        for size in (0.1, 0.08):  # an even and an odd number of cells
            pressures = self.pressures(0.37, 0.5, size)
            mirrored = self.pressures(-0.37, 0.5, size)
            for i, (ours, other) in enumerate(zip(pressures, mirrored)):
                self.assertAlmostEqual(ours / other, 1, delta=1e-12)
                self.assertAlmostEqual(ours / self.exact(0.37, 0.5)[i], 1, delta=1e-9)

    def test_a_well_at_a_crossing_feeds_all_arms_alike(self):
        """Four arms of one length hold as much, with the well at their crossing; with the well in one of them, a quarter of a cell from the
        crossing, both arms beside it do. The mean is that of the fluid: p = Q t/(L a c)."""
        for turn in (0.0, 0.4):
            c, s = math.cos(turn), math.sin(turn)
            arms = [(c, s), (-s, c), (-c, -s), (s, -c)]
            for before, processes in ((0.0, 1), (1e-9, 1), (0.025, 1), (0.0, 2 if MPIEXEC else 1)):
                probes = ", ".join(f"p{i}: {{of: conduit.pressure, at: [{0.35 * x!r} m, {0.35 * y!r} m]}}" for i, (x, y) in enumerate(arms))
                table = self.run_scene(self.write(CROSS.format(
                    ends=[[[-0.7 * c, -0.7 * s], [0.7 * c, 0.7 * s]], [[0.7 * s, -0.7 * c], [-0.7 * s, 0.7 * c]]],
                    well=[-before * c, -before * s], rate=RATE, probes=probes)), processes=processes).history
                pressures = [table[f"p{i}[Pa]"][-1] for i in range(4)]
                mean = RATE * 1.0 / (4 * 0.7 * 1e-4 * 4e-10)
                self.assertAlmostEqual(sum(pressures) / 4 / mean, 1, delta=1e-3)
                self.assertAlmostEqual(pressures[1] / pressures[3], 1, delta=1e-12)
                if before > 1e-6:
                    self.assertGreater(pressures[2], pressures[0] * (1 + 1e-6))
                else:
                    for one in pressures:
                        self.assertAlmostEqual(one / pressures[0], 1, delta=1e-9)

    def test_beside_a_pressure_that_is_prescribed_at_a_point(self):
        """Three straight lines of pressure: from one end to the well, to the point that is held, and to the other end."""
        for well, held, given in ((-0.33, 0.42, 1e3), (-0.3, 0.05, 0.0), (-0.03, 0.26, 1e2), (0.12, -0.41, 1e3)):
            scene = SCENE.format(start="[-1 m, 0 m]", end="[1 m, 0 m]", size=0.1, well=f"[{well} m, 0 m]", rate=RATE,
                                 probes="p: {of: conduit.pressure, at: [0.5 m, 0 m]}")
            table = self.run_scene(self.write(scene),
                                   f"components.conduit.prescribed={{held: {{at: [{held} m, 0 m], pressure: {given} Pa}}}}").history
            between, to_end = abs(held - well), 1 + well if held > well else 1 - well
            pressure = (RATE / MOBILITY + given / between) / (1 / to_end + 1 / between)
            rate = MOBILITY * ((given - pressure) / between + given / (1 - held if held > well else 1 + held))
            self.assertAlmostEqual(table["conduit.well.rate[m^2/s]"][-1], RATE, delta=1e-20)
            self.assertAlmostEqual(table["conduit.well.pressure[Pa]"][-1] / pressure, 1, delta=1e-9)
            self.assertAlmostEqual(table["conduit.held.rate[m^2/s]"][-1] / rate, 1, delta=1e-9)

    def test_in_a_fracture_with_a_prescribed_pressure_nothing_enters(self):
        scene = SCENE.format(start="[-1 m, 0 m]", end="[1 m, 0 m]", size=0.1, well="[-0.03 m, 0 m]", rate=RATE,
                             probes="p: {of: conduit.pressure, at: [0.5 m, 0 m]}")
        table = self.run_scene(self.write(scene), "components.conduit.prescribed={held: {fracture: main, pressure: 0 Pa}}").history
        self.assertAlmostEqual(table["conduit.well.rate[m^2/s]"][-1], 0, delta=1e-20)

    @on_two_processes
    def test_two_processes(self):
        for ours, exact in zip(self.pressures(0.37, 0.5, processes=2), self.exact(0.37, 0.5)):
            self.assertAlmostEqual(ours / exact, 1, delta=1e-9)


class PointsInPasses(SceneRuns):
    def test_the_shares_of_a_point_are_those_of_the_start_of_the_step_in_each_pass(self):
        # Apertures change in the passes, and would change the shares. A subcycle of one step begins its step in each pass.
        flow, rock = "{solve: [pore, conduit], stabilize: fixed_stress}", "{solve: [rock, contact]}"
        settings = ("mesh={size: 2 m, fracture_size: 0.4 m}", "components.conduit.injection.well={at: [4.83 m, 2.83 m], rate: 4e-7 m^2/s}", "time.end=12 h",
                    "output.fields=false")
        whole, plain, cycled = (
            self.run_scene(ROOT / "configs/tutorial/first_scene.yaml", *settings, *(f"schedule=[{schedule}]" for schedule in schedules))
            for schedules in ((), *([f"{{iterate: {{until: {{relative: 1e-11}}, fallback: none, steps: [{first}, {rock}]}}}}"]
                                    for first in (flow, f"{{subcycle: {{count: 1, steps: [{flow}]}}}}"))))
        self.assertEqual(self.largest_difference(cycled, plain), 0)
        self.assertLess(self.largest_difference(plain, whole), 1e-8)


if __name__ == "__main__":
    unittest.main()
