#!/usr/bin/python3
"""sealed_wings.py [SCENE…]: writes sealed_wings.csv, or its rows of these scenes: wings of a slipping fracture in sealed rock.

An infinite plane, sigma_xx = -20 MPa and sigma_yy = -10 MPa, a fracture 0.1 m long, closed, with the friction 0.5 and a
dilation angle psi, and fluid of one pressure p in it and in its two wings, which are straight increments. The state is
point-symmetric. Conditions (docs/numerics/contact.md):

    closed part of the fracture   |sigma_nt| = -mu (sigma_nn + p),  D_n = |D_t| tan psi     all of it slips (checked)
    open part next to the kink    sigma_nn = -p,  sigma_nt = 0
    between the two               sigma_nn + p = 0 and D_n = |D_t| tan psi
    wings                         sigma_nn = -p,  sigma_nt = 0                                they are open (checked)
    ends of the wings             K_II = 0 and K_I = K_IC

Given the place where the fracture closes and the direction of the last increment, all of this is linear in the jumps and in p. The
two are found by Newton's method.
"""
import math
import os
import sys

import numpy as np

from plane_crack import Panel

HALF, FRICTION, TOUGHNESS = 0.05, 0.5, 0.7  # m, -, MPa m^0.5
PLANE_MODULUS = 40e3 / (1 - 0.2**2)  # MPa
NEARLY_OPEN = 0.998  # beyond this open share of the fracture it is open everywhere
STRESS = (-20.0, -10.0)  # MPa


class Mesh:
    """Panels: polynomials of an order, neighbours in a ratio, so many of them towards the first kink and the edge of contact, and
    towards other kinks; the share of the panel at the tip in an increment."""

    def __init__(self, order=6, ratio=0.3, levels=7, contact_levels=5, wing_order=4, wing_levels=1, tip=0.4):
        self.order, self.ratio, self.levels, self.contact_levels = order, ratio, levels, contact_levels
        self.wing_order, self.wing_levels, self.tip = wing_order, wing_levels, tip

    def refined(self):
        return Mesh(self.order + 2, self.ratio, self.levels + 3, self.contact_levels + 3, self.wing_order + 2,
                    self.wing_levels + 1, self.tip)


def graded(ratio, levels):
    """Edges in [0, 1], finer towards 0."""
    return np.concatenate([[0], ratio ** np.arange(levels, -1, -1.0)])


