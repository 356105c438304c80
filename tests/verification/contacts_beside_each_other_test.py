#!/usr/bin/python3
"""contacts_beside_each_other_test.py SPREKK [MPIEXEC]: contacts that are on some of the fractures, beside each other.

- Two contacts of one law are one contact: also where their fractures meet, turned, mirrored, perturbed, on two processes, over a
  restart, and while a fracture grows.
- Two laws in one scene fulfil each its closed form: a uniform strain and a rigid jump across each of two fractures.
- A fracture with no contact or with two is refused.
"""

import unittest
from math import cos, pi, radians, sin, tan

import numpy as np
from scene_runs import ROOT, SceneRuns, on_two_processes, sprekk
from wings import VALUES_OF_PAPER

# Three fractures, two of which meet, in rock that is pressed and sheared, with fluid that is injected into one of them.
SCENE = """
name: contacts
geometry:
  box: {{x: [-2 m, 2 m], y: [-2 m, 2 m]}}
  fractures:
    fault: {{points: [{0}, {1}]}}
    branch: {{points: [{2}, {3}]}}
    joint: {{points: [{4}, {5}]}}
mesh: {{size: 0.6 m, fracture_size: 0.12 m, growth: 0.4}}
materials: {{young_modulus: 40 GPa, poisson_ratio: 0.2, friction: 0.3, dilation_angle: 2 deg, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa}}
components:
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {{displacement_x: 0 m}}
      bottom: {{displacement_y: 0 m}}
      right: {{normal_stress: -20 MPa}}
      top: {{normal_stress: -10 MPa}}
  {contacts}
  conduit:
    type: fracture_flow/tpfa
    fractures: [fault, branch]
    initial_aperture: 0.1 mm
    injection: {{well: {{fracture: fault, rate: 1e-7 m^2/s}}}}
couplers:
  - {{type: wall_traction, between: [rock, {names}, conduit]}}
  - {{type: aperture, between: [{names}, conduit]}}
schedule: [{{solve: [rock, conduit, {names}], newton: {{residual: 1e-13, update: 1e-11}}}}]
time: {{end: 40 s, step: 10 s}}
output:
  fields: false
  probes:
    u: {{of: rock.displacement, at: [1.1 m, 0.7 m]}}
    p: {{of: conduit.pressure, fracture: branch, take: mean}}
    {probes}
"""
POINTS = np.array([[-0.8, -0.5], [0.7, 0.4], [-0.05, -0.05], [-0.4, 0.8], [0.9, -0.3], [1.3, -1.2]])
TURNED = POINTS @ np.array([[cos(0.4), sin(0.4)], [-sin(0.4), cos(0.4)]])
PLACES = {"": POINTS, "turned": TURNED, "mirrored": POINTS * [-1, 1], "perturbed": POINTS * (1 + 1e-9)}


def scene(points, contacts):
    """`contacts`: the name, the rest of the component, and the fractures of each."""
    probes = [f"{kind}_{fracture}_{take}: {{of: {name}.{field}, fracture: {fracture}, take: {take}}}"
              for name, _, fractures in contacts for fracture in fractures
              for kind, field in (("jump", "jump"), ("force", "traction")) for take in ("mean", "largest")]
    whole = len(contacts) == 1
    return SCENE.format(*(f"[{x:.17g} m, {y:.17g} m]" for x, y in points), names=", ".join(name for name, _, _ in contacts),
                        contacts="\n  ".join(f"{name}: {{{rest}{'' if whole else f', fractures: [{chr(44).join(of)}]'}}}"
                                             for name, rest, of in contacts), probes="\n    ".join(probes))


def one(points, kind="coulomb", laws=""):
    return scene(points, [("contact", f"type: contact/{kind}{laws}", ["fault", "branch", "joint"])])


