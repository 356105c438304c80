#!/usr/bin/python3
"""Hydraulic fracture from viscosity to toughness, against tests/verification/references/kgd_self_similar.csv.

    tools/benchmark/kgd.py [--program build/release/sprekk] [--toughness 0.25,0.5,1,2,4] [--cells 30] [--update after_step]
                           [--set key=value …] [--scene overlay.yaml] [--keep FOLDER]

A straight fracture in a large impermeable rock, one half of it computed (configs/verification/kgd.yaml), grows from 5 to
CELLS cells of 0.5 m in half-length. Prints, where it has one third, two thirds and all of them, how far length, inlet
pressure and opening at the well are from the self-similar answer with toughness K = K'/(E'^3 mu' Q)^(1/4), in percent.
The answer is that of a fracture that began with no length: what is left of the start falls with time.
"""

import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/python"))
from sprekk import read_table  # noqa: E402

REFERENCES = ROOT / "tests/verification/references"
PLANE_MODULUS, RATE, VISCOSITY = 32e9, 1e-3, 1e-3  # Pa, m^2/s of both wings, Pa s
SIZE, FIRST = 0.5, 5  # m, cells
SMALL = 0.01  # toughness number that stands for 0: the answer is that of 0 to 1e-6
BOX = 80  # half-lengths at the end: one of 13 takes 0.1 to 0.2 % off the pressure
GROWTH = 0.1  # of cells with the distance from the fracture at the start: it grows into them; 0.2 costs 1 % of pressure at 60 cells
LARGEST_PLACE = 0.999  # of the half-length: the table of profiles ends there

SCENE = """
geometry:
  box: {{x: [0 m, {box} m], y: [-{box} m, {box} m]}}
  fractures:
    main: {{points: [[0 m, 0 m], [{start} m, 0 m]]}}
mesh: {{size: {far} m, fracture_size: {size} m, growth: {growth}}}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 30 GPa
    poisson_ratio: 0.25
    initial_stress: {{xx: -20 MPa, yy: 0 MPa, xy: 0 MPa}}
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: -20 MPa}}
  conduit:
    transmissivity: cubic_law
    transmissivity_value: null
    viscosity: {viscosity} Pa*s
    initial_aperture: 1 nm
    injection: {{well: {{at: [0 m, 0 m], rate: {half_rate} m^2/s}}}}
  tips: {{toughness: {toughness} Pa*m^0.5, growth: {{increment: {increment} m}}}}
time: {{end: {end} s, step: {step} s}}
"""
WITHIN_STEP = """
couplers:
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture,      between: [contact, conduit]}
  - {type: two_level,     between: [rock, conduit, tips], propagation_threshold: 0.25}
schedule:
  - solve: [rock, conduit, contact]
  - grow: tips
    settle: [rock, contact]
    update: within_step
"""
AFTER_STEP = """
schedule:
  - solve: [rock, conduit, contact]
  - {grow: tips, settle: [rock, contact], update: after_step}
"""


def read(name):
    rows = [line.split(",") for line in (REFERENCES / name).read_text().splitlines() if line[0].isdigit()]
    return np.array(rows, float)


class SelfSimilar:
    """gamma, Omega and Pi of kgd_self_similar.py for a toughness that its tables have."""

    def __init__(self, toughness):
        table, profiles = read("kgd_self_similar.csv"), read("kgd_profiles.csv")
        row = table[np.argmin(abs(table[:, 0] - toughness))]
        if abs(row[0] - toughness) > 1e-9:
            sys.exit(f"no reference for a toughness of {toughness:g}; there is one for {', '.join(map('{:g}'.format, table[:, 0]))}")
        self.gamma = row[1]
        self.opening_at_well, self.pressure_at_well = row[2], row[3]
        mine = profiles[abs(profiles[:, 0] - toughness) < 1e-9]
        self.profile = mine if len(mine) else None

    def time_of(self, length):
        return (length / self.gamma / (PLANE_MODULUS * RATE**3 / (12 * VISCOSITY)) ** (1 / 6)) ** 1.5

    def at(self, time, place=0):
        """(half-length, pressure, opening) at a place, m from the well."""
        scale = (PLANE_MODULUS * RATE**3 * time**4 / (12 * VISCOSITY)) ** (1 / 6)
        small = (12 * VISCOSITY / (PLANE_MODULUS * time)) ** (1 / 3)
        omega, pi = self.opening_at_well, self.pressure_at_well
        if place > 0 and self.profile is not None:
            xi = min(place / (self.gamma * scale), LARGEST_PLACE)
            omega = np.interp(xi, self.profile[:, 1], self.profile[:, 2])
            pi = np.interp(xi, self.profile[:, 1], self.profile[:, 3])
        return self.gamma * scale, small * PLANE_MODULUS * pi, small * scale * omega


