#!/usr/bin/python3
"""The checks of tools/stress for scenes that grow, with heat, and with wells find what is planted, and are silent where nothing is."""

import unittest

import numpy as np
from stress_state import P, at_rest, change
from stress_suite import check_growing, check_heat, check_wells, growing, heat, limited_wells, physics, ranges, well_shares, written


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

    def test_what_the_run_tells_is_granted_to_the_rock_and_no_more(self):
        p = {**self.P, "conduction": "mpfa"}
        for place, name in (("matrix", "heat.temperature[K]"), ("fractures", "water.temperature[K]")):
            instant = self.state()
            getattr(instant, place).cell_data[name][2] = 500.0
            self.assertTrue(check_heat.bounds(p, [instant]))
            self.assertTrue(check_heat.bounds(p, [instant], told_in_rock=99.9))
            self.assertEqual(check_heat.bounds(p, [instant], told_in_rock=100.1) == [], place == "matrix")

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

    def test_the_side_counts_as_rock_around(self):
        """The first short step beside a side of 250 K: cells have hardly cooled, and one is 1 K too warm."""
        for sides, count in (("right", 0), ("none", 1)):
            instant = self.state()
            instant.matrix.cell_data["heat.temperature[K]"][:] = 300.0
            instant.matrix.cell_data["heat.temperature[K]"][2] = 301.0
            instant.fractures.cell_data["water.temperature[K]"][:] = 300.0
            p = {**self.P, "conduction": "mpfa", "heat_sides": sides, "well": "none"}
            self.assertEqual(len(check_heat.bounds(p, [instant])), count)

    def test_a_short_step_moves_less_than_the_last_digit_of_what_is_stored(self):
        """2e6 x 16 x 310 J/m of rock: the last digit is 2e-6 J/m."""
        for wrong, count in ((1e-6, 0), (1e-5, 1)):
            history = self.history()
            for name in ("stored", "injected", "outflow"):
                history[f"heat_{name}[J/m]"] = np.array([0.0])
            history["heat_balance_error[J/m]"] = np.array([wrong])
            failures = check_heat.balances({**self.P, "conductivity": 1e-12, "fluid_heat_capacity": 1.0, "alpha": 1.0, "well": "none"}, [self.state()], history)
            self.assertEqual(sum("the balance" in failure for failure in failures), count, failures)

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
        size = physics.length(self.P) * self.P["aperture"] / physics.end(self.P)
        # Beside the well, at the end of two cells of 0.5 m: half of its rate flows 0.25 m to each side, q/2 = a^3/12 mu dp/(0.25 m).
        aperture = instant.fractures.cell_data["conduit.aperture[m]"][1]
        self.drop = 0.3 * size / 2 * 0.25 * 12 * self.P["viscosity"] / aperture ** 3
        instant.fractures.cell_data["conduit.pressure[Pa]"] = np.full(4, 3e6 - self.drop)
        instant.fractures.cell_data["rock.wall_traction.normal[Pa]"] = instant.fractures.cell_data["contact.traction.normal[Pa]"] - 3e6 + self.drop
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
                                        ("plant.rate[m^2/s]", 0.1 * size, "within its limit"), ("plant.pressure[Pa]", 1e4, "at its point"),
                                        ("plant.pressure[Pa]", 1.0, "at its point"), ("feed.pressure[Pa]", -0.1, "at its point"),
                                        ("feed.pressure[Pa]", 1e4, "at its point")):
            history = self.history()
            history["wells." + column] = history["wells." + column] + change_of
            failures = check_wells.failures(self.P, [self.at_rest()], history)
            self.assertTrue(any(text in failure for failure in failures), (column, change_of, failures))
        history = self.history()
        history["fluid_injected[m^2]"] = history["fluid_injected[m^2]"] * (1 + 1e-6)
        self.assertEqual(len(check_wells.amount(self.P, [self.at_rest()], history)), 1)

    def test_a_well_in_a_cell_shares_as_the_fracture_conducts(self):
        """At 0.2 m of 0.25 m from the centre to the end, beside a cell of twice the aperture: as two tubes in series from the place."""
        lines = self.at_rest().fractures
        aperture = np.array([1e-3, 1e-3, 2e-3, 1e-3])
        fracture = well_shares.Fracture(lines, 1, np.array([1.95, 2.0]), 1e-3)
        own, other = 1e-3 + 0.5e-3 / 2, 2e-3 - 0.5e-3 / 2  # the opening is linear from centre to centre
        back, ahead = (0.2 * 12e-3 / own ** 3, 0.05 * 12e-3 / own ** 3 + 0.25 * 12e-3 / other ** 3)  # resistances to both centres
        shares = fracture.shares(aperture)
        self.assertAlmostEqual(shares[2], back / (back + ahead))
        self.assertAlmostEqual(shares[1] + shares[2], 1)
        self.assertAlmostEqual(fracture.rise(aperture) * (1 / back + 1 / ahead), 1)

    def test_a_well_in_rock_shares_by_its_place(self):
        """Among cells around an inner node the mean of centres is the place; beyond the last ones it is the nearest one before."""
        rock = well_shares.Rock(self.at_rest().matrix)
        for place in ((1.1, 0.9), (0.6, 1.2), (2.9, 3.1), (3.0, 1.0)):
            home = int(np.argmin(np.hypot(*(rock.centres - place).T)))
            shares = rock.shares(home, np.array(place))
            self.assertTrue(min(shares.values()) >= 0)
            self.assertTrue(np.allclose(sum(share * rock.centres[cell] for cell, share in shares.items()), place))
        # The triangle (0.5, 0), (1, 0), (1, 0.5) has its centre 1/6 m above the side.
        home = int(np.argmin(np.hypot(*(rock.centres - (5 / 6, 1 / 6)).T)))
        self.assertEqual(rock.shares(home, np.array([5 / 6, 0.01])), {home: 1.0})

    def test_a_shut_well_may_have_more_than_its_limit(self):
        history = self.history()
        history["wells.feed.rate[m^2/s]"][:], history["wells.feed.pressure[Pa]"][:] = 0, 3.1e6
        self.assertEqual(check_wells.conditions(self.P, [self.at_rest()], history), [])

    def test_what_wells_bring_is_counted_for_their_fracture(self):
        history, instant = self.history(), self.at_rest()
        brought = check_wells.sources(self.P, history, instant)
        step = physics.end(self.P)
        for amount in brought(0, step, np.ones(4, bool)):
            self.assertAlmostEqual(abs(amount) / abs(history["wells.feed.rate[m^2/s]"][0] * step), 1)
        rates = [history[f"wells.{name}.rate[m^2/s]"][0] for name in self.P["wells"]]
        self.assertAlmostEqual(brought(0, step, "all")[1] / (sum(map(abs, rates)) * step), 1)
        self.assertEqual(brought(0, step, np.array([True, False, False, True])), (0, 0))

    def test_scenes_have_what_the_family_promises(self):
        drawn = [ranges.draw(1, number, "wells") for number in range(200)]
        kinds = [(well["kind"], well["in_fracture"]) for p in drawn for well in p["wells"].values()]
        self.assertEqual(set(kinds), {(kind, place) for kind in ("inject", "extract", "cycle", "pressure") for place in (True, False)})
        self.assertTrue(any(limited_wells.index(p, well) is None and not well["in_fracture"] for p in drawn for well in p["wells"].values()))


if __name__ == "__main__":
    unittest.main()