def two(points, kind="coulomb", laws="", other=None):
    return scene(points, [("faults", f"type: contact/{kind}{laws}", ["fault"]),
                          ("joints", f"type: contact/{other or kind}{laws}", ["branch", "joint"])])


# Two fractures through a whole box: three blocks, which move rigidly against each other on top of a uniform strain.
# Units with lambda = G = 1.
PATCH = """
geometry:
  box: {{x: [0, 1], y: [0, 1]}}
  fractures: {{lower: {{points: {lower}}}, upper: {{points: {upper}}}}}
mesh: {{size: 0.12, distortion: 0.2}}
components:
  rock: {{type: poromechanics/mpsa, young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: {{left: {u}, right: {u}, bottom: {u}, top: {u}}}}}
  below: {{type: contact/{kind}, fractures: [lower], friction: {friction[0]}, dilation_angle: {psi} rad, {laws[0]}}}
  above: {{type: contact/{other}, fractures: [upper], friction: {friction[1]}, dilation_angle: 0 rad, {laws[1]}}}
couplers: [{{type: wall_traction, between: [rock, below, above]}}]
schedule: [{{solve: [rock, below, above]}}]
time: {{end: 1 s, step: 1 s}}
output:
  fields: false
  probes:
    jump_below: {{of: below.jump, fracture: lower, take: mean}}
    jump_above: {{of: above.jump, fracture: upper, take: mean}}
    force_below: {{of: below.traction, fracture: lower, take: mean}}
    force_above: {{of: above.traction, fracture: upper, take: mean}}
    most_below: {{of: below.jump, fracture: lower, take: largest}}
    most_above: {{of: above.jump, fracture: upper, take: largest}}
"""


def patch(angle, traction, jumps, **words):
    """The patch with both fractures at an angle (rad), this traction, and the jumps of both, (normal, tangential)."""
    t, n = np.array([cos(angle), sin(angle)]), np.array([sin(angle), -cos(angle)])
    stress = traction[0] * np.outer(n, n) + traction[1] * (np.outer(n, t) + np.outer(t, n))
    strain = 0.5 * (stress - 0.25 * np.trace(stress) * np.eye(2))
    middles = [np.array([0.5, 0.3]), np.array([0.5, 0.7])]

    def ends(middle):
        reach = [(0.0 - middle[0]) / t[0], (1.0 - middle[0]) / t[0]]
        return [[float(x) for x in middle + s * t] for s in reach]

    def displacement(k):
        rigid = " + ".join(f"if({n[0]:.17g}*(x-{m[0]}) + ({n[1]:.17g})*(y-{m[1]}) > 0, {n[k] * j[0] + t[k] * j[1]:.17g}, 0)"
                           for m, j in zip(middles, jumps))
        return f"\"({strain[k, 0]:.17g})*x + ({strain[k, 1]:.17g})*y + {rigid}\""

    lower, upper = ends(middles[0]), ends(middles[1])
    return PATCH.format(u=f"{{displacement: [{displacement(0)}, {displacement(1)}]}}", lower=lower, upper=upper, **words)


