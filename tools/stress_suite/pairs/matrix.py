"""Every pair of features on a small scene, each with an answer that is known: tools/stress --family pairs."""

import itertools
import json
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed

import numpy as np

from . import answers, frame, unanswered
from .features import FEATURES

TO_THE_BIT = 0.0
TOLERANCES = {"neutral": 1e-6, "scheme": 1e-6, "half": 1e-6, "frame": 1e-6, "rest": 1e-6}
FALLS = 1.4         # by which the difference of two schemes of first order in time falls when steps are halved, at least
SMALL = 1e-5        # of a figure: below it a difference in time is as small as the tolerances of passes leave it
DISTURBED = 1 + 1e-9
SMOKE_FIRST, SMOKE_EVERY = 7, 31  # of the pairs: a sample for CI


def pairs():
    return [(FEATURES[i], FEATURES[j]) for i, j in itertools.combinations_with_replacement(range(len(FEATURES)), 2)]


def chosen(features, *kinds):
    return tuple(one for one in features if one.kind in kinds)


def expect(one, other, tolerance, what, **how):
    difference, name = answers.difference(one, other, **how)
    return [] if difference <= tolerance else [f"{name} differs by {difference:.2g} from {what}"]


def without(features, name):
    return tuple(one for one in features if one.name != name)


def like(known, answer, tolerance, what):
    return [f"{what}: {known.missing}"] if known.missing else expect(answer, known, tolerance, what)


def falls(runs, features, plain):
    """The difference to backward Euler in one system falls with the step, at the end of the run."""
    sizes = []
    for divide in (1, 2, 4, 8):
        one, other = runs.of(features, divide=divide), runs.of(plain, divide=divide)
        for answer in (one, other):
            if answer.missing:
                return [f"with steps divided by {divide}: {answer.missing}"]
        sizes.append(answers.difference(one, other, at_end=True))
        if sizes[-1][0] < SMALL or (len(sizes) > 1 and sizes[-1][0] < sizes[-2][0] / FALLS):
            return []
    return ["the difference to the monolithic scheme does not fall with the step: " +
            ", ".join(f"{size:.2g} of {name}" for size, name in sizes)]


def compare(runs, features, answer):
    """What is wrong with the answer of a pair."""
    physics = chosen(features, "physics", "rest")
    found = []
    if chosen(features, "rest"):
        moved, name = answers.moved(answer)
        if moved > TOLERANCES["rest"] and not UNRESTED & {one.name for one in features}:
            found.append(f"{name} moves by {moved:.2g} after everything was settled")
    draft = answers.draft_of(features)
    if draft.restarted:
        # On several processes two runs of one scene differ in their last digits: MUMPS adds what others send in the order in which it arrives.
        tolerance = TO_THE_BIT if draft.processes == 1 else TOLERANCES["neutral"]
        return found + like(runs.of(without(features, "restart"), meets=draft.meets), answer, tolerance, "the run that is not interrupted")
    if chosen(features, "time"):
        return found + falls(runs, features, physics)
    if chosen(features, "half"):
        whole = without(features, "subcycle all")
        if "growth" in {one.name for one in features}:  # once for two substeps, and not for steps half as long
            return found + falls(runs, features, whole)
        ends = answers.times(answer)
        halves = np.sort(np.concatenate([ends, ends - answer.figures["step[s]"] / 2]))
        return found + like(runs.of(whole, meets=tuple(halves.tolist())), answer, TOLERANCES["half"], "steps half as long")
    for kind, what in (("neutral", "the run without it"), ("scheme", "the monolithic scheme")):
        if chosen(features, kind):
            known = runs.of(physics)
            if not known.missing and not answers.same_times(answer, known):
                # Other steps have another error. Schemes whose passes need shorter steps are compared in the steps that they took.
                known = runs.of(physics, meets=tuple(answers.times(answer).tolist()))
            return found + like(known, answer, TOLERANCES[kind], what)
    if draft.mirrors:
        for where in (frame.Mirrored, frame.Turned):
            twin = runs.of(features, where=where)
            found += like(twin, answer, TOLERANCES["frame"], f"the scene that is {where.name}")
    return found + like(runs.of(features, scale=DISTURBED), answer, TOLERANCES["frame"], "the scene whose rates are larger by 1e-9")


# Features that move something by themselves after the start.
UNRESTED = {"wells", "window", "prescribed", "viscosity in time", "compressibility in time", "heat", "tracer", "thermal stress", "thermal viscosity",
            "buoyancy", "subcycle heat held", "subcycle heat linear", "rate and state", "growth"}


def examine(runs, number, one, other):
    features = (one,) if one is other else (one, other)
    answer = runs.of(features)
    report = {"number": number, "pair": [one.name, other.name], "outcome": "answer", "reason": "", "failures": []}
    if answer.refused:
        report["outcome"], report["reason"] = "refused", answer.refused
    elif why := unanswered.reason(report["pair"], answer.failed):
        report["outcome"], report["reason"] = "unanswered", why
        report["failures"] = accepted(runs, features, answer)
    else:
        report["failures"] = [answer.failed] if answer.failed else compare(runs, features, answer)
    if report["failures"]:
        report["outcome"] = "failed"
    return report


def accepted(runs, features, answer):
    """What is wrong with the steps before the one that was refused."""
    if not answer.figures or not chosen(features, "scheme"):
        return []
    return like(runs.of(chosen(features, "physics", "rest"), meets=tuple(answers.times(answer).tolist())), answer, TOLERANCES["scheme"],
                "the monolithic scheme")


def examine_all(program, folder, jobs, limit, numbers=None, keep=False):
    """The reports of all pairs, or of those with these numbers."""
    those = pairs()
    runs = answers.Runs(program, folder, limit, keep)
    with ThreadPoolExecutor(jobs) as pool:
        waiting = [pool.submit(examine, runs, number, *those[number]) for number in (numbers if numbers is not None else range(len(those)))]
        reports = []
        for one in as_completed(waiting):
            report = one.result()
            reports.append(report)
            if report["failures"]:
                print(f"FAILED {' × '.join(report['pair'])}: {'; '.join(report['failures'])}\n"
                      f"    tools/stress --family pairs --only {report['number']}", flush=True)
    return sorted(reports, key=lambda report: report["number"])


def main(program, chosen, folder):
    """Of tools/stress: the exit code."""
    numbers = [chosen.only] if chosen.only is not None else range(SMOKE_FIRST, len(pairs()), SMOKE_EVERY) if chosen.smoke else None
    reports = examine_all(program, folder, chosen.jobs, chosen.limit, numbers, bool(chosen.keep))
    counts = Counter(report["outcome"] for report in reports)
    print(f"{len(reports)} pairs of {len(FEATURES)} features: {counts['answer']} with the answer that is known, {counts['refused']} refused by check, "
          f"{counts['unanswered']} without an answer that say why, {counts['failed']} failed")
    if chosen.report:
        write(reports, chosen.report.with_suffix(".json"))
    return 1 if counts["failed"] else 0


def write(reports, path):
    """All outcomes, with the reasons of pairs that are refused or without an answer."""
    path.write_text(json.dumps(reports, indent=1, ensure_ascii=False) + "\n")
