#!/usr/bin/python3
"""scheme_pairs_test.py SPREKK [MPIEXEC]: every pair of time scheme, stabilization, substeps, waiting, acceleration and nesting has one answer:
the monolithic one where nothing takes substeps of its own, otherwise that of the same substeps without stabilization and acceleration, which
has the order of the time scheme; or it is refused."""

import itertools
import math
import unittest

import numpy as np
from scene_runs import ROOT, SceneRuns, on_two_processes

# Rock with one pressure, a fracture with another, and a resistance between them: two ordinary differential equations. The fracture is empty
# of pressure at first, so both jump at the start.
STORED, IN_FRACTURE, CONDUCTANCE, START, RATE, FREQUENCY = 1e-10, 5e-12, 1e-10, 1e6, 1e-4, 3.0
PAIR = """
name: pair
geometry:
  box: {x: [0 m, 1 m], y: [0 m, 1 m]}
  fractures: {f: {points: [[0 m, 0.5 m], [1 m, 0.5 m]]}}
mesh: {kind: structured, cells: [2, 2], shape: quadrilaterals}
components:
  pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1e-10 1/Pa, initial_pressure: 1 MPa, source: "(1e-4*sin(3*t)) 1/s"}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 Pa*s
    fluid_compressibility: 5e-9 1/Pa
    initial_aperture: 1 mm
    law: {type: constant, transmissivity: 1 m^3}
    normal_permeability: constant
    normal_permeability_value: 5e-11 m/(Pa*s)
couplers: [{type: wall_exchange, between: [pore, conduit]}]
time: {end: 0.5 s, step: 0.015625 s}
output: {fields: false, probes: {rock: {of: pore.pressure, take: mean}, fracture: {of: conduit.pressure, take: mean}}}
schedule: [{solve: [pore, conduit]}]
"""
SDIRK2 = "time.scheme=sdirk2"
SCHEMES = {1: (), 2: (SDIRK2,)}  # by order
ACCELERATORS = ("constant: {factor: 0.7}", "aitken: {}", "anderson: 5", "iqn_ils: {}", "iqn_imvj: {}")


def exact(time):
    """The two pressures, from the eigenvectors of the equations; a part oscillates with the source."""
    matrix = CONDUCTANCE * np.array([[-1, 1], [1, -1]]) / np.array([[STORED], [IN_FRACTURE]])
    particular = np.linalg.solve(1j * FREQUENCY * np.eye(2) - matrix, np.array([RATE / STORED, 0]))  # the source is Im exp(i w t)
    values, vectors = np.linalg.eig(matrix)
    free = np.linalg.solve(vectors, np.array([START, 0]) - particular.imag)
    return vectors @ (free * np.exp(values * time)) + (particular * np.exp(1j * FREQUENCY * time)).imag


def iterated(steps, options="", until=1e-11):
    return f"schedule=[{{iterate: {{until: {{relative: {until}, at_most: 400}}, {options}steps: [{', '.join(steps)}]}}}}]"


def part(components, count=1, waiting="linear", stabilize=""):
    solve = f"{{solve: {components}{', stabilize: ' + stabilize if stabilize else ''}}}"
    return f"{{subcycle: {{count: {count}, waiting: {waiting}, steps: [{solve}]}}}}" if count > 1 else solve


