#!/usr/bin/python3
"""one_way_test.py SPREKK MPIEXEC: Biot's coupling one way. A column of 1 m that cannot move sideways drains from 1 Pa at one end, which
is free: the pressure is that of rigid rock, pure diffusion with the storage S that is given, and the end settles by
alpha/(lambda + 2 G) times the integral of p_0 - p. Exact series of backward Euler; both directions, two kinds of rock, solved
together and in turn, and on two processes."""

import math
import unittest

from scene_runs import SceneRuns

STORAGE, STIFFNESS, ALPHA, DT, STEPS, CELLS = 0.5, 2.0, 0.8, 0.01, 10, 40
ONE_WAY, TOGETHER, IN_TURN = ", one_way: true", "{solve: [pore, rock]}", "{solve: pore}, {solve: rock}"

SCENE = """
geometry:
  box: {{x: [0 m, {width}], y: [0 m, {height}]}}
mesh: {{kind: structured, cells: [{cells}], shape: quadrilaterals}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0.5 1/Pa
    initial_pressure: 1 Pa
    boundary: {{{drained}: {{pressure: 0 Pa}}}}
  rock:
    type: poromechanics/{rock}
    young_modulus: {young!r} Pa
    poisson_ratio: 0.25
    boundary:
      {side}: {{displacement_{across}: 0 m}}
      {other_side}: {{displacement_{across}: 0 m}}
      {held}: {{displacement_{along}: 0 m}}
couplers:
  - {{type: biot, between: [pore, rock], biot_coefficient: 0.8{biot}}}
schedule: [{schedule}]
time: {{end: 0.1 s, step: 0.01 s}}
output:
  probes:
    end: {{of: rock.displacement, at: [{end}]}}
{probes}
"""


def column(along_x=False, biot=ONE_WAY, schedule=TOGETHER, rock="mpsa", young=5 / 3, cells=CELLS):
    places = [(i + 0.5) / cells for i in range(cells)]
    return SCENE.format(
        rock=rock, biot=biot, schedule=schedule, young=young, along="x" if along_x else "y", across="y" if along_x else "x",
        **(dict(width="1 m", height="0.1 m", cells=f"{cells}, 4", drained="left", held="right", side="bottom", other_side="top",
                end="0 m, 0.05 m") if along_x else
           dict(width="0.1 m", height="1 m", cells=f"4, {cells}", drained="bottom", held="top", side="left", other_side="right",
                end="0.05 m, 0 m")),
        probes="\n".join(f"    p{i}: {{of: pore.pressure, at: [{f'{y} m, 0.06 m' if along_x else f'0.06 m, {y} m'}]}}"
                         for i, y in enumerate(places)))


def diffused(y):
    """The pressure after all steps at y, and its integral."""
    pressure = integral = 0
    for k in range(2000):
        n = (k + 0.5) * math.pi
        decay = (1 + DT / STORAGE * n * n)**-STEPS
        pressure += 2 / n * math.sin(n * y) * decay
        integral += 2 / n**2 * decay
    return pressure, integral


class OneWay(SceneRuns):
    def last_row(self, text, processes=1):
        return self.run_scene(self.write(text), processes=processes).rows[-1]

    def test_pressure_diffuses_and_the_end_settles(self):
        for along_x in (False, True):
            for rock in ("mpsa", "fem"):
                for schedule in (TOGETHER, IN_TURN):
                    with self.subTest(along_x=along_x, rock=rock, schedule=schedule):
                        row = self.last_row(column(along_x, ONE_WAY, schedule, rock))
                        pressures = [row[f"p{i}"] for i in range(CELLS)]
                        for i, pressure in enumerate(pressures):
                            self.assertAlmostEqual(pressure, diffused((i + 0.5) / CELLS)[0], delta=5e-4)
                        # The balance is that of the storage alone, so the fluid that has left tells the loss of pressure.
                        lost = row["fluid_outflow"] / (STORAGE * 0.1)
                        settled, exact = row["end.x" if along_x else "end.y"], ALPHA / STIFFNESS * (1 - diffused(0)[1])
                        self.assertAlmostEqual(settled, exact, delta=1e-3 * exact)
                        self.assertAlmostEqual(ALPHA / STIFFNESS * lost, exact, delta=1e-3 * exact)
                        if rock == "fem":  # exact in space for a load that is constant in each cell
                            self.assertAlmostEqual(settled, ALPHA / STIFFNESS * lost, delta=1e-9)
                        self.assertLess(abs(row["fluid_balance_error"]), 1e-9)

    def test_order(self):
        exact = ALPHA / STIFFNESS * (1 - diffused(0)[1])
        for rock in ("mpsa", "fem"):
            coarse, fine = (abs(self.last_row(column(rock=rock, cells=cells))["end.y"] - exact) for cells in (20, 40))
            self.assertGreater(math.log2(coarse / fine), 1.9)

    def test_the_rock_does_not_move_the_fluid(self):
        rigid, soft, both = (self.last_row(column(biot=biot, young=young)) for biot, young in ((ONE_WAY, 5e6), (ONE_WAY, 5 / 3), ("", 5 / 3)))
        for i in range(CELLS):
            self.assertAlmostEqual(rigid[f"p{i}"], soft[f"p{i}"], delta=1e-11)
        # Both ways the storage is S + alpha^2/(lambda + 2 G): the pressure is another one.
        self.assertGreater(both[f"p{CELLS - 1}"], 1.1 * soft[f"p{CELLS - 1}"])
        stored = self.last_row(column().replace("storage: 0.5 1/Pa", f"storage: {STORAGE + ALPHA**2 / STIFFNESS!r} 1/Pa"))
        for i in range(CELLS):
            self.assertAlmostEqual(stored[f"p{i}"], both[f"p{i}"], delta=1e-3)

    def test_two_processes(self):
        one, two = self.last_row(column()), self.last_row(column(), processes=2)
        for name in [f"p{i}" for i in range(CELLS)] + ["end.y"]:
            self.assertAlmostEqual(one[name], two[name], delta=1e-9)

    def test_it_is_told_and_needs_no_stabilization(self):
        answer = self.call("check", self.write(column()))
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertIn("misses alpha times the change of the rock's volume", answer.stdout + answer.stderr)
        split = "{iterate: {until: {relative: 1e-8, at_most: 20}, steps: [{solve: pore, stabilize: fixed_stress}, {solve: rock}]}}"
        answer = self.call("check", self.write(column(schedule=split)))
        self.assertEqual(answer.returncode, 2, answer.stderr)
        self.assertIn("fixed_stress", answer.stderr)
        answer = self.call("check", self.write(column(schedule=split, biot="")))
        self.assertEqual(answer.returncode, 0, answer.stderr)


if __name__ == "__main__":
    unittest.main()
