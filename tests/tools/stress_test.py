#!/usr/bin/python3
"""The checks of tools/stress find what is planted, and are silent where nothing is; what makes its exit code."""

import argparse
import json
import os
import shutil
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import numpy as np
from stress_state import P, at_rest, change, grids, sprekk
from stress_suite import check_balance, check_contact, check_finite, check_pressure, compare, examine, physics, run, summary, written


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
        self.found(check_balance.matrix_mass(P, [at_rest()], lambda start, stop, own: (1e-6, 1e-6) if own is None else (0.0, 0.0)), "the matrix")

    def test_passes_leave_a_part_of_what_all_cells_take_up(self):
        """The tolerance of passes is 1e-10, and 100 times that for the balance of all cells together: S |dp| + alpha |d eps_v|. A monolithic
        scheme is held to a part of what one cell takes up, and so is one that counts later what passes leave."""
        p = {**P, "alpha": 0.5}
        instant = at_rest()
        volume = (np.array(physics.stresses(p, 1.0)).mean() + 0.5 * (instant.cell("pore.pressure[Pa]") - P["initial"])) / physics.in_plane_modulus(p)
        taken_up = (16 / 128 * (p["storage"] * abs(instant.cell("pore.pressure[Pa]") - P["initial"]) + 0.5 * abs(volume))).sum()
        for scheme, lost, count in (("response", 0.9e-8, 0), ("response", 1.2e-8, 1), ("fixed_stress", 0.9e-8, 1), ("monolithic", 0.9e-8, 1)):
            history = {"time[s]": np.array([1.0]), "fluid_balance_error[m^2]": np.array([lost * taken_up]),
                       **{f"fluid_{name}[m^2]": np.zeros(1) for name in ("stored", "injected", "outflow")}}
            found = check_balance.cumulative_balance({**p, "solved": scheme, "permeability": 1e-30}, [instant], history)
            self.assertEqual(len(found), count, (scheme, lost, found))

    def test_what_passes_through_a_fracture_may_round(self):
        """Millions times what stays: a relative 1e-14 of it is no loss, 1e-11 is."""
        through = 1e6 * physics.length(P) * P["aperture"] / physics.time_step(P)
        for lost, count in ((1e-14, 0), (1e-11, 1)):
            instant = at_rest()
            data = instant.fractures.cell_data
            data["pore.wall_flux.plus[m/s]"] = data["pore.wall_flux.plus[m/s]"] + through
            data["pore.wall_flux.minus[m/s]"] = data["pore.wall_flux.minus[m/s]"] - through * (1 - lost)
            self.assertEqual(len(check_balance.fracture_mass(P, [instant], 0)), count)

    def test_what_wells_exchange_has_a_last_digit(self):
        """Two wells of given pressure exchange 1e6 times what stays: 1e-16 of it is no loss, 1e-15 is."""
        through = 1e6 * physics.length(P) * P["aperture"]
        for lost, count in ((1e-16, 0), (1e-15, 1)):
            found = check_balance.fracture_mass(P, [at_rest()], 0, lambda start, stop, own: (lost * through, through))
            self.assertEqual(len(found), count, found)

    def test_pressures(self):
        self.found(check_pressure.failures(P, change("matrix", "pore.pressure[Pa]", 3, 1e8)), "above")
        board = change("matrix", "pore.pressure[Pa]", slice(None, None, 2), 1e5)
        self.found(check_pressure.failures(P, board), "peaks")
        self.found(check_pressure.failures(P, board, strain=0.9), "peaks")
        self.assertFalse(any("peaks" in failure for failure in check_pressure.failures(P, board, strain=1.1)))

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

    def test_differences_that_have_gone_are_none_to_count_against(self):
        """A checkerboard of a tenth of the differences that there were is within what deep cells keep of them; else it is found."""
        matrix, lines = grids(6, [1, 2, 3, 4])
        instant = written.Instant(0.0, matrix, lines, follows=True)
        pairs, walls = check_pressure.neighbours(instant), check_pressure.at_walls(instant)
        pressure, fracture = 1e3 * (np.arange(len(matrix.cells)) % 2), np.zeros(4)
        self.assertGreater(check_pressure.alternating(pressure, fracture, pairs, walls), check_pressure.SHARE)
        self.assertGreater(check_pressure.alternating(pressure, fracture, pairs, walls, 1e4), check_pressure.SHARE)
        self.assertEqual(check_pressure.alternating(pressure, fracture, pairs, walls, 1e5), 0)

    def test_along_a_fracture_depths_explain_what_follows_them(self):
        depths = np.array([1.0, 2, 1, 3, 2, 4, 1, 2, 1.0])
        changes = np.diff(1 / depths)
        mixed = np.concatenate([[0.0], np.cumsum(np.where(np.arange(8) % 2, 1, -1) * np.abs(changes))])
        for pressure in (1 / depths, -1 / depths):
            self.assertEqual(check_pressure.alternating_along(pressure, 0.01, 1 / depths), 0)
            self.assertEqual(check_pressure.alternating_along(pressure, 0.01), 7)
        self.assertEqual(check_pressure.alternating_along(mixed, 0.01, np.ones(9)), 7)  # equal depths
        self.assertEqual(check_pressure.alternating_along(mixed, 0.01, np.full(9, np.nan)), 7)  # a layer of several cells
        self.assertEqual(check_pressure.alternating_along(mixed, 0.01, np.array([1.0, 2, 3, 2, 1, 2, 3, 1, 2])), 7)  # other depths
        self.assertEqual(check_pressure.alternating_along(mixed, 0.01, np.append(1 / depths[:-1], np.nan)), 7)  # one cell is shallow

    def test_not_finite(self):
        bad = change("matrix", "pore.pressure[Pa]", 3, np.nan)
        self.found(check_finite.failures(bad, {}), "not finite")
        self.found(check_finite.failures([], {"a": np.array([1.0, np.inf])}), "not finite")

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


