#!/usr/bin/python3
"""leaky_sides_test.py SPREKK [MPIEXEC]: sides of the rock, and ends of fractures, behind which another pressure stands.

- Closed forms: a column in steady flow; a slab that leaks (Carslaw and Jaeger, sec. 3.11), with orders in time and space; linear pressures, which are
  exact in a plane and in space with fractures that cross; fluid at rest under gravity.
- Limits: a given pressure and a closed side.
- With rock, contact and fractures: turned, mirrored, disturbed by 1e-9, on two processes, by other solvers; restarted to the bit; balances."""

import math
import unittest

import numpy as np

from hexahedra import TURN, mesh_file
from leaky_column import HEIGHT, K, KINDS, LENGTH, MU, column
from scene_runs import on_two_processes, sprekk
from scenes_in_space import CUTS, LINEAR, SIDES, SpaceRuns, linear, scene as in_space

def slab_mean(biot, number):
    """Of a slab of thickness 1 and diffusivity 1, closed at one face, with −dv/dx = Bi v at the other, v = 1 at first (Carslaw and Jaeger 1959, sec. 3.11)."""
    total = 0
    for n in range(60):
        low, high = n * math.pi, n * math.pi + math.pi / 2 - 1e-15
        for _ in range(200):
            beta = (low + high) / 2
            low, high = (beta, high) if beta * math.tan(beta) < biot else (low, beta)
        total += 2 * biot**2 / (beta**2 * (beta**2 + biot**2 + biot)) * math.exp(-beta**2 * number)
    return total


SQUARES = "{kind: structured, cells: [12, 12], shape: quadrilaterals}"
# A linear pressure in a plane, with two fractures that cross and end on leaky sides.
PERMEABILITY = np.array([[1, 0.3], [0.3, 2]])
GRADIENT = np.array([1.0, -2.0])
PRESSURE = "1 + x/m - 2*y/m"
NORMALS = {"left": (-1, 0), "right": (1, 0), "bottom": (0, -1), "top": (0, 1)}
CONDUCTANCE = {"left": 0.3, "right": 4.0, "bottom": 1.5, "top": 0.02}
ENDS = {"left": ((0, 0.3), (1, 0.55)), "right": ((1, 0.55), (0, 0.3)), "bottom": ((0.4, 0), (0.65, 1)), "top": ((0.65, 1), (0.4, 0))}
APERTURE, TRANSMISSIVITY, END_CONDUCTANCE = 1e-3, 0.7, 40.0


def plane(kind, mesh, end="own"):
    leak = {side: float(PERMEABILITY @ GRADIENT @ np.array(normal)) / CONDUCTANCE[side] for side, normal in NORMALS.items()}
    sides = ", ".join(f"{side}: {{conductance: {CONDUCTANCE[side]} m/(Pa*s), outer_pressure: ({PRESSURE} + {leak[side]!r}) Pa}}" for side in NORMALS)
    ends = []
    for side, (here, there) in ENDS.items():
        outward = np.subtract(here, there) / np.linalg.norm(np.subtract(here, there))
        drop = TRANSMISSIVITY * float(GRADIENT @ outward) / (APERTURE * END_CONDUCTANCE)
        ends.append(f"{side}: {{conductance: {END_CONDUCTANCE} m/(Pa*s), outer_pressure: ({PRESSURE} + {drop!r}) Pa}}")
    return f"""
name: plane
geometry:
  box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}
  fractures:
    one: {{points: [[0 m, 0.3 m], [1 m, 0.55 m]]}}
    other: {{points: [[0.4 m, 0 m], [0.65 m, 1 m]]}}
mesh: {mesh}
components:
  pore:
    type: matrix_flow/{kind}
    permeability: {{xx: 1 m^2, yy: 2 m^2, xy: 0.3 m^2}}
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary: {{{sides}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 Pa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: {APERTURE} m
    transmissivity: constant
    transmissivity_value: {TRANSMISSIVITY} m^3
    normal_permeability: constant
    normal_permeability_value: 1e11 m/(Pa*s)
    boundary: {{{", ".join(ends)}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 s, step: 1 s}}
"""


