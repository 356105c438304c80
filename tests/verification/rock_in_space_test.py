#!/usr/bin/python3
"""rock_in_space_test.py SPREKK [MPIEXEC]: deformation of rock in space: linear displacements, which are exact on every kind of mesh; rest
under weight; balance of forces; consolidation; what is refused.

Twins: turned about no axis, mirrored, values that are disturbed by 1e-9, and two processes."""

import json
import unittest

import numpy as np

from hexahedra import TURN, mesh_file
from scene_runs import SceneRuns, on_two_processes

SIDES = ("left", "right", "front", "back", "bottom", "top")
GRADIENT = np.array([[1.0, 2.0, -1.0], [0.5, -1.0, 3.0], [0.1, 0.2, 0.7]]) * 1e-3
SHIFT = np.array([0.3, -0.2, 0.1])
YOUNG = 1e10
AXES = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]  # of the components of a stress


def stress_of(gradient, poisson):
    lame = YOUNG * poisson / ((1 + poisson) * (1 - 2 * poisson))
    return lame * np.trace(gradient) * np.eye(3) + YOUNG / (2 * (1 + poisson)) * (gradient + gradient.T)


def linear(row, unit, constant):
    """A component of a linear vector as an expression."""
    return "(" + " + ".join([repr(float(constant)), *(f"({float(a)!r})*{axis}" for a, axis in zip(row, "xyz"))]) + f") {unit}"


def displacement():
    return [linear(row, "m", at) for row, at in zip(GRADIENT, SHIFT)]


def scene(geometry, mesh, boundary, **rock):
    """A scene of rock alone, as a map."""
    return {"name": "rock_in_space", "geometry": geometry, **({"mesh": mesh} if mesh else {}),
            "components": {"rock": {"type": "poromechanics/fem", "young_modulus": f"{YOUNG} Pa", "poisson_ratio": 0.25, "boundary": boundary, **rock}},
            "schedule": {"solve": "rock"}, "time": {"end": "1 s", "step": "1 s"}, "output": {"fields": True}}


BOX = {"box": {"x": ["0 m", "1 m"], "y": ["0 m", "1.2 m"], "z": ["0 m", "0.9 m"]}}
MESHES = ("{size: 0.3 m}", "{kind: structured, shape: hexahedra, cells: [3, 3, 2]}", "{kind: structured, shape: wedges, cells: [3, 3, 2]}",
          "{kind: structured, shape: tetrahedra, cells: [3, 3, 2]}")


