"""The cells that share the rate of a well at its point, and their shares, from the written mesh and apertures alone: as
docs/numerics/wells.md (in rock) and docs/numerics/fracture_flow.md ("At a point") have them.
"""

import numpy as np

LEAST_APERTURE = 1e-7  # m, `aperture_floor`
SAME_PLACE = 1e-9      # of the size of a cell


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


class Rock:
    """Triangles whose nodes on fractures exist once a side."""

    def __init__(self, grid):
        self.points, self.cells = grid.points[:, :2], grid.cells
        self.centres = self.points[self.cells].mean(axis=1)
        sides = np.sort(np.concatenate([self.cells[:, [0, 1]], self.cells[:, [1, 2]], self.cells[:, [2, 0]]]), axis=1)
        sides, counts = np.unique(sides, axis=0, return_counts=True)
        self.on_sides = set(sides[counts == 1].ravel())

    def around(self, node, first):
        """The cells at a node, counter-clockwise from one of them on."""
        cells = np.flatnonzero((self.cells == node).any(axis=1))
        away = self.centres[cells] - self.points[node]
        cells = list(cells[np.argsort(np.arctan2(away[:, 1], away[:, 0]))])
        start = cells.index(first)
        return cells[start:] + cells[:start]

    def mean_values(self, cells, x):
        """Floater's coordinates of x in the polygon of the centres of cells, or None where not all of it is seen from x."""
        away = self.centres[cells] - x
        angles = [np.arctan2(cross(a, b), a @ b) for a, b in zip(away, np.roll(away, -1, axis=0))]
        if min(angles) < 0 or abs(sum(angles) - 2 * np.pi) > SAME_PLACE or max(angles) > np.pi * (1 - SAME_PLACE):
            return None
        half = np.tan(np.array(angles) / 2)
        weights = (half + np.roll(half, 1)) / np.hypot(*away.T)
        return dict(zip(cells, weights / weights.sum()))

    def neighbours(self, node, cells):
        """The pairs of cells that follow one another around a node, with rock between their centres that belongs to it."""
        pairs = []
        for one, other in zip(cells, cells[1:] + cells[:1]):
            is_joined = len(set(self.cells[one]) & set(self.cells[other])) == 2
            leaves_out = cross(self.centres[one] - self.points[node], self.centres[other] - self.points[node]) < 0
            if one != other and (is_joined or len(cells) > 2 and leaves_out):
                pairs.append((one, other))
        return pairs

    def chain(self, node, home):
        """(cells in order, or None where they do not surround a polygon; pairs) that go on from `home`."""
        cells = self.around(node, home)
        pairs, reached, size = self.neighbours(node, cells), {home}, 0
        while size < len(reached):
            size = len(reached)
            for pair in pairs:
                if reached & set(pair):
                    reached |= set(pair)
        return cells if len(pairs) == len(cells) > 2 else None, [pair for pair in pairs if pair[0] in reached]

    def beside(self, home, x):
        """Where no cells around an inner node surround x: of the nearest point on the lines between centres of neighbours."""
        best, nearest = {home: 1.0}, np.hypot(*(self.centres[home] - x))
        for node in self.cells[home]:
            polygon, pairs = self.chain(node, home)
            found = self.mean_values(polygon, x) if polygon else None
            if found:
                return found
            for one, other in pairs:
                way = self.centres[other] - self.centres[one]
                part = np.clip((x - self.centres[one]) @ way / (way @ way), 0, 1)
                away = np.hypot(*(self.centres[one] + part * way - x))
                if away < nearest:
                    best, nearest = {one: 1 - part, other: part}, away
        return best

    def shares(self, home, x):
        size = np.sqrt(abs(cross(*(self.points[self.cells[home][1:]] - self.points[self.cells[home][0]]))) / 2)
        if np.hypot(*(self.centres[home] - x)) <= SAME_PLACE * size:
            return {home: 1.0}
        for node in self.cells[home]:
            found = None if node in self.on_sides else self.mean_values(self.around(node, home), x)
            if found:
                return found
        return self.beside(home, x)


class Fracture:
    """What the cubic law makes of a place in a fracture that does not cross others, with the viscosity of the fluid."""

    def __init__(self, grid, home, x, viscosity):
        ends = grid.points[:, :2][grid.cells]
        self.half = np.hypot(*(ends[:, 1] - ends[:, 0]).T) / 2
        self.viscosity, self.home = viscosity, home
        along = (ends[home][1] - ends[home][0]) / (2 * self.half[home])
        off = (x - ends[home].mean(axis=0)) @ along
        end = grid.cells[home][0 if off < 0 else 1]
        cells = np.flatnonzero((grid.cells == end).any(axis=1) & (grid.cell_data["fracture"] == grid.cell_data["fracture"][home]))
        self.others = [cell for cell in cells if cell != home]
        self.part = min(abs(off) / self.half[home], 1.0) if self.others else 0.0

    def conductances(self, aperture):
        """Of the home and the other half cell beside the end, between which the opening is linear."""
        other = self.others[0]
        found = []
        for own, beside in ((self.home, other), (other, self.home)):
            change = (aperture[beside] - aperture[own]) * self.half[own] / (self.half[own] + self.half[beside])
            middle = max(aperture[own] + change / 2, LEAST_APERTURE)
            found.append(middle ** 3 / (12 * self.viscosity * self.half[own]))
        return found

    def shares(self, aperture):
        if self.part == 0:
            return {self.home: 1.0}
        home, other = self.conductances(aperture)
        passed = self.part * other / (home + other)
        return {self.home: 1 - passed, self.others[0]: passed}

    def rise(self, aperture):
        """Pa s/m^2: by this times its rate the place is above the mean of the cells."""
        if self.part == 0:
            return 0.0
        home, other = self.conductances(aperture)
        return self.part * (1 - self.part) / home + self.part ** 2 / (home + other)
