#!/usr/bin/env python3
"""scene_swaps_test.py SPREKK [SCENE…] [--all]: every scene of configs/ with every other component of each role, one at a time.

Each swapped scene is refused by `check` with a reason, or its first steps run and their probes stay near those of the scene as it is.
What may be refused, and why, is said here (REFUSED); nothing else may. All swaps are checked; without --all a sample of them is run."""

import csv
import math
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# The types of a role, with what else is to be said. (The one type of flow in fractures has laws, which have tests of their own.)
ROLES = {
    "matrix_flow": [("mpfa", {}), ("tpfa", {}), ("rt0", {}), ("ntpfa", {})],
    "poromechanics": [("mpsa", {}), ("fem", {"order": "first"}), ("fem", {"order": "second"})],
    "contact": [("coulomb", {}), ("augmented_lagrangian", {}), ("penalty", {})],
    "fine_fracture": [("quarter_point", {}), ("boundary_element", {}), ("jump_fit", {})],
}
def in_space(text):
    return re.search(r"^  box:.*\bz:", text, re.M) is not None


def uses_peaceman(text):
    """In space wells in the rock are lines; those at points of fractures have no index in the rock."""
    has_rock = not in_space(text) or re.search(r"^      \w+: \{points:", text, re.M)
    return has_rock and "type: well_exchange" in text and "radius:" in text and "index:" not in text


# Swaps without a meaning: for each type, pieces of reasons, and in which scenes.
REFUSED = {
    "fine_fracture/jump_fit": [("does not grow", lambda text: "grow: tips" in text)],
    "matrix_flow/rt0": [("unknowns on faces", uses_peaceman)],
    "matrix_flow/ntpfa": [("not linear in the pressures", uses_peaceman), ("for scenes in space yet", in_space)],
    "poromechanics/fem first": [("stabilized by more than the stress of their cells", lambda text: "\nstart: {settle:" in text)],
    "contact/penalty": [("its walls slip elastically", lambda text: "rate_and_state:" in text)],
}
# How far the probes of a scene may move with a type that is less exact, of the largest value of their unit, and why.
INEXACT = {
    "matrix_flow/tpfa": 0.1,  # fluxes that are not consistent on triangles
    "matrix_flow/ntpfa": 0.05,  # no correction at tips: of first order in the pressure of a fracture that conducts well
    "poromechanics/fem first": 0.05,  # on meshes of five cells on a fracture
    "contact/penalty": 0.02,  # walls that touch overlap a little
}
NEAR = 0.02  # of the largest value of the same unit


def run(program, scene, settings, *arguments):
    sets = [part for path, value in settings.items() for part in ("--set", f"{path}={value}")]
    return subprocess.run([program, *arguments[:1], scene, *arguments[1:], *sets], capture_output=True, text=True, timeout=300)


def components(text):
    """{name: type} of the section `components`."""
    section = re.search(r"^components:.*\n((?:[ #].*\n|\n)*)", text, re.M).group(1)
    return dict(re.findall(r"^  (\w+):(?: \{|(?:\n|\s|#.*)*?)type: ([\w/]+)", section, re.M))


def swaps(text):
    for name, kind in components(text).items():
        role, _, present = kind.partition("/")
        for other, more in ROLES.get(role, []):
            is_present = other == present and (not more or f"order: {more['order']}" in text or
                                               (more == {"order": "second"} and "order:" not in text))
            if is_present:
                continue
            settings = {f"components.{name}.type": f"{role}/{other}"}
            settings |= {f"components.{name}.{key}": value for key, value in more.items()}
            if present == "fem":
                if more or "order:" in text:
                    settings |= {f"components.{name}.order": more.get("order", "")}
            if other == "jump_fit":  # what such tips do not have
                tips = re.search(rf"^  {name}:.*\n((?:    .*\n|  *#.*\n)*)", text, re.M).group(1)
                settings |= {f"components.{name}.{key}": "" for key in re.findall(r"^    (\w+):", tips, re.M) if key != "type"}
            yield f"{role}/{other}" + (f" {more['order']}" if more else ""), settings


def seconds(text):
    number, unit = re.fullmatch(r"([\d.e+-]+) ?(\w+)", text).groups()
    return float(number) * {"s": 1, "min": 60, "h": 3600, "day": 86400, "year": 365.25 * 86400}[unit]


