"""Small scenes whose counts (factorizations, back-solves, iterations, assembled patterns, discretized cells, unknowns) are compared
with a stored baseline. Wall times are not: what a program does is the same everywhere, how long it takes is not."""

import json
import os
import shutil
import tempfile
from pathlib import Path

from cases import run_scene
from run_results import ROOT

BASELINE = Path(__file__).with_name("smoke.json")

FRACTURE = {"mesh.size": "0.3 m", "mesh.fracture_size": "20 mm"}
SCENES = {
    "flow and fracture, steady": ("verification/single_mode_fracture.yaml", {"mesh.size": "0.1 m"}),
    "flow and fracture, two-point": ("verification/single_mode_fracture.yaml",
                                     {"mesh.size": "0.1 m", "components.pore.type": "matrix_flow/tpfa"}),
    "Biot": ("verification/mandel.yaml", {"mesh.size": "0.1 m"}),
    "Biot, MUMPS": ("verification/mandel.yaml", {"mesh.size": "0.1 m", "solver.type": "mumps"}),
    "Biot, multigrid": ("verification/mandel.yaml", {"mesh.size": "0.1 m", "solver.type": "belos", "time.end": "3237 s"}),
    "Biot, fixed-stress split": ("verification/mandel.yaml",
                                 {"mesh.size": "0.1 m", "schedule": "[{iterate: {until: {relative: 1e-8, at_most: 50}, steps: "
                                                                    "[{solve: [pore], stabilize: fixed_stress}, {solve: [rock]}]}}]"}),
    "friction": ("verification/frictional_crack.yaml", {"mesh.fracture_size": "0.2 m", "mesh.growth": "0.4"}),
    "opening": ("verification/pressurized_crack.yaml", {"mesh.fracture_size": "0.2 m", "mesh.growth": "0.4"}),
    "slip that spreads": ("verification/injection_fault.yaml", {"mesh.fracture_size": "0.5 m", "mesh.growth": "0.5",
                                                              "time": "{end: 0.3 s, step: 0.03 s}"}),
    "section 5.1 before injection": ("paper/onset_coarse.yaml", {**FRACTURE, "time.end": "6 h"}),
    "section 5.1": ("paper/onset_coarse.yaml", {**FRACTURE, "time.end": "21 h"}),
    "section 5.1, two levels": ("paper/onset.yaml", {**FRACTURE, "time.end": "8 h"}),
    "growth": ("paper/wing_cracks.yaml", {**FRACTURE, "mesh.growth": "0.2", "time.end": "2 h", "time.step": "1 h", "schedule.1.update": "after_step",
                                          "components.tips.size": "0.5 m", "components.tips.growth": "{increment: 10 mm, front_tolerance: null}",
                                          "couplers.4.between": "[rock, conduit, tips]"}),
}

# OpenBLAS takes other kernels, which round differently, on other processors; how many iterations a state takes, and when a crack grows, may be
# decided by that. Counts are compared with the kernels that every processor of the last decade has.
KERNELS = "Haswell"


def counts(program):
    """{scene: {counter: value}} of all scenes, and what did not run."""
    os.environ["OPENBLAS_CORETYPE"] = KERNELS
    found, failures = {}, []
    for name, (scene, settings) in SCENES.items():
        scratch = Path(tempfile.mkdtemp())
        try:
            run_scene(program, ROOT / "configs" / scene, {"output.fields": "false", **settings}, scratch / "run", 120)
            found[name] = json.loads((scratch / "run" / "run.json").read_text())["counters"]
        except RuntimeError as failure:
            failures.append(f"{name}: {failure}")
        finally:
            shutil.rmtree(scratch)
    return found, failures


def differences(found, baseline):
    """One line for each counter that is not what it was."""
    lines = []
    for name in baseline.keys() - found.keys():
        lines.append(f"{name}: was not run")
    for name, counters in found.items():
        before = baseline.get(name)
        if before is None:
            lines.append(f"{name}: is new")
            continue
        for counter in sorted(counters.keys() | before.keys()):
            old, new = before.get(counter), counters.get(counter)
            if old != new:
                lines.append(f"{name}: {counter}: {'none' if old is None else old} -> {'none' if new is None else new}")
    return lines


def smoke(program, update):
    """0 when all counts are those of the baseline."""
    found, failures = counts(program)
    for failure in failures:
        print(f"FAILED {failure}")
    if failures:
        return 1
    baseline = json.loads(BASELINE.read_text()) if BASELINE.exists() else {}
    lines = differences(found, baseline)
    if update:
        BASELINE.write_text(json.dumps(found, indent=1, sort_keys=True) + "\n")
    for line in lines:
        print(line)
    if lines and not update:
        print("the counts are not those of tools/benchmark/smoke.json; an intended change is taken over by tools/bench --smoke --update")
        return 1
    print(f"{sum(len(c) for c in found.values())} counts of {len(found)} scenes " + ("stored" if update else "as before"))
    return 0
