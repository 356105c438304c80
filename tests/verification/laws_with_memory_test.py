#!/usr/bin/python3
"""laws_with_memory_test.py SPREKK [MPIEXEC]: formulas that name what is remembered of the state (`history`).

- Slip weakening by a sum over slip is that of `weakening`, to round-off; by a sum of work, a closed form.
- A joint that unloads along another line, and one that creeps (orders in time); pores and permeabilities that stay open. Closed forms.
- Restarts, substeps, other runs, two processes, turned, mirrored, in space; what is refused."""

import math
import unittest

import numpy as np
from formula_scenes import fractured, put
from scene_runs import ROOT, SceneRuns, on_two_processes

SHEARED = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 2 m]}, fractures: {f: {points: [[0 m, 1 m], [4 m, 1 m]]}}}
mesh: {size: 1 m}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 10 GPa
    poisson_ratio: 0
    boundary: {bottom: {displacement: [0 m, 0 m]}, top: {displacement: ["(MOTION) m", -1 mm]}, left: {displacement_y: "(-5e-4*y) m"}, right: {displacement_y: "(-5e-4*y) m"}}
  contact: {type: contact/coulomb, LAW}
couplers: [{type: wall_traction, between: [rock, contact]}]
schedule: [{solve: [rock, contact]}]
time: {end: 400 s, step: 50 s}
output: {fields: false, probes: {traction: {of: contact.traction, at: [2 m, 1 m]}, jump: {of: contact.jump, at: [2 m, 1 m]}}}
"""
FORTH, BACK_TOO = "1e-5*t", "3e-3*sin(2*pi*t/400)"
BUILT_IN = "friction: 0.6, weakening: {distance: 5 mm, friction: 0.3}"
REMEMBERED = 'history: {slid: {sum: "1", over: slip}}, friction: "0.6 - 0.3*min(1, slid/(5 mm))"'
WORN = 'history: {work: {sum: "sigma_n", over: slip}}, friction: "0.6 - 0.3*min(1, work/(25 MPa*mm))"'
# A block on a joint under a load that is given.
PRESSED = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 2 m]}, fractures: {f: {points: [[0 m, 1 m], [4 m, 1 m]]}}}
mesh: {size: 1 m}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 10 GPa
    poisson_ratio: 0
    boundary: {bottom: {displacement: [0 m, 0 m]}, top: {normal_stress: "(-LOAD) MPa"}, left: {displacement_x: 0 m}, right: {displacement_x: 0 m}}
  contact: {type: contact/coulomb, friction: 0.6, history: {HISTORY}, closure: {law: formula, closure: "CLOSURE"}}
couplers: [{type: wall_traction, between: [rock, contact]}]
schedule: [{solve: [rock, contact]}]
time: {end: 400 s, step: 25 s}
output: {fields: false, probes: {traction: {of: contact.traction, at: [2 m, 1 m]}, jump: {of: contact.jump, at: [2 m, 1 m]}}}
"""
CYCLE = "10*(1 - abs(1 - t/(200 s)))"  # MPa: to 10 and back
HYSTERETIC = {"LOAD": CYCLE, "HISTORY": 'tightest: {largest: "sigma_n"}', "CLOSURE": "sigma_n/(200 GPa/m) + tightest/(50 GPa/m)"}
CREEPING = {"LOAD": "10*sin(pi*t/400)", "HISTORY": 'crept: {sum: "sigma_n"}', "CLOSURE": "sigma_n/(200 GPa/m) + crept/(1e13 Pa*s/m)"}
# Rock or a fracture whose ends have the same pressure, up to 5 MPa and down, and in the end no longer.
ENDS = "(if(t < 250 s, 5*t/(250 s), if(t < 350 s, 5 - 4*(t - 250 s)/(100 s), LAST))) MPa"
COLUMN = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 1 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [4, 1]}
components:
  pore:
    {type: matrix_flow/KIND, permeability: "1e-15 m^2*(1 + highest/(1 MPa))", history: {highest: {largest: "p"}}, viscosity: 1 mPa*s, storage: 0 1/Pa,
     boundary: {left: {pressure: "LEFT"}, right: {pressure: "RIGHT"}}}
