"""Every command, model and program printed in the README and the guide is run, compiled, or at least exists.

The environment names the built parts; a test is skipped if its part is not built: POUNDING_PROGRAM, POUNDING_PACKAGE
(the folder of the Python package), POUNDING_CXX, POUNDING_CC, POUNDING_C_LIBRARY.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    ROOT / "python/docs/index.md",
    *sorted((ROOT / "python/docs/guide").glob("*.md")),
]
PATIENCE = 120
#: Language and text of every fenced block.
FENCE = re.compile(r"(?ms)^```([^\n]*)\n(.*?)^```$")


def blocks(page, language):
    """Blocks of this language, each with the output printed below it, if any."""
    text, found = page.read_text(), []
    for match in FENCE.finditer(text):
        if match.group(1) == language:
            below = re.match(r"\n\n```text\n(.*?)^```$", text[match.end() :], re.DOTALL | re.MULTILINE)
            found.append((match.group(2), below and below.group(1)))
    return found


def part(name):
    """A built part, from the environment."""
    if not os.environ.get(name):
        raise unittest.SkipTest(f"{name} is not set")
    return os.environ[name]


def without_times(text):
    return re.sub(r"\d+\.\d+ s$", "... s", text.strip(), flags=re.MULTILINE)


#: Used for the pair.yaml that pages name.
PAIR = """\
ground_motion: {harmonic: {amplitude: 3, period: 0.5, duration: 1}}
structures:
  left:  {oscillator: {mass: 100 t, period: 0.8}, damping: 5 %}
  right: {oscillator: {mass: 150 t, period: 0.4}, damping: 5 %}
