#!/usr/bin/python3
"""thermal_pressurization_test.py SPREKK [MPIEXEC]: fluid that is warmed and cannot leave. Closed forms: undrained heating of rock that is held, free or has
a fracture, in a plane and in space; the pressure around a Gaussian temperature (McTigue 1986: heat and fluid diffuse apart, and the displacement has no
rotation). Twins: turned and mirrored, values that are disturbed by 1e-9, two processes, schemes; with substeps, two stages, settled starts and restarts."""

import math
import unittest

import numpy as np

from scene_runs import ROOT, on_two_processes
from scenes_in_space import SpaceRuns

E, NU, ALPHA, PHI, C_F, BETA, ALPHA_T, WARMED = 15e9, 0.22, 0.7, 0.12, 4.5e-10, 3e-4, 8e-6, 7.0
K, G = E / (3 * (1 - 2 * NU)), E / (2 * (1 + NU))
STORAGE = PHI * C_F + (ALPHA - PHI) / K
EXPANSION = PHI * BETA + (ALPHA - PHI) * 3 * ALPHA_T
MATERIALS = f"""
materials: {{young_modulus: {E!r} Pa, poisson_ratio: {NU!r}, biot_coefficient: {ALPHA!r}, porosity: {PHI!r}, fluid_compressibility: {C_F!r} 1/Pa,
            expansion: {ALPHA_T!r} 1/K, fluid_expansion: {BETA!r} 1/K, viscosity: 1 mPa*s}}
"""
PRESSURIZED = "{type: thermal_pressurization, between: [pore, heat]}"


def warmed(dimension, sides, rock="fem", schedule="[{solve: [pore, rock]}]", steps=2):
    """A closed block whose temperature rises everywhere; in the first step by 3 K, then by the rest."""
    z = ", z: [0 m, 0.7 m]" if dimension == 3 else ""
    return f"""
name: warmed
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 0.8 m]{z}}}}}
mesh: {{size: 0.35 m}}
{MATERIALS}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-16 m^2}}
  heat: {{type: matrix_heat/prescribed, temperature: "(300 + 3*min(t/s, 1) + {WARMED - 3!r}*max(0, t/s - 1)) K"}}
  rock: {{type: poromechanics/{rock}, boundary: {{{sides}}}}}
couplers:
  - {{type: biot, between: [pore, rock]}}
  - {{type: thermal_stress, between: [heat, rock]}}
  - {PRESSURIZED}
schedule: {schedule}
time: {{end: 2 s, step: {2 / steps!r} s}}
"""


def gaussian(cells, steps, schedule="[{solve: [pore, heat, rock]}]", disturbed=1.0):
    """T = g(kappa) decays, p = A (g(kappa) - g(c)), where g(D) = exp(-r^2/(1 + 4 D t))/(1 + 4 D t): around it nothing holds the fluid back."""
    uniaxial = K + 4 * G / 3
    storage, expansion = STORAGE + ALPHA ** 2 / uniaxial, EXPANSION - ALPHA * 3 * K * ALPHA_T / uniaxial
    kappa, c = 1.2e-6, 5e-6 * disturbed
    amplitude = WARMED * expansion * kappa / (storage * (kappa - c))

    def g(diffusivity):
        spread = f"(1 + 4*{diffusivity!r}*t/s)"
        return f"exp(-((x/m)^2 + (y/m)^2)/{spread})/{spread}"

    def inside(diffusivity):  # integral of r g from 0 to r
        return f"0.5*(1 - exp(-((x/m)^2 + (y/m)^2)/(1 + 4*{diffusivity!r}*t/s)))"

    pressure = f"{amplitude!r}*({g(kappa)} - {g(c)})"
    warmed_by = f"({inside(kappa)} - 0.5*(1 - exp(-((x/m)^2 + (y/m)^2))))"
    per_radius = (f"({ALPHA * amplitude!r}*({inside(kappa)} - {inside(c)}) + {3 * K * ALPHA_T * WARMED!r}*{warmed_by})/"
                  f"({uniaxial!r}*((x/m)^2 + (y/m)^2))")
    sides = ("left", "right", "bottom", "top")

    def of_sides(what):
        return ", ".join(f"{side}: {{{what}}}" for side in sides)

    scene = f"""
name: gaussian
geometry: {{box: {{x: [-3 m, 3 m], y: [-3 m, 3 m]}}}}
mesh: {{kind: structured, cells: [{cells}, {cells}], distortion: 0.2}}
{MATERIALS}
components:
  pore: {{type: matrix_flow/mpfa, permeability: {c * storage * 1e-3!r} m^2, boundary: {{{of_sides(f'pressure: "({pressure}) Pa"')}}}}}
  heat: {{type: matrix_heat/mpfa, conductivity: {kappa * 2.3e6!r} W/(m*K), heat_capacity: 2.3e6 J/(m^3*K),
         initial_temperature: "({WARMED!r}*exp(-((x/m)^2 + (y/m)^2))) K", boundary: {{{of_sides(f'temperature: "({WARMED!r}*{g(kappa)}) K"')}}}}}
  rock: {{type: poromechanics/mpsa, boundary: {{{of_sides(f'displacement: ["({per_radius}*x/m) m", "({per_radius}*y/m) m"]')}}}}}
couplers:
  - {{type: biot, between: [pore, rock]}}
  - {{type: thermal_stress, between: [heat, rock]}}
  - {PRESSURIZED}
schedule: {schedule}
time: {{end: 40000 s, step: {40000 / steps!r} s}}
"""
    def exact(points, t=40000.0):
        r2 = (points[:, :2] ** 2).sum(axis=1)
        of = lambda d: np.exp(-r2 / (1 + 4 * d * t)) / (1 + 4 * d * t)
        return amplitude * (of(kappa) - of(c))
    return scene, exact


