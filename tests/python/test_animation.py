"""Animations: the times shown, flashing contacts, and messages if they cannot be made."""

import contextlib
import dataclasses
import os
import pty
import shutil
import stat
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import numpy as np
from PIL import Image

import frame_samples
from pounding import animation
from pounding._pictures.drawing import project
from pounding._runs import read
from pounding._pictures.scene import Motion, Scene
from pounding._pictures.style import BadRequest
from messages import assert_mentions, raises

PROGRAM = os.environ["POUNDING_PROGRAM"]
WRITER = os.environ["POUNDING_RESULTS_WRITER"]


class Films(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        warnings.simplefilter("error")
        cls.directory = tempfile.TemporaryDirectory()
        place = Path(cls.directory.name)
        frame_samples.write(place / "plane.h5", 2, nodes="none", wall=True)
        frame_samples.write(place / "space.h5", 3)
        for kind in ("towers", "alone"):
            subprocess.run([WRITER, kind, place / f"{kind}.h5"], check=True)
        cls.runs = {kind: read(place / f"{kind}.h5") for kind in ("plane", "space", "towers", "alone")}

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()
        warnings.resetwarnings()

    def test_members_are_where_the_displacements_are(self):
        run = self.runs["space"]
        times = run.time[[0, 50, 120]]
        film = animation.animate(run, times, scale=30)
        motion = Motion(Scene(run, 30), times)
        lines = next(c for c in film.figure.axes[0].collections if c.get_label() == "tall")
        for frame in (2, 0, 1):
            film.draw(frame)
            nodes = project(motion.nodes("tall", frame), "oblique")
            np.testing.assert_allclose(lines.get_segments(), nodes[run.structures["tall"].geometry.members])

    def test_links_flash_while_they_are_pressed(self):
        run = self.runs["plane"]
        times = animation.frame_times(run, 90)
        strengths = animation.pressed(run, times)
        link = run.links["tall.3-low.3"]
        expected = [
            bool(np.any(link.penetration[(link.time > a) & (link.time <= b)] > 0))
            for a, b in zip([times[0] - 1, *times[:-1]], times)
        ]
        self.assertTrue(any(expected) and not all(expected))
        self.assertEqual(list(strengths[:, 2] > 0), expected)
        self.assertEqual(strengths.max(), 1)
        film = animation.animate(run, times)
        flashes = film.figure.axes[0].collections[-1]
        for frame in (expected.index(True), expected.index(False)):
            film.draw(frame)
            self.assertEqual(flashes.get_sizes()[2] > 0, expected[frame])

    def test_contact_shorter_than_a_frame_is_seen(self):
        run = self.runs["towers"]
        times = animation.frame_times(run, 30)
        struck = animation.pressed(run, times) > 0
        for impact in run.impacts:
            frame = np.searchsorted(times, impact["t_start"])
            self.assertTrue(struck[frame, list(run.links).index(impact["link"])])

    def test_contact_that_has_not_ended_flashes(self):
        run = self.runs["plane"]
        times = animation.frame_times(run, 90)
        unfinished = dataclasses.replace(run, impacts=run.impacts[:0])
        np.testing.assert_array_equal(animation.pressed(unfinished, times), animation.pressed(run, times))

    def test_rigid_contacts_flash_too(self):
        run = self.runs["towers"]
        forces = {name: link.force.copy() for name, link in run.links.items()}
        peaks = run.impacts["peak_force"].copy()
        for link in run.links.values():
            link.force[:] = 0
        run.impacts["peak_force"] = np.nan
        try:
            self.assertEqual(set(np.unique(animation.pressed(run, animation.frame_times(run, 30)))), {0.0, 1.0})
        finally:
            run.impacts["peak_force"] = peaks
            for name, link in run.links.items():
                link.force[:] = forces[name]

    def test_scale_is_round_and_keeps_displacements_small(self):
        for run in self.runs.values():
            scale = animation.choose_scale(run)
            self.assertIn(f"{scale:e}"[0], "125")
            size = np.ptp(Scene(run).bounds(), axis=1).max()
            moved = max(np.abs(s.displacement).max(initial=0) for s in run.structures.values())
            self.assertTrue(size / 12 / 2.6 <= scale * moved <= size / 12 or scale == 1)

    def test_frames_are_spread_over_the_chosen_time(self):
        run = self.runs["towers"]
        np.testing.assert_allclose(animation.frame_times(run, 5, 4, 8), [4, 5, 6, 7, 8])
        self.assertEqual(len(animation.frame_times(run)), 240)
        self.assertEqual(len(animation.frame_times(run, None, 1, 5)), 60)

    def test_impossible_wishes_are_refused(self):
        run = self.runs["towers"]
        for wish, words in (
            ((10, 4, 20), ["--from", "--to", "0 s", "16 s", "4", "20"]),
            ((10, 5, 5), ()),
            ((1,), ["--frames", "2"]),
            ((10, float("nan"), None), ()),
        ):
            with raises(BadRequest, words):
                animation.frame_times(run, *wish)
        with raises(BadRequest, "--scale"):
            animation.animate(run, [0, 1], scale=0)

    def test_pictures_are_what_a_whole_drawing_shows(self):
        run = self.runs["plane"]
        film = animation.animate(run, animation.frame_times(run, 5))
        for frame, picture in enumerate(film.pictures()):
            whole = animation.animate(run, animation.frame_times(run, 5))
            whole.draw(frame)
            whole.figure.canvas.draw()
            np.testing.assert_array_equal(np.asarray(picture), np.asarray(whole.figure.canvas.buffer_rgba())[:, :, :3])

    def test_colours_of_a_film_are_those_drawn(self):
        run = self.runs["plane"]
        film = animation.animate(run, animation.frame_times(run, 5))
        with tempfile.TemporaryDirectory() as folder:
            animation.save(film, Path(folder) / "film.gif")
            with Image.open(Path(folder) / "film.gif") as moving:
                for frame, picture in enumerate(film.pictures()):
                    moving.seek(frame)
                    apart = np.asarray(moving.convert("RGB")).astype(int) - np.asarray(picture)
                    self.assertEqual(moving.convert("RGB").getpixel((1, 1)), (255, 255, 255))
                    self.assertLess(np.abs(apart).mean(), 0.1)

    def test_film_has_its_frames(self):
        place = Path(self.directory.name)
        for kind in ("plane", "alone"):
            animation.save(
                animation.animate(self.runs[kind], animation.frame_times(self.runs[kind], 4)), place / f"{kind}.gif"
            )
            with Image.open(place / f"{kind}.gif") as film:
                self.assertEqual(film.n_frames, 4)
        animation.save(animation.animate(self.runs["space"], [0, 1, 2]), place / "s.png")
        self.assertEqual(sorted(p.name for p in place.glob("s_*.png")), ["s_0001.png", "s_0002.png", "s_0003.png"])

    def test_mp4_says_what_is_missing(self):
        with mock.patch.object(shutil, "which", return_value=None):
            with raises(BadRequest, "-o"):
                animation.check_output("a.mp4")
        with raises(BadRequest, "mp4"):
            animation.check_output("a.avi")

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_mp4_is_written(self):
        path = Path(self.directory.name) / "a.mp4"
        animation.save(animation.animate(self.runs["alone"], [0, 1, 2]), path)
        self.assertEqual(path.read_bytes()[4:8], b"ftyp")


class Command(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        self.results = self.directory / "-run.h5"
        subprocess.run([WRITER, "alone", self.results], check=True)

    def test_film_is_written_into_the_current_folder_and_named(self):
        place = self.directory / "elsewhere"
        place.mkdir()
        done = subprocess.run(
            [PROGRAM, "animate", "--frames", "3", self.results], capture_output=True, text=True, cwd=place
        )
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "film         -run.gif\n", ""))
        with Image.open(place / "-run.gif") as film:
            self.assertEqual(film.n_frames, 3)
        self.assertFalse(self.results.with_suffix(".gif").exists())
        done = subprocess.run(
            [PROGRAM, "animate", "--frames", "2", "-o", "still.png", self.results],
            capture_output=True,
            text=True,
            cwd=place,
        )
        self.assertEqual((done.returncode, done.stdout), (0, "frames       still_0001.png to still_0002.png\n"))

    def test_progress_is_shown_on_a_terminal(self):
        master, terminal = pty.openpty()
        done = subprocess.run(
            [PROGRAM, "animate", "--frames", "3", self.results],
            stdout=subprocess.DEVNULL,
            stderr=terminal,
            cwd=self.directory,
        )
        os.close(terminal)
        shown = b""
        with contextlib.suppress(OSError):
            while part := os.read(master, 4096):
                shown += part
        os.close(master)
        self.assertEqual(done.returncode, 0, shown)
        self.assertIn(b"frame 2 of 3", shown)
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown)

    def test_wishes_reach_python_unchanged(self):
        python = self.directory / "python"
        python.write_text('#!/bin/sh\nprintf "%s\\n" "$@" > arguments\n')
        python.chmod(stat.S_IRWXU)
        subprocess.run(
            [
                PROGRAM,
                "animate",
                "-o",
                "x y.mp4",
                "--scale",
                "2.5e1",
                "--frames",
                "7",
                "--from",
                "0.1",
                "--to",
                "2",
                "--",
                "-run.h5",
            ],
            env={**os.environ, "POUNDING_PYTHON": str(python)},
            cwd=self.directory,
            check=True,
            stderr=subprocess.DEVNULL,
        )
        self.assertEqual(
            (self.directory / "arguments").read_text().splitlines(),
            [
                "-m",
                "pounding.animation",
                "-o",
                "x y.mp4",
                "--scale=2.5e1",
                "--frames=7",
                "--from=0.1",
                "--to=2",
                "--",
                "-run.h5",
            ],
        )

    def test_failures_are_reported(self):
        for words, text in (
            (["--to", "99"], ["--from", "--to", "99"]),
            (["-o", "x.avi"], "x.avi"),
            (["--frames", "x"], "--frames"),
        ):
            done = subprocess.run([PROGRAM, "animate", self.results, *words], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            assert_mentions(done.stderr, text)


if __name__ == "__main__":
    unittest.main()
