#!/usr/bin/env python3
"""output_lines_test.py SPREKK: tables along lines have a linear pressure and its velocity exactly, also on two processes and after a
restart, files have the chosen fields, and what cannot be written is refused before any work."""

import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

program = sys.argv[1]

# p = (1 + t/s) (x + 2 y)/m Pa on all sides, without storage.
SCENE = """
name: lines
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
mesh: {size: 0.2 m}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-12 m^2
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary:
      left: {pressure: ((1 + t)*(x + 2*y)) Pa}
      right: {pressure: ((1 + t)*(x + 2*y)) Pa}
      bottom: {pressure: ((1 + t)*(x + 2*y)) Pa}
      top: {pressure: ((1 + t)*(x + 2*y)) Pa}
schedule: [{solve: pore}]
time: {end: 4 s, step: 1 s}
output:
  every: 2 s
  fields: false
  lines:
    across: {of: pore.pressure, from: [0.2 m, 0.9 m], to: [1.9 m, 0.1 m], points: 7}
    flow: {of: pore.velocity, from: [0.2 m, 0.1 m], to: [1.9 m, 0.7 m], points: 2}
"""


def run(scene, folder, *more, processes=1):
    launcher = ["mpirun", "-n", str(processes)] if processes > 1 else []
    subprocess.run([*launcher, program, "run", scene, "-q", "-o", str(folder), *more], check=True)


def check(folder):
    with open(folder / "line_across.csv", encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    assert [row["time[s]"] for row in rows] == [0] * 7 + [2] * 7 + [4] * 7, rows
    for i, row in enumerate(rows):
        share = i % 7 / 6
        x, y = 0.2 + 1.7 * share, 0.9 - 0.8 * share
        assert abs(row["x[m]"] - x) < 1e-12 and abs(row["y[m]"] - y) < 1e-12, row
        assert abs(row["distance[m]"] - share * (1.7**2 + 0.8**2) ** 0.5) < 1e-12, row
        expected = 0 if row["time[s]"] == 0 else (1 + row["time[s]"]) * (x + 2 * y)
        assert abs(row["pore.pressure[Pa]"] - expected) < 1e-10, (row, expected)
    with open(folder / "line_flow.csv", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    for axis, velocity in (("x", -5e-12), ("y", -10e-12)):
        assert abs(float(last[f"pore.velocity.{axis}[m/s]"]) / velocity - 1) < 1e-10, last
    assert not list(folder.glob("*.vtu"))


def expect_refusal(scene, setting, *words):
    done = subprocess.run([program, "check", scene, "--set", f"output{setting}"], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and all(word in done.stderr for word in words), done


with tempfile.TemporaryDirectory() as name:
    scratch = Path(name)
    path = str(scratch / "scene.yaml")
    Path(path).write_text(SCENE, encoding="utf-8")
    run(path, scratch / "one")
    check(scratch / "one")
    run(path, scratch / "two", processes=2)
    check(scratch / "two")

    # Rows that are later than the checkpoint are written anew.
    run(path, scratch / "on", "--set", "time.end=2 s")
    table = scratch / "on/line_across.csv"
    table.write_text(table.read_text(encoding="utf-8") + "3,0,0,0,77\n", encoding="utf-8")
    subprocess.run([program, "run", path, "-q", "--restart", str(scratch / "on/checkpoint.h5")], check=True)
    check(scratch / "on")

    line = "{of: pore.pressure, from: [0 m, 0 m], to: [1 m, 0 m]}"
    expect_refusal(path, ".lines.a=" + line.replace("pressure", "presure"), "unknown field", "pore.pressure")
    expect_refusal(path, ".lines.a=" + line.replace("1 m", "3 m"), "leaves the rock")
    expect_refusal(path, ".lines.a=" + line.replace("1 m", "0 m"), "no length")
    expect_refusal(path, ".lines={a/b: " + line + "}", "'/'")
    expect_refusal(path, ".lines.a=" + line.replace("}", ", points: 1}"), "points")

    # Of the fields for ParaView those that are chosen, on one process and on two.
    for processes in (1, 2):
        for chosen, kept in (("pore.pressure", {"pore.pressure[Pa]"}), ("[pore.*]", {"pore.pressure[Pa]", "pore.velocity[m/s]"})):
            folder = scratch / f"chosen_{len(chosen)}_{processes}"
            run(path, folder, "--set", "output.fields=true", "--set", f"output.only={chosen}", processes=processes)
            names = set(re.findall(r'Name="(pore[^"]*)"', (folder / "matrix_000004.vtu").read_text(encoding="latin-1")))
            assert names == kept, (chosen, names)
    expect_refusal(path, ".only=[pore.presure]", "no fields are written")
    for wrong in ("pore.presure", "rock.*", "pore"):
        expect_refusal(path, f"={{fields: true, only: [pore.pressure, {wrong}]}}", "unknown field", wrong, "pore.velocity")
    print("outputs: as they should be")
