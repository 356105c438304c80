#!/usr/bin/python3
"""factors_along_fronts_test.py SPREKK [MPIEXEC]: stress intensity factors along the fronts of fractures in space (fine_fracture/jump_fit).

Closed forms for infinite rock: a circular crack of radius a under a pressure p + q x/a, tension and shear in general position has
K_I = 2 p (a/π)^½ + 4/3 q (a/π)^½ cos φ, K_II = 4 τ (a/π)^½ cos ψ/(2 − ν) and K_III = 4 (1 − ν) τ (a/π)^½ sin ψ/(2 − ν) (Kassir and Sih 1975);
closed and sliding it has the drop of stress in place of τ; an elliptical one has K_I = p (π b)^½ (sin² φ + b²/a² cos² φ)^¼/E(k) (Irwin 1962);
and a straight front has the factors of the plane.

Twins: mirrored, data that are disturbed by 1e-9, two processes, steps with two stages, a run that goes on after its checkpoint."""

import json
import unittest

import numpy as np

from circular_fault_test import FRICTION, POISSON, SIDES, YOUNG, normal_of, scene as fault, sheared
from scene_runs import SceneRuns, on_two_processes

PRESSURE, SLOPE = 6e6, 0.5e6  # Pa, of the fluid; the rock has 5 MPa across the disc and 3 MPa of shear
TENSION, SHEAR = 1e6, 3e6
ROOT = np.sqrt(1 / np.pi)
MIRROR = np.diag([-1, 1, 1])
COUPLERS = [{"type": "wall_traction", "between": ["rock", "conduit"]}, {"type": "two_level", "between": ["rock", "tips"]}]


def with_fronts(scene, **tips):
    scene["components"]["tips"] = {"type": "fine_fracture/jump_fit", **tips}
    return scene


def opened(size, strike, dip, stress, slope=(0, 0, 0), half=8):
    """The disc with a fluid whose pressure grows along `slope` (Pa/m) from its centre."""
    given = with_fronts(fault("second", size, strike, dip, stress))
    given["geometry"]["box"] = {axis: [f"-{half} m", f"{half} m"] for axis in "xyz"}
    pressure = " + ".join([repr(PRESSURE), *(f"({float(part)!r})*{axis}/m" for part, axis in zip(slope, "xyz"))])
    given["components"]["conduit"] = {"type": "fracture_flow/mfd", "viscosity": "1 mPa*s", "fluid_compressibility": "0 1/Pa", "initial_aperture": "1 mm",
                                      "prescribed": {"everywhere": {"pressure": f"({pressure}) Pa"}}}
    del given["components"]["contact"]
    given.update(couplers=COUPLERS, schedule=[{"solve": ["rock", "conduit"]}])
    return given


def ellipse(size):
    given = opened(size, 30, 40, np.diag([-5e6] * 3), half=10)
    given["geometry"]["fractures"]["disc"]["radius"] = ["2 m", "1 m"]
    return given


