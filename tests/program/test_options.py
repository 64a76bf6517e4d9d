"""PETSc's options on the command line of `pounding run`."""

import json
import os
import unittest

import h5py
from support import OSCILLATORS, ProgramTest
from messages import assert_mentions


FRAME = (
    "{frame: {origin: [X], material: {E: 30 GPa}, grid: {storeys: 12, bays: 3, storey_height: 3.2, bay_width: 6, columns: {rectangle: [0.6, "
    "0.6]}, beams: {rectangle: [0.3, 0.6]}, floor_mass: M}}, damping: 5 %}"
)
FRAMES = (
    "ground_motion: {harmonic: {amplitude: 4, period: 1.2, duration: 2}}\nstructures:\n"
    f"  left: {FRAME.replace('X', '0').replace('M', '120 t')}\n  right: {FRAME.replace('X', '18.02').replace('M', '60 t')}\n"
    "links: [{between: [left.12, right.12], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]\n"
    "analysis: {duration: 2}\n"
)


class Options(ProgramTest):
    def told(self, *words):
        """Summary of a run with warnings."""
        done = self.pounding("run", *words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_reach_the_time_stepping(self):
        self.write(OSCILLATORS.replace("{duration: 3.0}\n", "{duration: 3.0, integrator: generalized_alpha}\n"))
        usual = self.summary("model.yaml")
        finer = self.summary("model.yaml", "-pounding_ts_rtol", "1e-7")
        self.assertGreater(finer["solver"]["steps"], 5 * usual["solver"]["steps"])
        self.assertLess(finer["energy"]["error"], usual["energy"]["error"])

    def test_have_the_last_word_over_the_model(self):
        self.write(OSCILLATORS.replace("{duration: 3.0}", "{duration: 3.0, tolerance: 1e-7}"))
        written = self.summary("model.yaml")
        self.write(OSCILLATORS)
        typed = self.summary("model.yaml", "-pounding_ts_rtol", "1e-7")
        self.assertEqual(typed["links"], written["links"])

    def test_of_the_tolerance_hold_for_warnings(self):
        def energy(told):
            return [text for text in told["warnings"] if "energ" in text]

        fine = self.write(OSCILLATORS.replace("{duration: 3.0}", "{duration: 3.0, tolerance: 1e-9}"))
        self.assertEqual(energy(self.told(fine, "-pounding_ts_rtol", "1e-3")), [])
        done = self.pounding("run", fine, "-q", "-pounding_ts_rtol", "0.05")
        self.assertEqual(done.stderr.count("tolerance of 0.05"), 1)
        coarse = self.write(OSCILLATORS.replace("{duration: 3.0}", "{duration: 3.0, tolerance: 0.05}"))
        self.assertEqual(self.told(coarse, "-pounding_ts_rtol", "1e-4")["warnings"], [])

    def test_of_adaptivity_need_its_type(self):
        path = self.write(OSCILLATORS)
        self.refused(
            2,
            ["-pounding_ts_adapt_safety 0.5", "-pounding_ts_adapt_type basic"],
            "run",
            path,
            "--json",
            "-pounding_ts_adapt_safety",
            "0.5",
        )
        usual, basic = self.summary(path), self.summary(path, "-pounding_ts_adapt_type", "basic")
        self.assertEqual(basic["solver"]["steps"], usual["solver"]["steps"])
        self.assertEqual(basic["links"], usual["links"])
        careful = self.summary(path, "-pounding_ts_adapt_type", "basic", "-pounding_ts_adapt_safety", "0.5")
        self.assertGreater(careful["solver"]["steps"], usual["solver"]["steps"])

    def test_of_the_integrator_change_its_damping(self):
        done = self.pounding(
            "run",
            self.write(OSCILLATORS),
            "-q",
            "-pounding_ts_pounding_scheme",
            "generalized_alpha",
            "-pounding_ts_pounding_radius",
            "0.8",
            "-pounding_ts_view",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions(done.stdout, "0.8")

    def test_of_the_damping_of_another_integrator_are_an_error(self):
        self.refused(
            2,
            ["-pounding_ts_pounding_radius", "-pounding_ts_pounding_scheme", "generalized_alpha"],
            "run",
            self.write(OSCILLATORS),
            "--json",
            "-pounding_ts_pounding_radius",
            "0.8",
        )

    def test_name_the_integrator_that_the_report_tells(self):
        path = self.write(OSCILLATORS)
        for options, used in (
            ((), "esdirk4"),
            (("-pounding_ts_pounding_scheme", "generalized_alpha"), "generalized_alpha"),
        ):
            done = self.pounding("run", path, "-o", "out.h5", *options)
            assert_mentions(done.stdout, f"{used}")
            self.assertEqual(self.summary(path, *options)["solver"]["integrator"], used)
            with h5py.File(self.folder / "out.h5") as file:
                self.assertEqual(file["solver"].attrs["integrator"], used)

    def test_of_reduction_leave_small_structures_as_they_are(self):
        path = self.write(OSCILLATORS)
        usual, asked = self.summary(path), self.told(path, "-pounding_red_auto")
        self.assertEqual(asked["links"], usual["links"])
        self.assertIn("reduc", " ".join(asked["warnings"]))
        self.assertNotIn("reduce", " ".join(usual["warnings"]))

    def test_of_reduction_reduce_what_they_can(self):
        path = self.write(FRAMES)
        usual, reduced = self.summary(path), self.told(path, "-pounding_red_links", "5")
        self.assertNotIn("reduction", usual["solver"])
        told = reduced["solver"]["reduction"]["left"]
        self.assertEqual(told["blocks"], [5, 20])
        self.assertEqual(told["inputs"], {"links": 1, "friction": 0, "devices": 0, "parts": 0, "ground": 1})
        self.assertLess(told["coordinates"], told["unknowns"])
        peak, found = usual["links"][0]["peak_force"], reduced["links"][0]["peak_force"]
        self.assertNotEqual(found, peak)
        # In addition to its estimated error each run may be off by the tolerance 1e-4.
        self.assertLess(abs(found - peak), (told["error_force"] + 2e-4) * peak)
        done = self.pounding("run", path, "-o", "out.h5", "-pounding_red_links", "5")
        assert_mentions(done.stdout, ["5", "20", "reduction: forces"])
        with h5py.File(self.folder / "out.h5") as file:
            left = file["solver/reduction/left"]
            self.assertEqual(list(left["blocks"]), [5, 20])
            self.assertEqual(list(left["inputs"]), [1, 0, 0, 0, 1])
            for name in ("error_force", "error_displacement", "error_acceleration", "error_members"):
                self.assertEqual(left[name][()], told[name])

    def test_of_reduction_keep_modes_for_the_next_run(self):
        path, folder = self.write(FRAMES), self.folder / "of all/modes"
        reduced = ("-pounding_red_links", "5")
        made = self.told(path, *reduced)
        kept, found = (
            self.told(path, *reduced, "-pounding_red_cache", str(folder.parent) + "/modes") for _ in range(2)
        )
        self.assertEqual(len(list(folder.iterdir())), 2)
        for other in (kept, found):
            for part in ("links", "structures", "energy"):
                self.assertEqual(other[part], made[part])
            self.assertEqual(other["solver"]["reduction"], made["solver"]["reduction"])
        for path_of_modes in list(folder.iterdir()):
            path_of_modes.unlink()
            os.mkfifo(path_of_modes)
        self.assertEqual(self.told(path, *reduced, "-pounding_red_cache", str(folder))["links"], made["links"])
        self.assertTrue(all(one.is_file() for one in folder.iterdir()))
        # Structures that are not reduced are not cached, and a run resumes with or without the folder.
        self.assertEqual(self.told(path, "-pounding_red_cache", "none")["links"], self.told(path)["links"])
        self.assertFalse((self.folder / "none").exists())
        cut = self.pounding(
            "run", path, "-o", "out.h5", *reduced, "-pounding_red_cache", str(folder), "-pounding_ts_max_steps", "100"
        )
        self.assertNotEqual(cut.returncode, 0)
        with h5py.File(self.folder / "out.h5") as file:
            self.assertNotIn(
                "cache",
                str(list(file["checkpoint"].attrs.values())) + str([x[()] for x in file["checkpoint"].values()]),
            )
        (self.folder / "file").write_text("")
        self.refused(
            2, ["file", "-pounding_red_cache", "FOLDER"], "run", path, "--json", *reduced, "-pounding_red_cache", "file"
        )

    def test_of_reduction_go_before_the_words_of_the_model(self):
        words = FRAMES.replace("analysis: {", "analysis: {reduction: {links: 3, ground: 8}, ")
        path = self.write(words)
        self.assertEqual(self.told(path)["solver"]["reduction"]["left"]["blocks"], [3, 8])
        self.assertEqual(self.told(path, "-pounding_red_links", "5")["solver"]["reduction"]["left"]["blocks"], [5, 20])
        self.refused(2, "-pounding_ts_pounding_base", "run", path, "--json", "-pounding_ts_pounding_base", "modal")

    def test_of_reduction_with_wrong_numbers_are_an_error(self):
        self.refused(
            2,
            ["[1, 100]", "-pounding_red_links", "5"],
            "run",
            self.write(OSCILLATORS),
            "--json",
            "-pounding_red_links",
            "0",
        )
        large = (
            FRAMES.replace("storeys: 12, bays: 3", "storeys: 30, bays: 9")
            .replace("18.02", "54.02")
            .replace("law: hertz_damped, stiffness: 2.75e9", "law: stereomechanical")
        )
        self.refused(2, "left.12-right.12", "run", self.write(large), "--json", "-pounding_red_links", "5")

    def test_that_nothing_reads_are_an_error(self):
        self.refused(
            2,
            "-pounding_ts_rtoll",
            "run",
            self.write(OSCILLATORS),
            "--json",
            "-o",
            "out.h5",
            "-pounding_ts_rtoll",
            "1e-7",
        )
        self.assertFalse((self.folder / "out.h5").exists())

    def test_with_values_that_cannot_be_are_an_error(self):
        self.refused(2, "-pounding_", "run", self.write(OSCILLATORS), "--json", "-pounding_ts_rtol", "abc")

    def test_that_end_the_run_early_make_it_a_failed_one(self):
        self.refused(3, [], "run", self.write(OSCILLATORS), "-q", "-pounding_ts_max_steps", "5")

    def test_without_the_prefix_are_an_error(self):
        self.refused(
            2, ["-ts_rtol", "-pounding_", "PETSc"], "run", self.write(OSCILLATORS), "--json", "-ts_rtol", "1e-7"
        )

    def test_that_ask_for_another_integrator_are_an_error(self):
        self.refused(
            2, ["pounding", "-pounding_ts_type"], "run", self.write(OSCILLATORS), "--json", "-pounding_ts_type", "rk"
        )

    def test_of_an_impossible_tolerance_are_an_error(self):
        self.refused(
            2,
            ["[1e-10, 0.1]", "-pounding_ts_rtol", "2"],
            "run",
            self.write(OSCILLATORS),
            "--json",
            "-pounding_ts_rtol",
            "2",
        )


if __name__ == "__main__":
    unittest.main()
