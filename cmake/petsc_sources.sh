#!/usr/bin/env bash
# Downloads the source archives of PETSc of one version and of the SLEPc that belongs to it from PyPI into the user's cache, where they
# are missing, and prints their places, PETSc's first.
#   petsc_sources.sh VERSION
set -euo pipefail
. "$(dirname "$0")/building.sh"
version=$1
folder=${XDG_CACHE_HOME:-$HOME/.cache}/pounding/sources
mkdir -p "$folder"
alone_in "$folder"
cd "$folder"
minor=${version%.*}
missing=()
[ -e "petsc-$version.tar.gz" ] || missing+=("petsc==$version")
# SLEPc of the same minor version: the newest of its patches that is not newer than the version asked for may be another one.
ls slepc-"$minor".*.tar.gz > /dev/null 2>&1 || missing+=("slepc==$minor.*")
if [ ${#missing[@]} -gt 0 ]; then
  # pip asks a source archive for its metadata, which needs these two; with them it builds nothing.
  tools=$(mktemp -d)
  trap 'rm -rf "$tools"' EXIT
  python3 -m venv "$tools"
  "$tools/bin/python3" -m pip install --quiet --disable-pip-version-check setuptools wheel >&2
  "$tools/bin/python3" -m pip download --quiet --disable-pip-version-check --no-deps --no-build-isolation --no-binary :all: "${missing[@]}" >&2
fi
printf '%s\n' "$folder/petsc-$version.tar.gz" "$folder"/slepc-"$minor".*.tar.gz
