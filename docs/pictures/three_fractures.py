#!/usr/bin/python3
"""docs/pictures/three_fractures.py FOLDER: draws three_fractures.png from the results of configs/paper/three_fractures.yaml
(section 5.3 of the paper), and prints what docs/numerics/studies.md says of them."""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools/python"))
import sprekk

out = Path(sys.argv[1])
history = sprekk.read_table(out / "history.csv")
matrix, fractures = ([(time, sprekk.read_vtu(file)) for time, file in sprekk.read_pvd(out / name)]
                     for name in ("matrix.pvd", "fractures.pvd"))
tips = [f"{fracture}_{end}" for fracture in ("second", "third", "first") for end in ("first", "last")]
hours = history["time[s]"] / 3600


def pressures(grid, name):
    return next(values for array, values in grid.cell_data.items() if array.startswith(name)) / 1e6


figure, axes = plt.subplots(1, 3, figsize=(14, 4.2), layout="constrained", width_ratios=[1.15, 1.15, 1])
for panel, index in ((axes[0], len(matrix) // 2), (axes[1], len(matrix) - 1)):
    time, grid = matrix[index]
    colours = panel.tripcolor(grid.points[:, 0], grid.points[:, 1], grid.cells, facecolors=pressures(grid, "pore.pressure"),
                              vmin=7, vmax=11.7)
    line = fractures[index][1]
    for cell in line.cells:
        panel.plot(line.points[list(cell), 0], line.points[list(cell), 1], "w-", linewidth=1.5)
    panel.set(aspect="equal", title=f"{time / 3600:.1f} h", xlabel="x [m]", ylabel="y [m]")
figure.colorbar(colours, ax=axes[1], label="pore pressure [MPa]")
for tip in tips:
    length = history[f"tips.{tip}.length[m]"]
    axes[2].plot(hours, length * 100, label=tip.replace("_", ", "))
    print(f"{tip}: {length[-1] * 1e3:.1f} mm, first growth at "
          f"{hours[np.flatnonzero(length > 0)[0]] if length[-1] > 0 else np.nan:.2f} h, stopped "
          f"{history[f'tips.{tip}.stopped[1]'][-1]:.0f}, largest K_eq {np.nanmax(history[f'tips.{tip}.K_eq[Pa*m^0.5]'], initial=0) / 1e6:.3f} MPa√m")
axes[2].set(xlabel="t [h]", ylabel="length of wing [cm]")
axes[2].grid(alpha=0.3)
axes[2].legend(title="fracture, end", fontsize=8)
length = history["tips.second_last.length[m]"]
for metres in (0.1, 0.25):
    if length[-1] >= metres:
        print(f"{metres} m at {np.interp(metres, length, hours):.2f} h")
stored = history["fluid_injected[m^2]"]
print(f"{len(hours)} steps to {hours[-1]:.1f} h; balance error {np.abs(history['fluid_balance_error[m^2]']).max() / stored[-1]:.1e} "
      f"of what was injected; fluid in fractures at most {history['fracture_pressure[Pa]'].max() / 1e6:.2f} MPa; pore pressure "
      f"{min(pressures(grid, 'pore.pressure').min() for _, grid in matrix):.2f} to "
      f"{max(pressures(grid, 'pore.pressure').max() for _, grid in matrix):.2f} MPa")
record = json.loads((out / "run.json").read_text())
print(record["exit"], record["seconds"], record["timings"], {name: count for name, count in record["counters"].items()
                                                              if name.startswith(("steps", "changes", "tips", "mesh"))},
      {name: value for name, value in record["results"].items() if "angle" in name})
figure.savefig(HERE / "three_fractures.png", dpi=90)
