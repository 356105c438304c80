#!/usr/bin/python3
"""border_exchange_test.py SPREKK [MPIEXEC]: two flows whose regions touch, and the coupler between them.

- Closed forms across a slanted border: piecewise linear pressures are exact, sin times cosh and sinh has the order of the fluxes; a layer
  that resists; all types of flow beside each other.
- By two-point fluxes and by mixed elements two flows are one flow whose parameters differ by region, with fractures that cross the border,
  contact and deformation; on two processes, mirrored, turned, perturbed.
- In turn, in substeps and in one pass no fluid is lost; iterated they reach the monolithic answer.
"""

import math
import unittest

from scene_runs import SceneRuns, on_two_processes, sprekk

ANGLE = math.radians(20)
RISE = 0.5 * math.tan(ANGLE)
ACROSS = f"(-{math.sin(ANGLE)!r}*(x - 0.5) + {math.cos(ANGLE)!r}*(y - 0.5))"  # from the border
ALONG = f"({math.cos(ANGLE)!r}*(x - 0.5) + {math.sin(ANGLE)!r}*(y - 0.5))"
LOWER, UPPER = 1.0, 7.0  # m^2/(Pa s)

# `lower` and `upper`: pressures of sides; the flux across the border is −1 where they are those of linear_pressures.
SQUARE = """
name: square
geometry:
  box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}
  regions: {{up: {{polygon: [[0, {left}], [1, {right}], [1, 1], [0, 1]]}}}}
mesh: {{size: {size} m}}
components:
  under:
    type: matrix_flow/{first}
    regions: [rock]
    permeability: {k_lower} m^2
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary: {{bottom: {{pressure: ({lower}) Pa}}, left: {{pressure: ({lower}) Pa}}, right: {{pressure: ({lower}) Pa}}}}
  above:
    type: matrix_flow/{second}
    regions: [up]
    permeability: {k_upper} m^2
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary: {{top: {{pressure: ({upper}) Pa}}, left: {{pressure: ({upper}) Pa}}, right: {{pressure: ({upper}) Pa}}}}
couplers: [{{type: border_exchange, between: [{order}], resistance: {resistance} Pa*s/m}}]
schedule: [{{solve: [under, above]}}]
time: {{end: 1 s, step: 1 s}}
output:
  fields: false
  lines:
    down: {{of: under.pressure, from: [0.1 m, 0.2 m], to: [0.9 m, 0.45 m], points: 40}}
    up: {{of: above.pressure, from: [0.1 m, 0.5 m], to: [0.9 m, 0.8 m], points: 40}}
"""
SQUARE = SQUARE.replace("{left}", repr(0.5 - RISE)).replace("{right}", repr(0.5 + RISE))

BOX = """
name: side_by_side
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  regions: {layer: {polygon: [[0, 0.2], [2, 0.4], [2, 0.9], [0, 0.7]]}}
  fractures:
    across: {points: [[0.7 m, 0.1 m], [1.1 m, 0.5 m]]}
    inside: {points: [[1.3 m, 0.5 m], [1.6 m, 0.7 m]]}
mesh: {size: 0.1 m, fracture_size: 0.05 m}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, viscosity: 1 mPa*s, friction: 0.6, dilation_angle: 1 deg, fluid_compressibility: 4e-10 1/Pa}
components:
FLOWS
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {displacement_normal: 0 m}
      bottom: {displacement_normal: 0 m}
      right: {normal_stress: -32 MPa}
      top: {normal_stress: -8 MPa}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    initial_pressure: 1 MPa
    injection: {well: {fracture: across, rate: 5e-8 m^2/s}}
  contact: {type: contact/coulomb}
couplers:
COUPLERS
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
schedule: [{solve: [PORES, rock, conduit, contact]}]
time: {end: 1 h, step: 15 min}
output:
  fields: false
  probes:
    well: {of: conduit.pressure, fracture: across, take: largest}
    other: {of: conduit.pressure, fracture: inside, take: mean}
    slip: {of: contact.jump, fracture: across, take: mean}
    p: {of: pore.pressure, at: [1.2 m, 0.5 m]}
"""
FLOW = """
  NAME:
    type: matrix_flow/TYPE
    permeability: K
    REGIONS
    storage: STORAGE
    initial_pressure: 1 MPa
    boundary: {left: {pressure: 1 MPa}, right: {pressure: 2 MPa}}
"""
COUPLED = """
  - {type: biot, between: [NAME, rock], biot_coefficient: ALPHA}
  - {type: wall_exchange, between: [NAME, conduit]}
"""
COLUMNS = ("well[Pa]", "other[Pa]", "slip.n[m]", "slip.t[m]", "p[Pa]")
# Flow alone, with much exchanged across the border in each step.
IN_TURN = """
name: in_turn
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  regions: {layer: {polygon: [[0, 0.2], [2, 0.4], [2, 0.9], [0, 0.7]]}}
mesh: {size: 0.1 m}
components:
  pore:
    {type: matrix_flow/mpfa, regions: [layer], permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, boundary: {left: {pressure: (2*y) Pa}}}
  beside:
    {type: matrix_flow/mpfa, regions: [rock], permeability: 0.3 m^2, viscosity: 1 Pa*s, storage: 2 1/Pa, boundary: {top: {pressure: x Pa}}}
couplers: [{type: border_exchange, between: [pore, beside]}]
schedule: [{solve: [pore, beside]}]
time: {end: 0.125 s, step: 0.015625 s}
output: {fields: false, probes: {p: {of: pore.pressure, at: [1 m, 0.5 m]}, q: {of: beside.pressure, at: [1 m, 0.1 m]}}}
"""


