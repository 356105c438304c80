#!/usr/bin/python3
"""docs/pictures/wings_sealed.py STUDY EXPLICIT: draws wings_sealed.png from the results of
configs/verification/studies/wings_sealed.yaml and of its scene with growth={increment: 10 mm, direction: explicit,
length: fixed}."""

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

RUNS = {"10 mm, 10 mm": "fracture_size=10mm,increment=10mm", "5 mm, 10 mm": "fracture_size=5mm,increment=10mm",
        "5 mm, 5 mm": "fracture_size=5mm,increment=5mm"}


def grown(folder):
    history = sprekk.read_table(folder / "history.csv")
    length = history["tips.main_last.length[m]"]
    steps = [i for i in range(1, len(length)) if length[i] > length[i - 1]]
    return length[steps] * 1e3, {name: values[steps] for name, values in history.items()}


figure, axes = plt.subplots(1, 3, figsize=(14, 4), layout="constrained")
for name, folder in RUNS.items():
    length, history = grown(Path(sys.argv[1]) / folder)
    axes[0].plot(length, history["fracture_pressure[Pa]"] / 1e6, label=name)
    line = sprekk.read_vtu(sprekk.read_pvd(Path(sys.argv[1]) / folder / "fractures.pvd")[-1][1])
    points = line.points[np.argsort(line.points[:, 0])] * 1e3
    axes[1].plot(points[:, 0], points[:, 1], label=name)
    if name == "10 mm, 10 mm":
        axes[2].plot(length, history["tips.main_last.K_II[Pa*m^0.5]"] / 1e6, ".-", label="implicit")
length, history = grown(Path(sys.argv[2]))
axes[2].plot(length, history["tips.main_last.K_II[Pa*m^0.5]"] / 1e6, ".-", label="explicit")
axes[0].set(xlabel="length of wing [mm]", ylabel="pressure of the fluid [MPa]", xlim=(0, 250))
axes[1].set(xlabel="x [mm]", ylabel="y [mm]", title="path (y is stretched)")
axes[2].set(xlabel="length of wing [mm]", ylabel="K_II [MPa√m]", title="increments of 10 mm", xlim=(0, 210))
axes[0].legend(title="cells, increment")
axes[2].legend(title="direction")
for panel in axes:
    panel.grid(alpha=0.3)
figure.savefig(HERE / "wings_sealed.png", dpi=90)
