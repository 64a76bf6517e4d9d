# Functions of the scripts that build libraries into the cache folder of the user; source this file.

# Locks the folder until this process ends.
alone_in() {
  exec 9> "$1/lock"
  flock 9
}

# Runs a command at low priority with its output in the file $log; prints the end of the log if it fails.
run() {
  if ! nice "$@" >> "$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "failed: $*; the log is $log" >&2
    exit 1
  fi
}
