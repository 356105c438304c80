"""What tests of whole scenes share: the program, a folder, runs and their results.

Such a test is called as TEST SPREKK [MPIEXEC] [words for unittest]."""

import itertools
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402  pylint: disable=wrong-import-position

SPREKK = Path(sys.argv.pop(1)).resolve()
MPIEXEC = sys.argv.pop(1) if sys.argv[1:] and Path(sys.argv[1]).is_absolute() else shutil.which("mpirun")
on_two_processes = unittest.skipUnless(MPIEXEC, "no mpirun")  # of tests that need it


class SceneRuns(unittest.TestCase):
    """`folder` is one of this class of tests, and goes with it."""

    timeout = 200  # s, of one call of the program

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        cls.numbers = itertools.count(1)  # of runs

    @classmethod
    def write(cls, text, name="scene.yaml"):
        """The path of a file of this text in the folder."""
        (cls.folder / name).write_text(text)
        return cls.folder / name

    @classmethod
    def command(cls, words, scenes, *settings, processes=1):
        """[mpirun -n N] sprekk WORDS SCENES --set SETTING …; `words` and `scenes` are one or several."""
        words, scenes = (many if isinstance(many, (list, tuple)) else [many] for many in (words, scenes))
        return [*([MPIEXEC, "-n", str(processes)] if processes > 1 else ()), SPREKK, *words, *scenes,
                *(word for setting in settings for word in ("--set", setting))]

    @classmethod
    def call(cls, words, scenes, *settings, processes=1):
        """What such a command says (its attributes returncode, stdout, stderr)."""
        return subprocess.run(cls.command(words, scenes, *settings, processes=processes), capture_output=True, text=True,
                              timeout=cls.timeout, cwd=cls.folder, check=False)

    @classmethod
    def run_scene(cls, scenes, *settings, restart=None, processes=1):
        """The results (sprekk.Results) of a run that succeeds, in a folder of its own; or in the folder `restart`, where it goes on."""
        folder = restart or cls.folder / str(next(cls.numbers))
        words = ["run", "-q", *(("--restart", folder / "checkpoint.h5") if restart else ("-o", folder))]
        run = cls.call(words, scenes, *settings, processes=processes)
        if run.returncode:
            raise AssertionError(f"exit code {run.returncode}: {run.stderr}")
        return sprekk.Results(folder)

    @classmethod
    def turned(cls, scene, angle, *settings, mirror=False):
        """The files that make of the scene (a path) the same scene, turned by an angle (degrees; tools/turn_scene), with `mirror` after
        left and right have changed places."""
        folder = cls.folder / f"turned_{next(cls.numbers)}"
        done = subprocess.run([ROOT / "tools/turn_scene", scene, folder, "--angle", str(angle), "--program", SPREKK, *(["--mirror"] if mirror else []),
                               *(word for setting in settings for word in ("--set", setting))], capture_output=True, text=True, check=False)
        if done.returncode:
            raise AssertionError(f"tools/turn_scene: {done.stderr}")
        return [scene, folder / "turned.yaml"]

    @staticmethod
    def largest_difference(ours, other, columns=None):
        """Of two histories, in the largest value of each column; of all columns but those of errors, iterations and seconds."""
        worst = 0
        for column in columns or other.history:
            if columns is None and any(word in column for word in ("error", "iterations", "seconds")):
                continue
            one, two = ours.history[column], other.history[column]
            if len(one) != len(two):
                raise AssertionError(f"{len(one)} and {len(two)} steps")
            scale = max(np.abs(two).max(), 1e-30)
            worst = max(worst, np.abs(one - two).max() / scale)
        return worst

    def assert_same_bits(self, ours, other):
        """All columns of two histories but those of seconds taken."""
        self.assertEqual(len(ours.times), len(other.times))
        for column, values in other.history.items():
            if "seconds" not in column:
                self.assertTrue(np.array_equal(values, ours.history[column], equal_nan=True), column)
