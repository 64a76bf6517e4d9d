"""The archives collected by `make release`: archives of the version in CMakeLists.txt, their checksums, notes from the
changelog."""

import contextlib
import io
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake"))
import release  # noqa: E402


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "CMakeLists.txt").write_text("project(pounding\n  VERSION 1.4.0\n  LANGUAGES C)\n")
        (self.root / "CHANGELOG.md").write_text("# Changelog\n\n## 1.4.0\n\n- New.\n\n## 1.3.0\n\n- Old.\n")

    def gather(self, *names):
        archives = [self.root / name for name in names]
        for archive in archives:
            archive.write_text(archive.name)
        with contextlib.redirect_stdout(io.StringIO()):
            release.main(["--out", str(self.root / "out"), *map(str, archives)], self.root)
        return self.root / "out"

    def test_has_archives_checksums_and_notes(self):
        out = self.gather("pounding-1.4.0.tar.gz", "pounding-1.4.0-cp311-cp311-linux_x86_64.whl")
        subprocess.run(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=out, check=True)
        self.assertEqual(len((out / "SHA256SUMS").read_text().splitlines()), 2)
        self.assertEqual((out / "NOTES.md").read_text(), "# pounding 1.4.0\n\n- New.\n")

    def test_refuses_another_version(self):
        with self.assertRaisesRegex(SystemExit, "is not of version 1.4.0"):
            self.gather("pounding-1.3.0.tar.gz")

    def test_refuses_a_changelog_of_another_version(self):
        (self.root / "CHANGELOG.md").write_text("# Changelog\n\n## 1.5.0\n\n- New.\n")
        with self.assertRaisesRegex(SystemExit, "CHANGELOG.md begins with 1.5.0"):
            self.gather("pounding-1.4.0.tar.gz")

    def test_of_this_version_has_notes(self):
        self.assertTrue(release.notes().startswith(f"# pounding {release.version()}\n\n"))


if __name__ == "__main__":
    unittest.main()
