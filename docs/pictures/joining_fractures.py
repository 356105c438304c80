#!/usr/bin/python3
"""docs/pictures/joining_fractures.py FOLDER: draws joining_fractures.png from the results of
configs/tutorial/joining_fractures.yaml, and prints what docs/numerics/two_level.md says of them."""

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
hours = history["time[s]"] / 3600
joined = history["tips.main_last.stopped[1]"] == 1
meeting = hours[joined][0]

figure, axes = plt.subplots(1, 3, figsize=(14, 4.2), layout="constrained", width_ratios=[1.15, 1.15, 1])
for panel, wanted in ((axes[0], meeting - 0.5), (axes[1], hours[-1])):
    index = int(np.argmin([abs(time / 3600 - wanted) for time, _ in matrix]))
    time, grid = matrix[index]
    pressure = next(values for array, values in grid.cell_data.items() if array.startswith("pore.pressure")) / 1e6
    colours = panel.tripcolor(grid.points[:, 0], grid.points[:, 1], grid.cells, facecolors=pressure, vmin=7, vmax=11.7)
    line = fractures[index][1]
    for cell in line.cells:
        panel.plot(line.points[list(cell), 0], line.points[list(cell), 1], "w-", linewidth=1.5)
    panel.set(aspect="equal", xlim=(0.65, 1.55), ylim=(0.7, 1.4), title=f"{time / 3600:.1f} h", xlabel="x [m]", ylabel="y [m]")
figure.colorbar(colours, ax=axes[1], label="pore pressure [MPa]")
axes[2].plot(hours, history["fracture_pressure[Pa]"] / 1e6, label="main")
axes[2].plot(hours, history["second_pressure[Pa]"] / 1e6, label="second")
axes[2].set(xlabel="t [h]", ylabel="pressure of the fluid [MPa]")
axes[2].grid(alpha=0.3)
axes[2].legend(title="fracture", fontsize=8)
last = np.flatnonzero(joined)[0]
print(f"joined at {meeting:.2f} h; pressures before {history['fracture_pressure[Pa]'][last] / 1e6:.2f} and "
      f"{history['second_pressure[Pa]'][last] / 1e6:.2f}, after {history['fracture_pressure[Pa]'][last + 1] / 1e6:.2f} and "
      f"{history['second_pressure[Pa]'][last + 1] / 1e6:.2f} MPa; balance error "
      f"{np.abs(history['fluid_balance_error[m^2]']).max() / history['fluid_injected[m^2]'][-1]:.1e} of what was injected")
for end in ("main_first", "second_first", "second_last"):
    print(end, f"{history[f'tips.{end}.length[m]'][-1] * 1e3:.0f} mm")
figure.savefig(HERE / "joining_fractures.png", dpi=90)
