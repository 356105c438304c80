"""Errors of the two-level scenes against run time: one numerical parameter after the other is changed from the scene's value. Errors
scatter from mesh to mesh, so that each case is run on several that only chance tells apart. Every run is remembered in a file of its
own, with what was measured in it; errors are made of that when it is drawn."""

import hashlib
import itertools
import json
import shutil
import statistics
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable

import numpy as np

import closed_forms as exact
from cases import run_scene
from growth_times import time_to, time_within_steps
from paths import apart
from run_results import ROOT, RunResults

REFERENCE, SECOND = "reference", "second reference"  # the second tells what the first owes to its own parameters
HOUR = 3600


@dataclass
class Parameter:
    symbol: str
    default: str  # the scene's value, or "" where the scene has none of these
    others: dict  # {value: settings}


def parameter(symbol, path, default, *others):
    return Parameter(symbol, default, {value: {path: value} for value in others})


MESHES = [{}, *({"mesh.size": f"{size} m"} for size in ("0.098", "0.102", "0.099", "0.101"))]


@dataclass
class Problem:
    title: str
    scene: str  # in configs
    parameters: dict  # by the name in file names
    measure: Callable  # folder of a run -> what errors are made of
    errors: Callable  # measured of the run and of the reference -> {quantity: signed error}
    units: dict  # by quantity: what errors are of, for axes
    common: dict = field(default_factory=dict)
    grid: tuple = ()  # parameters whose values are combined, too
    references: dict = field(default_factory=dict)  # {REFERENCE: settings, SECOND: settings, …}; none with a closed form
    answer_errors: dict = field(default_factory=dict)  # of a closed form that is an approximation, by quantity
    meshes: int = len(MESHES)

    def choices(self):
        """{name of the case: settings}, what says most first."""
        cases = {"default": {}, **self.references}
        for name, parameter in self.parameters.items():
            cases |= {f"{name}={value}": settings for value, settings in parameter.others.items()}
        for combination in itertools.product(*([None, *self.parameters[name].others] for name in self.grid)):
            changed = [(name, value) for name, value in zip(self.grid, combination) if value]
            if len(changed) > 1:
                cases[",".join(f"{name}={value}" for name, value in changed)] = {
                    path: to for name, value in changed for path, to in self.parameters[name].others[value].items()}
        return {name: {**self.common, **settings} for name, settings in cases.items()}

    def runs(self):
        """[(case, number of the mesh, settings)]: all cases on a mesh, before those on the next; the two finest references on the first."""
        return [(case, mesh, {**settings, **MESHES[mesh]}) for mesh in range(self.meshes)
                for case, settings in self.choices().items() if mesh == 0 or case not in (REFERENCE, SECOND)]


def k_ii_measured(folder):
    """K_II of both tips and its closed form, for the fluid's pressure in the run, at each time with fields."""
    measured = []
    history = RunResults(folder).history
    entries = (folder / "matrix.pvd").read_text().count("<DataSet")
    for run in (RunResults(folder, entry) for entry in range(entries)):
        row = int(np.argmin(abs(history["time"] - run.time)))
        fluxes = run.fracture_field("pore.wall_flux.plus") + run.fracture_field("pore.wall_flux.minus")
        injects = run.time > 6 * HOUR + 1
        if run.time < 6 * HOUR - 1:
            continue
        answer = exact.onset_k_ii(run.fracture_field("conduit.pressure").mean(), run.mean(run.matrix_field("pore.pressure")),
                                  run.fracture_lengths @ fluxes if injects else 0)
        for tip in ("first", "last"):
            measured.append({"time": run.time, "tip": tip, "injects": bool(injects), "exact": float(answer),
                             "K_II": float(abs(history[f"tips.main_{tip}.K_II"][row]))})
    return measured


def k_ii_errors(measured, _):
    """The largest over tips and times, with its sign."""
    def largest(injects):
        return max((value["K_II"] / value["exact"] - 1 for value in measured if value["injects"] == injects), key=abs)
    return {"K_II while injecting": largest(True), "K_II before": largest(False)}


LENGTHS = (0.1, 0.25)


