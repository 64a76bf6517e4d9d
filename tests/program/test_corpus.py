"""Invalid texts: each ends with a message, in bounded time and memory.

`tests/corpus` has one small file per fault, in folders for models, units (each a quantity that should be a mass) and
records. A file whose name begins with fine_ is valid. Larger files are generated here.
"""

import json
import os
import resource
import signal
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

from support import PROGRAM
from messages import assert_mentions

CORPUS = Path(__file__).parent.parent / "corpus"
#: Limits on processor time [s], memory [bytes] and length of a message [bytes], and the wait for a busy machine [s].
PATIENCE, MEMORY, LONGEST, WAIT = 10, 1_000_000_000, 2000, 100

MODEL = (CORPUS / "model" / "fine_plain.yaml").read_text()


def limited():
    """Far above MEMORY, so that a text that exhausts memory fails without affecting other programs."""
    resource.setrlimit(resource.RLIMIT_AS, (6_000_000_000, 6_000_000_000))


class CorpusTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, text, name="m.yaml"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def outcome(self, *words):
        """Exit code and output, after the checks that apply to every text."""
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as told:
            process = subprocess.Popen(
                [PROGRAM, *map(str, words)],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=told,
                cwd=self.folder,
                preexec_fn=limited,
            )
            patience = threading.Timer(WAIT, process.kill)
            patience.start()
            _, status, used = os.wait4(process.pid, 0)
            patience.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            out.seek(0)
            told.seek(0)
            printed, message = out.read().decode(), told.read().decode()
        self.assertNotEqual(process.returncode, -signal.SIGKILL, "it took too long")
        self.assertLess(used.ru_utime + used.ru_stime, PATIENCE)
        self.assertLess(used.ru_maxrss * 1024, MEMORY)
        self.assertFalse({c for c in printed + message if not c.isprintable() and c not in "\n\u00a0"})
        self.assertLess(len(message.encode()), LONGEST)
        return process.returncode, message

    def refused(self, *words, facts=()):
        code, message = self.outcome(*words)
        self.assertEqual(code, 2, message)
        self.assertTrue(message.startswith("pounding: ") and len(message) > 20, message)
        assert_mentions(message, facts)
        return message

    def replay(self, folder, words_for):
        files = sorted(
            file for file in (CORPUS / folder).rglob("*") if file.is_file() and file.name != ".gitattributes"
        )
        self.assertGreater(len(files), 10)
        for file in files:
            with self.subTest(file=str(file.relative_to(CORPUS))):
                if not file.name.startswith("fine_"):
                    self.refused(*words_for(file))
                    continue
                code, message = self.outcome(*words_for(file))
                self.assertEqual(code, 0, message)


