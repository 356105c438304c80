#!/usr/bin/python3
"""every_scheme_test.py SPREKK: each iterated scheme with each choice of components reaches its own monolithic answer to 1e-7 of the largest value
of a field's unit: in Mandel's block, in a fracture that shear makes slip and fluid opens, and in section 5.1 of the paper. No step is cut, and
none is left to the fallback."""

import math
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns

MANDEL, PAPER = ROOT / "configs/verification/mandel.yaml", ROOT / "configs/paper/onset_coarse.yaml"
SMALL_MANDEL = ("mesh.size=0.2 m", "time.end=3237 s")
SMALL_PAPER = ("mesh={size: 0.5 m, fracture_size: 20 mm, growth: 0.4}", "time.end=7 h")
# A poroelastic square with a fracture, enlarged: the load makes all of the fracture slip, and fluid that is brought in from 3 s on
# opens it.
FRACTURED, ANGLE = ROOT / "tests/input/base/fractured.yaml", 0.4
OPENED = f"""
geometry:
  box: {{x: [-10, 10], y: [-10, 10]}}
  fractures: {{crack: {{points: [[{-math.cos(ANGLE)!r}, {-math.sin(ANGLE)!r}], [{math.cos(ANGLE)!r}, {math.sin(ANGLE)!r}]]}}}}
mesh: {{size: 5, fracture_size: 0.25, growth: 0.4}}
materials: {{young_modulus: 20 GPa, friction: 0.3, dilation_angle: 2 deg}}
components:
  pore: {{initial_pressure: 1 MPa, boundary: null}}
  rock: {{boundary: {{right: {{normal_stress: -5 MPa}}, top: {{normal_stress: -2 MPa}}}}}}
  conduit:
    initial_aperture: 0.2 mm
    initial_pressure: 1 MPa
    injection: {{well: {{at: null, fracture: crack, rate: {{value: 3e-5 m^2/s, from: 3 s}}}}}}
time: {{end: 12 s, step: 3 s}}
"""
FLOW, ROCK, RESPONSE = "{{solve: {flow}{}}}", "{{solve: {rock}{}}}", ", stabilize: response"
HELD, UNDRAINED = ", stabilize: fixed_stress", ", stabilize: undrained"
FOUND = ("couplers.0.fixed_stress_modulus=found",)
# name: (steps, more options of `iterate`, settings)
OF_TWO = {
    "fixed stress": ((FLOW, HELD, ROCK, ""), "", ()),
    "fixed stress, rock first": ((ROCK, "", FLOW, HELD), "", ()),
    "fixed stress, uniaxial": ((FLOW, HELD, ROCK, ""), "", ("couplers.0.fixed_stress_modulus=uniaxial",)),
    "fixed stress, optimal": ((FLOW, HELD, ROCK, ""), "", ("couplers.0.fixed_stress_modulus=optimal",)),
    "fixed stress, found": ((FLOW, HELD, ROCK, ""), "", FOUND),
    "fixed stress, jacobi, anderson": ((FLOW, HELD, ROCK, ""), "order: jacobi, accelerate: {anderson: 5}, ", ()),
    "undrained": ((ROCK, UNDRAINED, FLOW, ""), "", ()),
    "drained, aitken": ((ROCK, "", FLOW, ""), "accelerate: {aitken: {}}, ", ()),
    "strain held, anderson": ((FLOW, "", ROCK, ""), "accelerate: {anderson: 5}, ", ()),
    "drained, iqn_ils": ((ROCK, "", FLOW, ""), "accelerate: {iqn_ils: {reuse: 2}}, ", ()),
    "fixed stress, iqn_imvj": ((FLOW, HELD, ROCK, ""), "accelerate: {iqn_imvj: {}}, ", ()),
    "fixed stress, constant": ((FLOW, HELD, ROCK, ""), "accelerate: {constant: {factor: 0.9}}, ", ()),
}
INEXACT = "{solve: [pore, conduit], stabilize: fixed_stress, newton: {at_most: 1}}, {solve: [rock, contact], newton: {at_most: 1}}"
OF_FRACTURES = {
    "contact apart": "{solve: [pore, conduit], stabilize: fixed_stress}, {solve: rock}, {solve: contact, stabilize: response}",
    "fracture flow apart": "{solve: pore, stabilize: fixed_stress}, {solve: [rock, contact]}, {solve: conduit, stabilize: response}",
    "fractures apart": "{solve: [pore, rock]}, {solve: [conduit, contact], stabilize: response}",
    "all apart": "{solve: pore, stabilize: fixed_stress}, {solve: rock}, {solve: conduit, stabilize: response}, {solve: contact, stabilize: response}",
    "rock with fracture flow": "{solve: pore, stabilize: fixed_stress}, {solve: [rock, conduit], stabilize: response}, {solve: contact, stabilize: response}",
    "inexact": INEXACT,
}
# Those that find how fluid opens a fracture: they contain the compliance of its walls, and one Newton iteration for a pass is not enough there.
OF_OPENING = ("fracture flow apart", "fractures apart", "all apart", "rock with fracture flow")
PORE, KIND, CONTACT = "components.pore.type=matrix_flow/", "components.rock.type=poromechanics/", "components.contact.type=contact/"
OF_ROCK_AND_FLOW = ((PORE + "mpfa", KIND + "mpsa"), (PORE + "rt0", KIND + "fem"), (PORE + "tpfa", KIND + "mpsa"), (PORE + "ntpfa", KIND + "fem"))
OF_ALL = ((PORE + "mpfa", KIND + "mpsa", CONTACT + "coulomb"), (PORE + "rt0", KIND + "fem", CONTACT + "augmented_lagrangian"),
          (PORE + "tpfa", KIND + "mpsa", CONTACT + "penalty"))


