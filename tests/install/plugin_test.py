#!/usr/bin/env python3
"""plugin_test.py BUILD CMAKE: what `sprekk new` writes builds against an installation, and against the build folder, passes its own
tests and runs; and plug-ins that cannot be used are refused with the reason."""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

build_folder, cmake = sys.argv[1:3]
program = f"{build_folder}/sprekk"


def call(*command, plugins="", where=None):
    environment = {**os.environ, "SPREKK_PLUGINS": plugins}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, cwd=where)
    return done.returncode, done.stdout + done.stderr


def expect(answer, code, *words):
    found, text = answer
    assert found == code and all(word in text for word in words), f"exit code {found}, not {code}, or not {words}:\n{text}"


def build(folder, package, *settings):
    expect(call(cmake, "-S", str(folder), "-B", str(folder / "build"), f"-Dsprekk_DIR={package}", *settings), 0)
    return call(cmake, "--build", str(folder / "build"))


def make(scratch, kind, name, package, *more):
    folder = scratch / name.replace("/", "_")
    expect(call(program, "new", kind, name, *more, where=scratch), 0, "wrote")
    # Few optimizations: the test is shorter.
    expect(build(folder, package, "-DCMAKE_CXX_FLAGS_RELEASE=-O1"), 0)
    expect(call("ctest", "--test-dir", str(folder / "build"), "--output-on-failure"), 0, "100% tests passed")
    return folder, folder / "build" / f"{folder.name}.so"


def check_use(folder, plugin):
    """By the scene in a folder that is trusted, the option and the variable."""
    out = folder / "results"
    expect(call(program, "run", str(folder / "scene.yaml"), "-q", "-o", str(out), "--plugins", str(folder / "build")), 0)
    used = json.loads((out / "run.json").read_text(encoding="utf-8"))["program"]["plugins"]
    assert [(p["file"], p["types"]) for p in used] == [(str(plugin.resolve()), ["heat_flow/decay_of_heat"])], used
    expect(call(program, "list", "--plugin", str(plugin)), 0, "heat_flow/decay_of_heat")
    expect(call(program, "list", plugins=f"{plugin}:{plugin}"), 0, "heat_flow/decay_of_heat")
    expect(call(program, "schema", "--plugin", str(plugin)), 0, "heat_flow/decay_of_heat")
    expect(call("mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2", program, "run", str(folder / "scene.yaml"), "-q", "-o",
                str(folder / "two"), "--plugins", str(folder)), 0)


