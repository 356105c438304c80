"""Scenes of the family wells: those of `separate` with wells that keep to limits (wells/limited) in the place of given rates."""

import functools
import json
import math

from . import draws, fractures, physics, twisted_mesh


def draw(rng):
    return {"well": "none", "wells": {f"well_{i}": draw_well(rng) for i in range(rng.randint(1, 3))}}


def draw_well(rng):
    kind = draws.choose(rng, inject=0.4, extract=0.25, cycle=0.15, pressure=0.2)
    return {
        "kind": kind,
        "in_fracture": rng.random() < 0.6,
        "at": (rng.uniform(0.05, 0.95), rng.uniform(0.05, 0.95)),  # of the box; the first one along the fracture
        "rate": draws.log_uniform(rng, 1e-4, 10),     # in the whole run, of the volume of the fracture
        "above": draws.log_uniform(rng, 1e3, 3e7),    # limits from the initial pressure, Pa
        "below": draws.log_uniform(rng, 1e3, 3e7),
        "is_limited": rng.random() < 0.9,
        "pressure": rng.choice((-1, 1)) * draws.log_uniform(rng, 1e3, 1e7),  # of `pressure`, from the initial one
        "index": draws.sometimes(rng, None, 0.5, lambda: draws.log_uniform(rng, 1e-1, 1e3)),  # over the mobility of the rock
        "radius": draws.log_uniform(rng, 1e-4, 1e-2),  # of the size of cells on fractures
    }


def place(p, well):
    """m"""
    if not well["in_fracture"]:
        return well["at"][0] * p["width"], well["at"][1] * p["height"]
    lines = drawn_lines(p)["main"]
    at = well["at"][0] * (len(lines) - 1)
    (x0, y0), (x1, y1) = lines[int(at)], lines[int(at) + 1]
    return x0 + (at % 1) * (x1 - x0), y0 + (at % 1) * (y1 - y0)


def drawn_lines(p):
    """The points of each fracture: those of its ends, or of all its cells where the mesh is a file."""
    if p["mesh"] != "twisted":
        return fractures.segments(p)
    return twisted_lines(json.dumps(p))[0]


@functools.lru_cache(maxsize=4)
def twisted_lines(p):
    """(the points of each fracture, the length of the longest edge)."""
    grid = twisted_mesh.Grid(json.loads(p))
    lines = {name: [tuple(map(float, grid.points[node])) for node in line] for name, line in grid.lines.items()}
    corners = grid.points[grid.triangles]
    return lines, float(max(((corners[:, i] - corners[:, i - 1]) ** 2).sum(1).max() for i in range(3)) ** 0.5)


def coarsest(p):
    """m, the size of the coarsest cells."""
    if p["mesh"] == "twisted":
        return twisted_lines(json.dumps(p))[1]
    return max(physics.length(p) / p["cells"], min(p["width"], p["height"]) / p["coarse"])


def index(p, well):
    """m^2/(Pa s), or None: then it follows from the mesh, in the rock, and is infinite in a fracture. Beside sides and
    fractures it has to be given."""
    if well["index"] is not None:
        return well["index"] * p["permeability"] / p["viscosity"]
    if well["in_fracture"]:
        return None
    x, y = place(p, well)
    room = min(x, y, p["width"] - x, p["height"] - y,
               *(distance((x, y), a, b) for line in drawn_lines(p).values() for a, b in zip(line, line[1:])))
    return None if room > 2 * coarsest(p) and p["discretization"] in ("mpfa", "tpfa") else p["permeability"] / p["viscosity"]


def distance(point, a, b):
    """Of a point from a segment."""
    along = [b[0] - a[0], b[1] - a[1]]
    part = ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / (along[0] ** 2 + along[1] ** 2)
    part = min(1.0, max(0.0, part))
    return math.hypot(point[0] - a[0] - part * along[0], point[1] - a[1] - part * along[1])


def rate(p, well, t):
    """m^2/s at time t that the well is to bring."""
    size = well["rate"] * physics.length(p) * p["aperture"] / physics.end(p)
    if well["kind"] == "cycle":
        return size * math.cos(2 * math.pi * t / physics.end(p))
    return -size if well["kind"] == "extract" else size


def limits(p, well):
    """(lowest, highest) pressure, Pa; None where there is none."""
    if not well["is_limited"] or well["kind"] == "pressure":
        return None, None
    highest = p["initial"] + well["above"] if well["kind"] != "extract" else None
    lowest = p["initial"] - well["below"] if well["kind"] != "inject" else None
    return lowest, highest


def given_pressure(p, well):
    return p["initial"] + well["pressure"] if well["kind"] == "pressure" else None


def components(p):
    lines = ["  wells:", "    type: wells/limited", "    wells:"]
    for name, well in p["wells"].items():
        x, y = place(p, well)
        lines += [f"      {name}:", f"        at: [{x!r} m, {y!r} m]"]
        if well["in_fracture"]:
            lines.append("        fracture: main")
        if index(p, well) is not None:
            lines.append(f"        index: {index(p, well)!r} m^2/(Pa*s)")
        elif not well["in_fracture"]:
            lines.append(f"        radius: {well['radius'] * physics.length(p) / p['cells']!r} m")
        if well["kind"] == "pressure":
            lines.append(f"        pressure: {given_pressure(p, well)!r} Pa")
            continue
        size = rate(p, well, 0)
        lines.append(f"        rate: \"({size!r}*cos(2*{math.pi!r}*t/{physics.end(p)!r})) m^2/s\"" if well["kind"] == "cycle" else
                     f"        rate: {size!r} m^2/s")
        for limit, name_of in zip(limits(p, well), ("lowest_pressure", "highest_pressure")):
            if limit is not None:
                lines.append(f"        {name_of}: {limit!r} Pa")
    return lines


def couplers(p):
    return ["  - {type: well_exchange, between: [wells, pore, conduit]}"]


def describe(p):
    return ", ".join(f"{well['kind']} in {'fracture' if well['in_fracture'] else 'rock'}" for well in p["wells"].values()) + ", "


def pressures(p):
    """All that are given by wells, Pa: limits and pressures."""
    wells = p.get("wells", {}).values()
    return [value for well in wells for value in (given_pressure(p, well), *limits(p, well)) if value is not None]


def are_without_limit(p, kind):
    """Whether a well injects, or extracts, without a limit."""
    return any(well["kind"] in (kind, "cycle") and not well["is_limited"] for well in p.get("wells", {}).values())
