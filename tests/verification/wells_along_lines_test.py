#!/usr/bin/python3
"""wells_along_lines_test.py SPREKK [MPIEXEC]: wells/limited in space, open along lines in the rock and at points of fractures.

- Thiem: a well between two closed sides, in hexahedra, wedges and tetrahedra, off the middle of cells, in layers, in anisotropic rock and with a skin.
- A deviated well that ends in the rock: the capacity of a thin cylinder (Jackson, Am. J. Phys. 68 (2000) 789).
- At a point of a fracture: the rate that a prescribed pressure has at the same radius.
- Limits, weight, and twins: turned about the diagonal of space, mirrored, disturbed by 1e-10, on two processes."""

import unittest

import numpy as np
from scipy.special import exp1

from scene_runs import on_two_processes, sprekk
from scenes_in_space import SIDES, SpaceRuns

MOBILITY, RADIUS, HEIGHT, PER_LOG = 1e-10, 0.1, 30.0, 1e3  # m^2/(Pa s), m, m; Pa for a factor e in the distance
PRESSURE = -PER_LOG * np.log(RADIUS)
THIEM = """
name: thiem
geometry: {box: {x: [-100 m, 100 m], y: [-100 m, 100 m], z: [0 m, 30 m]}}
mesh: MESH
materials: {permeability: 1e-13 m^2, viscosity: 1 mPa*s}
components:
  pore:
    type: matrix_flow/mpfa
    storage: 0 1/Pa
    boundary: {left: {pressure: P}, right: {pressure: P}, front: {pressure: P}, back: {pressure: P}}
  wells: {type: wells/limited, wells: {w: {points: [[X m, Y m, 0 m], [X m, Y m, 30 m]], pressure: WELL Pa, radius: 0.1 m}}}
couplers: [{type: well_exchange, between: [wells, pore]}]
schedule: [{solve: [pore, wells]}]
time: {end: 1 s, step: 1 s}
output: {fields: false}
"""
SQUARE = "sqrt((x/m-X)*(x/m-X)+(y/m-Y)*(y/m-Y))"
HEXAHEDRA, WEDGES = ("{kind: structured, cells: [21, 21, 5], shape: %s}" % shape for shape in ("hexahedra", "wedges"))
TETRAHEDRA = "{size: 15 m}"
# Fluid with weight in two layers and a fracture; a well is open to both, another one to the rock.
FIELD = """
name: field
geometry:
  box: {x: [0 m, 120 m], y: [0 m, 100 m], z: [-90 m, 0 m]}
  fractures: {disc: {center: [80 m, 45 m, -50 m], strike: 20 deg, dip: 25 deg, radius: 24 m}}
  regions: {low: {point: [0 m, 0 m, -55 m], normal: [0.1, 0, -1]}}
mesh: {size: 16 m, fracture_size: 7 m}
materials:
  gravity: [0, 0, -9.81 m/s^2]
  viscosity: 1 mPa*s
  fluid_density: 1000 kg/m^3
  fluid_compressibility: 5e-10 1/Pa
  porosity: 0.1
  permeability: {regions: {low: {xx: 4e-14 m^2, yy: 3e-14 m^2, zz: 1e-14 m^2, xz: 1e-14 m^2}, default: 2e-15 m^2}}
components:
  pore: {type: matrix_flow/mpfa, initial_pressure: (20e6 - 9810*z/m) Pa, boundary: {left: {pressure: (20e6 - 9810*z/m) Pa}, back: {pressure: (20e6 - 9810*z/m) Pa}}}
  conduit: {type: fracture_flow/mfd, initial_aperture: 0.1 mm, initial_pressure: (20e6 - 9810*z/m) Pa}
  wells:
    type: wells/limited
    wells:
      feed:
        RATE
        radius: 0.1 m
        places:
          high: {points: [[29 m, 47 m, -24 m], [31 m, 49 m, -41 m], [34 m, 48 m, -70 m]]}
          deep: {fracture: disc, at: [82 m, 46 m, -50.3 m]}
      plant: {points: [[70 m, 75 m, -72 m], [86 m, 71 m, -76 m]], PLANT, radius: 0.08 m, skin: 1.5}
couplers:
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: well_exchange, between: [wells, pore, conduit]}
schedule: [{solve: [pore, conduit, wells]}]
time: {end: 4 h, step: 1 h}
output: {fields: false, probes: {p: {of: pore.pressure, at: [60 m, 50 m, -60 m]}}}
"""
WORKS = FIELD.replace("RATE", "rate: if(t < 2.5*h, 3e-3, 1e-3) m^3/s\n        highest_pressure: 22.5 MPa").replace("PLANT", "rate: -2e-4 m^3/s, lowest_pressure: 18.5 MPa")
COLUMNS = tuple(f"wells.{name}" for name in ("feed.rate[m^3/s]", "feed.high.rate[m^3/s]", "feed.deep.rate[m^3/s]", "feed.pressure[Pa]", "plant.rate[m^3/s]", "plant.pressure[Pa]")) + ("p[Pa]",)


