#!/usr/bin/env bash
# Compiles all callers of PETSc against the headers of other versions, without generating code. A name that is missing,
# deprecated or has other arguments is an error.
#   petsc_headers.sh BUILD VERSION...     BUILD: a build folder with the PETSc of the system, whose configuration is used for the headers
set -euo pipefail
root=$(realpath "$(dirname "$0")/../..")
build=$(realpath "$1")
shift
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

# Results of configure, from the PETSc of the system; newer versions need a few more.
mkdir "$place/configured"
for name in petscconf.h petscfix.h petscpkg_version.h slepcconf.h; do
  found=$(find $(pkg-config --cflags-only-I PETSc slepc | sed 's/-I//g') -maxdepth 1 -name "$name" | head -n 1)
  cp "$found" "$place/configured"
done
touch "$place/configured/petscconf_poison.h"
cat >> "$place/configured/petscconf.h" << 'END'
#define PETSC_HAVE_OPENMPI 1
#define PETSC_PKG_OPENMPI_VERSION_GT(major, minor, subminor) 0
#define PETSC_PKG_OPENMPI_VERSION_LT(major, minor, subminor) 0
#define PETSC_DEPRECATED_ENUM_BASE(why) __attribute__((deprecated(why)))
#define PETSC_DEPRECATED_FUNCTION_BASE(why) __attribute__((deprecated(why)))
#define PETSC_DEPRECATED_OBJECT_BASE(why) __attribute__((deprecated(why)))
#define PETSC_DEPRECATED_TYPEDEF_BASE(why) __attribute__((deprecated(why)))
#define PETSC_DEPRECATED_MACRO_BASE_(why) _Pragma(#why)
#define PETSC_DEPRECATED_MACRO_BASE(why) PETSC_DEPRECATED_MACRO_BASE_(GCC warning why)
END
others=$(pkg-config --cflags-only-I PETSc slepc hdf5-openmpi | tr ' ' '\n' | grep --invert-match --extended-regexp 'petsc|slepc|^$' | sed 's/^-I/-isystem /')

# One text per module, as in the build.
mkdir "$place/texts"
for file in "$root"/lib/pounding/{petsc,linear,reduction,run}/*.cpp "$root"/lib/pounding/stepping/ts_pounding.cpp; do
  echo "#include \"$file\"" >> "$place/texts/$(basename "$(dirname "$file")").cpp"
done

for version in "$@"; do
  archives=$(bash "$root/cmake/petsc_sources.sh" "$version")
  headers=()
  while read -r archive; do
    name=$(basename "$archive" .tar.gz)
    tar xf "$archive" --directory "$place" "$name/include"
    headers+=(-isystem "$place/$name/include")
  done <<< "$archives"
  for text in "$place"/texts/*.cpp; do
    "${CXX:-c++}" -std=c++20 -fsyntax-only -Werror=deprecated-declarations -Wno-subobject-linkage -DFMT_SHARED -I "$root/elements" -I "$root/lib" -I "$build/elements" -I "$build/lib" \
      "${headers[@]}" -isystem "$place/configured" $others -isystem /usr/include/eigen3 "$text"
  done
  echo "compiled against the headers of PETSc $version and ${name/-/ }"
done
