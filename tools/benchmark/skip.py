"""What is skipped: scenes from flow alone to the full model, what of each exists and is computed, and seconds of those for which there
is a dedicated minimal program (minimal.cpp)."""

import json
import shutil
import subprocess
import tempfile
from pathlib import Path

import page
from cases import run_scene
from run_results import ROOT

ONSET = "paper/onset_coarse.yaml"
MESH = {"mesh.size": "0.1 m", "mesh.fracture_size": "10 mm", "time.end": "12 h", "output.fields": "false", "output.probes": "{}"}
NO_FRACTURE = {**MESH, "geometry.fractures": "{}", "mesh.fracture_size": "0.1 m"}
PORE = "{pore: {type: matrix_flow/mpfa, boundary: {left: {pressure: 1 MPa}}}}"
ROCK = ("rock: {type: poromechanics/mpsa, boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, "
        "right: {normal_stress: -20 MPa}, top: {normal_stress: -10 MPa}}}")
BIOT = "[{type: biot, between: [pore, rock]}]"
ROCK_AND_PORE = "{pore: {type: matrix_flow/mpfa}, " + ROCK + "}"

# All of them are section 5.1's, with more and more left out.
SCENES = {
    "flow alone": {**NO_FRACTURE, "components": PORE, "couplers": "[]", "schedule": "[{solve: pore}]"},
    "mechanics alone": {**NO_FRACTURE, "components": "{" + ROCK + "}", "couplers": "[]", "schedule": "[{solve: rock}]"},
    "Biot": {**NO_FRACTURE, "components": ROCK_AND_PORE, "couplers": BIOT, "schedule": "[{solve: [pore, rock]}]"},
    "Biot, alpha = 0": {**NO_FRACTURE, "components": ROCK_AND_PORE, "couplers": BIOT, "schedule": "[{solve: [pore, rock]}]",
                        "materials.biot_coefficient": "0"},
    "Biot, k = 0": {**NO_FRACTURE, "components": ROCK_AND_PORE, "couplers": BIOT, "schedule": "[{solve: [pore, rock]}]",
                    "materials.permeability": "0 m^2"},
    "Biot, until it is steady": {**NO_FRACTURE, "components": ROCK_AND_PORE, "couplers": BIOT, "schedule": "[{solve: [pore, rock]}]",
                                 "time.stop_when_steady": "1e-6"},
    "5.1, friction that holds, no injection": {**MESH, "materials.friction": "2", "components.conduit.injection": "{}"},
    "5.1, friction that holds": {**MESH, "materials.friction": "2"},
    "5.1 before injection": {**MESH, "time.end": "6 h"},
    "5.1": MESH,
    "5.1, both levels, tips safe": {**MESH, "scene": "paper/onset.yaml", "components.tips.toughness": "100 MPa*m^0.5"},
    "5.1, both levels": {**MESH, "scene": "paper/onset.yaml"},
}

COLUMNS = {"fields": "objects: fields", "unknowns": "unknowns", "steps": "steps accepted", "discretized (flow)": "flux discretizations",
           "discretized (stress)": "stress discretizations", "iterations": "iterations", "factorizations": "linear: factorizations",
           "back-solves": "linear: solves", "fine solves": "tips: solves", "tips ruled out": "tips: ruled out"}


def counters(program, settings):
    settings = dict(settings)
    scene = ROOT / "configs" / settings.pop("scene", ONSET)
    scratch = Path(tempfile.mkdtemp())
    try:
        run_scene(program, scene, settings, scratch / "run", 300)
        return json.loads((scratch / "run" / "run.json").read_text())["counters"]
    finally:
        shutil.rmtree(scratch)


def measure(program, minimal, folder, again):
    file = folder / "skip.json"
    if again or not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        result = {"scenes": {name: counters(program, settings) for name, settings in SCENES.items()},
                  "pairs": json.loads(subprocess.run([minimal], capture_output=True, text=True, check=True).stdout)}
        file.write_text(json.dumps(result, indent=1) + "\n")
    print(text(json.loads(file.read_text())))


def rows(result):
    return [[name, *(counters.get(counter, "–") for counter in COLUMNS.values())] for name, counters in result["scenes"].items()]


def pair_rows(result):
    return [[p["name"], f"{p['general']:.3f}", f"{p['minimal']:.3f}", f"{p['ratio']:.2f}", f"{p['lowest']:.2f} – {p['highest']:.2f}",
             f"{p['difference']:.0e}"] for p in result["pairs"]["pairs"]]


PAIR_COLUMNS = ["", "scene (s)", "minimal program (s)", "ratio (median)", "range", "difference"]


def text(result):
    """Markdown."""
    def table(headings, body):
        lines = ["| " + " | ".join(map(str, row)) + " |" for row in [headings, ["---"] * len(headings), *body]]
        return "\n".join(lines)
    return (table(["scene", *COLUMNS], rows(result)) + f"\n\n{result['pairs']['cells']} triangles, {result['pairs']['repeats']} pairs\n\n"
            + table(PAIR_COLUMNS, pair_rows(result)))


def sections(folder):
    file = folder / "skip.json"
    if not file.exists():
        return []
    result = json.loads(file.read_text())
    return [("What is skipped", page.table(["scene", *COLUMNS], rows(result)) + page.table(PAIR_COLUMNS, pair_rows(result)))]
