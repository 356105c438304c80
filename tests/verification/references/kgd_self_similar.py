#!/usr/bin/python3
"""kgd_self_similar.py: writes kgd_self_similar.csv and kgd_profiles.csv, the KGD fracture from viscosity to toughness.

Plane strain, a Newtonian fluid that fills the fracture to its tips, impermeable rock, injected into the middle of a fracture of
half-length l(t) at the constant rate Q: of the whole fracture, both wings. E' = E/(1 - nu^2), mu' = 12 mu, K' = 4 sqrt(2/pi) K_IC.

    l = gamma L,  w = eps L Omega(xi),  p = eps E' Pi(xi),  xi = x/l,   L = (E' Q^3 t^4/mu')^(1/6),  eps = (mu'/(E' t))^(1/3)
    K = K'/(E'^3 mu' Q)^(1/4) does not depend on time, and neither do gamma, Omega, Pi.

With Omega = gamma W: volume balance between xi and the tip, elasticity and tip,

    -W^3 dPi/dxi = int_xi^1 W + (2/3) xi W,   Pi = (1/4 pi) PV int_-1^1 W'(s)/(xi - s) ds,   W -> k sqrt(1 - xi),  k = K/sqrt(gamma),
    2 gamma^2 int_0^1 W = 1.

Elasticity is inverted: W = k sqrt((1 - xi^2)/2) + int_0^1 g(s) H(xi, s) ds with g = -dPi/ds, and H the opening, with K_I = 0, from the
pressure [|x| < s] - (2/pi) asin(s). With xi = sin a, s = sin b

    H = (4/pi) { sin b ln((cos b + cos a)/|cos b - cos a|) - sin a ln(sin(a + b)/|sin(a - b)|) }.

With s = 1/(1 + exp(-y)) the trapezoidal rule is accurate: W and g are not smooth at the well either, where the flow turns. W is unknown
up to y = 26, 1 - xi = 1e-11; from there to 1e-36 it goes on like the tip solution W^3 ~ k^3 r^(3/2) + 2 3^(5/2) (2/3) r^2, r = 1 - xi.
Newton's method.
"""
import os

import numpy as np

KS = (0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)


