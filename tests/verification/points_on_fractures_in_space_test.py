#!/usr/bin/python3
"""points_on_fractures_in_space_test.py SPREKK [MPIEXEC]: rates and pressures at points of a fracture in space, in general position.

A rate q at a point of a surface without end has the pressure -mu q/(2 pi T) ln r (Thiem); here it holds where the fracture ends. Away from the point
it does not depend on which cell holds it, and at the radius of a bore hole it does not depend on the cells.

Twins: another place by 1e-9, a mirror image, two processes."""

import math
import unittest
from pathlib import Path

import numpy as np

from scene_runs import on_two_processes
from scenes_in_space import CUTS, FLOWS, SIDES, SpaceRuns
from scenes_in_space import scene as scene_with_rock

RATE, TRANSMISSIVITY, VISCOSITY, BORE = 3.0, 0.7, 0.5, 1e-3  # m^3/s, m^3, Pa s, m
SCALE = VISCOSITY * RATE / (2 * math.pi * TRANSMISSIVITY)  # Pa
PLACES = ((0.5, 0.5), (0.53, 0.47), (0.4123, 0.617), (0.61, 0.41))
CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))


def on_plane(x, y, mirror=1):
    return np.array([mirror * x, y, 0.3 + 0.3 * x + 0.2 * y])


