#!/usr/bin/python3
"""split_fractures_test.py SPREKK: contact apart from rock, and the flow in fractures apart from that in rock or from their opening. With the
Schur complement of waiting unknowns such splits reach the monolithic answer in few passes, whatever the number of cells, and count all fluid."""

import math
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns, on_two_processes

PAPER, NETWORK = ROOT / "configs/paper/onset_coarse.yaml", ROOT / "configs/verification/regular_network.yaml"
SPLITS = (
    "{solve: [pore, rock, conduit]}, {solve: contact, stabilize: response}",
    "{solve: contact, stabilize: response}, {solve: [pore, rock, conduit]}",
    "{solve: [pore, rock, contact]}, {solve: conduit, stabilize: response}",
    "{solve: conduit, stabilize: response}, {solve: [pore, rock, contact]}",
    "{solve: [pore, rock]}, {solve: [conduit, contact], stabilize: response}",
    "{solve: [pore, rock]}, {solve: conduit, stabilize: response}, {solve: contact, stabilize: response}",
    "{solve: [pore, conduit], stabilize: fixed_stress}, {solve: rock}, {solve: contact, stabilize: response}",
    "{solve: pore, stabilize: fixed_stress}, {solve: [rock, contact]}, {solve: conduit, stabilize: response}",
    "{solve: pore, stabilize: fixed_stress}, {solve: rock}, {solve: conduit, stabilize: response}, {solve: contact, stabilize: response}",
)
# The rock is solved with the flow in fractures, apart from the flow in the rock: contact waits with nothing that it could answer by.
OF_ROCK_AND_FLUID = (
    "{solve: pore, stabilize: fixed_stress}, {solve: [rock, conduit], stabilize: response}, {solve: contact, stabilize: response}",
    "{solve: pore, stabilize: fixed_stress}, {solve: contact, stabilize: response}, {solve: [rock, conduit], stabilize: response}",
    "{solve: pore, stabilize: fixed_stress}, {solve: [rock, contact, conduit], stabilize: response}",
)
# A crack in rock that lets no fluid in, which fluid opens.
CRACK = """
name: crack
geometry:
  box: {{x: [-20, 20], y: [-20, 20]}}
  fractures: {{main: {{points: [[{x0!r}, {y0!r}], [{x1!r}, {y1!r}]]}}}}
mesh: {{size: 6, fracture_size: {size!r}, growth: 0.3}}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 30 GPa
    poisson_ratio: 0.25
    boundary: {{left: {{displacement_x: 0}}, bottom: {{displacement_y: 0}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.1 mm
    injection: {{well: {{fracture: main, rate: 1e-6 m^2/s}}}}
  contact: {{type: contact/coulomb, friction: 0.5}}
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [rock, conduit, contact]}}]
time: {{end: 20 s, step: 10 s}}
"""
SPLITS_OF_CRACK = (
    "{solve: [rock, contact]}, {solve: conduit, stabilize: response}",
    "{solve: conduit, stabilize: response}, {solve: [rock, contact]}",
    "{solve: rock}, {solve: [conduit, contact], stabilize: response}",
    "{solve: rock}, {solve: conduit, stabilize: response}, {solve: contact, stabilize: response}",
)


def iterated(steps):
    return f"schedule=[{{iterate: {{fallback: none, until: {{relative: 1e-10, at_most: 60}}, steps: [{steps}]}}}}]"


