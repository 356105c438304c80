#!/usr/bin/python3
"""formulas_in_space_test.py SPREKK [MPIEXEC]: laws as formulas on a disc that slips under injection in space, with flow, rock, contact and aperture: a
built-in law as a formula has its answer; and so have two processes, also with a friction that weakens. In a plane: contact_formulas_test.cpp, hydraulic_formula_test.cpp, fluid_formulas_test.cpp."""

import unittest

from scene_runs import ROOT, SceneRuns, on_two_processes

SCENE = ROOT / "configs/tutorial/slipping_disc.yaml"
COARSE = ("mesh.size=100m", "mesh.fracture_size=20m", "mesh.growth=2", "time.end=2day")
CUBIC = "components.conduit.transmissivity=a^3/12"
CONSTANT = "components.contact.friction=0.6 + slip/(1e30 m)"  # what slip adds is far below round-off
WEAKENING = "components.contact.friction=max(0.3, 0.6 - slip/(20 mm))"  # slower than the rock unloads the walls


class FormulasInSpace(SceneRuns):
    def test_built_in_laws_as_formulas_have_the_same_answer(self):
        """Reference: the built-in laws, to what Newton's method leaves of the balances."""
        built_in = self.run_scene(SCENE, *COARSE)
        for formulas in ((CUBIC,), (CONSTANT,), (CUBIC, CONSTANT)):
            with self.subTest(formulas):
                self.assertLess(self.largest_difference(self.run_scene(SCENE, *COARSE, *formulas), built_in), 1e-8)

    @on_two_processes
    def test_two_processes(self):
        one, two = (self.run_scene(SCENE, *COARSE, CUBIC, WEAKENING, processes=processes) for processes in (1, 2))
        self.assertLess(self.largest_difference(two, one), 1e-8)

    def test_a_disturbed_friction_slips_almost_as_far(self):
        one, other = (self.run_scene(SCENE, *COARSE, f"components.contact.friction=max(0.3, 0.6 - slip*{factor!r}/(20 mm))") for factor in (1, 1 + 1e-9))
        self.assertLess(self.largest_difference(other, one), 1e-7)


if __name__ == "__main__":
    unittest.main()