def wings_measured(folder):
    """Hours at which the first tip is critical with a length, and the path."""
    run = RunResults(folder)
    measured = {}
    for wanted in LENGTHS:
        times = [time_to(wanted, run.history["time"], run.history[f"tips.{tip}.length"]) for tip in ("main_first", "main_last")]
        if np.isnan(times).all():
            raise RuntimeError(f"no wing became {wanted} m long")
        measured[f"hours to {wanted} m"] = float(np.nanmin(times) / HOUR)
    points = run.fractures.points[:, :2]
    measured["path"] = points[np.argsort(points[:, 0])].tolist()  # x grows along the fracture and both wings
    return measured


def wings_errors(measured, reference):
    errors = {f"time to {wanted} m": measured[f"hours to {wanted} m"] / reference[f"hours to {wanted} m"] - 1 for wanted in LENGTHS}
    errors["path"] = 1e3 * apart(*(np.array(run["path"]) for run in (measured, reference)))
    return errors


INCREMENT, UPDATE = "components.tips.growth.increment", "schedule.1.update"
MESH_RATIO = parameter("ε_m", "components.tips.mesh_ratio", "0.5", "1", "0.25")


def together(increment, **others):
    """The increment, the cells of fractures and the step, all in the ratio of the scene."""
    return {INCREMENT: f"{increment} mm", "mesh.fracture_size": f"{2 * increment} mm", "time.step": f"{increment / 10} h", **others}


def finer(increment, size):
    return together(increment, **{"mesh.size": size, "components.tips.size": "1 m"})


# The scene has other values, with which it takes least time for its error.
VALUES_OF_PAPER = {"mesh.size": "0.1 m", "mesh.growth": 0.2, "time.step": "1 h", "components.tips.size": "0.5 m", "components.tips.growth": "{increment: 10 mm, front_tolerance: null}"}
PROBLEMS = {
    "k_ii": Problem(
        "K_II of section 5.1", "paper/onset.yaml",
        {"dH": parameter("ΔH", "mesh.fracture_size", "20 mm", "10 mm", "5 mm"),
         "l": parameter("l", "components.tips.size", "0.5 m", "0.25 m", "1 m"),
         "mesh_ratio": MESH_RATIO,
         "step": parameter("Δt", "time.step", "1 h", "3 h", "0.5 h"),
         "growth": parameter("grading of the mesh", "mesh.growth", "0.2", "0.4", "0.1")},
        k_ii_measured, k_ii_errors, {"K_II while injecting": "relative error", "K_II before": "relative error"},
        {"time.end": "21 h", "output.every": "3 h"}, grid=("dH", "l", "growth"),
        # Its back stress is right to 0.05 MPa, which is 0.01 MPa m^0.5 of K_II.
        answer_errors={"K_II while injecting": 0.01e6 / 1.33e6}),
    "wings": Problem(
        "Wings of section 5.2", "paper/wing_cracks.yaml",
        {"together": Parameter("increment = ΔH/2 = Δt·10 mm/h", "10 mm", {f"{length} mm": together(length) for length in (20, 5)}),
         "held": Parameter("growth after steps, together", "", {
             f"{length} mm": together(length, **{UPDATE: "after_step"}) for length in (20, 10, 5)}),
         "dH": parameter("ΔH", "mesh.fracture_size", "20 mm", "40 mm", "10 mm"),
         "step": parameter("Δt", "time.step", "1 h", "2 h", "0.5 h"),
         "increment": parameter("increment", INCREMENT, "10 mm", "20 mm", "5 mm"),
         "l": parameter("l", "components.tips.size", "0.5 m", "0.3 m", "1 m"),
         "growth": parameter("grading of the mesh", "mesh.growth", "0.2", "0.1")},
        wings_measured, wings_errors,
        {"time to 0.1 m": "relative error", "time to 0.25 m": "relative error", "path": "distance (mm)"},
        {"output.every": "1000 h", **VALUES_OF_PAPER}, meshes=3,
        references={REFERENCE: finer(2.5, "0.025 m"), SECOND: finer(5, "0.05 m")}),
}


