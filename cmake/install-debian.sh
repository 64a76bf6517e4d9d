#!/usr/bin/env bash
# Installs the Debian packages that the build needs, and those that are named, where they are missing: by itself for root,
# otherwise it prints what to type. Touches the network only when something is missing.
set -euo pipefail

# gfortran compiles the Fortran module, help2man makes the manual pages; the build leaves out what is missing of both.
# libopenblas0-pthread: the reference BLAS, which PETSc takes otherwise, is two to four times slower.
packages=(g++ gfortran cmake ninja-build ccache pkg-config libpetsc-real-dev slepc-dev libeigen3-dev libyaml-cpp-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev libgtest-dev libopenblas0-pthread help2man "$@")

if ! command -v dpkg-query > /dev/null; then
  echo "This is not Debian: install what these packages hold, then go on with CMake (see README.md):" >&2
  echo "  ${packages[*]} python3-venv python3-dev" >&2
  exit 1
fi

installed=$(dpkg-query --show --showformat '${Package} ${db:Status-Status}\n' "${packages[@]}" 2> /dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep --quiet --fixed-strings --line-regexp "$package installed" <<< "$installed" || missing+=("$package")
done
# The Python that the path finds counts, whoever installed it.
python3 -c 'import ensurepip, venv' 2> /dev/null || missing+=(python3-venv)
python3 -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")' 2> /dev/null || missing+=(python3-dev)
[ ${#missing[@]} -eq 0 ] && exit 0

echo "Missing Debian packages: ${missing[*]}"
if [ "$(id -u)" -ne 0 ]; then
  echo "Install them, then repeat make:" >&2
  echo "  sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi
export DEBIAN_FRONTEND=noninteractive
apt-get update
apt-get install --yes --no-install-recommends "${missing[@]}" < /dev/null
