#!/usr/bin/python3
"""regular_network.py [N]: writes regular_network.csv, a reference for the regular network of Flemisch and others 2018.

Equi-dimensional, like their reference: fractures are strips of their aperture, 1e-4, in rectangles that grow away from
them; two-point fluxes, which are exact for linear pressures on such grids. N: cells across a strip (8). Means of the
pressure over 24 x 24 squares, without the strips.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

APERTURE, SQUARES = 1e-4, 24
# Along x at y, from x to x; the same along y.
FRACTURES = [(0.5, 0.0, 1.0), (0.75, 0.5, 1.0), (0.625, 0.5, 0.75)]


def lines(across):
    growth = 1 + 1.2 / across
    edges = {0.0, 1.0}
    for c in (0.5, 0.625, 0.75):
        edges.update(c - 0.5 * APERTURE + APERTURE * np.arange(across + 1) / across)
    edges.update(i / SQUARES for i in range(SQUARES + 1) if all(abs(i / SQUARES - c) > 1e-9 for c in (0.5, 0.625, 0.75)))
    edges = sorted(edges)
    found = [0.0]
    for a, b in zip(edges, edges[1:]):
        # Halved until no cell is longer than what the distance from the next strip allows.
        parts = [(a, b)]
        while parts:
            lo, hi = parts.pop()
            near = min(abs(s - c) - 0.5 * APERTURE for c in (0.5, 0.625, 0.75) for s in (lo, hi))
            if hi - lo > max(APERTURE / across * 1.01, (growth - 1) * max(near, 0) + APERTURE / across) and hi - lo > 1e-12 \
                    and not any(abs(0.5 * (lo + hi) - c) < 0.5 * APERTURE for c in (0.5, 0.625, 0.75)) \
                    or hi - lo > 0.04 / across:
                parts += [(0.5 * (lo + hi), hi), (lo, 0.5 * (lo + hi))]
            else:
                found.append(hi)
    return np.array(found)


def solve(permeability, across):
    x = lines(across)
    d, m = np.diff(x), 0.5 * (x[1:] + x[:-1])
    n = len(d)
    in_strip = np.zeros((n, n), bool)  # [y, x]
    for c, start, end in FRACTURES:
        strip, along = abs(m - c) < 0.5 * APERTURE, (m > start - 0.5 * APERTURE) & (m < end + 0.5 * APERTURE)
        in_strip |= strip[:, None] & along[None, :]
        in_strip |= along[:, None] & strip[None, :]
    k = np.where(in_strip, permeability, 1.0)
    number = np.arange(n * n).reshape(n, n)
    east = d[:, None] / (0.5 * d[None, :-1] / k[:, :-1] + 0.5 * d[None, 1:] / k[:, 1:])
    north = d[None, :] / (0.5 * d[:-1, None] / k[:-1] + 0.5 * d[1:, None] / k[1:])
    a = np.concatenate([number[:, :-1].ravel(), number[:-1].ravel()])
    b = np.concatenate([number[:, 1:].ravel(), number[1:].ravel()])
    t = np.concatenate([east.ravel(), north.ravel()])
    right = 2 * d * k[:, -1] / d[-1]  # pressure 1
    diagonal = np.bincount(np.concatenate([a, b, number[:, -1]]), np.concatenate([t, t, right]), n * n)
    matrix = coo_matrix((np.concatenate([-t, -t, diagonal]),
                         (np.concatenate([a, b, number.ravel()]), np.concatenate([b, a, number.ravel()])))).tocsc()
    source = np.zeros((n, n))
    source[:, 0] = d  # a flux of 1 through the left side
    source[:, -1] += right
    p = spsolve(matrix, source.ravel()).reshape(n, n)
    rock = np.where(in_strip, 0.0, d[:, None] * d[None, :])
    place = np.minimum((m * SQUARES).astype(int), SQUARES - 1)
    square = (place[:, None] * SQUARES + place[None, :]).ravel()
    sum_of = lambda values: np.bincount(square, values.ravel(), SQUARES**2)
    return sum_of(p * rock) / sum_of(rock), n


def main():
    across = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    conductive, n = solve(1e4, across)
    blocking, _ = solve(1e-4, across)
    rows = [f"{(i % SQUARES + 0.5) / SQUARES:.9f},{(i // SQUARES + 0.5) / SQUARES:.9f},{conductive[i]:.7f},{blocking[i]:.7f}"
            for i in range(SQUARES**2)]
    title = (f"# regular fracture network (Flemisch and others 2018): mean pressures of squares of 1/{SQUARES}; "
             f"centre x, y, conductive, blocking; by regular_network.py, {n} x {n} rectangles")
    Path(__file__).with_suffix(".csv").write_text("\n".join([title, *rows, ""]))


if __name__ == "__main__":
    main()