class Wings:
    """The right half of the fracture and its wing; the left half is its image under half a turn."""

    def __init__(self, angle, stress=STRESS, stress_angle=0.0, dilation=1.0, mesh=None):
        self.mesh = mesh or Mesh()
        self.turn = np.exp(1j * math.radians(angle))
        frame = np.exp(1j * math.radians(stress_angle))
        mean, difference = (stress[0] + stress[1]) / 2, (stress[0] - stress[1]) / 2
        self.far = lambda turn: mean - difference * (turn / frame) ** 2  # sigma_nn + i sigma_nt on lines along `turn`
        self.sense = math.copysign(1, self.far(self.turn).imag)  # of the slip
        self.dilation = math.tan(math.radians(dilation))
        self.kink = HALF * self.turn
        self.points = [self.kink]  # the last one is the end of the wing
        self.fixed = []  # panels of increments that are behind
        self.cache = []
        self.jacobian = None

    def onset(self):
        """The pressure at which K_eq of the fracture without wings is K_IC: the paper's Eqs. 10-12. And the angle of its Eq. 11."""
        k1, k2 = self.dilation, self.sense
        half = math.atan2(-2 * k2, k1 + math.sqrt(k1**2 + 8 * k2**2))
        equivalent = math.cos(half) * (k1 * math.cos(half) ** 2 - 1.5 * k2 * math.sin(2 * half))
        far = self.far(self.turn)
        drop = TOUGHNESS / equivalent / math.sqrt(math.pi * HALF) * (1 + FRICTION * self.dilation)
        return (drop - abs(far.imag)) / FRICTION - far.real, math.degrees(2 * half)

    def slipped(self, pressure):
        """What the slipping fracture without wings opens at this pressure, m^2."""
        far = self.far(self.turn)
        drop = (abs(far.imag) + FRICTION * (far.real + pressure)) / (1 + FRICTION * self.dilation)
        return 2 * math.pi * HALF**2 * drop * self.dilation / PLANE_MODULUS

    def fracture(self, open_length):
        """Panels of its closed and of its open part."""
        m, edge = self.mesh, HALF - open_length
        if edge <= 0:
            edges = HALF * (1 - graded(m.ratio, m.levels + 2)[::-1])
            return [], [Panel(a * self.turn, b * self.turn, m.order) for a, b in zip(edges[:-1], edges[1:])]
        closed = edge * (1 - graded(m.ratio, m.contact_levels + max(0, math.ceil(math.log(open_length / edge, m.ratio))))[::-1])
        towards_kink = graded(m.ratio, m.levels)
        first = graded(m.ratio, m.contact_levels) / 2
        opened = edge + open_length * np.concatenate([first, 1 - towards_kink[::-1][1:] / 2])
        def panels(edges):
            return [Panel(a * self.turn, b * self.turn, m.order) for a, b in zip(edges[:-1], edges[1:])]
        return panels(closed), panels(opened)

    def increment(self, end, last):
        """Panels of the increment from the last point to `end`."""
        m, start, first = self.mesh, self.points[-1], len(self.points) == 1
        edges = graded(m.ratio if first else 0.4, m.levels if first else m.wing_levels)
        if last:
            edges = np.concatenate([edges[edges < 0.9 * (1 - m.tip)], [1 - m.tip, 1]])
        return [Panel(start + (end - start) * a, start + (end - start) * b, m.order if first else m.wing_order,
                      tip=bool(last and b == 1)) for a, b in zip(edges[:-1], edges[1:])]

    @staticmethod
    def influence(targets, sources):
        """sigma_nn + i sigma_nt at the points of the targets from b_t and b_n of the sources and of their images."""
        z = np.concatenate([t.place(t.gauss[0]) for t in targets]).astype(complex)
        turn = np.concatenate([np.full(t.gauss[0].size, t.turn) for t in targets])
        result = []
        for source in sources:
            own = np.concatenate([np.full(t.gauss[0].size, t is source) for t in targets])
            t, n = source.tractions(-z, turn)
            for at, on_panel in ((own, True), (~own, False)):
                if at.any():
                    add = source.tractions(z[at], turn[at], on_panel)
                    t[at] += add[0]
                    n[at] += add[1]
            result.append(np.stack([t, n], axis=1))
        return result

    def solve(self, end, open_length):
        """The state with the wing's last increment from the last point to `end`, and with this open part of the fracture."""
        closed, opened = self.fracture(open_length)
        last = self.increment(end, True)
        around = closed + opened + last
        if len(self.cache) < len(self.fixed):  # what increments behind do to one another does not change any more
            self.cache = self.influence(self.fixed, self.fixed)
        parts = self.influence(around, around + self.fixed)
        if self.fixed:
            to_fixed = self.influence(self.fixed, around) + self.cache
            parts = [np.concatenate(pair) for pair in zip(parts, to_fixed)]
        panels = around + self.fixed  # the order of the coefficients
        chain = closed + opened + self.fixed + last  # the order along the fracture
        slot = {id(p): i for i, p in enumerate(panels)}
        n_closed = len(closed)
        tied = 1 + 1j * self.sense * self.dilation

        # D is continuous and piecewise polynomial: values at vertices in the frame of the main fracture, and what vanishes there.
        columns, tests = [], []  # each test: (panel, (D_t, D_n) at its points)
        for i, p in enumerate(chain):
            directions = [tied] if n_closed and i <= n_closed else [1, 1j]
            for e in directions:  # the vertex where p starts
                column, test = 0, []
                for q, sign in ((p, 1), (chain[i - 1] if i else None, -1)):
                    if q is None:
                        continue
                    d = e * self.turn / q.turn
                    scale = sign / (2 * q.half * (math.sqrt(2) if q.tip else 1))
                    column = column + scale * (d.real * parts[slot[id(q)]][:, 0, 0] + d.imag * parts[slot[id(q)]][:, 1, 0])
                    x = q.gauss[0]
                    test.append((q, d, np.sqrt((1 - x) / 2) if q.tip else (1 + sign * -x) / 2, (q, d * scale, 0)))
                columns.append(column[:, None])
                tests.append(test)
            inner = p.jump_integrals(p.gauss[0])
            for d in [tied] if i < n_closed else [1, 1j]:
                part = parts[slot[id(p)]]
                columns.append(d.real * part[:, 0, 1:] + complex(d).imag * part[:, 1, 1:])
                for k in range(1, p.order):
                    tests.append([(p, complex(d), inner[:, k], (p, d, k))])
        values = np.concatenate(columns, axis=1)
        far = np.concatenate([np.full(p.gauss[0].size, self.far(p.turn)) for p in panels])
        loads = np.stack([far, np.ones(len(far))], axis=1)  # and the pressure is a compression of the walls
        values = np.concatenate([values, loads], axis=1)
        start = np.cumsum([0] + [p.gauss[0].size for p in panels])
        closed_ids = {id(p) for p in closed}
        rows = np.empty((len(tests), values.shape[1]))
        row = 0
        for test in tests:
            total = 0
            for p, d, shape, _ in test:
                i = slot[id(p)]
                v = values[start[i]:start[i + 1]]
                weight = p.half * p.gauss[1] * shape
                if id(p) in closed_ids:
                    total = total + weight @ v.imag + self.sense * FRICTION * (weight @ v.real)
                else:
                    total = total + d.real * (weight @ v.imag) + d.imag * (weight @ v.real)
            rows[row] = total
            row += 1
        unknown = np.linalg.solve(rows[:, :-2], -rows[:, -2:])
        coefficients = {id(p): np.zeros((2, p.order, 2)) for p in panels}
        for q, test in zip(unknown, tests):
            for _, _, _, (p, d, k) in test:
                coefficients[id(p)][0, k] += complex(d).real * q
                coefficients[id(p)][1, k] += complex(d).imag * q
        return State(self, closed, opened, last, coefficients, values[:start[n_closed]], unknown)

    def accept(self, end):
        self.fixed += self.increment(end, False)
        self.points.append(end)

    def critical(self, length, angle, open_length, tolerance=(1e-6, 5e-5)):
        """The increment of this length at whose end K_II = 0: its state, its direction in degrees and the open length of the fracture.
        Newton's method in the direction and the logarithm of the ratio of open and closed length; the derivative is kept as long as it serves."""
        def share(ratio):
            return 1 if ratio > math.log(NEARLY_OPEN / (1 - NEARLY_OPEN)) else 1 / (1 + math.exp(-ratio))

        def evaluate(v):
            end = self.points[-1] + length * np.exp(1j * v[0])
            state = self.solve(end, HALF * share(v[1]))
            return state, np.array([state.shear / TOUGHNESS, state.edge])

        v = np.array([math.radians(angle), math.log(open_length / max(HALF - open_length, 1e-9))])
        if len(self.points) == 1:  # a first guess: the gap changes its sign
            guesses = [math.log(part * length / HALF) for part in np.geomspace(0.05, 2, 8)]
            v[1] = min(guesses, key=lambda guess: abs(evaluate(np.array([v[0], guess]))[1][1]))
        state, f = evaluate(v)
        fresh = False
        for _ in range(60):
            if (np.abs(f) < tolerance).all():
                return state, math.degrees(v[0]), HALF * share(v[1])
            if self.jacobian is None:
                self.jacobian = np.stack([(evaluate(v + d)[1] - f) / 1e-3 for d in 1e-3 * np.eye(2)], 1)
                if share(v[1]) == 1:  # open everywhere: the direction is the only unknown
                    self.jacobian[:, 1] = [0, 1]
                fresh = True
            step = -np.linalg.solve(self.jacobian, f)
            step *= min(1, 0.2 / np.abs(step).max())
            new, g = evaluate(v + step)
            while fresh and np.linalg.norm(g) > np.linalg.norm(f) and np.abs(step).max() > 1e-4:
                step /= 2
                new, g = evaluate(v + step)
            if np.linalg.norm(g) > 0.7 * np.linalg.norm(f):
                if not fresh:
                    self.jacobian = None
                    continue
                self.jacobian = None
            else:  # Broyden
                self.jacobian = self.jacobian + np.outer(g - f - self.jacobian @ step, step) / (step @ step)
            fresh = False
            v, state, f = v + step, new, g
        raise RuntimeError("no direction without K_II")


