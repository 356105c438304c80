#!/usr/bin/python3
"""contact_in_space_test.py SPREKK [MPIEXEC]: frictional contact in space in uniform states, which are exact: walls that stick, slide in any
direction with dilation and cohesion, or are open, on every kind of cell.

Twins: turned about no axis, mirrored, values that are disturbed by 1e-9, other types of contact, and two processes."""

import json
import unittest

import numpy as np

from hexahedra import TURN, mesh_file
from scene_runs import ROOT, SceneRuns, on_two_processes
from scenes_in_space import CUTS

SIDES = ("left", "right", "front", "back", "bottom", "top")
YOUNG, POISSON = 1e10, 0.25
FRICTION, DILATION = 0.6, 0.1
AXES = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]  # of the components of a stress
CORNERS = np.array([[0.3, 0, 0], [0.5, 1.2, 0], [0.6, 1.2, 0.9], [0.4, 0, 0.9]])  # of a fracture in general position: all in one plane
MIRROR = TURN @ np.diag([1, -1, 1])
PARTS = ("normal", "tangential1", "tangential2")


def frame(normal):
    """Two unit vectors across a unit vector."""
    return np.linalg.qr(np.column_stack([normal, np.eye(3)[:, :2]]))[0][:, 1:].T


def strain_of(stress):
    return (1 + POISSON) / YOUNG * stress - POISSON / YOUNG * np.trace(stress) * np.eye(3)


class State:
    """A uniform stress whose traction on the walls is given, and a jump of the side towards the normal."""

    def __init__(self, normal, traction, jump):
        """`traction`, `jump`: along the normal and two vectors across it."""
        local = np.vstack([normal, frame(normal)])
        whole = np.array([[traction[0], *traction[1:]], [traction[1], -4e6, 0.7e6], [traction[2], 0.7e6, -7e6]])
        self.stress = local.T @ whole @ local
        self.normal, self.traction, self.jump = normal, np.array(traction), np.array(jump)
        self.leap = local.T @ self.jump

    def displacement(self, point):
        """That on sides, of a fracture through the point."""
        gradient = strain_of(self.stress)
        side = " + ".join(f"({float(n)!r})*{axis}/m" for n, axis in zip(self.normal, "xyz"))
        return [f"({' + '.join(f'({float(g)!r})*{axis}' for g, axis in zip(row, 'xyz'))} + if({side} > {float(self.normal @ point)!r}, {float(part)!r}, 0)) m"
                for row, part in zip(gradient, self.leap)]


def states(normal, cohesion=0.0):
    """Walls that stick, that slide in some directions with dilation, and that are open."""
    yield "stick", State(normal, [-5e6, 1.2e6, -1.6e6], [0, 0, 0])
    for angle in np.radians([0, 70, 205]):
        direction = np.array([np.cos(angle), np.sin(angle)])
        yield f"slip towards {angle:.2f}", State(normal, [-5e6, *((FRICTION * 5e6 + cohesion) * direction)], 2e-4 * np.array([np.tan(DILATION), *direction]))
    yield "open", State(normal, [0, 0, 0], [3e-4, 1e-4, -2e-4])


def scene(geometry, mesh, boundary, order, **contact):
    return {"name": "contact_in_space", "geometry": geometry, **({"mesh": mesh} if mesh else {}),
            "components": {"rock": {"type": "poromechanics/fem", "order": order, "young_modulus": f"{YOUNG} Pa", "poisson_ratio": POISSON, "boundary": boundary},
                           "contact": {"type": "contact/coulomb", "friction": FRICTION, "dilation_angle": f"{DILATION} rad", "large_jump": 1, **contact}},
            "couplers": [{"type": "wall_traction", "between": ["rock", "contact"]}], "schedule": [{"solve": ["rock", "contact"]}],
            "time": {"end": "1 s", "step": "1 s"}, "output": {"fields": True}}


def tetrahedra(state, order, **contact):
    """A box of tetrahedra that a fracture in general position cuts."""
    points = [[f"{float(c)!r} m" for c in corner] for corner in CORNERS]
    geometry = {"box": {"x": ["0 m", "1 m"], "y": ["0 m", "1.2 m"], "z": ["0 m", "0.9 m"]}, "fractures": {"cut": {"points": points}}}
    return scene(geometry, {"size": "0.4 m"}, {side: {"displacement": state.displacement(CORNERS[0])} for side in SIDES}, order, **contact)


