"""Fractures of scenes in space: polygons, rectangles, discs and ellipses in general position, or rectangles on planes of a structured mesh.

A fracture is {"name", "shape", "text", "at"}: what stands in the scene, and a point in it. A polygon ends on what it is cut by."""

import math

import numpy as np

SHORTEST = 0.04   # edge of a polygon, of its longest
ENDINGS = 32      # points of a rim that lie in the box


def direction(rng):
    """Uniform on the sphere."""
    up, turn = rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
    flat = math.sqrt(1 - up * up)
    return np.array([flat * math.cos(turn), flat * math.sin(turn), up])


def axes_of(normal):
    """Two unit vectors along a plane."""
    other = np.eye(3)[int(np.argmin(np.abs(normal)))]
    first = np.cross(normal, other)
    first /= np.linalg.norm(first)
    return first, np.cross(normal, first)


def along_strike_and_dip(strike, dip):
    """Unit vectors (x east, y north, z up) of degrees: strike is clockwise from north, and it dips to the right of it."""
    s, d = math.radians(strike), math.radians(dip)
    return (np.array([math.sin(s), math.cos(s), 0.0]),
            np.array([math.cos(s) * math.cos(d), -math.sin(s) * math.cos(d), -math.sin(d)]))


def cut(points, inside, axis=None, bound=None):
    """What is left of a polygon where `inside` (a function of points, positive) holds; on a side of the box its coordinate is exact."""
    kept = []
    for one, other in zip(points, points[1:] + points[:1]):
        a, b = inside(one), inside(other)
        if a >= 0:
            kept.append(one)
        if a * b < 0:
            place = one + (other - one) * (a / (a - b))
            if axis is not None:
                place[axis] = bound
            kept.append(place)
    return kept


def cut_by_box(points, low, high):
    for axis in range(3):
        points = cut(points, lambda x, a=axis: x[a] - low[a], axis, low[axis])
        points = cut(points, lambda x, a=axis: high[a] - x[a], axis, high[axis])
    return points


def is_sound(points, least):
    if len(points) < 3:
        return False
    edges = [np.linalg.norm(b - a) for a, b in zip(points, points[1:] + points[:1])]
    return max(edges) > least and min(edges) > SHORTEST * max(edges)


def text_of(points):
    return "points: [" + ", ".join("[" + ", ".join(f"{float(c)!r} m" for c in point) + "]" for point in points) + "]"


def polygon(rng, low, high, share, through):
    """A convex polygon in any plane, cut by the box; `through`: the whole plane."""
    centre = low + (high - low) * [rng.uniform(0.15, 0.85) for _ in range(3)]
    normal = direction(rng)
    first, second = axes_of(normal)
    size = 10 * np.linalg.norm(high - low) if through else share * min(high - low)
    corners = 4 if through else rng.randint(3, 6)
    flatness = 1 if through else rng.uniform(0.4, 1)
    start = rng.uniform(0, 2 * math.pi)
    turns = [start + 2 * math.pi * (i + (0 if through else rng.uniform(0, 0.5))) / corners for i in range(corners)]
    return normal, cut_by_box([centre + size * (math.cos(t) * first + flatness * math.sin(t) * second) for t in turns], low, high)


SHARES = {"through": 0.15, "polygon": 0.25, "ending": 0.15, "rectangle": 0.2, "disc": 0.15, "ellipse": 0.1}


def in_general_position(rng, low, high, others, shapes=None):
    shares = {shape: share for shape, share in SHARES.items() if not shapes or shape in shapes}
    shape = rng.choices(tuple(shares), tuple(shares.values()))[0]
    planes = [other for other in others if other.get("normal") is not None and other["shape"] == "through"]
    if shape == "ending" and not planes:
        shape = "through"
    share = math.exp(rng.uniform(math.log(0.25), math.log(0.9)))
    least = 0.06 * min(high - low)
    for _ in range(200):
        if shape in ("through", "polygon", "ending"):
            normal, points = polygon(rng, low, high, max(share, 0.4) if shape == "ending" else share, shape == "through")
            if shape == "ending":
                plane = rng.choice(planes)
                if all(plane["normal"] @ (x - plane["at"]) > 0 for x in points):
                    continue
                points = cut(points, lambda x, of=plane: of["normal"] @ (x - of["at"]))
                on_plane = [x for x in points if abs(plane["normal"] @ (x - plane["at"])) < 1e-9 * max(high - low)]
                if len(on_plane) < 2:
                    continue
            if is_sound(points, least):
                return {"shape": shape, "text": text_of(points), "at": np.mean(points, axis=0), "normal": normal}
            continue
        strike, dip = rng.uniform(0, 360), math.degrees(math.acos(rng.uniform(0, 1)))
        first, second = along_strike_and_dip(strike, dip)
        long, short = 0.5 * share * max(high - low), 0.5 * share * min(high - low) * rng.uniform(0.5, 1)
        long = short if shape == "disc" else min(long, 6 * short) * rng.uniform(0.5, 1)
        if shape == "rectangle":
            rim = [a * long * first + b * short * second for a in (-1, 1) for b in (-1, 1)]
        else:
            turns = [2 * math.pi * i / ENDINGS for i in range(ENDINGS)]
            rim = [math.cos(t) * long * first + math.sin(t) * short * second for t in turns]
        room = np.abs(rim).max(axis=0) + 0.01 * (high - low)
        if (2 * room > high - low).any():
            share *= 0.9
            continue
        at = np.array([rng.uniform(a + r, b - r) for a, b, r in zip(low, high, room)])
        size = {"rectangle": f"length: {2 * long!r} m, height: {2 * short!r} m", "disc": f"radius: {short!r} m",
                "ellipse": f"radius: [{long!r} m, {short!r} m]"}[shape]
        middle = ", ".join(f"{float(c)!r} m" for c in at)
        return {"shape": shape, "text": f"center: [{middle}], strike: {strike!r} deg, dip: {dip!r} deg, {size}", "at": at, "normal": None}
    return None


def on_planes(rng, low, high, cells, others):
    """A rectangle of faces of cells; no two lie in one plane."""
    axes = [axis for axis in range(3) if cells[axis] > 1]
    for _ in range(50):
        axis = rng.choice(axes)
        plane = (axis, rng.randint(1, cells[axis] - 1))
        if plane in [other["plane"] for other in others]:
            continue
        spans = {}
        for a in {0, 1, 2} - {axis}:
            first, last = sorted(rng.sample(range(cells[a] + 1), 2))
            spans[a] = (0, cells[a]) if rng.random() < 0.3 else (first, last)
        a, b = sorted(spans)
        points = []
        for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)):
            at = [0, 0, 0]
            at[axis], at[a], at[b] = plane[1], spans[a][i], spans[b][j]
            points.append(low + (high - low) * np.array(at) / cells)
        return {"shape": "faces", "text": text_of(points), "at": np.mean(points, axis=0), "normal": None, "plane": plane}
    return None


def draw(rng, low, high, count, cells=None, shapes=None):
    """{name: fracture}; in general position of these shapes alone."""
    found = []
    for _ in range(count):
        new = on_planes(rng, low, high, cells, found) if cells else in_general_position(rng, low, high, found, shapes)
        if new:
            found.append(new)
    return {f"f{i}": fracture for i, fracture in enumerate(found)}
