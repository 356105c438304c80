"""Coordinates in which a scene is written: as drawn, mirrored, or turned by a right angle. The answer must not depend on them."""

import re

WIDTH, HEIGHT = 9.0, 7.0  # of the rock as drawn, m


class Frame:
    """Writes places, directions and names of sides. As drawn, nothing is changed."""

    name = "as drawn"
    box, cells = (WIDTH, HEIGHT), (9, 7)
    sides = {"left": "left", "right": "right", "bottom": "bottom", "top": "top"}
    x, y = "x", "y"  # the coordinates as drawn, by those of this frame
    axes = {"x": "x", "y": "y"}

    def point(self, x, y):
        return [x, y]

    def vector(self, x, y):
        return [x, y]

    def side(self, name):
        return self.sides[name]

    def axis(self, key):
        """displacement_x of the rock as drawn."""
        return key[:-1] + self.axes[key[-1]]

    def expression(self, text):
        """An expression of X and Y, the coordinates as drawn."""
        return re.sub("[XY]", lambda found: self.x if found[0] == "X" else self.y, text)


class Mirrored(Frame):
    name = "mirrored"
    sides = {"left": "right", "right": "left", "bottom": "bottom", "top": "top"}
    x = f"({WIDTH!r} - x)"

    def point(self, x, y):
        return [WIDTH - x, y]

    def vector(self, x, y):
        return [-x, y]


class Turned(Frame):
    """By 90 degrees, counter-clockwise: (x, y) becomes (HEIGHT - y, x)."""

    name = "turned"
    box, cells = (HEIGHT, WIDTH), (7, 9)
    sides = {"left": "bottom", "bottom": "right", "right": "top", "top": "left"}
    x, y = "y", f"({HEIGHT!r} - x)"
    axes = {"x": "y", "y": "x"}

    def point(self, x, y):
        return [HEIGHT - y, x]

    def vector(self, x, y):
        return [-y, x]
