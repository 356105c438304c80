#!/usr/bin/python3
"""flow_in_fracture_sets_test.py SPREKK [MPIEXEC]: a flow that lives in some of the fractures; the others are dry.

- Fluid that is injected stays in the fractures with a flow, also where dry ones cross them: p = Q t/(a L c).
- A crack that fluid opens is that of Sneddon (1946), beside a dry one that is held closed.
- In rock that conducts, a dry fracture is one that neither conducts nor lets anything through its walls.
"""

import unittest

from scene_runs import SceneRuns, on_two_processes

CROSSING = """
name: crossing
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 2 m]}
  fractures:
    main: {points: [[0.3 m, 0.4 m], [1.7 m, 1.1 m]]}
    across: {points: [[0.8 m, 1.5 m], [1.2 m, 0.2 m]]}
    branch: {points: [[1.4 m, 0.95 m], [1.4 m, 1.8 m]]}
mesh: {size: 0.2 m, fracture_size: 0.1 m}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.1 mm
    initial_pressure: 0 Pa
    injection: {well: {fracture: main, at: [0.3 m, 0.4 m], rate: 1e-9 m^2/s}}
schedule: [{solve: conduit}]
time: {end: 100 s, step: 25 s}
output:
  fields: false
  probes: {p: {of: conduit.pressure, fracture: main, take: mean}, low: {of: conduit.pressure, fracture: main, take: smallest}}
"""

CRACKS = """
name: cracks
geometry:
  box: {{x: [-20 m, 20 m], y: [-20 m, 20 m]}}
  fractures:
    one: {{points: {one}}}
    two: {{points: {two}}}
mesh: {{size: 4 m, fracture_size: 0.1 m, growth: 0.25}}
materials: {{young_modulus: 10 GPa, poisson_ratio: 0.25, viscosity: 1 mPa*s, friction: 5, dilation_angle: 0 deg, fluid_compressibility: 4e-10 1/Pa}}
components:
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: -1 MPa}}
      top: {{normal_stress: -1 MPa}}
  contact: {{type: contact/coulomb}}
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 0.1 mm
    {flow}
couplers:
  - {{type: wall_traction, between: [rock, contact, conduit]}}
  - {{type: aperture, between: [contact, conduit]}}
schedule: [{{solve: [rock, contact, conduit]}}]
time: {{end: 1 s, step: 1 s}}
output:
  fields: false
  probes:
    opening: {{of: contact.jump, fracture: one, take: largest}}
    of_dry: {{of: contact.jump, fracture: two, take: largest}}
    u: {{of: rock.displacement, at: [5 m, 3 m]}}
"""
LEVEL = {"one": "[[-1 m, 0 m], [1 m, 0 m]]", "two": "[[-0.5 m, 1.5 m], [0.5 m, 1.5 m]]"}
MIRRORED = {"one": "[[-0.8 m, 0.6 m], [0.8 m, -0.6 m]]", "two": "[[-1.3 m, -0.9 m], [-0.5 m, -1.5 m]]"}
SLANTED = {"one": "[[-0.8 m, -0.6 m], [0.8 m, 0.6 m]]", "two": "[[-1.3 m, 0.9 m], [-0.5 m, 1.5 m]]"}

IN_ROCK = """
name: in_rock
geometry:
  box: {{x: [0 m, 2 m], y: [0 m, 1 m]}}
  fractures:
    wet: {{points: [[0.3 m, 0.3 m], [1.1 m, 0.6 m]]}}
    dry: {{points: [[0.9 m, 0.2 m], [0.7 m, 0.9 m]]}}
mesh: {{size: 0.1 m, fracture_size: 0.05 m}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-14 m^2
    viscosity: 1 mPa*s
    storage: 1e-10 1/Pa
    boundary: {{left: {{pressure: 2 MPa}}, right: {{pressure: 1 MPa}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.1 mm
    {flow}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 h, step: 15 min}}
output:
  fields: false
  probes:
    p: {{of: conduit.pressure, fracture: wet, take: mean}}
    near: {{of: pore.pressure, at: [0.9 m, 0.7 m]}}
    far: {{of: pore.pressure, at: [1.5 m, 0.4 m]}}
"""


