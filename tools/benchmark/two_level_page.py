"""Pictures and tables of errors against run time for the two-level scenes."""

import html

from matplotlib.ticker import LogLocator

import page
from page import plt
from two_level import PROBLEMS, REFERENCE, SECOND, better, compared, front

COLOURS = {"dH": "#c8553d", "l": "#1b6ca8", "mesh_ratio": "#7b4b94", "threshold": "#3a7d44", "step": "#d19a1d",
           "increment": "#17929b", "growth": "#8a6d3b",
           "together": "#e0559a", "held": "#444444"}


def varied(problem, cases):
    """{parameter: [(value, case)]}, by value, the default among them."""
    found = {}
    for key, parameter in problem.parameters.items():
        values = sorted(filter(None, (parameter.default, *parameter.others)), key=lambda value: float(value.split()[0]))
        named = [(value, "default" if value == parameter.default else f"{key}={value}") for value in values]
        found[key] = [(value, cases[name]) for value, name in named if name in cases]
    return found


def label(problem, name):
    """ΔH = 10 mm, l = 1 m"""
    parts = [part.partition("=") for part in name.split(",")]
    return ", ".join(f"{problem.parameters[key].symbol} = {value}" if equals else key for key, equals, value in parts)


def unknown_of_answer(problem, cases, quantity):
    """The answer's own error; that of a reference is estimated by what the next coarser one differs by."""
    return cases[SECOND].error(quantity) if SECOND in cases else problem.answer_errors.get(quantity, 0)


def annotate(axes, points, default):
    """Values of parameters; next to the default, where nobody could read them, the table has to do."""
    for text, point, colour in points:
        here, there = axes.transAxes.inverted().transform(axes.transData.transform([point, default]))
        if max(abs(here - there)) > 0.05:
            axes.annotate(text, point, xytext=(5, 3), textcoords="offset points", fontsize=7.5, color=colour)


def figure(name, cases, quantity):
    """Mean absolute error over processor seconds; bars from the smallest to the largest on all meshes."""
    problem, known = PROBLEMS[name], compared(cases)
    picture, axes = plt.subplots(figsize=(8, 5.4), layout="constrained")
    point = lambda case: (case.seconds, case.error(quantity))
    best = [point(cases[case]) for case in front(cases, quantity)]
    axes.step(*zip(*best), where="post", color="#cccccc", linewidth=5, zorder=1, label="Pareto front")
    for case, result in known.items():
        sizes = [abs(error) for error in result.errors[quantity]]
        axes.vlines(result.seconds, min(sizes), max(sizes), color="#bbbbbb", linewidth=0.8, zorder=2)
        if "," in case:
            axes.plot(*point(result), ".", color="#888888", markersize=5, zorder=3)
    for key, results in varied(problem, known).items():
        parameter = problem.parameters[key]
        axes.plot(*zip(*[point(result) for _, result in results]), "o-", color=COLOURS[key], markersize=4.5, linewidth=1.1, zorder=4,
                  label=parameter.symbol + (f" (scene: {parameter.default})" if parameter.default else ""))
    if "default" in known:
        axes.plot(*point(known["default"]), "*", color="black", markersize=13, zorder=5, label="the scene")
    references = [point(known[reference]) for reference in problem.references if reference in known]
    if references:
        axes.plot(*zip(*references), "D:", color="black", markersize=4, linewidth=0.8, label="coarser references")
    if unknown_of_answer(problem, cases, quantity) > 0:
        axes.axhline(unknown_of_answer(problem, cases, quantity), color="black", linewidth=0.8, linestyle=":",
                     label="the answer is known no better")
    if any("," in case for case in known):
        axes.plot([], [], ".", color="#888888", linestyle="none", label="two or more changed")
    axes.set(xscale="log", yscale="log", xlabel="processor seconds of a run", ylabel=f"{quantity}, {problem.units[quantity]}",
             title=f"{problem.title}: {quantity}")
    if "default" in known:
        annotate(axes, [(value, point(case), COLOURS[key]) for key, results in varied(problem, known).items() for value, case in results],
                 point(known["default"]))
    axes.grid(True, which="both", linewidth=0.4, alpha=0.4)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(LogLocator(subs=(2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("{x:g}")
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(fontsize=7.5, frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return picture


def amount(quantity, error, sign="+"):
    return f"{error:.2f} mm" if quantity == "path" else f"{100 * error:{sign}.2f} %"


def text_of_errors(quantity, case):
    """Mean of the absolute ones; from the smallest to the largest with sign."""
    if not case.errors:
        return ""
    signed = case.errors[quantity]
    several = f" ({amount(quantity, min(signed))} … {amount(quantity, max(signed))})" if len(signed) > 1 else ""
    return amount(quantity, case.error(quantity), "") + several


def rows(name, cases):
    """A star: on the front."""
    problem = PROBLEMS[name]
    fronts = {quantity: front(cases, quantity) for quantity in problem.units}
    body = []
    for key, case in cases.items():
        counters = case.runs[0]["counters"]
        body.append([label(problem, key), len(case.runs), f"{case.seconds:.3g}", counters["steps accepted"],
                     counters["steps rejected"], counters["tips: solves"],
                     *(("* " if key in fronts[quantity] else "") + text_of_errors(quantity, case) for quantity in problem.units)])
    return body


HEADINGS = ["changed", "meshes", "processor seconds", "steps", "refused", "fine solves"]


def verdicts(name, cases):
    problem, body = PROBLEMS[name], []
    for key, parameter in problem.parameters.items():
        if not parameter.default:
            continue
        found = [better(cases, key, quantity) for quantity in problem.units]
        body.append([f"{parameter.symbol} = {parameter.default}", *(", ".join(
            f"{label(problem, case)} ({f'error {100 * gain:.0f} % smaller' if gain else 'same error'})"
            for case, gain in values.items()) or "none" for values in found)])
    return body


def sections(levels):
    """(heading, HTML) of each problem that has been run."""
    found = []
    for name, (cases, failed) in levels.items():
        if "default" not in compared(cases):
            continue
        problem = PROBLEMS[name]
        parts = [f'<img alt="{html.escape(quantity)}" src="{page.embedded(figure(name, cases, quantity))}">'
                 for quantity in problem.units]
        for which, settings in problem.references.items():
            told = ", ".join(f"{path} = {value}" for path, value in settings.items())
            parts.append(f"<p>The {which}: the scene with {html.escape(told)}.</p>")
        parts.append("<p>Mean of the absolute errors on all meshes; in brackets, the smallest and the largest with sign. A star: on the "
                     "Pareto front. Seconds are of the whole run; those and the counts of steps are of one mesh.</p>")
        parts.append(page.table([*HEADINGS, *problem.units], rows(name, cases)))
        parts += [f"<p>{html.escape(run['case'])} failed: {html.escape(run['failure'])}</p>" for run in failed]
        parts.append("<p>What is faster than the scene's value, and as accurate or, beyond the scatter, more so:</p>")
        parts.append(page.table(["the scene", *problem.units], verdicts(name, cases)))
        parts.append(f"<p>Commit {', '.join(sorted({run['commit'][:10] for case in cases.values() for run in case.runs}))}.</p>")
        found.append((problem.title, "".join(parts)))
    return found


def write_pictures(levels, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, (cases, _) in levels.items():
        for quantity in PROBLEMS[name].units if "default" in compared(cases) else ():
            picture = figure(name, cases, quantity)
            picture.savefig(folder / f"{name}_{quantity.replace(' ', '_')}.png", dpi=90)
            plt.close(picture)
