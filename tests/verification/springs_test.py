#!/usr/bin/python3
"""springs_test.py SPREKK [MPIEXEC]: sides of the rock that rest on springs, and pinned points.

- A bar on a spring: u = F/k, exact on unstructured meshes, by elements of both orders and by mpsa, in a plane and in space; a bar that a spring holds
  against shear. A side on a stiff spring is a held one, and one on no spring is free.
- A free body whose loads are in balance has the same stresses wherever points are pinned, as with rollers.
- With fractures in contact: turned, mirrored, disturbed by 1e-9, on two processes, by other solvers; restarted; counted from a settled state."""

import unittest

import numpy as np

from scene_runs import on_two_processes, sprekk
from scenes_in_space import SpaceRuns

YOUNG, NU, LENGTH, STRESS, SPRING = 3e9, 0.2, 2.0, -4e6, 5e9  # Pa, m, Pa, Pa/m
IN_PLANE = """
name: bar
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.3 m}
materials: {young_modulus: 3 GPa, poisson_ratio: 0.2}
components:
  rock:
    type: poromechanics/ORDER
    boundary: {BOUNDARY}
    PINNED
schedule: [{solve: rock}]
time: {end: 1 s, step: 1 s}
"""
IN_SPACE = IN_PLANE.replace("y: [0 m, 1 m]", "y: [0 m, 1 m], z: [0 m, 1 m]").replace("0.3 m", "0.5 m")
# All loads of a body that is free to move are in balance, and those of its sides are not alike.
FREE = """
name: free
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  fractures: {f: {points: [[0.7 m, 0.3 m], [1.3 m, 0.7 m]]}}
mesh: {size: 0.12 m, fracture_size: 0.06 m}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, friction: 0.5, dilation_angle: 2 deg}
components:
  rock:
    type: poromechanics/fem
    boundary: {left: {normal_stress: -30 MPa}, right: {normal_stress: -30 MPa}, bottom: {normal_stress: -8 MPa}, top: {normal_stress: -8 MPa}}
    pinned: {PINNED}
  contact: {type: contact/coulomb}
couplers: [{type: wall_traction, between: [rock, contact]}]
schedule: [{solve: [rock, contact]}]
time: {end: 1 s, step: 1 s}
output:
  probes: {slip: {of: contact.jump, fracture: f, take: mean}, s: {of: rock.stress, at: [0.5 m, 0.8 m]}}
"""
BED = """
name: bed
geometry:
  box: {x: [0 m, 2 m], y: [0 m, 1 m]}
  fractures: {f: {points: [[0.7 m, 0.3 m], [1.3 m, 0.7 m]]}}
mesh: {size: 0.12 m, fracture_size: 0.06 m}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, friction: 0.5, dilation_angle: 2 deg, viscosity: 1 mPa*s}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1e-15 m^2, storage: 1e-10 1/Pa, boundary: {top: {pressure: "if(t < 90*min, 2, 3) MPa"}}}
  rock:
    type: poromechanics/fem
    boundary:
      left: {spring_normal: 20 GPa/m, spring_tangential: 3 GPa/m}
      bottom: {spring_normal: (30 + 10*x/m) GPa/m, normal_stress: -1 MPa}
      right: {normal_stress: -30 MPa}
      top: {normal_stress: "if(t < 90*min, -8, -7) MPa"}
  contact: {type: contact/coulomb}
couplers:
  - {type: biot, between: [pore, rock], biot_coefficient: 0.8}
  - {type: wall_traction, between: [rock, contact]}
schedule: [{solve: [pore, rock, contact]}]
time: {end: 2 h, step: 30 min}
output:
  fields: false
  probes: {slip: {of: contact.jump, fracture: f, take: mean}, p: {of: pore.pressure, at: [1 m, 0.2 m]}, u: {of: rock.displacement, at: [0.5 m, 0.8 m]}}
"""
COLUMNS = ("slip.n[m]", "slip.t[m]", "p[Pa]")


KINDS = {"first": "fem\n    order: first", "second": "fem\n    order: second", "cells": "mpsa"}


def bar(text, order, boundary, pinned=""):
    return text.replace("ORDER", KINDS[order]).replace("BOUNDARY", boundary).replace("PINNED", f"pinned: {{{pinned}}}" if pinned else "")


