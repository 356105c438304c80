#!/usr/bin/python3
"""dense_network_test.py SPREKK [MPIEXEC]: a strong injection into a dense network of fractures that cross, with friction and dilation, and a well that
draws. More and more cells slip as the pressure spreads, and Newton's method has to find which. Against the
same scene with contact/augmented_lagrangian, which finds them in another way; turned, perturbed, on two processes; and the balance of fluid."""

import unittest

import numpy as np
from scene_runs import SceneRuns, on_two_processes, sprekk

SIZE = 40.0  # m, of the box
COUNT = 24
AGREE = 1e-6  # of the largest value of a column: both contacts end at residuals of 1e-10 of the largest term


def distance(point, a, b):
    along = b - a
    part = np.clip((point - a) @ along / (along @ along), 0, 1)
    return np.hypot(*(point - a - part * along))


def crosses(one, other):
    """Whether two segments cross."""
    def side(p, q, r):
        return np.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
    return side(*one, other[0]) != side(*one, other[1]) and side(*other, one[0]) != side(*other, one[1])


def network():
    """Lines of two directions that scatter by 10 degrees, whose ends keep apart from other lines."""
    random = np.random.RandomState(11)  # its numbers are the same in every version
    lines = []
    while len(lines) < COUNT:
        angle = np.radians((25 if len(lines) % 2 else 100) + random.uniform(-10, 10))
        middle, half = random.uniform(0.2 * SIZE, 0.8 * SIZE, 2), random.uniform(6, 11)
        way = half * np.array([np.cos(angle), np.sin(angle)])
        line = (middle - way, middle + way)
        is_inside = all((1.5 < end).all() and (end < SIZE - 1.5).all() for end in line)
        ends_apart = all(min(distance(end, *other) for end in line) > 1.2 and min(distance(end, *line) for end in other) > 1.2 for other in lines)
        if is_inside and ends_apart:
            lines.append(line)
    return lines


LINES = network()


def scene(contact="coulomb", factor=1.0):
    fractures = "\n".join(f"    f{k}: {{points: [[{a[0]:.6f} m, {a[1]:.6f} m], [{b[0]:.6f} m, {b[1]:.6f} m]]}}" for k, (a, b) in enumerate(LINES))
    at = [0.6 * a + 0.4 * b for a, b in LINES]
    feed, drain = INJECTED, DRAWN
    return f"""
geometry:
  box: {{x: [0 m, {SIZE} m], y: [0 m, {SIZE} m]}}
  fractures:
{fractures}
mesh: {{size: 8 m, fracture_size: 3 m}}
materials: {{young_modulus: 40 GPa, poisson_ratio: 0.25, biot_coefficient: 0.8, porosity: 0.01, permeability: 1e-17 m^2, fluid_compressibility: 4.5e-10 1/Pa, viscosity: 0.5 mPa*s, friction: 0.6, dilation_angle: 3 deg}}
components:
  pore: {{type: matrix_flow/mpfa, initial_pressure: 30 MPa, boundary: {{left: {{pressure: 30 MPa}}, right: {{pressure: 30 MPa}}}}}}
  rock:
    type: poromechanics/mpsa
    initial_stress: {{xx: -75 MPa, yy: -50 MPa, xy: 0 MPa}}
    boundary: {{left: {{displacement_x: 0 m}}, bottom: {{displacement_y: 0 m}}, right: {{normal_stress: -75 MPa}}, top: {{normal_stress: -50 MPa}}}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.3 mm, initial_pressure: 30 MPa}}
  contact: {{type: contact/{contact}}}
  wells:
    type: wells/limited
    wells:
      feed: {{at: [{at[feed][0]} m, {at[feed][1]} m], fracture: f{feed}, rate: {1e-4 * factor!r} m^2/s, highest_pressure: 70 MPa}}
      drain: {{at: [{at[drain][0]} m, {at[drain][1]} m], fracture: f{drain}, rate: {-2.5e-5 * factor!r} m^2/s, lowest_pressure: 25 MPa}}
couplers:
  - {{type: biot, between: [pore, rock]}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
schedule: [{{solve: [pore, rock, conduit, contact, wells]}}]
time: {{end: 45 min, step: 15 min}}
"""


def connected():
    """The fractures that belong to the largest part of the network."""
    parts = [{k} for k in range(COUNT)]
    for i in range(COUNT):
        for j in range(i):
            if crosses(LINES[i], LINES[j]):
                one, other = (next(part for part in parts if k in part) for k in (i, j))
                if one is not other:
                    one |= other
                    parts.remove(other)
    return sorted(max(parts, key=len))


INJECTED, DRAWN = connected()[0], connected()[-1]


class DenseNetwork(SceneRuns):
    def results(self, *settings, processes=1, **of_scene):
        return self.run_scene(self.write(scene(**of_scene)), *settings, processes=processes)

    def assert_same(self, ours, others, within):
        for column in ours.history:
            if column.startswith(("contact.", "wells.", "fluid_stored", "fluid_injected", "area")):
                values, known = np.asarray(ours[column]), np.asarray(others[column])
                self.assertLessEqual(np.abs(values - known).max(), within * np.abs(known).max(), column)

    def test_both_contacts_find_the_same_states(self):
        self.assertGreaterEqual(len(connected()), 20)
        self.assertGreater(sum(crosses(a, b) for i, a in enumerate(LINES) for b in LINES[:i]), 30)
        ours = self.results()
        self.assertGreater(ours["contact.cells_slip"][-1], 50)
        self.assertEqual(ours.record["counters"]["steps rejected"], 0)
        self.assert_same(ours, self.results(contact="augmented_lagrangian"), AGREE)
        # What wells bring, and what is stored: the tolerance of a balance.
        brought = sum(np.cumsum(ours["step"] * ours[f"wells.{name}.rate"]) for name in ("feed", "drain"))
        stored = ours["fluid_stored"] + ours["fluid_outflow"]
        self.assertLess(np.abs(stored - brought).max(), 1e-8 * brought[-1])

    def test_twins_have_the_same_states(self):
        plain = self.write(scene(), "plain.yaml")
        ours = self.run_scene(plain)
        self.assert_same(ours, self.run_scene(self.turned(plain, 90, mirror=True)), AGREE)
        self.assert_same(ours, self.results(factor=1 + 1e-9), AGREE)

    @on_two_processes
    def test_two_processes(self):
        self.assert_same(self.results(), self.results(processes=2), AGREE)


if __name__ == "__main__":
    unittest.main()
