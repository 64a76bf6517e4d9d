"""A killed, stopped or cut run resumes in a new process, with results bitwise identical to those of an uninterrupted
one."""

import re
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np
from support import MASTS, OSCILLATORS, PROGRAM, ProgramTest, seal
from messages import assert_mentions

#: Durations with about one second of run time.
SECOND_ORDER = "integrator: generalized_alpha, spectral_radius: "
SCHEMES = {SECOND_ORDER + "1": 6, SECOND_ORDER + "0.8": 6, "integrator: esdirk4": 300}


def model(scheme=SECOND_ORDER + "1", duration=6, output="10 ms", more="checkpoint: {every: 0.05 s}\n"):
    text = OSCILLATORS.replace("duration: 3.0}}", f"duration: {duration}}}}}")
    return (
        text.replace("{duration: 3.0}", f"{{duration: {duration}, tolerance: 1e-8, output_step: {output}, {scheme}}}")
        + more
    )


def contents(path):
    """Every dataset except wall-clock times."""
    found = {}

    def look(name, item):
        if isinstance(item, h5py.Dataset) and "wall" not in name:
            # Texts are Python objects, whose bytes are addresses.
            found[name] = item.asstr()[()].astype(str) if item.dtype.hasobject and item.shape else item[()]

    with h5py.File(path) as file:
        file.visititems(look)
    found["summary"] = re.sub(rb'"wall\w*":[^,}]*', b"", found["summary"])
    return found


class Resumed(ProgramTest):
    def same(self, one, other):
        first, second = contents(self.folder / one), contents(self.folder / other)
        self.assertEqual(list(first), list(second))
        for name, values in first.items():
            self.assertEqual(np.asarray(values).tobytes(), np.asarray(second[name]).tobytes(), name)

    def done(self, *words):
        result = self.pounding("run", *words, "-q")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def start(self, *words):
        return subprocess.Popen([PROGRAM, "run", *words, "-q"], cwd=self.folder, stderr=subprocess.PIPE, text=True)

    def reached(self):
        with h5py.File(self.folder / "out.h5") as file:
            return file["time"][-1]

    def kill(self, *words, beyond=0.0):
        """Kills the run once its file has passed this time. On a slow disk the run may end before its second update:
        then it is repeated."""
        path = self.folder / "out.h5"
        before = path.read_bytes() if path.exists() else None
        for _ in range(5):
            run = self.start(*words)
            while run.poll() is None and not (path.exists() and self.reached() > beyond):
                time.sleep(0.002)
            run.kill()
            run.communicate()
            if run.returncode == -signal.SIGKILL and self.status() == "running":
                return
            path.unlink() if before is None else path.write_bytes(before)
        self.fail("the run ends before it can be killed")

    def status(self):
        with h5py.File(self.folder / "out.h5") as file:
            return file.attrs["status"]

    def cut(self, text=OSCILLATORS, *words):
        """A file whose run was cut after 100 steps, and its model."""
        self.write(text)
        cut = self.pounding("run", "model.yaml", "-q", "-o", "out.h5", "-pounding_ts_max_steps", "100", *words)
        self.assertEqual(cut.returncode, 3, cut.stderr)
        assert_mentions(cut.stderr, ["pounding run", "--resume", "out.h5"])


class Killed(Resumed):
    def test_goes_on_to_the_same_bits_by_every_scheme(self):
        for scheme, duration in SCHEMES.items():
            with self.subTest(scheme):
                tolerance = "1e-10" if "esdirk4" in scheme else "1e-8"
                self.write(model(scheme, duration).replace("1e-8", tolerance))
                self.done("model.yaml", "-o", "whole.h5")
                self.kill("model.yaml", "-o", "out.h5")
                self.done("--resume", "out.h5")
                self.same("whole.h5", "out.h5")
                (self.folder / "out.h5").unlink()

    def test_twice_goes_on_to_the_same_bits(self):
        self.write(model(duration=20))
        self.done("model.yaml", "-o", "whole.h5")
        self.kill("model.yaml", "-o", "out.h5")
        first = self.reached()
        self.kill("--resume", "out.h5", beyond=first)
        self.assertGreater(self.reached(), first)
        self.done("--resume", "out.h5")
        self.same("whole.h5", "out.h5")

    def test_right_at_its_beginning_goes_on(self):
        self.write(model(duration=3))
        self.done("model.yaml", "-o", "whole.h5")
        run = self.start("model.yaml", "-o", "out.h5")
        while not (self.folder / "out.h5").exists():
            time.sleep(0.001)
        run.kill()
        run.communicate()
        self.done("--resume", "out.h5")
        self.same("whole.h5", "out.h5")


