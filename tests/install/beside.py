#!/usr/bin/env python3
"""The package together with others in one process, imported in every order, each order in a new process.

    beside.py h5py mpi4py.MPI petsc4py.PETSc openseespy.opensees

Every order that works without this package must work with it at each position, and run a model to the same peak force.
POUNDING_EXAMPLES names the folder of the lessons.
"""

import itertools
import os
import subprocess
import sys

#: Use of a package after all imports.
USES = {
    "h5py": "import io\nwith h5py.File(io.BytesIO(), 'w') as file:\n    file['a'] = [1.0, 2.0]\n    assert file['a'][1] == 2",
    "mpi4py.MPI": "assert mpi4py.MPI.COMM_WORLD.allreduce(3) == 3 * mpi4py.MPI.COMM_WORLD.size",
    "petsc4py.PETSc": "x = petsc4py.PETSc.Vec().createSeq(3)\nx.set(2)\nassert x.sum() == 6",
    "openseespy.opensees": "ops = openseespy.opensees\nops.wipe()\nops.model('basic', '-ndm', 1, '-ndf', 1)\nops.node(1, 0.0)\nassert ops.getNodeTags() == [1]",
    "pounding": f"print('force', pounding.run('{os.environ['POUNDING_EXAMPLES']}/02_two_oscillators/model.yaml').links['left-right'].force.max())",
}


def outcome(order):
    """Exit code and last line of a process that imports in this order and uses all of them twice."""
    imports = "\n".join(f"import {name}" for name in order)
    uses = "\n".join(USES[name] for name in (*order, *reversed(order)))
    done = subprocess.run(
        [sys.executable, "-c", f"{imports}\n{uses}\n"],
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
        timeout=120,
    )
    forces = {line for line in done.stdout.splitlines() if line.startswith("force")}
    return done.returncode, " ".join(sorted(forces)) or (done.stderr.strip().splitlines() or [""])[-1][:100]


def main():
    others, expected, failed, passed = sys.argv[1:], outcome(["pounding"]), 0, 0
    for order in itertools.permutations(others):
        # Some packages are incompatible with each other regardless of pounding.
        code, told = outcome(order)
        if code != 0:
            print(f"{', '.join(order)}: skipped, since without pounding it ends with {code} ({told})")
            continue
        for place in range(len(order) + 1):
            whole = [*order[:place], "pounding", *order[place:]]
            found = outcome(whole)
            if found == expected:
                passed += 1
            else:
                failed += 1
                print(f"{', '.join(whole)}: {found[0]} {found[1]}")
    print(f"{passed} orders of pounding, {', '.join(others)} gave {expected[1]}, {failed} did not")
    return failed > 0 or passed == 0 or expected[0] != 0


if __name__ == "__main__":
    sys.exit(main())