class RockInSpace(SceneRuns):
    def run_map(self, of_scene, *settings, **how):
        return self.run_scene(self.write(json.dumps(of_scene, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    def refusal(self, of_scene, *settings):
        call = self.call("check", self.write(json.dumps(of_scene, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings)
        self.assertEqual(call.returncode, 2, call.stderr)
        return call.stderr

    def assert_linear(self, results, poisson=0.25, within=1e-10):
        rock = results.fields()
        self.assertEqual(rock.dimension, 3)
        places = rock.points
        moved = rock["rock.displacement"] - (SHIFT + places @ GRADIENT.T)
        self.assertLess(np.abs(moved).max(), within * np.abs(places @ GRADIENT.T).max())
        stress = stress_of(GRADIENT, poisson)
        wanted = np.array([stress[i, j] for i, j in AXES])
        self.assertLess(np.abs(rock["rock.stress"] - wanted).max(), within * np.abs(wanted).max())

    def test_linear_displacements_are_exact_on_every_mesh(self):
        """Also where a side is loaded by tractions, and where rock is nearly incompressible."""
        for mesh in MESHES:
            for order, poisson in (("first", 0.25), ("first", 0.499), ("second", 0.25), ("second", 0.499)):
                with self.subTest(mesh, order=order, poisson=poisson):
                    boundary = {side: {"displacement": displacement()} for side in SIDES}
                    boundary["right"] = {"traction": [f"{t!r} Pa" for t in map(float, stress_of(GRADIENT, poisson)[:, 0])]}
                    boundary["top"] = {"displacement_z": displacement()[2], "traction_x": f"{float(stress_of(GRADIENT, poisson)[0, 2])!r} Pa",
                                       "traction_y": f"{float(stress_of(GRADIENT, poisson)[1, 2])!r} Pa"}
                    results = self.run_map(scene(BOX, None, boundary, poisson_ratio=poisson, order=order), f"mesh={mesh}")
                    self.assert_linear(results, poisson, 1e-10 if poisson < 0.4 else 1e-8)

    def from_file(self, turn, wedges, boundary, **rock):
        file = self.write(mesh_file(turn, wedges=wedges, fault=False), f"mesh_{next(self.numbers)}.msh")
        return scene({"file": str(file)}, None, boundary, **rock)

    def test_so_they_are_in_cells_with_bent_faces(self):
        """As drawn, turned about no axis, and mirrored; the flat side by its tractions."""
        mirror = TURN @ np.diag([1, -1, 1])
        for turn in (np.eye(3), TURN, mirror):
            for wedges in (False, True):
                with self.subTest(turn=turn, wedges=wedges):
                    order = "second" if wedges == (turn is TURN) else "first"
                    traction = stress_of(GRADIENT, 0.25) @ turn @ [-1, 0, 0]
                    boundary = {"west": {"traction": [f"{t!r} Pa" for t in map(float, traction)]}, "others": {"displacement": displacement()}}
                    self.assert_linear(self.run_map(self.from_file(turn, wedges, boundary, order=order)))

    def test_anisotropic_rock_has_the_stress_of_its_stiffness(self):
        rng = np.random.default_rng(2)
        half = rng.uniform(-1, 1, (6, 6))
        stiffness = 1e10 * (half @ half.T + np.eye(6))
        names = [f"{'xyz'[i]}{'xyz'[j]}" for i, j in AXES]
        entries = {names[i] + names[j]: f"{float(stiffness[i, j])!r} Pa" for i in range(6) for j in range(i, 6)}
        one = scene(BOX, None, {side: {"displacement": displacement()} for side in SIDES}, stiffness=entries)
        del one["components"]["rock"]["young_modulus"], one["components"]["rock"]["poisson_ratio"]
        strain = [GRADIENT[i, i] if i == j else GRADIENT[i, j] + GRADIENT[j, i] for i, j in AXES]
        found = self.run_map(one, "mesh={size: 0.4 m}").fields()["rock.stress"]
        self.assertLess(np.abs(found - stiffness @ strain).max(), 1e-10 * np.abs(stiffness @ strain).max())

    def test_weight_and_initial_stress_are_at_rest(self):
        """Lithostatic stress with two other principal values and rollers: nothing moves, and the stress stays, linear in z."""
        weight = 2500 * 9.81
        height = f"(-{weight!r}*(0.9 - z)) Pa"
        stress = {"xx": "(-7e5) Pa", "yy": "(-5e5) Pa", "zz": height, "xy": "0 Pa", "yz": "0 Pa", "xz": "0 Pa"}
        boundary = {side: {"displacement_normal": "0 m"} for side in SIDES if side != "top"}
        for mesh, order in zip(MESHES, ("first", "second", "first", "second")):
            results = self.run_map(scene(BOX, None, boundary, order=order, initial_stress=stress, rock_density="2500 kg/m^3",
                                         gravity=["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]), f"mesh={mesh}")
            rock = results.fields()
            self.assertLess(np.abs(rock["rock.displacement"]).max(), 1e-10 * weight * 0.9**2 / YOUNG, mesh)
            wanted = np.zeros((len(rock.centres), 6))
            wanted[:, 0], wanted[:, 1], wanted[:, 2] = -7e5, -5e5, -weight * (0.9 - rock.centres[:, 2])
            self.assertLess(np.abs(rock["rock.stress"] - wanted).max(), 1e-9 * 7e5, mesh)
            self.assertFalse(results.notes)

    def test_what_is_for_a_plane_says_what_to_write(self):
        boundary = {"left": {"displacement": ["0 m", "0 m", "0 m"]}}
        self.assertIn("'traction: [x, y, z]'", self.refusal(scene(BOX, None, {**boundary, "right": {"shear_stress": "1 MPa"}}), "mesh={size: 0.5 m}"))
        self.assertIn("two tangents", self.refusal(scene(BOX, None, {"left": {"displacement_tangential": "0 m"}}), "mesh={size: 0.5 m}"))
        roller = {"left": {"displacement_x": "0 m"}, "bottom": {"displacement_z": "0 m"}}
        said = self.refusal(scene(BOX, None, roller), "mesh={size: 0.5 m}")
        self.assertIn("nothing holds the rock along y", said)
        self.assertIn("'front: {displacement_y: 0 m}'", said)

    @on_two_processes
    def test_two_processes_have_the_answer_of_one(self):
        boundary = {"bottom": {"displacement": ["0 m", "0 m", "0 m"]}, "top": {"traction": ["1e6 Pa", "(2e6*x) Pa", "-3e6 Pa"]}}
        probes = {f"u{k}": {"of": "rock.displacement", "at": [f"{x} m" for x in at]} for k, at in enumerate(([1, 1.2, 0.9], [0.3, 0.4, 0.5]))}
        probes["s"] = {"of": "rock.stress", "at": ["0.5 m", "0.6 m", "0.4 m"]}
        for order in ("first", "second"):
            one = scene(BOX, None, boundary, order=order)
            one["output"] = {"probes": probes}
            settings = ("mesh={size: 0.25 m, division: scattered}",)
            self.assertLess(self.largest_difference(self.run_map(one, *settings), self.run_map(one, *settings, processes=2)), 1e-9)

    def test_a_smooth_displacement_has_its_order(self):
        """u = A sin(k·x + 1/2) with its body force, on unstructured tetrahedra."""
        a, k = np.array([1.0, -0.6, 0.4]), np.array([1.9, 1.2, -1.5])
        lame, shear = YOUNG * 0.25 / (1.25 * 0.5), YOUNG / 2.5
        phase = " + ".join(f"({float(c)!r})*{axis}/m" for c, axis in zip(k, "xyz")) + " + 0.5"
        force = (lame + shear) * k * (a @ k) + shear * a * (k @ k)
        body = [f"({float(f)!r}*sin({phase})) N/m^3" for f in force]
        boundary = {side: {"displacement": [f"({float(c)!r}*sin({phase})) m" for c in a]} for side in SIDES}
        for order, of_u, of_stress in (("first", 1.8, 0.9), ("second", 2.8, 1.8)):
            errors, cells = [], []
            for size in (0.24, 0.12):
                fields = self.run_map(scene(BOX, {"size": f"{size} m"}, boundary, order=order, body_force=body, large_strain=100)).fields()
                weights = fields.sizes / fields.sizes.sum()
                cells.append(len(weights))
                inside = np.all((fields.points > 1e-9) & (fields.points < np.array([1, 1.2, 0.9]) - 1e-9), axis=1)
                exact = np.multiply.outer(np.sin(fields.points @ k + 0.5), a)
                gradient = np.multiply.outer(np.cos(fields.centres @ k + 0.5), np.multiply.outer(a, k))
                stress = lame * np.trace(gradient, axis1=1, axis2=2)[:, None, None] * np.eye(3) + shear * (gradient + gradient.transpose(0, 2, 1))
                wanted = np.stack([stress[:, i, j] for i, j in AXES], 1)
                errors.append([np.sqrt(np.mean((fields["rock.displacement"] - exact)[inside]**2) / np.mean(exact**2)),
                               np.sqrt(weights @ ((fields["rock.stress"] - wanted)**2).sum(1) / (weights @ (wanted**2).sum(1)))])
            orders = 3 * np.log(np.divide(*errors)) / np.log(cells[1] / cells[0])
            print(f"order {order}: u, stress", *errors, orders, cells)
            self.assertGreater(orders[0], of_u)
            self.assertGreater(orders[1], of_stress)


if __name__ == "__main__":
    unittest.main()
