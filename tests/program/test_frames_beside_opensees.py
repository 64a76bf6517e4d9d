"""Frames of models compared with the same frames in OpenSees.

The models and the stored numbers are in tests/verification/opensees; its README describes how both were made.
"""

import json
import math
import unittest
from pathlib import Path

import h5py
import numpy as np
from book import Book
from support import ProgramTest

MODELS = Path(__file__).resolve().parents[1] / "verification" / "opensees"
LAWS = ("linear_spring", "kelvin_voigt", "hertz", "hertz_damped", "jankowski", "bilinear_hertz")
LINEAR, POUNDING = 1e-6, 1e-4
OPENSEES = "OpenSees 3.7.1 (openseespy) on the same frames, see [opensees](opensees/README.md)"


def reference(name):
    return json.loads((MODELS / f"{name}.json").read_text())


def words(values):
    return [v.decode() if isinstance(v, bytes) else str(v) for v in values]


class Results:
    """One structure of a results file."""

    def __init__(self, path, name):
        with h5py.File(path) as file:
            group = file[f"structures/{name}"]
            self.time = file["time"][()]
            self.nodes = words(group["nodes/names"].asstr()[:])
            self.directions = words(group["nodes/displacement"].attrs["directions"])
            self.displacement = group["nodes/displacement"][()]
            self.members = words(group["members/names"].asstr()[:])
            self.components = words(group["members/end_forces"].attrs["components"])
            self.end_forces = group["members/end_forces"][()]
            self.base_shear = group["base_shear"][()].T
            self.floors = group["displacement"][()]
            self.floor_directions = words(group.attrs["directions"])

    def node(self, name):
        """[direction, time]"""
        return self.displacement[:, self.nodes.index(name)].T

    def member(self, name):
        """[component, time]"""
        return self.end_forces[:, self.members.index(name)].T


def of_one_unit(parts):
    """Indices of the parts with the same unit: translations and rotations, forces and moments."""
    turning = [i for i, part in enumerate(parts) if part.split()[-1][0] in "rMT"]
    return [[i for i in range(len(parts)) if i not in turning], turning]


#: Quantities of mixed units, split by of_one_unit.
UNITS = {"nodes": ("displacements of nodes", "turns of nodes"), "members": ("end forces", "end moments")}


class Beside(ProgramTest):
    def results(self, model, *structures):
        summary = self.summary(MODELS / model, "-o", "out.h5")
        self.assertEqual(summary["status"], "done")
        return [Results(self.folder / "out.h5", name) for name in structures]

    def agree(self, book, got, wanted, tolerance, quantity, where=""):
        """Difference relative to the largest expected number."""
        got, wanted = np.asarray(got), np.asarray(wanted)
        with self.subTest(quantity=quantity, where=where):
            self.assertEqual(got.shape, wanted.shape)
            book.below(
                f"{quantity}, largest difference over the largest [-]",
                np.abs(got - wanted).max() / np.abs(wanted).max(),
                tolerance,
            )

    def check_statics(self, book, got, wanted):
        """Last state of a run under constant accelerations."""
        for parts, kind, of in ((got.directions, "nodes", got.node), (got.components, "members", got.member)):
            for name, values in wanted[kind].items():
                for quantity, places in zip(UNITS[kind], of_one_unit(parts)):
                    self.agree(
                        book, of(name)[places, -1], np.array(values)[places], LINEAR, f"at rest: {quantity}", name
                    )
        self.agree(book, got.base_shear[:, -1], wanted["base_shear"], LINEAR, "at rest: base shear")

    def check_history(self, book, got, wanted, every):
        """Stored samples, and the largest samples of the file at the sampling of the reference."""

        def check(rows, stored, quantity, where=""):
            self.agree(
                book,
                rows[:, ::every],
                np.array(stored["history"])[:, : len(rows[0, ::every])],
                LINEAR,
                f"history: {quantity}",
                where,
            )
            self.agree(book, np.abs(rows).max(axis=1), stored["peak"], LINEAR, f"peak: {quantity}", where)

        for parts, kind, of in ((got.directions, "nodes", got.node), (got.components, "members", got.member)):
            self.assertEqual(parts, wanted[kind]["parts"])
            for name, stored in wanted[kind].items():
                for quantity, places in zip(UNITS[kind], of_one_unit(parts)) if name != "parts" else []:
                    some = {key: [stored[key][i] for i in places] for key in ("history", "peak")}
                    check(of(name)[places], some, quantity, name)
        check(got.base_shear, wanted["base_shear"], "base shear")