NORMAL = np.cross(CORNERS[1] - CORNERS[0], CORNERS[3] - CORNERS[0])
NORMAL /= np.linalg.norm(NORMAL)


class ContactInSpace(SceneRuns):
    def run_map(self, of_scene, *settings, **how):
        return self.run_scene(self.write(json.dumps(of_scene, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    def from_file(self, state, turn, wedges, order):
        """A cube of cells with bent faces, cut in its middle."""
        file = self.write(mesh_file(turn, cells=(2, 2, 2), wedges=wedges), f"mesh_{next(self.numbers)}.msh")
        given = {"displacement": state.displacement(turn @ [0.5, 0.5, 0.5])}
        return scene({"file": str(file)}, None, {"west": given, "others": given}, order)

    @staticmethod
    def walls(results, name="contact"):
        """Tractions and jumps of each fracture cell."""
        fields = results.fractures()
        return tuple(np.column_stack([fields[f"{name}.{what}.{part}"] for part in PARTS]) for what in ("traction", "jump"))

    def assert_state(self, results, state, within=1e-9):
        stress = np.array([state.stress[i, j] for i, j in AXES])
        self.assertLess(np.abs(results.fields()["rock.stress"] - stress).max(), within * np.abs(stress).max())
        for found, wanted, scale in zip(self.walls(results), (state.traction, state.jump), (np.abs(stress).max(), 2e-4)):
            self.assertLess(np.abs(found[:, 0] - wanted[0]).max(), within * scale)
            self.assertLess(np.abs(np.linalg.norm(found[:, 1:], axis=1) - np.linalg.norm(wanted[1:])).max(), within * scale)
        traction, jump = (each[:, 1:] for each in self.walls(results))
        slid = np.linalg.norm(state.jump[1:]) > 0 and state.traction[0] < 0
        if slid:  # friction points along the slip
            along = np.sum(traction * jump, axis=1)
            self.assertLess(np.abs(along - np.linalg.norm(traction, axis=1) * np.linalg.norm(jump, axis=1)).max(), within * np.abs(along).max())
        kinds = results.fractures()["contact.state_0_stick_1_slip_2_open"]
        self.assertEqual(set(kinds), {1.0 if slid else 2.0 if state.traction[0] == 0 else 0.0})

    def test_uniform_states_are_exact_on_tetrahedra(self):
        for order in ("first", "second"):
            for name, state in states(NORMAL):
                with self.subTest(name, order=order):
                    self.assert_state(self.run_map(tetrahedra(state, order)), state)

    def test_so_they_are_on_hexahedra_and_wedges_with_bent_faces(self):
        """As drawn, turned about no axis, and mirrored."""
        for turn, wedges, order in ((np.eye(3), False, "first"), (TURN, True, "first"), (MIRROR, False, "second"), (TURN, True, "second")):
            for name, state in states(turn[:, 0]):
                with self.subTest(name, wedges=wedges, order=order):
                    self.assert_state(self.run_map(self.from_file(state, turn, wedges, order)), state)

    def test_walls_with_cohesion_and_closure_slide_as_these_say(self):
        """Walls under 5 MPa approach each other by a tenth of a millimetre, and hold 1 MPa more."""
        for name, state in states(NORMAL, cohesion=1e6):
            if not name.startswith("slip"):
                continue
            closed = State(NORMAL, state.traction, state.jump - [1e-4, 0, 0])
            closure = {"closure": {"law": "linear", "stiffness": "5e10 Pa/m"}}
            self.assert_state(self.run_map(tetrahedra(closed, "first", cohesion="1 MPa", **closure)), closed)

    def test_other_types_of_contact_have_the_same_states(self):
        """The springs of a penalty add traction over stiffness to the jump, so with a million times the rock's it is 1e-6 off."""
        for kind, within in (("augmented_lagrangian", 1e-9), ("penalty", 1e-5)):
            for name, state in list(states(NORMAL))[:2]:
                settings = [f"components.contact.type=contact/{kind}"] + ["components.contact.stiffness_factor=1e6"] * (kind == "penalty")
                with self.subTest(name, kind=kind):
                    self.assert_state(self.run_map(tetrahedra(state, "first"), *settings), state, within)

    def test_disturbed_walls_slide_almost_as_far(self):
        state = dict(states(NORMAL))["slip towards 1.22"]
        runs = [self.run_map(tetrahedra(state, "first"), *settings) for settings in ((), ("components.rock.young_modulus=10.00000001 GPa", f"components.contact.friction={FRICTION * (1 + 1e-9)!r}"))]
        for one, other in zip(*(self.walls(run) for run in runs)):
            self.assertLess(np.abs(one - other).max(), 1e-7 * np.abs(one).max())

    def test_tractions_of_walls_that_stick_do_not_alternate(self):
        """Under u = A sin(k·x + 1/2) beside a compression, on one fault and on two that cross: tractions are of first order,
        and the worst of them falls, too."""
        a, k = 1e-4 * np.array([1.0, -0.6, 0.4]), np.array([1.9, 1.2, -1.5])
        lame, shear = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
        phase = " + ".join(f"({float(c)!r})*{axis}/m" for c, axis in zip(k, "xyz")) + " + 0.5"
        body = [f"({float(f)!r}*sin({phase})) N/m^3" for f in (lame + shear) * k * (a @ k) + shear * a * (k @ k)]
        u = [f"({float(c)!r}*sin({phase}) - 1e-3*{axis}/m) m" for c, axis in zip(a, "xyz")]
        for names, order, sizes, least in ((("one",), "first", (0.24, 0.12), 0.9), (("one", "other"), "first", (0.24, 0.12), 0.9), (("one", "other"), "second", (0.6, 0.3), 0.9)):
            errors, counts = [], []
            for size in sizes:
                given = scene({"box": {"x": ["0 m", "1 m"], "y": ["0 m", "1.2 m"], "z": ["0 m", "0.9 m"]},
                               "fractures": {name: {"points": [[f"{float(c)!r} m" for c in corner] for corner in CUTS[name]]} for name in names}},
                              {"size": f"{size} m"}, {side: {"displacement": u} for side in SIDES}, order, friction=100, dilation_angle="0 rad")
                given["components"]["rock"]["body_force"] = body
                results = self.run_map(given)
                fields, found = results.fractures(), self.walls(results)[0]
                wanted = np.empty_like(found)
                for number, name in enumerate(names):
                    corners = np.array(CUTS[name], float)
                    normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
                    normal /= np.linalg.norm(normal)
                    along = np.cross([0, 0, 1], normal) / np.linalg.norm(normal[:2])
                    local = np.vstack([normal, along, np.cross(normal, along)])
                    here = np.abs((fields.centres - corners[0]) @ normal) < 1e-6
                    gradient = np.multiply.outer(np.cos(fields.centres @ k + 0.5), np.multiply.outer(a, k))
                    stress = lame * np.trace(gradient, axis1=1, axis2=2)[:, None, None] * np.eye(3) + shear * (gradient + gradient.transpose(0, 2, 1))
                    stress -= 1e-3 * (3 * lame + 2 * shear) * np.eye(3)
                    wanted[here] = (stress @ normal @ local.T)[here]
                weights = fields.sizes / fields.sizes.sum()
                error, scale = np.linalg.norm(found - wanted, axis=1), np.sqrt(weights @ np.sum((wanted - weights @ wanted)**2, axis=1))
                errors.append([np.sqrt(weights @ error**2) / scale, error.max() / scale])
                counts.append(len(weights))
            orders = 2 * np.log(np.divide(*errors)) / np.log(counts[1] / counts[0])
            print(f"tractions on {names}, order {order}: mean and largest error {errors}, orders {orders}, {counts} cells")
            self.assertGreater(orders[0], least)
            self.assertLess(errors[1][1], errors[0][1])

    def test_flow_rock_and_contact_in_turn_have_the_answer_of_all_at_once(self):
        """A disc that slips along all of its walls, with dilation that lets water in, in one step."""
        settings = ("mesh={size: 100 m, fracture_size: 20 m, growth: 2}", "time={end: 1 day, step: 1 day}", "output={every: 1 day, fields: true}",
                    "components.conduit.injection.well.rate=8e-5 m^3/s")
        schedule = {"iterate": {"steps": [{"solve": ["pore", "conduit"], "stabilize": "fixed_stress"}, {"solve": ["rock", "contact"]}],
                                "until": {"relative": 1e-10}}}
        path = ROOT / "configs/tutorial/slipping_disc.yaml"
        together = self.run_scene(path, *settings)
        in_turn = self.run_scene([path, self.write(json.dumps({"schedule": [schedule]}), "in_turn.yaml")], *settings)
        lines, others = together.fractures(), in_turn.fractures()
        self.assertEqual(set(lines["contact.state_0_stick_1_slip_2_open"]), {1.0})
        names = [f"contact.{what}.{part}" for what in ("jump", "traction") for part in PARTS] + ["conduit.pressure", "conduit.aperture"]
        for name in names:
            scale = np.abs(lines[name]).max() if name.startswith("conduit") else max(np.abs(lines[f"{name.rpartition('.')[0]}.{part}"]).max() for part in PARTS)
            self.assertLess(np.abs(lines[name] - others[name]).max(), 1e-8 * scale, name)
        # What slips opens the fracture, and what opens is the aperture.
        slip = np.hypot(*(lines[f"contact.jump.{part}"] for part in PARTS[1:]))
        self.assertLess(np.abs(lines["contact.jump.normal"] - slip * np.tan(np.radians(2))).max(), 1e-9 * slip.max())
        self.assertLess(np.abs(lines["conduit.aperture"] - 1e-4 - lines["contact.jump.normal"]).max(), 1e-9 * slip.max())

    def test_a_spring_slider_slips_in_any_direction_as_it_does_in_a_plane(self):
        """The scene of a plane (stick-slip with friction of rate and state, within an event), as a block that is sheared 35 degrees off its sides."""
        settings = ("components.rock.type=poromechanics/fem", "time.end=8e6 s", "output={}")
        path = ROOT / "configs/verification/spring_slider.yaml"
        plane = self.run_scene(path, *settings, "mesh.cells=[1, 4]")
        x, y = np.cos(np.radians(35)), np.sin(np.radians(35))
        drive = [f"({sign}0.5e-9*{float(c)!r}*t) m" for sign in ("", "-") for c in (x, y)]
        shear = {"xy": None, "xz": f"{float(5e6 * x)!r} Pa", "yz": f"{float(5e6 * y)!r} Pa"}
        beside = {"normal_stress": "-10 MPa", "displacement_z": "0 m"}
        block = {"geometry": {"box": {"x": ["0 m", "10 m"], "y": ["0 m", "10 m"], "z": ["-50 m", "50 m"]},
                              "fractures": {"fault": {"points": [[f"{a} m", f"{b} m", "0 m"] for a, b in ((0, 0), (0, 10), (10, 10), (10, 0))]}}},
                 "mesh": {"kind": "structured", "shape": "hexahedra", "cells": [2, 1, 4]},
                 "components": {"rock": {"initial_stress": {"xx": "-10 MPa", "yy": "-10 MPa", "zz": "-10 MPa", **shear},
                                         "boundary": {"top": {"displacement": [*drive[:2], "0 m"]}, "bottom": {"displacement": [*drive[2:], "0 m"]},
                                                      **{side: {"displacement_y": None, **beside} for side in SIDES[:2]},
                                                      **{side: beside for side in SIDES[2:4]}}}}}
        space = self.run_scene([path, self.write(json.dumps(block), "block.yaml")], *settings)
        self.assertEqual(len(plane.times), len(space.times))
        self.assertGreater(plane.history["contact.events[1]"][-1], 0)
        self.assertLess(np.abs(space.times / plane.times - 1).max(), 1e-9)
        for column in ("contact.largest_slip_rate[m/s]", "contact.event_peak_slip_rate[m/s]"):
            found, wanted = space.history[column], plane.history[column]
            self.assertLess(np.abs(found - wanted).max(), 1e-5 * np.abs(wanted).max(), column)
        moment, of_plane = space.history["contact.event_moment[N*m]"][-1] / 10, plane.history["contact.event_moment[N]"][-1]  # 10 m deep
        self.assertLess(abs(moment - of_plane), 1e-5 * of_plane)

    @on_two_processes
    def test_two_processes_have_the_states_of_one(self):
        for order in ("first", "second"):
            name, state = list(states(NORMAL))[2]
            with self.subTest(name, order=order):
                self.assert_state(self.run_map(tetrahedra(state, order), "mesh.division=scattered", processes=2), state)


if __name__ == "__main__":
    unittest.main()
