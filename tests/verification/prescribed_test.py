#!/usr/bin/env python3
"""prescribed_test.py SPREKK MPIEXEC: pressures and temperatures of the rock that are given, by formulas, tables and the fields of
another run. A column that cannot move sideways stretches by alpha/(lambda + 2 G) times the integral of the change of its pressure,
and by (1 + nu)/(1 - nu) alpha_T times that of its temperature: exact for what is linear along the column. Along x and y, with both kinds of rock, on two processes. What another run has computed loads the rock as in
one scene with both."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MPIEXEC = sys.argv.pop(2)
SPREKK = Path(sys.argv.pop(1)).resolve()
YOUNG, POISSON, ALPHA, EXPANSION = 5e9, 0.2, 0.8, 1e-5
STIFFNESS = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))

SCENE = """
geometry:
  box: {{x: [0 m, {width}], y: [0 m, {height}]}}
mesh: {{size: 0.1 m}}
components:
  pore: {{type: matrix_flow/prescribed, pressure: {pressure}}}
  heat: {{type: matrix_heat/prescribed, temperature: {temperature}}}
  rock:
    type: poromechanics/{rock}
    young_modulus: 5 GPa
    poisson_ratio: 0.2
    boundary:
      {side}: {{displacement_normal: 0 m}}
      {other_side}: {{displacement_normal: 0 m}}
      {held}: {{displacement_normal: 0 m}}
couplers:
  - {{type: biot, between: [pore, rock], biot_coefficient: 0.8}}
  - {{type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}}
schedule: [{{solve: rock}}]
time: {{end: 2 h, step: 1 h}}
output:
  probes:
    end: {{of: rock.displacement, at: [{end}]}}
"""

FLOW = """
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 0.4 m]}}}}
mesh: {{size: {size}}}
materials: {{biot_coefficient: 0.8, expansion: 1e-5 1/K}}
components:
{components}
couplers: {couplers}
schedule: {schedule}
time: {{start: {start}, end: 1 h, step: 6 min}}
output:
  every: 6 min
  probes:
    u: {{of: rock.displacement, take: mean}}
    p: {{of: pore.pressure, at: [0.3 m, 0.2 m]}}
