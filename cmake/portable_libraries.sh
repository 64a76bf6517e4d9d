#!/usr/bin/env bash
# Builds replacements of Debian's libraries for a portable wheel, from Debian's sources of the same versions, and prints the folder
# last:
#   portable_libraries.sh PETSC FOLDER     PETSC: the folder that `make petsc` printed
# - CHOLMOD without its modules under the GPL, which leaves the simplicial factor (LGPL);
# - UMFPACK, KLU and SPQR as symbols without code: PETSc links to them, pounding never calls them, and two are under the GPL;
# - HDF5 without network access, which needs some thirty libraries.
set -euo pipefail
. "$(dirname "$0")/building.sh"
petsc=$(realpath "$1")
mkdir -p "$2"
prefix=$(realpath "$2")
jobs=${JOBS:-$(nproc)}
# Concurrent builds of the same version wait here.
alone_in "$prefix"
if [ -e "$prefix/ready" ] && [ "$prefix/ready" -nt "$petsc/ready" ]; then
  echo "$prefix"
  exit
fi
work=$prefix/build
log=$prefix/log
mkdir -p "$work/lists/partial" "$prefix/lib/pkgconfig" "$prefix/include" "$prefix/share/licences"
cd "$work"
echo "Building HDF5 and CHOLMOD into $prefix: about three minutes on two free cores; the log is $log" >&2

# Sources from the mirror of the system, without changing its package lists.
if ! ls hdf5_*.orig.tar.* suitesparse_*.orig.tar.* > /dev/null 2>&1; then
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' "Codename: $release" | head -n 1)
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $release main" > sources.list
  apt=(apt-get -o Dir::Etc::sourceparts=/dev/null -o "Dir::Etc::sourcelist=$work/sources.list" -o "Dir::State::lists=$work/lists")
  run "${apt[@]}" update
  run "${apt[@]}" source --download-only hdf5 suitesparse
fi
unpack() {
  rm -rf "$1"
  mkdir "$1"
  tar xf "$(echo "$1"_*.orig.tar.*)" --strip-components=1 --directory "$1"
}

if [ ! -e "$prefix/lib/pkgconfig/hdf5.pc" ]; then
  unpack hdf5
  cd hdf5
  run ./configure --quiet --prefix="$prefix" --disable-static --disable-hl --disable-tests --disable-tools --enable-build-mode=production \
    --with-zlib --without-szlib
  run make --jobs "$jobs" -C src
  run make -C src install
  cd ..
  version=$(sed -n 's/^#define H5_PACKAGE_VERSION "\(.*\)"/\1/p' hdf5/src/H5pubconf.h)
  printf 'Name: HDF5\nDescription: HDF5 without the reader of files on the network\nVersion: %s\nCflags: -I%s/include\nLibs: -L%s/lib -lhdf5\n' \
    "$version" "$prefix" "$prefix" > "$prefix/lib/pkgconfig/hdf5.pc"
  cp hdf5/COPYING "$prefix/share/licences/HDF5"
fi

if [ ! -e "$prefix/share/licences/CHOLMOD" ]; then
  unpack suitesparse
  source=suitesparse/CHOLMOD
  run cc -O2 -fPIC -shared -DNGPL -Wl,-soname,libcholmod.so.3 -Wl,-Bsymbolic -I /usr/include/suitesparse -I "$source/Include" \
    -o "$prefix/lib/libcholmod.so.3" "$source"/{Core,Check,Cholesky,Partition}/cholmod_*.c \
    -lccolamd -lcamd -lcolamd -lamd -lmetis -lsuitesparseconfig -lm
  cp "$source/Doc/License.txt" "$prefix/share/licences/CHOLMOD"
fi

nm --dynamic --undefined-only "$petsc/lib/libpetsc.so" | awk '{print $2}' > asked
missing() {
  local library=$1 names name
  names=$(grep --extended-regexp "$2" asked)
  {
    echo '#include <stdio.h>'
    echo "static void *none(void) { fputs(\"pounding: this wheel comes without ${library^^}\\n\", stderr); return 0; }"
    # UMFPACK signals failure by a status below 0, the others by a null pointer or 0.
    for name in $names; do
      case $name in
        umfpack_*) echo "int $name(void) { none(); return -1; }" ;;
        *) echo "void *$name(void) { return none(); }" ;;
      esac
    done
  } > "$library.c"
  run cc -O2 -fPIC -shared -Wl,-soname,"$(readelf --dynamic "$petsc/lib/libpetsc.so" | sed -n "s/.*NEEDED.*\[\(lib$library\.so[^]]*\)\].*/\1/p")" \
    -o "$prefix/lib/lib$library.so" "$library.c"
}
missing umfpack '^umfpack_'
missing klu '^klu_'
# SPQR uses CHOLMOD with long indices.
missing spqr '^(SuiteSparseQR_|cholmod_l_)'
cd "$prefix"
for library in umfpack klu spqr; do
  name=$(readelf --dynamic "lib/lib$library.so" | sed -n 's/.*SONAME.*\[\(.*\)\].*/\1/p')
  mv "lib/lib$library.so" "lib/$name"
done
for each in blas:libblas.so.3 lapack:liblapack.so.3 openblas:libopenblas.so.0; do
  ln -sf "/usr/lib/x86_64-linux-gnu/openblas-serial/${each#*:}" "lib/${each#*:}"
done
rm -rf "$work/hdf5" "$work/suitesparse"
touch ready
echo "$prefix"
