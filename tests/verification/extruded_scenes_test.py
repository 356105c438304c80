#!/usr/bin/python3
"""extruded_scenes_test.py SPREKK [MPIEXEC]: each verification scene of flow and heat, and of rock with fluid and without fractures,
extruded into space, has its answer in the plane; one with contact has it to 1 %.

(x, y) becomes (x, z): the mesh of the plane, node by node, becomes two layers of wedges (or hexahedra), each line of a fracture a row of
rectangles. Sides in front and behind let nothing through, and are rollers. Expressions of y become those of z, rates are those over the depth."""

import importlib.machinery
import importlib.util
import json
import re
import unittest

import numpy as np

from scene_runs import ROOT, SPREKK, SceneRuns, on_two_processes

SCENES = ROOT / "configs"
# What the scenes have that has no counterpart in space.
LEFT_OUT = {"tutorial/heat_doublet.yaml": "wells at points of fractures, which would be lines",
            "tutorial/tracer_doublet.yaml": "wells at points of fractures, which would be lines",
            "tutorial/well_limits.yaml": "wells at points of fractures, which would be lines"}
# Settings of the plane and of space: coarser meshes, for seconds; and a point, which would become a line, becomes the whole fracture.
EXTRUDED = {"verification/closed_box.yaml": ["components.conduit.injection.well.at=null", "components.conduit.injection.well.fracture=main"],
            "verification/complex_network.yaml": ["mesh={size: 0.1 m, fracture_size: 0.04 m}"],
            "verification/fracture_barrier.yaml": ["mesh={size: 0.2 m, fracture_size: 30 mm, growth: 0.2}"],
            "verification/fracture_inflow.yaml": ["mesh={size: 0.2 m, fracture_size: 30 mm, growth: 0.2}"],
            "tutorial/geothermal_convection.yaml": ["mesh={size: 0.3 km, fracture_size: 0.15 km}", "time={end: 200000 day, step: 100000 day}",
                                                   "components.heat.boundary.bottom.temperature=(413.15 - 0.02*x/m) K"],
            "verification/hydrocoin.yaml": [],
            "verification/lauwerier.yaml": ["mesh.cells=[10, 20]", "time={end: 5e4 s, step: 1e4 s}"],
            "verification/ogata_banks.yaml": ["mesh.cells=[40, 1]", "time={end: 2e4 s, step: 4e3 s}"],
            "verification/outcrop_network.yaml": ["mesh={size: 60 m, fracture_size: 30 m}"],
            "verification/regular_network.yaml": ["mesh.size=0.06 m"],
            "verification/single_mode_fracture.yaml": ["mesh.size=0.08 m"],
            "verification/theis.yaml": ["mesh={kind: structured, cells: [25, 25], shape: quadrilaterals}", "time={end: 4e4 s, step: 4e3 s}"]}
BALANCED = ("verification/single_mode_fracture.yaml",)  # as much leaves each side as enters it: the sums are round-off
# Scenes of rock without fractures, by elements of second order, whose functions contain those of the plane. In a cell they replace the change of
# volume by a linear one; a half of the difference belongs to each direction in a plane, and a third in space: 8e-8 of the pressure and 5e-6 of the stress in Mandel's.
ROCK = {"swaps/mandel_fem.yaml": ["mesh.size=0.1 m"],
        "verification/mandel.yaml": ["mesh.size=0.1 m"],
        "verification/terzaghi.yaml": ["mesh.cells=[2, 20]"]}
ROCK_LEFT_OUT = {"verification/barry_mercer.yaml": "a well at a point, which would be a line",
                 "verification/biot_manufactured.yaml": "loads that are no polynomials: their means in wedges are not those in triangles",
                 "tutorial/tunnel.yaml": "regions that are taken away, by polygons"}
# With contact. Around tips the change of volume is not linear in a cell, so that the same difference counts; and rays from a tip have four points in wedges,
# three in the plane. Together they are 0.6 % of the largest traction; with a half and three points in space the answer is that of the plane to 3e-12.
CONTACT = {"verification/frictional_crack.yaml": ["mesh={size: 40 m, fracture_size: 0.25 m, growth: 0.5}"]}
FINITE_ELEMENTS = ["components.rock.type=poromechanics/fem", "components.rock.order=second"]
VECTORS = {"displacement": "0 m", "traction": "0 Pa", "body_force": "0 N/m^3", "gravity": "0 m/s^2"}  # and 0 of their unit
COUPLED = ("poromechanics", "contact")  # what a scene of flow and heat has not
LAYERS = 2

