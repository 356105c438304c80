#!/usr/bin/python3
"""grown_crack_test.py SPREKK [MPIEXEC]: a crack that has grown has the stress intensity factors of a crack that has been that long from
the start. A straight crack of half-length a, dry and open, in wide rock under the tension s(t) from all sides: K_I = s sqrt(pi a).
Its tips go on as s rises, since the toughness rises by more than the root of the distance from the middle."""

import math
import unittest

from scene_runs import SceneRuns, on_two_processes

START, TENSION = 5.0, 0.2e6  # m; Pa, at which the tips begin to grow
SCENE = """
name: grown_crack
geometry:
  box: {{x: [-200 m, 200 m], y: [-200 m, 200 m]}}
  fractures: {{main: {{center: [1.3 m, -0.7 m], length: {length!r} m, angle: {angle!r} deg}}}}
mesh: {{size: 40 m, fracture_size: 1 m, growth: 0.2}}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 20 GPa
    poisson_ratio: 0.25
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: &tension {{normal_stress: "({factor!r}*(1.5 + t/3600)*1e5) Pa"}}
      top: *tension
  contact: {{type: contact/coulomb, friction: 0.6, dilation_angle: 0 deg}}
  tips: {{type: fine_fracture/{tips}, size: 30 m{growth}}}
couplers:
  - {{type: wall_traction, between: [rock, contact]}}
  - {{type: two_level, between: [rock, tips]}}
schedule:
  - solve: [rock, contact]
  - {{grow: tips, settle: [rock, contact], update: {update}}}
time: {{end: {end!r} h, step: 0.125 h}}
output: {{fields: false}}
"""
GROWTH = ", toughness: '({tension!r}*(1 + {slope!r}*({r}/{start!r} - 1))*sqrt({pi!r}*{r})) Pa*m^0.5', growth: {{increment: 0.5 m}}"


def scene(length=2 * START, grows=True, angle=30.0, tips="quarter_point", update="within_step", factor=1.0, end=1.0):
    growth = GROWTH.format(tension=TENSION, slope=1.25, start=START, pi=math.pi, r="sqrt((x - 1.3)^2 + (y + 0.7)^2)") if grows else ""
    return SCENE.format(length=length, angle=angle, tips=tips, factor=factor, end=end, growth=growth, update=update)


def expected(time, grown):
    return (1.5 + time / 3600) * 1e5 * math.sqrt(math.pi * (START + grown / 2))


class GrownCrack(SceneRuns):
    timeout = 300

    def rows(self, processes=1, **scene_words):
        return self.run_scene(self.write(scene(**scene_words)), processes=processes).rows

    def check(self, least=0.9, **scene_words):
        """The row at the end of a run whose K is that of the closed form, to the error of the coarse cells, once the mesh has taken the
        first quarter of a cell over."""
        rows = self.rows(**scene_words)
        for row in rows:
            lengths = [row[f"tips.main_{end}.length"] for end in ("first", "last")]
            if 0 < min(lengths) < 0.3:
                continue
            for end in ("first", "last"):
                wanted = expected(row["time"], sum(lengths))
                self.assertLess(abs(row[f"tips.main_{end}.K_I"] / wanted - 1), 3e-3, (row["time"], lengths))
                self.assertLess(abs(row[f"tips.main_{end}.K_II"] / wanted), 1.5e-3, (row["time"], lengths))
        self.assertGreater(min(lengths), least)
        return rows[-1]

    def test_has_the_factors_of_one_that_was_there_from_the_start(self):
        grown = self.check()
        length = 2 * START + sum(grown[f"tips.main_{end}.length"] for end in ("first", "last"))
        whole = self.rows(length=length, grows=False)[-1]
        for end in ("first", "last"):
            self.assertLess(abs(grown[f"tips.main_{end}.K_I"] / whole[f"tips.main_{end}.K_I"] - 1), 3e-3, end)

    def test_turned_and_mirrored(self):
        for angle in (-30.0, 75.0):
            with self.subTest(angle=angle):
                self.check(angle=angle, end=0.75, least=0.4)

    def test_boundary_elements(self):
        self.check(tips="boundary_element", end=0.75, least=0.4)

    @on_two_processes
    def test_disturbed_and_on_two_processes(self):
        whole, disturbed, two = (self.rows(end=0.625, **words)[-1] for words in ({}, {"factor": 1 + 1e-9}, {"processes": 2}))
        self.assertGreater(whole["tips.main_first.length"], 0.1)
        for end in ("first", "last"):
            for column, scale in ((f"tips.main_{end}.length", START), (f"tips.main_{end}.K_I", 1e6), (f"tips.main_{end}.K_II", 1e6)):
                self.assertLess(abs(disturbed[column] - whole[column]) / scale, 2e-8, column)
                self.assertLess(abs(two[column] - whole[column]) / scale, 1e-9, column)


if __name__ == "__main__":
    unittest.main()
