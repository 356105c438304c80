#!/usr/bin/python3
"""kgd_leak_off.py: writes kgd_leak_off.csv, the KGD fracture with Carter's leak-off, where toughness or viscosity rules.

Plane strain, constant rate Q of both wings, leak-off C'/sqrt(t - t0(x)) from both walls together, C' = 2 C_L, t0 the time at which the tip
passed x. The opened volume is a l^(3/2) times `shape`, with

    toughness:  a = 2 sqrt(pi) K_IC/E',     shape = 1
    viscosity:  a = (mu' Q/E')^(1/4),       shape = 2 int_0^1 W,   w = a sqrt(l) W(xi),  p = E' a/sqrt(l) Pi(xi),  mu' = 12 mu

and the volume of fluid is Q t = a l^(3/2) shape + 2 C' int_0^t l(s)/sqrt(t - s) ds. In units of time and length

    T = a^4 Q^2/(2 C')^6,  L = Q sqrt(T)/(2 C'):   tau = lambda^(3/2) shape + int_0^tau lambda(s)/sqrt(tau - s) ds.

Small tau: no leak-off. Large tau: lambda = (2/pi) sqrt(tau), l = Q sqrt(t)/(pi C').
Viscosity: elasticity as in kgd_self_similar.py with K_I = 0, and -W^3 dPi/dxi = phi, the flux over Q,

    phi = d/dtau (lambda^(3/2) int_xi^1 W) + xi sqrt(lambda) dlambda/dtau W + (1/2) int_xi^1 lambda dxi'/sqrt(tau - tau0(xi')),

in steps of ln tau, of second order. For large tau phi = acos(xi)/pi.
"""
import math
import os

import numpy as np

from kgd_self_similar import Kgd


class Abel:
    """int_0^tau lambda(s)/sqrt(tau - s) ds for lambda that is linear between times, and grows with the power 2/3 before the first one."""

    def __init__(self, times):
        self.times = times

    def weights(self, n):
        """Of lambda at times 0..n, at time n."""
        t, result = self.times, np.zeros(n + 1)
        u, w = np.polynomial.legendre.leggauss(40)
        u, w = ((u + 1) / 2) ** 3, w * 1.5 * ((u + 1) / 2) ** 2  # of the first part: s = t0 u, sharp at s = 0
        if n == 0:
            result[0] = math.sqrt(t[0]) * math.gamma(5 / 3) * math.gamma(0.5) / math.gamma(13 / 6)
            return result
        result[0] = t[0] * np.sum(w * u ** (2 / 3) / np.sqrt(t[n] - t[0] * u))
        a, b = t[n] - t[:n], t[n] - t[1:n + 1]
        width = t[1:n + 1] - t[:n]
        whole = 2 * width / (np.sqrt(a) + np.sqrt(b))
        moment = (2 / 3) * (a**1.5 - b**1.5)  # int (tau - s)/sqrt(tau - s)
        right = np.where(width < 1e-5 * a, whole / 2, (a * whole - moment) / width)
        result[:n] += whole - right
        result[1:] += right
        return result


def toughness(times):
    """lambda at these times."""
    abel, result = Abel(times), np.zeros(len(times))
    for n, tau in enumerate(times):
        w = abel.weights(n)
        known = tau - w[:n] @ result[:n]
        x = tau ** (2 / 3) if n == 0 else result[n - 1]
        for _ in range(50):
            step = (x**1.5 + w[n] * x - known) / (1.5 * math.sqrt(x) + w[n])
            x -= step
            if abs(step) < 1e-14 * x:
                break
        result[n] = x
    return result


