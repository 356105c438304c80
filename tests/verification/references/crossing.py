#!/usr/bin/python3
"""crossing.py [N]: writes crossing.csv, the flow through a barrier that a conductor crosses at a right angle.

Equi-dimensional: both fractures are strips in a unit square of rock (permeability 1, viscosity 1), on rectangles that grow away
from them, N across a strip (16); two-point fluxes, which are exact for linear pressures on such grids, also where a strip conducts
otherwise along than across. The barrier lies at x = 0.5, over the whole height, the conductor at y = 0.53 from x = 0.1 to 0.9;
pressure 1 at the left side, 0 at the right one, nothing through the others. `fill` is the permeability of the rectangle in which both
strips cross: the harmonic mean of those along both, or that of the conductor, or that of the barrier (along and across).
"""

import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

BARRIER, CONDUCTOR, CONDUCTOR_ENDS = 0.5, 0.53, (0.1, 0.9)


def lines(strip, width, ends, across):
    """Edges of cells from 0 to 1: uniform within the strip, growing away from it and from `ends`."""
    fine = width / across
    edges = sorted([0.0, *ends, strip - width / 2, strip + width / 2, 1.0])
    found = [0.0]
    for a, b in zip(edges, edges[1:]):
        parts = [(a, b)]
        while parts:
            lo, hi = parts.pop()
            near = min([abs(0.5 * (lo + hi) - strip) - width / 2, *(abs(0.5 * (lo + hi) - e) for e in ends)])
            longest = fine * 1.01 if near < 0 else min(max(fine, 2.0 * near / across), 0.6 / across)
            if hi - lo > longest:
                parts += [(0.5 * (lo + hi), hi), (lo, 0.5 * (lo + hi))]
            else:
                found.append(hi)
    return np.array(found)


def solve(barrier_width, conductor_width, along, normal, conductor, fill, across):
    """The flow from left to right, and the part of it within the conductor's width."""
    x = lines(BARRIER, barrier_width, CONDUCTOR_ENDS, across)
    y = lines(CONDUCTOR, conductor_width, (), across)
    dx, dy = np.diff(x), np.diff(y)
    mx, my = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
    kx, ky = np.ones((len(dy), len(dx))), np.ones((len(dy), len(dx)))
    in_barrier = np.abs(mx - BARRIER) < barrier_width / 2
    in_conductor = np.abs(my - CONDUCTOR) < conductor_width / 2
    kx[:, in_barrier], ky[:, in_barrier] = normal, along
    inside = (mx > CONDUCTOR_ENDS[0]) & (mx < CONDUCTOR_ENDS[1])
    kx[np.ix_(in_conductor, inside)] = ky[np.ix_(in_conductor, inside)] = conductor
    both = np.ix_(in_conductor, in_barrier)
    if fill == "barrier":
        kx[both], ky[both] = normal, along
    else:
        kx[both] = ky[both] = {"mean": 2 / (1 / along + 1 / conductor), "conductor": conductor}[fill]
    number = np.arange(kx.size).reshape(kx.shape)
    east = dy[:, None] / (0.5 * dx[:-1] / kx[:, :-1] + 0.5 * dx[1:] / kx[:, 1:])
    north = dx[None, :] / (0.5 * dy[:-1, None] / ky[:-1] + 0.5 * dy[1:, None] / ky[1:])
    a = np.concatenate([number[:, :-1].ravel(), number[:-1].ravel()])
    b = np.concatenate([number[:, 1:].ravel(), number[1:].ravel()])
    t = np.concatenate([east.ravel(), north.ravel()])
    left, right = 2 * dy * kx[:, 0] / dx[0], 2 * dy * kx[:, -1] / dx[-1]
    ends = np.concatenate([a, b, number[:, 0], number[:, -1]])
    diagonal = np.bincount(ends, np.concatenate([t, t, left, right]), kx.size)
    matrix = coo_matrix((np.concatenate([-t, -t, diagonal]),
                         (np.concatenate([a, b, number.ravel()]), np.concatenate([b, a, number.ravel()])))).tocsc()
    source = np.zeros(kx.shape)
    source[:, 0] = left
    p = spsolve(matrix, source.ravel()).reshape(kx.shape)
    middle = np.searchsorted(mx, BARRIER) - 1
    flow = east[:, middle] * (p[:, middle] - p[:, middle + 1])
    return float((right * p[:, -1]).sum()), float(flow[in_conductor].sum())


CASES = [(b, c, along, normal, 1e4, fill)
         for b, c in ((1e-3, 1e-3), (1e-2, 1e-2), (1e-2, 2e-2), (2e-2, 1e-2))
         for along, normal in ((1e-4, 1e-6), (1e-4, 1e-4))
         for fill in ("mean", "barrier", "conductor")]


def main():
    across = int(sys.argv[1]) if len(sys.argv) > 1 else 16
    rows = []
    for case in CASES:
        fine, coarse = solve(*case, across), solve(*case, across // 2)
        fill = ("mean", "barrier", "conductor").index(case[-1])
        rows.append(",".join(f"{value:g}" for value in case[:-1]) + f",{fill},{fine[0]:.8g},{fine[1]:.8g},{fine[0] - coarse[0]:.1e}")
        print(rows[-1], flush=True)
    title = (f"# flow through a barrier that a conductor crosses, by crossing.py, {across} cells across a strip: width of the barrier, of the "
             "conductor, permeability of the barrier along, across, of the conductor, fill (0 mean, 1 barrier, 2 conductor), flow, "
             "flow within the crossing, change of the flow from half as many cells")
    Path(__file__).with_suffix(".csv").write_text("\n".join([title, *rows, ""]))


if __name__ == "__main__":
    main()
