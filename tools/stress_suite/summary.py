"""What came out: one line for each failure, the distribution of iterations and cuts, JSON and a picture."""

import json
import subprocess
from collections import Counter
from pathlib import Path

from . import physics

ROOT = Path(__file__).resolve().parents[2]


def repeats(chosen, number):
    extra = " --sanitize" if chosen.sanitize else f" --processes {chosen.processes}" if chosen.processes > 1 else ""
    return f"tools/stress{physics.family_option(vars(chosen))} --seed {chosen.seed} --only {number}{extra}"


def in_turn(report):
    """Of a scene that is solved in turn: what the word 'answer' does not say."""
    together = f"({report['together']} of {report['accepted']} steps by 'fallback: monolithic') " if report["together"] else ""
    return together + (f"(monolithic: {told(report['monolithic cuts'])}) " if report["rejected"] and report["monolithic cuts"] != 0 else "")


def told(cuts):
    return "no answer" if cuts is None else f"{cuts} cuts"


def lines_of(report, chosen):
    """One line for a scene that failed or gave up; with --only always one."""
    if report["failures"]:
        more = f" (and {len(report['failures']) - 1} more)" if len(report["failures"]) > 1 else ""
        return [f"FAILED {repeats(chosen, report['number'])}   {report['failures'][0]}{more}   [{report['scene']}]"]
    if report["outcome"] == "gave up":
        return [f"gave up {repeats(chosen, report['number'])}   {report['reason']}   [{report['scene']}]"]
    if chosen.only is not None:
        return [f"{report['outcome']}: {report['rejected']} cuts, iterations {report['iterations']} {report['reason']} "
                f"{in_turn(report)}[{report['scene']}]"]
    return []


def figures(reports):
    iterations = Counter(i for report in reports for i in report["iterations"])
    accepted, rejected = (sum(report[key] for report in reports) for key in ("accepted", "rejected"))
    ordered = sorted(iterations.elements())
    share = lambda part: ordered[min(len(ordered) - 1, int(part * len(ordered)))] if ordered else 0
    return {"scenes": len(reports), "outcomes": dict(Counter(report["outcome"] for report in reports)),
            "scenes with cuts": sum(1 for report in reports if report["rejected"]),
            "steps accepted": accepted, "steps cut": rejected,
            "steps solved together": sum(report.get("together", 0) for report in reports),
            "scenes with steps solved together": sum(1 for report in reports if report.get("together", 0)),
            "steps that the monolithic scheme cuts in scenes with cuts": sum(report.get("monolithic cuts", 0) or 0 for report in reports),
            "steps cut, percent": round(100 * rejected / max(1, accepted + rejected), 3),
            "reasons of cuts": {name: sum(r["cuts"][name] for r in reports if r["outcome"] == "answer")
                                for name in ("singular", "not converged")},
            "iterations": {str(k): iterations[k] for k in sorted(iterations)},
            "iterations, median": share(0.5), "iterations, 99 percent": share(0.99), "iterations, most": share(1.0),
            "scenes by error of the balance": {f"below {limit:g}": sum(1 for r in reports if r["accepted"] and r["balance"] < limit)
                                             for limit in (1e-12, 1e-9, 1e-6, 1e-3, 1e300)},
            **of_space(reports),
            "seconds": round(sum(report["seconds"] for report in reports), 1)}


def of_space(reports):
    """What the family space counts besides; nothing for the others."""
    if not any("overshoot" in report for report in reports):
        return {}
    beyond = [report["overshoot"] for report in reports if report.get("overshoot") is not None]
    return {"twins": dict(Counter(report["twin"] for report in reports if "twin" in report)), "scenes with bounds": len(beyond),
            "scenes by overshoot": {f"above {limit:g}": sum(1 for over in beyond if over > limit) for limit in (1e-9, 1e-3, 1e-2, 5e-2)},
            "largest overshoot": max(beyond, default=0.0)}


def text_of_space(f):
    if "twins" not in f:
        return ""
    beyond = ", ".join(f"{count} {limit}" for limit, count in f["scenes by overshoot"].items())
    return (f"\npressures beyond those given, as parts of all differences: {beyond} of {f['scenes with bounds']} scenes with bounds, at most {f['largest overshoot']:.2g}; "
            f"twins: {', '.join(f'{count} {name}' for name, count in sorted(f['twins'].items())) or 'none'}")


MOST_CUTS = 2.0  # percent of the steps
# Of scenes that grow: what may not happen. Their other failures are told, and are not yet an exit code.
REQUIRED_OF_GROWTH = ("crash", "fluid", "not finite", "negative")


def count_as_failed(reports, family):
    """Those that make the exit code."""
    return [report for report in reports if any(family != "growing" or failure.startswith(REQUIRED_OF_GROWTH)
                                                for failure in report["failures"])]


def cuts_too_often(reports, family="separate"):
    """Few scenes say nothing about a share: only those of --smoke, and more. Growth cuts steps to find the load of its onset."""
    return family != "growing" and len(reports) >= 40 and figures(reports)["steps cut, percent"] > MOST_CUTS


def text(reports):
    f = figures(reports)
    outcomes = ", ".join(f"{count} {name}" for name, count in sorted(f["outcomes"].items()))
    in_turn_line = (f"\nsolved in turn: {f['steps solved together']} steps in {f['scenes with steps solved together']} scenes by 'fallback: monolithic'; "
                    f"the monolithic scheme cuts {f['steps that the monolithic scheme cuts in scenes with cuts']} steps of the scenes with cuts"
                    if any(report.get("in turn") for report in reports) else "")
    return (f"{f['scenes']} scenes: {outcomes}\n{f['steps accepted']} steps, {f['steps cut']} cut "
            f"({f['steps cut, percent']} %) in {f['scenes with cuts']} scenes; Newton iterations a step: median "
            f"{f['iterations, median']}, 99 % at most {f['iterations, 99 percent']}, most {f['iterations, most']}\n"
            f"places in answered scenes where steps were cut: {f['reasons of cuts']['singular']} singular systems, "
            f"{f['reasons of cuts']['not converged']} without convergence{in_turn_line}{text_of_space(f)}")


def commit():
    return subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True).stdout.strip()


def write(reports, chosen, program):
    record = {"seed": chosen.seed, "commit": commit(), **figures(reports),
              "not answered": [{k: r[k] for k in ("number", "outcome", "failures", "reason", "scene")}
                               for r in reports if r["outcome"] != "answer"],
              "cuts": [{k: r[k] for k in ("number", "rejected", "accepted", "cuts", "scene")} for r in reports if r["rejected"]]}
    chosen.report.parent.mkdir(parents=True, exist_ok=True)
    chosen.report.with_suffix(".json").write_text(json.dumps(record, indent=1) + "\n")
    from . import picture
    picture.draw(record, chosen.report.with_suffix(".png"))