class Models(CorpusTest):
    def test_of_the_corpus(self):
        self.replay("model", lambda file: ["check", file])

    def test_by_every_verb(self):
        for verb in ("run", "modes", "sensitivity"):
            with self.subTest(verb=verb):
                self.refused(
                    verb, CORPUS / "model" / "yaml" / "comma.yaml", facts=["comma.yaml:1:1", "second YAML document"]
                )

    def test_are_refused_at_their_place(self):
        for name, facts in {
            "comma_after_map": [":1:11:", "second YAML document"],
            "second_document": [":8:1:", "second YAML document"],
            "latin1_comment": [":1:4:", "byte FC", "UTF-8"],
            "latin1_title": [":1:9:", "byte F6", "UTF-8"],
            "utf16": [":1:1:", "UTF-16", "UTF-8"],
            "utf16_without_mark": [":1:1:", "UTF-16"],
            "utf32": [":1:1:", "UTF-32"],
            "mac_lines": [":1:25:", "carriage return"],
            "zero_byte": [":1:9:", "control character \\x00"],
            "zero_in_name": [":3:3:", '"a\\x00b"', "control character \\x00"],
            "line_feed_in_name": [":3:3: structures.a\\nb:", '"a\\nb"', "control character"],
            "tab_in_link_name": ["links[0].name:", '"a\\tb"', "control character"],
            "aliases_ten_of_ten": ["1000000 values"],
            "alias_of_itself": [":2:6:", "alias"],
            "merge_key": [":5:5:", "<<"],
            "deep_by_aliases": ["64"],
            "period_1e308": [":3:39: structures.a.oscillator.period:", "m (2 pi/T)^2"],
            "floor_beyond_int": [":6:16: links[0].between[0]:", '"a.99999999999"'],
        }.items():
            with self.subTest(name=name):
                self.refused("check", next((CORPUS / "model").rglob(f"{name}.yaml")), facts=facts)

    def test_beyond_all_measure(self):
        for name, text in {
            "lists": "[" * 200_000,
            "maps": "{a: " * 200_000,
            "items": "- " * 200_000,
            "keys": "? " * 200_000,
            "brackets": "[" * 30_000 + "]" * 30_000,
            "title": MODEL.replace("A body", "A body " * 1_500_000),
            "law": MODEL.replace("hertz,", "h" * 12_000_000 + ","),
            "key": "x" * 11_000_000 + ": 1\n",
            "comment": "#" * 17_000_000,
            "values": "title: [" + "1," * 3_000_000 + "]\n",
            "empty maps": "title: [" + "{}," * 900_000 + "]\n",
            "long path": "".join(" " * i + "? " + "k" * 9_000 + f"{i}\n" + " " * i + ":\n" for i in range(60))
            + " " * 60
            + "- ["
            + "1," * 500_000
            + "]\n",
            "blanks": " " * 15_000_000 + "a: 1\n",
            "lines": "\n" * 15_000_000,
            "anchor": "&" + "a" * 5_000_000 + " [1]\n",
            "quotation": 'title: "' + "\\n" * 5_000_000,
            "tag": "!" + "a" * 5_000_000 + " x\n",
            "names": "structures: {"
            + ", ".join("n" * 60 + f"{i}: {{body: {{mass: 1}}}}" for i in range(20_000))
            + "}\n"
            "links: [{between: [" + "n" * 63 + "], law: hertz}]\n",
        }.items():
            with self.subTest(name=name):
                self.refused("check", self.write(text))

    def test_that_are_no_files(self):
        os.mkfifo(self.folder / "pipe.yaml")
        self.refused("check", "pipe.yaml", facts=["pipe.yaml:", "pipe"])
        self.refused("check", ".", facts=[".:", "folder", "YAML"])
        self.refused("check", "/dev/zero", facts=["/dev/zero:", "16 MB"])
        self.refused("check", "/dev/null", facts=["/dev/null:1:1:", "empty"])
        self.refused("check", "/proc/self/mem", facts=["/proc/self/mem:", "read"])
        self.refused("check", "not\x1bthere.yaml", facts=["not\\x1bthere.yaml:", "no such file"])
        self.refused("check", "n" * 100_000, facts=["no such file"])

    def test_through_standard_input(self):
        done = subprocess.run(
            [PROGRAM, "check", "/dev/stdin"], input=MODEL, capture_output=True, text=True, timeout=WAIT
        )
        self.assertEqual(done.returncode, 0, done.stderr)


class Units(CorpusTest):
    def test_of_the_corpus(self):
        def check(file):
            return [
                "check",
                self.write(MODEL.replace("{mass: 1 t}", "{mass: " + json.dumps(file.read_bytes().decode()) + "}")),
            ]

        self.replay("units", check)

    def test_beyond_all_measure(self):
        for text in ("1 " + "(" * 9_000, "1 " + "(" * 4_000 + "kg" + ")" * 4_000):
            self.refused("check", self.write(MODEL.replace("1 t", text)), facts=["8", "parentheses"])
        self.refused("calibrate", "--law", "hertz", "--m1", "1 " + "(" * 60_000, facts=["8", "parentheses"])

    def test_on_the_command_line(self):
        long, brackets, control = "x" * 100_000, "1 " + "(" * 60_000, "\x1b[31mred"
        for text in (long, brackets, control, "1e999", "nan", "", "1e-320 mm"):
            with self.subTest(text=text[:10]):
                for words in (
                    ["calibrate", "--law", text, "--m1", "1 t"],
                    ["calibrate", "--law", "hertz", "--m1", text],
                    ["calibrate", "--law", "hertz_damped", "--m1", "1 t", "--restitution", text or "x"],
                    ["calibrate", "--law", "hertz", "--m1", "1 t", "--parameter", text],
                    ["record", "info", "--step", text or "x", CORPUS / "records" / "fine_columns.txt"],
                    ["record", "info", "--units", text or "x", CORPUS / "records" / "fine_columns.txt"],
                    ["record", "info", "--channel", text or "x", CORPUS / "records" / "fine_columns.txt"],
                    ["record", "spectrum", "--periods", text, CORPUS / "records" / "fine_columns.txt"],
                    ["record", "spectrum", "--damping", text, CORPUS / "records" / "fine_columns.txt"],
                    ["words", text or "no"],
                    ["laws", text or "no"],
                    [text],
                    ["run", CORPUS / "model" / "fine_plain.yaml", "-q", text],
                ):
                    with self.subTest(words=words[:2]):
                        self.refused(*words)

    def test_beyond_the_range_of_numbers(self):
        """Numeric values whose results are not numbers."""
        hertz = ["calibrate", "--law", "hertz_damped", "--m1", "1"]
        for words in (
            [*hertz, "--restitution", "1e-300"],
            [*hertz, "--restitution", "0.5", "--velocity", "1e300"],
            """
                calibrate --cyclic --law jankowski --m1 1e-300 --restitution 0.5 --velocity 1e-300
                --stiffness 1e300
            """.split(),
        ):
            with self.subTest(words=words):
                self.refused(*words, facts=["units"])
        for words in (
            ["7e15", "--exponent", "971"],
            ["7e15", "--exponent", "971", "--cyclic"],
            ["7e152", "--exponent", "71"],
        ):
            self.refused(
                *hertz, "--restitution", "0.4", "--stiffness", "2", "--velocity", *words, facts=["impact", "units"]
            )
        record = CORPUS / "records" / "fine_columns.txt"
        for periods in ("1e-300:4:100", "1e-12:4:100"):
            self.refused("record", "spectrum", record, "--periods", periods, facts=["longer periods"])
        self.refused(
            "record", "spectrum", "--units", "g", CORPUS / "records" / "fine_sample_1e30.txt", facts=["longer periods"]
        )

    def test_of_options_of_petsc_are_named(self):
        self.refused(
            "run",
            CORPUS / "model" / "fine_plain.yaml",
            "-q",
            "-pounding_ts_rtol",
            "abc",
            facts=["-pounding_ts_rtol", "abc"],
        )