class ContactsBesideEachOther(SceneRuns):
    def assert_same(self, ours, other, tolerance=1e-10):
        """All probes and balances of two histories, relative to the largest value of the quantity."""
        compared, worst = 0, 0.0
        for column, values in other.history.items():
            if column not in ours.history or "error" in column or "iterations" in column or "seconds" in column or ".cells_" in column:
                continue
            scale = max(np.abs(values).max(), 1e-30)
            for kind in ("jump", "force", ".K_"):  # small components beside large ones
                if kind in column:
                    scale = max(np.abs(v).max() for c, v in other.history.items() if kind in c)
            worst = max(worst, np.abs(ours.history[column] - values).max() / scale)
            self.assertLess(np.abs(ours.history[column] - values).max() / scale, tolerance, column)
            compared += 1
        self.assertGreater(compared, 10)
        print(f"largest difference {worst:.1e}")

    def run_text(self, text, *settings, **more):
        return self.run_scene(self.write(text), *settings, **more)

    def test_two_contacts_of_one_law_are_one(self):
        for place, points in PLACES.items():
            with self.subTest(place=place):
                alone, beside = self.run_text(one(points)), self.run_text(two(points))
                self.assert_same(beside, alone)
                if place == "":
                    self.assertGreater(np.abs(alone.history["jump_fault_mean.t[m]"]).max(), 1e-5)  # it slips
                for states in ("stick", "slip", "open"):
                    counts = [beside.history[f"{name}.cells_{states}[1]"] for name in ("faults", "joints")]
                    self.assertTrue(np.array_equal(sum(counts), alone.history[f"contact.cells_{states}[1]"]))

    def test_a_probe_that_names_no_place_measures_where_its_component_lives(self):
        probes = "  probes:\n    most: {of: joints.jump, take: largest}\n    whole: {of: joints.jump, take: integral}\n    mean: {of: joints.jump, take: mean}\n"
        for place in ("", "turned"):
            run = self.run_text(two(PLACES[place]).replace("  probes:\n", probes)).history
            lengths = {"branch": np.linalg.norm(POINTS[3] - POINTS[2]), "joint": np.linalg.norm(POINTS[5] - POINTS[4])}
            for k in ("n[m]", "t[m]"):
                self.assertTrue(np.array_equal(run[f"most.{k}"], np.maximum(run[f"jump_branch_largest.{k}"], run[f"jump_joint_largest.{k}"])))
                whole = sum(length * run[f"jump_{name}_mean.{k}"] for name, length in lengths.items())
                column = next(name for name in run if name.startswith(f"whole.{k[0]}"))
                self.assertLess(np.abs(run[column] - whole).max(), 1e-10 * np.abs(whole).max() + 1e-18)
                self.assertLess(np.abs(run[f"mean.{k}"] * sum(lengths.values()) - whole).max(), 1e-10 * np.abs(whole).max() + 1e-18)

    def test_values_by_fracture_are_given_where_the_contact_is(self):
        def text(of_joints):
            return scene(POINTS, [("faults", "type: contact/coulomb, friction: {fractures: {fault: 0.3}}", ["fault"]),
                                  ("joints", f"type: contact/coulomb, friction: {{fractures: {{{of_joints}}}}}", ["branch", "joint"])])

        self.assert_same(self.run_text(text("branch: 0.3, joint: 0.3")), self.run_text(two(POINTS)), 1e-14)
        said = self.call("check", self.write(text("branch: 0.3")))
        self.assertEqual(said.returncode, 2)
        self.assertIn("has no value on the fracture 'joint'", said.stderr)

    def test_a_beginning_stands_for_names(self):
        renamed = two(POINTS).replace("branch", "set_1").replace("joint:", "set_2:").replace("fracture: joint,", "fracture: set_2,")
        self.assertIn("[set_1,joint]", renamed)
        listed = self.run_text(renamed.replace("[set_1,joint]", "[set_1,set_2]"))
        self.assert_same_bits(self.run_text(renamed.replace("[set_1,joint]", "['set_*']").replace("[fault, set_1]", "[fault, 'set_1*']")), listed)
        said = self.call("check", self.write(renamed.replace("[set_1,joint]", "['sett_*']")))
        self.assertEqual(said.returncode, 2)
        self.assertIn("unknown fracture 'sett_*'", said.stderr)

    @on_two_processes
    def test_on_two_processes(self):
        alone = self.run_text(one(POINTS))
        for _ in range(2):
            self.assert_same(self.run_text(two(POINTS), processes=2), alone, 1e-9)

    def test_with_laws_and_types(self):
        laws = ", closure: {law: barton_bandis, stiffness: 1e12 Pa/m, largest: 0.05 mm}, cohesion: 0.1 MPa, weakening: {distance: 1 mm, friction: 0.25}"
        alone = self.run_text(one(POINTS, laws=laws))
        self.assert_same(self.run_text(two(POINTS, laws=laws)), alone)
        self.assert_same(self.run_text(two(POINTS, laws=laws, other="augmented_lagrangian")), alone, 1e-7)
        rate = ", friction: 0.6, rate_and_state: {a: 0.012, b: 0.01, distance: 0.1 mm, reference_rate: 1e-6 m/s, initial_slip_rate: 1e-9 m/s}"
        longest = "time.smallest=1e-6 s"
        self.assert_same(self.run_text(two(POINTS, laws=rate), longest), self.run_text(one(POINTS, laws=rate), longest))

    def test_while_a_fracture_grows(self):
        scene_text = (ROOT / "configs/paper/wing_cracks.yaml").read_text(encoding="utf-8")
        scene_text = scene_text.replace("angle: 45 deg}", "angle: 45 deg}\n    joint: {points: [[1.3 m, 0.6 m], [1.55 m, 0.7 m]]}")
        beside = (scene_text.replace("type: contact/coulomb", "{type: contact/coulomb, fractures: [main]}\n  joints: {type: contact/coulomb, fractures: [joint]}")
                  .replace("  contact:\n    {", "  contact: {").replace("contact]", "contact, joints]").replace("contact, conduit]", "contact, joints, conduit]"))
        alone, two_contacts = (self.run_text(text, *VALUES_OF_PAPER, "time.end=5 h", "output.fields=false") for text in (scene_text, beside))
        self.assert_same(two_contacts, alone, 1e-7)
        self.assertGreater(alone.history["tips.main_last.length[m]"][-1], 5e-3)

    def test_with_factors_from_jumps(self):
        factors = []
        for text, names in ((one(POINTS), "contact"), (two(POINTS), "faults, joints")):
            text = text.replace("  conduit:\n", "  tips: {type: fine_fracture/jump_fit}\n  conduit:\n")
            text = text.replace("schedule:", f"  - {{type: two_level, between: [rock, conduit, tips, {names}]}}\nschedule:")
            factors.append(self.run_text(text.replace("0.12 m, growth", "0.08 m, growth")))
        self.assert_same(factors[1], factors[0])

    def test_a_restart_goes_on(self):
        whole = self.run_text(two(POINTS))
        part = self.run_text(two(POINTS), "time.end=20 s")
        self.assert_same_bits(self.run_text(two(POINTS), restart=part.folder), whole)

    def test_each_law_fulfils_its_closed_form(self):
        stiffness, largest, pressure, friction, psi = 5.0, 3e-3, 0.02, 0.4, 0.1
        closure = largest * pressure / (stiffness * largest + pressure)
        slip = 2e-3
        closes = (f"closure: {{law: barton_bandis, stiffness: {stiffness} Pa/m, largest: {largest} m}}", "large_jump: 0.02")
        for angle in (radians(20), -radians(15), radians(20) * (1 + 1e-9)):
            for sign in (1, -1):
                traction = [-pressure, sign * friction * pressure]
                for kind, other in (("coulomb", "coulomb"), ("coulomb", "augmented_lagrangian"), ("augmented_lagrangian", "coulomb")):
                    # Below slip with dilation, above closure of walls that stick.
                    jumps = [[slip * tan(psi), sign * slip], [-closure, 0]]
                    text = patch(angle, traction, jumps, kind=kind, other=other, friction=(friction, 0.7), psi=psi, laws=(closes[1], closes[0]))
                    runs = [self.run_text(text)]
                    if kind != other and sign == 1:
                        runs.append(self.run_text(text, processes=2))
                    for run in runs:
                        for name, jump in (("below", jumps[0]), ("above", jumps[1])):
                            for k, axis in enumerate("nt"):
                                for take in ("jump", "most"):
                                    self.assertAlmostEqual(run.history[f"{take}_{name}.{axis}[m]"][-1] if take == "jump" else 0,
                                                           jump[k] if take == "jump" else 0, delta=1e-9 * slip)
                                self.assertAlmostEqual(run.history[f"force_{name}.{axis}[Pa]"][-1], traction[k], delta=1e-9 * pressure)
                        self.assertEqual(run.history["below.cells_stick[1]"][-1], 0)
                        self.assertEqual(run.history["above.cells_slip[1]"][-1], 0)

    def test_a_fault_and_joints(self):
        folder = self.run_scene(ROOT / "configs/tutorial/fault_and_joints.yaml", "output.every=2 min").folder
        cells = sprekk.read_vtu(sprekk.read_pvd(folder / "fractures.pvd")[-1][1]).cell_data
        fault, joints = (np.isfinite(cells[f"{name}.state_0_stick_1_slip_2_open[1]"]) for name in ("fault_contact", "joint_contact"))
        self.assertTrue(np.all(fault != joints))
        normal, shear = (cells[f"wall_traction.contact_traction.{axis}[Pa]"] for axis in ("normal", "tangential"))
        opening, slip = (cells[f"wall_traction.jump.{axis}[m]"] for axis in ("normal", "tangential"))
        pressure = -normal[joints]
        self.assertGreater(pressure.min(), 1e6)
        self.assertLess(np.abs(opening[joints] + pressure * 0.3e-3 / (2e10 * 0.3e-3 + pressure)).max(), 1e-9 * 0.3e-3)
        slips = fault & (cells["fault_contact.state_0_stick_1_slip_2_open[1]"] == 1)
        self.assertGreater(slips.sum(), 10)
        friction = 0.6 - 0.1 * np.abs(slip[slips]) / 0.01  # slip goes one way
        self.assertLess(np.abs(np.abs(shear[slips]) / -normal[slips] - friction).max(), 1e-6)
        self.assertLess(np.abs(opening[slips] - np.abs(slip[slips]) * tan(radians(2))).max(), 1e-12)

    def test_what_has_no_meaning_is_refused(self):
        text = two(POINTS)

        def refused(text, *words):
            said = self.call("check", self.write(text))
            self.assertEqual(said.returncode, 2, said.stdout + said.stderr)
            for word in words:
                self.assertIn(word, said.stderr)

        refused(text.replace("fractures: [branch,joint]", "fractures: [joint]").replace("fracture: branch, take: mean", "fracture: fault, take: mean")
                .replace("{of: joints.jump, fracture: branch", "{of: joints.jump, fracture: joint")
                .replace("{of: joints.traction, fracture: branch", "{of: joints.traction, fracture: joint"),
                "fracture 'branch' has no contact", "friction 0")
        refused(text.replace("fractures: [branch,joint]", "fractures: [branch,joint,fault]"), "fracture 'fault' has two contacts", "'faults' and 'joints'")
        refused(text.replace(", fractures: [branch,joint]", ""), "fracture 'fault' has two contacts")
        refused(text.replace("fractures: [branch,joint]", "fractures: [brnch,joint]"), "unknown fracture", "branch")
        refused(text.replace("{of: joints.jump, fracture: branch", "{of: joints.jump, fracture: fault"), "does not live on fracture 'fault'")
        refused(text.replace("between: [rock, faults, joints, conduit]", "between: [rock, faults, conduit]"), "fracture 'branch' has no contact")
        refused(text.replace("solve: [rock, conduit, faults, joints]", "solve: [rock, conduit, faults]"), "joints")
        for flow, is_noted in (("[fault, branch]", True), ("[fault]", False)):
            said = self.call("check", self.write(text.replace("between: [faults, joints, conduit]", "between: [faults, conduit]")),
                             f"components.conduit.fractures={flow}", "output.probes.p.fracture=fault")
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertEqual("where 'joints' opens" in said.stdout + said.stderr, is_noted)


if __name__ == "__main__":
    unittest.main()
