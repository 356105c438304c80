"""Pictures of work-precision results, fitted slopes, and one self-contained HTML page."""

import base64
import html
import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from problems import PROBLEMS  # noqa: E402

MARKERS = {"umfpack": "o", "mumps": "s", "belos": "^", "auto": "D"}
COLOURS = {"umfpack": "#3a7d44", "mumps": "#c8553d", "belos": "#1b6ca8", "auto": "#555555", "tpfa": "#7b4b94"}


def curves(results, problem):
    """{(variant, solver): results of it by rising unknowns}, without failed ones."""
    found = {}
    for result in results:
        if result["problem"] == problem and "failure" not in result:
            found.setdefault((result["variant"], result["solver"]), []).append(result)
    for curve in found.values():
        curve.sort(key=lambda r: r["unknowns"])
    return found


def first_error(result):
    return next(iter(result["errors"].values()))


def slope(x, y):
    """The exponent of y = c x^e fitted to the finer half of the points, at least three; NaN with less."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    good = (x > 0) & (y > 0)
    x, y = x[good], y[good]
    count = max(3, (len(x) + 1) // 2)
    if len(x) < 3:
        return float("nan")
    return float(np.polyfit(np.log(x[-count:]), np.log(y[-count:]), 1)[0])


def slopes(curve):
    unknowns = [r["unknowns"] for r in curve]
    seconds = [r["seconds"] for r in curve]
    errors = [first_error(r) for r in curve]
    return {"error over unknowns": slope(unknowns, errors), "error over seconds": slope(seconds, errors),
            "seconds over unknowns": slope(unknowns, seconds)}


def figure(results, name):
    """Three panels: error over seconds, error over unknowns, seconds over unknowns."""
    problem, found = PROBLEMS[name], curves(results, name)
    picture, (work, precision, cost) = plt.subplots(1, 3, figsize=(13, 4.6))
    drawn_errors = set()
    for (variant, solver), curve in found.items():
        kind, _, condensed = solver.partition("+")
        style = {"marker": MARKERS[kind], "color": COLOURS["tpfa" if variant == "tpfa" else kind], "markersize": 4.5,
                 "linewidth": 1.1, "linestyle": "--" if variant == "tpfa" else ":" if condensed == "whole" else "-"}
        unknowns = [r["unknowns"] for r in curve]
        seconds = [r["seconds"] for r in curve]
        errors = [first_error(r) for r in curve]
        work.loglog(seconds, errors, label=f"{variant}, {solver}", **style)
        cost.loglog(unknowns, seconds, **style)
        if variant not in drawn_errors:  # the error does not depend on the solver
            drawn_errors.add(variant)
            precision.loglog(unknowns, errors, **style)
    for i, other in enumerate(problem.published):
        # One legend entry for all points of a label.
        style = {"marker": "*", "color": "black", "markersize": 9, "linestyle": "none",
                 "label": other["label"] if i == 0 or problem.published[i - 1]["label"] != other["label"] else None}
        if "seconds" in other and "error" in other:
            work.loglog([other["seconds"]], [other["error"]], **style)
        if "unknowns" in other and "error" in other:
            precision.loglog([other["unknowns"]], [other["error"]], **style)
        if "unknowns" in other and "seconds" in other:
            cost.loglog([other["unknowns"]], [other["seconds"]], **style)
    quantity = next((next(iter(r["errors"])) for c in found.values() for r in c), "")
    work.set(xlabel="seconds", ylabel=f"relative error of {quantity}")
    precision.set(xlabel="unknowns", ylabel=f"relative error of {quantity}")
    cost.set(xlabel="unknowns", ylabel="seconds")
    for axes in (work, precision, cost):
        axes.grid(True, which="major", linewidth=0.4, alpha=0.6)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    entries = [axes.get_legend_handles_labels() for axes in (work, precision)]
    unique = {label: handle for handles, labels in reversed(entries) for handle, label in zip(handles, labels)}
    picture.suptitle(problem.title, fontsize=11)
    picture.tight_layout(rect=(0, 0.1, 1, 1))
    picture.legend(unique.values(), unique.keys(), loc="lower center", ncol=4, fontsize=8, frameon=False)
    return picture


def embedded(picture):
    text = io.BytesIO()
    picture.savefig(text, format="svg")
    plt.close(picture)
    return "data:image/svg+xml;base64," + base64.b64encode(text.getvalue()).decode()


def table(headings, rows):
    cells = lambda row, tag: "".join(f"<{tag}>{html.escape(str(c))}</{tag}>" for c in row)
    return f"<table><tr>{cells(headings, 'th')}</tr>" + "".join(f"<tr>{cells(r, 'td')}</tr>" for r in rows) + "</table>"


STYLE = """body{font:15px/1.45 system-ui,sans-serif;max-width:1200px;margin:2em auto;padding:0 1em;color:#222}
img{max-width:100%}table{border-collapse:collapse;margin:1em 0;font-size:13px}
td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #ddd}td:first-child,th:first-child{text-align:left}
details{margin:.5em 0 2em}"""


def write_page(results, file, machine, extra=()):
    """`extra`: (heading, HTML) of further measurements."""
    parts = [f"<!doctype html><html lang=en><meta charset=utf-8><title>Sprekk: run time against error</title>"
             f"<style>{STYLE}</style><h1>Run time against error</h1><p>{html.escape(machine)}</p>"
             "<p>Seconds are processor time of all steps (discretization, assembly, solves) on one thread, without mesh and "
             "output. Slopes are exponents fitted to the finer half of the meshes.</p>"]
    for name in PROBLEMS:
        found = curves(results, name)
        failed = [r for r in results if r["problem"] == name and "failure" in r]
        if not found and not failed:
            continue
        parts.append(f"<h2 id={name}>{html.escape(PROBLEMS[name].title)}</h2>")
        if found:
            parts.append(f'<img alt="{name}" src="{embedded(figure(results, name))}">')
        rows = []
        for (variant, solver), curve in found.items():
            fit = slopes(curve)
            rows.append([f"{variant}, {solver}", curve[-1]["unknowns"], f"{first_error(curve[-1]):.2e}",
                         f"{curve[-1]['seconds']:.3g}", *(f"{v:.2f}" for v in fit.values())])
        parts.append(table(["", "most unknowns", "error", "seconds", "error ~ unknowns^", "error ~ seconds^",
                            "seconds ~ unknowns^"], rows))
        rows = [[r["name"].partition("/")[2], r["unknowns"], f"{r['seconds']:.3g}",
                 ", ".join(f"{k} {v:.2e}" for k, v in r["errors"].items()),
                 r["counters"].get("linear: factorizations", ""), r["counters"].get("linear: solves", ""),
                 r["counters"].get("iterations", ""), r["commit"][:10]] for c in found.values() for r in c]
        rows += [[r["name"].partition("/")[2], "", "", "failed: " + r["failure"], "", "", "", ""] for r in failed]
        parts.append("<details><summary>all runs</summary>" + table(
            ["case", "unknowns", "seconds", "relative errors", "factorizations", "back-solves", "Newton iterations",
             "commit"], rows) + "</details>")
    for heading, content in extra:
        parts.append(f"<h2>{html.escape(heading)}</h2>{content}")
    file.write_text("\n".join(parts) + "\n", encoding="utf-8")


def write_pictures(results, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name in PROBLEMS:
        if curves(results, name):
            picture = figure(results, name)
            picture.savefig(folder / f"{name}.png", dpi=90)
            plt.close(picture)
