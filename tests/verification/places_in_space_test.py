#!/usr/bin/python3
"""places_in_space_test.py SPREKK: what a scene in space says of places: points on fractures, layers, parts of sides, walls, probes, wells."""

import math
import unittest

import numpy as np

from scene_runs import sprekk
from scenes_in_space import CUTS, LINEAR, SIDES, SpaceRuns, linear, scene


class PlacesInSpace(SpaceRuns):
    def test_layers_follow_their_surfaces(self):
        """Hills and steps that lie away from the origin, in kilometres, and planes through them."""
        box = "{x: [1000 m, 2000 m], y: [0 m, 500 m], z: [0 m, 100 m]}"
        hill = 30e3 * 500 + 40 * 200 * math.sqrt(math.pi) * math.erf(2.5) * 500
        for top, volume, within in (("(30 + 40*exp(-((x-1500)/200)^2)) m", hill, 0.02), ("if(x > 1200 && x < 1800, 70 m, 30 m)", 2.7e7, 1e-9),
                                    ("(30 + 0.02*(x - 1000)) m", 2e7, 1e-9)):
            with self.subTest(top):
                kind = "{kind: structured, shape: hexahedra, cells: [40, 2, 40]}" if volume != 2e7 else "{size: 60 m}"
                text = scene(kind, {}, box=box, pressure="1 Pa").replace("components:", "  \ncomponents:")
                text = text.replace(f"  box: {box}\n", f"  box: {box}\n  regions: {{low: {{between: [0 m, \"{top}\"]}}}}\n")
                text = text.replace("    storage: 0 1/Pa\n", "    storage: {regions: {low: 2 1/Pa, default: 1 1/Pa}}\n", 1)
                results = self.run_text(text, "output={probes: {volume: {of: pore.pressure, region: low, take: integral}}}",
                                        "components.pore.initial_pressure=1 Pa")
                self.assertLess(abs(results["volume"][-1] / volume - 1), within)

    def test_fluid_at_rest_stays_at_rest_beside_points(self):
        """A pressure that is prescribed at a point, and one that is told there, have the weight of the fluid from the cell's centre."""
        rest = "(1e5 - 9810*z/m) Pa"
        at = "[47 m, 31 m, -19.5 m]"
        text = scene("{size: 12 m}", {"f": [[20, 0, -60], [60, 0, 0], [60, 80, 0], [20, 80, -60]]}, pressure=rest, rock="mpfa",
                     box="{x: [0 m, 100 m], y: [0 m, 80 m], z: [-60 m, 0 m]}",
                     fluid="viscosity: 1 mPa*s, fluid_compressibility: 4.5e-10 1/Pa, fluid_density: 1000 kg/m^3, gravity: [0,0,-9.81 m/s^2]")
        text = text.replace("    storage: 0 1/Pa\n", "    storage: 1e-10 1/Pa\n    fluid_density: 1000 kg/m^3\n    gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]\n", 1)
        text = text.replace("    initial_aperture: 0.1 mm\n", f"""    initial_aperture: 0.1 mm
    initial_pressure: {rest}
    prescribed: {{p: {{fracture: f, at: {at}, pressure: 291295 Pa}}}}
    injection: {{q: {{fracture: f, at: [40.2 m, 51 m, -29.7 m], rate: 0 m^3/s}}}}
""")
        results = self.run_text(text, f"components.pore.initial_pressure={rest}")
        # A transmissivity of 1 m^3 makes 1e3 m^3/s of a difference of 1 Pa.
        self.assertLess(abs(results["conduit.p.rate"][-1]), 1e-6)
        self.assertAlmostEqual(results["conduit.q.pressure"][-1], 1e5 + 9810 * 29.7, delta=1e-4)

    def test_points_on_a_fracture_are_found_wherever_they_lie(self):
        fracture = {"f": [[0, 0, 0.45], [1, 0, 0.45], [1, 1.2, 0.45], [0, 1.2, 0.45]]}
        for x, y in ((0, 0), (1, 1.2), (0.5, 0.6), (0, 0.6)):
            for mesh in ("{size: 0.4 m}", "{kind: structured, shape: hexahedra, cells: [1, 12, 2]}"):
                text = scene(mesh, fracture).replace("    transmissivity: constant\n", "    transmissivity: constant\n    injection: "
                                                     f"{{q: {{fracture: f, at: [{x} m, {y} m, 0.45 m], rate: 0 m^3/s}}}}\n")
                probe = f"output={{probes: {{there: {{of: conduit.pressure, fracture: f, at: [{x} m, {y} m, 0.45 m]}}}}}}"
                self.assertEqual(self.call("check", self.write(text), probe).returncode, 0)
        far = text.replace("0.45 m], rate", "0.05 m], rate")
        self.assertIn("there is no fracture at this place (the nearest one is 0.4 m away)", self.call("check", self.write(far)).stderr)

    def test_two_pressures_at_one_point_are_refused(self):
        twice = "{a: {fracture: one, at: [0.45 m, 0.57 m, 0.5 m], pressure: 1 Pa}, b: {fracture: one, at: [0.45 m, 0.57 m, 0.5 m], pressure: 2 Pa}}"
        text = scene("{size: 0.3 m}", CUTS).replace("    transmissivity: constant\n", f"    transmissivity: constant\n    prescribed: {twice}\n")
        self.assertEqual(self.call("check", self.write(text)).returncode, 2)

    def test_ends_where_two_sides_meet_are_noted(self):
        """A plane that ends on edges of the box, and one on the border of a part of a side, with a pressure on the side that they do not
        belong to; with one on both sides there is nothing to say."""
        edges = {"one": [[0, 0, 0], [0, 1.2, 0], [1, 1.2, 0.9], [1, 0, 0.9]]}
        found = []
        border = {"one": [[0, 0, 0.45], [1, 0, 0.45], [1, 1.2, 0.45], [0, 1.2, 0.45]]}
        for fractures, parts, given, other in ((edges, "", "bottom", "left"), (border, "  sides: {low: {side: left, z: [0 m, 0.45 m]}}\nmesh:", "left", "low"),
                                               (border, "  sides: {low: {side: left, z: [0 m, 0.45 m]}}\nmesh:", "low", "left")):
            text = scene("{size: 0.4 m}", fractures, pressure=None).replace("mesh:", parts or "mesh:", 1)
            start, end = text.split("  conduit:")
            noted = []
            for sides in ((given,), (given, other)):
                conditions = ", ".join(f"{side}: {{pressure: 1 Pa}}" for side in sides)
                said = self.call("check", self.write(start.replace("boundary: {}", "boundary: {right: {pressure: 0 Pa}}") + "  conduit:" +
                                                     end.replace("boundary: {}", f"boundary: {{right: {{closed: true}}, {conditions}}}"),
                                                     f"ends_{next(self.numbers)}.yaml"))
                self.assertEqual(said.returncode, 0, said.stderr)
                noted.append(f"the pressure at '{given}' has no effect there" in said.stdout + said.stderr)
            self.assertFalse(noted[1])
            found.append(noted[0])
        self.assertEqual(sum(found), 2)  # of the two sides at the border of a part, one has the end

    def test_walls_are_where_their_names_say(self):
        """Seen from the left the points turn clockwise: the plus side is there."""
        for wall, open_side in (("minus", "left"), ("plus", "right")):
            text = scene("{size: 0.3 m}", {"one": [[0.5, 0, 0], [0.5, 1.2, 0], [0.5, 1.2, 0.9], [0.5, 0, 0.9]]}, pressure=None)
            text = text.replace("    normal_permeability: constant\n", f"    wall_permeability: {{{wall}: 0 m/(Pa*s)}}\n    normal_permeability: constant\n"
                                "    prescribed: {all: {fracture: one, pressure: 1 Pa}}\n")
            text = text.replace("boundary: {}", "boundary: {left: {pressure: 0 Pa}, right: {pressure: 0 Pa}}", 1)
            results = self.run_text(text)
            for side in ("left", "right"):
                flow = results[f"pore.{side}.outflow"][-1]
                if side == open_side:
                    self.assertGreater(flow, 1)
                else:
                    self.assertLess(abs(flow), 1e-9)

    def test_parts_of_sides_have_conditions_of_their_own(self):
        """A linear pressure on a part of the left side, what leaves there, and no flow through the other part: as the whole side."""
        parts = "sides: {{low: {{side: left, z: [0 m, 0.3 m]}}, patch: {{side: top, x: [0.25 m, 0.75 m], y: [0.3 m, 0.6 m]}}}}"
        for mesh in ("{size: 0.25 m}", "{kind: structured, shape: hexahedra, cells: [4, 4, 3]}"):
            with self.subTest(mesh):
                whole = scene(mesh, {})
                divided = whole.replace("mesh:", "  " + parts.format() + "\nmesh:").replace("boundary: {", f"boundary: {{low: {{pressure: {LINEAR}}}, patch: {{pressure: {LINEAR}}}, ")
                results = self.run_text(divided)
                self.assert_linear(results, 1e-10)
                self.assertAlmostEqual(results["pore.low.outflow"][-1], (1 * 1 + 0.3 * -2 + 0.4 * 0.5) * 1.2 * 0.3, delta=1e-9)
                self.assertAlmostEqual(results["pore.patch.outflow"][-1], -(0.4 * 1 - 0.2 * -2 + 1.5 * 0.5) * 0.5 * 0.3, delta=1e-9)

    def test_parts_of_sides_that_cannot_be_are_refused(self):
        text = scene("{kind: structured, shape: hexahedra, cells: [4, 4, 3]}", {})
        for parts, words in (("low: {side: left, z: [0 m, 0.4 m]}", "does not follow 'low'"), ("left: {side: left, z: [0 m, 0.3 m]}", "name of a whole side"),
                             ("low: {side: left, z: [0 m, 2 m]}", "leaves its side along z"), ("low: {side: left, x: [0 m, 1 m]}", "has one x"),
                             ("low: {side: left, z: [0 m, 0.6 m]}, high: {side: left, z: [0.3 m, 0.9 m]}", "overlaps 'low'"),
                             ("low: {side: left, z: [0.6 m, 0.3 m]}", "does not begin and end along z")):
            with self.subTest(parts):
                called = self.call("check", self.write(text.replace("mesh:", f"  sides: {{{parts}}}\nmesh:"), f"parts_{next(self.numbers)}.yaml"))
                self.assertEqual(called.returncode, 2, called.stderr)
                self.assertIn(words, called.stderr)

    def test_probes_and_lines_are_at_their_places(self):
        output = ("output:\n  lines: {across: {of: pore.pressure, from: [0.1 m, 0.1 m, 0.1 m], to: [0.9 m, 1.1 m, 0.8 m], points: 5}}\n"
                  "  probes:\n    p: {of: pore.pressure, at: [0.31 m, 0.77 m, 0.41 m]}\n"
                  "    q: {of: conduit.pressure, fracture: one, at: [0.45 m, 0.6 m, 0.45 m]}\n"
                  "    volume: {of: pore.pressure, take: integral}\n")
        results = self.run_text(scene("{size: 0.25 m}", CUTS, more=output))
        self.assertAlmostEqual(results["p"][-1], linear(np.array([0.31, 0.77, 0.41])), delta=1e-8)
        self.assertAlmostEqual(results["q"][-1], linear(np.array([0.45, 0.6, 0.45])), delta=1e-8)
        self.assertAlmostEqual(results.history["volume[Pa*m^3]"][-1], linear(np.array([0.5, 0.6, 0.45])) * 1.08, delta=1e-8)
        line = sprekk.read_table(results.folder / "line_across.csv")
        places = np.stack([line[f"{axis}[m]"] for axis in "xyz"], axis=1)
        np.testing.assert_allclose(line["pore.pressure[Pa]"][-5:], linear(places[-5:]), atol=1e-8)

    def test_wells_at_points_share_their_rate_with_the_cells_around(self):
        text = scene("{size: 0.3 m}", {}, pressure="0 Pa", rock_more="    wells: {feed: {at: [0.4 m, 0.7 m, 0.5 m], rate: 2e-3 m^3/s}}\n")
        results = self.run_text(text)
        self.assertAlmostEqual(sum(results[f"pore.{side}.outflow"][-1] for side in SIDES), 2e-3, delta=1e-12)

    def test_wells_along_lines_say_what_is_wrong(self):
        plane = {"f": [[0, 0, 0.45], [1, 0, 0.45], [1, 1.2, 0.45], [0, 1.2, 0.45]]}
        for well, words, code in (("points: [[0.4 m, 0.7 m, 0.5 m], [0.4 m, 1.4 m, 0.5 m]]", "lies outside the rock (there is no cell at (0.4, 1.4, 0.5))", 2),
                                  ("points: [[0.4 m, 0.7 m, 0.5 m]]", "does not say where the well is", 2), ("", "does not say where the well is", 2),
                                  ("at: [0.4 m, 0.7 m, 0.5 m], points: [[0 m, 0 m, 0 m], [1 m, 1 m, 0.5 m]]", "does not say where the well is", 2),
                                  ("points: [[0.2 m, 0.3 m, 0.45 m], [0.6 m, 0.3 m, 0.45 m]]", "lies on the fracture 'f'", 0),
                                  ("points: [[0.2 m, 0.3 m, 0.2 m], [0.6 m, 0.3 m, 0.8 m], [0.7 m, 0.3 m, 0.3 m]]", "", 0)):
            with self.subTest(well):
                called = self.call("check", self.write(scene("{size: 0.3 m}", plane, rock_more=f"    wells: {{w: {{{well}{',' if well else ''} rate: 1 m^3/s}}}}\n")))
                said = called.stdout + called.stderr
                self.assertEqual(called.returncode, code, said)
                self.assertIn(words, said)
                self.assertEqual("on the fracture" in said, "on the fracture" in words)


if __name__ == "__main__":
    unittest.main()
