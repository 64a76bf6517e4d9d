#!/usr/bin/env bash
# Runs every fuzz target of a build folder in turn, for MINUTES in total, and prints the number of executions of each.
#   run.sh BUILD MINUTES [TARGET...]
# The corpus is kept in BUILD/fuzz/corpus for the next time. An input that crashes, takes more than 10 s or more than 1
# GB is written to BUILD/fuzz/found.
set -euo pipefail
build=$(realpath "$1")
minutes=$2
shift 2
here=$(realpath "$(dirname "$0")")
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(model records units laws c_interface state results)
seconds=$((minutes * 60 / ${#targets[@]} + 1))

mkdir -p "$build/fuzz/corpus" "$build/fuzz/found" "$build/fuzz/log"
export POUNDING_RECORDS=$here/seeds/records UBSAN_OPTIONS=print_stacktrace=1
# Models name records, here those of the seeds.
cd "$here/seeds/records"
status=0
for target in "${targets[@]}"; do
  folders=("$build/fuzz/corpus/$target")
  mkdir -p "${folders[0]}"
  for folder in "$here/seeds/$target" "$here/../corpus/$target"; do
    [ -d "$folder" ] && folders+=("$folder")
  done
  if [ "$target" = model ]; then
    mkdir -p "$build/fuzz/examples"
    for example in "$here"/../../examples/*/*.yaml; do
      cp "$example" "$build/fuzz/examples/$(basename "$(dirname "$example")")-$(basename "$example")"
    done
    folders+=("$build/fuzz/examples")
  fi
  log=$build/fuzz/log/$target
  code=0
  "$build/tests/fuzz/fuzz_$target" -max_total_time=$seconds -timeout=10 -rss_limit_mb=1024 -print_final_stats=1 \
    -dict="$build/tests/fuzz/words.dict" -artifact_prefix="$build/fuzz/found/$target-" "${folders[@]}" > "$log" 2>&1 < /dev/null || code=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" || true)
  printf '%-12s %12s executions in %s s\n' "$target" "${executions:-?}" "$seconds"
  if [ $code -ne 0 ]; then
    status=1
    echo "  a fault: $(grep -E '^(SUMMARY|broken promise)|runtime error:|what\(\):' "$log" | head -n 1)"
    echo "  the input: $(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1); the whole text: $log"
  fi
done
exit $status
