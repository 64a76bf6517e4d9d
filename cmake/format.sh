#!/usr/bin/env bash
# Formats the sources in place: C++ and C with clang-format, Python with ruff, Markdown with mdformat.
#   format.sh TOOLS [--check]    TOOLS is the folder of the programs; --check changes nothing and fails if a file would change
set -euo pipefail
cd "$(dirname "$0")/.."
tools=$1
check=${2:+yes}

# Generated pages are compared with their generators instead.
generated='elements/pounding/*/pages/*.md python/docs/reference/words.md tests/verification/README.md'
git ls-files -z '*.cpp' '*.hpp' '*.h' '*.c' | xargs -0 "$tools/clang-format" ${check:+--dry-run -Werror} -i
git ls-files -z '*.py' | xargs -0 "$tools/ruff" format --quiet ${check:+--check}
git ls-files -z '*.md' $(printf ':!%s ' $generated) |
  xargs -0 "$tools/mdformat" --wrap 120 --number --compact-tables ${check:+--check}
