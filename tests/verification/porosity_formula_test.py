#!/usr/bin/python3
"""porosity_formula_test.py SPREKK [MPIEXEC]: the porosity of rock as a formula of the state.

- What pores hold is a function of the state: closed forms of pressures that are the same everywhere (injected, pressed, warmed), on any number of steps.
- A wave of pressure in closed form, with its orders; turned and mirrored.
- Biot's own terms, and a constant, as formulas have the answers of both; one answer in every schedule, on two processes, after a restart; growth loses no fluid.
- What is refused."""

import math
import unittest

import numpy as np

import formula_scenes
from formula_scenes import put
from scene_runs import ROOT, SceneRuns, on_two_processes

WINGS = ROOT / "configs/paper/wing_cracks.yaml"
PORES, STIFFENS = 0.1, 20e6  # porosity at p = 0, and Pa
CLOSED = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.5 m}
components:
  pore:
    type: matrix_flow/KIND
    permeability: 1e-15 m^2
    viscosity: 1 mPa*s
    porosity: "FORMULA"
    fluid_compressibility: COMPRESSIBILITY 1/Pa
    initial_pressure: 3 MPa
    source: 1e-6 1/s
schedule: [{solve: pore}]
time: {end: 30000 s, step: 6000 s}
output: {probes: {p: {of: pore.pressure, take: largest}, lowest: {of: pore.pressure, take: smallest}}}
"""
# phi_0 u_t = k P/mu (ln u)_xx with u = exp(p/P) has the wave u = 1/(1 + exp(-4 (x - v t)/m)), v = 4 D/m, D = k P/(mu phi_0).
SPEED, STEEP, SCALE = 8e-5, 4.0, 2e6  # m/s, 1/m, Pa
WAVE = f"(-2*log(1 + exp(-{STEEP}*(x - {SPEED}*t)))) MPa"
TRAVELLING = f"""
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 0.4 m]}}}}
mesh: MESH
components:
  pore:
    type: matrix_flow/KIND
    permeability: 1e-15 m^2
    viscosity: 1 mPa*s
    porosity: "0.1*exp(p/(2 MPa))"
    fluid_compressibility: 0 1/Pa
    initial_pressure: "{WAVE.replace(f'{SPEED}*t', '0')}"
    boundary: {{left: {{pressure: "{WAVE}"}}, right: {{pressure: "{WAVE}"}}}}
schedule: [{{solve: pore}}]
time: {{end: 4000 s, step: STEP s, scheme: SCHEME}}
output: {{every: 4000 s}}
"""
# Rock between smooth walls that is pressed from above, with fluid that cannot leave.
PRESSED = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.5 m}
components:
  pore:
    type: matrix_flow/KIND
    permeability: 1e-15 m^2
    viscosity: 1 mPa*s
    porosity: "FORMULA"
    fluid_compressibility: 4e-10 1/Pa
  rock:
    type: poromechanics/ROCK
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    boundary: {left: {displacement_normal: 0 m}, right: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, top: {normal_stress: -30 MPa}}
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0.8}]
schedule: [{solve: [pore, rock]}]
time: {end: 2 s, step: 1 s}
output: {probes: {p: {of: pore.pressure, take: largest}}}
"""
BULK = 10e9 / (3 * (1 - 0.4))  # Pa, of formula_scenes.fractured
OF_BIOT = f"0.1 + 0.8*eps_v + {0.7 / BULK!r}*p/Pa"
YIELDING = "0.1*exp(p/(20 MPa)) + 0.8*eps_v*(1 + eps_v/1e-4)"



def closed(formula=f"{PORES}*exp(p/(20 MPa))", kind="mpfa", compressibility="0"):
    return put(CLOSED, KIND=kind, FORMULA=formula, COMPRESSIBILITY=compressibility)


def root(function, low, high):
    """Of a function that rises, by halving."""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if function(middle) > 0 else (middle, high)
    return low