class SplitFractures(SceneRuns):
    def run_checked(self, scene, *settings, processes=1):
        results = self.run_scene(scene, *settings, processes=processes)
        self.assertFalse([note for note in results.record["notes"] if "the balance of" in note["text"]])
        return results

    def expect_same(self, ours, truth):
        """Fields at the end, over the largest value of any field of their unit."""
        self.assertEqual(len(ours.rows), len(truth.rows))  # none was cut
        right = {kind: truth.fields(kind=kind) for kind in ("matrix", "fractures") if any(truth.folder.glob(f"{kind}_*.vtu"))}
        names = [(kind, name) for kind, fields in right.items() for name in fields.names
                 if "." in name and np.issubdtype(np.asarray(fields[name]).dtype, np.floating)]

        def unit(name):
            for unit, words in (("Pa", ("traction", "pressure")), ("m", ("jump", "displacement", "aperture"))):
                if any(word in name for word in words):
                    return unit
            return name

        scale = {}
        for kind, name in names:
            scale[unit(name)] = max(scale.get(unit(name), 0), abs(right[kind][name]).max())
        for kind, name in names:
            found = ours.fields(kind=kind)[name]
            self.assertLessEqual(abs(found - right[kind][name]).max(), 1e-7 * scale[unit(name)], name)

    def expect_passes(self, run, at_most):
        passes = [int(value) for value in run["iterations[1]"]]
        print(f"    {passes}", flush=True)
        self.assertLessEqual(max(passes), at_most)

    def test_section_5_1_of_the_paper(self):
        # Loading makes the walls slip, and two hours of injection make them slip on.
        for cells, at_most, splits in ((20, 30, SPLITS + OF_ROCK_AND_FLUID), (80, 45, SPLITS[1::2] + OF_ROCK_AND_FLUID)):
            settings = (f"mesh={{size: 0.3 m, fracture_size: {0.1 / cells!r} m, growth: 0.35}}", "time.end=8 h")
            for perturbed in (0, 1e-9) if cells == 20 else (0,):
                load = (f"components.rock.boundary.right.normal_stress={-20e6 * (1 + perturbed)!r} Pa",)
                truth = self.run_checked(PAPER, *settings, *load)
                self.assertGreater(truth.rows[-1]["contact.cells_slip"], cells / 2)
                for split in splits:
                    with self.subTest(cells=cells, split=split, perturbed=perturbed):
                        print(f"\n  {cells} cells: {split}", flush=True)
                        ours = self.run_checked(PAPER, *settings, *load, iterated(split))
                        self.expect_passes(ours, at_most)
                        self.expect_same(ours, truth)

    def test_a_crack_that_fluid_opens(self):
        for cells, at_most, angle in ((20, 30, 0.0), (20, 30, 0.7), (80, 45, 0.0)):
            x, y = math.cos(angle), math.sin(angle)
            scene = self.write(CRACK.format(x0=-x, y0=-y, x1=x, y1=y, size=2 / cells))
            truth = self.run_checked(scene)
            self.assertEqual(truth.rows[-1]["contact.cells_open"], cells)
            for split in SPLITS_OF_CRACK:
                with self.subTest(cells=cells, angle=angle, split=split):
                    print(f"\n  crack, {cells} cells, {angle}: {split}", flush=True)
                    ours = self.run_checked(scene, iterated(split))
                    self.expect_passes(ours, at_most)
                    self.expect_same(ours, truth)

    def test_a_network(self):
        truth = self.run_checked(NETWORK, "mesh.size=0.08 m")
        for split in ("{solve: pore}, {solve: conduit, stabilize: response}", "{solve: conduit, stabilize: response}, {solve: pore}"):
            # Everything is linear: the first pass finds the answer, the second one sees it.
            ours = self.run_checked(NETWORK, "mesh.size=0.08 m", iterated(split))
            self.expect_passes(ours, 3)
            self.expect_same(ours, truth)

    @on_two_processes
    def test_on_two_processes(self):
        for split in (SPLITS[5], OF_ROCK_AND_FLUID[0]):
            settings = ("mesh={size: 0.3 m, fracture_size: 0.01 m, growth: 0.35}", "time.end=8 h", iterated(split))
            one, two = self.run_checked(PAPER, *settings), self.run_checked(PAPER, *settings, processes=2)
            self.expect_same(two, one)

    def test_what_has_no_effect_is_refused(self):
        for steps, said in (("{solve: [pore, conduit]}, {solve: rock}, {solve: contact}", "'stabilize: response'"),
                            ("{solve: [pore, rock, conduit], stabilize: response}, {solve: contact, stabilize: response}", "'contact' waits alone, and has no answer"),
                            ("{solve: [rock, contact]}, {solve: [pore, conduit], stabilize: respond}", "response"),
                            ("{solve: [pore, rock, conduit, contact], stabilize: response}", "none waits")):
            run = self.call("check", PAPER, iterated(steps))
            self.assertEqual(run.returncode, 2, steps)
            self.assertIn(said, run.stderr)
        apart = "schedule=[{iterate: {fallback: none, steps: [{solve: [pore, conduit]}, {solve: contact, stabilize: response}]}}, {solve: rock}]"
        self.assertIn("let the same 'iterate' solve for both", self.call("check", PAPER, apart).stderr)
        run = self.call("check", NETWORK, "schedule=[{solve: pore}, {solve: conduit, stabilize: response}]")
        self.assertIn("'stabilize' stands outside of an 'iterate'", run.stderr)


if __name__ == "__main__":
    unittest.main()
