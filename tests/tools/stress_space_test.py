#!/usr/bin/python3
"""Scenes in space of tools/stress: what the family promises; its checks find what is planted, and are silent where nothing is."""

import copy
import math
import re
import tempfile
import unittest
from pathlib import Path

import numpy as np
from stress_state import sprekk
from stress_suite import check_space, ranges, scene, space, space_fractures, written

N = 3        # cubes along each edge of the state
RATE = 2e-6  # m^3/s
STEP = 100.0


def drawn(count, seed=613):
    return [ranges.draw(seed, number, "space") for number in range(count)]


def at_rest():
    """(p, the start and one step, its history): fluid is injected into a fracture over three faces of cubes, and stays in the three below.
    Through the side at the left a flux enters and stays in the first cell."""
    places = np.array([[x, y, z] for z in range(N + 1) for y in range(N + 1) for x in range(N + 1)], float)
    number = lambda x, y, z: (z * (N + 1) + y) * (N + 1) + x
    ring = ((0, 0), (1, 0), (1, 1), (0, 1))
    cubes = np.array([[number(x + i, y + j, z + k) for k in (0, 1) for i, j in ring] for z in range(N) for y in range(N) for x in range(N)])
    faces = np.array([[number(x + i, 1 + j, 1) for i, j in ring] for x in range(N)])
    matrix, fractures = sprekk.Grid(places, cubes, types=np.full(len(cubes), 12)), sprekk.Grid(places, faces, types=np.full(N, 9))
    p = {"low": np.zeros(3), "high": np.full(3, float(N)), "part": None, "fractures": {"f0": {}}, "anisotropy": 1.0, "gravity": False, "flow": "mpfa",
         "along": "mfd", "steady": False, "storage": 1e-9, "compressibility": 1e-9, "initial": 1e6, "given": {"left": ("flux", -1e-7), "top": ("pressure", 1e6)},
         "injection": [("f0", False, RATE)], "prescribed": [], "wells": [], "viscosity": 1e-3}
    aperture, entered = 1e-3, 1e-7 * N * N * STEP
    rise = 1e3  # in the fractures
    wall = (RATE * STEP - N * aperture * 1e-9 * rise) / STEP / N
    pressure = np.full(len(cubes), 1e6)
    pressure[[3, 4, 5]] += wall * STEP / 1e-9
    pressure[0] += entered / 1e-9
    matrix.cell_data = {"pore.pressure[Pa]": pressure}
    fractures.cell_data = {"fracture": np.zeros(N), "conduit.pressure[Pa]": np.full(N, 1e6 + rise), "conduit.aperture[m]": np.full(N, aperture),
                           "pore.wall_flux.plus[m/s]": np.zeros(N), "pore.wall_flux.minus[m/s]": np.full(N, wall)}
    one = lambda value: np.array([value])
    history = {"time[s]": one(STEP), "step[s]": one(STEP), "iterations[1]": one(1.0), "pore.left.outflow[m^3/s]": one(-1e-7 * N * N), "pore.top.outflow[m^3/s]": one(0.0),
               "conduit.i0.rate[m^3/s]": one(RATE), "of_rock[Pa*m^3]": one(pressure.sum()), "mean[Pa]": one(1e6 + rise), "most[Pa]": one(1e6 + rise),
               "fluid_stored[m^3]": one(RATE * STEP + entered), "fluid_injected[m^3]": one(RATE * STEP), "fluid_outflow[m^3]": one(-entered),
               "fluid_balance_error[m^3]": one(0.0)}
    return p, [written.Instant(STEP, matrix, fractures, follows=True)], history


