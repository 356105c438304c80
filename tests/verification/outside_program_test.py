#!/usr/bin/env python3
"""outside_program_test.py SPREKK MPIEXEC: components that are other programs, those of docs/outside_program.md and small ones.

Pressure in the rock by a Python program, in an iteration with the rock: the answer of matrix_flow/tpfa in one solve with it, with
every accelerator and order, turned, on two processes, in substeps and after a restart. Friction with a memory of its own: the answer
of a formula of the path, which is a variable of the contact. And programs that fail, each in another way."""

import os
import resource
import signal
import subprocess
import sys
import time
import unittest

from scene_runs import ROOT, SPREKK, SceneRuns, on_two_processes, sprekk

sys.path.insert(0, str(ROOT / "tests/docs"))
from pages import files  # noqa: E402  pylint: disable=wrong-import-position

PAGE = files(ROOT / "docs/outside_program.md")
PYTHON = f"PYTHONPATH={ROOT}/tools/python PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1 exec {sys.executable}"
SAME = 1e-10     # of a probe: passes end at 1e-11 of the largest value, and errors shrink at least twice a pass
SIDE = """    boundary: {left: {pressure: 3 MPa}}"""
OURS = PAGE["pore.yaml"].replace("""outside/program
    gives:
      pressure: {unit: Pa, initial: 1 MPa, as: rock_pressure}
    parameters: {permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: 2e-10 1/Pa, left: 3 MPa}""", f"""matrix_flow/tpfa
    permeability: 1e-15 m^2
    viscosity: 1 mPa*s
    storage: 2e-10 1/Pa
    initial_pressure: 1 MPa
{SIDE}""")
TOGETHER = OURS[:OURS.index("schedule:")] + "schedule: [{solve: [pore, rock]}]\n" + OURS[OURS.index("time:"):]

# A crack in a block whose top is moved forth and back.
FAULT = """
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 2 m]}
  fractures: {crack: {points: [[0.4 m, 0.9 m], [1.6 m, 1.1 m]]}}
mesh: {size: 0.4 m, fracture_size: 0.2 m}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 10 GPa
    poisson_ratio: 0.2
    boundary:
      bottom: {displacement_x: 0 m, displacement_y: 0 m}
      top: {displacement_x: (6e-3*sin(2*pi*t/8)) m, normal_stress: -10 MPa}
  contact: {type: contact/coulomb, friction: FRICTION}
  PROGRAM
couplers:
  - {type: wall_traction, between: [rock, contact]}
  GIVEN
schedule: SCHEDULE
time: {end: 8 s, step: 1 s}
output:
  probes:
    slip: {of: contact.jump, fracture: crack, take: mean}
    force: {of: contact.traction, fracture: crack, take: mean}
"""
FORMULA = FAULT.replace("FRICTION", '"0.3*(1 + path/(1*mm))"').replace("PROGRAM", "").replace("GIVEN", "").replace("SCHEDULE", "[{solve: [rock, contact]}]")
GIVEN = (FAULT.replace("FRICTION", "0.3").replace("GIVEN", "- {type: given_friction, between: [fault, contact]}")
         .replace("PROGRAM", 'fault: {type: outside/program, gives: {factor: {on: fracture_cells, unit: "", initial: 1, as: friction_factor}}, '
                             "takes: [contact.jump], parameters: {distance: 1 mm}}")
         .replace("SCHEDULE", "[{iterate: {until: {relative: 1e-11, at_most: 100}, steps: [{solve: [rock, contact]}, {solve: fault}]}}]"))

# A program that does something wrong in its second step.
WRONG = """
import os, sys, time
import numpy as np
from sprekk.outside import Component, Failed, serve
class Wrong(Component):
    def start(self, mesh, parameters, fields):
        self.count, self.calls = len(mesh.cell_measure), 0
    def solve(self, step, fields):
        self.calls += 1
        values = np.full(self.count, 1e6 + step.end)
        if step.start > 0:
            DO
        return {"value": values}
serve(Wrong())
"""
ALONE = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}
mesh: {kind: structured, cells: [4, 4]}
components:
  it: {type: outside/program, timeout: 50 s, gives: {value: {unit: Pa, initial: 1 MPa}}}
