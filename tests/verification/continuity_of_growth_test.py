#!/usr/bin/python3
"""continuity_of_growth_test.py SPREKK MPIEXEC: while growth is stable, lengths, pressures and times are continuous in what
a scene prescribes. Wings that grow within steps are the same after another last digit of the injection rate, with another
direct solver, another residual of Newton's method, and on two processes; and every mesh has the same topology."""

import unittest
from concurrent.futures import ThreadPoolExecutor

from scene_runs import SceneRuns
from wings import SCENE, WITHIN_STEPS

RATE = 5.0e-9  # m^2/s
OVERLAY = WITHIN_STEPS + """
mesh: {size: 0.4 m, fracture_size: 20 mm, growth: 0.5}
components: {tips: {size: 0.5 m, growth: {increment: 10 mm, front_tolerance: 1e-7}}}
time: {end: 5 h, step: 1 h}
output: {fields: false}
"""


def rate(factor):
    return f"components.conduit.injection.well.rate.value={RATE * factor!r} m^2/s"


RUNS = {
    "as it is": ([], 1),
    "rate 1e-9": ([rate(1 + 1e-9)], 1),
    "rate 1e-7": ([rate(1 + 1e-7)], 1),
    "UMFPACK": (["solver.type=umfpack"], 1),
    "residual 1e-8": (["newton.residual=1e-8"], 1),
    "two processes": ([], 2),
}
LARGEST = {"rate 1e-9": 1e-6}  # of lengths and pressures; 1e-5 for all others


class ContinuityOfGrowth(SceneRuns):
    timeout = 300

    def test_neighbours_of_a_scene(self):
        self.write(OVERLAY, "within.yaml")
        with ThreadPoolExecutor(2) as pool:
            answers = dict(zip(RUNS, pool.map(self.answer, RUNS)))
        rows, meshes = answers["as it is"]
        grown = rows[-1]["tips.main_last.length"]
        self.assertGreater(grown, 0.015)  # m, several increments and changes of the mesh
        self.assertGreater(len(meshes), 6)
        for name, (others, other_meshes) in answers.items():
            with self.subTest(name):
                self.assertEqual(len(others), len(rows))
                self.assertEqual([m["hash"] for m in other_meshes], [m["hash"] for m in meshes])
                for row, other in zip(rows, others):
                    for column in ("time", "tips.main_first.length", "tips.main_last.length", "fracture_pressure"):
                        self.assertAlmostEqual(other[column] / max(row[column], 1e-30), 1 if row[column] else 0,
                                               delta=LARGEST.get(name, 1e-5), msg=f"{column} at {row['time']} s")

    def answer(self, name):
        settings, processes = RUNS[name]
        results = self.run_scene([SCENE, self.folder / "within.yaml"], *settings, processes=processes)
        return results.rows, results.record["meshes"]


if __name__ == "__main__":
    unittest.main()
