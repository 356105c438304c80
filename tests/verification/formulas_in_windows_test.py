#!/usr/bin/python3
"""formulas_in_windows_test.py SPREKK [MPIEXEC]: laws that are formulas of the state, and jump at given times: steps end at the jumps, and take the value before
them. Against the same numbers as data, and against the laws themselves."""

import unittest

import numpy as np
from scene_runs import MPIEXEC, SceneRuns

COLUMN = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 1 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [4, 1]}
components:
  pore: {type: matrix_flow/tpfa, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: 0 1/Pa, boundary: {left: {pressure: 1 MPa}, right: {pressure: 0 Pa}}}
schedule: [{solve: pore}]
time: {end: 400 s, step: 100 s}
output: {fields: false}
"""
PIPE = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 2 m]}, fractures: {f: {points: [[0 m, 1 m], [4 m, 1 m]]}}}
mesh: {size: 1 m}
components:
  conduit:
    {type: fracture_flow/tpfa, viscosity: 1 mPa*s, initial_aperture: 0.1 mm, fluid_compressibility: 1e-12 1/Pa, law: {type: constant, transmissivity: 1e-14 m^3},
     boundary: {left: {pressure: 1 MPa}, right: {pressure: 0 Pa}}}
schedule: [{solve: conduit}]
time: {end: 400 s, step: 100 s}
output: {fields: false}
"""
SHEARED = """
geometry: {box: {x: [0 m, 4 m], y: [0 m, 2 m]}, fractures: {f: {points: [[0 m, 1 m], [4 m, 1 m]]}}}
mesh: {size: 1 m}
components:
  rock:
    type: poromechanics/mpsa
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    boundary:
      bottom: {displacement: [0 m, 0 m]}
      top: {displacement: ["(1e-5*t) m", -1 mm]}
      left: {displacement_y: "(-1e-3*y/2) m"}
      right: {displacement_y: "(-1e-3*y/2) m"}
  contact: {type: contact/coulomb, friction: 0.3}
couplers: [{type: wall_traction, between: [rock, contact]}]
schedule: [{solve: [rock, contact]}]
time: {end: 400 s, step: 100 s}
output: {fields: false, probes: {traction: {of: contact.traction, at: [2 m, 1 m]}, jump: {of: contact.jump, at: [2 m, 1 m]}}}
"""
TIMES = [100, 150, 250, 300, 400]


def window(value, added):
    """A value to which `added` comes from 150 s to 300 s."""
    return f"[{{value: '{value}'}}, {{value: '{added}', from: 150 s, to: 300 s}}]"


class FormulasInWindows(SceneRuns):
    def run_with(self, text, *settings, **more):
        run = self.run_scene(self.write(text), *settings, **more)
        np.testing.assert_allclose(run.times, TIMES, rtol=1e-12)
        return run

    def test_formulas_have_the_answer_of_data(self):
        for text, where, value, added, nothing, column, last in (
                (COLUMN, "components.pore.permeability", "1e-15 m^2", "3e-15 m^2", "*(1 + 0*p/(1 Pa))", "pore.right.outflow[m^2/s]", 1e-15 / 4 * 1e9),
                (PIPE, "components.conduit.law", "1e-14 m^3", "3e-14 m^3", "*(1 + 0*p/(1 Pa))", "conduit.right.outflow[m^2/s]", 1e-14 / 4 * 1e9),
                (SHEARED, "components.contact.friction", "0.3", "0.2", " + 0*slip/(1 m)", "traction.t[Pa]", None)):
            forms = []
            for first, second in (("", ""), (nothing, nothing), (nothing, ""), ("", nothing)):
                law = window(value + first, added + second)
                if where.endswith("law"):
                    law = f"{{type: {'formula' if first + second else 'constant'}, transmissivity: {law}}}"
                forms.append(self.run_with(text, f"{where}={law}")[column])
            if last:
                np.testing.assert_allclose(forms[0] / last, [1, 1, 4, 4, 1], rtol=1e-6)  # the fluid is compressible, by 1e-6
            for form in forms[1:]:
                np.testing.assert_allclose(form, forms[0], rtol=1e-9, err_msg=where)

    def test_twins(self):
        # By two stages, in substeps, on two processes, mirrored, and in space, a formula has the answer of the data; a disturbed one almost the same.
        mirrored = COLUMN.replace("left: {pressure: 1 MPa}, right: {pressure: 0 Pa}", "right: {pressure: 1 MPa}, left: {pressure: 0 Pa}")
        in_space = COLUMN.replace("y: [0 m, 1 m]", "y: [0 m, 1 m], z: [0 m, 1 m]").replace("quadrilaterals, cells: [4, 1]", "hexahedra, cells: [4, 1, 1]")
        substeps = "schedule=[{subcycle: {count: 3, steps: [{solve: STEPS}]}}]"
        variants = [(COLUMN, ("time.scheme=sdirk2",), 1), (COLUMN, (substeps.replace("STEPS", "pore"),), 1), (mirrored, (), 1), (in_space, (), 1),
                    (SHEARED, ("time.scheme=sdirk2",), 1), (SHEARED, (substeps.replace("STEPS", "[rock, contact]"),), 1)]
        if MPIEXEC:
            variants += [(COLUMN, (), 2), (SHEARED, (), 2)]
        for text, settings, processes in variants:
            is_flow = text is not SHEARED
            where, value, added, nothing = (("components.pore.permeability", 1e-15, "3e-15 m^2", " m^2*(1 + 0*p/(1 Pa))") if is_flow
                                            else ("components.contact.friction", 0.3, "0.2", " + 0*slip/(1 m)"))
            laws = (f"{value}{' m^2' if is_flow else ''}", f"{value}{nothing}", f"{value * (1 + 1e-9)!r}{nothing}")
            runs = [self.run_with(text, f"{where}={window(law, added)}", *settings, processes=processes) for law in laws]
            column = "traction.t[Pa]" if not is_flow else next(
                name for name in runs[0].history if name.startswith("pore.left.outflow" if text is mirrored else "pore.right.outflow"))
            data, formula, disturbed = (run[column] for run in runs)
            np.testing.assert_allclose(formula, data, rtol=1e-9, err_msg=f"{settings} {processes}")
            np.testing.assert_allclose(disturbed, data, rtol=1e-8, err_msg=f"{settings} {processes}")
            if is_flow:
                np.testing.assert_allclose(data / data[0], [1, 1, 4, 4, 1], rtol=1e-9, err_msg=f"{settings} {processes}")

    def test_cohesion(self):
        for value in ("1 MPa", "1 MPa + 0*slip*(1 Pa/m)"):
            run = self.run_with(SHEARED, f"components.contact.cohesion={window(value, '2 MPa')}")
            over = np.abs(run["traction.t[Pa]"]) - 0.3 * np.abs(run["traction.n[Pa]"])
            np.testing.assert_allclose(over[[1, 4]], 1e6, rtol=1e-8)  # it slips before the window, and after
            self.assertGreater(over[3], 1.1e6)
            self.assertLess(over[3], 3e6 * (1 + 1e-8))

    def test_dilation(self):
        run = self.run_with(SHEARED, "components.contact.dilation=" + window("0.1*slip", "0.2*slip"))
        np.testing.assert_allclose(run["jump.n[m]"] / np.abs(run["jump.t[m]"]), [0.1, 0.1, 0.3, 0.3, 0.1], rtol=1e-7)


if __name__ == "__main__":
    unittest.main()
