#!/usr/bin/python3
"""docs/pictures/convergence.py SPREKK: measures how errors fall with the mesh, on scenes with closed-form answers.

Runs the scenes with the given program, writes convergence.csv and convergence.png beside this file, and prints the tables of
docs/numerics. Errors are relative L2 norms over the cells, weighted with their size.
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from numpy import cos, cosh, pi, sin, sinh, sqrt, tan

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk

PROGRAM = str(Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 else sys.exit(__doc__)


def run(scene, settings):
    """The last matrix and fracture grids of a run; `scene` is a path below configs or YAML text."""
    with tempfile.TemporaryDirectory() as folder:
        file = ROOT / "configs" / scene if scene.endswith(".yaml") else Path(folder) / "scene.yaml"
        if not scene.endswith(".yaml"):
            file.write_text(scene)
        arguments = [a for key, value in settings.items() for a in ("--set", f"{key}={value}")]
        subprocess.run([PROGRAM, "run", str(file), "-q", "-o", folder + "/out", *arguments], check=True)
        fractures = Path(folder) / "out" / "fractures.pvd"
        matrix = sprekk.read_vtu(sprekk.read_pvd(Path(folder) / "out" / "matrix.pvd")[-1][1])
        return matrix, sprekk.read_vtu(sprekk.read_pvd(fractures)[-1][1]) if fractures.exists() else None


def data(grid, name):
    """The values of a field, whatever its unit is called."""
    return next(values for key, values in grid.cell_data.items() if key.partition("[")[0] == name)


def error(sizes, values, exact):
    values, exact = values.reshape(len(sizes), -1), exact.reshape(len(sizes), -1)
    return sqrt((sizes @ (values - exact) ** 2).sum() / (sizes @ exact**2).sum())


MANUFACTURED = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0.12 1/Pa
    source: "(0.12*P + 0.5*((1-2*x)*sin(2*pi*y) + 2*pi*sin(2*pi*x)*cos(2*pi*y)) + 2*sin(2*pi*y) + 4*pi^2*P) 1/s"
    boundary: {left: {pressure: 0 Pa}, right: {pressure: 0 Pa}, bottom: {pressure: 0 Pa}, top: {pressure: 0 Pa}}
  rock:
    type: poromechanics/mpsa
    young_modulus: 2.5 Pa
    poisson_ratio: 0.25
    body_force: ["BX N/m^3", "BY N/m^3"]
    boundary: {left: {displacement: [0 m, 0 m]}, right: {displacement: [0 m, 0 m]}, bottom: {displacement: [0 m, 0 m]}, top: {displacement: [0 m, 0 m]}}
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0.5}]
schedule: [{solve: [pore, rock]}]
time: {end: 1 s, step: 1 s}
"""
P = "(x*(1-x)*sin(2*pi*y))"
PXX, PYY, PXY = "(-2*sin(2*pi*y))", f"(-4*pi^2*{P})", "((1-2*x)*2*pi*cos(2*pi*y))"
V = "(sin(2*pi*x)*sin(2*pi*y))"
VXX, VXY = f"(-4*pi^2*{V})", "(4*pi^2*cos(2*pi*x)*cos(2*pi*y))"
MANUFACTURED = (MANUFACTURED
                .replace("BX", f"(-({PXX}+{PYY}+2*({PXX}+{VXY})-0.5*(1-2*x)*sin(2*pi*y)))")
                .replace("BY", f"(-(2*{VXX}+2*({PXY}+{VXX})-0.5*x*(1-x)*2*pi*cos(2*pi*y)))").replace("*P", "*" + P))


def manufactured(size):
    grid, _ = run(MANUFACTURED, {"mesh": f"{{size: {size} m}}"})
    (x, y), areas = grid.centres_and_sizes()[0][:, :2].T, grid.centres_and_sizes()[1]
    p = x * (1 - x) * sin(2 * pi * y)
    u = np.column_stack([p, sin(2 * pi * x) * sin(2 * pi * y)])
    return len(areas), {"p": error(areas, data(grid, "pore.pressure"), p),
                        "u": error(areas, data(grid, "rock.displacement")[:, :2], u)}


def terzaghi(layers):
    grid, _ = run("verification/terzaghi.yaml", {"mesh.shape": "triangles", "mesh.cells": f"[{layers // 10}, {layers}]"})
    centres, areas = grid.centres_and_sizes()
    n = (np.arange(4000) + 0.5) * pi
    exact = (2 / n * sin(np.outer(centres[:, 1], n)) * (1 + 0.01 * n**2) ** -10.0).sum(axis=1)
    return len(areas), {"p": error(areas, data(grid, "pore.pressure"), exact)}


