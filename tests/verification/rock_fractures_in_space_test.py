#!/usr/bin/python3
"""rock_fractures_in_space_test.py SPREKK [MPIEXEC]: open fractures in rock in space, without contact: constant jumps and linear
displacements, which are exact, and the penny-shaped crack under pressure.

Twins: in general position, values that are disturbed by 1e-9, and two processes."""

import copy
import json
import unittest

import numpy as np

from scene_runs import SceneRuns, on_two_processes

SIDES = ("left", "right", "front", "back", "bottom", "top")
YOUNG, POISSON, PRESSURE = 1e10, 0.2, 1e6
ROCK = {"type": "poromechanics/fem", "young_modulus": f"{YOUNG} Pa", "poisson_ratio": POISSON}
CONDUIT = {"type": "fracture_flow/mfd", "viscosity": "1 mPa*s", "fluid_compressibility": "0 1/Pa", "initial_aperture": "1 mm",
           "prescribed": {"everywhere": {"pressure": f"{PRESSURE} Pa"}}}
JUMP = [f"wall_traction.jump.{part}" for part in ("normal", "tangential1", "tangential2")]


def scene(geometry, mesh, rock):
    return {"name": "open", "geometry": geometry, "mesh": mesh, "components": {"rock": {**ROCK, **rock}, "conduit": copy.deepcopy(CONDUIT)},
            "couplers": [{"type": "wall_traction", "between": ["rock", "conduit"]}], "schedule": [{"solve": ["rock", "conduit"]}],
            "time": {"end": "1 s", "step": "1 s"}, "output": {"fields": True}}


