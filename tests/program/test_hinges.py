"""Frames with hinges in the program: cost without yielding, in space, on two processes, and resumed."""

import json
import re
import subprocess
import unittest

import h5py
import numpy as np

from support import LAUNCHER, PROGRAM, SURROUNDINGS, ProgramTest
from messages import assert_mentions

SHAKE = "ground_motion: {harmonic: {amplitude: 5.0, period: 0.5 s, duration: 1.5 s}}\n"
MEMBERS = "columns: {rectangle: [0.4 m, 0.4 m]}, beams: {rectangle: [0.3 m, 0.5 m]}"
ANALYSIS = "analysis: {duration: 2.0 s, tolerance: %s, output_step: 10 ms}\n"


def hinges(beams, columns):
    return f"      hinges:\n        beams: {{at: both, {beams}}}\n        columns: {{at: feet, {columns}}}\n"


def rigid_plastic(strength=1.0):
    return hinges(
        f"yield_moment: {180 * strength} kN m, hardening: 2 %", f"yield_moment: {250 * strength} kN m, hardening: 2 %"
    )


def by_law(law, more=""):
    yields = lambda moment: f"{law}: {{yield_moment: {moment} kN m, spring_hardening: 2 %, stiffness_factor: 10{more}}}"
    return hinges(yields(180), yields(250))


#: Laws with different memories.
LAWS = {
    "rigid_plastic": rigid_plastic(),
    "nested": by_law("menegotto_pinto"),
    "last": by_law("menegotto_pinto", ", memory: last"),
    "bouc_wen": by_law("bouc_wen"),
    "peak_oriented": by_law("peak_oriented", ", unloading: 0.5"),
}


def pair(of_hinges, tolerance="1e-5"):
    """Two frames that collide; the right one never yields."""
    frame = lambda storeys, x, inner: (
        f"""\
    frame:
      origin: [{x}, 0]
      material: {{E: 30 GPa}}
      grid: {{storeys: {storeys}, bays: 1, storey_height: 3.2 m, bay_width: 6 m, {MEMBERS}, floor_mass: 40 t}}
{inner}    damping: 5 %
"""
    )
    return (
        SHAKE
        + "structures:\n  left:\n"
        + frame(3, 0, of_hinges)
        + "  right:\n"
        + frame(2, 6.02, "")
        + "links:\n  - {between: [left, right], floors: all, gap: 20 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.65}\n"
        + ANALYSIS % tolerance
    )


def single(dimension, of_hinges, bays="1", tolerance="1e-7"):
    return f"""{SHAKE}structures:
  left:
    frame:
      dimension: {dimension}
      material: {{E: 30 GPa, poisson: 0.2}}
      grid: {{storeys: 2, bays: {bays}, storey_height: 3.2 m, bay_width: 6 m, {MEMBERS}, floor_mass: {40 if dimension == 2 else 80} t, rigid_floors: true}}
{of_hinges}    damping: {{modal: {{ratio: 5 %}}}}
{ANALYSIS % tolerance}"""


