"""`run.data`: groups and arrays of a results file with the dimensions, coordinates and units of the file."""

import os
import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from messages import raises
from pounding import _data
from pounding.results import NotResults, RunData

WRITER = os.environ["POUNDING_RESULTS_WRITER"]
WITHOUT_VALUES = "This is a netCDF dimension but not a netCDF variable.         3"


def write_sample(path):
    """Dimension scales as in netCDF: own and inherited ones, one without values, a further coordinate, and a table."""
    with h5py.File(path, "w", userblock_size=512) as file:
        file["time"] = np.arange(3.0)
        file["time"].make_scale(WITHOUT_VALUES)
        tower = file.create_group("structures/tower")
        tower["time"] = np.arange(3.0)
        tower["floor"] = np.array([b"1", b"r\xc3\xa4nge"])
        tower["elevation"] = [3.0, 6.0]
        tower["displacement"] = np.arange(6.0).reshape(3, 2)
        tower.attrs["coordinates"] = "elevation"
        nodes = tower.create_group("nodes")
        nodes["velocity"] = np.arange(3.0)
        for name in ("time", "floor"):
            tower[name].make_scale(name)
        for array, dimensions in (("displacement", ["time", "floor"]), ("elevation", ["floor"])):
            for i, name in enumerate(dimensions):
                tower[array].dims[i].attach_scale(tower[name])
        nodes["velocity"].dims[0].attach_scale(tower["time"])
        tower["displacement"].attrs.update({"units": "m", "long_name": "relative to the ground"})
        link = file.create_group("links/a-b")
        link["time"] = np.arange(5.0)  # longer than that of the structures
        link["time"].make_scale("time")
        link["force"] = np.arange(5.0)
        link["force"].dims[0].attach_scale(link["time"])
        rows = np.array([(b"a-b", 0.5), (b"a-b", 1.5)], dtype=[("link", "S3"), ("t_start", "f8")])
        file["impacts"] = rows
        file["impacts"].attrs.update({"units": ["text", "s"], "field_long_names": ["name of the link", "touch"]})
        file["impact"] = np.zeros(2)
        file["impact"].make_scale(WITHOUT_VALUES)
        file["impacts"].dims[0].attach_scale(file["impact"])


class Sample(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "sample.h5"
        write_sample(self.path)
        self.file = h5py.File(self.path, "r")
        self.addCleanup(self.file.close)
        self.data = _data.Data(self.file)

    def check(self, data):
        """Access that our class and xarray share."""
        displacement = data["structures/tower/displacement"]
        self.assertEqual(displacement.dims, ("time", "floor"))
        self.assertEqual(displacement.attrs, {"units": "m", "long_name": "relative to the ground"})
        np.testing.assert_array_equal(displacement.values, np.arange(6.0).reshape(3, 2))
        np.testing.assert_array_equal(displacement[1:, 0], [2.0, 4.0])
        self.assertEqual(displacement.coords["floor"].values.tolist(), ["1", "ränge"])
        self.assertEqual(data["structures/tower/nodes/velocity"].dims, ("time",))
        np.testing.assert_array_equal(data["structures/tower"].coords["elevation"].values, [3.0, 6.0])
        self.assertEqual(set(data["structures/tower"].data_vars), {"displacement"})
        self.assertEqual(dict(data["links/a-b"].dims), {"time": 5})
        self.assertEqual(data["impacts/link"].values.tolist(), ["a-b", "a-b"])
        self.assertEqual((data["impacts/t_start"].dims, data["impacts/t_start"].attrs["units"]), (("impact",), "s"))
        self.assertEqual(set(data.children), {"structures", "links", "impacts"})
        self.assertNotIn("time", data.data_vars)  # it has the marks of a dimension without values

    def test_our_class(self):
        self.check(self.data)
        self.assertIn("links/a-b/force", self.data)
        self.assertEqual(len(self.data), len(list(self.data)))
        with raises(KeyError, ["b-c", "a-b"]):
            self.data["links/b-c"]
        text = repr(self.data)
        self.assertIn("displacement (time: 3, floor: 2) [m] relative to the ground", text)
        self.assertIn("displacement", self.data._repr_html_())

    def test_tree_of_xarray(self):
        tree = _data.to_datatree(self.data)
        self.check(tree)
        self.assertEqual(float(tree["structures/tower/displacement"].sel(time=2.0, floor="1")), 4.0)

    def test_values_are_read_on_demand(self):
        read = _data.DataArray.__getitem__
        names = []

        def counted(array, key):
            names.append(array.name)
            return read(array, key)

        with mock.patch.object(_data.DataArray, "__getitem__", counted):
            tree = _data.to_datatree(self.data)
            self.assertNotIn("displacement", names)
            self.assertNotIn("force", names)
            tree["links/a-b/force"].values
        self.assertIn("force", names)
        self.assertNotIn("displacement", names)


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "run.h5"
        subprocess.run([WRITER, "towers", self.path], check=True)
        self.run_ = RunData.read(self.path)

    def test_every_array_of_the_file_is_there(self):
        with h5py.File(self.path) as file:
            count = 0
            for path, group in _data.Data(file).subtree():
                for name, array in {**group.data_vars, **group.coords}.items():
                    found = self.run_.data[f"{path}/{name}".strip("/")]
                    if array.dtype.kind == "f":
                        np.testing.assert_array_equal(found.values, array.values)
                        self.assertEqual(found.attrs.get("units"), array.attrs.get("units"))
                        count += 1
            self.assertGreater(count, 30)

    def test_without_xarray_it_is_our_class(self):
        with mock.patch.dict(sys.modules, {"xarray": None}):
            self.assertIsInstance(self.run_.data, _data.Data)

    def test_a_changed_file_is_refused(self):
        self.path.write_bytes(self.path.read_bytes()[:-1])
        with self.path.open("r+b") as file:
            file.write(b"other results")
        with raises(NotResults, ["run.h5", "changed"]):
            self.run_.data

    def test_copies_open_the_file_again(self):
        self.run_.data
        copied = pickle.loads(pickle.dumps(self.run_))
        np.testing.assert_array_equal(copied.data["energy/input"].values, self.run_.data["energy/input"].values)


if __name__ == "__main__":
    unittest.main()
