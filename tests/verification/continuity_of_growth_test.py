#!/usr/bin/python3
"""continuity_of_growth_test.py SPREKK MPIEXEC: while growth is stable, lengths, pressures and times are continuous in what
a scene prescribes. Wings that grow within steps are the same after another last digit of the injection rate, with another
direct solver, another residual of Newton's method, and on two processes; and every mesh has the same topology."""

import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK, MPIEXEC = (Path(sys.argv.pop(1)).resolve(), sys.argv.pop(1))
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

RATE = 5.0e-9  # m^2/s
OVERLAY = """
couplers:
  - {type: biot,          between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture,      between: [contact, conduit]}
  - {type: two_level,     between: [rock, conduit, tips], propagation_threshold: 0.25}
schedule:
  - solve: [pore, rock, conduit, contact]
  - grow: tips
    settle: [rock, contact]
    update: within_step
mesh: {size: 0.4 m, fracture_size: 20 mm, growth: 0.5}
time: {end: 5 h}
output: {fields: false}
"""


def rate(factor):
    return f"components.conduit.injection.well.rate.value={RATE * factor!r} m^2/s"


RUNS = {
    "as it is": ([], 1),
    "rate 1e-9": (["--set", rate(1 + 1e-9)], 1),
    "rate 1e-7": (["--set", rate(1 + 1e-7)], 1),
    "UMFPACK": (["--set", "solver.type=umfpack"], 1),
    "residual 1e-8": (["--set", "newton.residual=1e-8"], 1),
    "two processes": ([], 2),
}
LARGEST = {"rate 1e-9": 1e-6}  # of lengths and pressures; 1e-5 for all others


class ContinuityOfGrowth(unittest.TestCase):
    def test_neighbours_of_a_scene(self):
        with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
            self.folder = Path(folder)
            (self.folder / "within.yaml").write_text(OVERLAY)
            for name, run in zip(RUNS, pool.map(self.run_of, RUNS)):
                self.assertEqual(run.returncode, 0, f"{name}: {run.stderr}")
            rows, meshes = self.answer("as it is")
            grown = rows[-1]["tips.main_last.length"]
            self.assertGreater(grown, 0.015)  # m, several increments and changes of the mesh
            self.assertGreater(len(meshes), 6)
            for name in RUNS:
                others, other_meshes = self.answer(name)
                with self.subTest(name):
                    self.assertEqual(len(others), len(rows))
                    self.assertEqual([m["hash"] for m in other_meshes], [m["hash"] for m in meshes])
                    for row, other in zip(rows, others):
                        for column in ("time", "tips.main_first.length", "tips.main_last.length", "fracture_pressure"):
                            self.assertAlmostEqual(other[column] / max(row[column], 1e-30), 1 if row[column] else 0,
                                                   delta=LARGEST.get(name, 1e-5), msg=f"{column} at {row['time']} s")

    def run_of(self, name):
        settings, processes = RUNS[name]
        program = [SPREKK] if processes == 1 else [MPIEXEC, "-n", str(processes), SPREKK]
        return subprocess.run([*program, "run", ROOT / "configs/paper/wing_cracks.yaml", self.folder / "within.yaml",
                               "-q", "-o", self.folder / name.replace(" ", "_"), *settings],
                              capture_output=True, text=True, timeout=300)

    def answer(self, name):
        folder = self.folder / name.replace(" ", "_")
        results = sprekk.Results(folder)
        return results.rows, results.record["meshes"]


if __name__ == "__main__":
    unittest.main()
