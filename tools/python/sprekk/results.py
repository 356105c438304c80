"""The folder of a run: its histories, fields, paths of fractures, and record."""

import difflib
import json
from functools import cached_property
from pathlib import Path

import numpy as np

from .files import chain, read_pvd, read_table, read_vtu

SAME_TIME = 1e-9  # of two written times, over the time


def without_unit(name):
    return name.partition("[")[0]


def found(data, name, what):
    """The values by a name with or without its unit."""
    for key, values in data.items():
        if name in (key, without_unit(key)):
            return values
    names = [without_unit(key) for key in data]
    near = difflib.get_close_matches(name, names, 1)
    raise KeyError(f"no {what} '{name}' (there are: {', '.join(names)})" + (f" did you mean '{near[0]}'?" if near else ""))


class Fields:
    """The fields of a run on one mesh at a written time; fields["pore.pressure"] are values of cells (or of points).

    Of vectors, x and y (in space also z) are the columns, and of stresses xx, yy, xy the three; fields["rock.stress.xy"] is one of
    them. On fractures, components along and across them are fields of their own. `dimension` is 2 in a plane, 3 in space."""

    def __init__(self, time, grid, dimension=2):
        self.time = time  # s
        self.grid = grid
        self.dimension = dimension

    @property
    def points(self):
        """(n, dimension), m"""
        return self.grid.points[:, :self.dimension]

    @property
    def cells(self):
        """(m, 2 to 8): points of each cell. Among larger cells, smaller ones repeat their last point."""
        return self.grid.cells

    @cached_property
    def centres(self):
        """(m, dimension): centres of gravity of cells, m"""
        return self.grid.centres_and_sizes()[0][:, :self.dimension]

    @cached_property
    def sizes(self):
        """Areas of cells (m^2; volumes in space, m^3), or lengths of cells on fractures (m; areas in space, m^2)."""
        return self.grid.centres_and_sizes()[1]

    @property
    def names(self):
        """{field: unit}"""
        return {without_unit(key): key.partition("[")[2].rstrip("]") for data in (self.grid.cell_data, self.grid.point_data)
                for key in data if "[" in key}

    def __getitem__(self, name):
        data = {**self.grid.point_data, **self.grid.cell_data}
        for key, names in self.grid.component_names.items():
            whole, _, component = without_unit(name).rpartition(".")
            if whole == without_unit(key) and component in names:
                return data[key][:, names.index(component)]
        values = found(data, name, "field")
        # In a plane vectors have a third component, 0, for ParaView; tensors do not.
        names = next((names for key, names in self.grid.component_names.items() if name in (key, without_unit(key))), [])
        return values[:, :self.dimension] if names[:1] == ["x"] else values

    def mean(self, name):
        """The mean over the area, or over the length of fractures, where the field has values (a contact on some fractures is nan on the
        others). Fields of points are linear in triangles and tetrahedra; in other cells the mean of their points is taken."""
        values = self[name]
        own = {without_unit(name), without_unit(name).rpartition(".")[0]}
        if own.isdisjoint(map(without_unit, self.grid.cell_data)):
            values = self.grid.means_in_cells(values)
        has_value = np.isfinite(values.reshape(len(values), -1)).all(axis=1)
        return np.tensordot(self.sizes[has_value], values[has_value], 1) / self.sizes[has_value].sum()


class Results:
    """The folder of a run. Everything is read when it is asked for, in SI units."""

    def __init__(self, folder):
        self.folder = Path(folder)
        if not (self.folder / "run.json").is_file():
            raise FileNotFoundError(f"{folder} is no folder of results (it has no run.json) give the folder that 'sprekk run' has named")

    @cached_property
    def record(self):
        """run.json: exit, results, notes, counters, timings, scene …"""
        return json.loads((self.folder / "run.json").read_text(encoding="utf-8"))

    @property
    def is_done(self):
        return self.record["exit"]["code"] == 0

    @property
    def parameters(self):
        """{path: value as text} of the scene, with every default."""
        return {path: parameter["value"] for path, parameter in self.record["scene"]["parameters"].items()}

    @property
    def notes(self):
        return [note["text"] for note in self.record["notes"]]

    @cached_property
    def history(self):
        """{column: values} of history.csv; nan where it is empty."""
        return read_table(self.folder / "history.csv")

    def __getitem__(self, name):
        """A column of the history by its name with or without its unit."""
        return found(self.history, name, "column")

    @property
    def times(self):
        """The ends of the steps, s."""
        return self["time"]

    @property
    def rows(self):
        """The history as a list of {column without its unit: value}."""
        columns = {without_unit(name): values for name, values in self.history.items()}
        return [dict(zip(columns, row)) for row in zip(*(np.asarray(values).tolist() for values in columns.values()))]

    def at(self, name, time):
        """A column at a time (s), linear between the steps; nan outside of the run."""
        return np.interp(time, self.times, self[name], left=np.nan, right=np.nan)

    def written(self, kind="matrix"):
        """Times at which fields have been written, s; those of "fractures" and "paths" may be fewer."""
        index = self.folder / f"{kind}.pvd"
        return [time for time, _ in read_pvd(index)] if index.exists() else []

    def fields(self, time=None, kind="matrix"):
        """The fields of the matrix at a written time, by default the last one."""
        index = self.folder / f"{kind}.pvd"
        entries = read_pvd(index) if index.exists() else []
        if not entries:
            raise FileNotFoundError(f"{self.folder} has no fields ({index.name} is missing or empty) see 'output: {{fields, every}}' of the scene")
        nearest, file = entries[-1] if time is None else min(entries, key=lambda entry: abs(entry[0] - time))
        if time is not None and abs(nearest - time) > SAME_TIME * max(abs(nearest), abs(time)):
            raise KeyError(f"no fields at {time:g} s (the nearest written time is {nearest:g} s) see Results.written()")
        return Fields(nearest, read_vtu(file), self.record.get("dimension", 2))

    def fractures(self, time=None):
        """The fields on fractures at a written time; ["fracture"] is the number of each cell's fracture."""
        return self.fields(time, "fractures")

    def paths(self, time=None):
        """{fracture number: [(n, 2) points of a piece of its line]} at a written time: the cells of the fracture, and what has grown
        and is not in the mesh yet."""
        lines = self.fractures(time)
        if lines.dimension == 3:
            raise ValueError(f"{self.folder} has a run in space, whose fractures are surfaces (take the points and cells of fractures())")
        pieces = {}
        numbers = lines.grid.cell_data["fracture"]
        for number in np.unique(numbers):
            _, order = chain(lines.grid, np.flatnonzero(numbers == number))
            ends = lines.points[lines.cells[order]]
            pieces[int(number)] = [np.concatenate([ends[:, 0], ends[-1:, 1]])]
        if any(abs(other - lines.time) <= SAME_TIME * abs(lines.time) for other in self.written("paths")):
            more = self.fields(lines.time, "paths")
            for number, cell in zip(more.grid.cell_data["fracture"], more.cells):
                pieces.setdefault(int(number), []).append(more.points[cell])
        return pieces
