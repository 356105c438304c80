"""Distances between paths of fractures: polylines (n, 2) whose x grows."""

import numpy as np


def refined(path, size=1e-3):
    pieces = [np.linspace(a, b, max(int(np.hypot(*(b - a)) / size), 1), endpoint=False) for a, b in zip(path, path[1:])]
    return np.vstack([*pieces, path[-1:]])


def distances(points, path):
    """From each point to the polyline."""
    start, along = path[:-1], np.diff(path, axis=0)
    offset = points[:, None, :] - start
    share = np.clip((offset * along).sum(2) / (along**2).sum(1), 0, 1)
    return np.hypot(*np.moveaxis(offset - share[..., None] * along, 2, 0)).min(1)


def apart(one, other):
    """The largest distance between two paths (m), over the x that both have."""
    low, high = max(one[0, 0], other[0, 0]), min(one[-1, 0], other[-1, 0])
    common = [points[(points[:, 0] > low + 1e-3) & (points[:, 0] < high - 1e-3)] for points in map(refined, (one, other))]
    return max(distances(common[0], other).max(), distances(common[1], one).max())
