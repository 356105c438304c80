"""Closed forms of the verification problems, for the parameters of configs/verification. They are written for numpy and know
nothing of the program. Sources are named in the scenes."""

import csv
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]


def table(name):
    """Numbers of tests/verification/references/NAME.csv, without comments."""
    with open(ROOT / "tests/verification/references" / f"{name}.csv", encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    return np.array(rows, dtype=float)


def terzaghi_pressure(y, dt, steps):
    """p/p0 after backward-Euler steps; H = c = 1, drained at y = 0."""
    total = np.zeros_like(y)
    for first in range(0, 20000, 2000):
        n = (np.arange(first, first + 2000) + 0.5) * np.pi
        total += np.sin(np.outer(y, n)) @ (2 / n * (1 + dt * n * n) ** -steps)
    return total


class Mandel:
    """A quarter of 1 m x 1 m of the rock of Table 1 under F = 1e7 N/m (Cheng and Detournay 1988), in backward-Euler steps."""

    def __init__(self):
        young, poisson, alpha, mobility = 40e9, 0.2, 0.8, 5e-20 / 1e-4
        bulk, shear = young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))
        storage = 0.01 * 4e-10 + (alpha - 0.01) / bulk
        undrained_bulk = bulk + alpha**2 / storage
        self.force, self.shear, self.poisson = 1e7, shear, poisson
        self.skempton = alpha / (storage * undrained_bulk)
        self.undrained = (3 * undrained_bulk - 2 * shear) / (2 * (3 * undrained_bulk + shear))
        self.diffusivity = mobility / (storage + alpha**2 / (bulk + 4 * shear / 3))
        ratio = (1 - poisson) / (self.undrained - poisson)
        low = np.arange(400) * np.pi + 1e-9
        high = (np.arange(400) + 0.5) * np.pi - 1e-12
        for _ in range(200):  # tan A = ratio A, bracketed
            middle = 0.5 * (low + high)
            above = np.tan(middle) > ratio * middle
            low, high = np.where(above, low, middle), np.where(above, middle, high)
        self.roots = 0.5 * (low + high)

    def weights(self, time, steps):
        r = self.roots
        return (1 + r * r * self.diffusivity * time / steps) ** -steps / (r - np.sin(r) * np.cos(r))

    def pressure(self, x, time, steps):
        r = self.roots
        terms = (np.cos(np.outer(x, r)) - np.cos(r)) @ (np.sin(r) * self.weights(time, steps))
        return 2 * self.force * self.skempton * (1 + self.undrained) / 3 * terms

    def displacement(self, x, y, time, steps):
        r, weights = self.roots, self.weights(time, steps)
        uniform = np.sum(weights * np.sin(r) * np.cos(r))
        wave = np.sin(np.outer(x, r)) @ (weights * np.cos(r))
        unit = self.force / self.shear
        u_x = unit * (self.poisson / 2 - self.undrained * uniform) * x + unit * wave
        u_y = unit * (-(1 - self.poisson) / 2 + (1 - self.undrained) * uniform) * y
        return np.stack([u_x, u_y], axis=1)


def barry_mercer(x, y, dt, steps, modes=400):
    """p and u after backward-Euler steps from rest, with the rate of the well at the end of each step: no time error is left."""
    mobility, shear, poisson = 1e-8, 1e5 / 2.2, 0.1
    modulus = 2 * shear * (1 - poisson) / (1 - 2 * poisson)  # lambda + 2 G
    storage, diffusivity = 1 / modulus, mobility * modulus  # S = 0, alpha = 1: S* = 1/M_v
    rate, frequency = 2e-5, 1.022727272727272727e-3
    l = np.arange(1, modes + 1) * np.pi
    k2 = l[:, None] ** 2 + l[None, :] ** 2
    source = 4 * rate / storage * np.outer(np.sin(0.25 * l), np.sin(0.25 * l))
    amplitude = np.zeros_like(k2)
    for m in range(1, steps + 1):
        amplitude = (amplitude + dt * source * np.sin(frequency * m * dt)) / (1 + dt * diffusivity * k2)
    # Centres of a structured mesh share coordinates: the sums are taken on the grid of distinct ones.
    xs, at_x = np.unique(np.round(x, 12), return_inverse=True)
    ys, at_y = np.unique(np.round(y, 12), return_inverse=True)
    sin_x, cos_x = np.sin(np.outer(xs, l)), np.cos(np.outer(xs, l))
    sin_y, cos_y = np.sin(np.outer(ys, l)), np.cos(np.outer(ys, l))
    moved = -amplitude / (modulus * k2)
    p = (sin_x @ amplitude @ sin_y.T)[at_x, at_y]
    u_x = (cos_x @ (moved * l[:, None]) @ sin_y.T)[at_x, at_y]
    u_y = (sin_x @ (moved * l[None, :]) @ cos_y.T)[at_x, at_y]
    return p, np.stack([u_x, u_y], axis=1)


