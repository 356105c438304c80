#!/usr/bin/env python3
"""jump_fit_test.py SPREKK MPIEXEC: stress intensity factors from the jumps of the coarse level (fine_fracture/jump_fit).

Against closed forms: a straight crack of half-length a under remote stress has K_I = s_n sqrt(pi a) and K_II = t sqrt(pi a); closed
and slipping it has the drops of stress in their place; and the dry straight wings of a closed crack of half-length c that slips under
s_1, parallel to s_1 and as long as c, have K_I = 0.13885 s_1 sqrt(pi c). With rock of second order, too; twins of each scene; and
what has no meaning is refused."""

import csv
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MPIEXEC = sys.argv.pop(2)
SPREKK = Path(sys.argv.pop(1)).resolve()
A = 0.05  # m, half-length
MPSA, FEM = "type: poromechanics/mpsa", "type: poromechanics/fem"

SCENE = """
geometry:
  box: {{x: [-2 m, 2 m], y: [-2 m, 2 m]}}
  fractures:
    main: {{points: [{points}]}}
mesh: {{size: 0.4 m, fracture_size: {size}, growth: 0.2}}
components:
  rock:
    {rock}
    young_modulus: 40 GPa
    poisson_ratio: 0.2
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: {xx!r} Pa}}
      top: {{normal_stress: {yy!r} Pa}}
  contact: {{type: contact/coulomb, friction: {friction}, dilation_angle: {dilation} deg}}
  tips: {{type: fine_fracture/jump_fit{tips}}}
couplers:
  - {{type: wall_traction, between: [rock, contact]}}
  - {{type: two_level, between: [rock, contact, tips]{reconstruction}}}
schedule:
  - solve: [rock, contact]
{schedule}
time: {{end: 1 s, step: 1 s}}
"""


def scene(points, size, xx=0.0, yy=2e6, rock=MPSA, friction=0.5, dilation=0, tips="", reconstruction="", schedule=""):
    return SCENE.format(points=", ".join(f"[{x!r} m, {y!r} m]" for x, y in points), size=size, xx=xx, yy=yy, rock=rock,
                        friction=friction, dilation=dilation, tips=tips, reconstruction=reconstruction, schedule=schedule)


def crack(degrees, half=A, x=0.013, y=-0.007):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [(x - half * c, y - half * s), (x + half * c, y + half * s)]


