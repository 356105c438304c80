#!/usr/bin/python3
"""Friction of rate and state, without Sprekk: a block on a spring, and a fault in an infinite plane. `rate_and_state.py` writes rate_and_state.csv,
velocity_step.csv and fault_nucleation.csv.

The law is tau = N a arcsinh(V/(2 V0) exp((f0 + b ln(V0 theta/L))/a)) + eta V with d theta/dt = 1 - V theta/L. Slip and ln theta are integrated by
the pair of Dormand and Prince (1980) of order 5 and 4 with a bound on the error of each step; V follows from the traction and theta at every stage."""
import math
import os

import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))

# Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19
STAGES = ((), (1 / 5,), (3 / 40, 9 / 40), (44 / 45, -56 / 15, 32 / 9), (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
          (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656), (35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84))
TIMES = (0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1)
FOURTH = (5179 / 57600, 0, 7571 / 16695, 393 / 640, -92097 / 339200, 187 / 2100, 1 / 40)


def integrate(slope, y, time, end, error, step=1.0, longest=math.inf):
    """Yields (time, y) after each step; `error` of a vector y gives the size of an error relative to what is allowed."""
    first = slope(time, y)
    while time < end:
        step = min(step, end - time, longest)
        k = [first]
        for nodes, share in zip(STAGES[1:], TIMES[1:]):
            k.append(slope(time + share * step, y + step * sum(c * d for c, d in zip(nodes, k) if c)))
        new = y + step * sum(c * d for c, d in zip(STAGES[6], k) if c)
        size = error(step * sum((c - d) * s for c, d, s in zip(STAGES[6] + (0,), FOURTH, k)))
        if size <= 1:
            time, y, first = time + step, new, k[6]
            yield time, y
        step *= min(5.0, max(0.2, 0.9 * (size + 1e-12) ** -0.2))


class Friction:
    """Of walls under the pressure `normal`, Pa; parameters may be arrays."""

    def __init__(self, a, b, distance, normal, friction=0.6, rate=1e-6, damping=0.0):
        self.a, self.b, self.distance, self.normal = a, b, distance, normal
        self.friction, self.rate, self.damping = friction, rate, damping
        self.last = None

    def log_rate(self, traction, log_theta):
        """ln V by Newton's method, which converges from the right as the traction is convex in ln V."""
        n_a = self.normal * self.a
        shift = (self.friction + self.b * (log_theta + np.log(self.rate / self.distance))) / self.a - math.log(2 * self.rate)
        y = traction / n_a
        x = y + np.log(-np.expm1(-2 * y)) - math.log(2) - shift
        if self.damping > 0:
            x = np.minimum(x, np.log(traction / self.damping))
        for _ in range(100):
            e = x + shift
            w = np.exp(np.minimum(e, 300))
            value = n_a * np.where(e > 20, e + math.log(2), np.arcsinh(w)) + self.damping * np.exp(x) - traction
            change = value / (n_a * np.where(e > 20, 1.0, w / np.sqrt(1 + w * w)) + self.damping * np.exp(x))
            x = x - change
            if np.max(np.abs(change)) < 1e-13:
                break
        return x

    def traction(self, rate, theta):
        w = rate / (2 * self.rate) * np.exp((self.friction + self.b * np.log(self.rate * theta / self.distance)) / self.a)
        return self.normal * self.a * np.arcsinh(w) + self.damping * rate


class Slider:
    """A block on a spring whose end moves: traction + stiffness slip = initial + stiffness pull(t)."""

    def __init__(self, friction, stiffness, initial, pull):
        self.friction, self.stiffness, self.initial, self.pull = friction, stiffness, initial, pull

    def log_rate(self, time, y):
        return self.friction.log_rate(self.initial + self.stiffness * (self.pull(time) - y[0] * self.friction.distance), y[1])

    def slope(self, time, y):  # of (slip/L, ln theta)
        rate = math.exp(self.log_rate(time, y)) / self.friction.distance
        return np.array((rate, math.exp(-y[1]) - rate))

    def run(self, theta, end, tolerance=1e-9, step=1.0, longest=math.inf):
        """Rows (time, slip, theta, V)."""
        y = np.array((0.0, math.log(theta)))
        rows = [(0.0, 0.0, theta, math.exp(self.log_rate(0.0, y)))]
        for time, y in integrate(self.slope, y, 0.0, end, lambda e: np.max(np.abs(e)) / tolerance, step, longest):
            rows.append((time, y[0] * self.friction.distance, math.exp(y[1]), math.exp(self.log_rate(time, y))))
        return np.array(rows)


def events(rows, threshold):
    """Times at which V rises above the threshold (linear in ln V between steps), and the greatest V until it falls below."""
    log_rate, level = np.log(rows[:, 3]), math.log(threshold)
    found = []
    for i in range(1, len(rows)):
        if log_rate[i - 1] <= level < log_rate[i]:
            share = (level - log_rate[i - 1]) / (log_rate[i] - log_rate[i - 1])
            found.append([rows[i - 1, 0] + share * (rows[i, 0] - rows[i - 1, 0]), 0.0])
        if found and log_rate[i] > level:
            found[-1][1] = max(found[-1][1], rows[i, 3])
    return np.array(found)


# configs/verification/spring_slider.yaml: a block of rock of the height H, cut by a fault and sheared at V_pl
SHEAR_MODULUS, HEIGHT, WAVE_SPEED, PLATE_RATE = 30e9, 100.0, 3000.0, 1e-9
FAULT = {"a": 0.010, "b": 0.015, "distance": 1e-4, "normal": 10e6}


def slider(damped=True, tolerance=1e-9, end=3.0e7, **more):
    fault = dict(FAULT, damping=SHEAR_MODULUS / (2 * WAVE_SPEED) if damped else 0.0)
    fault.update(more)
    friction = Friction(**fault)
    theta = friction.distance / PLATE_RATE
    # begins at rest with less traction than at steady slip with V_pl
    block = Slider(friction, SHEAR_MODULUS / HEIGHT, 5e6, lambda t: PLATE_RATE * t)
    return block.run(theta, end, tolerance)


# configs/verification/fault_nucleation.yaml: a fault in a large body under shear that rises
NUCLEATION = {"a": 0.0075, "b": 0.015, "distance": 1e-4, "normal": 10e6}
FAULT_LENGTH, SHEAR_OVER, STRESS_RATE, FIRST_RATE = 100.0, SHEAR_MODULUS / (1 - 0.25), 0.05, 1e-12


class Fault:
    """Cells of constant slip on a straight fault in an infinite plane under uniform shear (plane strain). A cell from c - h/2 to c + h/2 with the
    slip D gives -G/(2 pi (1 - nu)) D (1/(x - c + h/2) - 1/(x - c - h/2)) at x (a pair of dislocations)."""

    def __init__(self, cells, friction, initial):
        h = FAULT_LENGTH / cells
        self.x = (np.arange(cells) + 0.5) * h - FAULT_LENGTH / 2
        away = self.x[:, None] - self.x[None, :]
        self.stress = -SHEAR_OVER / (2 * math.pi) * (1 / (away + h / 2) - 1 / (away - h / 2)) * friction.distance
        self.friction, self.initial, self.cells = friction, initial, cells

    def log_rate(self, time, y):
        traction = self.initial + STRESS_RATE * time + self.stress @ y[:self.cells]
        return self.friction.log_rate(traction, y[self.cells:])

    def slope(self, time, y):
        rate = np.exp(self.log_rate(time, y)) / self.friction.distance
        return np.concatenate((rate, np.exp(-y[self.cells:]) - rate))

    def run(self, end, tolerance, stop_rate):
        """Rows (time, greatest V)."""
        theta = self.friction.distance / FIRST_RATE
        y = np.concatenate((np.zeros(self.cells), np.full(self.cells, math.log(theta))))
        rows = []
        for time, y in integrate(self.slope, y, 0.0, end, lambda e: np.max(np.abs(e)) / tolerance, 1e3):
            rows.append((time, 0.0, 0.0, math.exp(np.max(self.log_rate(time, y)))))
            if rows[-1][3] > stop_rate:
                break
        return np.array(rows), y


def nucleation(cells, tolerance=1e-7, end=1e9):
    friction = Friction(damping=SHEAR_MODULUS / (2 * WAVE_SPEED), **NUCLEATION)
    initial = float(friction.traction(FIRST_RATE, friction.distance / FIRST_RATE))
    return Fault(cells, friction, initial).run(end, tolerance, 2e-3)


# A block whose slip is stable at 1 um/s, and from STEP_TIME on at 10 um/s; L is ten times as long
STEP_TIME, STEP_END, SLOW, FAST = 2000.0, 2600.0, 1e-6, 1e-5
STEP_FAULT = dict(FAULT, distance=1e-3, damping=SHEAR_MODULUS / (2 * WAVE_SPEED))


def velocity_step(tolerance=1e-10, times=np.arange(10.0, STEP_END + 1, 10.0)):
    """Rows (time, traction, V) at these times; the block begins in steady slip at SLOW."""
    friction = Friction(**STEP_FAULT)
    theta = friction.distance / SLOW
    initial = float(friction.traction(SLOW, theta))
    block = Slider(friction, SHEAR_MODULUS / HEIGHT, initial, lambda t: SLOW * min(t, STEP_TIME) + FAST * max(0.0, t - STEP_TIME))
    rows, y, now = [], np.array((0.0, math.log(theta))), 0.0
    for time in times:
        for now, y in integrate(block.slope, y, now, time, lambda e: np.max(np.abs(e)) / tolerance):
            pass
        rate = math.exp(block.log_rate(time, y))
        rows.append((time, float(friction.traction(rate, math.exp(y[1]))), rate))
    return np.array(rows)


def write(name, comment, columns, rows):
    with open(os.path.join(FOLDER, name), "w", encoding="utf8") as file:
        file.write(f"# {comment}; rate_and_state.py\n{','.join(columns)}\n")
        for row in rows:
            file.write(",".join(f"{value:.10g}" for value in row) + "\n")


def main():
    found, coarser = (events(slider(tolerance=tolerance), 1e-3) for tolerance in (1e-11, 1e-9))
    write("rate_and_state.csv", "events of a block on a spring (configs/verification/spring_slider.yaml): when slip passes 1 mm/s; change: by a hundredth of "
          "the bound of errors", ("begin_s", "peak_slip_rate_m_s", "begin_change_s", "peak_change"),
          [(*event, event[0] - other[0], event[1] / other[1] - 1) for event, other in zip(found, coarser)])
    fine, coarse = velocity_step(), velocity_step(1e-8)
    write("velocity_step.csv", "a block on a spring in steady slip at 1 um/s, pulled at 10 um/s from 2000 s on; change: by a hundredth of the bound of "
          "errors", ("time_s", "traction_Pa", "slip_rate_m_s", "traction_change"),
          [(*row, row[1] / other[1] - 1) for row, other in zip(fine, coarse)])
    times = [events(nucleation(cells, 1e-7)[0], 1e-3)[0, 0] for cells in (100, 200, 400, 800)]
    # of first order in the size of cells
    rows = [(cells, time, 2 * time - coarse) for cells, time, coarse in zip((200, 400, 800), times[1:], times)]
    write("fault_nucleation.csv", "a fault under rising shear (configs/verification/fault_nucleation.yaml): when slip passes 1 mm/s; extrapolated in the "
          "size of cells", ("cells", "begin_s", "extrapolated_s"), rows)


if __name__ == "__main__":
    main()
