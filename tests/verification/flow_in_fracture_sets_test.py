#!/usr/bin/python3
"""flow_in_fracture_sets_test.py SPREKK MPIEXEC: a flow that lives in some of the fractures; the others are dry.

- Fluid that is injected stays in the fractures with a flow, also where dry ones cross them: p = Q t/(a L c).
- A crack that fluid opens is that of Sneddon (1946), beside a dry one that is held closed.
- In rock that conducts, a dry fracture is one that neither conducts nor lets anything through its walls.
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK, MPIEXEC = Path(sys.argv[1]).resolve(), sys.argv[2]
del sys.argv[1:]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

CROSSING = """
name: crossing
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 2 m]}
  fractures:
    main: {points: [[0.3 m, 0.4 m], [1.7 m, 1.1 m]]}
    across: {points: [[0.8 m, 1.5 m], [1.2 m, 0.2 m]]}
    branch: {points: [[1.4 m, 0.95 m], [1.4 m, 1.8 m]]}
mesh: {size: 0.2 m, fracture_size: 0.1 m}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.1 mm
    initial_pressure: 0 Pa
    injection: {well: {fracture: main, at: [0.3 m, 0.4 m], rate: 1e-9 m^2/s}}
schedule: [{solve: conduit}]
time: {end: 100 s, step: 25 s}
output:
  fields: false
  probes: {p: {of: conduit.pressure, fracture: main, take: mean}, low: {of: conduit.pressure, fracture: main, take: smallest}}
"""

CRACKS = """
name: cracks
geometry:
  box: {{x: [-20 m, 20 m], y: [-20 m, 20 m]}}
  fractures:
    one: {{points: {one}}}
    two: {{points: {two}}}
mesh: {{size: 4 m, fracture_size: 0.1 m, growth: 0.25}}
materials: {{young_modulus: 10 GPa, poisson_ratio: 0.25, viscosity: 1 mPa*s, friction: 5, dilation_angle: 0 deg, fluid_compressibility: 4e-10 1/Pa}}
components:
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: -1 MPa}}
      top: {{normal_stress: -1 MPa}}
  contact: {{type: contact/coulomb}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    {flow}
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [rock, contact, conduit]}}]
time: {{end: 1 s, step: 1 s}}
output:
  fields: false
  probes:
    opening: {{of: contact.jump, fracture: one, take: largest}}
    of_dry: {{of: contact.jump, fracture: two, take: largest}}
    u: {{of: rock.displacement, at: [5 m, 3 m]}}
"""
LEVEL = {"one": "[[-1 m, 0 m], [1 m, 0 m]]", "two": "[[-0.5 m, 1.5 m], [0.5 m, 1.5 m]]"}
SLANTED = {"one": "[[-0.8 m, -0.6 m], [0.8 m, 0.6 m]]", "two": "[[-1.3 m, 0.9 m], [-0.5 m, 1.5 m]]"}

IN_ROCK = """
name: in_rock
geometry:
  box: {{x: [0 m, 2 m], y: [0 m, 1 m]}}
  fractures:
    wet: {{points: [[0.3 m, 0.3 m], [1.1 m, 0.6 m]]}}
    dry: {{points: [[0.9 m, 0.2 m], [0.7 m, 0.9 m]]}}
