#!/usr/bin/python3
"""derived_fields_test.py SPREKK MPIEXEC: stress, effective and principal stress, slip tendency and Darcy velocity against closed forms, as
probes, as fields with named components, in Python, and at the start of a run; uniaxial stress turned by angles, mirrored, disturbed, with
both kinds of rock, and on two processes."""

import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

MPIEXEC = sys.argv.pop(2)
SPREKK = Path(sys.argv.pop(1)).resolve()
COMPRESSION, PRESSURE, ALPHA, FRICTION = 30e6, 4e6, 0.7, 2.5

# Nothing moves: the sides are held, friction holds the fracture, and the pressure stays.
SCENE = """
geometry:
  box: {{x: [0 m, 2 m], y: [0 m, 1.6 m]}}
  fractures:
    crack: {{center: [0.9 m, 0.8 m], length: 0.6 m, angle: {crack!r} deg}}
mesh: {{size: 0.3 m, fracture_size: 0.15 m}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 5e-10 1/Pa}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-15 m^2
    porosity: 0.1
    initial_pressure: {pressure!r} Pa
  rock:
    type: poromechanics/{rock}
    young_modulus: 20 GPa
    poisson_ratio: 0.25
    initial_stress: {{xx: {xx!r} Pa, yy: {yy!r} Pa, xy: {xy!r} Pa}}
    boundary:
      left: {{displacement: [0 m, 0 m]}}
      right: {{displacement: [0 m, 0 m]}}
      bottom: {{displacement: [0 m, 0 m]}}
      top: {{displacement: [0 m, 0 m]}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.1 mm, initial_pressure: {pressure!r} Pa}}
  contact: {{type: contact/coulomb, friction: {friction!r}}}
couplers:
  - {{type: biot, between: [pore, rock], biot_coefficient: {alpha!r}}}
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [pore, rock, conduit, contact]}}]
time: {{end: 2 s, step: 1 s}}
output:
  every: 1 s
  probes:
    stress: {{of: rock.stress, at: [1.3 m, 0.4 m]}}
    effective: {{of: biot.effective_stress, take: mean}}
    most: {{of: rock.principal_stress.most_compressive, at: [0.3 m, 1.1 m]}}
    least: {{of: rock.principal_stress.least_compressive, take: largest}}
    direction: {{of: rock.most_compressive_direction, at: [1.3 m, 0.4 m]}}
    tendency: {{of: contact.slip_tendency, fracture: crack, take: mean}}
    used: {{of: contact.friction_used, at: [0.9 m, 0.8 m]}}
    state: {{of: contact.state_0_stick_1_slip_2_open, take: largest}}
"""

FLOW = """
geometry: {{box: {{x: [0 m, 2 m], y: [0 m, 1 m]}}}}
mesh: {{kind: {kind}, size: 0.2 m}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: {{along: 3e-14 m^2, across: 1e-14 m^2, angle: {angle!r} deg}}
    viscosity: 2 mPa*s
    storage: 1e-10 1/Pa
    initial_pressure: {pressure}
    boundary: {{left: {{pressure: {pressure}}}, right: {{pressure: {pressure}}}, bottom: {{pressure: {pressure}}}, top: {{pressure: {pressure}}}}}
schedule: [{{solve: pore}}]
time: {{end: 2 s, step: 1 s}}
output: {{probes: {{velocity: {{of: pore.velocity, at: [0.77 m, 0.31 m]}}, mean: {{of: pore.velocity, take: mean}}}}}}
"""


