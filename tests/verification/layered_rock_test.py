#!/usr/bin/python3
"""layered_rock_test.py SPREKK MPIEXEC: stress intensity factors of a crack beside rock of another stiffness that lies in the square of
the fine level.

A crack of half-length a = 50 mm in a plate under tension s, along the border to other rock, six half-lengths away. Without a
Poisson's ratio the plate without the crack has the same stress everywhere, whatever is stiffer. So K_I = s sqrt(pi a), but for
what the border changes in the stress of the crack, which falls with the square of the distance (below 2 % here), and K_II = 0.
"""

import math
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

SCENE = """
name: layered_rock
geometry:
  box: {{x: [0 m, 4 m], y: [0 m, 4 m]}}
  fractures: {{main: {{center: [2 m, 2 m], length: 0.1 m, angle: {angle} deg}}}}
  regions: {{other: {{polygon: {other}}}}}
mesh: {{size: 0.2 m, fracture_size: 10 mm, growth: 0.3}}
materials:
  young_modulus: {{regions: {{other: {young} GPa, default: 20 GPa}}}}
  poisson_ratio: 0
components:
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: {right} Pa}}
      top: {{normal_stress: {top} Pa}}
  contact: {{type: contact/coulomb, friction: 0.6, dilation_angle: 0 deg}}
  tips: {{type: fine_fracture/quarter_point, size: 1 m}}
couplers:
  - {{type: wall_traction, between: [rock, contact]}}
  - {{type: two_level, between: [rock, tips]}}
schedule:
  - solve: [rock, contact]
  - {{grow: tips, settle: [rock, contact]}}
time: {{end: 1 h, step: 1 h}}
"""
EXACT = 1e6 * math.sqrt(math.pi * 0.05)
ABOVE, BELOW, RIGHT = ("[[0, 2.3], [4, 2.3], [4, 4], [0, 4]]", "[[0, 0], [4, 0], [4, 1.7], [0, 1.7]]",
                       "[[2.3, 0], [4, 0], [4, 4], [2.3, 4]]")


class LayeredRock(unittest.TestCase):
    def factors(self, young, angle=0, other=ABOVE, tension=1e6, processes=1):
        right, top = (tension, 0.0) if angle == 90 else (0.0, tension)
        with tempfile.TemporaryDirectory() as folder:
            scene = SCENE.format(young=young, angle=angle, other=other, right=repr(right), top=repr(top))
            (Path(folder) / "scene.yaml").write_text(scene)
            command = [SPREKK, "run", Path(folder) / "scene.yaml", "-q", "-o", Path(folder) / "results"]
            if processes > 1:
                command = [MPIEXEC, "-n", str(processes), *command]
            run = subprocess.run(command, capture_output=True, text=True, timeout=100)
            self.assertEqual(run.returncode, 0, run.stderr)
            row = sprekk.Results(Path(folder) / "results").rows[-1]
            return [row[f"tips.main_{end}.K_{mode}"] / EXACT for end in ("first", "last") for mode in ("I", "II")]

    def check(self, factors):
        for k_1, k_2 in (factors[:2], factors[2:]):
            self.assertAlmostEqual(k_1, 1, delta=0.02)
            self.assertAlmostEqual(k_2, 0, delta=0.005)

    def test_soft_rock(self):
        self.check(self.factors(7))

    def test_stiff_rock(self):
        self.check(self.factors(60))

    def test_turned(self):
        self.check(self.factors(7, 90, RIGHT))

    def test_mirrored(self):
        self.check(self.factors(60, 0, BELOW))

    def test_disturbed_and_on_two_processes(self):
        whole = self.factors(7)
        for other in (self.factors(7, tension=1e6 * (1 + 1e-9)), self.factors(7, processes=2)):
            for one, two in zip(whole, other):
                self.assertAlmostEqual(one, two, delta=1e-8)


if __name__ == "__main__":
    unittest.main()
