#!/usr/bin/env bash
# The portable wheel of this Python as users install it: in a new environment, in an empty folder; prints the time of
# each part.
#   portable.sh WHEEL...
set -euo pipefail
tests=$(realpath "$(dirname "$0")/..")
tag=$(python3 -c 'import sys; print("cp%d%d-" % sys.version_info[:2])')
wheel=
for each in "$@"; do
  case $each in *"$tag"*) wheel=$(realpath "$each") ;; esac
done
[ -n "$wheel" ] || { echo "no wheel for $tag among $*: make portable-wheel PYTHONS=python3" >&2; exit 1; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place"
unset PYTHONPATH LD_LIBRARY_PATH
export PYTHONDONTWRITEBYTECODE=1
python3 -m venv venv
echo "Installing ${wheel##*/} (packages from PyPI)"
time venv/bin/python3 -m pip install --quiet --disable-pip-version-check "$wheel"
time venv/bin/pounding demo
ls -l demo.h5 demo.png
venv/bin/pounding lessons
time venv/bin/pounding run lessons/02_two_oscillators/model.yaml > run.txt
told=$(OMPI_COMM_WORLD_RANK=0 OMPI_COMM_WORLD_SIZE=2 venv/bin/pounding run lessons/02_two_oscillators/model.yaml 2>&1) && { echo "ran as one of two"; exit 1; }
case $told in *"was built without MPI"*) ;; *) echo "$told"; exit 1 ;; esac
export POUNDING_EXAMPLES=$place/lessons
venv/bin/python3 "$tests/install/test_wheel.py" Wheel Command
# Package tests that need no compiler, with all optional packages.
export POUNDING_PROGRAM POUNDING_WITHOUT_MPI=1
POUNDING_PROGRAM=$(echo "$place"/venv/lib/python3*/site-packages/pounding/bin/pounding)
venv/bin/python3 -m pip install --quiet --disable-pip-version-check "$wheel[all]"
cd "$tests/python"
"$place/venv/bin/python3" -m unittest test_demo test_device_results test_ground_motions test_laws test_mode_shapes test_models test_opensees_link test_printing test_process test_pushover test_run test_spring_results test_study_kernel test_yielding
cd studies
"$place/venv/bin/python3" -m unittest test_study_engines test_study_plan test_study_readings test_study_rows
