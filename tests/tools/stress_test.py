#!/usr/bin/python3
"""The checks of tools/stress find what is planted, and are silent where nothing is; scenes repeat by their number."""

import copy
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools/python")]
import sprekk  # noqa: E402
from stress_suite import (check_balance, check_contact, check_finite, check_growing, check_heat, check_pressure, check_wells,  # noqa: E402
                          compare, fractures, growing, heat, limited_wells, physics, ranges, scene, summary, swaps, twisted_mesh, written)

P = {"young": 2.5e9, "poisson": 0.25, "alpha": 0.0, "permeability": 1e-15, "viscosity": 1e-3, "storage": 1e-10,
     "compressibility": 1e-9, "friction": 0.5, "dilation": 10.0, "aperture": 1e-3, "width": 4.0, "height": 4.0,
     "length": 0.5, "sides": "stress", "stress": 1e7, "ratio": 2.0, "history": "constant", "initial": 1e6,
     "boundary": "none", "boundary_pressure": 0.0, "family": "separate", "well": "none", "volume": 0.1, "relative_step": 1.0, "steps": 1}


def grids(n=8, columns=(2, 3, 4, 5)):
    """A square of 4 m in triangles, n squares along a side, and a fracture on its middle line, in some columns."""
    points = np.array([[4 * i / n, 4 * j / n, 0] for j in range(n + 1) for i in range(n + 1)])
    triangles = []
    for j in range(n):
        for i in range(n):
            a, b = j * (n + 1) + i, (j + 1) * (n + 1) + i
            triangles += [[a, a + 1, b + 1], [a, b + 1, b]]
    row = n // 2 * (n + 1)
    lines = [[row + i, row + i + 1] for i in columns]
    return sprekk.Grid(points, np.array(triangles)), sprekk.Grid(points, np.array(lines))


def at_rest():
    """A state that fulfils everything: uniform stress, a very small slip with its friction and dilation in two cells."""
    matrix, lines = grids()
    cells = len(matrix.cells)
    x, y = physics.stresses(P, 1.0)
    matrix.cell_data = {"pore.pressure[Pa]": np.full(cells, P["initial"]),
                        "rock.stress[Pa]": np.tile([x, y, 0.0], (cells, 1)),
                        "rock.displacement[m]": np.zeros((cells, 3))}
    slip = np.array([0.0, 1e-5, 1e-5, 0.0])
    opening = slip * np.tan(np.radians(P["dilation"]))
    normal, shear = np.full(4, -4e6), np.array([1e6, 2e6, 2e6, -1e6])
    pressure = np.full(4, P["initial"])
    length = 0.5
    flux = -length * opening / physics.time_step(P) / length / 2  # what opens comes out of the rock
    lines.cell_data = {"contact.traction.normal[Pa]": normal, "contact.traction.tangential[Pa]": shear,
                       "contact.jump.normal[m]": opening, "contact.jump.tangential[m]": slip,
                       "rock.wall_traction.normal[Pa]": normal - pressure, "rock.wall_traction.tangential[Pa]": shear,
                       "conduit.pressure[Pa]": pressure, "conduit.aperture[m]": P["aperture"] + opening,
                       "pore.wall_flux.plus[m/s]": flux, "pore.wall_flux.minus[m/s]": flux, "fracture": np.zeros(4, int)}
    drained = 2 * (physics.time_step(P) * length * flux).sum() / (P["storage"] * 16.0)
    matrix.cell_data["pore.pressure[Pa]"] += drained
    return written.Instant(physics.end(P), matrix, lines, follows=True)


def change(where, name, cell, value):
    instant = copy.deepcopy(at_rest())
    getattr(instant, where).cell_data[name][cell] += value
    return [instant]


