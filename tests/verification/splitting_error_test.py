#!/usr/bin/python3
"""splitting_error_test.py SPREKK: a schedule that solves in turn without iterating tells its error. The truth is the monolithic run of the
same scene: without friction the estimate is within a factor of two of the error in every field, with friction at least half of it. It
changes nothing else, can be turned off, goes on after a restart, and is zero where solving in turn is exact."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402  pylint: disable=wrong-import-position

TERZAGHI, MANDEL = ROOT / "configs/verification/terzaghi.yaml", ROOT / "configs/verification/mandel.yaml"
FRICTION = ROOT / "configs/tutorial/first_scene.yaml"
FLOW_FIRST, ROCK_FIRST, TOGETHER = "[{solve: pore}, {solve: rock}]", "[{solve: rock}, {solve: pore}]", "[{solve: [pore, rock]}]"
IN_TURN = "[{solve: [pore, conduit]}, {solve: [rock, contact]}]"


class SplittingError(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def run_scene(self, name, scene, *settings, restart=False):
        where = ["--restart", self.folder / name / "checkpoint.h5"] if restart else ["-o", self.folder / name]
        scenes = scene if isinstance(scene, list) else [scene]
        run = subprocess.run([SPREKK, "run", "-q", *scenes, *where, *(word for setting in settings for word in ("--set", setting))],
                             capture_output=True, text=True, timeout=100)
        self.assertEqual(run.returncode, 0, run.stderr)
        return sprekk.Results(self.folder / name), run.stderr

    def errors(self, scene, split, *settings):
        """Of the fields that are written: the estimate and the true error, over the largest value."""
        turn, _ = self.run_scene("turn", scene, f"schedule={split}", *settings)
        truth, _ = self.run_scene("truth", scene, *settings)
        self.assertNotIn("splitting_error[1]", truth.history)
        found = {}
        for key, estimate in turn.record["results"].items():
            name = key.removeprefix("splitting_error of ").removesuffix("[1]")
            for kind in ("matrix", "fractures") if key.startswith("splitting_error of ") else ():
                if kind not in turn_kinds(turn) or name not in turn.fields(kind=kind).names:
                    continue
                ours, right = turn.fields(kind=kind)[name], truth.fields(kind=kind)[name]
                found[name] = (estimate, abs(ours - right).max() / max(abs(ours).max(), abs(right).max()))
        self.assertGreaterEqual(turn["splitting_error"][-1], max(estimate for estimate, _ in found.values()))
        for folder in ("turn", "truth"):
            subprocess.run(["rm", "-r", self.folder / folder], check=True)
        return found

    def test_without_friction_within_a_factor_of_two(self):
        cases = [(TERZAGHI, FLOW_FIRST, "time.step=0.005 s", f"time.end={end} s", f"components.pore.storage={storage} 1/Pa")
                 for storage in (4, 0.6) for end in (0.005, 0.02, 0.1)]
        cases += [(MANDEL, order, f"time.end={end} s") for order in (FLOW_FIRST, ROCK_FIRST) for end in (1079, 3237, 10790)]
        for scene, split, *settings in cases:
            with self.subTest(scene=scene.stem, split=split, settings=settings):
                found = self.errors(scene, split, *settings)
                self.assertEqual(set(found), {"pore.pressure", "rock.displacement"})
                for name, (estimate, error) in found.items():
                    self.assertLess(estimate, 2 * error, name)
                    self.assertGreater(estimate, error / 2, name)

    def test_with_friction_at_least_half(self):
        for settings in ([], ["time.step=2 h"], ["materials.friction=0.4"]):
            with self.subTest(settings=settings):
                found = self.errors(FRICTION, IN_TURN, *settings)
                for name in ("pore.pressure", "rock.displacement", "conduit.aperture"):
                    estimate, error = found[name]
                    self.assertGreater(estimate, error / 2, name)
                    self.assertLess(estimate, 2 * error, name)

    def turned(self, scene, angle, *settings, mirror=False):
        """The files of the same scene, turned by an angle (degrees) after left and right have changed places, with `mirror`."""
        folder = self.folder / f"turned_{angle}"
        done = subprocess.run([ROOT / "tools/turn_scene", scene, folder, "--angle", str(angle), "--program", SPREKK,
                               *(["--mirror"] if mirror else []),
                               *(word for setting in settings for word in ("--set", setting))], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [scene, folder / "turned.yaml"]

    def test_turned_and_mirrored(self):
        # A plate that moves by half a millimetre in the place of that of Mandel's solution, whose table cannot be turned.
        block = ("mesh.size=0.1 m", "components.rock.boundary.top.displacement_y=-0.5 mm")
        rock_first = "[{solve: [rock, contact]}, {solve: [pore, conduit]}]"
        fracture = ("mesh={size: 1 m, fracture_size: 0.25 m}",)
        for angle, mirror in ((30, False), (-75, True)):
            for scene, settings, splits, more in ((MANDEL, block, (FLOW_FIRST, ROCK_FIRST), ("time.end=1079 s",)),
                                                  (FRICTION, fracture, (IN_TURN, rock_first), ("materials.friction=5",)),  # sticks
                                                  (FRICTION, fracture, (IN_TURN,), ())):
                files = self.turned(scene, angle, *settings, mirror=mirror)
                for split in splits:
                    with self.subTest(scene=scene.stem, angle=angle, split=split, settings=more):
                        found = self.errors(files, split, *more)
                        self.assertIn("pore.pressure", found)
                        for name, (estimate, error) in found.items():
                            print(f"    {scene.stem}, {angle} degrees, {split} {more}: {name} {estimate:.2g}, true {error:.2g}", flush=True)
                            self.assertGreater(estimate, error / 2, name)
                            if more:  # without friction that slips
                                self.assertLess(estimate, 2 * error, name)

    def test_slip_is_told(self):
        turn, said = self.run_scene("turn", FRICTION, f"schedule={IN_TURN}")
        truth, _ = self.run_scene("truth", FRICTION)
        error = abs(turn["slip.t"][-1] - truth["slip.t"][-1]) / abs(turn["slip.t"][-1])
        self.assertGreater(error, 0.3)
        self.assertGreater(turn.record["results"]["splitting_error of contact.jump[1]"], error / 2)
        self.assertIn("note: solving in turn without iterating has an error", said)
        self.assertIn("splitting error", [note["topic"] for note in turn.record["notes"]])

    def test_the_answer_has_the_same_bits(self):
        told, _ = self.run_scene("told", FRICTION, f"schedule={IN_TURN}", "time.end=1 day")
        quiet, said = self.run_scene("quiet", FRICTION, f"schedule={IN_TURN}", "time.end=1 day", "output.splitting_error=false")
        self.assertNotIn("without iterating", said)
        self.assertEqual(set(told.history) - set(quiet.history), {"splitting_error[1]", "coupled_residual[1]"})
        for column, values in quiet.history.items():
            self.assertTrue(np.array_equal(values, told.history[column]), column)

    def test_goes_on_after_a_restart(self):
        whole, _ = self.run_scene("whole", FRICTION, f"schedule={IN_TURN}", "time.end=1 day")
        self.run_scene("parts", FRICTION, f"schedule={IN_TURN}", "time.end=8 h")
        parts, _ = self.run_scene("parts", FRICTION, f"schedule={IN_TURN}", "time.end=1 day", restart=True)
        self.assertEqual(len(parts.times), 6)
        for column in ("splitting_error[1]", "coupled_residual[1]", "slip.t[m]"):
            self.assertTrue(np.array_equal(whole.history[column], parts.history[column]), column)

    def test_exact_where_nothing_comes_back(self):
        # The flow does not feel the rock: solving the flow first is exact.
        run, said = self.run_scene("one_way", MANDEL, f"schedule={FLOW_FIRST}", "materials.biot_coefficient=0")
        self.assertEqual(max(run["splitting_error"]), 0)
        self.assertNotIn("without iterating", said)

    def test_iterated_systems_have_no_columns(self):
        run, said = self.run_scene("iterated", MANDEL, f"schedule=[{{iterate: {{fallback: none, steps: {FLOW_FIRST}}}}}]", "time.end=1079 s")
        self.assertNotIn("splitting_error[1]", run.history)
        self.assertNotIn("without iterating", said)


def turn_kinds(run):
    return [kind for kind in ("matrix", "fractures") if any(run.folder.glob(f"{kind}_*.vtu"))]


if __name__ == "__main__":
    unittest.main()