def iterated(steps, options=""):
    return f"schedule=[{{iterate: {{fallback: none, until: {{relative: 1e-10, at_most: 150}}, {options}steps: [{steps}]}}}}]"


def schemes(flow, rock):
    """{name: settings} of the schemes with flow and rock in turn."""
    found = {}
    for name, ((one, stabilized, other, other_stabilized), options, settings) in OF_TWO.items():
        steps = ", ".join(step.format(more, flow=flow, rock=rock) for step, more in ((one, stabilized), (other, other_stabilized)))
        found[name] = (iterated(steps, options), *settings)
    return found


def unit_of(name):
    for unit, words in (("Pa", ("traction", "pressure", "stress")), ("m", ("jump", "displacement", "aperture"))):
        if any(word in name for word in words):
            return unit
    return name


class EveryScheme(SceneRuns):
    def expect_answer(self, scene, components, settings, of_schemes):
        truth = self.run_scene(scene, *components, *settings)
        right = {kind: truth.fields(kind=kind) for kind in ("matrix", "fractures") if any(truth.folder.glob(f"{kind}_*.vtu"))}
        names = [(kind, name) for kind, fields in right.items() for name in fields.names
                 if "." in name and np.issubdtype(np.asarray(fields[name]).dtype, np.floating)]
        scale = {}
        for kind, name in names:
            scale[unit_of(name)] = max(scale.get(unit_of(name), 0), abs(right[kind][name]).max())
        for scheme, changes in of_schemes.items():
            with self.subTest(components=components, scheme=scheme):
                ours = self.run_scene(scene, *components, *settings, *changes)
                self.assertEqual(len(ours.rows), len(truth.rows))  # none was cut
                apart = {}
                for kind, name in names:
                    distance = abs(ours.fields(kind=kind)[name] - right[kind][name]).max()
                    apart[name] = distance / max(scale[unit_of(name)], 1e-300)
                worst = max(apart, key=apart.get)
                words = ", ".join(setting.rpartition("/")[2] for setting in components)
                print(f"    {words}: {scheme}: {[int(value) for value in ours['iterations[1]']]} passes, {worst} {apart[worst]:.1e}", flush=True)
                self.assertLessEqual(apart[worst], 1e-7, worst)
        return truth

    def test_mandel(self):
        for components in OF_ROCK_AND_FLOW:
            self.expect_answer(MANDEL, components, SMALL_MANDEL, schemes("pore", "rock"))

    def test_a_fracture_that_slips_and_opens(self):
        held = {name: settings for name, settings in schemes("[pore, conduit]", "[rock, contact]").items() if "fixed stress" in name and "jacobi" not in name}
        for components in OF_ALL:
            truth = self.expect_answer([FRACTURED, self.write(OPENED)], components, (), {**held, **{name: (iterated(OF_FRACTURES[name]),) for name in OF_OPENING}})
            self.assertGreater(truth.rows[0]["contact.cells_slip"], 0)
            self.assertEqual(truth.rows[0]["contact.cells_open"], 0)
            self.assertGreater(truth.rows[-1]["contact.cells_open"], 0)

    def test_section_5_1_of_the_paper(self):
        of_all = {**schemes("[pore, conduit]", "[rock, contact]"), **{name: (iterated(steps),) for name, steps in OF_FRACTURES.items()}}
        for components in OF_ALL:
            truth = self.expect_answer(PAPER, components, SMALL_PAPER, of_all)
            self.assertGreater(truth.rows[-1]["contact.cells_slip"], 0)


if __name__ == "__main__":
    unittest.main()
