#!/usr/bin/python3
"""accelerators_test.py SPREKK: iterated splits with each accelerator reach the monolithic answer, also where the plain iteration diverges or hardly moves;
quasi-Newton methods need no more passes than Anderson's, and fewer with what earlier steps have taught; a restarted run goes on to the bit;
two processes take the same passes; mistakes are refused."""

import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns, on_two_processes

CONFIGS = ROOT / "configs"
MANDEL, NETWORK = CONFIGS / "verification/mandel.yaml", CONFIGS / "verification/regular_network.yaml"
TERZAGHI, FRICTION = CONFIGS / "verification/terzaghi.yaml", CONFIGS / "tutorial/first_scene.yaml"
ACCELERATORS = ("constant: {factor: 0.8}", "aitken: {}", "anderson: 5", "iqn_ils: {}", "iqn_ils: {reuse: 3, filter: qr1}", "iqn_imvj: {}",
                "iqn_imvj: {rank: 6, filter: none}", "largest_step: 2, iqn_ils: {reuse: 2}")
OF_INTERFACE = "over: [rock.displacement], iqn_imvj: {}"  # what the first solve of the drained split needs of the second
DRAINED = "[{solve: pore}, {solve: rock}]"
FIXED_STRESS = "[{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}]"


def iterated(accelerator, steps, relative=1e-9, at_most=100):
    return f"schedule=[{{iterate: {{fallback: none, until: {{relative: {relative}, at_most: {at_most}}}, accelerate: {{{accelerator}}}, steps: {steps}}}}}]"


