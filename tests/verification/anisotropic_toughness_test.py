#!/usr/bin/python3
"""anisotropic_toughness_test.py SPREKK: growth in rock whose fracture energy depends on the direction of growth, G_c = G_0 (1 + A cos^2(theta - theta_0)):
a straight crack under pressure begins to grow where the largest G/G_c of a kink is 1, and turns to where that is largest; further on the condition of
Hakim and Karma (2009) for smooth cracks holds at its tip, and it is at its toughness. Also turned, mirrored and perturbed; strong anisotropy and rules
for isotropic rock are refused."""

import csv
import math
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns
from unstable_growth_test import CRACK, HALF_LENGTH, STRESS, TOUGHNESS

STRENGTH, ALONG = 0.6, 40  # A; degrees from the crack to theta_0


def published():
    """(degrees, F11, F21) of kinks, by boundary integrals; 0 to 75 degrees."""
    with open(ROOT / "tests/components/fine_fracture/reference/kinked_crack_Fij.csv", encoding="utf8") as file:
        rows = [[float(cell) for cell in row] for row in csv.reader(line for line in file if line[0] != "#")]
    return np.array([[0, 1, 0]] + [[row[0], row[1], row[3]] for row in rows if row[0] <= 75])


def factors(angle):
    """F11 and F21 (even and odd in the angle, rad) through the published values."""
    table = published()
    u = np.radians(table[:, 0]) ** 2
    even = np.polynomial.Polynomial.fit(u, table[:, 1], len(u) - 1)
    odd = np.polynomial.Polynomial.fit(u[1:], table[1:, 2] / np.radians(table[1:, 0]), len(u) - 2)
    return even(angle**2), angle * odd(angle**2)


def cost(angle, along=ALONG):
    """G_c over G_0 for growth at this angle (rad) from the crack."""
    return 1 + STRENGTH * np.cos(angle - math.radians(along)) ** 2


def scene(crack=30, along=ALONG, more=""):
    return CRACK.replace("angle: 30 deg", f"angle: {crack} deg").replace(
        "toughness: 0.7 MPa*m^0.5", f"toughness: 0.7 MPa*m^0.5\n    toughness_anisotropy: {{strength: {STRENGTH}, direction: {crack + along} deg}}").replace(
            "growth: {increment: 10 mm}", "growth: {increment: 2 mm, longest: 2 mm, direction_tolerance: 1e-3}").replace("reaches: 60 mm", "reaches: 1 mm").replace(
                "(10.9 + t/36000)", "(10.9 + t/72000)").replace("end: 6 h", "end: 40 h").replace("step: 1 h", "step: 15 min") + more


class AnisotropicToughness(SceneRuns):
    timeout = 300

    def first_growth(self, crack=30, along=ALONG, factor=1.0):
        """(net pressure over the critical one of G_0, angles of both tips from the crack, rad) of the first growth."""
        run = self.run_scene(self.write(scene(crack, along).replace("young_modulus: 40 GPa", f"young_modulus: {40 * factor!r} GPa")))
        grown = max(run["tips.main_last.length[m]"][-1], run["tips.main_first.length[m]"][-1])
        self.assertGreater(grown, 0)
        net = (run["fracture_pressure[Pa]"][-1] - STRESS) * math.sqrt(math.pi * HALF_LENGTH) / TOUGHNESS
        ahead = np.array([math.cos(math.radians(crack)), math.sin(math.radians(crack))])
        angles = []
        for tip, sign in (("last", 1), ("first", -1)):
            way = np.array([run[f"tips.main_{tip}.{axis}[m]"][-1] for axis in "xy"]) - sign * HALF_LENGTH * ahead
            angles.append(math.atan2(ahead[0] * way[1] - ahead[1] * way[0], ahead @ way * 1) if sign > 0 else
                          math.atan2(-ahead[0] * way[1] + ahead[1] * way[0], -ahead @ way))
        return net, angles

    def test_first_growth(self):
        kinks = np.linspace(-1.2, 1.2, 24001)
        f11, f21 = factors(kinks)
        load = math.sqrt(((f11**2 + f21**2) / cost(kinks)).max())  # of K_IC across theta_0, under a net pressure of one
        # Behind an infinitesimal kink straight growth is the best: d ln G = -2 k1 k2/(k1^2 + k2^2) is d ln G_c.
        slope = -STRENGTH * np.sin(2 * (kinks - math.radians(ALONG))) / cost(kinks)
        misfit = -2 * f11 * f21 / (f11**2 + f21**2) - slope
        right = kinks[np.flatnonzero(np.diff(np.sign(misfit)))[0]]
        self.assertGreater(abs(right), math.radians(8))
        for settings in ({}, {"crack": 75}, {"crack": -30}, {"factor": 1 + 1e-9}):
            with self.subTest(**settings):
                net, angles = self.first_growth(**settings)
                self.assertAlmostEqual(net * load, 1, delta=0.02)
                for angle in angles:
                    self.assertAlmostEqual(math.degrees(angle), math.degrees(right), delta=0.5)
        mirrored = self.first_growth(crack=-30, along=-ALONG)[1]
        for angle in mirrored:
            self.assertAlmostEqual(math.degrees(angle), -math.degrees(right), delta=0.5)

    def test_what_has_no_meaning_is_refused(self):
        for old, new, message in ((f"strength: {STRENGTH}", "strength: 1", "paths zigzag"), (f"strength: {STRENGTH}", "strength: -0.5", "paths zigzag"),
                                  ("{increment: 2 mm", "{direction: largest_release, increment: 2 mm", "those of isotropic rock"),
                                  ("{increment: 2 mm", "{direction: explicit, increment: 2 mm", "those of isotropic rock")):
            answer = self.call(["check"], self.write(scene().replace(old, new).replace("within_step", "after_step")))
            self.assertEqual(answer.returncode, 2, new)
            self.assertIn(message, answer.stderr)


if __name__ == "__main__":
    unittest.main()
