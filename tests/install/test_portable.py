"""Parts of the portable wheel that need neither its libraries nor a network: its command, its licences, refusals."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake"))
import portable_wheel  # noqa: E402


class Folder(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name).resolve()

    def script(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)
        return path


class Command(Folder):
    def setUp(self):
        super().setUp()
        self.command = self.script("env/bin/pounding", portable_wheel.COMMAND.replace("@VERSION@", "3.12"))
        self.python = self.script("env/bin/python3", '#!/bin/sh\necho "python $*"\n')
        self.program = self.script(
            "env/lib/python3.12/site-packages/pounding/bin/pounding",
            '#!/bin/sh\necho "program $* by $POUNDING_PYTHON"\n',
        )

    def says(self, *words, command=None):
        return subprocess.run(
            [command or self.command, *words], capture_output=True, text=True, check=True, env={"PATH": "/usr/bin:/bin"}
        ).stdout.strip()

    def test_is_the_program_with_the_python_of_its_environment(self):
        self.assertEqual(self.says("run", "a model.yaml"), f"program run a model.yaml by {self.python}")
        self.assertEqual(self.says(), f"program  by {self.python}")

    def test_gives_to_python_what_python_does(self):
        for name in ("demo", "lessons", "study", "separation"):
            self.assertEqual(self.says(name, "-x"), f"python -m pounding {name} -x")

    def test_works_by_a_link_from_elsewhere(self):
        link = self.folder / "link"
        link.symlink_to(self.command)
        self.assertEqual(self.says("laws", command=link), f"program laws by {self.python}")

    def test_leaves_the_program_of_another_python_alone(self):
        self.script("env/lib/python3.11/site-packages/pounding/bin/pounding", "#!/bin/sh\necho other\n")
        self.assertTrue(self.says("laws").startswith("program"))
        self.program.unlink()
        self.assertEqual(self.says("laws"), "python -m pounding laws")


def copied(source, to):
    """Writes the file that shutil.copy would create; the source need not exist."""
    to = Path(to)
    (to / Path(source).name if to.is_dir() else to).write_text(str(source))


class Licences(Folder):
    def add(self, *libraries, package="zlib1g"):
        """The licence folder of a wheel with these libraries, all others but ours from one Debian package."""
        info = Path(tempfile.mkdtemp(dir=self.folder))
        with (
            mock.patch.object(portable_wheel, "debian_package", return_value=(package, "1.0")),
            mock.patch("shutil.copy", copied),
        ):
            portable_wheel.add_licences(info, libraries, self.folder, self.folder)
        return info / "licenses/bundled"

    def test_are_there_for_everything_in_the_list(self):
        libraries = (
            "libpetsc-0a.so.3.26.1",
            "libslepc-0a.so.3.26.1",
            "libhdf5-0a.so.103.3.0",
            "libcholmod-0a.so.3",
            "libz-0a.so.1",
            "libklu-0a.so.1",
        )
        folder = self.add(*libraries)
        listed = (folder / "LIST").read_text()
        for library in libraries:
            self.assertIn(f"\n{library}: ", listed)
        for line in listed.splitlines():
            if ": " in line and "names without code" not in line and line.split(":")[0] in (*libraries, "compiled in"):
                self.assertTrue((folder / line.rsplit(": ", 1)[1]).is_file(), line)

    def test_refuse_what_must_not_be_passed_on(self):
        for package, library in (
            ("libcholmod3", "libothername-0a.so.3"),
            ("libopenblas0-pthread", "libopenblas-0a.so.0"),
        ):
            with self.assertRaisesRegex(SystemExit, f"{library} of {package} must not be in the wheel"):
                self.add(library, package=package)

    def test_refuse_what_nobody_knows(self):
        with self.assertRaisesRegex(SystemExit, "its licence is not known"):
            portable_wheel.debian_package("libnobody-0123456789.so.1", self.folder)


if __name__ == "__main__":
    unittest.main()
