#!/usr/bin/python3
"""tracer_test.py SPREKK [MPIEXEC]: a dissolved tracer in rock and fractures, against closed forms: a column with sorption and decay (Ogata and Banks 1961;
Bear 1979), a fracture that loses tracer to the rock by diffusion (Tang, Frind and Sudicky 1981), decay alone; uniform concentrations, which stay whatever
flows; balances. In a plane and in space; turned, mirrored, disturbed by 1e-9, in other schedules, on two processes; what contradicts is refused or told."""

import math
import unittest

import numpy as np

from scene_runs import MPIEXEC, ROOT, on_two_processes
from scenes_in_space import CUTS, SpaceRuns

# A column: the Darcy velocity is 1e-6 m/s, so that water moves with 5e-6 m/s.
POROSITY, SPEED, DIFFUSION, RETARDATION, DECAY = 0.2, 5e-6, 1e-6, 2.0, 2e-6
END = 4e5  # s


def column(cells, steps, kind="tpfa", box="x: [0 m, 4 m], y: [0 m, 0.1 m]", mesh="cells: [{cells}, 1], shape: quadrilaterals"):
    return f"""
name: column
geometry: {{box: {{{box}}}}}
mesh: {{kind: structured, {mesh.format(cells=cells)}}}
materials: {{porosity: {POROSITY}}}
components:
  pore: {{type: matrix_flow/tpfa, permeability: 1e-12 m^2, viscosity: 1 mPa*s, storage: 0 1/Pa,
    boundary: {{left: {{flux: -1e-6 m/s}}, right: {{pressure: 0 Pa}}}}}}
  salt: {{type: matrix_transport/{kind}, diffusion: {DIFFUSION!r} m^2/s, retardation: {RETARDATION}, decay: {DECAY!r} 1/s,
    boundary: {{left: {{concentration: 1 kg/m^3}}}}}}
couplers: [{{type: tracer_advection, between: [pore, salt]}}]
schedule: [{{solve: pore}}, {{solve: salt}}]
time: {{end: {END!r} s, step: {END / steps!r} s}}
"""


def of_column(x, t):
    """With u = v sqrt(1 + 4 lambda R D/v^2): (e^((v-u)x/2D) erfc((R x - u t)/sqrt(4 D R t)) + e^((v+u)x/2D) erfc((R x + u t)/sqrt(4 D R t)))/2."""
    v, d, r = SPEED, DIFFUSION, RETARDATION
    u = v * math.sqrt(1 + 4 * DECAY * r * d / v**2)
    return 0.5 * sum(math.exp((v + sign * u) * x / (2 * d)) * math.erfc((r * x + sign * u * t) / math.sqrt(4 * d * r * t)) for sign in (-1, 1))


# A fracture in a block: b is its half-width, R' and D' are those of the rock.
LENGTH, APERTURE, FLOW, IN_WATER, IN_ROCK, PORES = 2.0, 1e-4, 2e-9, 1.6e-9, 1e-10, 0.05
R_WATER, R_ROCK, HALF_LIFE, TWO_YEARS = 1.5, 3.0, 2e7, 2e7


def fracture(n, shift=0.0, mirror=False, more=""):
    """Half of the tracer's way into the rock is resolved by cells that become larger with n; the rock conducts next to nothing along the fracture."""
    sides = ("right", "left") if mirror else ("left", "right")
    return f"""
name: fracture
geometry: {{box: {{x: [0 m, {LENGTH} m], y: [-0.2 m, 0.2 m]}}, fractures: {{main: {{points: [[0 m, 0 m], [{LENGTH} m, 0 m]]}}}}}}
mesh: {{kind: structured, cells: [{20 * n}, {40 * n}], shape: quadrilaterals}}
components:
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 0 1/Pa, initial_aperture: {APERTURE!r} m,
    law: {{type: constant, transmissivity: 1e-12 m^3}}, boundary: {{{sides[0]}: {{pressure: {FLOW * 1e-3 / 1e-12 * LENGTH * (1 + shift)!r} Pa}}, {sides[1]}: {{pressure: 0 Pa}}}}}}
  salt: {{type: matrix_transport/tpfa, porosity: {PORES}, diffusion: {{xx: 1e-16 m^2/s, yy: {IN_ROCK!r} m^2/s}}, retardation: {R_ROCK}, decay: {math.log(2) / HALF_LIFE!r} 1/s}}
  water: {{type: fracture_transport/tpfa, aperture: {APERTURE!r} m, diffusion: {IN_WATER!r} m^2/s, retardation: {R_WATER}, decay: {math.log(2) / HALF_LIFE!r} 1/s,
    boundary: {{{sides[0]}: {{concentration: 1 kg/m^3}}}}}}
couplers:
  - {{type: tracer_advection, between: [conduit, water]}}
  - {{type: tracer_exchange, between: [salt, water], conductance: 1 m/s}}
schedule: [{{solve: conduit}}, {{solve: [salt, water]}}]
time: {{end: {TWO_YEARS!r} s, step: {TWO_YEARS / (20 * n)!r} s}}
{more}
"""