def filled(text, **values):
    for name, value in values.items():
        text = text.replace(name, value)
    return text


def box_scene(kind, two):
    flow = filled(FLOW.strip("\n"), TYPE=kind)
    coupled = COUPLED.strip("\n")
    if two:
        flows = (filled(flow, NAME="pore", REGIONS="regions: [layer]", K="1e-16 m^2", STORAGE="1e-10 1/Pa") + "\n"
                 + filled(flow, NAME="beside", REGIONS="regions: [rock]", K="3e-16 m^2", STORAGE="2e-10 1/Pa"))
        couplers = ("  - {type: border_exchange, between: [pore, beside]}\n" + filled(coupled, NAME="pore", ALPHA="0.8") + "\n"
                    + filled(coupled, NAME="beside", ALPHA="0.6"))
        return filled(BOX, FLOWS=flows, COUPLERS=couplers, PORES="pore, beside")
    permeability = "{regions: {layer: 1e-16 m^2, rock: 3e-16 m^2}}"
    return filled(BOX, FLOWS=filled(flow, NAME="pore", REGIONS="", K=permeability, STORAGE="{regions: {layer: 1e-10 1/Pa, rock: 2e-10 1/Pa}}"),
                  COUPLERS=filled(coupled, NAME="pore", ALPHA="{regions: {layer: 0.8, rock: 0.6}}"), PORES="pore")


def linear_pressures(resistance=0):
    """Of both sides; the flux across the border is −1 m/s and the gradient along it 0.3 Pa/m."""
    return (f"0.3*{ALONG} + {1 / LOWER!r}*{ACROSS} + 5", f"0.3*{ALONG} + {1 / UPPER!r}*{ACROSS} + {5 + resistance!r}")


def smooth_pressures():
    """sin along the border times A cosh + B/k sinh across it: no source, and pressure and flux are continuous."""
    return tuple(f"sin(pi*{ALONG} + 0.4)*(0.7*cosh(pi*{ACROSS}) + {1 / k!r}*sinh(pi*{ACROSS}))" for k in (LOWER, UPPER))


def value_of(text, x, y):
    return eval(text, {"x": x, "y": y, "pi": math.pi, "sin": math.sin, "cosh": math.cosh, "sinh": math.sinh})  # pylint: disable=eval-used


