#!/usr/bin/python3
"""grown_schemes_test.py SPREKK: growth within steps to the twelfth hour of section 5.2 of the paper, and a wing that joins another fracture, in
three schemes: monolithic, flow and rock in turn with fixed stress, and fractures apart from the rock with its response. Times, lengths and pressures
are those of the monolithic scheme."""

import unittest

from scene_runs import ROOT, SceneRuns
from wings import SCENE, VALUES_OF_PAPER

IN_TURN = "{{iterate: {{fallback: none, until: {{relative: 1e-10, at_most: 100}}, {}steps: [{}]}}}}"
SCHEMES = {
    "fixed stress": IN_TURN.format("accelerate: {anderson: 5}, ", "{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}"),
    "fractures apart": IN_TURN.format("", "{solve: [pore, rock]}, {solve: [conduit, contact], stabilize: response}"),
}
GROW = "{grow: tips, settle: [rock, contact]"
LENGTHS = ("tips.main_first.length", "tips.main_last.length")
# The wing of a fracture with given fluid pressure grows to another fracture in its way, and joins it (tests/verification/joining_test.cpp), in rock
# with fluid in its pores.
JOINING = ROOT / "tests/verification/scenes/joining.yaml"
WITH_PORES = """
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-19 m^2, viscosity: 1e-4 Pa*s, storage: 1e-11 1/Pa}
  tips: {type: fine_fracture/quarter_point, size: 0.3 m, toughness: 0.7 MPa*m^0.5, growth: {increment: 10 mm}, meeting: join}
couplers:
  - {type: biot, between: [pore, rock], biot_coefficient: 0.8}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
  - {type: two_level, between: [rock, conduit, tips, contact]}
schedule: [{solve: [pore, rock, conduit, contact]}, {grow: tips, settle: [rock, contact], update: after_step}]
time: {stop: {of: tips.main_last.stopped, reaches: 1 1}}
output: {fields: false}
"""


class GrownSchemes(SceneRuns):
    timeout = 600

    def test_section_5_2_of_the_paper(self):
        settings = (*VALUES_OF_PAPER, "time.end=12 h", "output.fields=false")
        truth = self.run_scene(SCENE, *settings)
        for length in LENGTHS:
            self.assertGreater(truth.rows[-1][length], 0.02)
        for name, scheme in SCHEMES.items():
            ours = self.run_scene(SCENE, *settings, f"schedule=[{scheme}, {GROW}, update: within_step}}]")
            self.assertEqual(len(ours.rows), len(truth.rows))
            worst = {"time": 0, "length": 0, "pressure": 0}
            for one, other in zip(truth.rows, ours.rows):
                for word, columns in (("time", ("time",)), ("length", LENGTHS), ("pressure", ("fracture_pressure",))):
                    scale = max(abs(truth.rows[-1][column]) for column in columns)
                    worst[word] = max(worst[word], *(abs(one[column] - other[column]) / scale for column in columns))
            print(f"    {name}: {max(ours['iterations[1]']):.0f} passes at most; differences {worst}", flush=True)
            # The front is found to 1e-7 in K_eq.
            for word, difference in worst.items():
                self.assertLess(difference, 1e-6, (name, word))

    def test_a_wing_that_joins(self):
        scene = [JOINING, self.write(WITH_PORES)]
        truth = self.run_scene(scene)
        self.assertEqual(truth.rows[-1]["tips.main_last.stopped"], 1)
        self.assertAlmostEqual(truth.rows[-1]["tips.main_last.length"], 0.065, delta=0.002)
        for name, scheme in SCHEMES.items():
            # In the steps of 2 s in which the wing grows, 1e-10 of the largest terms leaves 2e-6 of K.
            scheme = scheme.replace("1e-10", "1e-12")
            ours = self.run_scene(scene, f"schedule=[{scheme}, {GROW}, update: after_step}}]")
            joined = [next(row["time"] for row in run.rows if row["tips.main_last.stopped"]) for run in (truth, ours)]
            apart = [abs(ours.rows[-1][column] / truth.rows[-1][column] - 1) for column in ("tips.main_last.length", "tips.main_last.K_I")]
            print(f"    {name}: joined at {joined} s, differences {apart}", flush=True)
            self.assertAlmostEqual(joined[1] / joined[0], 1, delta=1e-6)
            self.assertLess(max(apart), 1e-6)


if __name__ == "__main__":
    unittest.main()