class TwoPressures(SceneRuns):
    """Flow in the rock and in a fracture in turn."""
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.write(PAIR)

    def end(self, *settings, step=None, **options):
        run = self.run_scene(self.scene, *settings, *((f"time.step={step!r} s",) if step else ()), **options)
        self.assertLess(np.abs(run["fluid_balance_error[m^2]"]).max(), 1e-9 * np.abs(run["fluid_injected[m^2]"]).max(), settings)
        self.assertEqual(run.record["counters"]["steps rejected"], 0, settings)
        return np.array([run[f"{column}[Pa]"][-1] for column in ("rock", "fracture")])

    def in_turn(self, rock=1, fracture=1, waiting="linear", stabilize=("", ""), options=""):
        return iterated([part("pore", rock, waiting, stabilize[0]), part("conduit", fracture, waiting, stabilize[1])], options)

    def assert_same(self, ours, other, what):
        self.assertLess(np.abs(ours - other).max() / np.abs(other).max(), 1e-9, what)

    def test_orders_in_time(self):
        truth = exact(0.5)
        for order, (rock, fracture), waiting in itertools.product(SCHEMES, ((1, 4), (3, 1), (2, 4)), ("held", "linear")):
            if order == 2 and waiting == "held":
                continue  # is refused
            with self.subTest(order=order, rock=rock, fracture=fracture, waiting=waiting):
                setting = self.in_turn(rock, fracture, waiting, stabilize=("response", "response"))
                errors = [np.abs(self.end(*SCHEMES[order], setting, step=step) - truth).max() / truth.max() for step in (1 / 64, 1 / 128)]
                self.assertGreater(math.log2(errors[0] / errors[1]), order - 0.05)
                self.assertLess(errors[1], (4e-3, 4e-6)[order - 1])

    def test_stabilization_and_substeps(self):
        stabilizations = (("response", ""), ("", "response"), ("response", "response"))
        for order, (rock, fracture), waiting in itertools.product(SCHEMES, ((1, 1), (1, 4), (3, 1), (2, 4)), ("held", "linear")):
            if (order == 2 or rock * fracture == 1) and waiting == "held":
                continue
            scheme = SCHEMES[order]
            plain = self.end(*scheme, self.in_turn(rock, fracture, waiting)) if rock * fracture > 1 else self.end(*scheme)
            for stabilize in stabilizations if waiting == "linear" else stabilizations[-1:]:
                what = (order, rock, fracture, waiting, stabilize)
                self.assert_same(self.end(*scheme, self.in_turn(rock, fracture, waiting, stabilize)), plain, what)

    def test_acceleration_and_order_of_passes(self):
        for order, (rock, fracture) in ((1, (1, 1)), (2, (1, 4))):
            scheme = SCHEMES[order]
            plain = self.end(*scheme, self.in_turn(rock, fracture)) if fracture > 1 else self.end(*scheme)
            for options in (*(f"accelerate: {{{rule}}}, " for rule in ACCELERATORS), "order: jacobi, "):
                self.assert_same(self.end(*scheme, self.in_turn(rock, fracture, options=options)), plain, (order, fracture, options))
            self.assert_same(self.end(*scheme, self.in_turn(rock, fracture, stabilize=("response", "response"), options="accelerate: {anderson: 5}, ")), plain,
                             (order, fracture))

    def test_nested(self):
        inner = "{iterate: {until: {relative: 1e-12}, steps: [{solve: pore}, {solve: conduit, stabilize: response}]}}"
        for scheme in SCHEMES.values():
            whole, small = self.end(*scheme), self.end(*scheme, step=1 / 256)
            for setting, truth in ((f"schedule=[{{subcycle: {{count: 4, steps: [{inner}]}}}}]", small),
                                   ("schedule=[{subcycle: {count: 2, steps: [{subcycle: {count: 2, steps: [{solve: [pore, conduit]}]}}]}}]", small),
                                   (iterated(["{subcycle: {count: 1, steps: [{solve: pore}]}}", "{solve: conduit, stabilize: response}"]), whole),
                                   (iterated([inner]), whole)):
                self.assert_same(self.end(*scheme, setting), truth, (scheme, setting))

    def test_disturbed_and_on_two_processes(self):
        setting = (SDIRK2, self.in_turn(1, 4, stabilize=("response", "response")))
        plain = self.end(*setting)
        self.assert_same(self.end(*setting, "components.conduit.normal_permeability_value=5.000000005e-11 m/(Pa*s)"), plain, "disturbed")

    @on_two_processes
    def test_on_two_processes(self):
        setting = (SDIRK2, self.in_turn(1, 4, stabilize=("response", "response")))
        self.assert_same(self.end(*setting, processes=2), self.end(*setting), "two processes")

    def test_what_leaves_first_order_is_refused(self):
        answer = self.call("check", self.scene, SDIRK2, self.in_turn(1, 4, "held"))
        self.assertEqual(answer.returncode, 2)
        self.assertIn("substeps are of first order in time where what waits is held ('time: scheme: sdirk2' is of second order) write 'waiting: linear'",
                      answer.stderr)

    def test_steps_that_are_cut_are_told(self):
        # Without help a pass multiplies errors by more than 1 in steps of an eighth.
        run = self.run_scene(self.scene, SDIRK2, self.in_turn(1, 4), "time.step=0.125 s")
        rejected = run.record["counters"]["steps rejected"]
        self.assertGreater(rejected, 0)
        (note,) = [note for note in run.record["notes"] if note["topic"] == "steps cut"]
        self.assertIn(f"{rejected} attempts at steps did not converge", note["text"])
        helped = self.run_scene(self.scene, SDIRK2, self.in_turn(1, 4, stabilize=("response", "response")), "time.step=0.015625 s")
        self.assertEqual([note for note in helped.record["notes"] if note["topic"] == "steps cut"], [])


