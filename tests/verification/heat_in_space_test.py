#!/usr/bin/python3
"""heat_in_space_test.py SPREKK [MPIEXEC]: heat in rock and fractures in space: linear temperatures, which are exact; uniform ones, which
stay whatever flows; fluid at rest whose density follows the temperature; a disc of Lauwerier; balances.

Twins: fractures in general position, mirrored, values that are disturbed by 1e-9, and two processes. Extruded scenes have a test of
their own (extruded_scenes_test.py)."""

import math
import unittest

import numpy as np

from hexahedra import TURN, mesh_file
from scene_runs import on_two_processes
from scenes_in_space import CUTS, SIDES, SpaceRuns, linear

LINEAR = "(300 + x/m - 2*y/m + 0.5*z/m) K"
TENSOR = "{xx: 1 W/(m*K), yy: 2 W/(m*K), zz: 1.5 W/(m*K), xy: 0.3 W/(m*K), yz: -0.2 W/(m*K), xz: 0.4 W/(m*K)}"
BOX = "box: {x: [0 m, 1 m], y: [0 m, 1.2 m], z: [0 m, 0.9 m]}"


def corners(fractures):
    return "  fractures:\n" + "".join(f"    {name}: {{points: {[[f'{float(c)!r} m' for c in point] for point in points]}}}\n".replace("'", "")
                                      for name, points in fractures.items())


def conduction(geometry, mesh, sides, kind="mpfa", tensor=TENSOR, water=1e-9):
    """A body whose sides have a linear temperature, after a time so long that nothing is stored any more."""
    given = ", ".join(f"{side}: {{temperature: {LINEAR}}}" for side in sides)
    has_fractures = "fractures" in geometry or "file" in geometry
    return f"""
name: conduction
geometry:
  {geometry}
{mesh}
components:
  heat: {{type: matrix_heat/{kind}, conductivity: {tensor}, heat_capacity: 1e6 J/(m^3*K), boundary: {{{given}}}}}
""" + (f"""
  water: {{type: fracture_heat/tpfa, aperture: 1 mm, conductivity: {water} W/(m*K), heat_capacity: 4e6 J/(m^3*K), boundary: {{{given}}}}}
couplers: [{{type: heat_exchange, between: [heat, water], conductance: 1e11 W/(m^2*K)}}]
schedule: [{{solve: [heat, water]}}]
""" if has_fractures else "schedule: [{solve: heat}]\n") + "time: {end: 1e20 s, step: 1e20 s}\n"


def flowing(rate=1e-6, start="350 K", schedule="[{solve: [pore, conduit, heat, water]}]", fractures=None):
    """Water flows through a box with fractures in general position; none has another temperature than `start`, but for what is injected."""
    fractures = fractures or {**CUTS, "disc": None}
    text = corners({name: points for name, points in fractures.items() if points})
    if "disc" in fractures:
        text += "    disc: {center: [0.75 m, 0.35 m, 0.3 m], strike: 40 deg, dip: 65 deg, radius: 0.15 m}\n"
    return f"""
name: flowing
geometry:
  {BOX}
{text}
mesh: {{size: 0.5 m, fracture_size: 0.3 m, growth: 0.5}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, fluid_heat_capacity: 4e6 J/(m^3*K), conductivity: 2 W/(m*K)}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-13 m^2, porosity: 0.1, boundary: {{left: {{pressure: 20 kPa}}, top: {{pressure: "(5 + 10*x/m) kPa"}}}}}}
  conduit: {{type: fracture_flow/mfd, initial_aperture: 0.1 mm, injection: {{well: {{fracture: one, rate: {rate!r} m^3/s}}}}, boundary: {{back: {{pressure: 0 Pa}}}}}}
  heat: {{type: matrix_heat/mpfa, heat_capacity: 2.2e6 J/(m^3*K), initial_temperature: "{start}"}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: "{start}"}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: heat_advection, between: [pore, conduit, heat, water], injected: {{well: {{temperature: 350 K}}}}}}
  - {{type: heat_exchange, between: [heat, water]}}
schedule: {schedule}
time: {{end: 3 h, step: 1 h}}
"""


