#!/usr/bin/python3
"""flow_in_space_test.py SPREKK [MPIEXEC]: flow in rock and fractures in space, on every kind of mesh: linear pressures, which are exact;
rest under gravity; scenes of a plane that are extruded; what enters and leaves; restarts, probes.

Twins: fractures in general position, mirrored, values that are disturbed by 1e-9, and two processes."""

import math
import subprocess
import unittest

import numpy as np

from hexahedra import TURN, mesh_file, moved_nodes
from scene_runs import ROOT, SPREKK, SceneRuns, on_two_processes, sprekk

SIDES = ("left", "right", "front", "back", "bottom", "top")
# Two fractures that cut the box and each other, in general position but for one axis, and one with its rim in the rock.
CUTS = {"one": [[0.3, 0, 0], [0.5, 1.2, 0], [0.6, 1.2, 0.9], [0.4, 0, 0.9]],
        "other": [[0, 0.4, 0], [1, 0.7, 0], [1, 0.8, 0.9], [0, 0.5, 0.9]]}
FLOWS = [f"{flow}.{side}.outflow[m^3/s]" for flow in ("pore", "conduit") for side in SIDES]
LINEAR = "(1 + x/m - 2*y/m + 0.5*z/m) Pa"


def linear(x):
    return 1 + x[..., 0] - 2 * x[..., 1] + 0.5 * x[..., 2]


def scene(mesh, fractures, flow="mfd", rock="mpfa", pressure=LINEAR, more="", rock_more="", fluid="viscosity: 1 Pa*s, fluid_compressibility: 0 1/Pa",
          walls="1e10 m/(Pa*s)", box="{x: [0 m, 1 m], y: [0 m, 1.2 m], z: [0 m, 0.9 m]}", end="1 s"):
    """The text of a scene with these fractures, whose pressure is given on all sides (none where `pressure` is None)."""
    sides = ", ".join(f"{side}: {{pressure: {pressure}}}" for side in SIDES) if pressure else ""
    corners = "".join(f"    {name}: {{points: {[[f'{float(c)!r} m' for c in point] for point in points]}}}\n".replace("'", "")
                      for name, points in fractures.items())
    conduit = f"""
  conduit:
    type: fracture_flow/{flow}
    {fluid.replace(', ', chr(10) + '    ')}
    initial_aperture: 0.1 mm
    transmissivity: constant
    transmissivity_value: 1 m^3
    normal_permeability: constant
    normal_permeability_value: {walls}
    boundary: {{{sides}}}""" if fractures else ""
    coupling = "couplers:\n  - {type: wall_exchange, between: [pore, conduit]}\n" if fractures else ""
    return f"""
name: in_space
geometry:
  box: {box}
{'  fractures:' if fractures else ''}
{corners}
mesh: {mesh}
components:
  pore:
    type: matrix_flow/{rock}
    permeability: {{xx: 1 m^2, yy: 2 m^2, zz: 1.5 m^2, xy: 0.3 m^2, yz: -0.2 m^2, xz: 0.4 m^2}}
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary: {{{sides}}}
{rock_more}{conduit}
{coupling}
schedule:
  - solve: [{'pore, conduit' if fractures else 'pore'}]
time: {{end: {end}, step: {end}}}
{more}
"""


AT_ZERO = """
name: at_zero
geometry:
  box: {x: [0 m, 100 m], y: [0 m, 100 m], z: [0 m, 100 m]}
  fractures:
    f1: {points: [[0 m, 50 m, 0 m], [100 m, 50 m, 0 m], [100 m, 50 m, 100 m], [0 m, 50 m, 100 m]]}
mesh: {kind: structured, shape: hexahedra, cells: [5, 2, 5]}
materials: {viscosity: 2e-4 Pa*s, fluid_compressibility: 0 1/Pa}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 3.6e-14 m^2
    storage: 0 1/Pa
    initial_pressure: 5e6 Pa
    boundary: {bottom: {pressure: 3e6 Pa}}
  conduit:
    type: fracture_flow/mfd
    initial_aperture: 1e-5 m
    initial_pressure: 5e6 Pa
    prescribed: {all: {fracture: f1, pressure: 0 Pa}}
couplers: [{type: wall_exchange, between: [pore, conduit]}]
schedule: [{solve: [pore, conduit]}]
time: {end: 1 s, step: 1 s}
"""


