#!/usr/bin/python3
"""mpsa_in_space_test.py SPREKK [MPIEXEC]: rock in space by MPSA: linear displacements and uniform states of walls in contact, which are exact
on every kind of cell; rest under weight; consolidation; a penny-shaped crack; extruded scenes of the plane; a settled start.

Twins: turned about no axis, mirrored, values that are disturbed by 1e-9, and two processes."""

import json
import unittest

import numpy as np

import biot_in_space_test as biot
import circular_fault_test as fault
import contact_in_space_test as contact
import extruded_scenes_test as extruded
import rock_fractures_in_space_test as fractures
import rock_in_space_test as rock
from hexahedra import TURN, mesh_file
from scene_runs import SceneRuns, on_two_processes

SIDES = rock.SIDES
MIRROR = TURN @ np.diag([1, -1, 1])


def with_mpsa(of_scene):
    """The same scene by MPSA in place of finite elements."""
    component = of_scene["components"]["rock"]
    component["type"] = "poromechanics/mpsa"
    component.pop("order", None)
    return of_scene


class MpsaInSpace(SceneRuns):
    def run_map(self, of_scene, *settings, **how):
        return self.run_scene(self.write(json.dumps(of_scene, indent=1), f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    def assert_linear(self, results, wanted=None, within=1e-10):
        cells = results.fields()
        moved = cells["rock.displacement"] - (rock.SHIFT + cells.centres @ rock.GRADIENT.T)
        self.assertLess(np.abs(moved).max(), within * np.abs(cells.centres @ rock.GRADIENT.T).max())
        if wanted is None:
            stress = rock.stress_of(rock.GRADIENT, 0.25)
            wanted = np.array([stress[i, j] for i, j in rock.AXES])
        self.assertLess(np.abs(cells["rock.stress"] - wanted).max(), within * np.abs(wanted).max())

    def test_linear_displacements_are_exact_on_every_mesh(self):
        stress = rock.stress_of(rock.GRADIENT, 0.25)
        given = rock.displacement()
        boundary = {side: {"displacement": given} for side in SIDES}
        boundary["right"] = {"traction": [f"{t!r} Pa" for t in map(float, stress[:, 0])]}
        boundary["top"] = {"displacement_z": given[2], "traction_x": f"{float(stress[0, 2])!r} Pa", "traction_y": f"{float(stress[1, 2])!r} Pa"}
        for mesh in rock.MESHES:
            with self.subTest(mesh):
                self.assert_linear(self.run_map(with_mpsa(rock.scene(rock.BOX, None, boundary)), f"mesh={mesh}"))

    def test_so_they_are_in_cells_with_bent_faces(self):
        """As drawn, turned about no axis, and mirrored."""
        for turn in (np.eye(3), TURN, MIRROR):
            for wedges in (False, True):
                with self.subTest(turn=turn, wedges=wedges):
                    traction = rock.stress_of(rock.GRADIENT, 0.25) @ turn @ [-1, 0, 0]
                    boundary = {"west": {"traction": [f"{t!r} Pa" for t in map(float, traction)]}, "others": {"displacement": rock.displacement()}}
                    file = self.write(mesh_file(turn, wedges=wedges, fault=False), f"mesh_{next(self.numbers)}.msh")
                    self.assert_linear(self.run_map(with_mpsa(rock.scene({"file": str(file)}, None, boundary))))

    def test_anisotropic_rock_has_the_stress_of_its_stiffness(self):
        half = np.random.default_rng(2).uniform(-1, 1, (6, 6))
        stiffness = 1e10 * (half @ half.T + np.eye(6))
        names = [f"{'xyz'[i]}{'xyz'[j]}" for i, j in rock.AXES]
        entries = {names[i] + names[j]: f"{float(stiffness[i, j])!r} Pa" for i in range(6) for j in range(i, 6)}
        one = with_mpsa(rock.scene(rock.BOX, None, {side: {"displacement": rock.displacement()} for side in SIDES}, stiffness=entries))
        del one["components"]["rock"]["young_modulus"], one["components"]["rock"]["poisson_ratio"]
        strain = np.array([rock.GRADIENT[i, i] if i == j else rock.GRADIENT[i, j] + rock.GRADIENT[j, i] for i, j in rock.AXES])
        self.assert_linear(self.run_map(one, "mesh={size: 0.4 m}"), stiffness @ strain)

    def test_weight_and_initial_stress_are_at_rest(self):
        """Lithostatic stress with two other principal values and rollers: nothing moves, and the stress stays, linear in z."""
        weight = 2500 * 9.81
        stress = {"xx": "(-7e5) Pa", "yy": "(-5e5) Pa", "zz": f"(-{weight!r}*(0.9 - z)) Pa", "xy": "0 Pa", "yz": "0 Pa", "xz": "0 Pa"}
        boundary = {side: {"displacement_normal": "0 m"} for side in SIDES if side != "top"}
        for mesh in rock.MESHES:
            results = self.run_map(with_mpsa(rock.scene(rock.BOX, None, boundary, initial_stress=stress, rock_density="2500 kg/m^3",
                                                        gravity=["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"])), f"mesh={mesh}")
            cells = results.fields()
            self.assertLess(np.abs(cells["rock.displacement"]).max(), 1e-10 * weight * 0.9**2 / rock.YOUNG, mesh)
            wanted = np.zeros((len(cells.centres), 6))
            wanted[:, 0], wanted[:, 1], wanted[:, 2] = -7e5, -5e5, -weight * (0.9 - cells.centres[:, 2])
            # The stress of a cell takes forces in the centres of faces, which is exact where it is uniform on each face.
            if "hexahedra" in mesh or "wedges" in mesh:
                self.assertLess(np.abs(cells["rock.stress"] - wanted).max(), 1e-9 * 7e5, mesh)
            self.assertFalse(results.notes)

    def test_walls_in_uniform_states_are_exact(self):
        """Walls that stick, slide in some direction with dilation, and are open, on tetrahedra and on cells with bent faces."""
        for name, state in contact.states(contact.NORMAL):
            with self.subTest(name):
                contact.ContactInSpace.assert_state(self, self.run_map(with_mpsa(contact.tetrahedra(state, None))), state)
        for turn, wedges in ((np.eye(3), False), (TURN, True), (MIRROR, False)):
            for name, state in list(contact.states(turn[:, 0]))[::2]:
                with self.subTest(name, wedges=wedges):
                    results = self.run_map(with_mpsa(contact.ContactInSpace.from_file(self, state, turn, wedges, None)))
                    contact.ContactInSpace.assert_state(self, results, state)

    walls = staticmethod(contact.ContactInSpace.walls)

    def test_disturbed_walls_slide_almost_as_far(self):
        state = dict(contact.states(contact.NORMAL))["slip towards 1.22"]
        settings = ("components.rock.young_modulus=10.00000001 GPa", f"components.contact.friction={contact.FRICTION * (1 + 1e-9)!r}")
        runs = [self.run_map(with_mpsa(contact.tetrahedra(state, None)), *each) for each in ((), settings)]
        for one, other in zip(*(self.walls(run) for run in runs)):
            self.assertLess(np.abs(one - other).max(), 1e-7 * np.abs(one).max())

    def test_a_column_consolidates_as_terzaghis(self):
        for shape in ("hexahedra", "wedges", "tetrahedra"):
            errors = []
            for n in (2, 4):
                cells = self.run_map(with_mpsa(biot.BiotInSpace.column()), f"mesh={{kind: structured, shape: {shape}, cells: [{n}, {n}, {5 * n}]}}").fields()
                errors.append(biot.error(cells, cells["pore.pressure"], biot.terzaghi(cells.centres[:, 2], 0.01, 10)))
            print(f"Terzaghi, {shape}: {errors[0]:.2g}, {errors[1]:.2g}")
            self.assertLess(errors[1], 4e-3)
            self.assertGreater(np.log2(errors[0] / errors[1]), 1.8)

    def test_a_column_in_parts_in_another_order_and_on_two_processes(self):
        """Flow and rock in turn; condensed or not; restarted."""
        mesh = "mesh={size: 0.15 m, division: scattered}"
        one = with_mpsa(biot.BiotInSpace.column("0.03 s"))
        columns = ("p[Pa]", "u.z[m]", "pore.bottom.outflow[m^3/s]")
        whole = self.run_map(one, mesh)
        split = [{"iterate": {"steps": [{"solve": "pore", "stabilize": "fixed_stress"}, {"solve": "rock"}], "until": {"relative": 1e-11}}}]
        others = [self.run_map({**one, "schedule": split}, mesh), self.run_map(one, mesh, "solver.condense=false")]
        for other in others:
            self.assertLess(self.largest_difference(other, whole, columns), 1e-8)
        half = self.run_map(one, mesh, "time.end=0.01 s")
        again = self.run_scene(self.write(json.dumps(one), f"scene_{next(self.numbers)}.yaml"), mesh, restart=half.folder)
        self.assertEqual(whole["p"][-1], again["p"][-1])
        self.assertEqual(whole["u.x"][-1], again["u.x"][-1])

    @on_two_processes
    def test_two_processes_have_the_answer_of_one(self):
        mesh = "mesh={size: 0.15 m, division: scattered}"
        one = with_mpsa(biot.BiotInSpace.column("0.03 s"))
        self.assertLess(self.largest_difference(self.run_map(one, mesh), self.run_map(one, mesh, processes=2), ["p[Pa]", "u.z[m]", "pore.bottom.outflow[m^3/s]"]), 1e-9)
        state = dict(contact.states(contact.NORMAL))["slip towards 0.00"]
        contact.ContactInSpace.assert_state(self, self.run_map(with_mpsa(contact.tetrahedra(state, None)), "mesh.division=scattered", processes=2), state)

    def manufactured(self, size):
        """That of biot_in_space_test, with displacements of cells."""
        run_map = self.run_map

        class OfCells(biot.BiotInSpace):
            def run_map(self, of_scene, *settings, **how):
                self.found = run_map(with_mpsa(of_scene), *settings, **how).fields()
                return self

            def fields(self):
                return self

            def __getitem__(self, name):
                return self.found[name]

            points = property(lambda self: self.found.centres)
            centres = property(lambda self: self.found.centres)
            sizes = property(lambda self: self.found.sizes)
        return OfCells().manufactured(size, "first")

    def test_a_manufactured_solution_on_unstructured_tetrahedra(self):
        (coarse, cells), (fine, more) = self.manufactured(0.24), self.manufactured(0.12)
        orders = 3 * np.log(coarse / fine) / np.log(more / cells)
        print("manufactured: u, stress, p", coarse, fine, orders, cells, more)
        self.assertGreater(orders[0], 1.9)
        self.assertGreater(orders[1], 0.9)
        self.assertGreater(orders[2], 1.8)

    def test_a_penny_shaped_crack_is_somewhat_too_wide(self):
        """Displacements are linear around the rim, so that the crack is like a larger one: by less, the smaller the cells."""
        errors = []
        for size in (1 / 2, 1 / 4):
            given = with_mpsa(fractures.RockFracturesInSpace.disc(None, size, growth=0.3))
            errors.append(fractures.RockFracturesInSpace.opening_and_volume(self, given))
        print("penny-shaped crack, opening and volume:", *errors)
        for coarse, fine in zip(*errors):
            self.assertGreater(fine, 0)
            self.assertLess(fine, 2**-0.5 * coarse)  # an order of a half at least
        self.assertLess(errors[1][0], 0.08)
        self.assertLess(errors[1][1], 0.13)

    def test_a_circular_fault_slips_somewhat_too_far(self):
        """For the same reason; against Eshelby's slip and moment."""
        strike, dip, drop = 30, 40, 3e6 - 5e6 * fault.FRICTION
        largest = 8 * (1 - fault.POISSON) * drop / (np.pi * fault.SHEAR * (2 - fault.POISSON))
        errors = []
        for size in (1 / 2, 1 / 4):
            distance, sizes, slip = fault.CircularFault.slip_of(self, with_mpsa(fault.scene("first", size, strike, dip, fault.sheared(strike, dip, 70))))
            found = np.linalg.norm(slip, axis=1)
            inner = distance < 0.5
            exact = largest * np.sqrt(1 - np.minimum(distance, 1)**2)
            errors.append((np.mean(found[inner] / exact[inner]) - 1, sizes @ found / (largest * 2 * np.pi / 3) - 1))
        print("circular fault, slip and moment:", *errors)
        for coarse, fine in zip(*errors):
            self.assertGreater(fine, 0)
            self.assertLess(fine, 2**-0.5 * coarse)
        self.assertLess(errors[1][0], 0.18)

    places_in_plane = extruded.ExtrudedScenes.places_in_plane

    def test_an_extruded_scene_has_the_answer_of_the_plane(self):
        """One layer of wedges, between rollers. With more layers parts of cells exchange their volume with three neighbours in place of two."""
        layers, extruded.LAYERS = extruded.LAYERS, 1
        try:
            for name in ("verification/mandel.yaml", "verification/terzaghi.yaml"):
                plane, space, _ = extruded.ExtrudedScenes.in_plane_and_space(self, name)
                flat, solid = plane.fields(), space.fields()
                place = self.places_in_plane(solid.centres[:, [0, 2]], flat.centres[:, :2], name)
                found, wanted = solid["rock.displacement"], flat["rock.displacement"][place]
                errors = {"u": max(np.abs(found[:, [0, 2]] - wanted).max(), np.abs(found[:, 1]).max()) / np.abs(wanted).max()}
                for field, columns in (("pore.pressure", None), ("rock.stress", [0, 2, 5])):
                    wanted = flat[field][place]
                    found = solid[field] if columns is None else solid[field][:, columns]
                    errors[field] = np.abs(found - wanted).max() / np.abs(wanted).max()
                print(name, errors)
                self.assertLess(max(errors.values()), 1e-9, name)
        finally:
            extruded.LAYERS = layers

    def test_a_layer_that_is_taken_away(self):
        """The rock above hangs from the top and stretches evenly; what is left of the layer's stiffness, a millionth, holds it back. Under full
        support nothing moves."""
        boundary = {side: {"displacement_normal": "0 m"} for side in SIDES}
        layer = {"box": {"x": ["0 m", "1 m"], "y": ["0 m", "1.2 m"], "z": ["0.3 m", "0.6 m"]}}
        given = with_mpsa(rock.scene({**rock.BOX, "regions": {"layer": layer}}, {"size": "0.3 m"}, boundary, excavation={"layer": {"support": "0"}},
                                     initial_stress={"xx": "-3 MPa", "yy": "-2 MPa", "zz": "-5 MPa", "xy": "0 MPa", "yz": "0 MPa", "xz": "0 MPa"}))
        cells = self.run_map(given).fields()
        above = cells.centres[:, 2] > 0.6
        p_wave_modulus = 1.2 * rock.YOUNG
        wanted = -5e6 / p_wave_modulus * (0.9 - cells.centres[above, 2])
        self.assertLess(np.abs(cells["rock.displacement"][above] - np.outer(wanted, [0, 0, 1])).max(), 1e-5 * np.abs(wanted).max())
        held = self.run_map(given, "components.rock.excavation.layer.support=1").fields()["rock.displacement"]
        self.assertLess(np.abs(held).max(), 1e-9 * np.abs(wanted).max())

    def test_a_start_is_settled(self):
        """Under its weight the rock comes to rest before the first step, from which displacements count."""
        boundary = {side: {"displacement_normal": "0 m"} for side in SIDES if side != "top"}
        given = with_mpsa(rock.scene(rock.BOX, {"size": "0.3 m"}, boundary, rock_density="2500 kg/m^3", gravity=["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]))
        loaded = self.run_map(given).fields()
        given["start"] = {"settle": "rock"}
        settled = self.run_map(given).fields()
        self.assertLess(np.abs(settled["rock.displacement"]).max(), 1e-9 * np.abs(loaded["rock.displacement"]).max())
        self.assertLess(np.abs(settled["rock.stress"] - loaded["rock.stress"]).max(), 1e-9 * np.abs(loaded["rock.stress"]).max())


if __name__ == "__main__":
    unittest.main()
