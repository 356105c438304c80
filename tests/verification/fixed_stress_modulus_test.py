#!/usr/bin/python3
"""fixed_stress_modulus_test.py SPREKK: the stabilization alpha^2/K by modulus and by value. Flow, then rock, contracts by
|L - b|/(S + L) at most, where b lies between alpha^2/(lambda + 2 G) (irrotational displacements) and alpha^2/(lambda + G) (a pressure that
is the same everywhere). So L = alpha^2/(lambda + 2 G) needs one pass in Terzaghi's column, and the middle of both is the best in Mandel's block."""

import csv
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SPREKK = Path(sys.argv.pop(1)).resolve()
# Table 1 of Dang, Berre, Keilegavlen (2022): E, nu, alpha, porosity, compressibility of the fluid.
YOUNG, POISSON, ALPHA, POROSITY, FLUID = 40e9, 0.2, 0.8, 0.01, 4e-10
LAMBDA, SHEAR = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
UNIAXIAL, IN_PLANE = ALPHA ** 2 / (LAMBDA + 2 * SHEAR), ALPHA ** 2 / (LAMBDA + SHEAR)
STORAGE = POROSITY * FLUID + (ALPHA - POROSITY) * 3 * (1 - 2 * POISSON) / YOUNG


def bound(stabilization):
    return max(abs(stabilization - b) for b in (UNIAXIAL, IN_PLANE)) / (STORAGE + stabilization)


