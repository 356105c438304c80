"""Reads the folder that a run of Sprekk has written: fields (.pvd, .vtu) and tables (.csv)."""

import csv
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

NUMBER_TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "<u1", "Int8": "<i1"}


@dataclass
class Grid:
    """Points (n, 3), cells (m, points per cell), and the arrays on them by name.

    Where there are quadrilaterals the cells have four points, and triangles between them repeat their last one."""

    points: np.ndarray
    cells: np.ndarray
    cell_data: dict = field(default_factory=dict)
    point_data: dict = field(default_factory=dict)
    component_names: dict = field(default_factory=dict)  # {array: [name of each component]}, of vectors and tensors

    def triangles(self):
        """Triangles (k, 3) that cover the cells, and the cell of each: a quadrilateral is two of them."""
        if self.cells.shape[1] == 3:
            return self.cells, np.arange(len(self.cells))
        second = np.flatnonzero(self.cells[:, 2] != self.cells[:, 3])
        return (np.concatenate([self.cells[:, :3], self.cells[second][:, [0, 2, 3]]]),
                np.concatenate([np.arange(len(self.cells)), second]))

    def centres_and_sizes(self):
        """Centres of gravity (m, 2), and the areas of cells or the lengths of lines."""
        if self.cells.shape[1] == 2:
            ends = self.points[self.cells][:, :, :2]
            return ends.mean(axis=1), np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        triangles, cell = self.triangles()
        corners = self.points[triangles][:, :, :2]
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        areas = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
        count = len(self.cells)
        sizes = np.bincount(cell, areas, count)
        moments = areas[:, None] * corners.mean(axis=1)
        centres = np.stack([np.bincount(cell, moments[:, k], count) for k in range(2)], axis=1) / sizes[:, None]
        return centres, sizes


def read_vtu(path):
    """A .vtu file as Sprekk writes it: raw appended data, not compressed, triangles and
    quadrilaterals, or lines."""
    content = Path(path).read_bytes()
    head, marker, tail = content.partition(b"<AppendedData")
    if not marker:
        raise ValueError(f"{path} has no appended data")
    root = xml.fromstring(head + b"</VTKFile>")
    if root.get("compressor") or root.get("header_type") != "UInt64":
        raise ValueError(f"{path} is compressed or has short headers")
    data = memoryview(tail)[tail.index(b"_") + 1:]

    def values(array):
        offset = int(array.get("offset"))
        size = int(np.frombuffer(data, "<u8", 1, offset)[0])
        kind = np.dtype(NUMBER_TYPES[array.get("type")])
        flat = np.frombuffer(data, kind, size // kind.itemsize, offset + 8)
        components = int(array.get("NumberOfComponents", 1))
        return flat.reshape(-1, components) if components > 1 else flat

    def named(section):
        return {array.get("Name"): values(array) for array in piece.find(section)}

    piece = root.find("UnstructuredGrid/Piece")
    cells = named("Cells")
    count = int(piece.get("NumberOfCells"))
    ends = cells["offsets"] if count else np.zeros(0, int)
    lengths = np.diff(ends, prepend=0)
    places = (ends - lengths)[:, None] + np.minimum(np.arange(lengths.max(initial=2)), lengths[:, None] - 1)
    connectivity = cells["connectivity"][places] if count else np.zeros((0, 2), int)
    points = values(piece.find("Points/DataArray")).reshape(-1, 3)
    names = {array.get("Name"): [array.get(f"ComponentName{i}") for i in range(int(array.get("NumberOfComponents")))]
             for section in ("CellData", "PointData") for array in piece.find(section) if array.get("ComponentName0")}
    return Grid(points, connectivity, named("CellData"), named("PointData"), names)


def read_pvd(path):
    """[(time in s, file)], in the order of time."""
    entries = xml.parse(path).getroot().iter("DataSet")
    folder = Path(path).parent
    return sorted((float(entry.get("timestep")), folder / entry.get("file")) for entry in entries)


def number(text, path, line, column):
    try:
        return float(text) if text else np.nan
    except ValueError:
        raise ValueError(f"{path}, line {line}, column {column}: '{text}' is no number (the file is damaged)") from None


def read_table(path):
    """{column: values}; numbers as an array with nan where the table is empty, texts as a list.

    A last row without the end of its line was cut short when its writer ended, and is left out, as Sprekk does itself. Columns whose
    names have a unit are numbers. ValueError where one of them is not, and where another row is not complete."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if line.endswith("\n")))
    for line, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise ValueError(f"{path}, line {line}: {len(row)} cells, and {len(rows[0])} columns (the file is cut off or damaged)")
    columns = {}
    for i, name in enumerate(rows[0] if rows else []):
        texts = [row[i] for row in rows[1:]]
        if name.endswith("]"):
            columns[name] = np.array([number(text, path, line, name) for line, text in enumerate(texts, 2)])
            continue
        try:
            columns[name] = np.array([float(text) if text else np.nan for text in texts])
        except ValueError:
            columns[name] = texts
    return columns


def chain(grid, cells):
    """The distance (m) of each of a fracture's cells from its first point, and the cells in that order."""
    lines = grid.cells[cells]
    lengths = np.linalg.norm(grid.points[lines[:, 1]] - grid.points[lines[:, 0]], axis=1)
    following = {start: i for i, start in enumerate(lines[:, 0])}
    ends = set(lines[:, 1])
    first = next((i for i, start in enumerate(lines[:, 0]) if start not in ends), 0)
    order = [first]
    while len(order) < len(cells) and lines[order[-1], 1] in following:
        order.append(following[lines[order[-1], 1]])
    along = np.cumsum(lengths[order]) - lengths[order] / 2
    return along, cells[order]
