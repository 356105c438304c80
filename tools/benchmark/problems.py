"""The problems of tools/bench: scenes with closed-form answers, on meshes from coarse to fine."""

from dataclasses import dataclass, field
from typing import Callable

import numpy as np

import closed_forms as exact
from run_results import relative_error


@dataclass
class Problem:
    title: str
    scene: str  # in configs
    levels: list  # [(label, {path: value})] from coarse to fine
    errors: Callable  # RunResults -> {quantity: relative error}; the first is drawn
    variants: dict = field(default_factory=lambda: {"mpfa": {}})
    common: dict = field(default_factory=dict)
    solvers: tuple = ("umfpack", "mumps", "belos")
    has_contact: bool = False
    published: list = field(default_factory=list)  # {"label", "unknowns", "seconds", "error"}, what is known of each


FLOWS = {"mpfa": {}, "tpfa": {"components.pore.type": "matrix_flow/tpfa"}}


def matrix_errors(run, pressure, displacement=None):
    errors = {"pressure": relative_error(run.areas, run.matrix_field("pore.pressure"), pressure)}
    if displacement is not None:
        errors["displacement"] = relative_error(run.areas, run.matrix_field("rock.displacement"), displacement)
    return errors


def terzaghi_errors(run):
    return matrix_errors(run, exact.terzaghi_pressure(run.centres[:, 1], run.time / run.steps, run.steps))


def mandel_errors(run):
    mandel, (x, y) = exact.Mandel(), run.centres.T
    return matrix_errors(run, mandel.pressure(x, run.time, run.steps), mandel.displacement(x, y, run.time, run.steps))


def manufactured_errors(run):
    return matrix_errors(run, *exact.manufactured_biot(*run.centres.T))


def barry_mercer_errors(run):
    x, y = run.centres.T
    p, u = exact.barry_mercer(x, y, run.time / run.steps, run.steps)
    # The pressure is infinite at the well, and no mesh resolves that: errors are of what is farther than 0.1 m from it.
    far = np.hypot(x - 0.25, y - 0.25) > 0.1
    errors = {"pressure": relative_error(run.areas[far], run.matrix_field("pore.pressure")[far], p[far])}
    errors["displacement"] = relative_error(run.areas[far], run.matrix_field("rock.displacement")[far], u[far])
    return errors


def single_mode_errors(run):
    matrix, fracture = exact.single_mode()
    errors = matrix_errors(run, matrix(*run.centres.T))
    errors["fracture pressure"] = relative_error(run.fracture_lengths, run.fracture_field("conduit.pressure"),
                                                 fracture(run.fracture_centres[:, 0]))
    return errors


def crack_errors(run, component, peak):
    distance = np.linalg.norm(run.fracture_centres, axis=1)
    jump = abs(run.fracture_field(f"contact.jump.{component}"))
    answer = exact.elliptic(distance, 1, peak)
    inner = distance < 0.85
    return {"jump": relative_error(run.fracture_lengths, jump, answer),
            "jump without the tips": relative_error(run.fracture_lengths[inner], jump[inner], answer[inner])}


def fault_errors(run):
    slip = abs(run.fracture_field("contact.jump.tangential"))
    answer = exact.viesca_slip(run.fracture_centres[:, 0], run.time)
    return {"slip": relative_error(run.fracture_lengths, slip, answer)}


def onset_errors(run):
    flux = run.fracture_lengths @ (run.fracture_field("pore.wall_flux.plus") + run.fracture_field("pore.wall_flux.minus"))
    distance = np.linalg.norm(run.fracture_centres - 1, axis=1)
    answer = exact.onset_slip(distance, run.fracture_field("conduit.pressure").mean(),
                              run.mean(run.matrix_field("pore.pressure")), flux)
    return {"slip": relative_error(run.fracture_lengths, abs(run.fracture_field("contact.jump.tangential")), answer)}


def sizes(*values):
    return [(f"{v} m", {"mesh.size": f"{v} m"}) for v in values]


def graded(*values):
    """The grading is refined with the crack, so that all of the error falls."""
    return [(f"{v} m", {"mesh.size": "32 m", "mesh.fracture_size": f"{v} m", "mesh.growth": 2 * v}) for v in values]


PROBLEMS = {
    "terzaghi": Problem(
        "Terzaghi's consolidation, 10 steps", "verification/terzaghi.yaml",
        [(f"{n} cells", {"mesh.shape": "triangles", "mesh.cells": f"[{n // 10}, {n}]"}) for n in (20, 40, 80, 160, 320)],
        terzaghi_errors, FLOWS,
        # pressure at two times, with the error of its time steps
        published=[{"label": "PorePy, 80 cells, error of its time steps included", "seconds": 12, "error": 1.0e-3}]),
    "mandel": Problem(
        "Mandel's problem, 10 steps", "verification/mandel.yaml", sizes(0.1, 0.05, 0.025, 0.0125, 0.00625),
        mandel_errors, FLOWS,
        published=[{"label": "PorePy, 100 m x 10 m, h = 2 m, error of its time steps included", "seconds": 3.1,
                    "error": 2.2e-3}]),
    "barry_mercer": Problem(
        "Barry and Mercer's well, 100 steps", "verification/barry_mercer.yaml",
        [(f"{n} x {n}", {"mesh.cells": f"[{n}, {n}]"}) for n in (8, 16, 32, 64, 128)], barry_mercer_errors, FLOWS,
        solvers=("umfpack", "mumps")),
    "biot_manufactured": Problem(
        "Manufactured solution of Biot's equations", "verification/biot_manufactured.yaml",
        sizes(0.1, 0.05, 0.025, 0.0125, 0.00625), manufactured_errors, FLOWS,
        published=[{"label": "PorePy", "unknowns": 3 * cells, "error": error}
                   for cells, error in ((248, 2.05e-2), (944, 5.56e-3), (3712, 1.41e-3), (14788, 3.53e-4))]),
    "single_mode": Problem(
        "Single mode across a fracture", "verification/single_mode_fracture.yaml",
        sizes(0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125), single_mode_errors, FLOWS),
    "frictional_crack": Problem(
        "Frictional crack", "verification/frictional_crack.yaml", graded(0.2, 0.1, 0.05, 0.025, 0.0125),
        lambda run: crack_errors(run, "tangential", exact.phan_peak()), {"mpsa": {}}, has_contact=True),
    "pressurized_crack": Problem(
        "Pressurized crack", "verification/pressurized_crack.yaml", graded(0.2, 0.1, 0.05, 0.025, 0.0125),
        lambda run: crack_errors(run, "normal", exact.SNEDDON_PEAK), {"mpsa": {}}, has_contact=True),
    "injection_fault": Problem(
        "Injection into a frictional fault", "verification/injection_fault.yaml",
        [(f"{s} m", {"mesh.fracture_size": f"{s} m", "mesh.growth": 5 * s, "time.step": f"{s / 5} s"})
         for s in (0.4, 0.2, 0.1, 0.05, 0.025, 0.016)], fault_errors, {"mpsa": {}}, {"time.end": "0.5 s"},
        has_contact=True),
    "onset": Problem(
        "Section 5.1, closed form with back stress, 21 steps", "paper/onset_coarse.yaml",
        [(f"{s} mm", {"mesh.fracture_size": f"{s} mm", "mesh.size": f"{20 * s} mm"}) for s in (20, 10, 5, 2.5, 1.25, 0.625, 0.55)],
        onset_errors, FLOWS, {"time.end": "21 h"}, has_contact=True),
}
