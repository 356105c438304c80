#!/usr/bin/python3
"""undrained_split_test.py SPREKK: the undrained split, and answers of fixed stress with the modulus that passes show. Rock that is solved for with the mass of fluid in its cells held, then the flow. An irrotational mode of the
wave number q contracts by alpha^2 D/((S + D)(S M_v + alpha^2)) with D = (k/mu) dt q^2 (Kim, Tchelepi and Juanes 2011), below 1 for any
storage; the answer is the monolithic one."""

import csv
import math
import unittest

from scene_runs import ROOT, SceneRuns, on_two_processes

TERZAGHI, MANDEL, PAPER = (ROOT / f"configs/{name}.yaml" for name in ("verification/terzaghi", "verification/mandel", "paper/onset_coarse"))
P_WAVE, ALPHA, STEP = 2.0, 1.0, 0.01  # of Terzaghi's scene
UNDRAINED = "{solve: rock, stabilize: undrained}, {solve: pore}"
SMALL_MANDEL = ("mesh.size=0.1 m", "time.end=4316 s")
SMALL_PAPER = ("mesh={size: 0.3 m, fracture_size: 0.005 m, growth: 0.35}", "time.end=6 h")


def iterated(steps, until=1e-10, options=""):
    return f"schedule=[{{iterate: {{fallback: none, until: {{relative: {until}, at_most: 100}}, {options}steps: [{steps}]}}}}]"