schedule: [{solve: pore}]
time: {end: 400 s, step: 50 s}
output: {fields: false, probes: {highest: {of: pore.highest, take: smallest}}}
"""
PIPE = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 2 m]}, fractures: {f: {points: [[0 m, 1 m], [4 m, 1 m]]}}}
mesh: {size: 1 m}
components:
  conduit:
    {type: fracture_flow/tpfa, viscosity: 1 mPa*s, initial_aperture: 0.1 mm, fluid_compressibility: 1e-14 1/Pa, history: {highest: {largest: "p"}},
     transmissivity: "1e-14 m^3*(1 + highest/(1 MPa))", boundary: {left: {pressure: "LEFT"}, right: {pressure: "RIGHT"}}}
schedule: [{solve: conduit}]
time: {end: 400 s, step: 50 s}
output: {fields: false, probes: {highest: {of: conduit.highest, take: smallest}}}
"""
# Closed rock into which fluid comes, and from which half of it is taken.
CLOSED = """
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.5 m}
components:
  pore:
    {type: matrix_flow/mpfa, permeability: 1e-15 m^2, viscosity: 1 mPa*s, fluid_compressibility: 0 1/Pa, initial_pressure: 3 MPa, POROSITY,
     source: [{value: 1e-6 1/s, to: 10000 s}, {value: -0.5e-6 1/s, from: 10000 s}]}
schedule: [{solve: pore}]
time: {end: 20000 s, step: 2500 s}
output: {fields: false, probes: {p: {of: pore.pressure, take: largest}, lowest: {of: pore.pressure, take: smallest}}}
"""
OPENED = 'history: {highest: {largest: "p"}}, porosity: "0.1 + p/(1 GPa) + highest/(1 GPa)"'