loader = importlib.machinery.SourceFileLoader("turn_scene", str(ROOT / "tools/turn_scene"))
turn_scene = importlib.util.module_from_spec(importlib.util.spec_from_loader("turn_scene", loader))
loader.exec_module(turn_scene)


def extrude_mesh(source, target, depth):
    """A mesh file of a plane (gmsh's format 2.2) as one of so many layers of wedges and hexahedra."""
    sections = {name: text.strip().splitlines() for name, text in re.findall(r"\$(\w+)\n(.*?)\$End\1", source.read_text(), re.DOTALL)}
    nodes = [line.split() for line in sections["Nodes"][1:]]
    number = {node[0]: i for i, node in enumerate(nodes)}
    groups = [line.split(maxsplit=2) for line in sections["PhysicalNames"][1:]]
    names = [f'{int(kind) + 1} {group} {name}' for kind, group, name in groups]
    front = max(int(group) for _, group, _ in groups) + 1
    names += [f'2 {front} "front"', f'2 {front + 1} "back"']
    count = len(nodes)
    elements = []
    for line in sections["Elements"][1:]:
        _, kind, tags, group, *rest = line.split()
        corners = [number[node] for node in rest[int(tags) - 1:]]
        for layer in range(LAYERS):
            low, high = ([corner + at * count for corner in corners] for at in (layer, layer + 1))
            if kind == "1":
                elements.append((3, group, [*low, *high[::-1]]))
            else:
                elements.append((6 if kind == "2" else 5, group, [*high, *low]))  # x, z, y are left-handed
        if kind != "1":
            elements += [(kind, front, corners), (kind, front + 1, [corner + LAYERS * count for corner in corners])]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(names), *names, "$EndPhysicalNames", "$Nodes", (LAYERS + 1) * count]
    lines += [f"{i + layer * count + 1} {x} {layer * depth / LAYERS!r} {y}" for layer in range(LAYERS + 1) for i, (_, x, y, _) in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", len(elements)]
    lines += [f"{i} {kind} 2 {group} {group} {' '.join(str(corner + 1) for corner in corners)}" for i, (kind, group, corners) in enumerate(elements, 1)]
    target.write_text("\n".join(map(str, [*lines, "$EndElements", ""])))


def in_space(value, depth):
    """A datum of the plane: y becomes z, a rate in m^2/s one over the depth; a tensor has the same value along y as along x."""
    if isinstance(value, dict):
        if set(value) <= {"xx", "yy", "xy"}:
            return {"xx": value["xx"], "yy": value["xx"], "zz": value["yy"], **({"xz": value["xy"]} if "xy" in value else {})}
        return {key: in_space(entry, depth) for key, entry in value.items()}
    if isinstance(value, list):
        return [in_space(entry, depth) for entry in value]
    number = turn_scene.number_of(value)
    if number:
        return f"{number[0] * depth!r} m^3/s" if number[1] == "m^2/s" else value
    return re.sub(r"(?<![\w.])y(?![\w(])", "z", value)


def extrude(parameters, mesh, depth):
    """What has to change in a scene of the plane."""
    changed = {"geometry.file": str(mesh)}
    if "components.rock.type" in parameters:
        changed.update({f"components.rock.boundary.{side}.displacement_y": "0 m" for side in ("front", "back")})
    for path, text in parameters.items():
        if path.partition(".")[0] not in ("components", "materials") or path.endswith((".type", ".fracture")):
            continue
        value = turn_scene.read_flow(text)
        folder, _, name = path.rpartition(".")
        if folder.startswith("components.wells.wells") and name == "at":
            changed[path] = None  # a point of the rock is a line at right angles to the plane
            path, name = f"{folder}.points", "points"
            changed[path] = [[value[0], y, value[1]] for y in ("0 m", f"{depth!r} m")]
            continue
        if name in VECTORS:
            value = [value[0], VECTORS[name], value[1]]
            changed[path] = in_space(value, depth)
        if name.endswith("_y"):
            changed[path] = None
            path = path[:-1] + "z"
            changed[path] = in_space(value, depth)
        if in_space(value, depth) != value:
            changed[path] = in_space(value, depth)
    return turn_scene.nest(changed)


def sides_of(places, cells):
    """Edges with one cell, by side; what is at no side of the rectangle around is at the top."""
    count = {}
    for cell in cells:
        for a, b in zip(cell, cell[1:] + cell[:1]):
            count.setdefault(frozenset((a, b)), []).append((a, b))
    low, high = places.min(0), places.max(0)
    sides = {"left": [], "right": [], "bottom": [], "top": []}
    for edges in count.values():
        if len(edges) == 1:
            x, y = places[list(edges[0])].T
            at = [side for side, values, place in (("left", x, low[0]), ("right", x, high[0]), ("bottom", y, low[1])) if np.ptp(values) == 0 and values[0] == place]
            sides[at[0] if at else "top"].append(edges[0])
    return sides


class ExtrudedScenes(SceneRuns):
    def test_every_scene_of_flow_is_extruded_or_left_out_with_its_reason(self):
        flows = set()
        for folder in ("verification", "tutorial"):
            for scene in (SCENES / folder).glob("*.yaml"):
                text = scene.read_text()
                if ("matrix_flow/" in text or "matrix_heat/" in text) and not any(word in text for word in COUPLED) and " z: [" not in text:
                    flows.add(f"{folder}/{scene.name}")
        self.assertEqual(flows, set(EXTRUDED) | set(LEFT_OUT))

    def in_plane_and_space(self, name, *settings, processes=1):
        """Both results, and the depth."""
        scene = SCENES / name
        settings = [*{**EXTRUDED, **ROCK, **CONTACT}[name], *settings, "output.fields=true", *(["output.probes=null"] if "probes:" in scene.read_text() else [])]
        folder = self.folder / f"extruded_{next(self.numbers)}"
        folder.mkdir()
        # The mesh of a run as a file: of the scene in the plane, as of what is extruded.
        parameters, places, cells, regions, fractures = turn_scene.read_scene(scene, settings, SPREKK)
        if "geometry.file" in parameters:  # its groups of lines that are no sides
            groups = re.findall(r'^1 \d+ "(\w+)"$', scene.with_suffix(".msh").read_text(), re.MULTILINE)
            names = [name for name in groups if name not in ("left", "right", "bottom", "top")]
        else:
            names = turn_scene.read_fractures(scene, settings, SPREKK) if fractures else []
        source = folder / "plane.msh"
        turn_scene.write_msh(source, places, turn_scene.cells_by_region(parameters, cells, regions), sides_of(places, cells),
                             {name: fractures[number] for number, name in enumerate(names)})
        others = {key: None for key in ("box", "fractures") if any(path.startswith(f"geometry.{key}") for path in parameters)}
        changed = {"geometry": {**others, "file": str(source)}, **({"mesh": None} if any(path.startswith("mesh.") for path in parameters) else {})}
        flat = [scene, self.write(json.dumps(changed) + "\n", f"{folder.name}/plane.yaml")]
        settings = [setting for setting in settings if not setting.startswith("mesh")]
        plane = self.run_scene(flat, *settings)
        sizes = plane.fields().sizes
        depth = LAYERS * float(np.sqrt(np.median(sizes)))
        extrude_mesh(source, folder / "extruded.msh", depth)
        given = json.loads((plane.folder / "run.json").read_text())["scene"]["parameters"]
        parameters = {path: entry["value"] for path, entry in given.items() if entry["origin"] != "default"}
        (folder / "extruded.yaml").write_text(json.dumps(extrude(parameters, folder / "extruded.msh", depth), indent=1) + "\n")
        return plane, self.run_scene([*flat, folder / "extruded.yaml"], *settings, processes=processes), depth

    def places_in_plane(self, seen, wanted, what):
        """For each place in space that of the plane it has come from."""
        direction = np.array([0.8191520442889918, 0.573576436351046])  # along which no two are at the same place
        order = np.argsort(wanted @ direction)
        sorted_places = (wanted @ direction)[order]
        place = np.clip(np.searchsorted(sorted_places, seen @ direction), 1, len(order) - 1)
        place -= np.abs(seen @ direction - sorted_places[place - 1]) < np.abs(seen @ direction - sorted_places[place])
        self.assertLess(np.abs(seen - wanted[order[place]]).max(), 1e-9 * np.ptp(wanted, axis=0).max(), what)
        return order[place]

    def assert_same(self, plane, space, depth, name, near=1e-9):
        for kind in ("matrix", "fractures"):
            if kind == "fractures" and not self.has_fractures(plane):
                continue
            flat, solid = plane.fields(kind=kind), space.fields(kind=kind)
            fields = [field for field in flat.names if field.endswith((".pressure", ".temperature"))]
            if not fields:
                continue  # a sealed fracture
            self.assertEqual(len(solid.sizes), LAYERS * len(flat.sizes))
            place = self.places_in_plane(solid.centres[:, [0, 2]], flat.centres[:, :2], (name, kind))
            worst = max(np.abs(solid[field] - flat[field][place]).max() / np.abs(flat[field]).max() for field in fields)
            print(f"{name}: {kind}, {len(solid.sizes)} cells: {worst:.1e}")
            self.assertLess(worst, near, (name, kind))
        for column in plane.history:
            if column.startswith("wells.") and column.endswith(".pressure[Pa]"):
                self.assertLess(np.abs(space.history[column] / plane.history[column] - 1).max(), near, (name, column))
        columns = [column for column in plane.history if ".outflow[" in column]
        largest = max((np.abs(plane.history[column]).max() for column in columns), default=0)
        for column in columns if name not in BALANCED else ():
            other = space.history[column.replace("m^2", "m^3")] / depth
            self.assertLess(np.abs(other - plane.history[column]).max(), near * largest, (name, column))

    def assert_same_rock(self, plane, space, name, near=1e-9):
        """Displacements of nodes, and stresses of cells."""
        flat, solid = plane.fields(), space.fields()
        place = self.places_in_plane(solid.points[:, [0, 2]], flat.points[:, :2], name)
        found, wanted = solid["rock.displacement"], flat["rock.displacement"][place]
        of_u = max(np.abs(found[:, [0, 2]] - wanted).max(), np.abs(found[:, 1]).max()) / np.abs(wanted).max()
        wanted = flat["rock.stress"][self.places_in_plane(solid.centres[:, [0, 2]], flat.centres[:, :2], name)]
        of_stress = np.abs(solid["rock.stress"][:, [0, 2, 5]] - wanted).max() / np.abs(wanted).max()
        print(f"{name}: rock, displacement {of_u:.1e}, stress {of_stress:.1e}")
        self.assertLess(max(of_u, of_stress), near, name)

    def assert_same_walls(self, plane, space, name, near):
        """Jumps and tractions of fracture cells, in the largest."""
        flat, solid = plane.fractures(), space.fractures()
        place = self.places_in_plane(solid.centres[:, [0, 2]], flat.centres[:, :2], name)
        for what in ("jump", "traction"):
            size = max(np.abs(flat[f"contact.{what}.{part}"]).max() for part in ("normal", "tangential"))
            found = [solid[f"contact.{what}.normal"], np.hypot(*(solid[f"contact.{what}.tangential{k}"] for k in "12"))]
            wanted = [flat[f"contact.{what}.normal"][place], np.abs(flat[f"contact.{what}.tangential"][place])]
            worst = max(np.abs(one - other).max() for one, other in zip(found, wanted)) / size
            print(f"{name}: {what}, {len(place)} cells: {worst:.1e}")
            self.assertLess(worst, near, (name, what))

    @staticmethod
    def has_fractures(results):
        return next(results.folder.glob("fractures_*.vtu"), None) is not None

    def test_each_has_the_answer_of_the_plane(self):
        for name in EXTRUDED:
            with self.subTest(name):
                plane, space, depth = self.in_plane_and_space(name)
                self.assert_same(plane, space, depth, name)

    def test_so_it_has_by_finite_elements(self):
        for name in ("verification/fracture_barrier.yaml", "verification/fracture_inflow.yaml"):
            with self.subTest(name):
                plane, space, depth = self.in_plane_and_space(name, "components.pore.type=matrix_flow/rt0")
                self.assert_same(plane, space, depth, name + " by rt0")

    def test_every_scene_of_rock_without_fractures_is_extruded_or_left_out_with_its_reason(self):
        texts = {f"{folder}/{scene.name}": scene.read_text() for folder in ("verification", "tutorial", "swaps") for scene in (SCENES / folder).glob("*.yaml")}
        rock = {name for name, text in texts.items()
                if ("poromechanics/" in text or "mandel.yaml" in text) and not any(word in text for word in ("contact", "_heat/")) and " z: [" not in text}
        self.assertEqual(rock, set(ROCK) | set(ROCK_LEFT_OUT))

    def test_rock_with_fluid_has_the_answer_of_the_plane(self):
        for name in ROCK:
            with self.subTest(name):
                plane, space, depth = self.in_plane_and_space(name, *FINITE_ELEMENTS)
                near = 1e-9 if "terzaghi" in name else 1e-5
                self.assert_same(plane, space, depth, name, near)
                self.assert_same_rock(plane, space, name, near)

    def test_walls_in_contact_have_nearly_the_answer_of_the_plane(self):
        for name in CONTACT:
            with self.subTest(name):
                plane, space, _ = self.in_plane_and_space(name, *FINITE_ELEMENTS)
                self.assert_same_walls(plane, space, name, 0.01)

    @on_two_processes
    def test_so_it_has_on_two_processes(self):
        plane, space, depth = self.in_plane_and_space("verification/fracture_inflow.yaml", processes=2)
        self.assert_same(plane, space, depth, "two processes")


if __name__ == "__main__":
    unittest.main()