def at_rest(gravity):
    """A closed box whose temperature is linear along gravity, and so is the density: T = 350 + 4 s, rho = 1000 (1 - 1e-3 (T - 350))."""
    size = math.hypot(*gravity)
    s = "(" + " + ".join(f"({g / size!r})*{axis}" for g, axis in zip(gravity, "xyz")) + ")"
    temperature, pressure = f'"(350 + 4*{s}/m) K"', f'"(2e6 + 1e3*{size!r}*({s}/m - 2e-3*({s}/m)^2)) Pa"'
    given = ", ".join(f"{side}: {{temperature: {temperature}}}" for side in SIDES)
    return f"""
name: at_rest
geometry:
  {BOX}
{corners(CUTS)}    disc: {{center: [0.75 m, 0.35 m, 0.3 m], strike: 40 deg, dip: 65 deg, radius: 0.15 m}}
mesh: {{size: 0.5 m, fracture_size: 0.3 m, growth: 0.5}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, fluid_density: 1000 kg/m^3, fluid_heat_capacity: 4e6 J/(m^3*K), fluid_expansion: 1e-3 1/K,
  conductivity: 2 W/(m*K), gravity: [{', '.join(f'{g!r} m/s^2' for g in gravity)}]}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: {{along: 1e-13 m^2, across: 4e-14 m^2, strike: 30 deg, dip: 50 deg}}, porosity: 0.1, initial_pressure: {pressure}}}
  conduit: {{type: fracture_flow/mfd, initial_aperture: 0.1 mm, initial_pressure: {pressure}}}
  heat: {{type: matrix_heat/mpfa, heat_capacity: 2e6 J/(m^3*K), initial_temperature: {temperature}, boundary: {{{given}}}}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 1e-15 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: {temperature}, boundary: {{{given}}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: heat_advection, between: [pore, conduit, heat, water]}}
  - {{type: heat_exchange, between: [heat, water], conductance: 1e12 W/(m^2*K)}}
  - {{type: buoyancy, between: [pore, conduit, heat, water], reference_temperature: 350 K}}
schedule: [{{solve: [pore, conduit, heat, water]}}]
newton: {{residual: 1e-14, update: 1e-13}}
time: {{end: 10 day, step: 5 day}}
"""


def warmed(geometry, mesh, boundary):
    """A body of rock that is warmed by 30 K."""
    return f"""
name: warmed
geometry:
  {geometry}
{mesh}
components:
  heat: {{type: matrix_heat/prescribed, temperature: "(350 + 30*t/s) K"}}
  rock: {{type: poromechanics/fem, young_modulus: 10 GPa, poisson_ratio: 0.25, boundary: {{{boundary}}}}}
couplers: [{{type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}}]
schedule: [{{solve: rock}}]
time: {{end: 1 s, step: 1 s}}
output: {{fields: true}}
"""


def quarter(cells, steps):
    """Water enters a horizontal fracture in its corner, and gives its heat off to the rock above and below."""
    return f"""
name: quarter
geometry:
  box: {{x: [0 m, 20 m], y: [0 m, 20 m], z: [-4 m, 4 m]}}
  fractures: {{main: {{points: [[0 m, 0 m, 0 m], [20 m, 0 m, 0 m], [20 m, 20 m, 0 m], [0 m, 20 m, 0 m]]}}}}
mesh: {{kind: structured, shape: hexahedra, cells: [{cells}, {cells}, {2 * cells}]}}
materials: {{fluid_heat_capacity: 4e6 J/(m^3*K), heat_capacity: 2.5e6 J/(m^3*K),
  conductivity: {{xx: 0.01 W/(m*K), yy: 0.01 W/(m*K), zz: 2.5 W/(m*K)}}}}
components:
  conduit: {{type: fracture_flow/mfd, viscosity: 1 mPa*s, fluid_compressibility: 0 1/Pa, initial_aperture: 0.1 mm,
    injection: {{well: {{at: [0.1 m, 0.1 m, 0 m], rate: 2e-4 m^3/s}}}}, boundary: {{right: {{pressure: 0 Pa}}, back: {{pressure: 0 Pa}}}}}}
  heat: {{type: matrix_heat/tpfa}}
  water: {{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K)}}
couplers:
  - {{type: heat_advection, between: [conduit, water], injected: {{well: {{temperature: 1 K}}}}}}
  - {{type: heat_exchange, between: [heat, water], conductance: 1e9 W/(m^2*K)}}
schedule: [{{solve: conduit}}, {{solve: [heat, water]}}]
time: {{end: 5e5 s, step: {5e5 / steps!r} s}}
output: {{fields: true}}
"""


