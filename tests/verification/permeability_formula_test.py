#!/usr/bin/python3
"""permeability_formula_test.py SPREKK [MPIEXEC]: the permeability of rock as a formula of the state.

- Closed forms: steady flow with k = k0 exp(g p) by Kirchhoff's transform, through unlike layers, with orders; turned and mirrored; a column whose strain is known.
- Transient flow against finite volumes in NumPy. Second order in time with sdirk2.
- One answer in every schedule, with and without condensing, by both programs, on two processes; a restart has the same bits; a constant formula the answer of the constant.
- What is refused."""

import math
import unittest

import numpy as np

import formula_scenes
from formula_scenes import put
from scene_runs import SceneRuns, on_two_processes

K, MU, LENGTH, HEIGHT, HIGH = 1e-15, 1e-3, 1.0, 0.4, 3e6  # m^2, Pa s, m, m, Pa
GAMMA = 1 / 2e6
EXPONENTIAL = "exp(p/(2 MPa))"

COLUMN = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 0.4 m]}}
mesh: MESH
components:
  pore:
    type: matrix_flow/KIND
    permeability: "FORMULA"
    viscosity: 1 mPa*s
    storage: STORAGE
    boundary: {left: {pressure: 3 MPa}, right: {pressure: 0 MPa}}
schedule: [{solve: pore}]
time: {end: 2000 s, step: 1000 s}
output: {every: 2000 s}
"""
SQUARES = "{kind: structured, shape: quadrilaterals, cells: [N, 2]}"
# An oedometer: the rock is pressed from above between smooth walls.
PRESSED = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.25 m}
components:
  pore:
    type: matrix_flow/KIND
    permeability: "FORMULA"
    viscosity: 1 mPa*s
    storage: 0 1/Pa
    boundary: {left: {pressure: 1 MPa}, right: {pressure: 0 MPa}}
  rock:
    type: poromechanics/ROCK
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    boundary: {left: {displacement_normal: 0 m}, right: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, top: {normal_stress: -3 MPa}}
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0}]
schedule: [{solve: [pore, rock]}]
time: {end: 2 s, step: 1 s}
output: {fields: false}
"""
STRAINED = "1e-15 m^2*(1 + 0.5*tanh(eps_v/(0.05e-3)) + 0.5*tanh(p/(2 MPa)))"