def identity(problem, settings):
    text = (ROOT / "configs" / problem.scene).read_text() + json.dumps(settings, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def file_of(folder, name, case, mesh):
    return folder / "two_level" / name / f"{case.replace(' ', '')}.mesh{mesh + 1}.json"


def kept(folder, name, case, mesh, settings):
    file = file_of(folder, name, case, mesh)
    if not file.exists():
        return None
    result = json.loads(file.read_text())
    return result if result["identity"] == identity(PROBLEMS[name], settings) else None


def measure(name, case, settings, program, limit):
    problem, scratch = PROBLEMS[name], Path(tempfile.mkdtemp())
    result = {"problem": name, "case": case, "settings": settings, "identity": identity(problem, settings)}
    try:
        run_scene(program, ROOT / "configs" / problem.scene, settings, scratch / "run", limit)
        record = json.loads((scratch / "run" / "run.json").read_text())
        seconds = sum(value for timer, value in record["timings"].items() if timer.startswith("processor: "))
        result.update(seconds=seconds, wall_seconds=record["seconds"], counters=record["counters"],
                      commit=record["program"]["git_commit"], measured=problem.measure(scratch / "run"))
    except RuntimeError as failure:
        result["failure"] = str(failure)
    finally:
        shutil.rmtree(scratch)
    return result


def run_cases(names, program, folder, limit, again):
    for name in names:
        for case, mesh, settings in PROBLEMS[name].runs():
            if not again and kept(folder, name, case, mesh, settings):
                continue
            result = measure(name, case, settings, program, limit)
            file = file_of(folder, name, case, mesh)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps(result, indent=1) + "\n")
            print(f"{name}/{case}, mesh {mesh + 1}".ljust(55) +
                  (f"FAILED: {result['failure']}" if "failure" in result else f"{result['seconds']:9.2f} s"), flush=True)


@dataclass
class Case:
    """What is known of one choice of parameters, from its runs on all meshes so far."""

    runs: list
    errors: dict = field(default_factory=dict)  # {quantity: signed errors of the runs}; empty where there is nothing to compare with

    @property
    def seconds(self):
        return statistics.median(run["seconds"] for run in self.runs)

    def error(self, quantity):
        return statistics.mean(map(abs, self.errors[quantity]))


def all_results(name, folder):
    """{case: Case} and failed runs; nothing of what has changed since it was run."""
    problem, found, failed = PROBLEMS[name], {}, []
    for case, mesh, settings in problem.runs():
        result = kept(folder, name, case, mesh, settings)
        if result and "failure" in result:
            failed.append(result)
        elif result:
            found.setdefault(case, Case([])).runs.append(result)
    reference = found[REFERENCE].runs[0]["measured"] if REFERENCE in found else None
    for case in found.values() if reference or not problem.references else ():
        each = [problem.errors(run["measured"], reference) for run in case.runs]
        case.errors = {quantity: [errors[quantity] for errors in each] for quantity in problem.units}
    return found, failed


def records(levels):
    """For bench.json: all runs, with their errors."""
    return [{**run, "errors": {quantity: errors[i] for quantity, errors in case.errors.items()}}
            for cases, _ in levels.values() for case in cases.values() for i, run in enumerate(case.runs)] + [
            run for _, failed in levels.values() for run in failed]


def compared(cases):
    """Those with errors; the reference itself is none."""
    return {name: case for name, case in cases.items() if case.errors and name != REFERENCE}


def front(cases, quantity):
    """The cases that no other beats in both seconds and error, by rising seconds; 1 % less of an error does not count."""
    best = []
    for name, case in sorted(compared(cases).items(), key=lambda entry: entry[1].seconds):
        if not best or case.error(quantity) < 0.99 * cases[best[-1]].error(quantity):
            best.append(name)
    return best


def better(cases, parameter, quantity):
    """{other values of one parameter that are on every count at least as good as the default: gain of the error, a share of it}. Faster by
    10 %, which processor times on a shared machine differ by anyway. The gain is more than two standard errors of the differences
    mesh by mesh, or else 0: below 2 %, errors are the same."""
    default, found = cases["default"], {}
    for name, case in compared(cases).items():
        if name.partition("=")[0] != parameter or "," in name or case.seconds > 0.9 * default.seconds:
            continue
        gains = [(abs(before) - abs(now)) / default.error(quantity)
                 for before, now in zip(default.errors[quantity], case.errors[quantity])]
        if len(gains) > 1 and max(map(abs, gains)) < 0.02:
            found[name] = 0
        elif len(gains) > 1 and statistics.mean(gains) > 2 * statistics.stdev(gains) / len(gains)**0.5:
            found[name] = statistics.mean(gains)
    return found
