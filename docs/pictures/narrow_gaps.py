#!/usr/bin/python3
"""docs/pictures/narrow_gaps.py SPREKK: draws narrow_gaps.png, a mesh around two narrow gaps with and without gap_edges."""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools/python"))
import sprekk

SCENE = """
geometry:
  box: {{x: [0 m, 2 m], y: [0 m, 2 m]}}
  fractures:
    long: {{points: [[1.2 m, 0.9 m], [1.995 m, 1.1 m]]}}
    short: {{points: [[1.45 m, 0.97 m], [1.3 m, 1.3 m]]}}
mesh: {{size: 0.2 m, fracture_size: 0.1 m, gap_edges: {edges}}}
materials: {{permeability: 1e-15 m^2, viscosity: 1e-3 Pa*s, fluid_compressibility: 0 1/Pa}}
components:
  pore: {{type: matrix_flow/mpfa, storage: 1e-10 1/Pa, initial_pressure: 0 Pa}}
schedule: [{{solve: [pore]}}]
time: {{end: 1 s, step: 1 s}}
output: {{every: 1 s}}
"""


def mesh(edges):
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.yaml"
        scene.write_text(SCENE.format(edges=edges))
        subprocess.run([sys.argv[1], "run", str(scene), "-q", "-o", folder + "/out"], check=True)
        return tuple(sprekk.read_vtu(sprekk.read_pvd(Path(folder) / "out" / f"{name}.pvd")[-1][1])
                     for name in ("matrix", "fractures"))


def smallest_angle(points, cells):
    corners = points[cells][:, :, :2]
    angles = []
    for k in range(3):
        a, b = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        angles.append(np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(1))))
    return np.degrees(np.min(angles))


figure, axes = plt.subplots(1, 4, figsize=(14, 3.95))
for panels, edges, name in ((axes[:2], 0, "gap_edges: 0"), (axes[2:], 0.5, "gap_edges: 0.5 (default)")):
    matrix, fractures = mesh(edges)
    cells = np.array([list(cell) for cell in matrix.cells])
    text = f"{name}\n{len(cells)} cells, smallest angle {smallest_angle(matrix.points, cells):.1f}°"
    for panel, limits, title in ((panels[0], (1.15, 2.0, 0.7, 1.55), text), (panels[1], (1.93, 2.0, 1.06, 1.13), "at the side")):
        panel.triplot(matrix.points[:, 0], matrix.points[:, 1], cells, color="0.55", linewidth=0.6)
        for cell in fractures.cells:
            panel.plot(fractures.points[list(cell), 0], fractures.points[list(cell), 1], "-", color="tab:red", linewidth=1.8)
        panel.set(xlim=limits[:2], ylim=limits[2:], aspect="equal", title=title)
        panel.set_xticks([])
        panel.set_yticks([])
figure.tight_layout()
figure.savefig(HERE / "narrow_gaps.png", dpi=90)
