#!/usr/bin/python3
"""contact_laws_in_space_test.py SPREKK [MPIEXEC]: the laws of contact in space along given paths of slip, pressure and opening. A block that a fault in
general position parts is strained uniformly; its two halves are displaced against each other along a path with turns and returns. Tractions, jumps and
stress then follow from the laws, which are written here once more, by hand.

Twins: hexahedra and wedges with bent faces, turned about no axis and mirrored; values that are disturbed by 1e-9; other types of contact, sdirk2, substeps,
adaptive steps, restarts, not condensed, and two processes."""

import json
import re
import unittest

import numpy as np

from contact_in_space_test import AXES, CORNERS, MIRROR, NORMAL, PARTS, POISSON, SIDES, YOUNG
from hexahedra import TURN, mesh_file
from scene_runs import SceneRuns, on_two_processes, sprekk

MPA, MM = 1e6, 1e-3
STIFFNESS, DISTANCE = 40e9 / 2.4 / 0.5, 1e-4  # of a block that is sheared, Pa/m; over which walls weaken, m
TOLD = re.compile(r"slip runs away at ([\d.e+-]+) s: along ([\d.e+-]+) m\^2 of fracture 'fault' around \([^)]+\) walls lose ([\d.e+-]+) Pa/m of slip, and the rock takes ([\d.e+-]+) Pa/m")


def towards(length, angle):
    """Slip of a length (mm) in a direction (degrees), m."""
    return MM * length * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])


def frame(normal):
    """The normal and the tangents of a fracture cell."""
    along = np.cross([0, 0, 1], normal) / np.linalg.norm(normal[:2])
    return np.vstack([normal, along, np.cross(normal, along)])


class Walls:
    """What walls do along a path: friction, cohesion and tensile strength are functions of (path, slip, pressure)."""

    def __init__(self, friction=lambda q, s, p: 0.6, cohesion=lambda q: 0.0, tension=lambda q: 0.0, dilation=lambda s: 0.1 * s, closure=lambda p: 0.0,
                 holds_open=False):
        self.friction, self.cohesion, self.tension, self.dilation, self.closure, self.holds_open = friction, cohesion, tension, dilation, closure, holds_open

    def follow(self, steps):
        """[(traction, jump)] of (slip, pressure in Pa, or a gap in m of walls that have parted; shear in Pa of walls that rest)."""
        found, slip, path, gap, shear = [], np.zeros(2), 0.0, 0.0, np.zeros(2)
        for to, pressure, opening, rest in steps:
            moved = to - slip
            path += np.linalg.norm(moved) + max(0.0, opening - gap)
            slip, gap = to, opening
            size = np.linalg.norm(slip)
            normal = self.tension(path) if opening > 0 else -pressure
            if np.linalg.norm(moved) > 0:
                held = self.cohesion(path) if opening == 0 or self.holds_open else 0.0
                shear = (held + self.friction(path, size, max(0.0, pressure if opening == 0 else 0.0)) * max(0.0, -normal)) * moved / np.linalg.norm(moved)
            else:
                shear = np.asarray(rest if rest is not None else shear)
            found.append((np.array([normal, *shear]), np.array([opening + self.dilation(size) - self.closure(-normal), *slip])))
        return found


def slid(slip, pressure=5.0):
    return slip, pressure * MPA, 0.0, None


def rests(shear, pressure=5.0, slip=np.zeros(2)):
    return slip, pressure * MPA, 0.0, np.array(shear) * MPA


def parted(slip, gap):
    return slip, 0.0, gap * MM, None