class State:
    def __init__(self, wings, closed, opened, last, coefficients, at_closed, unknown):
        self.wings, self.closed = wings, closed
        self.chain = closed + opened + wings.fixed + last
        self.on_fracture = len(closed) + len(opened)
        tip = last[-1]
        shear, opening = tip.factor() @ coefficients[id(tip)][0], tip.factor() @ coefficients[id(tip)][1]
        self.opening_factor, self.shear_factor = opening, shear  # for no pressure, and for each MPa
        self.pressure = (TOUGHNESS - opening[0]) / opening[1]
        self.shear = (shear[0] + shear[1] * self.pressure) * wings.sense
        self.coefficients = [coefficients[id(p)] @ [1, self.pressure] for p in self.chain]
        self.unknowns = len(unknown)
        self.contact = (at_closed[:, :-2] @ (unknown @ [1, self.pressure]) + at_closed[:, -2:] @ [1, self.pressure]).real  # MPa
        self.edge = 0
        if not closed:
            return
        # At the right place of the edge the gap grows with the power 3/2 of the distance to it, elsewhere with its root.
        i = len(closed)
        bt, bn = self.coefficients[i]
        gap = -2 * opened[0].half * (bn[0] - wings.sense * wings.dilation * bt[0])
        self.edge = gap / math.sqrt(2 * opened[0].half) / TOUGHNESS

    def jumps(self, count=12):
        """From the end of the wing to the middle, for each panel: it, local points, D_t and D_n there in its own frame, m."""
        end, result = 0j, []
        for p, (bt, bn) in zip(reversed(self.chain), reversed(self.coefficients)):
            u, weight = p.points(count)
            s = p.jump_integrals(np.concatenate([[-1], u]))
            d = s @ bt + 1j * (s @ bn) + end / p.turn
            result.append((p, u, weight, 4 / PLANE_MODULUS * d[1:]))
            end = d[0] * p.turn
        return result

    def volume(self):
        """What both halves have opened, m^2."""
        return 2 * sum(p.half * (weight @ d.imag) for p, _, weight, d in self.jumps())

    def slip(self, places):
        """|D_t| of the fracture at these distances from its middle, m."""
        at, value = [], []
        for p, u, _, d in self.jumps():
            if any(p is q for q in self.chain[:self.on_fracture]):
                at += list(abs(p.place(u)))
                value += list(d.real * self.wings.sense)
        order = np.argsort(at)
        return np.interp(places, np.array(at)[order], np.array(value)[order])

    def least_gap(self):
        """Of what is open, D_n - |D_t| tan psi, over its largest."""
        gap = []
        for p, _, _, d in self.jumps():
            if not any(p is q for q in self.closed):
                on_fracture = any(p is q for q in self.chain[:self.on_fracture])
                gap.append(d.imag - self.wings.sense * self.wings.dilation * d.real if on_fracture else d.imag)
        return min(g.min() for g in gap) / max(g.max() for g in gap)


