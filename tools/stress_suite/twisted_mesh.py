"""Meshes that no generator would make: graded, twisted, with slivers, and with cells and nodes in any order.

A grid of rectangles, clustered around its middle, is cut into triangles. Fractures lie on its lines. A rotation that
fades with the distance from the middle turns them to the wanted angle, or as far as the smallest angle allows.
"""

import random

import numpy as np

from . import physics


def clustered(first, last, cells, low, high, total):
    """Coordinates from 0 to total: `cells` equal cells from first to last, and geometrically growing ones outside."""
    def outside(distance, count, size):
        factor = 1.0
        for _ in range(60):  # sum of size·factor^i over count cells = distance
            partial = sum(size * factor**i for i in range(1, count + 1))
            factor *= (distance / partial) ** (1 / (count + 1))
        steps = np.array([size * factor**i for i in range(1, count + 1)])
        return np.cumsum(steps * distance / steps.sum())

    size = (last - first) / cells
    left = first - outside(first, low, size)[::-1]
    right = last + outside(total - last, high, size)
    left[0], right[-1] = 0.0, total
    return np.concatenate([left, np.linspace(first, last, cells + 1), right])


def smallest_angle(points, triangles):
    corners = points[triangles]
    angles = []
    for i in range(3):
        a = corners[:, (i + 1) % 3] - corners[:, i]
        b = corners[:, (i + 2) % 3] - corners[:, i]
        angles.append(np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(1))))
    return np.degrees(np.min(angles))


def areas(points, triangles):
    a = points[triangles[:, 1]] - points[triangles[:, 0]]
    b = points[triangles[:, 2]] - points[triangles[:, 0]]
    return 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def twist(points, middle, inner, outer, angle):
    offset = points - middle
    r = np.linalg.norm(offset, axis=1)
    s = np.clip((outer - r) / (outer - inner), 0, 1)
    turn = np.radians(angle) * s * s * (3 - 2 * s)
    cosine, sine = np.cos(turn), np.sin(turn)
    return middle + np.column_stack([cosine * offset[:, 0] - sine * offset[:, 1],
                                     sine * offset[:, 0] + cosine * offset[:, 1]])


