#!/usr/bin/python3
"""Hydraulic fracture with Carter's leak-off, against tests/verification/references/kgd_leak_off.csv.

    tools/benchmark/kgd_leak_off.py [--program build/release/sprekk] [--regime toughness,viscosity] [--cells 30] [--size 0.5] [--depth 2]
                                    [--set key=value …] [--keep FOLDER]

The scene of kgd.py with fluid in the pores of the rock, which does not feel it (no Biot coupling): a fracture grows within steps from 5 to
CELLS cells in half-length, and has lost about half of its fluid then. The pressure in the pores is lower by so much that the pressure in
the fracture is constant beside it, and fluid goes DEPTH metres into the rock until the end: Carter's limit is that of a depth of many cells
and of a small part of the length. Prints how far length, inlet pressure and opening at the well are from the answer, in percent.
"""

import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import kgd
from kgd import PLANE_MODULUS, RATE, ROOT, VISCOSITY, read_table

DROP = 100e6  # Pa, from the fracture to the pores: the pressure in the fracture changes by 1 to 2 % of it
PORE_VISCOSITY = 1e-3  # Pa s
NUMBER = {"toughness": 8, "viscosity": 0}  # 8 is 0.1 % of length and 0.2 % of pressure from the limit
TAU = 0.0316228  # at the end, a row of the table: 45 % and 51 % of the fluid are in the fracture

PORES = """
components:
  pore:
    type: matrix_flow/mpfa
    permeability: {permeability:.10g} m^2
    viscosity: {viscosity} Pa*s
    storage: {storage:.10g} 1/Pa
    initial_pressure: -{drop} Pa
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture,      between: [contact, conduit]}}
  - {{type: two_level,     between: [rock, conduit, tips], propagation_threshold: 0.25}}
schedule:
  - solve: [pore, rock, conduit, contact]
  - grow: tips
    settle: [rock, contact]
    update: within_step
"""


class LeakOff:
    """The table in units of the scene; `cells` cells of `size` m at the time tau = TAU."""

    def __init__(self, regime, length_at_end):
        table = kgd.read("kgd_leak_off.csv")
        self.tau = table[:, 0]
        self.length_of = table[:, {"toughness": 1, "viscosity": 2}[regime]]
        self.opening_at_well, self.pressure_at_well = table[:, 4], table[:, 5]
        self.is_viscous = regime == "viscosity"
        self.a = (12 * VISCOSITY * RATE / PLANE_MODULUS) ** 0.25 if self.is_viscous else \
            2 * math.sqrt(math.pi) * kgd.toughness_of(NUMBER[regime]) / PLANE_MODULUS
        self.unit = length_at_end / self.interpolated(TAU, self.length_of)
        self.both_walls = 0.5 * (self.a**2 * RATE**2 / self.unit) ** 0.25  # C'
        self.time_unit = self.a**4 * RATE**2 / (2 * self.both_walls) ** 6

    def interpolated(self, tau, column):
        return math.exp(np.interp(math.log(tau), np.log(self.tau), np.log(column)))

    def at(self, time):
        """(half-length, pressure, opening) at the well."""
        tau = time / self.time_unit
        length = self.unit * self.interpolated(tau, self.length_of)
        if self.is_viscous:
            return (length, PLANE_MODULUS * self.a / math.sqrt(length) * self.interpolated(tau, self.pressure_at_well),
                    self.a * math.sqrt(length) * self.interpolated(tau, self.opening_at_well))
        pressure = kgd.toughness_of(NUMBER["toughness"]) / math.sqrt(math.pi * length)
        return length, pressure, 4 * pressure * length / PLANE_MODULUS

    def pores(self, depth):
        """The scene of pores into which fluid goes by `depth` (m), sqrt(c t), at the end."""
        diffusivity = depth**2 / (TAU * self.time_unit)
        storage = self.both_walls / 2 / DROP * math.sqrt(math.pi / diffusivity)  # C_L = (p - p_0) S sqrt(c/pi)
        return PORES.format(permeability=diffusivity * storage * PORE_VISCOSITY, viscosity=PORE_VISCOSITY, storage=storage, drop=DROP)


def run(program, regime, cells, size, depth, more, folder, steps=60, box=kgd.BOX):
    """Rows (half-length over its answer, pressure, opening over theirs), the table of the run, and its log."""
    answer = LeakOff(regime, cells * size)
    end = TAU * answer.time_unit
    text = kgd.SCENE.format(start=kgd.FIRST * size, far=4 * cells * size, growth=kgd.GROWTH, box=box * cells * size, size=size,
                            viscosity=VISCOSITY, half_rate=RATE / 2, toughness=kgd.toughness_of(NUMBER[regime]), increment=size, end=end, step=end / steps)
    scene, pores = Path(folder) / "kgd.yaml", Path(folder) / "pores.yaml"
    scene.write_text(text)
    pores.write_text(answer.pores(depth))
    command = [program, "run", str(ROOT / "configs/verification/kgd.yaml"), str(scene), str(pores), "-q", "-o", folder + "/run", "--set", "output.fields=false"]
    for setting in more:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        print(done.stderr.strip()[-600:])
    table = {name.partition("[")[0]: values for name, values in read_table(folder + "/run/history.csv").items()}
    rows = []
    for i, time in enumerate(table["time"]):
        length, pressure, opening = answer.at(time)
        rows.append((kgd.FIRST * size + table["tips.main_last.length"][i], length, table["pressure"][i] / pressure, table["opening.n"][i] / opening))
    return np.array(rows), table, done.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/sprekk"))
    parser.add_argument("--regime", default="toughness,viscosity")
    parser.add_argument("--cells", type=int, default=30, help="on one wing, at the end")
    parser.add_argument("--size", type=float, default=kgd.SIZE, help="of a cell, m")
    parser.add_argument("--depth", type=float, default=2, help="m, to which fluid goes into the rock")
    parser.add_argument("--set", action="append", default=[], help="key=value of the scene")
    parser.add_argument("--keep", help="folder for the results")
    arguments = parser.parse_args()
    print(f"{'regime':>10} {'cells':>6} {'length':>8} {'pressure':>9} {'opening':>8}  (percent from the answer)")
    for regime in arguments.regime.split(","):
        with tempfile.TemporaryDirectory() as temporary:
            folder = temporary
            if arguments.keep:
                folder = f"{arguments.keep}/{regime}"
                Path(folder).mkdir(parents=True, exist_ok=True)
            rows, table, _ = run(arguments.program, regime, arguments.cells, arguments.size, arguments.depth, arguments.set, folder)
            for part in (1 / 3, 2 / 3, 1):
                due = part * arguments.cells * arguments.size
                near = np.argmin(abs(rows[:, 1] - due))
                grown, length, pressure, opening = rows[near]
                print(f"{regime:>10} {length / arguments.size:6.1f} {100 * (grown / length - 1):8.2f} {100 * (pressure - 1):9.2f} {100 * (opening - 1):8.2f}",
                      flush=True)
            print(f"      {len(table['time'])} steps, to {table['time'][-1]:.4g} s", flush=True)


if __name__ == "__main__":
    main()
