#!/usr/bin/python3
"""fallback_test.py SPREKK: an iteration whose passes do not converge solves the step for all of its unknowns at once. The answer is the
monolithic one, a note says why and in how many steps, and 'fallback: none' refuses such a step."""

import csv
import unittest

from scene_runs import ROOT, SceneRuns, on_two_processes

TERZAGHI, PAPER = ROOT / "configs/verification/terzaghi.yaml", ROOT / "configs/paper/onset_coarse.yaml"
COUPLED = 0.5  # 1/Pa: alpha^2/M_v of Terzaghi's scene
TOPIC = "steps solved together"
SMALL_PAPER = ("mesh={size: 0.3 m, fracture_size: 0.02 m, growth: 0.35}", "time.end=5 h")


def column(factor):
    """Fluid that hardly moves: the drained split contracts by this factor."""
    return (f"components.pore.storage={COUPLED / factor!r} 1/Pa", "components.pore.permeability=1e-9 m^2", "mesh.cells=[2, 20]", "time.end=0.04 s")


def iterated(steps, options=""):
    return f"schedule=[{{iterate: {{until: {{relative: 1e-9, at_most: 400}}, {options}steps: [{steps}]}}}}]"


IN_TURN = "{solve: pore}, {solve: rock}"
# The flow in the fracture apart from that in the rock and from the walls: an error of its pressure is multiplied by more than 100 in a pass.
FRACTURE_APART = "{solve: conduit}, {solve: [pore, rock, contact]}"


class Fallback(SceneRuns):
    def notes(self, run):
        return [note for note in run.record["notes"] if note["topic"] == TOPIC]

    def rows(self, run):
        with open(run.folder / "coupling.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def distance(self, ours, truth, kind="matrix"):
        """Of any field of the last time, over its largest value."""
        found, right = ours.fields(kind=kind), truth.fields(kind=kind)
        return max(abs(found[name] - right[name]).max() / abs(right[name]).max() for name in right.names
                   if "." in name and abs(right[name]).max() > 0 and "floor" not in name)

    def test_a_split_beyond_its_limit_has_the_monolithic_answer(self):
        truth = self.run_scene(TERZAGHI, *column(1.1))
        ours = self.run_scene(TERZAGHI, *column(1.1), iterated(IN_TURN))
        self.assertEqual(len(ours.rows), len(truth.rows))
        self.assertLess(self.distance(ours, truth), 1e-9)
        (note,) = self.notes(ours)
        self.assertEqual(note["steps"], len(truth.rows))
        self.assertRegex(note["text"], r"diverges: each pass changes (pore.pressure|rock.displacement) 1\.(09|1|11) times")
        names = [row["schedule"] for row in self.rows(ours)]
        self.assertIn("fallback", names)
        refused = self.call(["run", "-q", "-o", self.folder / "refused"], TERZAGHI, *column(1.1), "time.smallest=0.004 s",
                            iterated(IN_TURN, "fallback: none, "))
        self.assertEqual(refused.returncode, 1)
        self.assertIn("diverges", refused.stderr)

    def test_an_iteration_that_converges_does_not_use_it(self):
        ours = self.run_scene(TERZAGHI, *column(0.9), iterated(IN_TURN))
        self.assertFalse(self.notes(ours))
        self.assertNotIn("fallback", [row["schedule"] for row in self.rows(ours)])
        self.assert_same_bits(self.run_scene(TERZAGHI, *column(0.9), iterated(IN_TURN, "fallback: none, ")), ours)

    def test_stages_of_second_order(self):
        # Each stage is an iteration of its own. Those that see no change hold at once, to `until`.
        truth = self.run_scene(TERZAGHI, *column(1.3), "time.scheme=sdirk2")
        ours = self.run_scene(TERZAGHI, *column(1.3), "time.scheme=sdirk2", iterated(IN_TURN))
        self.assertLess(self.distance(ours, truth), 1e-8)
        self.assertGreaterEqual(self.notes(ours)[0]["steps"], 1)

    def test_a_fracture_that_slips(self):
        for perturbed in (0, 1e-9):
            load = f"components.rock.boundary.right.normal_stress={-20e6 * (1 + perturbed)!r} Pa"
            truth = self.run_scene(PAPER, *SMALL_PAPER, load)
            ours = self.run_scene(PAPER, *SMALL_PAPER, load, iterated(FRACTURE_APART))
            self.assertGreater(truth.rows[-1]["contact.cells_slip"], 2)
            self.assertEqual(len(ours.rows), len(truth.rows))
            self.assertGreaterEqual(self.notes(ours)[0]["steps"], 1)
            self.assertFalse([note for note in ours.record["notes"] if "the balance of" in note["text"]])
            for kind in ("matrix", "fractures"):
                self.assertLess(self.distance(ours, truth, kind), 1e-7)

    def test_a_restart_has_the_same_bits(self):
        # iqn_imvj learns from passes; of those that have not converged it keeps nothing.
        imvj = iterated(FRACTURE_APART, "accelerate: {iqn_imvj: {}}, ").replace("at_most: 400", "at_most: 30")
        for scene, settings, half in ((TERZAGHI, (*column(1.1), iterated(IN_TURN)), "0.02 s"), (PAPER, (*SMALL_PAPER, imvj), "3 h")):
            whole = self.run_scene(scene, *settings)
            first = self.run_scene(scene, *settings, f"time.end={half}")
            again = self.run_scene(scene, *settings, restart=first.folder)
            self.assert_same_bits(again, whole)
            self.assertEqual([note["steps"] for note in self.notes(again)], [note["steps"] for note in self.notes(whole)])

    @on_two_processes
    def test_on_two_processes(self):
        for scene, settings in ((TERZAGHI, (*column(1.1), iterated(IN_TURN))), (PAPER, (*SMALL_PAPER, iterated(FRACTURE_APART)))):
            one, two = (self.run_scene(scene, *settings, processes=count) for count in (1, 2))
            self.assertLess(self.distance(two, one), 1e-8)
            self.assertEqual(self.notes(two)[0]["steps"], self.notes(one)[0]["steps"])

    def test_mistakes(self):
        substeps = "{subcycle: {count: 2, steps: [{solve: pore}]}}, {solve: rock}"
        for schedule, said in (("schedule=[{iterate: {fallback: monolithic, steps: [" + substeps + "]}}]", "'fallback: monolithic' has no effect"),
                               (iterated(IN_TURN, "fallback: together, "), "monolithic, none")):
            run = self.call("check", TERZAGHI, schedule)
            self.assertEqual(run.returncode, 2)
            self.assertIn(said, run.stderr)
        self.assertEqual(self.call("check", TERZAGHI, "schedule=[{iterate: {steps: [" + substeps + "]}}]").returncode, 0)


if __name__ == "__main__":
    unittest.main()