FREE = "left: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}"
FREELY = {dimension: (EXPANSION - ALPHA * 3 * K * ALPHA_T / stiffness) / (STORAGE + ALPHA ** 2 / stiffness) * WARMED
          for dimension, stiffness in ((2, K + G / 3), (3, K))}  # S dp + alpha de = beta dT with K_d de = alpha dp + 3 K alpha_T dT
ALONE = f"""
name: alone
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 0.8 m]}}}}
mesh: {{size: 0.35 m}}
materials: {{porosity: {PHI!r}, fluid_compressibility: {C_F!r} 1/Pa, fluid_expansion: {BETA!r} 1/K, viscosity: 1 mPa*s}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-16 m^2}}
  heat: {{type: matrix_heat/prescribed, temperature: "(300 + 3*min(t/s, 1) + {WARMED - 3!r}*max(0, t/s - 1)) K"}}
couplers: [{PRESSURIZED}]
schedule: [{{solve: pore}}]
time: {{end: 2 s, step: 1 s}}
"""
FRACTURE = """
name: heated_fracture
geometry:
  box: {x: [0 m, 1 m], y: [0 m, 1 m]}
  fractures: {one: {points: [[0.21 m, 0.3 m], [0.78 m, 0.61 m]]}, other: {points: [[0.3 m, 0.72 m], [0.7 m, 0.86 m]]}}
mesh: {size: 0.2 m}
materials: {viscosity: 1 mPa*s}
components:
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: {fractures: {one: 0.3 mm, other: 0.05 mm}}
    initial_pressure: 1 MPa
    fluid_compressibility: 4.5e-10 1/Pa
  heat: {type: matrix_heat/mpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: 340 K}
  water: {type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 0.6 W/(m*K), heat_capacity: 4e6 J/(m^3*K), initial_temperature: 300 K}
couplers:
  - {type: heat_exchange, between: [heat, water]}
  - {type: thermal_pressurization, between: [conduit, water], fluid_expansion: {fractures: {one: 3e-5 1/K, other: 1e-5 1/K}}}
schedule: [{solve: [conduit, heat, water]}]
time: {end: 5000 s, step: 1000 s}
"""