class Viscosity:
    """W, step by step."""

    def __init__(self, step, quadrature=0.2):
        self.grid = Kgd(quadrature, unknown=40.0)
        self.step = step

    def limit(self):
        """W and Pi for large tau."""
        g = self.grid
        phi = np.arctan2(g.cos, g.xi) / np.pi
        return self.solve(lambda w: (phi, np.zeros_like(g.kernel)), 5 / 8, g.rest**0.625 * 1.5)

    def solve(self, flux, power, w):
        """W with the tip as a power of the distance beyond the unknowns; flux(W): it and its derivative by W."""
        g, n = self.grid, self.grid.unknowns
        follow = (g.rest[n:] / g.rest[n - 1]) ** power
        w = np.concatenate([w[:n], w[n - 1] * follow])
        for _ in range(60):
            phi, derivative = flux(w)
            gradient = phi / w**3
            residual = (w - g.kernel @ gradient)[:n] / w[:n]
            if np.abs(residual).max() < 1e-10:
                return w, gradient
            jacobian = -g.kernel[:n] @ (derivative / w[:, None] ** 3 - np.diag(3 * gradient / w)) * w
            jacobian[:, n - 1] += jacobian[:, n:].sum(axis=1)
            jacobian = np.eye(n) + jacobian[:, :n] / w[:n, None]
            w = w * np.exp(np.concatenate([np.clip(np.linalg.solve(jacobian, -residual), -1, 1), np.zeros(len(w) - n)]))
            w[n:] = w[n - 1] * follow
        raise RuntimeError("no solution")

    def march(self, first, last):
        """Yields tau, lambda, shape, W(0), Pi(0)."""
        g, h = self.grid, self.step
        g.solve(0.0)
        # Without leak-off w = eps L gamma W', l = gamma L, and a sqrt(l) = eps L sqrt(gamma): W = sqrt(gamma) W'.
        w = g.opening * math.sqrt(g.gamma)
        times = first * np.exp(h * np.arange(int(math.log(last / first) / h) + 1))
        abel, length = Abel(times), np.zeros(len(times))
        moments = []  # int_xi^1 W
        log_xi = -np.log1p(np.exp(-g.y))
        cells = g.cells()
        cells[-1, -1] = 2.0  # the integrand falls with exp(-y/2)
        power = 5 / 8  # of the opening at the tip, where leak-off always rules
        for n, tau in enumerate(times):
            weights = abel.weights(n)
            known = tau - weights[:n] @ length[:n]

            def balance(x):
                nonlocal w
                length[n] = x
                if n >= 2:
                    slope = (1.5 * math.log(x) - 2 * math.log(length[n - 1]) + 0.5 * math.log(length[n - 2])) / h
                elif n == 1:
                    slope = math.log(x / length[0]) / h
                else:
                    slope = 2 / 3
                # tau0 of places: powers between times
                at = np.log(length[n::-1] / x)
                since = np.concatenate([-h * np.arange(n + 1), [-h * n - 60]])
                at = np.concatenate([at, [at[-1] - 40]])
                local = np.interp(log_xi, at[::-1], since[::-1])
                if n == 0:
                    local = log_xi / slope
                else:  # near the tip with the slope there
                    near = log_xi > at[1]
                    u = log_xi[near] / at[1]
                    start, whole = at[1] / slope, -h
                    local[near] = start * u + (whole - start) * u**2
                rate = 0.5 * x / np.sqrt(-tau * np.expm1(local)) * g.slope
                leak = np.cumsum((cells @ rate)[::-1])[::-1]
                scale = x**1.5 / tau

                def flux(w):
                    moment = g.to_tip @ w
                    if n >= 2:
                        change, own = (1.5 * np.log(moment) - 2 * np.log(moments[-1]) + 0.5 * np.log(moments[-2])) / h, 1.5 / h
                    elif n == 1:
                        change, own = np.log(moment / moments[-1]) / h, 1 / h
                    else:
                        change, own = 0, 0
                    phi = scale * (moment * (1.5 * slope + change) + g.xi * slope * w) + leak
                    return phi, scale * ((1.5 * slope + change + own) * np.ones(len(w)))[:, None] * g.to_tip + np.diag(scale * g.xi * slope)

                w, self.gradient = self.solve(flux, power, w)
                return (x**1.5 * 2 * (g.to_tip[0] @ w) + weights[n] * x - known) / tau

            guess = tau ** (2 / 3) * g.gamma if n == 0 else length[n - 1] * (math.exp(2 / 3 * h) if n == 1 else length[n - 1] / length[n - 2])
            a, fa = guess, balance(guess)
            b = guess * (1 - 0.7 * fa + 1e-9)
            for _ in range(20):
                fb = balance(b)
                if abs(fb) < 1e-9 or fa == fb:
                    break
                a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
            moments.append(g.to_tip @ w)
            g.gradient, g.k = self.gradient, 0.0
            yield tau, length[n], 2 * moments[-1][0], w[0], g.pressure()[0]


FIRST, DECADES = 1e-10, 15


def toughness_table(parts):
    """lambda at half decades, with so many steps in a decade."""
    times = FIRST * 10 ** (np.arange(DECADES * parts + 1) / parts)
    return toughness(times)[::parts // 2]


def viscosity_table(parts, decades=DECADES):
    """lambda, shape, W(0), Pi(0) at half decades."""
    last = FIRST * 10 ** (decades + 0.5 / parts)
    return np.array(list(Viscosity(math.log(10) / parts).march(FIRST, last)))[::parts // 2, 1:]


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    tough = [toughness_table(parts) for parts in (100, 200)]
    viscous = [viscosity_table(parts) for parts in (18, 36)]
    extrapolated = [(4 * fine - coarse) / 3 for coarse, fine in (tough, viscous)]  # errors are of second order
    with open(os.path.join(folder, "kgd_leak_off.csv"), "w") as table:
        table.write("# KGD fracture with Carter's leak-off, units of kgd_leak_off.py: tau, lambda where toughness rules; lambda, shape, W(0), Pi(0) where\n"
                    "# viscosity rules. Extrapolated in the step; changes: by the extrapolation, relative, of both lambda\n"
                    "tau,toughness_lambda,viscosity_lambda,shape,opening,pressure,toughness_change,viscosity_change\n")
        for i in range(4, 2 * DECADES + 1):
            t, v = extrapolated[0][i], extrapolated[1][i]
            table.write(f"{FIRST * 10**(i / 2):.6g},{t:.8g}," + ",".join(f"{x:.7g}" for x in v)
                        + f",{abs(tough[1][i] / t - 1):.1e},{abs(viscous[1][i, 0] / v[0] - 1):.1e}\n")


if __name__ == "__main__":
    main()