class Checks(unittest.TestCase):
    def test_nothing_is_found_in_a_state_at_rest(self):
        self.assertEqual(check_contact.failures(P, [at_rest()]), [])
        self.assertEqual(check_balance.momentum(P, [at_rest()]), [])
        self.assertEqual(check_balance.fracture_mass(P, [at_rest()], 0), [])
        self.assertEqual(check_balance.matrix_mass(P, [at_rest()]), [])
        self.assertEqual(check_pressure.failures(P, [at_rest()]), [])

    def found(self, failures, text):
        self.assertTrue(any(text in failure for failure in failures), failures)

    def test_contact(self):
        for name, cell, value, text in (
                ("contact.traction.normal[Pa]", 0, 5e6, "walls pull"),
                ("contact.jump.normal[m]", 0, -1e-9, "overlap"),
                ("contact.jump.normal[m]", 0, 1e-6, "open wall carries load"),
                ("contact.traction.tangential[Pa]", 0, 1.1e6, "more than friction"),
                ("contact.traction.tangential[Pa]", 1, -1e3, "slip without its friction"),
                ("contact.traction.tangential[Pa]", 1, -4e6, "slip without its friction"),
                ("rock.wall_traction.normal[Pa]", 2, 1e3, "Eq. 4, normal")):
            self.found(check_contact.failures(P, change("fractures", name, cell, value)), text)

    def test_balances(self):
        self.found(check_balance.momentum(P, change("matrix", "rock.stress[Pa]", 5, 1e5)), "momentum")
        self.found(check_balance.fracture_mass(P, change("fractures", "conduit.aperture[m]", 0, 1e-9), 0), "fracture 0")
        self.found(check_balance.matrix_mass(P, change("matrix", "pore.pressure[Pa]", 7, 1e3)), "the matrix")
        self.found(check_balance.matrix_mass(P, [at_rest()], lambda start, stop, own: 1e-6 if own is None else 0.0), "the matrix")

    def test_what_passes_through_a_fracture_may_round(self):
        """Millions times what stays: a relative 1e-14 of it is no loss, 1e-11 is."""
        through = 1e6 * physics.length(P) * P["aperture"] / physics.time_step(P)
        for lost, count in ((1e-14, 0), (1e-11, 1)):
            instant = at_rest()
            data = instant.fractures.cell_data
            data["pore.wall_flux.plus[m/s]"] = data["pore.wall_flux.plus[m/s]"] + through
            data["pore.wall_flux.minus[m/s]"] = data["pore.wall_flux.minus[m/s]"] - through * (1 - lost)
            self.assertEqual(len(check_balance.fracture_mass(P, [instant], 0)), count)

    def test_pressures(self):
        self.found(check_pressure.failures(P, change("matrix", "pore.pressure[Pa]", 3, 1e8)), "above")
        board = change("matrix", "pore.pressure[Pa]", slice(None, None, 2), 1e5)
        self.found(check_pressure.failures(P, board), "peaks")

    def test_a_load_that_has_drained_lowers_the_pressure_when_it_is_taken_away(self):
        """In a step that was not written the load was larger than ever since: what drained then is missing now. The lowest
        pressure is that of a box that has drained under the load, from which all of the load is then removed."""
        p = {**P, "alpha": 1.0, "history": "cycle"}
        factor = p["alpha"] / (p["alpha"] ** 2 + p["storage"] * physics.in_plane_modulus(p))
        instant = at_rest()
        now = physics.end(p) / 8  # the horizontal load is 0, and half as far it is as large as at any time
        instant.time = now
        instant.matrix.cell_data["rock.stress[Pa]"][:] = [*physics.stresses(p, now), 0.0]
        instant.fractures.cell_data["contact.jump.normal[m]"][:] = 0
        drop = -factor * np.mean(physics.stresses(p, 0.0))  # the load that has been, and rest
        for part, times, count in ((0.99, [0.0, now], 0), (0.99, [now], 1), (1.1, [0.0, now], 1)):
            instant.matrix.cell_data["pore.pressure[Pa]"][:] = p["initial"] - part * drop
            instant.fractures.cell_data["conduit.pressure[Pa]"][:] = p["initial"]
            below = [f for f in check_pressure.failures(p, [instant], {"time[s]": np.array(times)}) if "below" in f]
            self.assertEqual(len(below), count, (part, times, below))

    def test_a_bound_is_missed_by_a_part_of_what_is_around_only(self):
        """The fluid in the fracture is 1 MPa lower: cells beside it may be 40 kPa too high, others may not, nor by 100 kPa."""
        for value, is_beside, count in ((4e4, True, 0), (1e5, True, 1), (4e4, False, 1)):
            instant = at_rest()
            instant.fractures.cell_data["contact.jump.normal[m]"][:] = 0
            instant.fractures.cell_data["conduit.pressure[Pa]"][:] = P["initial"] - 1e6
            instant.matrix.cell_data["pore.pressure[Pa]"][:] = P["initial"]
            cell = check_pressure.at_walls(instant)[0, 0] if is_beside else 0
            instant.matrix.cell_data["pore.pressure[Pa]"][cell] += value
            above = [f for f in check_pressure.failures(P, [instant]) if "above" in f]
            self.assertEqual(len(above), count, (value, is_beside, above))

    def test_a_ring_around_a_fracture_is_no_alternation(self):
        """The fracture has fallen below the rock, and with it the cells beside it; those that touch it with a corner are
        peaks. A checkerboard of a tenth on top of it is one."""
        matrix, lines = grids(6, [1, 2, 3, 4])
        cells, fracture = len(matrix.cells), np.full(4, -5e5)
        instant = written.Instant(0.0, matrix, lines, follows=True)
        pairs, walls = check_pressure.neighbours(instant), check_pressure.at_walls(instant)
        pressure = np.zeros(cells)
        pressure[np.isin(matrix.cells, np.unique(lines.cells)).any(1)] = 1e5
        pressure[walls[:, 0]] = -1e5
        lower = [all(pressure[cell] > pressure[pair].min() for pair in pairs[(pairs == cell).any(1)])
                 for cell in range(cells)]
        inner = np.bincount(pairs.ravel()) == 3
        self.assertGreater(np.mean(np.array(lower)[inner]), check_pressure.SHARE)
        self.assertEqual(check_pressure.alternating(pressure, fracture, pairs, walls), 0)
        pressure[::2] += 2e4
        self.assertGreater(check_pressure.alternating(pressure, fracture, pairs, walls), check_pressure.SHARE)

    def test_not_finite(self):
        bad = change("matrix", "pore.pressure[Pa]", 3, np.nan)
        self.found(check_finite.failures(bad, {}), "not finite")
        self.found(check_finite.failures([], {"a": np.array([1.0, np.inf])}), "not finite")


