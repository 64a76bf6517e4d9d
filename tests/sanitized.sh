#!/usr/bin/env bash
# Compiles tests in a build folder of the preset `sanitize` and runs them; the first finding ends a program, and this script fails.
#   sanitized.sh BUILD quick|all [JOBS]     quick: core, C interface and their corpus; all: every unit test and the whole corpus
set -euo pipefail
build=$(realpath "$1")
part=$2
jobs=${3:-$(nproc)}
here=$(realpath "$(dirname "$0")")

export ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$here/leaks.supp:print_suppressions=0
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OPENBLAS_NUM_THREADS=1

targets=(unit_tests fuzz_model fuzz_units fuzz_records fuzz_laws fuzz_c_interface fuzz_state fuzz_results)
corpus='^fuzz\.'
if [ "$part" = quick ]; then
  targets=(test_core test_c fuzz_units fuzz_records fuzz_c_interface fuzz_state)
  corpus='^fuzz\.(units|records|c_interface|state)$'
fi
cmake --build "$build" --parallel "$jobs" --target "${targets[@]}"

ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$jobs" --tests-regex "$corpus"
# Plug-ins of MPI stay loaded, or leaks have no names that leaks.supp could know.
stay=$build/libraries_stay.so
echo 'int dlclose(void* library) { (void)library; return 0; }' | cc -shared -fPIC -x c - -o "$stay"
export ASAN_OPTIONS=$ASAN_OPTIONS:verify_asan_link_order=0

failed=()
for program in "$build"/tests/*/test_*; do
  [ -f "$program" ] && [ -x "$program" ] || continue
  echo "== ${program##*/}"
  LD_PRELOAD=$stay "$program" --gtest_brief=1 || failed+=("${program##*/}")
done
if [ ${#failed[@]} -gt 0 ]; then
  echo "failed: ${failed[*]}"
  exit 1
fi
echo "the sanitizers are silent"
