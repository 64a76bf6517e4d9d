#!/usr/bin/env bash
# The wheel with all its extras as users install it: in a new Python environment, away from the clone.
#   wheel.sh WHEEL
set -euo pipefail
wheel=$(realpath "$1")
tests=$(realpath "$(dirname "$0")/..")
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place"
unset PYTHONPATH
export PYTHONDONTWRITEBYTECODE=1 POUNDING_EXAMPLES="$tests/../examples"

python3 -m venv venv
pip=(venv/bin/python3 -m pip install --quiet --disable-pip-version-check)
echo "Installing ${wheel##*/}[all] (packages from PyPI)"
"${pip[@]}" "$wheel[all]"
venv/bin/python3 "$tests/install/test_wheel.py"
venv/bin/python3 "$tests/python/test_process.py" Importing
# Together with another user of MPI, which is not an extra of ours.
"${pip[@]}" mpi4py
venv/bin/python3 "$tests/python/test_process.py" OneProcess
venv/bin/python3 "$tests/benchmarks/python_package.py" --imports
