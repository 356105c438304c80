#!/usr/bin/python3
"""kgd_lag.py: writes kgd_lag.csv, the KGD fracture whose fluid lags behind its tips.

As kgd_self_similar.py, whose scaling it has, but the pressure of the fluid cannot fall below the stress of the rock at rest (p = 0
here): the fluid reaches to xi_f, and beyond it the fracture is empty, Pi = 0. It is the solution of a fracture at early times (Garagash,
Int. J. Solids Struct. 43 (2006) 5811), and does not depend on time either. With Omega = gamma W:

    -W^3 dPi/dxi = int_xi^xi_f W + (2/3) xi W  (xi < xi_f),   W -> k sqrt(1 - xi),  Pi(1) = 0,   2 gamma^2 int_0^xi_f W = 1.

For a front xi_f the toughness is found for which Pi(1) = 0, by bisection in k, and W for each k by Newton's method. The fluid is at
xi_f with a pressure gradient that is finite: the trapezoidal rule over y, xi = xi_f/(1 + exp(-y)), is accurate.
"""
import os

import numpy as np

from kgd_self_similar import Kgd

KS = (0.5, 0.75, 1.0)


class Lag:
    def __init__(self, front, step):
        self.h, y = step, np.arange(-16, 16 + step / 2, step)
        share, rest = 1 / (1 + np.exp(-y)), 1 / (1 + np.exp(y))
        self.xi, self.rest, self.slope = front * share, (1 - front) + front * rest, front * share * rest
        self.cos = np.sqrt(self.rest * (1 + self.xi))
        self.kernel = Kgd.opening_of_steps(self) * (self.slope * step)
        n = len(y)
        cells = np.zeros((n, n))
        for i in range(1, n - 2):
            cells[i, i - 1:i + 3] = step / 24 * np.array([-1, 13, 13, -1])
        cells[0, :2] = cells[n - 2, n - 2:] = step / 2
        self.to_front = np.cumsum(cells[::-1], axis=0)[::-1] * self.slope
        self.balance = self.to_front + np.diag(2 / 3 * self.xi)

    def pressure_at_tip(self, k):
        r = self.cos**2 / 2
        w = (k**3 * r**1.5 + 4 * 3**1.5 * r**2) ** (1 / 3)
        for _ in range(80):
            g = w**-3 * (self.balance @ w)
            residual = (w - k / np.sqrt(2) * self.cos - self.kernel @ g) / w
            if np.abs(residual).max() < 1e-11:
                break
            derivative = -self.kernel @ (w[:, None] ** -3 * self.balance - np.diag(3 * g / w)) * w
            w *= np.exp(np.clip(np.linalg.solve(np.eye(len(w)) + derivative / w[:, None], -residual), -1, 1))
        else:
            raise RuntimeError(f"no solution for k = {k}")
        self.gamma = (2 * (self.to_front @ w)[0]) ** -0.5
        self.toughness, self.opening = k * np.sqrt(self.gamma), self.gamma * w[0]
        fall = g * self.slope * self.h
        at_tip = k / (4 * np.sqrt(2)) - fall @ (2 / np.pi * np.arctan2(self.xi, self.cos))
        self.pressure = at_tip + fall.sum()
        return at_tip


def halved(low, high, is_low, times=36):
    for _ in range(times):
        middle = (low + high) / 2
        low, high = (middle, high) if is_low(middle) else (low, middle)
    return (low + high) / 2


def with_front(front, step):
    lag = Lag(front, step)
    halved(0.0, 20.0, lambda k: lag.pressure_at_tip(k) < 0)
    return lag


def reach(toughness, step):
    """(xi_f, gamma, Omega(0), Pi(0))."""
    front = halved(0.3, 0.97, lambda front: with_front(front, step).toughness < toughness, 26)
    lag = with_front(front, step)
    return np.array([front, lag.gamma, lag.opening, lag.pressure])


def main():
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "kgd_lag.csv"), "w") as table:
        table.write("# KGD fracture with a lag at the stress of the rock at rest (kgd_lag.py): K, xi_f, gamma, Omega(0), Pi(0), largest relative\n"
                    "# change of the four with twice the step of the quadrature\nK,front,gamma,opening,pressure,change\n")
        for k in KS:
            coarse, fine = reach(k, 0.2), reach(k, 0.1)
            table.write(f"{k:g}," + ",".join(f"{v:.7g}" for v in fine) + f",{np.abs(coarse / fine - 1).max():.1e}\n")


if __name__ == "__main__":
    main()
