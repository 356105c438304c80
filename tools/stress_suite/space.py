"""Scenes of the family space: flow in a box of rock and in fractures of all shapes in it, with values over many decades."""

import math

import numpy as np

from . import space_fractures
from .draws import choose, log_uniform, sometimes

SIDES = {"left": (0, 0), "right": (0, 1), "front": (1, 0), "back": (1, 1), "bottom": (2, 0), "top": (2, 1)}  # axis, end
HEXAHEDRA = {"hexahedra": 1, "wedges": 2, "tetrahedra": 6}  # cells of one
WEIGHT = 9810.0  # Pa/m
TWINS = ("none", "disturbed", "processes", "restart")
DISTURBED = 1e-9


def mesh(rng, sides):
    """(kind, hexahedra along the axes or None, edge length)"""
    kind = choose(rng, unstructured=0.65, hexahedra=0.13, wedges=0.11, tetrahedra=0.11)
    target = log_uniform(rng, 500, 1500 if kind == "unstructured" else 4000)  # fractures make cells smaller
    volume = float(np.prod(sides))
    if kind == "unstructured":
        return kind, None, (16 * volume / target) ** (1 / 3)
    edge = (volume * HEXAHEDRA[kind] / target) ** (1 / 3)
    return kind, [max(2, round(side / edge)) for side in sides], edge


def tensor(rng, k):
    """(largest over least, text)"""
    kind = choose(rng, isotropic=0.4, components=0.35, layers=0.25)
    ratio = log_uniform(rng, 1, 1e4 if rng.random() < 0.4 else 10)
    strike, dip = rng.uniform(0, 360), rng.uniform(0, 90)
    normal = space_fractures.direction(rng)
    middle = ratio ** -rng.uniform(0, 1)
    if kind == "isotropic":
        return 1.0, f"{k!r} m^2"
    if kind == "layers":
        return ratio, f"{{along: {k!r} m^2, across: {k / ratio!r} m^2, strike: {strike!r} deg, dip: {dip!r} deg}}"
    first, second = space_fractures.axes_of(normal)
    full = k * (np.outer(first, first) + middle * np.outer(second, second) + np.outer(normal, normal) / ratio)
    names = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "yz": (1, 2), "xz": (0, 2)}
    return ratio, "{" + ", ".join(f"{name}: {float(full[at])!r} m^2" for name, at in names.items()) + "}"


