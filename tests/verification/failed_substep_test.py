#!/usr/bin/python3
"""failed_substep_test.py SPREKK: a substep that fails in the middle of its step leaves nothing behind: the shorter step that follows has
the state, the time and the balances of a run that began with it, to the last bit."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

# A fracture at 45 degrees under s_x = -10 MPa and s_y = -10 (1 + r t) MPa carries tau/sigma_n = r t/(2 + r t), less what the fluid carries. With r = 0.177/h it
# slips after 2.5 to 2.8 h with a friction of 0.3, in the third of four substeps of a step of 4 h; until then everything is linear,
# and one iteration is enough.
SCENE = """
name: substeps
geometry:
  box: {{x: [0, 2], y: [0, 2]}}
  fractures: {{main: {{center: [1, 1], length: 0.5, angle: {angle!r} deg}}}}
mesh: {{size: 0.4, fracture_size: 0.1, growth: 0.3}}
materials: {{young_modulus: 40 GPa, poisson_ratio: 0.2, biot_coefficient: 0.7, porosity: 0.05, fluid_compressibility: 4e-10 1/Pa,
  permeability: 1e-18 m^2, viscosity: 1e-3 Pa*s, friction: 0.3, dilation_angle: 1 deg}}
components:
  pore: {{type: matrix_flow/mpfa, boundary: {{left: {{pressure: 0 Pa}}}}}}
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {{displacement_x: 0}}
      bottom: {{displacement_y: 0}}
      right: {{normal_stress: "(-10e6*{right}) Pa"}}
      top: {{normal_stress: "(-10e6*{top}) Pa"}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 1 mm}}
  contact: {{type: contact/coulomb}}
couplers:
  - {{type: biot, between: [pore, rock]}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{subcycle: {{count: 4, steps: [{{solve: [pore, rock, conduit, contact], newton: {{at_most: {at_most}, undamped: 100, pieces: 0}}}}]}}}}]
time: {{end: {end} h, step: {step} h}}
output: {{fields: false, probes: {{p: {{of: pore.pressure, take: largest}}, q: {{of: pore.pressure, take: smallest}}}}}}
"""
RISING, STEADY = "(1+0.177*t/h)", "1"


class FailedSubstep(unittest.TestCase):
    def run_scene(self, folder, **settings):
        values = {"angle": 45.0, "right": STEADY, "top": RISING, "at_most": 1, "step": 4, "end": 4, **settings}
        (folder / "scene.yaml").write_text(SCENE.format(**values))
        run = subprocess.run([SPREKK, "run", folder / "scene.yaml", "-o", folder / "out"], capture_output=True, text=True, timeout=100)
        return run, sprekk.Results(folder / "out").rows

    def compare(self, **settings):
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
            cut, rows = self.run_scene(Path(one), **settings)
            self.assertIn("substep 3", cut.stderr)
            self.assertIn("again over 2 h", cut.stderr)
            fresh, expected = self.run_scene(Path(other), step=2, end=2, **settings)
            self.assertEqual(fresh.returncode, 0, fresh.stderr)
            self.assertEqual(rows[0], expected[0])
            row = rows[0]
            self.assertEqual(row["time"], 7200)
            self.assertGreater(abs(row["fluid_stored"]), 0)
            self.assertLess(abs(row["fluid_stored"] + row["fluid_outflow"]), 1e-9 * abs(row["fluid_outflow"]))

    def test_the_step_that_follows_is_that_of_a_run_which_begins_with_it(self):
        self.compare()

    def test_the_cut_is_told(self):
        def told(folder):
            return [note["text"] for note in sprekk.Results(folder / "out").record["notes"] if note["topic"] == "steps cut"]
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
            cut, _ = self.run_scene(Path(one))
            (text,) = told(Path(one))
            rejected = sprekk.Results(Path(one) / "out").record["counters"]["steps rejected"]
            self.assertEqual(cut.returncode, 1)  # the last attempt that is rejected ends the run
            self.assertRegex(text, rf"^{rejected - 1} attempts at steps did not converge, .* did not converge: substep \d: no convergence in 1 iterations")
            self.assertIn("note: " + text, cut.stderr)
            self.run_scene(Path(other), step=2, end=2)
            self.assertEqual(told(Path(other)), [])

    def test_turned_by_a_right_angle(self):
        self.compare(angle=-45.0, right=RISING, top=STEADY)

    def test_with_enough_iterations_no_substep_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            run, rows = self.run_scene(Path(folder), at_most=30)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(len(rows), 1)
            self.assertGreater(rows[0]["contact.cells_slip"], 0)


if __name__ == "__main__":
    unittest.main()
