"""Where the fractures of a scene lie, as segments in the box."""

import math

from . import physics


def along(angle):
    return math.cos(math.radians(angle)), math.sin(math.radians(angle))


def first(p):
    """A segment in the middle of the box, near one of its sides, or ending on it."""
    length = physics.length(p)
    tx, ty = along(p["angle"])
    x, y = 0.5 * p["width"], 0.5 * p["height"]
    if p["place"] != "inside":
        # To the right, until the end that is further right has the wanted distance from the side.
        distance = p["gap"] * length if p["place"] == "near_side" else 0.0
        x = p["width"] - distance - 0.5 * length * abs(tx)
    half = 0.5 * length
    ends = [[x - half * tx, y - half * ty], [x + half * tx, y + half * ty]]
    if p["place"] == "on_side":
        ends[0 if tx < 0 else 1][0] = p["width"]
    return ends


def second(p, ends):
    """Beside the first one, or in line with it, at the distance `gap`; smaller, so that it stays in the box."""
    (x0, y0), (x1, y1) = ends
    tx, ty = along(p["angle"])
    gap = p["gap"] * physics.length(p)
    if p["fractures"] == "parallel":
        nx, ny = (-ty, tx) if tx > 0 else (ty, -tx)
        middle = [0.5 * (x0 + x1) + gap * nx, 0.5 * (y0 + y1) + gap * ny]
        half = 0.3 * physics.length(p)
        return [[middle[0] - half * tx, middle[1] - half * ty], [middle[0] + half * tx, middle[1] + half * ty]]
    start, direction = ((x0, y0), (-tx, -ty)) if tx > 0 else ((x1, y1), (tx, ty))  # the end that is further left
    a = [start[0] + gap * direction[0], start[1] + gap * direction[1]]
    other = 0.4 * physics.length(p)
    return [a, [a[0] + other * direction[0], a[1] + other * direction[1]]]


def inside(p, ends):
    margin = 0.01 * min(p["width"], p["height"])
    return all(margin < x < p["width"] - margin and margin < y < p["height"] - margin for x, y in ends)


def meeting(p, ends, scale=1.0):
    """Those that meet the first one: their ends, each at the place where they meet or beyond it. `scale`: of arms."""
    (x0, y0), (x1, y1) = ends
    at = 1.0 if p["fractures"] == "corner" else p["at"]
    if p["fractures"] == "corner" and p["place"] == "on_side" and x1 == p["width"]:
        at = 0.0  # the end that is in the rock
    meet = [x0 + at * (x1 - x0), y0 + at * (y1 - y0)]

    def arm(degrees, part):
        tx, ty = along(math.degrees(math.atan2(y1 - y0, x1 - x0)) + degrees)
        distance = scale * part * physics.length(p)
        return [meet[0] + distance * tx, meet[1] + distance * ty]
    one, other, third = p["arms"]
    across = [arm(p["cut"] + 180, other), arm(p["cut"], one)]
    if p["fractures"] in ("touch", "corner"):
        across[0] = meet
    found = {"other": across}
    if p["fractures"] == "star":
        found["third"] = [meet, arm(p["cut"] + math.copysign(p["next_cut"], p["cut"]), third)]
    return found


def segments(p):
    """{name: [[x, y], [x, y]]}; others than the first one are left out where the box has no room for them at all."""
    if p["family"] == "growing":
        return p["lines"]
    found = {"main": first(p)}
    if p["family"] == "meeting":
        for scale in (1, 0.5, 0.25, 0.125):  # as long as the box has room for them
            others = meeting(p, found["main"], scale)
            if all(inside(p, ends) for ends in others.values()):
                found.update(others)
                break
    elif p["fractures"] != "one":
        other = second(p, found["main"])
        if inside(p, other):
            found["other"] = other
    return found