SCENES = {  # name: angle of the fracture, of the stresses, dilation angle; increments
    "45": (45, 0, 1, (10e-3, 5e-3, 2.5e-3)),
    "30": (30, 0, 1, (10e-3, 5e-3, 2.5e-3)),
    "60": (60, 0, 1, (10e-3, 5e-3, 2.5e-3)),
    "rotated": (75, 30, 1, (10e-3,)),
    "dilation 5": (45, 0, 5, (10e-3, 5e-3)),
    "limit": (45, 0, 1, (0,))}
LENGTH = 0.25
LENGTHS = (0.1e-3, 0.2e-3, 0.5e-3, 1e-3, 2e-3, 5e-3, 10e-3, 20e-3, 40e-3, 70e-3, 0.1, 0.15, 0.2, 0.25)  # m
KINKS = (0.1e-3, 0.2e-3, 0.5e-3, 1e-3, 2e-3, 5e-3)  # m, of first increments that are shorter
COLUMNS = "length_m,pressure_MPa,direction_deg,x_m,y_m,volume_m2,fracture_open_m,slip_back"


def growth(wings, ends, partial=()):
    """Rows of COLUMNS where increments end, before them those of shorter first increments.
    slip_back: by how much the slip of a closed place has fallen in this increment, over its largest slip. 0: it never turns back."""
    nothing = ([0, HALF], [0, 0])
    angle = math.degrees(np.angle(wings.turn)) - 76 * wings.sense
    opened, before = 1e-4, nothing

    def row(total, step):
        nonlocal angle, opened, before
        try:
            state, angle, opened = wings.critical(step, angle, opened)
        except RuntimeError:
            if opened < HALF / 2:
                raise
            wings.jacobian = None
            state, angle, opened = wings.critical(step, angle, HALF)
        end = wings.points[-1] + step * np.exp(1j * math.radians(angle))
        places = np.linspace(0, max(0, HALF - 1.5 * opened), 41)
        slip = state.slip(places)
        back = max(0, np.max(np.interp(places, *before) - slip)) / slip.max()
        before = (places, slip)
        # Next to the edge contact has the root of the distance, with the sign of what is left of the edge's error.
        if (len(state.contact) and state.contact.max() > -0.2 * state.contact.mean()) or state.least_gap() < -1e-4:
            raise RuntimeError(f"walls overlap or part at {total}")
        return end, (total, state.pressure, angle, end.real, end.imag, state.volume(), opened, back)

    for l in partial:
        yield row(l, l)[1]
    before = nothing
    start = 0
    for total in ends:
        end, values = row(total, total - start)
        wings.accept(end)
        start = total
        yield values


