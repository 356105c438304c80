#!/usr/bin/python3
"""cell_modes_test.py SPREKK: contraction factors of all modes of a column of rectangles by mpsa and mpfa, down to the size of a cell.

In a column of cells of the height h the stress of mpsa is continuous at a face with the displacement
(u_i + u_j)/2 + (alpha h/(4 M)) (p_i - p_j), M = lambda + 2 G. Let a mode of the pressure have the phase t = q h from cell to cell,
c = alpha^2/M, and D = (k/mu) dt (2 sin(t/2)/h)^2. Of the volume by which cells answer to it, a = c cos^2(t/2) comes by the displacements
of cells, and b = c sin^2(t/2) directly, which is solved for with the flow. So an error of the mode contracts in a pass by
  |L - a|/(S + L + b + D)               with the stabilization L (0: drained), and
  a (b + D)/((S + b + D) (S + a))       undrained, where the rock is solved for with the amount S p + a p of each cell held."""

import csv
import math
import unittest

from scene_runs import ROOT, SceneRuns

TERZAGHI = ROOT / "configs/verification/terzaghi.yaml"
CELLS, STEP = 20, 0.01
COUPLED = 0.5  # alpha^2/M of the scene, 1/Pa
DRAINED = "{{solve: pore{}}}, {{solve: rock}}"


class CellModes(SceneRuns):
    def factors(self, steps, start, *settings):
        """From pass to pass of a step whose error is this mode, until it has lost six digits."""
        run = self.run_scene(
            TERZAGHI, f"schedule=[{{iterate: {{fallback: none, until: {{relative: 1e-9, at_most: 400}}, steps: [{steps}]}}}}]",
            f"mesh.cells=[2, {CELLS}]", f"time.end={STEP} s", f"components.pore.initial_pressure='{start}'", *settings)
        with open(run.folder / "coupling.csv", newline="", encoding="utf-8") as file:
            changes = [float(row["update[1]"]) for row in csv.DictReader(file) if row["schedule"] == "iterate"][1:]
        changes = [change for change in changes if change > 1e-6 * changes[0]]  # round-off has other modes
        self.assertGreaterEqual(len(changes), 3)
        return [after / before for before, after in zip(changes, changes[1:])]

    def expect(self, found, theory, what, within=1e-4):
        print(f"    {what}: {min(found):.6f} to {max(found):.6f}, theory {theory:.6f}", flush=True)
        for factor in found:
            self.assertAlmostEqual(factor / theory, 1, delta=within, msg=what)

    def of_column(self, quarter_waves, mobility, storage, stabilization):
        """(found, theory): a column that is drained at one end, and held at the other one."""
        square = math.sin(quarter_waves * math.pi / (4 * CELLS)) ** 2
        by_cells, directly, moved = COUPLED * (1 - square), COUPLED * square, mobility * STEP * 4 * square * CELLS**2
        steps = DRAINED.format(", stabilize: fixed_stress" if stabilization else "")
        found = self.factors(steps, f"(sin({quarter_waves * math.pi / 2!r}*y)) Pa",
                             f"components.pore.permeability={mobility} m^2", f"components.pore.storage={storage} 1/Pa",
                             "components.rock.boundary.bottom.normal_stress=0 Pa",
                             *((f"couplers.0.fixed_stress_value={stabilization} 1/Pa",) if stabilization else ()))
        return found, abs(stabilization - by_cells) / (storage + stabilization + directly + moved)

    def test_stabilized_and_drained(self):
        for stabilization, mobility, modes in ((0.9, 0.05, (1, 7, 15, 25, 39)), (COUPLED, 0.05, (15, 25, 39)), (COUPLED, 0.5, (15, 25)),
                                               (0.0, 0.05, (1, 7, 15, 25))):
            for quarter_waves in modes:
                found, theory = self.of_column(quarter_waves, mobility, 0.55, stabilization)
                self.expect(found, theory, f"L = {stabilization}, k/mu = {mobility}, {quarter_waves} quarter waves")

    def test_from_cell_to_cell_a_third_to_a_half_is_left(self):
        # With L = c and little flow c/(S + 2 c): a third with S = c, a half without storage.
        for storage, limit in ((COUPLED, 1 / 3), (1e-6, 1 / 2)):
            found, _ = self.of_column(2 * CELLS - 1, 1e-4, storage, COUPLED)
            self.expect(found, limit, f"S = {storage}, from cell to cell", 0.01)

    def test_undrained(self):
        # Sealed and held at both ends: in a cell at a drained end the amount has another part by the pressure.
        for half_waves, mobility, storage in ((1, 5.0, 0.5), (4, 5.0, 0.5), (10, 0.5, 0.5), (13, 0.05, 0.5), (19, 0.05, 0.5), (1, 5.0, 0.05),
                                              (10, 0.05, 0.05)):
            square = math.sin(half_waves * math.pi / (2 * CELLS)) ** 2
            by_cells, directly, moved = COUPLED * (1 - square), COUPLED * square, mobility * STEP * 4 * square * CELLS**2
            theory = by_cells * (directly + moved) / ((storage + directly + moved) * (storage + by_cells))
            found = self.factors("{solve: rock, stabilize: undrained}, {solve: pore}", f"(cos({half_waves * math.pi!r}*y)) Pa",
                                 f"components.pore.permeability={mobility} m^2", f"components.pore.storage={storage} 1/Pa", "components.pore.boundary=null",
                                 "components.rock.boundary={left: {displacement_x: 0 m}, right: {displacement_x: 0 m}, "
                                 "top: {displacement_y: 0 m}, "
                                 "bottom: {displacement_y: 0 m, normal_stress: null}}")
            self.expect(found, theory, f"undrained, {half_waves} half waves, k/mu = {mobility}, S = {storage}")


if __name__ == "__main__":
    unittest.main()
