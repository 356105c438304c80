#!/usr/bin/python3
"""pressure_near_tips_test.py SPREKK MPIEXEC: the stress intensity of an open fracture after an hour of leak-off, with the pore pressure
near its tips (`pore_pressure: near_tips`).

A fracture of half-length 50 mm under 10 MPa from all sides is held open by 12 MPa of fluid. The pressure of the rock rises around it and
closes it, from 0.79 to 0.1315 MPa m^0.5 (0.131 and 0.132 in docs/numerics/two_level.md). The pressure goes with sqrt(r) at the tips, so that fits of
linear functions are too small by the first order in the size of the cells."""

import unittest

from scene_runs import ROOT, SceneRuns, on_two_processes

LIMIT = 0.1315e6  # Pa m^0.5; with the pressure of each cell as it is, and cells of 5 mm, K_I is 0.131 and 0.132
CHANGES = {
    "right: {normal_stress: -20 MPa}": "right: {normal_stress: -10 MPa}",
    "    injection:\n      well: {fracture: main, rate: {value: 5.0e-9 m^2/s, from: 6 h, to: 21 h}}":
        "    prescribed: {all: {fracture: main, pressure: 12 MPa}}",
    "between: [rock, conduit, tips]}": "between: [rock, conduit, tips], pore_pressure: near_tips}",
    "end: 30 h": "end: 1 h",
}


class PressureNearTips(SceneRuns):
    timeout = 900

    def factors(self, size, growth, *settings, processes=1):
        text = (ROOT / "configs/paper/onset.yaml").read_text()
        for old, new in CHANGES.items():
            self.assertEqual(text.count(old), 1, old)
            text = text.replace(old, new)
        scene = self.write(text)
        row = self.run_scene(scene, f"mesh.fracture_size={size} mm", f"mesh.growth={growth}", *settings, processes=processes).rows[-1]
        return [row[f"tips.main_{end}.K_I"] for end in ("first", "last")]

    def test_converges_to_one_limit(self):
        found = {size: self.factors(size, size / 100) for size in (20, 10)}
        errors = {size: max(abs(k / LIMIT - 1) for k in factors) for size, factors in found.items()}
        self.assertLess(errors[20], 0.1)
        self.assertLess(errors[10], 0.04)
        self.assertLess(errors[10], 0.5 * errors[20])
        fitted = self.factors(20, 0.2, "couplers.4.pore_pressure=fitted")
        self.assertGreater(min(fitted), 1.1 * LIMIT)

    @on_two_processes
    def test_neighbours(self):
        plain = self.factors(20, 0.2)
        for others in (self.factors(20, 0.2, "components.conduit.prescribed.all.pressure=12.000000012 MPa"),
                       self.factors(20, 0.2, processes=2)):
            for mine, other in zip(plain, others):
                # The pressure alone, 0.012 Pa more, makes 4e-8: sqrt(pi 0.05) 0.012/0.12e6.
                self.assertAlmostEqual(mine / other, 1, delta=5e-8)
        # Mirrored, and turned by 90 degrees: other meshes.
        for others in (self.factors(20, 0.2, "geometry.fractures.main.angle=-45 deg"),
                       self.factors(20, 0.2, "geometry.fractures.main.angle=135 deg")):
            for other in others:
                self.assertAlmostEqual(other / plain[0], 1, delta=0.03)


if __name__ == "__main__":
    unittest.main()
