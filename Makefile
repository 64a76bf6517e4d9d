# From a clean clone on Debian 12: `make demo` or `make test`. The build itself is CMake's (see CMakePresets.json).

JOBS ?= $(shell nproc)
LONG ?= 1

# The matrices are small: more BLAS threads would only stand in each other's way.
export OPENBLAS_NUM_THREADS ?= 1

CTEST_FLAGS = --output-on-failure --no-tests=error --parallel $(JOBS)
ifeq ($(LONG),0)
CTEST_FLAGS += --label-exclude long
endif

.PHONY: build test demo docs wheel test-wheel python packages clean distclean help

build: build/build.ninja
	cmake --build build --parallel $(JOBS)

test: build
	ctest --test-dir build $(CTEST_FLAGS)

demo: build
	bash cmake/demo.sh

# The site: user guide, laws, tutorials whose cells are run, theory, reference. A warning is an error.
docs: build .venv/docs-ready
	@bash cmake/install-debian.sh fonts-stix
	PYTHONPATH=$(CURDIR)/build/python .venv/bin/python3 -m sphinx -q -W --keep-going -c python/docs -d build/docs.doctrees . build/docs
	@echo "build/docs/index.html"

# The wheel is made from the archive of the sources. What `build` has compiled comes from ccache: it compares the names of the
# compilers, and paths from the build folder, for which b lies as deep as build.
wheel: .venv/ready
	rm -rf build/dist
	CC=cc CXX=c++ .venv/bin/python3 -m build --config-setting=build-dir=b --outdir build/dist

test-wheel: wheel
	bash tests/install/wheel.sh build/dist/*.whl

python: .venv/ready

packages:
	@bash cmake/install-debian.sh

.venv/ready: python/requirements.txt python/requirements-records.txt python/requirements-opensees.txt | packages
	bash cmake/python-env.sh

.venv/docs-ready: python/docs/requirements.txt | .venv/ready
	@echo "Installing what builds the site into .venv (packages from PyPI): sphinx, furo, myst-nb and what they need"
	.venv/bin/python3 -m pip install --quiet --disable-pip-version-check --requirement python/docs/requirements.txt
	@touch $@

build/build.ninja: .venv/ready | packages
	cmake -S . -B build -G Ninja
	@touch $@

clean:
	rm -rf build demo.h5 demo.png

distclean: clean
	rm -rf .venv

help:
	@echo "make build      install what is missing, build into build/"
	@echo "make test       build and run every test; LONG=0 leaves the long ones out"
	@echo "make demo       build, run two frames through an earthquake: demo.h5, demo.png"
	@echo "make docs       build, run the tutorials, make the site: build/docs/index.html"
	@echo "make wheel      the Python package for pip: build/dist; test-wheel installs it into a new environment and runs it there"
	@echo "make python     only the Python environment .venv that draws pictures"
	@echo "make clean      remove build/ and the demo's files; distclean removes .venv too"
	@echo "JOBS=$(JOBS) processes are used"
