# From a clean clone on Debian 12: `make demo` or `make test`. The build itself is CMake's (see CMakePresets.json).

JOBS ?= $(shell nproc)
LONG ?= 1

# The matrices are small: more BLAS threads would only stand in each other's way.
export OPENBLAS_NUM_THREADS ?= 1

CTEST_FLAGS = --output-on-failure --no-tests=error --parallel $(JOBS)
ifeq ($(LONG),0)
CTEST_FLAGS += --label-exclude long
endif

.PHONY: build test demo python packages clean distclean help

build: build/build.ninja
	cmake --build build --parallel $(JOBS)

test: build
	ctest --test-dir build $(CTEST_FLAGS)

demo: build
	bash cmake/demo.sh

python: .venv/ready

packages:
	@bash cmake/install-debian.sh

.venv/ready: python/requirements.txt python/requirements-records.txt | packages
	bash cmake/python-env.sh

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
	@echo "make python     only the Python environment .venv that draws pictures"
	@echo "make clean      remove build/ and the demo's files; distclean removes .venv too"
	@echo "JOBS=$(JOBS) processes are used"
