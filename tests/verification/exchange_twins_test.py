#!/usr/bin/python3
"""exchange_twins_test.py SPREKK [MPIEXEC]: two flows in one rock (matrix_exchange) with a well, a side with a pressure and one with a
flux: pressures and the rates of history.csv are the same when everything is turned, and on two processes, and hardly change with the
exchange; what the exchange passes leaves one flow and enters the other."""

import unittest

from scene_runs import SceneRuns, on_two_processes

SCENE = """
name: two_flows
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.15 m}
components:
  cracks:
    type: matrix_flow/mpfa
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0.1 1/Pa
    initial_pressure: 1 Pa
    boundary: {right: {pressure: 1 Pa}, top: {flux: 0.05 m/s}}
    wells: {feed: {at: [0.5 m, 0.3 m], rate: 0.4 m^2/s}}
  blocks:
    type: matrix_flow/mpfa
    permeability: 0.02 m^2
    viscosity: 1 Pa*s
    storage: 2 1/Pa
    initial_pressure: 2 Pa
    boundary: {left: {pressure: 2.5 Pa}}
couplers: [{type: matrix_exchange, between: [cracks, blocks], exchange: 3 1/(Pa*s)}]
schedule: [{solve: [cracks, blocks]}]
time: {end: 0.2 s, step: 0.02 s}
output:
  probes:
    near: {of: cracks.pressure, at: [0.6 m, 0.4 m]}
    far: {of: blocks.pressure, at: [1.5 m, 0.7 m]}
    in_cracks: {of: cracks.pressure, take: integral}
    in_blocks: {of: blocks.pressure, take: integral}
"""


class ExchangeTwins(SceneRuns):
    @on_two_processes
    def test_twins_agree(self):
        scene = self.write(SCENE)
        one = self.run_scene(scene)
        for column, value in (("cracks.feed.rate[m^2/s]", 0.4), ("cracks.top.outflow[m^2/s]", 0.1)):
            for rate in one.history[column]:
                self.assertAlmostEqual(rate, value, delta=1e-12)
        two = self.largest_difference(self.run_scene(scene, processes=2), one)
        turned = self.largest_difference(self.run_scene(self.turned(scene, 37)), one)
        disturbed = self.largest_difference(self.run_scene(scene, f"couplers.0.exchange={3 * (1 + 1e-9)!r} 1/(Pa*s)"), one)
        print(f"two processes {two:.1e}, turned {turned:.1e}, exchange times 1 + 1e-9 {disturbed:.1e}")
        self.assertLess(two, 1e-10)
        self.assertLess(turned, 1e-10)
        self.assertLess(disturbed, 1e-8)
        self.assertGreater(disturbed, 0)

    @on_two_processes
    def test_what_each_flow_stores_is_what_it_gets(self):
        """The blocks are sealed but for the left side: what they store beside has passed from the cracks, to the last digit of both."""
        for processes in (1, 2):
            table = self.run_scene(self.write(SCENE), processes=processes).history
            stored = [0.1 * (a - 2) + 2 * (b - 4) for a, b in zip(table["in_cracks[Pa*m^2]"], table["in_blocks[Pa*m^2]"])]
            passed = 0
            for i, total in enumerate(stored):
                passed += 0.02 * (table["cracks.feed.rate[m^2/s]"][i] - sum(
                    table[f"{name}.outflow[m^2/s]"][i] for name in ("cracks.right", "cracks.top", "blocks.left")))
                self.assertAlmostEqual(total, passed, delta=1e-12)
                self.assertAlmostEqual(table["fluid_stored[m^2]"][i], total, delta=1e-12)
            self.assertLess(max(abs(error) for error in table["fluid_balance_error[m^2]"]), 1e-12)


if __name__ == "__main__":
    unittest.main()