def manufactured_biot(x, y):
    """p and u (Nordbotten 2016) at t = 1."""
    bump = x * (1 - x) * np.sin(2 * np.pi * y)
    return bump, np.stack([bump, np.sin(2 * np.pi * x) * np.sin(2 * np.pi * y)], axis=1)


def single_mode(transmissivity=1.0, kappa=1.0, half=0.5):
    """p = cos(pi x)(A cosh pi|y| + B sinh pi|y|) in the rock and F cos(pi x) in the fracture, 1 at |y| = half."""
    m = np.pi
    # B = T m F/2 and A = F + m B/kappa, scaled to A cosh + B sinh = 1
    b = transmissivity * m / 2
    a = 1 + m * b / kappa
    scale = 1 / (a * np.cosh(m * half) + b * np.sinh(m * half))
    matrix = lambda x, y: scale * np.cos(m * x) * (a * np.cosh(m * abs(y)) + b * np.sinh(m * abs(y)))
    return matrix, lambda x: scale * np.cos(m * x)


def elliptic(distance, half_length, peak):
    """Opening or slip of a crack under uniform load."""
    return peak * np.sqrt(np.maximum(0, 1 - (distance / half_length) ** 2))


SNEDDON_PEAK = 4 / (10e9 / (1 - 0.2**2)) * 1e6  # half-length 1 m, 1 MPa


def phan_peak():
    """Slip at the centre of the frictional crack (Phan et al. 2003): 3.808e-3 m."""
    angle = np.radians(20)
    drop = 100e6 * np.sin(angle) * (np.cos(angle) - np.sin(angle) * np.tan(np.radians(30)))
    return 4 / (25e9 / (1 - 0.25**2)) * drop


def viesca_slip(distance, time):
    """Slip of the fault (m) where (f s' - tau)/(f dp) = 0.5 (Viesca 2021): the table's profile, linear between its rows."""
    fronts, profile = table("viesca2021_T_lambda"), table("viesca2021_slip_profiles")
    front = np.interp(0.5, fronts[:, 0], fronts[:, 1]) * np.sqrt(4 * time)
    scale = 0.5 * 4e6 * front / (10e9 / (1 - 0.25**2))
    return scale * np.interp(abs(distance) / front, profile[:, 0], profile[:, 2], right=0)


def onset_drop(fluid_pressure, mean_pressure, flux):
    """Drop of the shear stress (Pa) on the fracture of section 5.1 while it injects `flux` (m^2/s) into the rock: the back stress
    is that of a line source of uniform pressure and of the free boundary, eta (p_f - p_mean - A/2) with A = Q mu/(2 pi k). It needs
    sqrt(c t) much longer than the fracture. Nothing injected: there is none."""
    back_stress = 0.30 * (fluid_pressure - mean_pressure - 0.5 * flux * 1e-4 / (2 * np.pi * 5e-20)) if flux else 0
    friction, dilation = 0.5, np.radians(1)
    return (5e6 - friction * (15e6 + back_stress - fluid_pressure)) / (1 + friction * np.tan(dilation))


def onset_slip(distance, fluid_pressure, mean_pressure, flux):
    """Slip (m) of the fracture of section 5.1."""
    return elliptic(distance, 0.05, 4 / (40e9 / (1 - 0.2**2)) * onset_drop(fluid_pressure, mean_pressure, flux) * 0.05)


def onset_k_ii(fluid_pressure, mean_pressure, flux):
    """K_II (Pa m^0.5) at its tips."""
    return np.sqrt(np.pi * 0.05) * onset_drop(fluid_pressure, mean_pressure, flux)
