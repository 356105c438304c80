#!/usr/bin/env python3
"""restart_test.py SPREKK MPIEXEC: runs that go on from a checkpoint, whose factors were renewed in the step before it, and one of whose processes
was killed.

A step that ends at an output is shorter than the others, so the bulk is factorized anew just before the checkpoint; the run that goes on has no
factors, the one that was not interrupted has those of both steps. On one process they agree to the bit. On several, MUMPS adds up what processes send in
the order of its arrival: a run then repeats itself to the tolerance of the solver."""

import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "verification"))
from scene_runs import ROOT, SceneRuns, on_two_processes  # noqa: E402  pylint: disable=wrong-import-position

SCENE = ROOT / "configs/tutorial/first_scene.yaml"
SHORT_STEP = "9 h"  # after two steps of 4 h
SETTINGS = ("output.fields=false", f"output.times=[{SHORT_STEP}]")


class Restarts(SceneRuns):
    def interrupted(self, *settings, processes=1, on=None):
        """A run up to the short step on `processes`, which goes on on `on`."""
        first = self.run_scene(SCENE, *SETTINGS, *settings, f"time.end={SHORT_STEP}", processes=processes)
        return self.run_scene(SCENE, *SETTINGS, *settings, "time.end=1 day", restart=first.folder, processes=on or processes)

    def whole(self, *settings, processes=1):
        return self.run_scene(SCENE, *SETTINGS, *settings, "time.end=1 day", processes=processes)

    def test_one_process_repeats_its_bits(self):
        for settings in ((), ("solver.type=mumps",), ("solver.condense=false",)):
            with self.subTest(settings):
                whole = self.whole(*settings)
                self.assertTrue(any(abs(t - 9 * 3600) < 1 for t in whole.times), whole.times)
                self.assert_same_bits(self.interrupted(*settings), whole)

    @on_two_processes
    def test_two_processes_repeat_themselves_to_the_tolerance_of_the_solver(self):
        whole = self.whole(processes=2)
        self.assertLess(self.largest_difference(self.interrupted(processes=2), whole), 1e-7)

    @on_two_processes
    def test_fewer_processes_go_on(self):
        self.assertLess(self.largest_difference(self.interrupted(processes=2, on=1), self.whole()), 1e-7)


def processes_of(folder):
    """The numbers of the processes of `sprekk` that write to a folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if Path(os.fsdecode(words[0])).name.startswith("sprekk") and os.fsencode(folder) in words:
            found.append(int(entry.name))
    return found


class KilledProcess(SceneRuns):
    @on_two_processes
    def test_ends_the_run_and_leaves_a_whole_checkpoint(self):
        folder = self.folder / "killed"
        settings = ("output.fields=false", "output.checkpoint_every=0.01 s", "time.step=1 min", "time.end=1 h")
        command = self.command(["run", "-q", "-o", folder], SCENE, *settings, processes=2)
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=self.folder) as run:
            started = time.monotonic()
            while not (folder / "checkpoint.h5").exists() or len(processes_of(folder)) < 2:
                self.assertIsNone(run.poll(), "the run ended before it could be killed")
                self.assertLess(time.monotonic() - started, self.timeout)
                time.sleep(0.05)
            os.kill(max(processes_of(folder)), signal.SIGKILL)
            _, said = run.communicate(timeout=self.timeout)
            self.assertNotEqual(run.returncode, 0)
            self.assertIn("signal 9", said)
        self.assertEqual(processes_of(folder), [])
        went_on, whole = self.run_scene(SCENE, *settings, restart=folder), self.run_scene(SCENE, *settings)
        self.assertEqual(len(went_on.times), len(whole.times))
        self.assertLess(self.largest_difference(went_on, whole), 1e-7)


if __name__ == "__main__":
    unittest.main()
