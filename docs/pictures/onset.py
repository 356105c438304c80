#!/usr/bin/python3
"""docs/pictures/onset.py SPREKK: draws onset_coarse.png, the first scene of the paper against closed forms."""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk

# Table 1, and the loads of sec. 5.1.
young, nu, alpha, porosity, fluid, permeability, viscosity = 40e9, 0.2, 0.8, 0.01, 4e-10, 5e-20, 1e-4
friction, dilation, half_length, rate = 0.5, np.pi / 180, 0.05, 5e-9
bulk, shear = young / (3 * (1 - 2 * nu)), young / (2 * (1 + nu))
lame = bulk - 2 * shear / 3
storage = porosity * fluid + (alpha - porosity) / bulk
undrained = bulk + alpha**2 / storage
skempton = alpha / (storage * undrained)
nu_u = (3 * undrained - 2 * shear) / (2 * (3 * undrained + shear))
loaded = skempton * (1 + nu_u) / 3 * 30e6
injected = loaded + rate * 15 * 3600 / 4 / (storage + alpha**2 / (lame + shear))


def stress_drop(fluid_pressure, mean_pressure, flux):
    """Of a closed crack at 45 degrees; the second term is the poroelastic back stress of a crack that injects."""
    eta = alpha * (1 - 2 * nu) / (2 * (1 - nu))
    normal = 15e6 + eta * (fluid_pressure - mean_pressure - flux * viscosity / (4 * np.pi * permeability))
    return (5e6 - friction * (normal - fluid_pressure)) / (1 + friction * np.tan(dilation))


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], "run", str(ROOT / "configs/paper/onset_coarse.yaml"), "-q", "-o", folder + "/out",
                    "--set", "output.probes.mean={of: pore.pressure, take: mean}"], check=True)
    out = Path(folder) / "out"
    history = sprekk.read_table(out / "history.csv")
    fractures = {round(time / 3600): sprekk.read_vtu(file) for time, file in sprekk.read_pvd(out / "fractures.pvd")}

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
hours = history["time[s]"] / 3600
for name, text, color in (("fracture_pressure[Pa]", "in the fracture", "C1"), ("p_C[Pa]", "at point C", "C0")):
    left.plot(hours, history[name] / 1e6, ".", color=color, label=text)
left.hlines(loaded / 1e6, 0, 6, color="0.5", linewidth=1)
left.hlines(injected / 1e6, 21, 30, color="0.5", linewidth=1)
left.set(xlabel="t [h]", ylabel="fluid pressure [MPa]")
left.legend()

for hour, flux, color in ((6, 0, "C0"), (9, rate, "C2"), (21, rate, "C3")):
    grid, row = fractures[hour], np.flatnonzero(hours == hour)[0]
    along, cells = sprekk.chain(grid, np.arange(len(grid.cells)))
    jump = next(values for name, values in grid.cell_data.items() if name.startswith("contact.jump.tangential"))
    right.plot(along * 100, abs(jump[cells]) * 1e6, ".", color=color, label=f"t = {hour} h")
    drop = stress_drop(history["fracture_pressure[Pa]"][row], history["mean[Pa]"][row], flux)
    x = np.linspace(-half_length, half_length, 201)
    slip = 4 * (1 - nu**2) / young * drop * np.sqrt(half_length**2 - x**2)
    right.plot((x + half_length) * 100, slip * 1e6, color="0.5", linewidth=1, zorder=0)
    print(f"t = {hour} h: slip at the centre {abs(history['slip.t[m]'][row]) * 1e6:.2f} um, closed form {slip.max() * 1e6:.2f} um")
right.set(xlabel="distance along the fracture [cm]", ylabel="slip [µm]")
right.legend()
for axes in (left, right):
    axes.grid(alpha=0.3)
row = np.flatnonzero(hours == 6)[0]
print(f"p_C {history['p_C[Pa]'][row] / 1e6:.4f} MPa, closed form {loaded / 1e6:.4f}; at the end {history['p_C[Pa]'][-1] / 1e6:.4f}, {injected / 1e6:.4f}")
figure.savefig(HERE / "onset_coarse.png", dpi=100)