def of_fracture(x, y, t):
    """Tang's transform, with diffusion along the fracture, inverted by Talbot's contour (Weideman 2006): c = e^(-x (sqrt(m^2 + k) - m) - |y| sqrt(R'(p + r)/D'))/p,
    m = v/2D, k = (R (p + r) + phi sqrt(R' D' (p + r))/b)/D."""
    points = 32
    theta = np.pi * (2 * np.arange(points) + 1) / points - np.pi
    s = points / t * (0.5017 * theta / np.tan(0.6407 * theta) - 0.6122 + 0.2645j * theta)
    ds = points / t * (0.5017 / np.tan(0.6407 * theta) - 0.5017 * 0.6407 * theta / np.sin(0.6407 * theta) ** 2 + 0.2645j)
    p = s + math.log(2) / HALF_LIFE
    m = FLOW / APERTURE / (2 * IN_WATER)
    k = (R_WATER * p + PORES * np.sqrt(R_ROCK * IN_ROCK * p) * 2 / APERTURE) / IN_WATER
    transform = np.exp(-x * (np.sqrt(m**2 + k) - m) - abs(y) * np.sqrt(R_ROCK * p / IN_ROCK)) / s
    return float(np.real((np.exp(s * t) * transform * ds).sum() / (1j * points)))


def decaying(dimension):
    box = "x: [0 m, 1 m], y: [0 m, 1 m]" + (", z: [0 m, 1 m]" if dimension == 3 else "")
    corners = [[0.2, 0.5], [0.8, 0.5]] if dimension == 2 else [[0.2, 0.5, 0.2], [0.8, 0.5, 0.2], [0.8, 0.5, 0.8]]
    points = str([[f"{c} m" for c in corner] for corner in corners]).replace("'", "")
    return f"""
name: decaying
geometry: {{box: {{{box}}}, fractures: {{cut: {{points: {points}}}}}}}
mesh: {{size: 0.5 m}}
components:
  salt: {{type: matrix_transport/mpfa, porosity: 0.3, diffusion: 1e-9 m^2/s, retardation: 4, decay: 0.1 1/s, initial_concentration: 2 kg/m^3}}
  water: {{type: fracture_transport/tpfa, aperture: 1 mm, diffusion: 1e-9 m^2/s, decay: 0.1 1/s, initial_concentration: 2 kg/m^3}}
couplers: [{{type: tracer_exchange, between: [salt, water]}}]
schedule: [{{solve: [salt, water]}}]
time: {{end: 10 s, step: 1 s}}
"""


# Fluid flows through rock and fractures in space, of which those in the plane are the marks on a side.
BOTH = "[{solve: [pore, conduit]}, {solve: [salt, water]}]"
FLOWING = {2: ("x: [0 m, 1 m], y: [0 m, 1.2 m]", {"one": [[0.3, 0], [0.5, 0.9]], "other": [[0.1, 0.4], [1, 0.7]]}, "{size: 0.2 m, fracture_size: 0.1 m}", "tpfa", "m^2/s"),
           3: ("x: [0 m, 1 m], y: [0 m, 1.2 m], z: [0 m, 0.9 m]", CUTS, "{size: 0.5 m, fracture_size: 0.3 m, growth: 0.5}", "mfd", "m^3/s")}


