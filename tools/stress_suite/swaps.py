"""Other components of the same roles, for `tools/stress --swapped`: drawn apart from all else, so that a scene stays as it is."""

import random

FLOWS = ("mpfa", "tpfa", "rt0", "ntpfa")
ROCKS = ("mpsa", "fem first", "fem second")
CONTACTS = ("coulomb", "augmented_lagrangian", "penalty")
STIFFNESS_FACTOR = 100  # of contact/penalty, its default


def draw(seed, number, family):
    rng = random.Random(f"swapped:{family}:{seed}:{number}")
    return {"discretization": rng.choice(FLOWS), "rock": rng.choice(ROCKS), "contact": rng.choice(CONTACTS)}


def rock(p):
    """The lines of a scene that name the type."""
    kind, *order = p.get("rock", ROCKS[0]).split()
    return [f"    type: poromechanics/{kind}", *(f"    order: {o}" for o in order)]


def contact(p):
    return p.get("contact", CONTACTS[0])


def describe(p):
    return f"{p['discretization']}, {p['rock']}, {p['contact']}, " if p.get("swapped") else ""