TURNS = [rests([0.6, -0.4]), slid(towards(0.3, 20)), slid(towards(0.3, 20) + towards(0.4, 130)), slid(towards(0.3, 20) + towards(0.9, 130)), slid(towards(0.2, 250))]
PRESSED = [rests([0.2, 0.5], 3.0), slid(towards(0.3, 20), 6.0), slid(towards(0.5, 80), 2.0), slid(towards(0.2, 200), 9.0)]
WEAKENED = Walls(friction=lambda q, s, p: 0.6 - 0.2 * min(1, q / (1 * MM)), cohesion=lambda q: MPA * max(0, 1 - q / (1 * MM)))
TENSILE = Walls(cohesion=lambda q: MPA * max(0, 1 - q / (1 * MM)), tension=lambda q: 0.5 * MPA * max(0, 1 - q / (1 * MM)), holds_open=True)
LAWS = {
    "weakening": (WEAKENED, TURNS, {"cohesion": "1 MPa", "weakening": {"distance": "1 mm", "friction": 0.4}}),
    "cohesion that stays": (Walls(cohesion=lambda q: MPA), TURNS[:3] + [parted(towards(0.4, 60), 0.2), slid(towards(0.5, 10))], {"cohesion": "1 MPa"}),
    "tensile strength": (TENSILE, [rests([0.3, -0.2], -0.4), parted(towards(0.1, 40), 0.1), parted(towards(0.3, 120), 0.3), parted(towards(0.4, 200), 0.8)],
                         {"cohesion": "1 MPa", "tensile_strength": "0.5 MPa", "weakening": {"distance": "1 mm"}}),
    "dilation limit": (Walls(dilation=lambda s: 0.1 * min(s, 0.5 * MM)), TURNS, {"dilation_limit": "0.5 mm"}),
    "linear closure": (Walls(closure=lambda p: p / 5e10), PRESSED, {"closure": {"law": "linear", "stiffness": "5e10 Pa/m"}}),
    "Barton and Bandis": (Walls(closure=lambda p: p * 2e-4 / (2e10 * 2e-4 + p)), PRESSED,
                          {"closure": {"law": "barton_bandis", "stiffness": "2e10 Pa/m", "largest": "0.2 mm"}}),
    "formulas": (Walls(friction=lambda q, s, p: 0.6 - 0.1 * q / MM - 0.05 * s / MM - 0.01 * p / MPA, cohesion=lambda q: 0.5 * MPA * np.exp(-q / MM),
                       dilation=lambda s: 0.1 * MM * (1 - np.exp(-s / MM)), closure=lambda p: p * 1e-4 / (4 * MPA + p)), PRESSED,
                 {"friction": "0.6 - 0.1*path/(1 mm) - 0.05*slip/(1 mm) - 0.01*sigma_n/(1 MPa)", "cohesion": "0.5 MPa*exp(-path/(1 mm))",
                  "dilation_angle": None, "dilation": "0.1 mm*(1 - exp(-slip/(1 mm)))",
                  "closure": {"law": "formula", "closure": "sigma_n*0.1 mm/(4 MPa + sigma_n)"}}),
}

IN_TIME = {"seconds": [], "two stages": ["time.scheme=sdirk2"], "two stages, short": ["time.scheme=sdirk2", "time.step=0.5 s"], "not condensed": ["solver.condense=false"],
           "substeps": ["schedule=[{subcycle: {count: 2, steps: [{solve: [rock, contact]}]}}]"],
           "adaptive": ["time.step=0.3 s", "time.adaptive={largest: 0.7 s, grow: 1.3}"], "second order": ["components.rock.order=second"]}
EXPANSION = 1e-5  # 1/K


