#!/usr/bin/python3
"""near_tip.py: writes near_tip.csv, the opening at the tip of a fluid-driven fracture, between toughness and viscosity.

A semi-infinite crack, filled to its tip with a Newtonian fluid, moves steadily with the speed V in impermeable rock. s: distance from
the tip. K' = 4 sqrt(2/pi) K_IC, mu' = 12 mu. In units of length l = (K'^3/(E'^2 mu' V))^2 and of opening (K'/E') sqrt(l)

    w^2 dp/ds = 1,   w = sqrt(s) + int_0^inf H(s, r) dp/dr dr,   H = (4/pi) {2 sqrt(s r) + (s - r) ln((sqrt(s) + sqrt(r))/|sqrt(s) - sqrt(r)|)},

H being the limit at the tip of the kernel in kgd_self_similar.py (Garagash and Detournay 2000 have the same equation).
s -> 0: w = sqrt(s); s -> inf: w = 2^(1/3) 3^(5/6) s^(2/3).
"""
import math
import os

import numpy as np

SLOPE = 2 * 3**2.5  # of w^3 over s^2 where viscosity rules


class Tip:
    """w at nodes that are equidistant in ln s."""

    def __init__(self, step=0.1, first=1e-22, last=1e26):
        self.s = first * np.exp(step * np.arange(int(math.log(last / first) / step) + 1))
        s = self.s
        q = np.sqrt(s[:, None] / s[None, :])
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            small = 4 / 3 * q**3 + 4 / 15 * q**5
            below = 2 * q - (1 - q**2) * 2 * np.arctanh(np.where(q < 1, q, 0))
            above = 2 * q + (q**2 - 1) * 2 * np.arctanh(np.where(q > 1, 1 / q, 0))
        h = np.where(q < 1e-2, small, np.where(q < 1, below, np.where(q == 1, 2, above)))
        kernel = 4 / np.pi * h * s[None, :] * s[None, :] * step  # dr = r d ln r
        kernel[:, -1] *= 0.5
        # beyond the last node dp/dr ~ r^(-4/3) and H ~ (16/(3 pi)) s^(3/2)/sqrt(r)
        tail = 16 / (3 * np.pi) * s**1.5 * s[-1] ** 0.5 * 6 / 5
        w = (s**1.5 + SLOPE * s**2) ** (1 / 3)
        for _ in range(60):
            gradient = w**-2.0
            residual = (w - np.sqrt(s) - kernel @ gradient - tail * gradient[-1]) / w
            if np.abs(residual).max() < 1e-12:
                break
            derivative = kernel * (2 * gradient)
            derivative[:, -1] += tail * 2 * gradient[-1]
            w = w * np.exp(np.linalg.solve(np.eye(len(s)) + derivative / w[:, None], -residual))
        else:
            raise RuntimeError("no solution")
        self.w = w
        # the mean over (0, s): cells are exact for powers of s
        p = np.log(s[1:] * w[1:] / (s[:-1] * w[:-1])) / step
        parts = np.concatenate([[s[0] * w[0] / 1.5], (s[1:] * w[1:] - s[:-1] * w[:-1]) / p])
        self.mean = np.cumsum(parts) / s

    def at(self, s, values):
        return math.sqrt(s) * np.exp(np.interp(math.log(s), np.log(self.s), np.log(values / np.sqrt(self.s))))


def opening(s, toughness=1.0, viscosity=1.0):
    """w of the formula w^3 = a s^(3/2) + b s^2 with a = (K'/E')^3, b = 2 3^(5/2) mu' V/E'; given K'/E' and mu' V/E'."""
    return (toughness**3 * s**1.5 + SLOPE * viscosity * s**2) ** (1 / 3)


def closer(s, toughness=1.0, viscosity=1.0):
    """A closer formula: the coefficient of s^2 goes from 12 pi, which the expansion at small s has, to 2 3^(5/2)."""
    x = viscosity * np.sqrt(s) / toughness**3
    return toughness * np.sqrt(s) * (1 + x * (SLOPE + (12 * math.pi - SLOPE) / (1 + 70 * x))) ** (1 / 3)


def mean(h, toughness=1.0, viscosity=1.0):
    """Its mean over a tip cell (0, h), in closed form: with s = v^2 the integral is that of 2 v^2 (a + b v)^(1/3)."""
    a, b = toughness**3, SLOPE * viscosity
    x = b * math.sqrt(h) / a if a > 0 else math.inf
    if x < 0.05:  # a series where the closed form cancels
        series, term = 0.0, 1.0
        for k in range(14):
            series += term * 2 / (3 + k)
            term *= (1 / 3 - k) / (k + 1) * x
        return a ** (1 / 3) * math.sqrt(h) * series
    z = a + b * math.sqrt(h)
    def part(z):
        return 3 / 10 * z ** (10 / 3) - 6 / 7 * a * z ** (7 / 3) + 3 / 4 * a**2 * z ** (4 / 3)
    return 2 / b**3 * (part(z) - part(a)) / h


def speed(h, opened, toughness=1.0):
    """mu' V/E' from the mean opening of a tip cell; 0 if toughness alone opens it as far. Newton's method: the mean is concave in it."""
    if opened <= mean(h, toughness, 0.0) if toughness > 0 else opened <= 0:
        return 0.0
    value = (opened * 5 / 3) ** 3 / (SLOPE * h**2)  # as if viscosity alone: too fast
    for _ in range(200):
        f = mean(h, toughness, value) - opened
        slope = (mean(h, toughness, value * 1.0001) - mean(h, toughness, value)) / (1e-4 * value)
        new = value - f / slope
        new = max(new, value / 10)
        if abs(new - value) <= 1e-12 * value:
            return new
        value = new
    return value


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    fine, coarse = Tip(0.05), Tip(0.1)
    with open(os.path.join(folder, "near_tip.csv"), "w") as table:
        table.write("# tip between toughness and viscosity, units of near_tip.py: s, w, mean of w over (0, s), relative change of w with twice the step\n"
                    "s,opening,mean,change\n")
        for exponent in np.arange(-10, 6.01, 0.5):
            s = 10.0**exponent
            w = fine.at(s, fine.w)
            table.write(f"{s:.6g},{w:.7g},{fine.at(s, fine.mean):.7g},{abs(coarse.at(s, coarse.w) / w - 1):.1e}\n")


if __name__ == "__main__":
    main()
