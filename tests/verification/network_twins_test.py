#!/usr/bin/python3
"""network_twins_test.py SPREKK MPIEXEC [--full]: stimulation of a network of fractures from a table, and its twins.

The scene is configs/tutorial/network_stimulation.yaml on a smaller table that the same generator draws (--full: as it is). Its twins are turned
by 90 degrees, mirrored, injected with a rate of 1 + 1e-9, and on two processes. Turned and mirrored meshes are those of the scene,
node by node. Pressures, slip and states are the same; no step fails, and one pattern has one ordering, which run.json tells."""

import importlib.machinery
import importlib.util
import json
import sys
import unittest

import numpy as np

FULL = "--full" in sys.argv
if FULL:
    sys.argv.remove("--full")
sys.dont_write_bytecode = True
from scene_runs import ROOT, SPREKK, SceneRuns, on_two_processes, sprekk  # noqa: E402  pylint: disable=wrong-import-position

loader = importlib.machinery.SourceFileLoader("turn_scene", str(ROOT / "tools/turn_scene"))
turn_scene = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
loader.exec_module(turn_scene)

SCENE = ROOT / "configs/tutorial/network_stimulation.yaml"
DRAWN = """
geometry:
  box: {x: [0 m, 100 m], y: [0 m, 100 m]}
  fractures:
    joints: {random: {number: 6, length: &law {law: power, exponent: 2.2, from: 14 m, to: 60 m}, orientation: {mean: 35 deg, concentration: 30}, seed: 3}}
    cross: {random: {number: 6, length: *law, orientation: {mean: 120 deg, concentration: 30}, seed: 4}}
"""
SMALL = ["mesh.size=15 m", "mesh.fracture_size=4 m"]
WELL = "joints_14" if FULL else "joints_1"
RATE = 4e-5 if FULL else 5e-6
COMMON = ["output.every=20 h", f"output.probes.well_pressure={{of: conduit.pressure, fracture: {WELL}, take: largest}}"]
MATRICES = {"turned": np.array([[0.0, -1.0], [1.0, 0.0]]), "mirrored": np.array([[-1.0, 0.0], [0.0, 1.0]])}
# What the rock's sides are in the twins.
SIDES = {"turned": {"bottom": "{displacement_y: 0 m}", "right": "{displacement_x: 0 m}", "top": "{normal_stress: -75 MPa}",
                    "left": "{normal_stress: -50 MPa}"},
         "mirrored": {"right": "{displacement_x: 0 m}", "bottom": "{displacement_y: 0 m}", "left": "{normal_stress: -75 MPa}",
                      "top": "{normal_stress: -50 MPa}"}}
STRESSES = {"turned": "{xx: -50 MPa, yy: -75 MPa, xy: 0 MPa}", "mirrored": "{xx: -75 MPa, yy: -50 MPa, xy: 0 MPa}"}