def mandel(size):
    young, nu, alpha, porosity, fluid, mobility, force = 40e9, 0.2, 0.8, 0.01, 4e-10, 5e-16, 1e7
    bulk, shear = young / (3 * (1 - 2 * nu)), young / (2 * (1 + nu))
    storage = porosity * fluid + (alpha - porosity) / bulk
    undrained = bulk + alpha**2 / storage
    skempton = alpha / (storage * undrained)
    nu_u = (3 * undrained - 2 * shear) / (2 * (3 * undrained + shear))
    diffusivity = mobility / (storage + alpha**2 / (bulk + 4 * shear / 3))
    ratio = (1 - nu) / (nu_u - nu)
    low, high = np.arange(400) * pi + 1e-9, (np.arange(400) + 0.5) * pi - 1e-12
    for _ in range(200):
        middle = (low + high) / 2
        above = tan(middle) > ratio * middle
        high, low = np.where(above, middle, high), np.where(above, low, middle)
    A = (low + high) / 2
    e = (1 + A**2 * diffusivity * 1079) ** -10.0 / (A - sin(A) * cos(A))
    grid, _ = run("verification/mandel.yaml", {"mesh": f"{{size: {size} m}}"})
    (x, y), areas = grid.centres_and_sizes()[0][:, :2].T, grid.centres_and_sizes()[1]
    waves = np.outer(x, A)
    p = 2 * force * skempton * (1 + nu_u) / 3 * ((cos(waves) - cos(A)) @ (sin(A) * e))
    uniform = (sin(A) * cos(A) * e).sum()
    unit = force / shear
    u = np.column_stack([(unit * nu / 2 - unit * nu_u * uniform) * x + unit * (sin(waves) @ (cos(A) * e)),
                         (-unit * (1 - nu) / 2 + unit * (1 - nu_u) * uniform) * y])
    return len(areas), {"p": error(areas, data(grid, "pore.pressure"), p),
                        "u": error(areas, data(grid, "rock.displacement")[:, :2], u)}


def single_mode(size, along=1.0, across=1.0):
    grid, fractures = run("verification/single_mode_fracture.yaml",
                          {"mesh.size": f"{size} m", "components.conduit.transmissivity_value": f"{along!r} m^3",
                           "components.conduit.normal_permeability_value": f"{across!r} m/(Pa*s)"})
    f, b = 1.0, along * pi / 2
    a = f + pi * b / across
    scale = 1 / (a * cosh(pi / 2) + b * sinh(pi / 2))
    (x, y), areas = grid.centres_and_sizes()[0][:, :2].T, grid.centres_and_sizes()[1]
    exact = scale * cos(pi * x) * (a * cosh(pi * abs(y)) + b * sinh(pi * abs(y)))
    centres, lengths = fractures.centres_and_sizes()
    values, in_fracture = data(fractures, "conduit.pressure"), scale * f * cos(pi * centres[:, 0])
    # Relative to the largest pressure, 1, as the pressure in the fracture may be as small as one likes.
    return len(areas), {"p": sqrt(areas @ (data(grid, "pore.pressure") - exact) ** 2 / areas.sum()),
                        "p_f": sqrt(lengths @ (values - in_fracture) ** 2 / lengths.sum())}


