"""Pressures stay within what physics allows, and do not alternate from cell to cell.

Bounds: a pressure lies between those that were given, widened by what loads and injection can make of it.
- Loads: undrained, S p = -alpha div u, at most B = alpha/(alpha^2 + S (lambda + G)) times the range of the mean stress in
  the plane since the start, at rest, which near tips is the written one. (More than the stress where S is below what grains
  allow.) It is the range and not the largest: what has drained under a load is missing when the load is taken away. With the
  part G(t, s) that is left at t of what a load at s has made, p = -B int G ds/ds, and G rises with s to 1. Loads of steps
  that are not written, which end where a rate changes, are those of the scene.
- Injection of a volume V: at most V over the compressibility of the fluid in the fracture, or what opens the fracture
  by V, whichever is less (a crack of length L under the net pressure q opens by pi L^2 q/(2 E')); twice that for the
  sides of the box.
- Walls that overlap (contact/penalty) press on the fluid as a fracture that closes, and let go of it.
- Heat: what expands counts as a load, 3 K alpha_T times the range of temperatures.
- Fluid that is warmed in closed rock, or in a closed fracture: its expansion over the compressibility there.
- Gravity: the weight of the heaviest fluid between two corners of the box.
- Wells with limits: these, where their rates drive pressures to them, and given ones; in rock for the mean of the cells that share
  a well, at its place.
- A fracture that has opened, and closes: at most the stress that closes it.
- Opening by slip, and extraction, lower the pressure without a bound of their own where the rock gives no fluid.
Alternating: a cell is a peak (a trough) when its pressure is above (below) that of all its neighbours by more than 2 %
of all differences there are; the neighbour of a cell at a fracture is the fluid in it. In a checkerboard all cells are
one or the other, side by side. Smooth pressures may have a ring of peaks, around a fracture whose load falls, but from
there they fall to the fracture and away from it, with no trough in between. Two-point fluxes of a weight do not add up to
nothing in triangles that are not orthogonal, and raise and lower pressures cell by cell: there peaks are not counted.
Cells at walls that are deeper than what a step diffuses through take up fluid as their depths say, with every flow, monotone ones
as well. This scatter is no alternation. Along fractures it is told by rising and falling with the depths throughout (or against them:
what earlier steps have left); in the rock it stays when the differences have gone, and counts against those that there have been.
Rock that is strained by more than 1 is turned inside out: its equations mean nothing any more, as the run says in a note, and the
pressures that such strains squeeze out of cells are not judged.
"""

import math

import numpy as np

from . import buoyancy, check_wells, heat, limited_wells, physics, pressed, swaps

MISSED = 0.05  # of the differences
PEAK = 0.02
SHARE = 0.1
# Along a fracture: what two cells differ by, of the whole change, and how often in a row. Cells of an unstructured mesh
# lie at different distances from the fracture; short steps, whose layer of diffusion is thinner, show it as a scatter.
SCATTER = 0.05
IN_A_ROW = 5
SAME_DEPTH = 1e-6
INSIDE_OUT = 1  # strain


def cells_of_edges(instant):
    """({edge: its cells}, the edges of the fracture cells)."""
    def edge(grid, a, b):
        return tuple(sorted(tuple(np.round(grid.points[corner], 12)) for corner in (a, b)))
    edges = {}
    for cell, corners in enumerate(instant.matrix.cells):
        for i in range(3):
            edges.setdefault(edge(instant.matrix, corners[i], corners[(i + 1) % 3]), []).append(cell)
    return edges, [edge(instant.fractures, a, b) for a, b in instant.fractures.cells]


def neighbours(instant):
    """Pairs of cells that share an edge which is not on a fracture."""
    edges, on_fractures = cells_of_edges(instant)
    excluded = set(on_fractures)
    return np.array([cells for edge, cells in edges.items() if len(cells) == 2 and edge not in excluded])


def at_walls(instant):
    """Pairs of a cell and a fracture cell that is one of its edges."""
    edges, on_fractures = cells_of_edges(instant)
    return np.array([(cell, line) for line, edge in enumerate(on_fractures) for cell in edges[edge]])