class ThermalPressurization(SpaceRuns):
    def test_closed_rock_that_is_held_or_free(self):
        """Reference: S dp + alpha de = beta dT; held, de = 0; free, K_d de = alpha dp + 3 K alpha_T dT, with K_d = lambda + G in a plane, K in space."""
        for dimension, rock in ((2, "fem"), (2, "mpsa"), (3, "fem")):
            names = ("left", "bottom") + (("front",) if dimension == 3 else ())
            others = ("right", "top") + (("back",) if dimension == 3 else ())
            free = ", ".join(f"{side}: {{displacement_normal: 0 m}}" for side in names)
            held = ", ".join(f"{side}: {{displacement_normal: 0 m}}" for side in names + others)
            for sides, exact in ((held, EXPANSION / STORAGE * WARMED), (free, FREELY[dimension])):
                with self.subTest((dimension, rock, sides)):
                    results = self.run_text(warmed(dimension, sides, rock))
                    pressure = results.fields()["pore.pressure"]
                    self.assertLess(np.abs(pressure / exact - 1).max(), 1e-9)
                    self.assertLess(abs(results.history["fluid_stored[m^2]" if dimension == 2 else "fluid_stored[m^3]"][-1]), 1e-12 * PHI)

    def test_turned_with_substeps_and_settled(self):
        """Reference: the closed form of the free block, which knows no direction and no steps."""
        scene = warmed(2, FREE)
        path = self.write(scene, "free.yaml")
        exact = FREELY[2]
        for name, files in (("turned", self.turned(path, 27)), ("mirrored", self.turned(path, 27, mirror=True))):
            with self.subTest(name):
                self.assertLess(np.abs(self.run_scene(files).fields()["pore.pressure"] / exact - 1).max(), 1e-9)
        for more in ("start: {settle: pore}", "start: {settle: [pore, rock]}"):
            with self.subTest(more):
                self.assertLess(np.abs(self.run_text(scene + more).fields()["pore.pressure"] / exact - 1).max(), 1e-9)
        in_substeps = warmed(2, FREE, schedule="[{subcycle: {count: 3, steps: [{solve: [pore, rock]}]}}]")
        self.assertLess(np.abs(self.run_text(in_substeps).fields()["pore.pressure"] / exact - 1).max(), 1e-9)

    def test_two_stages(self):
        """Reference: dp = beta_f dT/c_f in rock that keeps its volume (thermal_stress has one stage only)."""
        for steps in (2, 8):
            pressure = self.run_text(ALONE, f"time={{end: 2 s, step: {2 / steps!r} s, scheme: sdirk2}}").fields()["pore.pressure"]
            self.assertLess(np.abs(pressure / (BETA * WARMED / C_F) - 1).max(), 1e-9)

    def test_a_restart_keeps_the_bits(self):
        scene = self.write(gaussian(16, 10)[0], "whole.yaml")
        whole, folder = self.run_scene(scene), self.folder / "half"
        self.assertEqual(self.call(["run", "-q", "-o", folder], scene, "time.end=20000 s").returncode, 0)
        self.assert_same_bits(self.run_scene(scene, restart=folder), whole)

    def test_schedules_have_the_same_answer(self):
        whole = self.run_text(warmed(2, FREE)).fields()["pore.pressure"]
        for schedule in ("[{iterate: {steps: [{solve: rock}, {solve: pore, stabilize: fixed_stress}], until: {relative: 1e-10, at_most: 400}}}]",
                         "[{iterate: {steps: [{solve: pore, stabilize: fixed_stress}, {solve: rock}], until: {relative: 1e-10, at_most: 400}}}]"):
            with self.subTest(schedule):
                split = self.run_text(warmed(2, FREE, schedule=schedule)).fields()["pore.pressure"]
                self.assertLess(np.abs(split / whole - 1).max(), 1e-7)

    def test_pressure_around_a_gaussian_temperature(self):
        """Reference: above. Second order in space, first in time."""
        errors = []
        for cells, steps in ((16, 10), (32, 40)):
            scene, exact = gaussian(cells, steps)
            matrix = self.run_text(scene).fields()
            truth = exact(matrix.centres)
            errors.append(np.sqrt(np.mean((matrix["pore.pressure"] - truth) ** 2) / np.mean(truth ** 2)))
        print("Gaussian temperature: errors", errors)
        self.assertGreater(math.log2(errors[0] / errors[1]), 1.8)
        self.assertLess(errors[1], 0.02)

    def test_a_heat_that_is_solved_apart_is_counted_once(self):
        """Reference: the monolithic run; heat goes its way alone, so that the order of solves does not matter where heat comes first."""
        scene, _ = gaussian(16, 10)
        whole = self.run_text(scene).fields()["pore.pressure"]
        apart = self.run_text(gaussian(16, 10, "[{solve: heat}, {solve: [pore, rock]}]")[0]).fields()["pore.pressure"]
        self.assertLess(np.abs(apart - whole).max(), 1e-8 * np.abs(whole).max())
        disturbed = self.run_text(gaussian(16, 10, disturbed=1 + 1e-9)[0]).fields()["pore.pressure"]
        self.assertLess(np.abs(disturbed - whole).max(), 1e-7 * np.abs(whole).max())

    def test_a_fracture_that_warms_tight_rock(self):
        """The tutorial's scene: half-spaces beside a fracture that is warm and drained, uniaxial strain (McTigue 1986), A (erfc_kappa - erfc_c). Steps of
        half a day leave some per cent, which fall with time and with the step."""
        k, g, alpha, phi = 6e9 / (3 * (1 - 2 * 0.27)), 6e9 / (2 * 1.27), 0.8, 0.16
        uniaxial, kappa = k + 4 * g / 3, 2 / 2.3e6
        storage = phi * 4.5e-10 + (alpha - phi) / k + alpha ** 2 / uniaxial
        c = 5e-20 / 0.6e-3 / storage
        amplitude = 40 * (phi * 4e-4 + (alpha - phi) * 3e-5 - alpha * 3 * k * 1e-5 / uniaxial) * kappa / (storage * (kappa - c))

        def front(diffusivity, away, times):
            return np.array([math.erfc(away / (2 * math.sqrt(diffusivity * t))) for t in times])

        errors = {}
        for step in ("0.5 day", "1 day"):
            run = self.run_scene(ROOT / "configs/tutorial/heated_fracture.yaml", f"time.step={step}", "output.fields=false")
            late = run.times > 10 * 86400
            times = run.times[late]
            for probe, away in (("p_near", 0.5), ("p_far", 1.5)):
                exact = amplitude * (front(kappa, away, times) - front(c, away, times))
                errors[probe, step] = np.abs((run[probe][late] - 2e6) / exact - 1).max()
            warm = np.abs((run["T_near"][late] - 300) / (40 * front(kappa, 0.5, times)) - 1).max()
            self.assertLess(warm, 0.015 if step == "0.5 day" else 0.03)
        self.assertLess(errors["p_near", "0.5 day"], 0.02)
        self.assertLess(errors["p_far", "0.5 day"], 0.05)
        self.assertLess(errors["p_far", "0.5 day"], 0.65 * errors["p_far", "1 day"])

    def test_fluid_that_fills_closed_fractures(self):
        """Reference: p = p_0 + beta_f (T - T_0)/c_f with the mean temperature of each fracture, since pressure evens out along it and heat does not; c_f dp
        is the logarithm of a density, of which half a square is left out."""
        water = self.run_text(FRACTURE).fractures()
        in_one = np.hypot(*(water.centres[:, :2] - [0.495, 0.455]).T) < 0.35
        in_one &= np.abs((water.centres[:, :2] - [0.21, 0.3]) @ [-0.31, 0.57]) < 1e-9
        self.assertTrue(0 < in_one.sum() < len(in_one))
        for here, beta in ((in_one, 3e-5), (~in_one, 1e-5)):
            sizes = water.sizes[here]
            mean = {name: (water[name][here] * sizes).sum() / sizes.sum() for name in ("conduit.pressure", "water.temperature")}
            rise = beta / 4.5e-10 * (mean["water.temperature"] - 300)
            self.assertGreater(rise, 3e5)
            self.assertLess(abs((mean["conduit.pressure"] - 1e6) / rise - 1), 4.5e-10 * rise + 1e-9)

    def test_is_missed_or_refused(self):
        scene, _ = gaussian(16, 10)
        told = [[str(note) for note in self.run_text(each, "time.end=4000 s").notes] for each in (scene, scene.replace(f"  - {PRESSURIZED}\n", ""))]
        self.assertFalse(any("keeps its volume when it is warmed" in text for text in told[0]), told[0])
        self.assertTrue(any("keeps its volume when it is warmed" in text for text in told[1]), told[1])
        stored = scene.replace(f"porosity: {PHI!r}, fluid_compressibility: {C_F!r} 1/Pa,", "").replace("mpfa, perm", "mpfa, storage: 2e-10 1/Pa, perm")
        for wrong, why in ((scene.replace("[pore, heat]}", "[pore, rock]}"), "stands between a flow and no heat"), (stored, "'porosity' is missing"),
                           (scene.replace(f"fluid_expansion: {BETA!r} 1/K, ", ""), "fluid_expansion"),
                           (scene.replace("[pore, heat]}", "[pore, heat], biot_coefficient: 0.1}"), "below 'porosity'")):
            with self.subTest(why):
                said = self.call("check", self.write(wrong))
                self.assertEqual(said.returncode, 2)
                self.assertIn(why, said.stderr)

    @on_two_processes
    def test_two_processes(self):
        scene, _ = gaussian(16, 10)
        ours, other = (self.run_text(scene, processes=processes) for processes in (1, 2))
        self.assertLess(self.largest_difference(ours, other), 1e-7)


if __name__ == "__main__":
    unittest.main()