def run(text, processes=1):
    holder = tempfile.TemporaryDirectory()
    folder = Path(holder.name)
    (folder / "scene.yaml").write_text(text)
    command = ["nice", *([MPIEXEC, "-n", str(processes)] if processes > 1 else []), SPREKK, "run", "-q", folder / "scene.yaml", "-o", folder / "out"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    if done.returncode:
        raise AssertionError(done.stderr)
    return holder, sprekk.Results(folder / "out")


def stress_of(angle, factor=1.0):
    """(xx, yy, xy) of a uniaxial compression along a direction, in degrees from x."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return [-COMPRESSION * factor * value for value in (c * c, s * s, c * s)]


def scene(angle, crack, rock="mpsa", pressure=PRESSURE, factor=1.0):
    xx, yy, xy = stress_of(angle, factor)
    return SCENE.format(crack=float(crack), rock=rock, xx=xx, yy=yy, xy=xy, pressure=pressure, alpha=ALPHA, friction=FRICTION)


class Stress(unittest.TestCase):
    def check(self, angle, crack, rock="mpsa", pressure=PRESSURE, factor=1.0, processes=1):
        holder, result = run(scene(angle, crack, rock, pressure, factor), processes)
        load, (xx, yy, xy) = COMPRESSION * factor, stress_of(angle, factor)
        near = lambda value, expected: self.assertAlmostEqual(value, expected, delta=1e-9 * load)
        last = {name: values[-1] for name, values in ((key.partition("[")[0], v) for key, v in result.history.items())}
        for name, expected in (("xx", xx), ("yy", yy), ("xy", xy)):
            near(last[f"stress.{name}"], expected)
            near(last[f"effective.{name}"], expected + (ALPHA * pressure if name != "xy" else 0))
        near(last["most"], -load)
        near(last["least"], 0)
        along = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
        self.assertAlmostEqual(abs(along @ [last["direction.x"], last["direction.y"]]), 1, delta=1e-9)
        self.assertGreater(max(last["direction.x"], last["direction.y"], key=abs), 0)
        # Mohr's circle: the normal of the crack makes the angle phi with the compression.
        phi = math.radians(crack + 90 - angle)
        normal, shear = load * math.cos(phi) ** 2 - pressure, load * abs(math.sin(phi) * math.cos(phi))
        self.assertAlmostEqual(last["tendency"], shear / normal, delta=1e-9)
        self.assertAlmostEqual(last["used"], shear / normal / FRICTION, delta=1e-9)
        self.assertEqual(last["state"], 0)
        # The same as fields with names, also at the start, where sides and walls have no load yet.
        self.assertEqual(result.written(), [0, 1, 2])
        for time in (0, 2):
            fields = result.fields(time)
            for component, expected in (("xx", xx), ("yy", yy), ("xy", xy)):
                near(np.abs(fields[f"rock.stress.{component}"] - expected).max(), 0)
            near(np.abs(fields["pore.pressure"] - pressure).max(), 0)
            self.assertEqual(fields["pore.velocity"].shape[1], 2)
            self.assertEqual(fields.grid.component_names["rock.stress[Pa]"], ["xx", "yy", "xy"])
            self.assertEqual(fields.grid.component_names["pore.velocity[m/s]"], ["x", "y", "z"])
        self.assertEqual(set(result.fields(0).names), set(result.fields(2).names))
        self.assertEqual(set(result.fractures(0).names), set(result.fractures(2).names))
        holder.cleanup()

    def test_turned_and_mirrored(self):
        for angle, crack in ((20, 85), (-20, -85), (110, 175), (63, 120), (63, 0)):
            with self.subTest(angle=angle, crack=crack):
                self.check(angle, crack)

    def test_slip_tendency_without_fluid_pressure_is_the_tangent(self):
        holder, result = run(scene(20, 20 + 90 - 31, pressure=0.0))
        self.assertAlmostEqual(result["tendency"][-1], math.tan(math.radians(31)), delta=1e-9)
        holder.cleanup()

    def test_finite_elements_disturbed_and_two_processes(self):
        self.check(20, 85, rock="fem")
        self.check(20, 85, factor=1 + 1e-9)
        self.check(20, 85, processes=2)

    def test_walls_that_have_parted_have_used_their_friction_up(self):
        text = scene(0, 90, pressure=PRESSURE)
        text = text.replace("initial_aperture: 0.1 mm,", "initial_aperture: 0.1 mm, prescribed: {feed: {at: [0.9 m, 0.8 m], pressure: 60 MPa}},")
        holder, result = run(text)
        self.assertEqual(result["state"][-1], 2)
        self.assertEqual(result["used"][-1], 1)
        holder.cleanup()


class Velocity(unittest.TestCase):
    def test_of_a_linear_pressure(self):
        gradient = np.array([3e5, -7e5])
        for angle in (0, 25, -25, 140):
            for kind in ("unstructured", "structured"):
                with self.subTest(angle=angle, kind=kind):
                    holder, result = run(FLOW.format(kind=kind, angle=float(angle), pressure=f"(1e6 + {gradient[0]}*x + ({gradient[1]})*y) Pa"))
                    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
                    turn = np.array([[c, -s], [s, c]])
                    expected = -turn @ np.diag([3e-14, 1e-14]) @ turn.T @ gradient / 2e-3
                    for probe in ("velocity", "mean"):
                        found = [result[f"{probe}.{axis}"][-1] for axis in "xy"]
                        np.testing.assert_allclose(found, expected, rtol=1e-9)
                    np.testing.assert_allclose(result.fields(0)["pore.velocity"], np.tile(expected, (len(result.fields().cells), 1)), rtol=1e-8)
                    holder.cleanup()


if __name__ == "__main__":
    unittest.main()
