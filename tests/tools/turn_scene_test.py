#!/usr/bin/python3
"""turn_scene_test.py SPREKK: turned scenes of tools/turn_scene have the answers of the scene before anything grows."""

import importlib.machinery
import importlib.util
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1)
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

loader = importlib.machinery.SourceFileLoader("turn_scene", str(ROOT / "tools/turn_scene"))
turn_scene = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
loader.exec_module(turn_scene)

WINGS = ROOT / "configs/paper/wing_cracks.yaml"
# Slip begins within these steps; K_eq is 0.94 of the toughness at their end.
BEFORE_GROWTH = ["time.end=0.05 h", "time.step=0.01 h", "output.every=1 h"]


def run(folder, *files, settings=()):
    command = [PROGRAM, "run", "-q", *map(str, files), "-o", str(folder)]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
    return sprekk.read_table(folder / "history.csv")


def along_box(table, turn):
    """Displacements of probes in the axes of the box."""
    for name in [name for name in table if name.endswith(".x[m]")]:
        other = name.replace(".x[", ".y[")
        table[name], table[other] = turn.T @ np.array([table[name], table[other]])
    return table


def difference(one, other, name):
    return np.nanmax(np.abs(one[name] - other[name])) / np.nanmax(np.abs(one[name]))


class Turned(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def turned_run(self, name, angle, shift=(0.013, -0.009), settings=()):
        file, motion = turn_scene.turn(WINGS, self.folder / name, angle, shift, settings, PROGRAM)
        return along_box(run(self.folder / (name + "_results"), WINGS, file, settings=BEFORE_GROWTH), motion.turn)

    def test_the_same_mesh_gives_the_same_answers(self):
        straight = run(self.folder / "straight", WINGS, settings=BEFORE_GROWTH)
        self.assertEqual(len(straight["time[s]"]), 5)
        self.assertGreater(abs(straight["slip.t[m]"][-1]), 1e-6)
        for angle in (30, 77, -90):
            turned = self.turned_run(f"by{angle}", angle)
            for name in ("fracture_pressure[Pa]", "p_C[Pa]", "slip.n[m]", "slip.t[m]", "traction.n[Pa]", "traction.t[Pa]",
                         "u_D.x[m]", "u_D.y[m]", "fluid_stored[m^2]", "contact.cells_slip[1]"):
                found = difference(straight, turned, name)
                print(f"{angle} degrees, {name}: {found:.1e}")
                self.assertLess(found, 1e-8, name)
            # The meshes of the fine level are made in the new place.
            for tip in ("main_first", "main_last"):
                for mode in ("K_eq", "K_II", "K_I"):
                    name = f"tips.{tip}.{mode}[Pa*m^0.5]"
                    found = np.nanmax(np.abs(straight[name] - turned[name])) / np.nanmax(straight[f"tips.{tip}.K_eq[Pa*m^0.5]"])
                    print(f"{angle} degrees, {name}: {found:.1e} of K_eq")
                    self.assertLess(found, 2e-3, name)

    def test_conditions_in_the_frame_of_each_side(self):
        motion = turn_scene.Motion(30, (0, 0), (0, 0))
        self.assertEqual(turn_scene.along_side("left", {"displacement": ["1 mm", "-2 mm"]}, motion),
                         {"displacement": None, "displacement_normal": "-1.0 mm", "displacement_tangential": "2.0 mm"})
        self.assertEqual(turn_scene.along_side("top", {"displacement_x": "1 mm", "traction_y": "-3 MPa"}, motion),
                         {"displacement_x": None, "displacement_tangential": "-1.0 mm", "traction_y": None,
                          "normal_stress": "-3 MPa"})
        self.assertEqual(turn_scene.along_side("bottom", {"traction": ["1 Pa", "2 Pa"]}, motion),
                         {"traction": None, "shear_stress": "1 Pa", "normal_stress": "-2.0 Pa"})
        self.assertEqual(turn_scene.along_side("right", {"normal_stress": "-1 Pa"}, motion), {})
        self.assertEqual(turn_scene.along_side("bottom", {"traction": ["1 Pa", "2 Pa"]}, turn_scene.Motion(30, (0, 0), (0, 0), mirror=True)),
                         {"traction": None, "shear_stress": "-1.0 Pa", "normal_stress": "-2.0 Pa"})

    def test_stress_turns_with_the_box(self):
        scene = self.folder / "scene.yaml"
        scene.write_text("""
geometry: {box: {x: [0 m, 1 m], y: [0 m, 2 m]}}
mesh: {kind: structured, cells: [3, 4]}
components:
  rock: {type: poromechanics/mpsa, young_modulus: 10 GPa, poisson_ratio: 0.25, initial_stress: {xx: -3 MPa, yy: -1 MPa, xy: 1 MPa},
         body_force: [2e6 N/m^3, 0 N/m^3], boundary: {left: {displacement: [0 m, 1 mm]}, right: {traction: [-3 MPa, 1 MPa]},
         top: {traction_x: 1 MPa, displacement_y: 1 mm}, bottom: {displacement_x: 2 mm, traction_y: 1 MPa}}}
schedule: [{solve: rock}]
time: {end: 1 h, step: 1 h}
output: {probes: {u: {of: rock.displacement, at: [0.9 m, 1.7 m]}}}
""", encoding="utf-8")
        straight = run(self.folder / "straight", scene)
        for angle, mirror in ((30, False), (200, False), (0, True), (75, True)):
            name = f"{angle}_{mirror}"
            file, motion = turn_scene.turn(scene, self.folder / name, angle, (1, 2), (), PROGRAM, mirror)
            turned = along_box(run(self.folder / f"{name}_results", scene, file), motion.turn)
            for name in ("u.x[m]", "u.y[m]"):
                self.assertLess(difference(straight, turned, name), 1e-10)

    def test_fractures_of_a_table_turn_with_their_columns(self):
        """Two that cross, and one whose aperture and friction make it another one; as segments and as polylines."""
        tables = {"segments": "name,x1[m],y1[m],x2[m],y2[m],aperture[mm],friction\nfirst,0.2,0.3,0.7,0.6,0.2,0.3\n"
                              "second,0.3,0.7,0.6,0.25,0.1,0.6\nthird,0.8,0.2,0.8,0.7,0.4,0.2\n",
                  "polylines": "name,x,y,aperture[mm],friction\nfirst,0.2,0.3,0.2,0.1\nfirst,0.5,0.55,0.2,0.1\nfirst,0.7,0.6,0.2,0.1\n"
                               "second,0.8,0.2,0.4,0.6\nsecond,0.8,0.7,0.4,0.6\n"}
        for kind, text in tables.items():
            (self.folder / f"{kind}.csv").write_text(text, encoding="utf-8")
            scene = self.folder / f"{kind}.yaml"
            scene.write_text(f"""
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}, fractures: {{table: {kind}.csv}}}}
mesh: {{size: 0.2 m, fracture_size: 0.1 m}}
materials: {{young_modulus: 10 GPa, poisson_ratio: 0.25, biot_coefficient: 1, permeability: 1e-15 m^2, viscosity: 1 mPa*s,
            fluid_compressibility: 4e-10 1/Pa, friction: {{column: friction}}}}
components:
  pore: {{type: matrix_flow/mpfa, storage: 1e-11 1/Pa, boundary: {{left: {{pressure: 1 MPa}}, right: {{pressure: 0 MPa}}}}}}
  rock: {{type: poromechanics/mpsa, boundary: {{left: {{displacement_x: 0 m}}, bottom: {{displacement_x: 0 m, displacement_y: 0 m}},
         right: {{normal_stress: -9 MPa}}, top: {{normal_stress: -1 MPa}}}}}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: {{column: aperture}}}}
  contact: {{type: contact/coulomb}}
couplers:
  - {{type: biot, between: [pore, rock]}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [pore, rock, conduit, contact]}}]
time: {{end: 20 s, step: 10 s}}
output: {{probes: {{u: {{of: rock.displacement, at: [0.9 m, 0.8 m]}}, p: {{of: pore.pressure, at: [0.35 m, 0.3 m]}}}}}}
""", encoding="utf-8")
            straight = run(self.folder / f"{kind}_straight", scene)
            self.assertGreater(straight["contact.cells_slip[1]"][-1], 0)
            file, motion = turn_scene.turn(scene, self.folder / f"{kind}_turned", 37, (0.3, -0.2), (), PROGRAM)
            turned = along_box(run(self.folder / f"{kind}_results", scene, file), motion.turn)
            for name in ("u.x[m]", "u.y[m]", "p[Pa]", "fluid_stored[m^2]", "contact.cells_slip[1]"):
                found = difference(straight, turned, name)
                print(f"{kind}, {name}: {found:.1e}")
                self.assertLess(found, 1e-8, name)

    def test_tensors_and_expressions_turn_with_the_box(self):
        """Flow and rock with each form of a tensor, and data that depend on the place and on time. Each form changes the answer."""
        base = """
geometry: {box: {x: [1 m, 3 m], y: [0 m, 1 m]}, regions: {left half: {polygon: [[1 m, 0 m], [2 m, 0 m], [2 m, 1 m], [1 m, 1 m]]}}}
mesh: {kind: structured, cells: [6, 4]}
materials: {gravity: [0 m/s^2, -9.81 m/s^2], viscosity: 1 mPa*s, permeability: 1e-15 m^2}
components:
  pore: {type: matrix_flow/mpfa, storage: 1e-9 1/Pa, boundary: {left: {pressure: (1e6*(1 + 0.3*y)) Pa}, right: {pressure: 0.2*MPa + 0.1*MPa/m*y}}}
  rock: {type: poromechanics/mpsa, young_modulus: (1e10*(1 + 0.1*x*y)) Pa, poisson_ratio: 0.25, rock_density: 2000 kg/m^3,
         boundary: {left: {displacement_x: (1e-4*y*(t/h)) m, displacement_y: 0 m}, right: {traction: [(-1e6*y) Pa, 1 MPa]}, top: {shear_stress: (1e5*x) Pa}}}
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0.8}]
schedule: [{solve: [pore, rock]}]
time: {end: 1 h, step: 30 min}
output: {probes: {u: {of: rock.displacement, at: [2.6 m, 0.7 m]}, p: {of: pore.pressure, at: [1.7 m, 0.4 m]}}}
"""
        forms = {"by_angle": ("pore", "permeability: {along: (1e-15*(1 + 0.2*x)) m^2, across: 1e-16 m^2, angle: 25 deg}"),
                 "by_entries": ("pore", "permeability: {xx: 2e-15 m^2, yy: (1e-15*(1 + y)) m^2, xy: -5e-16 m^2}"),
                 "by_region": ("pore", "permeability: {regions: {left half: {along: 1e-15 m^2, across: 1e-16 m^2, angle: 0.4 rad}, default: 1e-15 m^2}}"),
                 "stress": ("rock", "initial_stress: {xx: (-1e6*(1 + x)) Pa, yy: -2 MPa, xy: (2e5*y) Pa}"),
                 "force": ("rock", "body_force: [(1e6*x*y) N/m^3, 2e5 N/m^3]")}
        answers = []
        for name, (owner, line) in forms.items():
            scene = self.folder / f"{name}.yaml"
            scene.write_text(base.replace(f"  {owner}: {{", f"  {owner}: {{{line}, "), encoding="utf-8")
            straight = run(self.folder / f"{name}_straight", scene)
            answers.append((straight["p[Pa]"][-1], straight["u.x[m]"][-1]))
            for angle, mirror in ((30, False), (75, True)):
                file, motion = turn_scene.turn(scene, self.folder / f"{name}_{angle}", angle, (0.3, -0.2), (), PROGRAM, mirror)
                turned = along_box(run(self.folder / f"{name}_{angle}_results", scene, file), motion.turn)
                for column in ("u.x[m]", "u.y[m]", "p[Pa]"):
                    self.assertLess(difference(straight, turned, column), 1e-9, f"{name}, {angle}, {column}")
        self.assertEqual(len(set(answers)), len(forms))

    def test_units_of_expressions_stay_where_they_are(self):
        """Behind a group, a function or a name, or inside; x and y as numbers and as lengths. All forms are one pressure."""
        straight = {}
        for form in ("(3 + cos(pi*y)) Pa", "(3 + cos(pi*y/m)) Pa", "max(3 + cos(pi*y), 1) Pa", "3 Pa + cos(pi*y/m)*Pa", "3*Pa + cos(pi*y)*Pa",
                     "exp(log(3 + cos(pi*y))) Pa", "y Pa", "(y/m) Pa", "y*Pa"):
            scene = self.folder / f"{len(straight)}.yaml"
            scene.write_text(f"""
geometry: {{box: {{x: [0 m, 2 m], y: [0 m, 1 m]}}}}
mesh: {{kind: structured, cells: [4, 3]}}
components: {{pore: {{type: matrix_flow/mpfa, permeability: 1e-12 m^2, viscosity: 1 mPa*s, storage: 1e-9 1/Pa,
              boundary: {{left: {{pressure: "{form}"}}, right: {{pressure: 1 Pa}}}}}}}}
schedule: [{{solve: pore}}]
time: {{end: 1 s, step: 1 s}}
output: {{probes: {{p: {{of: pore.pressure, at: [0.3 m, 0.2 m]}}}}}}
""", encoding="utf-8")
            straight[form] = run(self.folder / f"{len(straight)}", scene)["p[Pa]"][-1]
            file, _ = turn_scene.turn(scene, self.folder / f"{len(straight)}_turned", 40, (0.3, -0.2), (), PROGRAM)
            turned = run(self.folder / f"{len(straight)}_results", scene, file)["p[Pa]"][-1]
            self.assertAlmostEqual(turned / straight[form], 1, delta=1e-9, msg=form)
        values = list(straight.values())
        np.testing.assert_allclose(values[:6], values[0], rtol=1e-12)
        np.testing.assert_allclose(values[6:], values[6], rtol=1e-12)
        self.assertGreater(abs(values[0] / values[6] - 1), 0.1)

    def test_stiffness_turns_with_the_box(self):
        scene = self.folder / "scene.yaml"
        scene.write_text("""
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {kind: structured, cells: [4, 3]}
components:
  rock: {type: poromechanics/mpsa, stiffness: {xxxx: 40 GPa, yyyy: 20 GPa, xyxy: 7 GPa, xxyy: 6 GPa, xxxy: 2 GPa, yyxy: -1 GPa},
         boundary: {left: {displacement: [0 m, 0 m]}, right: {traction: [2 MPa, 1 MPa]}}}
schedule: [{solve: rock}]
time: {end: 1 h, step: 1 h}
output: {probes: {u: {of: rock.displacement, at: [1.7 m, 0.6 m]}}}
""", encoding="utf-8")
        straight = run(self.folder / "straight", scene)
        for angle, mirror in ((30, False), (0, True), (110, True)):
            file, motion = turn_scene.turn(scene, self.folder / f"{angle}", angle, (0, 0), (), PROGRAM, mirror)
            turned = along_box(run(self.folder / f"{angle}_results", scene, file), motion.turn)
            for name in ("u.x[m]", "u.y[m]"):
                self.assertLess(difference(straight, turned, name), 1e-10)

    def test_pinned_points_turn_with_the_box(self):
        def turned(held, angle, mirror=False):
            return turn_scene.of_pin(held, "pinned.q", turn_scene.Motion(angle, (0, 0), (1, 1), mirror))

        self.assertEqual(turned({"x": "1 mm"}, 90), {"displacement_x": None, "displacement_y": "1.0 mm"})
        self.assertEqual(turned({"x": "1 mm"}, 0, mirror=True), {"displacement_x": "-1.0 mm"})
        self.assertEqual(turned({"y": "1 mm"}, 180), {"displacement_y": "-1.0 mm"})
        found = [float(value.split()[0]) for value in turned({"x": "1 mm", "y": "2 mm"}, 30).values()]
        radians = np.deg2rad(30)
        self.assertLess(np.abs(np.array(found) - [np.cos(radians) - 2 * np.sin(radians), np.sin(radians) + 2 * np.cos(radians)]).max(), 1e-12)
        with self.assertRaisesRegex(turn_scene.CannotTurn, "turned off the axes"):
            turned({"x": "1 mm"}, 30)

    def test_what_cannot_be_turned_is_refused(self):
        (self.folder / "survey.csv").write_text("x,p[MPa]\n0,1\n2,2\n", encoding="utf-8")
        (self.folder / "pull.csv").write_text("t[h],u[mm]\n0,0\n1,2\n", encoding="utf-8")
        table = f"{{table: {self.folder}/survey.csv, of: x}}"
        for setting, reason in ((f"components.pore.initial_pressure={table}", "its axes are those of the box"),
                                ("components.pore.initial_pressure={hydrostatic: {water_table: 9 m, fluid_density: 1000 kg/m^3}}", "its depth is along y"),
                                (f"components.rock.boundary.left.displacement_x={{table: {self.folder}/pull.csv}}", "its sign would change"),
                                ("materials.permeability={along: 1e-20 m^2, across: 2e-20 m^2, angle: 0.1*rad}", "no number")):
            with self.subTest(setting), self.assertRaisesRegex(turn_scene.CannotTurn, reason):
                turn_scene.turn(WINGS, self.folder / "new", angle=90, settings=["materials.permeability=", setting] if "permeability" in setting else [setting],
                                program=PROGRAM)
            self.assertFalse((self.folder / "new").exists())
        done = subprocess.run([ROOT / "tools/turn_scene", WINGS, self.folder / "new", "--program", PROGRAM, "--set", f"components.pore.initial_pressure={table}"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "^turn_scene: cannot turn components.pore.initial_pressure .*give|use")
        self.assertFalse((self.folder / "new").exists())


unittest.main()
