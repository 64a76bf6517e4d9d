"""Interactive views: the contents of the page, and the page in a browser."""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from PIL import Image

import pounding
from messages import assert_mentions, raises
from pounding import view
from pounding.errors import InputError
from pounding._pictures.scene import Motion, Scene

EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
PROGRAM = os.environ["POUNDING_PROGRAM"]
#: Headless Chromium draws WebGL without a graphics card.
BROWSER = ("chromium", "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader")
BROWSER += ("--enable-unsafe-swiftshader", "--hide-scrollbars")
FRAME = {
    "frame": {
        "material": {"E": "30 GPa"},
        "grid": {
            "storeys": 3,
            "bays": 2,
            "storey_height": "3 m",
            "bay_width": "5 m",
            "columns": {"rectangle": ["0.4 m", "0.4 m"]},
            "beams": {"rectangle": ["0.3 m", "0.5 m"]},
            "floor_mass": "40 t",
        },
    },
    "damping": "5 %",
}


def pair():
    """A frame next to a yielding shear building with a body and a wall, which all hit each other."""
    shear = {"storeys": 3, "height": "3 m", "mass": "40 t", "stiffness": "30 MN/m", "yield_force": "100 kN"}
    law = {"law": "kelvin_voigt_no_tension", "stiffness": "100 MN/m", "restitution": 0.6}
    return pounding.Model(
        title="Frame <and> stick",
        structures={
            "frame": FRAME,
            "stick": {"shear_building": {**shear, "hardening": 0.05, "damping": "5 %"}},
            "moat": {"wall": {}},
        },
        links=[
            {"between": ["frame.3", "stick.3"], "gap": "5 mm", **law},
            {"between": ["stick.1", "moat"], "gap": "500 mm", **law},
        ],
        ground_motion={"harmonic": {"amplitude": 5.0, "period": 0.6, "duration": 2.0}},
        analysis={"duration": 2.5},
    )


def page_of(made):
    """The data in the page."""
    text = made.html.split('<script id="data" type="application/json">', 1)[1].split("</script>", 1)[0]
    return json.loads(text)