def flowing(dimension, start="2 kg/m^3", given="2 kg/m^3", rate=1e-6, schedule=BOTH, decay="0 1/s", spread=""):
    box, cuts, mesh, flow, unit = FLOWING[dimension]
    fractures = "".join(f"    {name}: {{points: {[[f'{float(c)!r} m' for c in point] for point in points]}}}\n".replace("'", "") for name, points in cuts.items())
    return f"""
name: flowing
geometry:
  box: {{{box}}}
  fractures:
{fractures}
mesh: {mesh}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, porosity: 0.1}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-13 m^2, boundary: {{left: {{pressure: 20 kPa}}, top: {{pressure: "(5 + 10*x/m) kPa"}}}}}}
  conduit: {{type: fracture_flow/{flow}, initial_aperture: 0.1 mm, injection: {{well: {{fracture: one, rate: {rate!r} {unit}}}}}, boundary: {{right: {{pressure: 0 Pa}}}}}}
  salt: {{type: matrix_transport/mpfa, diffusion: 1e-9 m^2/s, retardation: 2, decay: {decay}, initial_concentration: "{start}",
    boundary: {{left: {{concentration: {given}}}, top: {{concentration: {given}}}}}}}
  water: {{type: fracture_transport/tpfa, aperture: 0.1 mm, diffusion: 1e-9 m^2/s, decay: {decay}, initial_concentration: "{start}"}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: tracer_advection, between: [pore, conduit, salt, water], injected: {{well: {{concentration: {given}}}}}{spread}}}
  - {{type: tracer_exchange, between: [salt, water]}}
schedule: {schedule}
time: {{end: 3 h, step: 1 h}}
"""


def crossing(sides, schedule):
    """Four equal arms with pressures 4, 3, 1 and 0 at their ends, on the sides in this order: the first two give fluid to the crossing."""
    one, two, three, four = sides
    return f"""
name: crossing
geometry:
  box: {{x: [0 m, 10 m], y: [0 m, 10 m]}}
  fractures: {{along: {{points: [[0 m, 5 m], [10 m, 5 m]]}}, across: {{points: [[5 m, 0 m], [5 m, 10 m]]}}}}
mesh: {{size: 1 m}}
components:
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 0 1/Pa, initial_aperture: 1 mm,
    boundary: {{{one}: {{pressure: 4 Pa}}, {two}: {{pressure: 3 Pa}}, {three}: {{pressure: 1 Pa}}, {four}: {{pressure: 0 Pa}}}}}}
  water: {{type: fracture_transport/tpfa, aperture: 1 mm, diffusion: 1e-14 m^2/s,
    boundary: {{{one}: {{concentration: 1 kg/m^3}}, {two}: {{concentration: 0.25 kg/m^3}}}}}}
couplers: [{{type: tracer_advection, between: [conduit, water]}}]
schedule: {schedule}
time: {{end: 1e9 s, step: 1e8 s}}
output:
  probes:
    left: {{of: water.concentration, at: [4.9 m, 5 m]}}
    bottom: {{of: water.concentration, at: [5 m, 4.9 m]}}
    top: {{of: water.concentration, at: [5 m, 5.1 m]}}
    right: {{of: water.concentration, at: [5.1 m, 5 m]}}
"""


def oblique(q, diffusion, spread):
    """A uniform flow q (m/s) through a box, which carries a cloud."""
    axes = "xyz"[:len(q)]
    pressure = '"(' + " + ".join(f"({-float(each) * 1e9!r})*{axis}/m" for each, axis in zip(q, axes)) + ') Pa"'
    names = ("left", "right", "bottom", "top") + (("front", "back") if len(q) == 3 else ())
    sides = ", ".join(f"{side}: {{pressure: {pressure}}}" for side in names)
    cloud = '"exp(-20*(' + " + ".join(f"({axis}/m - 0.5)^2" for axis in axes) + ')) kg/m^3"'
    return f"""
name: oblique
geometry: {{box: {{{", ".join(f"{axis}: [0 m, 1 m]" for axis in axes)}}}}}
mesh: {{size: {0.15 if len(q) == 2 else 0.3} m}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-12 m^2, viscosity: 1 mPa*s, storage: 0 1/Pa, boundary: {{{sides}}}}}
  salt: {{type: matrix_transport/mpfa, porosity: 0.2, diffusion: {diffusion}, initial_concentration: {cloud}}}
couplers: [{{type: tracer_advection, between: [pore, salt]{spread}}}]
schedule: [{{solve: pore}}, {{solve: salt}}]
time: {{end: 1e5 s, step: 2e4 s}}
"""


