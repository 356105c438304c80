#!/usr/bin/python3
"""growth_agreement_test.py SPREKK MPIEXEC: fractures grow on several processes as they do on one.

Each scene that grows, shortened to its first growth: before it every figure of history.csv agrees to 1e-8 of the largest
of its unit; the first growth comes in the same step, with all factors to 1e-6 and lengths to 1e-4. On three processes,
too, where tips belong to others than on two; and when a run on two goes on from a checkpoint. Balances close on all of them.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

program, mpiexec = sys.argv[1:3]
configs = Path(__file__).resolve().parents[2] / "configs"


def settings(*values):
    return [argument for value in values for argument in ("--set", value)]


quick = settings("mesh.size=0.5 m", "mesh.growth=0.6", "components.tips.sectors=8", "components.tips.size=0.3 m",
                 "components.tips.toughness=0.42 MPa*m^0.5", "time.step=10 min", "time.end=10 min",
                 "output.fields=false")
# The tips that grow, and what they stand in: two sides of a box of 2 m, cut by the border between processes.
scenes = {
    "wing_cracks": ("paper/wing_cracks.yaml", quick + settings(
        "components.conduit.injection.well.rate=4.0e-8 m^2/s", "time.stop={of: tips.main_last.length, reaches: 1e-6 m}")),
    "three_fractures": ("paper/three_fractures.yaml", quick + settings(
        "components.conduit.injection.well.rate=4.0e-8 m^2/s",
        "time.stop={of: tips.second_last.length, reaches: 1e-6 m}")),
    "joining_fractures": ("tutorial/joining_fractures.yaml", quick + settings(
        "components.conduit.injection.well.rate=4.0e-8 m^2/s", "time.stop={of: tips.main_last.length, reaches: 1e-6 m}")),
    "wings_sealed": ("verification/wings_sealed.yaml", settings(
        "mesh.size=1 m", "mesh.growth=0.5", "time.start=7.9 h", "time.step=0.1 h", "time.end=8.4 h",
        "components.tips.sectors=8", "time.stop={of: tips.main_last.length, reaches: 1e-6 m}")),
    "kgd": ("verification/kgd.yaml", settings(
        "mesh.size=150 m", "mesh.fracture_size=2 m", "mesh.growth=0.5", "components.tips.sectors=8",
        "components.tips.growth={increment: 1 m}", "time.stop={of: tips.main_last.length, reaches: 1e-6 m}")),
}
on_three = ("wing_cracks", "wings_sealed")
# What is left of figures that cancel.
left_out = ("fluid_balance_error[m^2]", "iterations[1]")


def run(processes, arguments, folder):
    command = [program] if processes == 1 else [mpiexec, "-n", str(processes), program]
    result = subprocess.run(command + ["run", "-q"] + arguments, capture_output=True, text=True, timeout=300)
    if result.returncode != 0:
        return None, f"{processes} processes, {' '.join(arguments)}: exit code {result.returncode}\n{result.stderr}"
    with open(folder / "history.csv", newline="") as file:
        return list(csv.DictReader(file)), ""


def grown(row):
    return sum(float(value) for name, value in row.items() if name.startswith("tips.") and name.endswith("length[m]"))


def tolerance(column, has_grown):
    if not has_grown:
        return 1e-8
    return 1e-4 if column.endswith(".length[m]") else 1e-6


def compare(name, alone, together):
    if len(alone) != len(together):
        return [f"{name}: {len(together)} steps up to the first growth instead of {len(alone)}"]
    scale = {}
    for column in alone[0]:
        unit = column[column.rindex("["):]
        scale[unit] = max([scale.get(unit, 0)] + [abs(float(row[column])) for row in alone if row[column]])
    failures = []
    for number, (a, b) in enumerate(zip(alone, together)):
        for column in a:
            # The error estimate of a factor is a difference of factors: its digits are theirs.
            if column in left_out or column.endswith("K_error_fine_mesh[Pa*m^0.5]"):
                continue
            if not a[column] or not b[column]:
                if a[column] != b[column]:
                    failures.append(f"{name}, step {number + 1}, {column}: '{b[column]}' instead of '{a[column]}'")
                continue
            difference = abs(float(a[column]) - float(b[column]))
            of = scale[column[column.rindex("["):]]
            if difference > tolerance(column, grown(a) > 0) * of:
                failures.append(f"{name}, step {number + 1}, {column}: {b[column]} instead of {a[column]}")
    return failures


def notes(name, folder, processes):
    """Runs this small say that they share too little."""
    told = json.loads((folder / "run.json").read_text())["notes"]
    says = any("takes longer than one alone" in note["text"] for note in told)
    return [] if says == (processes > 1) else [f"{name}: says so of {processes} processes: {says}"]


def balance_error(name, rows):
    column = "fluid_balance_error[m^2]"
    if column not in rows[0]:
        return []
    throughput = max(max(abs(float(row[f"fluid_{what}[m^2]"])) for what in ("stored", "injected", "outflow"))
                   for row in rows)
    worst = max(abs(float(row[column])) for row in rows)
    return [f"{name}: the balance is off by {worst / throughput:.2e}"] if worst > 1e-7 * throughput else []


def main():
    failures, compared = [], 0
    with tempfile.TemporaryDirectory() as temporary:
        for name, (scene, arguments) in scenes.items():
            base = [str(configs / scene)] + arguments
            folder = Path(temporary) / name
            alone, wrong = run(1, base + ["-o", str(folder)], folder)
            if wrong or grown(alone[-1]) == 0:
                failures.append(wrong or f"{name}: nothing has grown")
                continue
            failures += balance_error(name, alone) + notes(name, folder, 1)
            for processes in (2, 3) if name in on_three else (2,):
                title, folder = f"{name} on {processes}", Path(temporary) / f"{name}_{processes}"
                together, wrong = run(processes, base + ["-o", str(folder)], folder)
                failures += [wrong] if wrong else (compare(title, alone, together) + balance_error(title, together)
                                                   + notes(title, folder, processes))
                compared += 1
            if len(alone) < 2:
                continue
            # Ended before the growth, then gone on with.
            title, folder = f"{name}, gone on with on 2", Path(temporary) / f"{name}_parts"
            half = settings(f"time.end={alone[len(alone) // 2 - 1]['time[s]']} s")
            _, wrong = run(2, base + half + ["-o", str(folder)], folder)
            if not wrong:
                together, wrong = run(2, base + ["--restart", str(folder / "checkpoint.h5")], folder)
            failures += [wrong] if wrong else compare(title, alone, together)
            compared += 1
    print("\n".join(failures))
    print(f"{compared} runs on several processes compared with one")
    return 1 if failures else 0


sys.exit(main())
