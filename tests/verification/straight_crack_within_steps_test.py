#!/usr/bin/python3
"""straight_crack_within_steps_test.py SPREKK: both tips of a straight crack under one pressure have the same K wherever they are, so
that nothing but the mesh and round-off would tell which one grows: they grow alike."""

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

# A crack in a box of 2 m, compressed along the crack so that it grows straight, in sealed rock.
SCENE = """
name: straight_crack
geometry:
  box: {x: [-1 m, 1 m], y: [-1 m, 1 m]}
  fractures: {main: {center: [0 m, 0 m], length: 0.28 m, angle: 0 deg}}
mesh: {size: 0.2 m, fracture_size: 20 mm, growth: 0.2}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 30 GPa
    poisson_ratio: 0.25
    initial_stress: {xx: -1 MPa, yy: 0 MPa, xy: 0 MPa}
    boundary:
      left: {displacement: [0 m, 0 m]}
      bottom: {displacement: [0 m, 0 m]}
      right: {displacement: [0 m, 0 m]}
      top: {displacement: [0 m, 0 m]}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1.0e-4 Pa*s
    fluid_compressibility: 4.0e-10 1/Pa
    initial_aperture: 0.1 mm
    grown: {aperture: 0 m, fluid: filled}
    transmissivity: constant
    transmissivity_value: 1.0e-6 m^3
    injection: {well: {fracture: main, rate: {value: 1.0e-7 m^2/s}}}
  contact: {type: contact/coulomb, friction: 0.5}
  tips:
    type: fine_fracture/quarter_point
    size: 0.5 m
    skip_below: 0
    cavity: 2
    toughness: 1 MPa*m^0.5
    growth: {increment: 10 mm}
couplers:
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
  - {type: two_level, between: [rock, conduit, tips, contact], propagation_threshold: 0.25}
schedule:
  - solve: [rock, conduit, contact]
  - {grow: tips, settle: [rock, contact], update: within_step}
time: {end: 400 s, step: 10 s, stop: {of: tips.main_last.length, reaches: 0.05 m}}
output:
  probes:
    pressure: {of: conduit.pressure, at: [0 m, 0 m]}
"""
# Along the diagonal of 32 by 32 squares: mesh and load are point-symmetric.
SYMMETRIC = {
    "box: {x: [-1 m, 1 m], y: [-1 m, 1 m]}": "box: {x: [-0.4 m, 0.4 m], y: [-0.4 m, 0.4 m]}",
    "length: 0.28 m, angle: 0 deg": "length: 0.28284271247461900976 m, angle: 45 deg",
    "mesh: {size: 0.2 m, fracture_size: 20 mm, growth: 0.2}": "mesh: {kind: structured, cells: [32, 32]}",
    "initial_stress: {xx: -1 MPa, yy: 0 MPa, xy: 0 MPa}": "initial_stress: {xx: -0.5 MPa, yy: -0.5 MPa, xy: -0.5 MPa}",
    "size: 0.5 m": "size: 0.31 m",
}
# Between toughness and viscosity: K is up to 1.14 times the toughness.
VISCOUS = {
    "viscosity: 1.0e-4 Pa*s": "viscosity: 1.0e-2 Pa*s",
    "initial_aperture: 0.1 mm": "initial_aperture: 0.01 mm",
    "transmissivity: constant\n    transmissivity_value: 1.0e-6 m^3": "transmissivity: cubic_law",
    "rate: {value: 1.0e-7 m^2/s}": "rate: {value: 5.0e-6 m^2/s}",
    "time: {end: 400 s, step: 10 s, stop: {of: tips.main_last.length, reaches: 0.05 m}}":
        "time: {end: 40 s, step: 0.2 s, stop: {of: tips.main_last.length, reaches: 0.05 m}}",
}
PERTURBED = {"value: 1.0e-7 m": "value: 1.000000001e-7 m"}


def interpolated(x, places, values):
    """Linear, where places first pass x."""
    for i in range(1, len(places)):
        if places[i - 1] <= x < places[i]:
            return values[i - 1] + (values[i] - values[i - 1]) * (x - places[i - 1]) / (places[i] - places[i - 1])
    raise ValueError(f"{x} is not passed")


