"""The package together with other packages in one process; each test starts a new process."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
from collections import Counter
from pathlib import Path

from messages import assert_mentions

EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
ROOT = EXAMPLES.parent
WITHOUT_MPI = bool(os.environ.get("POUNDING_WITHOUT_MPI"))
#: One run, and one file written and read with h5py's own HDF5.
RUN = f"""
def run():
    import io, h5py, numpy
    import pounding
    results = pounding.run("{EXAMPLES}/02_two_oscillators/model.yaml", tolerance=1e-3)
    assert results.status == "done" and len(results.impacts) == 5
    with h5py.File(io.BytesIO(), "w") as file:
        file["a"] = numpy.arange(1000.0)
        assert file["a"][:].sum() == 499500
    return results
"""


def python(code, *launcher, **environment):
    done = subprocess.run(
        [*launcher, sys.executable, "-c", RUN + textwrap.dedent(code)],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
        stdin=subprocess.DEVNULL,
    )
    if done.returncode != 0:
        raise AssertionError(f"{done.returncode}: {done.stderr}")
    return done.stdout


class Importing(unittest.TestCase):
    def test_loads_nothing_that_is_not_used(self):
        code = """
            import sys
            import pounding
            dir(pounding)
            heavy = {"numpy", "h5py", "matplotlib", "typing", "pounding._core", "mpi4py"} & set(sys.modules)
            assert not heavy, heavy
            pounding.laws
            assert not {"matplotlib", "h5py"} & set(sys.modules)
            with open("/proc/self/maps") as maps:
                loaded = maps.read()
            # MPI opens its components when it starts.
            assert "mca_" not in loaded
            print("libmpi.so" in loaded)
        """
        self.assertEqual(python(code), f"{not WITHOUT_MPI}\n")

    def test_the_package_runs_the_program(self):
        done = subprocess.run(
            [sys.executable, "-m", "pounding", "--version"], capture_output=True, text=True, timeout=60
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, python("import pounding; print('pounding', pounding.__version__)"))

    def test_links_for_opensees_are_there_without_opensees(self):
        self.assertEqual(
            python("""
            import sys
            sys.modules["openseespy"] = None
            import pounding
            assert pounding.opensees.link.__name__ == "link" and "opensees" in dir(pounding)
            assert pounding.from_opensees.__module__ == "pounding._opensees.from_model"
            assert not {"matplotlib", "h5py"} & set(sys.modules)
            try:
                pounding.opensees.link(1, 2, 3, gap=0.0, law="hertz")
            except ImportError as error:
                assert "python3 -m pip install openseespy" in str(error)
            else:
                raise AssertionError("a link without a model")
        """),
            "",
        )

    def test_public_modules_are_attributes(self):
        for module in ("animation", "contact", "errors", "models", "opensees", "plan", "results", "studies", "view"):
            self.assertEqual(
                python(f"import pounding; print(pounding.{module}.__name__)").strip(), f"pounding.{module}"
            )

    def test_unknown_names_are_no_attributes(self):
        self.assertEqual(
            python("""
            import pounding
            assert not hasattr(pounding, "lawz")
            assert {"laws", "run", "Model"} <= set(dir(pounding))
            assert pounding.__version__.count(".") == 2
        """),
            "",
        )

    @unittest.skipUnless((ROOT / "python").exists(), "the sources are missing")
    def test_pictures_do_without_the_compiled_part(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(ROOT / "python/pounding", Path(folder) / "pounding")
            code = """
                import pounding._plots, pounding.animation, pounding._export, pounding._mode_shapes
                try:
                    pounding.laws
                except ImportError as error:
                    print(error)
            """
            said = python(code, PYTHONPATH=folder)
            self.assertIn("pip install .", said)


class OneProcess(unittest.TestCase):
    def test_h5py_before_and_after(self):
        python("import h5py; run(); run()")
        python("import pounding; pounding.laws; import h5py; run()")

    def test_both_hdf5_libraries_are_there_and_each_is_used_by_its_own(self):
        said = python("""
            results = run()
            maps = {line.split()[-1] for line in open("/proc/self/maps") if "libhdf5" in line and "_hl" not in line}
            ours = {name for name in maps if "h5py" not in name}
            assert len(ours) == 1 and len(maps) > 1, maps
            import h5py
            import tempfile
            with tempfile.TemporaryDirectory() as folder:
                results.save(folder + "/saved.h5")
            print("openmpi" in ours.pop())
        """)
        self.assertEqual(said, f"{not WITHOUT_MPI}\n")

    @unittest.skipIf(WITHOUT_MPI, "without MPI")
    def test_mpi4py_before_after_and_ending_mpi_itself(self):
        python("from mpi4py import MPI; run(); assert MPI.COMM_WORLD.size == 1 and not MPI.Is_finalized()")
        python("run(); from mpi4py import MPI; assert MPI.Is_initialized() and MPI.COMM_WORLD.size == 1; run()")
        python(
            "import mpi4py; mpi4py.rc.initialize = False; from mpi4py import MPI; run(); assert MPI.Is_initialized()"
        )

    def test_the_host_keeps_its_signals_and_variables(self):
        python("""
            import os, signal, subprocess
            ours = lambda *_: None
            for number in (signal.SIGTERM, signal.SIGUSR1, signal.SIGHUP):
                signal.signal(number, ours)
            before = subprocess.run(["env"], capture_output=True).stdout
            def signals():
                with open("/proc/self/status") as status:
                    masks = dict(line.split(":") for line in status if line[:6] in ("SigBlk", "SigIgn", "SigCgt"))
                # The real-time ones belong to the C library.
                return {name: int(mask, 16) & 0x7fffffff for name, mask in masks.items()}
            handled = signals()
            run()
            assert signals() == handled
            assert signal.getsignal(signal.SIGTERM) is ours
            assert subprocess.run(["env"], capture_output=True).stdout == before
        """)

    @unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
    def test_mpirun_can_be_started_afterwards(self):
        said = python(
            """
            import subprocess
            run()
            command = ["mpirun", "--oversubscribe", "-n", "2", "sh", "-c", "echo here"]
            print(subprocess.run(command, capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL).stdout)
        """,
            OMPI_ALLOW_RUN_AS_ROOT="1",
            OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
        )
        self.assertEqual(said.split(), ["here", "here"])

    @unittest.skipUnless(shutil.which("mpirun") and not WITHOUT_MPI, "mpirun is not installed, or without MPI")
    def test_two_processes_run_one_model(self):
        said = python(
            """
            import sys
            # In one piece: mpirun mixes those of two processes.
            sys.stdout.write(repr(float(run().impacts["peak_force"][0])) + "\\n")
        """,
            "mpirun",
            "--oversubscribe",
            "-n",
            "2",
            OMPI_ALLOW_RUN_AS_ROOT="1",
            OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
        )
        first, second = said.split()
        self.assertEqual(first, second)
        self.assertEqual(python('print(repr(float(run().impacts["peak_force"][0])))').split(), [first])


class InterruptedStudy(unittest.TestCase):
    def setUp(self):
        self.words = (
            os.environ["POUNDING_PROGRAM"],
            "study",
            EXAMPLES / "24_fragility_curve" / "study.yaml",
            "-o",
            "table.h5",
            "-j",
            "2",
        )
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.how = {"cwd": folder.name, "env": os.environ | {"POUNDING_PYTHON": sys.executable}}

    def interrupt_at(self, come):
        """The exit code of a study that receives Ctrl-C, as sent by a terminal, when come(process) returns."""
        Path(self.how["cwd"], "table.h5").unlink(missing_ok=True)
        study = subprocess.Popen(
            self.words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True, **self.how
        )
        come(study)
        os.killpg(study.pid, signal.SIGINT)
        told, _ = study.communicate(timeout=120)
        self.assertNotIn("Traceback", told)
        if study.returncode == 3:
            assert_mentions(told, "pounding")
        return study.returncode

    def test_ctrl_c_at_any_time_is_told_in_one_line(self):
        """While modules are imported, workers start, rows run and the program ends: never the Python location of the
        interrupt."""
        whole = time.monotonic()
        subprocess.run(self.words, capture_output=True, check=True, **self.how)
        whole = time.monotonic() - whole
        fates = Counter(
            self.interrupt_at(lambda _, part=part: time.sleep(part * whole))
            for part in (0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.05)
        )
        self.assertLessEqual(set(fates), {0, 3, -signal.SIGINT}, fates)

    def test_ctrl_c_while_workers_start_is_told_in_one_line(self):
        def children(process):
            return Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()

        def has(count, process):
            while process.poll() is None and len(children(process)) < count:
                pass

        # The workers and the process that cleans up after them.
        fates = Counter(
            self.interrupt_at(lambda process, count=count: has(count, process)) for count in (1, 2, 3) for _ in range(2)
        )
        self.assertIn(3, fates)
        self.assertLessEqual(set(fates), {0, 3}, fates)

    def test_ctrl_c_waits_until_a_worker_has_been_started(self):
        """Even if a thread of another library receives the signal that this one has blocked."""
        said = python("""
            import os, signal, threading, time
            from pounding._studies.execution import _interrupt_held
            thread = threading.Thread(target=time.sleep, args=(1,))
            thread.start()
            handler = signal.getsignal(signal.SIGINT)
            try:
                with _interrupt_held():
                    os.kill(os.getpid(), signal.SIGINT)
                    time.sleep(0.1)
                    print("started")
            except KeyboardInterrupt:
                print("interrupted")
            assert signal.getsignal(signal.SIGINT) is handler and not signal.pthread_sigmask(signal.SIG_BLOCK, [])
        """)
        self.assertEqual(said.split(), ["started", "interrupted"])


if __name__ == "__main__":
    unittest.main()