BOX = """
name: leaky_box
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  fractures:
    across: {points: [[0.7 m, 0.1 m], [1.1 m, 0.5 m]]}
    out: {points: [[1.3 m, 0.5 m], [2 m, 0.7 m]]}
mesh: {size: 0.1 m, fracture_size: 0.05 m}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, viscosity: 1 mPa*s, friction: 0.6, dilation_angle: 1 deg, fluid_compressibility: 4e-10 1/Pa}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-16 m^2
    storage: 1e-10 1/Pa
    initial_pressure: 1 MPa
    boundary:
      left: {conductance: 4e-13 m/(Pa*s), outer_pressure: 1 MPa}
      right: {conductance: 2e-12 m/(Pa*s), outer_pressure: 0.5 MPa}
      top: {outer_pressure: (0.8 + 0.25*x/m) MPa, only_out: true}
  rock:
    type: poromechanics/mpsa
    initial_stress: {xx: -32 MPa, yy: -8 MPa, xy: 0 MPa}
    boundary: {left: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, right: {normal_stress: -32 MPa}, top: {normal_stress: -8 MPa}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    initial_pressure: 1 MPa
    injection: {well: {fracture: across, rate: 5e-8 m^2/s}}
    boundary: {right: {as_rock: true}}
  contact: {type: contact/coulomb}
couplers:
  - {type: biot, between: [pore, rock], biot_coefficient: 0.8}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
schedule: [{solve: [pore, rock, conduit, contact]}]
time: {end: 1 h, step: 15 min}
output:
  fields: false
  probes:
    well: {of: conduit.pressure, fracture: across, take: largest}
    other: {of: conduit.pressure, fracture: out, take: mean}
    slip: {of: contact.jump, fracture: across, take: mean}
    p: {of: pore.pressure, at: [1.2 m, 0.5 m]}
"""
OUTFLOWS = [f"pore.{side}.outflow[m^2/s]" for side in ("left", "right", "top")] + ["conduit.right.outflow[m^2/s]"]
COLUMNS = ["well[Pa]", "other[Pa]", "slip.n[m]", "slip.t[m]", "p[Pa]", *OUTFLOWS]