mesh: {{size: 0.1 m, fracture_size: 0.05 m}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-14 m^2
    viscosity: 1 mPa*s
    storage: 1e-10 1/Pa
    boundary: {{left: {{pressure: 2 MPa}}, right: {{pressure: 1 MPa}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.1 mm
    {flow}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 h, step: 15 min}}
output:
  fields: false
  probes:
    p: {{of: conduit.pressure, fracture: wet, take: mean}}
    near: {{of: pore.pressure, at: [0.9 m, 0.7 m]}}
    far: {{of: pore.pressure, at: [1.5 m, 0.4 m]}}
"""


class FlowInFractureSets(unittest.TestCase):
    def history(self, text, *settings, processes=1):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.yaml"
            path.write_text(text, encoding="utf-8")
            launcher = [MPIEXEC, "-n", str(processes)] if processes > 1 else []
            sets = [word for setting in settings for word in ("--set", setting)]
            done = subprocess.run([*launcher, str(SPREKK), "run", str(path), "-q", "-o", f"{folder}/out", *sets], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            return sprekk.read_table(f"{folder}/out/history.csv")

    def largest_difference(self, one, two):
        worst = 0
        for column in one:
            if "error" in column or column == "iterations[1]" or column not in two:
                continue
            scale = max(max(abs(value) for value in two[column]), 1e-30)
            worst = max(worst, *(abs(a - b) / scale for a, b in zip(one[column], two[column])))
        return worst

    def test_injected_fluid_stays_in_the_fractures_with_a_flow(self):
        main, branch, across = (1.4**2 + 0.7**2) ** 0.5, 0.85, (0.4**2 + 1.3**2) ** 0.5
        for names, length in (("main", main), ("[main, branch]", main + branch), ("[main, across, branch]", main + across + branch)):
            for processes in (1, 2):
                table = self.history(CROSSING, f"components.conduit.fractures={names}", processes=processes)
                for i, time in enumerate(table["time[s]"]):
                    exact = 1e-9 * time / (1e-4 * length * 4e-10)
                    self.assertAlmostEqual(table["fluid_stored[m^2]"][i] / (1e-9 * time), 1, delta=1e-12)
                    self.assertLess(abs(table["fluid_balance_error[m^2]"][i]), 1e-20)
                # Long after the pressures have come together.
                self.assertAlmostEqual(table["p[Pa]"][-1] / exact, 1, delta=1e-3)

    def test_a_crack_with_fluid_beside_a_dry_one_is_that_of_sneddon(self):
        exact = 4 * 2e6 * 1 * (1 - 0.25**2) / 10e9
        prescribed = "prescribed: {{inside: {{fracture: one, pressure: 3 MPa}}{more}}}"
        for place in (LEVEL, SLANTED):
            wet = self.history(CRACKS.format(flow="fractures: one\n    " + prescribed.format(more=""), **place))
            opening = wet["opening.n[m]"][-1]
            print(f"opening {opening:.4e} m, closed form {exact:.4e} m")
            self.assertAlmostEqual(opening / exact, 1, delta=0.02)
            self.assertLess(abs(wet["of_dry.n[m]"][-1]), 1e-12)
            none = self.history(CRACKS.format(flow=prescribed.format(more=", outside: {fracture: two, pressure: 0 MPa}"), **place))
            self.assertLess(self.largest_difference(wet, {key: none[key] for key in ("opening.n[m]", "opening.t[m]", "u.x[m]", "u.y[m]")}), 1e-10)
        # With fluid of the same pressure the other one opens, too.
        both = self.history(CRACKS.format(flow=prescribed.format(more=", outside: {fracture: two, pressure: 3 MPa}"), **LEVEL))
        self.assertGreater(both["of_dry.n[m]"][-1], 1e-4)

    def test_a_dry_fracture_in_rock_that_conducts_is_sealed(self):
        sealed = ("transmissivity: constant\n    transmissivity_value: {fractures: {wet: 1e-13 m^3, dry: 0 m^3}}\n    normal_permeability: constant\n"
                  "    normal_permeability_value: {fractures: {wet: 1e-8 m/(Pa*s), dry: 0 m/(Pa*s)}}")
        zero = self.history(IN_ROCK.format(flow=sealed))
        for processes in (1, 2):
            dry = self.history(IN_ROCK.format(flow="fractures: [wet]\n    " + sealed.replace("dry: 0 ", "dry: 1 ")), processes=processes)
            self.assertLess(self.largest_difference(dry, zero), 1e-10)
        self.assertGreater(abs(dry["near[Pa]"][-1] - 2e6 + 0.45e6), 1e3)  # the barrier is felt

    def test_what_has_no_meaning_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.yaml"
            path.write_text(CROSSING, encoding="utf-8")
            for setting, words in (("fractures=[mian]", ("unknown fracture", "main")),
                                   ("fractures=[across]", ("no flow at this place", "fractures")),
                                   ("prescribed={a: {fracture: across, pressure: 1 Pa}}", ("no flow at this place",))):
                more = ["--set", "components.conduit.fractures=main"] if "prescribed" in setting else []
                done = subprocess.run([str(SPREKK), "check", str(path), *more, "--set", f"components.conduit.{setting}"], capture_output=True, text=True,
                                      check=False)
                self.assertEqual(done.returncode, 2, setting + done.stderr)
                self.assertTrue(all(word in done.stderr for word in words), done.stderr)
            done = subprocess.run([str(SPREKK), "check", str(path), "--set", "components.conduit.fractures=main", "--set",
                                   "output.probes={q: {of: conduit.pressure, fracture: across, take: mean}}"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn("does not live on fracture 'across'", done.stderr)


if __name__ == "__main__":
    unittest.main()