class FlowInSpace(SceneRuns):
    def run_text(self, text, *settings, **how):
        return self.run_scene(self.write(text, f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    def assert_linear(self, results, within):
        rock = results.fields()
        self.assertEqual(rock.dimension, 3)
        self.assertLess(np.abs(rock["pore.pressure"] - linear(rock.centres)).max(), within)
        if "fractures.pvd" in {path.name for path in results.folder.iterdir()}:
            lines = results.fractures()
            self.assertLess(np.abs(lines["conduit.pressure"] - linear(lines.centres)).max(), within)

    def test_linear_pressures_are_exact_on_every_mesh(self):
        along_axes = {"one": [[0.5, 0, 0], [0.5, 1.2, 0], [0.5, 1.2, 0.9], [0.5, 0, 0.9]],
                      "other": [[0, 0, 0.3], [1, 0, 0.3], [1, 1.2, 0.3], [0, 1.2, 0.3]]}
        for mesh, fractures in (("{size: 0.25 m}", CUTS), ("{kind: structured, shape: hexahedra, cells: [4, 4, 3]}", along_axes),
                                ("{kind: structured, shape: wedges, cells: [4, 4, 3]}", along_axes),
                                ("{kind: structured, shape: tetrahedra, cells: [4, 4, 3]}", along_axes),
                                ("{size: 0.3 m}", {})):
            with self.subTest(mesh):
                # What the walls hold back is some 1e-10 of the pressure.
                self.assert_linear(self.run_text(scene(mesh, fractures)), 5e-10)

    def from_file(self, turn, rock="mpfa", more="", **mesh):
        self.write(mesh_file(turn, **mesh), f"mesh_{next(self.numbers)}.msh")
        text = scene("{}", {"fault": []}, rock=rock, more=more).replace("  box: {x: [0 m, 1 m], y: [0 m, 1.2 m], z: [0 m, 0.9 m]}\n  fractures:\n    fault: {points: []}\n",
                                                  f"  file: {max(self.folder.glob('mesh_*.msh'), key=lambda path: path.stat().st_mtime_ns).name}\n")
        sides = ", ".join(f"{side}: {{pressure: {LINEAR}}}" for side in SIDES)
        return text.replace("mesh: {}\n", "").replace(sides, f"west: {{pressure: {LINEAR}}}, others: {{pressure: {LINEAR}}}")

    def test_a_mesh_from_a_file(self):
        """It says by itself that it is in space, also through `check`; as drawn, turned about no axis, mirrored."""
        mirror = TURN @ np.diag([1, -1, 1])
        for turn in (np.eye(3), TURN, mirror):
            text = self.from_file(turn)
            self.assertEqual(self.call("check", self.write(text)).returncode, 0)
            self.assert_linear(self.run_text(text), 5e-10)

    def test_velocities_are_exact_in_cells_with_bent_faces(self):
        """-K grad p for a linear pressure."""
        exact = -np.array([[1, 0.3, 0.4], [0.3, 2, -0.2], [0.4, -0.2, 1.5]]) @ [1, -2, 0.5]
        mirror = TURN @ np.diag([1, -1, 1])
        for turn, rock, wedges in ((np.eye(3), "mpfa", False), (TURN, "mpfa", True), (mirror, "rt0", False), (TURN, "rt0", True)):
            with self.subTest(rock=rock, wedges=wedges):
                velocity = self.run_text(self.from_file(turn, rock, wedges=wedges)).fields()["pore.velocity"]
                self.assertLess(np.abs(velocity - exact).max(), 1e-8)

    def test_values_between_the_planes_of_bent_faces(self):
        """At the middles of edges in the rock, where planes through bent faces leave gaps: along lines, and at probes."""
        for turn, wedges in ((np.eye(3), False), (TURN, True)):
            nodes = moved_nodes(turn, moved=0.09)
            middles = (nodes[[1, 1, 3, 3], 1, 1:] + nodes[[1, 1, 3, 3], 2, 1:]).reshape(-1, 3) / 2
            places = ["[" + ", ".join(f"{x!r} m" for x in map(float, at)) + "]" for at in middles]
            probes = ", ".join(f"p{k}: {{of: pore.pressure, at: {at}}}" for k, at in enumerate(places))
            line = f"across: {{of: pore.pressure, from: {places[0]}, to: {places[-1]}, points: 2}}"
            results = self.run_text(self.from_file(turn, more=f"output: {{probes: {{{probes}}}, lines: {{{line}}}}}\n", moved=0.09, wedges=wedges))
            found = np.array([results[f"p{k}"][-1] for k in range(len(places))])
            self.assertLess(np.abs(found - linear(middles)).max(), 1e-8)
            along = sprekk.read_table(results.folder / "line_across.csv")["pore.pressure[Pa]"][-2:]
            self.assertLess(np.abs(along - linear(middles[[0, -1]])).max(), 1e-8)

    def test_a_linear_pressure_disturbed_by_round_off_hardly_moves(self):
        one = self.run_text(scene("{size: 0.3 m}", CUTS))
        other = self.run_text(scene("{size: 0.3 m}", CUTS), "components.pore.viscosity=1.000000001 Pa*s")
        self.assertLess(self.largest_difference(one, other, FLOWS), 1e-8)

    @on_two_processes
    def test_two_processes_have_the_answer_of_one(self):
        text = scene("{size: 0.25 m, division: scattered}", CUTS)
        self.assertLess(self.largest_difference(self.run_text(text), self.run_text(text, processes=2), FLOWS), 1e-9)

    def test_two_point_fluxes_are_not_exact_on_triangles(self):
        results = self.run_text(scene("{size: 0.25 m}", CUTS, flow="tpfa"))
        self.assertTrue(any("take fracture_flow/mfd" in note for note in results.notes))
        self.assertFalse(any("take fracture_flow/mfd" in note for note in self.run_text(scene("{size: 0.25 m}", CUTS)).notes))
        lines = results.fractures()
        self.assertGreater(np.abs(lines["conduit.pressure"] - linear(lines.centres)).max(), 1e-3)

    def test_a_curved_pressure_is_of_second_order_with_fractures_that_cross(self):
        """p = cos(pi y) cos(pi z) in rock and in two fractures, of which one is crossed by the flow, with the sources that this needs."""
        curve = "cos(pi*y/m)*cos(pi*z/m)"
        across = "{{points: [[0.5 m, 0 m, 0 m], [0.5 m, 1 m, 0 m], [0.5 m, 1 m, 1 m], [0.5 m, 0 m, 1 m]]}}"
        upright = "{{points: [[0 m, 0.4 m, 0 m], [1 m, 0.4 m, 0 m], [1 m, 0.4 m, 1 m], [0 m, 0.4 m, 1 m]]}}"
        errors, cells = [], []
        for size in (0.16, 0.08, 0.055):
            results = self.run_text(f"""
name: curved
geometry:
  box: {{x: [0 m, 1 m], y: [0 m, 1 m], z: [0 m, 1 m]}}
  fractures: {{across: {across.format()}, upright: {upright.format()}}}
mesh: {{size: {size} m}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    source: (2*pi^2*{curve}) 1/s
    boundary: {{left: {{pressure: ({curve}) Pa}}, right: {{pressure: ({curve}) Pa}}}}
  conduit:
    type: fracture_flow/mfd
    viscosity: 1 Pa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: 0.1 mm
    transmissivity: constant
    transmissivity_value: 0.7 m^3
    normal_permeability: constant
    normal_permeability_value: 1e8 m/(Pa*s)
    injection:
      one: {{fracture: across, rate: (0.7*2*pi^2*{curve}) m^3/s}}
      other: {{fracture: upright, rate: (0.7*pi^2*{curve}) m^3/s}}
    boundary: {{left: {{pressure: ({curve}) Pa}}, right: {{pressure: ({curve}) Pa}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
schedule:
  - solve: [pore, conduit]
time: {{end: 1 s, step: 1 s}}
""")
            of_size = []
            for kind, name in (("matrix", "pore.pressure"), ("fractures", "conduit.pressure")):
                fields = results.fields(kind=kind)
                exact = np.cos(np.pi * fields.centres[:, 1]) * np.cos(np.pi * fields.centres[:, 2])
                of_size.append(np.sqrt((fields.sizes * (fields[name] - exact) ** 2).sum() / fields.sizes.sum()))
            errors.append(of_size)
            cells.append(len(results.fields().sizes))
        orders = np.log(np.array(errors[0]) / np.array(errors[-1])) / math.log(cells[-1] / cells[0]) * 3
        print("errors of a curved pressure in rock and fractures:", errors, "orders", orders)
        self.assertGreater(orders.min(), 1.9)

    def test_a_fracture_at_zero_pressure_has_its_answer_with_every_solver(self):
        """What MUMPS leaves of zero pressures and fluxes is no residual."""
        rates = [self.run_text(AT_ZERO, f"solver={{type: {solver}}}")["conduit.all.rate"][-1] for solver in ("umfpack", "mumps")]
        self.assertAlmostEqual(rates[1], rates[0], delta=1e-9 * abs(rates[0]))
        self.assertLess(rates[0], -0.1)

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

    def test_two_point_fluxes_in_the_rock_tell_where_they_are_not_exact(self):
        for mesh, told in (("{kind: structured, shape: hexahedra, cells: [3, 3, 3]}", False), ("{kind: structured, shape: tetrahedra, cells: [3, 3, 3]}", True)):
            text = scene(mesh, {}, rock="tpfa").replace("{xx: 1 m^2, yy: 2 m^2, zz: 1.5 m^2, xy: 0.3 m^2, yz: -0.2 m^2, xz: 0.4 m^2}", "{xx: 1 m^2, yy: 2 m^2, zz: 1.5 m^2}")
            self.assertEqual(any("two-point fluxes are not exact" in note for note in self.run_text(text).notes), told)
            turned = scene(mesh, {}, rock="tpfa")
            self.assertTrue(any("take matrix_flow/mpfa" in note for note in self.run_text(turned).notes))

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

    def test_what_enters_leaves(self):
        results = self.run_text(scene("{size: 0.25 m}", CUTS))
        flows = [values[-1] for name, values in results.history.items() if "outflow[" in name and "fluid" not in name]
        self.assertLess(abs(sum(flows)), 1e-9)
        # K grad p through the left side: -(1 - 0.6 + 0.2) over its area, without the width of the fractures.
        self.assertAlmostEqual(results["pore.left.outflow"][-1], (1 * 1 + 0.3 * -2 + 0.4 * 0.5) * 1.2 * 0.9, delta=1e-8)

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

    def test_fluid_at_rest_stays_at_rest_under_gravity(self):
        gravity = "gravity: [0, 0, -9.81 m/s^2]\n    fluid_density: 1000 kg/m^3"
        fluid = "viscosity: 1 Pa*s, fluid_compressibility: 1e-9 1/Pa, " + gravity.replace("\n    ", ", ").replace("[0, 0, ", "[0,0,")
        weight = "(1e5 + 9810*(0.9 - z/m)) Pa"
        text = scene("{size: 0.3 m}", {**CUTS, "third": [[0.1, 0.9, 0.1], [0.3, 1.1, 0.2], [0.2, 1.0, 0.7]]}, pressure=None,
                     rock_more=f"    initial_pressure: {weight}\n    {gravity}\n", fluid=fluid + f", initial_pressure: {weight}", end="1e5 s")
        rock = self.run_text(text, "components.pore.storage=1e-9 1/Pa").fields()
        self.assertLess(np.abs(rock["pore.pressure"] - 1e5 - 9810 * (0.9 - rock.centres[:, 2])).max(), 1e-6)
        self.assertLess(np.abs(rock["pore.flux"]).max() if "pore.flux" in rock.names else 0, 1e-9)

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

    def test_a_run_goes_on_from_its_checkpoint_to_the_bit(self):
        text = scene("{size: 0.3 m}", CUTS, pressure=None, rock_more="    initial_pressure: (x/m) Pa\n",
                     fluid="viscosity: 1 Pa*s, fluid_compressibility: 1e-3 1/Pa")
        settings = ("components.pore.storage=1 1/Pa", "time.step=0.125 s")
        whole = self.run_text(text, *settings, "time.end=0.75 s")
        path = self.write(text, "restarted.yaml")
        part = self.run_scene(path, *settings, "time.end=0.375 s")
        self.assert_same_bits(self.run_scene(path, *settings, "time.end=0.75 s", restart=part.folder), whole)

    def test_the_scene_of_the_tutorial_has_no_note(self):
        results = self.run_scene(ROOT / "configs/tutorial/fractured_block.yaml")
        self.assertEqual(results.notes, [])
        # What is injected leaves, but for what the fluid stores as its pressure rises.
        self.assertLess(abs(results.history["fluid_balance_error[m^3]"][-1]), 1e-9 * results.history["fluid_injected[m^3]"][-1])
        report = self.call("report", results.folder)
        self.assertEqual(report.returncode, 0, report.stderr)
        self.assertIn('"inSpace":true', (results.folder / "report.html").read_text())
        with self.assertRaises(ValueError):
            results.paths()
        with self.assertRaises(ValueError):
            results.fields().grid.triangles()
        self.assertAlmostEqual(results.fields().sizes.sum(), 100 * 80 * 60, delta=1e-6)
        self.assertAlmostEqual(results.fractures().mean("conduit.aperture"), 1.663e-4, delta=2e-7)  # the fault has 5,029 m^2, the others 2,560, a little less where chords cut the circle
        for tool in ("plot", "turn_scene"):
            words = [results.folder] if tool == "plot" else [ROOT / "configs/tutorial/fractured_block.yaml", self.folder / "turned", "--program", SPREKK]
            refused = subprocess.run([ROOT / "tools" / tool, *words], capture_output=True, text=True, check=False)
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn("in space", refused.stderr)

    def test_wells_at_points_share_their_rate_with_the_cells_around(self):
        text = scene("{size: 0.3 m}", {}, pressure="0 Pa", rock_more="    wells: {feed: {at: [0.4 m, 0.7 m, 0.5 m], rate: 2e-3 m^3/s}}\n")
        results = self.run_text(text)
        self.assertAlmostEqual(sum(results[f"pore.{side}.outflow"][-1] for side in SIDES), 2e-3, delta=1e-12)

    def test_inertia_is_exact_for_constant_flows_in_every_direction(self):
        """Forchheimer's law, 12 mu v/h^3 + beta rho |v| v/h^2 = -grad p, in fractures that cross, with a linear pressure at their rims."""
        gradient, beta, density, viscosity, h = np.array([-900.0, 400.0, -250.0]), 500.0, 1000.0, 1e-3, 1e-3
        level = {"low": [[0, 0, 0.3], [1, 0, 0.6], [1, 1.2, 0.6], [0, 1.2, 0.3]], "up": [[0.3, 0, 0], [0.6, 1.2, 0], [0.6, 1.2, 0.9], [0.3, 0, 0.9]]}
        along_axes = {"low": [[0, 0, 0.45], [1, 0, 0.45], [1, 1.2, 0.45], [0, 1.2, 0.45]], "up": [[0.5, 0, 0], [0.5, 1.2, 0], [0.5, 1.2, 0.9], [0.5, 0, 0.9]]}
        pressure = "(2000 + " + " + ".join(f"({g!r})*{axis}/m" for axis, g in zip("xyz", map(float, gradient))) + ") Pa"
        sides = ", ".join(f"{side}: {{pressure: {pressure}}}" for side in SIDES)
        rectangles = "{kind: structured, shape: hexahedra, cells: [4, 4, 4]}"
        for flow, mesh, fractures in (("mfd", "{size: 0.3 m}", level), ("mfd", "{size: 0.15 m}", level), ("mfd", rectangles, along_axes),
                                      ("tpfa", rectangles, along_axes)):
            for law in ("type: cubic", f"type: constant, transmissivity: {h**3 / 12} m^3"):
                with self.subTest(flow=flow, mesh=mesh, law=law):
                    lines = "".join(f"    {name}: {{points: {[[f'{float(c)!r} m' for c in point] for point in points]}}}\n".replace("'", "")
                                    for name, points in fractures.items())
                    results = self.run_text(f"""
geometry:
  box: {{x: [0 m, 1 m], y: [0 m, 1.2 m], z: [0 m, 0.9 m]}}
  fractures:
{lines}
mesh: {mesh}
components:
  conduit:
    type: fracture_flow/{flow}
    viscosity: {viscosity} Pa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: {h} m
    law: {{{law}, inertia: {beta} 1/m}}
    boundary: {{{sides}}}
schedule:
  - solve: [conduit]
time: {{end: 1 s, step: 1 s}}
""")
                    lines = results.fractures()
                    self.assertLess(np.abs(lines["conduit.pressure"] - 2000 - lines.centres @ gradient).max(), 1e-6)
                    exact = dict.fromkeys(SIDES, 0.0)
                    for corners in map(np.array, fractures.values()):
                        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
                        fall = -(gradient - gradient @ normal / (normal @ normal) * normal)
                        linear_part, square_part = 12 * viscosity / h**3, beta * density / h**2
                        speed = 2 * np.linalg.norm(fall) / (linear_part + math.sqrt(linear_part**2 + 4 * square_part * np.linalg.norm(fall)))
                        self.assertGreater(speed * square_part / linear_part, 0.1)  # inertia matters
                        for one, other in zip(corners, np.roll(corners, -1, axis=0)):
                            middle = (one + other) / 2 / [1, 1.2, 0.9]
                            axis = np.abs(middle - 0.5).argmax()
                            out = np.cross(other - one, normal) / np.linalg.norm(normal)  # outward, of its length: corners turn about the normal
                            exact[SIDES[2 * axis + round(middle[axis])]] += speed * (fall / np.linalg.norm(fall)) @ out
                    for side in SIDES:
                        found = results.history.get(f"conduit.{side}.outflow[m^3/s]", [0])[-1]
                        self.assertAlmostEqual(found, exact[side], delta=1e-8 * max(map(abs, exact.values())), msg=side)

    def test_extruded_scenes_have_the_answers_of_the_plane(self):
        """Structured rectangles and triangles of a plane, as hexahedra and wedges: (x, y) becomes (x, z)."""
        # A conductor and a barrier that cross; the barrier ends in the rock.
        lines = {"along": ([0, 0.5], [1, 0.5]), "up": ([0.5, 0], [0.5, 0.75])}
        for flat, solid in (("triangles", "wedges"), ("quadrilaterals", "hexahedra")):
            with self.subTest(solid):
                # wedges are extruded along z: there the plane is that of x and y
                depth = 2 if solid == "wedges" else 1

                def text(dimension, depth=depth, flat=flat, solid=solid):
                    def place(point, deep):
                        numbers = list(point) if dimension == 2 else [point[0], *([point[1], deep] if depth == 2 else [deep, point[1]])]
                        return "[" + ", ".join(f"{c} m" for c in numbers) + "]"

                    def points(ends):
                        one, other = ends
                        corners = [(one, 0), (other, 0)] if dimension == 2 else [(one, 0), (other, 0), (other, 2), (one, 2)]
                        return "[" + ", ".join(place(*corner) for corner in corners) + "]"
                    up, axis = ("top", "y") if dimension == 2 else (("back", "y") if depth == 2 else ("top", "z"))
                    down = {"top": "bottom", "back": "front"}[up]
                    cells = "[8, 8]" if dimension == 2 else ("[8, 8, 3]" if depth == 2 else "[8, 3, 8]")
                    box = {2: "{x: [0 m, 1 m], y: [0 m, 1 m]}", 3: "{x: [0 m, 1 m], y: [0 m, 1 m], z: [0 m, 2 m]}" if depth == 2 else
                           "{x: [0 m, 1 m], y: [0 m, 2 m], z: [0 m, 1 m]}"}[dimension]
                    return f"""
name: extruded
geometry:
  box: {box}
  fractures: {{along: {{points: {points(lines['along'])}}}, up: {{points: {points(lines['up'])}}}}}
mesh: {{kind: structured, shape: {flat if dimension == 2 else solid}, cells: {cells}}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-3 m^2
    viscosity: 1 Pa*s
    storage: 0.1 1/Pa
    boundary: {{left: {{pressure: (1 + {axis}/m) Pa}}, {up}: {{pressure: 0 Pa}}, {down}: {{flux: -1e-3 m/s}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 Pa*s
    fluid_compressibility: 0.1 1/Pa
    initial_aperture: 1 mm
    transmissivity: constant
    transmissivity_value: {{fractures: {{along: 1e-2 m^3, up: 1e-8 m^3}}}}
    normal_permeability: constant
    normal_permeability_value: {{fractures: {{along: 1e3 m/(Pa*s), up: 1e-5 m/(Pa*s)}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
schedule:
  - solve: [pore, conduit]
time: {{end: 5 s, step: 1 s}}
output: {{fields: true}}
"""
                plane, space = (self.run_text(text(dimension)) for dimension in (2, 3))
                for kind, name in (("matrix", "pore.pressure"), ("fractures", "conduit.pressure")):
                    flat_fields, solid_fields = plane.fields(kind=kind), space.fields(kind=kind)
                    seen = np.delete(solid_fields.centres, depth, axis=1)
                    apart = np.linalg.norm(seen[:, None] - flat_fields.centres[None], axis=2)
                    self.assertLess(apart.min(axis=1).max(), 1e-9)
                    wanted = flat_fields[name][apart.argmin(axis=1)]
                    scale = np.abs(flat_fields[name]).max()
                    self.assertLess(np.abs(solid_fields[name] - wanted).max(), 1e-9 * scale, (solid, name))


if __name__ == "__main__":
    unittest.main()
