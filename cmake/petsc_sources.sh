#!/usr/bin/env bash
# Downloads the source archives of PETSc of one version and of the SLEPc that belongs to it from PyPI into a folder, where they are
# missing, and prints their names without .tar.gz.
#   petsc_sources.sh VERSION FOLDER
set -euo pipefail
version=$1
mkdir -p "$2"
cd "$2"
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
for archive in petsc-"$version".tar.gz slepc-"$minor".*.tar.gz; do
  echo "${archive%.tar.gz}"
done
