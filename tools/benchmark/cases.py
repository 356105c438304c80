"""Work-precision runs: every problem x variant x solver x mesh is a case, run once and remembered in a file of its own."""

import hashlib
import json
import os
import resource
import shutil
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from problems import PROBLEMS
from run_results import ROOT, RunResults


@dataclass
class Case:
    problem: str
    variant: str
    solver: str
    level: int

    @property
    def name(self):
        return f"{self.problem}/{self.variant}/{self.solver}/{PROBLEMS[self.problem].levels[self.level][0]}"

    @property
    def settings(self):
        problem = PROBLEMS[self.problem]
        solver, _, condensed = self.solver.partition("+")
        settings = {**problem.common, **problem.variants[self.variant], **problem.levels[self.level][1],
                    "solver.type": solver}
        if condensed:
            settings["solver.condense"] = {"condensed": "true", "whole": "false"}[condensed]
        return settings

    @property
    def scene(self):
        return ROOT / "configs" / PROBLEMS[self.problem].scene

    def identity(self):
        """Changes with anything that the run reads; the version of the program is noted, but makes no other case."""
        text = self.scene.read_text() + json.dumps(self.settings, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def file(self, folder):
        label = PROBLEMS[self.problem].levels[self.level][0].replace(" ", "")
        return folder / self.problem / f"{self.variant}.{self.solver}.{label}.json"


def condensing_is_a_choice(program):
    explained = subprocess.run([program, "explain", "solver"], capture_output=True, text=True)
    return "condense:" in explained.stdout


def all_cases(names, solvers, program):
    choice = condensing_is_a_choice(program)
    for name in names:
        problem = PROBLEMS[name]
        for index, variant in enumerate(problem.variants):
            # What a solver costs is seen with the first choice of components; errors of the others need one solver.
            for solver in problem.solvers if index == 0 else ("mumps",):
                # Only direct solvers condense, and only what has a nonlinear part on fractures gains by it.
                both = choice and problem.has_contact and solver != "belos"
                kinds = [f"{solver}+condensed", f"{solver}+whole"] if both else [solver]
                for kind in kinds:
                    if solvers and kind not in solvers and solver not in solvers:
                        continue
                    for level in range(len(problem.levels)):
                        yield Case(name, variant, kind, level)


def child_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run_scene(program, scene, settings, folder, limit):
    """Wall and processor seconds of the whole process, of which the latter are limited; raises with what it printed when it fails."""
    arguments = [program, "run", "-q", str(scene), "-o", str(folder)]
    for path, value in settings.items():
        arguments += ["--set", f"{path}={value}"]
    processor, wall = child_seconds(), time.monotonic()
    done = subprocess.run(arguments, capture_output=True, text=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + 5)),
                          env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"})
    wall, processor = time.monotonic() - wall, child_seconds() - processor
    if done.returncode == -signal.SIGXCPU:
        raise RuntimeError(f"took more than {limit:g} s")
    if done.returncode:
        raise RuntimeError((done.stderr or done.stdout).strip().splitlines()[-1] if done.stderr or done.stdout else
                           f"exit code {done.returncode}")
    return wall, processor


def measure(case, program, limit):
    scratch = Path(tempfile.mkdtemp())
    result = {"name": case.name, "problem": case.problem, "variant": case.variant, "solver": case.solver,
              "level": PROBLEMS[case.problem].levels[case.level][0], "settings": case.settings,
              "identity": case.identity()}
    try:
        wall, processor = run_scene(program, case.scene, case.settings, scratch / "run", limit)
        run = RunResults(scratch / "run")
        result.update(solved_in(run.record, wall, processor))
        result["errors"] = PROBLEMS[case.problem].errors(run)
    except RuntimeError as failure:
        result["failure"] = str(failure)
    finally:
        shutil.rmtree(scratch)
    return result


def solved_in(record, wall, processor):
    """Seconds of all steps: discretization, assembly and solves, without the mesh and output. On a machine that others use too,
    processor time is the steadier; the share of output is that of the wall time."""
    profile = {entry["name"]: entry for entry in record["profile"]}
    steps = sum(entry["seconds"] for name, entry in profile.items() if name not in ("output", "change of mesh"))
    computed = record["timings"]["processor: steps and output"] * steps / (steps + profile["output"]["seconds"])
    return {"seconds": computed, "wall_seconds": steps, "process_wall_seconds": wall, "process_seconds": processor,
            "profile": {name: entry["seconds"] for name, entry in profile.items()},
            "unknowns": record["counters"]["unknowns"], "cells": record["counters"]["mesh: cells"],
            "counters": record["counters"], "steps": record["counters"]["steps accepted"],
            "commit": record["program"]["git_commit"], "blas": record["program"]["blas"]}


def kept(case, folder):
    """The remembered result of the same case, or nothing."""
    file = case.file(folder)
    if not file.exists():
        return None
    result = json.loads(file.read_text())
    return result if result["identity"] == case.identity() else None


def run_cases(cases, program, folder, limit, again):
    """Runs what is not there yet, from coarse to fine. When a mesh took too long, or the solver failed, finer ones are left."""
    hopeless = set()
    for case in cases:
        line = (case.problem, case.variant, case.solver)
        result = None if again else kept(case, folder)
        if result is None and line not in hopeless:
            result = measure(case, program, limit)
            file = case.file(folder)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps(result, indent=1) + "\n")
            print(text_line(result), flush=True)
        if result is None:
            continue
        if "failure" in result:
            hopeless.add(line)


def text_line(result):
    if "failure" in result:
        return f"{result['name']:<55} FAILED: {result['failure']}"
    errors = ", ".join(f"{name} {error:.2e}" for name, error in result["errors"].items())
    return f"{result['name']:<55} {result['unknowns']:>8} unknowns {result['seconds']:>9.3f} s  {errors}"


def all_results(folder):
    results = [json.loads(file.read_text()) for file in sorted(folder.glob("*/*.json"))]
    current = []
    for result in results:
        if result.get("problem") in PROBLEMS:
            current.append(result)
    return sorted(current, key=lambda r: (list(PROBLEMS).index(r["problem"]), r["variant"], r["solver"],
                                          r.get("unknowns", 0)))
