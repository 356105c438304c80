"""What the benchmarks read from the folder of a run."""

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools/python")]
from sprekk import Results, read_table  # noqa: E402, F401


class RunResults:
    """Fields at a time that was written, the last one by default, the history, and the record of the run."""

    def __init__(self, folder, entry=-1):
        self.folder = Path(folder)
        self.results = Results(folder)
        self.record = self.results.record
        self.counters = self.record["counters"]
        self.steps = self.counters["steps accepted"]
        written = self.results.fields(self.results.written()[entry])
        self.time, self.matrix = written.time, written.grid
        self.centres, self.areas = written.centres, written.sizes
        if self.results.written("fractures"):
            lines = self.results.fractures(self.time)
            self.fractures, self.fracture_centres, self.fracture_lengths = lines.grid, lines.centres, lines.sizes

    @property
    def history(self):
        """{column without its unit: values}"""
        return {name.partition("[")[0]: values for name, values in self.results.history.items()}

    def matrix_field(self, name):
        """Cell values by the name without its unit; vectors have two columns."""
        values = named(self.matrix.cell_data, name)
        return values[:, :2] if values.ndim > 1 else values

    def fracture_field(self, name):
        return named(self.fractures.cell_data, name)

    def mean(self, values):
        return float(self.areas @ values / self.areas.sum())


def named(data, name):
    for key, values in data.items():
        if key.partition("[")[0] == name:
            return values
    raise KeyError(f"no field {name} (there are: {', '.join(data)})")


def relative_error(weights, values, exact):
    """Weighted L2 norm of the difference over that of the exact values."""
    difference = np.square(values - exact).reshape(len(weights), -1).sum(axis=1)
    size = np.square(exact).reshape(len(weights), -1).sum(axis=1)
    return float(np.sqrt(weights @ difference / (weights @ size)))