class FlowInFractureSets(SceneRuns):
    def run_text(self, text, *settings, processes=1):
        return self.run_scene(self.write(text), *settings, processes=processes)

    def history(self, text, *settings, processes=1):
        return self.run_text(text, *settings, processes=processes).history

    @on_two_processes
    def test_injected_fluid_stays_in_the_fractures_with_a_flow(self):
        main, branch, across = (1.4**2 + 0.7**2) ** 0.5, 0.85, (0.4**2 + 1.3**2) ** 0.5
        for names, length in (("main", main), ("[main, branch]", main + branch), ("[main, across, branch]", main + across + branch)):
            for processes in (1, 2):
                table = self.history(CROSSING, f"components.conduit.fractures={names}", processes=processes)
                for i, time in enumerate(table["time[s]"]):
                    exact = 1e-9 * time / (1e-4 * length * 4e-10)
                    self.assertAlmostEqual(table["fluid_stored[m^2]"][i] / (1e-9 * time), 1, delta=1e-12)
                    self.assertLess(abs(table["fluid_balance_error[m^2]"][i]), 1e-20)
                # Long after the pressures have come together.
                self.assertAlmostEqual(table["p[Pa]"][-1] / exact, 1, delta=1e-3)

    def test_a_crack_with_fluid_beside_a_dry_one_is_that_of_sneddon(self):
        exact = 4 * 2e6 * 1 * (1 - 0.25**2) / 10e9
        prescribed = "prescribed: {{inside: {{fracture: one, pressure: 3 MPa}}{more}}}"
        for place in (LEVEL, SLANTED):
            run = self.run_text(CRACKS.format(flow="fractures: one\n    " + prescribed.format(more=""), **place))
            wet = run.history
            opening = wet["opening.n[m]"][-1]
            print(f"opening {opening:.4e} m, closed form {exact:.4e} m")
            self.assertAlmostEqual(opening / exact, 1, delta=0.02)
            self.assertLess(abs(wet["of_dry.n[m]"][-1]), 1e-12)
            none = self.run_text(CRACKS.format(flow=prescribed.format(more=", outside: {fracture: two, pressure: 0 MPa}"), **place))
            self.assertLess(self.largest_difference(run, none, ("opening.n[m]", "opening.t[m]", "u.x[m]", "u.y[m]")), 1e-10)
        # With fluid of the same pressure the other one opens, too.
        both = self.history(CRACKS.format(flow=prescribed.format(more=", outside: {fracture: two, pressure: 3 MPa}"), **LEVEL))
        self.assertGreater(both["of_dry.n[m]"][-1], 1e-4)

    @on_two_processes
    def test_a_dry_fracture_in_rock_that_conducts_is_sealed(self):
        sealed = ("transmissivity: constant\n    transmissivity_value: {fractures: {wet: 1e-13 m^3, dry: 0 m^3}}\n    normal_permeability: constant\n"
                  "    normal_permeability_value: {fractures: {wet: 1e-8 m/(Pa*s), dry: 0 m/(Pa*s)}}")
        # A fracture without fluid in it does not stop what flows along the other one; one that lets nothing through would.
        zero = self.run_text(IN_ROCK.format(flow=sealed + "\n    crossings: {open: {through: wet}}"))
        for processes in (1, 2):
            dry = self.run_text(IN_ROCK.format(flow="fractures: [wet]\n    " + sealed.replace("dry: 0 ", "dry: 1 ")), processes=processes)
            self.assertLess(self.largest_difference(dry, zero), 1e-10)
        self.assertGreater(abs(dry.history["near[Pa]"][-1] - 2e6 + 0.45e6), 1e3)  # the barrier is felt

    def test_what_has_no_meaning_is_refused(self):
        scene = self.write(CROSSING)
        for settings, words in ((["fractures=[mian]"], ("unknown fracture", "main")),
                                (["fractures=[across]"], ("no flow at this place", "fractures")),
                                (["fractures=main", "prescribed={a: {fracture: across, pressure: 1 Pa}}"], ("no flow at this place",))):
            said = self.call("check", scene, *(f"components.conduit.{setting}" for setting in settings))
            self.assertEqual(said.returncode, 2, said.stderr)
            self.assertTrue(all(word in said.stderr for word in words), said.stderr)
        said = self.call("check", scene, "components.conduit.fractures=main",
                         "output.probes={q: {of: conduit.pressure, fracture: across, take: mean}}")
        self.assertEqual(said.returncode, 2)
        self.assertIn("does not live on fracture 'across'", said.stderr)

    def test_turned_mirrored_and_perturbed(self):
        # All couplers are at work: a crack that fluid opens beside a dry one, and flow in rock around a dry fracture.
        opened = "prescribed: {inside: {fracture: one, pressure: 3 MPa}}"
        for text, mirrored, slightly in (
                (CRACKS.format(flow="fractures: one\n    " + opened, **SLANTED),
                 CRACKS.format(flow="fractures: one\n    " + opened, **MIRRORED), "components.conduit.prescribed.inside.pressure=3000000.003 Pa"),
                (IN_ROCK.format(flow="fractures: [wet]"),
                 IN_ROCK.format(flow="fractures: [wet]").replace("[0.3 m, 0.3 m], [1.1 m, 0.6 m]", "[0.3 m, 0.7 m], [1.1 m, 0.4 m]")
                 .replace("[0.9 m, 0.2 m], [0.7 m, 0.9 m]", "[0.9 m, 0.8 m], [0.7 m, 0.1 m]").replace("[0.9 m, 0.7 m]", "[0.9 m, 0.3 m]")
                 .replace("[1.5 m, 0.4 m]", "[1.5 m, 0.6 m]"), "components.pore.boundary.left.pressure=2000000.002 Pa")):
            scene = self.write(text)
            one = self.run_scene(scene)
            columns = [column for column in one.history if column.startswith(("opening", "p[", "near", "far"))]
            self.assertTrue(columns)
            turned = self.largest_difference(self.run_scene(self.turned(scene, 37)), one, columns)
            disturbed = self.largest_difference(self.run_scene(scene, slightly), one, columns)
            other = self.run_text(mirrored)
            mirror = max(abs(abs(other.history[column][-1]) / abs(one.history[column][-1]) - 1) for column in columns if not column.startswith("opening.t"))
            print(f"turned {turned:.1e}, mirrored (on another mesh) {mirror:.1e}, times 1 + 1e-9 {disturbed:.1e}")
            self.assertLess(turned, 1e-9)
            self.assertLess(disturbed, 1e-7)
            self.assertGreater(disturbed, 0)
            self.assertLess(mirror, 0.01)


if __name__ == "__main__":
    unittest.main()
