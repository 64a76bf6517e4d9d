"""`mpirun -n 2 python3`: an error on one process reaches all, and none waits for a process that has ended."""

import os
import shutil
import subprocess
import sys
import textwrap
import unittest
from pathlib import Path
from messages import assert_mentions

LAUNCHER = os.environ.get("POUNDING_MPIEXEC") or shutil.which("mpiexec") or shutil.which("mpirun")
MODEL = Path(os.environ["POUNDING_EXAMPLES"]) / "02_two_oscillators/model.yaml"
#: Open MPI refuses root and oversubscription by default.
SURROUNDINGS = {
    **os.environ,
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OPENBLAS_NUM_THREADS": "1",
}
PATIENCE = 100  # [s]; a hanging run fails its test
#: Each process prints its message in one piece, because mpirun mixes output.
BEGIN = f"""
import os, sys
import pounding
second = next(os.environ[name] for name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK") if name in os.environ) == "1"
model = pounding.Model.from_file("{MODEL}")

def report(task):
    try:
        said = f"{{len(task().impacts)}} impacts"
    except Exception as error:
        said = f"{{type(error).__name__}}: {{error}}"
    sys.stdout.write(f"{{second + 1}} {{said}}\\n")
    sys.stdout.flush()

def run(**arguments):
    return pounding.run(model, **{{"tolerance": 1e-3, **arguments}})
"""


@unittest.skipUnless(LAUNCHER, "mpiexec is missing")
class Processes(unittest.TestCase):
    def on_two(self, code):
        return subprocess.run(
            [LAUNCHER, "-n", "2", sys.executable, "-c", BEGIN + textwrap.dedent(code)],
            text=True,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=PATIENCE,
            env=SURROUNDINGS,
        )

    def told(self, code):
        """Lines printed by each process, in order."""
        done = self.on_two(code)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = sorted(done.stdout.splitlines())
        return [[line[2:] for line in lines if line[0] == process] for process in "12"]


class Raised(Processes):
    def test_by_one_is_raised_by_all_and_they_go_on(self):
        first, second = self.told("""
            if second:
                model.links[0]["law"] = "jankowsky"
            report(run)
            model.links[0]["law"] = "jankowski"
            report(run)
        """)
        self.assertEqual(first, second)
        done, refused = first
        assert_mentions(refused, ["InputError", "2", "jankowsky", "jankowski"])
        self.assertEqual(done, "5 impacts")

    def test_by_all_is_what_one_process_raises(self):
        first, second = self.told('model.links[0]["gap"] = "20 s"; report(run)')
        self.assertEqual(first, second)
        self.assertNotIn("alone", first[0])
        assert_mentions(first[0], "InputError")

    def test_before_the_run_began(self):
        first, second = self.told('report(lambda: pounding.run("none.yaml" if second else model))')
        self.assertEqual(first, second)
        assert_mentions(first[0], ["InputError", "2", "yaml"])
        first, second = self.told("report(lambda: run(options=5 if second else None))")
        self.assertEqual(first, second)
        assert_mentions(first[0], ["InputError", "2"])

    def test_by_a_file_that_cannot_go_on(self):
        first, second = self.told('report(lambda: pounding.resume("none.h5" if second else "nothing.h5"))')
        self.assertEqual(first, second)
        assert_mentions(first[0], ["InputError", "h5"])

    def test_by_one_in_the_middle_ends_the_run_of_all(self):
        first, second = self.told("""
            model.analysis = {"duration": 100000, "output_step": 10}
            def progress(time, duration, impacts):
                if second:
                    raise ValueError("enough")
            report(lambda: run(progress=progress))
        """)
        self.assertEqual(
            (first, second), (["SolverError: process 2 of 2 failed alone: ValueError: enough"], ["ValueError: enough"])
        )

    def test_different_models_are_refused(self):
        for different in (
            'model.links[0]["gap"] = 0.02 + 0.01 * second',
            'arguments["options"] = {"ts_max_steps": 10 + second}',
        ):
            with self.subTest(different):
                first, second = self.told(f"arguments = {{}}; {different}; report(lambda: run(**arguments))")
                self.assertEqual(first, second)
                assert_mentions(first[0], "InputError")


class Uncaught(Processes):
    def ends(self, code, error="ZeroDivisionError"):
        done = self.on_two(code)
        self.assertNotEqual(done.returncode, 0)
        assert_mentions(done.stderr, error)
        return done

    def test_of_one_ends_the_others_who_run(self):
        for begin in ("", "run()", "from mpi4py import MPI"):
            with self.subTest(begin):
                done = self.ends(f"""
                    {begin}
                    print("before", flush=False)
                    if second:
                        1 / 0
                    run()
                    print("after")
                """)
                self.assertIn("before", done.stdout)
                self.assertNotIn("after", done.stdout)

    def test_of_all_ends_without_force(self):
        done = self.ends("run(); 1 / 0")
        self.assertEqual(done.stderr.count("ZeroDivisionError"), 2)
        self.assertNotIn("MPI_ABORT", done.stderr)

    def test_failure_of_one_while_the_others_wait_for_it(self):
        """A PETSc option that only one process has is refused by that process after the run of the others has begun."""
        code = textwrap.dedent("""
            import ctypes
            run()
            if second:
                [petsc] = {line.split()[-1] for line in open("/proc/self/maps") if "libpetsc" in line}
                ctypes.CDLL(petsc).PetscOptionsSetValue(None, b"-pounding_ts_pounding_radius", b"7")
        """)
        done = self.ends(code + "run()", "process 2 of 2 failed alone")
        self.assertIn("radius", done.stderr)
        # Open MPI's own message about the abort is sometimes lost.
        done = self.ends(code + "report(run); report(run)", error="")
        assert_mentions(done.stdout, "2")


if __name__ == "__main__":
    unittest.main()
