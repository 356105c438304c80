#!/usr/bin/python3
"""flow_in_regions_test.py SPREKK [MPIEXEC]: a flow that lives in some regions of the rock only.

- Patch: in a slanted layer a linear pressure along it is exact, and nothing leaves the layer.
- Consolidation: a column whose one half is dry and elastic settles by that of Terzaghi's column, drained at one end and sealed where
  the dry rock begins, and by that of the dry half, also turned and on two processes.
- The same scene with Biot's coefficient zero and hardly any permeability in the other rock gives the same answer, also with fractures
  that cross the border, mirrored, perturbed, and with a fluid whose density varies.
"""

import math
import unittest

from scene_runs import ROOT, SceneRuns, on_two_processes, sprekk

CONVECTION = ROOT / "configs/tutorial/geothermal_convection.yaml"

PATCH = """
name: patch
geometry:
  box: {{x: [0 m, 2 m], y: [0 m, 1 m]}}
  regions: {{layer: {{polygon: [[0, 0.2], [2, 0.7], [2, 0.9], [0, 0.4]]}}}}
mesh: {{size: {size} m}}
components:
  pore:
    type: matrix_flow/{flow}
    regions: layer
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary:
      left: {{pressure: (x + y/4) Pa}}
      right: {{pressure: (x + y/4) Pa}}
schedule: [{{solve: pore}}]
time: {{end: 1 s, step: 1 s}}
output:
  fields: false
  lines:
    middle: {{of: pore.pressure, from: [0.1 m, 0.325 m], to: [1.9 m, 0.775 m], points: 10}}
    outside: {{of: pore.pressure, from: [0.1 m, 0.1 m], to: [1.9 m, 0.1 m], points: 3}}
"""

# lambda = G = 2/3 Pa, M_v = 2 Pa, S + alpha^2/M_v = 1/Pa, c = 1 m^2/s: the pressure of the load is 1 Pa.
COLUMN = """
name: column
geometry:
  box: {{x: [0 m, {width} m], y: [0 m, {height} m]}}
  regions: {{wet: {{polygon: {polygon}}}}}
mesh: {{kind: structured, cells: {cells}, shape: quadrilaterals}}
components:
  pore:
    type: matrix_flow/{flow}
    regions: [wet]
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0.5 1/Pa
    boundary: {{{end}: {{pressure: 0 Pa}}}}
  rock:
    type: poromechanics/mpsa
    young_modulus: 1.6666666666666667 Pa
    poisson_ratio: 0.25
    boundary: {{{rollers}, {end}: {{normal_stress: -2 Pa}}}}
couplers: [{{type: biot, between: [pore, rock], biot_coefficient: 1}}]
schedule: [{{solve: [pore, rock]}}]
time: {{end: 0.1 s, step: 0.01 s}}
output:
  fields: false
  probes:
    p: {{of: pore.pressure, at: {inside}}}
    u: {{of: rock.displacement, at: {tip}}}
"""
UP = {"width": 0.2, "height": 2, "polygon": "[[0, 1], [0.2, 1], [0.2, 2], [0, 2]]", "end": "top", "inside": "[0.1 m, 1.5 m]",
      "tip": "[0.1 m, 2 m]", "rollers": "left: {displacement_x: 0 m}, right: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}"}
LEFT = {"width": 2, "height": 0.2, "polygon": "[[0, 0], [1, 0], [1, 0.2], [0, 0.2]]", "end": "left", "inside": "[0.5 m, 0.1 m]",
        "tip": "[0 m, 0.1 m]", "rollers": "bottom: {displacement_y: 0 m}, top: {displacement_y: 0 m}, right: {displacement_x: 0 m}"}

