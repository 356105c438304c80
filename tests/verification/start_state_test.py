#!/usr/bin/env python3
"""start_state_test.py SPREKK MPIEXEC: `start:`, the state that a run begins with.

from: a column of 1 m that cannot move sideways consolidates from 1 Pa in two runs, of which the second begins with the state of
the first: one run to round-off, the series of backward Euler for Terzaghi's problem, with storage S + alpha^2/(lambda + 2 G),
and totals that begin anew; on two processes as well. What does not fit is refused. settle: a run with weight goes on from its
checkpoint with the same bits, also when a region is taken away, and has the same answer on two processes."""

import csv
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MPIEXEC = sys.argv.pop(2)
SPREKK = Path(sys.argv.pop(1)).resolve()
STORAGE, MODULUS, ALPHA, DT, CELLS = 0.5, 2.0, 0.8, 0.01, 40

COLUMN = f"""
geometry:
  box: {{x: [0 m, 0.1 m], y: [0 m, 1 m]}}
mesh: {{kind: structured, cells: [4, {CELLS}], shape: quadrilaterals}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: {STORAGE} 1/Pa
    initial_pressure: 1 Pa
    boundary: {{bottom: {{pressure: 0 Pa}}}}
  rock:
    type: poromechanics/mpsa
    young_modulus: {5 / 3!r} Pa
    poisson_ratio: 0.25
    boundary:
      left: {{displacement_x: 0 m}}
      right: {{displacement_x: 0 m}}
      top: {{displacement_y: 0 m}}
couplers:
  - {{type: biot, between: [pore, rock], biot_coefficient: {ALPHA}}}
schedule: [{{solve: [pore, rock]}}]
time: {{end: 0.05 s, step: {DT} s}}
output:
  probes:
    end: {{of: rock.displacement, at: [0.05 m, 0 m]}}
    middle: {{of: pore.pressure, at: [0.06 m, 0.5125 m]}}
"""

WEIGHT = """
geometry:
  box: {x: [0 m, 40 m], y: [-40 m, 0 m]}
  regions: {tunnel: {polygon: [[15 m, -25 m], [25 m, -25 m], [25 m, -15 m], [15 m, -15 m]]}}
  fractures: {fault: {points: [[4 m, -30 m], [12 m, -22 m]]}}
mesh: {size: 5 m, fracture_size: 2 m}
components:
  rock:
    type: poromechanics/ROCK
    young_modulus: 1 GPa
    poisson_ratio: 0.3
    rock_density: 2000 kg/m^3
    gravity: [0, -10 m/s^2]
    boundary:
      left: {displacement_x: 0 m}
      right: {displacement_x: 0 m}
      bottom: {displacement_y: 0 m}
    excavation: {tunnel: {support: "if(t < 1.5, 1, max(0, 1 - t/5))"}}
  contact: {type: contact/coulomb, friction: 0.6}
couplers: [{type: wall_traction, between: [rock, contact]}]
start: {settle: [rock, contact]}
schedule: [{solve: [rock, contact]}]
time: {end: 4 s, step: 1 s}
output:
  probes:
    top: {of: rock.displacement, at: [20 m, 0 m]}
    fault: {of: contact.jump, fracture: fault, take: mean}
    force: {of: contact.traction, fracture: fault, take: mean}
"""