class FixedStressModulus(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.runs = 0

    def call(self, command, scene, *settings):
        return subprocess.run([SPREKK, *command, ROOT / f"configs/verification/{scene}.yaml", *(word for s in settings for word in ("--set", s))],
                              capture_output=True, text=True, timeout=100)

    def iterated(self, scene, coupler, until, *settings):
        """Rows of coupling.csv, by step, of the iteration."""
        self.runs += 1
        folder = self.folder / str(self.runs)
        schedule = (f"schedule=[{{iterate: {{fallback: none, until: {{relative: {until}, at_most: 60}}, "
                    "steps: [{solve: pore, stabilize: fixed_stress}, {solve: rock}]}}]")
        run = self.call(["run", "-q", "-o", folder], scene, schedule, f"couplers=[{{type: biot, between: [pore, rock], {coupler}}}]", *settings)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(folder / "coupling.csv", newline="", encoding="utf-8") as file:
            return [row for row in csv.DictReader(file) if row["schedule"] == "iterate"]

    def test_a_column_needs_one_pass(self):
        # With finite elements a cell's volume follows from its own pressure; mpsa's own term of the pressure moves modes of the size of a cell.
        fem, one = "components.rock.type=poromechanics/fem", "biot_coefficient: 1, "  # alpha^2/M_v = 1/2
        for coupler in ("fixed_stress_modulus: uniaxial", "fixed_stress_value: 0.5 1/Pa"):
            rows = self.iterated("terzaghi", one + coupler, 1e-7, fem)
            # In the first step the flow is solved before the rock has seen the load.
            self.assertEqual([row["iteration[1]"] for row in rows], ["1", "2", *["1"] * 9], coupler)
        self.assertGreater(len(self.iterated("terzaghi", one + "fixed_stress_value: 0.6 1/Pa", 1e-7, fem)), 20)

    def test_the_modulus_is_found_in_the_first_passes(self):
        # The column has one modulus for all pressures: two passes of the first step show it, and each later step takes one pass.
        rows = self.iterated("terzaghi", "biot_coefficient: 1, fixed_stress_modulus: found", 1e-7, "components.rock.type=poromechanics/fem")
        passes = [int(row["iteration[1]"]) for row in rows]
        print(f"    column: {passes}", flush=True)
        self.assertLessEqual(max(passes), 4)
        self.assertEqual(passes[max(passes):], [1] * (len(passes) - max(passes)))
        # In a block no factor is worse than that of the least favourable bound of L, and the last ones are near to the best.
        rows = self.iterated("mandel", "fixed_stress_modulus: found", 1e-10, "time.end=1079 s")
        changes = [float(row["update[1]"]) for row in rows[1:]]
        factors = [after / before for before, after in zip(changes, changes[1:])]
        print(f"    block: {[f'{factor:.3f}' for factor in factors]}, at most {bound(UNIAXIAL):.3f}", flush=True)
        self.assertLessEqual(max(factors), bound(UNIAXIAL))

    def test_a_restart_finds_what_was_found(self):
        found = ("couplers=[{type: biot, between: [pore, rock], fixed_stress_modulus: found}]", "mesh.size=0.1 m",
                 "schedule=[{iterate: {fallback: none, steps: [{solve: pore, stabilize: fixed_stress}, {solve: rock}]}}]")
        histories = []
        for name, ends in (("whole", ("4316 s",)), ("parts", ("2158 s", "4316 s"))):
            for i, end in enumerate(ends):
                how = ["run", "-q", *(("--restart", self.folder / name / "checkpoint.h5") if i else ("-o", self.folder / name))]
                run = self.call(how, "mandel", *found, f"time.end={end}")
                self.assertEqual(run.returncode, 0, run.stderr)
            with open(self.folder / name / "history.csv", newline="", encoding="utf-8") as file:
                histories.append([{key: value for key, value in row.items() if "seconds" not in key} for row in csv.DictReader(file)])
        self.assertEqual(*histories)

    def test_factors_in_a_block(self):
        self.assertAlmostEqual(bound(UNIAXIAL), 0.160, delta=5e-4)
        self.assertAlmostEqual(bound((UNIAXIAL + IN_PLANE) / 2), 0.074, delta=5e-4)
        for modulus, stabilization in (("uniaxial", UNIAXIAL), ("optimal", (UNIAXIAL + IN_PLANE) / 2)):
            rows = self.iterated("mandel", f"fixed_stress_modulus: {modulus}", 1e-10, "time.end=1079 s")
            changes = [float(row["update[1]"]) for row in rows[1:]]
            factors = [after / before for before, after in zip(changes, changes[1:])]
            print(f"    {modulus}: {[f'{factor:.3f}' for factor in factors]}, at most {bound(stabilization):.3f}", flush=True)
            self.assertLessEqual(max(factors), bound(stabilization))

    def test_fluid_that_stores_less_and_less(self):
        # An irrotational mode of the wave number q contracts by |L - c|/(S + L + D), with c = alpha^2/M_v and D = (k/mu) dt q^2 (Kim, Tchelepi
        # and Juanes 2011): S -> 0 changes little, where the drained split has c/(S + D). The initial pressure is the mode, so errors are.
        step, coupled, q = 0.01, 0.5, math.pi / 2
        for rock in ("mpsa", "fem"):
            for storage in (1e-2, 1e-5, 1e-10, 0.0):
                for stabilization, mobility in ((0.9, 4.0), (0.3, 4.0), (0.9, 0.4)):
                    theory = (stabilization - coupled) / (storage + stabilization + mobility * step * q ** 2)
                    rows = self.iterated(
                        "terzaghi", f"biot_coefficient: 1, fixed_stress_value: {stabilization} 1/Pa", 1e-6, f"components.rock.type=poromechanics/{rock}",
                        f"components.pore.storage={storage!r} 1/Pa", f"components.pore.permeability={mobility} m^2",
                        f"components.pore.initial_pressure='(sin({q!r}*y)) Pa'", "mesh.cells=[2, 80]", "components.rock.boundary.bottom.normal_stress=0 Pa",
                        f"time.end={step} s")
                    changes = [float(row["update[1]"]) for row in rows[1:]]
                    factors = [after / before for before, after in zip(changes, changes[1:])][1:4]
                    print(f"    {rock}, S = {storage}, L = {stabilization}, k/mu = {mobility}: {[f'{f:.4f}' for f in factors]}, theory {abs(theory):.4f}",
                          flush=True)
                    for factor in factors:
                        self.assertAlmostEqual(factor / abs(theory), 1, delta=0.02)

    def test_the_answer_without_storage_is_the_monolithic_one(self):
        answers = []
        for scheme in ("[{solve: [pore, rock]}]", "[{iterate: {fallback: none, until: {relative: 1e-11, at_most: 60}, steps: [{solve: pore, "
                       "stabilize: fixed_stress}, {solve: rock}]}}]"):
            folder = self.folder / str(len(answers))
            run = self.call(["run", "-q", "-o", folder], "terzaghi", f"schedule={scheme}", "components.pore.storage=0 1/Pa")
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(folder / "history.csv", newline="", encoding="utf-8") as file:
                answers.append([float(row["p_closed[Pa]"]) for row in csv.DictReader(file)])
        self.assertEqual(len(answers[0]), len(answers[1]))
        for one, other in zip(*answers):
            self.assertAlmostEqual(other / one, 1, delta=1e-8)

    def test_the_value_is_that_of_the_modulus(self):
        passes = [[row["residual[1]"] for row in self.iterated("mandel", coupler, 1e-6, "time.end=1079 s")]
                  for coupler in ("fixed_stress_modulus: uniaxial", f"fixed_stress_value: {UNIAXIAL!r} 1/Pa")]
        self.assertEqual(len(passes[0]), len(passes[1]))
        for first, second in zip(*passes):
            self.assertAlmostEqual(float(first) / float(second), 1, delta=1e-6)

    def test_mistakes(self):
        for coupler, said in (("fixed_stress_value: 1e-11 1/Pa, fixed_stress_factor: 2", "'fixed_stress_factor' has no effect"),
                              ("fixed_stress_value: 1e-11 1/Pa, fixed_stress_modulus: bulk", "'fixed_stress_modulus' has no effect"),
                              ("fixed_stress_modulus: shear", "uniaxial"), ("fixed_stress_value: 0 1/Pa", "fixed_stress_value")):
            run = self.call(["check"], "mandel", f"couplers=[{{type: biot, between: [pore, rock], {coupler}}}]")
            self.assertEqual(run.returncode, 2, coupler)
            self.assertIn(said, run.stderr)


if __name__ == "__main__":
    unittest.main()
