#!/usr/bin/python3
"""depth_profiles_test.py SPREKK [MPIEXEC]: values with depth by name, hydrostatic, lithostatic and geothermal, in a plane and in space. What is given so
is in equilibrium: nothing moves, flows or cools, with unlike horizontal stresses, and the same as by formulas."""

import unittest

import numpy as np

from scene_runs import on_two_processes
from scenes_in_space import SpaceRuns

G, RHO, WET, TABLE, GROUND = 9.80665, 1020.0, 2350.0, 90.0, 120.0


def scene(dimension, of_pressure, of_stress, of_heat, ground=GROUND):
    """Half of the box lies above the water table only where `TABLE` is below its top."""
    down = "yz"[dimension - 2]
    z = ", z: [0 m, 100 m]" if dimension == 3 else ""
    ratios = {"x": 0.7, "y": 0.45 if dimension == 3 else 1.0, "z": 1.0}
    axes = "xyz"[:dimension]
    stress = ", ".join(f"{axis}{axis}: {of_stress(ratios[axis])}" for axis in axes) + ", " + ", ".join(
        f"{pair}: 0 Pa" for pair in (("xy",) if dimension == 2 else ("xy", "yz", "xz")))
    held = "left: {displacement_x: 0 m}, bottom: {displacement_%s: 0 m}" % down + (", front: {displacement_y: 0 m}" if dimension == 3 else "")
    sides = f"{held}, right: {{normal_stress: {of_stress(ratios['x'])}}}, top: {{normal_stress: {of_stress(1.0)}}}" + (
        f", back: {{normal_stress: {of_stress(ratios['y'])}}}" if dimension == 3 else "")
    gravity = "[0 m/s^2, -9.80665 m/s^2]" if dimension == 2 else "[0 m/s^2, 0 m/s^2, -9.80665 m/s^2]"
    return f"""
name: profiles
geometry: {{box: {{x: [0 m, 80 m], y: [0 m, 100 m]{z}}}}}
mesh: {{size: 40 m}}
materials: {{gravity: {gravity}, fluid_density: {RHO} kg/m^3, rock_density: {WET} kg/m^3, viscosity: 1 mPa*s}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-15 m^2, storage: 1e-10 1/Pa, initial_pressure: {of_pressure}, boundary: {{right: {{pressure: {of_pressure}}}}}}}
  rock: {{type: poromechanics/fem, order: second, young_modulus: 5 GPa, poisson_ratio: 0.25, initial_stress: {{{stress}}}, boundary: {{{sides}}}}}
  heat: {{type: matrix_heat/mpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: {of_heat},
         boundary: {{top: {{temperature: {of_heat}}}, bottom: {{temperature: {of_heat}}}}}}}
couplers: [{{type: biot, between: [pore, rock], biot_coefficient: 0.8}}]
schedule: [{{solve: [pore, rock]}}, {{solve: heat}}]
time: {{end: 1 year, step: 0.5 year}}
output:
  probes:
    u: {{of: rock.displacement, at: [61 m, 47 m{", 83 m" if dimension == 3 else ""}]}}
    p: {{of: pore.pressure, at: [61 m, 47 m{", 83 m" if dimension == 3 else ""}]}}
    T: {{of: heat.temperature, at: [61 m, 47 m{", 83 m" if dimension == 3 else ""}]}}
"""


def by_name(dimension, ground=GROUND):
    return scene(dimension, f"{{hydrostatic: {{water_table: {TABLE} m, pressure: 0.1 MPa}}}}",
                 lambda ratio: f"{{lithostatic: {{surface: {ground} m, ratio: {ratio}, stress: -0.1 MPa}}}}",
                 "{geothermal: {surface: 120 m, temperature: 9 degC, gradient: 31 K/km}}".replace("9 degC", "282.15 K"))


def by_formula(dimension):
    down = "yz"[dimension - 2]
    return scene(dimension, f'"(1e5 + {RHO * G!r}*({TABLE} - {down}/m)) Pa"',
                 lambda ratio: f'"({ratio}*(-1e5 - {WET * G!r}*({GROUND} - {down}/m))) Pa"', f'"(282.15 + 0.031*(120 - {down}/m)) K"')


class DepthProfiles(SpaceRuns):
    def test_nothing_moves(self):
        for dimension in (2, 3):
            run = self.run_text(by_name(dimension))
            high = 47 if dimension == 2 else 83
            self.assertLess(max(np.abs(run.history[name]).max() for name in run.history if name.startswith("u.")), 1e-12)
            self.assertLess(np.abs(run["p"] / (1e5 + RHO * G * (TABLE - high)) - 1).max(), 1e-12)
            self.assertLess(np.abs(run["T"] / (282.15 + 0.031 * (120 - high)) - 1).max(), 1e-12)
            notes = " ".join(note["text"] for note in run.record["notes"])
            self.assertNotIn("out of balance", notes)
            formula = self.run_text(by_formula(dimension))
            for column in ("p", "T"):
                self.assertLess(np.abs(run[column] / formula[column] - 1).max(), 1e-13)

    @on_two_processes
    def test_two_processes(self):
        run = self.run_text(by_name(2), processes=2)
        self.assertLess(np.abs(run["p"] / (1e5 + RHO * G * (TABLE - 47)) - 1).max(), 1e-12)

    def test_what_has_no_meaning_is_refused(self):
        file = self.write(by_name(2), "profiles.yaml")
        for setting, words in (("components.pore.permeability={hydrostatic: {water_table: 1 m}}", ("'permeability' cannot be hydrostatic", "in Pa")),
                               ("components.heat.source={lithostatic: {surface: 1 m}}", ("cannot be lithostatic",)),
                               ("components.pore.boundary.left.pressure={hydrostatic: {table: 1 m}}", ("table", "water_table")),
                               ("components.pore.boundary.left.pressure={hydrostatic: {water_table: 1 m}, unit: Pa}", ("unit",)),
                               ("components.pore.boundary.left.pressure={hydrostatic: 90 m}", ("hydrostatic",)),
                               ("components.pore.boundary.left.pressure={hydrostatc: {water_table: 1 m}}", ("hydrostatc", "hydrostatic")),
                               ("components.rock.initial_stress.yy={lithostatic: {surface: 50 m}}", ("above the 'surface'",)),
                               ("components.heat.boundary.left.temperature={geothermal: {surface: 50 m, temperature: 280 K}}", ("gradient",))):
            done = self.call("check", file, setting)
            self.assertEqual(done.returncode, 2, setting + done.stdout + done.stderr)
            self.assertTrue(all(word in done.stderr for word in words), setting + done.stderr)


if __name__ == "__main__":
    unittest.main()
