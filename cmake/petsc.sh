#!/usr/bin/env bash
# Builds PETSc and SLEPc of one version from the source archives on PyPI into a folder of the user, and prints that folder last.
#   petsc.sh VERSION on|off [FOLDER]     on: with MPI (the compilers mpicc and mpicxx), off: without
# Uses CHOLMOD of SuiteSparse, and with MPI also MUMPS if the system has it for this MPI. Environment: JOBS, number of processes;
# MPICC, MPICXX, MPIFC, the compilers (mpicc, mpicxx, mpif90); WITHOUT_MUMPS=1 excludes MUMPS.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
. "$here/building.sh"
version=$1
mpi=$2
case $mpi in
  on) kind=mpi ;;
  off) kind=nompi ;;
  *) echo "MPI=$mpi is neither on nor off" >&2; exit 2 ;;
esac
if ! [[ $version =~ ^3\.(1[89]|2[0-9])\.[0-9]+$ ]]; then
  echo "PETSC=$version is not a version from 3.18.0 on, such as 3.26.1" >&2
  exit 2
fi
cache=${XDG_CACHE_HOME:-$HOME/.cache}/pounding
prefix=${3:-$cache/petsc-$version-$kind}
jobs=${JOBS:-$(nproc)}
work=$cache/build/petsc-$version-$kind
log=$work/log
mkdir -p "$work"
# Concurrent builds of the same version wait here.
alone_in "$work"
if [ -e "$prefix/ready" ]; then
  echo "$prefix"
  exit
fi

echo "Building PETSc and SLEPc $version ($kind) into $prefix: about ten minutes on two free cores; the log is $log" >&2

cd "$work"
archives=$(bash "$here/petsc_sources.sh" "$version" 2>> "$log") || { tail -n 30 "$log" >&2; exit 1; }
while read -r archive; do
  slepc=$(basename "$archive" .tar.gz)
  [ -d "$slepc" ] || tar xf "$archive"
done <<< "$archives"

options=(--prefix="$prefix" --with-debugging=0 --with-shared-libraries=1 --with-x=0 --with-ssl=0 --with-c2html=0
  --with-fortran-bindings=0 COPTFLAGS=-O2 CXXOPTFLAGS=-O2
  --with-blaslapack-lib="-llapack -lblas"
  --with-suitesparse=1 --with-suitesparse-include="${SUITESPARSE_INCLUDE:-/usr/include/suitesparse}"
  --with-suitesparse-lib="-lspqr -lumfpack -lklu -lcholmod -lamd"
  # Binds calls within the library even if another PETSc is in the process. Data stay global: executables may contain
  # PETSC_COMM_WORLD (copy relocations).
  LDFLAGS=-Wl,-Bsymbolic-functions)
if [ "$mpi" = on ]; then
  options+=(--with-cc="${MPICC:-mpicc}" --with-cxx="${MPICXX:-mpicxx}")
  if [ -n "${WITHOUT_MUMPS:-}" ]; then
    options+=(--with-fc=0)
  else
    options+=(--with-fc="${MPIFC:-mpif90}" --with-scalapack=1 --with-scalapack-lib=-lscalapack-openmpi
      --with-mumps=1 --with-mumps-include=/usr/include --with-mumps-lib="-ldmumps -lmumps_common -lpord")
  fi
else
  options+=(--with-mpi=0 --with-fc=0)
fi

unset PETSC_DIR PETSC_ARCH SLEPC_DIR
cd "petsc-$version"
run python3 ./configure PETSC_ARCH=$kind "${options[@]}"
run make PETSC_DIR="$PWD" PETSC_ARCH=$kind MAKE_NP="$jobs" all
run make PETSC_DIR="$PWD" PETSC_ARCH=$kind install
cd "../$slepc"
export PETSC_DIR=$prefix SLEPC_DIR=$PWD
run python3 ./configure --prefix="$prefix"
run make MAKE_NP="$jobs"
run make install
mkdir -p "$prefix/share/licences"
cp "$work/petsc-$version/LICENSE" "$prefix/share/licences/PETSc"
cat "$work/$slepc"/LICENSE* > "$prefix/share/licences/SLEPc"
touch "$prefix/ready"
rm -rf "$work/petsc-$version" "$work/$slepc"
echo "$prefix"
