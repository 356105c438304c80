"""Where the seconds of section 5.2 go: by kind of step, and by what is done. Processor seconds are those of the program when it
says that a step is accepted; the steps that were refused before it belong to it."""

import json
import shutil
import statistics
import subprocess
import time

import numpy as np

from run_results import ROOT, read_table

KINDS = ("a tip grew, the mesh changed", "a tip grew, the path was kept", "no growth, first on a new mesh",
         "no growth, another step size", "no growth, nothing new")


def run(program, folder, scene, settings=()):
    """[processor seconds when the steps were accepted]"""
    arguments = [program, "run", str(ROOT / "configs/paper" / scene), "-o", str(folder)]
    for setting in settings:
        arguments += ["--set", setting]
    seconds = []
    with subprocess.Popen(arguments, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as process:
        clock = (~process.pid << 3) | 2  # Linux: the processor time of another process
        for line in process.stderr:
            if "step " in line and "t = " in line and "%" in line:
                seconds.append(time.clock_gettime(clock))
    if process.returncode:
        raise RuntimeError(f"{scene} did not run: exit code {process.returncode}")
    (folder / "step_seconds.json").write_text(json.dumps(seconds))
    return seconds


def kinds_of_steps(history):
    """What each accepted step was. The cells of fractures are counted before the mesh changes at the end of a step."""
    steps = history["step[s]"]
    lengths = np.array([values for name, values in history.items() if name.split("[")[0].endswith(".length")]).reshape(-1, len(steps))
    cells = sum(values for name, values in history.items() if name.startswith("contact.cells_"))
    kinds = []
    for i in range(len(steps)):
        grew = i > 0 and np.any(lengths[:, i] > lengths[:, i - 1] + 1e-9)
        if i == 0:
            kinds.append(None)
        elif grew:
            kinds.append(KINDS[0] if i + 1 < len(steps) and cells[i + 1] != cells[i] else KINDS[1])
        elif cells[i] != cells[i - 1]:
            kinds.append(KINDS[2])
        else:
            kinds.append(KINDS[3] if abs(steps[i] - steps[i - 1]) > 1e-9 * steps[i] else KINDS[4])
    return kinds


def print_steps(folder):
    seconds = np.diff(json.loads((folder / "step_seconds.json").read_text()), prepend=0)
    kinds = kinds_of_steps(read_table(folder / "history.csv"))
    print("| step | steps | mean (s) | median (s) | largest (s) |\n|---|---|---|---|---|")
    for kind in KINDS:
        found = [s for s, k in zip(seconds, kinds) if k == kind]
        if found:
            print(f"| {kind} | {len(found)} | {statistics.mean(found):.3f} | {statistics.median(found):.3f} | {max(found):.3f} |")


def print_parts(folder):
    record = json.loads((folder / "run.json").read_text())
    total = record["seconds"]
    print("| part | share | calls | each (ms) |\n|---|---|---|---|")
    for entry in sorted(record["profile"], key=lambda entry: -entry["seconds"]):
        each = 1e3 * entry["seconds"] / max(entry["calls"], 1)
        print(f"| {entry['name']} | {100 * entry['seconds'] / total:.1f} % | {entry['calls']} | {each:.2f} |")
    for name in ("factorizations, back-solves", "everything else"):
        print(f"| **{name}** | {100 * record['timings'][name] / total:.1f} % | | |")
    print(f"{total:.1f} s by the clock, {record['timings']['processor: steps and output']:.1f} s of processor time\n")


def measure(program, folder, again):
    held = "schedule.1.update=after_step"  # its kinds of steps are told apart
    of_paper = ("time.step=1 h", "mesh.size=0.1 m", "mesh.growth=0.2", "components.tips.size=0.5 m", "components.tips.growth={increment: 10 mm, front_tolerance: null}")
    resting = (*of_paper, "components.tips.toughness=100 MPa*m^0.5", "time.end=26 h")
    cases = {"wing_cracks": ("wing_cracks.yaml", (*of_paper, held)),
             "no growth": ("wing_cracks.yaml", (*resting, "components.tips.skip_below=0")),
             "no growth, tips ruled out": ("wing_cracks.yaml", resting),
             "onset": ("onset.yaml", ()), "onset_coarse": ("onset_coarse.yaml", ())}
    for name, (scene, settings) in cases.items():
        results = folder / "growth_steps" / name
        if again and results.exists():
            shutil.rmtree(results)
        if not (results / "step_seconds.json").exists():
            run(program, results, scene, settings)
        print(f"{name}: configs/paper/{scene} {' '.join(settings)}\n")
        print_steps(results)
        print()
        print_parts(results)