class Ends(unittest.TestCase):
    """Runs that end before their first step are reported as others are."""

    def report_of(self, text):
        """Of a program that is a shell script: $4 is the folder of the results."""
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "program"
            program.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            program.chmod(0o755)
            chosen = argparse.Namespace(seed=1, family="heat", update="after_step", scheme="monolithic", swapped=False, buoyant=False, limit=10)
            return examine.examine(program, chosen, 0, Path(folder) / "scene")

    def test_no_step(self):
        record = '{"exit": {"code": 1, "reason": "REASON"}, "counters": {}}'
        for reason, outcome in (("the step from 0 s over 1 s has no data: it says why", "gave up"), ("something else", "failed")):
            report = self.report_of(f"mkdir -p $4; echo '{record.replace('REASON', reason)}' > $4/run.json; exit 1")
            self.assertEqual((report["outcome"], report["accepted"], report["rejected"]), (outcome, 0, 0), report)

    def test_no_results(self):
        report = self.report_of("echo no room >&2; exit 1")
        self.assertEqual(report["outcome"], "failed")
        self.assertIn("no results: no room", report["failures"][0])


class Summary(unittest.TestCase):
    def test_cuts_count_from_forty_scenes_on(self):
        def reports(scenes, cuts):
            return [{"iterations": [1], "accepted": 1, "rejected": int(i < cuts), "outcome": "answer", "balance": 0.0,
                     "cuts": {"singular": 0, "not converged": 1}, "seconds": 1.0} for i in range(scenes)]
        self.assertFalse(summary.cuts_too_often(reports(100, 2)))
        self.assertTrue(summary.cuts_too_often(reports(100, 3)))
        self.assertFalse(summary.cuts_too_often(reports(10, 10)))

    def test_steps_that_the_fallback_has_solved_are_told(self):
        report = {"iterations": [9], "accepted": 5, "rejected": 2, "outcome": "answer", "balance": 0.0, "cuts": {"singular": 0, "not converged": 1},
                  "seconds": 1.0, "in turn": True, "together": 3, "monolithic cuts": 1}
        text = summary.text([report, {**report, "together": 0, "rejected": 0, "monolithic cuts": 0}])
        self.assertIn("3 steps in 1 scenes by 'fallback: monolithic'; the monolithic scheme cuts 1 steps of the scenes with cuts", text)
        self.assertNotIn("solved in turn", summary.text([{**report, "in turn": False}]))
        self.assertEqual(summary.in_turn(report), "(3 of 5 steps by 'fallback: monolithic') (monolithic: 1 cuts) ")
        self.assertEqual(summary.in_turn({**report, "together": 0, "rejected": 0}), "")

    def test_notes_count_the_steps_of_the_fallback(self):
        with tempfile.TemporaryDirectory() as folder:
            notes = [{"topic": "steps solved together", "steps": 4}, {"topic": "pore.pressure beyond the loads", "steps": 2}]
            (Path(folder) / "run.json").write_text(json.dumps({"notes": notes}))
            self.assertEqual(written.steps_solved_together(Path(folder)), 4)

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


class Runs(unittest.TestCase):
    @unittest.skipUnless(shutil.which("mpirun"), "no mpirun")
    def test_on_two_processes_whoever_calls(self):
        """mpirun refuses root, and more processes than cores, unless it is told otherwise: also where nobody has set its environment."""
        bare = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_")}
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.dict(os.environ, bare, clear=True):
            program = Path(folder) / "program"
            program.write_text("#!/bin/sh\necho on process $OMPI_COMM_WORLD_RANK >&2\n", encoding="utf-8")
            program.chmod(0o755)
            ended = run.run(program, "scene.yaml", Path(folder) / "out", limit=60, processes=2)
        self.assertEqual(ended.code, 0, ended.stderr)
        for rank in (0, 1):
            self.assertIn(f"on process {rank}", ended.stderr)


if __name__ == "__main__":
    unittest.main()
