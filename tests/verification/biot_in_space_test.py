#!/usr/bin/python3
"""biot_in_space_test.py SPREKK [MPIEXEC]: rock with fluid in space: Terzaghi's column and Mandel's problem against their series for backward
Euler, a manufactured solution on unstructured tetrahedra, and schemes that split flow and rock.

Twins: turned about no axis, mirrored, values that are disturbed by 1e-9, and two processes."""

import json
import unittest

import numpy as np

from hexahedra import TURN, box_of_tetrahedra
from scene_runs import ROOT, SceneRuns, on_two_processes, sprekk

ROLLERS = {side: {"displacement_normal": "0 m"} for side in ("left", "front", "back", "bottom")}
PLATE = sprekk.read_table(ROOT / "configs/verification/mandel_plate.csv")
YOUNG, POISSON, BIOT = 40e9, 0.2, 0.8  # Mandel's rock: configs/verification/mandel.yaml


def volumes_of(fields):
    return fields.sizes / fields.sizes.sum()


def error(fields, found, exact):
    """In L2 over cells, of the exact values."""
    weights = volumes_of(fields)
    return np.sqrt(weights @ (found - exact)**2 / (weights @ exact**2))


def terzaghi(z, step, steps):
    n = (np.arange(2000) + 0.5) * np.pi
    return (2 / n * np.sin(np.multiply.outer(z, n)) * (1 + step * n**2)**-steps).sum(-1)


def mandel(x, steps, step=1079.0):
    """The pressure after so many steps (mandel.yaml has the formula); roots by bisection."""
    shear, bulk = YOUNG / (2 * (1 + POISSON)), YOUNG / (3 * (1 - 2 * POISSON))
    storage = 0.01 * 4e-10 + (BIOT - 0.01) / bulk
    mobility = 5e-20 / 1e-4
    undrained = bulk + BIOT**2 / storage
    skempton = BIOT / (storage * undrained)
    poisson = (3 * undrained - 2 * shear) / (2 * (3 * undrained + shear))
    diffusivity = mobility / (storage + BIOT**2 / (bulk + 4 * shear / 3))
    ratio = (1 - POISSON) / (poisson - POISSON)
    low, high = (np.arange(200) * np.pi + 1e-9, np.arange(200) * np.pi + np.pi / 2 - 1e-12)
    for _ in range(200):
        middle = (low + high) / 2
        above = np.tan(middle) > ratio * middle
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    root = (low + high) / 2
    terms = np.sin(root) / (root - np.sin(root) * np.cos(root)) * (1 + root**2 * diffusivity * step)**-steps
    return 2 * 1e7 * skempton * (1 + poisson) / 3 * (terms * (np.cos(np.multiply.outer(x, root)) - np.cos(root))).sum(-1)


