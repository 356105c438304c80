#!/usr/bin/python3
"""tools/python against files of VTK's own writer, and tools/plot on a folder of results."""

import subprocess
import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_QUAD, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/python"))
import sprekk  # noqa: E402

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) / 3
TRIANGLES = ((0, 1, 2), (0, 2, 3))
LINES = ((2, 1), (0, 2))  # out of order: the chain is 0, 2, 1


def write_vtu(path, kinds, cells, cell_data, point_data, corners=POINTS):
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(corners.astype(float)))
    grid.SetPoints(points)
    for kind, cell in zip(kinds, cells):
        grid.InsertNextCell(kind, len(cell), cell)
    for target, arrays in ((grid.GetCellData(), cell_data), (grid.GetPointData(), point_data)):
        for name, values in arrays.items():
            array = numpy_to_vtk(np.asarray(values))
            array.SetName(name)
            target.AddArray(array)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt64()
    assert writer.Write() == 1


def write_results(folder):
    """Two written times of two triangles and a fracture of two cells."""
    for name, kind, cells in (("matrix", VTK_TRIANGLE, TRIANGLES), ("fractures", VTK_LINE, LINES)):
        entries = ""
        for step in range(2):
            number = np.array([step + 1 / 3, step + 2.0])
            data = {"a.pressure[Pa]": number, "a.state[1]": number, "fracture": np.zeros(2, np.int32)}
            if name == "fractures":
                data["a.jump[m]"] = np.outer(number, [1, 2, 0])
            write_vtu(folder / f"{name}_{step}.vtu", (kind, kind), cells, data, {"a.displacement[m]": POINTS * (step + 1)})
            entries += f'<DataSet timestep="{step * 7200}" file="{name}_{step}.vtu"/>'
        (folder / f"{name}.pvd").write_text(f'<VTKFile type="Collection"><Collection>{entries}</Collection></VTKFile>')
    (folder / "history.csv").write_text('time[s],p[Pa],note,q[1]\n0,1,"a, b",\n7200,0.1,c,3\n')