schedule: [{solve: it}]
time: {end: 3 s, step: 1 s, smallest: 0.5 s}
output: {probes: {v: {of: it.value, at: [0.3 m, 0.3 m]}}}
"""


# Values that are known: an aperture that doubles, in a fracture that is fed everywhere and open at one end, and a temperature that rises.
KNOWN = """
import numpy as np
from sprekk.outside import Component, serve
class Known(Component):
    def start(self, mesh, parameters, fields):
        self.sizes = {name: values.size for name, values in fields.items()}
    def solve(self, step, fields):
        values = {"aperture": 1e-4 if step.end < 1.5 else 2e-4, "temperature": 300 + 5 * step.end}
        return {name: np.full(size, values[name]) for name, size in self.sizes.items()}
serve(Known())
"""
FLOW = """
geometry:
  box: {x: [0 m, 1 m], y: [0 m, 0.4 m]}
  fractures: {crack: {points: [[0 m, 0.2 m], [1 m, 0.2 m]]}}
mesh: {size: 0.2 m}
components:
  it: {type: outside/program, gives: {aperture: {on: fracture_cells, unit: m, initial: 0.1 mm, as: aperture}}}
  conduit: {type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 0 1/Pa, initial_aperture: 0.1 mm,
    boundary: {left: {pressure: 0 Pa}}, injection: {all: {fracture: crack, rate: {value: 1e-6 m^2/s}}}}
couplers: [{type: given_aperture, between: [it, conduit]}]
schedule: [{solve: it}, {solve: conduit}]
time: {end: 3 s, step: 1 s}
output:
  probes:
    p: {of: conduit.pressure, fracture: crack, take: mean}
"""
WARM = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 0.3 m]}}
mesh: {size: 0.1 m}
components:
  it: {type: outside/program, gives: {temperature: {unit: K, initial: 300 K, as: rock_temperature}}}
  rock: {type: poromechanics/mpsa, young_modulus: 5 GPa, poisson_ratio: 0.2,
    boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}, top: {displacement_y: 0 m}}}
couplers: [{type: thermal_stress, between: [it, rock], expansion: 1e-5 1/K}]
schedule: [{solve: it}, {solve: rock}]
time: {end: 2 s, step: 1 s}
output: {probes: {end: {of: rock.displacement, at: [1 m, 0.15 m]}}}
"""


