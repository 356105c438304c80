#!/usr/bin/python3
"""docs/pictures/wings_errors.py: draws wings_errors.png from wings_errors.csv, times and costs of section 5.2 of the paper: its errors, with
growth within steps and after them, over processor seconds. The first row is the reference. Growth after steps has two times: that at
which the tip has its load before it jumps to a length, and that at which it is there after the jump. "cfb2fba" is the program
before there was growth within steps."""

import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
COLOURS = {"within steps": "#1b6ca8", "after steps": "#c8553d", "after steps, cfb2fba": "#777777"}

with open(HERE / "wings_errors.csv", newline="") as file:
    reference, *rows = csv.DictReader(file)

figure, both = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
for axes, length in zip(both, ("0.1 m", "0.25 m")):
    column = f"hours to {length}"
    for growth, colour in COLOURS.items():
        of_it = [row for row in rows if row["growth"] == growth]
        error = lambda row, name: 100 * (float(row[name]) / float(reference[column]) - 1)
        points = [(float(row["processor seconds"]), error(row, column)) for row in of_it]
        for row, (seconds, late) in zip(of_it, points):
            if row[f"hours after the jump to {length}"]:
                axes.vlines(seconds, error(row, f"hours after the jump to {length}"), late, color=colour, linewidth=1)
        axes.plot(*zip(*points), "o", color=colour, markersize=5, label=f"growth {growth}")
        axes.plot(*next(point for row, point in zip(of_it, points) if row["changed"] == "nothing"), "*", color=colour, markersize=15,
                  markeredgecolor="black", label=f"the scene, growth {growth}")
    axes.axhline(0, color="black", linewidth=0.8)
    axes.axhspan(-0.5, 0.5, color="#dddddd", zorder=0)
    axes.set(xscale="log", xlabel="processor seconds of a run", title=f"time to {length}")
    axes.grid(True, linewidth=0.4, alpha=0.4)
    axes.xaxis.set_major_formatter("{x:g}")
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
both[0].set_ylabel("error, %")
both[0].legend(fontsize=8, frameon=False, loc="lower right")
figure.savefig(HERE / "wings_errors.png", dpi=100)