class Results(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.folder = Path(self.holder.name)
        write_results(self.folder)

    def tearDown(self):
        self.holder.cleanup()

    def test_vtu_is_read_to_the_bit(self):
        grid = sprekk.read_vtu(self.folder / "fractures_1.vtu")
        np.testing.assert_array_equal(grid.points, POINTS)
        np.testing.assert_array_equal(grid.cells, LINES)
        np.testing.assert_array_equal(grid.cell_data["a.pressure[Pa]"], [1 + 1 / 3, 3])
        np.testing.assert_array_equal(grid.cell_data["a.jump[m]"][1], [3, 6, 0])
        np.testing.assert_array_equal(grid.point_data["a.displacement[m]"], POINTS * 2)

    def test_triangles_beside_quadrilaterals(self):
        path = self.folder / "mixed.vtu"
        points, cells = np.array([[0, 0, 0], [2, 0, 0], [1, 1, 0], [0, 1, 0], [3, 1, 0]]), ((0, 1, 2, 3), (1, 4, 2))
        write_vtu(path, (VTK_QUAD, VTK_TRIANGLE), cells, {"a.p[Pa]": np.array([3.0, 5.0])}, {}, points)
        grid = sprekk.read_vtu(path)
        np.testing.assert_array_equal(grid.cells, [[0, 1, 2, 3], [1, 4, 2, 2]])
        triangles, cell = grid.triangles()
        np.testing.assert_array_equal(triangles, [[0, 1, 2], [1, 4, 2], [0, 2, 3]])
        np.testing.assert_array_equal(cell, [0, 1, 0])
        # A trapezoid with parallel sides 2 and 1: its centre is at 4/9 of the height, 7/9 along.
        centres, sizes = grid.centres_and_sizes()
        np.testing.assert_allclose(sizes, [1.5, 1], rtol=1e-15)
        np.testing.assert_allclose(centres[:, :2], [[7 / 9, 4 / 9], [2, 2 / 3]], rtol=1e-15)

    def test_cells_of_a_fracture_follow_one_another(self):
        grid = sprekk.read_vtu(self.folder / "fractures_0.vtu")
        along, cells = sprekk.chain(grid, np.arange(2))
        np.testing.assert_array_equal(cells, [1, 0])
        np.testing.assert_allclose(along, [2**0.5 / 6, 2**0.5 / 3 + 1 / 6], rtol=1e-15)

    def test_index_and_table(self):
        self.assertEqual([time for time, _ in sprekk.read_pvd(self.folder / "matrix.pvd")], [0, 7200])
        table = sprekk.read_table(self.folder / "history.csv")
        np.testing.assert_array_equal(table["p[Pa]"], [1, 0.1])
        np.testing.assert_array_equal(table["q[1]"], [np.nan, 3])
        self.assertEqual(table["note"], ["a, b", "c"])

    def test_every_picture_is_drawn(self):
        done = subprocess.run([ROOT / "tools/plot", self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("mesh", "matrix_a_pressure", "matrix_a_displacement_length", "fractures_a_pressure", "fractures_a_jump", "history"):
            picture = (self.folder / "plots" / f"{name}.png").read_bytes()
            self.assertTrue(picture.startswith(b"\x89PNG"), name)

    def test_one_time_is_the_last(self):
        spec = spec_from_loader("plot", SourceFileLoader("plot", str(ROOT / "tools/plot")))
        plot = module_from_spec(spec)
        spec.loader.exec_module(plot)
        for count, times in ((1, [7]), (2, [0, 7]), (3, [0, 4, 7]), (20, list(range(8)))):
            self.assertEqual(plot.choose(list(range(8)), count), times)

    def test_paths_beyond_the_mesh_are_drawn(self):
        def drawn():
            subprocess.run([ROOT / "tools/plot", self.folder], capture_output=True, check=True)
            return (self.folder / "plots/matrix_a_pressure.png").read_bytes()

        def add_path(time):
            write_vtu(self.folder / "paths_1.vtu", (VTK_LINE,), ((0, 1),), {"fracture": np.zeros(1, np.int32)}, {},
                      np.array([[0.1, 0.3, 0], [0.2, 0.2, 0]]))
            (self.folder / "paths.pvd").write_text(
                f'<VTKFile type="Collection"><Collection><DataSet timestep="{time}" file="paths_1.vtu"/></Collection></VTKFile>')

        without = drawn()
        self.assertEqual(drawn(), without)
        add_path(0)  # another time than that of the map
        self.assertEqual(drawn(), without)
        add_path(7200)
        self.assertNotEqual(drawn(), without)

    def test_fractures_are_coloured_on_the_map(self):
        def plot(field):
            return subprocess.run([ROOT / "tools/plot", self.folder, "--on-map", field], capture_output=True, text=True)

        def colours():
            picture = plt.imread(self.folder / "plots/on_map_a_pressure.png")[:, :, :3].reshape(-1, 3)
            return lambda colour: (np.abs(picture - np.array(colour[:3])).max(axis=1) < 0.01).sum()

        self.assertEqual(plot("a.pressure").returncode, 0)
        # One cell has the least value and the other the largest: beside the bar, which has an end no more often than
        # its middle, these alone are seen.
        count = colours()
        first, middle, last = (count(plt.get_cmap("viridis")(share)) for share in (0.0, 0.5, 1.0))
        self.assertGreater(min(first, last), 1.5 * middle, (first, middle, last))
        wrong = plot("a.presure")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("fractures have no field a.presure (they have: a.pressure", wrong.stderr)

    def film(self, *fields):
        return subprocess.run([ROOT / "tools/plot", self.folder, "--film", *fields], capture_output=True, text=True)

    def test_films_have_a_frame_for_each_time_in_the_same_colours(self):
        done = self.film("a.pressure", "a.displacement length")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("film_a_pressure", "film_a_displacement_length"):
            with Image.open(self.folder / f"plots/{name}.gif") as film:
                self.assertGreaterEqual(film.n_frames, 2)
                frames = []
                for i in range(film.n_frames):
                    film.seek(i)
                    frames.append(np.asarray(film.convert("RGB")).astype(int))
                self.assertLess(film.n_frames, 40)
            # Values grow by as much as the range: the frames differ, and the bar at the right does not.
            self.assertGreater(abs(frames[0] - frames[-1]).max(), 50)
            right = frames[0].shape[1] * 9 // 10
            self.assertLess(abs(frames[0][:, right:] - frames[-1][:, right:]).max(), 40, name)
        self.assertFalse((self.folder / "plots/mesh.png").exists())
        wrong = self.film("a.presure")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("there is no field a.presure (there are: a.displacement length, a.jump length", wrong.stderr)

    def test_names_of_fractures_are_drawn(self):
        def drawn():
            subprocess.run([ROOT / "tools/plot", self.folder, "--on-map", "a.pressure"], capture_output=True, check=True)
            return (self.folder / "plots/on_map_a_pressure.png").read_bytes()

        without = drawn()
        (self.folder / "run.json").write_text('{"scene": {"fractures": ["fault"]}}')
        self.assertNotEqual(drawn(), without)

    def test_a_folder_without_results_is_refused(self):
        done = subprocess.run([ROOT / "tools/plot", ROOT / "tools"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("holds no results", done.stderr)


if __name__ == "__main__":
    unittest.main()