class HeatInSpace(SpaceRuns):
    def assert_linear_temperatures(self, results, within=1e-9):
        rock = results.fields()
        exact = linear(rock.centres) + 299
        self.assertLess(np.abs(rock["heat.temperature"] - exact).max(), within)
        if next(results.folder.glob("fractures_*.vtu"), None):
            water = results.fractures()
            self.assertLess(np.abs(water["water.temperature"] - (linear(water.centres) + 299)).max(), within)

    def test_linear_temperatures_are_exact(self):
        along_axes = {"one": [[0.5, 0, 0], [0.5, 1.2, 0], [0.5, 1.2, 0.9], [0.5, 0, 0.9]],
                      "other": [[0, 0, 0.3], [1, 0, 0.3], [1, 1.2, 0.3], [0, 1.2, 0.3]]}
        for mesh, fractures, kind, tensor, water in (
                ("mesh: {size: 0.3 m}", CUTS, "mpfa", TENSOR, 1e-9),
                ("mesh: {kind: structured, shape: wedges, cells: [4, 4, 3]}", along_axes, "mpfa", TENSOR, 1e-9),
                # Along the rectangles of fractures much is conducted.
                ("mesh: {kind: structured, shape: hexahedra, cells: [4, 4, 3]}", along_axes, "mpfa", TENSOR, 1e3),
                ("mesh: {kind: structured, shape: hexahedra, cells: [4, 4, 3]}", along_axes, "tpfa", "2 W/(m*K)", 1e3)):
            with self.subTest(mesh, kind=kind):
                self.assert_linear_temperatures(self.run_text(conduction(f"{BOX}\n{corners(fractures)}", mesh, SIDES, kind, tensor, water)))

    def test_heat_along_triangles_of_fractures_is_told_where_it_matters(self):
        for water, told in ((1e3, True), (1e-9, False)):
            text = conduction(f"{BOX}\n{corners(CUTS)}", "mesh: {size: 0.5 m}", SIDES, water=water)
            results = self.run_text(text)
            self.assertEqual("two-point fluxes along fractures" in (results.folder / "run.json").read_text(), told, water)

    def test_they_are_in_bent_cells_turned_about_no_axis_and_mirrored(self):
        for turn, wedges in ((np.eye(3), False), (TURN, True), (TURN @ np.diag([1, -1, 1]), False)):
            with self.subTest(wedges=wedges):
                name = f"bent_{next(self.numbers)}.msh"
                self.write(mesh_file(turn, wedges=wedges), name)
                self.assert_linear_temperatures(self.run_text(conduction(f"file: {name}", "", ("west", "others"))))

    def test_a_uniform_temperature_stays_whatever_flows(self):
        """Reference: 350 K; through walls, crossings and sides, together and in turn."""
        for schedule in ("[{solve: [pore, conduit, heat, water]}]", "[{solve: [pore, conduit]}, {solve: [heat, water]}]", "[{solve: [heat, water]}, {solve: [pore, conduit]}]"):
            with self.subTest(schedule):
                results = self.run_text(flowing(schedule=schedule))
                for values in (results.fields()["heat.temperature"], results.fractures()["water.temperature"]):
                    self.assertLess(np.abs(values - 350).max(), 350e-11)

    def test_what_flows_in_is_stored_or_flows_out(self):
        results = self.run_text(flowing(start="(340 + 10*x/m) K"))
        brought = 350 * 4e6 * 1e-6 * 3 * 3600  # J, by the well
        self.assertLess(np.abs(results.history["heat_balance_error[J]"]).max(), 1e-12 * brought)
        coldest, hottest = (getattr(results.fields()["heat.temperature"], what)() for what in ("min", "max"))
        self.assertGreater(hottest - coldest, 1)

    def test_twins(self):
        """One schedule and the other have one answer once passes repeat; 1 + 1e-9; two processes."""
        text = flowing(start="(340 + 10*x/m) K")
        one = self.run_text(text)
        near = self.run_text(flowing(rate=1e-6 * (1 + 1e-9), start="(340 + 10*x/m) K"))
        self.assertLess(self.largest_difference(one, near), 1e-8)
        turns = self.run_text(flowing(start="(340 + 10*x/m) K", schedule="[{iterate: {steps: [{solve: [pore, conduit]}, {solve: [heat, water]}]}}]"))
        difference = np.abs(one.fields()["heat.temperature"] - turns.fields()["heat.temperature"]).max()
        self.assertLess(difference, 1e-7)

    @on_two_processes
    def test_two_processes(self):
        text = flowing(start="(340 + 10*x/m) K")
        one, two = self.run_text(text), self.run_text(text, processes=2)
        self.assertLess(self.largest_difference(one, two), 1e-9)

    def test_a_restart_goes_on_to_the_bit(self):
        text = flowing(start="(340 + 10*x/m) K")
        whole = self.run_text(text)
        half = self.run_text(text, "time.end=1 h")
        scene = self.write(text, f"scene_{next(self.numbers)}.yaml")
        self.assert_same_bits(self.run_scene(scene, restart=half.folder), whole)

    def test_fluid_with_a_linear_density_stays_at_rest(self):
        """Reference: no flux; over what the lightest fluid would have in the densest."""
        for gravity in ((0.0, 0.0, -10.0), (3.0, -4.0, -8.0)):
            with self.subTest(gravity):
                results = self.run_text(at_rest(gravity))
                scale = math.hypot(*gravity) * 1000 * 1e-3 * 4 * 1e-13 / 1e-3
                self.assertLess(np.abs(results.fields()["pore.velocity"]).max(), 1e-8 * scale)

    def test_rock_that_is_warmed_expands_freely_or_is_pressed(self):
        """Reference: u = 1e-5 30 x without stress where rollers hold three sides; -3 K alpha Delta T where they hold all."""
        pressed = -3 * 10e9 / (3 * (1 - 2 * 0.25)) * 1e-5 * 30
        for mesh in ("{size: 0.4 m}", "{kind: structured, shape: hexahedra, cells: [3, 3, 2]}", "{kind: structured, shape: wedges, cells: [3, 3, 2]}"):
            with self.subTest(mesh):
                rollers = ", ".join(f"{side}: {{displacement_normal: 0 m}}" for side in ("left", "front", "bottom"))
                rock = self.run_text(warmed(BOX, f"mesh: {mesh}", rollers)).fields()
                self.assertLess(np.abs(rock["rock.displacement"] - 3e-4 * rock.points).max(), 1e-10 * 3e-4)
                self.assertLess(np.abs(rock["rock.stress"]).max(), 1e-9 * abs(pressed))
        for turn, wedges in ((TURN, False), (TURN @ np.diag([1, -1, 1]), True)):
            with self.subTest(wedges=wedges):
                name = f"warm_{next(self.numbers)}.msh"
                self.write(mesh_file(turn, wedges=wedges, fault=False), name)
                rock = self.run_text(warmed(f"file: {name}", "", "west: {displacement_normal: 0 m}, others: {displacement_normal: 0 m}")).fields()
                self.assertLess(np.abs(rock["rock.displacement"]).max(), 1e-12 * 3e-4 + 1e-17)
                self.assertLess(np.abs(rock["rock.stress"] - np.array([pressed] * 3 + [0] * 3)).max(), 1e-9 * abs(pressed))

    def test_a_fracture_fed_at_a_point_warms_the_rock_as_in_lauwerier(self):
        """Reference: Lauwerier 1955 with the area that the fluid has passed in place of the distance, T = erfc((k A/(c_f Q))/sqrt(D (t - A a/Q))), A = pi r^2/4
        in a quarter; while flow is radial (r < L/2: the shares of a square's sides are (r/L)^4)."""
        errors = []
        for cells, steps in ((10, 20), (20, 40)):
            water = self.run_text(quarter(cells, steps)).fractures()
            r = np.hypot(*water.centres[:, :2].T)
            near = (r > 4) & (r < 9)
            area = math.pi * r[near] ** 2 / 4
            late = 5e5 - area * 1e-4 / 2e-4
            exact = np.array([math.erfc(each) for each in 2.5 * area / (4e6 * 2e-4) / np.sqrt(1e-6 * late)])
            errors.append(np.sqrt(np.mean((water["water.temperature"][near] - exact) ** 2) / np.mean(exact ** 2)))
        print("Lauwerier from a point: errors", errors)
        # Shares of a point beside a corner add up, and none of them takes anything out.
        brought = self.run_text(quarter(10, 20), "time={end: 1e4 s, step: 1e3 s}").history["heat_injected[J]"][-1]
        self.assertLess(abs(brought / (2e-4 * 4e6 * 1e4) - 1), 1e-9)
        self.assertGreater(math.log2(errors[0] / errors[1]), 0.9)  # upwinding and backward Euler are of first order
        self.assertLess(errors[1], 0.035)


if __name__ == "__main__":
    unittest.main()