class Checks(unittest.TestCase):
    def failures(self, change):
        p, instants, history = copy.deepcopy(at_rest())
        change(p, instants[0], history)
        return check_space.failures(p, instants, history)

    def test_nothing_is_found_where_nothing_is(self):
        self.assertEqual(self.failures(lambda p, instant, history: None), [])

    def found(self, text, change):
        failures = self.failures(change)
        self.assertTrue(any(text in failure for failure in failures), failures)

    def test_fluid_that_is_lost(self):
        part = 1 + 1e-6
        for text, grid, name in (("of all", "matrix", "pore.pressure[Pa]"), ("of the fractures", "fractures", "pore.wall_flux.minus[m/s]")):
            def change(p, instant, history, grid=grid, name=name):
                data = getattr(instant, grid).cell_data[name]
                data[0 if grid == "fractures" else 3] *= part
            self.found(text, change)
        for name, text in (("pore.left.outflow[m^3/s]", "flux"), ("conduit.i0.rate[m^3/s]", "rate"), ("pore.top.outflow[m^3/s]", "of all"),
                           ("fluid_balance_error[m^3]", "the program's balance")):
            def tell(p, instant, history, name=name):
                history[name] += 1e-6 * RATE * STEP
            self.found(text, tell)

    def test_probes(self):
        for name in ("of_rock[Pa*m^3]", "mean[Pa]", "most[Pa]"):
            def change(p, instant, history, name=name):
                history[name] *= 1 + 1e-8
            self.found(name, change)

    def test_pressures_beyond_what_is_given(self):
        """Fluid is brought, so only low pressures are too low; of anisotropic rock they are counted alone."""
        def change(value, **more):
            def to(p, instant, history):
                p.update(more)
                instant.cell("pore.pressure[Pa]")[13] += value
            return to
        self.found("below", change(-1e7))
        self.assertFalse(any("pressure" in failure for failure in self.failures(change(1e7))))
        self.assertFalse(any("pressure" in failure for failure in self.failures(change(-1e7, anisotropy=100.0))))
        p, instants, _ = at_rest()
        change(-1e7)(p, instants[0], None)
        self.assertGreater(check_space.overshoot(p, instants, check_space.Places(instants[0]))[1], 0.2)

    def test_heads_are_what_is_compared_under_gravity(self):
        p, instants, _ = at_rest()
        places = check_space.Places(instants[0])
        p.update(gravity=True, injection=[], given={"top": ("pressure", 1e6)})
        instants[0].matrix.cell_data["pore.pressure[Pa]"] = 1e6 - space.WEIGHT * places.rock[:, 2]
        instants[0].fractures.cell_data["conduit.pressure[Pa]"] = 1e6 - space.WEIGHT * places.fractures[:, 2]
        self.assertEqual(check_space.overshoot(p, instants, places), ([], 0.0))
        instants[0].matrix.cell_data["pore.pressure[Pa]"][2] += 1e3
        self.assertEqual(len(check_space.overshoot(p, instants, places)[0]), 1)
        p["flow"] = "tpfa"  # whose weights do not add up to nothing
        self.assertEqual(len(check_space.overshoot(p, instants, places)[0]), 0)
        self.assertGreater(check_space.overshoot(p, instants, places)[1], 0.9)

    def test_figures_of_twins(self):
        _, _, history = at_rest()
        self.assertEqual(check_space.differences(history, history, 0), [])
        other = {**history, "pore.left.outflow[m^3/s]": history["pore.left.outflow[m^3/s]"] * (1 + 2e-6)}
        self.assertEqual(len(check_space.differences(history, other)), 1)
        self.assertEqual(len(check_space.differences(history, {**history, "mean[Pa]": np.nextafter(history["mean[Pa]"], 0)}, 0)), 1)
        self.assertEqual(len(check_space.differences(history, {**history, "time[s]": np.zeros(2)})), 1)

    def test_refusals_name_a_place_and_a_reason(self):
        self.assertEqual(check_space.refusal("error: a.yaml:6:5: fractures 'a' and 'b' nearly touch at (1, 2, 3) (they are 1e-9 m apart)"), [])
        for text in ("error: no", "no mesh", "error: the fracture 'f0'", "error: nothing (why)"):
            self.assertEqual(len(check_space.refusal(text)), 1, text)


class Drawn(unittest.TestCase):
    def test_a_number_gives_the_same_scene(self):
        with tempfile.TemporaryDirectory() as temporary:
            for number in range(20):
                texts = [scene.write(ranges.draw(3, number, "space"), Path(temporary) / str(i)).read_text() for i in (0, 1)]
                self.assertEqual(*texts)
                self.assertFalse(re.search(r"\bnan\b|\binf\b|np\.", texts[0]), texts[0])

    def test_all_that_the_family_promises_is_drawn(self):
        all_of_them = drawn(200)
        for name, kinds in (("mesh", {"unstructured", *space.HEXAHEDRA}), ("flow", {"mpfa", "rt0", "tpfa"}), ("along", {"mfd", "tpfa"}), ("twin", set(space.TWINS)),
                            ("law", {"constant", "cubic", "rough", "residual"}), ("solver", {"auto", "mumps", "belos"}), ("gravity", {True, False}),
                            ("steady", {True, False}), ("in_turn", {True, False}), ("crossings", {"none", "sealed", "filled"})):
            self.assertEqual({p[name] for p in all_of_them}, kinds)
        shapes = {fracture["shape"] for p in all_of_them for fracture in p["fractures"].values()}
        self.assertEqual(shapes, {"through", "polygon", "ending", "rectangle", "disc", "ellipse", "faces"})
        self.assertGreater(max(p["contrast"] for p in all_of_them), 1e9)
        counts = [len(p["fractures"]) for p in all_of_them]
        self.assertTrue(min(counts) >= 2 and max(counts) == 20)
        for p in all_of_them:
            self.assertTrue(not p["steady"] or any(kind == "pressure" for kind, _ in p["given"].values()))

    def test_polygons_lie_in_the_box_and_in_a_plane(self):
        for p in drawn(100):
            size = np.linalg.norm(p["high"] - p["low"])
            for fracture in p["fractures"].values():
                if "points" not in fracture["text"]:
                    continue
                points = np.array([[float(c) for c in re.findall(r"[-\d.e]+(?= m)", corner)] for corner in re.findall(r"\[([^\[\]]+)\]", fracture["text"])])
                self.assertTrue((points >= p["low"] - 1e-12 * size).all() and (points <= p["high"] + 1e-12 * size).all(), p["number"])
                self.assertLess(np.linalg.svd(points - points.mean(0))[1][-1], 1e-9 * size)

    def test_strike_is_clockwise_from_north_and_the_dip_to_its_right(self):
        along, down = space_fractures.along_strike_and_dip(90, 30)  # to the east; down to the south
        np.testing.assert_allclose(along, [1, 0, 0], atol=1e-15)
        np.testing.assert_allclose(down, [0, -math.cos(math.radians(30)), -0.5], atol=1e-15)

    def test_tensors_are_positive_definite(self):
        for p in drawn(100):
            for ratio, text in p["tensors"].values():
                values = {name: float(value) for name, value in re.findall(r"(\w\w): ([-\d.e]+) m\^2", text)}
                if "xx" in values:
                    x, y, z, xy, yz, xz = (values[name] for name in ("xx", "yy", "zz", "xy", "yz", "xz"))
                    eigen = np.linalg.eigvalsh([[x, xy, xz], [xy, y, yz], [xz, yz, z]])
                    self.assertAlmostEqual(eigen[-1] / eigen[0] / ratio, 1, 6)


if __name__ == "__main__":
    unittest.main()
