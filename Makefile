# From a clean clone on Debian 12: `make demo`, `make test`. The build itself is CMake's (see CMakePresets.json).
# The demo compiles the program alone; what tests need is installed and compiled in the same folder when they are asked for.

JOBS ?= $(shell nproc)
MINUTES ?= 10
PART ?= all
COUNT ?= 10000
PETSC ?=
VERSIONS ?= 3.26.1
MPI ?= on
PYTHONS ?= python3

# With PETSC=3.26.1 the build takes that PETSc, which `make petsc` leaves in a folder of the user, and has a folder of its own.
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

# The matrices are small: more BLAS threads would only stand in each other's way.
export OPENBLAS_NUM_THREADS ?= 1

CTEST = ctest --test-dir $(BUILD) --output-on-failure --no-tests=error --parallel $(JOBS)

.PHONY: build program test test-all test-sanitized test-damage test-petsc-headers fuzz demo announce format format-check docs wheel test-wheel \
  portable-wheel test-portable-wheel release python python-test petsc packages-demo packages clean distclean help

build: $(BUILD)/with-tests
	cmake --build $(BUILD) --parallel $(JOBS)

program: $(BUILD)/build.ninja
	cmake --build $(BUILD) --parallel $(JOBS) --target pounding_program

test: build
	$(CTEST) --label-exclude '^long$$'

# With the long ones. The cells of the site's pages run when `make docs` makes the site.
test-all: build
	$(CTEST) --label-exclude '^cells$$'

# PETSc and SLEPc from their source archives on PyPI: make petsc PETSC=3.26.1 MPI=off
petsc: $(petsc_ready)
	@test -n "$(PETSC)" || { echo "Which version? Type make petsc PETSC=3.26.1, with MPI=off for one without MPI" >&2; exit 2; }
	@echo $(petsc_folder)

# Unit tests and the corpus under the address and undefined-behaviour sanitizers; PART=quick leaves out what has matrices in it.
test-sanitized: | packages
	cmake --preset sanitize
	bash tests/sanitized.sh build-sanitize $(PART) $(JOBS)

test-damage: build
	POUNDING_PROGRAM=$(CURDIR)/build/pounding PYTHONPATH=$(CURDIR)/build/python POUNDING_PYTHON=$(CURDIR)/.venv-test/bin/python3 \
	  .venv-test/bin/python3 tests/program/damage.py --count $(COUNT)

# Sources that call PETSc are compiled against the headers of other versions, from their archives on PyPI.
test-petsc-headers: build
	bash tests/install/petsc_headers.sh build $(VERSIONS)

# Clang's libFuzzer looks for texts that crash, hang or fill the memory, MINUTES in all.
fuzz:
	@bash cmake/install-debian.sh demo clang-14 libclang-rt-14-dev llvm-14
	cmake --preset fuzz
	cmake --build build-fuzz --parallel $(JOBS) --target fuzz
	bash tests/fuzz/run.sh build-fuzz $(MINUTES)

# The compiler and the network work side by side.
demo: announce packages-demo
	@$(MAKE) --no-print-directory --jobs=2 .venv/ready program
	@bash cmake/demo.sh

announce:
	@test -e build/pounding || echo "The demo installs Debian packages and a Python environment .venv where they are missing," \
	  "then compiles the program: about six minutes on two cores the first time, seconds afterwards"

# C++, Python and Markdown; format-check changes nothing and fails if a file would change.
format format-check: .venv-test/ready
	@bash cmake/format.sh .venv-test/bin $(if $(filter format-check,$@),--check)

# The site: user guide, laws, tutorials whose cells are run, theory, reference. A warning is an error.
docs: build .venv-test/docs-ready
	@bash cmake/install-debian.sh test fonts-stix
	PYTHONPATH=$(CURDIR)/build/python .venv-test/bin/python3 -m sphinx -q -W --keep-going -c python/docs -d build/docs.doctrees . build/docs
	@echo "build/docs/index.html"

