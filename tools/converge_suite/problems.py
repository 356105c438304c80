"""Problems with closed forms for `sprekk converge`: whether the true error lies within the stated one, and how much larger that is."""

import json
import math
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/benchmark"))
import numpy as np  # noqa: E402

import closed_forms as exact  # noqa: E402

CONTINUOUS = 10**7  # steps of closed forms that are given for steps


@dataclass
class Problem:
    scene: str  # in configs/verification
    quantity: str
    answer: float  # SI
    settings: dict = field(default_factory=dict)
    quick: bool = False
    elsewhere: dict = field(default_factory=dict)  # {column of history.csv: its answer}, of the same kind at other places

    @property
    def answers(self):
        return {self.quantity: self.answer, **self.elsewhere}


def probes(of, function, places, ending=""):
    """(settings, answers) of the field at places; `function`: its answer there; `ending`: of the column, for components."""
    names = [f"place_{i}" for i in range(len(places))]
    settings = {f"output.probes.{name}": f"{{of: {of}, at: [{x!r} m, {y!r} m]}}" for name, (x, y) in zip(names, places)}
    return settings, {name + ending: float(function(x, y)) for name, (x, y) in zip(names, places)}


def barrier(x, y):
    """Im sqrt(z^2 - 0.01) above the fracture."""
    return float(abs(np.sqrt(complex(x, y) ** 2 - 0.01).imag))


def inflow(x, y):
    """2 - acosh of the sum of the distances from both ends of the fracture over its length."""
    return float(2 - np.arccosh((np.hypot(x + 0.1, y) + np.hypot(x - 0.1, y)) / 0.2))


def pressure_of_well(x, y, time):
    """Barry and Mercer's p with all modes up to 400, by the formula of the scene."""
    mobility, shear, poisson, rate, frequency = 1e-8, 1e5 / 2.2, 0.1, 2e-5, 1.022727272727272727e-3
    modulus = 2 * shear * (1 - poisson) / (1 - 2 * poisson)
    n = np.arange(1, 401) * np.pi
    decay = mobility * modulus * (n[:, None] ** 2 + n[None, :] ** 2)
    source = 4 * rate * modulus * np.outer(np.sin(0.25 * n), np.sin(0.25 * n))
    wave = decay * np.sin(frequency * time) - frequency * np.cos(frequency * time) + frequency * np.exp(-decay * time)
    return float(np.sin(n * x) @ (source * wave / (decay**2 + frequency**2)) @ np.sin(n * y))


PLACES = 30
DRAWN = np.random.default_rng(20261127)


def drawn(low, high, fits):
    """Points of a square that fit."""
    found = []
    while len(found) < PLACES:
        x, y = DRAWN.uniform(low, high, 2)
        if fits(x, y):
            found.append((float(x), float(y)))
    return found


IN_ROCK = drawn(-0.9, 0.9, lambda x, y: math.hypot(max(abs(x) - 0.1, 0), y) > 0.08)  # m, off a fracture from -0.1 to 0.1 m
IN_SQUARE = drawn(0.07, 0.93, lambda x, y: abs(y - 0.5) > 0.05)  # m, off the middle of a square of 1 m
ALONG = [(float(x), 0.0) for x in DRAWN.uniform(-0.85, 0.85, PLACES)]  # m, of a fracture from -1 to 1 m


