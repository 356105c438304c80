"""A component of a scene as a Python program (docs/outside_program.md has the protocol):

    from sprekk.outside import Component, serve

    class Pressure(Component):
        def solve(self, step, fields):
            return {"pressure": ...}

    serve(Pressure())

Standard output is for the messages, so what the program prints goes to standard error."""

import copy
import os
import sys

import numpy as np

VERSION = 1
_TYPES = {"real": np.dtype("=f8"), "int": np.dtype("=i4"), "text": np.dtype("S1")}


class Failed(Exception):
    """Raised by solve where a step cannot be taken: a shorter one is tried."""


class Fields(dict):
    """Arrays by name, those at the end of the step; `before` has those at its start."""

    def __init__(self, values, before):
        super().__init__(values)
        self.before = before


class Step:
    """The times of a step, s."""

    def __init__(self, start, dt, end):
        self.start, self.dt, self.end = start, dt, end


class Mesh:
    """The mesh of the scene: arrays as attributes (nodes, cell_center, face_cells, …), names as lists (sides, regions, fractures)."""

    def __init__(self, dimension, items):
        self.dimension = dimension
        for name, values in items.items():
            if isinstance(values, str):
                values = values.splitlines()
            elif name in ("nodes", "cell_center", "face_center", "face_normal", "fracture_cell_center", "fracture_cell_normal"):
                values = values.reshape(-1, dimension)
            elif name in ("face_cells", "fracture_cell_faces"):
                values = values.reshape(-1, 2)
            setattr(self, name, values)

    def nodes_of(self, cell):
        return self.cell_nodes[self.cell_nodes_begin[cell]:self.cell_nodes_begin[cell + 1]]

    def faces_on(self, side):
        """The numbers of the faces on a side of the outer boundary."""
        return np.flatnonzero(self.face_side == self.sides.index(side))


class Component:
    """To be derived from. `state` holds what solve takes from one step to the next, arrays by name: each solve finds it as it was
    at the start of the step, whatever earlier ones of the same step have made of it."""

    def __init__(self):
        self.state = {}

    def start(self, mesh, parameters, fields):
        """Called once. parameters: of the scene, in SI units; fields: the values at the start of what it gives."""

    def solve(self, step, fields):
        """Returns the values at the end of the step, {name: array}, for these values of the fields that it takes."""
        raise NotImplementedError


def _read_exactly(stream, size):
    data = stream.read(size)
    if len(data) < size:
        raise EOFError
    return data


def _read(stream):
    line = stream.readline()
    if not line:
        raise EOFError
    word, count = line.split()
    items = {}
    for _ in range(int(count)):
        name, kind, size = stream.readline().decode().split()
        data = _read_exactly(stream, int(size) * _TYPES[kind].itemsize)
        items[name] = data.decode() if kind == "text" else np.frombuffer(data, _TYPES[kind]).copy()
    return word.decode(), items


def _write(stream, word, items):
    parts = [f"{word} {len(items)}\n".encode()]
    for name, values in items.items():
        if isinstance(values, str):
            kind, data = "text", values.encode()
            size = len(data)
        else:
            kind = "int" if name == "version" else "real"
            array = np.ascontiguousarray(values, _TYPES[kind])
            size, data = array.size, array.tobytes()
        parts.append(f"{name} {kind} {size}\n".encode() + data)
    stream.write(b"".join(parts))
    stream.flush()


class _Server:
    """The states of a component: as last accepted, at the start of the step (the base), and after the last solve."""

    def __init__(self, component):
        self.component = component
        self.accepted = self.base = self.solved = None

    def hello(self, items):
        if items["version"][0] != VERSION:
            raise ValueError(f"this module speaks version {VERSION} of the protocol, not {items['version'][0]}")
        self.gives = [line.split()[0] for line in items["gives"].splitlines()]
        self.components = {words[0]: int(words[1]) for words in
                           (line.split() for line in (items["gives"] + items["takes"]).splitlines())}
        mesh = Mesh(int(items["dimension"][0]), {name[5:]: values for name, values in items.items() if name.startswith("mesh.")})
        parameters = {name[10:]: float(values[0]) for name, values in items.items() if name.startswith("parameter.")}
        self.component.start(mesh, parameters, self._shaped({name: items[name] for name in self.gives}))
        self.shapes = {name: np.shape(values) for name, values in self.component.state.items()}
        self.accepted = self.base = copy.deepcopy(self.component.state)
        return "ready", {"version": [VERSION]}

    def _shaped(self, items):
        return {name: values.reshape(-1, self.components[name]) if self.components.get(name, 1) > 1 else values
                for name, values in items.items()}

    def restore(self, items):
        self.accepted = {name: values.reshape(self.shapes.get(name, values.shape)) for name, values in items.items()}
        self.base = self.accepted
        return "restored", {}

    def begin(self, items):
        self.step = Step(*(float(value) for value in items.pop("step")))
        self.before = self._shaped(items)
        return "begun", {}

    def solve(self, items):
        self.component.state = copy.deepcopy(self.base)
        values = self.component.solve(self.step, Fields(self._shaped(items), self.before))
        self.solved = copy.deepcopy(self.component.state)
        missing = [name for name in self.gives if name not in values]
        if missing:
            raise KeyError(f"solve does not return {missing}")
        return "solved", {name: np.asarray(values[name], float) for name in self.gives}

    def advance(self, _):
        self.base = self.solved
        return "advanced", {}

    def accept(self, _):
        self.base = self.accepted = self.solved
        return "accepted", {name: np.asarray(values, float) for name, values in self.accepted.items()}

    def rewind(self, _):
        self.base = self.accepted
        return "rewound", {}


def serve(component):
    """Answers until the run ends."""
    sys.stdout.flush()
    ask, answer = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    server = _Server(component)
    while True:
        try:
            word, items = _read(ask)
        except EOFError:
            return
        try:
            reply = getattr(server, word)(items)
        except Failed as failure:
            reply = "failed", {"why": str(failure)}
        try:
            _write(answer, *reply)
        except BrokenPipeError:  # nobody waits for the answer any more
            os._exit(0)