links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]
analysis: {duration: 4}
"""


#: Used for the towers.yaml of the page on reduced structures.
TOWER = (
    "{frame: {origin: [X], material: {E: 30 GPa}, grid: {storeys: 12, bays: 3, storey_height: 3.2, bay_width: 6, columns: {rectangle: [0.6, "
    "0.6]}, beams: {rectangle: [0.3, 0.6]}, floor_mass: 120 t}}, damping: 5 %}"
)
TOWERS = (
    "ground_motion: {harmonic: {amplitude: 4, period: 1.2, duration: 1}}\nstructures:\n"
    f"  left: {TOWER.replace('X', '0')}\n  right: {TOWER.replace('X', '18.02')}\n"
    "links: [{between: [left.12, right.12], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]\n"
    "analysis: {duration: 1}\n"
)


class Lines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copytree(ROOT / "examples", self.folder / "examples")

    def done(self, *words, **environment):
        """Output of a command, which must succeed."""
        run = subprocess.run(
            [str(word) for word in words],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            env=os.environ | environment,
        )
        self.assertEqual((run.returncode, run.stderr), (0, ""), f"{words}\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}")
        return run.stdout

    def in_main(self, text, given, last):
        """A program: the includes of a block, and the rest of it as the body of main."""
        includes = "\n".join(re.findall(r"(?m)^#include.*$", text))
        rest = re.sub(r"(?m)^#include.*$", "", text)
        return f"#include <stdio.h>\n{includes}\nint main(void) {{\n{given}\n{rest}\n{last}\n}}\n"

    def run_c(self, text):
        """Compiles and runs a block of C with a law that remains alive."""
        c, cxx, library = part("POUNDING_CC"), part("POUNDING_CXX"), part("POUNDING_C_LIBRARY")
        (self.folder / "host.c").write_text(
            self.in_main(text, "double penetration = 2e-3, rate = 0.3;", "pnd_destroy(law);\nreturn 0;")
        )
        self.done(
            c,
            "-std=c99",
            "-Wall",
            "-Werror",
            "-Wno-unused-parameter",
            "-I",
            ROOT / "elements/c",
            "-c",
            "host.c",
            "-o",
            "host.o",
        )
        self.done(cxx, "host.o", library, f"-Wl,-rpath,{Path(library).parent}", "-o", "host")
        self.assertEqual(self.done(self.folder / "host"), "")


class Commands(Lines):
    def refuse_unknown(self, line):
        """Checks a shell line; commands of `pounding` are run."""
        words = shlex.split(line, comments=True)
        for command in " ".join(shlex.quote(word) if word != "&&" else word for word in words).split(" && "):
            self.check(shlex.split(command))

    def check(self, words):
        match words:
            case []:
                pass
            case ["make", *targets]:
                known = re.search(r"(?m)^\.PHONY: ((?:.*\\\n)*.*)$", (ROOT / "Makefile").read_text()).group(1).split()
                for target in targets:
                    self.assertIn(
                        target.split("=")[0], [*known, "JOBS", "MINUTES", "PART", "PETSC", "MPI", "PYTHONS", "VERSIONS"]
                    )
            case ["build/pounding", *rest]:
                self.assertNotEqual(self.done(part("POUNDING_PROGRAM"), *rest), "")
            case ["pounding", "run", "towers.yaml", *options]:
                (self.folder / "towers.yaml").write_text(TOWERS)
                run = subprocess.run(
                    [part("POUNDING_PROGRAM"), "run", "towers.yaml", *options],
                    cwd=self.folder,
                    capture_output=True,
                    text=True,
                    timeout=PATIENCE,
                )
                self.assertEqual(run.returncode, 0, run.stderr)
                told = (
                    "no structure is reduced" if "-pounding_red_auto" in options else "errors of the reduction: forces "
                )
                self.assertIn(told, run.stderr + run.stdout)
            case ["cmake", "--build", "build", "--target", *targets]:
                for target in targets:
                    self.assert_target(target)
            case [test, *_] if test.startswith("build/tests/"):
                _, _, area, target = test.split("/")
                self.assertTrue((ROOT / "tests" / area).is_dir(), test)
                self.assert_target(target)
            case ["cmake", "--preset" | "--build", *rest]:
                presets = json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
                self.assertIn(rest[-1], [preset["name"] for preset in presets])
            case ["ctest", "--test-dir", "build", "--output-on-failure", "-R", name]:
                area, subject = name.split(".")
                self.assertTrue((ROOT / "tests" / area / f"test_{subject}.py").is_file(), name)
            case ["cmake", "-S", ".", "-B", "build", "-G", "Ninja", *options]:
                texts = [
                    path.read_text()
                    for path in (
                        ROOT / "CMakeLists.txt",
                        ROOT / "python/CMakeLists.txt",
                        *(ROOT / "cmake").glob("*.cmake"),
                    )
                ]
                for option in options:
                    name = re.fullmatch(r"-D(\w+)=.+", option).group(1)
                    self.assertTrue(any(re.search(rf"\b{name}\b", text) for text in texts), option)
            case [*settings, "bash", "cmake/petsc.sh", _, "on" | "off", _]:
                script = (ROOT / "cmake/petsc.sh").read_text()
                for setting in settings:
                    self.assertTrue("${" + setting.split("=")[0] + ":-" in script, setting)
            case ["cmake", "--install", "build", "--prefix", "DIR"] | ["python3", "-m", "venv", "env"]:
                pass
            case ["env/bin/python3", "-m", "pip", "install", place]:
                self.assertRegex(place, r"^(\.|pounding-[0-9.]+-cp\d+-cp\d+-manylinux_\d+_\d+_x86_64\.whl)$")
            case ["env/bin/pounding", name]:
                self.assertIn(name, ["demo", "lessons"])  # tests/python/test_demo.py runs them
            case _:
                self.fail(f"nobody has tried: {shlex.join(words)}")

    def assert_target(self, target):
        texts = [path.read_text() for folder in ("lib", "tests") for path in (ROOT / folder).rglob("CMakeLists.txt")]
        name = target.removeprefix("test_")
        self.assertTrue(
            any(re.search(rf"pounding_test\({name}\s|add_executable\({target}\s", text) for text in texts), target
        )

    def test_AreRunOrThere(self):
        for page in PAGES:
            for text, _ in blocks(page, "sh"):
                for line in text.splitlines():
                    with self.subTest(page.name, line=line):
                        self.refuse_unknown(line)

    def test_NothingIsInstalledIntoThePythonOfTheSystem(self):
        # Debian answers "externally-managed-environment".
        for page in [*PAGES, *(ROOT / "examples").rglob("*.md")]:
            self.assertNotRegex(
                page.read_text(), r"(?<!env/bin/)python3 -m pip install|(?<!-m )\bpip3? install \S", page
            )

    def test_NamedExtrasExist(self):
        extras = re.search(
            r"(?ms)^\[project\.optional-dependencies\]\n(.*?)^\[", (ROOT / "pyproject.toml").read_text()
        ).group(1)
        for page in PAGES:
            for name in re.findall(r'"\.\[(\w+)\]"', page.read_text()):
                self.assertRegex(extras, rf"(?m)^{name} = ", page)

    def test_CommandsOfTheProgramExist(self):
        # by the package only: python.demo
        known = self.done(part("POUNDING_PROGRAM"), "--help") + "  demo \n  lessons \n"
        for page in PAGES:
            for name in re.findall(r"`(?:mpirun -n K )?pounding ([a-z]+)", page.read_text()):
                self.assertRegex(known, rf"(?m)^  {name} ", page)


class Models(Lines):
    def put_what_a_study_names(self):
        """A pair of oscillators and two records."""
        (self.folder / "pair.yaml").write_text(PAIR)
        (self.folder / "records").mkdir(exist_ok=True)
        for name, sign in (("one", 1), ("two", -1), ("three", 0.8)):
            values = " ".join(f"{sign * 0.1 * (-1) ** (i // 10):.7E}" for i in range(200))
            (self.folder / f"records/{name}.AT2").write_text(
                "PEER NGA STRONG MOTION DATABASE RECORD\nA pulse\nACCELERATION TIME SERIES IN "
                f"UNITS OF G\nNPTS= 200, DT= .0200 SEC\n{values}\n"
            )

    def test_AreReadAsTheyStand(self):
        count = 0
        for page in PAGES:
            for text, _ in blocks(page, "yaml"):
                with self.subTest(page.name):
                    (self.folder / "model.yaml").write_text(text)
                    if "\nstudy:" in text or "\nrecords:" in text:
                        self.put_what_a_study_names()
                    if "\nrecords:" in text:
                        self.done(part("POUNDING_PROGRAM"), "suite", "model.yaml", "-j", "0")
                    else:
                        self.done(part("POUNDING_PROGRAM"), *["study"] * ("\nstudy:" in text), "check", "model.yaml")
                    count += 1
        self.assertGreaterEqual(count, 2)

    def test_TheModelOfTheReadmePrintsWhatStandsBelowIt(self):
        readme = (ROOT / "README.md").read_text()
        (self.folder / "model.yaml").write_text(blocks(ROOT / "README.md", "yaml")[0][0])
        printed = re.search(r"(?ms)^<!-- begin two_oscillators -->\n+```console\n\$ [^\n]*\n(.*?)^```$", readme).group(
            1
        )
        self.assertEqual(
            without_times(self.done(part("POUNDING_PROGRAM"), "run", "model.yaml")), without_times(printed)
        )


class Programs(Lines):
    def test_ThoseInPythonPrintWhatStandsBelowThem(self):
        package, count = part("POUNDING_PACKAGE"), 0
        for page in PAGES:
            for text, printed in blocks(page, "python"):
                with self.subTest(page.name):
                    found = self.done(
                        sys.executable, "-c", text, PYTHONPATH=package, MPLBACKEND="agg", PYTHONDONTWRITEBYTECODE="1"
                    )
                    if printed:
                        self.assertEqual(found.strip(), printed.strip())
                    count += 1
        self.assertGreaterEqual(count, 3)

    def test_ThoseInCxxCompileAndRun(self):
        compiler, count = part("POUNDING_CXX"), 0
        for page in PAGES:
            for text, _ in blocks(page, "cpp"):
                with self.subTest(page.name):
                    (self.folder / "host.cpp").write_text(
                        self.in_main(text, "", "return !(force > 0 && by_penetration > 0 && by_rate > 0);")
                    )
                    self.done(compiler, "-std=c++20", "-I", ROOT / "elements", "host.cpp", "-o", "host")
                    self.done(self.folder / "host")
                    count += 1
        self.assertGreaterEqual(count, 1)

    def test_ThoseInCCompileAndRun(self):
        count = 0
        for page in PAGES:
            for text, _ in blocks(page, "c"):
                with self.subTest(page.name):
                    self.run_c(text)
                    count += 1
        self.assertGreaterEqual(count, 1)


if __name__ == "__main__":
    unittest.main()