def regions(rng, low, high, cells):
    """{name: text}; they follow planes of a structured mesh."""
    found = {}
    for i in range(rng.choices((0, 1, 2, 3), (0.25, 0.4, 0.2, 0.15))[0]):
        kind = rng.choice(("half", "layer", "box"))
        def plane(axis, least, most):
            if cells:
                first = min(cells[axis] - 1, round(least * cells[axis])) if most < 0.5 else max(1, round(least * cells[axis]))
                last = max(first, round(most * cells[axis]) if most > 0.5 else min((cells[axis] - 1) // 2, round(most * cells[axis])))
                return float(low[axis] + (high[axis] - low[axis]) * rng.randint(first, last) / cells[axis])
            return float(low[axis] + (high[axis] - low[axis]) * rng.uniform(least, most))
        if kind == "box":
            spans = {axis: (plane(a, 0.05, 0.4), plane(a, 0.6, 0.95)) for a, axis in enumerate("xyz")}
            found[f"r{i}"] = "{box: {" + ", ".join(f"{axis}: [{a!r} m, {b!r} m]" for axis, (a, b) in spans.items()) + "}}"
        elif kind == "layer":
            tilts = (0, 0) if cells else [0.3 * rng.uniform(-1, 1) * (high[2] - low[2]) / (high[a] - low[a]) for a in (0, 1)]
            middle = (low + high) / 2
            heights = [plane(2, 0.1, 0.4), plane(2, 0.6, 0.9)]
            texts = [f"({h!r} + {tilts[0]!r}*(x/m - {float(middle[0])!r}) + {tilts[1]!r}*(y/m - {float(middle[1])!r})) m" if not cells else f"{h!r} m"
                     for h in heights]
            found[f"r{i}"] = f"{{between: [{texts[0]}, {texts[1]}]}}"
        else:
            axis = rng.randrange(3)
            normal = [float(a == axis) for a in range(3)] if cells else [float(c) for c in space_fractures.direction(rng)]
            place = [plane(a, 0.3, 0.7) for a in range(3)]
            found[f"r{i}"] = f"{{point: [{', '.join(f'{c!r} m' for c in place)}], normal: {normal!r}}}"
    return found


def part_of_side(rng, low, high, cells):
    """{side, spans}: a rectangle of one side."""
    side = rng.choice(list(SIDES))
    spans = {}
    for a in {0, 1, 2} - {SIDES[side][0]}:
        first, last = sorted(rng.sample(range(cells[a] + 1), 2)) if cells else (rng.uniform(0, 0.4), rng.uniform(0.55, 1))
        spans["xyz"[a]] = tuple(float(low[a] + (high[a] - low[a]) * c / (cells[a] if cells else 1)) for c in (first, last))
    return {"side": side, "spans": spans}


def conditions(rng, part, scale_of_flux, is_steady):
    """{side: ("pressure" | "flux", value)}; a steady scene has a pressure."""
    found = {}
    for side in [*SIDES, *(["part"] if part else [])]:
        kind = choose(rng, pressure=0.4, flux=0.15, nothing=0.45) if side != "part" else "pressure"
        pressure, flux = pressure_of(rng), rng.choice((-1, 1)) * scale_of_flux * log_uniform(rng, 1e-3, 1)
        if kind != "nothing":
            found[side] = (kind, pressure if kind == "pressure" else flux)
    if is_steady and not any(kind == "pressure" for kind, _ in found.values()):
        found[rng.choice(list(SIDES))] = ("pressure", pressure_of(rng))
    return found


def pressure_of(rng):
    return sometimes(rng, 0.0, 0.15, lambda: log_uniform(rng, 1e5, 3e7))


def conductors(rng, names):
    """Of fractures: apertures, transmissivities and permeabilities of walls, each for itself."""
    return {name: {"aperture": log_uniform(rng, 1e-6, 1e-2), "transmissivity": log_uniform(rng, 1e-22, 1e-7), "walls": log_uniform(rng, 1e-19, 1e-4)}
            for name in names}


def draw(rng):
    size = log_uniform(rng, 1, 1000)
    sides = np.array([float(f"{size * log_uniform(rng, 0.4, 2.5):.3g}") for _ in range(3)])
    low = np.array([0.0, 0.0, -sides[2]]) if rng.random() < 0.5 else np.zeros(3)
    high = low + sides
    kind, cells, edge = mesh(rng, sides)
    count = round(log_uniform(rng, 2, 20.4))
    fractures = space_fractures.draw(rng, low, high, count, cells)
    areas = regions(rng, low, high, cells)
    k, viscosity = log_uniform(rng, 1e-18, 1e-10), log_uniform(rng, 1e-4, 1e-2)
    contrasts = [1.0, *(log_uniform(rng, 1e-10, 1) if rng.random() < 0.5 else log_uniform(rng, 1e-3, 1) for _ in areas)]
    rng.shuffle(contrasts)
    tensors = {name: tensor(rng, k * contrast) for name, contrast in zip(["default", *areas], contrasts)}
    is_steady = rng.random() < 0.55
    storage = 0.0 if is_steady else sometimes(rng, 0.0, 0.1, lambda: log_uniform(rng, 1e-13, 1e-7))
    compressibility = 0.0 if is_steady else log_uniform(rng, 1e-11, 3e-9)
    clock = viscosity * max(storage, 1e-12) * size ** 2 / (k * math.sqrt(min(contrasts)))
    step = 1.0 if is_steady else clock * log_uniform(rng, 1e-4, 1e3)
    part = part_of_side(rng, low, high, cells) if rng.random() < 0.3 else None
    flux = k / viscosity * 1e6 / size
    given = conditions(rng, part, flux, is_steady)
    names = list(fractures)
    p = {"low": low, "high": high, "mesh": kind, "cells": cells, "edge": edge, "fractures": fractures, "regions": areas, "tensors": tensors,
         "anisotropy": max(ratio for ratio, _ in tensors.values()), "contrast": 1 / min(contrasts), "viscosity": viscosity, "storage": storage,
         "compressibility": compressibility, "steady": is_steady, "step": step, "steps": 1 if is_steady else rng.randint(2, 4), "part": part, "given": given,
         "flow": choose(rng, mpfa=0.7, rt0=0.15, tpfa=0.15), "along": choose(rng, mfd=0.75, tpfa=0.25), "conductors": conductors(rng, names),
         "law": choose(rng, constant=0.45, cubic=0.3, rough=0.15, residual=0.1), "walls": choose(rng, constant=0.7, cubic=0.3),
         "gravity": rng.random() < 0.35, "initial": pressure_of(rng), "growth": rng.uniform(0.3, 1.0), "finer": rng.uniform(0.6, 1.0),
         "gaps": choose(rng, usual=0.7, none=0.3), "crossings": choose(rng, none=0.75, sealed=0.08, filled=0.17), "filling": log_uniform(rng, 1e-18, 1e-6),
         "injection": [(rng.choice(names), rng.random() < 0.6, rng.choice((-1, 1, 1)) * flux * size ** 2 * log_uniform(rng, 1e-4, 1))
                       for _ in range(rng.choices((0, 1, 2), (0.6, 0.3, 0.1))[0])],
         "prescribed": [(name, rng.random() < 0.4, pressure_of(rng)) for name in rng.sample(names, min(len(names), rng.choices((0, 1, 2), (0.6, 0.3, 0.1))[0]))],
         "wells": [([float(a + (b - a) * rng.uniform(0.1, 0.9)) for a, b in zip(low, high)], rng.choice((-1, 1)) * flux * size ** 2 * log_uniform(rng, 1e-4, 1))
                   for _ in range(rng.choices((0, 1, 2), (0.75, 0.2, 0.05))[0])],
         "open_fractures": rng.random() < 0.75, "in_turn": rng.random() < 0.2, "solver": choose(rng, auto=0.6, mumps=0.2, belos=0.2),
         "probed": [float(a + (b - a) * rng.uniform(0.1, 0.9)) for a, b in zip(low, high)]}
    taken = {name for name, _, _ in p["prescribed"]}
    p["injection"] = [one for one in p["injection"] if one[0] not in taken]
    twin = rng.choices(TWINS, (0.55, 0.2, 0.1, 0.15))[0]
    p["twin"] = "disturbed" if twin == "restart" and is_steady else twin
    return p


def describe(p):
    shapes = ", ".join(sorted({fracture["shape"] for fracture in p["fractures"].values()}))
    return (f"{p['mesh']}, {len(p['fractures'])} fractures ({shapes}), {len(p['regions'])} regions, {p['flow']}, {p['along']}, {p['law']}, walls: {p['walls']}, "
            f"contrast = {p['contrast']:.0e}, anisotropy = {p['anisotropy']:.0e}, {'steady' if p['steady'] else 'transient'}, "
            f"{'gravity, ' if p['gravity'] else ''}{'part of a side, ' if p['part'] else ''}{len(p['injection'])} injections, {len(p['prescribed'])} prescribed, "
            f"{len(p['wells'])} wells, crossings: {p['crossings']}, {'in turn, ' if p['in_turn'] else ''}{p['solver']}, twin: {p['twin']}")


def pressure(p, value):
    """Of fluid that is at rest at this pressure at the height 0."""
    return f"({value!r} - {WEIGHT!r}*z/m) Pa" if p["gravity"] else f"{value!r} Pa"


def text_of_point(point):
    return "[" + ", ".join(f"{float(c)!r} m" for c in point) + "]"


def geometry(p):
    box = ", ".join(f"{axis}: [{float(a)!r} m, {float(b)!r} m]" for axis, a, b in zip("xyz", p["low"], p["high"]))
    lines = ["geometry:", f"  box: {{{box}}}", "  fractures:", *(f"    {name}: {{{fracture['text']}}}" for name, fracture in p["fractures"].items())]
    if p["regions"]:
        lines += ["  regions:", *(f"    {name}: {text}" for name, text in p["regions"].items())]
    if p["part"]:
        spans = ", ".join(f"{axis}: [{a!r} m, {b!r} m]" for axis, (a, b) in p["part"]["spans"].items())
        lines.append(f"  sides: {{part: {{side: {p['part']['side']}, {spans}}}}}")
    if p["cells"]:
        return [*lines, f"mesh: {{kind: structured, shape: {p['mesh']}, cells: {p['cells']!r}}}"]
    gaps = ", gap_edges: 0" if p["gaps"] == "none" else ""
    return [*lines, f"mesh: {{size: {p['edge']!r} m, fracture_size: {p['edge'] * p['finer']!r} m, growth: {p['growth']!r}{gaps}}}"]


def rock(p):
    texts = {name: text for name, (_, text) in p["tensors"].items()}
    permeability = texts["default"] if len(texts) == 1 else "{regions: {" + ", ".join(f"{name}: {text}" for name, text in texts.items()) + "}}"
    lines = ["  pore:", f"    type: matrix_flow/{p['flow']}", f"    permeability: {permeability}", f"    storage: {p['storage']!r} 1/Pa",
             f"    initial_pressure: {pressure(p, p['initial'])}"]
    if p["given"]:
        lines.append("    boundary:")
        lines += [f"      {side}: {{{kind}: {pressure(p, value) if kind == 'pressure' else f'{value!r} m/s'}}}" for side, (kind, value) in p["given"].items()]
    if p["wells"]:
        lines.append("    wells:")
        lines += [f"      w{i}: {{at: {text_of_point(at)}, rate: {rate!r} m^3/s}}" for i, (at, rate) in enumerate(p["wells"])]
    return lines


def by_fracture(p, what, unit):
    return "{fractures: {" + ", ".join(f"{name}: {values[what]!r} {unit}" for name, values in p["conductors"].items()) + "}}"


def conduit(p):
    lines = ["  conduit:", f"    type: fracture_flow/{p['along']}", f"    initial_aperture: {by_fracture(p, 'aperture', 'm')}",
             f"    initial_pressure: {pressure(p, p['initial'])}"]
    if p["law"] == "constant":
        lines += ["    transmissivity: constant", f"    transmissivity_value: {by_fracture(p, 'transmissivity', 'm^3')}"]
    elif p["law"] in ("rough", "residual"):
        lines.append("    law: {type: rough, roughness: 1e-4 m}" if p["law"] == "rough" else "    law: {type: cubic, residual: 1e-5 m}")
    if p["walls"] == "constant":
        lines += ["    normal_permeability: constant", f"    normal_permeability_value: {by_fracture(p, 'walls', 'm/(Pa*s)')}"]
    pressures = {side: value for side, (kind, value) in p["given"].items() if kind == "pressure"}
    if p["open_fractures"] and pressures:
        lines += ["    boundary:", *(f"      {side}: {{pressure: {pressure(p, value)}}}" for side, value in pressures.items())]
    if p["crossings"] != "none":
        lines.append(f"    crossings: {{all: {{permeability: {0.0 if p['crossings'] == 'sealed' else p['filling']!r} m^2}}}}")
    for kind, what in (("injection", "rate"), ("prescribed", "pressure")):
        if p[kind]:
            lines.append(f"    {kind}:")
        for i, (name, is_at_point, value) in enumerate(p[kind]):
            at = f", at: {text_of_point(p['fractures'][name]['at'])}" if is_at_point else ""
            lines.append(f"      {kind[0]}{i}: {{fracture: {name}{at}, {what}: {f'{value!r} m^3/s' if what == 'rate' else pressure(p, value)}}}")
    return lines


def write(p, path):
    tolerance = "{relative: 1e-10, at_most: 100}"
    schedule = "{solve: [pore, conduit]}"
    if p["in_turn"]:
        schedule = f"{{iterate: {{until: {tolerance}, accelerate: {{anderson: 5}}, steps: [{{solve: pore}}, {{solve: conduit}}]}}}}"
    names = list(p["fractures"])
    solver = [] if p["solver"] == "auto" else [f"solver: {{type: {p['solver']}}}"]
    text = [f"# tools/stress --family space --seed {p['seed']} --only {p['number']}", f"name: space_{p['number']}", *geometry(p), "materials:",
            f"  viscosity: {p['viscosity']!r} Pa*s", f"  fluid_compressibility: {p['compressibility']!r} 1/Pa",
            *(["  gravity: [0, 0, -9.81 m/s^2]", "  fluid_density: 1000 kg/m^3"] if p["gravity"] else []),
            "components:", *rock(p), *conduit(p), "couplers:", "  - {type: wall_exchange, between: [pore, conduit]}", f"schedule: [{schedule}]", *solver,
            f"time: {{end: {p['step'] * p['steps']!r} s, step: {p['step']!r} s}}", "output:", f"  every: {p['step']!r} s", "  probes:",
            f"    in_rock: {{of: pore.pressure, at: {text_of_point(p['probed'])}}}", "    of_rock: {of: pore.pressure, take: integral}",
            f"    mean: {{of: conduit.pressure, fracture: {names[0]}, take: mean}}", f"    most: {{of: conduit.pressure, fracture: {names[-1]}, take: largest}}", ""]
    path.write_text("\n".join(text))
    return path
