#!/usr/bin/python3
"""Run time against error: see tools/bench --help."""

import argparse
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

import cases
import smoke
import two_level
from problems import PROBLEMS
from run_results import ROOT

# What prints a table of its own, from programs in the build folder.
TABLES = {
    "discretization": "seconds of TPFA, MPFA, MPSA on unstructured triangles, beside PorePy's",
    "growth_steps": "where the seconds of section 5.2 go, by kind of step and by part, and those of section 5.1",
    "scaling": "seconds, memory and messages of each of 1, 2 and 4 processes",
    "skip": "what scenes from flow alone to the full model have, and seconds beside dedicated minimal programs",
    "step": "where the seconds of a step of section 5.1 go, on uniform meshes",
}


def parse():
    parser = argparse.ArgumentParser(
        prog="tools/bench", description="Runs the benchmarks of the given names, all by default. What has been run is kept.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="subset; see --list")
    parser.add_argument("--list", action="store_true", help="say what there is, and what of it has been run")
    parser.add_argument("--solvers", metavar="S,…", help="only these: umfpack, mumps, belos, auto")
    parser.add_argument("--again", action="store_true", help="run again what is there")
    parser.add_argument("--limit", type=float, default=600, metavar="SECONDS", help="of one run in processor time; finer meshes are left then")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "bench", metavar="DIR", help="default: %(default)s")
    parser.add_argument("--pictures", type=Path, metavar="DIR", help="also write PNG pictures, for the documentation")
    parser.add_argument("--smoke", action="store_true", help="compare the counts of small scenes with tools/benchmark/smoke.json")
    parser.add_argument("--update", action="store_true", help="with --smoke: take over an intended change")
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    return parser.parse_args()


def machine():
    processor = next((line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines()
                      if line.startswith("model name")), platform.machine())
    return f"{processor}, {os.cpu_count()} cores, one thread used"


def list_cases(names, options, program):
    for name in names:
        if name in TABLES:
            print(f"{name:<18} {TABLES[name]}")
            continue
        if name in two_level.PROBLEMS:
            found, failed = two_level.all_results(name, options.out)
            done = sum(len(case.runs) for case in found.values()) + len(failed)
            print(f"{name:<18} {two_level.PROBLEMS[name].title}, two levels: {done} of {len(two_level.PROBLEMS[name].runs())} runs done")
            continue
        all_of_it = list(cases.all_cases([name], options.solvers, program))
        done = sum(cases.kept(case, options.out) is not None for case in all_of_it)
        print(f"{name:<18} {PROBLEMS[name].title}: {done} of {len(all_of_it)} runs done")


def step_times(program, folder, again):
    """`onset_coarse` on a mesh of one size everywhere, half of the steps with injection."""
    runs = []
    for size in ("0.04", "0.02", "0.01"):
        run = folder / "step" / size
        if again or not (run / "run.json").exists():
            subprocess.run([program, "run", "-q", ROOT / "configs/paper/onset_coarse.yaml", "-o", run, "--set", f"mesh.size={size}",
                            "--set", f"mesh.fracture_size={size}", "--set", "time.end=12 h", "--set", "output.fields=false"],
                           check=True)
        runs.append(run)
    subprocess.run([sys.executable, ROOT / "tools/benchmark/step_times.py", *runs], check=True)


def main():
    options = parse()
    everything = [*PROBLEMS, *two_level.PROBLEMS, *TABLES]
    unknown = [name for name in options.names if name not in everything]
    if unknown:
        sys.exit(f"unknown benchmark '{unknown[0]}' (there are: {', '.join(everything)})")
    options.solvers = options.solvers.split(",") if options.solvers else None
    names = options.names or everything
    program = str(options.build / "sprekk")
    if options.smoke:
        sys.exit(smoke.smoke(program, options.update))
    if options.list:
        list_cases(names, options, program)
        return

    import growth_steps
    import page  # draws with matplotlib, which takes a while to load
    import skip
    import two_level_page

    problems = [name for name in names if name in PROBLEMS]
    cases.run_cases(cases.all_cases(problems, options.solvers, program), program, options.out, options.limit, options.again)
    two_level.run_cases([name for name in names if name in two_level.PROBLEMS], program, options.out, options.limit, options.again)
    if "discretization" in names:
        subprocess.run([options.build / "bench_discretization"], check=True)
    if "growth_steps" in names:
        growth_steps.measure(program, options.out, options.again)
    if "skip" in names:
        skip.measure(program, options.build / "bench_minimal", options.out, options.again)
    if "scaling" in names:
        subprocess.run([sys.executable, ROOT / "tools/benchmark/scaling.py", program, options.out / "scaling"], check=True)
    if "step" in names:
        step_times(program, options.out, options.again)
    results = cases.all_results(options.out)
    levels = {name: two_level.all_results(name, options.out) for name in two_level.PROBLEMS}
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "bench.json").write_text(json.dumps({"machine": machine(), "results": results, "two_level": two_level.records(levels)}, indent=1) + "\n")
    page.write_page(results, options.out / "bench.html", machine(), [*two_level_page.sections(levels), *skip.sections(options.out)])
    if options.pictures:
        page.write_pictures(results, options.pictures)
        two_level_page.write_pictures(levels, options.pictures)
    print(f"results: {options.out / 'bench.html'}")


if __name__ == "__main__":
    main()
