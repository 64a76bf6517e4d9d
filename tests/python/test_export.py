"""Exports as read by an XDMF reader: every selection is followed into the HDF5 files and compared with the run."""

import os
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np

import frame_samples
from sealed import seal
from pounding import _export as export
from pounding._runs import read
from pounding._pictures.geometry import node_displacements
from pounding._pictures.scene import Scene
from pounding._pictures.style import BadRequest
from messages import assert_mentions, raises

PROGRAM = os.environ["POUNDING_PROGRAM"]
WRITER = os.environ["POUNDING_RESULTS_WRITER"]


def follow(item, directory):
    """The array of a DataItem."""
    if item.get("ItemType") == "HyperSlab":
        choice, source = item.findall("DataItem")
        start, stride, count = np.array(choice.text.split(), int).reshape(3, -1)
        whole = follow(source, directory)
        selected = whole[tuple(slice(a, a + n * s, s) for a, s, n in zip(start, stride, count))]
        return selected.reshape(dimensions(item))
    file, place = item.text.split(":")
    with h5py.File(directory / file) as data:
        values = data[place][:]
    assert values.shape == dimensions(item)
    assert values.dtype.kind == {"Float": "f", "Int": "i"}[item.get("NumberType")]
    assert values.dtype.itemsize == int(item.get("Precision"))
    return values


def dimensions(item):
    return tuple(map(int, item.get("Dimensions").split()))


class Exports(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        self.results = self.directory / "run.h5"

    def grids(self, step, place=None):
        """{structure: {quantity: array}} at one time."""
        path = (place or self.directory) / "out.xdmf"
        steps = {
            series.get("Name"): series.findall("Grid")[step]
            for series in ElementTree.parse(path).getroot().findall("Domain/Grid")
        }
        times = {float(one.find("Time").get("Value")) for one in steps.values()}
        self.assertEqual(len(times), 1)
        self.time = times.pop()
        return {
            name: {
                "points": follow(one.find("Geometry/DataItem"), path.parent),
                "lines": follow(one.find("Topology/DataItem"), path.parent),
                **{a.get("Name"): follow(a.find("DataItem"), path.parent) for a in one.findall("Attribute")},
            }
            for name, one in steps.items()
        }

    def export(self, dimension=2, place=None, **options):
        frame_samples.write(self.results, dimension, **options)
        run = read(self.results)
        export.export(self.results, run, (place or self.directory) / "out.xdmf")
        return run

    def check(self, run, step=37, place=None):
        grids = self.grids(step, place)
        self.assertEqual(set(grids), set(run.structures))
        self.assertEqual(self.time, run.time[step])
        scene = Scene(run)
        for name, structure in run.structures.items():
            np.testing.assert_allclose(grids[name]["points"], scene.at_rest(name))
            np.testing.assert_array_equal(grids[name]["lines"], scene.line_models[name].members)
            np.testing.assert_allclose(
                grids[name]["displacement"], node_displacements(structure, scene.line_models[name])[step]
            )
        return grids

    def test_frames_in_space_point_into_the_results(self):
        run = self.export(3)
        grids = self.check(run)
        np.testing.assert_array_equal(grids["low"]["end Mz"], run.structures["low"].members.end_forces[37, :, 11])
        with h5py.File(self.directory / "out.data.h5") as data:
            self.assertEqual(set(data["low"]), {"points", "members", "axial_force"})
        np.testing.assert_array_equal(grids["low"]["axial force"], run.structures["low"].members.axial_force[37])

    def test_what_does_not_fit_stands_in_a_second_file(self):
        run = self.export(2, wall=True, nodes=5)
        grids = self.check(run)
        np.testing.assert_array_equal(grids["tall"]["start My"], run.structures["tall"].members.end_forces[37, :, 2])

    def test_members_that_were_not_asked_for_are_not_numbers(self):
        frame_samples.write(self.results, 2)
        with h5py.File(self.results, "a") as file:
            group = file["structures/tall/members"]
            forces = group["end_forces"][:][:, [4, 2]]
            components = group["end_forces"].attrs["components"]
            del group["end_forces"], group["names"]
            group["end_forces"] = forces
            group["end_forces"].attrs["components"] = components
            group["names"] = ["m4", "m2"]
        seal(self.results)
        export.export(self.results, read(self.results), self.directory / "out.xdmf")
        shown = self.grids(37)["tall"]["end N"]
        np.testing.assert_array_equal(np.flatnonzero(np.isfinite(shown)), [2, 4])
        np.testing.assert_array_equal(np.flatnonzero(np.isfinite(self.grids(37)["tall"]["axial force"])), [2, 4])
        np.testing.assert_array_equal(shown[[4, 2]], forces[37, :, 3])

    def test_sticks_are_exported(self):
        subprocess.run([WRITER, "towers", self.results], check=True)
        run = read(self.results)
        export.export(self.results, run, self.directory / "out.xdmf")
        self.check(run, 1234)

    def test_paths_hold_from_another_directory(self):
        place = self.directory / "elsewhere"
        place.mkdir()
        self.check(self.export(3, place), place=place)

    def test_results_are_not_overwritten(self):
        self.results = self.directory / "out.data.h5"
        with raises(BadRequest):
            self.export(2)
        self.assertEqual(read(self.results).status, "done")

    def test_command_writes_into_the_current_folder_and_names_its_files(self):
        frame_samples.write(self.results, 3)
        place = self.directory / "elsewhere"
        place.mkdir()
        done = subprocess.run([PROGRAM, "export", self.results], capture_output=True, text=True, cwd=place)
        self.assertEqual(
            (done.returncode, done.stdout, done.stderr), (0, "export       run.xdmf\nexport       run.data.h5\n", "")
        )
        self.assertEqual(sorted(path.name for path in place.iterdir()), ["run.data.h5", "run.xdmf"])
        self.assertFalse((self.directory / "run.xdmf").exists())
        done = subprocess.run([PROGRAM, "export", self.results, "-o", "x.vtk"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, "x.vtk")


try:
    from vtkmodules import vtkCommonExecutionModel, vtkIOXdmf2
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError:
    vtkIOXdmf2 = None


@unittest.skipUnless(vtkIOXdmf2, "the reader of ParaView is not installed (python3 -m pip install vtk)")
class ReaderOfParaView(Exports):
    """Exports as VTK reads them."""

    def grids(self, step, place=None):
        reader = vtkIOXdmf2.vtkXdmfReader()
        reader.SetFileName(str((place or self.directory) / "out.xdmf"))
        reader.UpdateInformation()
        times = reader.GetOutputInformation(0).Get(
            vtkCommonExecutionModel.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        )
        reader.UpdateTimeStep(times[step])
        self.time = times[step]
        blocks = reader.GetOutputDataObject(0)
        found = {}
        for i in range(blocks.GetNumberOfBlocks()):
            grid, cells = blocks.GetBlock(i), blocks.GetBlock(i).GetCellData()
            name = blocks.GetMetaData(i).Get(blocks.NAME())
            found[name] = {
                "points": vtk_to_numpy(grid.GetPoints().GetData()),
                "lines": vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 2),
                "displacement": vtk_to_numpy(grid.GetPointData().GetArray("displacement")),
            }
            found[name] |= {
                cells.GetArrayName(j): vtk_to_numpy(cells.GetArray(j)) for j in range(cells.GetNumberOfArrays())
            }
        return found


if __name__ == "__main__":
    unittest.main()
