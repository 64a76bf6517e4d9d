"""The build with another PETSc than the system's: messages of `make`, its script and CMake before anything is
compiled."""

import fcntl
import os
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def done(*words, folder=ROOT, **environment):
    clean = {
        name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "PETSC", "MPI")
    }
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, env=clean | environment)


def without_python(cache):
    """A folder with a python3 that fails: a build ends immediately."""
    folder = Path(cache) / "bin"
    folder.mkdir()
    (folder / "python3").write_text("#!/bin/sh\nexit 1\n")
    (folder / "python3").chmod(0o755)
    return folder


class Make(unittest.TestCase):
    def test_has_a_folder_for_each_petsc(self):
        for words, folder in (
            (["PETSC=3.26.1", "MPI=off"], "build-petsc-3.26.1-nompi"),
            (["PETSC=3.19.6"], "build-petsc-3.19.6-mpi"),
            ([], "build"),
        ):
            plan = done("make", "--dry-run", "--always-make", "program", *words)
            self.assertEqual(plan.returncode, 0, plan.stderr)
            self.assertIn(f"cmake --build {folder} ", plan.stdout)
            self.assertEqual("-DPETSC_DIR=" in plan.stdout, bool(words))
            self.assertEqual("-DPOUNDING_MPI=off" in plan.stdout, "MPI=off" in words)

    def test_asks_for_the_petsc_that_has_no_mpi(self):
        plan = done("make", "--dry-run", "program", "MPI=off")
        self.assertEqual(plan.returncode, 2)
        self.assertIn("Type make program PETSC=3.26.1 MPI=off", plan.stderr)

    def test_asks_which_version(self):
        plan = done("make", "petsc")
        self.assertEqual(plan.returncode, 2)
        self.assertIn("Type make petsc PETSC=3.26.1", plan.stderr)


class Script(unittest.TestCase):
    def test_refuses_other_versions_and_words(self):
        for words, told in (
            (["3.17.0", "on"], "PETSC=3.17.0 is not"),
            (["3.26", "on"], "PETSC=3.26 is not"),
            (["3.26.1", "no"], "MPI=no is neither"),
        ):
            with tempfile.TemporaryDirectory() as cache:
                run = done("bash", "cmake/petsc.sh", *words, XDG_CACHE_HOME=cache)
                self.assertEqual(run.returncode, 2)
                self.assertIn(told, run.stderr)
                self.assertEqual(list(Path(cache).iterdir()), [])

    def test_takes_what_is_ready(self):
        with tempfile.TemporaryDirectory() as cache:
            folder = Path(cache) / "pounding/petsc-3.26.1-nompi"
            folder.mkdir(parents=True)
            (folder / "ready").touch()
            self.assertEqual(
                done("bash", "cmake/petsc.sh", "3.26.1", "off", XDG_CACHE_HOME=cache).stdout, f"{folder}\n"
            )

    def test_waits_for_another_that_builds_the_same(self):
        with tempfile.TemporaryDirectory() as cache:
            folder, work = (
                Path(cache) / "pounding/petsc-3.26.1-nompi",
                Path(cache) / "pounding/build/petsc-3.26.1-nompi",
            )
            folder.mkdir(parents=True)
            work.mkdir(parents=True)
            with (work / "lock").open("w") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX)
                other = subprocess.Popen(
                    ["bash", "cmake/petsc.sh", "3.26.1", "off"],
                    cwd=ROOT,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    text=True,
                    env=os.environ | {"XDG_CACHE_HOME": cache, "PATH": f"{without_python(cache)}:{os.environ['PATH']}"},
                )
                time.sleep(0.3)
                (folder / "ready").touch()
            self.assertEqual(other.communicate(timeout=60), (f"{folder}\n", ""))


class Configured(unittest.TestCase):
    """A PETSc of two pkg-config files and the header that defines whether it has MPI."""

    def configured(self, *, mpi, wanted):
        with tempfile.TemporaryDirectory() as place:
            petsc = Path(place) / "petsc"
            (petsc / "lib/pkgconfig").mkdir(parents=True)
            (petsc / "include").mkdir()
            (petsc / "include/petscconf.h").write_text("" if mpi else "#define PETSC_HAVE_MPIUNI 1\n")
            for name in ("PETSc", "slepc"):
                (petsc / f"lib/pkgconfig/{name}.pc").write_text(
                    f"Name: {name}\nDescription: none\nVersion: 3.26.1\nCflags: -I{petsc}/include\n"
                )
            script = Path(place) / "CMakeLists.txt"
            script.write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(one LANGUAGES C)\nfind_package(PkgConfig REQUIRED)\n"
                f'include({ROOT}/cmake/petsc.cmake)\nmessage(STATUS "MPI ${{POUNDING_MPI}} PETSc ${{PETSC_VERSION}}")\n'
            )
            words = [] if wanted is None else [f"-DPOUNDING_MPI={wanted}"]
            run = done("cmake", "-S", place, "-B", f"{place}/build", f"-DPETSC_DIR={petsc}", *words)
            return run.returncode, " ".join((run.stdout + run.stderr).split())

    def test_is_as_petsc_has_it(self):
        for mpi, wanted, told in (
            (True, None, "MPI ON PETSc 3.26.1"),
            (False, None, "MPI OFF PETSc 3.26.1"),
            (False, "OFF", "MPI OFF PETSc 3.26.1"),
        ):
            code, printed = self.configured(mpi=mpi, wanted=wanted)
            self.assertEqual(code, 0, printed)
            self.assertIn(told, printed)

    def test_refuses_what_petsc_has_not(self):
        code, printed = self.configured(mpi=False, wanted="ON")
        self.assertEqual(code, 1)
        self.assertIn("has no MPI. Type cmake -DPOUNDING_MPI=OFF", printed)
        code, printed = self.configured(mpi=True, wanted="OFF")
        self.assertEqual(code, 1)
        self.assertIn("make petsc PETSC=3.26.1 MPI=off", printed)


if __name__ == "__main__":
    unittest.main()