class Driven:
    """A path of walls with this normal in a block: what its sides are given, linear in each second."""

    def __init__(self, normal, walls, steps, *, fluid=0.0, heat=0.0, initial=None, on_walls=1.0, biot=0.0):
        """`fluid`, `heat`: pressure (Pa) and warming (times the expansion) at the end of each second; `initial`: a stress that is there before."""
        self.axes, self.states = frame(normal), walls.follow(steps)
        self.fluid = np.array(fluid) * np.ones(len(steps))
        self.heat = np.array(heat) * np.ones(len(steps))
        self.stresses, self.strains = [], []
        for k, (traction, _) in enumerate(self.states):
            total = traction - [on_walls * self.fluid[k], 0, 0]
            whole = np.array([[total[0], *total[1:]], [total[1], -4e6, 0.7e6], [total[2], 0.7e6, -7e6]])
            stress = self.axes.T @ whole @ self.axes
            self.stresses.append(stress)
            carried = stress - (0 if initial is None else initial) + biot * self.fluid[k] * np.eye(3)
            self.strains.append((1 + POISSON) / YOUNG * carried - POISSON / YOUNG * np.trace(carried) * np.eye(3) + self.heat[k] * np.eye(3))

    def in_time(self, values, start=0.0):
        """An expression: `values` at 1 s, 2 s, …, linear between."""
        parts = [f"({float(b - a)!r})*min(max(t/s - {k}, 0), 1)" for k, (a, b) in enumerate(zip([start, *values], values)) if b != a]
        return " + ".join([repr(float(start)), *parts])

    def displacement(self, point):
        side = " + ".join(f"({float(n)!r})*{axis}/m" for n, axis in zip(self.axes[0], "xyz"))
        leaps = [self.axes.T @ jump for _, jump in self.states]
        return ["(" + " + ".join(f"({self.in_time([strain[i, j] for strain in self.strains])})*{axis}/m" for j, axis in enumerate("xyz")) +
                f" + if({side} > {float(self.axes[0] @ point)!r}, {self.in_time([leap[i] for leap in leaps])}, 0)) m" for i in range(3)]

    def scene(self, geometry, mesh, sides, point, **contact):
        given = {"displacement": self.displacement(point)}
        laws = {key: value for key, value in {"friction": 0.6, "dilation_angle": f"{float(np.arctan(0.1))!r} rad", "large_jump": 1, **contact}.items() if value is not None}
        return {"name": "contact_laws_in_space", "geometry": geometry, **({"mesh": mesh} if mesh else {}),
                "components": {"rock": {"type": "poromechanics/fem", "young_modulus": f"{YOUNG} Pa", "poisson_ratio": POISSON, "boundary": {side: given for side in sides}},
                               "contact": {"type": "contact/coulomb", **laws}},
                "couplers": [{"type": "wall_traction", "between": ["rock", "contact"]}], "schedule": [{"solve": ["rock", "contact"]}],
                "time": {"end": f"{len(self.states)} s", "step": "1 s"}, "output": {"every": "1 s", "fields": True}}