class BiotInSpace(SceneRuns):
    def run_map(self, of_scene, *settings, **how):
        return self.run_scene(self.write(json.dumps(of_scene, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    @staticmethod
    def column(end="0.1 s"):
        """Terzaghi's column, drained and loaded at its lower end: see configs/verification/terzaghi.yaml."""
        boundary = {**ROLLERS, "right": {"displacement_x": "0 m"}, "top": {"displacement_z": "0 m"}, "bottom": {"normal_stress": "-2 Pa"}}
        return {"name": "column", "geometry": {"box": {"x": ["0 m", "0.2 m"], "y": ["0 m", "0.15 m"], "z": ["0 m", "1 m"]}},
                "components": {"pore": {"type": "matrix_flow/mpfa", "permeability": "1 m^2", "viscosity": "1 Pa*s", "storage": "0.5 1/Pa",
                                        "boundary": {"bottom": {"pressure": "0 Pa"}}},
                               "rock": {"type": "poromechanics/fem", "young_modulus": f"{5 / 3} Pa", "poisson_ratio": 0.25, "boundary": boundary}},
                "couplers": [{"type": "biot", "between": ["pore", "rock"], "biot_coefficient": 1}],
                "schedule": [{"solve": ["pore", "rock"]}], "time": {"end": end, "step": "0.01 s"},
                "output": {"fields": True, "probes": {"p": {"of": "pore.pressure", "at": ["0.1 m", "0.1 m", "0.4 m"]},
                                                      "u": {"of": "rock.displacement", "at": ["0.1 m", "0.1 m", "0 m"]}}}}

    def column_error(self, mesh):
        fields = self.run_map(self.column(), f"mesh={mesh}").fields()
        return error(fields, fields["pore.pressure"], terzaghi(fields.centres[:, 2], 0.01, 10))

    def test_a_column_consolidates_as_terzaghis(self):
        for shape in ("hexahedra", "wedges", "tetrahedra"):
            with self.subTest(shape):
                coarse, fine = (self.column_error(f"{{kind: structured, shape: {shape}, cells: [{n}, {n}, {5 * n}]}}") for n in (2, 4))
                print(f"Terzaghi, {shape}: {coarse:.2g}, {fine:.2g}")
                self.assertLess(fine, 4e-3)
                self.assertGreater(np.log2(coarse / fine), 1.8)

    def test_splits_have_the_answer_of_all_together(self):
        mesh = "mesh={size: 0.12 m}"
        one = self.column("0.03 s")
        whole = self.run_map(one, mesh)
        for split in ([{"iterate": {"steps": [{"solve": "pore", "stabilize": "fixed_stress"}, {"solve": "rock"}], "until": {"relative": 1e-11}}}],
                      [{"iterate": {"steps": [{"solve": "rock", "stabilize": "undrained"}, {"solve": "pore"}], "until": {"relative": 1e-11}}}]):
            other = self.run_map({**one, "schedule": split}, mesh)
            for column in ("p[Pa]", "u.z[m]", "pore.bottom.outflow[m^3/s]"):
                self.assertLess(np.abs(other.history[column] - whole.history[column]).max(), 1e-8 * np.abs(whole.history[column]).max(), (split, column))

    @on_two_processes
    def test_two_processes_have_the_answer_of_one(self):
        mesh = "mesh={size: 0.12 m, division: scattered}"
        one, other = self.run_map(self.column("0.03 s"), mesh), self.run_map(self.column("0.03 s"), mesh, processes=2)
        self.assertLess(self.largest_difference(one, other, ["p[Pa]", "u.z[m]", "pore.bottom.outflow[m^3/s]"]), 1e-9)

    def test_a_restart_goes_on_with_the_same_bits(self):
        mesh = "mesh={size: 0.15 m}"
        scene = self.column("0.04 s")
        whole = self.run_map(scene, mesh)
        half = self.run_map(scene, mesh, "time.end=0.02 s")
        again = self.run_scene(self.write(json.dumps(scene), f"scene_{next(self.numbers)}.yaml"), mesh, restart=half.folder)
        self.assertEqual(whole["p"][-1], again["p"][-1])
        self.assertEqual(whole["u.x"][-1], again["u.x"][-1])

    def mandel(self, turn, cells, *settings):
        file = self.write(box_of_tetrahedra(turn, (1, 0.3, 1), cells, 0.2), f"mesh_{next(self.numbers)}.msh")
        plate = {"table": str(ROOT / "configs/verification/mandel_plate.csv"), "column": "u_y", "of": "t"}
        probe = [f"{float(x)!r} m" for x in turn @ [0.31, 0.17, 0.52]]
        return self.run_map({
            "name": "mandel", "geometry": {"file": str(file)},
            "components": {"pore": {"type": "matrix_flow/mpfa", "permeability": "5e-20 m^2", "viscosity": "1e-4 Pa*s", "porosity": 0.01,
                                    "fluid_compressibility": "4e-10 1/Pa", "boundary": {"right": {"pressure": "0 Pa"}}},
                           "rock": {"type": "poromechanics/fem", "young_modulus": f"{YOUNG} Pa", "poisson_ratio": POISSON,
                                    "boundary": {**ROLLERS, "top": {"displacement_normal": plate}}}},
            "couplers": [{"type": "biot", "between": ["pore", "rock"], "biot_coefficient": BIOT}],
            "schedule": [{"solve": ["pore", "rock"]}], "time": {"end": "5395 s", "step": "1079 s"},
            "output": {"fields": True, "probes": {"p": {"of": "pore.pressure", "at": probe}}}}, *settings)

    def test_mandels_problem_turned_about_no_axis_and_mirrored(self):
        columns = ["p[Pa]", "pore.right.outflow[m^3/s]"]
        errors = []
        for cells in ((6, 2, 6), (12, 4, 12)):
            fields = self.mandel(TURN, cells).fields()
            errors.append(error(fields, fields["pore.pressure"], mandel((fields.centres @ TURN)[:, 0], 5)))
        print("Mandel: {:.2g}, {:.2g}".format(*errors))
        self.assertLess(errors[1], 5e-3)
        self.assertGreater(np.log2(errors[0] / errors[1]), 1.7)
        drawn = self.mandel(np.eye(3), (6, 2, 6))
        for turn in (TURN, TURN @ np.diag([1, -1, 1])):
            self.assertLess(self.largest_difference(self.mandel(turn, (6, 2, 6)), drawn, columns), 1e-9)
        disturbed = self.mandel(np.eye(3), (6, 2, 6), "components.rock.young_modulus=40.00000004 GPa")
        self.assertLess(self.largest_difference(disturbed, drawn, columns), 1e-8)

    def manufactured(self, size, order):
        """u = A sin(k·x + 1/2), p = cos(m·x) after one step from nothing, with alpha = 0.7 and S = 0.3."""
        a, k, m = np.array([1.0, -0.6, 0.4]), np.array([1.9, 1.2, -1.5]), np.array([1.1, -1.4, 1.7])
        lame, shear, alpha, storage, mobility = 1.3, 0.8, 0.7, 0.3, 0.5
        young, poisson = shear * (3 * lame + 2 * shear) / (lame + shear), lame / (2 * (lame + shear))
        phase = " + ".join(f"({float(c)!r})*{axis}/m" for c, axis in zip(k, "xyz")) + " + 0.5"
        of_p = " + ".join(f"({float(c)!r})*{axis}/m" for c, axis in zip(m, "xyz"))
        u = [f"({float(c)!r}*sin({phase})) m" for c in a]
        force = (lame + shear) * k * (a @ k) + shear * a * (k @ k)
        body = [f"({float(f)!r}*sin({phase}) - ({float(alpha * c)!r})*sin({of_p})) N/m^3" for f, c in zip(force, m)]
        source = f"({float(storage + mobility * (m @ m))!r}*cos({of_p}) + ({float(alpha * (a @ k))!r})*cos({phase})) 1/s"
        sides = ("left", "right", "front", "back", "bottom", "top")
        fields = self.run_map({
            "name": "manufactured", "geometry": {"box": {"x": ["0 m", "1 m"], "y": ["0 m", "1 m"], "z": ["0 m", "1 m"]}}, "mesh": {"size": f"{size} m"},
            "components": {"pore": {"type": "matrix_flow/mpfa", "permeability": f"{mobility} m^2", "viscosity": "1 Pa*s", "storage": f"{storage} 1/Pa",
                                    "source": source, "boundary": {side: {"pressure": f"(cos({of_p})) Pa"} for side in sides}},
                           "rock": {"type": "poromechanics/fem", "order": order, "young_modulus": f"{young!r} Pa", "poisson_ratio": poisson, "body_force": body,
                                    "boundary": {side: {"displacement": u} for side in sides}}},
            "couplers": [{"type": "biot", "between": ["pore", "rock"], "biot_coefficient": alpha}],
            "schedule": [{"solve": ["pore", "rock"]}], "time": {"end": "1 s", "step": "1 s"}, "output": {"fields": True}}).fields()
        weights = volumes_of(fields)
        exact = np.multiply.outer(np.sin(fields.points @ k + 0.5), a)
        inside = np.all(np.abs(fields.points - 0.5) < 0.5 - 1e-9, axis=1)
        of_u = np.sqrt(np.mean((fields["rock.displacement"] - exact)[inside]**2) / np.mean(exact**2))
        gradient = np.multiply.outer(np.cos(fields.centres @ k + 0.5), np.multiply.outer(a, k))
        pressure = np.cos(fields.centres @ m)
        stress = (lame * np.trace(gradient, axis1=1, axis2=2) - alpha * pressure)[:, None, None] * np.eye(3) + shear * (gradient + gradient.transpose(0, 2, 1))
        wanted = stress[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
        of_stress = np.sqrt(weights @ ((fields["rock.stress"] - wanted)**2).sum(1) / (weights @ (wanted**2).sum(1)))
        return np.array([of_u, of_stress, error(fields, fields["pore.pressure"], pressure)]), len(weights)

    def test_a_manufactured_solution_on_unstructured_tetrahedra(self):
        """Beside cellwise pressures displacements of second order lose one order."""
        for order, of_stress in (("first", 0.9), ("second", 1.5)):
            (coarse, cells), (fine, more) = self.manufactured(0.24, order), self.manufactured(0.12, order)
            orders = 3 * np.log(coarse / fine) / np.log(more / cells)
            print(f"manufactured, order {order}: u, stress, p", coarse, fine, orders)
            self.assertGreater(orders[0], 1.8)
            self.assertGreater(orders[1], of_stress)
            self.assertGreater(orders[2], 1.8)


if __name__ == "__main__":
    unittest.main()