CRACKED = """
name: cracked
geometry:
  box: {{x: [0 m, 2 m], y: [0 m, 1 m]}}
  regions: {{layer: {{polygon: [[0, 0.2], [2, 0.4], [2, 0.9], [0, 0.7]]}}}}
  fractures:
    across: {{points: [[0.7 m, 0.1 m], [1.1 m, 0.5 m]]}}
    inside: {{points: [[1.3 m, 0.5 m], [1.6 m, 0.7 m]]}}
mesh: {{size: 0.1 m, fracture_size: 0.05 m}}
materials: {{young_modulus: 40 GPa, poisson_ratio: 0.2, viscosity: 1 mPa*s, friction: 0.6, dilation_angle: 1 deg, fluid_compressibility: 4e-10 1/Pa}}
components:
  pore:
    type: matrix_flow/{flow}
    {permeability}
    storage: 1e-10 1/Pa
    initial_pressure: 1 MPa
    boundary: {{left: {{pressure: 1 MPa}}}}
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: -32 MPa}}
      top: {{normal_stress: -8 MPa}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    initial_pressure: 1 MPa
    injection: {{well: {{fracture: across, rate: 5e-8 m^2/s}}}}
  contact: {{type: contact/coulomb}}
couplers:
  - {{type: biot, between: [pore, rock], biot_coefficient: {alpha}}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [pore, rock, conduit, contact]}}]
time: {{end: 1 h, step: 15 min}}
output:
  fields: false
  probes:
    well: {{of: conduit.pressure, fracture: across, take: largest}}
    other: {{of: conduit.pressure, fracture: inside, take: mean}}
    slip: {{of: contact.jump, fracture: across, take: mean}}
    p: {{of: pore.pressure, at: [1.2 m, 0.5 m]}}
    u: {{of: rock.displacement, at: [1.7 m, 0.9 m]}}
"""


