#!/usr/bin/python3
"""The family faults of tools/stress: what it promises; its checks find what is planted, and are silent where nothing is."""

import copy
import tempfile
import unittest
from pathlib import Path

import numpy as np
from stress_state import sprekk
from stress_suite import check_faults, faults, ranges, scene, written

N = 3  # cubes along each edge of the state
NORMAL, SHEAR, SLIP = -5e6, np.array([1.8e6, 2.4e6]), 1e-4 * np.array([0.6, 0.8])


def at_rest():
    """(p, one step, its history): two fractures of unlike walls, of which the first slides over its cells and the second sticks; fluid is injected."""
    places = np.array([[x, y, z] for z in range(N + 1) for y in range(N + 1) for x in range(N + 1)], float)
    number = lambda x, y, z: (z * (N + 1) + y) * (N + 1) + x
    ring = ((0, 0), (1, 0), (1, 1), (0, 1))
    cubes = np.array([[number(x + i, y + j, z + k) for k in (0, 1) for i, j in ring] for z in range(N) for y in range(N) for x in range(N)])
    faces = np.array([[number(x + i, 1 + j, 1) for i, j in ring] for x in range(N)])
    matrix, fractures = sprekk.Grid(places, cubes, types=np.full(len(cubes), 12)), sprekk.Grid(places, faces, types=np.full(N, 9))
    walls = {"f0": {"friction": 0.6, "dilation": 5.0, "cohesion": 0.0, "aperture": 1e-3}, "f1": {"friction": 0.8, "dilation": 0.0, "cohesion": 1e5, "aperture": 2e-3}}
    p = {"low": np.zeros(3), "high": np.full(3, float(N)), "fractures": dict.fromkeys(walls, {}), "walls": walls, "closure": "linear", "closed": ["f1"],
         "stiffness": {"f0": 1e11, "f1": 5e10}, "young": 1e10, "poisson": 0.25, "load": 5e6, "stresses": [4e6, 5e6, 6e6], "history": "constant", "steps": 1,
         "loading": "stress", "fluid": True, "alpha": 0.0, "storage": 1e-11, "relative_step": 1.0, "permeability": 1e-15, "viscosity": 1e-3, "width": 3.0}
    number = np.array([0, 0, 1])
    traction = np.column_stack([np.full(N, NORMAL), np.where(number[:, None] == 0, SHEAR, [1e6, -1e6])])
    opening = np.where(number == 0, np.tan(np.radians(5)) * 1e-4, NORMAL / 5e10)
    jump = np.column_stack([opening, np.where(number[:, None] == 0, SLIP, 0)])
    pressure = 1e6
    vectors = {"wall_traction.contact_traction": (traction, "Pa"), "wall_traction.jump": (jump, "m"), "rock.wall_traction": (traction - [pressure, 0, 0], "Pa")}
    fractures.cell_data = {f"{name}.{part}[{unit}]": values[:, k].copy() for name, (values, unit) in vectors.items() for k, part in enumerate(("normal", "tangential1", "tangential2"))}
    fractures.cell_data |= {"fracture": number.astype(float), "conduit.pressure[Pa]": np.full(N, pressure), "conduit.aperture[m]": np.array([1e-3, 1e-3, 2e-3]) + opening}
    matrix.cell_data = {"rock.stress[Pa]": np.tile([-4e6, -5e6, -6e6, 1e5, 0.0, 0.0], (len(cubes), 1)), "pore.pressure[Pa]": np.full(len(cubes), pressure)}
    history = {"fluid_balance_error[m^3]": np.zeros(1), "fluid_stored[m^3]": np.ones(1), "fluid_injected[m^3]": np.ones(1), "fluid_outflow[m^3]": np.zeros(1)}
    return p, [written.Instant(1.0, matrix, fractures, follows=True)], history


class Checks(unittest.TestCase):
    def failures(self, change):
        p, instants, history = copy.deepcopy(at_rest())
        change(p, instants[0].fractures.cell_data, instants[0].matrix.cell_data, history)
        return check_faults.failures(p, instants, history)

    def test_nothing_is_found_where_nothing_is(self):
        self.assertEqual(self.failures(lambda p, walls, rock, history: None), [])

    def test_what_is_planted_is_found(self):
        traction, jump = ([f"wall_traction.{what}.{part}[{unit}]" for part in ("normal", "tangential1", "tangential2")] for what, unit in (("contact_traction", "Pa"), ("jump", "m")))

        def plant(name, cell, factor):
            def change(p, walls, rock, history):
                walls[name][cell] *= factor
            return change

        def pull(p, walls, rock, history):
            walls[traction[0]][0] = 1e3

        for text, change in (("walls pull", pull), ("walls overlap", plant(jump[0], 2, 1.01)), ("an open wall carries load", plant(jump[0], 0, 1.01)),
                             ("more than friction", plant(traction[1], 0, 1.01)), ("more than friction", plant(traction[2], 2, 6)),
                             ("slip without its friction", plant(traction[2], 0, -1)), ("slip without its friction", plant(traction[1], 1, 0.99)),
                             ("Eq. 4", plant("rock.wall_traction.tangential1[Pa]", 1, 1.01)), ("aperture", plant("conduit.aperture[m]", 1, 1.01)),
                             ("momentum", lambda p, walls, rock, history: rock["rock.stress[Pa]"].__imul__([1, 1, 1.001, 1, 1, 1])),
                             ("balance", lambda p, walls, rock, history: history["fluid_balance_error[m^3]"].__iadd__(1e-7))):
            with self.subTest(text):
                self.assertTrue(any(text in failure for failure in self.failures(change)), (text, self.failures(change)))

    def test_a_twin_that_differs_is_told(self):
        p, one, _ = at_rest()
        other = copy.deepcopy(one)
        self.assertEqual(check_faults.differences(p, one, other, 0), [])
        other[0].fractures.cell_data["wall_traction.jump.tangential1[m]"][0] *= 1 + 1e-4
        self.assertTrue(any("jump" in text for text in check_faults.differences(p, one, other, 1e-6)))


class Draws(unittest.TestCase):
    def test_fractures_are_two_to_eight_and_unlike(self):
        drawn = [ranges.draw(1, number, "faults") for number in range(200)]
        counts = {len(p["fractures"]) for p in drawn}
        self.assertTrue({2, 8} <= counts and max(counts) <= 8, counts)
        for what in ("friction", "dilation", "aperture"):
            self.assertGreater(np.mean([len({walls[what] for walls in p["walls"].values()}) > 1 for p in drawn]), 0.9)
        for key, kinds in (("loading", 2), ("order", 2), ("closure", 3), ("contact", 2), ("fluid", 2), ("in_turn", 2), ("condense", 2), ("twin", 4), ("history", 4)):
            self.assertEqual(len({p[key] for p in drawn}), kinds, key)

    def test_the_same_number_writes_the_same_scene_and_each_contact_its_fractures(self):
        with tempfile.TemporaryDirectory() as temporary:
            for number in range(10):
                texts = [scene.write(ranges.draw(3, number, "faults"), Path(temporary) / str(i)).read_text() for i in (0, 1)]
                self.assertEqual(*texts)
                p = ranges.draw(3, number, "faults")
                self.assertEqual(sorted(sum(faults.contacts(p).values(), [])), sorted(p["fractures"]))


if __name__ == "__main__":
    unittest.main()