class Growing(unittest.TestCase):
    """A state at rest, as of a scene that grows, and the balance of a run that has injected twice and drawn out once."""
    P = {**P, "family": "growing", "lines": {"f0": ((1.0, 2.0), (3.0, 2.0))}, "gravity": True, "scheme": "monolithic", "toughness": 1e6, "fracture_size": 0.05,
         "source": [(2e-8, 0.0, 3600.0), (1e-8, 7200.0, 10800.0), (-1e-8, 10800.0, 14400.0)]}

    def history(self):
        time = np.array([1800.0, 3600.0, 7200.0, 10800.0, 14400.0])
        injected = np.array([3.6e-5, 7.2e-5, 7.2e-5, 1.08e-4, 7.2e-5])
        outflow = 0.25 * injected
        return {"time[s]": time, "fluid_injected[m^2]": injected, "fluid_outflow[m^2]": outflow,
                "fluid_stored[m^2]": injected - outflow, "tips.f0_last.K_eq[Pa*m^0.5]": np.array([1e6, 9e5, np.nan, 1e6, 8e5]),
                "tips.f0_last.length[m]": np.array([2.0, 2.05, 2.05, 2.1, 2.1])}

    def test_nothing_is_found_where_all_is_well(self):
        self.assertEqual(check_growing.failures(self.P, [at_rest()], self.history()), [])

    def found(self, instants, history, text):
        failures = check_growing.failures(self.P, instants, history)
        self.assertTrue(any(text in failure for failure in failures), failures)

    def test_fluid(self):
        for column, place, part, text in (("stored", 2, 1e-5, "the balance"), ("stored", -1, -1e-5, "the balance"),
                                          ("outflow", 0, 1e-5, "the balance"), ("injected", 3, 1e-5, "what was injected")):
            history = self.history()
            history[f"fluid_{column}[m^2]"] = history[f"fluid_{column}[m^2]"].copy()
            history[f"fluid_{column}[m^2]"][place] += part * 1e-4
            self.found([at_rest()], history, text)
            history[f"fluid_{column}[m^2]"][place] -= 0.999 * part * 1e-4
            self.assertEqual(check_growing.fluid(self.P, history), [])
        # Loads of 20 MPa press 0.5 * 2e7 Pa / 2.67e9 Pa of 16 m^2 from the pores: 0.06 m^2, of which 1e-8 may be lost.
        for scheme, lost, is_found in (("monolithic", 5e-10, True), ("iterated", 5e-10, False), ("iterated", 1e-9, True)):
            history = self.history()
            history["fluid_stored[m^2]"] = history["fluid_stored[m^2]"] - lost
            self.assertEqual(bool(check_growing.fluid({**self.P, "alpha": 0.5, "scheme": scheme}, history)), is_found)
        both = self.history()  # a rate that was left out, with a balance that closes
        for column in ("injected", "stored"):
            both[f"fluid_{column}[m^2]"] = both[f"fluid_{column}[m^2]"] - 3.6e-5 * (both["time[s]"] > 7200)
        self.found([at_rest()], both, "what was injected")

    def test_pressures_beyond_reach(self):
        for value in (1e9, -1e9):
            self.found(change("matrix", "pore.pressure[Pa]", 3, value), self.history(), "in the rock, beyond")
            moved = change("fractures", "conduit.pressure[Pa]", 2, value)
            self.found(moved, self.history(), "in the fractures, beyond")

    def test_nothing_is_negative_and_nothing_heals(self):
        self.found(change("fractures", "conduit.aperture[m]", 1, -0.1), self.history(), "an aperture")
        for column, change_of, text in (("K_eq[Pa*m^0.5]", -2e6, "K_eq"), ("length[m]", -3.0, "length"), ("length[m]", -0.01, "growth")):
            history = self.history()
            history["tips.f0_last." + column] = history["tips.f0_last." + column] + np.array([0, 0, 0, 0, change_of])
            self.found([at_rest()], history, text)

    def test_contact_and_numbers(self):
        self.found(change("fractures", "contact.jump.normal[m]", 0, -1e-9), self.history(), "overlap")
        self.found(change("matrix", "pore.pressure[Pa]", 3, np.nan), self.history(), "not finite")
        self.found([at_rest()], {**self.history(), "fluid_stored[m^2]": np.full(5, np.nan)}, "not finite")

    def test_slip_is_not_compared_across_a_growth(self):
        before, after = at_rest(), at_rest()
        lines = after.fractures
        lines.cells = lines.cells[1:]
        lines.cell_data = {name: values[1:] for name, values in lines.cell_data.items()}
        self.assertEqual([i.follows for i in check_growing.with_growth(self.P, [before, after])], [True, False])
        self.assertEqual(check_growing.failures(self.P, [before, after], self.history()), [])

    def test_slip_is_not_compared_across_steps_that_are_not_written(self):
        """A substep that slides, and one in which the walls stick under less shear: only the sum of both is written."""
        state = at_rest()
        state.fractures.cell_data["contact.traction.tangential[Pa]"][1] = 1e6
        state.fractures.cell_data["rock.wall_traction.tangential[Pa]"][1] = 1e6
        self.found([state], self.history(), "slip without its friction")
        self.assertEqual(check_growing.failures({**self.P, "scheme": "subcycled"}, [state], self.history()), [])

    def test_scenes_have_what_the_family_promises(self):
        drawn = [ranges.draw(1, number, "growing") for number in range(300)]
        self.assertEqual({len(p["lines"]) for p in drawn}, {2, 3, 4, 5, 6})
        self.assertEqual({p["scheme"] for p in drawn}, {"monolithic", "iterated", "subcycled"})
        self.assertTrue(any(p["gravity"] for p in drawn) and any(len(p["source"]) > 1 for p in drawn))
        for p in drawn:
            self.assertGreater(max(growing.injected(p, 0, t * 3600) for t in range(1, 5)), 0)
            names = list(p["lines"])
            for name in names:
                others = [p["lines"][other] for other in names if other != name]
                self.assertTrue(growing.are_apart(p["lines"][name], others, 0.7 * p["fracture_size"]), p["number"])


