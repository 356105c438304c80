#!/usr/bin/python3
"""report_test.py SPREKK: the report of a run, opened in a browser without a screen, draws and complains about nothing."""

import csv
import html.parser
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
BROWSER = shutil.which("chromium")


class Page(html.parser.HTMLParser):
    """What a page holds: sections with their pictures, the canvas, and everything that it would load."""

    def __init__(self, text):
        super().__init__()
        self.sections, self.pictures, self.canvas, self.loaded, self.small = [], {}, {}, [], 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "body":
            self.body = attributes
        if tag == "section":
            self.sections.append(attributes["id"])
        if tag == "svg":
            self.pictures.setdefault(self.sections[-1], []).append(attributes["aria-label"])
        if tag == "canvas":
            self.canvas = attributes if attributes.get("id") == "map" else self.canvas
            self.small += attributes.get("id") != "map"
        self.loaded += [attributes[name] for name in ("src", "href") if name in attributes]


class Report(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.folder = Path(self.holder.name)

    def tearDown(self):
        self.holder.cleanup()

    def run_sprekk(self, *arguments, code=0):
        run = subprocess.run([SPREKK, *arguments], cwd=self.folder, text=True, capture_output=True, timeout=120)
        self.assertEqual(run.returncode, code, run.stderr)
        return run

    def report(self, scene, *settings):
        self.run_sprekk("run", ROOT / "configs" / scene, "-o", "results", "-q",
                        *(word for setting in settings for word in ("--set", setting)))
        self.run_sprekk("report", "results")
        return self.folder / "results/report.html"

    def opened(self, file):
        """The page after its script has run."""
        self.assertTrue(BROWSER, "chromium is missing: run tools/install")
        run = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0",
                              f"--user-data-dir={self.folder}/browser", "--virtual-time-budget=5000", "--dump-dom",
                              file.as_uri()], text=True, capture_output=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("CONSOLE", run.stderr)
        return Page(run.stdout)

    def assert_loads_nothing(self, page, file):
        for target in page.loaded:
            self.assertRegex(target, r"^(#|data:)")
        self.assertIsNone(re.search(r"@import|url\(|fetch\(|XMLHttpRequest|https?://(?!www\.w3\.org/2000/svg)",
                                    file.read_text(encoding="utf-8")))

    def test_run_with_fractures_has_all_figures(self):
        file = self.report("tutorial/first_scene.yaml", "mesh={size: 1 m, fracture_size: 0.3 m}")
        page = self.opened(file)
        self.assert_loads_nothing(page, file)
        self.assertEqual(page.sections, ["summary", "history", "tips", "maps", "fractures", "convergence", "effort", "parameters"])
        self.assertIn("injection_pressure", page.pictures["history"])
        for name in ("conduit.aperture", "contact.traction.normal", "contact.traction.tangential", "contact.jump.tangential"):
            self.assertIn(name, page.pictures["fractures"])
        self.assertIn("iterations of each step", page.pictures["convergence"])
        self.assertEqual(page.canvas["data-field"], "pore.pressure")
        # The block fills the frame: all pixels of it have a colour.
        width, height = int(page.canvas["width"]) - 120 - 230, int(page.canvas["height"]) - 20 - 80
        self.assertGreater(int(page.canvas["data-pixels"]), 0.995 * width * height)
        self.assertEqual(page.small, 5)  # the start, and four times
        text = file.read_text(encoding="utf-8")
        for expected in ("first_scene", "done", "MPa", "mesh.fracture_size", "linear: factorization", "crack"):
            self.assertIn(expected, text)

    def test_controls_draw_anew(self):
        file = self.report("tutorial/first_scene.yaml", "mesh={size: 1 m, fracture_size: 0.3 m}")
        use = """<script>
          const set = (id, value, event) => {
            document.getElementById(id).value = value;
            document.getElementById(id).dispatchEvent(new Event(event));
          };
          set('map-field', 4, 'change');
          set('map-time', 0, 'input');
          set('map-scale', 'one', 'change');
          for (const id of ['map-lines', 'map-in', 'map-out', 'map-out']) document.getElementById(id).click();
          const box = document.getElementById('map').getBoundingClientRect();
          document.getElementById('map').dispatchEvent(
            new PointerEvent('pointermove', {clientX: box.left + box.width / 2, clientY: box.top + box.height / 2}));
          document.body.dataset.value = document.getElementById('map-value').textContent;
          document.body.dataset.time = document.getElementById('map-time-text').textContent;
        </script></body>"""
        used = self.folder / "used.html"
        used.write_text(file.read_text(encoding="utf-8").replace("</body>", use), encoding="utf-8")
        page = self.opened(used)
        self.assertEqual(page.canvas["data-field"], "rock.displacement, x")
        self.assertEqual(page.body["data-time"], "0 h")
        self.assertRegex(page.body["data-value"], r"^x = [-0-9.]+ m, y = [-0-9.]+ m: rock\.displacement, x = [-0-9.]+ mm$")

    def test_all_times_are_a_film(self):
        file = self.report("tutorial/first_scene.yaml", "mesh={size: 1 m, fracture_size: 0.3 m}")
        use = """<script>
          const seen = [], play = document.getElementById('map-play'), time = document.getElementById('map-time-text');
          const look = () => {
            if (seen[seen.length - 1] !== time.textContent) seen.push(time.textContent);
            document.body.dataset.seen = seen.join(', ');
          };
          play.click();
          document.body.dataset.button = play.textContent;
          look();
          setInterval(look, 100);
          setTimeout(() => { document.body.dataset.after = play.textContent; }, 4000);
        </script></body>"""
        used = self.folder / "used.html"
        used.write_text(file.read_text(encoding="utf-8").replace("</body>", use), encoding="utf-8")
        page = self.opened(used)
        self.assertEqual((page.body["data-button"], page.body["data-seen"], page.body["data-after"]),
                         ("■", "0 h, 12 h, 24 h, 36 h, 48 h", "▶"))

    def test_fractures_are_coloured_and_named_on_the_map(self):
        file = self.report("tutorial/first_scene.yaml", "mesh={size: 1 m, fracture_size: 0.3 m}")
        use = """<script>
          const choice = document.getElementById('map-line-field');
          choice.value = [...choice.options].find((option) => option.text === 'contact.jump.tangential').value;
          choice.dispatchEvent(new Event('change'));
          document.getElementById('map-lines').click();
          const box = document.getElementById('map').getBoundingClientRect(), canvas = document.getElementById('map');
          // The middle of the frame, which is that of the fracture.
          const [x, y] = [120 + (canvas.width - 120 - 460) / 2, 20 + (canvas.height - 100) / 2];
          canvas.dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + x * box.width / canvas.width,
                                                                clientY: box.top + y * box.height / canvas.height}));
          document.body.dataset.value = document.getElementById('map-value').textContent;
        </script></body>"""
        used = self.folder / "used.html"
        used.write_text(file.read_text(encoding="utf-8").replace("</body>", use), encoding="utf-8")
        page = self.opened(used)
        self.assertEqual(page.canvas["data-line-field"], "contact.jump.tangential")
        # What history.csv has of the middle of the fracture in the last step, which is shown.
        with open(self.folder / "results/history.csv", newline="", encoding="utf-8") as table:
            slip = float(list(csv.DictReader(table))[-1]["slip.t[m]"])
        shown = re.search(r"; fracture crack: contact\.jump\.tangential = (\S+) (\S+)$", page.body["data-value"])
        self.assertIsNotNone(shown, page.body["data-value"])
        self.assertEqual(shown[2], "mm")
        self.assertAlmostEqual(float(shown[1]) * 1e-3 / slip, 1, delta=0.1)  # cells beside the one of the probe

    def test_many_fractures_are_maps_and_one_step_draws_no_frames(self):
        """Reference: the highest and lowest class of a map name the extreme values of the field."""
        file = self.report("verification/outcrop_network.yaml")
        page = self.opened(file)
        self.assertEqual(page.pictures["fractures"], ["pore.wall_flux.plus [10⁻⁶ m/s]", "pore.wall_flux.minus [10⁻⁶ m/s]", "conduit.pressure [MPa]"])
        self.assertNotIn("convergence", page.pictures)
        text = file.read_text(encoding="utf-8")
        self.assertIn("All 63 fractures at the last written time", text)
        self.assertIn("1 step with 1 iteration.", text)
        pressures = [float(bound) for bounds in re.findall(r"<g><title>(\S+ to \S+)</title>", text.split("conduit.pressure [MPa]")[-1]) for bound in bounds.split(" to ")]
        self.assertEqual(pressures[1:-1:2], pressures[2::2])
        sys.path.insert(0, str(ROOT / "tools/python"))
        import sprekk
        field = sprekk.Results(file.parent).fractures()["conduit.pressure"]
        self.assertAlmostEqual(pressures[0], field.min() * 1e-6, delta=5e-3 * abs(pressures[0]))
        self.assertAlmostEqual(pressures[-1], field.max() * 1e-6, delta=5e-3)

    def test_run_without_fractures_or_probes(self):
        page = self.opened(self.report("verification/terzaghi.yaml", "output.probes=~"))
        self.assertNotIn("fractures", page.sections)
        self.assertGreater(int(page.canvas["data-pixels"]), 0)

    def test_run_without_fields(self):
        page = self.opened(self.report("verification/terzaghi.yaml", "output.fields=false"))
        self.assertNotIn("maps", page.sections)
        self.assertIn("history", page.sections)

    def test_tips_have_curves_and_a_run_that_failed_says_why(self):
        file = self.report("verification/terzaghi.yaml")
        rows = "time[s],step[s],iterations[1]," + ",".join(
            f"tips.main_{end}.{name}" for end in ("first", "last") for name in ("K_I[Pa*m^0.5]", "K_II[Pa*m^0.5]", "length[m]"))
        (file.parent / "history.csv").write_text(rows + "\n3600,3600,2" + ",1e5,7e5,0.05" * 2 + "\n7200,3600,2" + ",2e5,8e5,0.06" * 2 + "\n")
        record = file.parent / "run.json"
        text = record.read_text().replace('"code": 0', '"code": 1').replace('"reason": "done"', '"reason": "it <b>broke</b>"')
        record.write_text(text)
        (file.parent / "matrix.pvd").write_text("cut off")
        self.run_sprekk("report", "results")
        page = self.opened(file)
        self.assertEqual(page.pictures["tips"], ["tips.main_first", "tips.main_last", "length"])
        text = file.read_text(encoding="utf-8")
        self.assertIn("it &lt;b&gt;broke&lt;/b&gt;", text)
        self.assertIn("not a complete .pvd file", text)

    def test_folder_without_results_is_refused(self):
        run = self.run_sprekk("report", ".", code=2)
        self.assertIn("this is no folder of results (it has no run.json)", run.stderr)


if __name__ == "__main__":
    unittest.main()