class Grid:
    """The grid before it is shuffled: points, triangles, and lines by name."""

    def __init__(self, p):
        rng = random.Random(p["shuffle"])
        width, height, length = p["width"], p["height"], physics.length(p)
        x0 = 0.5 * (width - length)
        if p["place"] != "inside":
            x0 = width - length - max(0.02, p["gap"]) * length
        n = p["cells"]
        # Rows that are as flat as the wanted slivers.
        band = 4
        row = length / n * np.tan(np.radians(p["sliver"]))
        half = min(0.5 * band * row, 0.3 * height)
        x = clustered(x0, x0 + length, n, rng.randint(2, 5), rng.randint(2, 5), width)
        y = clustered(0.5 * height - half, 0.5 * height + half, band, rng.randint(3, 6), rng.randint(3, 6), height)
        self.columns, self.rows = len(x), len(y)
        self.points = np.array([[a, b] for b in y for a in x])
        halves = [self.halves(i, j, rng) for j in range(self.rows - 1) for i in range(self.columns - 1)]
        i0 = int(np.argmin(abs(x - x0)))
        j0 = int(np.argmin(abs(y - 0.5 * height)))
        self.lines = {"main": self.row_of(j0, i0, i0 + n)}
        if p["fractures"] == "parallel":
            self.lines["other"] = self.row_of(j0 + 1, i0 + 1, i0 + n - 1)
        elif p["fractures"] == "in_line":
            self.lines = {"main": self.row_of(j0, i0, i0 + n // 2), "other": self.row_of(j0, i0 + n // 2 + 1, i0 + n)}
        elif p["family"] == "meeting":
            self.lines.update(self.meeting(p, i0, j0, n))
            for a, b in zip(self.lines.get("third", []), self.lines.get("third", [])[1:]):
                halves[a // self.columns * (self.columns - 1) + a % self.columns] = [[a, a + 1, b], [a, b, b - 1]]
        self.lines = {name: line for name, line in self.lines.items() if len(line) > 1}
        self.triangles = np.array([t for pair in halves for t in pair])
        last = self.rows - 1
        self.sides = {"bottom": self.row_of(0, 0, self.columns - 1), "top": self.row_of(last, 0, self.columns - 1),
                      "left": [self.node(0, j) for j in range(self.rows)],
                      "right": [self.node(self.columns - 1, j) for j in range(self.rows)]}
        middle = np.array([x0 + 0.5 * length, 0.5 * height])
        self.turn(middle, 0.52 * length, 0.98 * min(middle[0], width - middle[0], 0.5 * height), p)

    def meeting(self, p, i0, j0, n):
        """Along a column, and from there to the upper right along diagonals: two rows of the flat band at most."""
        up = 1 if p["cut"] > 0 else -1
        i = i0 + (n if p["fractures"] == "corner" else min(n - 1, max(1, round(p["at"] * n))))
        one, other, third = (1 + round(arm) for arm in (2 * a for a in p["arms"]))
        found = {"other": [self.node(i, j0 + up * k) for k in range(-other, one + 1)]}
        if p["fractures"] in ("touch", "corner"):
            found["other"] = found["other"][other:]
        if p["fractures"] == "star":
            found["third"] = [self.node(i + k, j0 + k) for k in range(third + 1) if i + k < i0 + n]
        return found

    def node(self, i, j):
        return j * self.columns + i

    def row_of(self, j, first, last):
        return [self.node(i, j) for i in range(first, last + 1)]

    def halves(self, i, j, rng):
        a, b, c, d = self.node(i, j), self.node(i + 1, j), self.node(i + 1, j + 1), self.node(i, j + 1)
        return [[a, b, c], [a, c, d]] if rng.random() < 0.5 else [[a, b, d], [b, c, d]]

    def turn(self, middle, inner, outer, p):
        angle = p["angle"] if p["angle"] <= 90 else p["angle"] - 180
        flat = self.points
        wanted = min(5.0, 0.999 * smallest_angle(flat, self.triangles))
        while outer > inner and abs(angle) > 0.5:
            points = twist(flat, middle, inner, outer, angle)
            if areas(points, self.triangles).min() > 0 and smallest_angle(points, self.triangles) >= wanted:
                self.points = points
                return
            angle *= 0.8


def write(p, path):
    """A gmsh file (version 2.2) of the scene's mesh. Returns the names of its fractures."""
    grid = Grid(p)
    rng = random.Random(p["shuffle"] + 1)
    order = list(range(len(grid.points)))
    rng.shuffle(order)  # order[k]: the node that becomes number k + 1
    number = {node: k + 1 for k, node in enumerate(order)}
    names = list(grid.sides) + list(grid.lines)
    elements = []
    for tag, name in enumerate(names, 1):
        line = grid.sides.get(name) or grid.lines[name]
        elements += [f"1 2 {tag} {tag} {number[a]} {number[b]}" for a, b in zip(line, line[1:])]
    triangles = [list(t) for t in grid.triangles]
    rng.shuffle(triangles)
    surface = len(names) + 1
    for t in triangles:
        turn = rng.randrange(3)
        a, b, c = (number[t[(turn + k) % 3]] for k in range(3))
        elements.append(f"2 2 {surface} {surface} {a} {b} {c}")
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(surface)]
    text += [f'1 {tag} "{name}"' for tag, name in enumerate(names, 1)] + [f'2 {surface} "rock"', "$EndPhysicalNames"]
    text += ["$Nodes", str(len(order))]
    text += [f"{k} {grid.points[node][0]:.17g} {grid.points[node][1]:.17g} 0" for k, node in enumerate(order, 1)]
    text += ["$EndNodes", "$Elements", str(len(elements))] + [f"{k} {e}" for k, e in enumerate(elements, 1)]
    path.write_text("\n".join(text + ["$EndElements", ""]))
    return list(grid.lines)
