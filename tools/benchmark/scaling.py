#!/usr/bin/python3
"""scaling.py PROGRAM FOLDER [--scene plane|fem|space …] [--processes 1 2 4] [--size FACTOR]

Counts what processes do alone, keep and say to one another, in flow and rock with two fractures in a plane (`plane`: mpfa and
mpsa, `fem`: mpfa and finite elements of first order) and in flow with two fractures in space (`space`, with sprekk-space beside
PROGRAM). For each number of processes a row for each process: processor seconds outside of MPI in all and by phase, largest
memory, and messages and bytes that Sprekk and its solvers give to MPI. Processes may share cores: the table has no wall time.
The count is made by message_counter.cpp, which is compiled into FOLDER. It needs mpicxx and Open MPI.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
from pathlib import Path

PLANE = """
name: scaling
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 6 m]}
  fractures:
    crack: {points: [[4 m, 2 m], [6 m, 4 m]]}
    other: {points: [[2 m, 3.5 m], [3.5 m, 2.5 m]]}
mesh: {size: SIZE_1 m, fracture_size: SIZE_2 m}
materials: {young_modulus: 20 GPa, poisson_ratio: 0.25, biot_coefficient: 0.8, porosity: 0.05, fluid_compressibility: 4.5e-10 1/Pa,
            permeability: 1e-17 m^2, viscosity: 1 mPa*s, friction: 0.6, dilation_angle: 2 deg}
components:
  pore: {type: matrix_flow/mpfa, initial_pressure: 5 MPa, boundary: {left: {pressure: 5 MPa}}}
  rock:
    type: ROCK
    boundary:
      left: {displacement_x: 0 m}
      bottom: {displacement_y: 0 m}
      right: {normal_stress: -25 MPa}
      top: {normal_stress: -12 MPa}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.2 mm
    initial_pressure: 5 MPa
    injection: {well: {fracture: crack, at: [5 m, 3 m], rate: 1e-7 m^2/s}}
  contact: {type: contact/coulomb}
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
schedule:
  - solve: [pore, rock, conduit, contact]
time: {end: 12 h, step: 4 h}
output: {every: 12 h, probes: {pressure: {of: conduit.pressure, fracture: crack, at: [5 m, 3 m]}}}
"""

SPACE = """
name: scaling
geometry:
  box: {x: [-80 m, 80 m], y: [-80 m, 80 m], z: [-80 m, 80 m]}
  fractures:
    fault: {center: [0 m, 0 m, 0 m], strike: 30 deg, dip: 60 deg, radius: 40 m}
    second: {center: [10 m, 45 m, 10 m], strike: 120 deg, dip: 50 deg, radius: 20 m}
mesh: {size: SIZE_1 m, fracture_size: SIZE_2 m, growth: 1}
materials: {viscosity: 1 mPa*s, fluid_compressibility: 4.5e-10 1/Pa}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-17 m^2
    porosity: 0.02
    initial_pressure: 15 MPa
    boundary: {left: {pressure: 15 MPa}, right: {pressure: 15 MPa}, top: {pressure: 15 MPa}}
  conduit:
    type: fracture_flow/mfd
    initial_aperture: 0.1 mm
    initial_pressure: 15 MPa
    injection: {well: {fracture: fault, at: [0 m, 0 m, 0 m], rate: 4e-5 m^3/s}}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
schedule:
  - solve: [pore, conduit]
time: {end: 3 day, step: 1 day}
output: {every: 3 day, probes: {pressure: {of: conduit.pressure, fracture: fault, at: [0 m, 0 m, 0 m]}}}
"""

# The text, the type of the rock, and edges of rock and fractures that give about 56,000 triangles or 59,000 tetrahedra.
SCENES = {
    "plane": (PLANE, "poromechanics/mpsa", 0.05, 0.04),
    "fem": (PLANE, "poromechanics/fem", 0.05, 0.04),
    "space": (SPACE, "", 7, 4),
}
PHASES = ("linear: ordering", "linear: factorization", "linear: solve", "steps", "output")


def scene_text(name, factor):
    text, rock, size, fracture_size = SCENES[name]
    if name == "fem":
        text = text.replace("    type: ROCK\n", "    type: ROCK\n    order: first\n")
    return text.replace("ROCK", rock).replace("SIZE_1", f"{factor * size:.6g}").replace("SIZE_2", f"{factor * fracture_size:.6g}")


def compile_counter(folder):
    source, library = Path(__file__).with_name("message_counter.cpp"), folder / "message_counter.so"
    subprocess.run(["mpicxx", "-std=c++20", "-O1", "-shared", "-fPIC", source, "-o", library, "-ldl"], check=True)
    return library


def counted(path):
    """Seconds, bytes of memory, and messages and bytes of Sprekk's own calls and of its solvers'."""
    result = {"seconds": 0.0, "memory": 0.0, "own": [0, 0.0], "solvers": [0, 0.0]}
    with open(path, newline="") as file:
        for row in csv.reader(file):
            if len(row) == 2:
                result[row[0]] = float(row[1])
                continue
            whose = result["own" if row[0].startswith("sprekk") and "trilinos" not in row[0] else "solvers"]
            whose[0] += int(row[2])
            whose[1] += float(row[3])
    return result


def run(program, scene, processes, library, folder):
    folder.mkdir(parents=True, exist_ok=True)
    settings = {"LD_PRELOAD": library, "MESSAGE_COUNTER": folder / "counts", "OPENBLAS_NUM_THREADS": 1}
    command = ["mpirun", "-n", processes, "--oversubscribe", "--bind-to", "none", "env", *(f"{k}={v}" for k, v in settings.items()),
               program, "run", scene, "-o", folder / "run", "--set", "output.fields=false"]
    result = subprocess.run([str(word) for word in command], env={**os.environ, "OMPI_MCA_mpi_yield_when_idle": "1"},
                            capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{scene} on {processes} processes: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return [counted(folder / f"counts.{rank}") for rank in range(processes)], json.loads((folder / "run/run.json").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--scene", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--processes", nargs="+", type=int, default=[1, 2, 4])
    parser.add_argument("--size", type=float, default=1, metavar="FACTOR", help="of all edges")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    library = compile_counter(options.folder)
    print(f"{'scene':>6} {'processes':>9} {'rank':>4} {'cells':>7} {'seconds':>8} {'MB':>6} {'messages':>9} {'MB sent':>8}"
          f" {'of solvers':>10} {'MB sent':>8}  first process: {', '.join(PHASES)}, the rest")
    for name in options.scene:
        scene = options.folder / f"{name}.yaml"
        scene.write_text(scene_text(name, options.size))
        program = options.program.with_name("sprekk-space") if name == "space" else options.program
        for processes in options.processes:
            counts, record = run(program.resolve(), scene, processes, library.resolve(), options.folder / f"{name}_{processes}")
            seconds = {entry["name"]: entry["seconds"] for entry in record["profile"]}
            phases = [seconds.get(phase, 0.0) for phase in PHASES]
            phases.append(counts[0]["seconds"] - sum(phases))
            for rank, count in enumerate(counts):
                print(f"{name:>6} {processes:>9} {rank:>4} {record['counters']['mesh: cells']:>7} {count['seconds']:>8.2f}"
                      f" {count['memory'] / 1e6:>6.0f} {count['own'][0]:>9} {count['own'][1] / 1e6:>8.1f} {count['solvers'][0]:>10}"
                      f" {count['solvers'][1] / 1e6:>8.1f}" + ("  " + ", ".join(f"{phase:.2f}" for phase in phases) if rank == 0 else ""),
                      flush=True)


if __name__ == "__main__":
    main()