def column(formula=f"1e-15 m^2*{EXPONENTIAL}", kind="mpfa", mesh=None, cells=10, storage="0 1/Pa"):
    return put(COLUMN, MESH=put(mesh or SQUARES, N=cells, ROWS=int(cells) * 2 // 5), KIND=kind, FORMULA=formula, STORAGE=storage)


def potential(pressure):
    """Kirchhoff's: the integral of k/k0 from p = 0."""
    return np.expm1(GAMMA * pressure) / GAMMA


class PermeabilityFormula(SceneRuns):
    def outflow(self, run, side="right"):
        return run.history[f"pore.{side}.outflow[m^2/s]"][-1]

    def test_steady_flow_has_the_flux_and_pressure_of_kirchhoffs_transform(self):
        """k = k0 exp(g p): the potential is linear; the flux is k0/(mu L) times its drop. Of second order on both meshes."""
        known = HEIGHT * K / (MU * LENGTH) * potential(HIGH)
        for kind, mesh in (("tpfa", SQUARES), ("mpfa", SQUARES), ("mpfa", "{kind: structured, shape: triangles, cells: [N, ROWS]}")):
            errors = []
            for cells in (10, 20, 40):
                run = self.run_scene(self.write(column(kind=kind, mesh=mesh, cells=cells)))
                matrix = run.fields(kind="matrix")
                exact = np.log1p(GAMMA * potential(HIGH) * (1 - matrix.centres[:, 0] / LENGTH)) / GAMMA
                errors.append((abs(self.outflow(run) / known - 1), np.abs(matrix["pore.pressure"] - exact).max() / HIGH))
                self.assertLess(abs(self.outflow(run) + self.outflow(run, "left")), 1e-9 * known)
            for of_flux_or_pressure, largest, order in ((0, 2e-2, 1.8), (1, 3e-2, 1.7)):
                some = [error[of_flux_or_pressure] for error in errors]
                self.assertLess(some[0], largest, msg=f"{kind} {mesh}")
                self.assertGreater(math.log2(some[1] / some[2]), order, msg=f"{kind} {mesh} {some}")

    def test_unlike_layers_conduct_as_their_harmonic_mean(self):
        """k = k_i exp(g p): the potential of Kirchhoff is continuous, so that the layers are resistances in series."""
        layers = f"if(x < 0.4 m, 1e-15 m^2, 7e-15 m^2)*{EXPONENTIAL}"
        known = HEIGHT * potential(HIGH) / MU / (0.4 / 1e-15 + 0.6 / 7e-15)
        errors = [abs(self.outflow(self.run_scene(self.write(column(layers, cells=cells)))) / known - 1) for cells in (10, 20, 40)]
        self.assertLess(errors[-1], 2e-3)
        self.assertGreater(math.log2(errors[-2] / errors[-1]), 1.7, msg=errors)

    def test_turned_and_mirrored_columns_conduct_alike(self):
        scene = self.write(column(mesh="{size: 0.13 m}"))
        one = self.outflow(self.run_scene(scene))
        for mirror in (False, True):
            turned = self.run_scene(self.turned(scene, 35, mirror=mirror))
            self.assertLess(abs(self.outflow(turned) / one - 1), 1e-2)

    def test_transient_flow_is_that_of_finite_volumes(self):
        """Two-point fluxes with harmonic means of the permeabilities of cells, at the end of each step: by another program, to what Newton leaves."""
        cells, storage, step = 20, 1e-9, 1000.0
        h = LENGTH / cells
        p = np.zeros(cells)
        for _ in range(2):
            old, change = p.copy(), 1.0
            for _ in range(500):
                k = K * np.exp(GAMMA * p)
                inner = 2 * k[1:] * k[:-1] / (k[1:] + k[:-1]) / (MU * h)
                ends = 2 * k[[0, -1]] / (MU * h)
                rows = np.diag(np.full(cells, storage * h / step))
                for i, t in enumerate(inner):
                    rows[[i, i + 1], [i, i + 1]] += t
                    rows[[i, i + 1], [i + 1, i]] -= t
                rows[0, 0] += ends[0]
                rows[-1, -1] += ends[1]
                right = storage * h / step * old
                right[0] += ends[0] * HIGH
                new = np.linalg.solve(rows, right)
                change, p = np.abs(new - p).max(), new
                if change < 1e-9 * HIGH * 1e-4:
                    break
            self.assertLess(change, 1e-6)
        run = self.run_scene(self.write(column(kind="tpfa", cells=f"{cells}", storage="1e-9 1/Pa").replace(f"[{cells}, 2]", f"[{cells}, 1]")))
        found = np.sort(np.asarray(run.fields(kind="matrix")["pore.pressure"]))[::-1]
        self.assertLess(np.abs(found - p).max(), 1e-8 * HIGH)

    def test_second_order_in_time(self):
        text = column(kind="tpfa", storage="1e-9 1/Pa").replace("pressure: 3 MPa", 'pressure: "(3*sin(pi*t/(4000 s))^2) MPa"')
        for scheme, order in (("backward_euler", 1), ("sdirk2", 2)):
            values = []
            for step in (100, 50, 25):
                run = self.run_scene(self.write(text), f"time.scheme={scheme}", f"time.step={step} s")
                values.append(np.asarray(run.fields(kind="matrix")["pore.pressure"]))
            first, second = (np.abs(a - b).max() for a, b in zip(values, values[1:]))
            self.assertAlmostEqual(math.log2(first / second), order, delta=0.2, msg=scheme)

    def test_a_column_of_known_strain(self):
        """eps_v = sigma/(lambda + 2 G) everywhere: exact on any mesh."""
        strain = -3e6 / (10e9 * 0.75 / (1.25 * 0.5))
        known = K / MU * (1 + strain / 1e-3) ** 3 * 1e6 / 2
        for kind in ("mpfa", "tpfa"):
            for rock in ("mpsa", "fem"):
                mesh = "{size: 0.25 m}" if kind == "mpfa" else "{kind: structured, shape: quadrilaterals, cells: [6, 3]}"
                run = self.run_scene(self.write(put(PRESSED, KIND=kind, ROCK=rock, FORMULA="1e-15 m^2*(1 + eps_v/1e-3)^3").replace("{size: 0.25 m}", mesh)))
                self.assertLess(abs(self.outflow(run) / known - 1), 1e-9, msg=(kind, rock))

    def test_a_formula_that_is_constant(self):
        for kind in ("mpfa", "tpfa"):
            mesh = "{size: 0.13 m}"
            constant, formula = (self.run_scene(self.write(column(text, kind, mesh, storage="1e-9 1/Pa"))) for text in ("3e-15 m^2", "3e-15 m^2*max(1, p/(1e9 Pa))"))
            self.assertLess(self.largest_difference(formula, constant), 1e-12)

    def fractured(self, *settings, formula=STRAINED, rate="3e-6", **more):
        return self.run_scene(self.write(formula_scenes.fractured((1.8, 0.5), rate, PERMEABILITY=formula)), *settings, **more)

    def test_schedules_have_one_answer(self):
        whole = self.fractured()
        split = "schedule=[{iterate: {fallback: none, until: {relative: 1e-10, at_most: 200}, accelerate: {anderson: 5}, steps: [{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}]}}]"
        for settings, tolerance in (((split,), 1e-6), (("solver.condense=false",), 1e-8)):
            with self.subTest(settings):
                self.assertLess(self.largest_difference(self.fractured(*settings), whole), tolerance)
        self.assertLess(self.largest_difference(self.fractured(rate=f"{3e-6 * (1 + 1e-9)!r}"), whole), 1e-7)
        # And the formula matters.
        self.assertGreater(self.largest_difference(self.fractured(formula="1e-15 m^2"), whole), 1e-2)

    def test_substeps(self):
        """The flow takes two substeps in each step of the rock. One substep is the answer above, but for what it differs by with a permeability of any kind."""
        def substeps(count, formula=STRAINED):
            return self.fractured(f"schedule=[{{iterate: {{until: {{relative: 1e-10, at_most: 100}}, steps: [{{subcycle: {{steps: [{{solve: [pore, conduit], stabilize: fixed_stress}}], count: {count}}}}}, {{solve: [rock, contact]}}]}}}}]", formula=formula)

        whole = self.fractured()
        of_constant = self.largest_difference(substeps(1, "1e-15 m^2"), self.fractured(formula="1e-15 m^2"))
        self.assertLess(self.largest_difference(substeps(1), whole), of_constant + 1e-6)
        halved = self.last(self.fractured("time.step=100 s"), "p")
        self.assertLess(abs(self.last(substeps(2), "p") - halved), 0.5 * abs(self.last(whole, "p") - halved))

    @staticmethod
    def last(run, quantity):
        return next(values[-1] for name, values in run.history.items() if name.split("[")[0] == quantity)

    def test_a_restart_has_the_same_bits(self):
        whole = self.fractured()
        half = self.fractured("time.end=400 s")
        rest = self.fractured(restart=half.folder)
        self.assertEqual(self.largest_difference(rest, whole), 0)

    def test_second_order_beside_fractures(self):
        runs = [self.fractured("time.scheme=sdirk2", f"time.step={step} s", rate="3e-6*sin(pi*t/(1200 s))^2") for step in (200, 100, 50)]
        for quantity in ("p", "u.x", "pore.left.outflow"):
            first, second, third = (self.last(run, quantity) for run in runs)
            self.assertGreater(math.log2(abs(first - second) / abs(second - third)), 1.8, msg=quantity)

    def test_a_leaky_side(self):
        """What flows to the side leaks out of it: k0/(mu L) (F(p_high) − F(p)) = C p for the pressure p at the side."""
        conductance = 2e-12
        low, high = 0.0, HIGH
        for _ in range(100):
            p = (low + high) / 2
            low, high = (p, high) if K / (MU * LENGTH) * (potential(HIGH) - potential(p)) > conductance * p else (low, p)
        text = column(cells=40).replace("right: {pressure: 0 MPa}", f"right: {{outer_pressure: 0 Pa, conductance: {conductance} m/(Pa*s)}}")
        for kind in ("mpfa", "tpfa"):
            self.assertLess(abs(self.outflow(self.run_scene(self.write(text.replace("/mpfa", f"/{kind}")))) / (HEIGHT * conductance * p) - 1), 1e-3)

    def test_a_formula_of_the_temperature(self):
        """Of rock at 350 K everywhere."""
        text = column("1e-15 m^2*(T/(300 K))^2").replace("schedule: [{solve: pore}]", """  heat: {type: matrix_heat/tpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: 350 K, boundary: {left: {temperature: 350 K}}}
couplers: [{type: heat_advection, between: [pore, heat], fluid_heat_capacity: 4e6 J/(m^3*K)}]
schedule: [{solve: [pore, heat]}]""")
        run = self.run_scene(self.write(text))
        self.assertLess(abs(self.outflow(run) / (HEIGHT * K / MU * (350 / 300) ** 2 * HIGH / LENGTH) - 1), 1e-9)

    def test_a_settled_rock_is_the_one_from_which_its_strain_counts(self):
        # The weight of the rock strains it while it settles; the permeability afterwards, and the pressure that rests, are those without strain.
        scene = self.write("""
geometry: {box: {x: [0 m, 20 m], y: [0 m, 30 m]}}
mesh: {size: 10 m}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-15 m^2*exp(eps_v/2e-5)
    viscosity: 1 mPa*s
    storage: 1e-10 1/Pa
    initial_pressure: 1 MPa
    boundary: {top: {pressure: 1 MPa}, bottom: {pressure: 2 MPa}}
  rock:
    type: poromechanics/mpsa
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    rock_density: 2500 kg/m^3
    gravity: [0 m/s^2, -9.81 m/s^2]
    boundary: {left: {displacement_x: 0 m}, right: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}}
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0}]
schedule: [{solve: [pore, rock]}]
time: {end: 10 day, step: 1 day}
start: {settle: [pore, rock]}
output: {fields: false, probes: {p: {of: pore.pressure, at: [9 m, 16 m]}, u: {of: rock.displacement, at: [9 m, 29 m]}}}
""")
        for settings in ((), ("mesh.size=5 m",), ("components.rock.type=poromechanics/fem", "components.rock.order=second"),
                         ("couplers.0.biot_coefficient=0.8",)):
            run = self.run_scene(scene, *settings)
            self.assertLess(np.abs(run["p[Pa]"] / (1e6 + 1e6 * 14 / 30) - 1).max(), 1e-9, settings)
            self.assertLess(np.abs(run["u.y[m]"]).max(), 1e-12, settings)

    def test_what_is_refused(self):
        for changes, message in (((("mpfa", "rt0"),), "unknown name in the expression"),
                                 (((EXPONENTIAL, "T/(300 K)"),), "names 'T'"),
                                 (((EXPONENTIAL, "(p/(1 MPa))"),), "keep it above 0"),
                                 (((EXPONENTIAL, "if(p < 1 MPa, 1, 2)"),), "jumps from"),
                                 (((EXPONENTIAL, "(1 + p)"),), "has another unit"),
                                 (((f'"1e-15 m^2*{EXPONENTIAL}"', f'{{xx: "1e-15 m^2*{EXPONENTIAL}", yy: 1e-15 m^2, xy: 1e-16 m^2}}'),), "beside its diagonal"),
                                 ((("geometry: {", "geometry: {regions: {half: {polygon: [[0 m, 0 m], [0.5 m, 0 m], [0.5 m, 0.4 m], [0 m, 0.4 m]]}}, "), ("viscosity:", "regions: [half]\n    viscosity:"),
                                   (", right: {pressure: 0 MPa}", "")), "a flow in some 'regions'")):
            text = column()
            for old, new in changes:
                self.assertIn(old, text)
                text = text.replace(old, new)
            refused = self.call("check", self.write(text))
            self.assertEqual(refused.returncode, 2, msg=text)
            self.assertIn(message, refused.stderr)

    def test_in_space(self):
        """A column of known strain, in tetrahedra."""
        strain = -3e6 / (10e9 * 0.75 / (1.25 * 0.5))
        known = K / MU * (1 + strain / 1e-3) ** 3 * 1e6 / 2
        text = put(PRESSED, KIND="mpfa", ROCK="fem", FORMULA="1e-15 m^2*(1 + eps_v/1e-3)^3").replace("y: [0 m, 1 m]}", "y: [0 m, 1 m], z: [0 m, 1 m]}").replace("size: 0.25 m", "size: 0.6 m")
        text = text.replace("bottom: {displacement", "front: {displacement_normal: 0 m}, back: {displacement_normal: 0 m}, bottom: {displacement")
        run = self.run_scene(self.write(text))
        outflow = next(values[-1] for name, values in run.history.items() if name.startswith("pore.right.outflow"))
        self.assertLess(abs(outflow / known - 1), 1e-9)

    @on_two_processes
    def test_two_processes(self):
        one, two = (self.fractured(processes=processes) for processes in (1, 2))
        self.assertLess(self.largest_difference(two, one), 1e-7)


if __name__ == "__main__":
    unittest.main()
