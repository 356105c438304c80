#!/usr/bin/python3
"""compare_test.py SPREKK: `sprekk compare` finds a difference of 1e-6 that is planted in a history, in a field, on fractures or in a
path, and nothing else; says what cannot be compared; its page loads nothing."""

import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

SMALL = {"mesh.size": "1 m", "mesh.fracture_size": "0.3 m", "time.step": "6 h", "time.end": "1 day"}


def plant(vtu, array, entity, change):
    """Adds `change` to a value of an array of a .vtu file; returns its place among all values."""
    content = bytearray(vtu.read_bytes())
    tag = re.search(rb'<DataArray[^>]*Name="' + re.escape(array.encode()) + rb'"[^>]*>', content).group()
    start = content.index(b"_", content.index(b"<AppendedData")) + 1
    place = start + int(re.search(rb'offset="(\d+)"', tag).group(1)) + 8 + 8 * entity
    value, = struct.unpack_from("<d", content, place)
    struct.pack_into("<d", content, place, value + change)
    vtu.write_bytes(content)


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.holder.name)
        cls.whole = sprekk.run(ROOT / "configs/tutorial/first_scene.yaml", set=SMALL, out=cls.folder / "run", program=SPREKK)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def compare(self, *arguments, code):
        done = subprocess.run([SPREKK, "compare", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def copy(self, name):
        shutil.rmtree(self.folder / name, ignore_errors=True)
        shutil.copytree(self.folder / "run", self.folder / name)
        return self.folder / name

    def assert_found(self, name, quantity, *more):
        """Only `quantity` differs, by about 1e-6 of its range."""
        text = self.compare("run", name, "--tolerance", 5e-7, code=3)
        verdict = next(line for line in text.splitlines() if "beyond" in line)
        self.assertRegex(verdict, rf"^{name}: 1 of \d+ differences are beyond 5e-07: {re.escape(quantity)} \((1\.0e-06|9\.9e-07)\)$")
        for words in more:
            self.assertIn(words, text)
        self.assertIn(f"{name}: 1 of", self.compare("run", name, "--tolerance", 1e-9, code=3))
        self.compare("run", name, "--tolerance", 2e-6, code=0)
        return text

    def test_a_copy_is_the_same(self):
        self.copy("same")
        text = self.compare("run", "same", "--tolerance", 0, code=0)
        self.assertRegex(text, r"all \d+ differences are within 0")

    def test_a_millionth_in_a_history(self):
        folder = self.copy("history")
        lines = (folder / "history.csv").read_text().splitlines()
        column = lines[0].split(",").index("injection_pressure[Pa]")
        values = self.whole["injection_pressure"]
        cells = lines[3].split(",")
        cells[column] = repr(float(cells[column]) + 1e-6 * (values.max() - values.min()))
        lines[3] = ",".join(cells)
        (folder / "history.csv").write_text("\n".join(lines) + "\n")
        self.assert_found("history", "injection_pressure", "18 h 0 min")

    def test_a_millionth_in_a_field(self):
        for array, entity in (("pore.pressure[Pa]", 17), ("rock.displacement[m]", 3 * 17 + 1)):
            fields = self.whole.fields()
            values = fields[array]
            spread = (values.max(axis=0) - values.min(axis=0)).max()
            folder = self.copy("field")
            plant(sorted(folder.glob("matrix_*.vtu"))[-1], array, entity, 1e-6 * spread)
            x, y = fields.centres[17]
            self.assert_found("field", "the field " + array.partition("[")[0], f"({x:.4g}, {y:.4g}) m")

    def test_a_millionth_on_a_fracture(self):
        fields = self.whole.fractures()
        spread = max(numpy_range(fields["contact.jump.tangential"]), numpy_range(fields["contact.jump.normal"]))
        folder = self.copy("line")
        plant(sorted(folder.glob("fractures_*.vtu"))[-1], "contact.jump.tangential[m]", 2, 1e-6 * spread)
        self.assert_found("line", "the field contact.jump.tangential")

    def test_a_millionth_in_a_path(self):
        (line,) = self.whole.paths()[0]
        length = sum(((line[1:] - line[:-1]) ** 2).sum(axis=1) ** 0.5)
        folder = self.copy("path")
        file = sorted(folder.glob("fractures_*.vtu"))[-1]
        point = next(i for i, place in enumerate(self.whole.fractures().points) if tuple(place) == tuple(line[3]))
        normal = (line[4] - line[2])[::-1] * [-1, 1] / ((line[4] - line[2]) ** 2).sum() ** 0.5
        for axis in (0, 1):
            plant_point(file, point, axis, 1e-6 * length * normal[axis])
        text = self.compare("run", "path", "--of", "paths", "--tolerance", 5e-7, code=3)
        self.assertRegex(text, r"1 of 1 differences are beyond 5e-07: the path of crack \((1\.0e-06|9\.9e-07)\)")
        self.compare("run", "path", "--of", "paths", "--tolerance", 2e-6, code=0)

    def test_a_run_that_ended_early_is_compared_as_far_as_it_goes(self):
        sprekk.run(ROOT / "configs/tutorial/first_scene.yaml", set={**SMALL, "time.end": "12 h"}, out=self.folder / "short",
                   program=SPREKK)
        text = self.compare("run", "short", "--tolerance", 0, code=0)  # the same bits until then
        self.assertIn("compared until 12 h 0 min: run ends at 1 d 0 h, short at 12 h 0 min", text)
        record = json.loads((self.folder / "short/run.json").read_text())
        record["exit"] = {"code": 1, "reason": "no convergence"}
        (self.folder / "short/run.json").write_text(json.dumps(record))
        self.assertIn("short has not come to its end, it has reached 12 h 0 min (no convergence)",
                      self.compare("run", "short", code=0))
        shutil.rmtree(self.folder / "short")

    def test_mistakes_are_told(self):
        (self.folder / "empty").mkdir()
        other = self.copy("other")
        (other / "history.csv").write_text("time[s],step[s],iterations[1],speed[m/s]\n1,1,1,2\n")
        for file in other.glob("*.pvd"):
            file.unlink()
        damaged = self.copy("damaged")
        (damaged / "run.json").write_text("no record")
        cut, lost, changed = self.copy("cut"), self.copy("lost"), self.copy("changed")
        fields = sorted(cut.glob("matrix_*.vtu"))[-1]
        fields.write_bytes(fields.read_bytes()[:2000])
        (lost / "history.csv").unlink()
        lines = (changed / "history.csv").read_text().splitlines(keepends=True)
        (changed / "history.csv").write_text("".join([*lines[:2], "x" + lines[2], *lines[3:]]))
        for arguments, message in ((["run", "nowhere"], "nowhere: this is no folder of results (it does not exist) give"),
                                   (["run", "empty"], "empty: this is no folder of results (it has no run.json) give"),
                                   (["run", "damaged"], "this is not the record of a run (it is damaged, or another file)"),
                                   (["run", "cut"], f"{fields.relative_to(self.folder)}: this is not a whole file of fields"),
                                   (["run", "lost"], "lost/history.csv: this is not the history of its run (it has no row"),
                                   (["run", "changed"], "changed/history.csv: this is not the history of its run (the time in its row 2"),
                                   (["run"], "a comparison needs two runs (there is one) give"),
                                   (["run", "other"], "run and other: there is nothing to compare (they have no quantity"),
                                   (["run", "run", "--of", "slip.y"], "unknown quantity 'slip.y'"),
                                   (["run", "run", "--tolerance", "-1"], "--tolerance")):
            self.assertIn(message, self.compare(*arguments, code=2))

    def test_the_page_has_all_and_loads_nothing(self):
        sprekk.run(ROOT / "configs/tutorial/first_scene.yaml", set={**SMALL, "mesh.fracture_size": "0.2 m"},
                   out=self.folder / "finer", program=SPREKK)
        text = self.compare("run", "finer", "run", "--page", "pages/a.html", code=0)
        self.assertIn("the meshes differ", text)
        self.assertIn("page: pages/a.html", text)
        page = (self.folder / "pages/a.html").read_text()
        for words in ('id="summary"', 'id="history"', 'id="fields"', 'id="paths"', "injection_pressure", "conduit.aperture",
                      "finer against run", "processor time"):
            self.assertIn(words, page)
        self.assertIsNone(re.search(r"@import|url\(|fetch\(|XMLHttpRequest|https?://(?!www\.w3\.org/2000/svg)", page))


def numpy_range(values):
    return values.max() - values.min()


def plant_point(vtu, point, axis, change):
    """Moves a point of a .vtu file."""
    content = bytearray(vtu.read_bytes())
    tag = re.search(rb'<Points>\s*<DataArray[^>]*offset="(\d+)"', content)
    start = content.index(b"_", content.index(b"<AppendedData")) + 1
    place = start + int(tag.group(1)) + 8 + 8 * (3 * point + axis)
    value, = struct.unpack_from("<d", content, place)
    struct.pack_into("<d", content, place, value + change)
    vtu.write_bytes(content)


if __name__ == "__main__":
    unittest.main()
