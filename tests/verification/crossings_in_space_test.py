#!/usr/bin/python3
"""crossings_in_space_test.py SPREKK [MPIEXEC]: unlike fractures on the lines where they cross, and where three meet in a point.

Against closed forms, and against an equi-dimensional solution of the plane (references/crossing.py) that is extruded. Turned about no axis,
mirrored, with values that differ by 1e-9, and on two processes between which the line is divided."""

import unittest

import numpy as np

from hexahedra import TURN
from scene_runs import ROOT, on_two_processes
from scenes_in_space import SpaceRuns

WIDTH, VISCOSITY = 0.002, 0.5  # m, Pa s
DEPTH = 0.8                    # along the line, m
MIRROR = TURN @ np.diag([1.0, -1.0, 1.0])
# Permeabilities of 1e4, 10 and 25 m^2, and strips of other fractures, at whose edges a ends, so permeable that these have the pressure of the strip.
UNLIKE = {"a": 20.0, "b": 0.02, "c": 0.05, "from": 1e11, "to": 1e11}
FILLS = {"": 2 / (1e-4 + 0.1), "through: a": 1e4, "through: b": 10.0, "permeability: 1e-3 m^2": 1e-3}


def along_y(x, z):
    """The rectangle through two places of x and z."""
    return [[x[0], 0, z[0]], [x[1], 0, z[1]], [x[1], DEPTH, z[1]], [x[0], DEPTH, z[0]]]


def conductor(angle=90, t=False):
    """a from x = -1 to 1, between strips, crossed by b at this angle; as a T, b only ends there."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return {"a": along_y((-1, 1), (0, 0)), "from": along_y((-1.3, -1), (0, 0)), "to": along_y((1, 1.3), (0, 0)),
            "b": along_y((0 if t else -0.6 * c, 0.6 * c), (0 if t else -0.6 * s, 0.6 * s))}


def exact_flow(k, k_x, within=WIDTH / 2):
    """Through a: 2 m long, of it so much on both sides of the line with what fills the crossing."""
    return 2 * WIDTH * DEPTH / VISCOSITY / ((2 - 2 * within) / k + 2 * within / k_x)


def scene(fractures, turn, crossings="", mesh="{size: 0.5 m, fracture_size: 0.15 m}", transmissivities=UNLIKE, widths=f"{WIDTH} m", more=""):
    """Fractures alone, in a box that has them all, with 3 Pa in `from` and 1 Pa in `to`."""
    moved = {name: np.array(points) @ turn.T for name, points in fractures.items()}
    low, high = (f(np.concatenate(list(moved.values())), axis=0) for f in (np.min, np.max))
    box = ", ".join(f"{axis}: [{a - 0.4!r} m, {b + 0.4!r} m]" for axis, a, b in zip("xyz", map(float, low), map(float, high)))
    return f"""
name: crossing
geometry:
  box: {{{box}}}
  fractures:
{"".join(f"    {name}: {{points: {texts(points)}}}{chr(10)}" for name, points in moved.items())}
mesh: {mesh}
components:
  conduit:
    type: fracture_flow/mfd
    viscosity: {VISCOSITY} Pa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: {widths}
    transmissivity: constant
    transmissivity_value: {{fractures: {{{", ".join(f"{name}: {transmissivities[name.partition('_')[0]]!r} m^3" for name in fractures)}}}}}
    prescribed: {{{", ".join(f"{name}: {{fracture: {name}, pressure: {3 if name.startswith('from') else 1} Pa}}" for name in fractures if name[:2] in ("fr", "to"))}}}
    {f"crossings: {{x: {{{crossings}}}}}" if crossings else ""}{more}