STEADY = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary: {left: {pressure: "EXACT Pa"}, right: {pressure: "EXACT Pa"}, bottom: {pressure: "EXACT Pa"}, top: {pressure: "EXACT Pa"}}
schedule: [{solve: pore}]
time: {end: 1 s, step: 1 s}
""".replace("EXACT", "(cos(pi*x)*cosh(pi*y))")


def steady(kind, structured):
    def measure(n):
        mesh = f"{{kind: structured, cells: [{n}, {n}]}}" if structured else f"{{size: {1.4 / n} m}}"
        grid, _ = run(STEADY, {"mesh": mesh, "components.pore.type": f"matrix_flow/{kind}"})
        (x, y), areas = grid.centres_and_sizes()[0][:, :2].T, grid.centres_and_sizes()[1]
        return len(areas), {"p": error(areas, data(grid, "pore.pressure"), cos(pi * x) * cosh(pi * y))}
    return measure


def crack(scene, component, peak):
    def measure(size):
        # The cells around the crack shrink with those on it.
        grid, fractures = run(scene, {"mesh": f"{{size: 32 m, fracture_size: {size} m, growth: {2 * size}}}"})
        centres, lengths = fractures.centres_and_sizes()
        x = np.linalg.norm(centres, axis=1)
        jump, exact = abs(data(fractures, f"contact.jump.{component}")), peak * sqrt(1 - x**2)
        inner = x < 0.85
        return len(grid.cells), {"jump": error(lengths, jump, exact),
                                 "jump without the outer 15 %": error(lengths[inner], jump[inner], exact[inner])}
    return measure


drop = 100e6 * (sin(pi / 9) * cos(pi / 9) - sin(pi / 9) ** 2 * tan(pi / 6))
CASES = {
    "manufactured Biot": (manufactured, (0.1, 0.05, 0.025, 0.0125)),
    "Terzaghi": (terzaghi, (20, 40, 80, 160)),
    "Mandel": (mandel, (0.1, 0.05, 0.025, 0.0125)),
    "single mode": (single_mode, (0.1, 0.05, 0.025, 0.0125)),
    "single mode, T = 1e4, kappa = 1e-4": (lambda size: single_mode(size, 1e4, 1e-4), (0.1, 0.05, 0.025, 0.0125)),
    "steady, MPFA, unstructured": (steady("mpfa", False), (10, 20, 40, 80)),
    "steady, TPFA, unstructured": (steady("tpfa", False), (10, 20, 40, 80)),
    "steady, TPFA, squares": (steady("tpfa", True), (10, 20, 40, 80)),
    "pressurized crack": (crack("verification/pressurized_crack.yaml", "normal", 4 / (10e9 / 0.96) * 1e6), (0.2, 0.1, 0.05, 0.025)),
    "frictional crack": (crack("verification/frictional_crack.yaml", "tangential", 4 / (25e9 / 0.9375) * drop), (0.2, 0.1, 0.05, 0.025)),
}


def main():
    rows = []
    for name, (measure, resolutions) in CASES.items():
        measured = [measure(resolution) for resolution in resolutions]
        rows += [(name, resolution, cells, quantity, value)
                 for resolution, (cells, errors) in zip(resolutions, measured) for quantity, value in errors.items()]
        quantities = list(measured[0][1])
        print(f"\n{name}\n\n| resolution | cells | " + " | ".join(f"{q} | order" for q in quantities) + " |")
        print("|---|---|" + "---|---|" * len(quantities))
        for i, (cells, errors) in enumerate(measured):
            line = f"| {resolutions[i]:g} | {cells:,} |"
            for q in quantities:
                # The order by the resolution that was asked for: cells far from a fracture do not shrink with it.
                finer = max(resolutions[i - 1] / resolutions[i], resolutions[i] / resolutions[i - 1]) if i else 1
                order = f"{np.log(measured[i - 1][1][q] / errors[q]) / np.log(finer):.2f}" if i else ""
                line += f" {errors[q]:.2e} | {order} |"
            print(line)
    with open(HERE / "convergence.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([("case", "resolution", "cells", "quantity", "relative_error"), *rows])
    draw(rows)


def draw(rows):
    panels = (("poroelasticity", 2, ("manufactured Biot", "Terzaghi", "Mandel")),
              ("flow", 2, ("single mode", "single mode, T = 1e4, kappa = 1e-4", "steady, MPFA, unstructured",
                           "steady, TPFA, unstructured", "steady, TPFA, squares")),
              ("cracks", 2, ("pressurized crack", "frictional crack")))
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.6), layout="constrained")
    for panel, (title, order, names) in zip(axes, panels):
        for color, name in enumerate(names):
            for marker, quantity in zip("os", dict.fromkeys(row[3] for row in rows if row[0] == name)):
                # A crack of 2 m in cells of so many metres, else the cells of the matrix.
                x, y = np.array([(2 / row[1] if title == "cracks" else row[2], row[4])
                                 for row in rows if row[0] == name and row[3] == quantity]).T
                panel.loglog(x, y, marker=marker, markersize=4, linewidth=1, color=f"C{color}",
                             linestyle="-" if marker == "o" else "--", label=f"{name}: {quantity}")
        low, high = panel.get_ylim()
        x = np.array(panel.get_xlim())
        panel.loglog(x, high * 0.5 * (x[0] / x) ** (order if title == "cracks" else order / 2), color="0.6", linewidth=0.8,
                     label=f"order {order}")
        panel.set(xlabel="cells on the crack" if title == "cracks" else "cells", title=title, ylim=(low * 0.02 if title == "flow" else low, high))
        panel.grid(alpha=0.3)
        panel.legend(fontsize=6.5, framealpha=0.6)
    axes[0].set_ylabel("relative error")
    figure.savefig(HERE / "convergence.png", dpi=100)


if __name__ == "__main__":
    main()