class LeakySides(SpaceRuns):
    def test_a_column_in_steady_flow(self):
        """dp/(L mu/k + 1/c), and a flux that is lost by neither; a given pressure and a closed side are limits."""
        for kind in KINDS:
            for conductance in (1e-9, 3e-3, 1e6):
                leaky = f"left: {{pressure: 5 Pa}}, right: {{conductance: {conductance!r} m/(Pa*s), outer_pressure: 2 Pa}}"
                exact = 3 * HEIGHT / (LENGTH * MU / K + 1 / conductance)
                flow = self.run_text(column(kind, leaky))["pore.right.outflow"][-1]
                self.assertLess(abs(flow / exact - 1), 1e-10, (kind, conductance))
            given = self.run_text(column(kind, "left: {pressure: 5 Pa}, right: {pressure: 2 Pa}"))
            open_side = self.run_text(column(kind, "left: {pressure: 5 Pa}, right: {conductance: 1e30 m/(Pa*s), outer_pressure: 2 Pa}"))
            closed = self.run_text(column(kind, "left: {pressure: 5 Pa}, right: {conductance: 0 m/(Pa*s), outer_pressure: 2 Pa}"))
            self.assertLess(abs(open_side["pore.right.outflow"][-1] / given["pore.right.outflow"][-1] - 1), 1e-12)
            self.assertLess(abs(open_side["p"][-1] / given["p"][-1] - 1), 1e-12)
            self.assertEqual(closed["pore.right.outflow"][-1], 0)
            self.assertLess(abs(closed["p"][-1] - 5), 1e-10)

    def test_a_slab_that_leaks(self):
        """Second order in space; first and second in time. Bi = c L mu/k."""
        storage, biot, initial, outer = K / MU / LENGTH**2 * 2, 1.7, 9.0, 4.0  # the diffusion time L^2/D is 2 s
        sides = f"right: {{conductance: {biot * K / MU / LENGTH!r} m/(Pa*s), outer_pressure: {outer} Pa}}"
        exact = outer + (initial - outer) * slab_mean(biot, 0.5)
        for kind in KINDS:
            errors = [abs(self.run_text(column(kind, sides, n, storage, initial, "0.005 s"), "time.scheme=sdirk2")["p"][-1] - exact) for n in (4, 8, 16)]
            self.assertLess(errors[-1], 2e-3)
            self.assertGreater(math.log2(errors[0] / errors[-1]) / 2, 1.85, (kind, errors))
        truth = self.run_text(column("mpfa", sides, 16, storage, initial, "0.0025 s"), "time.scheme=sdirk2")["p"][-1]
        for scheme, order in (("backward_euler", 0.9), ("sdirk2", 1.8)):
            errors = [abs(self.run_text(column("mpfa", sides, 16, storage, initial, f"{1 / n!r} s"), f"time.scheme={scheme}")["p"][-1] - truth) for n in (8, 16, 32)]
            self.assertGreater(math.log2(errors[0] / errors[-1]) / 2, order, (scheme, errors))

    @on_two_processes
    def test_linear_pressures_are_exact_in_a_plane(self):
        """With fractures that cross and leak at their ends, on one process and two."""
        for kind, processes in (("mpfa", 1), ("rt0", 1), ("ntpfa", 1), ("mpfa", 2), ("ntpfa", 2)):
            results = self.run_text(plane(kind, "{size: 0.15 m}"), processes=processes)
            for kind_of_field, name in (("matrix", "pore.pressure"), ("fractures", "conduit.pressure")):
                fields = results.fields(kind=kind_of_field)
                x = fields.centres
                error = np.abs(fields[name] - (1 + x[:, 0] - 2 * x[:, 1])).max()
                self.assertLess(error, 1e-10, (kind, processes, name))
            self.assertLess(abs(results.history["fluid_balance_error[m^2]"][-1]), 1e-10)
            exact = -float(PERMEABILITY @ GRADIENT @ np.array(NORMALS["top"]))
            self.assertLess(abs(results["pore.top.outflow"][-1] - exact), 1e-9)

    @on_two_processes
    def test_linear_pressures_are_exact_in_space(self):
        """With fractures that cross, on tetrahedra, and on hexahedra with bent faces, as drawn, turned about no axis, mirrored."""
        gradient = np.array([1, -2, 0.5])
        flux = np.array([[1, 0.3, 0.4], [0.3, 2, -0.2], [0.4, -0.2, 1.5]]) @ gradient
        sides = ", ".join(f"{side}: {{pressure: {LINEAR}}}" for side in SIDES)

        def leaky(normals):
            return ", ".join(f"{side}: {{conductance: {c} m/(Pa*s), outer_pressure: (1 + x/m - 2*y/m + 0.5*z/m + {float(flux @ n) / c!r}) Pa}}"
                             for (side, n), c in zip(normals.items(), (0.3, 4.0, 1.5, 0.02, 7.0, 0.5)))

        normals = dict(zip(SIDES, np.repeat(np.eye(3), 2, axis=0) * np.tile([[-1], [1]], (3, 1))))
        for kind, processes in (("mpfa", 1), ("rt0", 1), ("mpfa", 2)):
            text = in_space("{size: 0.3 m}", CUTS, rock=kind, walls="1e11 m/(Pa*s)").replace(sides, leaky(normals), 1)
            results = self.run_text(text, processes=processes)
            error = np.abs(results.fields()["pore.pressure"] - linear(results.fields().centres)).max()
            self.assertLess(error, 1e-10, kind)
        for turn in (np.eye(3), TURN, TURN @ np.diag([1, -1, 1])):
            self.write(mesh_file(turn, fault=False), "bent.msh")
            west = {"west": turn @ [-1, 0, 0]}
            text = in_space("{}", {}, rock="rt0").replace("  box: {x: [0 m, 1 m], y: [0 m, 1.2 m], z: [0 m, 0.9 m]}\n", "  file: bent.msh\n").replace("mesh: {}\n", "")
            results = self.run_text(text.replace(sides, f"{leaky(west)}, others: {{pressure: {LINEAR}}}"))
            self.assertLess(np.abs(results.fields()["pore.pressure"] - linear(results.fields().centres)).max(), 1e-10)

    def test_limited_fluxes_keep_the_bounds_of_outer_pressures(self):
        """Reference: 1 to 2 Pa, which stand outside, in rock of 1000:1 at 30 degrees, as drawn, mirrored and with 1 + 1e-9; mpfa goes beyond."""
        def pressures(kind, angle=30, mirror=False, factor=1.0, only_out="", mesh="{size: 0.08 m}"):
            sides = {"left": 1, "right": 2, "bottom": 1, "top": 2} if not mirror else {"right": 1, "left": 2, "bottom": 1, "top": 2}
            leaks = ", ".join(f"{side}: {{conductance: {3e4 * factor!r} m/(Pa*s), outer_pressure: {p} Pa{only_out if p == 1 else ''}}}" for side, p in sides.items())
            return self.run_text(f"""
name: tilted
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}
mesh: {mesh}
components:
  pore: {{type: matrix_flow/{kind}, permeability: {{along: 1000 m^2, across: 1 m^2, angle: {180 - angle if mirror else angle} deg}}, viscosity: 1 Pa*s, storage: 0 1/Pa, boundary: {{{leaks}}}}}
schedule: [{{solve: pore}}]
time: {{end: 1 s, step: 1 s}}
""")

        within = {kind: pressures(kind).fields()["pore.pressure"] for kind in ("mpfa", "ntpfa")}
        print("within bounds:", {kind: (values.min(), values.max()) for kind, values in within.items()})
        for values in (within["ntpfa"], pressures("ntpfa", only_out=", only_out: true").fields()["pore.pressure"], pressures("ntpfa", mesh=SQUARES).fields()["pore.pressure"]):
            self.assertTrue(1 - 1e-9 < values.min() and values.max() < 2 + 1e-9, (values.min(), values.max()))
        self.assertTrue(within["mpfa"].min() < 0.99 or within["mpfa"].max() > 2.01)
        one = pressures("ntpfa", mesh=SQUARES)
        self.assertLess(abs(one["pore.left.outflow"][-1] / pressures("ntpfa", factor=1 + 1e-9, mesh=SQUARES)["pore.left.outflow"][-1] - 1), 1e-7)
        self.assertLess(abs(one["pore.left.outflow"][-1] / pressures("ntpfa", mirror=True, mesh=SQUARES)["pore.right.outflow"][-1] - 1), 1e-7)

    def test_the_end_of_a_fracture(self):
        """dp/(L mu/T + 1/(a c)) along a fracture in tight rock; as the rock's side says, or as its own keys say."""
        aperture, transmissivity, conductance = 2e-3, 5e-4, 0.03
        text = f"""
name: end
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}, fractures: {{f: {{points: [[0 m, 0.5 m], [1 m, 0.5 m]]}}}}}}
mesh: {{kind: structured, cells: [4, 4]}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-30 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, initial_pressure: 1 Pa,
          boundary: {{right: {{conductance: {conductance} m/(Pa*s), outer_pressure: 1 Pa}}, left: {{pressure: 4 Pa}}}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: {MU} Pa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: {aperture} m
    transmissivity: constant
    transmissivity_value: {transmissivity} m^3
    normal_permeability: constant
    normal_permeability_value: 1 m/(Pa*s)
    boundary: {{left: {{as_rock: true}}, right: {{END}}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 s, step: 1 s}}
"""
        exact = 3 / (MU / transmissivity + 1 / (aperture * conductance))
        leaks = f"conductance: {conductance} m/(Pa*s), outer_pressure: 1 Pa"
        for end, flow in (("as_rock: true", exact), (leaks, exact), (leaks + ", only_out: true", exact), ("outer_pressure: 1 Pa, only_out: true", 3 * transmissivity / MU),
                          ("outer_pressure: 9 Pa, only_out: true", 0), (leaks.replace("1 Pa", "9 Pa") + ", only_out: true", 0)):
            results = self.run_text(text.replace("END", end))
            self.assertLess(abs(results["conduit.right.outflow"][-1] - flow), 1e-9 * exact, end)
            self.assertLess(abs(results.history["fluid_balance_error[m^2]"][-1]), 1e-12)

    def test_fluid_at_rest_stays_at_rest_under_gravity(self):
        """An outer pressure that grows with depth; also where the density is another than the constant one."""
        for kind in KINDS:
            for only_out in ("", ", only_out: true"):
                sides = ", ".join(f"{side}: {{conductance: 1e-2 m/(Pa*s), outer_pressure: (1e3 + 9810*({HEIGHT} - y/m)) Pa{only_out}}}" for side in ("left", "right", "top"))
                results = self.run_text(column(kind, sides, storage=1e-3, initial=f"(1e3 + 9810*({HEIGHT} - y/m))").replace("    boundary", "    gravity: [0, -9.81 m/s^2]\n    boundary"))
                for side in ("left", "right", "top"):
                    self.assertLess(abs(results[f"pore.{side}.outflow"][-1]), 1e-11, (kind, only_out))
            sides = "top: {conductance: 1e-2 m/(Pa*s), outer_pressure: 1e3 Pa}"
            text = column(kind, sides, storage=1e-3, initial=f"(1e3 + 1.1*9810*({HEIGHT} - y/m))").replace("    boundary", "    gravity: [0, -9.81 m/s^2]\n    boundary")
            warm = text.replace("schedule: [{solve: pore}]", """  heat: {type: matrix_heat/tpfa, conductivity: 1 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: 300 K}
couplers: [{type: buoyancy, between: [pore, heat], fluid_expansion: 1e-3 1/K, reference_temperature: 400 K}]
schedule: [{solve: [pore, heat]}]""")
            self.assertLess(abs(self.run_text(warm)["pore.top.outflow"][-1]), 1e-11, kind)
            self.assertGreater(self.run_text(text)["pore.top.outflow"][-1], 1e-7)

    def test_twins_with_rock_and_contact(self):
        scene = self.write(BOX, "box.yaml")
        straight = self.run_scene(scene)
        scale = max(straight.history["fluid_injected[m^2]"])
        for column_of_flow in OUTFLOWS:
            self.assertGreater(np.abs(straight.history[column_of_flow]).max(), 1e-11, column_of_flow)
        self.assertLess(np.abs(straight.history["fluid_balance_error[m^2]"]).max(), 1e-10 * scale)
        for settings in (["solver.condense=false"], ["solver.type=mumps"], ["solver.type=belos"]):
            self.assertLess(self.largest_difference(self.run_scene(scene, *settings), straight, COLUMNS), 1e-7, settings)
        perturbed = self.run_scene(scene, f"components.pore.boundary.right.conductance={2e-12 * (1 + 1e-9)!r} m/(Pa*s)")
        self.assertLess(self.largest_difference(perturbed, straight, COLUMNS), 1e-7)
        for angle, mirror in ((37, False), (0, True)):
            twin = self.run_scene(self.turned(scene, angle, mirror=mirror))
            names = ["well[Pa]", "other[Pa]", "p[Pa]", *(OUTFLOWS if not mirror else OUTFLOWS[2:3])]
            self.assertLess(self.largest_difference(twin, straight, names), 1e-7, (angle, mirror))
        in_turn = ("schedule=[{iterate: {steps: [{solve: [pore, conduit]}, {solve: [rock, contact]}], until: {relative: 1e-10, at_most: 200}}}]",)
        split = self.run_scene(scene, *in_turn)
        self.assertLess(self.largest_difference(split, straight, COLUMNS), 1e-5)
        for kind in ("tpfa", "rt0", "ntpfa"):
            other = self.run_scene(scene, f"components.pore.type=matrix_flow/{kind}")
            self.assertLess(self.largest_difference(other, straight, ["well[Pa]", "p[Pa]"]), 0.1)
        second = self.run_scene(scene, "time.scheme=sdirk2")
        self.assertLess(self.largest_difference(second, straight, ["well[Pa]", "p[Pa]"]), 0.1)
        self.assertLess(np.abs(second.history["fluid_balance_error[m^2]"]).max(), 1e-9 * scale)

    @on_two_processes
    def test_two_processes(self):
        scene = self.write(BOX, "box.yaml")
        straight = self.run_scene(scene)
        for settings in ((), ("mesh.division=scattered", "components.pore.type=matrix_flow/rt0"), ("components.pore.type=matrix_flow/ntpfa",)):
            one = self.run_scene(scene, *settings) if settings else straight
            self.assertLess(self.largest_difference(self.run_scene(scene, *settings, processes=2), one, COLUMNS), 1e-8, settings)

    @on_two_processes
    def test_a_side_that_only_one_process_has(self):
        """Its equations change on that process alone. Sources of heat press fluid out of one side, and leave through no other: what they expand."""
        text = """
name: one_side
geometry: {box: {x: [0 m, 6 m], y: [0 m, 4 m]}, fractures: {a: {points: [[3 m, 1 m], [5 m, 1.7 m]]}}}
mesh: {size: 0.7 m}
materials: {viscosity: 1 mPa*s, fluid_compressibility: 0 1/Pa, fluid_expansion: 3e-4 1/K, porosity: 0.2, expansion: 1e-4 1/K, biot_coefficient: 1}
components:
  pore: {type: matrix_flow/tpfa, permeability: 1e-13 m^2, storage: 1e-10 1/Pa, boundary: {right: {outer_pressure: 2 kPa, only_out: true}}}
  conduit: {type: fracture_flow/tpfa, initial_aperture: 0.1 mm}
  heat: {type: matrix_heat/tpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), source: "(100*x/m) W/m^3"}
  water: {type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 2e6 J/(m^3*K)}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: heat_exchange, between: [heat, water]}
  - {type: thermal_pressurization, between: [pore, conduit, heat, water]}
output: {probes: {p: {of: pore.pressure, take: mean}}}
schedule: [{solve: [pore, conduit, heat, water]}]
time: {end: 4 h, step: 1 h}
"""
        # All that warms expands by 3e-4 1/K: 300 W/m^3 in the mean, 24 m^2, 2e6 J/(m^3 K).
        expands = 3e-4 * 300 * 24 / 2e6 * 4 * 3600
        for processes in (1, 2, 3):
            run = self.run_text(text, processes=processes)
            left, stored = run.history["fluid_outflow[m^2]"][-1], 1e-10 * 24 * run.history["p[Pa]"][-1]
            self.assertLess(abs((left + stored) / expands - 1), 1e-8, processes)
            self.assertGreater(run.history["p[Pa]"][-1], 2000)

    def test_a_settled_start(self):
        """Steady flow between leaky sides alone, by direct and iterative solvers: what flows in flows out, and nothing changes after."""
        scene = self.write(BOX, "box.yaml")
        settled = "start={settle: [pore, rock, conduit, contact]}"
        direct, iterative = (self.run_scene(scene, settled, *more) for more in ((), ("solver.type=belos",)))
        self.assertLess(self.largest_difference(iterative, direct, COLUMNS), 1e-7)
        flows = np.array([direct.history[name] for name in OUTFLOWS]).sum(axis=0)
        self.assertLess(np.abs(flows - 5e-8).max(), 1e-8 * 5e-8)
        self.assertLess(np.abs(direct["p"] / direct["p"][0] - 1).max(), 1e-9)

    def test_a_restart_goes_on_to_the_bit(self):
        scene = self.write(BOX, "box.yaml")
        whole = self.run_scene(scene)
        half = self.run_scene(scene, "time.end=30 min")
        self.run_scene(scene, restart=half.folder)
        self.assert_same_bits(sprekk.Results(half.folder), whole)

    def test_what_has_no_meaning_is_refused(self):
        scene = self.write(column("mpfa", "left: {pressure: 1 Pa}"))
        side, ends = "components.pore.boundary.right=", "components.conduit.boundary.left="
        box = self.write(BOX, "box.yaml")
        for file, setting, words in ((scene, side + "{pressure: 1 Pa, conductance: 1 m/(Pa*s)}", ("conductance", "contradicts", "pressure")),
                                     (scene, side + "{pressure: 1 Pa, outer_pressure: 2 Pa, conductance: 1 m/(Pa*s)}", ("outer_pressure", "contradicts")),
                                     (scene, side + "{flux: 1 m/s, outer_pressure: 2 Pa, only_out: true}", ("outer_pressure", "flux")),
                                     (scene, side + "{conductance: 1 m/(Pa*s)}", ("conductance", "add 'outer_pressure'")),
                                     (scene, side + "{outer_pressure: 1 Pa}", ("nothing stands", "conductance")),
                                     (scene, side + "{only_out: true}", ("only_out", "outer_pressure")),
                                     (scene, side + "{outer_pressure: 1 Pa, conductance: -1 m/(Pa*s)}", ("conductance", "-1")),
                                     (box, ends + "{as_rock: true, pressure: 1 Pa}", ("contradicts itself",)),
                                     (box, ends + "{conductance: 1 m/(Pa*s)}", ("outer_pressure",)),
                                     (box, ends + "{outer_pressure: 1 Pa}", ("nothing stands",)),
                                     (box, ends + "{only_out: true}", ("one of",))):
            done = self.call("check", file, setting)
            self.assertEqual(done.returncode, 2, setting + done.stdout + done.stderr)
            self.assertTrue(all(word in done.stderr for word in words), setting + done.stderr)


if __name__ == "__main__":
    unittest.main()