class ContactLawsInSpace(SceneRuns):
    def run_map(self, of_scene, *settings, **how):
        return self.run_scene(self.write(json.dumps(of_scene, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    @staticmethod
    def in_tetrahedra(driven, **contact):
        points = [[f"{float(c)!r} m" for c in corner] for corner in CORNERS]
        return driven.scene({"box": {"x": ["0 m", "1 m"], "y": ["0 m", "1.2 m"], "z": ["0 m", "0.9 m"]}, "fractures": {"cut": {"points": points}}},
                            {"size": "0.6 m"}, SIDES, CORNERS[0], **contact)

    def from_file(self, driven, turn, wedges, **contact):
        file = self.write(mesh_file(turn, cells=(2, 2, 2), wedges=wedges), f"mesh_{next(self.numbers)}.msh")
        return driven.scene({"file": str(file)}, None, ("west", "others"), turn @ [0.5, 0.5, 0.5], **contact)

    def assert_path(self, results, driven, within=1e-9, ends=None, traction="contact.traction", jump="contact.jump"):
        """At the end of each second; of those in `ends` only."""
        for k, (wanted_traction, wanted_jump) in enumerate(driven.states):
            if ends is not None and k not in ends:
                continue
            fields, stress = results.fractures(time=k + 1.0), driven.stresses[k]
            found = [np.column_stack([fields[f"{what}.{part}"] for part in PARTS]) for what in (traction, jump)]
            misses = []
            for sign in (1, -1):  # the normal of a file's fracture may point to either side; along the second tangent values then have the other sign
                wanted = [w * [1, 1, sign] for w in (wanted_traction, wanted_jump)]
                misses.append([np.abs(f - w).max() / s for f, w, s in zip(found, wanted, (np.abs(stress).max(), 2e-4))])
            self.assertLess(min(max(miss) for miss in misses), within, (k, found[0][0], wanted_traction, found[1][0], wanted_jump))
            of_rock = results.fields(time=k + 1.0)["rock.stress"]
            self.assertLess(np.abs(of_rock - [stress[i, j] for i, j in AXES]).max(), within * np.abs(stress).max(), k)

    def test_each_law_along_a_path_with_turns(self):
        for name, (walls, steps, contact) in LAWS.items():
            with self.subTest(name):
                driven = Driven(NORMAL, walls, steps)
                self.assert_path(self.run_map(self.in_tetrahedra(driven, **contact)), driven)

    def test_so_they_are_on_hexahedra_and_wedges_turned_and_mirrored(self):
        for name, turn, wedges, order in (("weakening", TURN, True, "first"), ("tensile strength", MIRROR, False, "first"), ("formulas", MIRROR, True, "second"),
                                          ("Barton and Bandis", TURN, False, "second")):
            walls, steps, contact = LAWS[name]
            with self.subTest(name):
                driven = Driven(turn[:, 0], walls, steps)
                self.assert_path(self.run_map(self.from_file(driven, turn, wedges, **contact), f"components.rock.order={order}"), driven)

    def test_other_types_of_contact(self):
        """Springs of a penalty: 1e7 times the rock's, whose traction over stiffness is 1e-7 of what it displaces."""
        for kind, within in (("augmented_lagrangian", 1e-9), ("penalty", 1e-5)):
            for name in ("weakening", "tensile strength", "Barton and Bandis", "formulas"):
                walls, steps, contact = LAWS[name]
                settings = [f"components.contact.type=contact/{kind}"] + ["components.contact.stiffness_factor=1e7"] * (kind == "penalty")
                with self.subTest(name, kind=kind):
                    driven = Driven(NORMAL, walls, steps)
                    self.assert_path(self.run_map(self.in_tetrahedra(driven, **contact), *settings), driven, within)

    def test_linear_paths_in_other_steps(self):
        """Walls rest while their shear turns, and slide along it: a path that is linear in each second, whatever the steps."""
        walls, driven = self.linear_path()
        for name, settings in IN_TIME.items():
            with self.subTest(name):
                self.assert_path(self.run_map(self.in_tetrahedra(driven, **walls), *settings), driven)

    @staticmethod
    def linear_path():
        turned = lambda held, angle: held * towards(1e3, angle)  # MPa
        first, then = towards(0.3, 20), towards(0.3, 20) + towards(0.5, 130)
        steps = [rests([0.6, -0.4]), rests(turned(4.0, 20)), slid(first), rests(turned(3.4, 130), slip=first), slid(then), rests([-0.5, 0.3], slip=then)]
        walls = Walls(WEAKENED.friction, WEAKENED.cohesion, dilation=lambda s: 0.0, closure=lambda p: p / 5e10)
        return {**LAWS["weakening"][2], **LAWS["linear closure"][2], "dilation_angle": None}, Driven(NORMAL, walls, steps)

    def test_a_restart_goes_on_to_the_bit(self):
        walls, driven = self.linear_path()
        scene = self.in_tetrahedra(driven, **walls)
        whole, part = self.run_map(scene), self.run_map(scene, "time.end=3 s")
        self.assert_same_bits(self.run_map(scene, restart=part.folder), whole)

    def test_two_faults_with_contacts_of_their_own(self):
        """Beside the fault another one, parallel to it, whose walls rest and are closed by the law of Barton and Bandis."""
        walls, steps, contact = LAWS["weakening"]
        driven = Driven(NORMAL, walls, steps)
        scene = self.in_tetrahedra(driven, fractures=["cut"], **contact)
        away = CORNERS + [0.3, 0, 0]
        scene["geometry"]["fractures"]["beside"] = {"points": [[f"{float(c)!r} m" for c in corner] for corner in away]}
        scene["components"]["other"] = {"type": "contact/coulomb", "fractures": ["beside"], "friction": 2, "large_jump": 1, "closure": LAWS["Barton and Bandis"][2]["closure"]}
        scene["couplers"][0]["between"].append("other")
        scene["schedule"] = [{"solve": ["rock", "contact", "other"]}]
        closed = [np.array([-LAWS["Barton and Bandis"][0].closure(-traction[0]), 0, 0]) for traction, _ in driven.states]
        leaps = [driven.axes.T @ jump for jump in closed]
        side = " + ".join(f"({float(n)!r})*{axis}/m" for n, axis in zip(NORMAL, "xyz"))
        given = [f"{text[:-3]} + if({side} > {float(NORMAL @ away[0])!r}, {driven.in_time([leap[i] for leap in leaps])}, 0)) m"
                 for i, text in enumerate(driven.displacement(CORNERS[0]))]
        for condition in scene["components"]["rock"]["boundary"].values():
            condition["displacement"] = given
        results = self.run_map(scene)
        for k, (traction, jump) in enumerate(driven.states):
            fields = results.fractures(time=k + 1.0)
            is_on = np.abs((fields.centres - CORNERS[0]) @ NORMAL) < 1e-6
            self.assertTrue(0 < is_on.sum() < len(is_on))
            found = [np.column_stack([fields[f"wall_traction.{what}.{part}"] for part in PARTS]) for what in ("contact_traction", "jump")]
            for here, wanted in ((is_on, (traction, jump)), (~is_on, (traction, closed[k]))):
                for values, value, scale in zip(found, wanted, (1e7, 2e-4)):
                    self.assertLess(np.abs(values[here] - value).max(), 1e-9 * scale, (k, values[here][0], value))

    def with_fluid(self, driven, *, biot=0.0, on_walls=1.0, heat=False, **contact):
        """Water at the same pressure everywhere, which the sides give, and rock that is warmed everywhere."""
        scene = self.in_tetrahedra(driven, **contact)
        pressure = f"({driven.in_time(driven.fluid)}) Pa"
        held = {side: {"pressure": pressure} for side in SIDES}
        scene["components"]["pore"] = {"type": "matrix_flow/mpfa", "permeability": "1 m^2", "viscosity": "1 mPa*s", "storage": "0 1/Pa", "boundary": held}
        scene["components"]["conduit"] = {"type": "fracture_flow/mfd", "initial_aperture": "1 mm", "viscosity": "1 mPa*s", "fluid_compressibility": "4e-10 1/Pa",
                                          "transmissivity": "constant", "transmissivity_value": "1 m^3", "normal_permeability": "constant",
                                          "normal_permeability_value": "1e3 m/(Pa*s)", "boundary": held}
        scene["couplers"] = [{"type": "biot", "between": ["pore", "rock"], "biot_coefficient": biot}, {"type": "wall_exchange", "between": ["pore", "conduit"]},
                             {"type": "wall_traction", "between": ["rock", "contact", "conduit"], "fracture_biot_coefficient": on_walls},
                             {"type": "aperture", "between": ["contact", "conduit"]}]
        scene["schedule"] = [{"solve": ["pore", "rock", "contact", "conduit"]}]
        if heat:
            scene["components"]["heat"] = {"type": "matrix_heat/prescribed", "temperature": f"(300 + {driven.in_time(driven.heat / EXPANSION)}) K"}
            scene["couplers"].append({"type": "thermal_stress", "between": ["heat", "rock"], "expansion": f"{EXPANSION!r} 1/K"})
        return scene

    def fluid_path(self, name="weakening", **how):
        walls, steps, contact = LAWS[name]
        driven = Driven(NORMAL, walls, steps, fluid=[1e6, 3e6, 2e6, 0.5e6, 4e6][:len(steps)], heat=1e-5 * np.array([3.0, 5, -4, 8, 1])[:len(steps)],
                        biot=0.7, on_walls=0.9)
        return driven, self.with_fluid(driven, biot=0.7, on_walls=0.9, heat=True, **contact)

    def test_fluid_and_heat_beside_the_laws(self):
        for name, settings in (("weakening", []), ("weakening", ["solver.condense=false"]), ("formulas", ["components.rock.order=second"]), ("tensile strength", [])):
            with self.subTest(name, settings=settings):
                driven, scene = self.fluid_path(name)
                results = self.run_map(scene, *settings)
                self.assert_path(results, driven)
                for k, (_, jump) in enumerate(driven.states):
                    fields = results.fractures(time=k + 1.0)
                    self.assertLess(np.abs(fields["conduit.pressure"] - driven.fluid[k]).max(), 1e-9 * 4e6)
                    self.assertLess(np.abs(fields["conduit.aperture"] - 1e-3 - jump[0]).max(), 1e-9 * 1e-3)

    def test_passes_have_the_answer_of_all_at_once(self):
        driven, scene = self.fluid_path()
        scene["schedule"] = [{"iterate": {"steps": [{"solve": ["pore", "conduit"], "stabilize": "fixed_stress"}, {"solve": ["rock", "contact"]}], "until": {"relative": 1e-12, "at_most": 60}}}]
        self.assert_path(self.run_map(scene), driven)

    def test_walls_that_bear_an_initial_stress(self):
        """It rests at the start, by itself and settled; then the path goes on from there."""
        walls, steps, contact = LAWS["linear closure"]
        axes = frame(NORMAL)
        before = axes.T @ np.array([[-4e6, 0.3e6, 0.2e6], [0.3e6, -4e6, 0.7e6], [0.2e6, 0.7e6, -7e6]]) @ axes
        driven = Driven(NORMAL, walls, steps, initial=before)
        closed = -walls.closure(4e6)
        for settled in (False, True):
            with self.subTest(settled=settled):
                path = Driven(NORMAL, walls, steps, initial=before)
                path.states = [(traction, jump - [closed, 0, 0]) for traction, jump in driven.states]  # sides move from the closed state on
                scene = self.in_tetrahedra(path, **contact)
                scene["components"]["rock"]["initial_stress"] = {name: f"{float(before[i, j])!r} Pa" for name, (i, j) in zip(("xx", "yy", "zz", "xy", "yz", "xz"), AXES)}
                scene["components"]["rock"]["order"] = "second"
                if settled:
                    scene["start"] = {"settle": ["rock", "contact"]}
                self.assert_path(self.run_map(scene), driven)

    def test_disturbed_values(self):
        for name in ("weakening", "formulas"):
            walls, steps, contact = LAWS[name]
            driven = Driven(NORMAL, walls, steps)
            one, other = (self.run_map(self.in_tetrahedra(driven, **contact), f"components.rock.young_modulus={YOUNG * factor!r} Pa") for factor in (1, 1 + 1e-9))
            for what, scale in (("jump", 1e-3), ("traction", 1e7)):
                for part in PARTS:
                    field = f"contact.{what}.{part}"
                    self.assertLess(np.abs(one.fractures()[field] - other.fractures()[field]).max(), 1e-7 * scale, (name, field))

    @on_two_processes
    def test_two_processes(self):
        for driven, scene in ((lambda walls, steps, contact: (lambda d: (d, self.in_tetrahedra(d, **contact)))(Driven(NORMAL, walls, steps)))(*LAWS["tensile strength"]),
                              self.fluid_path("formulas")):
            self.assert_path(self.run_map(scene, processes=2), driven)

    def block(self, ratio, angle, shape="hexahedra", factor=1.0, cells=(2, 2, 4), **laws):
        """A block (runaway_test.py) whose halves are sheared in a direction (degrees) off its sides. `ratio`: its stiffness over what walls lose."""
        lost, rate = STIFFNESS / ratio * DISTANCE / 10e6, 0.5e5 * factor / STIFFNESS
        x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        drive = {sign: {"displacement": [f"({sign}{rate}*({float(c)!r})*t/s) m" for c in (x, y)] + ["0 m"]} for sign in "+-"}
        beside = {"displacement_z": "0 m", "traction_x": "0 Pa", "traction_y": "0 Pa"}
        stress = {"xx": "0 Pa", "yy": "0 Pa", "zz": "-10 MPa", "xz": f"{float(5.47e6 * x)!r} Pa", "yz": f"{float(5.47e6 * y)!r} Pa"}
        weakens = {} if "friction" in laws else {"friction": 0.6, "weakening": {"distance": f"{DISTANCE} m", "friction": 0.6 - lost}}
        laws = {key: value.format(lost / DISTANCE, 0.6 - lost) if key == "friction" else value for key, value in laws.items()}
        return {"name": "runaway", "mesh": {"kind": "structured", "shape": shape, "cells": list(cells)},
                "geometry": {"box": {"x": ["0 m", "0.4 m"], "y": ["0 m", "0.3 m"], "z": ["-0.25 m", "0.25 m"]},
                             "fractures": {"fault": {"points": [[f"{a} m", f"{b} m", "0 m"] for a, b in ((0, 0), (0, 0.3), (0.4, 0.3), (0.4, 0))]}}},
                "components": {"rock": {"type": "poromechanics/fem", "young_modulus": f"{40 * factor} GPa", "poisson_ratio": 0.2, "initial_stress": stress,
                                        "boundary": {"top": drive["+"], "bottom": drive["-"], **{side: beside for side in SIDES[:4]}}},
                               "contact": {"type": "contact/coulomb", "large_jump": 1, **weakens, **laws}},
                "couplers": [{"type": "wall_traction", "between": ["rock", "contact"]}], "schedule": [{"solve": ["rock", "contact"]}], "time": {"end": "6 s", "step": "1 s"}}

    def test_slip_runs_away_below_the_critical_stiffness(self):
        """And not above it, where nothing is told; in any direction, also where an equilibrium is found beyond the jump."""
        for ratio, angle, how in ((0.9, 35, {}), (0.999, 35, {}), (0.999, 35, {"factor": 1 + 1e-9}), (0.97, 90, {"shape": "tetrahedra"}), (1.01, 35, {}), (1.01, 200, {"shape": "tetrahedra"}), (0.97, 35, {"cells": (1, 1, 2)}),
                                  (0.97, 310, {"type": "contact/augmented_lagrangian"}), (0.97, 200, {"friction": "max({1}, 0.6 - slip*{0}/m)"}),
                                  (0.97, 120, {"friction": "max({1}, 0.6 - path*{0}/m)", "shape": "wedges"})):
            with self.subTest(ratio=ratio, angle=angle, **how):
                folder = self.folder / f"runaway_{next(self.numbers)}"
                run = self.call(["run", "-o", folder], self.write(json.dumps(self.block(ratio, angle, **how)), f"{folder.name}.yaml"))
                told = TOLD.search(run.stderr + " ".join(note["text"] for note in sprekk.Results(folder).record["notes"]))
                self.assertEqual(told is not None, ratio < 1, run.stderr)
                if told:
                    at, area, lost, taken = map(float, told.groups())
                    self.assertAlmostEqual(at, 5.3, delta=1e-3)
                    self.assertAlmostEqual(area, 0.12, delta=1e-9)
                    self.assertAlmostEqual(lost * ratio / STIFFNESS, 1, delta=1e-3)
                    self.assertAlmostEqual(taken / STIFFNESS, 1, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