class Accelerators(SceneRuns):
    def difference(self, ours, right):
        """The largest of all fields, over the largest value of all components of the field."""
        largest = 0
        for kind in ("matrix", "fractures"):
            if not any(right.folder.glob(f"{kind}_*.vtu")):
                continue
            truth, found = right.fields(kind=kind), ours.fields(kind=kind)
            names = [name for name in truth.names if "." in name and np.issubdtype(np.asarray(truth[name]).dtype, np.floating)]
            for name in names:
                field = name.split(".")[:2]
                size = max(abs(truth[other]).max() for other in names if other.split(".")[:2] == field)
                largest = max(largest, abs(found[name] - truth[name]).max() / max(size, 1e-12))
        return largest

    @staticmethod
    def passes(run):
        return [int(value) for value in run["iterations[1]"]]

    def test_all_reach_the_monolithic_answer(self):
        for scene, steps, settings in ((MANDEL, DRAINED, ("time.end=3237 s", "mesh.size=0.1 m")),
                                       (FRICTION, FIXED_STRESS, ("time.end=6 h", "mesh.size=0.8 m"))):
            truth = self.run_scene(scene, *settings)
            for accelerator in (*ACCELERATORS, OF_INTERFACE) if scene == MANDEL else ACCELERATORS[1:6:2]:
                with self.subTest(scene=scene.stem, accelerator=accelerator):
                    ours = self.run_scene(scene, *settings, iterated(accelerator, steps))
                    self.assertLess(self.difference(ours, truth), 1e-7)
                    self.assertLess(max(self.passes(ours)), 40)

    def test_rock_and_fractures_in_turn(self):
        settings = ("mesh.size=0.08 m", "time.smallest=0.9 s")
        truth = self.run_scene(NETWORK, *settings)
        split = "[{solve: pore}, {solve: conduit}]"
        plain = self.call(["run", "-q", "-o", self.folder / "plain"], NETWORK, *settings, iterated("", split))
        self.assertEqual(plain.returncode, 1)
        for accelerator in ("aitken: {}", "iqn_ils: {}", "iqn_imvj: {}"):
            ours = self.run_scene(NETWORK, *settings, iterated(accelerator, split))
            self.assertLess(self.difference(ours, truth), 1e-7, accelerator)
            self.assertLessEqual(self.passes(ours)[-1], 20, accelerator)

    def test_a_column_ends_after_its_modes(self):
        # The drained split of a column that hardly conducts multiplies each change by -3. It has as many modes as it has cells in a row.
        cells = 6
        settings = ("components.pore.storage=0.16666666666666666 1/Pa", f"mesh.cells=[1, {cells}]", "time.end=0.01 s", "time.step=0.01 s",
                    "time.smallest=0.009 s")
        truth = self.run_scene(TERZAGHI, *settings)
        for accelerator in ("over: [rock.displacement], iqn_ils: {filter_limit: 1e-12}", "over: [rock.displacement], iqn_imvj: {filter_limit: 1e-12}"):
            # n + 1 passes tell how the iteration answers; the next one is the answer.
            ours = self.run_scene(TERZAGHI, *settings, iterated(accelerator, DRAINED))
            self.assertLessEqual(self.passes(ours)[-1], cells + 2, accelerator)
            self.assertLess(self.difference(ours, truth), 1e-7, accelerator)

    def test_what_earlier_steps_teach_saves_passes(self):
        counts = {accelerator: sum(self.passes(self.run_scene(MANDEL, iterated(accelerator, DRAINED, 1e-10))))
                  for accelerator in ("", "anderson: 5", "iqn_ils: {reuse: 3}", "iqn_imvj: {}")}
        self.assertLess(counts["anderson: 5"], 0.6 * counts[""])
        self.assertLess(counts["iqn_ils: {reuse: 3}"], 0.8 * counts["anderson: 5"])
        self.assertLess(counts["iqn_imvj: {}"], 0.8 * counts["anderson: 5"])

    def test_a_restart_goes_on_to_the_bit(self):
        for accelerator in ("iqn_imvj: {rank: 5}", "iqn_ils: {reuse: 2}"):
            schedule = iterated(accelerator, DRAINED, 1e-6)
            whole = self.run_scene(MANDEL, schedule, "time.end=8632 s")
            parts = self.run_scene(MANDEL, schedule, "time.end=4316 s")
            parts = self.run_scene(MANDEL, schedule, "time.end=8632 s", restart=parts.folder)
            self.assert_same_bits(parts, whole)
            # What was learned counts: without it the run differs.
            alone = self.run_scene(MANDEL, iterated("iqn_ils: {}", DRAINED, 1e-6), "time.end=8632 s")
            self.assertFalse(np.array_equal(self.passes(alone), self.passes(whole)))

    @on_two_processes
    def test_two_processes_take_the_same_passes(self):
        for scene, steps, settings, accelerators in ((MANDEL, DRAINED, ("time.end=2158 s", "mesh.size=0.25 m"), (*ACCELERATORS[:6], OF_INTERFACE)),
                                                     (FRICTION, FIXED_STRESS, ("time.end=8 h", "mesh.size=1 m"), ACCELERATORS[2:6:3])):
            for accelerator in accelerators:
                with self.subTest(scene=scene.stem, accelerator=accelerator):
                    one, two = (self.run_scene(scene, *settings, iterated(accelerator, steps), processes=processes)
                                for processes in (1, 2))
                    self.assertEqual(self.passes(one), self.passes(two))
                    for column, values in one.history.items():
                        if "seconds" not in column and "error" not in column:
                            self.assertLess(abs(values - two.history[column]).max(), 1e-7 * max(abs(values).max(), 1e-12), column)

    def test_mistakes(self):
        for accelerator, words in (("aitken: {}, iqn_ils: {}", ("accelerate one iteration", "remove one")),
                                   ("over: [rock.displacment], aitken: {}", ("rock.displacement",)),
                                   ("over: [rock.displacement]", ("'over' has no effect",)),
                                   ("largest_step: 3", ("'largest_step' has no effect",)),
                                   ("iqn_imjv: {}", ("iqn_imvj",)),
                                   ("iqn_imvj: {rank: 0}", ("rank",)),
                                   ("constant: {}", ("factor",)),
                                   ("constant: {factor: 2}", ("factor",))):
            answer = self.call("check", MANDEL, iterated(accelerator, DRAINED))
            self.assertEqual(answer.returncode, 2, accelerator)
            for word in words:
                self.assertIn(word, answer.stderr, accelerator)


if __name__ == "__main__":
    unittest.main()
