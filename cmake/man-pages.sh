#!/usr/bin/env bash
# Makes pounding.1 and one page per command from the help of the program.
#   man-pages.sh HELP2MAN PROGRAM FOLDER
set -euo pipefail
help2man=$1 program=$2 folder=$3
version=$("$program" --version | cut --delimiter=' ' --fields=2)

# Commands in Python print their help only if it is installed; without it they have no page.
page() {  # WORDS OF THE COMMAND, its page, what it does
  "$help2man" --no-info --version-string="$version" --source="pounding $version" --name="$3" --output="$folder/$2.1" "$program$1"
}

mkdir -p "$folder"
help=$("$program" --help)
page "" pounding "$(head --lines=1 <<< "$help" | tr '[:upper:]' '[:lower:]')"
sed --quiet '/^Subcommands:/,$ s/^  \([a-z]\+\) \+/\1 /p' <<< "$help" | while read -r command summary; do
  "$program" "$command" --help > /dev/null 2>&1 || continue
  page " $command" "pounding-$command" "$summary"
done
