"""Envelopes, the run without links next to the run with them, and floor spectra, in the program's output and in the
file."""

import csv
import json
import unittest

import h5py
import numpy as np
from support import OSCILLATORS, ProgramTest, bits
from messages import assert_mentions

APART = OSCILLATORS[: OSCILLATORS.index("links:")] + OSCILLATORS[OSCILLATORS.index("analysis:") :]


def datasets(group):
    found = {}
    group.visititems(lambda name, item: found.update({name: item}) if isinstance(item, h5py.Dataset) else None)
    return found


def peak_responses(time, accelerations, periods, damping):
    """[period, motion]: largest |u| of u'' + 2 z w u' + w^2 u = -a(t) by the Runge-Kutta method of order four with four
    steps per sample, until one longest period after the end. `accelerations` [time, motion]."""
    w = 2 * np.pi / np.asarray(periods)[:, None]
    step = (time[1] - time[0]) / 4
    count = int(np.ceil((time[-1] + max(periods)) / step))
    halves = np.arange(2 * count + 1) * step / 2
    a = np.stack([np.interp(halves, time, motion, right=0.0) for motion in accelerations.T], axis=-1)
    y = np.zeros((2, len(periods), a.shape[1]))
    largest = np.zeros(y.shape[1:])

    def rate(y, a):
        return np.stack([y[1], -a - 2 * damping * w * y[1] - w * w * y[0]])

    for i in range(count):
        k1 = rate(y, a[2 * i])
        k2 = rate(y + step / 2 * k1, a[2 * i + 1])
        k3 = rate(y + step / 2 * k2, a[2 * i + 1])
        k4 = rate(y + step * k3, a[2 * i + 2])
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        np.maximum(largest, np.abs(y[0]), out=largest)
    return largest