class Heat(unittest.TestCase):
    """The state at rest, warmed from 300 K to 310 K in all of the rock and to 320 K in the fracture, by fluid of 400 K."""
    P = {**P, "family": "heat", "conduction": "tpfa", "conductivity": 2.0, "heat_capacity": 2e6, "fluid_heat_capacity": 4e6,
         "fracture_conductivity": 0.6, "expansion": 1e-5, "temperature": 300.0, "fracture_temperature": None, "viscosity_law": "none", "decay": 0.0,
         "side_temperatures": {"left": 350.0, "right": 250.0}, "injected_temperature": 400.0, "heat_sides": "none", "well": "inject",
         "order": "together", "clock": "flow"}

    def state(self):
        instant = at_rest()
        instant.matrix.cell_data["heat.temperature[K]"] = np.full(len(instant.matrix.cells), 310.0)
        instant.fractures.cell_data["water.temperature[K]"] = np.full(4, 320.0)
        return instant

    def history(self):
        # C (T - T_0) of 16 m^2 of rock and of 2 m of fracture, and what fluid has brought: c m T.
        fluid_rock = P["storage"] * 16 * (self.state().cell("pore.pressure[Pa]")[0] - P["initial"])
        opening = 0.5 * 2 * 1e-5 * np.tan(np.radians(10))
        stored = 2e6 * 16 * 10 + 4e6 * 1e-3 * 2 * 20 + 4e6 * fluid_rock * 310 + 4e6 * opening * 320
        injected = physics.rate(self.P) * 0.5 * physics.end(self.P) * 4e6 * 400
        return {"time[s]": np.array([physics.end(self.P)]), "step[s]": np.array([physics.end(self.P)]), "heat_stored[J/m]": np.array([stored]),
                "heat_injected[J/m]": np.array([injected]), "heat_outflow[J/m]": np.array([injected - stored]), "heat_balance_error[J/m]": np.array([0.0])}

    def test_nothing_is_found_where_all_is_well(self):
        self.assertEqual(check_heat.failures(self.P, [self.state()], self.history()), [])

    def test_what_is_planted_is_found(self):
        for place, name, value in (("matrix", "heat.temperature[K]", 299.99), ("matrix", "heat.temperature[K]", 400.01), ("fractures", "water.temperature[K]", 400.01)):
            instant = self.state()
            getattr(instant, place).cell_data[name][2] = value
            failures = check_heat.bounds(self.P, [instant])
            self.assertTrue(any("temperature" in failure for failure in failures), failures)
        for column, part, text in (("stored", 1e-5, "are said to be stored"), ("injected", 1e-5, "were injected"), ("balance_error", 1e-5, "the balance")):
            history = self.history()
            history[f"heat_{column}[J/m]"] = history[f"heat_{column}[J/m]"] + part * abs(history["heat_stored[J/m]"])
            failures = check_heat.balances(self.P, [self.state()], history)
            self.assertTrue(any(text in failure for failure in failures), (column, failures))

    def test_conduction_by_mpfa_may_miss_a_bound_by_a_part_of_what_is_around(self):
        for conduction, count in (("mpfa", 0), ("tpfa", 1)):
            instant = self.state()
            instant.matrix.cell_data["heat.temperature[K]"][2] = 299.6  # of 20 K between rock and fracture, 10 K in the rock
            self.assertEqual(len(check_heat.bounds({**self.P, "conduction": conduction}, [instant])), count)

    def test_the_least_viscosity(self):
        """Of water at 400 K: 0.218 mPa s (IAPWS 2008), within 3 % by the law."""
        self.assertAlmostEqual(heat.least_viscosity({**self.P, "viscosity_law": "water"}), 0.218e-3, delta=0.03 * 0.218e-3)


