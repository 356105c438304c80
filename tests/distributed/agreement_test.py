#!/usr/bin/python3
"""agreement_test.py SPREKK MPIEXEC: two processes give the answer of one.

Mandel's problem, on triangles, on a mesh of mostly quadrilaterals and with finite elements, and the scene of sec. 5.1, also with properties
that change with time and with fractures that cross and touch, and turned by 30 degrees, run in one process, and on two with
a distributed direct solver and with multigrid; a closed box, whose constant mode a sum of balances of both processes
determines, with the direct solver.
Every figure of history.csv agrees to 1e-8 of the largest of its column, and of its unit where the column is zero but for
round-off. And a run that shares so little among processes says so.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
root = Path(__file__).resolve().parents[2]
program, mpiexec = sys.argv[1:3]
configs = root / "configs"
small = ["--set", "mesh.size=0.2 m", "--set", "mesh.fracture_size=0.01 m", "--set", "time.end=9 h"]
in_time = [argument for value in ("young_modulus=(40e9*(1 - t/(100*h))) Pa", "permeability=(5e-20*(1 + t/h)) m^2",
                                  "biot_coefficient=0.8 - 0.005*t/h", "porosity=0.01*(1 + 0.02*t/h)",
                                  "friction=0.5 - 0.01*t/h") for argument in ("--set", "materials." + value)]
meeting = ["--set", "geometry.fractures.crossing={points: [[0.96, 1.01], [1.03, 1.01]]}",
           "--set", "geometry.fractures.touching={points: [[0.99, 0.99], [1.02, 0.97]]}"]
limited = ["--set", "components.pore.type=matrix_flow/ntpfa"]
elements = ["--set", "components.rock.type=poromechanics/fem", "--set", "components.rock.order=first"]
scenes = (("verification/mandel.yaml", []), ("verification/mandel.yaml", ["--set", "mesh.shape=quadrilaterals"]),
          ("verification/mandel.yaml", limited), ("paper/onset_coarse.yaml", small + limited),
          ("swaps/mandel_fem.yaml", []), ("paper/onset_coarse.yaml", small + elements),
          ("paper/onset_coarse.yaml", small), ("paper/onset_coarse.yaml", small + in_time),
          ("paper/onset_coarse.yaml", small + meeting), ("verification/closed_box.yaml", []),
          ("paper/onset_coarse.yaml", small + ["--turned"]))
# Multigrid does not converge for finite elements with fractures (docs/numerics/finite_elements.md).
direct_only = ("verification/closed_box.yaml",)
# Counts of iterations, and balance errors, which are differences of round-off, are not answers.
left_out = ("iterations[1]", "fluid_balance_error[m^2]")


def turned(scene, arguments, folder):
    """The changes that turn a scene by 30 degrees: no side is along an axis."""
    subprocess.run([str(root / "tools/turn_scene"), str(configs / scene), str(folder), "--angle", "30", "--program",
                    program] + arguments, check=True, capture_output=True, timeout=100)
    return [str(folder / "turned.yaml")] + [argument for pair in zip(arguments[::2], arguments[1::2])
                                            if not pair[1].startswith("mesh.") for argument in pair]


def history(command, scene, arguments, folder):
    if "--turned" in arguments:
        others = [argument for argument in arguments if argument != "--turned"]
        arguments = turned(scene, others[:len(small)], folder.with_name(folder.name + "_turned")) + others[len(small):]
    result = subprocess.run(command + ["run", "-q", str(configs / scene), "-o", str(folder)] + arguments,
                            capture_output=True, text=True, timeout=500)
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)} on {scene}: exit code {result.returncode}\n{result.stderr}")
    with open(folder / "history.csv", newline="") as file:
        return list(csv.DictReader(file))


def compare(scene, name, alone, together):
    if len(alone) != len(together):
        return [f"{scene}, {name}: {len(together)} steps instead of {len(alone)}"]
    unit_scale = {}
    for column in alone[0]:
        unit = column[column.rindex("["):]
        unit_scale[unit] = max([unit_scale.get(unit, 0)] + [abs(float(row[column])) for row in alone])
    failures = []
    for column in alone[0]:
        if column in left_out:
            continue
        largest = max(abs(float(row[column])) for row in alone)
        scale = max(largest, 1e-6 * unit_scale[column[column.rindex("["):]])
        worst = max(abs(float(a[column]) - float(b[column])) for a, b in zip(alone, together))
        if worst > 1e-8 * scale:
            failures.append(f"{scene}, {name}, {column}: differs by {worst / scale:.2e}")
    return failures


def is_said_to_share_too_little(folder):
    notes = json.loads((folder / "run.json").read_text())["notes"]
    return any(note["topic"] == "too few unknowns for several processes" for note in notes)


failures, compared = [], 0
with tempfile.TemporaryDirectory() as temporary:
    for number, (scene, arguments) in enumerate(scenes):
        stem = Path(temporary) / f"{number}_{Path(scene).stem}"
        alone = history([program], scene, arguments, stem.with_suffix(".one"))
        if is_said_to_share_too_little(stem.with_suffix(".one")):
            failures.append(f"{scene}: one process is said to share its unknowns")
        is_direct = scene in direct_only or arguments == small + elements
        for solver in ("mumps",) if is_direct else ("mumps", "belos"):
            together = history([mpiexec, "-n", "2", program], scene, arguments + ["--set", f"solver.type={solver}"],
                               stem.with_suffix("." + solver))
            failures += compare(scene, f"2 processes with {solver}", alone, together)
            if not is_said_to_share_too_little(stem.with_suffix("." + solver)):  # all scenes here are small
                failures.append(f"{scene}, 2 processes with {solver}: nothing says that one would be faster")
            compared += 1
print("\n".join(failures))
print(f"{compared} runs on two processes compared with one")
sys.exit(1 if failures else 0)
