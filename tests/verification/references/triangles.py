"""Flow in rock and fractures by quadratic finite elements on triangles, with meshes of gmsh's library (libgmsh, called by ctypes).

-div(k grad p) = 0 with k of each triangle, natural boundaries, and p given at nodes. Lines may conduct in addition: K dp/ds along edges
of the mesh, with the pressure of the triangles beside them (a conductor whose walls take no pressure)."""

import ctypes
import os
import tempfile

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.linalg import spsolve


def mesh(geo):
    """Points (n, 2), triangles (m, 3) and edges on curves (l, 2) of the mesh of a text in gmsh's language."""
    library, error = ctypes.CDLL("libgmsh.so"), ctypes.c_int()
    call = lambda name, *arguments: getattr(library, name)(*arguments, ctypes.byref(error))
    call("gmshInitialize", 0, None, 0)
    call("gmshOptionSetNumber", b"General.Terminal", ctypes.c_double(0))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "rock.geo")
        with open(path, "w") as file:
            file.write(geo + "\nMesh.MshFileVersion = 2.2;\nMesh.SaveAll = 1;\n")
        call("gmshOpen", path.encode())
        call("gmshModelMeshGenerate", 2)
        call("gmshWrite", os.path.join(folder, "rock.msh").encode())
        call("gmshFinalize")
        with open(os.path.join(folder, "rock.msh")) as file:
            return read(file.read().split("\n"))


def read(rows):
    start = rows.index("$Nodes") + 1
    count = int(rows[start])
    nodes = np.array([[float(word) for word in row.split()] for row in rows[start + 1:start + 1 + count]])
    place = {int(number): i for i, number in enumerate(nodes[:, 0])}
    start = rows.index("$Elements") + 1
    of_kind = {1: [], 2: []}
    for row in rows[start + 1:start + 1 + int(rows[start])]:
        words = [int(word) for word in row.split()]
        if words[1] in of_kind:
            of_kind[words[1]].append([place[word] for word in words[3 + words[2]:]])
    triangles, edges = np.array(of_kind[2]), np.array(of_kind[1])
    used = np.unique(triangles)
    new = np.full(count, -1)
    new[used] = np.arange(len(used))
    edges = edges[(new[edges] >= 0).all(axis=1)]
    return nodes[used, 1:3], new[triangles], new[edges]


class Flow:
    """Unknowns: the pressure at nodes, then at middles of edges."""

    def __init__(self, points, triangles, permeability):
        self.points, self.triangles = points, triangles
        sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        self.edges, number = np.unique(sides, axis=0, return_inverse=True)
        self.unknowns = np.hstack([triangles, len(points) + number.reshape(-1, 3)])
        self.places = np.vstack([points, points[self.edges].mean(axis=1)])
        x = points[triangles]
        area = 0.5 * ((x[:, 1, 0] - x[:, 0, 0]) * (x[:, 2, 1] - x[:, 0, 1]) - (x[:, 2, 0] - x[:, 0, 0]) * (x[:, 1, 1] - x[:, 0, 1]))
        opposite = x[:, [2, 0, 1]] - x[:, [1, 2, 0]]
        gradients = np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1) / (2 * area[:, None, None])
        stiffness = np.zeros((len(triangles), 6, 6))
        for l in ((2 / 3, 1 / 6, 1 / 6), (1 / 6, 2 / 3, 1 / 6), (1 / 6, 1 / 6, 2 / 3)):
            shape = self.shape_gradients(l, gradients)
            stiffness += (np.abs(area) * permeability / 3)[:, None, None] * np.einsum("tid,tjd->tij", shape, shape)
        self.rows = [np.repeat(self.unknowns, 6, axis=1).ravel()]
        self.columns = [np.tile(self.unknowns, (1, 6)).ravel()]
        self.values = [stiffness.ravel()]

    @staticmethod
    def shape_gradients(l, g):
        corners = [(4 * l[i] - 1) * g[:, i] for i in range(3)]
        middles = [4 * (l[i] * g[:, j] + l[j] * g[:, i]) for i, j in ((0, 1), (1, 2), (2, 0))]
        return np.stack(corners + middles, axis=1)

    def add_lines(self, edges, conductance):
        """`conductance`: K of each edge."""
        number = {tuple(edge): len(self.points) + i for i, edge in enumerate(self.edges)}
        unknowns = np.array([[*edge, number[tuple(sorted(edge))]] for edge in edges])
        length = np.linalg.norm(self.points[edges[:, 1]] - self.points[edges[:, 0]], axis=1)
        of_unit = np.array([[7, 1, -8], [1, 7, -8], [-8, -8, 16]]) / 3
        self.rows.append(np.repeat(unknowns, 3, axis=1).ravel())
        self.columns.append(np.tile(unknowns, (1, 3)).ravel())
        self.values.append(((conductance / length)[:, None, None] * of_unit).ravel())

    def solve(self, given):
        """`given`: pressures by unknown, NaN where the balance determines it. Also returns what flows out at each unknown."""
        n = len(self.places)
        matrix = csr_matrix(coo_matrix((np.concatenate(self.values), (np.concatenate(self.rows), np.concatenate(self.columns))), (n, n)))
        free = np.isnan(given)
        p = np.where(free, 0, given)
        p[free] = spsolve(matrix[free][:, free].tocsc(), -(matrix[free] @ p))
        return p, -(matrix @ p)

    def at(self, p, place):
        """The pressure at a place."""
        x = self.points[self.triangles]
        d = np.stack([x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]], axis=2)
        r = np.linalg.solve(d, (place - x[:, 0])[..., None])[..., 0]
        l = np.stack([1 - r.sum(axis=1), r[:, 0], r[:, 1]], axis=1)
        best = l.min(axis=1).argmax()
        a, b, c = l[best]
        shape = np.array([a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a])
        return float(shape @ p[self.unknowns[best]])


def near(points, segment):
    """Distances of points from a segment."""
    a, b = np.array(segment[:2]), np.array(segment[2:])
    s = np.clip(((points - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)
    return np.linalg.norm(points - a - s[:, None] * (b - a), axis=1)