class Wells(unittest.TestCase):
    """A well in the fracture that its limit of 3 MPa binds, and one in the rock with an index that brings its rate."""
    WELL = {"kind": "inject", "in_fracture": True, "at": (0.5, 0.5), "rate": 1.0, "above": 2e6, "below": 1e6, "is_limited": True,
            "pressure": 1e6, "index": None, "radius": 1e-3}
    P = {**P, "family": "wells", "angle": 0.0, "place": "inside", "fractures": "one", "cells": 4, "coarse": 8, "discretization": "mpfa", "mesh": "gmsh",
         "wells": {"feed": WELL, "plant": {**WELL, "kind": "extract", "in_fracture": False, "at": (0.1, 0.1), "index": 2.0}}}

    def at_rest(self):
        instant = at_rest()
        instant.fractures.cell_data["conduit.pressure[Pa]"] = np.full(4, 3e6)
        instant.fractures.cell_data["rock.wall_traction.normal[Pa]"] = instant.fractures.cell_data["contact.traction.normal[Pa]"] - 3e6
        return instant

    def history(self):
        size = physics.length(self.P) * self.P["aperture"] / physics.end(self.P)
        around = self.at_rest().cell("pore.pressure[Pa]")[0]
        drop = size / (2 * self.P["permeability"] / self.P["viscosity"])
        step, rate = physics.end(self.P), 0.3 * size
        plant = self.P["wells"]["plant"]
        plant["below"] = 1.5 * drop
        return {"time[s]": np.array([step]), "step[s]": np.array([step]), "wells.feed.rate[m^2/s]": np.array([rate]),
                "wells.feed.pressure[Pa]": np.array([3e6]), "wells.plant.rate[m^2/s]": np.array([-size]),
                "wells.plant.pressure[Pa]": np.array([around - drop]), "fluid_injected[m^2]": np.array([(rate - size) * step])}

    def test_nothing_is_found_where_all_is_well(self):
        self.assertEqual(check_wells.failures(self.P, [self.at_rest()], self.history()), [])

    def test_what_is_planted_is_found(self):
        size = physics.length(self.P) * self.P["aperture"] / physics.end(self.P)
        for column, change_of, text in (("feed.pressure[Pa]", -1e4, "within its limit"), ("feed.pressure[Pa]", 1e4, "beyond its limit"),
                                        ("feed.rate[m^2/s]", 0.8 * size, "more than"), ("feed.rate[m^2/s]", -0.4 * size, "more than 0"),
                                        ("plant.rate[m^2/s]", 0.1 * size, "within its limit"), ("plant.pressure[Pa]", 1e4, "by its index"),
                                        ("feed.pressure[Pa]", 1e4, "beside")):
            history = self.history()
            history["wells." + column] = history["wells." + column] + change_of
            failures = check_wells.failures(self.P, [self.at_rest()], history)
            self.assertTrue(any(text in failure for failure in failures), (column, change_of, failures))
        history = self.history()
        history["fluid_injected[m^2]"] = history["fluid_injected[m^2]"] * (1 + 1e-6)
        self.assertEqual(len(check_wells.amount(self.P, [self.at_rest()], history)), 1)

    def test_a_shut_well_may_have_more_than_its_limit(self):
        history = self.history()
        history["wells.feed.rate[m^2/s]"][:], history["wells.feed.pressure[Pa]"][:] = 0, 3.1e6
        self.assertEqual(check_wells.conditions(self.P, [self.at_rest()], history), [])

    def test_what_wells_bring_is_counted_for_their_fracture(self):
        history, instant = self.history(), self.at_rest()
        brought = check_wells.sources(self.P, history, instant)
        step = physics.end(self.P)
        self.assertAlmostEqual(brought(0, step, np.ones(4, bool)) / (history["wells.feed.rate[m^2/s]"][0] * step), 1)
        self.assertEqual(brought(0, step, np.array([True, False, False, True])), 0)

    def test_scenes_have_what_the_family_promises(self):
        drawn = [ranges.draw(1, number, "wells") for number in range(200)]
        kinds = [(well["kind"], well["in_fracture"]) for p in drawn for well in p["wells"].values()]
        self.assertEqual(set(kinds), {(kind, place) for kind in ("inject", "extract", "cycle", "pressure") for place in (True, False)})
        self.assertTrue(any(limited_wells.index(p, well) is None and not well["in_fracture"] for p in drawn for well in p["wells"].values()))