def scene(name, mesh=None):
    angle, stress_angle, dilation, _ = SCENES[name]
    return Wings(angle, stress_angle=stress_angle, dilation=dilation, mesh=mesh)


def onset_row(wings):
    """The row of length 0."""
    pressure, turn = wings.onset()
    return 0, pressure, math.degrees(np.angle(wings.turn)) + turn, wings.kink.real, wings.kink.imag, wings.slipped(pressure), 0, 0


def limit(wings, parts):
    """Rows at LENGTHS by increments that grow with the length, so many of them between two LENGTHS."""
    ends = [LENGTHS[0] / 2]
    for a, b in zip((LENGTHS[0] / 2,) + LENGTHS, LENGTHS):
        ends += list(a * (b / a) ** (np.arange(1, parts) / parts)) + [b]
    return [row for row in growth(wings, ends) if min(abs(row[0] / l - 1) for l in LENGTHS) < 1e-9]


def rows_of(name):
    """Increment and row."""
    if name == "limit":
        yield 0, onset_row(scene(name))
        coarse, fine = (np.array(limit(scene(name), parts)) for parts in (3, 6))
        for values in 2 * fine - coarse:  # the error is of first order in the increment
            yield 0, values
        print(f"limit: the extrapolation adds {np.abs(1 - coarse[:, 1] / fine[:, 1]).max():.1e}")
        return
    for increment in SCENES[name][3]:
        yield increment, onset_row(scene(name))
        ends = increment * np.arange(1, round(LENGTH / increment) + 1)
        try:
            for values in growth(scene(name), ends, KINKS if increment == 10e-3 else ()):
                yield increment, values
        except RuntimeError as failure:
            print(f"{name}, {increment}: {failure}")


def main():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "sealed_wings.csv")
    names = sys.argv[1:] or list(SCENES)
    old = []
    if sys.argv[1:] and os.path.exists(path):
        old = [line for line in open(path).read().splitlines()[3:] if line.split(",")[0] not in names]
    new = [f"{name},{increment:g}," + ",".join(f"{v:.9g}" for v in values) for name in names for increment, values in rows_of(name)]
    with open(path, "w") as out:
        out.write("# wings of a slipping fracture in sealed rock, infinite plane, sealed_wings.py: length of one wing, pressure at which its end has\n"
                  "# K_I = K_IC and K_II = 0, direction of its last increment, its end, volume that both wings and the fracture have opened. Length 0: Eq. 12\n"
                  "scene,increment_m," + COLUMNS + "\n" + "\n".join(old + new) + "\n")


if __name__ == "__main__":
    main()