class StraightCrack(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.folder = Path(self.holder.name)

    def tearDown(self):
        self.holder.cleanup()

    def rows(self, changes, more=(), refused=3):
        scene = SCENE
        for old, new in changes.items():
            self.assertEqual(scene.count(old), 1, old)
            scene = scene.replace(old, new)
        (self.folder / "scene.yaml").write_text(scene)
        output = Path(tempfile.mkdtemp(dir=self.folder))
        run = subprocess.run([SPREKK, "run", self.folder / "scene.yaml", *more, "-q", "-o", output], capture_output=True, text=True,
                             timeout=300)
        self.assertEqual(run.returncode, 0, run.stderr)
        results = sprekk.Results(output)
        self.assertGreater(results.rows[-1]["tips.main_first.length"], 0.049)
        self.assertLessEqual(results.record["counters"].get("steps rejected", 0), refused)
        return results.rows

    def test_on_a_symmetric_mesh_round_off_chooses_no_leader(self):
        for row in self.rows(SYMMETRIC):
            self.assertLess(abs(row["tips.main_first.length"] - row["tips.main_last.length"]), 1e-10, row["time"])

    def check_growth(self, rows):
        grown = [row for row in rows if row["tips.main_last.length"] > 5e-3]
        self.assertGreater(len(grown), 4)
        for row in grown:
            first, last = row["tips.main_first.length"], row["tips.main_last.length"]
            self.assertLess(abs(first - last), 0.01 * (0.28 + first + last) / 2, row["time"])
            mean = (row["tips.main_first.K_eq"] + row["tips.main_last.K_eq"]) / 2
            self.assertAlmostEqual(mean / 1e6, 1, delta=1e-6)
            # The error of a mesh, and no more, is left between them.
            self.assertLess(abs(row["tips.main_first.K_eq"] / row["tips.main_last.K_eq"] - 1), 2.5e-3)

    def test_on_any_mesh_both_tips_grow(self):
        rows = self.rows({})
        self.check_growth(rows)
        # Ten figures more of the rate, and nothing else.
        for row, twin in zip(rows, self.rows(PERTURBED)):
            for tip in ("tips.main_first.length", "tips.main_last.length"):
                self.assertLess(abs(row[tip] - twin[tip]), 1e-8, row["time"])

    def test_turned_by_30_degrees(self):
        (self.folder / "scene.yaml").write_text(SCENE)
        subprocess.run([ROOT / "tools/turn_scene", self.folder / "scene.yaml", self.folder / "turned", "--angle", "30", "--program",
                        SPREKK], check=True, capture_output=True, timeout=100)
        self.check_growth(self.rows({}, [self.folder / "turned/turned.yaml"]))

    def test_mirrored(self):
        """The other end of the crack is the first one, in the image of the load."""
        there = self.rows({})
        back = self.rows({"{center: [0 m, 0 m], length: 0.28 m, angle: 0 deg}": "{points: [[0.14 m, 0 m], [-0.14 m, 0 m]]}"})
        self.check_growth(back)
        self.check_twins(there, back, ("first", "last"))

    def check_twins(self, one, other, ends=("last", "first")):
        """Time, pressure and the other tip where one tip of each is 0.04 m long; `ends` of the other."""
        def state(rows, end, far_end):
            lengths = [row[f"tips.main_{end}.length"] for row in rows]
            return [interpolated(0.04, lengths, [row[column] for row in rows]) for column in ("time", "pressure", f"tips.main_{far_end}.length")]
        for mine, its in zip(state(one, "last", "first"), state(other, *ends)):
            self.assertLess(abs(its / mine - 1), 0.01)

    def test_viscous_tips_turned_by_30_degrees(self):
        """Where the fluid is viscous the advances take the energy that they release, both tips rest at their apparent toughness
        but for the error of the mesh, and the box may be turned."""
        straight = self.rows(VISCOUS, refused=9)
        scene = SCENE
        for old, new in VISCOUS.items():
            scene = scene.replace(old, new)
        (self.folder / "scene.yaml").write_text(scene)
        subprocess.run([ROOT / "tools/turn_scene", self.folder / "scene.yaml", self.folder / "turned", "--angle", "30", "--program",
                        SPREKK], check=True, capture_output=True, timeout=100)
        turned = self.rows(VISCOUS, [self.folder / "turned/turned.yaml"], refused=9)
        self.check_twins(straight, turned)
        for rows in (straight, turned):
            late = [row for row in rows if row["tips.main_last.length"] > 0.02]
            self.assertGreater(len(late), 3)
            for row in late:
                loads = [row[f"tips.main_{end}.K_eq"] / row[f"tips.main_{end}.apparent_toughness"] for end in ("first", "last")]
                speeds = [row[f"tips.main_{end}.speed"] for end in ("first", "last")]
                energy = sum(load * speed for load, speed in zip(loads, speeds)) / sum(speeds)
                self.assertAlmostEqual(energy, 1, delta=1e-6)
                self.assertLess(abs(loads[0] - loads[1]), 2.5e-3)
                self.assertGreater(row["tips.main_last.apparent_toughness"], 1.1e6)


if __name__ == "__main__":
    unittest.main()
