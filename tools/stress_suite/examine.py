"""Draws, runs and checks one scene."""

import shutil

from . import buoyancy, check_balance, check_contact, check_end, check_faults, check_finite, check_growing, check_heat, check_pressure, check_space, check_wells, faults, growing, heat, physics, ranges, run, scene, schemes, space, swaps, written


def describe(p):
    if p["family"] == "growing":
        return growing.describe(p)
    if p["family"] in scene.IN_SPACE:
        return scene.IN_SPACE[p["family"]].describe(p)
    more = scene.MORE[p["family"]].describe(p) if p["family"] in scene.MORE else ""
    return (f"{swaps.describe(p)}{buoyancy.describe(p)}{more}dt = {p['relative_step']:.0e} of diffusion, k = {p['permeability']:.0e}, alpha = {p['alpha']:.2f}, "
            f"S = {p['storage']:.0e}, nu = {p['poisson']:.4f}, friction = {p['friction']:.2f}, "
            f"dilation = {p['dilation']:.0f} deg, a = {p['aperture']:.0e} m, {p['history']}, {p['well']}, {p['mesh']}, "
            f"{p['fractures']}, {p['place']}")


def reasons_of_cuts(stderr):
    """How many steps were cut because the linear solver found the system singular, and for other reasons."""
    lines = [line for line in stderr.splitlines() if line.startswith("step cut:")]
    singular = sum("singular" in line for line in lines)
    return {"singular": singular, "not converged": len(lines) - singular}


def strain_told(folder):
    return written.told(folder, "rock large strain", r"changes by (\S+) of the distance")


def beyond_bounds_with_two_points(program, chosen, p, folder, kind):
    """How temperatures (concentrations) of the same scene, conducted by two-point fluxes, miss their bounds. They keep them whatever the
    mesh, so what multi-point fluxes miss is theirs."""
    twin = {**p, "conduction" if kind is check_heat.HEAT else "diffused": "tpfa"}
    ended = run.run(program, scene.write(twin, folder / "two_points"), folder / "two_points/results", chosen.limit)
    return check_heat.bounds(twin, written.instants(ended.folder), kind=kind) if ended.code == 0 else check_end.failures(ended)


def check_fields(program, chosen, p, folder):
    instants, history = written.instants(folder), written.history(folder)
    if p["family"] == "growing":
        return check_growing.failures(p, instants, history)
    several = faults.contacts(p) if p["family"] == "faults" else ()
    found = check_finite.failures(instants, history, left_out=several if len(several) > 1 else ())
    if found or not instants:
        return found
    if p["family"] == "space":
        return check_space.failures(p, instants, history)
    if p["family"] == "faults":
        return check_faults.failures(p, instants, history)
    brought = check_wells.sources(p, history, instants[0]) if p["family"] == "wells" else None
    found = (check_contact.failures(p, instants) + check_balance.failures(p, instants, history, main=0, brought=brought) +
             check_pressure.failures(p, instants, history, strain_told(folder)))
    for kind in ([check_heat.HEAT] if heat.is_in(p) else []) + ([check_heat.TRACER] if p["family"] == "tracer" else []):
        found += check_heat.failures(p, instants, history, check_heat.told(folder, kind), kind)
        if kind.conduction(p) == "mpfa" and check_heat.bounds(p, instants, kind=kind):
            found += beyond_bounds_with_two_points(program, chosen, p, folder.parent, kind)
    return found + (check_wells.failures(p, instants, history) if p["family"] == "wells" else [])


def cuts_of_the_monolithic_scheme(program, chosen, number, folder):
    """The cuts of the same scene solved in one system; None where that gives no answer."""
    p = ranges.draw(chosen.seed, number, chosen.family, chosen.update, schemes.MONOLITHIC, chosen.swapped, chosen.buoyant)
    ended = run.run(program, scene.write(p, folder / "monolithic"), folder / "monolithic/results", chosen.limit)
    return written.iterations_of_steps(ended.folder)[2] if ended.code == 0 and not ended.timed_out else None


def look_further(program, chosen, p, path, ended, report):
    """Of a scene in space: what a refusal says, how far pressures of flow alone are beyond what is given, and its twin."""
    check = {"space": check_space, "faults": check_faults}[p["family"]]
    if report["outcome"] == "refused":
        report["failures"] += check_space.refusal(ended.stderr)
    elif report["outcome"] == "gave up":
        report["failures"].append(f"end: exit code 1: {report['reason']}")
    elif report["outcome"] == "answer":
        instants = written.instants(ended.folder) if check is check_space else []
        if instants:
            report["overshoot"] = check_space.overshoot(p, instants, check_space.Places(instants[0]))[1]
        if p["twin"] != "none" and chosen.processes == 1:
            report["twin"] = p["twin"]
            report["failures"] += check.twin(program, p, path, path.parent, chosen.limit)


def examine(program, chosen, number, folder, keep=False):
    """{number, outcome, failures, iterations, accepted, rejected, together, monolithic cuts, seconds}; the folder is removed unless it
    is kept. Of a scene that is solved in turn and was cut, the monolithic scheme's cuts are counted as well."""
    p = ranges.draw(chosen.seed, number, chosen.family, chosen.update, chosen.scheme, chosen.swapped, chosen.buoyant)
    shutil.rmtree(folder, ignore_errors=True)
    path = scene.write(p, folder)
    ended = run.run(program, path, folder / "results", chosen.limit)
    report = {"number": number, "failures": check_end.failures(ended), "iterations": [], "accepted": 0, "rejected": 0, "together": 0,
              "in turn": p.get("solved", schemes.MONOLITHIC) != schemes.MONOLITHIC, "monolithic cuts": 0,
              "balance": 0.0, "seconds": round(ended.seconds, 2), "scene": describe(p), "reason": "",
              "cuts": reasons_of_cuts(ended.stderr)}
    if check_end.is_refused(ended):
        report["outcome"], report["reason"] = "refused", " ".join(ended.stderr.split())[:300]
    elif ended.timed_out or ended.code < 0 or ended.code > 2 or not (ended.folder / "run.json").exists():
        report["outcome"] = "failed"
    else:
        report["outcome"] = "gave up" if check_end.gave_up(ended) else "answer"
        report["reason"] = written.exit_record(ended.folder)["exit"]["reason"]
        report["iterations"], report["accepted"], report["rejected"] = written.iterations_of_steps(ended.folder)
        report["together"] = written.steps_solved_together(ended.folder)
        if report["in turn"] and report["rejected"]:
            report["monolithic cuts"] = cuts_of_the_monolithic_scheme(program, chosen, number, folder)
        if report["accepted"] > 0:
            report["balance"] = check_balance.relative_error_of_balance(written.history(ended.folder))
            report["failures"] += check_fields(program, chosen, p, ended.folder)
    if p["family"] in scene.IN_SPACE:
        look_further(program, chosen, p, path, ended, report)
    if report["failures"]:
        report["outcome"] = "failed"
    if not keep:
        shutil.rmtree(folder, ignore_errors=True)
    return report
