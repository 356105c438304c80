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

    All cells have as many points as the largest ones have; smaller ones repeat their last point."""

    points: np.ndarray
    cells: np.ndarray
    cell_data: dict = field(default_factory=dict)
    point_data: dict = field(default_factory=dict)
    component_names: dict = field(default_factory=dict)  # {array: [name of each component]}, of vectors and tensors
    types: np.ndarray = None  # VTK's number of each cell's shape; by default that of lines, triangles or quadrilaterals

    def __post_init__(self):
        if self.types is None:
            corners = self.cells.shape[1] - (self.cells[:, -1] == self.cells[:, -2]) * (self.cells.shape[1] > 2)
            self.types = np.choose(corners - 2, (3, 5, 9))

    def triangles(self):
        """Triangles (k, 3) that cover the cells, and the cell of each: a quadrilateral is two of them."""
        if (self.types > 9).any():
            raise ValueError("the cells are bodies in space (take simplices())")
        if self.cells.shape[1] == 3:
            return self.cells, np.arange(len(self.cells))
        second = np.flatnonzero(self.cells[:, 2] != self.cells[:, 3])
        return (np.concatenate([self.cells[:, :3], self.cells[second][:, [0, 2, 3]]]),
                np.concatenate([np.arange(len(self.cells)), second]))

    def centres_and_sizes(self):
        """Centres of gravity (m, 3), and the volumes of cells, their areas, or the lengths of lines."""
        corners, cell = self.simplices()
        edges = corners[:, 1:] - corners[:, :1]
        # The determinant of Gram's matrix is the square of the measure of a simplex times its dimension's factorial.
        grams = np.einsum("nik,njk->nij", edges, edges)
        measures = np.sqrt(np.maximum(np.linalg.det(grams), 0)) / (1, 1, 2, 6)[edges.shape[1]]
        count = len(self.cells)
        sizes = np.bincount(cell, measures, count)
        moments = measures[:, None] * corners.mean(axis=1)
        centres = np.stack([np.bincount(cell, moments[:, k], count) for k in range(3)], axis=1) / sizes[:, None]
        return centres, sizes

    def means_in_cells(self, values):
        """The mean over the points of each cell, of values of points."""
        counts = np.ones(self.cells.shape, bool)  # smaller cells repeat their last point
        counts[:, 1:] = self.cells[:, 1:] != self.cells[:, :-1]
        shares = counts / counts.sum(axis=1, keepdims=True)
        return np.einsum("mk,mk...->m...", shares, values[self.cells])

    def simplices(self):
        """The corners (k, d + 1, 3) of lines, triangles or tetrahedra that make up the cells, and the cell of each. A quadrilateral
        that bounds a body is taken for the four triangles between its edges and the mean of its nodes, as the program does."""
        divided = {3: [(0, 1)], 5: [(0, 1, 2)], 9: [(0, 1, 2), (0, 2, 3)], 10: [(0, 1, 2, 3)]}
        faces_of = {12: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],  # hexahedra
                    13: [(0, 1, 2), (3, 4, 5), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)]}  # wedges
        parts, cells = [np.zeros((0, 2, 3))] if len(self.types) == 0 else [], []
        for shape in np.unique(self.types):
            of_shape = np.flatnonzero(self.types == shape)
            nodes = self.points[self.cells[of_shape]]
            if shape in divided:
                found = [nodes[:, list(corners)] for corners in divided[shape]]
            else:
                middle = nodes[:, sorted({k for face in faces_of[shape] for k in face})].mean(axis=1)
                found = []
                for face in map(list, faces_of[shape]):
                    ends = [nodes[:, face].mean(axis=1)] if len(face) == 4 else []
                    edges = zip(face, face[1:] + face[:1]) if len(face) == 4 else [face]
                    found += [np.stack([middle, *ends, *(nodes[:, k] for k in edge)], axis=1) for edge in edges]
            parts += found
            cells += [of_shape] * len(found)
        return np.concatenate(parts), np.concatenate([np.zeros(0, int), *cells])


def read_vtu(path):
    """A .vtu file as Sprekk writes it: raw appended data, not compressed."""
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
    return Grid(points, connectivity, named("CellData"), named("PointData"), names, cells["types"])


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
