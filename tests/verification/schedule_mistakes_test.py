#!/usr/bin/python3
"""schedule_mistakes_test.py SPREKK: schedules that are read but do not do what they seem to say are refused or noted, and adaptive steps
of an iterated scheme are those of Newton's method in its solves, as in the monolithic one: passes do not shorten them."""

import csv
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
SCENE = ROOT / "configs/tutorial/first_scene.yaml"
FLOW, ROCK, ALL = "solve: [pore, conduit]", "solve: [rock, contact]", "solve: [pore, rock, conduit, contact]"


def sprekk(*words):
    return subprocess.run([SPREKK, *words], capture_output=True, text=True, timeout=100)


def check(schedule):
    run = sprekk("check", SCENE, "--set", f"schedule={schedule}")
    return run.returncode, run.stdout + run.stderr


class ScheduleMistakes(unittest.TestCase):
    def test_stabilization_without_effect_is_refused(self):
        code, said = check(f"[{{iterate: {{steps: [{{{FLOW}}}, {{{ROCK}, stabilize: fixed_stress}}]}}}}]")
        self.assertNotEqual(code, 0)
        self.assertIn("'stabilize: fixed_stress' has no effect here (it is for pore.pressure", said)
        self.assertEqual(check(f"[{{iterate: {{steps: [{{{FLOW}, stabilize: fixed_stress}}, {{{ROCK}}}]}}}}]")[0], 0)

    def test_solves_looser_than_their_iteration_are_refused(self):
        for residual, is_refused in (("1e-5", True), ("1e-9", False)):
            code, said = check(f"[{{iterate: {{until: {{relative: 1e-8}}, steps: [{{{FLOW}, newton: {{residual: {residual}}}}}, {{{ROCK}}}]}}}}]")
            self.assertEqual(code != 0, is_refused, said)
            self.assertEqual("'newton: residual' is larger than 'until: relative'" in said, is_refused, said)

    def test_a_solver_that_cannot_solve_is_refused(self):
        # Elements of second order leave nothing on fractures that the preconditioner of belos could eliminate first.
        for order, solver, schedule, is_refused in (("second", "belos", f"[{{{ALL}}}]", True), ("second", "umfpack", f"[{{{ALL}}}]", False),
                                                    ("first", "belos", f"[{{{ALL}}}]", False),
                                                    ("second", "belos", f"[{{{FLOW}}}, {{{ROCK}, solver: {{type: umfpack}}}}]", False)):
            run = sprekk("check", SCENE, "--set", "components.rock.type=poromechanics/fem", "--set", f"components.rock.order={order}",
                         "--set", f"solver.type={solver}", "--set", f"schedule={schedule}")
            self.assertEqual(run.returncode, 2 if is_refused else 0, run.stderr)
            self.assertEqual("'solver: belos' cannot solve for rock.wall_traction" in run.stderr, is_refused, run.stderr)

    def test_settling_leaves_nothing_behind(self):
        def settle(what):
            run = sprekk("check", ROOT / "configs/paper/wing_cracks.yaml", "--set", f"schedule=[{{{ALL}}}, {{grow: tips, settle: {what}}}]")
            return run.returncode, run.stdout + run.stderr
        code, said = settle("[rock]")
        self.assertNotEqual(code, 0)
        self.assertIn("'rock' is settled without 'contact'", said)
        self.assertEqual(settle("[rock, contact]")[0], 0)

    def test_the_graph_labels_nested_steps(self):
        inner = f"{{subcycle: {{count: 1, steps: [{{{FLOW}}}]}}}}"
        drawn = sprekk("graph", SCENE, "--set", f"schedule=[{{iterate: {{steps: [{inner}, {{{ROCK}}}]}}}}]").stdout
        labels = dict(re.findall(r'^ *(step\d+) \[.*label="([^"]*)"\];$', drawn, re.MULTILINE))
        arrows = re.findall(r"^ *(step\d+) -> (step\d+);$", drawn, re.MULTILINE)
        self.assertEqual({(labels[one], labels[other]) for one, other in arrows},
                         {("iterate", "sequence"), ("sequence", "subcycle 1"), ("subcycle 1", "solve pore conduit"),
                          ("sequence", "solve rock contact")})

    def test_gaps_are_noted(self):
        def late(condition):
            return check(f"[{{when: 't < 12*h', steps: [{{{ALL}}}]}}, {{when: '{condition}', steps: [{{{ALL}}}]}}]")
        code, said = late("t > 24*h")
        self.assertEqual(code, 0)
        self.assertIn("no step solves for 'pore' from about 12 h to 24 h", said.replace("43200 s", "12 h").replace("86400 s", "24 h"))
        self.assertNotIn("no step solves", late("t >= 12*h")[1])

    def test_passes_do_not_shorten_steps(self):
        def steps(schedule):
            with tempfile.TemporaryDirectory() as folder:
                run = sprekk("run", "-q", SCENE, "-o", folder + "/out", "--set", f"schedule={schedule}", "--set", "time.step=1 h",
                             "--set", "time.adaptive={largest: 8 h}")
                self.assertEqual(run.returncode, 0, run.stderr)
                with open(folder + "/out/history.csv", newline="", encoding="utf-8") as file:
                    rows = list(csv.DictReader(file))
                return [float(row["step[s]"]) for row in rows], [int(row["iterations[1]"]) for row in rows]
        together, _ = steps(f"[{{{ALL}}}]")
        split, passes = steps(f"[{{iterate: {{fallback: none, steps: [{{{FLOW}}}, {{{ROCK}}}]}}}}]")
        self.assertGreater(min(passes), 8)  # which 'adaptive: {iterations: 8}' would take for too many
        self.assertLessEqual(len(split), len(together) + 2)
        self.assertGreaterEqual(min(split), 0.5 * min(together))


if __name__ == "__main__":
    unittest.main()
