#!/usr/bin/python3
"""The reference solutions of this folder against closed forms and published values, and their tables against coarser computations."""
import csv
import math
import os
import unittest

import numpy as np

import kgd_leak_off
import near_tip
import porous_convection
import rate_and_state
import sealed_wings
from kgd_self_similar import Kgd

FOLDER = os.path.dirname(os.path.abspath(__file__))


def table(name):
    with open(os.path.join(FOLDER, name)) as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return [{key: value if key == "scene" else float(value) for key, value in row.items()} for row in rows]


class SealedWings(unittest.TestCase):
    coarse = sealed_wings.Mesh(order=4, levels=5, contact_levels=3, wing_order=3, wing_levels=0)

    def test_factors_of_short_kinks(self):
        # F_ij of Amestoy and Leblond, Int. J. Solids Struct. 29 (1992) 465, at 30, 60 and 70.53 degrees. The next term of k grows
        # with the root of the kink's length.
        known = {30: (0.90174, -0.72984, 0.24025, 0.79716), 60: (0.65567, -1.16799, 0.36925, 0.30787),
                 70.53: (0.55436, -1.22332, 0.37811, 0.11769)}
        for angle, factors in known.items():
            found = []
            # sigma_yy = 1; and sigma_xx = 1, sigma_yy = -1, seen from a fracture at 45 degrees, where sigma_nt = -1
            for fracture, stress in ((0, (0, 1)), (45, (1, -1))):
                wings = sealed_wings.Wings(fracture, stress=stress, mesh=sealed_wings.Mesh(levels=14))
                kink = np.exp(1j * math.radians(fracture + angle))
                k = [wings.solve(wings.kink + length * kink, sealed_wings.HALF) for length in (4e-6, 1e-6)]
                found.append([(2 * k[1].opening_factor[0] - k[0].opening_factor[0]),
                              (2 * k[1].shear_factor[0] - k[0].shear_factor[0])] / np.sqrt(np.pi * sealed_wings.HALF))
            (f11, f21), (f12, f22) = found
            for value, expected in zip((f11, -f12, f21, -f22), factors):
                self.assertAlmostEqual(value, expected, delta=1e-3, msg=f"{angle} {found}")

    def test_dry_wings(self):
        # Wings along the only stress, -1, of a fracture at 45 degrees with the friction 0.3, no fluid: K_I/sqrt(pi b), by others.
        # K_I = K_IC at p = 0 if K_IC is what p = 0 gives.
        friction, toughness = sealed_wings.FRICTION, sealed_wings.TOUGHNESS
        try:
            sealed_wings.FRICTION = 0.3
            for share, known in ((0.01, 0.30466), (0.1, 0.24689), (1, 0.13885)):
                wings = sealed_wings.Wings(45, stress=(-1, 0), dilation=0)
                end = wings.kink + share * sealed_wings.HALF

                def gap(exponent):
                    sealed_wings.TOUGHNESS = wings.solve(end, sealed_wings.HALF * 10**exponent).opening_factor[0]
                    return wings.solve(end, sealed_wings.HALF * 10**exponent)

                low, high = -4.0, -1.0
                while high - low > 0.05:
                    middle = (low + high) / 2
                    low, high = (middle, high) if gap(middle).edge > 0 else (low, middle)
                found = gap(low).opening_factor[0] / np.sqrt(np.pi * sealed_wings.HALF)
                self.assertAlmostEqual(found, known, delta=1e-4)
        finally:
            sealed_wings.FRICTION, sealed_wings.TOUGHNESS = friction, toughness

    def test_onset(self):
        pressure, turn = sealed_wings.scene("45").onset()
        # 5 MPa - 0.5 (15 MPa - p) = 0.601 MPa m^0.5/sqrt(pi b) (1 + 0.5 tan psi); docs/numerics/growth.md
        self.assertAlmostEqual(pressure, 8.06, delta=0.005)
        self.assertAlmostEqual(turn, -70.20, delta=0.01)

    def test_table_is_that_of_a_coarser_mesh(self):
        rows = [row for row in table("sealed_wings.csv") if row["scene"] == "45" and row["increment_m"] == 0.01]
        wings = sealed_wings.scene("45", self.coarse)
        found = list(sealed_wings.growth(wings, (0.01, 0.02, 0.03), (1e-3, 5e-3)))
        for values in found:
            row = next(row for row in rows if abs(row["length_m"] - values[0]) < 1e-9)
            self.assertLess(abs(values[1] / row["pressure_MPa"] - 1), 2e-4)
            self.assertLess(abs(values[2] - row["direction_deg"]), 0.02)
            self.assertLess(abs(values[5] / row["volume_m2"] - 1), 1e-3)

    def test_rotated_with_the_stresses(self):
        rows = {}
        for row in table("sealed_wings.csv"):
            rows.setdefault((row["scene"], row["increment_m"]), []).append(row)
        plain, rotated = rows["45", 0.01], rows["rotated", 0.01]
        self.assertEqual(len(plain), len(rotated))
        for a, b in zip(plain, rotated):
            self.assertLess(abs(a["pressure_MPa"] / b["pressure_MPa"] - 1), 1e-6)
            end = (a["x_m"] + 1j * a["y_m"]) * np.exp(1j * math.pi / 6)
            self.assertLess(abs(end - b["x_m"] - 1j * b["y_m"]), 1e-6)

    def test_slip_never_turns_back_and_increments_converge(self):
        rows = table("sealed_wings.csv")
        self.assertEqual(max(row["slip_back"] for row in rows), 0)
        pressure = {(row["increment_m"], round(row["length_m"], 6)): row["pressure_MPa"] for row in rows if row["scene"] in ("45", "limit")}
        for length in (0.01, 0.02, 0.04, 0.1):
            ten, five, half, limit = (pressure[increment, length] for increment in (0.01, 0.005, 0.0025, 0))
            self.assertLess(abs(five / limit - 1), 0.7 * abs(ten / limit - 1))
            self.assertLess(abs(half / limit - 1), 0.7 * abs(five / limit - 1))