class Stopped(Resumed):
    def test_by_a_signal_goes_on(self):
        self.write(model(more=""))
        self.done("model.yaml", "-o", "whole.h5")
        for number in (signal.SIGINT, signal.SIGTERM):
            run = self.start("model.yaml", "-o", "out.h5")
            while not (self.folder / "out.h5").exists():
                time.sleep(0.001)
            time.sleep(0.2)
            run.send_signal(number)
            _, errors = run.communicate(timeout=20)
            self.assertEqual(run.returncode, 3)
            assert_mentions(errors, ["pounding run", "--resume", "out.h5"])
            self.done("--resume", "out.h5")
            self.same("whole.h5", "out.h5")
            (self.folder / "out.h5").unlink()

    def test_by_a_limit_on_steps_goes_on_with_the_options_of_its_beginning(self):
        options = [
            "-pounding_ts_rtol",
            "1e-6",
            "-pounding_ts_pounding_scheme",
            "generalized_alpha",
            "-pounding_ts_pounding_radius",
            "0.9",
        ]
        self.cut(OSCILLATORS, *options)
        self.done("model.yaml", "-o", "whole.h5", *options)
        again = self.pounding("run", "--resume", "out.h5", "-q", "-pounding_ts_max_steps", "5000")
        self.assertEqual(again.returncode, 3, again.stderr)
        self.done("--resume", "out.h5", "-pounding_ts_rtol", "1e-6")
        self.same("whole.h5", "out.h5")

    def test_of_frames_that_turn_goes_on(self):
        for integrator in ("generalized_alpha", "esdirk4"):
            with self.subTest(integrator):
                self.write(MASTS.replace("tolerance: 1e-5", f"tolerance: 1e-5, integrator: {integrator}"))
                self.done("model.yaml", "-o", "whole.h5")
                cut = self.pounding("run", "model.yaml", "-q", "-o", "out.h5", "-pounding_ts_max_steps", "150")
                self.assertEqual(cut.returncode, 3, cut.stderr)
                self.done("--resume", "out.h5")
                self.same("whole.h5", "out.h5")

    def test_beside_a_run_without_links_goes_on_in_another_file(self):
        self.write(model(duration=6, more="compare: no_pounding\n"))
        run = self.start("model.yaml", "-o", "out.h5")
        while not (self.folder / "out.h5").exists() or not self.holds_a_checkpoint():
            self.assertIsNone(run.poll(), "the run ended before it was stopped")
            time.sleep(0.001)
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=20)
        self.assertEqual(run.returncode, 3)
        before = (self.folder / "out.h5").read_bytes()
        continued = self.summary("--resume", "out.h5", "-o", "other.h5")
        self.assertEqual((self.folder / "out.h5").read_bytes(), before)
        whole = self.summary("model.yaml")
        self.assertIn("no_pounding", whole)
        for summary in (continued, whole):
            del summary["solver"]["wall_seconds"]
        self.assertEqual(continued, whole)

    def holds_a_checkpoint(self):
        with h5py.File(self.folder / "out.h5") as file:
            return "checkpoint" in file

    def test_finds_the_record_beside_the_model_from_another_folder(self):
        (self.folder / "models").mkdir()
        (self.folder / "models/record.csv").write_text("".join(f"{0.02 * i}, {(i * 7) % 5 - 2}\n" for i in range(150)))
        text = OSCILLATORS.replace(
            "{harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}", "{record: record.csv, units: m/s^2}"
        )
        self.write(text, "models/model.yaml")
        self.done("models/model.yaml", "-o", "whole.h5")
        cut = self.pounding("run", "models/model.yaml", "-q", "-o", "out.h5", "-pounding_ts_max_steps", "100")
        self.assertEqual(cut.returncode, 3, cut.stderr)
        self.done("--resume", "out.h5")
        self.same("whole.h5", "out.h5")


class Frequency(Resumed):
    def test_in_simulated_time_is_kept(self):
        self.write(
            model(duration=20000, output="1 s", more="checkpoint: {every_simulated: 10 s}\n").replace("1e-8", "1e-5")
        )
        run = self.start("model.yaml", "-o", "out.h5")
        times = []
        deadline = time.monotonic() + 40
        while len(times) < 3 and time.monotonic() < deadline:
            self.assertIsNone(run.poll())
            if (self.folder / "out.h5").exists() and (reached := self.reached()) not in times:
                times.append(reached)
            time.sleep(0.002)
        run.kill()
        run.communicate()
        self.assertGreater(len(times), 1)
        self.assertGreaterEqual(np.diff(times).min(), 9)

    def test_in_run_time_is_kept(self):
        self.write(model(duration=1000, more="checkpoint: {every: 1000 s}\n"))
        run = self.start("model.yaml", "-o", "out.h5")
        while not (self.folder / "out.h5").exists():
            time.sleep(0.001)
        first = (self.folder / "out.h5").stat().st_ino
        time.sleep(2.5)
        self.assertIsNone(run.poll())
        self.assertEqual((self.folder / "out.h5").stat().st_ino, first)
        run.kill()
        run.communicate()

    def test_stands_in_the_resolved_model(self):
        file = self.write(model(more="checkpoint: {every: 2 min, every_simulated: 1}\n"))
        checked = self.pounding("check", file, "--resolved")
        assert_mentions(checked.stdout, ["every_simulated", "120"])

    def test_must_be_given_with_its_key(self):
        for wrong in ("true", "60 s", "{}"):
            self.refused(2, "checkpoint: {every: 60 s}", "check", self.write(model(more=f"checkpoint: {wrong}\n")))
        self.refused(2, ["evry", "every"], "check", self.write(model(more="checkpoint: {evry: 1}\n")))
        self.refused(2, "checkpoint.every", "check", self.write(model(more="checkpoint: {every: 0}\n")))


