#!/usr/bin/python3
"""docs/pictures/wing_cracks.py SPREKK: draws wing_cracks.png, the growth of two wings (section 5.2 of the paper)."""

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

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], "run", str(ROOT / "configs/paper/wing_cracks.yaml"), "-q", "-o", folder + "/out"], check=True)
    out = Path(folder) / "out"
    history = sprekk.read_table(out / "history.csv")
    matrix = [(time, sprekk.read_vtu(file)) for time, file in sprekk.read_pvd(out / "matrix.pvd")]
    fractures = [(time, sprekk.read_vtu(file)) for time, file in sprekk.read_pvd(out / "fractures.pvd")]

figure, axes = plt.subplots(1, 3, figsize=(14, 4.2), layout="constrained", width_ratios=[1.15, 1.15, 1])
for panel, index in ((axes[0], len(matrix) // 2), (axes[1], len(matrix) - 1)):
    time, grid = matrix[index]
    pressure = next(values for name, values in grid.cell_data.items() if name.startswith("pore.pressure"))
    cells = np.array([list(cell) for cell in grid.cells])
    colours = panel.tripcolor(grid.points[:, 0], grid.points[:, 1], cells, facecolors=pressure / 1e6, vmin=7, vmax=11.7)
    line = fractures[index][1]
    for cell in line.cells:
        panel.plot(line.points[list(cell), 0], line.points[list(cell), 1], "w-", linewidth=1.5)
    panel.set(xlim=(0.65, 1.35), ylim=(0.65, 1.35), aspect="equal", title=f"{time / 3600:.1f} h")
figure.colorbar(colours, ax=axes[1], label="pore pressure [MPa]")
hours = history["time[s]"] / 3600
for tip, text in (("first", "left tip"), ("last", "right tip")):
    axes[2].plot(hours, history[f"tips.main_{tip}.length[m]"] * 100, label=text)
axes[2].set(xlabel="t [h]", ylabel="length of wing [cm]")
axes[2].grid(alpha=0.3)
axes[2].legend()
lengths = history["tips.main_last.length[m]"]
for metres in (0.1, 0.25):
    print(f"{metres} m of wing after {np.interp(metres, lengths, hours):.1f} h")
print(f"{len(hours)} steps; growth starts at {hours[np.flatnonzero(lengths > 0)[0]]:.3f} h; largest pressure "
      f"{history['fracture_pressure[Pa]'].max() / 1e6:.2f} MPa")
figure.savefig(HERE / "wing_cracks.png", dpi=90)