class KgdFracture(unittest.TestCase):
    grid = Kgd(0.4)

    def test_kernel(self):
        # (1 - xi^2)^(3/2) has the pressure (3/4)(1/2 - xi^2), so g = 1.5 xi.
        g = Kgd(0.2)
        found = g.kernel @ (1.5 * g.xi)
        np.testing.assert_allclose(found[g.y < 20], (g.cos**3)[g.y < 20], rtol=2e-4)

    def test_viscosity(self):
        # Adachi and Detournay, Int. J. Numer. Anal. Meth. Geomech. 26 (2002) 579, have 0.6152 from a short series.
        self.grid.reach(0)
        self.assertAlmostEqual(self.grid.gamma / 0.6152, 1, delta=1e-3)
        # at the tip W = (2 3^(5/2) 2/3)^(1/3) (1 - xi)^(2/3), as V = (2/3) l/t
        n = self.grid.unknowns - 10
        self.assertAlmostEqual(self.grid.opening[n] / self.grid.rest[n] ** (2 / 3), (4 * 3**1.5) ** (1 / 3), delta=1e-3)

    def test_toughness(self):
        for k in (8, 30):
            self.grid.reach(k)
            opening, pressure = self.grid.at([0.0])
            length = (2 * math.sqrt(2) / math.pi / k) ** (2 / 3)
            self.assertAlmostEqual(self.grid.gamma / length, 1, delta=5 / k**4)
            self.assertAlmostEqual(opening[0] / (k * math.sqrt(length / 2)), 1, delta=5 / k**4)
            self.assertAlmostEqual(pressure[0] / (k / (4 * math.sqrt(2 * length))), 1, delta=10 / k**4)

    def test_table(self):
        for row in table("kgd_self_similar.csv"):
            self.grid.reach(row["K"])
            opening, pressure = self.grid.at([0.0])
            for value, expected in ((self.grid.gamma, row["gamma"]), (opening[0], row["opening"]), (pressure[0], row["pressure"])):
                self.assertAlmostEqual(value / expected, 1, delta=5e-5)
            self.assertLess(row["change"], 1e-5)

    def test_small_toughness(self):
        # Garagash and Detournay, J. Appl. Mech. 72 (2005) 916: the correction has the power 4 - 6 0.1387 = 3.17 of K.
        gamma = {row["K"]: row["gamma"] for row in table("kgd_self_similar.csv")}
        power = math.log((gamma[0] - gamma[0.5]) / (gamma[0] - gamma[0.25])) / math.log(2)
        self.assertAlmostEqual(power, 3.17, delta=0.1)


