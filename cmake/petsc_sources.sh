#!/usr/bin/env bash
# Downloads missing source archives of one version of PETSc and the matching SLEPc from PyPI into the cache of the user, and prints
# their paths, PETSc first.
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
# SLEPc of the same minor version: its latest patch up to the requested version may differ from it.
ls slepc-"$minor".*.tar.gz > /dev/null 2>&1 || missing+=("slepc==$minor.*")
if [ ${#missing[@]} -gt 0 ]; then
  # pip reads the metadata of a source archive, which requires these two; it does not build.
  tools=$(mktemp -d)
  trap 'rm -rf "$tools"' EXIT
  python3 -m venv "$tools"
  "$tools/bin/python3" -m pip install --quiet --disable-pip-version-check setuptools wheel >&2
  "$tools/bin/python3" -m pip download --quiet --disable-pip-version-check --no-deps --no-build-isolation --no-binary :all: "${missing[@]}" >&2
fi
printf '%s\n' "$folder/petsc-$version.tar.gz" "$folder"/slepc-"$minor".*.tar.gz