# Rock, fluid and heat of two layers with a fault that slides under the weight; the water rises after the first step.
LAYERS = """
geometry:
  box: {x: [0 m, 100 m], y: [-1000 m, 0 m]}
  regions: {lower: {polygon: [[0 m, -1000 m], [100 m, -1000 m], [100 m, -400 m], [0 m, -400 m]]}}
  fractures: {f: {points: [[20 m, -700 m], [70 m, -580 m]]}}
mesh: {size: 80 m, fracture_size: 35 m}
materials: {gravity: [0, -10 m/s^2], fluid_density: 1000 kg/m^3}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, boundary: {top: {pressure: "(-5e5 + 200*x + if(t < 9e7, 0, 1e6)) Pa"}}}
  conduit: {type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, initial_aperture: 1 mm}
  rock:
    type: poromechanics/ROCK
    young_modulus: {regions: {lower: 40 GPa, default: 10 GPa}}
    poisson_ratio: 0.25
    rock_density: {regions: {lower: 2600 kg/m^3, default: 2200 kg/m^3}}
    boundary: {left: {displacement_x: 0 m}, right: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}}
  contact: {type: contact/coulomb, friction: 0.6, closure: {law: linear, stiffness: 100 GPa/m}}
  heat: {type: matrix_heat/mpfa, conductivity: 3 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: (283-0.03*y) K, boundary: {top: {temperature: 283 K}, bottom: {heat_flux: -0.06 W/m^2}}}
  slot: {type: fracture_heat/tpfa, aperture: 1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4.2e6 J/(m^3*K), initial_temperature: (283-0.03*y) K}
couplers:
  - {type: aperture, between: [contact, conduit]}
  - {type: biot, between: [pore, rock], biot_coefficient: 0.8}
  - {type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: heat_exchange, between: [heat, slot]}
  - {type: heat_advection, between: [pore, conduit, heat, slot], fluid_heat_capacity: 4.2e6 J/(m^3*K)}
start: {settle: [pore, conduit, rock, contact, heat, slot]}
schedule: [{solve: [pore, conduit, rock, contact]}, {solve: [heat, slot]}]
time: {end: 10 year, step: 2.5 year}
output:
  probes:
    p: {of: pore.pressure, at: [50 m, -300 m]}
    pf: {of: conduit.pressure, fracture: f, take: mean}
    f: {of: contact.traction, fracture: f, take: mean}
    a: {of: conduit.aperture, fracture: f, take: mean}
    T: {of: heat.temperature, at: [50 m, -900 m]}
    s: {of: rock.stress, at: [50 m, -900 m]}
    u: {of: rock.displacement, at: [50 m, 0 m]}
"""


def changed(text, *changes):
    for before, after in changes:
        assert before in text, before
        text = text.replace(before, after)
    return text


class Start(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def call(self, name, text, processes=1, command="run", options=()):
        (self.folder / f"{name}.yaml").write_text(text)
        program = [MPIEXEC, "-n", str(processes)] if processes > 1 else []
        program += [SPREKK, command, f"{name}.yaml", *options]
        if command == "run" and "--restart" not in options:
            program += ["-o", name]
        return subprocess.run(program, capture_output=True, text=True, timeout=100, cwd=self.folder)

    def rows(self, name, text, processes=1, options=()):
        done = self.call(name, text, processes, options=options)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / name / "history.csv") as file:
            return list(csv.DictReader(file))

    def number(self, row, name):
        return next(float(value) for key, value in row.items() if key.split("[")[0] == name)

    def second(self, *changes):
        return changed(COLUMN, ("time:", "start: {from: first}\ntime:"), *changes)

    def test_two_parts_are_one_run(self):
        whole = self.rows("whole", changed(COLUMN, ("end: 0.05 s", "end: 0.1 s")))
        first = self.rows("first", COLUMN)
        second = self.rows("second", self.second())
        self.assertEqual([len(whole), len(first), len(second)], [10, 5, 5])
        for row, other in zip(whole[5:], second):
            for name in ("end.y", "middle"):  # the same state; lengths of steps differ by round-off
                self.assertAlmostEqual(self.number(other, name) / self.number(row, name), 1, delta=1e-12)
            stored = self.number(row, "fluid_stored") - self.number(whole[4], "fluid_stored")
            self.assertAlmostEqual(self.number(other, "fluid_stored"), stored, delta=1e-12)
            self.assertLess(abs(self.number(other, "fluid_balance_error")), 1e-12)
        self.assertEqual(self.number(second[0], "time"), DT)
        diffusivity, pressure, integral = 1 / (STORAGE + ALPHA**2 / MODULUS), 0, 0
        for k in range(2000):
            n = (k + 0.5) * math.pi
            decay = (1 + diffusivity * DT * n * n) ** -10
            pressure += 2 / n * math.sin(0.5125 * n) * decay
            integral += 2 / n**2 * decay
        self.assertAlmostEqual(self.number(second[-1], "middle") / pressure, 1, delta=2 / CELLS**2)
        settled = ALPHA / MODULUS * (1 - integral)
        self.assertAlmostEqual(self.number(second[-1], "end.y") / settled, 1, delta=2 / CELLS**2)

    def test_loads_that_are_given_in_time(self):
        """Rock under a pressure or a temperature that are data of time: they count from the start of the first run, in both rocks."""
        plane = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 2 m]}}
