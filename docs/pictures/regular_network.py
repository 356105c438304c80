#!/usr/bin/python3
"""docs/pictures/regular_network.py SPREKK: draws regular_network.png, the pressures of configs/verification/
regular_network.yaml with fractures that conduct and that block, and prints errors against the equi-dimensional solution."""

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
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk

REFERENCE = np.loadtxt(ROOT / "tests/verification/references/regular_network.csv", delimiter=",")
SQUARES = round(len(REFERENCE) ** 0.5)
BLOCKING = ["--set", "components.conduit.transmissivity_value=1e-8 m^3",
            "--set", "components.conduit.normal_permeability_value=2 m/(Pa*s)"]


def run(settings):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        subprocess.run([sys.argv[1], "run", str(ROOT / "configs/verification/regular_network.yaml"), "-q", "-o", str(out),
                        *settings], check=True)
        return tuple(sprekk.read_vtu(sprekk.read_pvd(out / f"{name}.pvd")[-1][1]) for name in ("matrix", "fractures"))


def error(settings, wanted):
    """Root mean square over squares, of the difference of pressures."""
    matrix, _ = run(settings)
    centre, area = matrix.centres_and_sizes()
    square = (SQUARES * centre[:, 1]).astype(int) * SQUARES + (SQUARES * centre[:, 0]).astype(int)
    mean = np.bincount(square, matrix.cell_data["pore.pressure[Pa]"] * area) / np.bincount(square, area)
    return len(area), np.sqrt(((mean - wanted) ** 2).mean()) / (wanted.max() - 1)


figure, axes = plt.subplots(1, 2, figsize=(11, 4.6))
for panel, settings, column, name in ((axes[0], [], 2, "conducting"), (axes[1], BLOCKING, 3, "blocking")):
    matrix, fractures = run(settings)
    triangles, of_cell = matrix.triangles()
    drawn = panel.tripcolor(matrix.points[:, 0], matrix.points[:, 1], triangles,
                            facecolors=matrix.cell_data["pore.pressure[Pa]"][of_cell], cmap="viridis")
    for line in fractures.points[fractures.cells]:
        panel.plot(line[:, 0], line[:, 1], color="white" if name == "blocking" else "black", linewidth=1)
    panel.set_aspect("equal")
    panel.set_title(f"{name} fractures")
    panel.set_xlabel("x (m)")
    figure.colorbar(drawn, ax=panel, label="pressure (Pa)")
    for shape in ("quadrilaterals", "triangles"):
        for n in (24, 48, 96, 192):
            mesh = ["--set", f"mesh={{kind: structured, shape: {shape}, cells: [{n}, {n}]}}"]
            print("| {} | {} | {:,} | {:.1e} |".format(name, shape, *error(settings + mesh, REFERENCE[:, column])))
axes[0].set_ylabel("y (m)")
figure.tight_layout()
figure.savefig(HERE / "regular_network.png", dpi=110)
