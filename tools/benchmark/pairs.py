#!/usr/bin/python3
"""tools/benchmark/pairs.py SPREKK [--sizes 0.05,0.025,0.0125] [--flow ntpfa] [--draw]: work against error of every kind of flow with every kind of rock.

The manufactured solution of Biot's equations (configs/verification/biot_manufactured.yaml) on unstructured triangles, one thread, MUMPS.
Errors are relative L2 norms: of the pressure at cell centres; of the displacement where it is an unknown, at cell centres (mpsa) or at
nodes (fem), weighted by areas. Writes docs/pictures/bench/pairs.csv and pairs.png and prints a table; --flow measures one flow anew and keeps the other rows of the
CSV, --draw draws from the CSV alone.
Broken lines are figures of others on the same problem, one thread with MUMPS, by PorePy (MPFA/MPSA) and by a general finite-element
library (P2-P1), both at cell centres."""

import argparse
import csv
import shutil
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from cases import run_scene, solved_in  # noqa: E402
from run_results import ROOT, RunResults, named, relative_error  # noqa: E402

FLOWS = ["mpfa", "tpfa", "rt0", "ntpfa"]
ROCKS = {"mpsa": {}, "fem first": {"components.rock.order": "first"}, "fem second": {"components.rock.order": "second"}}
COLOURS = {"mpfa": "#1b6ca8", "tpfa": "#c8553d", "rt0": "#3a7d44", "ntpfa": "#8e5ea2"}
MARKERS = {"mpsa": "o", "fem first": "v", "fem second": "s"}
# Cells, error of p, error of u, processor seconds without the mesh.
OTHERS = {"PorePy, MPFA/MPSA": [(944, 5.6e-3, 9.5e-3, .50), (3712, 1.4e-3, 2.4e-3, 1.07), (14788, 3.5e-4, 6.0e-4, 3.9)],
          "P2-P1": [(946, 1.0e-2, 2.7e-4, .10), (3704, 2.6e-3, 3.7e-5, .19), (14786, 6.5e-4, 5.7e-6, .90)]}
FILES = ROOT / "docs/pictures/bench"


def exact(points):
    x, y = points[:, 0], points[:, 1]
    pressure = x * (1 - x) * np.sin(2 * np.pi * y)
    return pressure, np.column_stack([pressure, np.sin(2 * np.pi * x) * np.sin(2 * np.pi * y)])


def at_nodes(run):
    """The displacement of nodes, with a share of the area of the cells around each."""
    grid = run.matrix
    weights = np.zeros(len(grid.points))
    for nodes, area in zip(grid.cells, run.areas):
        weights[nodes] += area / len(nodes)
    return weights, named(grid.point_data, "rock.displacement")[:, :2], exact(grid.points)[1]


def measured(program, flow, rock, size):
    scratch = Path(tempfile.mkdtemp())
    try:
        settings = {"components.pore.type": f"matrix_flow/{flow}", "components.rock.type": f"poromechanics/{rock.split()[0]}",
                    "mesh.size": f"{size} m", "solver.type": "mumps", **ROCKS[rock]}
        wall, processor = run_scene(program, ROOT / "configs/verification/biot_manufactured.yaml", settings, scratch / "run", 300)
        run = RunResults(scratch / "run")
        pressure, displacement = exact(run.centres)
        if rock == "mpsa":
            of_displacement = run.areas, run.matrix_field("rock.displacement"), displacement
        else:
            of_displacement = at_nodes(run)
        solved = solved_in(run.record, wall, processor)
        return {"flow": flow, "rock": rock, "cells": solved["cells"], "unknowns": solved["unknowns"],
                "error of p": relative_error(run.areas, run.matrix_field("pore.pressure"), pressure),
                "error of u": relative_error(*of_displacement), "seconds": solved["seconds"], "commit": solved["commit"][:7]}
    finally:
        shutil.rmtree(scratch)


def draw(rows):
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.8), sharex=True)
    for panel, quantity, index in zip(panels, ("error of p", "error of u"), (1, 2)):
        for flow in FLOWS:
            for rock in ROCKS:
                curve = sorted((float(row["seconds"]), float(row[quantity])) for row in rows if (row["flow"], row["rock"]) == (flow, rock))
                panel.loglog(*zip(*curve), color=COLOURS[flow], marker=MARKERS[rock], markersize=5, linewidth=1.2,
                             label=f"{flow} × {rock}")
        for (name, points), grey in zip(OTHERS.items(), ("#555555", "#aaaaaa")):
            panel.loglog([p[3] for p in points], [p[index] for p in points], "--", color=grey, marker="x", label=name)
        panel.set_xlabel("processor seconds, without the mesh")
        panel.set_ylabel(f"{quantity}, relative L2")
        panel.grid(True, which="major", alpha=0.3)
    panels[1].legend(fontsize=7, ncol=2)
    figure.tight_layout()
    figure.savefig(FILES / "pairs.png", dpi=110)


def print_table(rows):
    print("| flow × rock | cells | error of p | error of u | seconds |\n|---|---|---|---|---|")
    for flow in FLOWS:
        for rock in ROCKS:
            line = [row for row in rows if (row["flow"], row["rock"]) == (flow, rock)]
            cells = [" / ".join(form(row[key]) for row in line) for key, form in
                     (("cells", lambda v: f"{int(v):,}"), ("error of p", lambda v: f"{float(v):.1e}"),
                      ("error of u", lambda v: f"{float(v):.1e}"), ("seconds", lambda v: f"{float(v):.2g}"))]
            print(f"| `{flow}` × `{rock}` | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", type=Path)
    parser.add_argument("--sizes", default="0.05,0.025,0.0125")
    parser.add_argument("--flow", choices=FLOWS)
    parser.add_argument("--draw", action="store_true")
    options = parser.parse_args()
    table = FILES / "pairs.csv"
    if options.draw:
        rows = list(csv.DictReader(open(table)))
    else:
        if not options.program:
            parser.error("the program is missing")
        kept = [row for row in csv.DictReader(open(table)) if row["flow"] != options.flow] if options.flow else []
        rows = kept + [measured(str(options.program.resolve()), flow, rock, size) for size in options.sizes.split(",")
                       for flow in ([options.flow] if options.flow else FLOWS) for rock in ROCKS]
        with open(table, "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    draw(rows)
    print_table(rows)


if __name__ == "__main__":
    main()
