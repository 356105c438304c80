"""Scenes of the family faults, from the written fields: the conditions of contact cell by cell, with the laws of each fracture written once more;
what acts on walls; the mean stress of the body; apertures; the balance of the fluid; twins.

Newton's method ends when its next update would be below 1e-8 of the fields of one unit: so much the conditions may miss. The direction of a
slip is known as well as its length."""

import numpy as np

from . import faults, physics, twins, written

PRECISION = 1e-8
TOLERANCE = 1e-6  # of twins, as compare.py
RESIDUAL = 1e-10  # of a balance, of the largest flow between two cells, where Newton's method ends


def together(p, instant, what, unit):
    """Of all contacts: (normal, tangential1, tangential2) of each fracture cell."""
    name = f"wall_traction.{what}" if len(faults.contacts(p)) > 1 else f"{next(iter(faults.contacts(p)))}.{what.replace('contact_', '')}"
    return instant.on_fractures(name, unit)


def of_cells(p, instant, what):
    number = instant.fractures.cell_data["fracture"].astype(int)
    return np.array([p["walls"][name][what] for name in p["fractures"]])[number]


def scales(p, instant, traction, jump, places):
    """As in check_contact.py."""
    stiffness = physics.shear_modulus(p) / np.sqrt(places.area.max())
    largest = np.abs(traction).max()
    pressures = max(np.abs(instant.cell("pore.pressure[Pa]")).max(), np.abs(instant.on_fractures("conduit.pressure", "Pa")).max()) if p["fluid"] else 0.0
    in_pa = max(largest, pressures, 1e-6 * p["load"])
    return max(np.abs(jump).max(), in_pa / stiffness), in_pa


class Places:
    def __init__(self, instant):
        self.rock, self.volume = instant.matrix.centres_and_sizes()
        _, self.area = instant.fractures.centres_and_sizes()


def contact(p, instants, places):
    found, before = [], None
    for instant in instants:
        traction, jump = together(p, instant, "contact_traction", "Pa"), together(p, instant, "jump", "m")
        in_m, in_pa = (PRECISION * scale for scale in scales(p, instant, traction, jump, places))
        friction, cohesion, tangent = of_cells(p, instant, "friction"), of_cells(p, instant, "cohesion"), np.tan(np.radians(of_cells(p, instant, "dilation")))
        number = instant.fractures.cell_data["fracture"].astype(int)
        normal, shear, slid = traction[:, 0], traction[:, 1:], np.linalg.norm(jump[:, 1:], axis=1)
        gap = jump[:, 0] - tangent * slid
        for i, name in enumerate(p["fractures"]):
            here = number == i
            gap[here] += faults.closure(p, name)(-normal[here])

        def expect(name, violation, allowed):
            worst = int(np.argmax(violation - allowed))
            if (violation - allowed)[worst] > 0:
                found.append(f"contact: {name} by {violation[worst]:.3g} (allowed {np.broadcast_to(allowed, violation.shape)[worst]:.3g}) in cell {worst} at t = {instant.time:.6g} s")

        expect("walls pull", normal, in_pa)
        expect("walls overlap", -gap, in_m)
        expect("an open wall carries load", np.minimum(-normal / in_pa, gap / in_m), 1.0)
        closed = gap <= in_m
        bound = np.where(closed, cohesion + friction * np.maximum(-normal, 0), 0.0)
        held = np.linalg.norm(shear, axis=1)
        expect("more than friction", held - bound, (1 + friction) * in_pa)
        if instant.follows:
            moved = jump[:, 1:] - (0 if before is None else before)
            length = np.linalg.norm(moved, axis=1)
            slips = closed & (length > in_m) & (normal < -in_pa)
            along = moved / np.maximum(length, 1e-300)[:, None]
            missing = np.where(slips, np.linalg.norm(shear - bound[:, None] * along, axis=1), 0)
            expect("slip without its friction", missing, (1 + friction) * in_pa + bound * np.minimum(2, in_m / np.maximum(length, 1e-300)))
        load = instant.on_fractures("rock.wall_traction", "Pa")
        wanted = traction.copy()
        if p["fluid"]:
            wanted[:, 0] -= instant.on_fractures("conduit.pressure", "Pa")
        expect("Eq. 4", np.abs(load - wanted).max(axis=1), PRECISION * max(np.abs(load).max(), in_pa / PRECISION))
        before = jump[:, 1:]
    return found