def thiem(mesh, at=(0, 0), distance=SQUARE, pressure=PRESSURE):
    return THIEM.replace("MESH", mesh).replace("P}", f'(-{PER_LOG}*log({distance})) Pa}}').replace("WELL", repr(pressure)).replace("X", str(at[0])).replace("Y", str(at[1]))


class WellsAlongLines(SpaceRuns):
    def rate(self, text, *settings, column="wells.w.rate[m^3/s]", **how):
        return self.run_text(text, *settings, **how).history[column][-1]

    def test_thiem(self):
        exact = 2 * np.pi * MOBILITY * PER_LOG * HEIGHT
        for mesh, at, within in ((HEXAHEDRA, (0, 0), 3e-4), (WEDGES, (0.5, 0.3), 5e-5), (HEXAHEDRA, (2.3, -1.1), 3e-4), (TETRAHEDRA, (13.1, 7.7), 1.5e-4)):
            error = self.rate(thiem(mesh, at)) / exact - 1
            print(f"Thiem, {mesh}, {at}: {error:.1e}")
            self.assertLess(abs(error), within, (mesh, at))

    def test_thiem_in_anisotropic_rock(self):
        # sqrt(det M) = 2e-10 across; Peaceman's radius of the bore hole.
        root = np.sqrt(2)
        bore = RADIUS * (root + 1 / root) / 2
        for tensor, distance in (("{xx: 4e-13 m^2, yy: 1e-13 m^2, zz: 3e-14 m^2}", "sqrt(0.5*x*x/m/m+2*y*y/m/m)"),
                                 ("{xx: 1e-13 m^2, yy: 4e-13 m^2, zz: 8e-13 m^2}", "sqrt(2*x*x/m/m+0.5*y*y/m/m)")):
            exact = 2 * np.pi * 2 * MOBILITY * PER_LOG * HEIGHT
            error = self.rate(thiem(HEXAHEDRA, distance=distance, pressure=-PER_LOG * np.log(bore)), f"materials.permeability={tensor}") / exact - 1
            print(f"Thiem, anisotropic: {error:.1e}")
            self.assertLess(abs(error), 2e-4)

    def test_layers_and_skin(self):
        """Each piece has the index of its layer, and a skin is a longer logarithm."""
        layers = ["geometry.regions={low: {between: [0 m, 12 m]}}", "materials.permeability={regions: {low: 7e-13 m^2, default: 1e-13 m^2}}"]
        exact = 2 * np.pi * MOBILITY * PER_LOG * (7 * 12 + 18)
        self.assertLess(abs(self.rate(thiem(HEXAHEDRA), *layers) / exact - 1), 5e-4)
        skin = 1.7
        exact = 2 * np.pi * MOBILITY * PER_LOG * HEIGHT
        text = thiem(HEXAHEDRA, pressure=PRESSURE + PER_LOG * skin).replace("radius: 0.1 m", f"radius: 0.1 m, skin: {skin}")
        self.assertLess(abs(self.rate(text) / exact - 1), 5e-4)

    def test_a_deviated_well_that_ends_in_the_rock(self):
        ends = np.array([[-6, -9, -12], [9, 6, 14.0]])
        length = np.linalg.norm(ends[1] - ends[0])
        log = np.log(length / RADIUS)
        capacity = length / (2 * log) * (1 + (1 - np.log(2)) / log + (1 + (1 - np.log(2))**2 - np.pi**2 / 12) / log**2)
        drop = 1e5
        exact = 4 * np.pi * MOBILITY * capacity * drop
        one, other = (f"sqrt((x/m-{e[0]})*(x/m-{e[0]})+(y/m-{e[1]})*(y/m-{e[1]})+(z/m-{e[2]})*(z/m-{e[2]}))" for e in ends)
        far = f'"({exact / (4 * np.pi * MOBILITY * length)}*log(({one}+{other}+{length})/({one}+{other}-{length}))) Pa"'
        text = thiem("{size: 15 m}", pressure=drop)
        text = text.replace("100 m]", "60 m]").replace("[-100 m", "[-60 m").replace("z: [0 m, 30 m]", "z: [-60 m, 60 m]")
        text = text.replace("[[0 m, 0 m, 0 m], [0 m, 0 m, 30 m]]", str([[f"{c} m" for c in end] for end in ends]).replace("'", ""))
        start = text.index("    boundary:")
        text = text[:start] + "    boundary: {" + ", ".join(f"{side}: {{pressure: {far}}}" for side in SIDES) + "}\n" + text[text.index("  wells:"):]
        error = self.rate(text) / exact - 1
        print(f"deviated: {error:.1e}")
        self.assertLess(abs(error), 3e-3)  # of the mesh: 1e-3 measured, 4e-4 with cells of 12 m

    def test_a_well_that_ends_on_a_row_of_centres(self):
        """The next centres lie on its axis: as a well beside them by 1e-6 m."""
        rates = []
        for x in (0, 1e-6):
            text = thiem("{kind: structured, cells: [25, 25, 15], shape: hexahedra}").replace("[0 m, 0 m, 0 m], [0 m, 0 m, 30 m]", f"[{x!r} m, 0 m, 11 m], [{x!r} m, 0 m, 30 m]")
            rates.append(self.rate(text))
        self.assertGreater(rates[0], 0.5 * 2 * np.pi * MOBILITY * PER_LOG * 19)
        self.near(rates[0], rates[1], 1e-6)

    def test_fluid_with_weight_stays_at_rest(self):
        """A shut well through both layers and the fracture, and one without a rate: nothing flows, relative to what 65 kPa would drive."""
        rest = self.run_text(FIELD.replace("RATE", "rate: 0 m^3/s").replace("PLANT", "rate: 0 m^3/s"))
        moved = self.run_text(FIELD.replace("RATE", "pressure: 20.3 MPa").replace("PLANT", "rate: 0 m^3/s"))
        for place in ("high", "deep"):
            column = f"wells.feed.{place}.rate[m^3/s]"
            self.assertLess(np.abs(rest[column]).max(), 1e-9 * np.abs(moved[column]).max(), place)
        # The pressures of wells are those at their highest places.
        self.near(rest["wells.feed.pressure[Pa]"][-1], 20e6 + 9810 * 24, 1e-9)
        self.near(rest["wells.plant.pressure[Pa]"][-1], 20e6 + 9810 * 72, 1e-9)

    def test_limits_hold_and_nothing_is_lost(self):
        results = self.run_text(WORKS)
        binds = results["wells.feed.binds_0_rate_1_pressure_2_shut[1]"]
        self.assertEqual(set(binds[1:]), {0, 1})
        at_limit, at_rate = binds == 1, (binds == 0) & (results["time[s]"] > 2.5 * 3600)
        self.assertLess(np.abs(results["wells.feed.pressure[Pa]"][at_limit] / 22.5e6 - 1).max(), 1e-9)
        self.assertLess(results["wells.feed.rate[m^3/s]"][at_limit].max(), 3e-3)
        self.assertLess(np.abs(results["wells.feed.rate[m^3/s]"][at_rate] / 1e-3 - 1).max(), 1e-9)
        self.assertLess(np.abs(results["wells.feed.high.rate[m^3/s]"] + results["wells.feed.deep.rate[m^3/s]"] - results["wells.feed.rate[m^3/s]"]).max(), 1e-12)
        self.assertLess(np.abs(results["fluid_balance_error[m^3]"]).max(), 1e-9 * results["fluid_injected[m^3]"][-1])

    @on_two_processes
    def test_twins(self):
        one = self.run_text(WORKS)
        for settings, processes, within in (([], 2, 1e-8), (["components.wells.wells.plant.rate=-2.0000000002e-4 m^3/s"], 1, 1e-8),
                                            (["solver.condense=false"], 1, 1e-8)):
            other = self.run_text(WORKS, *settings, processes=processes)
            self.assertLess(self.largest_difference(other, one, COLUMNS), within, (settings, processes))

    def test_turned_and_mirrored(self):
        """About the diagonal of space, and with x in the other direction: the cells are the same, and a line passes through them at no right angle."""
        def scene(order, mirror):
            sign = -1 if mirror else 1
            sizes, cells, names = (50, 55, 40), (10, 11, 8), ("x", "y", "z")
            points = [[-12.3 * sign, 7.1, -18.2], [9.7 * sign, -5.3, 21.4]]
            tensor = {(0, 0): 3, (1, 1): 2, (2, 2): 1, (0, 1): 0.4 * sign, (1, 2): -0.3, (0, 2): 0.5 * sign}
            place = [order.index(axis) for axis in range(3)]  # of each axis of the scene
            axes = {"".join(sorted((names[place[i]], names[place[j]]))): value for (i, j), value in tensor.items()}
            axes = {name: f"{value}e-13 m^2" for name, value in axes.items()}
            text = thiem(f"{{kind: structured, cells: {[cells[axis] for axis in order]}, shape: hexahedra}}")
            box = ", ".join(f"{name}: [-{sizes[axis]} m, {sizes[axis]} m]" for name, axis in zip(names, order))
            text = text.replace("{x: [-100 m, 100 m], y: [-100 m, 100 m], z: [0 m, 30 m]}", f"{{{box}}}")
            text = text.replace("[[0 m, 0 m, 0 m], [0 m, 0 m, 30 m]]", str([[f"{point[axis]} m" for axis in order] for point in points]).replace("'", ""))
            start, low_and_high = text.index("    boundary:"), (("left", "right"), ("front", "back"), ("bottom", "top"))
            inlet = low_and_high[place[0]][1 if mirror else 0]
            text = text[:start] + f"    boundary: {{{inlet}: {{pressure: 0 Pa}}, {low_and_high[place[2]][1]}: {{pressure: 100 Pa}}}}\n" + text[text.index("  wells:"):]
            return self.rate(text.replace("permeability: 1e-13 m^2", f"permeability: {axes}".replace("'", "")))
        rate = scene((0, 1, 2), False)
        for order, mirror in (((1, 2, 0), False), ((0, 1, 2), True), ((2, 0, 1), True)):
            self.near(scene(order, mirror), rate, 1e-9)

    def test_a_restart_keeps_the_bits_and_substeps_are_steps(self):
        whole, half = self.run_text(WORKS), self.run_text(WORKS, "time.end=2 h")
        rest = self.run_scene(self.write(WORKS), restart=half.folder)
        inside = self.run_text(WORKS, "schedule=[{subcycle: {count: 2, steps: [{solve: [pore, conduit, wells]}]}}]")
        shorter = self.run_text(WORKS, "time.step=0.5 h")
        for column in COLUMNS:
            self.assertEqual(rest[column][-1], whole[column][-1], column)
            self.near(inside[column][-1], shorter[column][-1], 1e-9)

    def test_a_point_of_a_fracture_has_the_rate_of_a_prescribed_pressure(self):
        text = FIELD.replace("RATE", "pressure: 21 MPa").replace("          high: {points: [[29 m, 47 m, -24 m], [31 m, 49 m, -41 m], [34 m, 48 m, -70 m]]}\n", "").replace("PLANT", "rate: 0 m^3/s")
        text = text.replace("  gravity: [0, 0, -9.81 m/s^2]\n", "").replace("-9810*z/m", "").replace("- 9810*z/m", "")
        wells = self.rate(text, column="wells.feed.rate[m^3/s]")
        given = self.rate(text, "components.wells.wells.feed=null",
                          "components.conduit.prescribed={feed: {fracture: disc, at: [82 m, 46 m, -50.3 m], radius: 0.1 m, pressure: 21 MPa}}", column="conduit.feed.rate[m^3/s]")
        print(f"point of a fracture: {wells / given - 1:.1e}")
        self.near(wells, given, 1e-9)

    def test_what_is_refused(self):
        line = "points: [[0 m, 0 m, 0 m], [0 m, 0 m, 30 m]]"
        for change, message in (("at: [0 m, 0 m, 10 m]", "the pressure at a point has no bound in space"), ("points: [[0 m, 0 m, 10 m]]", "the well is no line"),
                                ("points: [[0 m, 0 m, 10 m], [0 m, 0 m, 40 m]]", "lies outside"), ("points: [[97 m, 9 m, 0 m], [97 m, 9 m, 30 m]]", "its cells touch the open side 'right'"),
                                ("points: [[0 m, 0 m, 0 m], [9 m, 0 m, 30 m]]", "its cells touch several sides"),
                                (f"{line}, index: 1e-9 m^3/(Pa*s)", "'radius' and 'skin' have no effect")):
            run = self.call("check", self.write(thiem(HEXAHEDRA).replace(line, change), "refused.yaml"))
            self.assertIn(message, " ".join(run.stderr.split()), change)

    def near(self, found, exact, within):
        self.assertLess(abs(found / exact - 1), within)


if __name__ == "__main__":
    unittest.main()
