"""Mesh files of hexahedra and wedges with bent faces, and of tetrahedra."""

import itertools

import numpy as np

TURN = np.linalg.qr(np.array([[1.0, 0.4, -0.3], [-0.2, 1.1, 0.6], [0.5, -0.3, 0.9]]))[0]  # about no axis


def moved_nodes(turn, cells=(4, 3, 3), seed=5, moved=0.05):
    """The nodes of a unit cube of hexahedra, turned: those off its sides and off the plane in its middle are moved at random."""
    grid = np.stack(np.meshgrid(*(np.linspace(0, 1, n + 1) for n in cells), indexing="ij"), -1)
    moves = np.random.default_rng(seed).uniform(-moved, moved, grid.shape)
    moves[[0, cells[0] // 2, -1]] = 0
    moves[:, [0, -1]] = 0
    moves[:, :, [0, -1]] = 0
    return (grid + moves) @ turn.T


def mesh_file(turn, cells=(4, 3, 3), seed=5, moved=0.05, wedges=False, without=(), bodies=(), fault=True):
    """A gmsh file (2.2) of these hexahedra, or of two wedges in the place of each: a fracture `fault` in the middle (if it is to be), the sides `west` and `others`.
    Cells `without` are missing, and `bodies` are more tetrahedra, with nodes of their own."""
    grid = moved_nodes(turn, cells, seed, moved)
    count = grid[..., 0].size
    number = np.arange(1, count + 1).reshape(grid.shape[:3])
    nodes = "".join("{} {!r} {!r} {!r}\n".format(k, *map(float, x)) for k, x in zip(number.ravel(), grid.reshape(-1, 3)))
    elements = []
    square = ((0, 0), (1, 0), (1, 1), (0, 1))
    for i, j, k in np.ndindex(*cells):
        for bottom in (square[:3], (*square[2:], square[0])) if wedges else (square,):
            if (i, j, k) not in without:
                elements.append((6 if wedges else 5, 4, [number[i + a, j + b, k + c] for c in (0, 1) for a, b in bottom]))
    for body in bodies:
        nodes += "".join("{} {!r} {!r} {!r}\n".format(count + k, *map(float, x)) for k, x in enumerate(np.array(body) @ turn.T, 1))
        elements.append((4, 4, list(range(count + 1, count + 5))))
        count += 4
    for axis in range(3):
        planes = [(0, 2 if axis == 0 else 3), (cells[axis], 3)] + ([(cells[0] // 2, 1)] if axis == 0 and fault else [])
        for at, group in planes:
            sheet = np.take(number, at, axis)
            for i, j in np.ndindex(sheet.shape[0] - 1, sheet.shape[1] - 1):
                corners = [sheet[i + a, j + b] for a, b in square]
                halves = [corners[:3], [*corners[2:], corners[0]]] if wedges and axis == 2 else [corners]
                elements += [(len(at) - 1, group, at) for at in halves]  # gmsh's type is 2 for three nodes, 3 for four
    lines = "".join(f"{n} {kind} 2 {group} {group} {' '.join(map(str, at))}\n" for n, (kind, group, at) in enumerate(elements, 1))
    names = ['2 1 "fault"'] * fault + ['2 2 "west"', '2 3 "others"', '3 4 "rock"']
    return ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + "\n".join([str(len(names)), *names]) + "\n$EndPhysicalNames\n"
            f"$Nodes\n{count}\n{nodes}$EndNodes\n$Elements\n{len(elements)}\n{lines}$EndElements\n")


def box_of_tetrahedra(turn, size=(1, 1, 1), cells=(4, 3, 3), moved=0.0, seed=3):
    """A gmsh file (2.2) of a box of six tetrahedra in the place of each brick, turned; nodes inside are moved at random. All six sides have their names."""
    grid = np.stack(np.meshgrid(*(np.linspace(0, 1, n + 1) for n in cells), indexing="ij"), -1)
    moves = np.random.default_rng(seed).uniform(-moved, moved, grid.shape) / cells
    for axis in range(3):
        np.moveaxis(moves, axis, 0)[[0, -1]] = 0
    grid = ((grid + moves) * size) @ turn.T
    number = np.arange(1, grid[..., 0].size + 1).reshape(grid.shape[:3])
    elements = []
    for at in np.ndindex(*cells):  # along the ways from one corner to the opposite one (Kuhn)
        for order in itertools.permutations(range(3)):
            corners = [np.array(at)]
            for axis in order:
                corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
            elements.append((4, 7, [number[tuple(corner)] for corner in corners]))
    for axis in range(3):
        for end, group in ((0, 2 * axis + 1), (cells[axis], 2 * axis + 2)):
            sheet = np.take(number, end, axis)
            for i, j in np.ndindex(sheet.shape[0] - 1, sheet.shape[1] - 1):
                for middle in ((1, 0), (0, 1)):
                    elements.append((2, group, [sheet[i, j], sheet[i + middle[0], j + middle[1]], sheet[i + 1, j + 1]]))
    nodes = "".join("{} {!r} {!r} {!r}\n".format(k, *map(float, x)) for k, x in zip(number.ravel(), grid.reshape(-1, 3)))
    lines = "".join(f"{n} {kind} 2 {group} {group} {' '.join(map(str, at))}\n" for n, (kind, group, at) in enumerate(elements, 1))
    names = [f'2 {k} "{side}"' for k, side in enumerate(("left", "right", "front", "back", "bottom", "top"), 1)] + ['3 7 "rock"']
    return ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + "\n".join([str(len(names)), *names]) + "\n$EndPhysicalNames\n"
            f"$Nodes\n{number.size}\n{nodes}$EndNodes\n$Elements\n{len(elements)}\n{lines}$EndElements\n")
