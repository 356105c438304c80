"""What a run has written: the fields of every step, and the tables."""

import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
import sprekk  # noqa: E402


@dataclass
class Instant:
    """Fields at the end of a step. Vectors on fractures have the columns normal, tangential; in space two tangential ones."""

    time: float
    matrix: sprekk.Grid
    fractures: sprekk.Grid
    follows: bool  # whether the step before it is the Instant before it

    def cell(self, name):
        return self.matrix.cell_data[name]

    def on_fractures(self, name, unit):
        data = self.fractures.cell_data
        if f"{name}[{unit}]" in data:
            return data[f"{name}[{unit}]"]
        parts = [part for part in ("normal", "tangential", "tangential1", "tangential2") if f"{name}.{part}[{unit}]" in data]
        return np.column_stack([data[f"{name}.{part}[{unit}]"] for part in parts])


def exit_record(folder):
    return json.loads((folder / "run.json").read_text())


def history(folder):
    path = folder / "history.csv"  # there is none before the first step
    return sprekk.read_table(path) if path.exists() else {}


def iterations_of_steps(folder):
    """(Newton's iterations of accepted steps, accepted steps, rejected steps). A run that ends in its start counts no steps."""
    record, table = exit_record(folder), history(folder)
    counters = record.get("counters", {})
    return [int(i) for i in table.get("iterations[1]", [])], counters.get("steps accepted", 0), counters.get("steps rejected", 0)


def steps_solved_together(folder):
    """Accepted steps whose passes did not converge, and which `fallback: monolithic` has solved: as the run's note counts them."""
    return sum(note["steps"] for note in exit_record(folder).get("notes", []) if note["topic"] == "steps solved together")


def told(folder, topic, number):
    """The number that the run's note on a topic has where `number` (a regular expression with one group) finds it; 0 without it."""
    found = [re.search(number, note["text"]) for note in exit_record(folder).get("notes", []) if note["topic"] == topic]
    return max((float(match.group(1)) for match in found if match), default=0.0)


def instants(folder):
    if not (folder / "matrix.pvd").exists():  # no time of output was reached
        return []
    matrix = sprekk.read_pvd(folder / "matrix.pvd")
    fractures = sprekk.read_pvd(folder / "fractures.pvd")
    table = history(folder)
    if not table:  # no step was accepted
        return []
    ends = np.asarray(table["time[s]"])
    begins = ends - np.asarray(table["step[s]"])
    found, last = [], 0.0
    for (t, file), (_, other) in zip(matrix, fractures):
        if t < ends[0]:  # the start, which no equation has been solved for
            continue
        row = int(np.argmin(abs(ends - t)))
        follows = abs(begins[row] - last) <= 1e-9 * ends[-1]
        found.append(Instant(t, sprekk.read_vtu(file), sprekk.read_vtu(other), follows))
        last = t
    return found