class NetworkTwins(SceneRuns):
    timeout = 7200 if FULL else 200

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.settings = [*COMMON, *cls.table_of(), cls.well(RATE)]
        cls.base = cls.injected(RATE)
        cls.fields = cls.fields_of(cls.base)

    @classmethod
    def table_of(cls):
        """Settings that replace the table of the scene; writes it."""
        cls.rows = (ROOT / "configs/tutorial/network_stimulation.csv").read_text().splitlines()
        if FULL:
            return []
        drawn = cls.call("fractures", [SCENE, cls.write(DRAWN, "drawn.yaml")], "geometry.fractures.table=null",
                         "components.conduit={initial_aperture: 0.3 mm, injection: null}", "output.probes=null")
        if drawn.returncode:
            raise AssertionError(drawn.stderr)
        lines = [line for line in drawn.stdout.splitlines() if line and not line.startswith("#")]
        cls.rows = [lines[0] + ",aperture[mm]"] + [f"{line},{0.25 + 0.01 * (k % 7):.2f}" for k, line in enumerate(lines[1:])]
        cls.write("\n".join(cls.rows) + "\n", "drawn.csv")
        box = "{x: [0 m, 100 m], y: [0 m, 100 m]}"
        return [f"geometry.box={box}", f"geometry.fractures={{table: {cls.folder}/drawn.csv}}", *SMALL]

    @staticmethod
    def well(rate):
        return f"components.conduit.injection={{well: {{fracture: {WELL}, rate: {rate!r} m^2/s}}}}"

    @classmethod
    def injected(cls, rate, *settings, processes=1, scenes=SCENE):
        return cls.run_scene(scenes, *(cls.settings if scenes is SCENE else COMMON), cls.well(rate), *settings, processes=processes)

    @staticmethod
    def fields_of(results, matrix=np.eye(2), middle=np.zeros(2)):
        """Pressure and slip in the cells of fractures, in the order of the places before they were moved."""
        last = sprekk.read_vtu(sorted(results.folder.glob("fractures_*.vtu"))[-1])
        places = np.array([last.points[cell, :2].mean(0) for cell in last.cells])
        places = (places - middle) @ matrix + middle  # the inverse of a motion is its transpose
        order = np.lexsort(np.round(places, 6).T)
        return {name: np.abs(last.cell_data[name])[order] for name in ("conduit.pressure[Pa]", "contact.jump.tangential[m]")}

    def assert_same(self, other, fields, delta):
        worst = {}
        for column in ("well_pressure[Pa]", "contact.cells_slip[1]", "contact.cells_stick[1]", "contact.cells_open[1]", "fluid_stored[m^2]"):
            ours, values = self.base.history[column], other.history[column]
            worst[column] = np.max(np.abs(values - ours)) / max(np.max(np.abs(ours)), 1e-300)
        for name, values in self.fields.items():
            worst[name] = np.max(np.abs(fields[name] - values)) / np.max(np.abs(values))
        print(self.id().rpartition(".")[2], {name: f"{value:.1e}" for name, value in worst.items()}, flush=True)
        for name, value in worst.items():
            self.assertLessEqual(value, delta, name)

    def moved(self, name):
        """The files of the scene after a motion, on its own mesh."""
        _, places, cells, _, lines = turn_scene.read_scene(SCENE, self.settings, SPREKK)
        middle = 0.5 * (places.min(0) + places.max(0))
        matrix = MATRICES[name]
        header, *rows = [row.split(",") for row in self.rows]
        ends = {row[0]: [float(row[header.index(key)]) for key in ("x1[m]", "y1[m]", "x2[m]", "y2[m]")] for row in rows}
        apertures = {row[0]: row[header.index("aperture[mm]")] for row in rows}
        named = {}
        for edges in lines.values():
            points = [point for edge in edges for point in edge]
            centre = places[[point for point in points if points.count(point) == 1]].mean(0)
            distance = {key: np.hypot(*(0.5 * (np.array(at[:2]) + at[2:]) - centre)) for key, at in ends.items()}
            named[min(distance, key=distance.get)] = edges
        self.assertEqual(len(named), len(ends))
        if np.linalg.det(matrix) < 0:
            cells = [cell[::-1] for cell in cells]
        places = (places - middle) @ matrix.T + middle
        turn_scene.write_msh(self.folder / f"{name}.msh", places, {"rock": cells}, turn_scene.sides_of_box(places, cells), named)
        aperture = {"column": None, "fractures": {key: f"{value} mm" for key, value in apertures.items()}}
        change = {"geometry": {"box": None, "fractures": None, "file": str(self.folder / f"{name}.msh")}, "mesh": None,
                  "components": {"conduit": {"initial_aperture": aperture}}}
        file = self.write(json.dumps(change), f"{name}.yaml")
        rock = [f"components.rock.boundary.{side}={condition}" for side, condition in SIDES[name].items()]
        nothing = [f"components.rock.boundary.{side}=null" for side in SIDES[name]]
        return [SCENE, file], [*nothing, *rock, f"components.rock.initial_stress={STRESSES[name]}"], matrix, middle

    def test_no_step_fails_and_a_pattern_has_one_ordering(self):
        counters = self.base.record["counters"]
        self.assertEqual(counters["steps accepted"], 20)
        self.assertEqual(counters["steps rejected"], 0)
        self.assertEqual(counters["assembly: patterns"], 1)
        self.assertEqual(counters["linear: orderings"], counters["assembly: patterns"])
        self.assertGreater(max(self.base.history["contact.cells_slip[1]"]), 0)

    def test_sums_that_come_and_go_need_no_other_ordering(self):
        """With four times the rate the rows of balances that are summed change as apertures do."""
        counters = self.injected(4 * RATE).record["counters"]
        print(counters["linear: orderings"], "orderings,", counters["linear: factorizations"], "factorizations", flush=True)
        self.assertEqual(counters["linear: orderings"], 1)
        self.assertEqual(counters["steps rejected"], 0)

    def test_turned_and_mirrored(self):
        for name in MATRICES:
            with self.subTest(name):
                scenes, settings, matrix, middle = self.moved(name)
                other = self.injected(RATE, *settings, scenes=scenes)
                self.assert_same(other, self.fields_of(other, matrix, middle), 1e-7)

    def test_rate_that_differs_in_the_ninth_digit(self):
        other = self.injected(RATE * (1 + 1e-9))
        self.assert_same(other, self.fields_of(other), 1e-7)

    @on_two_processes
    def test_two_processes(self):
        other = self.injected(RATE, processes=2)
        self.assert_same(other, self.fields_of(other), 1e-7)


if __name__ == "__main__":
    unittest.main()