# The wheel is made from the archive of the sources. What `build` has compiled comes from ccache: it compares the names of the
# compilers, and paths from the build folder, for which b lies as deep as build.
wheel: .venv-test/ready
	rm -rf build/dist
	CC=cc CXX=c++ .venv-test/bin/python3 -m build --config-setting=build-dir=b --outdir build/dist

test-wheel: wheel
	bash tests/install/wheel.sh build/dist/*.whl

# Wheels with PETSc without MPI and all other libraries inside, one for each of PYTHONS; 3.26.1 unless PETSC names another version.
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

packages-demo:
	@bash cmake/install-debian.sh demo

packages:
	@bash cmake/install-debian.sh test

.venv/ready: python/requirements.txt python/requirements-records.txt | packages-demo
	bash cmake/python-env.sh .venv

.venv-test/ready: python/requirements.txt python/requirements-test.txt python/requirements-records.txt \
    python/requirements-format.txt \
    python/requirements-opensees.txt | packages
	bash cmake/python-env.sh .venv-test

.venv-test/docs-ready: python/docs/requirements.txt | .venv-test/ready
	@echo "Installing what builds the site into .venv-test (packages from PyPI): sphinx, furo, myst-nb and what they need"
	.venv-test/bin/python3 -m pip install --quiet --disable-pip-version-check --requirement python/docs/requirements.txt
	@touch $@

$(BUILD)/build.ninja: | packages-demo $(petsc_ready)
	cmake -S . -B $(BUILD) -G Ninja -DPOUNDING_BUILD_TESTS=OFF -DPOUNDING_PYTHON=OFF $(petsc_options)

# Adds targets; what the demo has compiled stays.
$(BUILD)/with-tests: .venv/ready .venv-test/ready | packages $(petsc_ready)
	cmake -S . -B $(BUILD) -G Ninja -DPOUNDING_BUILD_TESTS=ON -DPOUNDING_PYTHON=AUTO $(petsc_options)
	@touch $@

ifneq ($(PETSC),)
$(petsc_ready):
	@bash cmake/install-debian.sh petsc $(if $(filter off,$(MPI)),libhdf5-dev,libhdf5-openmpi-dev libmumps-dev libscalapack-openmpi-dev gfortran)
	JOBS=$(JOBS) bash cmake/petsc.sh $(PETSC) $(MPI)
endif

clean:
	rm -rf build build-fuzz build-sanitize build-petsc-* demo.h5 demo.png

distclean: clean
	rm -rf .venv .venv-test

help:
	@echo "make demo       install what the program needs, compile it, run two frames through an earthquake: demo.h5, demo.png"
	@echo "make test       install what tests need, compile everything, run all tests but the long ones; test-all: those too"
	@echo "make test-sanitized   unit tests under the address and undefined-behaviour sanitizers; PART=quick some of them"
	@echo "make test-damage      COUNT=n damaged results files, by every reader"
	@echo "make test-petsc-headers   VERSIONS=\"3.22.5 3.26.1\": compile what calls PETSc against their headers, without making code"
	@echo "make fuzz       MINUTES=n: look for inputs that crash or hang; installs Clang"
	@echo "make build      compile everything into build/"
	@echo "make petsc PETSC=3.26.1   build PETSc and SLEPc of that version into ~/.cache/pounding, MPI=off without MPI; with the same"
	@echo "                words make test, build and program use them, in build-petsc-..."
	@echo "make format     format C++, Python and Markdown; format-check only tells which files differ"
	@echo "make docs       build, run the tutorials, make the site: build/docs/index.html"
	@echo "make wheel      the Python package for pip: build/dist; test-wheel installs it into a new environment and runs it there"
	@echo "make portable-wheel   PYTHONS=\"python3.11 python3.12\": wheels with all libraries inside, without MPI: build/portable;"
	@echo "                test-portable-wheel installs the one of python3 into a new environment and runs it there"
	@echo "make release    source archive and portable wheels, checksums, notes of the version: build/release"
	@echo "make python     only the Python environment .venv that draws pictures; python-test: .venv-test, for tests and builds"
	@echo "make clean      remove build/, build-fuzz/, build-sanitize/ and the demo's files; distclean removes .venv and .venv-test too"
	@echo "JOBS=$(JOBS) processes are used"