class Fronts(SceneRuns):
    def run_map(self, given, *settings, **how):
        return self.run_scene(self.write(json.dumps(given, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    @staticmethod
    def along(results):
        """Places on the fronts, their directions, and (K_I, K_II, K_III) there."""
        lines = results.fields(kind="fronts")
        ends = lines.points[lines.cells]
        return ends.mean(axis=1), ends[:, 1] - ends[:, 0], np.column_stack([lines[f"tips.K_{mode}"] for mode in ("I", "II", "III")])

    def factors(self, given, *settings, **how):
        return self.along(self.run_map(given, *settings, **how))[2]

    def assert_disc(self, results, stress, tension, shear, slope, within):
        """`tension`, `shear`: what the walls lose of them; of `stress` the direction counts. Errors are over the largest K_I and K_II."""
        places, along, found = self.along(results)
        ahead = places / np.linalg.norm(places, axis=1)[:, None]
        across = np.cross(along, ahead)  # towards the plus side
        across /= np.linalg.norm(across, axis=1)[:, None]
        along = np.cross(ahead, across)
        traction = across @ stress.T
        traction -= np.einsum("ij,ij->i", traction, across)[:, None] * across
        traction *= shear / np.linalg.norm(traction, axis=1)[:, None]
        exact = ROOT * np.column_stack([2 * tension + 4 / 3 * ahead @ slope,
                                        4 / (2 - POISSON) * np.einsum("ij,ij->i", traction, ahead),
                                        4 * (1 - POISSON) / (2 - POISSON) * np.einsum("ij,ij->i", traction, along)])
        scale = ROOT * np.array([2 * max(tension, 1), 4 * shear / (2 - POISSON), 4 * shear / (2 - POISSON)])
        errors = (found - exact) / scale
        mean, largest = np.sqrt((errors**2).mean(axis=0)), np.abs(errors).max(axis=0)
        print(f"{len(places)} edges: means {mean.round(4)}, largest {largest.round(4)}")
        for mode in range(3):
            if tension or mode:
                self.assertLess(mean[mode], within[0], mode)
                self.assertLess(largest[mode], within[1], mode)
        return found

    @staticmethod
    def slope_on(strike, dip):
        _, along, down = normal_of(strike, dip)
        return SLOPE * (0.6 * along + 0.8 * down)

    def test_a_disc_under_pressure_and_shear_has_its_factors(self):
        stress, slope = sheared(30, 40, 70), self.slope_on(30, 40)
        # Errors fall by a factor of three to four.
        for size, within in ((1 / 4, (0.02, 0.04)), (1 / 8, (0.006, 0.012))):
            results = self.run_map(opened(size, 30, 40, stress, slope))
            found = self.assert_disc(results, stress, TENSION, SHEAR, slope, within)
            row = results.rows[-1]
            self.assertEqual(row["tips.disc.K_I"], found[:, 0].max())
            for mode, name in ((1, "K_II"), (2, "K_III")):
                self.assertEqual(abs(row[f"tips.disc.{name}"]), np.abs(found[:, mode]).max())
            modulus, rigidity = YOUNG / (1 - POISSON**2), YOUNG / (2 * (1 + POISSON))
            release = ((found[:, :2]**2).sum(axis=1) / modulus + found[:, 2]**2 / (2 * rigidity)).max()
            self.assertLess(abs(row["tips.disc.energy_release_rate"] / release - 1), 1e-12)
            arc = results.fields(kind="fronts")["tips.arc"]
            self.assertTrue((np.diff(arc) > 0).all())
            self.assertLess(abs(arc[-1] / (2 * np.pi) * len(arc) / (len(arc) - 0.5) - 1), 0.03)

    def test_mirrored_it_has_them_too(self):
        """Through the plane x = 0: strike and rake turn round; meshes differ."""
        stress, slope = MIRROR @ sheared(30, 40, 70) @ MIRROR, MIRROR @ self.slope_on(30, 40)
        self.assert_disc(self.run_map(opened(1 / 4, 150, 40, stress, slope)), stress, TENSION, SHEAR, slope, (0.025, 0.05))

    def test_a_fault_that_slides_has_them(self):
        stress = sheared(30, 40, 70)
        given = with_fronts(fault("second", 1 / 4, 30, 40, stress))
        given["couplers"] = [given["couplers"][0], {"type": "two_level", "between": ["rock", "contact", "tips"]}]
        self.assert_disc(self.run_map(given), stress, 0, SHEAR - FRICTION * 5e6, np.zeros(3), (0.02, 0.03))

    def test_an_ellipse_has_irwins_factors(self):
        places, _, found = self.along(self.run_map(ellipse(1 / 5)))
        axes = np.linalg.svd(places, full_matrices=False)[2]
        angle = np.arctan2(places @ axes[1], places @ axes[0] / 2)
        quarter = np.linspace(0, np.pi / 2, 20001)
        values = np.sqrt(1 - 0.75 * np.sin(quarter)**2)
        integral = (values[1:] + values[:-1]).sum() / 2 * quarter[1]
        exact = TENSION * np.sqrt(np.pi) / integral * (np.sin(angle)**2 + np.cos(angle)**2 / 4)**0.25
        error = found[:, 0] / exact - 1
        print(f"ellipse: mean {np.sqrt((error**2).mean()):.4f}, largest {np.abs(error).max():.4f}")
        self.assertLess(np.sqrt((error**2).mean()), 0.008)
        self.assertLess(np.abs(error).max(), 0.03)
        self.assertLess(np.abs(found[:, 1:]).max(), 0.02 * exact.max())

    def test_twins(self):
        """A little more load, two stages, and a run that goes on: as much of everything, in two steps."""
        given = opened(1 / 3, 30, 40, sheared(30, 40, 70), half=4)
        given["time"] = {"end": "2 s", "step": "1 s"}
        whole = self.run_map(given)
        found = self.along(whole)[2]
        for name, settings, bound in (("disturbed", (f"components.rock.young_modulus={YOUNG * (1 + 1e-9)!r} Pa",), 1e-8),
                                      ("two stages", ("time.scheme=sdirk2",), 1e-9)):
            self.assertLess(np.abs(self.factors(given, *settings) - found).max(), bound * np.abs(found).max(), name)
        begun = self.run_map(given, "time.end=1 s")
        on = self.run_scene(self.write(json.dumps(given), "on.yaml"), restart=begun.folder)
        self.assertTrue(np.array_equal(self.along(on)[2], found))
        self.assert_same_bits(on, whole)

    @on_two_processes
    def test_two_processes_have_the_factors_of_one(self):
        given = opened(1 / 2, 30, 40, sheared(30, 40, 70), half=3)
        one, other = (self.factors(given, "mesh.division=scattered", processes=processes) for processes in (1, 2))
        self.assertLess(np.abs(one - other).max(), 1e-7 * np.abs(one).max())

    def test_straight_fronts_have_the_factors_of_a_plane(self):
        """A crack of ten cells across a slab between rollers: two fronts that end on sides."""
        def given(in_space):
            sides = {"left": {"displacement_x": "0 m"}, "right": {"traction": ["0.5 MPa", "1 MPa"]}, "bottom": {"displacement": ["0 m"] * 2}, "top": {"traction": ["1 MPa", "2 MPa"]}}
            points, box, cells = [["-0.5 m", "0 m"], ["0.5 m", "0 m"]], {"x": ["-1 m", "1 m"], "y": ["-1 m", "1 m"]}, [20, 20]
            if in_space:
                sides = {"left": {"displacement_x": "0 m"}, "right": {"traction": ["0.5 MPa", "0 Pa", "1 MPa"]}, "bottom": {"displacement": ["0 m"] * 3},
                         "top": {"traction": ["1 MPa", "0 Pa", "2 MPa"]}, "front": {"displacement_y": "0 m"}, "back": {"displacement_y": "0 m"}}
                points = [[x, y, "0 m"] for x, y in (("-0.5 m", "0 m"), ("0.5 m", "0 m"), ("0.5 m", "0.2 m"), ("-0.5 m", "0.2 m"))]
                box, cells = {"x": box["x"], "y": ["0 m", "0.2 m"], "z": box["y"]}, [20, 2, 20]
            flow = "mfd" if in_space else "tpfa"
            return with_fronts({"name": "slab", "geometry": {"box": box, "fractures": {"crack": {"points": points}}},
                                "mesh": {"kind": "structured", "cells": cells, "shape": "hexahedra" if in_space else "quadrilaterals"},
                                "components": {"rock": {"type": "poromechanics/fem", "order": "second", "young_modulus": f"{YOUNG} Pa", "poisson_ratio": POISSON,
                                                        "boundary": sides},
                                               "conduit": {"type": f"fracture_flow/{flow}", "viscosity": "1 mPa*s", "fluid_compressibility": "0 1/Pa",
                                                           "initial_aperture": "1 mm", "prescribed": {"everywhere": {"pressure": "0 Pa"}}}},
                                "couplers": COUPLERS, "schedule": [{"solve": ["rock", "conduit"]}], "time": {"end": "1 s", "step": "1 s"},
                                "output": {"fields": True}}, cells=3, leave_out=1)
        plane = self.run_map(given(False)).rows[-1]
        places, along, found = self.along(self.run_map(given(True)))
        scale = plane["tips.crack_last.K_I"]
        for end, sign in (("first", -1), ("last", 1)):
            here = sign * places[:, 0] > 0
            self.assertEqual(here.sum(), 2)
            self.assertLess(np.abs(found[here, 0] - plane[f"tips.crack_{end}.K_I"]).max(), 0.01 * scale)
            # Where the front runs along −y, its frame is that of the plane: x2 is z.
            turned = -np.sign(along[here, 1])
            self.assertLess(np.abs(turned * found[here, 1] - plane[f"tips.crack_{end}.K_II"]).max(), 0.01 * scale)
            self.assertLess(np.abs(found[here, 2]).max(), 1e-6 * scale)

    def test_refusals(self):
        given = opened(1 / 2, 30, 40, sheared(30, 40, 70), half=4)
        for change, words in (
                ({"rock": {**given["components"]["rock"], "order": "first"}}, ("do not tell the factors along fronts", "second order")),
                ({"rock": {key: value for key, value in given["components"]["rock"].items() if key != "order"} | {"type": "poromechanics/mpsa"}}, ("do not tell the factors along fronts", "4 cells")),
                ({"tips": {"type": "fine_fracture/quarter_point"}}, ("in a plane",))):
            answer = self.call("check", self.write(json.dumps({**given, "components": {**given["components"], **change}}), "refused.yaml"))
            self.assertEqual(answer.returncode, 2, answer.stderr)
            for word in words:
                self.assertIn(word, answer.stderr)
        growing = {**given, "schedule": [*given["schedule"], {"grow": "tips", "settle": ["rock"]}]}
        answer = self.call("check", self.write(json.dumps(growing), "growing.yaml"))
        self.assertEqual(answer.returncode, 2, answer.stderr)
        self.assertIn("fractures in space do not grow", answer.stderr)

    def test_coarse_fractures_have_a_note(self):
        notes = self.run_map(opened(1, 30, 40, sheared(30, 40, 70), half=4)).notes
        self.assertTrue([note for note in notes if "have the factors of one cell" in note], notes)


if __name__ == "__main__":
    unittest.main()