class OutsideProgram(SceneRuns):
    timeout = 200  # s

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name in ("pore.py", "fault.py"):
            cls.write(PAGE[name], name)
        cls.pore, cls.together = cls.write(PAGE["pore.yaml"], "pore.yaml"), cls.write(TOGETHER, "together.yaml")
        cls.answer = cls.run_scene(cls.together)

    def setUp(self):
        os.environ.pop("SPREKK_PROGRAMS", None)

    def start(self, name, file):
        os.environ["SPREKK_PROGRAMS"] = f"{name}={PYTHON} {self.folder / file}"

    def wrong(self, do, *settings):
        """The command of a program that does this in its second step, and what a run says. It has a checkpoint after the first step, and
        leaves no process."""
        self.start("it", self.write(WRONG.replace("DO", do), "wrong.py"))
        out = self.folder / str(next(self.numbers))
        done = self.call(["run", "-q", "-o", out], self.write(ALONE, "alone.yaml"), *settings)
        self.assert_nothing_left()
        return done, out

    def assert_nothing_left(self):
        listed = subprocess.run(["ps", "-eo", "stat,args"], capture_output=True, text=True, check=True).stdout
        self.assertNotIn(str(self.folder), "\n".join(line for line in listed.splitlines() if " sprekk" not in line and "python" in line and "outside_program_test" not in line))

    def test_pressure_of_a_program_is_that_of_one_solve(self):
        self.start("pore", "pore.py")
        calls = {}
        rock_last, rock_first = "[{solve: pore}, {solve: rock}]", "[{solve: rock}, {solve: pore}]"
        for name, how in {"anderson": "accelerate: {anderson: 5}, steps: " + rock_last, "plain": "steps: " + rock_last,
                          "aitken": "accelerate: {aitken: {}}, steps: " + rock_last, "iqn_ils": "accelerate: {iqn_ils: {}}, steps: " + rock_last,
                          "iqn_imvj": "accelerate: {iqn_imvj: {}}, steps: " + rock_last,
                          "jacobi": "accelerate: {anderson: 5}, order: jacobi, steps: " + rock_last, "rock first": "steps: " + rock_first}.items():
            with self.subTest(name):
                run = self.run_scene(self.pore, "schedule=[{iterate: {until: {relative: 1e-11, at_most: 200}, " + how + "}}]")
                self.assertLess(self.largest_difference(run, self.answer, ("p[Pa]", "u.x[m]", "u.y[m]")), SAME)
                calls[name] = run.record["counters"]["pore: solves by its program"] / sum(run.history["iterations[1]"])
                self.assertTrue(any("judged by change" in note["topic"] for note in run.record["notes"]), run.record["notes"])
        # One call a pass and one more a step; two where values change between the check and the next pass.
        self.assertLess(calls["plain"], 1.2)
        self.assertLess(max(calls.values()), 2.1)
        self.assert_nothing_left()


    def test_turned_in_substeps_restarted_and_on_two_processes(self):
        self.start("pore", "pore.py")
        turned = self.turned(self.pore, 30)
        run = self.run_scene(turned)
        self.assertLess(self.largest_difference(run, self.answer, ("p[Pa]",)), SAME)
        # Perturbed by 1e-9 of a length, it moves by some 1e-9.
        near = self.run_scene(self.pore, "geometry.box.x=[0 m, 4.000000004 m]")
        self.assertLess(self.largest_difference(near, self.answer, ("p[Pa]", "u.x[m]")), 1e-8)
        # The flow takes three substeps, in passes.
        scheme = "[{iterate: {until: {relative: 1e-11, at_most: 60}, steps: [{subcycle: {count: 3, steps: [{solve: pore}]}}, {solve: rock}]}}]"
        run, other = (self.run_scene(scene, "schedule=" + scheme) for scene in (self.pore, self.together))
        self.assertLess(self.largest_difference(run, other, ("p[Pa]", "u.x[m]")), 1e-9)
        self.assertGreater(self.largest_difference(run, self.answer, ("p[Pa]",)), 1e-4)

    @on_two_processes
    def test_two_processes(self):
        self.start("pore", "pore.py")
        run = self.run_scene(self.pore, "time.end=20 min", processes=2)
        for column in ("p[Pa]", "u.x[m]", "u.y[m]"):
            self.assertLess(max(abs(run.history[column] / self.answer.history[column][:2] - 1)), SAME, column)
        self.assert_nothing_left()

    def test_friction_with_memory_is_that_of_a_formula(self):
        self.start("fault", "fault.py")
        answer = self.run_scene(self.write(FORMULA, "formula.yaml"))
        fault = self.write(GIVEN, "fault.yaml")
        run = self.run_scene(fault)
        slip = answer.history["slip.t[m]"]
        self.assertLess(min(slip), -1e-4)  # it slides forth and back
        self.assertGreater(max(slip), 5e-4)
        self.assertLess(self.largest_difference(run, answer, ("slip.t[m]", "force.t[Pa]")), 1e-9)
        # Restarted in the middle: the memory comes back.
        half = self.run_scene(fault, "time.end=4 s")
        self.assert_same_bits(self.run_scene(fault, restart=half.folder), run)

    def test_apertures_and_temperatures_are_those_of_the_program(self):
        self.start("it", self.write(KNOWN, "known.py"))
        pressure = self.run_scene(self.write(FLOW, "flow.yaml"), "mesh.size=0.05 m").history["p[Pa]"]
        cubic = 1e-6 * 12 * 1e-3 / 1e-12 / 3  # Q L 12 mu/a^3/3
        self.assertAlmostEqual(pressure[0] / cubic, 1, delta=0.05**2)  # (size of a cell)^2
        self.assertAlmostEqual(pressure[0] / pressure[2], 8, delta=1e-8)
        end = self.run_scene(self.write(WARM, "warm.yaml")).history["end.x[m]"]
        for seconds, stretched in zip((1, 2), end):  # (1 + nu)/(1 - nu) alpha_T T L
            self.assertAlmostEqual(stretched / (1.2 / 0.8 * 1e-5 * 5 * seconds), 1, delta=1e-9)
        wrong = self.call("check", self.folder / "flow.yaml", "components.it.gives.aperture.initial=0.2 mm")
        self.assertIn("starts with 0.0002 m, and the aperture with 0.0001 m", wrong.stderr)

    def test_failures_end_with_a_message_and_a_checkpoint(self):
        for do, words in {"os._exit(3)": "has ended with exit code 3", "os.kill(os.getpid(), 9)": "was ended by signal 9",
                          "time.sleep(60)": "has not answered for 3 s", "values = values[1:]": "gives 31 numbers for 'value', not 32",
                          "os.write(SERVER, b'hello world\\n')": "is no message", "return {}": "exit code 1",
                          "values[3] = np.nan": "gives nan for value 3 of 'value'",
                          "raise Failed('no such step')": "cannot take the step: no such step"}.items():
            with self.subTest(do):
                do = do.replace("SERVER", "[fd for fd in range(3, 20) if os.path.exists(f'/proc/self/fd/{fd}') and 'pipe' in os.readlink(f'/proc/self/fd/{fd}')][-1]")
                done, out = self.wrong(do, *(["components.it.timeout=3 s"] if "sleep" in do else []))
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(words, done.stderr)
                self.assertEqual(len(sprekk.Results(out).times), 1)
                self.assertTrue((out / "checkpoint.h5").exists())

    def test_a_program_that_does_not_repeat_itself_is_noted(self):
        self.start("it", self.write(WRONG.replace("DO", "pass").replace("1e6 +", "1e6 + self.calls +"), "wrong.py"))
        run = self.run_scene(self.write(ALONE, "alone.yaml"))
        self.assertTrue(any("does not repeat itself" in note["topic"] for note in run.record["notes"]))

    def test_interrupted(self):
        self.start("it", self.write(WRONG.replace("DO", "time.sleep(60)"), "wrong.py"))
        out = self.folder / "interrupted"
        program = subprocess.Popen([SPREKK, "run", "-q", "-o", out, self.write(ALONE, "alone.yaml")], stderr=subprocess.PIPE)
        for _ in range(200):
            time.sleep(0.05)
            if (out / "history.csv").exists() and len((out / "history.csv").read_text().splitlines()) > 1:
                break
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=20)
        self.assertEqual(program.returncode, 130)
        self.assert_nothing_left()

    def test_scenes_start_nothing_and_mistakes_are_told(self):
        alone = self.write(ALONE, "alone.yaml")
        done = self.call("check", alone)
        self.assertEqual(done.returncode, 0, done.stderr)
        for words, settings, message in (
                ((), (), "no command starts it"),
                (("--program", "is=true"), (), "unknown|no command starts it"),
                (("--program", "it="), (), "starts no program"),
                (("--program", "it=exit 7"), (), "exit code 7"),
                ((), ("components.it.gives.value.unit=kPa",), "is no SI unit"),
                ((), ("components.it.gives.value.as=aperture",), "on: fracture_cells"),
                ((), ("components.it.takes=[it.valu]",), "did you mean 'it.value'"),
                ((), ("components.it.parameters={a: 3 cows}",), "no number with a unit"),
                ((), ("schedule=[{iterate: {steps: [{solve: it, stabilize: response}]}}]",), "the 'solve' of 'it' is stabilized"),
                ((), ("time.scheme=sdirk2",), "first order in time"),
                ((), ("start={settle: [it]}",), "cannot be settled")):
            with self.subTest(message):
                done = self.call(["run", "-q", *words], alone, *settings)
                self.assertIn(done.returncode, (1, 2))
                self.assertRegex(done.stderr, message)
        self.assertIn("solved together", self.call("check", self.pore, "schedule=[{solve: [pore, rock]}]").stderr)

    def test_messages_cost_little(self):
        """Processor time of the Python program a step, with 10 000 numbers to and fro and three messages: a process waits for its
        children, so the time of ours has theirs."""
        self.start("it", self.write(WRONG.replace("DO", "pass"), "wrong.py"))
        scene, seconds = self.write(ALONE, "alone.yaml"), []
        for steps in (10, 110):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            run = self.run_scene(scene, "mesh.cells=[71, 71]", f"time.end={steps} s", "components.it.takes=[it.value]")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            ours = run.record["timings"]["processor: steps and output"]
            seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime - ours)
        self.assertLess((seconds[1] - seconds[0]) / 100, 2e-3)


if __name__ == "__main__":
    unittest.main()
