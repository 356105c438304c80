"""Starts runs."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from .results import Results


class RunFailed(RuntimeError):
    """A run that did not come to its end: its exit code, and what the program said."""

    def __init__(self, code, said):
        super().__init__(f"exit code {code}: {said.strip()}")
        self.code, self.said = code, said


def find_program():
    """The program: the environment's SPREKK, that of the tree this module is in, or the first `sprekk` of the path."""
    built = Path(__file__).resolve().parents[3] / "build/release/sprekk"
    program = os.environ.get("SPREKK") or (built if built.is_file() else shutil.which("sprekk"))
    if not program:
        raise FileNotFoundError("no program 'sprekk' is found (it is not on the path) build it, or set SPREKK to its place")
    return str(program)


def as_yaml(value):
    """A value of Python as one of a scene."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {as_yaml(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(as_yaml, value)) + "]"
    return str(value)


def run(scene, set=None, out=None, text=None, program=None, processes=1, timeout=None):  # pylint: disable=redefined-builtin
    """Runs a scene and returns its Results. Raises RunFailed when it does not come to its end.

    scene: a file or several, which are merged. set: {path in the scene: value}. text: YAML that is merged as a further file.
    out: the folder of the results, a new temporary one by default. processes: of mpirun."""
    files = [str(file) for file in ([scene] if isinstance(scene, (str, Path)) else scene)]
    folder = Path(out) if out is not None else Path(tempfile.mkdtemp(prefix="sprekk_")) / "out"
    with tempfile.TemporaryDirectory() as scratch:
        if text is not None:
            files.append(f"{scratch}/text.yaml")
            Path(files[-1]).write_text(text, encoding="utf-8")
        command = [str(program or find_program()), "run", "-q", *files, "-o", str(folder)]
        for path, value in (set or {}).items():
            command += ["--set", f"{path}={as_yaml(value)}"]
        if processes > 1:
            command = ["mpirun", "-n", str(processes), *command]
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    if done.returncode != 0:
        raise RunFailed(done.returncode, done.stderr)
    return Results(folder)