class Swapped(unittest.TestCase):
    def test_a_scene_stays_as_it_is_but_for_its_components(self):
        for number in range(20):
            plain, swapped = ranges.draw(1, number), ranges.draw(1, number, swapped=True)
            self.assertEqual({k: v for k, v in plain.items() if k != "discretization"},
                             {k: v for k, v in swapped.items() if k not in ("discretization", "rock", "contact", "swapped")})

    def test_all_combinations_are_drawn(self):
        drawn = {tuple(swaps.draw(1, number, "separate").values()) for number in range(300)}
        self.assertEqual(len(drawn), len(swaps.FLOWS) * len(swaps.ROCKS) * len(swaps.CONTACTS))


class Processes(unittest.TestCase):
    def test_a_cell_at_its_friction_bound_may_stick_or_slip(self):
        def history(stick, slip, is_open, pressure):
            return {"time[s]": np.array([1.0, 2.0]), "contact.cells_stick[1]": np.array([0.0, stick]),
                    "contact.cells_slip[1]": np.array([9.0, slip]), "contact.cells_open[1]": np.array([0.0, is_open]),
                    "p[Pa]": np.array([1.0, pressure])}

        alone = history(4, 5, 0, 3.0)
        self.assertEqual(compare.differences(alone, history(5, 4, 0, 3.0), 0), [])
        self.assertEqual(len(compare.differences(alone, history(4, 4, 1, 3.0), 0)), 2)
        self.assertEqual(len(compare.differences(alone, history(5, 4, 0, 3.0001), 0)), 1)


