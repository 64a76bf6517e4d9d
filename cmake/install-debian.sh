#!/usr/bin/env bash
# Installs missing Debian packages if run by root; otherwise prints the command. Prints their names and sizes first. Uses the network
# only if a package is missing.
#   install-debian.sh [--names] demo|test|petsc [more packages]     demo: packages of the program; test: also those of the tests and
#   the Python module; petsc: those that build PETSc from source; --names only prints the missing ones
set -euo pipefail
names=
if [ "$1" = --names ]; then
  names=yes
  shift
fi
part=$1
shift

# libopenblas0-pthread: PETSc would otherwise use the reference BLAS, which is two to four times slower. ccache: the wheel reuses the
# objects of the build.
packages=(g++ cmake ninja-build ccache pkg-config libpetsc-real-dev slepc-dev libeigen3-dev libyaml-cpp-dev libcli11-dev
  libfmt-dev nlohmann-json3-dev zlib1g-dev libopenblas0-pthread)
# gfortran compiles the Fortran module, help2man makes the manual pages; both are optional for the build.
if [ "$part" = test ]; then
  packages+=(libgtest-dev gfortran help2man)
fi
if [ "$part" = petsc ]; then
  packages=(g++ make pkg-config libsuitesparse-dev)
fi
packages+=("$@")

if ! command -v dpkg-query > /dev/null; then
  [ -n "$names" ] && exit 0
  echo "This system is not Debian: install the equivalents of these packages, then use CMake (see python/docs/guide/start.md):" >&2
  echo "  ${packages[*]} python3-venv python3-dev" >&2
  exit 1
fi

installed=$(dpkg-query --show --showformat '${Package} ${db:Status-Status}\n' "${packages[@]}" 2> /dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep --quiet --fixed-strings --line-regexp "$package installed" <<< "$installed" || missing+=("$package")
done
# Checks the python3 on the path, which need not be Debian's.
python3 -c 'import ensurepip, venv' 2> /dev/null || missing+=(python3-venv)
if [ "$part" = test ]; then
  python3 -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")' 2> /dev/null || missing+=(python3-dev)
fi
[ ${#missing[@]} -eq 0 ] && exit 0

if [ -n "$names" ]; then
  [ "$(id -u)" -ne 0 ] && exit 0  # the user gets the command instead
  echo "make will install these Debian packages: ${missing[*]}"
  exit 0
fi
if [ "$(id -u)" -ne 0 ]; then
  echo "Missing Debian packages. Install them, then repeat make:" >&2
  echo "  sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi
export DEBIAN_FRONTEND=noninteractive
apt-get --quiet --quiet update
# Prints the sizes of the download and of the installed files; --assume-no stops there.
LC_ALL=C apt-get install --assume-no --no-install-recommends "${missing[@]}" 2> /dev/null |
  sed --quiet --regexp-extended 's/^(Need to get|After this operation,) /  &/p' || true
apt-get install --yes --no-install-recommends "${missing[@]}" < /dev/null