class Envelopes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write(OSCILLATORS)
        self.printed = self.summary("model.yaml", "-o", "out.h5")

    def test_hold_least_and_largest_values_with_their_times(self):
        with h5py.File(self.folder / "out.h5") as file:
            for name, printed in self.printed["structures"].items():
                envelope, structure = file[f"envelopes/structures/{name}"], file[f"structures/{name}"]
                self.assertEqual(
                    {key for key, data in envelope.items() if not data.is_scale},
                    {
                        f"{key}{end}"
                        for end in ("", "_time")
                        for key in ("displacement", "acceleration", "drift", "storey_shear", "base_shear")
                    },
                )
                self.assertEqual(envelope["displacement"].shape, (1, 1, 2))
                least, largest = envelope["displacement"][0, 0]
                self.assertEqual(max(-least, largest), printed["peak_displacement"][0])
                self.assertLessEqual(least, structure["displacement"][:].min())
                self.assertGreaterEqual(largest, structure["displacement"][:].max())
                # Outputs, 3 ms apart, are close to the extremes.
                near = np.argmin(np.abs(file["time"][:] - envelope["displacement_time"][0, 0, 1]))
                self.assertAlmostEqual(structure["displacement"][near, 0, 0] / largest, 1, delta=0.01)
                np.testing.assert_array_equal(envelope["base_shear"][:], envelope["storey_shear"][:1])
                kept = printed["envelope"]["storey_shear"]
                self.assertEqual([kept["min"][0], kept["max"][0]], list(envelope["storey_shear"][0, 0]))
                self.assertEqual([kept["t_min"][0], kept["t_max"][0]], list(envelope["storey_shear_time"][0, 0]))

    def test_impacts_are_listed(self):
        with h5py.File(self.folder / "out.h5") as file:
            rows = file["impacts"][:]
        listed = self.printed["impacts"]
        self.assertEqual(len(listed), len(rows))
        for impact, row in zip(listed, rows):
            self.assertEqual(impact["link"], row["link"].decode())
            for key in (
                "t_start",
                "t_end",
                "v_approach",
                "restitution",
                "peak_force",
                "t_peak",
                "peak_penetration",
                "impulse",
            ):
                self.assertEqual(impact[key], row[key], key)

    def test_are_in_the_report(self):
        done = self.pounding("run", "model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        line = next(line for line in done.stdout.splitlines() if "base shear (kN)" in line)
        kept = self.printed["structures"]["left"]["envelope"]["base_shear"]
        self.assertEqual(
            line.split(),
            [
                "left",
                "base",
                "shear",
                "(kN)",
                f"{kept['min'][0] / 1e3:.3f}",
                f"{kept['t_min'][0]:.3f}",
                f"{kept['max'][0] / 1e3:.3f}",
                f"{kept['t_max'][0]:.3f}",
            ],
        )


class WithoutLinks(ProgramTest):
    def test_is_kept_whole(self):
        self.write(OSCILLATORS + "compare: no_pounding\n")
        self.write(APART, "apart.yaml")
        printed = self.summary("model.yaml", "-o", "both.h5")
        self.summary("apart.yaml", "-o", "apart.h5")
        with h5py.File(self.folder / "both.h5") as both, h5py.File(self.folder / "apart.h5") as apart:
            kept, alone = datasets(both["no_pounding"]), datasets(apart)
            self.assertEqual(set(kept), {name for name in alone if not name.startswith("input/")})
            self.assertEqual(both["no_pounding"].attrs["status"], "done")
            self.assertEqual(both["no_pounding"].attrs["title"], "Two oscillators")
            self.assertEqual(len(both["no_pounding/impacts"]), 0)
            for name, data in kept.items():
                self.assertLessEqual({"units", "long_name"}, set(data.attrs), name)
            for name in ("left", "right"):
                np.testing.assert_allclose(
                    kept[f"structures/{name}/displacement"][:],
                    alone[f"structures/{name}/displacement"][:],
                    atol=1e-3 * np.abs(alone[f"structures/{name}/displacement"][:]).max(),
                )
            self.assertEqual(json.loads(kept["summary"][()])["structures"], printed["no_pounding"]["structures"])
            [pair] = printed["no_pounding"]["separations"]
            approach = (kept["structures/left/displacement"][:] - kept["structures/right/displacement"][:]).max()
            self.assertAlmostEqual(pair["enough"] / approach, 1, delta=1e-3)
            self.assertGreater(pair["enough"], pair["gap"])
            self.assertLess(pair["ddc"], pair["abs"])
        report = self.pounding("run", "model.yaml").stdout
        line = next(line for line in report.splitlines() if line.startswith("left-right  ") and "20.0000" in line)
        self.assertIn(f"{1e3 * pair['enough']:.4f}", line)
        self.assertIn(f"{1e3 * pair['srss']:.4f}", line)

    def test_survives_a_resume(self):
        self.write(OSCILLATORS + "compare: no_pounding\n")
        self.summary("model.yaml", "-o", "whole.h5")
        cut = self.pounding("run", "model.yaml", "-q", "-o", "cut.h5", "-pounding_ts_max_steps", "150")
        self.assertEqual(cut.returncode, 3, cut.stderr)
        self.summary("--resume", "cut.h5")
        with h5py.File(self.folder / "whole.h5") as whole, h5py.File(self.folder / "cut.h5") as resumed:
            expected, found = datasets(whole), datasets(resumed)
            self.assertEqual(set(expected), set(found))
            for name, data in expected.items():
                if "wall_" in name or name.endswith("summary"):
                    continue
                self.assertEqual(
                    bits(data[()]) if data.shape else data[()],
                    bits(found[name][()]) if data.shape else found[name][()],
                    name,
                )


#: A space building that rotates about its stiff corner next to the one that it hits; and one without rigid floors.
CORNER = """\
ground_motion:
  components:
    x: {{pulse: {{shape: sine, amplitude: 6 m/s^2, duration: 0.5 s}}}}
    y: {{pulse: {{shape: half_sine, amplitude: 4 m/s^2, duration: 0.4 s}}}}
structures:
  corner:
    frame:
      material: {{E: 30 GPa, density: 2500}}
      sections: {{C: {{rectangle: [0.45, 0.45]}}, W: {{rectangle: [1.0, 1.0]}}, B: {{rectangle: [0.3, 0.5]}}}}
      grid: {{storeys: 2, bays: [1, 1], storey_height: 3.2 m, bay_width: {{x: 5 m, y: 4 m}}, floor_mass: 60 t, columns: [[W, C, C, C], [W, C, C, C]], beams: B}}
      report: {{members: all}}
      {gravity}
    damping: 5 %
  loose:
    frame:
      origin: [5.002, 0]
      material: {{E: 30 GPa, density: 2500}}
      mass: consistent
      grid: {{storeys: 1, bays: [1, 1], storey_height: 3.2 m, bay_width: {{x: 5 m, y: 4 m}}, floor_mass: 60 t, rigid_floors: false,
             columns: {{rectangle: [0.45, 0.45]}}, beams: {{rectangle: [0.3, 0.5]}}}}
    damping: 5 %
links: [{{between: [corner, loose], floors: level, points: 1, law: hertz_damped, stiffness: 1e9, restitution: 0.6}}]
analysis: {{duration: 1.2 s, output_step: {step}}}
compare: no_pounding
"""


class Torsion(ProgramTest):
    def test_of_rigid_floors_is_in_every_table(self):
        self.write(CORNER.format(gravity="gravity: true", step="0.2 ms"))
        printed = self.summary("model.yaml", "-o", "out.h5")["structures"]
        self.assertNotIn("peak_rotation", printed["loose"])
        with h5py.File(self.folder / "out.h5") as file:
            structure, envelope = file["structures/corner"], file["envelopes/structures/corner"]
            self.assertNotIn("edge_displacement", file["envelopes/structures/loose"])
            self.assertNotIn("plan", file["structures/loose"])
            names = [name.decode() for name in structure["nodes/names"][:]]
            moved = structure["nodes/displacement"][:]
            # The corners of the plan are the columns; an edge moves along itself with its nodes.
            corners = [moved[:, names.index(f"2.{i}.{k}")] for i in (0, 1) for k in (0, 1)]
            edges = np.stack([corners[0][:, 0], corners[1][:, 0], corners[0][:, 1], corners[2][:, 1]], axis=1)
            dense = np.stack([edges.min(axis=0), edges.max(axis=0)], axis=-1)
            np.testing.assert_allclose(envelope["edge_displacement"][1], dense, atol=1e-4 * np.abs(dense).max())
            # Extremes between steps are those of cubics.
            self.assertTrue((envelope["edge_displacement"][1, :, 0] <= dense[:, 0] + 1e-5 * np.abs(dense).max()).all())
            largest = max(np.hypot(*corner[:, :2].T).max() for corner in corners)
            rotation = np.abs(structure["displacement"][:, 1, 2]).max()
            self.assertGreater(rotation, 1e-3)
            self.assertAlmostEqual(printed["corner"]["peak_edge_displacement"][1] / largest, 1, delta=1e-4)
            self.assertAlmostEqual(printed["corner"]["peak_rotation"][1] / rotation, 1, delta=1e-4)
            self.assertGreater(largest, 1.05 * printed["corner"]["peak_displacement"][1])
            self.assertEqual(structure["plan"].shape, (2, 4))
            np.testing.assert_allclose(np.diff(structure["plan"][:].reshape(2, 2, 2), axis=2)[..., 0], [[5, 4], [5, 4]])
            self.assertGreater(np.abs(file["ground/acceleration_y"][:]).max(), 3.9)
            self.assertNotIn("acceleration_z", file["ground"])
            without = file["no_pounding/envelopes/structures/corner/edge_displacement"]
            self.assertFalse(np.allclose(without[:], envelope["edge_displacement"][:]))
        report = self.pounding("run", "model.yaml").stdout
        table = report[report.index("structure  floor      rotation") :].splitlines()
        self.assertEqual(table[0].split()[-1], "ratio")
        self.assertEqual([line.split()[:2] for line in table[2:4]], [["corner", "2"], ["corner", "1"]])
        self.assertIn(f"{1e3 * printed['corner']['peak_edge_displacement'][1]:.4f}", table[2])

    def test_survives_a_resume(self):
        self.write(CORNER.format(gravity="", step="5 ms"))
        whole = self.summary("model.yaml", "-o", "whole.h5")
        resumed = self.resumed(60, "cut.h5")
        self.assertEqual(whole["structures"], resumed["structures"])
        with h5py.File(self.folder / "whole.h5") as expected, h5py.File(self.folder / "cut.h5") as found:
            for place in (
                "ground/acceleration_y",
                "envelopes/structures/corner/edge_displacement",
                "structures/corner/plan",
            ):
                np.testing.assert_array_equal(expected[place][:], found[place][:])


class MemberForces(ProgramTest):
    def test_have_one_sign_and_say_what_they_include(self):
        for gravity, expected in (("gravity: true", True), ("geometry: p_delta", True), ("", False)):
            with self.subTest(gravity):
                self.write(CORNER.format(gravity=gravity, step="5 ms"))
                envelope = self.summary("model.yaml", "-o", "out.h5")["structures"]["corner"]["envelope"]
                self.assertEqual(envelope["gravity_included"], expected)
                self.assertEqual("P-Delta" in envelope["included"], "p_delta" in gravity)
                start, end = (envelope["components"].index(f"{one} N") for one in ("start", "end"))
                forces = envelope["member_force"]
                for i, name in enumerate(envelope["members"]):
                    self.assertEqual(
                        envelope["axial_force"]["min"][i], min(-forces["max"][i][start], forces["min"][i][end]), name
                    )
                    self.assertEqual(
                        envelope["axial_force"]["max"][i], max(-forces["min"][i][start], forces["max"][i][end]), name
                    )
                with h5py.File(self.folder / "out.h5") as file:
                    group = file["envelopes/structures/corner"]
                    np.testing.assert_array_equal(group["axial_force"][:, 0, 1], envelope["axial_force"]["max"])
                    for data in (
                        group["member_force"],
                        group["axial_force"],
                        group["reaction"],
                        file["structures/corner/members/end_forces"],
                        file["structures/corner/reactions/force"],
                    ):
                        self.assertEqual(bool(data.attrs["gravity_included"]), expected)
                report = self.pounding("run", "model.yaml").stdout
                line = next(line for line in report.splitlines() if line.startswith("corner") and " N (kN) " in line)
                least, largest = float(line.split()[3]), float(line.split()[5])
                self.assertAlmostEqual(least, min(envelope["axial_force"]["min"]) / 1e3, places=3)
                # Beams in rigid floors have no axial force and do not count.
                pairs = [
                    pair
                    for pair in zip(envelope["axial_force"]["min"], envelope["axial_force"]["max"])
                    if max(-pair[0], pair[1]) > 1
                ]
                self.assertAlmostEqual(largest, max(high for _, high in pairs) / 1e3, places=3)
                self.assertEqual(largest < 0, expected, "under their weight columns stay compressed")
                assert_mentions(report, "corner")
                self.assertIn(
                    "corner, loose: gravity is not included" if not expected else "corner: gravity is included", report
                )
                uplift = next(
                    line for line in report.splitlines() if line.startswith("corner") and " reaction z (kN) " in line
                )
                vertical = envelope["directions"].index("z")
                self.assertAlmostEqual(
                    float(uplift.split()[4]), min(one[vertical] for one in envelope["reaction"]["min"]) / 1e3, places=3
                )

    def test_of_a_column_under_its_weight_are_compression(self):
        self.write("""\
structures:
  hanging:
    frame:
      material: {E: 30 GPa}
      nodes: {a: [0, 0], b: [0, 3 m], c: [0, 6 m]}
      members: {low: {between: [a, b], section: {rectangle: [0.4, 0.4]}}, top: {between: [c, b], section: {rectangle: [0.4, 0.4]}}}
      supports: {a: fixed, c: fixed}
      floors: [{nodes: [b]}]
      masses: {b: 60 t}
      gravity: true
    damping: 5 %
    initial_displacement: 1 mm
analysis: {duration: 0.1 s, output_step: 1 ms}
""")
        printed = self.summary("model.yaml")["structures"]["hanging"]["envelope"]
        half = 30e3 * 9.80665
        np.testing.assert_allclose(
            [printed["axial_force"]["min"], printed["axial_force"]["max"]], [[-half, half], [-half, half]], rtol=1e-6
        )


class Spectra(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write(
            OSCILLATORS.replace("{duration: 3.0}\n", "{duration: 3.0, output_step: 0.5 ms}\n")
            + "compare: no_pounding\n"
        )
        self.summary("model.yaml", "-o", "out.h5")

    def test_of_a_floor_are_those_of_an_independent_integration(self):
        done = self.pounding(
            "spectrum", "out.h5", "--floor", "right.1", "--damping", "3 %", "--periods", "0.1:1.6:5", "--csv", "s.csv"
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(self.folder / "s.csv", newline="") as file:
            head, *rows = csv.reader(file)
        self.assertEqual(head[:2], ["period (s)", "with links sd (m)"])
        self.assertEqual(head[4], "without links sd (m)")
        with h5py.File(self.folder / "out.h5") as file:
            motions = [file[f"{root}structures/right/acceleration"][:, 0, 0] for root in ("", "no_pounding/")]
            expected = peak_responses(
                file["time"][:], np.stack(motions, axis=-1), [float(row[0]) for row in rows], 0.03
            )
        for row, (with_links, without) in zip(rows, expected):
            # Its samples are 1/800 of the shortest period apart.
            self.assertAlmostEqual(float(row[1]) / with_links, 1, delta=1e-4)
            self.assertAlmostEqual(float(row[4]) / without, 1, delta=1e-4)
            self.assertAlmostEqual(float(row[3]) / (float(row[1]) * (2 * np.pi / float(row[0])) ** 2), 1, places=8)

    def test_are_printed_and_drawn(self):
        done = self.pounding("spectrum", "out.h5", "--floor", "left.1", "--periods", "0.1:1:3")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        assert_mentions(lines[0], ["left.1", "0.0005 s", "5 %"])
        self.assertEqual(lines[1].split(), ["with", "links", "without", "links"])
        self.assertEqual(len(lines), 6)
        self.assertEqual(self.pounding("spectrum", "out.h5", "--floor", "left.1", "--picture", "s.png").returncode, 0)
        self.assertEqual((self.folder / "s.png").read_bytes()[1:4], b"PNG")

    def test_that_miss_a_peak_are_not_drawn(self):
        self.write(OSCILLATORS.replace("{duration: 3.0}\n", "{duration: 3.0, output_step: 50 ms}\n"), "coarse.yaml")
        self.summary("coarse.yaml", "-o", "coarse.h5")
        self.refused(2, ["left.1", "0.05 s"], "spectrum", "coarse.h5", "--floor", "left.1", "--picture", "s.png")
        self.assertFalse((self.folder / "s.png").exists())

    def test_pictures_leave_out_periods_that_the_outputs_do_not_resolve(self):
        self.write(OSCILLATORS, "coarse.yaml")
        self.summary("coarse.yaml", "-o", "coarse.h5")
        done = self.pounding("spectrum", "coarse.h5", "--floor", "left.1", "--picture", "s.png")
        self.assertEqual((done.returncode, (self.folder / "s.png").exists()), (0, True))
        assert_mentions(done.stderr, ["0.02 s", "10", "0.03 s"])
        self.refused(
            2,
            ["0.005 s", "10"],
            "spectrum",
            "coarse.h5",
            "--floor",
            "left.1",
            "--periods",
            "0.005:0.02:5",
            "--picture",
            "t.png",
        )

    def test_of_outputs_too_far_apart_warn(self):
        self.write(OSCILLATORS, "coarse.yaml")
        self.summary("coarse.yaml", "-o", "coarse.h5")
        done = self.pounding("spectrum", "coarse.h5", "--floor", "left.1")
        self.assertEqual(done.returncode, 0)
        assert_mentions(done.stderr, ["left.1", "0.003 s", "analysis: {output_step: 0.0003}"])

    def test_refuse_what_is_not_there(self):
        for words, message in (
            (["--floor", "middle.1"], "middle"),
            (["--floor", "left.2"], "1"),
            (["--floor", "left"], "left.3"),
            (["--floor", "left.1", "--direction", "y"], ()),
            (["--floor", "left.1", "--damping", "1.5"], "[0, 1)"),
            (["--floor", "left.1", "--periods", "1"], ()),
        ):
            with self.subTest(words):
                self.refused(2, message, "spectrum", "out.h5", *words)
        self.refused(2, [], "spectrum", "model.yaml", "--floor", "left.1")


if __name__ == "__main__":
    unittest.main()