class LawsWithMemory(SceneRuns):
    def sheared(self, law, *settings, motion=FORTH, **more):
        return self.run_scene(self.write(put(SHEARED, MOTION=motion, LAW=law)), *settings, **more)

    def pressed(self, words, *settings, **more):
        return self.run_scene(self.write(put(PRESSED, **words)), *settings, **more)

    def test_slip_weakening_as_it_is_built_in(self):
        substeps = "schedule=[{subcycle: {count: 3, steps: [{solve: [rock, contact]}]}}]"
        for motion in (FORTH, BACK_TOO):
            for settings in ((), ("time.scheme=sdirk2",), (substeps,), ("components.contact.type=contact/augmented_lagrangian",), ("solver.condense=false",)):
                with self.subTest(motion=motion, settings=settings):
                    built_in, ours = (self.sheared(law, *settings, motion=motion) for law in (BUILT_IN, REMEMBERED))
                    self.assertLess(self.largest_difference(ours, built_in, ["traction.n[Pa]", "traction.t[Pa]", "jump.t[m]"]), 1e-11)
                    self.assertLessEqual(abs(ours["iterations"].sum() - built_in["iterations"].sum()), 1)  # where round-off ends one
                    self.assertGreater(np.abs(built_in["jump.t[m]"]).max(), 1e-3)

    def test_friction_that_falls_with_work(self):
        """G (U − s)/H = (0.6 − 0.3 w/W) sigma with w = sigma s: a uniform state, which any steps meet; a part 1e-9 more is 1e-9 or so more."""
        sigma, shear = 5e6, 5e9 / 2
        motion = 1e-5 * np.arange(50, 401, 50)
        known = np.maximum(0, (shear * motion - 0.6 * sigma) / (shear - 0.3 * sigma * sigma / 25e3))
        for settings in ((), ("time.step=400 s",), ("components.rock.type=poromechanics/fem",)):
            run = self.sheared(WORN, *settings)
            self.assertLess(np.abs(np.abs(run["jump.t[m]"]) - known[-len(run.times):]).max(), 1e-9 * known[-1], msg=settings)
        more = self.sheared(WORN.replace("25 MPa", f"{25 * (1 + 1e-9)!r} MPa"))
        self.assertLess(abs(more["jump.t[m]"][-1] / run["jump.t[m]"][-1] - 1), 1e-7)

    def test_a_joint_unloads_along_another_line(self):
        for settings in ((), ("components.rock.type=poromechanics/fem",), ("time.step=50 s", "time.scheme=sdirk2"), ("components.contact.type=contact/augmented_lagrangian",)):
            run = self.pressed(HYSTERETIC, "time.end=350 s", *settings)  # without a load, the upper half would be held by nothing
            pressure = 10e6 * (1 - np.abs(1 - run.times / 200))
            np.testing.assert_allclose(-run["traction.n[Pa]"], pressure, atol=1e-2)
            closure = pressure / 200e9 + np.maximum.accumulate(pressure) / 50e9
            np.testing.assert_allclose(-run["jump.n[m]"], closure, rtol=0, atol=1e-9 * closure.max(), err_msg=str(settings))
            load, closed = (np.concatenate(([0], values, [end])) for values, end in ((-run["traction.n[Pa]"], 0), (-run["jump.n[m]"], 10e6 / 50e9)))
            work = ((load[1:] + load[:-1]) / 2 * np.diff(closed)).sum()
            self.assertLess(abs(work / (0.5 * 10e6**2 / 50e9) - 1), 1e-8)

    def test_a_joint_that_creeps(self):
        """c = sigma/k + the integral of sigma over the viscosity, to first order, and with two stages to second."""
        known = 10e6 * 2 * 400 / math.pi / 1e13
        for scheme, order in (("backward_euler", 1), ("sdirk2", 2)):
            errors = [abs(-self.pressed(CREEPING, f"time.scheme={scheme}", f"time.step={step} s")["jump.n[m]"][-1] / known - 1) for step in (100, 50, 25)]
            # (The rectangles of a whole half-wave are those of the trapezoidal rule: second order, too.)
            self.assertGreater(math.log2(errors[1] / errors[2]), 1.9, msg=(scheme, errors))
            half = {"LOAD": "10*t/(400 s)", **{key: CREEPING[key] for key in ("HISTORY", "CLOSURE")}}
            errors = [abs(-self.pressed(half, f"time.scheme={scheme}", f"time.step={step} s")["jump.n[m]"][-1] - 10e6 / 200e9 - 10e6 * 200 / 1e13) / (10e6 * 200 / 1e13) for step in (100, 50)]
            if order == 1:
                self.assertLess(abs(errors[0] - 1 / 4), 1e-8)
                self.assertLess(abs(errors[1] - 1 / 8), 1e-8)
            else:
                self.assertLess(max(errors), 1e-8)

    def test_permeability_that_stays_at_its_largest(self):
        left, right = ENDS.replace("LAST", "1"), ENDS.replace("LAST", "0")
        for text, path, known in ((COLUMN, "pore", 1e-15 * 6 / 4 * 1e9), (put(COLUMN, KIND="tpfa"), "pore", 1e-15 * 6 / 4 * 1e9), (PIPE, "conduit", 1e-14 * 6 / 4 * 1e9)):
            for first, second, side in ((left, right, "right"), (right, left, "left")):
                run = self.run_scene(self.write(put(text, KIND="mpfa", LEFT=first, RIGHT=second)))
                outflow = next(values for name, values in run.history.items() if name.startswith(f"{path}.{side}.outflow"))
                self.assertLess(abs(outflow[-1] / known - 1), 1e-7, msg=path)
                np.testing.assert_allclose(run["highest[Pa]"], 5e6 * np.minimum(1, run.times / 250), rtol=1e-8)

    def test_pores_that_stay_open(self):
        """phi = 0.1 + (p + highest)/G: 2/G while p rises, 1/G when it falls, and the balance closes."""
        for settings in ((), ("time.step=5000 s",), ("time.scheme=sdirk2",), ("schedule=[{subcycle: {count: 3, steps: [{solve: pore}]}}]",)):
            run = self.run_scene(self.write(put(CLOSED, POROSITY=OPENED)), *settings)
            for probe in ("p", "lowest"):
                pressure = run[f"{probe}[Pa]"]
                self.assertLess(abs(pressure.max() / (3e6 + 5e6) - 1), 1e-9)
                self.assertLess(abs(pressure[-1] / 3e6 - 1), 1e-9)
            self.assertLess(np.abs(run["fluid_balance_error[m^2]"]).max(), 1e-10 * 0.02)

    def test_a_start_value(self):
        """Rock that has had 10 MPa before: its pores do not open again below that."""
        run = self.run_scene(self.write(put(CLOSED, POROSITY=OPENED.replace('"p"}', '"p", start: 10 MPa}'))))
        self.assertLess(abs(run["p[Pa]"].max() / (10e6 + 1.5e6) - 1), 1e-9)

    def test_smallest(self):
        ends = "(if(t < 200 s, 3 - t/(100 s), 1 + (t - 200 s)/(100 s))) MPa"
        text = put(COLUMN, KIND="mpfa", LEFT=ends, RIGHT=ends).replace("largest", "smallest").replace("storage: 0 1/Pa", "initial_pressure: 3 MPa, storage: 0 1/Pa")
        np.testing.assert_allclose(self.run_scene(self.write(text))["highest[Pa]"], 1e4 * np.maximum(100, 300 - 50 * np.arange(1, 9)), rtol=1e-9)

    def acting(self, *settings, **more):
        """All that acts on rock, its fluid and a fracture, with memory in each of them."""
        text = fractured((2, 0.6), "3e-6*sin(pi*t/400)", PERMEABILITY="1e-15 m^2*(1 + highest/(2 MPa))", POROSITY="0.1 + 0.8*eps_v + p/(24 GPa) + highest/(100 GPa)")
        text = text.replace("viscosity: 1 mPa*s\n    porosity", 'history: {highest: {largest: "p"}}\n    viscosity: 1 mPa*s\n    porosity')
        text = text.replace("xy: 1 MPa", "xy: -7 MPa")  # it slides
        text = text.replace("initial_aperture: 0.2 mm", 'initial_aperture: 0.2 mm\n    history: {widest: {largest: "a"}}\n    transmissivity: "(a^3 + widest^3)/24"')
        text = text.replace("{type: contact/coulomb, friction: 0.6, closure: {law: linear, stiffness: 100 GPa/m}}",
                            '{type: contact/coulomb, history: {tightest: {largest: "sigma_n"}, slid: {sum: "1", over: slip}}, friction: "0.6 - 0.1*min(1, slid/(1 mm))", '
                            'closure: {law: formula, closure: "sigma_n/(200 GPa/m) + tightest/(200 GPa/m)"}}')
        text = text.replace("probes: {p:", "probes: {highest: {of: pore.highest, take: largest}, widest: {of: conduit.widest, take: largest}, slid: {of: contact.slid, take: largest}, "
                            "tightest: {of: contact.tightest, take: largest}, p:")
        return self.run_scene(self.write(text), *settings, **more)

    def test_one_answer_in_all_schedules(self):
        whole = self.acting()
        self.assertGreater(whole["slid[m]"][-1], 1e-6)
        self.assertLess(np.abs(whole["fluid_balance_error[m^2]"]).max(), 1e-10 * np.abs(whole["fluid_injected[m^2]"]).max())
        split = "schedule=[{iterate: {fallback: none, until: {relative: 1e-10, at_most: 200}, accelerate: {anderson: 5}, steps: [{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}]}}]"
        for settings in ((split,), ("solver.condense=false",)):
            self.assertLess(self.largest_difference(self.acting(*settings), whole), 1e-6, msg=settings)
        half = self.acting("time.end=400 s")
        self.assertLess(self.largest_difference(self.acting(restart=half.folder), whole), 1e-14)
        twin = self.acting("components.conduit.injection.well.rate=(3.000000003e-6*sin(pi*t/400)) m^2/s")
        self.assertLess(self.largest_difference(twin, whole), 1e-6)

    @on_two_processes
    def test_two_processes(self):
        self.assertLess(self.largest_difference(self.acting(processes=2), self.acting()), 1e-7)

    def test_a_run_goes_on_from_another(self):
        first = self.pressed(HYSTERETIC, "time.end=300 s")
        words = {**HYSTERETIC, "LOAD": "5"}
        then = self.pressed(words, f"start.from={first.folder}")
        np.testing.assert_allclose(-then["jump.n[m]"], 5e6 / 200e9 + 10e6 / 50e9, rtol=1e-9)

    def test_extremes_begin_at_the_start(self):
        """Of a constant pressure times 1 - t/1000 s the largest is that at 0 s, whatever the steps; of 1 + t/1000 s the smallest."""
        scene = """
geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}
mesh: {size: 1 m}
components:
  pore: {type: matrix_flow/tpfa, permeability: "1e-15*m^2*(1 + extreme/(1e12*Pa))", viscosity: 1 mPa*s, storage: 1e-10 1/Pa, initial_pressure: 4 MPa, history: {extreme: {RECALL}}}
schedule: [{solve: pore}]
time: {end: 400 s, step: STEP s}
output: {fields: false, probes: {extreme: {of: pore.extreme, take: mean}}}
"""
        for recall in ('largest: "p*(1 - t/(1000 s))"', 'smallest: "p*(1 + t/(1000 s))"'):
            for step in ("100", "400"):
                run = self.run_scene(self.write(put(scene, RECALL=recall, STEP=step)))
                np.testing.assert_allclose(run["extreme"], 4e6, rtol=1e-12)

    def test_extremes_in_cells_that_have_grown_begin_with_the_state_there(self):
        """The least pressure of new cells is one that they have had, and not that with which fractures begin; that of old cells is."""
        for update in ("within_step", "after_step"):
            run = self.run_scene(ROOT / "configs/paper/wing_cracks.yaml", "time.end=3h", f"schedule.1.update={update}", "components.conduit.initial_pressure=5 MPa",
                                 'components.conduit.history={least: {smallest: "p"}}', "components.conduit.transmissivity=a^3/12*(1 + 0*least/Pa)",
                                 *(f"output.probes.{probe}={{of: conduit.{field}, take: {take}}}" for probe, field, take in (("old", "least", "smallest"), ("new", "least", "largest"), ("p", "pressure", "smallest"))))
            np.testing.assert_allclose(run["old"], 5e6, rtol=1e-12)
            grown = run["new"] > 5.1e6
            self.assertGreater(grown.sum(), 2, update)
            # The pressure hardly differs along the fracture; growth after steps lowers it by 3 %.
            self.assertGreater(run["new"][-1], 0.95 * run["p"][np.argmax(grown) - 1], update)
            self.assertLess(run["new"][-1], run["p"][-1], update)

    def test_another_memory_of_the_same_name_is_refused(self):
        first = self.pressed(HYSTERETIC, "time.end=300 s")
        changed = self.call("check", self.write(put(PRESSED, **HYSTERETIC).replace("largest:", "smallest:")), f"start.from={first.folder}")
        self.assertEqual(changed.returncode, 2, changed.stderr)
        self.assertIn("its values come from there", changed.stderr)

    def test_a_start_that_is_settled(self):
        """Memory begins with the state that has been found, not with the way to it."""
        run = self.pressed({**HYSTERETIC, "LOAD": "(8 - 4*t/(400 s))"}, "start.settle=[rock, contact]")
        np.testing.assert_allclose(-run["jump.n[m]"], 1e6 * (8 - run.times / 100) / 200e9 + 8e6 / 50e9, rtol=1e-9)

    def test_memory_goes_on_where_a_mesh_grows(self):
        """The slip of walls that touch is their path, on one mesh and the next, also that while the state is found anew; new cells begin with none."""
        run = self.run_scene(ROOT / "configs/paper/wing_cracks.yaml", "time.end=5h", 'components.contact.history={slid: {sum: "1", over: slip}}', "components.contact.friction=0.5 + 0*slid/m + 0*path/m",
                             "output.probes.slid={of: contact.slid, at: [1 m, 1 m]}", "output.probes.path={of: contact.path, at: [1 m, 1 m]}", "output.probes.new={of: contact.slid, take: smallest}")
        self.assertGreater(run["tips.main_last.length[m]"][-1], 1e-2)
        self.assertLess(run["traction.n[Pa]"].max(), 0)
        np.testing.assert_allclose(run["slid[m]"], run["path[m]"], rtol=1e-9)
        np.testing.assert_allclose(run["slid[m]"], -run["slip.t[m]"], rtol=1e-9)
        self.assertLess(run["new[m]"][-1], 0.5 * run["slid[m]"][-1])

    def test_in_space(self):
        def in_space(law):
            text = put(SHEARED, MOTION=FORTH, LAW=law).replace("y: [0 m, 2 m]}", "y: [0 m, 2 m], z: [0 m, 2 m]}").replace("[[0 m, 1 m], [4 m, 1 m]]", "[[0 m, 0 m, 1 m], [4 m, 0 m, 1 m], [4 m, 2 m, 1 m], [0 m, 2 m, 1 m]]")
            text = text.replace("poromechanics/mpsa", "poromechanics/fem").replace("[0 m, 0 m]}", "[0 m, 0 m, 0 m]}").replace("-1 mm]", "0 m, -1 mm]").replace("at: [2 m, 1 m]", "at: [2 m, 1 m, 1 m]")
            return self.write(text.replace("displacement_y", "displacement_z").replace("5e-4*y", "5e-4*z").replace("size: 1 m", "size: 2 m"))

        built_in, ours = (self.run_scene(in_space(law), "time.step=100 s") for law in (BUILT_IN, REMEMBERED))
        slip, expected = (np.hypot(run["jump.t1[m]"], run["jump.t2[m]"]) for run in (ours, built_in))
        np.testing.assert_allclose(slip, expected, rtol=0, atol=1e-10 * expected.max())
        known = np.maximum(0, (2.5e9 * 1e-5 * built_in.times - 0.6 * 5e6) / (2.5e9 - 0.3 * 5e6 / 5e-3))
        np.testing.assert_allclose(slip, known, rtol=0, atol=1e-8 * known.max())

    def test_turned_and_mirrored(self):
        scene = self.write(put(PRESSED, **HYSTERETIC))
        one = self.run_scene(scene, "time.end=300 s")["jump.n[m]"]
        for mirror in (False, True):
            np.testing.assert_allclose(self.run_scene(self.turned(scene, 35, mirror=mirror), "time.end=300 s")["jump.n[m]"], one, rtol=1e-8)

    def test_what_is_refused(self):
        def contact(law):
            return put(SHEARED, MOTION=FORTH, LAW=law)

        for text, message in ((contact('history: {a: {largest: "b"}, b: {largest: "slip"}}, friction: "0.6 + 0*a/m + 0*b/m"'), "what 'a' remembers depends on 'b'"),
                              (contact('history: {a: {sum: "a"}}, friction: "0.6 + 0*a/m"'), "depends on itself"),
                              (contact('history: {a: {largest: "slp"}}, friction: "0.6 + 0*a/m"'), "did you mean 'slip'"),
                              (contact('history: {a: {largest: "slip + sigma_n"}}, friction: "0.6 + 0*a/m"'), "its terms have different units"),
                              (contact('history: {a: {sum: "sigma_n", over: slip}}, friction: "0.6 - a/(1 MPa)"'), "has another unit"),
                              (contact('history: {a: {largest: "slip", start: 3 s}}, friction: "0.6 - a/m"'), "'3 s' for 'start'"),
                              (contact('history: {a: {largest: "slip"}}, friction: "if(a < 1 mm, 0.6, 0.3)"'), "jumps from 0.6 to 0.3"),
                              (contact('history: {a: {largest: "if(slip < 1 mm, 0 mm, 1 mm)"}}, friction: "0.6 - a/m"'), "jumps from 0"),
                              (contact('history: {a: {largest: "3 m"}}, friction: "0.6 - a/m"'), "remembers what does not follow the state"),
                              (contact('history: {slip: {largest: "sigma_n"}}, friction: 0.6'), "in a formula the name means something else"),
                              (contact('history: {mm: {largest: "sigma_n"}}, friction: 0.6'), "in a formula the name means something else"),
                              (contact('history: {"1a": {largest: "sigma_n"}}, friction: 0.6'), "no formula could name it"),
                              (contact('history: {traction: {largest: "sigma_n"}}, friction: "0.6 + 0*traction/Pa"'), "has a field of this name"),
                              (contact('history: {a: {largest: "slip"}}, friction: 0.6'), "'a' of 'history' has no effect"),
                              (contact('history: {a: {largest: "slip", smallest: "slip"}}, friction: "0.6 - a/m"'), "contradicts itself"),
                              (contact('history: {a: {}}, friction: "0.6 - a/m"'), "does not say what is remembered"),
                              (contact('history: {a: {largest: "slip", over: slip}}, friction: "0.6 - a/m"'), "'over' has no effect"),
                              (contact('history: {a: {sum: "1", over: path}}, friction: "0.6 - a/m"'), "variable to sum over"),
                              (contact('history: {a: {largest: "slip"}}, friction: 0.6, closure: {law: formula, closure: "sigma_n/(1 GPa/m) + 0*a"}'), "which follows 'slip'"),
                              (contact('history: {a: {largest: "slip"}, b: {largest: "path"}, c: {sum: "1"}, d: {sum: "slip"}, f: {sum: "path"}}, friction: 0.6'), "more than 4 variables"),
                              (put(COLUMN, KIND="rt0", LEFT="1 MPa", RIGHT="1 MPa"), "unknown key 'history'"),
                              (put(CLOSED, POROSITY='history: {a: {largest: "T"}}, porosity: "0.1 + a/(1e4 K)"'), "names 'T'"),
                              (put(CLOSED, POROSITY='history: {a: {largest: "p"}}, storage: "1e-10 1/Pa*(1 + a/(1 GPa))"').replace("fluid_compressibility: 0 1/Pa, ", ""), "which remembers"),
                              (put(PIPE, LEFT="1 MPa", RIGHT="1 MPa").replace('"1e-14 m^3*(1 + highest/(1 MPa))"', "cubic_law"), "laws that are no formulas have no memory")):
            with self.subTest(text=text):
                refused = self.call("check", self.write(text))
                self.assertEqual(refused.returncode, 2, msg=refused.stderr)
                self.assertIn(message, refused.stderr)


if __name__ == "__main__":
    unittest.main()
