#!/usr/bin/python3
"""jump_fit_test.py SPREKK MPIEXEC: stress intensity factors from the jumps of the coarse level (fine_fracture/jump_fit).

Against closed forms: a straight crack of half-length a under remote stress has K_I = s_n sqrt(pi a) and K_II = t sqrt(pi a); closed
and slipping it has the drops of stress in their place; and the dry straight wings of a closed crack of half-length c that slips under
s_1, parallel to s_1 and as long as c, have K_I = 0.13885 s_1 sqrt(pi c). With rock of second order, too; twins of each scene; and
what has no meaning is refused."""

import math
import unittest

from cracks import A, CrackScenes, crack, in_metres, remote, wings

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
    return SCENE.format(points=in_metres(points), size=size, xx=xx, yy=yy, rock=rock,
                        friction=friction, dilation=dilation, tips=tips, reconstruction=reconstruction, schedule=schedule)


class JumpFit(CrackScenes):
    def test_open_crack_at_any_angle(self):
        # 5, 10 and 20 cells.
        root = math.sqrt(math.pi * A)
        for degrees, xx, yy, rock in ((27, 0.0, 2e6, MPSA), (-61, 1.5e6, 0.3e6, MPSA), (103, 1e6, 3e6, MPSA), (27, 0.0, 2e6, FEM),
                                      (0, 0.0, 2e6, FEM)):
            normal, shear = remote(degrees, xx, yy)
            for size, bound in (("20 mm", 0.02), ("10 mm", 0.01), ("5 mm", 0.006)):
                with self.subTest(degrees=degrees, size=size, rock=rock):
                    self.expect_factors(self.factors(scene(crack(degrees), size, xx, yy, rock)), (normal * root, shear * root), bound)

    def test_closed_crack_that_slips_and_dilates(self):
        for degrees, rock in ((45, MPSA), (-38, MPSA), (45, FEM)):
            normal, shear = remote(degrees, -20e6, -10e6)
            drop = (abs(shear) + 0.2 * normal) / (1 + 0.2 * math.tan(math.radians(3)))
            k2 = math.copysign(drop * math.sqrt(math.pi * A), shear)
            found = self.factors(scene(crack(degrees), "10 mm", -20e6, -10e6, rock, friction=0.2, dilation=3))
            self.expect_factors(found, (abs(k2) * math.tan(math.radians(3)), k2), 0.012)

    def test_wings(self):
        k1 = 0.13885 * 20e6 * math.sqrt(math.pi * A)
        for mirror, rock in ((1, MPSA), (-1, FEM)):
            for size, bound in (("20 mm", 0.08), ("10 mm", 0.06), ("5 mm", 0.02)):
                found = self.factors(scene(wings(mirror), size, -20e6, 0.0, rock, friction=0.3))
                for tip in found:
                    self.assertLess(abs(tip[0] / k1 - 1), bound, (mirror, rock, size))
                    self.assertEqual(tip[1] > 0, mirror > 0)

    def test_twins(self):
        settings = {"size": "10 mm", "xx": 0.4e6, "yy": 2e6}
        plain = self.factors(scene(crack(27), **settings))
        scale = max(map(abs, plain[0]))
        for name, twin, sign, bound in (
                ("from its other end", self.factors(scene(crack(27)[::-1], **settings))[::-1], 1, 1e-3),
                ("mirrored", self.factors(scene(crack(-27, y=0.007), **settings)), -1, 5e-3),
                ("turned by 90 degrees", self.factors(scene(crack(117, x=0.007, y=0.013), size="10 mm", xx=2e6, yy=0.4e6)), 1, 5e-3),
                ("a little more load", self.factors(scene(crack(27), "10 mm", 0.4e6 * (1 + 1e-9), 2e6 * (1 + 1e-9))), 1, 1e-7),
                ("a little longer", self.factors(scene(crack(27, half=A * (1 + 1e-9)), **settings)), 1, 1e-6),
                ("on two processes", self.factors(scene(crack(27), **settings), processes=2), 1, 1e-7)):
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
            answer = self.call("check", self.write(scene(crack(27), "10 mm", **settings)))
            self.assertEqual(answer.returncode, 2, answer.stderr)
            for word in words:
                self.assertIn(word, answer.stderr)

    def test_one_cell_up_to_a_kink_is_told(self):
        # The pieces beyond the kinks have two cells each.
        text = scene(wings(), "25 mm", -20e6, 0.0, friction=0.3)
        notes = self.run_scene(self.write(text)).record["notes"]
        self.assertTrue([note for note in notes if "are those of one cell" in note["text"]], notes)


if __name__ == "__main__":
    unittest.main()
