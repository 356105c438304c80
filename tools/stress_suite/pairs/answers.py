"""Runs drafts, and compares the figures of two runs."""

import json
import shutil
import threading
from concurrent.futures import Future
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .. import run as runner
from .. import written
from . import base, frame

PER_STEP = 1e-8     # part of all that was moved by which a balance may be off
SAME_TIME = 1e-9    # of the end: times nearer to one another are one
# Below these a figure is round-off: of stresses of 10 MPa and their displacements over ten metres, and of temperatures.
FLOORS = {"Pa": 1e5, "m": 1e-6, "K": 1.0}


@dataclass
class Answer:
    figures: dict = field(default_factory=dict)  # column of history.csv: values
    refused: str = ""                            # the message of `check`
    failed: str = ""                             # why there is no answer; the figures are those of the steps before

    @property
    def missing(self):
        return self.failed or self.refused


def draft_of(features, where=frame.Frame, divide=1, scale=1.0, meets=None):
    """`divide`: what steps are divided by; `meets`: times at which steps end, s."""
    draft = base.Draft(where())
    draft.scale = scale
    for feature in sorted(features, key=lambda one: one.kind == "rest"):
        feature.add(draft)
    draft.time["step"] /= divide
    if divide > 1 and "rate_and_state" in draft.components["contact"]:
        draft.components["contact"]["rate_and_state"]["state_change"] /= divide
    if meets is not None:
        draft.meets = meets
    return draft


class Runs:
    """The answers of drafts, for several threads; each scene is run once."""

    def __init__(self, program, folder, limit, keep):
        self.program, self.folder, self.limit, self.keep = str(program), Path(folder), limit, keep
        self.known, self.lock = {}, threading.Lock()

    def of(self, features, **how):
        draft = draft_of(features, **how)
        text = json.dumps(draft.scene(), indent=1)
        key = (text, draft.processes, draft.restarted)
        with self.lock:
            is_new = key not in self.known
            promise = self.known.setdefault(key, Future())
            folder = self.folder / str(len(self.known))
        if is_new:
            try:
                promise.set_result(self.run(draft, text, folder))
            except Exception as error:  # whoever waits for it gets it, too
                promise.set_exception(error)
            if not self.keep:
                shutil.rmtree(folder, ignore_errors=True)
        return promise.result()

    def run(self, draft, text, folder):
        folder.mkdir(parents=True, exist_ok=True)
        scene = folder / "scene.yaml"
        scene.write_text(text)
        checked = runner.run(self.program, scene, None, self.limit, draft.processes, command="check")
        if checked.code == 2:
            said = next(line for line in checked.stderr.splitlines() if line.startswith("error: "))
            return Answer(refused=said.split("scene.yaml", 1)[-1].lstrip(":0123456789 "))
        if checked.code != 0:
            return Answer(failed=f"check ends with {checked.code}: {checked.stderr[-300:]}")
        results = folder / "results"
        if draft.restarted:
            half = base.STEP * base.STEPS / 2
            ended = runner.run(self.program, scene, results, self.limit, draft.processes, more=("--set", f"time.end={half!r} s"))
            if ended.code == 0:
                ended = runner.run(self.program, scene, results, self.limit, draft.processes, more=("--restart",))
        else:
            ended = runner.run(self.program, scene, results, self.limit, draft.processes)
        if ended.timed_out or ended.code != 0:
            said = [line for line in ended.stderr.splitlines() if not line.startswith("note")]
            return Answer(self.figures(results), failed=f"{'no end' if ended.timed_out else f'exit code {ended.code}'}: {' '.join(said)[-600:]}")
        return Answer(figures=self.figures(results), failed=self.lost(results))

    @staticmethod
    def figures(results):
        return {name: np.asarray(values, dtype=float) for name, values in written.history(results).items()}

    @staticmethod
    def lost(results):
        """What a balance is off by, as the program's own table says."""
        table = written.history(results)
        for name, values in table.items():
            if "balance_error" in name:
                size = max((float(np.abs(table[other]).max()) for other in table if other.split("_")[0] == name.split("_")[0] and
                            any(word in other for word in ("injected", "stored", "outflow"))), default=0.0)
                if float(np.abs(values).max()) > PER_STEP * size + 1e-14 * max(1.0, size):
                    return f"{name} is {float(np.abs(values).max()):.3g} of {size:.3g}"
        return ""


def probes(answer):
    names = {name.split("[")[0].split(".")[0] for name in answer.figures}
    wanted = {"p_rock", "p_far", "p_main", "p_other", "aperture", "slip", "traction", "T_rock", "T_main"} & names
    return [name for name in answer.figures if name.split("[")[0].split(".")[0] in wanted]


def times(answer):
    return answer.figures["time[s]"]


def same_times(one, other):
    a, b = times(one), times(other)
    return len(a) == len(b) and bool((np.abs(a - b) <= SAME_TIME * b[-1]).all())


def rows_at(answer, wanted):
    """The rows of an answer at these times; None where it has none at one of them."""
    rows = np.abs(times(answer)[:, None] - wanted).argmin(axis=0)
    return rows if (np.abs(times(answer)[rows] - wanted) <= SAME_TIME * wanted[-1]).all() else None


def difference(one, other, at_end=False):
    """(largest difference of a figure over its largest value, its name): at the times of the first answer if the second has them, otherwise at the
    end. Tangential components change their sign in a mirror."""
    worst, which = 0.0, ""
    rows = None if at_end else rows_at(other, times(one))
    for name in probes(other):
        if name not in one.figures:
            return np.inf, name
        a, b = np.abs(one.figures[name]), np.abs(other.figures[name])
        a, b = (a[-1:], b[-1:]) if rows is None else (a, b[rows])
        size = max(np.abs(other.figures[name]).max(), FLOORS[name.split("[")[1].rstrip("]")])
        found = float(np.abs(a - b).max() / size)
        if not found <= worst:
            worst, which = found, name
    return worst, which


def moved(answer):
    """(largest change of a figure over its size, its name)"""
    worst, which = 0.0, ""
    for name in probes(answer):
        values = answer.figures[name]
        size = max(np.abs(values).max(), FLOORS[name.split("[")[1].rstrip("]")])
        found = float((values.max() - values.min()) / size)
        if not found <= worst:
            worst, which = found, name
    return worst, which