class Summary(unittest.TestCase):
    def test_cuts_count_from_forty_scenes_on(self):
        def reports(scenes, cuts):
            return [{"iterations": [1], "accepted": 1, "rejected": int(i < cuts), "outcome": "answer", "balance": 0.0,
                     "cuts": {"singular": 0, "not converged": 1}, "seconds": 1.0} for i in range(scenes)]
        self.assertFalse(summary.cuts_too_often(reports(100, 2)))
        self.assertTrue(summary.cuts_too_often(reports(100, 3)))
        self.assertFalse(summary.cuts_too_often(reports(10, 10)))


    def test_what_makes_the_exit_code_of_scenes_that_grow(self):
        def failing(text):
            return [{"failures": ["pressure: too high", text]}, {"failures": []}]
        for text, count in (("crash: signal 11", 1), ("fluid: the balance is wrong", 1), ("negative: an aperture", 1), ("contact: walls pull", 0)):
            self.assertEqual(len(summary.count_as_failed(failing(text), "growing")), count)
            self.assertEqual(len(summary.count_as_failed(failing(text), "meeting")), 1)
        many = [{"iterations": [1], "accepted": 1, "rejected": 1, "outcome": "answer", "balance": 0.0,
                 "cuts": {"singular": 0, "not converged": 1}, "seconds": 1.0}] * 40
        self.assertTrue(summary.cuts_too_often(many, "meeting"))
        self.assertFalse(summary.cuts_too_often(many, "growing"))