class Refused(Resumed):
    """Each with its reason; the file is unchanged."""

    def refuse(self, message, *words):
        path = self.folder / "out.h5"
        before = path.read_bytes()
        self.refused(2, message, "run", "-q", "--resume", "out.h5", *words)
        self.assertEqual(path.read_bytes(), before)

    def change(self, edit):
        with h5py.File(self.folder / "out.h5", "r+") as file:
            edit(file)
        seal(self.folder / "out.h5")

    def test_a_run_that_is_done(self):
        self.write(OSCILLATORS)
        self.done("model.yaml", "-o", "out.h5")
        self.refuse("out.h5")

    def test_a_file_without_a_checkpoint(self):
        self.cut()

        def edit(file):
            del file["checkpoint"]

        self.change(edit)
        self.refuse("out.h5")

    def test_another_version_of_the_program(self):
        self.cut()
        self.change(lambda file: file.attrs.modify("version", np.bytes_("0.0.1")))
        self.refuse(["out.h5", "0.0.1"])

    def test_another_model(self):
        self.cut()
        self.write(OSCILLATORS.replace("gap: 20 mm", "gap: 21 mm"), "other.yaml")
        self.refuse(["out.h5", "other.yaml", "7"], "other.yaml")
        self.done("model.yaml", "--resume", "out.h5")

    def test_a_record_that_has_changed(self):
        rows = [f"{0.02 * i}, {(i * 7) % 5 - 2}\n" for i in range(200)]
        (self.folder / "record.csv").write_text("".join(rows))
        self.cut(
            OSCILLATORS.replace(
                "{harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}", "{record: record.csv, units: m/s^2}"
            )
        )
        rows[100] = rows[100].replace("\n", ".0001\n")
        (self.folder / "record.csv").write_text("".join(rows))
        self.refuse("record")
        (self.folder / "record.csv").unlink()
        self.refuse("record.csv")

    def test_other_options(self):
        self.cut(OSCILLATORS, "-pounding_ts_rtol", "1e-5")
        self.refuse(["-pounding_ts_rtol", "out.h5", "1e-5", "1e-6"], "-pounding_ts_rtol", "1e-6")
        self.refuse(
            ["-pounding_ts_pounding_scheme", "-pounding_ts_rtol", "generalized_alpha", "1e-5"],
            "-pounding_ts_pounding_scheme",
            "generalized_alpha",
        )
        self.cut()
        self.refuse("-pounding_ts_pounding_radius", "-pounding_ts_pounding_radius", "0.8")

    def test_damaged_data(self):
        self.cut()

        def forget(file):
            del file["energy/kinetic"]

        self.change(forget)
        self.refuse(["out.h5", "HDF5"])

    def test_half_a_file(self):
        self.cut()
        path = self.folder / "out.h5"
        path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
        self.refuse("out.h5")

    def test_one_changed_bit(self):
        self.cut()
        path = self.folder / "out.h5"
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 1
        path.write_bytes(content)
        self.refuse("out.h5")

    def test_a_file_without_a_checksum(self):
        self.cut()
        path = self.folder / "out.h5"
        path.write_bytes(path.read_bytes()[512:])
        self.refuse("out.h5")

    def test_what_is_no_results_file(self):
        (self.folder / "out.h5").write_text("time, force\n")
        self.refuse("out.h5")
        (self.folder / "out.h5").write_text("")
        self.refuse("out.h5")
        self.refused(2, "none.h5", "run", "--resume", "none.h5")

    def test_an_adaptive_control_with_a_memory(self):
        self.write(OSCILLATORS)
        self.pounding(
            "run", "model.yaml", "-q", "-o", "out.h5", "-pounding_ts_max_steps", "100", "-pounding_ts_adapt_type", "dsp"
        )
        self.refuse("out.h5")


if __name__ == "__main__":
    unittest.main()