def on_cut(u, v):
    """A point of the first fracture of CUTS."""
    a, b, c, d = np.array(CUTS["one"])
    return (1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d


def scene(place, what, size, mirror=1, more=""):
    """`what`: of a point, without its place."""
    at = on_plane(*place, mirror)
    distance = "sqrt(" + " + ".join(f"({axis}/m - {float(c)!r})^2" for axis, c in zip("xyz", at)) + ")"
    sides = ", ".join(f"{side}: {{pressure: (-{SCALE!r}*log({distance})) Pa}}" for side in SIDES[:4])
    points = ", ".join("[" + ", ".join(f"{float(c)!r} m" for c in on_plane(x, y, mirror)) + "]" for x, y in CORNERS)
    kind, value = what.split(":", 1)
    return f"""
name: point
geometry:
  box: {{x: {"[0 m, 1 m]" if mirror == 1 else "[-1 m, 0 m]"}, y: [0 m, 1 m], z: [0 m, 1 m]}}
  fractures: {{f: {{points: [{points}]}}}}
mesh: {{size: {max(size, 0.3)} m, fracture_size: {size} m, growth: 2{more}}}
components:
  conduit:
    type: fracture_flow/mfd
    viscosity: {VISCOSITY} Pa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: 1 mm
    transmissivity: constant
    transmissivity_value: {TRANSMISSIVITY} m^3
    {kind}: {{p: {{at: [{', '.join(f'{float(c)!r} m' for c in at)}], {value}}}}}
    boundary: {{{sides}}}
schedule: [{{solve: conduit}}]
time: {{end: 1 s, step: 1 s}}
"""


INJECTED = f"injection:rate: {RATE} m^3/s, radius: {BORE} m"
GIVEN = f"prescribed:pressure: {-SCALE * math.log(BORE)!r} Pa, radius: {BORE} m"


# A fracture between two sides without pressure; `more`: another one.
STRIP = """
name: strip
geometry: {{box: {{x: [0 m, 100 m], y: [0 m, 80 m], z: [-60 m, 0 m]}},
           fractures: {{a: {{points: [[0 m, {low} m, -30 m], [100 m, {low} m, -30 m], [100 m, {high} m, -30 m], [0 m, {high} m, -30 m]]}}{more}}}}}
mesh: {{kind: structured, shape: {shape}, cells: {cells}}}
components:
  c:
    type: fracture_flow/mfd
    viscosity: 1 mPa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: {{fractures: {{a: 0.2 mm, default: 0.1 mm}}}}
    injection: {{i: {{fracture: a, at: [{x} m, {y} m, -30 m], rate: 1e-4 m^3/s}}}}
    boundary: {{left: {{pressure: 0 Pa}}, right: {{pressure: 0 Pa}}}}
schedule: [{{solve: c}}]
time: {{end: 100 s, step: 100 s}}
"""
CROSSED = ", b: {points: [[40 m, 20 m, -45 m], [40 m, 60 m, -45 m], [40 m, 60 m, -15 m], [40 m, 20 m, -15 m]]}"


class PointsOnFractures(SpaceRuns):
    def test_a_rate_keeps_its_place_where_cells_are_few(self):
        """What leaves at x = 0 is the rate times 1 - x/L: in a row of cells, and in corners of triangles beside a crossing."""
        rows = [dict(shape="hexahedra", cells=[5, 1, 4], low=0, high=80, more="", x=x, y=40) for x in (3.0, 40.0, 41.0, 60.0, 99.0)]
        corners = [dict(shape=shape, cells=[5, 4, 4], low=20, high=60, more=CROSSED, x=x, y=y)
                   for shape in ("tetrahedra", "wedges") for x, y in ((40.0, 20.0), (41.0, 48.0), (40.0, 32.4), (1.0, 20.4), (97.0, 58.8))]
        for strip in rows + corners:
            left, right = (self.run_text(STRIP.format(**strip))[f"c.{side}.outflow"][-1] for side in ("left", "right"))
            self.assertAlmostEqual(left + right, 1e-4, delta=1e-13, msg=strip)
            self.assertAlmostEqual(left, 1e-4 * (1 - strip["x"] / 100), delta=1e-12, msg=strip)

    def injected(self, place, size, mirror=1, **how):
        """The error away from the point, and that at its bore hole, over SCALE."""
        results = self.run_text(scene(place, INJECTED, size, mirror), **how)
        fracture = results.fractures()
        distance = np.linalg.norm(fracture.centres - on_plane(*place, mirror), axis=1)
        far = distance > 0.25
        error = fracture["conduit.pressure"][far] / SCALE + np.log(distance[far])
        away = math.sqrt((fracture.sizes[far] * error ** 2).sum() / fracture.sizes[far].sum())
        return away, results["conduit.p.pressure"][-1] / SCALE + math.log(BORE)

    def test_a_rate_has_its_pressure_wherever_it_lies_in_a_cell(self):
        errors = np.array([[self.injected(place, size) for place in PLACES] for size in (0.1, 0.05)])
        print("errors of the pressure away from a point that injects, and at its bore hole:\n", errors)
        away = errors[:, :, 0].max(axis=1)
        self.assertLess(away[1], 0.35 * away[0])
        self.assertLess(np.abs(errors[0, :, 1]).max(), 0.02)
        self.assertLess(np.abs(errors[1, :, 1]).max(), 0.01)

    def test_a_pressure_lets_its_rate_in_on_every_mesh(self):
        for place in PLACES[:3]:
            for size in (0.15, 0.07):
                rate = self.run_text(scene(place, GIVEN, size))["conduit.p.rate"][-1]
                print(place, size, rate / RATE - 1)
                self.assertAlmostEqual(rate / RATE, 1, delta=0.005)

    def test_twins(self):
        place = PLACES[2]
        rate = self.run_text(scene(place, GIVEN, 0.1))["conduit.p.rate"][-1]
        moved = self.run_text(scene(np.array(place) * (1 + 1e-9), GIVEN, 0.1))["conduit.p.rate"][-1]
        self.assertAlmostEqual(moved / rate, 1, delta=1e-7)
        self.assertAlmostEqual(self.run_text(scene(place, GIVEN, 0.1, mirror=-1))["conduit.p.rate"][-1] / RATE, 1, delta=0.005)

    @on_two_processes
    def test_two_processes_have_the_answer_of_one(self):
        for what, column in ((GIVEN, "conduit.p.rate"), (INJECTED, "conduit.p.pressure")):
            text = scene(PLACES[2], what, 0.1, more=", division: scattered")
            one, two = (self.run_text(text, processes=count)[column][-1] for count in (1, 2))
            self.assertAlmostEqual(two / one, 1, delta=1e-9)

    def test_points_have_their_pressures_with_gmres(self):
        """A rate at a point, whose row has pressures alone, beside rock and walls."""
        points = {"one": on_cut(0.4, 0.5), "other": on_cut(0.3, 0.2)}
        given = ", ".join(f"{name}: {{fracture: one, at: [{', '.join(f'{float(c)!r} m' for c in at)}], pressure: {7 + k} Pa}}" for k, (name, at) in enumerate(points.items()))
        text = scene_with_rock("{size: 0.25 m}", CUTS).replace("    initial_aperture:", f"    prescribed: {{{given}}}\n    initial_aperture:", 1)
        direct, found = (self.run_text(text, f"solver={{type: {solver}}}") for solver in ("umfpack", "belos"))
        for column in [*(f"conduit.{name}.rate[m^3/s]" for name in points), *FLOWS]:
            self.assertAlmostEqual(found.history[column][-1], direct.history[column][-1], delta=1e-6 * abs(direct["conduit.one.rate"][-1]))

    def test_pressures_stay_between_those_given(self):
        """A pressure at a point between the centres of cells of a fracture that conducts less than its walls."""
        for u, v in ((0.4, 0.5), (0.43, 0.47)):
            given = f"{{p: {{fracture: one, at: [{', '.join(f'{float(c)!r} m' for c in on_cut(u, v))}], pressure: -9 Pa}}}}"
            text = scene_with_rock("{size: 0.25 m}", {"one": CUTS["one"]}, walls="1 m/(Pa*s)")
            text = text.replace("value: 1 m^3", "value: 1e-3 m^3").replace("    initial_aperture:", f"    prescribed: {given}\n    initial_aperture:", 1)
            pressures = self.run_text(text).fractures()["conduit.pressure"]
            self.assertLess(pressures.max(), 2.45)  # the sides have -1.4 to 2.45 Pa
            self.assertGreaterEqual(pressures.min(), -9)
            self.assertAlmostEqual(pressures.min(), -9, delta=1e-9)

    def test_what_is_told(self):
        for place, radius, size, words, code in (((0.5, 0.5), 0.5, 0.1, "too small for the bore hole", 2), ((0.999, 0.5), 1e-3, 0.1, "at the rim", 2),
                                                 ((0.5, 0.5), None, 0.1, "give the 'radius' of its bore hole", 0), ((0.5, 0.5), 1e-3, 0.1, "", 0)):
            with self.subTest(words):
                given = GIVEN.split(", radius")[0] + (f", radius: {radius} m" if radius else "")
                called = self.call("check", self.write(scene(place, given, size), f"told_{next(self.numbers)}.yaml"))
                said = called.stdout + called.stderr
                self.assertEqual(called.returncode, code, said)
                self.assertIn(words, said)
                self.assertEqual("bore hole" in said, bool(words))


class PointsInCorners(SpaceRuns):
    def test_a_rate_in_a_corner_of_cells_enters_all_of_them_alike(self):
        # In the middle of four squares, whose pressures are equal, and in a node of triangles; the same for a point that is off by round-off.
        text = """
geometry:
  box: {x: [0 m, 40 m], y: [0 m, 40 m], z: [0 m, 20 m]}
  fractures: {f: {points: [[0 m, 0 m, 10 m], [0 m, 40 m, 10 m], [40 m, 40 m, 10 m], [40 m, 0 m, 10 m]]}}
mesh: {kind: structured, shape: SHAPE, cells: [4, 4, 2]}
components:
  conduit:
    {type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, initial_aperture: 0.1 mm,
     boundary: {left: {pressure: 0 Pa}, right: {pressure: 0 Pa}, front: {pressure: 0 Pa}, back: {pressure: 0 Pa}},
     injection: {i: {fracture: f, at: [OVER x m, OVER y m, 10 m], rate: 1e-5 m^3/s}}}
schedule: [{solve: conduit}]
time: {end: 1 day, step: 1 day}
"""
        for shape in ("hexahedra", "tetrahedra"):
            found = []
            for x, y in ((20, 20), (20 + 1e-9, 20), (20 - 1e-9, 20 + 1e-9)):
                path = self.write(text.replace("SHAPE", shape).replace("OVER x", repr(x)).replace("OVER y", repr(y)))
                found.append(np.sort(self.run_scene(path).fields(kind="fractures")["conduit.pressure"]))
                np.testing.assert_allclose(found[-1], found[0], rtol=0, atol=1e-8 * found[0][-1])
            if shape == "hexahedra":
                self.assertLess(np.ptp(found[0][-4:]), 1e-9 * found[0][-1])
                self.assertLess(found[0][-5], 0.999 * found[0][-1])


class BesideALeakySide(SpaceRuns):
    def test_gmres_goes_on_where_the_solution_of_a_block_is_next_to_nothing(self):
        # What leaves through the leaky side is zero, and its residual is as large as its terms however small both are.
        file = Path(__file__).parent / "meshes/graded_tetrahedra.msh"
        at_rest = "1500*x - 2000*y - 9200*z"
        path = self.write(f"""
geometry: {{file: {file}}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-14 m^2
    viscosity: 1 mPa*s
    porosity: {{regions: {{low: 0.1, high: 0.03}}}}
    fluid_compressibility: 4.5e-10 1/Pa
    initial_pressure: "(1e7 + {at_rest}) Pa"
    boundary:
      left: {{pressure: "(1.05e7 + {at_rest}) Pa"}}
      bottom: {{outer_pressure: "(9.9e6 + {at_rest}) Pa", conductance: 2e-11 m/(Pa*s), only_out: true}}
  conduit:
    type: fracture_flow/mfd
    viscosity: 1 mPa*s
    fluid_compressibility: 4.5e-10 1/Pa
    initial_aperture: 0.3 mm
    initial_pressure: "(1e7 + {at_rest}) Pa"
    prescribed: {{out: {{fracture: fb, at: [80 m, 45 m, 30 m], pressure: 9 MPa}}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 day, step: 1 day, smallest: 0.4 day}}
output: {{fields: false, probes: {{p: {{of: pore.pressure, at: [50 m, 33 m, 33 m]}}}}}}
""")
        direct, found = (self.run_scene(path, f"solver={{type: {solver}}}") for solver in ("umfpack", "belos"))
        self.assertEqual(found.record["counters"]["steps rejected"], 0)
        for column in ("p[Pa]", "conduit.out.rate[m^3/s]"):
            self.assertAlmostEqual(found[column][-1] / direct[column][-1], 1, delta=1e-6, msg=column)


if __name__ == "__main__":
    unittest.main()
