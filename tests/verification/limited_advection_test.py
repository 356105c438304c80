#!/usr/bin/python3
"""limited_advection_test.py SPREKK [MPIEXEC]: what fluid carries with the scheme `limited`, against closed forms: a column (Ogata and Banks 1961), a fracture that
loses tracer to the rock (Tang, Frind and Sudicky 1981), a cloud and a square that move along a diagonal, linear values that move. Bounds, balances, uniform
values; turned, mirrored, disturbed by 1e-9, in other schedules, after a restart, on two processes; in a plane and in space, tracer and heat."""

import math
import unittest

import numpy as np

import tracer_test as scenes
from scene_runs import ROOT, on_two_processes
from scenes_in_space import SpaceRuns

POROSITY, END = 0.2, 1e5  # s
SDIRK2 = "time.scheme=sdirk2"
WAY = 0.4  # m, in x and y, by the end


def limited(text, scheme="limited"):
    """The scene with this scheme of what fluid carries."""
    found = text.replace("type: tracer_advection,", f"type: tracer_advection, scheme: {scheme},")
    assert found != text
    return found


def relative_error(values, exact):
    return np.sqrt(((values - exact) ** 2).sum() / (exact**2).sum())


def moving(start, steps, mesh, way=(WAY, WAY), given="0 kg/m^3", scheme="limited", kind="tpfa"):
    """A uniform flow through a box of 1 m that carries `start` by this way."""
    axes = "xyz"[:len(way)]
    pressure = '"(' + " + ".join(f"({-w * POROSITY / END * 1e9!r})*{axis}/m" for w, axis in zip(way, axes)) + ') Pa"'
    names = ("left", "right", "bottom", "top") + (("front", "back") if len(way) == 3 else ())
    return f"""
name: moving
geometry: {{box: {{{", ".join(f"{axis}: [0 m, 1 m]" for axis in axes)}}}}}
mesh: {mesh}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-12 m^2, viscosity: 1 mPa*s, storage: 0 1/Pa, boundary: {{{", ".join(f"{side}: {{pressure: {pressure}}}" for side in names)}}}}}
  salt: {{type: matrix_transport/{kind}, porosity: {POROSITY}, diffusion: 1e-18 m^2/s, initial_concentration: "{start}",
    boundary: {{{", ".join(f'{side}: {{concentration: "{given}"}}' for side in names)}}}}}
couplers: [{{type: tracer_advection, scheme: {scheme}, between: [pore, salt]}}]
schedule: [{{solve: pore}}, {{solve: salt}}]
time: {{end: {END!r} s, step: {END / steps!r} s}}
"""


def squares(cells, dimension=2):
    return f"{{kind: structured, cells: {[cells] * dimension}, shape: {'quadrilaterals' if dimension == 2 else 'hexahedra'}}}"


SQUARE = "(1 + sign(0.15 - abs(x/m - 0.3)))*(1 + sign(0.15 - abs(y/m - 0.3)))/4 kg/m^3"
WIDTH = 20  # 1/m^2, of a cloud
CLOUD = f"exp(-{WIDTH}*((x/m - 0.3)^2 + (y/m - 0.3)^2)) kg/m^3"
COMING = CLOUD.replace("- 0.3)", f"- 0.3 - {WAY}*t/({END}*s))")