class Kgd:
    def __init__(self, step=0.1, start=-16.0, unknown=26.0, end=84.0):
        self.h, self.unknowns = step, int((unknown - start) / step)
        self.y = start + step * np.arange(int((end - start) / step))
        self.xi, self.rest = 1 / (1 + np.exp(-self.y)), 1 / (1 + np.exp(self.y))  # xi, 1 - xi
        self.slope = self.xi * self.rest  # d xi/dy
        self.cos = np.sqrt(self.rest * (1 + self.xi))
        self.kernel = self.opening_of_steps() * (self.slope * step)
        cells = self.cells()
        self.to_tip = np.cumsum(cells[::-1], axis=0)[::-1] * self.slope
        self.balance = self.to_tip + np.diag(2 / 3 * self.xi)

    def opening_of_steps(self):
        """H without cancellation near the tip."""
        sa, sb = self.xi[:, None], self.xi[None, :]
        ca, cb = self.cos[:, None], self.cos[None, :]
        difference = self.rest[:, None] - self.rest[None, :]  # sin b - sin a
        both = sa * cb + ca * sb
        with np.errstate(divide="ignore", invalid="ignore"):
            first = sb * np.log1p(2 * ca * cb * (ca + cb) / ((sa + sb) * both))
            second = np.where(difference == 0, 0, difference * np.log(both**2 / (np.abs(difference) * (sa + sb))))
        return 4 / np.pi * (first + second)

    def cells(self):
        """Row i: the integral over y from node i to the next one, of fourth order; the last one: beyond, of what falls with exp(-5/3 y)."""
        n, h = len(self.y), self.h
        cells = np.zeros((n, n))
        for i in range(1, n - 2):
            cells[i, i - 1:i + 3] = h / 24 * np.array([-1, 13, 13, -1])
        cells[0, :2] = cells[n - 2, n - 2:] = h / 2
        cells[n - 1, n - 1] = 3 / 5
        return cells

    def solve(self, k):
        """W for this k, beginning with w^3 = k^3 s^(3/2) + 2 3^(5/2) (2/3) s^2, s = (1 - xi^2)/2: the tip solution."""
        n, r = self.unknowns, self.cos**2 / 2
        w = (k**3 * r**1.5 + 4 * 3**1.5 * r**2) ** (1 / 3)
        follow = w[n:] / w[n - 1]
        for _ in range(50):
            inverse = w**-3.0
            g = inverse * (self.balance @ w)
            residual = (w - k / np.sqrt(2) * self.cos - self.kernel @ g)[:n] / w[:n]
            if np.abs(residual).max() < 1e-11:
                break
            derivative = -self.kernel[:n] @ (inverse[:, None] * self.balance - np.diag(3 * g / w)) * w
            derivative[:, n - 1] += derivative[:, n:].sum(axis=1)
            derivative = np.eye(n) + derivative[:, :n] / w[:n, None]
            w[:n] *= np.exp(np.clip(np.linalg.solve(derivative, -residual), -1, 1))
            w[n:] = w[n - 1] * follow
        else:
            raise RuntimeError(f"no solution for k = {k}")
        self.opening, self.gradient, self.k = w, g, k
        self.gamma = (2 * (self.to_tip @ w)[0]) ** -0.5
        return k * np.sqrt(self.gamma)  # K

    def reach(self, toughness):
        """The solution for this K."""
        if toughness == 0:
            return self.solve(0.0)
        a = toughness / np.sqrt(0.6)
        fa = self.solve(a) - toughness
        b = a * 1.01
        for _ in range(30):
            fb = self.solve(b) - toughness
            if abs(fb) < 1e-9:
                return toughness + fb
            a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
        raise RuntimeError("no solution")

    def pressure(self):
        """Pi."""
        f = self.gradient * self.slope
        share = 2 / np.pi * np.arctan2(self.xi, self.cos)  # (2/pi) asin
        cells = self.cells()
        cells[-1] = 0
        ahead = np.cumsum((cells @ (f * (1 - share)))[::-1])[::-1]
        behind = np.concatenate([[0], np.cumsum(cells @ (f * share))[:-1]])
        return self.k / (4 * np.sqrt(2)) + ahead - behind

    def at(self, xi):
        """Omega and Pi there; 0 is the first node, at 1e-7."""
        xi = np.asarray(xi)
        y = np.log(np.maximum(xi, self.xi[0]) / (1 - xi))
        return self.gamma * np.exp(_cubic(self.y, np.log(self.opening), y)), _cubic(self.y, self.pressure(), y)


def _cubic(grid, values, y):
    """Interpolation by cubic polynomials of four nodes."""
    result = []
    for v in np.atleast_1d(y):
        x = (v - grid[0]) / (grid[1] - grid[0])
        points = min(max(int(x) - 1, 0), len(grid) - 4) + np.arange(4)
        weight = [np.prod([(x - points[m]) / (points[j] - points[m]) for m in range(4) if m != j]) for j in range(4)]
        result.append(np.dot(weight, values[points]))
    return np.array(result)


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    places = np.array([0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99])
    fine, coarse = Kgd(0.1), Kgd(0.2)
    with open(os.path.join(folder, "kgd_self_similar.csv"), "w") as table, open(os.path.join(folder, "kgd_profiles.csv"), "w") as profiles:
        table.write("# KGD fracture, scaling of kgd_self_similar.py (Q of both wings): K, gamma, Omega(0), Pi(0), largest relative change of the three\n"
                    "# with twice the step of the quadrature\nK,gamma,opening,pressure,change\n")
        profiles.write("# KGD fracture, scaling of kgd_self_similar.py: K, xi = x/l, Omega, Pi\nK,xi,opening,pressure\n")
        for k in KS:
            rows = []
            for kgd in coarse, fine:
                kgd.reach(k)
                opening, pressure = kgd.at(places)
                rows.append(np.array([kgd.gamma, opening[0], pressure[0]]))
            change = np.abs(rows[0] / rows[1] - 1).max()
            table.write(f"{k:g}," + ",".join(f"{v:.7g}" for v in rows[1]) + f",{change:.1e}\n")
            for values in zip(places, opening, pressure):
                profiles.write(f"{k:g}," + ",".join(f"{v:.7g}" for v in values) + "\n")


if __name__ == "__main__":
    main()
