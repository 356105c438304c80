#!/usr/bin/env python3
"""Steady convection in a square of porous rock: Nusselt numbers, by collocation at Chebyshev points.

In units of the side, the diffusivity and the difference of temperature, with the stream function s:
  u = ds/dz, w = -ds/dx,   laplace s = -Ra dT/dx,   u dT/dx + w dT/dz = laplace T,   s = 0 on all sides.
`side`: T = 1 at x = 0 and 0 at x = 1, bottom and top insulated. `bottom`: T = 1 at z = 0 and 0 at z = 1, the sides
insulated; the branch of a single cell. The Nusselt number is the mean of the heat flux from hot to cold,
which converges faster than that at the hot side, with its corners.

Ra = density * gravity * expansion * difference * permeability * side / (viscosity * diffusivity), the diffusivity being
the conductivity over the heat capacity of the fluid. Published: side-heated, 3.097 at Ra = 100 (Walker and Homsy
1978); heated from below, 1.45, 2.651 and 3.813 at Ra = 50, 100 and 200 (Caltagirone 1975).

usage: porous_convection.py > porous_convection.csv
"""
import numpy as np


def chebyshev(n):
    """Points on [0, 1], ascending, and the matrix of derivatives there (Trefethen, Spectral Methods in MATLAB, 2000)."""
    k = np.arange(n + 1)
    x = -np.cos(np.pi * k / n)
    c = np.where((k == 0) | (k == n), 2.0, 1.0) * (-1.0) ** k
    difference = x[:, None] - x[None, :]
    d = np.outer(c, 1 / c) / (difference + np.eye(n + 1))
    d -= np.diag(d.sum(axis=1))
    return (x + 1) / 2, 2 * d


def weights(x):
    """Of the integral over [0, 1], exact for polynomials through the points."""
    n = len(x) - 1
    powers = np.polynomial.chebyshev.chebvander(2 * x - 1, n)
    integrals = [0 if k % 2 else 1 / (1 - k * k) for k in range(n + 1)]
    return np.linalg.solve(powers.T, integrals)


def nusselt(heated, rayleigh, n):
    """Heated from below, the single cell is followed from Ra = 50 on."""
    state = None
    if heated == "bottom":
        for smaller in np.arange(50, rayleigh, 25):
            state = solve(heated, smaller, n, state)[1]
    return solve(heated, rayleigh, n, state)[0]


def solve(heated, rayleigh, n, state):
    """The Nusselt number, and the stream function and temperature that Newton's method finds from those given."""
    x, d = chebyshev(n)
    one = np.eye(n + 1)
    dx, dz = np.kron(d, one), np.kron(one, d)  # x is the slow index
    laplace = dx @ dx + dz @ dz
    grid_x, grid_z = (g.ravel() for g in np.meshgrid(x, x, indexing="ij"))
    left, right, bottom, top = grid_x == 0, grid_x == 1, grid_z == 0, grid_z == 1
    outside = left | right | bottom | top
    hot, cold = (left, right) if heated == "side" else (bottom, top)
    insulated = outside & ~hot & ~cold
    normal = dz if heated == "side" else dx
    size = len(grid_x)

    base = 1 - (grid_x if heated == "side" else grid_z)
    if heated == "side":
        s, t = np.zeros(size), base.copy()
    else:
        s = 2 * np.sin(np.pi * grid_x) * np.sin(np.pi * grid_z)
        t = base + 0.2 * np.cos(np.pi * grid_x) * np.sin(np.pi * grid_z) - 0.1 * np.sin(2 * np.pi * grid_z)
    if state:
        s, t = state
    for _ in range(60):
        u, w, tx, tz = dz @ s, -dx @ s, dx @ t, dz @ t
        of_s = laplace @ s + rayleigh * tx
        of_t = u * tx + w * tz - laplace @ t
        a, b = laplace.copy(), rayleigh * dx
        c = tx[:, None] * dz - tz[:, None] * dx
        e = u[:, None] * dx + w[:, None] * dz - laplace
        of_s[outside], a[outside], b[outside] = s[outside], np.eye(size)[outside], 0
        fixed = hot | cold
        of_t[fixed] = (t - np.where(hot, 1.0, 0.0))[fixed]
        c[outside], e[fixed] = 0, np.eye(size)[fixed]
        of_t[insulated], e[insulated] = (normal @ t)[insulated], normal[insulated]
        step = np.linalg.solve(np.block([[a, b], [c, e]]), np.concatenate([of_s, of_t]))
        s, t = s - step[:size], t - step[size:]
        if np.abs(step).max() < 1e-11:
            break
    else:
        raise RuntimeError("no convergence")
    flux = (dz @ s) * t - dx @ t if heated == "side" else -(dx @ s) * t - dz @ t
    return weights(x) @ flux.reshape(n + 1, n + 1) @ weights(x), (s, t)


def main():
    print("# side-heated (1) or heated from below (0), Rayleigh number, Nusselt number; by porous_convection.py")
    for heated, numbers in (("side", (50, 100)), ("bottom", (50, 100, 200))):
        for rayleigh in numbers:
            coarse, fine = nusselt(heated, rayleigh, 16), nusselt(heated, rayleigh, 22)
            assert abs(fine - coarse) < 1e-4 * fine, (heated, rayleigh, coarse, fine)
            print(f"{int(heated == 'side')},{rayleigh},{fine:.5f}")


if __name__ == "__main__":
    main()