class Records(CorpusTest):
    def test_of_the_corpus(self):
        self.replay(
            "records",
            lambda file: ["record", "info", "--units", "cm/s^2" if file.name.startswith("esm") else "g", file],
        )

    def test_in_a_model_are_refused_at_their_place(self):
        for name in ("sample_1e308.txt", "time_1e-320.txt", "utf16.txt"):
            model = MODEL + f"ground_motion: {{record: {CORPUS / 'records' / name}, units: g}}\n"
            self.refused("check", self.write(model), facts=["m.yaml:8:25: ground_motion.record:"])

    def test_are_refused_at_their_place(self):
        for name, facts in {
            "sample_1e308.txt": ["sample_1e308.txt:2:", '"1e308"', "1e+30"],
            "time_1e308.txt": ["time_1e308.txt:2:", '"1e308"', "1e+30"],
            "time_1e-320.txt": ["time_1e-320.txt:", "velocity"],
            "zero_byte.txt": ["zero_byte.txt:3:", "zero bytes"],
            "peer_huge_count.at2": ["NPTS", "1e+09", "5000000 samples"],
        }.items():
            with self.subTest(name=name):
                self.refused("record", "info", "--units", "g", CORPUS / "records" / name, facts=facts)

    def test_of_displacements_are_refused_at_their_place(self):
        for name, facts in {
            "peer_displacement_step_1e308.at2": ["sample 3", "inf s", "1e+308 s"],
            "displacement_times_1e-324.txt": ["sample 2", "0 s"],
        }.items():
            with self.subTest(name=name):
                self.refused(
                    "record",
                    "info",
                    "--displacement",
                    "--units",
                    "cm",
                    CORPUS / "records" / name,
                    facts=[f"{name}:", *facts],
                )

    def test_tell_headers_that_are_no_utf8(self):
        done = subprocess.run(
            [PROGRAM, "record", "info", "--json", CORPUS / "records" / "fine_peer_escape_in_title.at2"],
            capture_output=True,
            timeout=WAIT,
        )
        self.assertEqual(json.loads(done.stdout)["title"], "Z\u00fcrich  [31m red")

    def test_beyond_all_measure(self):
        values = "\n0 0\n1 1\n2 0\n"
        for name, text in {
            "line": "0 " * 20_000_000,
            "letters": "x" * 30_000_000,
            "lines": "\n" * 20_000_000,
            "header of secs": "# " + "sec" * 3_000_000 + values,
            "header of brackets": "# " + "(a) " * 2_000_000 + values,
            "header of an open bracket": "a ( " + "x " * 2_000_000 + values,
            "header of columns": "# " + "a " * 2_000_000 + values,
            "comments": "# (a)\n" * 1_000_000 + values,
            "zeros": b"\0" * 130_000_000,
            "minus signs": "-" * 9_000_000 + values,
        }.items():
            for more in ([], ["--step", "0.01 s"]):
                with self.subTest(name=name, more=more):
                    self.refused("record", "info", *more, self.write(text, "r.txt"))

    def test_that_are_no_files(self):
        for name in ("/dev/zero", ".", "pipe", "nothing"):
            if name == "pipe":
                os.mkfifo(self.folder / name)
            self.refused("record", "info", name, facts=["folder" if name == "." else "found"])


if __name__ == "__main__":
    unittest.main()