class FlowAndRock(SceneRuns):
    """Mandel's block, which is pressed slowly: flow and rock in turn."""
    mandel = ROOT / "configs/verification/mandel.yaml"
    settings = ('components.rock.boundary.top={displacement_y: "(-1e-4*sin(pi*t/20000)^2) m"}', "mesh.size=0.5 m", "time.end=2000 s", "time.step=1000 s",
                "output.fields=false", "output.probes={mean: {of: pore.pressure, take: mean}, u: {of: rock.displacement, at: [1 m, 0.5 m]}}")

    def columns(self, *settings, **options):
        run = self.run_scene(self.mandel, *self.settings, *settings, **options)
        self.assertEqual(run.record["counters"]["steps rejected"], 0, settings)
        return np.array([run[column] / np.abs(run[column]).max() for column in ("mean[Pa]", "u.x[m]", "fluid_outflow[m^2]")])

    def in_turn(self, flow=1, rock=1, waiting="linear", stabilize=("", ""), options=""):
        return iterated([part("pore", flow, waiting, stabilize[0]), part("rock", rock, waiting, stabilize[1])], options)

    def test_stabilization_acceleration_and_substeps(self):
        for order, (flow, rock), waiting in itertools.product(SCHEMES, ((1, 1), (4, 1), (1, 3)), ("held", "linear")):
            if (order == 2 or flow * rock == 1) and waiting == "held":
                continue
            scheme = SCHEMES[order]
            plain = self.columns(*scheme, self.in_turn(flow, rock, waiting)) if flow * rock > 1 else self.columns(*scheme)
            for stabilize, options in ((("fixed_stress", ""), ""), (("", "undrained"), ""), (("fixed_stress", ""), "accelerate: {anderson: 5}, "),
                                       (("", ""), "accelerate: {iqn_imvj: {}}, "), (("fixed_stress", ""), "order: jacobi, ")):
                ours = self.columns(*scheme, self.in_turn(flow, rock, waiting, stabilize, options))
                self.assertLess(np.abs(ours - plain).max(), 1e-8, (order, flow, rock, waiting, stabilize, options))

    def mean(self, *settings):
        return self.run_scene(self.mandel, *self.settings, *settings)["mean[Pa]"][-1]

    def test_a_jump_of_the_load_is_not_interpolated(self):
        # The plate comes down at 1000 s. Interpolated across the jump, the second order is lost, by 3 % in steps of 1000 s.
        cycled = self.in_turn(4, 1, "linear", ("fixed_stress", ""))
        settings = (SDIRK2, 'components.rock.boundary.top.displacement_y=[{value: "(-1e-9*t) m", to: 1000 s}, {value: -1e-4 m, from: 1000 s}]')
        truth = self.mean(*settings, "time.step=31.25 s")
        coarse, fine = (abs(self.mean(*settings, cycled, f"time.step={step} s") / truth - 1) for step in (1000, 500))
        self.assertLess(coarse, 2e-3)
        self.assertGreater(math.log2(coarse / fine), 1.85)

    def test_nor_is_a_load_that_is_there_at_once(self):
        # Four substeps of the flow are better than one; interpolated across the jump they would be worse.
        settings = ("components.rock.boundary.top.displacement_y=-1e-4 m",)
        truth = self.mean(*settings, SDIRK2, "time.step=31.25 s")
        whole, cycled = (abs(self.mean(*settings, *more) / truth - 1) for more in ((), (self.in_turn(4, 1, "linear", ("fixed_stress", "")),)))
        self.assertLess(cycled, 0.5 * whole)


if __name__ == "__main__":
    unittest.main()
