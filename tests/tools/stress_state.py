"""A state that fulfils all that tools/stress checks, and what changes it. Whoever imports this finds the suite, too."""

import copy
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools/python")]
import sprekk  # noqa: E402
from stress_suite import physics, written  # noqa: E402

P = {"young": 2.5e9, "poisson": 0.25, "alpha": 0.0, "permeability": 1e-15, "viscosity": 1e-3, "storage": 1e-10,
     "compressibility": 1e-9, "friction": 0.5, "dilation": 10.0, "aperture": 1e-3, "width": 4.0, "height": 4.0,
     "length": 0.5, "sides": "stress", "stress": 1e7, "ratio": 2.0, "history": "constant", "initial": 1e6,
     "boundary": "none", "boundary_pressure": 0.0, "family": "separate", "well": "none", "volume": 0.1, "relative_step": 1.0, "steps": 1}


def grids(n=8, columns=(2, 3, 4, 5)):
    """A square of 4 m in triangles, n squares along a side, and a fracture on its middle line, in some columns."""
    points = np.array([[4 * i / n, 4 * j / n, 0] for j in range(n + 1) for i in range(n + 1)])
    triangles = []
    for j in range(n):
        for i in range(n):
            a, b = j * (n + 1) + i, (j + 1) * (n + 1) + i
            triangles += [[a, a + 1, b + 1], [a, b + 1, b]]
    row = n // 2 * (n + 1)
    lines = [[row + i, row + i + 1] for i in columns]
    return sprekk.Grid(points, np.array(triangles)), sprekk.Grid(points, np.array(lines))


def at_rest():
    """A state that fulfils everything: uniform stress, a very small slip with its friction and dilation in two cells."""
    matrix, lines = grids()
    cells = len(matrix.cells)
    x, y = physics.stresses(P, 1.0)
    matrix.cell_data = {"pore.pressure[Pa]": np.full(cells, P["initial"]),
                        "rock.stress[Pa]": np.tile([x, y, 0.0], (cells, 1)),
                        "rock.displacement[m]": np.zeros((cells, 3))}
    slip = np.array([0.0, 1e-5, 1e-5, 0.0])
    opening = slip * np.tan(np.radians(P["dilation"]))
    normal, shear = np.full(4, -4e6), np.array([1e6, 2e6, 2e6, -1e6])
    pressure = np.full(4, P["initial"])
    length = 0.5
    flux = -length * opening / physics.time_step(P) / length / 2  # what opens comes out of the rock
    lines.cell_data = {"contact.traction.normal[Pa]": normal, "contact.traction.tangential[Pa]": shear,
                       "contact.jump.normal[m]": opening, "contact.jump.tangential[m]": slip,
                       "rock.wall_traction.normal[Pa]": normal - pressure, "rock.wall_traction.tangential[Pa]": shear,
                       "conduit.pressure[Pa]": pressure, "conduit.aperture[m]": P["aperture"] + opening,
                       "pore.wall_flux.plus[m/s]": flux, "pore.wall_flux.minus[m/s]": flux, "fracture": np.zeros(4, int)}
    drained = 2 * (physics.time_step(P) * length * flux).sum() / (P["storage"] * 16.0)
    matrix.cell_data["pore.pressure[Pa]"] += drained
    return written.Instant(physics.end(P), matrix, lines, follows=True)


def change(where, name, cell, value):
    instant = copy.deepcopy(at_rest())
    getattr(instant, where).cell_data[name][cell] += value
    return [instant]
