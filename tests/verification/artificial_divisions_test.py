#!/usr/bin/python3
"""artificial_divisions_test.py SPREKK MPIEXEC: scenes on processes that own cells nobody would give them.

Each cell belongs to a process at random (two, three processes), or one process has the cell at one wall of a fracture alone and another
one nothing at all. The answers are those of one process."""

import unittest

from scene_runs import ROOT, SceneRuns, on_two_processes

# Between them the scenes have every kind of component and coupler; steps are few.
SCENES = {
    "tutorial/first_scene": [],
    "tutorial/fault_and_joints": [],
    "tutorial/well_limits": [],
    "swaps/mandel_fem": [],
    "verification/kgd": ["time.end=4 s"],
    "verification/lauwerier": [],
    "verification/pressurized_cross": [],
    "verification/regular_network": [],
    "verification/terzaghi": [],
}
TOLERANCE = 1e-8  # of the largest value of a column: systems are solved in another order, and Newton's method ends at 1e-10


@on_two_processes
class ArtificialDivisions(SceneRuns):
    timeout = 400

    def expect_alike(self, scene, settings):
        path = ROOT / "configs" / f"{scene}.yaml"
        alone = self.run_scene(path, *settings)
        for division, processes in (("scattered", 2), ("scattered", 3), ("lopsided", 3)):
            shared = self.run_scene(path, *settings, f"mesh.division={division}", processes=processes)
            with self.subTest(scene=scene, division=division, processes=processes):
                self.assertLess(self.largest_difference(alone, shared), TOLERANCE)


def of_scene(scene, settings):
    return lambda self: self.expect_alike(scene, settings)


for name, its_settings in SCENES.items():
    setattr(ArtificialDivisions, "test_" + name.split("/")[-1], of_scene(name, its_settings))

if __name__ == "__main__":
    unittest.main()
