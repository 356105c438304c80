#!/usr/bin/python3
"""stop_at_boundary_test.py SPREKK [MPIEXEC]: wings that grow within steps come as near to the boundary as the mesh allows.

A fracture that is filled at a constant rate grows through a square until it is a cell away from two sides. It does so
whatever its increments are, and a note tells it; turned by 90 degrees, with the rate times 1 + 1e-9 and on two processes, too."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

program = [sys.argv[1]]
on_two = [*sys.argv[2:], "-n", "2", *program] if len(sys.argv) > 2 else program
CELL = 0.025


def scene(increment, is_upright, factor):
    ends = [[0.33, 0.52], [0.53, 0.55]]
    if is_upright:
        ends = [[y, x] for x, y in ends]
    return f"""
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}, fractures: {{main: {{points: {ends}}}}}}}
mesh: {{size: 0.15 m, fracture_size: {CELL} m, growth: 0.3}}
materials: {{young_modulus: 40 GPa, poisson_ratio: 0.2, viscosity: 1.0e-4 Pa*s, fluid_compressibility: 4.0e-10 1/Pa, friction: 0.5}}
components:
  rock:
    type: poromechanics/mpsa
    boundary: {{left: {{displacement_x: 0 m}}, bottom: {{displacement_y: 0 m}}, right: {{normal_stress: -10 MPa}}, top: {{normal_stress: -10 MPa}}}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    injection: {{well: {{fracture: main, rate: {{value: {1e-8 * factor!r} m^2/s}}}}}}
  contact: {{type: contact/coulomb}}
  tips:
    type: fine_fracture/quarter_point
    size: 0.3 m
    toughness: 0.7 MPa*m^0.5
    growth: {{increment: {increment} m, front_tolerance: 1e-4}}
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
  - {{type: two_level, between: [rock, conduit, tips, contact]}}
schedule:
  - solve: [rock, conduit, contact]
  - grow: tips
    settle: [rock, contact]
    update: within_step
time: {{end: 1 h, step: 10 min}}
"""


def distances(folder, increment, is_upright, factor, command):
    """Of both tips from the side ahead, m, at the end; and whether a note tells of each that it has stopped."""
    folder.mkdir()
    (folder / "scene.yaml").write_text(scene(increment, is_upright, factor))
    result = subprocess.run([*command, "run", folder / "scene.yaml", "-o", folder / "out"], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"exit code {result.returncode}\n{result.stderr}")
    with open(folder / "out/history.csv", newline="") as file:
        last = list(csv.DictReader(file))[-1]
    axis = "y" if is_upright else "x"
    first, end = (float(last[f"tips.main_{tip}.{axis}[m]"]) for tip in ("first", "last"))
    is_told = [f"tips.main_{tip} stops at" in result.stdout + result.stderr for tip in ("first", "last")]
    return [first, 1 - end], is_told


failures = []
with tempfile.TemporaryDirectory() as folder:
    # The last growth is unstable: where a jump ends differs by some hundredths of a cell between twins.
    for number, (increment, is_upright, factor, command) in enumerate((
            (0.025, False, 1.0, program), (0.1, False, 1.0, program), (0.1, True, 1.0, program),
            (0.1, False, 1 + 1e-9, program), (0.1, False, 1.0, on_two))):
        case = f"increment {increment} m, {'upright' if is_upright else 'level'}, {' '.join(command)}, rate times {factor!r}"
        found, is_told = distances(Path(folder) / str(number), increment, is_upright, factor, command)
        print(case, found)
        if not all(0.75 * CELL < distance < 1.05 * CELL for distance in found):
            failures.append(f"{case}: tips end {found} m before the sides, not a cell of {CELL} m")
        if not all(is_told):
            failures.append(f"{case}: no note tells that the tips have stopped")
print("\n".join(failures) or "tips end a cell before the sides")
sys.exit(bool(failures))