class RockFracturesInSpace(SceneRuns):
    def run_map(self, of_scene, *settings, **how):
        return self.run_scene(self.write(json.dumps(of_scene, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    @staticmethod
    def cut_box(order):
        """A fracture in general position cuts the box. On its walls the stress is the pressure; across it the displacement jumps by a constant."""
        corners = np.array([[0.3, 0, 0], [0.5, 1.2, 0], [0.6, 1.2, 0.9], [0.4, 0, 0.9]])  # all in one plane
        normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
        normal /= np.linalg.norm(normal)
        along, across = np.linalg.qr(np.column_stack([normal, np.eye(3)[:, :2]]))[0][:, 1:].T
        stress = -PRESSURE * np.outer(normal, normal) + 3e6 * np.outer(along, along) - 2e6 * np.outer(across, across) + 1e6 * (np.outer(along, across) + np.outer(across, along))
        gradient = (1 + POISSON) / YOUNG * stress - POISSON / YOUNG * np.trace(stress) * np.eye(3)
        jump = 1e-4 * (2 * normal + along - 0.5 * across)
        side = " + ".join(f"({float(n)!r})*{axis}/m" for n, axis in zip(normal, "xyz"))
        u = [f"({' + '.join(f'({float(g)!r})*{axis}' for g, axis in zip(row, 'xyz'))} + if({side} > {float(normal @ corners[0])!r}, {float(part)!r}, 0)) m"
             for row, part in zip(gradient, jump)]
        points = [[f"{float(c)!r} m" for c in corner] for corner in corners]
        geometry = {"box": {"x": ["0 m", "1 m"], "y": ["0 m", "1.2 m"], "z": ["0 m", "0.9 m"]}, "fractures": {"cut": {"points": points}}}
        return scene(geometry, {"size": "0.3 m"}, {"order": order, "boundary": {side: {"displacement": u} for side in SIDES}}), stress, jump

    def test_a_constant_jump_is_exact(self):
        for order in ("first", "second"):
            given, stress, jump = self.cut_box(order)
            results = self.run_map(given)
            found = results.fields()["rock.stress"]
            wanted = stress[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
            self.assertLess(np.abs(found - wanted).max(), 1e-9 * np.abs(wanted).max(), order)
            lines = results.fractures()
            jumps = np.column_stack([lines[part] for part in JUMP])
            self.assertLess(np.abs(np.linalg.norm(jumps, axis=1) - np.linalg.norm(jump)).max(), 1e-9 * np.linalg.norm(jump), order)
            self.assertLess(np.abs(jumps[:, 0] - 2e-4).max(), 1e-13, order)

    @staticmethod
    def disc(order, size, growth=0.3, half=8):
        box = {axis: [f"-{half} m", f"{half} m"] for axis in "xyz"}
        fracture = {"center": ["0 m", "0 m", "0 m"], "strike": "30 deg", "dip": "40 deg", "radius": "1 m"}
        return scene({"box": box, "fractures": {"disc": fracture}}, {"size": "4 m", "fracture_size": f"{size} m", "growth": growth},
                     {"order": order, "boundary": {"left": {"displacement_x": "0 m"}, "front": {"displacement_y": "0 m"}, "bottom": {"displacement_z": "0 m"}}})

    def opening_and_volume(self, of_scene, *settings, **how):
        """Errors, over Sneddon's: of the mean opening in cells nearer to the centre than half the radius, and of the volume."""
        lines = self.run_map(of_scene, *settings, **how).fractures()
        largest = 8 * (1 - POISSON**2) * PRESSURE / (np.pi * YOUNG)
        radius = np.linalg.norm(lines.centres, axis=1)
        exact = largest * np.sqrt(1 - np.minimum(radius, 1)**2)
        inner = radius < 0.5
        volume = 16 * (1 - POISSON**2) * PRESSURE / (3 * YOUNG)
        return np.mean(lines[JUMP[0]][inner] / exact[inner]) - 1, lines.sizes @ lines[JUMP[0]] / volume - 1

    def test_the_penny_shaped_crack_opens_as_sneddon_says(self):
        """With four cells on the radius; at first order the rock around is too stiff, so its cells grow more slowly."""
        opening, volume = self.opening_and_volume(self.disc("second", 1 / 4, growth=0.6, half=6))
        print(f"penny-shaped crack, second order: opening {opening:.4f}, volume {volume:.4f}")
        self.assertLess(abs(opening), 0.01)
        self.assertLess(abs(volume), 0.005)
        opening, volume = self.opening_and_volume(self.disc("first", 1 / 4, growth=0.15))
        print(f"penny-shaped crack, first order: opening {opening:.4f}, volume {volume:.4f}")
        self.assertLess(abs(opening), 0.12)
        self.assertLess(abs(volume), 0.14)

    def test_a_crack_that_rock_closes_keeps_its_stress(self):
        """Linear displacements are exact around the rim, too: walls that are pressed apart as much as the rock pulls do not move."""
        for order in ("first", "second"):
            given = self.disc(order, 1 / 2, growth=1, half=2)
            given["mesh"]["size"] = "2 m"
            stress = -PRESSURE * np.eye(3)
            gradient = (1 + POISSON) / YOUNG * stress - POISSON / YOUNG * np.trace(stress) * np.eye(3)
            u = [f"({float(gradient[0, 0])!r}*{axis}) m" for axis in "xyz"]
            given["components"]["rock"]["boundary"] = {side: {"displacement": u} for side in SIDES}
            results = self.run_map(given)
            self.assertLess(np.abs(results.fields()["rock.stress"] - np.array([-PRESSURE] * 3 + [0] * 3)).max(), 1e-10 * PRESSURE, order)
            self.assertLess(np.abs(results.fractures()[JUMP[0]]).max(), 1e-10 * PRESSURE / YOUNG, order)

    def test_a_disturbed_crack_hardly_moves(self):
        found = self.opening_and_volume(self.disc("first", 1 / 4))
        disturbed = self.opening_and_volume(self.disc("first", 1 / 4), "components.rock.young_modulus=10.00000001 GPa")
        self.assertLess(np.abs(np.subtract(disturbed, found)).max(), 1e-8)

    @on_two_processes
    def test_two_processes_have_the_answer_of_one(self):
        found, other = (self.opening_and_volume(self.disc("first", 1 / 3), "mesh.division=scattered", processes=processes) for processes in (1, 2))
        self.assertLess(np.abs(np.subtract(found, other)).max(), 1e-9)

    def test_rock_with_fractures_needs_what_acts_on_its_walls(self):
        given = self.disc("first", 1 / 3)
        del given["couplers"]
        call = self.call("check", self.write(json.dumps(given), "bare.yaml"))
        self.assertEqual(call.returncode, 2)
        self.assertIn("needs a coupler of type 'wall_traction'", call.stderr)

    def test_a_note_tells_of_walls_that_overlap(self):
        given = self.disc("first", 1 / 3)
        given["components"]["conduit"]["prescribed"]["everywhere"]["pressure"] = "0 Pa"
        given["components"]["rock"]["boundary"]["top"] = {"normal_stress": "-1 MPa"}
        self.assertTrue(any("walls of fractures overlap by" in note for note in self.run_map(given).notes))


if __name__ == "__main__":
    unittest.main()