mesh: {size: 1 m}
components:
  rock: {type: poromechanics/ROCK, young_modulus: 10 GPa, poisson_ratio: 0.25,
         boundary: {bottom: {displacement_y: 0 m}, left: {displacement_x: 0 m}, top: {normal_stress: -5 MPa}}}
  given: GIVEN
couplers: [COUPLER]
schedule: [{solve: rock}]
time: {start: 0 s, end: 300 s, step: 100 s}
output: {fields: false, probes: {u: {of: rock.displacement, at: [4 m, 1 m]}}}
"""
        lame = 4e9  # Pa, both parameters
        for kind, given, coupler, load in (
                ("p", "{type: matrix_flow/prescribed, pressure: (1e6 + 1e4*t) Pa}", "{type: biot, between: [given, rock], biot_coefficient: 0.8}", 0.8 * 3e6),
                ("T", "{type: matrix_heat/prescribed, temperature: (300 + 0.1*t) K}", "{type: thermal_stress, between: [given, rock], expansion: 1e-5 1/K}",
                 (3 * lame + 2 * lame) * 1e-5 * 30)):
            for rock in ("mpsa", "fem"):
                text = plane.replace("ROCK", rock).replace("GIVEN", given).replace("COUPLER", coupler)
                name = kind + rock
                whole = self.rows(f"{name}_whole", text.replace("end: 300 s", "end: 600 s"))
                self.rows(f"{name}_first", text)
                second = self.rows(f"{name}_second", text.replace("start: 0 s, end: 300 s", "start: 300 s, end: 600 s") + f"start: {{from: {name}_first}}\n")
                moved = self.number(whole[5], "u.x") - self.number(whole[2], "u.x")
                self.assertAlmostEqual(moved / (4 * load / (2 * (lame + lame))), 1, delta=1e-9, msg=name)
                for row, other in zip(whole[3:], second, strict=True):
                    self.assertAlmostEqual(self.number(other, "u.x") / self.number(row, "u.x"), 1, delta=1e-12, msg=name)

    def test_scenes_go_on(self):
        """Slip and apertures, temperatures, and wells whose rates have just changed: two runs are one."""
        scenes = Path(__file__).resolve().parents[2] / "configs/tutorial"
        for name, step, half, end in (("first_scene", "1 h", "2 h", "4 h"), ("heat_doublet", "20 day", "60 day", "120 day"),
                                      ("well_limits", "0.05 day", "0.2 day", "0.4 day")):
            def rows(folder, *settings):
                options = [option for setting in (f"time.step={step}", *settings) for option in ("--set", setting)]
                done = subprocess.run([SPREKK, "run", "-q", scenes / f"{name}.yaml", *options, "-o", folder], capture_output=True,
                                      text=True, timeout=100, cwd=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(self.folder / folder / "history.csv") as file:
                    return list(csv.DictReader(file))
            whole = rows(f"{name}_whole", f"time.end={end}")
            first = rows(f"{name}_first", f"time.end={half}")
            second = rows(f"{name}_second", f"time.start={half}", f"time.end={end}", f"start={{from: {name}_first}}")
            self.assertEqual(len(whole), len(first) + len(second))
            for column in whole[0]:
                if any(word in column for word in ("stored", "injected", "outflow", "error", "iterations")):
                    continue
                size = max(abs(float(row[column])) for row in whole)
                for row, other in zip(whole[len(first):], second, strict=True):
                    self.assertAlmostEqual(float(other[column]), float(row[column]), delta=1e-9 * size, msg=f"{name} {column}")

    def test_on_two_processes(self):
        self.rows("first", COLUMN)
        alone = self.rows("alone", self.second())
        shared = self.rows("shared", self.second(), 2)
        for row, other in zip(alone, shared):
            for name in ("end.y", "middle", "fluid_stored"):
                self.assertAlmostEqual(self.number(other, name), self.number(row, name), delta=1e-9)

    def test_what_does_not_fit_is_refused(self):
        self.rows("first", COLUMN)
        (self.folder / "empty").mkdir()
        (self.folder / "damaged").mkdir()
        (self.folder / "damaged/checkpoint.h5").write_bytes((self.folder / "first/checkpoint.h5").read_bytes()[:5000])
        (self.folder / "damaged/run.json").write_bytes((self.folder / "first/run.json").read_bytes())
        (self.folder / "alone").mkdir()
        (self.folder / "alone/checkpoint.h5").write_bytes((self.folder / "first/checkpoint.h5").read_bytes())
        biot = f"  - {{type: biot, between: [pore, rock], biot_coefficient: {ALPHA}}}"
        mistakes = [
            ([("from: first", "from: frist")], "there is no such folder"),
            ([("from: first", "from: empty")], "it has no checkpoint.h5"),
            ([("from: first", "from: damaged")], "does not start from 'damaged'"),
            ([("from: first", "from: alone")], "there is no run.json"),
            ([(f"cells: [4, {CELLS}]", "cells: [4, 20]")], "it has 160 cells, 0 fracture cells and 205 nodes there, and 80"),
            ([("y: [0 m, 1 m]", "y: [0 m, 2 m]")], "its nodes lie elsewhere, up to 1 m away"),
            ([("poromechanics/mpsa", "poromechanics/fem")], "it is poromechanics/mpsa there and poromechanics/fem here"),
            ([("initial_pressure: 1 Pa", "initial_pressure: 2 Pa")], "the state is counted from it"),
            ([("pore:", "water:"), ("rock:", "stone:"), ("[pore, rock]", "[water, stone]"), ("of: rock", "of: stone"),
              ("of: pore", "of: water"), (biot.replace("[pore, rock]", "[water, stone]"), "")],
             "has no component of this scene"),
        ]
        for changes, words in mistakes:
            for command in ("check", "run"):
                done = self.call("second", self.second(*changes), command=command)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(words, done.stderr)
                self.assertFalse((self.folder / "second").exists())
        self.rows("apart", changed(COLUMN, (biot, "  []"), ("couplers:\n  []", "couplers: []")))
        done = self.call("second", changed(self.second(), ("from: first", "from: apart")), command="check")
        self.assertEqual(done.returncode, 2)
        self.assertIn("has no coupler biot", done.stderr)

    def test_components_that_are_new_or_left_behind_are_noted(self):
        self.rows("first", COLUMN)
        done = self.call("second", changed(self.second(), ("  rock:\n", "  heat: {type: matrix_heat/mpfa, conductivity: 1 W/(m*K), "
                         "heat_capacity: 1 J/(m^3*K), initial_temperature: 300 K}\n  rock:\n"),
                         ("schedule: [{solve: [pore, rock]}]", "schedule: [{solve: [pore, rock]}, {solve: heat}]")), command="check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("'heat' begins with its initial values", done.stderr)
        alone = changed(self.second(), ("  - {type: biot, between: [pore, rock], biot_coefficient: 0.8}", "  []"), ("couplers:\n  []", ""),
                        ("solve: [pore, rock]", "solve: pore"), ("    end: {of: rock.displacement, at: [0.05 m, 0 m]}\n", ""))
        rock = alone[alone.index("  rock:"):alone.index("schedule:")]
        done = self.call("second", changed(alone, (rock, "")), command="check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the state of 'rock' is left behind", done.stderr)

    def test_growth_does_not_begin_with_a_settled_run(self):
        # The fine level has no settled stress, nor has a mesh that has changed: K would be half as large.
        self.rows("settled", changed(WEIGHT, ("ROCK", "mpsa")))
        self.rows("plain", changed(WEIGHT, ("ROCK", "mpsa"), ("start: {settle: [rock, contact]}\n", "")))
        tips = changed(WEIGHT, ("ROCK", "mpsa"), ("couplers: [", "  tips: {type: fine_fracture/quarter_point, size: 10 m}\n"
                       "couplers: [{type: two_level, between: [rock, tips]}, "), ("time: {end: 4 s", "time: {start: 4 s, end: 6 s"),
                       ("{solve: [rock, contact]}", "{solve: [rock, contact]}, {grow: tips, settle: [rock, contact]}"))
        for other, code in (("settled", 2), ("plain", 0)):
            text = changed(tips, ("start: {settle: [rock, contact]}", f"start: {{from: {other}}}"))
            done = self.call("second", text, command="check")
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual("changes are counted from a state that was settled there" in done.stderr, code == 2, done.stderr)

    def test_settled_run_goes_on_from_its_checkpoint(self):
        for rock in ("mpsa", "fem"):
            scene = changed(WEIGHT, ("ROCK", rock))
            whole = self.rows(f"whole_{rock}", scene)
            for row in whole[:1]:
                self.assertLess(abs(self.number(row, "top.y")), 1e-14)
            self.assertGreater(abs(self.number(whole[-1], "top.y")), 1e-4)
            for name in (f"parts_{rock}", f"half_{rock}"):
                self.rows(name, changed(scene, ("end: 4 s", "end: 2 s")))
            parts = self.rows(f"parts_{rock}", scene, options=("--restart", f"parts_{rock}/checkpoint.h5"))
            self.assertEqual([dict(row) for row in whole], [dict(row) for row in parts])
            goes_on = self.rows(f"goes_on_{rock}", changed(scene, ("start: {settle: [rock, contact]}", f"start: {{from: half_{rock}}}"),
                                                           ("time: {end: 4 s", "time: {start: 2 s, end: 4 s")))
            for row, other in zip(whole[2:], goes_on, strict=True):
                self.assertEqual(row["top.y[m]"], other["top.y[m]"])
                self.assertEqual(row["force.n[Pa]"], other["force.n[Pa]"])
            shared = self.rows(f"shared_{rock}", scene, 2)
            for row, other in zip(whole, shared):
                for name in row:
                    if not name.startswith("iterations"):
                        value = float(row[name])
                        self.assertAlmostEqual(float(other[name]), value, delta=1e-8 * abs(value) + 1e-12, msg=name)

    def test_all_that_was_settled_goes_on_from_its_checkpoint(self):
        for rock in ("mpsa", "fem"):
            scene = changed(LAYERS, ("ROCK", rock))
            whole = self.rows(f"layers_{rock}", scene)
            self.assertLess(abs(self.number(whole[0], "u.y")), 1e-11)  # the weight has shortened the box by a metre
            self.assertGreater(abs(self.number(whole[-1], "u.y")), 1e-3)
            for name in (f"part_{rock}", f"half_layers_{rock}"):
                self.rows(name, changed(scene, ("end: 10 year", "end: 5 year")))
            part = self.rows(f"part_{rock}", scene, options=("--restart", f"part_{rock}/checkpoint.h5"))
            self.assertEqual([dict(row) for row in whole], [dict(row) for row in part])
            settle = "start: {settle: [pore, conduit, rock, contact, heat, slot]}"
            goes_on = self.rows(f"on_{rock}", changed(scene, (settle, f"start: {{from: half_layers_{rock}}}"),
                                                      ("time: {end: 10 year", "time: {start: 5 year, end: 10 year")))
            for row, other in zip(whole[2:], goes_on, strict=True):
                for name in ("p[Pa]", "pf[Pa]", "f.n[Pa]", "a[m]", "T[K]", "s.xx[Pa]", "u.y[m]"):
                    self.assertEqual(row[name], other[name], name)
            for name, text in ((f"shared_layers_{rock}", scene), (f"disturbed_{rock}", changed(
                    scene, ("fluid_density: 1000 kg/m^3", "fluid_density: 1000.000001 kg/m^3")))):
                for row, other in zip(whole, self.rows(name, text, 2 if "shared" in name else 1), strict=True):
                    for key in ("p[Pa]", "pf[Pa]", "f.n[Pa]", "a[m]", "T[K]", "s.xx[Pa]"):
                        value = float(row[key])
                        self.assertAlmostEqual(float(other[key]), value, delta=1e-7 * abs(value), msg=f"{name} {key}")


if __name__ == "__main__":
    unittest.main()