SPREAD = ", longitudinal_dispersivity: 0.05 m, transverse_dispersivity: 0.01 m"
UNEVEN = {"start": "(1 + x/m) kg/m^3", "given": "3 kg/m^3"}
AMOUNT = {2: "kg/m", 3: "kg"}


def figures(results):
    """The columns of the history that are no round-off."""
    return [column for column in results.history if not any(word in column for word in ("error", "residual", "iterations", "seconds"))]


def concentrations(results):
    return results.fields()["salt.concentration"], results.fractures()["water.concentration"]


class Tracer(SpaceRuns):
    def test_a_front_in_a_column_with_sorption_and_decay(self):
        """Reference: of_column. First order, by upwinding and backward Euler."""
        for kind in ("tpfa", "mpfa"):
            errors = []
            for cells in (80, 160):
                rock = self.run_text(column(cells, cells, kind)).fields()
                exact = np.array([of_column(x, END) for x in rock.centres[:, 0]])
                errors.append(np.sqrt(((rock["salt.concentration"] - exact) ** 2).sum() / (exact**2).sum()))
            print("Ogata and Banks:", kind, errors)
            self.assertGreater(math.log2(errors[0] / errors[1]), 0.9)
            self.assertLess(errors[1], 0.02)

    def test_a_column_in_space(self):
        """Reference: the column in the plane, to round-off; with the axis in another direction."""
        plane = self.run_text(column(20, 5)).fields()
        space = column(20, 5, box="x: [0 m, 0.1 m], y: [0 m, 0.2 m], z: [0 m, 4 m]", mesh="cells: [1, 1, {cells}], shape: hexahedra")
        solid = self.run_text(space.replace("left:", "bottom:").replace("right:", "top:")).fields()
        self.assertLess(np.abs(solid["salt.concentration"][np.argsort(solid.centres[:, 2])] - plane["salt.concentration"][np.argsort(plane.centres[:, 0])]).max(), 1e-10)

    def test_a_fracture_that_loses_tracer_to_the_rock(self):
        """Reference: of_fracture. First order."""
        errors = []
        for n in (1, 2):
            results = self.run_text(fracture(n))
            rock, water = results.fields(), results.fractures()
            in_water = np.array([of_fracture(x, 0, TWO_YEARS) for x in water.centres[:, 0]])
            in_rock = np.array([of_fracture(x, y, TWO_YEARS) for x, y in rock.centres[:, :2]])
            errors.append([np.sqrt(((ours - exact) ** 2).sum() / (exact**2).sum())
                           for ours, exact in ((water["water.concentration"], in_water), (rock["salt.concentration"], in_rock))])
        print("Tang, Frind and Sudicky:", errors)
        for one, two in zip(*errors):
            self.assertGreater(math.log2(one / two), 0.85)
            self.assertLess(two, 0.04)

    def test_decay_alone(self):
        """Reference: backward Euler, 2/(1 + r dt)^n, to round-off; it is of first order. Dissolved and sorbed, in rock and in fractures."""
        for dimension in (2, 3):
            results = self.run_text(decaying(dimension))
            for values in concentrations(results):
                self.assertLess(np.abs(values * 1.1**10 / 2 - 1).max(), 1e-12)
            self.assertLess(np.abs(results.history[f"tracer_balance_error[{AMOUNT[dimension]}]"]).max(), 1e-14)
            self.assertTrue(any("nothing carries" in str(note) for note in results.notes), results.notes)

    def test_a_uniform_concentration_stays_whatever_flows(self):
        """Reference: 2 kg/m^3; and with decay, which is that of the decay alone while all that enters has as much."""
        for dimension in (2, 3):
            for schedule in ("[{solve: [pore, conduit, salt, water]}]", BOTH, "[{solve: [salt, water]}, {solve: [pore, conduit]}]",
                             "[{subcycle: {count: 3, steps: [{solve: [pore, conduit]}]}}, {subcycle: {count: 2, steps: [{solve: [salt, water]}]}}]"):
                with self.subTest(schedule, dimension=dimension):
                    for values in concentrations(self.run_text(flowing(dimension, schedule=schedule))):
                        self.assertLess(np.abs(values - 2).max(), 2e-11)

    def test_it_stays_where_sides_and_ends_of_fractures_leak(self):
        """Reference: 2 kg/m^3, and a balance that closes; where fluid comes through a side that leaks, it has the concentration of that side."""
        for dimension in (2, 3):
            for schedule in ("[{solve: [pore, conduit, salt, water]}]", BOTH):
                with self.subTest(schedule, dimension=dimension):
                    scene = flowing(dimension, schedule=schedule)
                    for given, leaking in (("left: {pressure: 20 kPa}", "left: {outer_pressure: 20 kPa, conductance: 1e-10 m/(Pa*s)}"),
                                           ("top: {pressure: \"(5 + 10*x/m) kPa\"}", "top: {outer_pressure: \"(5 + 10*x/m) kPa\", only_out: true}"),
                                           ("right: {pressure: 0 Pa}", "right: {outer_pressure: 0 Pa, conductance: 1e-6 m/(Pa*s)}")):
                        self.assertIn(given, scene)
                        scene = scene.replace(given, leaking)
                    results = self.run_text(scene)
                    for values in concentrations(results):
                        self.assertLess(np.abs(values - 2).max(), 2e-11)
                    self.assertLess(results["pore.left.outflow"].max(), 0)
                    self.assertLess(np.abs(results["tracer_balance_error"]).max(), 1e-12 * np.abs(results["tracer_injected"]).max())

    def test_it_stays_where_a_fracture_opens_and_slips(self):
        """Reference: 2 kg/m^3."""
        settings = ("components.salt={type: matrix_transport/mpfa, diffusion: 1e-9 m^2/s, initial_concentration: 2 kg/m^3, boundary: {left: {concentration: 2 kg/m^3}}}",
                    "components.water={type: fracture_transport/tpfa, aperture: 0.2 mm, diffusion: 1e-9 m^2/s, initial_concentration: 2 kg/m^3}",
                    "couplers=[{type: biot, between: [pore, rock]}, {type: wall_exchange, between: [pore, conduit]}, {type: wall_traction, between: [rock, contact, conduit]}, "
                    "{type: aperture, between: [contact, conduit]}, {type: tracer_exchange, between: [salt, water]}, "
                    "{type: tracer_advection, between: [pore, conduit, salt, water], injected: {well: {concentration: 2 kg/m^3}}}]",
                    "schedule=[{solve: [pore, rock, conduit, contact]}, {solve: [salt, water]}]", "time.end=12 h", "mesh={size: 1 m, fracture_size: 0.3 m}")
        results = self.run_scene(ROOT / "configs/tutorial/first_scene.yaml", *settings)
        self.assertGreater(np.abs(results.history["slip[m]"][-1] if "slip[m]" in results.history else 1), 0)
        for values in concentrations(results):
            self.assertLess(np.abs(values - 2).max(), 2e-10)

    def test_what_enters_is_stored_decays_or_leaves(self):
        for dimension in (2, 3):
            for schedule in (BOTH, "[{solve: [salt, water]}, {solve: [pore, conduit]}]"):
                with self.subTest(schedule, dimension=dimension):
                    results = self.run_text(flowing(dimension, **UNEVEN, schedule=schedule, decay="1e-4 1/s", spread=SPREAD))
                    unit = AMOUNT[dimension]
                    brought = 3 * 1e-6 * 3 * 3600
                    self.assertGreater(results.history[f"tracer_injected[{unit}]"][-1], 0.5 * brought)
                    self.assertLess(np.abs(results.history[f"tracer_balance_error[{unit}]"]).max(), 1e-12 * brought)
                    for values in concentrations(results):
                        self.assertTrue(0 < values.min() and values.max() < 3 * (1 + 1e-12))

    def test_dispersion_that_is_late_is_told(self):
        for schedule, is_late in ((BOTH, False), ("[{solve: [pore, conduit, salt, water]}]", True)):
            results = self.run_text(flowing(2, **UNEVEN, schedule=schedule, spread=SPREAD))
            self.assertEqual(any("of the step before" in str(note) for note in results.notes), is_late, results.notes)

    def test_more_dispersion_across_than_along_is_told(self):
        for across in (0.02, 0.2):
            file = self.write(flowing(2, **UNEVEN, spread=f", longitudinal_dispersivity: 0.1 m, transverse_dispersivity: {across} m"), f"spread_{across}.yaml")
            said = self.call("check", file)
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertEqual("more across the flow (0.2 m) than along it (0.1 m)" in said.stderr, across > 0.1, said.stderr)

    def test_dispersion(self):
        """Reference: the same scene with that much more diffusion, phi D + alpha_T |q| I + (alpha_L - alpha_T) q q^T/|q|: in a column, in a flow that is oblique to
        all axes, in a plane and in space, along a fracture."""
        spread = self.run_text(column(40, 10).replace("[pore, salt]", "[pore, salt], longitudinal_dispersivity: 0.1 m")).fields()
        diffused = self.run_text(column(40, 10).replace(f"diffusion: {DIFFUSION!r}", f"diffusion: {DIFFUSION + 0.1 * 1e-6 / POROSITY!r}")).fields()
        self.assertLess(np.abs(spread["salt.concentration"] - diffused["salt.concentration"]).max(), 1e-10)
        for dimension in (2, 3):
            with self.subTest(dimension=dimension):
                q = np.array([3e-7, -2e-7, 1e-7][:dimension])
                size = np.linalg.norm(q)
                tensor = 1e-8 * np.eye(dimension) + (0.01 * size * np.eye(dimension) + (0.05 - 0.01) / size * np.outer(q, q)) / 0.2
                names = "xyz"[:dimension]
                explicit = ", ".join(f"{names[i]}{names[j]}: {tensor[i, j]!r} m^2/s" for i in range(dimension) for j in range(i, dimension)).replace("np.float64(", "").replace(")", "")
                spread, diffused = (self.run_text(oblique(q, diffusion, more)).fields()["salt.concentration"]
                                    for diffusion, more in (("1e-8 m^2/s", SPREAD), (f"{{{explicit}}}", "")))
                self.assertGreater(np.ptp(spread), 0.1)
                self.assertLess(np.abs(spread - diffused).max(), 1e-9)
                none = self.run_text(oblique(q, "1e-8 m^2/s", "")).fields()["salt.concentration"]
                self.assertGreater(np.abs(spread - none).max(), 1e-2)
        one = self.run_text(fracture(1).replace("[conduit, water]", "[conduit, water], longitudinal_dispersivity: 0.3 m")).fractures()["water.concentration"]
        two = self.run_text(fracture(1).replace(f"diffusion: {IN_WATER!r}", f"diffusion: {IN_WATER + 0.3 * FLOW / APERTURE!r}")).fractures()["water.concentration"]
        self.assertLess(np.abs(one - two).max(), 1e-10)

    def test_fluid_of_which_nothing_is_told_has_no_tracer(self):
        """Reference: a cell that pure water flushes, c = c_0/(1 + q dt/(phi R V))^n."""
        text = column(1, 10, box="x: [0 m, 1 m], y: [0 m, 1 m]").replace("boundary: {left: {concentration: 1 kg/m^3}}", "initial_concentration: 1 kg/m^3").replace("decay: 2e-06", "decay: 0")
        rock = self.run_text(text).fields()
        self.assertLess(abs(rock["salt.concentration"][0] * (1 + 1e-6 * END / 10 / (POROSITY * RETARDATION)) ** 10 - 1), 1e-12)

    def test_fluid_that_enters_without_a_concentration_is_told(self):
        """Reference: by hand; where it leaves, or has a concentration, there is no note."""
        text = flowing(2)
        entering = text.replace("right: {pressure: 0 Pa}", "right: {pressure: 100 kPa}")
        as_rock = text.replace("boundary: {right: {pressure: 0 Pa}}", "boundary: {right: {as_rock: true}}")
        as_rock = as_rock.replace("left: {pressure: 20 kPa},", "left: {pressure: 20 kPa}, right: {pressure: 100 kPa},")
        as_rock = as_rock.replace("boundary: {left: {concentration", "boundary: {right: {concentration: 2 kg/m^3}, left: {concentration")
        closed = as_rock.replace("decay: 0 1/s, initial_concentration: \"2 kg/m^3\"}", "decay: 0 1/s, initial_concentration: \"2 kg/m^3\", boundary: {right: {concentration: 2 kg/m^3}}}")
        self.assertNotEqual(closed, as_rock)
        for scene, words in ((text, None), (entering, "tells no concentration (it has no tracer)"), (as_rock, "though the rock beside has one"), (closed, None)):
            with self.subTest(words):
                told = [str(note) for note in self.run_text(scene).notes if "fluid enters" in str(note)]
                self.assertEqual(len(told), 0 if words is None else 1, told)
                self.assertTrue(words is None or words in told[0], told)

    def test_turned_mirrored_disturbed_and_elsewise(self):
        text = flowing(2, **UNEVEN, decay="1e-4 1/s")
        one, path = self.run_text(text), self.write(text, "flowing.yaml")
        self.assertLess(self.largest_difference(one, self.run_text(flowing(2, **UNEVEN, decay="1e-4 1/s", rate=1e-6 * (1 + 1e-9))), figures(one)), 1e-8)
        for schedule in ("[{solve: [pore, conduit, salt, water]}]", "[{iterate: {steps: [{solve: [pore, conduit]}, {solve: [salt, water]}]}}]"):
            other = self.run_text(text, f"schedule={schedule}")
            for ours, theirs in zip(concentrations(one), concentrations(other)):
                self.assertLess(np.abs(ours - theirs).max(), 1e-8)
        straight = self.run_text(text, "solver.condense=false")
        self.assertLess(self.largest_difference(one, straight, figures(one)), 1e-9)
        columns = [f"tracer_{what}[kg/m]" for what in ("stored", "injected", "outflow")]
        for mirror in (False, True):
            turned = self.run_scene(self.turned(path, 90, mirror=mirror))
            self.assertLess(self.largest_difference(one, turned, columns), 1e-7)

    def test_what_meets_at_a_crossing_mixes(self):
        """Reference: fluxes 2, 1, -1 and -2, of which those that enter mix to (2 + 0.25)/3, and the cells that give are not reached by others."""
        for schedule in ("[{solve: conduit}, {solve: water}]", "[{solve: [conduit, water]}]"):
            for sides in (("left", "bottom", "top", "right"), ("right", "bottom", "top", "left"), ("top", "left", "right", "bottom")):
                last = self.run_text(crossing(sides, schedule)).history
                for side, value in zip(sides, (1, 0.25, 0.75, 0.75)):
                    self.assertLess(abs(last[f"{side}[kg/m^3]"][-1] - value), 1e-8, (sides, side))

    def test_a_restart_keeps_the_bits(self):
        for dimension in (2, 3):
            text = flowing(dimension, **UNEVEN, spread=SPREAD)
            whole, half = self.run_text(text), self.run_text(text, "time.end=1 h")
            self.assert_same_bits(self.run_scene(self.write(text), restart=half.folder), whole)

    @on_two_processes
    def test_two_processes(self):
        for dimension in (2, 3):
            text = flowing(dimension, **UNEVEN, decay="1e-4 1/s", spread=SPREAD)
            one = self.run_text(text)
            self.assertLess(self.largest_difference(one, self.run_text(text, processes=2), figures(one)), 1e-9)

    def test_a_doublet(self):
        """Reference: what is injected, by hand; most of it comes out."""
        doublet = ROOT / "configs/tutorial/tracer_doublet.yaml"
        short = ("mesh={size: 16 m, fracture_size: 3 m, growth: 0.5}", "time={end: 6 h, step: 10 min}", "output.fields=false")
        one = self.run_scene(doublet, *short)
        injected = 1e-5 * 1800
        self.assertLess(abs(one.history["tracer_injected[kg/m]"][-1] / injected - 1), 1e-12)
        self.assertLess(np.abs(one.history["tracer_balance_error[kg/m]"]).max(), 1e-13 * injected)
        curve = one.history["tracer_advection.outlet.concentration[kg/m^3]"]
        self.assertTrue(0 < np.argmax(curve) < len(curve) - 1 and curve.min() >= 0)
        self.assertLess(abs((curve * 600).sum() * 1e-5 / injected - 0.98), 0.02)
        if MPIEXEC:
            two = self.run_scene(doublet, *short, processes=2)
            self.assertLess(self.largest_difference(one, two, ["tracer_advection.outlet.concentration[kg/m^3]", "tracer_stored[kg/m]"]), 1e-8)

    @on_two_processes
    def test_by_gmres(self):
        """Reference: the direct solver. Hardly anything is exchanged in a short step, so that no unknowns of the rock are strongly coupled."""
        for dimension in (2, 3):
            text = flowing(dimension, **UNEVEN, decay="1e-4 1/s")
            one = self.run_text(text)
            for processes in (1, 2):
                other = self.run_text(text, "solver={type: belos, tolerance: 1e-11}", processes=processes)
                self.assertLess(self.largest_difference(one, other, figures(one)), 1e-7)

    def test_a_mirrored_fracture(self):
        one, two = (self.run_text(fracture(1, mirror=mirror)).fractures() for mirror in (False, True))
        self.assertLess(np.abs(one["water.concentration"] - two["water.concentration"][::-1]).max(), 1e-12)
        near = self.run_text(fracture(1, shift=1e-9)).fractures()
        self.assertLess(np.abs(one["water.concentration"] - near["water.concentration"]).max(), 1e-8)

    def test_is_missed_or_refused(self):
        text = flowing(2)
        advection = text[text.index("  - {type: tracer_advection"):text.index("  - {type: tracer_exchange")]
        exchange = "  - {type: tracer_exchange, between: [salt, water]}\n"
        for wrong, why in ((text.replace("[pore, conduit, salt, water], inj", "[salt, water], inj"), "has no flow that carries tracer"),
                           (text.replace("injected: {well:", "injected: {hole:"), "hole"),
                           (text.replace("concentration: 2 kg/m^3", "concentration: -2 kg/m^3"), "-2"),
                           (text.replace('initial_concentration: "2 kg/m^3"', 'initial_concentration: "(x/m - 0.5) kg/m^3"'), "must be >= 0 kg/m^3"),
                           (text.replace("{well: {concentration: 2 kg/m^3}}", '{well: {concentration: "(2 - t/(1 h)) kg/m^3"}}'), "must be >= 0 kg/m^3"),
                           (text.replace("type: tracer_advection,", "type: tracer_advection, scheme: sharp,"), "limited"),
                           (text.replace("porosity: 0.1}", "porosity: 0}"), "porosity"),
                           (text.replace("retardation: 2", "retardation: 0.5"), "retardation"),
                           (text.replace("left: {concentration: 2 kg/m^3}", "left: {concentration: 2 kg/m^3, flux: 0 kg/(m^2*s)}"), "contradictory")):
            with self.subTest(why):
                self.assertNotEqual(wrong, text)
                said = self.call("check", self.write(wrong))
                self.assertEqual(said.returncode, 2, said.stderr)
                self.assertIn(why, said.stderr)
        for lacking, what in ((text.replace(advection, ""), "carries no tracer of"), (text.replace(exchange, ""), "no tracer is conducted between")):
            said = self.call("check", self.write(lacking))
            self.assertIn(what, said.stdout + said.stderr)


if __name__ == "__main__":
    unittest.main()
