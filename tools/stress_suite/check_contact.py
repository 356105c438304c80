"""Eqs. 2 and 3 in the written fields, cell by cell. Nothing of the program's own formulas is used.

Newton's method ends when its next update would be below 1e-8 of the fields of one unit: that is what the conditions may
miss. Lengths are held to more, 1e-8 of the jumps.

By contact/penalty walls overlap by traction over stiffness, and slip elastically as much before friction gives way. The
stiffness is `stiffness_factor` times that of the rock against a jump of one cell, along the walls against one of the fracture:
G over the length of either, or far less where only a sliver of rock separates two fractures. It is one for each cell: overlap and traction are in proportion.
"""

import numpy as np

from . import physics, swaps

PRECISION = 1e-8
SOFTER = 100  # than G over the length


def lengths(instant):
    ends = instant.fractures.points[instant.fractures.cells]
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def proportional(normal, gap, in_pa, in_m, stiffness, expect):
    """Overlaps are in proportion to tractions. Returns the largest stiffness of each cell until now (Pa/m), where it is known."""
    known = (-normal > 1e4 * in_pa) & (-gap > 1e4 * in_m)  # to 1e-4
    found = np.where(known, normal / np.where(known, gap, 1), np.nan)
    if stiffness is None:
        return found
    both = np.isfinite(found) & np.isfinite(stiffness)
    expect("overlap is not in proportion to traction", np.where(both, np.abs(found / stiffness - 1), 0), 1e-3)
    return np.where(np.isfinite(found), found, stiffness)


def scales(p, instant, traction, jump):
    """What lengths and tractions are small against: the largest there are, and what tractions make of lengths."""
    length = max(lengths(instant))
    stiffness = physics.shear_modulus(p) / length
    largest_traction = np.abs(traction).max()
    pressures = max(np.abs(instant.cell("pore.pressure[Pa]")).max(),
                    np.abs(instant.on_fractures("conduit.pressure", "Pa")).max())
    return max(np.abs(jump).max(), largest_traction / stiffness), max(largest_traction, pressures, 1e-6 * p["stress"])  # round-off of the load


def failures(p, instants):
    found = []
    friction, dilation = p["friction"], np.tan(np.radians(p["dilation"]))
    old = old_shear = stiffness = None
    is_soft = swaps.contact(p) == "penalty"
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
        overlap, elastic = 0.0, 0.0
        if is_soft:
            sizes = lengths(instant)
            soft = SOFTER / (swaps.STIFFNESS_FACTOR * physics.shear_modulus(p))
            overlap = soft * sizes * np.abs(normal)
            elastic = soft * sizes.sum() * np.abs(shear - (0 if old_shear is None else old_shear))
            stiffness = proportional(normal, gap, in_pa, in_m, stiffness, expect)
        expect("walls overlap", -gap - overlap, in_m)
        expect("an open wall carries load", np.minimum(-normal / in_pa, gap / in_m), 1.0)
        expect("more than friction", np.abs(shear) + friction * np.minimum(normal, 0), (1 + friction) * in_pa)
        before = np.zeros_like(jump) if old is None and instant.follows else old if instant.follows else None
        if before is not None:
            slip = jump[:, 1] - before[:, 1]
            slips = (np.abs(slip) > in_m + elastic) & (gap <= in_m)
            missing = np.where(slips, np.abs(shear - np.sign(slip) * friction * np.abs(np.minimum(normal, 0))), 0)
            expect("slip without its friction", missing, (1 + friction) * in_pa)
        load = instant.on_fractures("rock.wall_traction", "Pa")
        pressure = instant.on_fractures("conduit.pressure", "Pa")
        total = max(np.abs(load).max(), np.abs(pressure).max(), in_pa / PRECISION)
        expect("Eq. 4, normal", np.abs(load[:, 0] - (normal - pressure)), PRECISION * total)
        expect("Eq. 4, tangential", np.abs(load[:, 1] - shear), PRECISION * total)
        old, old_shear = jump, shear
    return found