def unpacked(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


def displacements(motion, structure, nodes):
    """[instant, node, 3] [m]"""
    return motion["step"][structure] * unpacked(motion["values"][structure], "<i2").reshape(-1, nodes, 3)


def trace(page, name):
    return next(one for one in page["traces"] if one["shown"]["name"] == name)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.model = pair()
        cls.run_ = pounding.run(cls.model)
        cls.made = cls.run_.view(modes=2, frames=40)
        cls.page = page_of(cls.made)

    def test_works_without_a_network(self):
        head = re.sub(r"<script>.*?</script>", "", self.made.html, flags=re.DOTALL)
        self.assertNotRegex(head, r"(src|href)\s*=")
        self.assertIn("Plotly", self.made.html)
        self.assertLess(len(self.made.html), 20e6)

    def test_film_shows_the_displacements_of_the_run(self):
        film, structures = self.page["film"], list(self.run_.structures)
        scene = Scene(self.run_, view._scale(self.run_))
        motion = Motion(scene, np.array(film["times"]))
        self.assertEqual(len(film["times"]), 40)
        for i, name in enumerate(structures):
            drawn = displacements(film["motion"], i, self.page["nodes"][i])
            expected = scene.scale * motion.displacements[name]
            np.testing.assert_allclose(drawn, expected, atol=2e-5 * max(1e-9, np.abs(expected).max()))
        roof = self.run_.structures["stick"].displacement[:, 2]
        drawn = displacements(film["motion"], 1, self.page["nodes"][1])[:, 3, 0]
        expected = scene.scale * np.interp(film["times"], self.run_.time, roof)
        np.testing.assert_allclose(drawn, expected, atol=1e-4 * np.abs(expected).max())

    def test_links_have_their_impacts(self):
        rows = self.run_.impacts_of("frame.3-stick.3")
        self.assertGreater(len(rows), 0)
        worst = rows[np.argmax(rows["peak_force"])]
        struck, apart = trace(self.page, "links")["shown"]["text"]
        assert_mentions(struck, ["5 mm", f"{len(rows)} impacts", "frame.3-stick.3", f"{worst['t_peak']:.3f} s"])
        self.assertRegex(struck, r"peak force [\d.]+ [kM]?N")
        assert_mentions(apart, ["500 mm", "no impact"])

    def test_flashes_are_at_impacts(self):
        film = self.page["film"]
        pressed = unpacked(film["pressed"], "u1").reshape(len(film["times"]), 2)
        self.assertGreater(pressed[:, 0].max(), 0)
        self.assertEqual(pressed[:, 1].max(), 0)
        np.testing.assert_allclose(film["strikes"], np.sort(self.run_.impacts["t_start"]))

    def test_parts_have_their_states(self):
        states = self.run_.structures["stick"].springs.states
        for state in set(states):
            points = trace(self.page, f"storeys: {state}")["points"]
            self.assertEqual(len(unpacked(points["structure"], "<i4")), states.count(state))

    def test_supports_are_at_the_feet(self):
        tops = unpacked(trace(self.page, "supports")["points"]["rest"], "<f4").reshape(-1, 5, 3)[:, 0]
        self.assertEqual(len(tops), 4)  # three columns and a stick
        np.testing.assert_allclose(tops[:, 2], 0, atol=1e-6)

    def test_modes_have_the_shapes_of_the_model(self):
        found = pounding.modes(self.model, 2)
        for number in range(2):
            mode = self.page["modes"][number]
            stick = displacements(mode["motion"], 1, self.page["nodes"][1])[0, 1:, 0]
            shape = found["stick"][number].shape
            np.testing.assert_allclose(stick / stick[-1], shape / shape[-1], atol=1e-3)
            assert_mentions(mode["about"], [f"Mode {number + 1}", f"{found['frame'][number].period:.4g} s"])

    def test_page_is_text_for_any_title(self):
        self.assertIn("<title>Frame &lt;and&gt; stick</title>", self.made.html)
        self.assertEqual(self.page["title"], "Frame <and> stick")

    def test_points_follow_their_structures(self):
        """The two ends of a gap are apart by the opening of the link, enlarged."""
        points, film = trace(self.page, "gaps")["points"], self.page["film"]
        rest = unpacked(points["rest"], "<f4").reshape(-1, 3)
        at = []
        for p in range(2):
            s, a, b = (unpacked(points[key], "<i4")[p] for key in ("structure", "first", "second"))
            share, moved = unpacked(points["share"], "<f4")[p], displacements(film["motion"], s, self.page["nodes"][s])
            at.append(rest[p, 0] + (1 - share) * moved[:, a, 0] + share * moved[:, b, 0])
        link = self.run_.links["frame.3-stick.3"]
        opening = -np.interp(film["times"], link.time, link.penetration)
        scale = view._scale(self.run_)
        np.testing.assert_allclose(at[1] - at[0], scale * opening, atol=0.02 * scale * opening.max())


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def command(self, *words):
        return subprocess.run(
            [PROGRAM, "view", *map(str, words)],
            cwd=self.folder,
            capture_output=True,
            text=True,
            env={**os.environ, "POUNDING_PYTHON": sys.executable},
        )

    def test_every_kind_of_lesson_has_a_view(self):
        for lesson in ("01_ball_on_wall", "05_moat_wall", "12_isolated_frame", "18_coupled_pair", "20_hinge_frames"):
            with self.subTest(lesson):
                model = pounding.Model.from_file(EXAMPLES / lesson / "model.yaml")
                page = page_of(model.view(modes=1))
                self.assertIsNone(page["film"])
                self.assertEqual(len(page["nodes"]), len(model.structures))
                names = {one["shown"]["name"] for one in page["traces"]}
                self.assertIn("links", names)

    def test_isolators_devices_and_hinges_are_drawn(self):
        for lesson, name in (
            ("21_isolated_moat", "isolators: elastic"),
            ("22_dampers_between_neighbours", "devices"),
            ("20_hinge_frames", "hinges: elastic"),
        ):
            with self.subTest(lesson):
                model = pounding.Model.from_file(EXAMPLES / lesson / "model.yaml")
                self.assertIn(name, {one["shown"]["name"] for one in page_of(model.view())["traces"]})

    def test_command_writes_the_view_of_results_and_of_a_model(self):
        model = EXAMPLES / "02_two_oscillators" / "model.yaml"
        subprocess.run([PROGRAM, "run", str(model), "-o", "r.h5"], cwd=self.folder, check=True, capture_output=True)
        for words, film in ((("r.h5",), True), ((str(model), "-o", "m.html", "--modes=1"), False)):
            done = self.command(*words)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            name = done.stdout.split()[-1]
            page = page_of(view.View((self.folder / name).read_text(), 0, 0))
            self.assertEqual(page["film"] is not None, film)

    def test_refusals(self):
        (self.folder / "mine.html").write_text("<p>mine</p>")
        model = str(EXAMPLES / "02_two_oscillators" / "model.yaml")
        for words, facts in (
            ((model, "-o", "a.png"), (".png", ".html")),
            ((model, "-o", "mine.html"), ("mine.html", "view")),
            (("missing.h5",), ("missing.h5",)),
            ((model, "--scale=-1"), ("--scale -1",)),
            ((model, "--frames=9"), ("--frames",)),
        ):
            done = self.command(*words)
            self.assertEqual(done.returncode, 2, words)
            assert_mentions(done.stderr, facts)
        self.assertEqual((self.folder / "mine.html").read_text(), "<p>mine</p>")

    def test_film_is_limited(self):
        run = pounding.run(pair())
        before, view.FILM = view.FILM, 8.0 * 20 * sum(page_of(run.view())["nodes"])
        try:
            self.assertEqual(run.view().frames, 20)
            with raises(InputError, ["--frames 30", "--frames 20"]):
                run.view(frames=30)
        finally:
            view.FILM = before

    def test_without_plotly_the_message_names_it(self):
        with mock.patch.dict(sys.modules, {"plotly": None, "plotly.offline": None}):
            with raises(ImportError, ["plotly", "pip install"]):
                pair().view()


class Browser(unittest.TestCase):
    """The page in headless Chromium, with WebGL in software."""

    @classmethod
    def setUpClass(cls):
        if shutil.which(BROWSER[0]) is None:
            if os.environ.get("CI"):
                raise AssertionError("chromium is missing: apt-get install chromium")
            raise unittest.SkipTest("chromium is not installed")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        pounding.run(pair()).view(cls.folder / "view.html", modes=2, frames=40)

    def browse(self, place, *words, milliseconds=30000):
        own = (f"--user-data-dir={self.folder}/profile", f"--virtual-time-budget={milliseconds}")
        call = [*BROWSER, *own, *words, f"file://{self.folder}/view.html#{place}"]
        return subprocess.run(call, capture_output=True, text=True, timeout=120, check=True).stdout

    def state(self, place, **options):
        """The data attributes of the page after loading."""
        body = re.search(r"<body([^>]*)>", self.browse(place, "--dump-dom", **options))[1]
        return dict(re.findall(r'data-(\w+)="([^"]*)"', body))

    def test_film_and_modes_open_without_an_error(self):
        film = self.state("film,20")
        self.assertEqual((film["ready"], film["motion"], film["frame"]), ("yes", "film", "20"))
        self.assertNotIn("error", film)
        self.assertRegex(film["clock"], r"^t = [\d.]+ s, \d+ impacts?$")
        mode = self.state("mode2")
        self.assertEqual((mode["ready"], mode["motion"], mode.get("error")), ("yes", "1", None))

    def test_play_advances_the_film(self):
        text = (self.folder / "view.html").read_text()
        played = text.replace('view.ready = "yes";', 'view.ready = "yes"; find("play").click();')
        (self.folder / "view.html").write_text(played)
        self.addCleanup((self.folder / "view.html").write_text, text)
        state = self.state("film", milliseconds=3000)
        self.assertGreater(int(state["frame"]), 0)
        self.assertNotIn("error", state)

    def test_structures_are_visible(self):
        """The colours of both structures are on the screen."""
        for size in ("1200,900", "500,700"):
            self.browse("film,0", f"--window-size={size}", f"--screenshot={self.folder}/shot.png")
            pixels = np.asarray(Image.open(self.folder / "shot.png").convert("RGB")).astype(int)
            for colour in ((0, 114, 178), (213, 94, 0)):
                near = np.abs(pixels - np.array(colour)).sum(axis=2) < 60
                self.assertGreater(near.sum(), 150, f"{colour} at {size}")


if __name__ == "__main__":
    unittest.main()