def problems():
    mandel = exact.Mandel()
    matrix, _ = exact.single_mode()
    around, around_answers = probes("pore.pressure", inflow, IN_ROCK)
    above, above_answers = probes("pore.pressure", barrier, [(x, abs(y)) for x, y in IN_ROCK])
    manufactured, manufactured_answers = probes(
        "pore.pressure", lambda x, y: exact.manufactured_biot(np.array([x]), np.array([y]))[0][0], IN_SQUARE)
    mode, mode_answers = probes("pore.pressure", matrix, [(x, y - 0.5) for x, y in IN_SQUARE])
    fault, fault_answers = probes("contact.jump", lambda x, _: exact.viesca_slip(x, 0.5), [(0.6 * x, 0.0) for x, _ in ALONG], ".t")
    along_slope = [(x * math.cos(math.radians(20)), x * math.sin(math.radians(20))) for x, _ in ALONG]
    slip, slip_answers = probes("contact.jump", lambda x, y: exact.elliptic(math.hypot(x, y), 1.0, exact.phan_peak()), along_slope, ".t")
    opening, opening_answers = probes("contact.jump", lambda x, _: exact.elliptic(x, 1.0, exact.SNEDDON_PEAK), ALONG, ".n")
    crack = {"mesh.fracture_size": "0.1 m", "mesh.growth": 0.2}
    return {
        "terzaghi": Problem("terzaghi", "p_closed", float(exact.terzaghi_pressure(np.array([1.0]), 0.1 / CONTINUOUS, CONTINUOUS)[0]),
                            {"mesh.cells": "[2, 20]"}, quick=True),
        "mandel": Problem("mandel", "p_half", float(mandel.pressure(np.array([0.5]), 10790, CONTINUOUS)[0]), {"mesh.size": "0.1 m"},
                          quick=True),
        "barry_mercer": Problem("barry_mercer", "p_75_5", pressure_of_well(0.75, 0.5, 1535.889741755005), {"mesh.cells": "[16, 16]"}),
        "pressurized_crack": Problem("pressurized_crack", "opening.n", exact.SNEDDON_PEAK, {**crack, **opening}, quick=True,
                                     elsewhere=opening_answers),
        "frictional_crack": Problem("frictional_crack", "slip.t", exact.phan_peak(), {**crack, **slip}, quick=True, elsewhere=slip_answers),
        "fracture_inflow": Problem("fracture_inflow", "p_fracture", 2.0, around, quick=True, elsewhere=around_answers),
        "fracture_barrier": Problem("fracture_barrier", "p_above", barrier(0, 0.03), above, quick=True, elsewhere=above_answers),
        "biot_manufactured": Problem("biot_manufactured", "p", float(exact.manufactured_biot(np.array([0.3]), np.array([0.2]))[0][0]),
                                     {"output.probes.p": "{of: pore.pressure, at: [0.3 m, 0.2 m]}", **manufactured}, quick=True,
                                     elsewhere=manufactured_answers),
        "single_mode": Problem("single_mode_fracture", "p", float(matrix(0.2, 0.25)),
                               {"output.probes.p": "{of: pore.pressure, at: [0.2 m, 0.25 m]}", **mode}, quick=True, elsewhere=mode_answers),
        "injection_fault": Problem("injection_fault", "slip.t", float(exact.viesca_slip(0.0, 0.5)),
                                   {"time.end": "0.5 s", "time.step": "0.02 s", "mesh.fracture_size": "0.1 m", "mesh.growth": 0.5,
                                    "output.probes.slip": "{of: contact.jump, at: [0 m, 0 m]}", **fault}, elsewhere=fault_answers),
    }


@dataclass
class Verdict:
    value: float  # of the quantity of the problem
    errors: dict  # {column: (stated, true)}, of the quantity and of those elsewhere
    orders: dict

    @property
    def beyond(self):
        """The columns whose true error is beyond the stated one."""
        return [column for column, (stated, true) in self.errors.items() if true > stated]

    @property
    def stated(self):
        """Root mean square: at a single place an error may pass zero, where any stated one is many times too large."""
        return float(np.sqrt(np.mean([stated**2 for stated, _ in self.errors.values()])))

    @property
    def true(self):
        return float(np.sqrt(np.mean([true**2 for _, true in self.errors.values()])))

    @property
    def times_too_large(self):
        return self.stated / self.true if self.true else float("inf")


def converge(program, problem, folder, *more):
    """converge.json of all quantities of a problem."""
    settings = [word for path, value in problem.settings.items() for word in ("--set", f"{path}={value}")]
    scene = ROOT / "configs/verification" / f"{problem.scene}.yaml"
    of = [word for column in problem.answers for word in ("--of", column)]
    done = subprocess.run([str(program), "converge", str(scene), *of, "-q", "-j", "1", "-o", str(folder), *settings, *more],
                          capture_output=True, text=True, timeout=1500, check=False)
    if done.returncode:
        raise RuntimeError(f"{problem.scene}: exit code {done.returncode}: {done.stderr}")
    return json.loads((Path(folder) / "converge.json").read_text())


def judged(program, problem, folder):
    found = converge(program, problem, folder)["quantities"]
    errors = {}
    for one in found:
        answer = problem.answers[one["quantity"]]
        sign = np.sign(one["value"] * answer)  # the sign of a slip is that of the fracture's direction
        errors[one["quantity"]] = (one["error"], abs(sign * one["value"] - answer))
    orders = {one["name"]: round(one["order"], 2) if one["regular"] else None for one in found[0]["parameters"]}
    return Verdict(found[0]["value"], errors, orders)
