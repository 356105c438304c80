#!/usr/bin/python3
"""Scans first growth: at which K a wing of sealed rock comes to rest when one step carries it past its toughness.

    tools/benchmark/first_growth.py [--program build/release/sprekk] [--pressures 200] [--sizes 20,10,5] [--jobs 2]

Each run of configs/verification/wings_sealed.yaml has one step, from 7 MPa to a pressure between 8.07 and 11 MPa at
whose end both tips grow for the first time. Whatever grew must end at K_eq = K_IC within 2 % and with |K_II| below 3 %
of K_I, or run.json must have a note of that tip that says why not. Exit code 1 where neither is so.
"""

import argparse
import concurrent.futures
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/python"))
from sprekk import read_table  # noqa: E402

TOUGHNESS = 0.7e6
FIRST, LAST = 8.07, 11.0  # MPa; the first growth is due at 8.06
SCHEDULE = "[{solve: [rock, conduit, contact]}, {grow: tips, settle: [rock, contact], update: after_step, overshoot: 100}]"


def pressures(count):
    """More of them where growth has just begun, MPa."""
    return [8.06 + (FIRST - 8.06) * ((LAST - 8.06) / (FIRST - 8.06)) ** (i / max(1, count - 1)) for i in range(count)]


def run(program, size, pressure):
    """One run: for both tips (name, length in m, K_eq/K_IC, |K_II|/K_I), notes by topic, and what went wrong."""
    with tempfile.TemporaryDirectory() as folder:
        settings = {"time.start": "7 h", "time.step": f"{pressure - 7!r} h", "time.end": f"{pressure!r} h",
                    "mesh.fracture_size": f"{size} mm", "schedule": SCHEDULE, "output.fields": "false"}
        command = [program, "run", str(ROOT / "configs/verification/wings_sealed.yaml"), "-q", "-o", folder + "/run"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
        if done.returncode != 0:
            return [], {}, done.stderr.strip().splitlines()[-1:] or ["it failed"]
        last = {name.partition("[")[0]: values[-1] for name, values in read_table(folder + "/run/history.csv").items()}
        # Of these tips themselves: others may name them too, as one of a `time.stop` that was not reached does.
        notes = json.loads(Path(folder + "/run/run.json").read_text()).get("notes", [])
        tips = []
        for tip in ("main_first", "main_last"):
            k1, k2, k_eq = (last[f"tips.{tip}.{name}"] for name in ("K_I", "K_II", "K_eq"))
            tips.append((tip, last[f"tips.{tip}.length"], k_eq / TOUGHNESS, abs(k2) / k1 if k1 > 0 else float("inf")))
        return tips, {note["topic"]: note["text"] for note in notes}, []


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/sprekk"))
    parser.add_argument("--pressures", type=int, default=200)
    parser.add_argument("--sizes", default="20,10,5", help="of the cells on the fracture, mm")
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    failures = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for size in [float(size) for size in arguments.sizes.split(",")]:
            wanted = pressures(arguments.pressures)
            results = pool.map(lambda pressure: run(arguments.program, size, pressure), wanted)
            grown = at_toughness = waits = said = 0
            for pressure, (tips, notes, errors) in zip(wanted, results):
                failures += len(errors)
                for error in errors:
                    print(f"{size:g} mm, {pressure:.5f} MPa: {error}")
                for tip, length, k_eq, shear in tips:
                    grown += length > 0
                    waits += length == 0
                    if abs(k_eq - 1) <= 0.02 and (shear < 0.03 or length == 0):
                        at_toughness += 1
                    elif texts := [text for topic, text in notes.items() if topic.startswith(f"tips.{tip} ")]:
                        said += 1
                        print(f"{size:g} mm, {pressure:.5f} MPa: {' | '.join(texts)}")
                    else:
                        failures += 1
                        print(f"{size:g} mm, {pressure:.5f} MPa: {tip} is {1e3 * length:.3f} mm long with K_eq/K_IC = "
                              f"{k_eq:.3f} and |K_II|/K_I = {shear:.3f}, without a note")
            print(f"cells of {size:g} mm: {grown} tips have grown, {waits} wait; {at_toughness} are at the toughness "
                  f"without shear, {said} have a note, pressures: {len(wanted)}", flush=True)
    print(f"failures: {failures}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
