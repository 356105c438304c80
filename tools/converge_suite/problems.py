"""Problems with closed forms for `sprekk converge`: whether the true error lies within the stated one, and how much larger that is."""

import json
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


def barrier(y):
    """Im sqrt(z^2 - 0.01) at z = iy."""
    return float(np.sqrt(y**2 + 0.01))


def pressure_of_well(x, y, time):
    """Barry and Mercer's p with all modes up to 400, by the formula of the scene."""
    mobility, shear, poisson, rate, frequency = 1e-2, 1e5 / 2.2, 0.1, 20, 1022.727272727272727
    modulus = 2 * shear * (1 - poisson) / (1 - 2 * poisson)
    n = np.arange(1, 401) * np.pi
    decay = mobility * modulus * (n[:, None] ** 2 + n[None, :] ** 2)
    source = 4 * rate * modulus * np.outer(np.sin(0.25 * n), np.sin(0.25 * n))
    wave = decay * np.sin(frequency * time) - frequency * np.cos(frequency * time) + frequency * np.exp(-decay * time)
    return float(np.sin(n * x) @ (source * wave / (decay**2 + frequency**2)) @ np.sin(n * y))


def problems():
    mandel = exact.Mandel()
    matrix, fracture = exact.single_mode()
    return {
        "terzaghi": Problem("terzaghi", "p_closed", float(exact.terzaghi_pressure(np.array([1.0]), 0.1 / CONTINUOUS, CONTINUOUS)[0]),
                            {"mesh.cells": "[2, 20]"}, quick=True),
        "mandel": Problem("mandel", "p_half", float(mandel.pressure(np.array([0.5]), 10790, CONTINUOUS)[0]), {"mesh.size": "0.1 m"}, quick=True),
        "barry_mercer": Problem("barry_mercer", "p_75_5", pressure_of_well(0.75, 0.5, 1.535889741755005e-3), {"mesh.cells": "[16, 16]"}),
        "pressurized_crack": Problem("pressurized_crack", "opening.n", exact.SNEDDON_PEAK, {"mesh.fracture_size": "0.1 m", "mesh.growth": 0.2}, quick=True),
        "frictional_crack": Problem("frictional_crack", "slip.t", exact.phan_peak(), {"mesh.fracture_size": "0.1 m", "mesh.growth": 0.2}, quick=True),
        "fracture_inflow": Problem("fracture_inflow", "p_fracture", 2.0, quick=True),
        "fracture_barrier": Problem("fracture_barrier", "p_above", barrier(0.03), quick=True),
        "biot_manufactured": Problem("biot_manufactured", "p", float(exact.manufactured_biot(np.array([0.3]), np.array([0.2]))[0][0]),
                                     {"output.probes.p": "{of: pore.pressure, at: [0.3 m, 0.2 m]}"}, quick=True),
        "single_mode": Problem("single_mode_fracture", "p", float(matrix(0.2, 0.25)),
                               {"output.probes.p": "{of: pore.pressure, at: [0.2 m, 0.25 m]}"}, quick=True),
        "injection_fault": Problem("injection_fault", "slip.t", float(exact.viesca_slip(0.0, 0.5)),
                                   {"time.end": "0.5 s", "time.step": "0.02 s", "mesh.fracture_size": "0.1 m", "mesh.growth": 0.5,
                                    "output.probes.slip": "{of: contact.jump, at: [0 m, 0 m]}"}),
    }


@dataclass
class Verdict:
    value: float
    stated: float
    true: float
    orders: dict

    @property
    def is_within(self):
        return self.true <= self.stated

    @property
    def times_too_large(self):
        return self.stated / self.true if self.true else float("inf")


def converge(program, problem, folder, *more):
    """The first quantity of converge.json."""
    settings = [word for path, value in problem.settings.items() for word in ("--set", f"{path}={value}")]
    scene = ROOT / "configs/verification" / f"{problem.scene}.yaml"
    done = subprocess.run([str(program), "converge", str(scene), "--of", problem.quantity, "-q", "-j", "1", "-o", str(folder), *settings, *more],
                          capture_output=True, text=True, timeout=1500, check=False)
    if done.returncode:
        raise RuntimeError(f"{problem.scene}: exit code {done.returncode}: {done.stderr}")
    return json.loads((Path(folder) / "converge.json").read_text())


def judged(program, problem, folder):
    found = converge(program, problem, folder)["quantities"][0]
    sign = np.sign(found["value"] * problem.answer)  # the sign of a slip is that of the fracture's direction
    return Verdict(found["value"], found["error"], abs(sign * found["value"] - problem.answer),
                   {one["name"]: round(one["order"], 2) if one["regular"] else None for one in found["parameters"]})