class Linear(Beside):
    def book(self, frames):
        return Book(
            self,
            f"Frames compared with OpenSees: {frames}",
            OPENSEES,
            "the digits that the references have: everything is linear",
        )

    def check_modes(self, book, got, wanted):
        a0, b0 = wanted["rayleigh"]
        self.assertGreaterEqual(len(got), 6)
        for mode, period in zip(got, wanted["periods"]):
            book.near("periods [s]", mode["period"], period, LINEAR * period)
            w = 2 * math.pi / period
            ratio = a0 / (2 * w) + b0 * w / 2
            book.near("damping ratios [-]", mode["damping_ratio"], ratio, LINEAR * ratio)

    def modes(self, model):
        done = self.pounding("modes", MODELS / model, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def test_periods_and_damping_of_the_plane_frames(self):
        book = self.book("two plane frames")
        for side, modes in self.modes("plane.yaml").items():
            self.check_modes(book, modes, reference("plane")[side])

    def test_periods_and_damping_of_the_frame_in_space(self):
        self.check_modes(self.book("a frame in space"), self.modes("space.yaml")["tower"], reference("space")["tower"])

    def test_static_answer_of_the_plane_frames(self):
        book = self.book("two plane frames")
        for side, got in zip(("left", "right"), self.results("plane_static.yaml", "left", "right")):
            self.check_statics(book, got, reference("plane")[side]["static"])

    def test_static_answer_of_the_frame_in_space(self):
        self.check_statics(
            self.book("a frame in space"),
            self.results("space_static.yaml", "tower")[0],
            reference("space")["tower"]["static"],
        )

    def test_earthquake_answer_of_the_plane_frames(self):
        wanted, book = reference("plane"), self.book("two plane frames")
        for side, got in zip(("left", "right"), self.results("plane.yaml", "left", "right")):
            every = round(wanted["history_step"] / wanted["peaks_at_multiples_of"])
            np.testing.assert_allclose(got.time, wanted["peaks_at_multiples_of"] * np.arange(4001), atol=1e-12)
            self.check_history(book, got, wanted[side], every)

    def test_earthquake_answer_of_the_frame_in_space(self):
        wanted = reference("space")
        [got] = self.results("space.yaml", "tower")
        every = round(wanted["history_step"] / wanted["peaks_at_multiples_of"])
        np.testing.assert_allclose(got.time, wanted["peaks_at_multiples_of"] * np.arange(1001), atol=1e-12)
        self.check_history(self.book("a frame in space"), got, wanted["tower"], every)
        # All nodes of a floor rotate by the same angle.
        turn = got.floors[:, 3, got.floor_directions.index("rz")]
        np.testing.assert_allclose(
            turn, got.node("4.0.0")[got.directions.index("rz")], rtol=0, atol=1e-9 * np.abs(turn).max()
        )


class Pounding(Beside):
    def test_models_differ_in_their_links_alone(self):
        def rest(name):
            lines = (MODELS / f"{name}.yaml").read_text().splitlines()
            return [line for line in lines if not line.startswith(("title", "links", "  - {between", "analysis"))]

        for law in LAWS:
            self.assertEqual(rest(f"plane_{law}"), rest("plane"))

    def test_reference_is_that_of_the_peers(self):
        book = Book(
            self,
            "Frames compared with OpenSees: pounding",
            "another program's numbers for the same frames, from the matrices of "
            "OpenSees by the same method, compared with the references",
            "the digits that both have",
        )
        for law, numbers in reference("plane_pounding")["laws"].items():
            if "peers" in numbers:
                self.assertEqual(numbers["impacts"], numbers["peers"]["impacts"], law)
                self.agree(
                    book,
                    numbers["peak_force"],
                    numbers["peers"]["peak_force"],
                    2e-5,
                    "peak forces of the references",
                    law,
                )

    def test_every_law_gives_the_impacts_forces_and_drifts(self):
        book = Book(
            self,
            "Frames compared with OpenSees: pounding",
            f"matrices of {OPENSEES}; the impacts integrated from them independently",
            "impacts exactly, forces and drifts to the 1e-4 of the references",
        )
        for law in LAWS:
            with self.subTest(law=law):
                self.check_law(book, law, reference("plane_pounding")["laws"][law])

    def check_law(self, book, law, wanted):
        summary = self.summary(MODELS / f"plane_{law}.yaml", "-o", "out.h5")
        links = {link["name"]: link for link in summary["links"]}
        for floor, (impacts, force) in enumerate(zip(wanted["impacts"], wanted["peak_force"]), 1):
            link = links.pop(f"left.{floor}-right.{floor}")
            book.equal(f"{law}: impacts of each link", link["impacts"], impacts)
            book.near(f"{law}: peak force of each link [N]", link["peak_force"], force, POUNDING * force)
        self.assertEqual(links, {})
        # The facing columns.
        for side, line, storeys in (("left", 3, 8), ("right", 0, 6)):
            got = Results(self.folder / "out.h5", side)
            moved = np.array([got.node(f"{s}.{line}")[got.directions.index("x")] for s in range(1, storeys + 1)])
            drift = np.abs(np.diff(moved, axis=0, prepend=0)).max(axis=1)
            for storey in range(storeys):
                for what, value in (("drift", drift), ("displacement", np.abs(moved).max(axis=1))):
                    expected = wanted[f"peak_{what}"][side][storey]
                    book.near(f"{law}: peak {what} of each storey [m]", value[storey], expected, POUNDING * expected)


class Portals(Beside):
    def book(self):
        return Book(
            self,
            "Frames compared with OpenSees: two portals with stiff beams",
            "the two oscillators that they are: DOP853 with located events",
            "half a unit of the last digit printed, and 1e-6 of the value for the run",
        )

    def model(self, law):
        text = (MODELS / "portals.yaml").read_text()
        link = "law: linear_spring, stiffness: 93.5e6"
        self.assertIn(link, text)
        return self.write(text.replace(link, law) + "accept: [penetration]\n")

    def near(self, book, got, printed, unit, what):
        book.near(what, got, printed, 0.51 * unit + 1e-6 * abs(printed))

    def test_two_portals_with_stiff_beams_are_two_oscillators(self):
        wanted, book = reference("portals"), self.book()
        for law, numbers in wanted["laws"].items():
            with self.subTest(law=law):
                model = self.model(law)
                summary = self.summary(model, "-o", "out.h5")
                u1, u2, impacts, largest, *each = numbers
                for side, printed in (("left", u1), ("right", u2)):
                    self.near(
                        book,
                        summary["structures"][side]["peak_displacement"][0],
                        printed,
                        1e-6,
                        f"peak displacement, {side} [m]",
                    )
                [link] = summary["links"]
                book.equal("impacts", link["impacts"], impacts)
                self.near(book, link["peak_force"], largest, 0.1, "peak force [N]")
                with h5py.File(self.folder / "out.h5") as file:
                    rows = file["impacts"][()]
                for row, (touch, approach, force) in zip(rows, (each[:3], each[3:])):
                    self.near(book, row["t_start"], touch, 1e-6, "touch of the first two impacts [s]")
                    self.near(book, row["v_approach"], approach, 1e-6, "approach of the first two impacts [m/s]")
                    self.near(book, row["peak_force"], force, 0.1, "peak force of the first two impacts [N]")

    def test_their_periods_are_those_of_the_oscillators(self):
        self.write((MODELS / "portals.yaml").read_text())
        modes = json.loads(self.pounding("modes", "model.yaml", "--json").stdout)
        book = Book(
            self,
            "Frames compared with OpenSees: two portals with stiff beams",
            "the target periods and damping of the oscillators",
            "rounding",
        )
        for side, period in zip(("left", "right"), reference("portals")["periods"]):
            self.assertEqual(len(modes[side]), 1)
            book.near("period [s]", modes[side][0]["period"], period, 1e-12 * period)
            book.near("damping ratio [-]", modes[side][0]["damping_ratio"], 0.05, 1e-12 * 0.05)


if __name__ == "__main__":
    unittest.main()
