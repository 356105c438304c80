#!/usr/bin/python3
"""contact_in_space_test.py SPREKK [MPIEXEC]: frictional contact in space in uniform states, which are exact: walls that stick, slide in any
direction with dilation and cohesion, or are open, on every kind of cell.

Twins: turned about no axis, mirrored, values that are disturbed by 1e-9, other types of contact, and two processes."""

import json
import unittest

import numpy as np

from hexahedra import TURN, mesh_file
from scene_runs import SceneRuns, on_two_processes

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

    @on_two_processes
    def test_two_processes_have_the_states_of_one(self):
        for order in ("first", "second"):
            name, state = list(states(NORMAL))[2]
            with self.subTest(name, order=order):
                self.assert_state(self.run_map(tetrahedra(state, order), "mesh.division=scattered", processes=2), state)


if __name__ == "__main__":
    unittest.main()
