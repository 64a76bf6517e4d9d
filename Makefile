# From a clean clone on Debian 12: `make demo`, `make test`. CMake does the build (see CONTRIBUTING.md and CMakePresets.json).
# The demo compiles the program only; the tests use the same folder.

JOBS ?= $(shell nproc)
MINUTES ?= 10
PART ?= all
COUNT ?= 10000
PETSC ?=
VERSIONS ?= 3.26.1
MPI ?= on
PYTHONS ?= python3

# PETSC=3.26.1 builds in a separate folder with that PETSc, which `make petsc` installs into the cache folder of the user.
BUILD = build
cache = $(or $(XDG_CACHE_HOME),$(HOME)/.cache)/pounding
ifneq ($(PETSC),)
kind = $(if $(filter off,$(MPI)),nompi,mpi)
BUILD = build-petsc-$(PETSC)-$(kind)
petsc_folder = $(cache)/petsc-$(PETSC)-$(kind)
petsc_options = -DPETSC_DIR=$(petsc_folder) -DPOUNDING_MPI=$(MPI)
petsc_ready = $(petsc_folder)/ready
else ifeq ($(filter on,$(MPI)),)
$(error MPI=$(MPI) needs PETSC=VERSION: the PETSc of the system has MPI. Type make $(MAKECMDGOALS) PETSC=3.26.1 MPI=off)
endif

# The matrices are small: more BLAS threads would make the tests slower.
export OPENBLAS_NUM_THREADS ?= 1

CTEST = ctest --test-dir $(BUILD) --output-on-failure --no-tests=error --parallel $(JOBS)

.PHONY: build program test test-all test-sanitized test-threads test-damage test-petsc-headers fuzz demo announce format format-check docs wheel test-wheel \
  portable-wheel test-portable-wheel release python python-test petsc packages-demo packages clean distclean help

build: $(BUILD)/with-tests
	cmake --build $(BUILD) --parallel $(JOBS)

program: $(BUILD)/build.ninja
	cmake --build $(BUILD) --parallel $(JOBS) --target pounding_program

test: build
	$(CTEST) --label-exclude '^long$$'

# Includes the long tests. Cells of the site run in `make docs`.
test-all: build
	$(CTEST) --label-exclude '^cells$$'

# PETSc and SLEPc from their source archives on PyPI: make petsc PETSC=3.26.1 MPI=off
petsc: $(petsc_ready)
	@test -n "$(PETSC)" || { echo "Which version? Type make petsc PETSC=3.26.1, with MPI=off for one without MPI" >&2; exit 2; }
	@echo $(petsc_folder)

# Unit tests and the corpus under the address and undefined-behaviour sanitizers; PART=quick excludes tests with matrices.
test-sanitized: | packages
	cmake --preset sanitize
	bash tests/sanitized.sh build-sanitize $(PART) $(JOBS)

# Runs in several threads under the thread sanitizer: the libraries and one test program.
test-threads: | packages
	cmake --preset threads
	cmake --build build-threads --parallel $(JOBS) --target test_threads
	build-threads/tests/run/test_threads --gtest_brief=1

test-damage: build
	POUNDING_PROGRAM=$(CURDIR)/build/pounding PYTHONPATH=$(CURDIR)/build/python POUNDING_PYTHON=$(CURDIR)/.venv-test/bin/python3 \
	  .venv-test/bin/python3 tests/program/damage.py --count $(COUNT)

# Compiles the sources that call PETSc against the headers of other versions, from their archives on PyPI.
test-petsc-headers: build
	bash tests/install/petsc_headers.sh build $(VERSIONS)

# Clang's libFuzzer searches for inputs that crash, hang or exhaust the memory, for MINUTES in total.
fuzz:
	@bash cmake/install-debian.sh demo clang-14 libclang-rt-14-dev llvm-14
	cmake --preset fuzz
	cmake --build build-fuzz --parallel $(JOBS) --target fuzz
	bash tests/fuzz/run.sh build-fuzz $(MINUTES)

# Compiles and downloads in parallel.
demo: announce packages-demo
	@$(MAKE) --no-print-directory --jobs=2 .venv/ready program
	@bash cmake/demo.sh

# Names all missing Debian packages before any is installed.
package_set = $(if $(filter-out demo program .venv/ready,$(or $(MAKECMDGOALS),build)),test,demo)
announce:
	@bash cmake/install-debian.sh --names $(package_set)

# C++, Python and Markdown; format-check changes no file and fails if one is not formatted.
format format-check: .venv-test/ready
	@bash cmake/format.sh .venv-test/bin $(if $(filter format-check,$@),--check)

# The site: user guide, laws, executed tutorials, theory, reference. A warning is an error.
docs: build .venv-test/docs-ready
	@bash cmake/install-debian.sh test fonts-stix
	PYTHONPATH=$(CURDIR)/build/python .venv-test/bin/python3 -m sphinx -q -W --keep-going -c python/docs -d build/docs.doctrees . build/docs
	@echo "build/docs/index.html"