def alternating(pressure, fracture, pairs, walls, differences=0.0):
    """Share of the cells with three neighbours that are peaks beside a trough, or troughs beside a peak: by more than a part of the
    differences that there are, or of those given."""
    below, above, degree = (np.zeros(len(pressure), int) for _ in range(3))
    margin = PEAK * max(pressure.max() - pressure.min(), differences)
    difference = pressure[pairs[:, 0]] - pressure[pairs[:, 1]]
    for cells, more in ((pairs[:, 0], difference), (pairs[:, 1], -difference),
                        (walls[:, 0], pressure[walls[:, 0]] - fracture[walls[:, 1]])):
        np.add.at(above, cells, more > margin)
        np.add.at(below, cells, more < -margin)
        np.add.at(degree, cells, 1)
    peak, trough = (above == degree) & (degree >= 2), (below == degree) & (degree >= 2)
    opposite = (peak[pairs[:, 0]] & trough[pairs[:, 1]]) | (trough[pairs[:, 0]] & peak[pairs[:, 1]])
    beside = np.zeros(len(pressure), bool)
    beside[pairs[opposite].ravel()] = True
    inner = degree == 3
    return beside[inner].mean() if inner.any() else 0.0


def conduction_of_deep_walls(instant, walls, layer):
    """For every fracture cell the sum of 1/depth of the triangles at its walls, where they are deeper than `layer`; else nan."""
    ends = instant.fractures.points[instant.fractures.cells][:, :, :2]
    along = ends[:, 1] - ends[:, 0]
    across = np.column_stack([along[:, 1], -along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    arms = instant.matrix.points[instant.matrix.cells[walls[:, 0]]].mean(1)[:, :2] - ends[walls[:, 1]].mean(1)
    depth = 3 * np.abs((arms * across[walls[:, 1]]).sum(1))
    sums, shallowest = np.zeros(len(ends)), np.full(len(ends), np.inf)
    np.add.at(sums, walls[:, 1], 1 / depth)
    np.minimum.at(shallowest, walls[:, 1], depth)
    return np.where(shallowest > layer, sums, np.nan)


def alternating_along(pressure, margin, conduction=None):
    """The most changes of direction one after the other along a fracture. `conduction` of deep walls: a row of changes that all rise
    with it, or all fall with it, does not count."""
    steps = np.diff(pressure)
    conduction = np.full(len(pressure), np.nan) if conduction is None else conduction
    by_depths = np.diff(conduction)
    is_same = np.abs(by_depths) < SAME_DEPTH * np.abs(conduction[1:])
    with_depths = np.sign(steps) * np.where(is_same, 0, np.sign(by_depths))
    longest = run = 0
    for i, (a, b) in enumerate(zip(steps, steps[1:])):
        run = run + 1 if a * b < 0 and min(abs(a), abs(b)) > margin else 0
        row = with_depths[i + 1 - run:i + 2]
        if not (np.isfinite(row).all() and abs(row.sum()) == len(row)):
            longest = max(longest, run)
    return longest


def has_uneven_weight(p):
    """Whether two-point fluxes of the weight of fluid differ from cell to cell: no mesh here is orthogonal."""
    return "buoyancy" in p and p["discretization"] == "tpfa"


class Stresses:
    """What loads have done until now: the least and the largest mean in the plane, and the largest of all normal stresses."""

    def __init__(self, p, times):
        self.p, self.times = p, np.asarray(times)
        self.least = self.most = self.largest = 0.0

    def see(self, instant):
        stress = instant.cell("rock.stress[Pa]")[:, :2]
        means = [stress.mean(1).min(), stress.mean(1).max()]
        if self.p["sides"] == "stress":
            means += [np.mean(physics.stresses(self.p, t)) for t in self.times[self.times <= instant.time]]
        self.least, self.most = min(self.least, *means), max(self.most, *means)
        self.largest = max(self.largest, np.abs(stress).max())


def bounds(p, instant, stresses, has_opened):
    given = [p["initial"]] + ([p["boundary_pressure"]] if p["boundary"] == "across" else []) + limited_wells.pressures(p)
    mean = 0.0
    if p["alpha"] > 0:
        heated = 3 * physics.bulk_modulus(p) * p["expansion"] * (max(heat.given(p)) - min(heat.given(p))) if heat.is_in(p) else 0.0
        mean = p["alpha"] * (stresses.most - stresses.least + heated) / (p["alpha"] ** 2 + p["storage"] * physics.in_plane_modulus(p))
    mean += pressed.pressures(p, heat.given(p)) if pressed.is_in(p) else 0.0
    volume, length = abs(p["volume"] * physics.length(p) * p["aperture"]), physics.length(p)
    lowest, highest = min(given) - mean - buoyancy.weight(p), max(given) + mean + buoyancy.weight(p)
    if has_opened:
        highest = max(highest, stresses.largest) + mean
    if p["well"] in ("inject", "inject_extract"):
        compress = volume / (length * p["aperture"] * p["compressibility"]) if p["compressibility"] else math.inf
        opening = 2 * physics.plane_strain_modulus(p) * volume / (math.pi * length**2)
        loads = 2 * max(map(abs, physics.stresses(p, instant.time))) + stresses.largest
        highest += 2 * min(compress, opening + loads)
    if limited_wells.are_without_limit(p, "inject"):
        highest = math.inf
    return lowest, highest


def differences_around(instant, pressure, fracture):
    """For every cell, and every fracture cell: by how much pressures differ in two rings of what shares a corner, the fluid in
    fractures among them. From the first ring MPFA computes the fluxes of the cell, from the second those of its neighbours."""
    lines, cells = instant.fractures.cells, instant.matrix.cells
    corners = np.vstack([instant.matrix.points[cells].reshape(-1, 3), instant.fractures.points[lines].reshape(-1, 3)])
    _, places = np.unique(np.round(corners, 12), axis=0, return_inverse=True)
    of_cells, of_lines = places.ravel()[:cells.size].reshape(cells.shape), places.ravel()[cells.size:].reshape(lines.shape)

    def highest(pressure, fracture):
        at = np.full(places.max() + 1, -np.inf)
        np.maximum.at(at, of_cells, pressure[:, None])
        np.maximum.at(at, of_lines, fracture[:, None])
        return at[of_cells].max(1), at[of_lines].max(1)

    high, low = highest(*highest(pressure, fracture)), highest(*highest(-pressure, -fracture))
    return high[0] + low[0], high[1] + low[1]


def failures(p, instants, history=None, strain=0.0):
    found = []
    pairs = None
    been = 0.0  # differences until now
    stresses = Stresses(p, history["time[s]"] if history else [])
    has_opened = False
    for instant in instants:
        stresses.see(instant)
        pressure = instant.cell("pore.pressure[Pa]")
        fracture = instant.on_fractures("conduit.pressure", "Pa")
        has_opened = has_opened or swaps.contact(p) == "penalty" or instant.on_fractures("contact.jump", "m")[:, 0].max() > 0
        low, high = bounds(p, instant, stresses, has_opened)
        size = max(abs(low), abs(high), p["initial"], stresses.largest)  # Newton judges all pressures and stresses together
        # MPFA is no M-matrix: it may miss a bound by a part of the differences in the rock, and beside fractures of those
        # between their fluid and the rock, too.
        in_rock = pressure.max() - pressure.min()
        may_fall = p["well"] in ("extract", "inject_extract") or has_opened or limited_wells.are_without_limit(p, "extract")
        for values, around in zip((check_wells.at_places(p, instant), fracture), differences_around(instant, pressure, fracture)):
            slack = 1e-8 * size + MISSED * np.maximum(around, in_rock)
            for side, over in ((f"above {high:.6g}", values - high - slack), (f"below {low:.6g}", low - slack - values)):
                worst = int(np.argmax(over))
                if over[worst] > 0 and not (side.startswith("below") and may_fall):
                    found.append(f"pressure: {values[worst]:.6g} Pa {side} at t = {instant.time:.6g} s")
        if pairs is None:
            pairs, walls = neighbours(instant), at_walls(instant)
            conduction = conduction_of_deep_walls(instant, walls, physics.layer(p))
        if pressure.max() - pressure.min() > 1e-8 * size:
            been = max(been, pressure.max() - pressure.min()) if np.isfinite(conduction).all() else 0.0
            share = alternating(pressure, fracture, pairs, walls, been)
            if share > SHARE and not has_uneven_weight(p) and strain <= INSIDE_OUT:
                found.append(f"alternating: {100 * share:.0f} % of the cells are peaks beside troughs at t = {instant.time:.6g} s")
        numbers = instant.fractures.cell_data["fracture"]
        for number in np.unique(numbers):
            own = fracture[numbers == number]
            margin = max(SCATTER * np.abs(own - p["initial"]).max(), 1e-8 * size)
            if alternating_along(own, margin, conduction[numbers == number]) > IN_A_ROW:
                found.append(f"alternating: along fracture {number} at t = {instant.time:.6g} s")
    return found