schedule: [{{solve: conduit}}]
time: {{end: 1 s, step: 1 s}}
"""


def texts(points):
    return "[" + ", ".join("[" + ", ".join(f"{float(c)!r} m" for c in x) + "]" for x in points) + "]"


class CrossingsInSpace(SpaceRuns):
    def flow(self, text, *settings, **how):
        results = self.run_text(text, *settings, **how)
        flows = [sum(values[-1] for name, values in results.history.items() if name.startswith(f"conduit.{end}") and ".rate[" in name) for end in ("from", "to")]
        self.assertAlmostEqual(flows[0], -flows[1], delta=1e-9 * abs(flows[1]))
        return flows[0]

    def test_the_fill_of_a_line(self):
        """Harmonic means at any angle, and where b only ends; or what the scene says."""
        for turn, angle, t in ((np.eye(3), 90, False), (TURN, 40, False), (MIRROR, 70, True)):
            for crossings, k_x in FILLS.items():
                said = f"between: [a, b], {crossings}" if crossings else ""
                with self.subTest(crossings=crossings, angle=angle):
                    self.assertAlmostEqual(self.flow(scene(conductor(angle, t), turn, said)) / exact_flow(1e4, k_x), 1, delta=1e-9)

    def test_three_fractures_on_one_line(self):
        fractures = {**conductor(90), "c": along_y((-0.4, 0.4), (-0.4, 0.4))}
        self.assertAlmostEqual(self.flow(scene(fractures, TURN)) / exact_flow(1e4, 3 / (1e-4 + 0.1 + 0.04)), 1, delta=1e-9)

    def test_the_walls_of_what_goes_through(self):
        walls = "\n    normal_permeability: constant\n    normal_permeability_value: {fractures: {b: 0.3 m/(Pa*s), default: 7 m/(Pa*s)}}"
        exact = 2 * DEPTH / ((2 - WIDTH) * VISCOSITY / (1e4 * WIDTH) + 2 / (0.3 * WIDTH))
        self.assertAlmostEqual(self.flow(scene(conductor(), TURN, "between: [a, b], through: b", more=walls)) / exact, 1, delta=1e-9)

    def test_values_that_differ_by_little(self):
        more = {**UNLIKE, "a": 20.00000002, "b": 0.02000000002}
        self.assertAlmostEqual(self.flow(scene(conductor(), TURN, transmissivities=more)) / exact_flow(1e4, 2 / (1e-4 + 0.1)), 1, delta=2e-9)

    @on_two_processes
    def test_a_line_that_two_processes_share(self):
        text = scene(conductor(), TURN).replace("fracture_size: 0.15 m", "fracture_size: 0.15 m, division: scattered")
        self.assertAlmostEqual(self.flow(text, processes=2) / exact_flow(1e4, 2 / (1e-4 + 0.1)), 1, delta=1e-9)

    def test_a_triple_point(self):
        """a and c cross in a line along the flow, and b crosses both: a and c of one permeability have the same pressures, and their flows add up."""
        height = 0.5
        flat = {name: points for name, points in conductor().items() if name != "b"}
        steep = {{"a": "c", "from": "from_c", "to": "to_c"}[name]: [[x, DEPTH / 2, height * (y / DEPTH - 0.5)] for x, y, _ in points] for name, points in flat.items()}
        fractures = {**flat, **steep, "b": along_y((0, 0), (-0.4, 0.4))}
        widths = "{fractures: {c: 5 mm, default: 2 mm}}"
        for turn, crossings in ((TURN, ""), (MIRROR, "between: [b, a, c], through: b")):
            k_x = FILLS["through: b" if crossings else ""]
            text = scene(fractures, turn, crossings, transmissivities={**UNLIKE, "c": 50.0}, widths=widths)
            self.assertAlmostEqual(self.flow(text) / (exact_flow(1e4, k_x) * (1 + 2.5 * height / DEPTH)), 1, delta=1e-9)

    def test_fills_that_conduct_better_than_narrow_cells(self):
        """Where crossings are as wide as triangles, what is left of a drop keeps the pressure between those given."""
        fractures = {**conductor(), "c": [[-0.9, DEPTH / 2, -0.3], [0.9, DEPTH / 2, -0.3], [0.9, DEPTH / 2, 0.3], [-0.9, DEPTH / 2, 0.3]]}
        for width in (0.1, 0.5):
            known = {**UNLIKE, "a": 1e4 * width, "b": 10 * width, "c": 3 * width}
            results = self.run_text(scene(fractures, TURN, "permeability: 1e9 m^2", transmissivities=known, widths=f"{width} m"))
            pressure = results.fractures()["conduit.pressure"]
            self.assertGreater(pressure.min(), 1 - 1e-9)
            self.assertLess(pressure.max(), 3 + 1e-9)

    def test_a_barrier_through_the_whole_box(self):
        """Rock and two conductors, which cross each other on the barrier, have one pressure on each side of it: what passes goes through its walls, and
        through what fills its crossings."""
        barrier, wall, pressure = 1e-3, 2e-3, 5.0  # m, m/(Pa s), Pa
        shapes = {"b": [[0.5, 0, 0], [0.6, 1, 0], [0.6, 1, 1], [0.5, 0, 1]], "a": [[0.2, 0, 0.3], [0.9, 0, 0.3], [0.9, 1, 0.6], [0.2, 1, 0.6]],
                  "c": [[0.1, 0.2, 0], [0.8, 0.4, 0], [0.8, 0.4, 1], [0.1, 0.2, 1]]}
        of_a = np.linalg.norm([0.1, 1, 0.3])  # its line on b
        width, k_b = {"a": 2e-3, "c": 3e-3}, 1e-4
        for crossings, k_x, wall in (("", 2 / (1 / k_b + 1e-9), wall), ("between: [a, b, c], through: b", wall * barrier / 2, wall),
                                     ("between: [a, b, c], through: b", 0, 0.0)):
            with self.subTest(crossings=crossings, wall=wall):
                results = self.run_text(f"""
geometry:
  box: {{x: [0 m, 1 m], y: [0 m, 1 m], z: [0 m, 1 m]}}
  fractures: {{{", ".join(f"{name}: {{points: {texts(points)}}}" for name, points in shapes.items())}}}
mesh: {{size: 0.3 m}}
materials: {{viscosity: 1 Pa*s}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e9 m^2, storage: 0 1/Pa, boundary: {{left: {{pressure: {pressure} Pa}}, right: {{pressure: 0 Pa}}}}}}
  conduit:
    type: fracture_flow/mfd
    fluid_compressibility: {{fractures: {{b: 1e-9 1/Pa, default: 0 1/Pa}}}}
    initial_aperture: {{fractures: {{a: {width["a"]} m, b: {barrier} m, c: {width["c"]} m}}}}
    transmissivity: constant
    transmissivity_value: {{fractures: {{a: {1e9 * width["a"]!r} m^3, b: {k_b * barrier!r} m^3, c: {1e9 * width["c"]!r} m^3}}}}
    normal_permeability: constant
    normal_permeability_value: {{fractures: {{b: {wall!r} m/(Pa*s), default: 1e12 m/(Pa*s)}}}}
    {f"crossings: {{x: {{{crossings}}}}}" if crossings else ""}
    boundary: {{bottom: {{closed: true}}, top: {{closed: true}}, front: {{closed: true}}, back: {{closed: true}}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 s, step: 1 s}}
""")
                exact = pressure * (wall / 2 * np.hypot(1, 0.1) + k_x / barrier * (of_a * width["a"] + 1 * width["c"]))
                self.assertAlmostEqual(results["pore.right.outflow"][-1], exact, delta=1e-8 * exact + 1e-12)


if __name__ == "__main__":
    unittest.main()