def remote(degrees, xx, yy):
    """The normal and the shear stress on a crack, in its frame."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return xx * s * s + yy * c * c, (yy - xx) * s * c


def wings(mirror=1):
    q = A * math.sqrt(0.5)
    return [(x, mirror * y) for x, y in ((-q - A, -q), (-q, -q), (q, q), (q + A, q))]


def run(text, processes=1, command="run"):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "scene.yaml").write_text(text)
        program = [SPREKK, command, Path(folder) / "scene.yaml"]
        if command == "run":
            program += ["-q", "-o", Path(folder) / "run"]
        if processes > 1:
            program = [MPIEXEC, "-n", str(processes)] + program
        done = subprocess.run(program, capture_output=True, text=True, timeout=100)
        if command != "run":
            return done.returncode, done.stdout + done.stderr
        assert done.returncode == 0, done.stderr
        with open(Path(folder) / "run/history.csv") as file:
            row = list(csv.DictReader(file))[-1]
    row = {key.split("[")[0]: float(value or "nan") for key, value in row.items()}
    return [(row[f"tips.main_{end}.K_I"], row[f"tips.main_{end}.K_II"]) for end in ("first", "last")]


class JumpFit(unittest.TestCase):
    def compare(self, found, expected, bound):
        scale = math.hypot(*expected)
        for k1, k2 in found:
            self.assertLess(math.hypot(k1 - expected[0], k2 - expected[1]), bound * scale, (found, expected))

    def test_open_crack_at_any_angle(self):
        # 5, 10 and 20 cells.
        root = math.sqrt(math.pi * A)
        for degrees, xx, yy, rock in ((27, 0.0, 2e6, MPSA), (-61, 1.5e6, 0.3e6, MPSA), (103, 1e6, 3e6, MPSA), (27, 0.0, 2e6, FEM),
                                      (0, 0.0, 2e6, FEM)):
            normal, shear = remote(degrees, xx, yy)
            for size, bound in (("20 mm", 0.02), ("10 mm", 0.01), ("5 mm", 0.006)):
                with self.subTest(degrees=degrees, size=size, rock=rock):
                    self.compare(run(scene(crack(degrees), size, xx, yy, rock)), (normal * root, shear * root), bound)

    def test_closed_crack_that_slips_and_dilates(self):
        for degrees, rock in ((45, MPSA), (-38, MPSA), (45, FEM)):
            normal, shear = remote(degrees, -20e6, -10e6)
            drop = (abs(shear) + 0.2 * normal) / (1 + 0.2 * math.tan(math.radians(3)))
            k2 = math.copysign(drop * math.sqrt(math.pi * A), shear)
            found = run(scene(crack(degrees), "10 mm", -20e6, -10e6, rock, friction=0.2, dilation=3))
            self.compare(found, (abs(k2) * math.tan(math.radians(3)), k2), 0.012)

    def test_wings(self):
        k1 = 0.13885 * 20e6 * math.sqrt(math.pi * A)
        for mirror, rock in ((1, MPSA), (-1, FEM)):
            for size, bound in (("20 mm", 0.08), ("10 mm", 0.06), ("5 mm", 0.02)):
                found = run(scene(wings(mirror), size, -20e6, 0.0, rock, friction=0.3))
                for tip in found:
                    self.assertLess(abs(tip[0] / k1 - 1), bound, (mirror, rock, size))
                    self.assertEqual(tip[1] > 0, mirror > 0)

    def test_twins(self):
        settings = {"size": "10 mm", "xx": 0.4e6, "yy": 2e6}
        plain = run(scene(crack(27), **settings))
        scale = max(map(abs, plain[0]))
        for name, twin, sign, bound in (
                ("from its other end", run(scene(crack(27)[::-1], **settings))[::-1], 1, 1e-3),
                ("mirrored", run(scene(crack(-27, y=0.007), **settings)), -1, 5e-3),
                ("turned by 90 degrees", run(scene(crack(117, x=0.007, y=0.013), size="10 mm", xx=2e6, yy=0.4e6)), 1, 5e-3),
                ("a little more load", run(scene(crack(27), "10 mm", 0.4e6 * (1 + 1e-9), 2e6 * (1 + 1e-9))), 1, 1e-7),
                ("a little longer", run(scene(crack(27, half=A * (1 + 1e-9)), **settings)), 1, 1e-6),
                ("on two processes", run(scene(crack(27), **settings), processes=2), 1, 1e-7)):
            with self.subTest(name):
                for (k1, k2), (other1, other2) in zip(plain, twin):
                    self.assertLess(abs(k1 - other1), bound * scale)
                    self.assertLess(abs(k2 - sign * other2), bound * scale)

    def test_refusals(self):
        for settings, words in (
                ({"rock": FEM + "\n    order: first"}, ("do not tell the factors of tips", "first order")),
                ({"reconstruction": ", reconstruction: cell_centred"}, ("do not tell the factors of tips", "strain as slip")),
                ({"schedule": "  - grow: tips\n    settle: [rock, contact]\n"}, ("does not grow", "several cells in line")),
                ({"tips": ", growth: {increment: 10 mm}"}, ("unknown key 'growth'",))):
            code, text = run(scene(crack(27), "10 mm", **settings), command="check")
            self.assertEqual(code, 2, text)
            for word in words:
                self.assertIn(word, text)

    def test_one_cell_up_to_a_kink_is_told(self):
        # The pieces beyond the kinks have two cells each.
        text = scene(wings(), "25 mm", -20e6, 0.0, friction=0.3)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "scene.yaml").write_text(text)
            done = subprocess.run([SPREKK, "run", Path(folder) / "scene.yaml", "-o", Path(folder) / "run"], capture_output=True,
                                  text=True, timeout=100)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("are those of one cell", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