def momentum(p, instants, places):
    if p["loading"] != "stress":
        return []
    found = []
    for instant in instants:
        stress = instant.cell("rock.stress[Pa]")
        mean = places.volume @ stress[:, :3] / places.volume.sum()
        size = max(np.abs(stress).max(), np.abs(instant.on_fractures("rock.wall_traction", "Pa")).max())
        for axis in range(3):
            wanted = faults.stress_of(p, axis, instant.time)
            if abs(mean[axis] - wanted) > PRECISION * size:
                found.append(f"momentum: the mean stress along {'xyz'[axis]} is {mean[axis]:.9g} instead of {wanted:.9g} Pa at t = {instant.time:.6g} s")
    return found


def fluid(p, instants, history):
    if not p["fluid"]:
        return []
    found = []
    for instant in instants:
        opening = instant.on_fractures("conduit.aperture", "m") - of_cells(p, instant, "aperture")
        jump = together(p, instant, "jump", "m")[:, 0]
        error = np.abs(opening - jump).max()
        if error > 1e-12 * max(np.abs(jump).max(), of_cells(p, instant, "aperture").max()) + PRECISION * np.abs(jump).max():
            found.append(f"aperture: off by {error:.3g} m at t = {instant.time:.6g} s")
    error = np.abs(history["fluid_balance_error[m^3]"]).max()
    size = max(np.abs(history[f"fluid_{name}[m^3]"]).max() for name in ("stored", "injected", "outflow"))
    pressures = max(np.abs(instant.cell("pore.pressure[Pa]")).max() for instant in instants)
    # What is squeezed out of one cell into others, as the rock is loaded, may be far more than what enters and leaves the body.
    volume = float(np.prod(p["high"] - p["low"]))
    squeezed = volume * (p["storage"] * pressures + p["alpha"] * (p["load"] + pressures) / p["young"])
    if error > PRECISION * size + RESIDUAL * squeezed:
        found.append(f"mass: the program's balance is wrong by {error:.3g} of {size:.3g} m^3")
    return found


def failures(p, instants, history):
    if not instants:
        return ["end: no fields"]
    places = Places(instants[0])
    return contact(p, instants, places) + momentum(p, instants, places) + fluid(p, instants, history)


def differences(p, one, other, tolerance):
    """Of the last fields of two runs."""
    found = []
    if len(one) != len(other):
        return [f"{len(other)} steps instead of {len(one)}"]
    places = Places(one[-1])
    for what, unit, scale in (("jump", "m", 0), ("contact_traction", "Pa", 1)):
        values = [together(p, instants[-1], what, unit) for instants in (one, other)]
        size = scales(p, one[-1], together(p, one[-1], "contact_traction", "Pa"), together(p, one[-1], "jump", "m"), places)[scale]
        worst = np.abs(values[0] - values[1]).max()
        if worst > tolerance * size:
            found.append(f"{what} differs by {worst / size:.2g}")
    return found


def twin(program, p, scene, folder, limit):
    """Runs the scene's twin, and compares it with the run in folder/results."""
    place = folder / "twin"
    disturbed = f"components.rock.young_modulus={p['young'] * (1 + faults.DISTURBED)!r} Pa"
    bad = twins.failures(program, scene, place, limit, p["twin"], disturbed, faults.step(p) * (p["steps"] // 2))
    if not bad:
        bad = differences(p, written.instants(folder / "results"), written.instants(place), twins.tolerance(p["twin"], TOLERANCE))
    return [f"twin ({p['twin']}): {text}" for text in bad]
