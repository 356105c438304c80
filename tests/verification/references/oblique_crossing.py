#!/usr/bin/python3
"""oblique_crossing.py: prints what passes a crossing of two strips at an angle, over fill * width of the conductor / width of the barrier.

Equi-dimensional, by quadratic finite elements in a unit square of rock: a barrier (permeability 1e-6) along x = 0.5 and a conductor (1e4)
through its middle, 0.7 m long; what fills their crossing has 1e-4. From the flows with it and with a fill that seals it, so that the walls of
the barrier drop out; a hundredth leaks into the barrier around the crossing, a few at small angles."""

import numpy as np

import triangles

BARRIER, CONDUCTOR, FILL, HALF = 1e-6, 1e4, 1e-4, 0.35
MIDDLE = np.array([0.5, 0.5])


def flow(angle, barrier, conductor, fill):
    """`angle`: between both strips, degrees. Flow from left (pressure 1) to right (0)."""
    tilt = np.radians(90 - angle)
    along, across = np.array([np.cos(tilt), np.sin(tilt)]), np.array([-np.sin(tilt), np.cos(tilt)])
    left, right, half = 0.5 - barrier / 2, 0.5 + barrier / 2, conductor / 2

    def at(x, side):  # where a side of the conductor has this x
        return MIDDLE + side * across + (x - 0.5 - side * across[0]) / along[0] * along

    points = [(0, 0), (left, 0), (right, 0), (1, 0), (1, 1), (right, 1), (left, 1), (0, 1),
              MIDDLE - HALF * along - half * across, at(left, -half), at(right, -half), MIDDLE + HALF * along - half * across,
              MIDDLE + HALF * along + half * across, at(right, half), at(left, half), MIDDLE - HALF * along + half * across]
    fine = min(barrier, conductor) / 4
    sizes = [0.05, 0.02, 0.02, 0.05] * 2 + [3 * fine, fine, fine, 3 * fine] * 2
    loops = [(1, 2, 10, 9, 16, 15, 7, 8), (3, 4, 5, 6, 14, 13, 12, 11), (2, 3, 11, 10), (15, 14, 6, 7), (9, 10, 15, 16), (11, 12, 13, 14),
             (10, 11, 14, 15)]
    geo, lines = [f"Point({i + 1}) = {{{x:.17g}, {y:.17g}, 0, {size}}};" for i, ((x, y), size) in enumerate(zip(points, sizes))], {}
    for k, loop in enumerate(loops):
        names = []
        for a, b in zip(loop, loop[1:] + loop[:1]):
            if (b, a) not in lines and (a, b) not in lines:
                lines[a, b] = len(lines) + 1
                geo.append(f"Line({lines[a, b]}) = {{{a}, {b}}};")
            names.append(lines[a, b] if (a, b) in lines else -lines[b, a])
        geo += [f"Curve Loop({k + 1}) = {{{', '.join(map(str, names))}}};", f"Plane Surface({k + 1}) = {{{k + 1}}};"]
    nodes, cells, _ = triangles.mesh("\n".join(geo))
    from_middle = nodes[cells].mean(axis=1) - MIDDLE
    in_barrier = np.abs(from_middle[:, 0]) < barrier / 2
    in_conductor = (np.abs(from_middle @ across) < half) & (np.abs(from_middle @ along) < HALF)
    permeability = np.where(in_conductor, np.where(in_barrier, fill, CONDUCTOR), np.where(in_barrier, BARRIER, 1.0))
    rock = triangles.Flow(nodes, cells, permeability)
    x = rock.places[:, 0]
    return rock.solve(np.where(x < 1e-9, 1, np.where(x > 1 - 1e-9, 0, np.nan)))[1][x > 1 - 1e-9].sum()


def main():
    for barrier, conductor in ((0.01, 0.01), (0.01, 0.02), (0.02, 0.01)):
        for angle in (90, 60, 45, 30):
            passed = flow(angle, barrier, conductor, FILL) - flow(angle, barrier, conductor, 1e-9)
            print(f"barrier {barrier} m, conductor {conductor} m, {angle} degrees: {passed / (FILL * conductor / barrier):.3f}")


if __name__ == "__main__":
    main()
