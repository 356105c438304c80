#!/usr/bin/python3
"""hydrocoin.py: writes hydrocoin.csv, heads of an equi-dimensional solution of configs/verification/hydrocoin.yaml.

Geometry of the paper (Flemisch and others, Adv. Water Resour. 111 (2018) 239, sec. 4.1; Hydrocoin, international project on groundwater
modelling, 1988, level 1, case 2): fracture zones are strips, 10 and 15 m wide along x. The head is the height of the surface there,
nothing flows through the other sides. Heads along the line y = -200 m by quadratic finite elements; and heads with zones without width,
which conduct along edges of the mesh and have the head of the rock beside them."""

from pathlib import Path

import numpy as np

import triangles

LINE = -200.0


def solve(size):
    # Corners of the two strips: at the surface, at the bottom, and where they cross.
    def crossing(x1, x2):  # lines from (x1, 100) at 45 degrees and from (x2, 100) along (-200, -1100)
        s = (x2 - x1) / (1 + 2 / 11)
        return x1 + s, 100 - s
    points = [(0, 150), (395, 100), (405, 100), (800, 150), (1192.5, 100), (1207.5, 100), (1600, 150), (1600, -1000), (1505, -1000),
              (1495, -1000), (1007.5, -1000), (992.5, -1000), (0, -1000),
              crossing(405, 1192.5), crossing(405, 1207.5), crossing(395, 1207.5), crossing(395, 1192.5)]
    # Numbers from 1. Loops of rock and of strips.
    loops = [(1, 2, 17, 12, 13), (3, 4, 5, 14), (6, 7, 8, 9, 15), (10, 11, 16),
             (2, 3, 14, 17), (5, 6, 15, 14), (15, 9, 10, 16), (16, 11, 12, 17), (14, 15, 16, 17)]
    geo = [f"Point({i + 1}) = {{{x:.17g}, {y:.17g}, 0, {size if i not in (13, 14, 15, 16) else size / 8}}};" for i, (x, y) in enumerate(points)]
    lines = {}
    for k, loop in enumerate(loops):
        names = []
        for a, b in zip(loop, loop[1:] + loop[:1]):
            if (b, a) in lines:
                names.append(-lines[b, a])
            else:
                if (a, b) not in lines:
                    lines[a, b] = len(lines) + 1
                    geo.append(f"Line({lines[a, b]}) = {{{a}, {b}}};")
                names.append(lines[a, b])
        geo += [f"Curve Loop({k + 1}) = {{{', '.join(map(str, names))}}};", f"Plane Surface({k + 1}) = {{{k + 1}}};"]
    geo += ["Field[1] = Distance;", "Field[1].PointsList = {2, 3, 5, 6, 14, 15, 16, 17};", "Field[2] = Threshold;", "Field[2].InField = 1;",
            f"Field[2].SizeMin = {size / 10};", f"Field[2].SizeMax = {size};", "Field[2].DistMin = 10;", "Field[2].DistMax = 300;",
            "Background Field = 2;", "Mesh.CharacteristicLengthExtendFromBoundary = 0;"]
    nodes, cells, _ = triangles.mesh("\n".join(geo))
    centre = nodes[cells].mean(axis=1)
    # Distance along x from the middle of each zone.
    one = np.abs(centre[:, 0] - (500 - centre[:, 1])) < 5
    two = np.abs(centre[:, 0] - (1200 - (100 - centre[:, 1]) * 2 / 11)) < 7.5
    flow = triangles.Flow(nodes, cells, np.where(one | two, 1e-6, 1e-8))
    x, y = flow.places.T
    surface = np.interp(x, [0, 395, 405, 800, 1192.5, 1207.5, 1600], [150, 100, 100, 150, 100, 100, 150])
    on_surface = np.abs(y - surface) < 1e-6
    head, leaving = flow.solve(np.where(on_surface, y, np.nan))
    return flow, head, leaving[on_surface & (leaving > 0)].sum(), len(cells)


def solve_thin(size):
    cross = (500 + 7500 / 13, -7500 / 13)
    points = [(0, 150), (400, 100), (800, 150), (1200, 100), (1600, 150), (1600, -1000), (1500, -1000), (1000, -1000), (0, -1000), cross]
    lines = [(1, 2), (2, 3), (3, 4), (4, 5), (5, 6), (6, 7), (7, 8), (8, 9), (9, 1), (2, 10), (10, 7), (4, 10), (10, 8)]
    loops = ("1, 10, 13, 8, 9", "2, 3, 12, -10", "4, 5, 6, -11, -12", "11, 7, -13")
    geo = [f"Point({i + 1}) = {{{x:.17g}, {y:.17g}, 0, {size / 8 if i in (1, 3, 9) else size}}};" for i, (x, y) in enumerate(points)]
    geo += [f"Line({i + 1}) = {{{a}, {b}}};" for i, (a, b) in enumerate(lines)]
    geo += [f"Curve Loop({i + 1}) = {{{loop}}};\nPlane Surface({i + 1}) = {{{i + 1}}};" for i, loop in enumerate(loops)]
    nodes, cells, edges = triangles.mesh("\n".join(geo))
    flow = triangles.Flow(nodes, cells, np.full(len(cells), 1e-8))
    middle = nodes[edges].mean(axis=1)
    for ends, width in (((400, 100, 1500, -1000), 5 * 2**0.5), ((1200, 100, 1000, -1000), 33 / 5**0.5)):
        along = triangles.near(middle, ends) < 1e-6
        flow.add_lines(edges[along], np.full(along.sum(), 1e-6 * width))
    x, y = flow.places.T
    surface = np.interp(x, [0, 400, 800, 1200, 1600], [150, 100, 150, 100, 150])
    head, _ = flow.solve(np.where(np.abs(y - surface) < 1e-6, y, np.nan))
    return flow, head


def main():
    (flow, head, _, count), (coarse, rough, _, _) = solve(20), solve(40)
    (thin, thin_head), (thin_coarse, thin_rough) = solve_thin(20), solve_thin(40)
    rows = []
    for x in range(20, 1600, 40):
        values = [f.at(h, (x, LINE)) for f, h in ((flow, head), (thin, thin_head), (coarse, rough), (thin_coarse, thin_rough))]
        rows.append(f"{x:g},{values[0]:.7g},{values[1]:.7g},{values[0] - values[2]:.1e},{values[1] - values[3]:.1e}")
    title = (f"# heads (m) along y = {LINE:g} m by hydrocoin.py, {count} triangles: x (m), head, head with zones without width, changes of both "
             "from meshes twice as coarse")
    Path(__file__).with_suffix(".csv").write_text("\n".join([title, *rows, ""]))


if __name__ == "__main__":
    main()