class Hinges(ProgramTest):
    def results(self, model, name="out.h5", processes=1, words=()):
        self.write(model)
        launcher = [LAUNCHER, "-n", str(processes)] if processes > 1 else []
        done = subprocess.run(
            [*launcher, PROGRAM, "run", "model.yaml", "--json", "-o", name, *words],
            cwd=self.folder,
            capture_output=True,
            text=True,
            env=SURROUNDINGS,
            timeout=300,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout), self.folder / name

    def numbers(self, path):
        """Every numeric dataset except wall-clock times and the checkpoint."""
        found = {}

        def look(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not re.search("wall|checkpoint", name):
                found[name] = item[()]

        with h5py.File(path) as file:
            file.visititems(look)
        return found

    def test_that_never_yield_leave_every_bit_as_it_is(self):
        for integrator in ("esdirk4", "generalized_alpha"):
            scheme = f", integrator: {integrator}}}"
            strong, one = self.results(
                pair(rigid_plastic(1000), "1e-4").replace("10 ms}", "10 ms" + scheme), "strong.h5"
            )
            elastic, other = self.results(pair("", "1e-4").replace("10 ms}", "10 ms" + scheme), "elastic.h5")
            self.assertEqual(strong["structures"]["left"]["yielding"]["yielded"], 0)
            self.assertGreater(len(elastic["impacts"]), 0)
            for key in ("steps", "rejected", "events"):
                self.assertEqual(strong["solver"][key], elastic["solver"][key])
            one, other = self.numbers(one), self.numbers(other)
            self.assertTrue(
                {"structures/left/displacement", "structures/left/storey_shear", "energy/strain"} <= other.keys()
            )
            for name, values in other.items():
                with self.subTest(integrator=integrator, name=name):
                    self.assertTrue(values.tobytes() == one[name].tobytes())

    def test_without_hardening_at_all_ends_reach_the_load_of_the_mechanism(self):
        # A portal of 3.2 m whose ends all yield at 120 kN m: the columns carry 4 Mp/h, and the joints rotate no further
        # than the beam.
        for law in (
            "yield_moment: 120 kN m",
            "bilinear: {yield_moment: 120 kN m, stiffness_factor: 10, hardening: 0}",
            "bouc_wen: {yield_moment: 120 kN m, stiffness_factor: 10, hardening: 0, exponent: 8}",
        ):
            words = f"      hinges: {{beams: {{at: both, {law}}}, columns: {{at: both, {law}}}}}\n"
            run, path = self.results(
                single(2, words, tolerance="1e-6")
                .replace("storeys: 2", "storeys: 1")
                .replace("amplitude: 5.0", "amplitude: 9.0")
            )
            with h5py.File(path) as file:
                shear = np.abs(file["envelopes/structures/left/storey_shear"][:, 0]).max()
            with self.subTest(law):
                self.assertEqual(run["structures"]["left"]["yielding"]["yielded"], 6)
                self.assertGreater(
                    max(part["ductility"] for part in run["structures"]["left"]["yielding"]["springs"]), 3
                )
                np.testing.assert_allclose(shear, 4 * 120e3 / 3.2, rtol=1e-6)

    def test_hardening_and_ductility_mean_the_same_in_every_form(self):
        # A spring of a thousand times 6EI/L is nearly a rigid-plastic hinge. Read as the ratio of the bare spring, the
        # hardening would be a thousand times too stiff.
        found = {}
        for form in (
            "yield_moment: 120 kN m, hardening: 10 %",
            "bilinear: {yield_moment: 120 kN m, hardening: 10 %, stiffness_factor: 1000}",
        ):
            run, _ = self.results(
                single(
                    2,
                    f"      hinges: {{beams: {{at: both, {form}}}, columns: {{at: both, {form}}}}}\n",
                    tolerance="1e-6",
                )
                + "accept: [hardening, yield]\n"
            )
            parts = run["structures"]["left"]["yielding"]["springs"]
            found[form] = np.array([[part["peak_force"], part["ductility"], part["plastic"]] for part in parts])
        rigid, series = found.values()
        self.assertGreater(rigid[:, 1].max(), 2)
        np.testing.assert_allclose(series, rigid, rtol=0.01, atol=0.01 * rigid.max(axis=0).min())

    def test_in_space_are_those_in_the_plane(self):
        # Two equal frames side by side under one floor: each carries half of the space model. The out-of-plane motion is zero. Steps end at corners, which are located to a fraction of the step: the answers agree to the tolerance
        # of the runs.
        for law in ("rigid_plastic", "nested"):
            flat, one = self.results(single(2, LAWS[law]))
            self.assertGreater(flat["structures"]["left"]["yielding"]["yielded"], 4)
            along = LAWS[law].replace("at: both", "axis: y, at: both").replace("at: feet", "axis: y, at: feet")
            deep, two = self.results(single(3, along, "[1, 1]"), "space.h5")
            with h5py.File(one) as plane, h5py.File(two) as space:
                u, v = plane["structures/left/displacement"][:], space["structures/left/displacement"][:]
                np.testing.assert_allclose(v[:, :, 0], u[:, :, 0], rtol=0, atol=1e-7 * np.abs(u).max())
                np.testing.assert_allclose(v[:, :, 1:], 0, atol=1e-9 * np.abs(u).max())
                # Outputs within steps are interpolated, and the steps of the two runs differ: the end of the run and
                # the extremes are compared.
                shear, both = (
                    plane["structures/left/storey_shear"][-1],
                    space["structures/left/storey_shear"][-1].reshape(2, 2)[:, 0],
                )
                np.testing.assert_allclose(both, 2 * shear, rtol=1e-8)
                least_and_largest = "envelopes/structures/left/storey_shear"
                np.testing.assert_allclose(
                    space[least_and_largest][:, 0], 2 * plane[least_and_largest][:, 0], rtol=1e-6
                )
            ductility = lambda run: sorted(
                {
                    round(part["ductility"], 6)
                    for part in run["structures"]["left"]["yielding"]["springs"]
                    if part["ductility"] > 1e-6
                }
            )
            np.testing.assert_allclose(ductility(deep), ductility(flat), rtol=1e-6)

    @unittest.skipUnless(LAUNCHER, "needs MPI")
    def test_are_alike_on_two_processes(self):
        for law in ("rigid_plastic", "nested"):
            summary, one = self.results(pair(LAWS[law]))
            self.assertGreater(summary["structures"]["left"]["yielding"]["yielded"], 4)
            _, two = self.results(pair(LAWS[law]), "two.h5", 2)
            one, two = self.numbers(one), self.numbers(two)
            for name in (
                "displacement",
                "storey_shear",
                "springs/deformation",
                "springs/force",
                "springs/hysteretic",
                "springs/summary/ductility",
                "springs/summary/residual",
            ):
                name = f"structures/left/{name}"
                with self.subTest(law=law, name=name):
                    np.testing.assert_allclose(two[name], one[name], rtol=1e-9, atol=1e-9 * np.abs(one[name]).max())

    def test_of_wrong_words_are_refused_with_what_to_type(self):
        """Each with its location; exit code 2 of `check` and of `run`, and no results."""

        def refused(model, *messages):
            self.write(model)
            for verb in ("check", "run"):
                done = self.pounding(verb, "model.yaml")
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr, r"model\.yaml:\d+:\d+: ")
                for message in messages:
                    assert_mentions(done.stderr, message)
            self.assertEqual(list(self.folder.glob("*.h5")), [])

        def with_hinges(words, dimension=2, bays="1"):
            return single(dimension, f"      hinges: {{beams: {words}}}\n", bays)

        refused(with_hinges("{at: both, yield_moment: 0 kN m}"), ["12 kN m", "hinges.beams.yield_moment"])
        refused(
            with_hinges("{at: both, yield_moment: 180 kN m, hardening: 100 %}"),
            ["5 %", "[0, 1)", "hinges.beams.hardening"],
        )
        refused(
            with_hinges("{at: both, yield_moment: 180 kN m, hardening: -1 %}"), ["[0, 1)", "hinges.beams.hardening"]
        )
        refused(with_hinges("{at: both, yield_moment: 180 kN m}", 3, "[1, 1]"), ["axis: y", "axis: both"])
        refused(
            with_hinges("{at: both, bouc_wen: {yield_moment: 180 kN m, gamma_share: 0.6}}"),
            ["[0, 0.5]", "hinges.beams", "gamma_share", "1.0", "0.6"],
        )
        refused(with_hinges("{at: both, yield_moment: 180 kN m, gamma_share: 0.5}"), ["gamma_share", "hinges.beams"])
        refused(
            with_hinges("{at: both, bilinear: {yield_moment: 180 kN m, gamma_share: 0.5}}"),
            ["gamma_share", "yield_moment", "stiffness", "stiffness_factor", "hinges.beams.bilinear"],
        )
        released = "      members: {beam x 1.0: {releases: {end: [ry]}}}\n"
        refused(
            with_hinges("{at: both, yield_moment: 180 kN m}").replace("      hinges", released + "      hinges"), "ry"
        )
        # 98 kN m at the foot of the bracket under gravity.
        refused(
            SHAKE
            + """structures:
  left:
    frame:
      material: {E: 30 GPa}
      nodes: {a: [0, 0], b: [1 m, 0]}
      members: {arm: {between: [a, b], section: {rectangle: [0.4, 0.4]}}}
      supports: {a: fixed}
      masses: {b: 10 t}
      floors: [{nodes: [b]}]
      gravity: true
      hinges: {arm: {at: start, yield_moment: 90 kN m}}
    damping: 5 %
"""
            + ANALYSIS % "1e-4",
            ["-98.07 kN m", "-90 kN m"],
        )

    def test_go_on_to_the_bit(self):
        for law, steps in zip(LAWS, (97, 211, 164, 283, 342)):
            whole, path = self.results(pair(LAWS[law]))
            self.assertGreater(whole["structures"]["left"]["yielding"]["yielded"], 4, law)
            again = self.resumed(steps, "part.h5")
            for summary in (whole, again):
                summary.pop("solver")
            self.assertEqual(again, whole)
            one, other = self.numbers(path), self.numbers(self.folder / "part.h5")
            self.assertEqual(one.keys(), other.keys())
            for name in one:
                with self.subTest(law=law, name=name):
                    self.assertTrue(one[name].tobytes() == other[name].tobytes())


if __name__ == "__main__":
    unittest.main()
