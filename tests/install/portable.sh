#!/usr/bin/env bash
# The portable wheel of this Python as users install it: into a new environment, in an empty folder; prints how long each part takes.
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
POUNDING_EXAMPLES=$place/lessons venv/bin/python3 "$tests/install/test_wheel.py" Wheel Command
