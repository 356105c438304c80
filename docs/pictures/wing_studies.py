#!/usr/bin/python3
"""docs/pictures/wing_studies.py FOLDER: draws wing_studies.png and prints the tables of docs/numerics/studies.md. FOLDER
has the results of the studies in configs/paper/studies: sprekk sweep configs/paper/studies/NAME.yaml -o FOLDER/NAME.
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "tools"), str(HERE.parents[1] / "tools/python")]
import sprekk
from growth_times import time_to
from paths import apart

STUDIES = {  # the finest run of each
    "fig12_coarse_size": "reference",
    "fig14_fine_level": "size=4m,mesh_ratio=0.25",
    "fig15_step_and_threshold": "step=30min",
}
TIP = "tips.main_last.length[m]"


class Run:
    def __init__(self, folder):
        history = sprekk.read_table(folder / "history.csv")
        self.hours, self.length = history["time[s]"] / 3600, history[TIP]
        self.record = json.loads((folder / "run.json").read_text())
        line = sprekk.read_vtu(sprekk.read_pvd(folder / "fractures.pvd")[-1][1]).points[:, :2]
        self.path = line[np.argsort(line[:, 0])]  # x grows along the fracture and both wings

    def time_to(self, length):
        return time_to(length, self.hours, self.length)


figure, axes = plt.subplots(2, len(STUDIES), figsize=(14, 7), layout="constrained", height_ratios=[1.3, 1])
for (study, finest), (upper, lower) in zip(STUDIES.items(), axes.T):
    folder = Path(sys.argv[1]) / study
    runs = {entry.name: Run(entry) for entry in sorted(folder.iterdir()) if (entry / "fractures.pvd").is_file()}
    print(f"{study}\n| run | to 0.1 m | | to 0.25 m | | path | steps | seconds |\n|---|---|---|---|---|---|---|---|")
    for name, run in runs.items():
        reference = runs[finest]
        times = "".join(f" {run.time_to(metres):.2f} h | {100 * (run.time_to(metres) / reference.time_to(metres) - 1):+.1f} % |"
                        for metres in (0.1, 0.25))
        print(f"| {name} |{times} {1e3 * apart(run.path, reference.path):.1f} mm | {len(run.hours)} "
              f"| {run.record['seconds']:.0f} |")
        style = {"color": "k", "linewidth": 2.2, "zorder": 1} if name == finest else {"linewidth": 1.1}
        upper.plot(run.hours, run.length * 100, label=name.replace(",", ", "), **style)
        lower.plot(*run.path.T, **style)
    upper.set(title=study[:3].capitalize() + ". " + study[3:5], xlabel="t [h]", ylabel="length of the right wing [cm]")
    upper.grid(alpha=0.3)
    upper.legend(fontsize=7)
    lower.set(xlabel="x [m]", ylabel="y [m]", title="final paths (y is stretched)")
    lower.grid(alpha=0.3)
figure.savefig(HERE / "wing_studies.png", dpi=90)