# The wheel is built from the source archive. ccache reuses the objects of `build`: compiler names and relative paths agree, since
# the folder b has the same depth as build.
wheel: .venv-test/ready
	rm -rf build/dist
	CC=cc CXX=c++ .venv-test/bin/python3 -m build --config-setting=build-dir=b --outdir build/dist

test-wheel: wheel
	bash tests/install/wheel.sh build/dist/*.whl

# Wheels that contain PETSc without MPI and all other libraries, one for each of PYTHONS; PETSC selects the version.
portable_petsc = $(cache)/petsc-$(or $(PETSC),3.26.1)-nompi
portable-wheel:
	@bash cmake/install-debian.sh demo libopenblas0-serial libmetis-dev
	$(MAKE) petsc PETSC=$(or $(PETSC),3.26.1) MPI=off
	JOBS=$(JOBS) bash cmake/portable_libraries.sh $(portable_petsc) $(cache)/portable-libraries
	rm -f build/portable/*.whl
	python3 cmake/portable_wheel.py --petsc $(portable_petsc) --libraries $(cache)/portable-libraries --out build/portable $(PYTHONS)

test-portable-wheel:
	bash tests/install/portable.sh build/portable/*.whl

# Source archive and portable wheels of this version, checksums, and its notes from CHANGELOG.md.
release: wheel portable-wheel
	python3 cmake/release.py --out build/release build/dist/*.tar.gz build/portable/*.whl

python: .venv/ready

python-test: .venv-test/ready

packages-demo: | announce
	@bash cmake/install-debian.sh demo

packages: | announce
	@bash cmake/install-debian.sh test

.venv/ready: python/requirements.txt python/requirements-records.txt | packages-demo
	bash cmake/python-env.sh .venv

.venv-test/ready: python/requirements.txt python/requirements-test.txt python/requirements-records.txt \
    python/requirements-format.txt \
    python/requirements-opensees.txt | packages
	bash cmake/python-env.sh .venv-test

.venv-test/docs-ready: python/docs/requirements.txt | .venv-test/ready
	@echo "Installing sphinx, furo, myst-nb, sphinx-copybutton and their dependencies from PyPI into .venv-test"
	.venv-test/bin/python3 -m pip install --quiet --disable-pip-version-check --requirement python/docs/requirements.txt
	@touch $@

$(BUILD)/build.ninja: | packages-demo $(petsc_ready)
	cmake -S . -B $(BUILD) -G Ninja -DPOUNDING_BUILD_TESTS=OFF -DPOUNDING_PYTHON=OFF $(petsc_options)

# Adds targets to the build folder of the demo.
$(BUILD)/with-tests: .venv/ready .venv-test/ready | packages $(petsc_ready)
	cmake -S . -B $(BUILD) -G Ninja -DPOUNDING_BUILD_TESTS=ON -DPOUNDING_PYTHON=AUTO $(petsc_options)
	@touch $@

ifneq ($(PETSC),)
$(petsc_ready):
	@bash cmake/install-debian.sh petsc $(if $(filter off,$(MPI)),libhdf5-dev,libhdf5-openmpi-dev libmumps-dev libscalapack-openmpi-dev gfortran)
	JOBS=$(JOBS) bash cmake/petsc.sh $(PETSC) $(MPI)
endif

clean:
	rm -rf build build-fuzz build-sanitize build-threads build-petsc-* demo.h5 demo.png

distclean: clean
	rm -rf .venv .venv-test

help:
	@echo "make demo       install packages, compile the program, run two frames during an earthquake: demo.h5, demo.png"
	@echo "make test       install packages, compile everything, run all but the long tests; test-all: all tests"
	@echo "make test-sanitized   unit tests under the address and undefined-behaviour sanitizers; PART=quick for a subset"
	@echo "make test-threads     runs in several threads under the thread sanitizer"
	@echo "make test-damage      COUNT=n damaged results files, by every reader"
	@echo "make test-petsc-headers   VERSIONS=\"3.22.5 3.26.1\": compile the sources that call PETSc against their headers"
	@echo "make fuzz       MINUTES=n: look for inputs that crash or hang; installs Clang"
	@echo "make build      compile everything into build/"
	@echo "make petsc PETSC=3.26.1   build PETSc and SLEPc of that version into ~/.cache/pounding, MPI=off without MPI; make test,"
	@echo "                build and program accept the same options and use build-petsc-..."
	@echo "make format     format C++, Python and Markdown; format-check lists unformatted files"
	@echo "make docs       build, run the tutorials, make the site: build/docs/index.html"
	@echo "make wheel      the Python package for pip: build/dist; test-wheel tests it in a new environment"
	@echo "make portable-wheel   PYTHONS=\"python3.11 python3.12\": self-contained wheels without MPI: build/portable;"
	@echo "                test-portable-wheel tests the one of python3 in a new environment"
	@echo "make release    source archive and portable wheels, checksums, notes of the version: build/release"
	@echo "make python     the Python environment .venv for pictures; python-test: .venv-test, for tests and builds"
	@echo "make clean      remove build/, build-fuzz/, build-sanitize/, build-threads/ and the demo's files; distclean also removes .venv and .venv-test"
	@echo "JOBS=$(JOBS) processes are used"