class FlowInRegions(SceneRuns):
    def tables(self, text, *settings, processes=1):
        folder = self.run_scene(self.write(text), *settings, processes=processes).folder
        return {file.stem: sprekk.read_table(file) for file in folder.glob("*.csv")}

    def test_a_linear_pressure_along_a_slanted_layer_is_exact(self):
        for flow in ("mpfa", "ntpfa", "rt0"):
            for size in (0.1, 0.03):
                tables = self.tables(PATCH.format(flow=flow, size=size))
                line = tables["line_middle"]
                rows = [i for i, time in enumerate(line["time[s]"]) if time == 1]
                self.assertEqual(len(rows), 10)
                for i in rows:
                    self.assertAlmostEqual(line["pore.pressure[Pa]"][i], line["x[m]"][i] + line["y[m]"][i] / 4, delta=1e-10)
                self.assertTrue(all(math.isnan(p) for p in tables["line_outside"]["pore.pressure[Pa]"]))
                history = tables["history"]
                self.assertAlmostEqual(history["pore.left.outflow[m^2/s]"][-1], 0.2, delta=1e-10)
                self.assertAlmostEqual(history["pore.right.outflow[m^2/s]"][-1], -0.2, delta=1e-10)

    def column_error(self, column, layers, processes=1, dry=1, flow="mpfa"):
        """`layers`: half of those of the column, of which the dry part is `dry` m long."""
        cells = f"[{2 * layers}, 2]" if column is LEFT else f"[2, {2 * layers}]"
        history = self.tables(COLUMN.format(cells=cells, flow=flow, **column), processes=processes)["history"]
        axis, sign = ("x", 1) if column is LEFT else ("y", -1)
        worst = 0
        for step, (p, u) in enumerate(zip(history["p[Pa]"], history[f"u.{axis}[m]"]), start=1):
            pressure = mean = 0
            for k in range(3000):
                n = (k + 0.5) * math.pi
                decay = (1 + 0.01 * n * n) ** -step
                pressure += 2 / n * math.sin(n * 0.5) * decay
                mean += 2 / n**2 * decay
            worst = max(worst, abs(p - pressure), abs(sign * u - (dry + 1 - mean / 2)))
        self.assertLess(max(abs(error) for error in history["fluid_balance_error[m^2]"]), 1e-13)
        return worst

    @on_two_processes
    def test_a_column_that_is_half_dry_settles_as_in_the_closed_form(self):
        coarse, fine = self.column_error(UP, 40), self.column_error(UP, 80)
        print(f"errors with 40 and 80 layers: {coarse:.2e}, {fine:.2e}, order {math.log2(coarse / fine):.2f}")
        # A fraction of (cell size / length of the boundary layer of one step)^2, as in docs/write_a_component.md.
        self.assertLess(coarse, 1 / (8 * 40**2 * 0.01))
        self.assertLess(fine, 1 / (8 * 80**2 * 0.01))
        self.assertGreater(math.log2(coarse / fine), 1.8)
        # The wet half alone has the same error.
        alone = {**UP, "height": 1, "polygon": "[[0, 0], [0.2, 0], [0.2, 1], [0, 1]]", "inside": "[0.1 m, 0.5 m]", "tip": "[0.1 m, 1 m]"}
        self.assertAlmostEqual(self.column_error(alone, 20, dry=0), coarse, delta=1e-10)
        self.assertAlmostEqual(self.column_error(LEFT, 40), coarse, delta=1e-10)
        self.assertAlmostEqual(self.column_error(UP, 40, processes=2), coarse, delta=1e-10)
        # Mixed finite elements have their own error, in the half alone as well.
        mixed = self.column_error(UP, 40, flow="rt0")
        self.assertLess(mixed, 1 / (8 * 40**2 * 0.01))
        self.assertAlmostEqual(self.column_error(alone, 20, dry=0, flow="rt0"), mixed, delta=1e-10)
        self.assertAlmostEqual(self.column_error(LEFT, 40, flow="rt0"), mixed, delta=1e-10)

    def histories_of_cracked(self, flow, processes=1, settings=()):
        alpha = "{regions: {layer: 0.8, default: 0}}"
        in_layer = self.tables(CRACKED.format(flow=flow, alpha="0.8", permeability="permeability: 1e-16 m^2\n    regions: [layer]"), *settings,
                               processes=processes)
        tight = self.tables(CRACKED.format(
            flow=flow, alpha=alpha, permeability="permeability: {regions: {layer: 1e-16 m^2, default: 1e-28 m^2}}"), *settings)
        return in_layer["history"], tight["history"]

    @on_two_processes
    def test_it_is_the_flow_in_rock_without_permeability_and_biot_coefficient(self):
        # The corrections of rt0 at tips are fitted to cells with a flow: on the coarse mesh those next to the border differ by 6e-6.
        fine = ("mesh.size=0.05 m", "mesh.fracture_size=0.025 m")
        for flow, processes, settings in (("mpfa", 1, ()), ("tpfa", 1, ()), ("mpfa", 2, ()), ("rt0", 1, fine), ("rt0", 2, fine),
                                          ("rt0", 1, ("components.pore.flux_mass=lumped",))):
            one, two = self.histories_of_cracked(flow, processes, settings)
            self.assertEqual(len(one["time[s]"]), len(two["time[s]"]))
            self.assertGreater(abs(one["slip.t[m]"][-1]), 1e-5)
            worst = 0
            for column in ("well[Pa]", "other[Pa]", "slip.n[m]", "slip.t[m]", "p[Pa]", "u.x[m]", "u.y[m]"):
                scale = max(abs(value) for value in two[column])
                worst = max(worst, *(abs(a - b) / scale for a, b in zip(one[column], two[column])))
            print(f"{flow}, {processes} processes: largest difference {worst:.1e}")
            self.assertLess(worst, 1e-8)
            self.assertLess(max(abs(error) for error in one["fluid_balance_error[m^2]"]), 1e-9 * max(one["fluid_injected[m^2]"]))

    def test_mirrored_and_perturbed(self):
        layer, columns = "permeability: 1e-16 m^2\n    regions: [layer]", ("well[Pa]", "other[Pa]", "slip.n[m]", "slip.t[m]", "p[Pa]")
        scene = self.write(CRACKED.format(flow="mpfa", alpha="0.8", permeability=layer))
        one = self.run_scene(scene)
        disturbed = self.largest_difference(self.run_scene(scene, f"components.conduit.injection.well.rate={5e-8 * (1 + 1e-9)!r} m^2/s"), one, columns)
        self.assertLess(disturbed, 1e-7)
        self.assertGreater(disturbed, 0)
        # The mirror image by its own mesh and the flow by another way: in all rock, without permeability and Biot coefficient outside.
        mirrored = CRACKED
        for of, to in (("[0, 0.2], [2, 0.4], [2, 0.9], [0, 0.7]", "[0, 0.8], [2, 0.6], [2, 0.1], [0, 0.3]"),
                       ("[0.7 m, 0.1 m], [1.1 m, 0.5 m]", "[0.7 m, 0.9 m], [1.1 m, 0.5 m]"), ("[1.3 m, 0.5 m], [1.6 m, 0.7 m]", "[1.3 m, 0.5 m], [1.6 m, 0.3 m]"),
                       ("bottom: {{displacement_y", "top: {{displacement_y"), ("top: {{normal_stress", "bottom: {{normal_stress"),
                       ("[1.7 m, 0.9 m]", "[1.7 m, 0.1 m]")):
            self.assertIn(of, mirrored)
            mirrored = mirrored.replace(of, to)
        image = self.run_scene(self.write(mirrored.format(flow="mpfa", alpha="0.8", permeability=layer)))
        tight = self.run_scene(self.write(mirrored.format(flow="mpfa", alpha="{regions: {layer: 0.8, default: 0}}",
                                                          permeability="permeability: {regions: {layer: 1e-16 m^2, default: 1e-28 m^2}}")))
        self.assertLess(self.largest_difference(image, tight, columns), 1e-8)
        of_meshes = max(abs(abs(image.history[column][-1] / one.history[column][-1]) - 1) for column in columns)
        print(f"mirrored (on another mesh) {of_meshes:.1e}, times 1 + 1e-9 {disturbed:.1e}")
        self.assertLess(of_meshes, 0.03)

    def test_fluid_whose_density_varies(self):
        # Convection in a slanted layer, with a fault that crosses its border. In steps of 200000 days Newton's method takes up to 29 iterations or
        # cuts the step, which round-off decides, and then both differ by the error of the step, 2 %. In these it takes at most 7.
        common = ("geometry.regions={layer: {polygon: [[0, -1000], [2000, -1000], [2000, -250], [0, -350]]}}",
                  "materials.permeability=5e-14 m^2", "time.end=800000 day", "time.step=50000 day",
                  "output={fields: false, probes: {T: {of: heat.temperature, at: [1000 m, -500 m]}, "
                  "p: {of: pore.pressure, at: [1000 m, -500 m]}, f: {of: conduit.pressure, fracture: east, take: mean}}}")
        scene = CONVECTION.read_text(encoding="utf-8").replace("    boundary: {top: {pressure: 5 MPa}}\n", "")  # outside of the layer
        inside, tight = [self.tables(scene, *common, setting)["history"]
                         for setting in ("components.pore.regions=[layer]",
                                         "components.pore.permeability={regions: {layer: 5e-14 m^2, default: 1e-30 m^2}}")]
        self.assertGreater(abs(tight["T[K]"][-1] - (293.15 + 0.12 * 500)), 5)  # K, away from conduction
        for column in ("T[K]", "p[Pa]", "f[Pa]"):
            self.assertLess(abs(inside[column][-1] / tight[column][-1] - 1), 1e-9, column)

    def test_two_flows_beside_each_other(self):
        # One by multi-point, one by two-point fluxes: each is the flow alone, and a note says that nothing passes the border.
        first = PATCH.format(flow="mpfa", size=0.1)
        other = first.replace("  pore:", "  beside:").replace("regions: layer", "regions: rock").replace("matrix_flow/mpfa", "matrix_flow/ntpfa")
        component = other[other.index("  beside:"):other.index("schedule")]
        both = first.replace("schedule: [{solve: pore}]", component + "schedule: [{solve: [pore, beside]}]")
        both, alone, beside = (self.run_scene(self.write(text)) for text in (both, first, other.replace("solve: pore", "solve: beside")
                                                                            .replace("of: pore", "of: beside")))
        for run, name in ((alone, "pore"), (beside, "beside")):
            for side in ("left", "right"):
                column = f"{name}.{side}.outflow[m^2/s]"
                self.assertAlmostEqual(both.history[column][-1], run.history[column][-1], delta=1e-12)
        self.assertTrue(any("no fluid passes between 'pore' and 'beside'" in str(note) for note in both.notes), both.notes)
        self.assertFalse(any("no fluid passes" in str(note) for note in alone.notes))

    def test_what_has_no_meaning_is_refused(self):
        scene = PATCH.format(flow="mpfa", size=0.1)
        for setting, words in (("components.pore.regions=[layers]", ("unknown region", "layer")),
                               ("components.pore.boundary.bottom={pressure: 1 Pa}", ("bottom", "no effect")),
                               ("components.pore.wells={w: {at: [1 m, 0.1 m], rate: 1 m^2/s}}", ("well 'w'", "without a flow")),
                               ("output.probes={a: {of: pore.pressure, at: [1 m, 0.1 m]}}", ("probe 'a'", "does not live"))):
            done = self.call("check", self.write(scene), setting)
            self.assertEqual(done.returncode, 2, setting + done.stdout + done.stderr)
            self.assertTrue(all(word in done.stderr for word in words), done.stderr)


if __name__ == "__main__":
    unittest.main()