def rows_of(folder):
    with open(folder / "history.csv", encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def check_law(folder, plugin, kind, parameters):
    """It is listed and explained; two processes give its answer, and a run that goes on the same bits."""
    scene, chosen = str(folder / "scene.yaml"), ("-q", "--plugin", str(plugin), "--set", "plugins=null")
    expect(call(program, "list", "--plugin", str(plugin)), 0, f"laws of {kind}, by ", f"  {folder.name} ")
    expect(call(program, "explain", folder.name, "--plugin", str(plugin)), 0, *parameters, "in contact/augmented_lagrangian, contact/coulomb, contact/penalty")
    expect(call(program, "new", "law", folder.name, "--kind", kind, "-o", str(folder / "again"), plugins=str(plugin)), 2, f"a law of {kind} is called")
    expect(call(program, "run", scene, *chosen, "-o", str(folder / "whole")), 0)
    expect(call(program, "run", scene, *chosen, "-o", str(folder / "part"), "--set", "time.end=0.5 s"), 0)
    expect(call(program, "run", scene, *chosen, "-o", str(folder / "part"), "--restart", str(folder / "part/checkpoint.h5")), 0)
    expect(call("mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2", program, "run", scene, *chosen, "-o", str(folder / "two")), 0)
    whole = rows_of(folder / "whole")
    assert len(whole) == 4 and rows_of(folder / "part") == whole, (whole, rows_of(folder / "part"))
    for row, twin in zip(whole, rows_of(folder / "two"), strict=True):
        assert all(abs(twin[key] - value) <= 1e-11 * max(abs(value), 1e-3) for key, value in row.items()), (row, twin)


IN_SPACE = """
geometry:
  box: {x: [0 m, 1 m], y: [0 m, 1 m], z: [0 m, 1 m]}
  fractures: {joint: {points: [[0 m, 0 m, 0.5 m], [1 m, 0 m, 0.5 m], [1 m, 1 m, 0.5 m], [0 m, 1 m, 0.5 m]]}}
mesh: {size: 0.5 m}
components:
  rock:
    type: poromechanics/fem
    young_modulus: 25 GPa
    poisson_ratio: 0.25
    boundary:
      left: &moved
        displacement:
          - "0.6*(6 MPa*(0.3 + 0.3*exp(-2*t/(1 s)))/(10 GPa)*z + if(z > 0.5 m, 2 mm*t/(1 s), 0))"
          - "-0.8*(6 MPa*(0.3 + 0.3*exp(-2*t/(1 s)))/(10 GPa)*z + if(z > 0.5 m, 2 mm*t/(1 s), 0))"
          - "-6 MPa/(30 GPa)*z"
      right: *moved
      front: *moved
      back: *moved
      bottom: *moved
      top: *moved
  walls: {type: contact/coulomb, friction: 0.6, friction_law: {type: lost_in_space, lost_in_space: {residual: 0.3, distance: 1 mm}}}
couplers: [{type: wall_traction, between: [rock, walls]}]
schedule: [{solve: [rock, walls], newton: {residual: 1e-13, update: 1e-12}}]
time: {end: 1 s, step: 0.25 s}
output: {fields: false, probes: {traction: {of: walls.traction, fracture: joint, take: mean}}}
"""


def check_friction_in_space(scratch, package):
    """The scene of the template in space, where the walls slip in another direction than along an axis."""
    folder = scratch / "lost_in_space"
    expect(call(program, "new", "law", folder.name, "--kind", "friction", where=scratch), 0)
    expect(build(folder, package, "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-Dsprekk_DIMENSION=3"), 0)
    (folder / "space.yaml").write_text(IN_SPACE, encoding="utf-8")
    chosen = (str(folder / "space.yaml"), "-q", "--plugin", str(folder / "build/lost_in_space.so"))
    expect(call(program, "run", *chosen, "-o", str(folder / "law")), 0)
    expect(call(program, "run", *chosen, "-o", str(folder / "formula"), "--set", "components.walls.friction_law=null",
                "--set", "components.walls.friction=0.3 + 0.3*exp(-path/(1 mm))"), 0)
    rows, twins = rows_of(folder / "law"), rows_of(folder / "formula")
    assert len(rows) == 4
    for row, twin in zip(rows, twins, strict=True):
        along, across, held = row["traction.t1[Pa]"], row["traction.t2[Pa]"], 6e6 * (0.3 + 0.3 * math.exp(-2 * row["time[s]"]))
        assert abs(math.hypot(along, across) / held - 1) < 1e-10 and abs(abs(across / along) / (4 / 3) - 1) < 1e-10, row
        # Later steps begin with all walls on their cone, and round-off decides which of them slide at first.
        iterations = row.pop("iterations[1]")
        assert row["time[s]"] > 0.25 or iterations == twin["iterations[1]"]
        assert all(abs(twin[key] - value) <= 1e-11 * max(abs(value), 1e-3) for key, value in row.items()), (row, twin)


def check_trust(scratch, folder):
    """A library that leaves a mark when it is opened, named by a scene of somebody else, is opened by no command."""
    mark, stranger, safe = scratch / "mark", scratch / "stranger", scratch / "safe"
    stranger.mkdir()
    safe.mkdir()
    (stranger / "bad.c").write_text(f'#include <stdio.h>\n__attribute__((constructor)) static void leave_mark(void) {{ FILE* f = fopen("{mark}", "w"); '
                                    "if (f) fclose(f); }\n", encoding="utf-8")
    expect(call(os.environ.get("CC", "cc"), "-shared", "-fPIC", "-o", str(stranger / "bad.so"), str(stranger / "bad.c")), 0)
    (safe / "link.so").symlink_to(stranger / "bad.so")
    text = (folder / "scene.yaml").read_text(encoding="utf-8")
    scenes = {}
    for name, value in {"beside": "bad.so", "link": str(safe / "link.so"), "up": f"{safe}/../stranger/bad.so", "list": "[bad.so]"}.items():
        scenes[name] = stranger / f"{name}.yaml"
        scenes[name].write_text("".join(line if not line.startswith("plugins:") else f"plugins: {value}\n" for line in text.splitlines(True)),
                                encoding="utf-8")
    study = stranger / "study.yaml"
    study.write_text("scene: beside.yaml\nruns: {a: {}}\n", encoding="utf-8")
    out = str(scratch / "not_written")
    refusal = ("bad.so", "in no folder that you trust", "nothing of it was opened", "--plugins ")
    for scene in scenes.values():
        for command in (("check",), ("show",), ("graph",), ("fractures",), ("run", "-o", out)):
            expect(call(program, *command, str(scene), "--plugins", str(safe)), 2, scene.name + ":", *(refusal if scene.name != "link.yaml" else refusal[1:]))
    for command in (("sweep", str(study), "--list"), ("sweep", str(study), "-o", out), ("converge", str(scenes["beside"]), "--of", "u", "-o", out),
                    ("schemes", str(scenes["beside"]), "-o", out)):
        expect(call(program, *command), 2, *refusal)
    assert not mark.exists() and not Path(out).exists()
    # With the user's word it is opened; runs of a sweep are told.
    expect(call(program, "check", str(scenes["beside"]), "--plugins", str(stranger)), 2, "no plug-in of Sprekk")
    assert mark.exists()
    expect(call(program, "check", str(scenes["beside"]), "--plugins", str(scratch / "nowhere")), 2, "--plugins", "there is no folder")
    study.write_text(f"scene: {folder / 'scene.yaml'}\nruns: {{a: {{}}}}\n", encoding="utf-8")
    expect(call(program, "sweep", str(study), "-q", "-o", str(scratch / "swept"), "--plugins", str(folder)), 0)
    expect(call(program, "sweep", str(study), "-q", "-o", str(scratch / "launched"), "--plugins", str(folder), "--launcher", "sh -c {command}"), 0)


def check_refusals(scratch, folder, plugin):
    scene = str(folder / "scene.yaml")
    # Lines and columns of the scene, and what to do.
    expect(call(program, "check", scene, "--set", "plugins=none.so"), 2, "there is no plug-in", "none.so", "correct the path")
    expect(call(program, "check", scene, "--set", "plugins=null"), 2, "heat_flow/decay_of_heat", "type of component")
    expect(call(program, "check", scene, "--set", "plugins={a: b}"), 2, "names no file")
    text = scratch / "text.so"
    text.write_text("no library", encoding="utf-8")
    expect(call(program, "list", "--plugin", str(text)), 2, "--plugin", "cannot be loaded", "sprekk_plugin()")
    expect(call(program, "new", "component", "heat_flow/decay_of_heat", "-o", str(folder)), 2, "exists", "nothing is overwritten")
    expect(call(program, "new", "component", "matrix_flow/mpfa"), 2, "exists")
    expect(call(program, "new", "law", "friction/my_law", where=scratch), 2, "of a law has a '/'", "my_law")
    expect(call(program, "new", "law", "barton_bandis", "--kind", "closure", where=scratch), 2, "a law of closure is called 'barton_bandis'")
    expect(call(program, "new", "law", "my_law", where=scratch), 2, "'--kind' is missing", "closure, friction, transmissivity")
    expect(call(program, "new", "law", "my_law", "--kind", "viscosity", where=scratch), 2, "transmissivity")
    expect(call(program, "new", "coupler", "my_coupler", "--kind", "friction", where=scratch), 2, "'--kind' has no effect")
    for name in ("1st", "a b", "a//b", "/a", "a/", ""):
        expect(call(program, "new", "component", name, where=scratch), 2, "no name of a type")

    # Two plug-ins with one type.
    twin = scratch / "twin.so"
    twin.write_bytes(plugin.read_bytes())
    expect(call(program, "list", "--plugin", str(plugin), "--plugin", str(twin)), 2, "heat_flow/decay_of_heat", "a type of this name exists")

    # One for a plane, with a scene in space.
    in_space = str(Path(__file__).resolve().parents[2] / "configs/tutorial/fractured_block.yaml")
    expect(call(program, "check", in_space, "--plugin", str(plugin)), 2, "for scenes in a plane, and this one is in space", "sprekk_DIMENSION=3")

    # Another version, a missing function, and a library that is no plug-in.
    sources = scratch / "wrong"
    sources.mkdir()
    (sources / "other.c").write_text("extern const char sprekk_interface_0_0_1_abc_16; const char* sprekk_plugin = "
                                     "&sprekk_interface_0_0_1_abc_16;\n", encoding="utf-8")
    (sources / "lacks.cpp").write_text("namespace sprekk { int not_there(double); }\nint x = sprekk::not_there(1);\n", encoding="utf-8")
    (sources / "plain.c").write_text("int x;\n", encoding="utf-8")
    for source, words in (("other.c", ("built for the interface 0_0_1_abc_16", "build it anew")),
                          ("lacks.cpp", ("sprekk::not_there(double)", "does not have")),
                          ("plain.c", ("no plug-in of Sprekk",))):
        library = sources / f"{source}.so"
        expect(call(os.environ.get("CXX", "c++") if source.endswith("cpp") else os.environ.get("CC", "cc"), "-shared", "-fPIC", "-o",
                    str(library), str(sources / source)), 0)
        expect(call(program, "list", "--plugin", str(library)), 2, *words)


with tempfile.TemporaryDirectory() as name:
    scratch_folder = Path(name)
    make(scratch_folder, "coupler", "leakage", build_folder)
    make(scratch_folder, "law", "mated_badly", build_folder, "--kind", "transmissivity")
    check_law(*make(scratch_folder, "law", "lost_friction", build_folder, "--kind", "friction"), "friction", ("residual: quantity", "distance: quantity in m"))
    check_law(*make(scratch_folder, "law", "log_closure", build_folder, "--kind", "closure"), "closure", ("length: quantity in m", "pressure: quantity in Pa"))
    check_friction_in_space(scratch_folder, build_folder)
    make(scratch_folder, "accelerator", "alternating", build_folder)
    make(scratch_folder, "output", "extremes", build_folder)
    expect(call(cmake, "--install", build_folder, "--prefix", str(scratch_folder / "prefix")), 0)
    program = str(scratch_folder / "prefix/bin/sprekk")
    component, library_file = make(scratch_folder, "component", "heat_flow/decay_of_heat", scratch_folder / "prefix/lib/cmake/sprekk")
    check_use(component, library_file)
    check_trust(scratch_folder, component)
    check_refusals(scratch_folder, component, library_file)
