#!/usr/bin/python3
"""sweep_places_test.py SPREKK: a sweep whose launcher loses one run in ten ends complete, with the table of a sweep without launcher; a run that
fails by itself is not repeated; choices give readable names; quantiles of samples are those of their distributions; Sobol's points are those
of SciPy; mistakes are refused."""

import csv
import json
import math
import os
import shlex
import statistics
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SPREKK = Path(sys.argv.pop(1)).resolve()
# At rest the pressure is that of the side: a figure that is the value that is set.
SCENE = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [2, 1]}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-10 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, initial_pressure: 0 MPa,
         boundary: {left: {pressure: 1 MPa}}}
schedule: [{solve: pore}]
time: {end: 1000 s, step: 1000 s}
output: {probes: {p: {of: pore.pressure, at: [0.25 m, 0.5 m]}}}
"""
FIGURE = "compare: {table: {p: {of: p, at: end}}}\n"
# Each tenth call does not come back: before the run, or after its first output.
LOSING = """#!/bin/sh
n=$(cat {folder}/calls 2>/dev/null || echo 0); echo $((n + 1)) > {folder}/calls
if [ $((n % 10)) -eq 4 ]; then kill -KILL $$; fi
exec "$@"
"""


class SweepPlaces(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "scene.yaml").write_text(SCENE)

    def sweep(self, study, *words, name="study", code=0):
        (self.folder / f"{name}.yaml").write_text("scene: scene.yaml\n" + study + FIGURE)
        run = subprocess.run([SPREKK, "sweep", f"{name}.yaml", "-o", name, *words], cwd=self.folder, capture_output=True, text=True, timeout=200)
        self.assertEqual(run.returncode, code, run.stderr)
        return run

    def rows(self, name="study", file="sweep.csv"):
        with (self.folder / name / file).open() as table:
            return list(csv.DictReader(table))

    def launcher(self):
        script = self.folder / "losing"
        script.write_text(LOSING.format(folder=shlex.quote(str(self.folder))))
        script.chmod(0o755)
        return script

    def test_a_launcher_that_loses_runs(self):
        grid = f"grid: {{components.pore.boundary.left.pressure: [{', '.join(f'{k} MPa' for k in range(1, 21))}]}}\n"
        script = self.launcher()
        run = self.sweep(grid, "-j", "1", "--launcher", str(script), "--launcher", "env")
        self.assertIn("lost by", run.stderr)
        rows = self.rows()
        self.assertEqual([row["state"] for row in rows], ["done"] * 20)
        for k, row in enumerate(rows, 1):
            self.assertAlmostEqual(float(row["p[Pa]"]) / (k * 1e6), 1, delta=1e-5)
        self.assertGreater(int((self.folder / "calls").read_text()), 5)  # the other launcher has its share
        self.sweep(grid, "-j", "2", name="plain")
        for ours, plain in zip(rows, self.rows("plain")):
            self.assertEqual(ours["p[Pa]"], plain["p[Pa]"])
        # One launcher alone repeats what it has lost itself; a template gets the whole command as one word.
        (self.folder / "calls").unlink()
        self.sweep(grid, "-j", "1", "--launcher", f"{script} sh -c {{command}}", name="template")
        self.assertEqual([row["state"] for row in self.rows("template")], ["done"] * 20)
        self.assertEqual((self.folder / "calls").read_text().strip(), "22")

    def test_what_fails_by_itself_is_not_repeated(self):
        counting = self.folder / "counting"
        counting.write_text(f'#!/bin/sh\necho 1 >> {shlex.quote(str(self.folder))}/count\nexec "$@"\n')
        counting.chmod(0o755)
        # Data without a value end a run with a reason.
        self.sweep('runs: {bad: {time.step: 250 s, components.pore.source: "(1e-12*sqrt(abs(t - 500) - 100)) 1/s"}}\n', "--launcher", str(counting), code=1)
        self.assertEqual((self.folder / "count").read_text().split(), ["1"])
        self.assertEqual(self.rows()[0]["state"], "failed")

    def test_a_launcher_that_loses_all(self):
        run = self.sweep("runs: {one: {time.step: 500 s}}\n", "--launcher", "false", "--repeats", "3", code=1)
        self.assertEqual(run.stderr.count("lost by"), 3)

    def test_choices(self):
        self.sweep("choices:\n  flow: {mpfa: {components.pore.type: matrix_flow/mpfa}, tpfa: {components.pore.type: matrix_flow/tpfa}}\n"
                   "  scheme: {second_order: {time.scheme: sdirk2}, first_order: {}}\ngrid: {time.step: [500 s, 250 s]}\n")
        rows = self.rows()
        self.assertEqual([row["run"] for row in rows[:3]], ["flow=mpfa,scheme=second_order,step=500s", "flow=mpfa,scheme=second_order,step=250s",
                                                            "flow=mpfa,scheme=first_order,step=500s"])
        self.assertEqual(len(rows), 8)
        self.assertEqual((rows[7]["flow"], rows[7]["scheme"], rows[7]["time.step"]), ("tpfa", "first_order", "250 s"))
        record = json.loads((self.folder / "study" / rows[0]["run"] / "run.json").read_text())
        self.assertIn("sdirk2", json.dumps(record))

    def test_quantiles(self):
        count = 32
        for method, within in (("sobol", 1 / count), ("latin_hypercube", 1 / count)):
            self.sweep(f"samples: {{count: {count}, method: {method}, of: {{components.pore.boundary.left.pressure: {{from: 1 MPa, to: 3 MPa}}}}}}\n",
                       name=method)
            row, = self.rows(method, "quantiles.csv")
            self.assertEqual(int(row["count[1]"]), count)
            for share in (5, 25, 50, 75, 95):
                self.assertAlmostEqual(float(row[f"{share} %"]) / 1e6, 1 + share / 50, delta=2 * 2 * within)
            numbers = [float(row["p[Pa]"]) for row in self.rows(method)]
            self.assertAlmostEqual(float(row["mean"]), statistics.mean(numbers), delta=1)
            self.assertAlmostEqual(float(row["deviation"]), statistics.stdev(numbers), delta=1)
            # One of each interval of the count.
            drawn = [float(row["components.pore.boundary.left.pressure"].split()[0]) for row in self.rows(method)]
            self.assertEqual(sorted(math.floor((p - 1) / 2 * count) for p in drawn), list(range(count)))
            for p, given in zip(numbers, drawn):
                self.assertAlmostEqual(p / (given * 1e6), 1, delta=1e-5)
            self.assertIn("Quantiles of the samples", (self.folder / method / "sweep.html").read_text())
        self.sweep("samples: {count: 64, seed: 5, of: {components.pore.boundary.left.pressure: {mean: 2 MPa, deviation: 0.1, log: true}}}\n", name="log")
        row, = self.rows("log", "quantiles.csv")
        for share in (5, 25, 50, 75, 95):
            exact = 2e6 * math.exp(0.1 * statistics.NormalDist().inv_cdf(share / 100))
            self.assertAlmostEqual(float(row[f"{share} %"]) / exact, 1, delta=0.012)

    def test_samples_of_each_combination(self):
        self.sweep("grid: {time.step: [500 s, 1000 s]}\nsamples: {count: 10, of: {components.pore.boundary.left.pressure: {from: 1 MPa, to: 2 MPa}}}\n")
        rows = self.rows()
        self.assertEqual((rows[0]["run"], rows[19]["run"]), ("step=500s,sample=01", "step=1000s,sample=10"))
        self.assertEqual([row["samples of"] for row in self.rows(file="quantiles.csv")], ["step=500s", "step=1000s"])
        path = "components.pore.boundary.left.pressure"
        self.assertEqual([row[path] for row in rows[:10]], [row[path] for row in rows[10:]])

    def test_sobol_points_are_those_of_scipy(self):
        try:
            from scipy.stats import qmc  # pylint: disable=import-outside-toplevel
        except ImportError:
            self.skipTest("SciPy is not here")
        paths = ["components.pore.permeability", "components.pore.viscosity", "components.pore.storage", "components.pore.initial_pressure",
                 "components.pore.boundary.left.pressure", "time.end"]
        units = ["m^2", "Pa*s", "1/Pa", "Pa", "Pa", "s"]
        of = ", ".join(f"{path}: {{from: {2 ** 32} {unit}, to: {2 ** 33} {unit}}}" for path, unit in zip(paths, units))
        self.sweep(f"samples: {{count: 16, of: {{{of}}}}}\nset: {{time.step: 1e11 s}}\n")
        points = qmc.Sobol(len(paths), scramble=False).random(16)
        for k, path in enumerate(paths):
            ours = [(float(row[path].split()[0]) - 2**32) / 2**32 for row in self.rows()]
            digits = [int(x * 16) ^ int(ours[0] * 16) for x in ours]
            self.assertEqual(digits, [int(x * 16) for x in points[:, k]], path)

    def test_mistakes(self):
        for study, words in (("samples: {count: 4, of: {time.step: {from: 1 s}}}\n", ("the distribution is not known",)),
                             ("samples: {count: 4, of: {time.step: {from: 1 s, to: 1 h}}}\n", ("two units",)),
                             ("samples: {count: 4, of: {time.step: {from: 2 s, to: 1 s}}}\n", ("'from' is not below 'to'",)),
                             ("samples: {count: 4, of: {time.step: {from: -1 s, to: 1 s, log: true}}}\n", ("logarithm",)),
                             ("samples: {count: 4, of: {time.step: {mean: fast, deviation: 1 s}}}\n", ("is no number",)),
                             ("samples: {count: 4, of: {}}\n", ("nothing is drawn",)),
                             ("choices: {scheme: {a b: {time.step: 1 s}}}\n", ("an option cannot be called",)),
                             ("choices: {scheme: {}}\n", ("has no options",))):
            answer = self.sweep(study, code=2)
            for word in words:
                self.assertIn(word, answer.stderr, study)
        for launcher, word in (("", "a launcher is empty"), ("ssh 'a", "does not end")):
            self.assertIn(word, self.sweep("runs: {a: {}}\n", "--launcher", launcher, code=2).stderr)

    def test_a_study_starts_no_command(self):
        for words in ((), ("--list",)):
            answer = self.sweep(f"runs: {{a: {{}}}}\nlauncher: touch {self.folder}/touched\n", *words, code=2)
            for word in ("study.yaml:3:", "a study names no launcher", "--launcher"):
                self.assertIn(word, answer.stderr)
        self.assertFalse((self.folder / "touched").exists())


if __name__ == "__main__":
    os.environ.pop("OMPI_COMM_WORLD_SIZE", None)
    unittest.main()
