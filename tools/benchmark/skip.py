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

MESH = {"mesh.size": "0.1 m", "mesh.fracture_size": "10 mm", "time.end": "12 h", "output.fields": "false"}

MATERIALS = """materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, biot_coefficient: 0.8, porosity: 0.01, fluid_compressibility: 4.0e-10 1/Pa,
  permeability: 5.0e-20 m^2, viscosity: 1.0e-4 Pa*s}"""
PORE = "  pore: {type: matrix_flow/mpfa, boundary: {left: {pressure: 1 MPa}}}"
ROCK = """  rock:
    type: poromechanics/mpsa
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, right: {normal_stress: -20 MPa}, top: {normal_stress: -10 MPa}}"""


def unfractured(components, solve, coupler=""):
    """The block of section 5.1 without its fracture; what the components do not name may not be in `materials` either."""
    used = MATERIALS if len(components) > 1 else MATERIALS.replace("biot_coefficient: 0.8, ", "")
    return "\n".join(["name: block", "geometry: {box: {x: [0 m, 2 m], y: [0 m, 2 m]}}", "mesh: {size: 0.05 m}", used, "components:",
                      *components, coupler, f"schedule: [{{solve: [{solve}]}}]", "time: {end: 12 h, step: 1 h}",
                      "output: {fields: false}", ""])


BIOT = unfractured([PORE, ROCK], "pore, rock", "couplers: [{type: biot, between: [pore, rock]}]")

# (a scene of configs or the text of one, settings): section 5.1's with more and more left out.
SCENES = {
    "flow alone": (unfractured([PORE], "pore"), {}),
    "mechanics alone": (unfractured([ROCK], "rock"), {}),
    "Biot": (BIOT, {}),
    "Biot, alpha = 0": (BIOT, {"materials.biot_coefficient": "0"}),
    "Biot, k = 0": (BIOT, {"materials.permeability": "0 m^2"}),
    "Biot, k = 0, until it is steady": (BIOT, {"materials.permeability": "0 m^2", "time.stop_when_steady": "1e-6"}),
    "5.1, friction that holds": ("paper/onset_coarse.yaml", {**MESH, "materials.friction": "2"}),
    "5.1 before injection": ("paper/onset_coarse.yaml", {**MESH, "time.end": "6 h"}),
    "5.1": ("paper/onset_coarse.yaml", MESH),
    "5.1, both levels, tips safe": ("paper/onset.yaml", {**MESH, "components.tips.toughness": "100 MPa*m^0.5"}),
    "5.1, both levels": ("paper/onset.yaml", MESH),
}

COLUMNS = {"fields": "objects: fields", "unknowns": "unknowns", "steps": "steps accepted", "discretized (flow)": "flux discretizations",
           "discretized (stress)": "stress discretizations", "iterations": "iterations", "factorizations": "linear: factorizations",
           "back-solves": "linear: solves", "fine solves": "tips: solves", "tips ruled out": "tips: ruled out"}


def counters(program, scene, settings):
    scratch = Path(tempfile.mkdtemp())
    try:
        file = ROOT / "configs" / scene
        if "\n" in scene:
            file = scratch / "scene.yaml"
            file.write_text(scene)
        run_scene(program, file, settings, scratch / "run", 300)
        return json.loads((scratch / "run" / "run.json").read_text())["counters"]
    finally:
        shutil.rmtree(scratch)


def measure(program, minimal, folder, again):
    file = folder / "skip.json"
    if again or not file.exists():
        folder.mkdir(parents=True, exist_ok=True)
        result = {"scenes": {name: counters(program, *scene) for name, scene in SCENES.items()},
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