class LimitedAdvection(SpaceRuns):
    def salt(self, text, *settings, **how):
        rock = self.run_text(text, *settings, **how).fields()
        return rock.centres, rock["salt.concentration"]

    def test_a_front_in_a_column(self):
        """Reference: of_column. With the same cells and steps the error is less than a third; with steps like squares of cells it is of second order."""
        for kind in ("tpfa", "mpfa"):
            errors = {}
            for scheme, cells, steps in (("upwind", 80, 80), ("limited", 80, 80), ("limited", 160, 160), ("limited", 40, 100), ("limited", 80, 400)):
                x, values = self.salt(limited(scenes.column(cells, steps, kind), scheme))
                errors[scheme, cells, steps] = relative_error(values, np.array([scenes.of_column(each, scenes.END) for each in x[:, 0]]))
            print("Ogata and Banks:", kind, errors)
            self.assertLess(errors["limited", 80, 80], errors["upwind", 80, 80] / 3)
            self.assertLess(errors["limited", 160, 160], 2.5e-3)
            self.assertGreater(math.log2(errors["limited", 40, 100] / errors["limited", 80, 400]), 1.8)

    def test_second_order_in_time(self):
        """Reference: of_column, and the cloud at its place; cells and steps refined together. With backward Euler orders are below 1."""
        errors = []
        for n in (40, 80):
            x, values = self.salt(limited(scenes.column(n, n, "tpfa")), SDIRK2)
            errors.append(relative_error(values, np.array([scenes.of_column(each, scenes.END) for each in x[:, 0]])))
        self.assertLess(errors[1], 2.6e-4)
        self.assertGreater(math.log2(errors[0] / errors[1]), 1.8)
        clouds = []
        for cells, steps in ((16, 20), (32, 40)):
            x, values = self.salt(moving(CLOUD, steps, squares(cells), given=COMING), SDIRK2)
            clouds.append(relative_error(values, np.exp(-WIDTH * ((x[:, :2] - 0.3 - WAY) ** 2).sum(axis=1))))
        print("sdirk2:", errors, clouds)
        self.assertLess(clouds[1], 0.019)
        self.assertGreater(math.log2(clouds[0] / clouds[1]), 1.8)

    def test_two_stages_keep_uniform_values_balances_and_bits(self):
        """Reference: 2 kg/m^3; the balance with decay; the same run restarted, disturbed, mirrored, and with the tracer in substeps of one stage each."""
        for schedule in (scenes.BOTH, "[{solve: [pore, conduit, salt, water]}]", "[{solve: [salt, water]}, {solve: [pore, conduit]}]"):
            for values in scenes.concentrations(self.run_text(limited(scenes.flowing(2, schedule=schedule)), SDIRK2)):
                self.assertLess(np.abs(values - 2).max(), 2e-11)
            results = self.run_text(limited(scenes.flowing(2, **scenes.UNEVEN, schedule=schedule, decay="1e-4 1/s", spread=scenes.SPREAD)), SDIRK2)
            self.assertLess(np.abs(results["tracer_balance_error"]).max(), 1e-12 * 3 * 1e-6 * 3 * 3600)
        uneven = {**scenes.UNEVEN, "decay": "1e-4 1/s"}
        text = limited(scenes.flowing(2, **uneven))
        whole, half, path = self.run_text(text, SDIRK2), self.run_text(text, SDIRK2, "time.end=1 h"), self.write(text, "stages.yaml")
        self.assert_same_bits(self.run_scene(self.write(text), SDIRK2, restart=half.folder), whole)
        other = self.run_text(limited(scenes.flowing(2, **uneven, rate=1e-6 * (1 + 1e-9))), SDIRK2)
        self.assertLess(self.largest_difference(whole, other, scenes.figures(whole)), 1e-8)
        columns = [f"tracer_{what}[kg/m]" for what in ("stored", "injected", "outflow")]
        self.assertLess(self.largest_difference(whole, self.run_scene(self.turned(path, 90, mirror=True), SDIRK2), columns), 1e-7)

    @on_two_processes
    def test_two_stages_on_two_processes(self):
        text = limited(scenes.flowing(2, **scenes.UNEVEN, decay="1e-4 1/s", spread=scenes.SPREAD))
        one = self.run_text(text, SDIRK2)
        self.assertLess(self.largest_difference(one, self.run_text(text, SDIRK2, processes=2), scenes.figures(one)), 1e-9)

    def test_steady_flow_has_one_factorization(self):
        """Of the flow and of the tracer: the matrix of upwind values does not change, with decay and sorption as well."""
        for text, solves in ((scenes.column(80, 80, "tpfa"), 81), (moving(CLOUD, 40, squares(32), scheme="upwind", given=COMING), 41)):
            counters = self.run_text(text).record["counters"]
            self.assertEqual((counters["linear: factorizations"], counters["linear: solves"]), (2, solves))

    def test_a_fracture_that_loses_tracer_to_the_rock(self):
        """Reference: of_fracture."""
        errors = []
        for scheme in ("upwind", "limited"):
            water = self.run_text(limited(scenes.fracture(1), scheme)).fractures()
            exact = np.array([scenes.of_fracture(x, 0, scenes.TWO_YEARS) for x in water.centres[:, 0]])
            errors.append(relative_error(water["water.concentration"], exact))
        print("Tang, Frind and Sudicky:", errors)
        self.assertLess(errors[1], 0.6 * errors[0])

    def test_a_cloud_that_moves_along_a_diagonal(self):
        """Reference: the cloud at its place. Of second order with steps like squares of cells; in triangles as well."""
        for meshes in ((squares(16), squares(32)), ("{size: 0.08 m}", "{size: 0.04 m}")):
            errors = {}
            for scheme in ("upwind", "limited"):
                for mesh, steps in zip(meshes, (20, 80)):
                    x, values = self.salt(moving(CLOUD, steps, mesh, scheme=scheme, given=COMING))
                    exact = np.exp(-WIDTH * ((x[:, :2] - 0.3 - WAY) ** 2).sum(axis=1))
                    errors.setdefault(scheme, []).append(relative_error(values, exact))
            print("a cloud:", errors)
            self.assertGreater(math.log2(errors["limited"][0] / errors["limited"][1]), 1.5)
            self.assertLess(errors["limited"][1], errors["upwind"][1] / 3)

    def test_a_square_stays_within_its_bounds(self):
        """Reference: 0 to 1 kg/m^3, in steps of any length, and the square at its place. Turned and mirrored flows give turned and mirrored squares."""
        found = {}
        for scheme in ("upwind", "limited"):
            x, values = self.salt(moving(SQUARE, 30, squares(20), scheme=scheme))
            found[scheme] = np.abs(values - (np.abs(x[:, :2] - 0.3 - WAY) < 0.15).all(axis=1)).sum() / 36
            if scheme == "limited":
                x, values = np.round(x, 6), values[:, None]
                mirrored = self.salt(moving(SQUARE.replace("x/m - 0.3", "x/m - 0.7"), 30, squares(20), way=(-WAY, WAY)))
                there = np.round(mirrored[0], 6)
                own = values[np.lexsort((x[:, 1], x[:, 0])), 0]
                self.assertLess(np.abs(own - mirrored[1][np.lexsort((there[:, 1], -there[:, 0]))]).max(), 1e-8)
                self.assertLess(np.abs(own - values[np.lexsort((x[:, 0], x[:, 1])), 0]).max(), 1e-8)
        print("a square:", found)
        self.assertLess(found["limited"], 0.7 * found["upwind"])
        for mesh in (squares(20), "{size: 0.06 m}"):
            for steps in (1, 5, 20):
                values = self.salt(moving(SQUARE, steps, mesh))[1]
                self.assertTrue(values.min() > -1e-9 and values.max() < 1 + 1e-9, (mesh, steps, values.min(), values.max()))

    def test_linear_values_that_move(self):
        """Reference: 3 + a (x - way t/end), given on all sides; steps of backward Euler are exact for it. To round-off in each cell of rows; in triangles
        the cell in the corner where values are lowest has its limit, from which an error spreads downstream."""
        for dimension, steps, mesh, within in ((2, 20, squares(6), 1e-9), (3, 12, squares(4, 3), 1e-9), (2, 20, "{size: 0.2 m}", 0.01)):
            slope, way = np.array([1, -0.6, 0.3][:dimension]), (0.4, 0.25, -0.2)[:dimension]
            terms = [f"({s!r})*({axis}/m - {{{axis}}})" for s, axis in zip(slope.tolist(), "xyz")]
            start = "(3 + " + " + ".join(terms).format(x=0, y=0, z=0) + ") kg/m^3"
            given = "(3 + " + " + ".join(terms).format(**{axis: f"({w!r})*t/({END!r}*s)" for axis, w in zip("xyz", way)}) + ") kg/m^3"
            wrong = {}
            for scheme in ("upwind", "limited"):
                x, values = self.salt(moving(start, steps, mesh, way=way, given=given, scheme=scheme))
                wrong[scheme] = np.abs(values - 3 - (x[:, :dimension] - way) @ slope).max()
            print("linear:", dimension, mesh, wrong)
            self.assertLess(wrong["limited"], within)
            self.assertLess(wrong["limited"], 0.2 * wrong["upwind"])

    def test_a_uniform_concentration_stays_whatever_flows(self):
        """Reference: 2 kg/m^3."""
        for dimension in (2, 3):
            for schedule in ("[{solve: [pore, conduit, salt, water]}]", scenes.BOTH, "[{solve: [salt, water]}, {solve: [pore, conduit]}]",
                             "[{subcycle: {count: 3, steps: [{solve: [pore, conduit]}]}}, {subcycle: {count: 2, steps: [{solve: [salt, water]}]}}]"):
                with self.subTest(schedule, dimension=dimension):
                    for values in scenes.concentrations(self.run_text(limited(scenes.flowing(dimension, schedule=schedule)))):
                        self.assertLess(np.abs(values - 2).max(), 2e-11)

    def test_what_enters_is_stored_decays_or_leaves(self):
        """Reference: the balance, and the bounds of what is given."""
        for dimension in (2, 3):
            for schedule in (scenes.BOTH, "[{solve: [pore, conduit, salt, water]}]", "[{solve: [salt, water]}, {solve: [pore, conduit]}]"):
                with self.subTest(schedule, dimension=dimension):
                    results = self.run_text(limited(scenes.flowing(dimension, **scenes.UNEVEN, schedule=schedule, decay="1e-4 1/s", spread=scenes.SPREAD)))
                    brought = 3 * 1e-6 * 3 * 3600
                    self.assertLess(np.abs(results["tracer_balance_error"]).max(), 1e-12 * brought)
                    for values in scenes.concentrations(results):
                        self.assertTrue(0 < values.min() and values.max() < 3 * (1 + 1e-9))

    def test_turned_mirrored_disturbed_and_elsewise(self):
        """Reference: the same scene."""
        uneven = {**scenes.UNEVEN, "decay": "1e-4 1/s"}
        text = limited(scenes.flowing(2, **uneven))
        one, path = self.run_text(text), self.write(text, "flowing.yaml")
        self.assertLess(self.largest_difference(one, self.run_text(limited(scenes.flowing(2, **uneven, rate=1e-6 * (1 + 1e-9)))), scenes.figures(one)), 1e-8)
        for schedule in ("[{solve: [pore, conduit, salt, water]}]", "[{iterate: {steps: [{solve: [pore, conduit]}, {solve: [salt, water]}]}}]"):
            other = self.run_text(text, f"schedule={schedule}")
            for ours, theirs in zip(scenes.concentrations(one), scenes.concentrations(other)):
                self.assertLess(np.abs(ours - theirs).max(), 1e-8)
        self.assertLess(self.largest_difference(one, self.run_text(text, "solver.condense=false"), scenes.figures(one)), 1e-9)
        columns = [f"tracer_{what}[kg/m]" for what in ("stored", "injected", "outflow")]
        for mirror in (False, True):
            self.assertLess(self.largest_difference(one, self.run_scene(self.turned(path, 90, mirror=mirror)), columns), 1e-7)

    def test_a_settled_state_is_that_of_the_scheme(self):
        """The steady column with decay, away from its end: exp((v - u) x/(2 D)), u = v sqrt(1 + 4 lambda R D/v^2). It rests. Upwind is off by 0.98 %."""
        v, d = scenes.SPEED, scenes.DIFFUSION
        by = (v - v * math.sqrt(1 + 4 * scenes.DECAY * scenes.RETARDATION * d / v**2)) / (2 * d)
        errors = []
        for cells in (20, 40):
            fields = self.run_text(limited(scenes.column(cells, 20)) + "start: {settle: [pore, salt]}\noutput: {probes: {c: {of: salt.concentration, take: mean}}}\n")
            np.testing.assert_allclose(fields["c"], fields["c"][0], rtol=1e-10)
            rock = fields.fields()
            x = rock.centres[:, 0]
            errors.append(relative_error(rock["salt.concentration"][x < 2], np.exp(by * x[x < 2])))
        self.assertLess(errors[1], 6e-4)
        self.assertLess(errors[1], 0.5 * errors[0])

    @on_two_processes
    def test_a_settled_state_on_two_processes_and_disturbed(self):
        scene = limited(scenes.column(20, 20)) + "start: {settle: [pore, salt]}\noutput: {probes: {c: {of: salt.concentration, take: mean}}}\n"
        one = self.run_text(scene)["c"][-1]
        for other in (self.run_text(scene, processes=2), self.run_text(scene, "components.pore.boundary.left.flux=-1.000000001e-6 m/s")):
            self.assertLess(abs(other["c"][-1] / one - 1), 5e-9)

    def test_a_restart_keeps_the_bits(self):
        for dimension in (2, 3):
            text = limited(scenes.flowing(dimension, **scenes.UNEVEN, spread=scenes.SPREAD))
            whole, half = self.run_text(text), self.run_text(text, "time.end=1 h")
            self.assert_same_bits(self.run_scene(self.write(text), restart=half.folder), whole)

    @on_two_processes
    def test_two_processes(self):
        for dimension in (2, 3):
            text = limited(scenes.flowing(dimension, **scenes.UNEVEN, decay="1e-4 1/s", spread=scenes.SPREAD))
            one = self.run_text(text)
            self.assertLess(self.largest_difference(one, self.run_text(text, processes=2), scenes.figures(one)), 1e-9)

    @on_two_processes
    def test_by_gmres(self):
        """Reference: the direct solver, and as many iterations of Newton's method."""
        text = limited(scenes.flowing(2, **scenes.UNEVEN, decay="1e-4 1/s"))
        one = self.run_text(text)
        for processes in (1, 2):
            other = self.run_text(text, "solver={type: belos, tolerance: 1e-11}", processes=processes)
            self.assertLess(self.largest_difference(one, other, scenes.figures(one)), 1e-9)
            self.assertEqual(list(one.history["iterations[1]"]), list(other.history["iterations[1]"]))

    def test_heat(self):
        """Reference: Ogata and Banks, with the cells and steps of `upwind`; of second order with two stages."""
        def error(scheme, *settings):
            heat = self.run_scene(ROOT / "configs/verification/ogata_banks.yaml", f"couplers=[{{type: heat_advection, between: [pore, heat], scheme: {scheme}}}]",
                                  *settings, "output.fields=true").fields()
            u, d, t = 5e-6, 1e-6, 2e5
            exact = np.array([0.5 * (math.erfc((x - u * t) / (2 * math.sqrt(d * t))) + math.exp(u * x / d) * math.erfc((x + u * t) / (2 * math.sqrt(d * t))))
                              for x in heat.centres[:, 0]])
            return relative_error(heat["heat.temperature"], exact)

        errors = [error(scheme, "mesh.cells=[80, 1]", "time.step=4e3 s") for scheme in ("upwind", "limited")]
        stages = [error("limited", f"mesh.cells=[{n}, 1]", f"time.step={3.2e5 / n!r} s", SDIRK2) for n in (40, 80)]
        print("heat:", errors, stages)
        self.assertLess(errors[1], errors[0] / 2)
        self.assertLess(stages[1], 8e-4)
        self.assertGreater(math.log2(stages[0] / stages[1]), 1.9)


if __name__ == "__main__":
    unittest.main()
