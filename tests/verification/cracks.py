"""A crack in wide rock, and the wings of one that slips: their points, what loads them, and their stress intensity factors."""

import math

from scene_runs import SceneRuns

A = 0.05  # m, half-length


def crack(degrees, half=A, x=0.013, y=-0.007):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [(x - half * c, y - half * s), (x + half * c, y + half * s)]


def remote(degrees, xx, yy):
    """The normal and the shear stress on a crack, in its frame."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return xx * s * s + yy * c * c, (yy - xx) * s * c


def wings(mirror=1):
    """A crack at 45 degrees with wings along x that are as long as half of it."""
    q = A * math.sqrt(0.5)
    return [(x, mirror * y) for x, y in ((-q - A, -q), (-q, -q), (q, q), (q + A, q))]


def in_metres(points):
    """As scenes have them."""
    return ", ".join(f"[{x!r} m, {y!r} m]" for x, y in points)


class CrackScenes(SceneRuns):
    def factors(self, text, processes=1):
        """[(K_I, K_II)] of the first and the last tip of the fracture `main`, at the end of a run of this scene."""
        row = self.run_scene(self.write(text), processes=processes).rows[-1]
        return [(row[f"tips.main_{end}.K_I"], row[f"tips.main_{end}.K_II"]) for end in ("first", "last")]

    def expect_factors(self, found, expected, bound):
        scale = math.hypot(*expected)
        for k1, k2 in found:
            self.assertLess(math.hypot(k1 - expected[0], k2 - expected[1]), bound * scale, (found, expected))