"""
PORE = """
  pore: {type: matrix_flow/mpfa, permeability: 1e-16 m^2, viscosity: 1 mPa*s, storage: 1e-9 1/Pa, initial_pressure: 1 MPa,
    boundary: {left: {pressure: 0 Pa}}}
  heat: {type: matrix_heat/mpfa, conductivity: 200 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: 300 K,
    boundary: {bottom: {temperature: 310 K}}}"""
ROCK = """
  rock: {type: poromechanics/mpsa, young_modulus: 5 GPa, poisson_ratio: 0.2,
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, top: {normal_stress: 0 Pa}}}"""
COUPLERS = "[{type: biot, between: [pore, rock]%s}, {type: thermal_stress, between: [heat, rock]}]"


class Folder:
    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        return self

    def __exit__(self, *_):
        self.folder.cleanup()

    def call(self, command, text, name, processes=1):
        (self.path / f"{name}.yaml").write_text(text)
        program = [MPIEXEC, "-n", str(processes)] if processes > 1 else []
        program += [SPREKK, command, f"{name}.yaml"] + (["-q", "-o", name] if command == "run" else [])
        return subprocess.run(program, capture_output=True, text=True, timeout=100, cwd=self.path)

    def run(self, text, name="scene", processes=1):
        """The rows of its history."""
        done = self.call("run", text, name, processes)
        assert done.returncode == 0, done.stderr
        with open(self.path / name / "history.csv") as file:
            return [{key.split("[")[0]: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(file)]


def column(along_x, rock="mpsa", pressure="0 Pa", temperature="0 K"):
    sides = dict(width="1 m", height="0.3 m", held="left", side="bottom", other_side="top", end="1 m, 0.15 m") if along_x else dict(
        width="0.3 m", height="1 m", held="bottom", side="left", other_side="right", end="0.15 m, 1 m")
    return SCENE.format(rock=rock, pressure=pressure, temperature=temperature, **sides)


class Prescribed(unittest.TestCase):
    def test_columns_stretch_as_in_the_closed_form(self):
        # p = (3 + 2 s) MPa t/h and T = 300 K + 10 K s t/h at s along the column; or their means everywhere, where displacements
        # are linear, and exact.
        hourly = ALPHA / STIFFNESS * 4e6 + (1 + POISSON) / (1 - POISSON) * EXPANSION * 5
        for along_x in (False, True):
            s = "x" if along_x else "y"
            table = f"{s},t[h],p[MPa],T\n" + "".join(f"{a},{t},{(3 + 2 * a) * t},{300 + 10 * a * t}\n" for t in (0, 4) for a in (0, 2))
            even = ("(4e6*t/3600) Pa", "(300 + 5*t/3600) K")
            formulas = (f"((3e6 + 2e6*{s})*t/3600) Pa", f"(300 + 10*{s}*t/3600) K")
            tables = (f"{{table: t.csv, of: [t, {s}], column: p}}", f"{{table: t.csv, of: [{s}, t], column: T}}")

            def error(form, rock, processes=1, size="0.1 m"):
                with Folder() as folder:
                    (folder.path / "t.csv").write_text(table)
                    rows = folder.run(column(along_x, rock, *form).replace("size: 0.1 m", f"size: {size}"), processes=processes)
                return max(abs(row[f"end.{s}"] / (hours * hourly) - 1) for hours, row in zip((1, 2), rows))

            for rock in ("mpsa", "fem"):
                with self.subTest(along_x=along_x, rock=rock):
                    self.assertLess(max(error(even, rock), error(even, rock, processes=2)), 1e-9)
                    coarse = error(formulas, rock)
                    self.assertLess(coarse, 3e-3 if rock == "mpsa" else 1e-4)
                    self.assertAlmostEqual(error(tables, rock, processes=2), coarse, delta=1e-9)
                    # The load is constant in each cell: an error of the second order.
                    self.assertLess(error(formulas, rock, size="0.025 m"), 3e-3 / 10 if rock == "mpsa" else 1e-4 / 4)

    def test_another_run_loads_the_rock_as_in_one_scene(self):
        with Folder() as folder:
            both = folder.run(FLOW.format(size="0.05 m", components=PORE + ROCK, couplers=COUPLERS % ", one_way: true",
                                          schedule="[{solve: [pore, heat]}, {solve: rock}]", start="0 h"), "both")
            folder.run(FLOW.format(size="0.05 m", components=PORE, couplers="[]", schedule="[{solve: [pore, heat]}]",
                                   start="0 h").replace("    u: {of: rock.displacement, take: mean}\n", ""), "flow")
            given = """
  pore: {type: matrix_flow/prescribed, pressure: {run: flow, of: pore.pressure}}
  heat: {type: matrix_heat/prescribed, temperature: {run: flow, of: heat.temperature}}"""
            scene = FLOW.format(size="0.05 m", components=given + ROCK, couplers=COUPLERS % "", schedule="[{solve: rock}]", start="6 min")
            for name, text, processes, bound in (("same", scene, 1, 1e-9), ("two", scene, 2, 1e-9),
                                                 ("finer", scene.replace("size: 0.05 m", "size: 0.03 m"), 1, 1e-2)):
                rows = folder.run(text, name, processes)
                self.assertEqual(len(rows), len(both) - 1)
                for row, other in zip(rows, both[1:]):
                    for axis in ("u.x", "u.y"):
                        exact = other[axis] - both[0][axis]
                        self.assertAlmostEqual(row[axis], exact, delta=bound * max(abs(exact), abs(both[-1][axis])))
            # Between written times, linear: half-way steps have the mean of the states at their ends.
            halved = folder.run(scene.replace("step: 6 min", "step: 3 min"), "halved")
            for before, middle, after in zip(halved[1::2], halved[2::2], halved[3::2]):
                self.assertAlmostEqual(middle["u.x"], (before["u.x"] + after["u.x"]) / 2, delta=1e-9 * abs(after["u.x"]))

    def test_a_box_within_a_box_has_the_displacements_of_the_large_one(self):
        # Sides of the small box move as the rock of the large one did: a linear displacement is found again.
        outer = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 2 m]}}
mesh: {size: 0.3 m}
components:
  rock: {type: poromechanics/mpsa, young_modulus: 5 GPa, poisson_ratio: 0.2, boundary: {%s}}
schedule: [{solve: rock}]
time: {end: 1 s, step: 1 s}
output: {probes: {u: {of: rock.displacement, at: [0.8 m, 1.1 m]}}}
""" % ", ".join(f"{side}: {{displacement_x: (1e-4*x + 3e-5*y) m, displacement_y: (2e-5*x - 4e-5*y) m}}"
                for side in ("left", "right", "bottom", "top"))
        inner = outer.replace("[0 m, 2 m]", "[0.5 m, 1.4 m]").replace("size: 0.3 m", "size: 0.17 m")
        for axis, formula in (("x", "(1e-4*x + 3e-5*y) m"), ("y", "(2e-5*x - 4e-5*y) m")):
            inner = inner.replace(f"displacement_{axis}: {formula}",
                                  f"displacement_{axis}: {{run: outer, of: rock.displacement.{axis}, at: end}}")
        with Folder() as folder:
            folder.run(outer, "outer")
            small = folder.run(inner, "inner")[-1]
            self.assertAlmostEqual(small["u.x"], 1e-4 * 0.8 + 3e-5 * 1.1, delta=1e-12)
            self.assertAlmostEqual(small["u.y"], 2e-5 * 0.8 - 4e-5 * 1.1, delta=1e-12)

    def test_fields_on_fractures(self):
        # Fractures that conduct nothing keep a pressure that is linear in space; other cells along them have it, too.
        scene = """
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  fractures:
    first: {points: [[0.3 m, 0.2 m], [1.1 m, 0.6 m]]}
    second: {points: [[0.6 m, 0.8 m], [1.7 m, 0.3 m]]}
mesh: {size: 0.2 m, fracture_size: FINE}
components:
  conduit: {type: fracture_flow/tpfa, initial_aperture: 1 mm, viscosity: 1 mPa*s, fluid_compressibility: 1e-9 1/Pa,
    transmissivity: constant, transmissivity_value: 1e-30 m^3, initial_pressure: PRESSURE}
schedule: [{solve: conduit}]
time: {end: 1 s, step: 1 s}
output: {probes: {p: {of: conduit.pressure, at: [0.7 m, 0.4 m]}, q: {of: conduit.pressure, at: [1.15 m, 0.55 m]}}}
"""
        with Folder() as folder:
            exact = folder.run(scene.replace("FINE", "50 mm").replace("PRESSURE", "(1e6*x + 3e5*y) Pa"), "one")[-1]
            read = scene.replace("FINE", "30 mm").replace("PRESSURE", "{run: one, of: conduit.pressure, at: end}")
            same = scene.replace("FINE", "30 mm").replace("PRESSURE", "(1e6*x + 3e5*y) Pa")
            again, other = folder.run(read, "again", processes=2)[-1], folder.run(same, "other")[-1]
            for key in ("p", "q"):
                self.assertAlmostEqual(again[key], other[key], delta=1e-3)
                self.assertAlmostEqual(again[key], exact[key], delta=3e4)
            moved = folder.call("check", read.replace("[0.3 m, 0.2 m]", "[0.3 m, 0.3 m]"), "moved")
            self.assertEqual(moved.returncode, 2)
            self.assertIn("not on fracture 1 of the run one", moved.stderr)
            fewer = folder.call("check", read.replace("  fractures:", "  fractures:\n    zero: {points: [[0.2 m, 0.8 m], [0.3 m, 0.9 m]]}"),
                                "fewer")
            self.assertEqual(fewer.returncode, 2)
            rock = folder.call("check", column(True, pressure="{run: one, of: conduit.pressure, at: end}"), "rock")
            self.assertEqual(rock.returncode, 2)
            self.assertIn("is a field on fractures, and is needed elsewhere", rock.stderr)

    def test_what_is_refused(self):
        with Folder() as folder:
            folder.run(FLOW.format(size="0.2 m", components=PORE, couplers="[]", schedule="[{solve: [pore, heat]}]",
                                   start="0 h").replace("    u: {of: rock.displacement, take: mean}\n", ""), "flow")
            folder.run(FLOW.format(size="0.2 m", components=PORE, couplers="[]", schedule="[{solve: [pore, heat]}]", start="0 h")
                       .replace("    u: {of: rock.displacement, take: mean}\n", "").replace("  every: 6 min\n", ""), "last")

            def messages(datum, scene=column(True), unit="pressure"):
                done = folder.call("check", scene.replace(f"{unit}: 0 {'Pa' if unit == 'pressure' else 'K'}", f"{unit}: {datum}"), "scene")
                self.assertEqual(done.returncode, 2, done.stdout)
                return done.stderr

            self.assertIn("there is no such folder", messages("{run: nowhere, of: pore.pressure}"))
            self.assertIn("did you mean 'pore.pressure'", messages("{run: flow, of: pore.presure}"))
            self.assertIn("has the dimension of temperature", messages("{run: flow, of: heat.temperature}"))
            self.assertIn("'of'", messages("{run: flow}"))
            self.assertIn("at one time only", messages("{run: last, of: pore.pressure}"))
            self.assertIn("has no value at t = ", messages("{run: flow, of: pore.pressure}"))
            self.assertIn("the run has no pore.pressure at 7200 s", messages("{run: flow, of: pore.pressure, at: 2 h}"))
            self.assertIn("outside of the mesh of the run", messages("{run: flow, of: pore.pressure, at: end}", column(False)))
            self.assertIn("unknown key", messages("{run: flow, of: pore.pressure, att: end}"))
            viscous = column(True, temperature="300 K").replace("couplers:", "couplers:\n  - {type: thermal_viscosity, between: [heat, pore], law: water}")
            done = folder.call("check", viscous, "viscous")
            self.assertEqual(done.returncode, 2)
            self.assertIn("has no viscosity", done.stderr)


if __name__ == "__main__":
    unittest.main()
