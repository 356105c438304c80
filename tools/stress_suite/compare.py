"""The same scene on one process and on several: the figures of history.csv agree."""

import shutil

import numpy as np

from . import check_end, check_space, examine as one_process, physics, ranges, run, scene, written

# The answer is as good as Newton's last update, 1e-8 of the fields; columns that depend on a difference lose two digits.
TOLERANCE = 1e-6
LEFT_OUT = ("iterations[1]",)  # and what balances are off by, which is round-off
# A cell that is at its friction bound and does not move in a step sticks as well as it slips; round-off says which.
CLOSED = ("contact.cells_stick[1]", "contact.cells_slip[1]")


def comparable(history):
    """{name: values}"""
    closed = [history[name] for name in CLOSED if name in history]
    found = {name: values for name, values in history.items() if name not in LEFT_OUT + CLOSED and "_balance_error[" not in name and not isinstance(values, list)}
    return found | ({"contact.cells_closed[1]": sum(closed)} if closed else {})


def differences(alone, together, fluid):
    """`fluid`: m^2 that there is, whose round-off is no difference."""
    if len(alone["time[s]"]) != len(together["time[s]"]):
        return [f"processes: {len(together['time[s]'])} steps instead of {len(alone['time[s]'])}"]
    found = []
    turnover = max([np.abs(alone[c]).max() for c in alone if c.endswith("[m^2]")] + [0])
    others = comparable(together)
    for name, values in comparable(alone).items():
        size = max(np.abs(values).max(), 1e-6 * turnover if name.endswith("[m^2]") else 0)
        worst = np.abs(values - others[name]).max()
        if worst > TOLERANCE * size + (1e-12 * fluid if name.endswith("[m^2]") else 0):
            found.append(f"processes: {name} differs by {worst / max(size, 1e-300):.2g}")
    return found


def examine(program, chosen, number, folder):
    report = one_process.examine(program, chosen, number, folder, keep=True)
    p = ranges.draw(chosen.seed, number, chosen.family, chosen.update, chosen.scheme, chosen.swapped, chosen.buoyant)
    ended = run.run(program, scene.write(p, folder), folder / "together", 3 * chosen.limit, chosen.processes)
    bad = check_end.failures(ended)
    report["seconds"] += round(ended.seconds, 2)
    if report["outcome"] == "refused":
        if ended.code == 0:
            bad.append("processes: refused on one process only")
    elif not bad and ended.code != 2 and p["family"] == "space":
        bad += check_space.differences(written.history(folder / "results"), written.history(folder / "together"))
    elif not bad and ended.code != 2:
        fluid = physics.length(p) * p["aperture"] + p["storage"] * p["width"] * p["height"] * (p["initial"] + p["stress"])
        bad += differences(written.history(folder / "results"), written.history(folder / "together"), fluid)
    report["failures"] += [f"on {chosen.processes} processes: {text}" for text in bad]
    if report["failures"]:
        report["outcome"] = "failed"
    if not chosen.keep:
        shutil.rmtree(folder, ignore_errors=True)
    return report
