#!/usr/bin/python3
"""The tracers of cases 3 and 4 of Berre and others, Adv. Water Resour. 147 (2021) 103759, against the published solutions.

    tools/benchmark/tracers_in_space.py small_features|field [--program build/release/sprekk-space] [--scheme upwind] [--set key=value …] [--keep FOLDER]

Mean concentrations in the fractures at the times of tests/verification/references/berre_*_tracer.csv: how far each is from the mean of the
participants, in percent of the concentration that enters and in their standard deviations. The flow is that of the scenes
configs/verification/berre_small_features.yaml and tests/verification/scenes/berre_field.yaml; porosities of rock and fractures are 0.2.
"""

import argparse
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/python"))
from sprekk import Results  # noqa: E402

CASES = {"small_features": (ROOT / "configs/verification/berre_small_features.yaml", ("inlet",), 1.0, 0.01),
         "field": (ROOT / "tests/verification/scenes/berre_field.yaml", ("inlet_back", "inlet_left"), 600.0, 50.0)}
APERTURE = "2 mm"  # 1 cm, of which a fifth are pores
TRACER = """
components:
  conduit: {{initial_aperture: {aperture}}}
  salt:
    type: matrix_transport/tpfa
    porosity: 0.2
    diffusion: 1e-14 m^2/s  # none in the benchmark
    boundary: {{{inlets}}}
  water: {{type: fracture_transport/tpfa, aperture: {aperture}, diffusion: 1e-14 m^2/s}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: tracer_advection, between: [pore, conduit, salt, water], scheme: {scheme}}}
  - {{type: tracer_exchange, between: [salt, water]}}
schedule: [{{solve: [pore, conduit]}}, {{solve: [salt, water]}}]
time: {{end: {end} s, step: {step} s}}
output:
  fields: false
  probes: {{{probes}}}
"""


def fractures_of(scene):
    """The names of the fractures of a scene, in its order."""
    table = scene.with_suffix(".csv")
    if table.exists():
        with open(table, encoding="utf-8") as lines:
            return list(dict.fromkeys(row["name"] for row in csv.DictReader(lines)))
    lines = scene.read_text(encoding="utf-8").split("  fractures:\n")[1].split("  sides:\n")[0].splitlines()
    return [line.split(":")[0].strip() for line in lines]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=CASES)
    parser.add_argument("--program", default=ROOT / "build/release/sprekk-space", type=Path)
    parser.add_argument("--scheme", default="upwind")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    scene, inlets, end, step = CASES[options.case]
    names = fractures_of(scene)
    published = np.loadtxt(ROOT / f"tests/verification/references/berre_{options.case}_tracer.csv", delimiter=",")
    with tempfile.TemporaryDirectory() as holder:
        folder = options.keep or Path(holder)
        folder.mkdir(parents=True, exist_ok=True)
        overlay = folder / "tracer.yaml"
        overlay.write_text(TRACER.format(aperture=APERTURE, scheme=options.scheme, end=end, step=step,
                                         inlets=", ".join(f"{side}: {{concentration: 1 kg/m^3}}" for side in inlets),
                                         probes=", ".join(f"{name}: {{of: water.concentration, fracture: {name}, take: mean}}" for name in names)))
        command = [options.program, "run", scene, overlay, "-o", folder / "results", *(word for each in options.set for word in ("--set", each))]
        subprocess.run(command, check=True, stdout=sys.stderr)
        results = Results(folder / "results")
        counters = results.record["counters"]
        print(f"{counters['linear: factorizations']} factorizations, {counters['linear: solves']} solves")
        for time in np.unique(published[:, 0]):
            if time > results.times[-1] * (1 + 1e-9):
                continue
            rows = published[published[:, 0] == time]
            first = rows[:, 1].min()
            found = np.array([np.interp(time, results.times, results.history[f"{names[int(row[1] - first)]}[kg/m^3]"]) for row in rows])
            away = found - rows[:, 2]
            print(f"at {time:g} s: root mean square {100 * np.sqrt((away**2).mean()):.2f} % (deviation of participants {100 * np.sqrt((rows[:, 3]**2).mean()):.2f} %), "
                  f"largest {100 * np.abs(away).max():.2f} % in {names[int(rows[np.abs(away).argmax(), 1] - first)]}")
            if options.case == "small_features":
                for row, each in zip(rows, found):
                    print(f"  {names[int(row[1])]:10} {each:.4f}  {row[2]:.4f} +- {row[3]:.4f}, with finer cells {row[4]:.4f}")


if __name__ == "__main__":
    main()
