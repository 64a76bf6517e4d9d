# Parts of the scripts that build libraries into a folder of the user; they are sourced.

# Who builds in the same folder waits until this process ends.
alone_in() {
  exec 9> "$1/lock"
  flock 9
}

# A command at low priority whose words go to the file $log; the end of them is shown where it fails.
run() {
  if ! nice "$@" >> "$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "failed: $*; the log is $log" >&2
    exit 1
  fi
}
