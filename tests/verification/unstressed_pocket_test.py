#!/usr/bin/python3
"""unstressed_pocket_test.py SPREKK: check says that rock which fractures enclose is held by nothing at the start, unless there is an
initial stress, or no such rock."""

import subprocess
import sys
import tempfile
from pathlib import Path

program = sys.argv[1]
SCENE = """
name: pocket
geometry:
  box: {x: [0 m, 3 m], y: [0 m, 3 m]}
  fractures:
    one: {points: [[0.6 m, 1 m], [2.4 m, 1 m]]}
    two: {points: [[0.9 m, 0.6 m], [1.7 m, 2.2 m]]}
    three: {points: [[2.1 m, 0.6 m], [1.3 m, 2.2 m]]}
mesh: {size: 0.3 m, fracture_size: 0.15 m}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, friction: 0.6, dilation_angle: 0 deg}
components:
  rock:
    type: poromechanics/mpsa
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, top: {normal_stress: -10 MPa}}
  contact: {type: contact/coulomb}
couplers: [{type: wall_traction, between: [rock, contact]}]
schedule: [{solve: [rock, contact]}]
time: {end: 1 s, step: 1 s}
"""
NOTE = "cut off 1 parts of the rock"

with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "scene.yaml"
    path.write_text(SCENE, encoding="utf-8")

    def said(*settings):
        more = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([program, "check", str(path), *more], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done
        return done.stdout + done.stderr

    assert NOTE in said() and "initial_stress" in said(), said()
    assert NOTE not in said("components.rock.initial_stress={xx: 0 MPa, yy: -10 MPa, xy: 0 MPa}")
    assert NOTE not in said("geometry.fractures.three.points=[[2.1 m, 2.3 m], [1.9 m, 2.6 m]]")
print("as it should be")