class LeakOff(unittest.TestCase):
    def test_little_and_much(self):
        rows = table("kgd_leak_off.csv")
        tau, length = rows[0]["tau"], rows[0]["toughness_lambda"]
        # lambda^(3/2) = tau - B tau^(7/6) + …, B = Beta(5/3, 1/2)
        beta = math.gamma(5 / 3) * math.gamma(1 / 2) / math.gamma(13 / 6)
        self.assertAlmostEqual(length / tau ** (2 / 3), 1 - 2 / 3 * beta * tau ** (1 / 6), delta=0.6 * beta**2 * tau ** (1 / 3))
        for name in "toughness_lambda", "viscosity_lambda":
            x = rows[-1][name] / math.sqrt(rows[-1]["tau"]) * math.pi / 2
            self.assertLess(x, 1)
            self.assertGreater(x, 0.9)

    def test_viscosity_and_much_leak_off(self):
        # The tip of the limit is w ~ (1 - xi)^(5/8).
        viscosity = kgd_leak_off.Viscosity(0.5, 0.4)
        w, gradient = viscosity.limit()
        g = viscosity.grid
        y = (g.y > 25) & (g.y < 35)
        power = np.polyfit(np.log(g.rest[y]), np.log(w[y]), 1)[0]
        self.assertAlmostEqual(power, 5 / 8, delta=1e-3)
        last = table("kgd_leak_off.csv")[-1]
        self.assertAlmostEqual(last["shape"] / (2 * (g.to_tip[0] @ w)), 1, delta=2e-3)
        self.assertAlmostEqual(last["opening"] / w[0], 1, delta=2e-3)

    def test_table(self):
        rows = table("kgd_leak_off.csv")
        for i, value in enumerate(kgd_leak_off.toughness_table(20)[4:]):
            self.assertAlmostEqual(value / rows[i]["toughness_lambda"], 1, delta=1e-3)
        for i, values in enumerate(kgd_leak_off.viscosity_table(6, 6)[4:]):
            self.assertAlmostEqual(values[0] / rows[i]["viscosity_lambda"], 1, delta=2e-3)
        self.assertLess(max(row["toughness_change"] for row in rows), 1e-3)
        self.assertLess(max(row["viscosity_change"] for row in rows), 1e-3)


class NearTip(unittest.TestCase):
    tip = near_tip.Tip(0.2)

    def test_ends_and_table(self):
        # w^3 = s^(3/2) + 12 pi s^2 + … for small s; 2 3^(5/2) s^2 for large s
        for row in table("near_tip.csv"):
            s, w = row["s"], row["opening"]
            self.assertAlmostEqual(self.tip.at(s, self.tip.w) / w, 1, delta=2e-4)
            self.assertAlmostEqual(self.tip.at(s, self.tip.mean) / row["mean"], 1, delta=4e-4)
            if s < 1e-7:
                self.assertAlmostEqual((w**3 / s**1.5 - 1) / math.sqrt(s) / (12 * math.pi), 1, delta=0.03)
            if s > 1e4:
                self.assertAlmostEqual(w / (near_tip.SLOPE * s**2) ** (1 / 3), 1, delta=1e-4)
            self.assertLess(abs(near_tip.opening(s) / w - 1), 0.0115)
            self.assertLess(abs(near_tip.closer(s) / w - 1), 0.0015)

    def test_mean_and_its_inverse(self):
        x, weight = np.polynomial.legendre.leggauss(60)
        v = (x + 1) / 2
        for toughness in (0.0, 0.3, 1.0):
            for viscosity in (1e-6, 1e-3, 1.0, 1e3):
                h = 0.7
                s = h * v**2
                quadrature = np.sum(weight / 2 * 2 * v * near_tip.opening(s, toughness, viscosity))
                mean = near_tip.mean(h, toughness, viscosity)
                self.assertAlmostEqual(mean / quadrature, 1, delta=1e-6)
                self.assertAlmostEqual(near_tip.speed(h, mean, toughness) / viscosity, 1, delta=1e-6)
        self.assertEqual(near_tip.speed(0.7, 0.1, 1.0), 0)


