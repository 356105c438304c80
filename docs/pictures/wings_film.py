#!/usr/bin/python3
"""docs/pictures/wings_film.py SPREKK: draws wings.gif, the film of two growing wings (configs/paper/wing_cracks.yaml, section 5.2 of
the paper), and prints its size. A folder of results, written every 30 min, may stand in the place of SPREKK."""

import io
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from PIL import Image

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk

SECONDS_A_FRAME, SECONDS_AT_THE_END = 0.12, 3.0
HALF_WIDTH = 0.36  # m, of what is seen around the fracture


def read(folder):
    fields = [(time, sprekk.read_vtu(matrix), sprekk.read_vtu(fracture)) for (time, matrix), (_, fracture)
              in zip(sprekk.read_pvd(folder / "matrix.pvd"), sprekk.read_pvd(folder / "fractures.pvd"))]
    return fields, sprekk.read_table(folder / "history.csv")


def draw_rock(axes, time, grid, line, limits):
    triangles, cell = grid.triangles()
    pressure = grid.cell_data["pore.pressure[Pa]"][cell] / 1e6
    image = axes.tripcolor(grid.points[:, 0], grid.points[:, 1], triangles, facecolors=pressure, vmin=limits[0], vmax=limits[1], cmap="viridis")
    axes.triplot(grid.points[:, 0], grid.points[:, 1], triangles, color="white", linewidth=0.3, alpha=0.4)
    axes.add_collection(LineCollection(line.points[line.cells, :2], colors="white", linewidths=2.2))
    axes.set(xlim=(1 - HALF_WIDTH, 1 + HALF_WIDTH), ylim=(1 - HALF_WIDTH, 1 + HALF_WIDTH), aspect="equal", xticks=[], yticks=[])
    axes.set_title(f"{time / 3600:4.1f} h of injection", fontsize=11)
    return image


def draw_lengths(axes, history, time):
    hours = np.concatenate([[0], history["time[s]"] / 3600])
    now = time / 3600
    for tip, text, colour in (("first", "left wing", "tab:blue"), ("last", "right wing", "tab:orange")):
        length = np.concatenate([[0], history[f"tips.main_{tip}.length[m]"] * 100])
        axes.plot(hours, length, color=colour, alpha=0.25)
        until = hours <= now + 1e-9
        axes.plot(hours[until], length[until], color=colour, label=text)
        axes.plot(now, np.interp(now, hours, length), "o", color=colour, markersize=4)
    axes.set(xlabel="time [h]", ylabel="length of the wing [cm]", xlim=(0, hours[-1]), ylim=(0, None))
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", fontsize=9, frameon=False)


def frames(fields, history):
    pressures = np.concatenate([grid.cell_data["pore.pressure[Pa]"] for _, grid, _ in fields]) / 1e6
    limits = np.percentile(pressures, (1, 99.9))
    for time, grid, line in fields:
        figure, axes = plt.subplots(1, 2, figsize=(6.6, 3.4), dpi=100, layout="constrained", width_ratios=[1.25, 1])
        image = draw_rock(axes[0], time, grid, line, limits)
        figure.colorbar(image, ax=axes[0], label="pore pressure [MPa]", shrink=0.9)
        draw_lengths(axes[1], history, time)
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png")
        plt.close(figure)
        yield Image.open(buffer).convert("RGB")


def palette():
    """The same for all frames, so that what stays takes no room: the colours of the map, under the lines of the mesh as well, of the
    two curves, and greys."""
    bar = plt.get_cmap("viridis")(np.linspace(0, 1, 56))[:, :3]
    curves = [np.array(matplotlib.colors.to_rgb(name)) for name in ("tab:blue", "tab:orange")]
    greys = np.linspace(0, 1, 24)[:, None] * np.ones(3)
    colours = np.concatenate([bar, 0.75 * bar[::2] + 0.25, 0.45 * bar[::4] + 0.55, greys] + [[a * c + 1 - a for a in (1, 0.6, 0.25)] for c in curves])
    picture = Image.new("P", (1, 1))
    picture.putpalette(list((255 * colours).round().astype(int).ravel()))
    return picture


def save(pictures, path):
    colours = palette()
    drawn = [picture.quantize(palette=colours, dither=Image.Dither.NONE) for picture in pictures]
    durations = [int(1000 * SECONDS_A_FRAME)] * (len(drawn) - 1) + [int(1000 * SECONDS_AT_THE_END)]
    drawn[0].save(path, save_all=True, append_images=drawn[1:], duration=durations, loop=0, optimize=True, disposal=1)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    given = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as scratch:
        folder = given
        if not given.is_dir():
            folder = Path(scratch) / "out"
            subprocess.run([given.resolve(), "run", str(ROOT / "configs/paper/wing_cracks.yaml"), "--set", "output.every=30min", "-q", "-o", folder],
                           check=True, stdout=subprocess.DEVNULL)
        fields, history = read(folder)
    pictures = list(frames(fields, history))
    save(pictures, HERE / "wings.gif")
    print(f"wings.gif: {len(pictures)} frames, {(HERE / 'wings.gif').stat().st_size / 1e6:.2f} MB")


main()
