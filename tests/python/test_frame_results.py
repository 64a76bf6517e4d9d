"""Frames in the results file as returned by pounding.results, and the positions of their nodes."""

import dataclasses
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import frame_samples
from pounding._runs import read
from pounding._pictures.geometry import line_model, nearest_on_members, node_displacements
from pounding._pictures.scene import Motion, Scene
from messages import raises

WRITER = os.environ["POUNDING_RESULTS_WRITER"]


class Samples(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.path = Path(directory.name) / "run.h5"

    def read(self, dimension=2, **options):
        frame_samples.write(self.path, dimension, **options)
        return read(self.path)

    def read_old(self, kind):
        subprocess.run([WRITER, kind, self.path], check=True)
        with h5py.File(self.path, "a") as file:
            for structure in file["structures"].values():
                del structure["base_shear"]
                for name in ("kind", "dimension", "elevations", "directions"):
                    del structure.attrs[name]
            for link in file["links"].values():
                for name in ("left_end", "right_end", "position", "direction"):
                    del link.attrs[name]
        return read(self.path, checked=False)


class Reading(Samples):
    def test_plane_frame_is_read_whole(self):
        tall = self.read(2).structures["tall"]
        self.assertEqual((tall.kind, tall.dimension, tall.directions), ("frame", 2, ["x"]))
        np.testing.assert_allclose(tall.elevations, [3.2, 6.4, 9.6, 12.8, 16])
        self.assertEqual(tall.geometry.nodes.shape, (18, 3))
        self.assertEqual(tall.geometry.node_names[4], "1.1")
        np.testing.assert_array_equal(tall.geometry.floor_of_node[:6], [-1, -1, -1, 0, 0, 0])
        self.assertEqual(tall.nodes.directions, ["x", "z", "ry"])
        self.assertEqual(tall.members.components[:2], ["start N", "start Vz"])
        self.assertEqual(tall.members.end_forces.shape, (201, len(tall.geometry.members), 6))

    def test_directions_of_a_frame_in_space_do_not_mix(self):
        tall = self.read(3).structures["tall"]
        motion = frame_samples.sway("tall")
        self.assertEqual(tall.directions, ["x", "y", "rz"])
        for axis in ("x", "y", "rz"):
            np.testing.assert_allclose(tall.along[axis].displacement[:, -1], motion[axis], atol=1e-15)
        np.testing.assert_allclose(tall.along["y"].drift.sum(axis=1), motion["y"], atol=1e-15)
        np.testing.assert_allclose(tall.along["y"].base_shear, tall.along["y"].storey_shear[:, 0])
        self.assertEqual(tall.along["rz"].drift.shape, (201, 0))
        self.assertIsNone(tall.along["rz"].base_shear)

    def test_rigid_floors_have_rotations_and_edges(self):
        tall = self.read(3, rigid=True).structures["tall"]
        np.testing.assert_allclose(tall.rotation[:, -1], frame_samples.sway("tall")["rz"], atol=1e-15)
        nodes = frame_samples.grid(3, 5, 0)[0]
        moved = frame_samples.displacement_of("tall", nodes, 5, 3)
        roof = np.flatnonzero(nodes[:, 2] == 16)
        for edge, (axis, across, place) in enumerate(((0, 1, 0), (0, 1, 4), (1, 0, 0), (1, 0, 10))):
            node = next(node for node in roof if nodes[node, across] == place)
            np.testing.assert_allclose(tall.edge_displacement[:, -1, edge], moved[:, node, axis], atol=1e-15)
        run = self.read(3)
        self.assertIsNone(run.structures["tall"].rotation)
        self.assertIsNone(run.structures["tall"].edge_displacement)
        self.assertEqual(run.ground_across, {})

    def test_internal_forces_have_one_sign_at_both_ends(self):
        run = self.read(3)
        forces, envelope = run.structures["tall"].members, run.envelopes["tall"]
        np.testing.assert_array_equal(forces.section_forces[:, :, :6], -forces.end_forces[:, :, :6])
        np.testing.assert_array_equal(forces.section_forces[:, :, 6:], forces.end_forces[:, :, 6:])
        self.assertEqual(forces.axial_force.shape, forces.end_forces.shape[:2])
        np.testing.assert_array_equal(forces.axial_force, forces.end_forces[:, :, 6])  # the larger one here
        low, high = envelope.member("m1")["start N"]
        self.assertEqual(envelope.section("m1")["start N"], (-high, -low))
        self.assertEqual(envelope.section("m1")["end N"], envelope.member("m1")["end N"])
        np.testing.assert_array_equal(
            envelope.axial_force.min, np.minimum(-envelope.member_force.max[:, 0], envelope.member_force.min[:, 6])
        )
        np.testing.assert_array_equal(
            envelope.axial_force.max, np.maximum(-envelope.member_force.min[:, 0], envelope.member_force.max[:, 6])
        )
        np.testing.assert_array_equal(envelope.section_force.times[:, 0], envelope.member_force.times[:, 0, ::-1])
        with raises(KeyError):
            envelope.section("x")
        self.assertIsNone(forces.gravity_included)

    def test_links_have_a_place(self):
        run = self.read(3)
        link = run.links["tall.2-low.2.b"]
        np.testing.assert_allclose(link.position, [10 + frame_samples.GAP / 2, 4, 6.4])
        np.testing.assert_array_equal(link.direction, [1, 0, 0])
        self.assertEqual((link.left_end, link.right_end), ("floor 2", "floor 2"))
        np.testing.assert_allclose(link.friction[:, 0], 0.3 * link.force)

    def test_older_files_are_read_as_before(self):
        run = self.read_old("towers")
        stiff = run.structures["stiff"]
        self.assertEqual((stiff.dimension, stiff.directions), (1, ["x"]))
        self.assertEqual(stiff.displacement.shape, (1601, 6))
        self.assertEqual(stiff.storey_shear.shape, (1601, 6))
        self.assertTrue(np.isnan(stiff.elevations).all())
        self.assertIsNone(stiff.geometry)
        link = run.links["slender.6-stiff.6"]
        self.assertIsNone(link.position)
        self.assertEqual((link.left_end, link.friction), ("floor 6", None))

    def test_wall_has_nothing_but_its_name(self):
        self.assertTrue(self.read(2, wall=True).structures["wall"].is_wall)


class Nodes(Samples):
    def moved(self, dimension, **options):
        run = self.read(dimension, **options)
        return {name: node_displacements(s, line_model(s)) for name, s in run.structures.items()}

    def expected(self, dimension):
        nodes = {
            name: frame_samples.grid(
                dimension, storeys, 0 if name == "tall" else 2 * frame_samples.BAY + frame_samples.GAP
            )[0]
            for name, storeys in (("tall", 5), ("low", 3))
        }
        return {
            name: frame_samples.displacement_of(name, nodes[name], {"tall": 5, "low": 3}[name], dimension)
            for name in nodes
        }

    def test_nodes_in_the_file_are_taken_as_they_are(self):
        for dimension in (2, 3):
            for name, moved in self.expected(dimension).items():
                np.testing.assert_allclose(self.moved(dimension)[name], moved, atol=1e-15)

    def test_nodes_rotate_about_the_point_whose_motion_is_reported(self):
        # The motion at a point 1 m and 0.5 m away from the mean of the nodes, for example a centre of mass.
        run = self.read(3, nodes="none", rigid=True)
        tall = run.structures["tall"]
        turn = tall.along["rz"].displacement
        moved = {"x": tall.along["x"].displacement - 0.5 * turn, "y": tall.along["y"].displacement + 1.0 * turn}
        tall = dataclasses.replace(
            tall,
            plan=tall.plan - [1, 1, 0.5, 0.5],
            along={
                **tall.along,
                **{axis: dataclasses.replace(tall.along[axis], displacement=values) for axis, values in moved.items()},
            },
        )
        np.testing.assert_allclose(tall.centre(0), [6, 2.5])
        np.testing.assert_allclose(node_displacements(tall, line_model(tall)), self.expected(3)["tall"], atol=1e-15)
        np.testing.assert_allclose(
            tall.edge_displacement,
            frame_samples.edges_of(
                np.stack([run.structures["tall"].along[axis].displacement for axis in ("x", "y", "rz")], axis=-1)
            ),
            atol=1e-15,
        )

    def test_nodes_follow_rigid_floors_that_turn(self):
        for dimension in (2, 3):
            for name, moved in self.expected(dimension).items():
                np.testing.assert_allclose(self.moved(dimension, nodes="none")[name], moved, atol=1e-15)

    def test_nodes_that_were_not_asked_for_follow_their_floor(self):
        for name, moved in self.expected(3).items():
            np.testing.assert_allclose(self.moved(3, nodes=7)[name], moved, atol=1e-15)

    def test_reported_node_goes_before_its_floor(self):
        run = self.read(2, nodes=7)
        tall = run.structures["tall"]
        tall.nodes.displacement[:, 6, 1] = 0.5
        self.assertTrue(np.all(node_displacements(tall, line_model(tall))[:, 6, 2] == 0.5))

    def test_node_between_floors_lies_between_their_motions(self):
        run = self.read(2, nodes="none")
        tall = run.structures["tall"]
        geometry = dataclasses.replace(
            tall.geometry, floor_of_node=np.where(tall.geometry.floor_of_node == 1, -1, tall.geometry.floor_of_node)
        )
        geometry.nodes[6:9, 2] = 4.0  # a quarter of the distance from floor 1 to floor 2
        tall = dataclasses.replace(tall, geometry=geometry)
        moved = node_displacements(tall, line_model(tall))
        floors = tall.displacement
        np.testing.assert_allclose(moved[:, 7, 0], 0.75 * floors[:, 0] + 0.25 * floors[:, 1], atol=1e-15)


class Scenes(Samples):
    def test_touching_structures_touch_in_the_scene_at_any_scale(self):
        for run in (self.read(2), self.read(3), self.read_old("towers")):
            for scale in (1.0, 40.0):
                link = list(run.links.values())[-1]
                opening = -np.interp(run.time, link.time, link.penetration)
                frames = [np.argmin(opening), len(opening) // 3]
                scene = Scene(run, scale)
                motion = Motion(scene, run.time[frames])
                self.assertLess(opening[frames[0]], 0)
                for i, frame in enumerate(frames):
                    self.assertAlmostEqual(
                        self.distance(scene, motion, link, i), scale * opening[frame], delta=scale * 1e-9
                    )

    def distance(self, scene, motion, link, frame):
        """Between the faces of the two structures at the link, in the scene."""
        ends = []
        face = motion.face(link, frame)
        for name, side in ((link.left, 1), (link.right, -1)):
            nodes = motion.nodes(name, frame) + [side * scene.line_models[name].half_width, 0, 0]
            level = nodes[np.abs(scene.at_rest(name)[:, 2] - scene.faces[link.name][2]) < 1e-9]
            ends.append(level[np.argmin(np.linalg.norm(level - face, axis=1)), 0])
        return ends[1] - ends[0]

    def test_sticks_of_a_row_stand_gap_beside_gap(self):
        scene = Scene(self.read_old("row"), 10)
        left, right, far = (scene.at_rest(name)[0, 0] for name in ("left", "right", "far right"))
        width = 2 * scene.line_models["left"].half_width
        self.assertAlmostEqual(right - left, width + 0.2)
        self.assertAlmostEqual(far - right, width + 0.3)

    def test_wall_stands_where_its_link_is(self):
        run = self.read(2, wall=True)
        scene = Scene(run, 3)
        shift = 2 * frame_samples.GAP
        self.assertAlmostEqual(scene.at_rest("wall")[0, 0], 20 + frame_samples.GAP + shift + 0.3)

    def test_heights_come_from_the_file(self):
        self.assertTrue(Scene(self.read(2, wall=True)).has_heights)
        self.assertFalse(Scene(self.read_old("towers")).has_heights)

    def test_point_between_nodes_is_shared_by_its_member(self):
        nodes = np.array([[0, 0, 0], [0, 0, 4.0], [3, 0, 4.0]])
        shares = dict(nearest_on_members(nodes, np.array([[0, 1], [1, 2]]), np.array([0.2, 0, 1.0])))
        self.assertEqual(shares, {0: 0.75, 1: 0.25})


if __name__ == "__main__":
    unittest.main()