class RateAndState(unittest.TestCase):
    def test_integrator_is_of_its_order(self):
        errors = []
        for tolerance in (1e-6, 1e-9):
            for now, y in rate_and_state.integrate(lambda t, y: -2 * t * y, np.array((1.0,)), 0.0, 2.0, lambda e, t=tolerance: abs(e[0]) / t):
                pass
            errors.append(abs(y[0] - math.exp(-4)))
            self.assertEqual(now, 2.0)
            self.assertLess(errors[-1], 20 * tolerance)
        self.assertLess(errors[1], 1e-2 * errors[0])

    def test_slip_of_a_crack(self):
        # A uniform drop of stress over 2 c: slip 2 (1 - nu)/G drop sqrt(c^2 - x^2).
        errors = []
        for cells in (50, 100):
            fault = rate_and_state.Fault(cells, rate_and_state.Friction(**rate_and_state.NUCLEATION), 0.0)
            slip = np.linalg.solve(fault.stress, np.full(cells, -1e6)) * fault.friction.distance
            half = rate_and_state.FAULT_LENGTH / 2
            exact = 2e6 / rate_and_state.SHEAR_OVER * np.sqrt(half**2 - fault.x**2)
            errors.append(np.abs(slip - exact)[cells // 4:-cells // 4].max() / exact.max())
        self.assertLess(errors[1], 0.012)
        self.assertAlmostEqual(math.log2(errors[0] / errors[1]), 1, delta=0.2)

    def test_steady_slip_stays_and_stiffness_decides(self):
        # Steady slip is stable above k = N (b - a)/L, and not below it (Ruina 1983).
        friction = rate_and_state.Friction(**rate_and_state.FAULT)
        critical = friction.normal * (friction.b - friction.a) / friction.distance
        theta = friction.distance / 1e-6
        start = float(friction.traction(1e-6, theta))
        for share, grows in ((1.1, False), (0.9, True)):
            block = rate_and_state.Slider(friction, share * critical, start * (1 + 1e-6), lambda t: 1e-6 * t)
            away = np.abs(np.log(block.run(theta, 3e3)[:, 3] / 1e-6))
            third = len(away) // 3
            self.assertEqual(away[-third:].max() > away[third:2 * third].max(), grows)

    def test_tables(self):
        found = rate_and_state.events(rate_and_state.slider(tolerance=1e-6, end=1.1e7), 1e-3)
        for event, row in zip(found, table("rate_and_state.csv")):
            self.assertAlmostEqual(event[0] / row["begin_s"], 1, delta=1e-6)
            self.assertAlmostEqual(event[1] / row["peak_slip_rate_m_s"], 1, delta=1e-3)
        for row in table("velocity_step.csv"):
            self.assertLess(abs(row["traction_change"]), 1e-9)
        last = table("fault_nucleation.csv")[-1]["extrapolated_s"]
        coarse = [rate_and_state.events(rate_and_state.nucleation(cells, 1e-6)[0], 1e-3)[0, 0] for cells in (50, 100)]
        self.assertAlmostEqual((2 * coarse[1] - coarse[0]) / last, 1, delta=1e-4)


class PorousConvection(unittest.TestCase):
    def test_table(self):
        with open(os.path.join(FOLDER, "porous_convection.csv")) as lines:
            rows = [[float(value) for value in line.split(",")] for line in lines if not line.startswith("#")]
        # Walker and Homsy, J. Fluid Mech. 87 (1978) 449, from the side; Caltagirone, J. Fluid Mech. 72 (1975) 269, from below.
        published = {(1, 100): (3.097, 0.015), (0, 50): (1.45, 0.005), (0, 100): (2.651, 0.01), (0, 200): (3.813, 0.01)}
        for side, rayleigh, value in rows:
            if (side, rayleigh) in published:
                known, bound = published[side, rayleigh]
                self.assertAlmostEqual(value, known, delta=bound)
            if rayleigh <= 100:
                coarser = porous_convection.nusselt("side" if side else "bottom", rayleigh, 13)
                self.assertAlmostEqual(value, coarser, delta=3e-3 * value)

    def test_conduction(self):
        self.assertAlmostEqual(porous_convection.nusselt("side", 1e-9, 8), 1, delta=1e-12)
        # Weak convection: the Nusselt number is 1 plus a multiple of Ra^2.
        excess = [porous_convection.nusselt("side", rayleigh, 12) - 1 for rayleigh in (0.5, 1)]
        self.assertAlmostEqual(excess[1] / excess[0], 4, delta=0.02)


if __name__ == "__main__":
    unittest.main()
