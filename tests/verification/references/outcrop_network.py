#!/usr/bin/python3
"""outcrop_network.py: writes outcrop_network.csv, pressures of configs/verification/outcrop_network.yaml by another method.

Quadratic finite elements, on a mesh whose edges follow the fractures: these conduct along the edges, and have the pressure of the rock
beside them (a wall of such a conductor takes 1e-6 of the pressure that the rock in front of it takes over its aperture). Pressures along
y = 500 m and x = 625 m, the lines of the paper (Flemisch and others, Adv. Water Resour. 111 (2018) 239, sec. 4.4), and the flow."""

from pathlib import Path

import numpy as np

import triangles

CONFIGS = Path(__file__).resolve().parents[3] / "configs/verification"
LEFT = 1013250.0
FRACTURES = np.array([[float(word) for word in row.split(",")[1:]]
                      for row in (CONFIGS / "outcrop_network.csv").read_text().split("\n")[1:] if row])


def solve(size):
    geo = ['SetFactory("OpenCASCADE");', "Rectangle(1) = {0, 0, 0, 700, 600};"]
    for i, (x1, y1, x2, y2) in enumerate(FRACTURES):
        geo += [f"Point({100 + 2 * i}) = {{{x1}, {y1}, 0}};", f"Point({101 + 2 * i}) = {{{x2}, {y2}, 0}};",
                f"Line({100 + i}) = {{{100 + 2 * i}, {101 + 2 * i}}};"]
    geo += [f"BooleanFragments{{ Surface{{1}}; Delete; }}{{ Line{{100:{99 + len(FRACTURES)}}}; Delete; }}",
            f"Mesh.CharacteristicLengthMax = {size};", "Mesh.CharacteristicLengthMin = 0;"]
    nodes, cells, edges = triangles.mesh("\n".join(geo))
    flow = triangles.Flow(nodes, cells, np.full(len(cells), 1e-14))
    middle = nodes[edges].mean(axis=1)
    along = np.min([triangles.near(middle, fracture) for fracture in FRACTURES], axis=0) < 1e-6
    length = np.linalg.norm(nodes[edges[along, 1]] - nodes[edges[along, 0]], axis=1).sum()
    wanted = np.linalg.norm(FRACTURES[:, 2:] - FRACTURES[:, :2], axis=1).sum()
    assert abs(length / wanted - 1) < 1e-9, (length, wanted)
    flow.add_lines(edges[along], np.full(along.sum(), 1e-8 * 1e-2))
    x = flow.places[:, 0]
    pressure, leaving = flow.solve(np.where(x < 1e-6, LEFT, np.where(x > 700 - 1e-6, 0, np.nan)))
    return flow, pressure, leaving[x > 700 - 1e-6].sum(), len(cells)


def main():
    (flow, fine, out, count), (other, rough, rough_out, _) = solve(3), solve(6)
    places = [(x, 500.0) for x in range(10, 700, 20)] + [(625.0, y) for y in range(10, 600, 20)]
    title = (f"# pressures (Pa) by outcrop_network.py, {count} triangles; flow at the right side {out:.6g} m^2/s (viscosity 1 Pa*s, change "
             f"{out - rough_out:.1e}): x (m), y, pressure, its change from a mesh twice as coarse")
    rows = [f"{x:g},{y:g},{flow.at(fine, (x, y)):.7g},{flow.at(fine, (x, y)) - other.at(rough, (x, y)):.1e}" for x, y in places]
    Path(__file__).with_suffix(".csv").write_text("\n".join([title, *rows, ""]))
    print(title)


if __name__ == "__main__":
    main()
