"""What tests of flow in space share: a scene with a linear pressure, and its runs."""

import numpy as np

from scene_runs import SceneRuns

SIDES = ("left", "right", "front", "back", "bottom", "top")
# Two fractures that cut the box and each other, in general position but for one axis, and one with its rim in the rock.
CUTS = {"one": [[0.3, 0, 0], [0.5, 1.2, 0], [0.6, 1.2, 0.9], [0.4, 0, 0.9]],
        "other": [[0, 0.4, 0], [1, 0.7, 0], [1, 0.8, 0.9], [0, 0.5, 0.9]]}
FLOWS = [f"{flow}.{side}.outflow[m^3/s]" for flow in ("pore", "conduit") for side in SIDES]
LINEAR = "(1 + x/m - 2*y/m + 0.5*z/m) Pa"


def linear(x):
    return 1 + x[..., 0] - 2 * x[..., 1] + 0.5 * x[..., 2]


def scene(mesh, fractures, flow="mfd", rock="mpfa", pressure=LINEAR, more="", rock_more="", fluid="viscosity: 1 Pa*s, fluid_compressibility: 0 1/Pa",
          walls="1e10 m/(Pa*s)", box="{x: [0 m, 1 m], y: [0 m, 1.2 m], z: [0 m, 0.9 m]}", end="1 s"):
    """The text of a scene with these fractures, whose pressure is given on all sides (none where `pressure` is None)."""
    sides = ", ".join(f"{side}: {{pressure: {pressure}}}" for side in SIDES) if pressure else ""
    corners = "".join(f"    {name}: {{points: {[[f'{float(c)!r} m' for c in point] for point in points]}}}\n".replace("'", "")
                      for name, points in fractures.items())
    conduit = f"""
  conduit:
    type: fracture_flow/{flow}
    {fluid.replace(', ', chr(10) + '    ')}
    initial_aperture: 0.1 mm
    transmissivity: constant
    transmissivity_value: 1 m^3
    normal_permeability: constant
    normal_permeability_value: {walls}
    boundary: {{{sides}}}""" if fractures else ""
    coupling = "couplers:\n  - {type: wall_exchange, between: [pore, conduit]}\n" if fractures else ""
    return f"""
name: in_space
geometry:
  box: {box}
{'  fractures:' if fractures else ''}
{corners}
mesh: {mesh}
components:
  pore:
    type: matrix_flow/{rock}
    permeability: {{xx: 1 m^2, yy: 2 m^2, zz: 1.5 m^2, xy: 0.3 m^2, yz: -0.2 m^2, xz: 0.4 m^2}}
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary: {{{sides}}}
{rock_more}{conduit}
{coupling}
schedule:
  - solve: [{'pore, conduit' if fractures else 'pore'}]
time: {{end: {end}, step: {end}}}
{more}
"""


class SpaceRuns(SceneRuns):
    def run_text(self, text, *settings, **how):
        return self.run_scene(self.write(text, f"scene_{next(self.numbers)}.yaml"), *settings, **how)

    def assert_linear(self, results, within):
        rock = results.fields()
        self.assertEqual(rock.dimension, 3)
        self.assertLess(np.abs(rock["pore.pressure"] - linear(rock.centres)).max(), within)
        if "fractures.pvd" in {path.name for path in results.folder.iterdir()}:
            lines = results.fractures()
            self.assertLess(np.abs(lines["conduit.pressure"] - linear(lines.centres)).max(), within)