class Springs(SpaceRuns):
    @on_two_processes
    def test_a_bar_on_a_spring(self):
        """u = F/k + the strain of the bar; F along the side gives a shear that springs along it hold."""
        for text, along in ((IN_PLANE, (1 - NU**2) / YOUNG), (IN_SPACE, 1 / YOUNG)):
            for order in ("first", "second"):
                held = {IN_PLANE: "foot: {at: [0 m, 0 m], displacement_y: 0 m}",
                        IN_SPACE: "foot: {at: [0 m, 0 m, 0 m], displacement_y: 0 m, displacement_z: 0 m}, side: {at: [0 m, 1 m, 0 m], displacement_z: 0 m}"}[text]
                scene = bar(text, order, f"left: {{spring_normal: {SPRING} Pa/m}}, right: {{normal_stress: {STRESS} Pa}}", held)
                probes = "output.probes={" + ", ".join(f"u{x}: {{of: rock.displacement, at: [{x} m, 0.5 m{', 0.5 m' if text is IN_SPACE else ''}]}}" for x in (0, 2)) + "}"
                results = self.run_text(scene, probes, processes=2 if order == "first" else 1)
                self.assertLess(abs(results["u0.x"][-1] / (STRESS / SPRING) - 1), 1e-9, order)
                self.assertLess(abs(results["u2.x"][-1] / (STRESS / SPRING + along * STRESS * LENGTH) - 1), 1e-9, order)
                stress = results.fields()["rock.stress"].reshape(len(results.fields().sizes), -1)
                self.assertLess(np.abs(stress[:, 0] / STRESS - 1).max(), 1e-8)

    @on_two_processes
    def test_a_bar_on_a_spring_by_cells(self):
        """The same with mpsa, whose displacements are those of cells: u_x = F/k + strain x, u_y = strain y, whatever the direction of the bar."""
        boundary = f"left: {{spring_normal: {SPRING} Pa/m}}, right: {{normal_stress: {STRESS} Pa}}"
        text = bar(IN_PLANE, "cells", boundary, "foot: {at: [0 m, 0 m], displacement_y: 0 m}")
        upright = text.replace("x: [0 m, 2 m], y: [0 m, 1 m]", "y: [0 m, 2 m], x: [0 m, 1 m]").replace("left", "bottom").replace("right", "top").replace("displacement_y", "displacement_x")
        squares = "mesh={kind: structured, cells: [5, 3], shape: quadrilaterals}"
        for settings in ((), (squares,)):
            for scene, (along, across) in ((text, (0, 1)), (upright, (1, 0))):
                for processes in (1, 2):
                    fields = self.run_text(scene, *settings, processes=processes).fields()
                    x, u = fields.centres, fields["rock.displacement"]
                    for axis, exact in ((along, STRESS / SPRING + (1 - NU**2) / YOUNG * STRESS * x[:, along]), (across, -NU * (1 + NU) / YOUNG * STRESS * x[:, across])):
                        self.assertLess(np.abs(u[:, axis] - exact).max(), 1e-9 * abs(STRESS / SPRING), (settings, processes, axis))

    def test_limits(self):
        """On a stiff spring a side is held, and on none it is free."""
        for order in KINDS:
            rollers = "bottom: {displacement_normal: 0 m}, right: {normal_stress: (-4 - y/m) MPa}"
            probe = "output.probes={u: {of: rock.displacement, at: [2 m, 1 m]}, s: {of: rock.stress, at: [0.4 m, 0.6 m]}}"
            held = self.run_text(bar(IN_PLANE, order, "left: {displacement_normal: 0 m, displacement_tangential: 0 m}, " + rollers), probe)
            stiff = self.run_text(bar(IN_PLANE, order, "left: {spring_normal: 1e22 Pa/m, spring_tangential: 1e22 Pa/m}, " + rollers), probe)
            names = [name for name in held.history if name.startswith(("u.", "s."))]
            self.assertLess(self.largest_difference(stiff, held, names), 1e-7, order)
            free = self.run_text(bar(IN_PLANE, order, "left: {displacement_normal: 0 m}, " + rollers), probe)
            soft = self.run_text(bar(IN_PLANE, order, "left: {displacement_normal: 0 m, spring_tangential: 0 Pa/m}, " + rollers), probe)
            self.assertLess(self.largest_difference(soft, free, names), 1e-12, order)

    def test_a_free_body_has_the_same_stresses_wherever_it_is_pinned(self):
        points = ("a: {at: [0 m, 0 m], displacement_x: 0 m, displacement_y: 0 m}, b: {at: [2 m, 0 m], displacement_y: 0 m}",
                  "a: {at: [2 m, 1 m], displacement_x: 1 cm, displacement_y: 2 cm}, b: {at: [2 m, 0 m], displacement_x: 1 cm}",
                  "a: {at: [0.31 m, 0.5 m], displacement_x: 0 m, displacement_y: 0 m}, b: {at: [1.7 m, 0.5 m], displacement_y: 0 m}")
        # The moments of mpsa's forces balance to its error, and points bear the rest: 1.7e-4 of the slip here, 7e-5 with cells of half the size.
        for kind, of_slip, of_stress in (("fem", 1e-8, 1e-8), ("mpsa", 3e-4, 2.5e-3)):
            runs = [self.run_text(FREE.replace("PINNED", pinned), f"components.rock.type=poromechanics/{kind}") for pinned in points]
            self.assertGreater(abs(runs[0]["slip.t"][-1]), 1e-5)
            stress = [run.fields()["rock.stress"] for run in runs]
            for other, its in zip(runs[1:], stress[1:]):
                self.assertLess(self.largest_difference(other, runs[0], ("slip.n[m]", "slip.t[m]")), of_slip, kind)
                self.assertLess(np.abs(its - stress[0]).max() / np.abs(stress[0]).max(), of_stress, kind)

    def test_twins(self):
        self.compare_twins(BED)

    def test_twins_with_mpsa(self):
        self.compare_twins(BED.replace("poromechanics/fem", "poromechanics/mpsa"))

    def compare_twins(self, text):
        scene = self.write(text, "bed.yaml")
        straight = self.run_scene(scene)
        self.assertGreater(abs(straight["slip.t"][-1]), 1e-6)
        for settings in (["solver.condense=false"], ["solver.type=mumps"]):
            self.assertLess(self.largest_difference(self.run_scene(scene, *settings), straight, COLUMNS), 1e-8, settings)
        perturbed = self.run_scene(scene, f"components.rock.boundary.left.spring_normal={20e9 * (1 + 1e-9)!r} Pa/m")
        self.assertLess(self.largest_difference(perturbed, straight, COLUMNS), 1e-7)
        for angle, mirror in ((37, False), (0, True)):
            twin = self.run_scene(self.turned(scene, angle, mirror=mirror))
            self.assertLess(self.largest_difference(twin, straight, COLUMNS[2:] if mirror else COLUMNS), 1e-7, (angle, mirror))
        half = self.run_scene(scene, "time.end=1 h")
        self.run_scene(scene, restart=half.folder)
        self.assert_same_bits(sprekk.Results(half.folder), straight)
        smooth = ("start={settle: [pore, rock, contact]}", "components.rock.boundary.top.normal_stress=(-8 + t/(2*h)) MPa",
                  "components.pore.boundary.top.pressure=(2 + t/(2*h)) MPa", "components.pore.permeability=1e-17 m^2")
        first, second, truth = (self.run_scene(scene, *smooth, *more) for more in ((), ("time.scheme=sdirk2",), ("time.scheme=sdirk2", "time.step=2 min")))
        errors = [abs(run["p"][-1] - truth["p"][-1]) for run in (first, second)]
        self.assertGreater(errors[0], 100)
        self.assertLess(errors[1], 0.3 * errors[0])

    @on_two_processes
    def test_two_processes(self):
        scene = self.write(BED, "bed.yaml")
        for settings in ((), ("mesh.division=scattered",), ("components.rock.type=poromechanics/mpsa",)):
            one = self.run_scene(scene, *settings)
            self.assertLess(self.largest_difference(self.run_scene(scene, *settings, processes=2), one, COLUMNS), 1e-8)

    def test_one_face_holds_a_beam(self):
        """Bent by a moment at its end, with a Poisson's ratio of 0: u_x = s x (y - 1/2)/E, u_y = -s x^2/(2 E), by elements of second order."""
        text = """
name: beam
geometry: {box: {x: [0 m, 4 m], y: [0 m, 1 m]}}
mesh: {kind: structured, cells: [4, 1], shape: quadrilaterals}
components:
  rock:
    type: poromechanics/fem
    order: second
    young_modulus: 1 GPa
    poisson_ratio: 0
    boundary: {left: {displacement: [0 m, 0 m]}, right: {normal_stress: "(1e6*(y - 0.5)) Pa"}}
schedule: [{solve: rock}]
time: {end: 1 s, step: 1 s}
output: {probes: {u: {of: rock.displacement, at: [4 m, 1 m]}}}
"""
        run = self.run_scene(self.write(text, "beam.yaml"))
        self.assertLess(abs(run["u.x"][-1] / (1e-3 * 4 * 0.5) - 1), 1e-10)
        self.assertLess(abs(run["u.y"][-1] / (-1e-3 * 16 / 2) - 1), 1e-10)
        said = self.call("check", self.write(text.replace("fem", "mpsa").replace("    order: second\n", ""), "cells.yaml"))
        self.assertEqual(said.returncode, 2)
        self.assertIn("turning", said.stderr)

    @on_two_processes
    def test_a_body_that_points_hold_on_two_processes(self):
        """With loads that points bear, by mpsa, which replaces balances of cells."""
        pinned = "a: {at: [0 m, 0 m], displacement_x: 0 m, displacement_y: 1 mm}, b: {at: [2 m, 0 m], displacement_y: 0 m}"
        scene = self.write(FREE.replace("PINNED", pinned).replace("type: poromechanics/fem", "type: poromechanics/mpsa\n    body_force: [0 N/m^3, -2 MN/m^3]"), "held.yaml")
        one = self.run_scene(scene)
        columns = ("slip.n[m]", "slip.t[m]", "s.xx[Pa]", "s.yy[Pa]")
        self.assertLess(self.largest_difference(self.run_scene(scene, processes=2), one, columns), 1e-8)
        self.assertLess(self.largest_difference(self.run_scene(scene, "solver.condense=false"), one, columns), 1e-8)

    def test_counted_from_a_settled_state(self):
        """Springs keep what they bear: with the loads of the settled state nothing moves, and later loads move the rock as they would from the start."""
        for kind in ("fem", "mpsa"):
            self.count_from_settled(self.write(BED.replace("poromechanics/fem", f"poromechanics/{kind}"), "bed.yaml"))

    def count_from_settled(self, scene):
        settle = "start={settle: [pore, rock, contact]}"
        rest = self.run_scene(scene, settle, "components.rock.boundary.top.normal_stress=-8 MPa", "components.pore.boundary.top.pressure=2 MPa")
        self.assertLess(np.abs(rest["u.x"]).max() + np.abs(rest["u.y"]).max(), 1e-12)
        loaded = self.run_scene(scene, settle, "components.contact.friction=10")
        whole = self.run_scene(scene, "components.contact.friction=10")
        early = self.run_scene(scene, "components.contact.friction=10", "components.rock.boundary.top.normal_stress=-8 MPa",
                               "components.pore.boundary.top.pressure=2 MPa", "time={end: 1e9 s, step: 1e8 s}")
        moved = self.run_scene(scene, "components.contact.friction=10", "time={end: 1e9 s, step: 1e8 s}")
        late = self.run_scene(scene, settle, "components.contact.friction=10", "time={end: 1e9 s, step: 1e8 s}")
        for axis in "xy":
            change = moved[f"u.{axis}"][-1] - early[f"u.{axis}"][-1]
            self.assertLess(abs(late[f"u.{axis}"][-1] / change - 1), 1e-6)
        self.assertEqual(len(loaded.times), len(whole.times))

    def test_what_has_no_meaning_is_refused(self):
        one = "a: {at: [0 m, 0 m], displacement_x: 0 m, displacement_y: 0 m}"
        bed, free = self.write(BED, "bed.yaml"), self.write(FREE.replace("PINNED", one), "free.yaml")
        held = self.write(FREE.replace("PINNED", one + ", b: {at: [2 m, 0 m], displacement_y: 0 m}"), "held.yaml")
        rock = "components.rock."
        for file, setting, words in ((bed, rock + "boundary.left={spring_normal: 1 GPa/m, displacement_normal: 0 m}", ("spring_normal", "contradicts")),
                                     (bed, rock + "boundary.left={spring_tangential: 1 GPa/m, displacement_y: 0 m}", ("spring_", "contradicts")),
                                     (bed, rock + "boundary.left={spring_normal: -1 GPa/m}", ("spring_normal", "-1")),
                                     (bed, rock + "boundary.left={spring_normal: (1 + t/s) GPa/m}", ("spring_normal", "time")),
                                     (bed, rock + "boundary.left=", ("nothing", "pinned")),
                                     (held, [rock + "type=poromechanics/mpsa", "geometry.fractures=", "mesh={kind: structured, cells: [1, 4], shape: quadrilaterals}"], ("in a row", "refine")),
                                     (free, rock + "large_strain=0.01", ("turning", "pinned")),
                                     (free, rock + "pinned.b={at: [1 m, 0.5 m], displacement_y: 0 m}", ("on a fracture",)),
                                     (free, rock + "pinned.b={at: [5 m, 0.5 m], displacement_y: 0 m}", ("outside",)),
                                     (free, rock + "pinned.b={at: [2.05 m, 0.5 m], displacement_y: 0 m}", ("outside",)),
                                     (free, rock + "pinned.b={at: [0.001 m, 0 m], displacement_y: 1 mm}", ("'a' and 'b'", "given twice")),
                                     (free, rock + "pinned.b={at: [2 m, 0.5 m]}", ("holds nothing",)),
                                     (free, rock + "pinned.b={displacement_y: 0 m}", ("at",)),
                                     (free, rock + "boundary.bottom={displacement_y: 0 m}", ("given twice", "bottom"))):
            done = self.call("check", file, *([setting] if isinstance(setting, str) else setting))
            self.assertEqual(done.returncode, 2, str(setting) + done.stdout + done.stderr)
            self.assertTrue(all(word in done.stderr for word in words), str(setting) + done.stderr)


if __name__ == "__main__":
    unittest.main()
