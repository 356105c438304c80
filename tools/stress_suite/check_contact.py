"""Eqs. 2 and 3 in the written fields, cell by cell. Nothing of the program's own formulas is used.

Newton's method ends when its next update would be below 1e-8 of the fields of one unit: that is what the conditions may
miss. Lengths are held to more, 1e-8 of the jumps.
"""

import numpy as np

from . import physics

PRECISION = 1e-8


def scales(p, instant, traction, jump):
    """What lengths and tractions are small against: the largest there are, and what tractions make of lengths."""
    ends = instant.fractures.points[instant.fractures.cells]
    sizes = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    length = max(sizes)
    stiffness = physics.shear_modulus(p) / length
    largest_traction = np.abs(traction).max()
    pressures = max(np.abs(instant.cell("pore.pressure[Pa]")).max(),
                    np.abs(instant.on_fractures("conduit.pressure", "Pa")).max())
    return max(np.abs(jump).max(), largest_traction / stiffness), max(largest_traction, pressures, 1e-6 * p["stress"])  # round-off of the load


def failures(p, instants):
    found = []
    friction, dilation = p["friction"], np.tan(np.radians(p["dilation"]))
    old = None
    for instant in instants:
        traction, jump = instant.on_fractures("contact.traction", "Pa"), instant.on_fractures("contact.jump", "m")
        in_m, in_pa = scales(p, instant, traction, jump)
        in_m, in_pa = PRECISION * in_m, PRECISION * in_pa
        normal, shear = traction.T
        gap = jump[:, 0] - np.abs(jump[:, 1]) * dilation

        def expect(name, violation, allowed):
            worst = int(np.argmax(violation))
            if violation[worst] > allowed:
                found.append(f"contact: {name} by {violation[worst]:.3g} (allowed {allowed:.3g}) in cell {worst} "
                             f"at t = {instant.time:.6g} s")

        expect("walls pull", normal, in_pa)
        expect("walls overlap", -gap, in_m)
        expect("an open wall carries load", np.minimum(-normal / in_pa, gap / in_m), 1.0)
        expect("more than friction", np.abs(shear) + friction * np.minimum(normal, 0), (1 + friction) * in_pa)
        before = np.zeros_like(jump) if old is None and instant.follows else old if instant.follows else None
        if before is not None:
            slip = jump[:, 1] - before[:, 1]
            slips = (np.abs(slip) > in_m) & (gap <= in_m)
            missing = np.where(slips, np.abs(shear - np.sign(slip) * friction * np.abs(np.minimum(normal, 0))), 0)
            expect("slip without its friction", missing, (1 + friction) * in_pa)
        load = instant.on_fractures("rock.wall_traction", "Pa")
        pressure = instant.on_fractures("conduit.pressure", "Pa")
        total = max(np.abs(load).max(), np.abs(pressure).max(), in_pa / PRECISION)
        expect("Eq. 4, normal", np.abs(load[:, 0] - (normal - pressure)), PRECISION * total)
        expect("Eq. 4, tangential", np.abs(load[:, 1] - shear), PRECISION * total)
        old = jump
    return found
