"""Results files as xarray opens them without the package: dimensions, coordinates, units."""

import os
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path

import h5py
import numpy as np
import xarray

FRAME = """\
  {name}:
    frame:
      origin: [{x}, 0]
      material: {{E: 30 GPa}}
      grid: {{storeys: 2, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: {{rectangle: [0.4, 0.4]}}, beams: {{rectangle: [0.3, 0.5]}}, floor_mass: {mass} t}}
      hinges: {{beams: {{at: both, yield_moment: 60 kN m, hardening: 2 %}}}}
      report: {{members: [column 1.0], nodes: all}}
    damping: 5 %
"""
#: Colliding frames that yield, with a device, and the run without links.
FRAMES = (
    "title: Two frames\nground_motion: {harmonic: {amplitude: 8.0, period: 0.5 s, duration: 1.0 s}}\nstructures:\n"
    + FRAME.format(name="left", x=0, mass=40)
    + FRAME.format(name="right", x=6.005, mass=20)
    + "links: [{between: [left, right], floors: all, law: hertz_damped, stiffness: 1e9, restitution: 0.65}]\n"
    "compare: no_pounding\nanalysis: {duration: 1.0 s, tolerance: 1e-4, output_step: 10 ms}\n"
)
#: Bodies, without storeys, with a device.
BODIES = """\
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 1.0}}
structures:
  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
links: [{between: [left, right], gap: 10 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.65}]
devices:
  damper: {between: [left, right], damper: {coefficient: 200 kN (s/m)^0.5, exponent: 0.5, stiffness: 5 MN/m}}
analysis: {duration: 1.0, output_step: 10 ms}
"""


class DataTree(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.frames, cls.bodies = cls.run_model("frames", FRAMES), cls.run_model("bodies", BODIES)

    @classmethod
    def run_model(cls, name, model):
        """The path of the results of a model."""
        (cls.folder / f"{name}.yaml").write_text(model)
        out = cls.folder / f"{name}.h5"
        done = subprocess.run(
            [os.environ["POUNDING_PROGRAM"], "run", f"{name}.yaml", "-o", out],
            cwd=cls.folder,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        return out

    def tree(self, path):
        """The whole file; a dimension without a name would be a warning."""
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            tree = xarray.open_datatree(path, engine="h5netcdf")
        self.addCleanup(tree.close)
        return tree.load()

    def test_floors_have_times_names_elevations_and_directions(self):
        left = self.tree(self.frames)["structures/left"]
        self.assertEqual(left.displacement.dims, ("time", "floor", "direction"))
        self.assertEqual(left.storey_shear.dims, ("time", "floor"))
        self.assertEqual(left.floor.values.tolist(), ["1", "2"])
        self.assertEqual(left.direction.values.tolist(), ["x"])
        self.assertEqual(left.coords["elevation"].dims, ("floor",))
        np.testing.assert_allclose(left.elevation, [3.2, 6.4])
        self.assertEqual((left.displacement.units, left.time.units), ("m", "s"))
        self.assertEqual(left.acceleration.long_name, "absolute acceleration")
        with h5py.File(self.frames) as file:
            np.testing.assert_array_equal(left.time, file["time"])
            second = file["structures/left/displacement"][:, 1, 0]
        np.testing.assert_array_equal(left.displacement.sel(floor="2", direction="x"), second)

    def test_nodes_members_supports_and_springs_are_selected_by_name(self):
        tree = self.tree(self.frames)
        left = tree["structures/left"]
        for place, name, dims in (
            ("nodes", "displacement", ("time", "node", "node_direction")),
            ("members", "end_forces", ("time", "member", "component")),
            ("reactions", "force", ("time", "support", "support_direction")),
            ("springs", "force", ("time", "spring")),
            ("springs/summary", "ductility", ("spring",)),
            ("geometry", "nodes", ("node", "axis")),
        ):
            array = left[place][name]
            self.assertEqual(array.dims, dims, place)
            if place != "geometry":
                names = array[dims[-2] if dims[-1] != "spring" else "spring"].values
                self.assertTrue(all(isinstance(one, str) for one in names.tolist()), place)
        forces = tree["envelopes/structures/left"].member_force
        self.assertEqual(forces.dims, ("member", "component", "extreme"))
        member = left["members/member"].values[0]
        history = left["members"].end_forces.sel(member=member, component="start N")
        self.assertGreaterEqual(forces.sel(member=member, component="start N", extreme="maximum"), history.max() - 1)

    def test_links_and_energies_have_their_own_times(self):
        tree = self.tree(self.frames)
        link = next(iter(tree["links"].children.values()))
        self.assertEqual(link.penetration.dims, ("time",))
        self.assertNotEqual(link.sizes["time"], tree["ground"].sizes["time"])
        self.assertEqual(tree["energy"].input.dims, ("time",))
        self.assertEqual(tree["energy"].input.units, "J")

    def test_the_run_without_links_has_the_same_dimensions(self):
        tree = self.tree(self.frames)
        without = tree["no_pounding/structures/left"]
        self.assertEqual(without.displacement.dims, ("time", "floor", "direction"))
        np.testing.assert_array_equal(without.time, tree["structures/left"].time)
        with h5py.File(self.frames) as file:
            for dimension in file["no_pounding/structures/left/displacement"].dims:
                self.assertTrue(dimension[0].name.startswith("/no_pounding"), dimension[0].name)

    def test_impacts_are_a_table(self):
        tree = self.tree(self.frames)
        self.assertEqual(tree["impacts"].dims, ("impact",))
        self.assertGreater(tree.sizes["impact"], 0)
        self.assertGreater(tree["impacts"].values["peak_force"].min(), 0)

    def test_bodies_and_devices_are_read(self):
        tree = self.tree(self.bodies)
        self.assertEqual(tree["structures/left"].displacement.sizes["floor"], 1)
        self.assertEqual(tree["devices/damper"].force.dims, ("time",))
        self.assertEqual(tree["devices/damper/envelope"].force.extreme.values.tolist(), ["minimum", "maximum"])

    def test_every_array_names_its_dimensions(self):
        unnamed = []

        def visit(name, item):
            if isinstance(item, h5py.Dataset) and item.ndim > 0 and not item.is_scale:
                unnamed.extend(name for dimension in item.dims if len(dimension) != 1)

        for path in (self.frames, self.bodies):
            with h5py.File(path) as file:
                file.visititems(visit)
        self.assertEqual(unnamed, [])


if __name__ == "__main__":
    unittest.main()