def first_steps(text):
    """Of one step."""
    time = text[text.index("\ntime:"):]
    start = re.search(r"start: ([^,}\n#]+)", time)
    step = seconds(re.search(r"\bstep: ([^,}\n#]+)", time).group(1).strip())
    end = seconds(re.search(r"\bend: ([^,}\n#]+)", time).group(1).strip())
    begin = seconds(start.group(1).strip()) if start else 0
    return {"time.end": f"{min(end, begin + step)!r} s", "output.fields": "false"}


def last_row(folder):
    with open(Path(folder) / "history.csv") as file:
        row = list(csv.DictReader(file))[-1]
    return {key: float(value) if value else math.nan for key, value in row.items()}


def measured(program, scene, settings):
    with tempfile.TemporaryDirectory() as folder:
        done = run(program, scene, settings, "run", "-q", "-o", folder + "/run")
        return (done.returncode, done.stderr.strip(), last_row(folder + "/run") if done.returncode == 0 else {})


def difference(row, other, probes):
    """The largest difference of a probe, over the largest value of its unit in both rows, and the probe."""
    worst = (0.0, "")
    for key in row:
        if key.split("[")[0].split(".")[0] not in probes or key not in other:
            continue
        unit = key.partition("[")[2]
        scale = max(abs(value) for name, value in [*row.items(), *other.items()]
                    if name.partition("[")[2] == unit and name.split("[")[0].split(".")[0] in probes)
        if scale > 0 and not abs(row[key] - other[key]) <= worst[0] * scale:
            worst = abs(row[key] - other[key]) / scale, key
    return worst


def main():
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    program, all_of_them = str(Path(arguments[0]).resolve()), "--all" in sys.argv
    failures, refused, cases = [], 0, []
    for scene in sorted((ROOT / "configs").glob("*/*.yaml")):
        if arguments[1:] and scene.stem not in arguments[1:]:
            continue
        text = scene.read_text()
        cases += [(scene, text, kind, settings) for kind, settings in swaps(text)]

    def check(case):
        scene, text, kind, settings = case
        done = run(program, scene, settings, "check")
        said = done.stdout + done.stderr
        reasons = [reason for reason, meant in REFUSED.get(kind, []) if meant(text)]
        if done.returncode == 0:
            return [f"{scene.name} with {kind} has no meaning, and is not refused"] if reasons else []
        if done.returncode == 2 and any(reason in said for reason in reasons):
            return None
        return [f"{scene.name} with {kind}: check ends with {done.returncode}: {said[-300:]}"]

    with ThreadPoolExecutor(2) as pool:
        results = list(pool.map(check, cases))
    left = [case for case, result in zip(cases, results) if result == []]
    refused = sum(result is None for result in results)
    failures += [line for result in results if result for line in result]
    quick = [case for case in left if case[0].stem in SAMPLE]
    originals, compared = {}, []
    for scene, text, kind, settings in left if all_of_them else quick[::4]:
        until = first_steps(text)
        if scene not in originals:
            originals[scene] = measured(program, scene, until)
        probes = re.findall(r"^    (\w+): *\{of: ", text[text.index("\noutput:"):], re.M) if "\noutput:" in text else []
        code, error, row = measured(program, scene, until | settings)
        if code != 0:
            failures.append(f"{scene.name} with {kind} fails: {error[-300:]}")
            continue
        worst, column = difference(originals[scene][2], row, probes)
        compared.append((worst, scene.name, kind, column))
        if not worst <= INEXACT.get(kind, NEAR):
            failures.append(f"{scene.name} with {kind}: {column} differs by {worst:.3g} of the largest value")
        if all_of_them:
            print(f"{scene.name:28} {kind:30} {worst:9.2e} {column}", flush=True)
    print(f"{len(cases)} swaps checked, {refused} refused with a reason, {len(compared)} run")
    if not arguments[1:] and (len(cases) < 60 or refused == 0 or len(compared) < 8):
        failures.append("too few swaps")
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


# Scenes whose first steps take less than a second.
SAMPLE = {"onset_coarse", "mandel", "terzaghi", "first_scene", "pressurized_cross", "fracture_inflow", "closed_box", "onset"}

if __name__ == "__main__":
    main()