class PorosityFormula(SceneRuns):
    @staticmethod
    def last(run, quantity):
        return next(values[-1] for name, values in run.history.items() if name.split("[")[0] == quantity)

    def assert_conserved(self, run, share=1e-10):
        """Of all that has come in, moved or is stored; Newton's method leaves up to 4e-12."""
        moved = max(np.abs(values).max() for name, values in run.history.items() if name.startswith(("fluid_injected", "fluid_stored", "fluid_outflow")))
        error = max(np.abs(values).max() for name, values in run.history.items() if name.startswith("fluid_balance_error"))
        self.assertLess(error, share * moved)

    def test_what_a_closed_rock_holds_is_a_function_of_its_pressure(self):
        """phi(p) = phi(p_0) + q t, in one step or many, with both schemes."""
        before = PORES * math.exp(3e6 / STIFFENS)
        known = STIFFENS * math.log((before + 0.03) / PORES)
        for kind in ("mpfa", "tpfa"):
            scene = self.write(closed(kind=kind))
            for settings in ((), ("time.step=30000 s",), ("time.step=1700 s",), ("time.scheme=sdirk2",), ("time.scheme=sdirk2", "time.step=30000 s"))[:: 1 if kind == "mpfa" else 3]:
                with self.subTest(kind=kind, settings=settings):
                    run = self.run_scene(scene, *settings)
                    for probe in ("p", "lowest"):
                        self.assertLess(abs(self.last(run, probe) / known - 1), 1e-9)
                    self.assert_conserved(run)

    def test_closed_rock_in_space(self):
        known = STIFFENS * math.log((PORES * math.exp(3e6 / STIFFENS) + 0.03) / PORES)
        for kind in ("mpfa", "tpfa"):
            run = self.run_scene(self.write(closed(kind=kind)), "geometry.box.z=[0 m, 1 m]", "mesh.size=1 m")
            self.assertLess(abs(self.last(run, "p") / known - 1), 1e-9)

    def test_a_fluid_that_yields(self):
        """phi(p) (1 + c (p − p_0)), and with a porosity that follows the time as well."""
        run = self.run_scene(self.write(closed(compressibility="5e-9")))
        known = root(lambda p: PORES * math.exp(p / STIFFENS) * (1 + 5e-9 * (p - 3e6)) - PORES * math.exp(3e6 / STIFFENS) - 0.03, 0, 30e6)
        self.assertLess(abs(self.last(run, "p") / known - 1), 1e-9)
        self.assert_conserved(run)
        run = self.run_scene(self.write(closed(f"{PORES}*exp(p/(20 MPa)) + 0.02*t/(30000 s)")))
        self.assertLess(abs(self.last(run, "p") / (STIFFENS * math.log((PORES * math.exp(3e6 / STIFFENS) + 0.01) / PORES)) - 1), 1e-9)

    def test_pores_that_close_with_the_temperature(self):
        """In the end the rock has the temperature of its side everywhere, and its closed pores hold what they held: phi(p, T) (1 + c (p − p_0)) stays."""
        text = closed("0.1*exp(p/(20 MPa))*(1 - (T - 300 K)/(500 K))", compressibility="4e-10").replace("source: 1e-6 1/s", "source: 0 1/s")
        text = text.replace("schedule: [{solve: pore}]", """  heat: {type: matrix_heat/tpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: 300 K, boundary: {left: {temperature: 350 K}}}
couplers: [{type: heat_advection, between: [pore, heat], fluid_heat_capacity: 4e6 J/(m^3*K)}]
schedule: [{solve: [pore, heat]}]""").replace("time: {end: 30000 s, step: 6000 s}", "time: {end: 1000 day, step: 100 day}")
        before = PORES * math.exp(3e6 / STIFFENS)
        known = root(lambda p: 0.9 * PORES * math.exp(p / STIFFENS) * (1 + 4e-10 * (p - 3e6)) - before, 0, 30e6)
        one = self.run_scene(self.write(text))
        split = self.run_scene(self.write(text), "schedule=[{iterate: {until: {relative: 1e-10, at_most: 60}, steps: [{solve: heat}, {solve: pore}]}}]")
        loose = self.run_scene(self.write(text), "schedule=[{solve: heat}, {solve: pore}]")
        for run in (one, split, loose):
            self.assertLess(abs(self.last(run, "p") / known - 1), 1e-6)  # what ten steps leave of the difference of temperatures
            self.assertLess(np.abs(run["fluid_stored[m^2]"]).max(), 1e-10 * 0.23)
        self.assertLess(self.largest_difference(split, one, ["p[Pa]"]), 1e-8)

    def test_a_wave_of_pressure(self):
        errors = {}
        for kind, mesh in (("tpfa", "{kind: structured, shape: quadrilaterals, cells: [N, 1]}"), ("mpfa", "{kind: structured, shape: triangles, cells: [N, ROWS]}")):
            for cells in (10, 20, 40):
                for scheme in ("sdirk2", "backward_euler")[: 2 if kind == "tpfa" else 1]:
                    run = self.run_scene(self.write(put(TRAVELLING, MESH=put(mesh, N=cells, ROWS=cells * 2 // 5), KIND=kind, STEP=5000 / cells, SCHEME=scheme)))
                    matrix = run.fields(kind="matrix")
                    exact = -SCALE * np.log1p(np.exp(-STEEP * (matrix.centres[:, 0] - SPEED * 4000)))
                    errors.setdefault((kind, scheme), []).append(np.abs(matrix["pore.pressure"] - exact).max() / SCALE)
        for (kind, scheme), some in errors.items():
            order = 1.8 if scheme == "sdirk2" else 0.85
            self.assertGreater(math.log2(some[-2] / some[-1]), order, msg=f"{kind} {scheme} {some}")
            self.assertLess(some[-1], 3e-3 if scheme == "sdirk2" else 2e-2, msg=f"{kind} {scheme} {some}")

    def test_a_turned_and_a_mirrored_wave(self):
        text = put(TRAVELLING, MESH="{size: 0.13 m}", KIND="mpfa", STEP=500, SCHEME="sdirk2").replace("output: {every: 4000 s}", "output: {probes: {p: {of: pore.pressure, take: smallest}}}")
        text = text.replace(WAVE, "(-1 - 3*t/4000) MPa").replace(WAVE.replace(f"{SPEED}*t", "0"), "-1 MPa")
        scene = self.write(text.replace(", right: {pressure: \"(-1 - 3*t/4000) MPa\"}", ""))
        one = self.last(self.run_scene(scene), "pore.left.outflow")
        for mirror in (False, True):
            self.assertLess(abs(self.last(self.run_scene(self.turned(scene, 35, mirror=mirror)), "pore.left.outflow") / one - 1), 1e-2)

    def test_pressed_rock(self):
        """Uniaxial strain e, fluid that stays: M e − alpha p = −load, phi(p, e) (1 + c p) = phi(0, 0)."""
        stiffness = 10e9 * 0.75 / (1.25 * 0.5)
        for formula, pores in (("0.2*exp(p/(1 GPa)) + 0.8*eps_v - 20*eps_v^2", lambda p, e: 0.2 * math.exp(p / 1e9) + 0.8 * e - 20 * e * e),
                               ("0.2*exp(4*eps_v)", lambda p, e: 0.2 * math.exp(4 * e))):
            known = root(lambda p, pores=pores: pores(p, (0.8 * p - 30e6) / stiffness) * (1 + 4e-10 * p) - 0.2, 0, 40e6)
            for kind, rock in (("mpfa", "mpsa"), ("tpfa", "fem")):
                scene = self.write(put(PRESSED, KIND=kind, ROCK=rock, FORMULA=formula))
                for settings in ((), ("time.scheme=sdirk2",), ("schedule=[{iterate: {fallback: none, until: {relative: 1e-11, at_most: 60}, steps: [{solve: pore, stabilize: fixed_stress}, {solve: rock}]}}]",)):
                    run = self.run_scene(scene, *settings)
                    self.assertLess(abs(self.last(run, "p") / known - 1), 1e-8, msg=(formula, kind, settings))
                    self.assertLess(np.abs(run["fluid_stored[m^2]"]).max(), 1e-10 * 0.4)

    def test_pressed_rock_in_space(self):
        stiffness = 10e9 * 0.75 / (1.25 * 0.5)
        known = root(lambda p: 0.2 * math.exp(4 * (0.8 * p - 30e6) / stiffness) * (1 + 4e-10 * p) - 0.2, 0, 40e6)
        text = put(PRESSED, KIND="mpfa", ROCK="fem", FORMULA="0.2*exp(4*eps_v)").replace("y: [0 m, 1 m]}", "y: [0 m, 1 m], z: [0 m, 1 m]}").replace("size: 0.5 m", "size: 0.8 m")
        text = text.replace("bottom: {displacement", "front: {displacement_normal: 0 m}, back: {displacement_normal: 0 m}, bottom: {displacement")
        self.assertLess(abs(self.last(self.run_scene(self.write(text)), "p") / known - 1), 1e-8)

    def fractured(self, *settings, formula=YIELDING, rate="3e-6", compressibility="4e-10", **more):
        return self.run_scene(self.write(formula_scenes.fractured((2, 0.6), rate, POROSITY=formula, COMPRESSIBILITY=compressibility)), *settings, **more)

    def test_a_constant_and_biots_terms_as_formulas(self):
        constant, formula = (self.run_scene(self.write(closed(text, compressibility="4e-10"))) for text in ("0.1", "max(0.1, p/(1e12 Pa))"))
        self.assertLess(self.largest_difference(formula, constant), 1e-11)
        # Without a compressibility the fluid's part of both is linear in pressure and strain.
        built_in, formula = (self.fractured(formula=text, compressibility="0") for text in ("0.1", OF_BIOT))
        self.assertLess(self.largest_difference(formula, built_in, [name for name in built_in.history if "seconds" not in name and "error" not in name and "iterations" not in name and name in formula.history]), 1e-8)

    def test_schedules_have_one_answer(self):
        whole = self.fractured()
        self.assert_conserved(whole)
        split = "schedule=[{iterate: {fallback: none, until: {relative: 1e-10, at_most: 200}, accelerate: {anderson: 5}, steps: [{solve: [pore, conduit], stabilize: STABILIZE}, {solve: [rock, contact]}]}}]"
        undrained = "schedule=[{iterate: {fallback: none, until: {relative: 1e-10, at_most: 200}, accelerate: {anderson: 5}, steps: [{solve: [rock, contact], stabilize: undrained}, {solve: [pore, conduit]}]}}]"
        for settings, tolerance in (((split.replace("STABILIZE", "fixed_stress"),), 1e-6), ((undrained,), 1e-6), (("solver.condense=false",), 1e-8)):
            with self.subTest(settings):
                run = self.fractured(*settings)
                self.assertLess(self.largest_difference(run, whole), tolerance)
                self.assert_conserved(run)
        self.assertLess(self.largest_difference(self.fractured(rate=f"{3e-6 * (1 + 1e-9)!r}"), whole), 1e-7)
        # And the formula matters.
        self.assertGreater(abs(self.last(self.fractured(formula=OF_BIOT), "p") / self.last(whole, "p") - 1), 1e-2)

    def test_substeps(self):
        """The flow takes substeps in each step of the rock, and no fluid is lost; two of them are nearer to steps of half the length."""
        def substeps(count):
            run = self.fractured(f"schedule=[{{iterate: {{until: {{relative: 1e-10, at_most: 100}}, steps: [{{subcycle: {{steps: [{{solve: [pore, conduit], stabilize: fixed_stress}}], count: {count}}}}}, {{solve: [rock, contact]}}]}}}}]")
            self.assert_conserved(run, 1e-9)
            return run

        whole, halved = self.last(self.fractured(), "p"), self.last(self.fractured("time.step=100 s"), "p")
        self.assertLess(abs(self.last(substeps(2), "p") - halved), 0.5 * abs(whole - halved))

    def test_a_loose_split_loses_no_fluid(self):
        self.assert_conserved(self.fractured("schedule=[{solve: [pore, conduit]}, {solve: [rock, contact]}]"))

    def test_a_restart_has_the_same_bits(self):
        whole = self.fractured()
        half = self.fractured("time.end=400 s")
        rest = self.fractured(restart=half.folder)
        self.assertEqual(self.largest_difference(rest, whole), 0)

    def test_second_order_beside_fractures(self):
        runs = [self.fractured("time.scheme=sdirk2", f"time.step={step} s", rate="3e-6*sin(pi*t/(1200 s))^2") for step in (200, 100, 50)]
        for run in runs:
            self.assert_conserved(run)
        for quantity in ("p", "u.x", "pore.left.outflow"):
            first, second, third = (self.last(run, quantity) for run in runs)
            self.assertGreater(math.log2(abs(first - second) / abs(second - third)), 1.8, msg=quantity)

    def test_growth_loses_no_fluid(self):
        """Across changes of the mesh, to round-off; with a little more than Biot's terms the wings are as long as with these terms, within 1 %."""
        formula = self.run_scene(WINGS, "time.end=9h", "materials.porosity=0.01 + 0.8*eps_v + p/(28.13 GPa) + 2*eps_v^2")
        self.assertLess(np.abs(formula["fluid_balance_error[m^2]"]).max(), 1e-12 * np.abs(formula["fluid_injected[m^2]"]).max())
        with_terms = self.run_scene(WINGS, "time.end=9h")
        self.assertLess(abs(self.last(formula, "tips.main_last.length") / self.last(with_terms, "tips.main_last.length") - 1), 1e-2)

    def test_a_start_that_is_settled(self):
        """Strains are counted from there, and so is what the pores hold: where nothing else happens, nothing moves."""
        run = self.fractured("start.settle=[pore, rock, conduit, contact]", "components.conduit.injection.well.rate=0 m^2/s")
        self.assertLess(np.abs(run["fluid_stored[m^2]"]).max(), 1e-12)

    def test_what_is_refused(self):
        pressed = put(PRESSED, KIND="mpfa", ROCK="mpsa")
        for text, message in ((closed(kind="rt0"), "is taken as 'porosity' by matrix_flow/mpfa, matrix_flow/tpfa"),
                              (closed("0.1*T/(300 K)"), "names 'T'"),
                              (closed("0.1*(1 + eps_v)"), "names 'eps_v'"),
                              (closed("if(p < 1 MPa, 0.1, 0.2)"), "jumps from"),
                              (closed("0.1 + p"), "has another unit"),
                              (closed("2 + p/(1 GPa)"), "'porosity' is 2.003"),
                              (closed("0.1*exp(-p/(20 MPa))"), "let 'porosity' not fall with p"),
                              (closed().replace("fluid_compressibility: 0 1/Pa", 'fluid_compressibility: "(1e-10*(1 + t/day)) 1/Pa"'), "'fluid_compressibility' depends on time"),
                              (put(pressed, FORMULA="0.1*exp(p/(20 MPa))"), "do not follow the volume of the rock"),
                              (put(pressed, FORMULA="0.1 + eps_v").replace("biot_coefficient: 0.8", "biot_coefficient: 0.8, one_way: true"), "'one_way' contradicts the porosity")):
            refused = self.call("check", self.write(text))
            self.assertEqual(refused.returncode, 2, msg=text)
            self.assertIn(message, refused.stderr)

    @on_two_processes
    def test_two_processes(self):
        one, two = (self.fractured(processes=processes) for processes in (1, 2))
        self.assertLess(self.largest_difference(two, one), 1e-7)


if __name__ == "__main__":
    unittest.main()