def toughness_of(number):
    """K_IC in Pa m^0.5 from K = K'/(E'^3 mu' Q)^(1/4), K' = 4 sqrt(2/pi) K_IC."""
    return (number or SMALL) * (PLANE_MODULUS**3 * 12 * VISCOSITY * RATE) ** 0.25 / (4 * math.sqrt(2 / math.pi))


def run(program, number, cells, update, more, scenes, folder, size=SIZE):
    """Rows (half-length over that of the start, errors of length, pressure, opening in percent) by step, and the log."""
    answer = SelfSimilar(number)
    end = answer.time_of(cells * size)
    text = SCENE.format(start=FIRST * size, far=4 * cells * size, growth=GROWTH, box=BOX * cells * size, size=size, viscosity=VISCOSITY, half_rate=RATE / 2,
                        toughness=toughness_of(number), increment=size, end=end, step=end / 60)
    overlay = Path(folder) / "kgd.yaml"
    overlay.write_text(text + (WITHIN_STEP if update == "within_step" else AFTER_STEP))
    command = [program, "run", str(ROOT / "configs/verification/kgd.yaml"), str(overlay), *scenes, "-q", "-o", folder + "/run",
               "--set", "output.fields=false"]
    for setting in more:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        print(done.stderr.strip()[-600:])
    table = {name.partition("[")[0]: values for name, values in read_table(folder + "/run/history.csv").items()}
    rows = []
    for i, time in enumerate(table["time"]):
        length, pressure, opening = answer.at(time, 0.5 * size)
        rows.append((FIRST * size + table["tips.main_last.length"][i], length, table["pressure"][i] / pressure,
                     table["opening.n"][i] / opening, table["tips.main_last.K_eq"][i] / toughness_of(number)))
    return np.array(rows), table, done.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/sprekk"))
    parser.add_argument("--toughness", default="0.25,0.5,1,2,4")
    parser.add_argument("--cells", type=int, default=30, help="on one wing, at the end")
    parser.add_argument("--size", type=float, default=SIZE, help="of a cell, m")
    parser.add_argument("--update", default="after_step", choices=["after_step", "within_step"])
    parser.add_argument("--set", action="append", default=[], help="key=value of the scene")
    parser.add_argument("--scene", action="append", default=[], help="overlay")
    parser.add_argument("--keep", help="folder for the results")
    arguments = parser.parse_args()
    print(f"{'K':>5} {'cells':>6} {'length':>8} {'pressure':>9} {'opening':>8}  K_eq/K_IC   (percent from the answer)")
    for number in map(float, arguments.toughness.split(",")):
        with tempfile.TemporaryDirectory() as temporary:
            folder = temporary
            if arguments.keep:
                folder = f"{arguments.keep}/{number:g}"
                Path(folder).mkdir(parents=True, exist_ok=True)
            rows, table, _ = run(arguments.program, number, arguments.cells, arguments.update, arguments.set, arguments.scene,
                                 folder, arguments.size)
            for part in (1 / 3, 2 / 3, 1):
                due = part * arguments.cells * arguments.size
                near = np.flatnonzero((rows[:, 1] < 1.15 * due) & (rows[:, 1] > due / 1.15))
                if not len(near):
                    continue
                grown, length, pressure, opening, load = rows[near].T
                change = lambda values: 100 * (np.mean(values) - 1)
                print(f"{number:5g} {part * arguments.cells:6.0f} {change(grown / length):8.2f} {change(pressure):9.2f} "
                      f"{change(opening):8.2f}  {np.nanmin(load):.2f} to {np.nanmax(load):.2f}", flush=True)
            print(f"      {len(table['time'])} steps, to {table['time'][-1]:.4g} s")


if __name__ == "__main__":
    main()
