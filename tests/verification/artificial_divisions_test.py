#!/usr/bin/python3
"""artificial_divisions_test.py SPREKK MPIEXEC: scenes on processes that own cells nobody would give them.

Each cell belongs to one of two processes at random; or of three processes one has the cell at one wall of a fracture alone and another
one nothing at all (in the scenes that take a second). The answers are those of one process."""

import unittest

import numpy as np
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


LOPSIDED = ("swaps/mandel_fem", "tutorial/first_scene", "verification/regular_network")
# Columns that are sums of what cancels: in- and outflow of steady flow, and rates where nothing flows.
CANCELS = {"verification/regular_network": ["fluid_outflow"], "verification/lauwerier": ["fluid_outflow"], "verification/pressurized_cross": ["everywhere.rate"]}


def differences(alone, shared, left_out):
    """Of each column, over the largest value of the columns of its unit."""
    columns = [column for column in alone.history if not any(word in column for word in ("error", "iterations", "seconds", *left_out))]
    unit = {column: column[column.rindex("["):] if "[" in column else "" for column in columns}
    sizes = {}
    for column in columns:
        sizes[unit[column]] = max(sizes.get(unit[column], 0), np.abs(alone.history[column]).max())
    return {column: np.abs(alone.history[column] - shared.history[column]).max() / sizes[unit[column]]
            for column in columns if sizes[unit[column]] > 0}


@on_two_processes
class ArtificialDivisions(SceneRuns):
    timeout = 400

    def expect_alike(self, scene, settings):
        path = ROOT / "configs" / f"{scene}.yaml"
        alone = self.run_scene(path, *settings)
        for division, processes in (("scattered", 2), *([("lopsided", 3)] if scene in LOPSIDED else [])):
            shared = self.run_scene(path, *settings, f"mesh.division={division}", processes=processes)
            with self.subTest(scene=scene, division=division, processes=processes):
                self.assertEqual(len(alone.history["time[s]"]), len(shared.history["time[s]"]))
                found = differences(alone, shared, CANCELS.get(scene, []))
                self.assertGreater(len(found), 3)
                self.assertLess(max(found.values()), TOLERANCE, max(found, key=found.get))


def of_scene(scene, settings):
    return lambda self: self.expect_alike(scene, settings)


for name, its_settings in SCENES.items():
    setattr(ArtificialDivisions, "test_" + name.split("/")[-1], of_scene(name, its_settings))

if __name__ == "__main__":
    unittest.main()