class BorderExchange(SceneRuns):
    def square_error(self, pressures, first, second, size, order="under, above", resistance=0.0, processes=1, scene=None):
        """The largest error on both lines, and the results."""
        text = (scene or SQUARE).format(first=first, second=second, size=size, lower=pressures[0], upper=pressures[1], order=order,
                                        k_lower=LOWER, k_upper=UPPER, resistance=resistance)
        run = self.run_scene(self.write(text), processes=processes)
        worst = 0
        for line, name, pressure in (("down", "under", pressures[0]), ("up", "above", pressures[1])):
            table = sprekk.read_table(run.folder / f"line_{line}.csv")
            points = [i for i, time in enumerate(table["time[s]"]) if time == 1]
            self.assertEqual(len(points), 40)
            worst = max(worst, *(abs(table[f"{name}.pressure[Pa]"][i] - value_of(pressure, table["x[m]"][i], table["y[m]"][i])) for i in points))
        return worst, run

    def test_piecewise_linear_pressures_are_exact(self):
        for first, second, order, processes in (("mpfa", "mpfa", "under, above", 1), ("mpfa", "mpfa", "above, under", 2), ("rt0", "rt0", "under, above", 1),
                                                ("mpfa", "rt0", "under, above", 1), ("rt0", "mpfa", "under, above", 2)):
            for resistance in (0.0, 0.5):
                error, run = self.square_error(linear_pressures(resistance), first, second, 0.1, order, resistance, processes)
                self.assertLess(error, 1e-10, (first, second, order, processes, resistance))
                rate = 1 / math.cos(ANGLE) * (1 if order.startswith("above") else -1)
                self.assertAlmostEqual(run.history["border_exchange.rate[m^2/s]"][-1], rate, delta=1e-10)
                self.assertLess(abs(run.history["fluid_balance_error[m^2]"][-1]), 1e-10)

    def test_a_smooth_pressure_has_the_order_of_the_fluxes(self):
        for first, second in (("mpfa", "mpfa"), ("rt0", "mpfa")):
            errors = [self.square_error(smooth_pressures(), first, second, size)[0] for size in (0.08, 0.04, 0.02)]
            order = math.log2(errors[0] / errors[2]) / 2
            print(f"{first} beside {second}: {', '.join(f'{error:.1e}' for error in errors)}, order {order:.2f}")
            self.assertGreater(order, 1.8)

    @on_two_processes
    def test_two_flows_are_one_whose_parameters_differ_by_region(self):
        # The corrections of rt0 at tips are fitted to cells of one flow: on the coarse mesh those next to the border differ by 3e-4.
        fine = ("mesh.size=0.05 m", "mesh.fracture_size=0.025 m")
        for kind, processes, mesh in (("tpfa", 1, ()), ("tpfa", 2, ()), ("rt0", 1, fine), ("rt0", 2, fine)):
            one = self.run_scene(self.write(box_scene(kind, False)), *mesh)
            two = self.run_scene(self.write(box_scene(kind, True)), *mesh, processes=processes)
            self.assertGreater(abs(one.history["slip.t[m]"][-1]), 1e-5)
            difference = self.largest_difference(two, one, COLUMNS)
            print(f"{kind}, {processes} processes: {difference:.1e}")
            self.assertLess(difference, 1e-9)
            self.assertLess(max(abs(error) for error in two.history["fluid_balance_error[m^2]"]), 1e-9 * max(one.history["fluid_injected[m^2]"]))

    def test_iterative_solver(self):
        # Rows of a flow where it does not live, and of faces off the border, are driven by nothing.
        for kind in ("mpfa", "rt0"):
            scene = self.write(box_scene(kind, True))
            difference = self.largest_difference(self.run_scene(scene, "solver.type=belos"), self.run_scene(scene), COLUMNS)
            print(f"belos, {kind}: {difference:.1e}")
            self.assertLess(difference, 1e-8)

    def test_turned_mirrored_perturbed(self):
        scene = self.write(box_scene("mpfa", True), "mpfa.yaml")
        straight = self.run_scene(scene)
        one_flow = self.run_scene(self.write(box_scene("mpfa", False)))
        self.assertLess(self.largest_difference(straight, one_flow, COLUMNS), 0.02)  # on this mesh
        turned, mirrored = (self.run_scene(self.turned(scene, angle, mirror=mirror)) for angle, mirror in ((37, False), (0, True)))
        self.assertLess(self.largest_difference(turned, straight, ("well[Pa]", "other[Pa]", "p[Pa]")), 1e-8)
        self.assertLess(self.largest_difference(mirrored, straight, ("well[Pa]", "other[Pa]", "p[Pa]")), 1e-8)
        perturbed = self.run_scene(scene, f"components.conduit.injection.well.rate={5e-8 * (1 + 1e-9)!r} m^2/s")
        self.assertLess(self.largest_difference(perturbed, straight, COLUMNS), 1e-7)

    def test_in_turn_no_fluid_is_lost(self):
        scene = self.write(IN_TURN)
        together = self.run_scene(scene)
        scale = together.history["fluid_stored[m^2]"][-1]
        self.assertGreater(abs(together.history["border_exchange.rate[m^2/s]"][-1]), 0.01)
        for steps, is_same in (("[{iterate: {steps: [{solve: pore}, {solve: beside}], until: {relative: 1e-10, at_most: 400}, fallback: none}}]", True),
                               ("[{iterate: {steps: [{solve: beside}, {solve: pore}], until: {relative: 1e-10, at_most: 400}, fallback: none}}]", True),
                               ("[{solve: pore}, {solve: beside}]", False), ("[{solve: beside}, {solve: pore}]", False),
                               ("[{solve: pore}, {subcycle: {count: 3, steps: [{solve: beside}]}}]", False),
                               ("[{subcycle: {count: 3, steps: [{solve: pore}]}}, {solve: beside}]", False)):
            run = self.run_scene(scene, f"schedule={steps}")
            lost = max(abs(error) for error in run.history["fluid_balance_error[m^2]"]) / scale
            difference = self.largest_difference(run, together, ("p[Pa]", "q[Pa]"))
            print(f"{steps}: lost {lost:.1e}, difference {difference:.1e}")
            self.assertLess(lost, 1e-10 if is_same else 1e-12, steps)
            self.assertLess(difference, 1e-7 if is_same else 0.5, steps)

    def test_a_restart_goes_on_to_the_bit(self):
        scene = self.write(IN_TURN)
        whole = self.run_scene(scene)
        half = self.run_scene(scene, "time.end=0.0625 s")
        self.run_scene(scene, restart=half.folder)
        self.assertEqual((half.folder / "history.csv").read_text().splitlines()[-1].split(",")[:8],
                         (whole.folder / "history.csv").read_text().splitlines()[-1].split(",")[:8])

    def test_a_border_without_the_coupler_is_told(self):
        alone = self.run_scene(self.write(IN_TURN), "couplers=[]")
        self.assertTrue(any("border_exchange" in str(note) for note in alone.notes), alone.notes)
        self.assertFalse(any("no fluid passes" in str(note) for note in self.run_scene(self.write(IN_TURN)).notes))

    def test_what_has_no_meaning_is_refused(self):
        scene = self.write(IN_TURN)
        for settings, words in ((["components.pore.regions=[rock]", "components.pore.boundary=", "output.probes="], ("both flows", "'rock'", "matrix_exchange")),
                                (["components.beside.type=matrix_flow/ntpfa"], ("border of 'beside'", "limited")),
                                (["components.heat={type: matrix_heat/tpfa, conductivity: 1 W/(m*K), heat_capacity: 2 J/(m^3*K), initial_temperature: 300 K}",
                                  "couplers=[{type: border_exchange, between: [pore, beside]}, {type: heat_advection, between: [heat, beside], "
                                  "fluid_heat_capacity: 1 J/(m^3*K)}]", "schedule=[{solve: [pore, beside, heat]}]"], ("passes to another flow", "one flow")),
                                (["couplers=[{type: border_exchange, between: [pore]}]"], ("border_exchange", "two components")),
                                (["couplers=[{type: border_exchange, between: [pore, beside], resistance: -1 Pa*s/m}]"], ("resistance", "-1")),
                                (["components.beside.permeability=0 m^2", "components.beside.boundary="], ("border", "no permeability")),
                                (["geometry.regions.core={polygon: [[0.5, 0.45], [1, 0.45], [1, 0.55], [0.5, 0.55]]}", "components.beside.regions=[core]",
                                  "components.pore.regions=[far]", "geometry.regions.far={polygon: [[0, 0], [2, 0], [2, 0.1], [0, 0.1]]}",
                                  "components.pore.boundary={bottom: {pressure: 1 Pa}}", "components.beside.boundary=", "output.probes="], ("do not touch",))):
            done = self.call("check", scene, *settings)
            self.assertEqual(done.returncode, 2, str(settings) + done.stdout + done.stderr)
            self.assertTrue(all(word in done.stderr for word in words), done.stderr)


if __name__ == "__main__":
    unittest.main()