class Scenes(unittest.TestCase):
    def test_a_number_gives_the_same_scene(self):
        with tempfile.TemporaryDirectory() as temporary:
            for family in ranges.FAMILIES:
                for number in range(8):
                    texts = [scene.write(ranges.draw(3, number, family), Path(temporary) / str(i)).read_text() for i in (0, 1)]
                    self.assertEqual(*texts)

    def test_ranges_are_those_of_the_task(self):
        drawn = [ranges.draw(1, number) for number in range(500)]
        for name, low, high in (("permeability", 1e-24, 1e-10), ("alpha", 0, 1), ("poisson", 0, 0.4999),
                                ("friction", 0, 2), ("dilation", 0, 20), ("aperture", 1e-6, 1e-2),
                                ("relative_step", 1e-6, 1e6)):
            values = [p[name] for p in drawn]
            self.assertGreaterEqual(min(values), low * (1 - 1e-12))
            self.assertLessEqual(max(values), high * (1 + 1e-12))
            self.assertLess(min(values), low + 0.05 * (high - low))

    def test_twisted_meshes_have_slivers_and_no_flat_cells(self):
        found = []
        for p in (ranges.draw(1, number) for number in range(60)):
            grid = twisted_mesh.Grid(p)
            self.assertGreater(twisted_mesh.areas(grid.points, grid.triangles).min(), 0)
            self.assertAlmostEqual(twisted_mesh.areas(grid.points, grid.triangles).sum() / (p["width"] * p["height"]), 1, 9)
            found.append(twisted_mesh.smallest_angle(grid.points, grid.triangles))
        self.assertLess(min(found), 6)

    def test_fractures_lie_in_the_box(self):
        for p in (ranges.draw(2, number, family) for number in range(200) for family in ranges.FAMILIES):
            for a, b in fractures.segments(p).values():
                for x, y in (a, b):
                    self.assertTrue(-1e-9 <= x <= p["width"] * (1 + 1e-9) and 0 <= y <= p["height"], p["number"])

    def test_fractures_of_the_other_family_meet(self):
        alone = 0
        for p in (ranges.draw(1, number, "meeting") for number in range(200)):
            lines = list(fractures.segments(p).values())
            alone += len(lines) == 1
            (x0, y0), (x1, y1) = lines[0]
            for a, b in lines[1:]:
                sides = [(x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) for x, y in (a, b)]
                self.assertLess(min(sides) * max(sides), 1e-12 * max(map(abs, sides)) ** 2, p["number"])
        self.assertLess(alone, 10)

    def test_fractures_of_the_other_family_meet_in_twisted_meshes(self):
        for p in (ranges.draw(1, number, "meeting") for number in range(100)):
            grid = twisted_mesh.Grid(p)
            self.assertGreater(twisted_mesh.areas(grid.points, grid.triangles).min(), 0)
            edges = {frozenset(edge) for a, b, c in grid.triangles for edge in ((a, b), (b, c), (c, a))}
            for line in grid.lines.values():
                self.assertTrue(all(frozenset(edge) in edges for edge in zip(line, line[1:])), p["number"])
                self.assertTrue(set(line) & set(grid.lines["main"]), p["number"])

    def test_what_fractures_exchange_where_they_meet_is_no_loss(self):
        instant = at_rest()
        instant.fractures.cell_data["fracture"] = np.array([0, 0, 1, 1])
        data = instant.fractures.cell_data
        data["conduit.aperture[m]"] = data["conduit.aperture[m]"] + np.array([1e-6, 0, 0, -1e-6])
        self.assertEqual(check_balance.fracture_mass(P, [instant], 0), [])
        lines = instant.fractures
        apart = sprekk.Grid(np.vstack([lines.points, lines.points + [0, 1, 0]]),
                             np.vstack([lines.cells[:2], lines.cells[2:] + len(lines.points)]), data)
        self.assertEqual(len(check_balance.fracture_mass(P, [written.Instant(instant.time, instant.matrix, apart, True)], 0)), 2)


if __name__ == "__main__":
    unittest.main()
