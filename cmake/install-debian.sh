#!/usr/bin/env bash
# Installs the Debian packages that are missing: by itself for root, otherwise it prints what to type. Says first how much that
# is. Touches the network only when something is missing.
#   install-debian.sh demo|test|petsc [more packages]     demo: what the program needs; test: what tests and the Python module need,
#   too; petsc: what PETSc from source is built with
set -euo pipefail
part=$1
shift

# libopenblas0-pthread: the reference BLAS, which PETSc takes otherwise, is two to four times slower. ccache: the wheel takes what
# the build has compiled.
packages=(g++ cmake ninja-build ccache pkg-config libpetsc-real-dev slepc-dev libeigen3-dev libyaml-cpp-dev libcli11-dev
  libfmt-dev nlohmann-json3-dev zlib1g-dev libopenblas0-pthread)
# gfortran compiles the Fortran module, help2man makes the manual pages; the build leaves out what is missing of both.
if [ "$part" = test ]; then
  packages+=(libgtest-dev gfortran help2man)
fi
if [ "$part" = petsc ]; then
  packages=(g++ make pkg-config libsuitesparse-dev)
fi
packages+=("$@")

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
if [ "$part" = test ]; then
  python3 -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")' 2> /dev/null || missing+=(python3-dev)
fi
[ ${#missing[@]} -eq 0 ] && exit 0

echo "Missing Debian packages: ${missing[*]}"
if [ "$(id -u)" -ne 0 ]; then
  echo "Install them, then repeat make:" >&2
  echo "  sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi
export DEBIAN_FRONTEND=noninteractive
apt-get --quiet --quiet update
# How much is to be fetched and stored; --assume-no ends there.
LC_ALL=C apt-get install --assume-no --no-install-recommends "${missing[@]}" 2> /dev/null |
  sed --quiet --regexp-extended 's/^(Need to get|After this operation,) /  &/p' || true
apt-get install --yes --no-install-recommends "${missing[@]}" < /dev/null
