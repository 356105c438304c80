#!/usr/bin/python3
"""sealed_wings_box.py: by how much the box of configs/verification/wings_sealed.yaml changes the pressures of sealed_wings.csv.

A square of 6 m, rollers at the left and the bottom, given stresses at the right and the top. Rollers are planes of symmetry, so the square is
a quarter of one of 12 m with four fractures, mirrored, and with free sides (the uniform stress apart). The jumps of the fracture in the infinite plane
are kept; their stresses on the sides are taken away by dislocations along these; what both this and the mirrored fractures add to the stress
around the fracture changes the pressure. The next round would be smaller by (fracture/box)^2 again.
"""
import numpy as np

import sealed_wings
from plane_crack import Panel

SIDE = 3.0


def tensor(fields):
    """sigma_xx, sigma_yy, sigma_xy from sigma_nn + i sigma_nt on lines along x and along y."""
    along_x, along_y = fields
    return np.stack([along_y.real, along_x.real, along_x.imag])


def mirrored(stress, z):
    """The sum of a field and its images in x = -SIDE and y = -SIDE; stress(z) gives (xx, yy, xy). Without the original, and the original."""
    original = stress(z)
    shift_x, shift_y = -2 * SIDE - np.conj(z), np.conj(z) - 2j * SIDE
    both = -2 * SIDE - 2j * SIDE - z
    images = stress(both)
    for at in shift_x, shift_y:
        s = stress(at)
        images = images + np.stack([s[0], s[1], -s[2]])
    return images, original


def field(panel, z):
    """Stress of the coefficients (b_t, b_n) of a panel, shape (3, points, 2 order)."""
    parts = []
    for turn in (1, 1j):
        t, n = panel.tractions(z, np.full(len(z), turn, complex))
        parts.append(np.concatenate([t, n], axis=1))
    return tensor(parts)


def change(length, increment=0.01):
    """Relative change of the pressure at the right tip of the scene 45."""
    wings = sealed_wings.scene("45", sealed_wings.Mesh(order=4, levels=5, contact_levels=3, wing_order=3, wing_levels=0))
    count = round(length / increment)
    rows = list(sealed_wings.growth(wings, increment * np.arange(1, count + 1)))
    # the state once more, with the last increment as the last
    end = wings.points.pop()
    before = len(wings.fixed) - len(wings.increment(end, False))
    wings.fixed = wings.fixed[:before]
    wings.cache = []
    opened = rows[-1][6]
    state = wings.solve(end, opened)

    def fracture(z):
        total = 0
        for at in (z, -z):
            for p, b in zip(state.chain, state.coefficients):
                total = total + field(p, at) @ b.ravel()
        return total

    sides = []
    edges = SIDE * np.array([-1, -0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75, 0.9, 1])
    for a, b in zip(edges[:-1], edges[1:]):
        sides += [Panel(SIDE + 1j * a, SIDE + 1j * b, 4), Panel(b + 1j * SIDE, a + 1j * SIDE, 4)]
    z = np.concatenate([p.place(p.points(6)[0]) for p in sides])
    normal_x = np.concatenate([np.full(6, p.turn == 1j) for p in sides])
    inside = z - 1e-9 * np.where(normal_x, 1, 1j)  # not on the panels themselves

    def on_side(stress):
        return np.concatenate([np.where(normal_x.reshape((-1,) + (1,) * (stress[0].ndim - 1)), stress[0], stress[1]), stress[2]])

    columns = [on_side(sum(mirrored(lambda at: field(p, at), inside))) for p in sides]
    load = on_side(sum(mirrored(fracture, z)))
    strength = np.linalg.lstsq(np.concatenate(columns, axis=1), -load, rcond=1e-8)[0]
    remaining = np.abs(np.concatenate(columns, axis=1) @ strength + load).max() / np.abs(load).max()

    def added(z):
        result = mirrored(fracture, z)[0]
        for i, p in enumerate(sides):
            result = result + sum(mirrored(lambda at: field(p, at), z)) @ strength[8 * i:8 * i + 8]
        return result

    places = np.array([1e-3j, 1.001 * end])  # beside the ends of panels
    xx, yy, xy = added(places)
    pressure, far = state.pressure, wings.far
    wings.far = lambda turn: far(turn) + (xx[0] + yy[0]) / 2 + ((yy[0] - xx[0]) / 2 + 1j * xy[0]) * turn**2
    return wings.solve(end, opened).pressure / pressure - 1, np.stack([xx, yy, xy]), remaining


if __name__ == "__main__":
    for length in (0.01, 0.04, 0.1, 0.25):
        relative, stress, remaining = change(length)
        print(f"{length * 1e3:.0f} mm: pressure {1e2 * relative:+.4f} %; added stress (xx, yy, xy) in MPa in the middle {stress[:, 0]}, at the right tip {stress[:, 1]}; "
              f"sides keep {remaining:.1e}")