class UndrainedSplit(SceneRuns):
    def changes(self, run):
        """By the passes of the first step."""
        with open(run.folder / "coupling.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["schedule"] == "iterate"]
        passes = []
        for row in rows:
            if row["iteration[1]"] == "1" and passes:
                break
            passes.append(float(row["update[1]"]))
        return passes[1:]

    def expect_same(self, ours, truth, at_most=1e-7):
        self.assertEqual(len(ours.rows), len(truth.rows))
        for kind in ("matrix", "fractures") if any(truth.folder.glob("fractures_*.vtu")) else ("matrix",):
            found, right = ours.fields(kind=kind), truth.fields(kind=kind)
            for name in right.names:
                if name in ("pore.pressure", "rock.displacement", "conduit.pressure", "contact.jump", "rock.wall_traction"):
                    self.assertLessEqual(abs(found[name] - right[name]).max(), at_most * abs(right[name]).max(), name)

    def test_smooth_modes_contract_at_the_rate_of_theory(self):
        # The initial pressure is the mode, so errors are: it flows out at the bottom, and nothing else loads the rock.
        for rock in ("mpsa", "fem"):
            for quarter_waves, mobility, storage in ((1, 20.0, 0.5), (1, 20.0, 0.05), (3, 10.0, 0.5)):
                q = quarter_waves * math.pi / 2
                moved = mobility * STEP * q ** 2
                rate = ALPHA ** 2 * moved / ((storage + moved) * (storage * P_WAVE + ALPHA ** 2))
                run = self.run_scene(
                    TERZAGHI, f"components.rock.type=poromechanics/{rock}", f"components.pore.initial_pressure='(sin({q!r}*y)) Pa'",
                    f"components.pore.storage={storage} 1/Pa", f"components.pore.permeability={mobility} m^2", "mesh.cells=[2, 80]",
                    "components.rock.boundary.bottom.normal_stress=0 Pa", f"time.end={STEP} s", iterated(UNDRAINED, 1e-3))
                changes = self.changes(run)
                factors = [after / before for before, after in zip(changes, changes[1:])][1:4]
                print(f"    {rock}, q = {q:.2f}, S = {storage}: {[f'{factor:.4f}' for factor in factors]}, theory {rate:.4f}", flush=True)
                for factor in factors:
                    self.assertAlmostEqual(factor / rate, 1, delta=0.02)

    def test_it_converges_where_the_drained_split_diverges(self):
        # alpha^2/(S M_v) = 1.3 and 50; the undrained factor is below 1/(1 + S M_v/alpha^2) = 0.57 and 0.98.
        for factor in (1.3, 50.0):
            storage = f"components.pore.storage={0.5 / factor!r} 1/Pa"
            truth = self.run_scene(TERZAGHI, storage)
            ours = self.run_scene(TERZAGHI, storage, iterated(UNDRAINED, options="accelerate: {anderson: 10}, " if factor > 2 else ""))
            self.expect_same(ours, truth)

    def test_answers_are_the_monolithic_ones(self):
        for scene, settings, steps in ((TERZAGHI, (), UNDRAINED), (MANDEL, SMALL_MANDEL, UNDRAINED),
                                       (MANDEL, SMALL_MANDEL, "{solve: pore}, {solve: rock, stabilize: undrained}"),
                                       (PAPER, SMALL_PAPER, "{solve: [rock, contact], stabilize: undrained}, {solve: [pore, conduit]}")):
            truth, ours = self.run_scene(scene, *settings), self.run_scene(scene, *settings, iterated(steps))
            print(f"    {scene.stem}: {[int(value) for value in ours['iterations[1]']]} passes", flush=True)
            self.expect_same(ours, truth)

    def test_answers_with_the_modulus_that_passes_show(self):
        flow_first, found = "{{solve: {}, stabilize: fixed_stress}}, {{solve: {}}}", "couplers.0.fixed_stress_modulus=found"
        for scene, settings, groups in ((TERZAGHI, (), ("pore", "rock")), (MANDEL, SMALL_MANDEL, ("pore", "rock")),
                                        (PAPER, SMALL_PAPER, ("[pore, conduit]", "[rock, contact]"))):
            truth = self.run_scene(scene, *settings)
            ours = self.run_scene(scene, *settings, found, iterated(flow_first.format(*groups)))
            print(f"    found, {scene.stem}: {[int(value) for value in ours['iterations[1]']]} passes", flush=True)
            self.expect_same(ours, truth)

    @on_two_processes
    def test_on_two_processes(self):
        one, two = (self.run_scene(MANDEL, *SMALL_MANDEL, iterated(UNDRAINED), processes=count) for count in (1, 2))
        self.expect_same(two, one, 1e-8)
        for ours, other in zip(two["iterations[1]"], one["iterations[1]"]):
            self.assertLessEqual(abs(ours - other), 1)

    @on_two_processes
    def test_the_modulus_found_on_two_processes(self):
        split, found = "{{solve: {}, stabilize: fixed_stress}}, {{solve: {}}}", "couplers.0.fixed_stress_modulus=found"
        for scene, settings, groups in ((TERZAGHI, (), ("pore", "rock")), (MANDEL, SMALL_MANDEL, ("pore", "rock")),
                                        (PAPER, SMALL_PAPER, ("[pore, conduit]", "[rock, contact]"))):
            one, two = (self.run_scene(scene, *settings, found, iterated(split.format(*groups)), processes=count) for count in (1, 2))
            self.expect_same(two, one, 1e-8)
            # What passes show is found of both processes' cells: with half of them the factor would be another one, and so would passes.
            passes = [[int(value) for value in run["iterations[1]"]] for run in (one, two)]
            print(f"    found, {scene.stem}: {passes}", flush=True)
            for ours, other in zip(*passes):
                self.assertLessEqual(abs(ours - other), 1)
            changes = [self.changes(run) for run in (one, two)]
            for ours, other in zip(*(run[:4] for run in changes)):
                self.assertAlmostEqual(other / ours, 1, delta=1e-4)

    def test_mistakes(self):
        for settings, said in ((("components.pore.storage=0 1/Pa", iterated(UNDRAINED)), "'stabilize: undrained' needs fluid that is stored"),
                               ((iterated("{solve: pore, stabilize: undrained}, {solve: rock}"),), "'stabilize: undrained' has no effect here"),
                               (("schedule=[{solve: rock, stabilize: undrained}, {solve: pore}]",), "'stabilize' stands outside of an 'iterate'")):
            run = self.call("check", TERZAGHI, *settings)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(said, run.stderr)


if __name__ == "__main__":
    unittest.main()
