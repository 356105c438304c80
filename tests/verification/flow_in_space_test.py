#!/usr/bin/python3
"""flow_in_space_test.py SPREKK [MPIEXEC]: flow in rock and fractures in space, on every kind of mesh: linear pressures, which are exact;
rest under gravity; scenes of a plane that are extruded; what enters and leaves; restarts, probes.

Twins: fractures in general position, mirrored, values that are disturbed by 1e-9, and two processes."""

import json
import math
import re
import subprocess
import unittest

import numpy as np

from hexahedra import TURN, mesh_file, moved_nodes
from scene_runs import ROOT, SPREKK, on_two_processes, sprekk
from scenes_in_space import CUTS, FLOWS, LINEAR, SIDES, SpaceRuns, linear, scene


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


class FlowInSpace(SpaceRuns):
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

    def test_two_point_fluxes_in_the_rock_tell_where_they_are_not_exact(self):
        for mesh, told in (("{kind: structured, shape: hexahedra, cells: [3, 3, 3]}", False), ("{kind: structured, shape: tetrahedra, cells: [3, 3, 3]}", True)):
            text = scene(mesh, {}, rock="tpfa").replace("{xx: 1 m^2, yy: 2 m^2, zz: 1.5 m^2, xy: 0.3 m^2, yz: -0.2 m^2, xz: 0.4 m^2}", "{xx: 1 m^2, yy: 2 m^2, zz: 1.5 m^2}")
            self.assertEqual(any("two-point fluxes are not exact" in note for note in self.run_text(text).notes), told)
            turned = scene(mesh, {}, rock="tpfa")
            self.assertTrue(any("take matrix_flow/mpfa" in note for note in self.run_text(turned).notes))

    def test_what_enters_leaves(self):
        results = self.run_text(scene("{size: 0.25 m}", CUTS))
        flows = [values[-1] for name, values in results.history.items() if "outflow[" in name and "fluid" not in name]
        self.assertLess(abs(sum(flows)), 1e-9)
        # K grad p through the left side: -(1 - 0.6 + 0.2) over its area, without the width of the fractures.
        self.assertAlmostEqual(results["pore.left.outflow"][-1], (1 * 1 + 0.3 * -2 + 0.4 * 0.5) * 1.2 * 0.9, delta=1e-8)

    def test_fluid_at_rest_stays_at_rest_under_gravity(self):
        gravity = "gravity: [0, 0, -9.81 m/s^2]\n    fluid_density: 1000 kg/m^3"
        fluid = "viscosity: 1 Pa*s, fluid_compressibility: 1e-9 1/Pa, " + gravity.replace("\n    ", ", ").replace("[0, 0, ", "[0,0,")
        weight = "(1e5 + 9810*(0.9 - z/m)) Pa"
        text = scene("{size: 0.3 m}", {**CUTS, "third": [[0.1, 0.9, 0.1], [0.3, 1.1, 0.2], [0.2, 1.0, 0.7]]}, pressure=None,
                     rock_more=f"    initial_pressure: {weight}\n    {gravity}\n", fluid=fluid + f", initial_pressure: {weight}", end="1e5 s")
        rock = self.run_text(text, "components.pore.storage=1e-9 1/Pa").fields()
        self.assertLess(np.abs(rock["pore.pressure"] - 1e5 - 9810 * (0.9 - rock.centres[:, 2])).max(), 1e-6)
        self.assertLess(np.abs(rock["pore.flux"]).max() if "pore.flux" in rock.names else 0, 1e-9)

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
        page = (results.folder / "report.html").read_text()
        self.assertIn('"inSpace":true', page)
        edges = json.loads(re.search(r'"edges":(\[.*?\}\])', page)[1])
        self.assertEqual([(edge["name"], edge["low"], edge["high"]) for edge in edges], [("x", 0, 100), ("y", 0, 80), ("z", -60, 0)])
        for one, other in ((0, 1), (1, 2)):  # they meet, at the front below and at the left behind
            meeting = (edges[0]["from"], edges[1]["from"]) if one == 0 else (edges[1]["to"], edges[2]["from"])
            np.testing.assert_allclose(*meeting, atol=1e-9)
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
        for flat, solid, crossing in (("triangles", "wedges", ""), ("quadrilaterals", "hexahedra", ""), ("triangles", "wedges", "through: up"),
                                      ("quadrilaterals", "hexahedra", "permeability: 1e-3 m^2")):
            with self.subTest(solid, crossing=crossing):
                # wedges are extruded along z: there the plane is that of x and y
                depth = 2 if solid == "wedges" else 1

                def text(dimension, depth=depth, flat=flat, solid=solid, crossing=crossing):
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
    {f"crossings: {{x: {{{crossing}}}}}" if crossing else ""}
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
