#!/usr/bin/python3
"""python_test.py SPREKK: the code of docs/python.md runs, and the package finds what files hold.

All ```python test blocks of the page are one program, in a folder that holds configs/."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
from pages import ROOT, blocks  # noqa: E402

SPREKK = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tools/python"))
import numpy as np  # noqa: E402
import sprekk  # noqa: E402

POINTS = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]])


class Python(unittest.TestCase):
    def test_the_code_of_the_page(self):
        code = "\n".join(block.text for block in blocks(ROOT / "docs/python.md") if block.language == "python" and "test" in block.words)
        self.assertGreater(code.count("sprekk.run("), 2)
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(ROOT / "configs", Path(folder) / "configs")
            environment = dict(os.environ, PYTHONPATH=str(ROOT / "tools/python"), SPREKK=str(SPREKK), PYTHONDONTWRITEBYTECODE="1", TMPDIR=folder)
            done = subprocess.run([sys.executable, "-c", code], cwd=folder, env=environment, capture_output=True, text=True, timeout=200)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_means_and_vectors(self):
        """Of a rectangle in two triangles of unequal values: the mean is by area, a vector has two columns."""
        grid = sprekk.Grid(POINTS, np.array([[0, 1, 2], [0, 2, 3]]), {"a.p[Pa]": np.array([1.0, 4.0]),
                           "a.u[m]": np.array([[1.0, 2, 0], [3, 4, 0]]), "a.s[Pa]": np.array([[1.0, 2, 3], [4, 5, 6]]), "region": np.zeros(2)},
                           component_names={"a.u[m]": ["x", "y", "z"], "a.s[Pa]": ["xx", "yy", "xy"]})
        fields = sprekk.Fields(7.0, grid)
        self.assertAlmostEqual(fields.mean("a.p"), 2.5)
        self.assertEqual(fields["a.u"].shape, (2, 2))
        self.assertEqual(fields["a.s[Pa]"].shape, (2, 3))
        np.testing.assert_array_equal(fields["a.s.yy"], [2, 5])
        np.testing.assert_array_equal(fields["a.u.x"], [1, 3])
        self.assertEqual(fields.names, {"a.p": "Pa", "a.u": "m", "a.s": "Pa"})
        np.testing.assert_allclose(fields.centres, [[4 / 3, 1 / 3], [2 / 3, 2 / 3]])
        with self.assertRaisesRegex(KeyError, "did you mean 'a.u'"):
            fields["a.v"]  # pylint: disable=pointless-statement

    def test_means_where_there_are_values(self):
        """Of points, linear in triangles: 3 x + y over the rectangle is 3.5. Of a field that some cells lack: over the others."""
        cells = np.array([[0, 1, 2], [0, 2, 3]])
        grid = sprekk.Grid(POINTS, cells, {"a.p[Pa]": np.array([np.nan, 4.0])}, {"a.u[m]": np.stack([3 * POINTS[:, 0] + POINTS[:, 1], *np.zeros((2, 4))], axis=1)},
                           component_names={"a.u[m]": ["x", "y", "z"]})
        fields = sprekk.Fields(7.0, grid)
        np.testing.assert_allclose(fields.mean("a.u"), [3.5, 0])
        self.assertAlmostEqual(fields.mean("a.u.x"), 3.5)
        self.assertAlmostEqual(fields.mean("a.p"), 4)

    def test_histories(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            with self.assertRaisesRegex(FileNotFoundError, "has no run.json"):
                sprekk.Results(folder)
            (folder / "run.json").write_text('{"exit": {"code": 1, "reason": "stopped"}, "notes": []}')
            (folder / "history.csv").write_text("time[s],tip.length[m]\n10,\n20,1\n40,3\n")
            run = sprekk.Results(folder)
            self.assertFalse(run.is_done)
            self.assertEqual(run.at("tip.length", 30), 2)
            self.assertTrue(np.isnan(run.at("tip.length", 50)) and np.isnan(run["tip.length"][0]))
            for damaged, told in (("20,1..5", r"history.csv, line 3, column tip.length\[m\]: '1..5' is no number"), ("20", "line 3: 1 cells, and 2 columns")):
                (folder / "history.csv").write_text(f"time[s],tip.length[m]\n10,\n{damaged}\n40,3\n")
                with self.assertRaisesRegex(ValueError, told):
                    sprekk.read_table(folder / "history.csv")
            (folder / "history.csv").write_text("time[s],tip.length[m]\n10,1.25\n20,1.2")  # the rest of 1.25 was not written
            np.testing.assert_array_equal(sprekk.read_table(folder / "history.csv")["tip.length[m]"], [1.25])
            (folder / "coupling.csv").write_text("time[s],field\n10,pore.pressure\n")
            self.assertEqual(sprekk.read_table(folder / "coupling.csv")["field"], ["pore.pressure"])
            self.assertEqual(run.rows[2], {"time": 40, "tip.length": 3})
            self.assertEqual(run.written(), [])
            with self.assertRaisesRegex(FileNotFoundError, "has no fields"):
                run.fields()

    def test_values_become_yaml(self):
        from sprekk.program import as_yaml  # pylint: disable=import-outside-toplevel
        self.assertEqual(as_yaml({"pressure": "2 MPa", "on": True, "at": [1, "2 m"]}), "{pressure: 2 MPa, on: true, at: [1, 2 m]}")


if __name__ == "__main__":
    unittest.main()
