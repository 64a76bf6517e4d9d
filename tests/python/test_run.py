"""Runs from Python: the numbers of the program, and effects on the process and its threads."""

import base64
import contextlib
import copy
import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

import pounding
import frame_samples
from test_models import TWO_OSCILLATORS, two_oscillators
from messages import assert_mentions, raises

FRAMES = TWO_OSCILLATORS.parents[1] / "07_plane_frames/model.yaml"
PROGRAM = os.environ["POUNDING_PROGRAM"]
#: No step is short enough for this contact stiffness.
UNSOLVABLE = pounding.Model(
    structures={"a": {"body": {"mass": "100 t"}, "initial_velocity": "1 m/s"}, "b": {"body": {"mass": "150 t"}}},
    links=[{"between": ["a", "b"], "gap": "10 mm", "law": "hertz", "stiffness": 1e300}],
    analysis={"duration": 0.2},
)


def long_model(duration=500.0):
    """Runs longer than any test waits by default."""
    model = two_oscillators()
    model.ground_motion["harmonic"]["duration"] = duration
    model.analysis = {
        "duration": duration,
        "tolerance": "1e-7",
        "output_step": "10 ms",
        "integrator": "generalized_alpha",
    }
    return model


def without_times(summary):
    summary["solver"].pop("wall_seconds")
    return summary


class RunTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def program(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=60)

    def assert_same_file(self, one, other):
        """Every dataset of two runs except wall-clock times, and the name and options of the call."""
        with h5py.File(one) as a, h5py.File(other) as b:
            places = []
            a.visititems(lambda name, item: places.append(name) if isinstance(item, h5py.Dataset) else None)
            compared = [place for place in places if not place.startswith("solver/wall") and place != "summary"]
            self.assertGreater(len(compared), 20)
            for place in compared:
                # Arrays of texts have the addresses of their texts as bytes.
                values = [
                    file[place][()]
                    if file[place].dtype == object or not file[place].shape
                    else file[place][()].tobytes()
                    for file in (a, b)
                ]
                self.assertEqual(*(list(v) if getattr(v, "shape", ()) else v for v in values), place)


class SameAsTheProgram(RunTest):
    def test_summary_and_file_are_those_of_the_command(self):
        done = self.program("run", TWO_OSCILLATORS, "--json", "-o", self.folder / "program.h5")
        results = pounding.run(TWO_OSCILLATORS, output=self.folder / "python.h5")
        printed = without_times(json.loads(done.stdout))
        self.assertEqual(printed["warnings"], [])
        self.assertEqual(without_times(results.summary), printed)
        self.assert_same_file(self.folder / "program.h5", self.folder / "python.h5")
        results.save(self.folder / "saved.h5")
        self.assert_same_file(self.folder / "program.h5", self.folder / "saved.h5")
        self.assertEqual(results.model_yaml, TWO_OSCILLATORS.read_text())

    def test_a_run_in_memory_is_its_file(self):
        results = pounding.run(two_oscillators(), output=self.folder / "out.h5")
        read = pounding.read(self.folder / "out.h5")
        np.testing.assert_array_equal(results.impacts, read.impacts)
        np.testing.assert_array_equal(results.structures["left"].displacement, read.structures["left"].displacement)
        self.assertEqual((results.status, len(results.impacts), repr(results)), ("done", 5, repr(read)))

    def test_a_run_is_in_memory_until_a_history_is_asked_for(self):
        with mock.patch("pounding.results.require_whole_image", side_effect=AssertionError("an image was read")):
            results = pounding.run(two_oscillators())
            self.assertEqual((results.summary["status"], results.summary["links"][0]["impacts"]), ("done", 5))
        summary = results.summary
        self.assertEqual(len(results.impacts), 5)
        self.assertIs(results.summary, summary)
        self.assertIsNone(results.no_pounding)
        with raises(AttributeError, "force"):
            results.force

    def test_a_run_in_memory_is_copied_whole(self):
        results = pounding.run(two_oscillators())
        for other in (
            copy.copy(results),
            pickle.loads(pickle.dumps(results)),
            copy.deepcopy(pounding.run(two_oscillators())),
        ):
            np.testing.assert_array_equal(other.time, results.time)
            self.assertEqual(
                without_times(dict(other.summary, solver=dict(other.summary["solver"]))),
                without_times(dict(results.summary, solver=dict(results.summary["solver"]))),
            )

    def test_arrays_may_be_made_while_another_run_shows_its_progress(self):
        results, seen = pounding.run(two_oscillators()), []
        pounding.run(long_model(5), progress=lambda *now: seen.append(results.time.size))
        self.assertEqual(set(seen), {results.time.size})

    def test_names_are_text(self):
        model = two_oscillators()
        model.structures = {"Büro 1": model.structures["left"], "right": model.structures["right"]}
        model.links[0]["between"] = ["Büro 1", "right"]
        model.structures["wall"] = {"wall": {}}
        model.links.append(
            {"between": ["right", "wall"], "gap": "10 mm", "law": "hertz", "stiffness": 1e9, "name": "ω"}
        )
        results = pounding.run(model, tolerance=1e-3, output=self.folder / "out.h5")
        for run in (results, pounding.read(self.folder / "out.h5")):
            self.assertEqual(set(run.impacts["link"].tolist()), {"Büro 1-right", "ω"})
            for name, link in run.links.items():
                self.assertEqual(np.count_nonzero(run.impacts["link"] == name), len(run.impacts_of(name)))
                self.assertEqual(
                    (type(name), type(link.left), type(link.law), type(link.left_end)), (str, str, str, str)
                )
            self.assertEqual(len(run.impacts_of("ω")) + len(run.impacts_of("Büro 1-right")), len(run.impacts))
            self.assertEqual({type(structure.kind) for structure in run.structures.values()}, {str})
            self.assertEqual(set(run.to_pandas()["impacts"]["link"]), {"Büro 1-right", "ω"})
            self.assertEqual(set(run.to_xarray()["impacts"]["link"].values.tolist()), {"Büro 1-right", "ω"})

    def test_names_of_no_impact_are_text_too(self):
        model = two_oscillators()
        model.links[0]["gap"] = "5 m"
        results = pounding.run(model, tolerance=1e-3)
        self.assertEqual((results.impacts["link"].dtype.kind, results.impacts["link"].size), ("U", 0))

    def test_contact_forces_are_those_of_the_law(self):
        for name in ("jankowski", "hertz_damped", "bilinear_hertz"):
            model = two_oscillators()
            model.links[0] = {**model.links[0], "law": name}
            results = pounding.run(model)
            link, impact = results.links["left-right"], results.impacts[2]
            law = pounding.laws[name](stiffness=2.75e9, restitution=0.65, reduced_mass=6e4)
            # Touch and separation have two samples each, one of them without force.
            inside = (link.time > impact["t_start"]) & (link.time < impact["t_release"])
            force = law.force(link.penetration[inside], link.velocity[inside], impact["v_approach"], in_order=True)
            self.assertGreater(force.size, 100)
            # The last iteration of a step moves the state by less than this; the largest penetration, stored by
            # bilinear_hertz, lies between two samples.
            rtol = 1e-6 if name == "bilinear_hertz" else 1e-8
            np.testing.assert_allclose(
                force, link.force[inside], rtol=rtol, atol=1e-9 * impact["peak_force"], err_msg=name
            )

    def test_tolerance_and_options_reach_the_run(self):
        rough = pounding.run(two_oscillators(), tolerance=1e-3)
        # A thousandfold tolerance: 5.6 times fewer steps by the order of the scheme, apart from impacts.
        self.assertLess(rough.solver["steps"], pounding.run(two_oscillators()).solver["steps"] / 3)
        assert_mentions(rough.model_yaml, ["tolerance", "0.001"])
        done = self.program(
            "run",
            TWO_OSCILLATORS,
            "--json",
            "-pounding_ts_rtol",
            "0.001",
            "-pounding_ts_pounding_scheme",
            "generalized_alpha",
        )
        by_option = pounding.run(TWO_OSCILLATORS, options={"ts_rtol": 1e-3, "ts_pounding_scheme": "generalized_alpha"})
        printed = without_times(json.loads(done.stdout))
        self.assertEqual(printed["warnings"], [], "the imbalance is within the tolerance of the option")
        self.assertEqual(without_times(by_option.summary), printed)
        # Options of one run do not affect the next.
        again = pounding.run(two_oscillators(), tolerance=1e-3)
        self.assertEqual(without_times(again.summary), without_times(rough.summary))

    def test_modes_are_those_of_the_command(self):
        modes = pounding.modes(TWO_OSCILLATORS)
        printed = json.loads(self.program("modes", TWO_OSCILLATORS, "--json").stdout)
        self.assertEqual(
            {name: [mode.period for mode in modes[name]] for name in modes},
            {name: [mode["period"] for mode in found] for name, found in printed.items()},
        )
        self.assertAlmostEqual(modes["left"][0].period, 0.8, delta=1e-12)
        self.assertEqual((modes["left"][0].participation.shape, modes["left"][0].shape.shape), ((1,), (1,)))
        self.assertEqual(len(modes.plot().axes), 4)

    def test_modes_of_frames_are_those_of_the_command_and_drawn_as_frames(self):
        modes = pounding.modes(FRAMES, count=3)
        printed = json.loads(self.program("modes", FRAMES, "--json", "--count", 3).stdout)
        self.assertEqual(list(modes), list(printed))
        for name, found in printed.items():
            self.assertEqual(len(modes[name]), 3)
            for mode, told in zip(modes[name], found):
                self.assertIsInstance(mode, pounding.Mode)
                self.assertEqual((mode.period, mode.damping_ratio), (told["period"], told["damping_ratio"]))
                for quantity in ("participation", "effective_mass", "shape"):
                    np.testing.assert_array_equal(getattr(mode, quantity), told[quantity])
                self.assertEqual(mode.participation.shape, (3,))
        # Members at rest and displaced, no profile.
        self.assertEqual([len(axes.collections) for axes in modes.plot().axes], [2] * 3 * len(modes))


class Failures(RunTest):
    def test_wrong_models_and_options_are_told_as_by_the_program(self):
        with self.assertRaises(pounding.InputError) as caught:
            pounding.run(TWO_OSCILLATORS, options={"ts_rtoll": 1})
        done = self.program("run", TWO_OSCILLATORS, "-pounding_ts_rtoll", "1")
        self.assertEqual(f"pounding: {caught.exception}\n", done.stderr)
        with raises(pounding.InputError):
            pounding.run(two_oscillators(), output=self.folder / "no folder" / "out.h5")

    def test_failed_solve_keeps_what_was_computed(self):
        (self.folder / "model.yaml").write_text(UNSOLVABLE.to_yaml())
        done = self.program("run", "model.yaml", "-q")
        with self.assertRaises(pounding.SolverError) as caught:
            pounding.run(UNSOLVABLE, output=self.folder / "out.h5")
        self.assertEqual((done.returncode, done.stderr), (3, f"pounding: {str(caught.exception).splitlines()[0]}\n"))
        assert_mentions(str(caught.exception), f"{self.folder / 'out.h5'}")
        results = caught.exception.results
        self.assertTrue(results.status.startswith("failed: "))
        self.assertGreater(results.time.size, 1)
        self.assertEqual(pounding.read(self.folder / "out.h5").status, results.status)

    def test_energies_that_do_not_close_warn_as_in_the_program(self):
        # Steps of constant length ignore the tolerance.
        options = {"ts_adapt_type": "none", "ts_dt": 1e-3, "ts_pounding_scheme": "generalized_alpha"}
        words = [word for name, value in options.items() for word in (f"-pounding_{name}", str(value))]
        done = self.program("run", TWO_OSCILLATORS, "-q", *words)
        with self.assertWarnsRegex(pounding.AccuracyWarning, "energ") as caught:
            pounding.run(TWO_OSCILLATORS, options=options)
        self.assertEqual(f"pounding: warning: {caught.warning}\n", done.stderr)
        self.assertEqual([each.category for each in caught.warnings], [pounding.AccuracyWarning])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            pounding.run(two_oscillators())

    def test_what_is_implausible_warns_as_in_the_program(self):
        model = two_oscillators()
        model.structures["left"]["oscillator"]["mass"] = 100
        model.links[0]["stiffness"] = "1e4 N/m^1.5"
        (self.folder / "model.yaml").write_text(model.to_yaml())
        done = self.program("run", "model.yaml", "--json")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            pounding.run(model)
        texts = [str(each.message) for each in caught if each.category is pounding.ImplausibleWarning]
        self.assertEqual([text.rpartition("accept: ")[2] for text in texts], ["[mass])", "[penetration])"])
        self.assertEqual(json.loads(done.stdout)["warnings"], texts)
        self.assertEqual(done.stderr, "".join(f"pounding: warning: {text}\n" for text in texts))
        model.accept = ["mass", "penetration"]
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            pounding.run(model)
            self.assertEqual(pounding.check(model).warnings, ())
        model.accept = []
        with self.assertWarnsRegex(pounding.ImplausibleWarning, "100 kg"):
            self.assertEqual(pounding.check(model).warnings, tuple(texts[:1]))


class Stopping(RunTest):
    def interrupted(self, model, **more):
        timer = threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        try:
            with self.assertRaises(pounding.Interrupted) as caught:
                pounding.run(model, **more)
        finally:
            timer.join()
        self.assertLess(time.monotonic() - begin, 5)
        self.assertIsInstance(caught.exception, KeyboardInterrupt)
        return caught.exception

    def test_ctrl_c_keeps_what_was_computed_and_the_run_goes_on_to_the_same_bits(self):
        place = self.folder / "out.h5"
        model = long_model(30.0)
        stop = self.interrupted(model, output=place)
        assert_mentions(str(stop), f"{place}")
        self.assertTrue(stop.results.status.startswith("failed: "))
        self.assertGreater(stop.results.time.size, 1)
        self.assertEqual(pounding.read(place).time.size, stop.results.time.size)
        went_on = pounding.resume(place)
        whole = pounding.run(model, output=self.folder / "whole.h5")
        self.assertEqual(went_on.status, "done")
        np.testing.assert_array_equal(went_on.structures["left"].displacement, whole.structures["left"].displacement)
        np.testing.assert_array_equal(went_on.impacts, whole.impacts)

    def test_without_a_file_the_results_are_in_the_exception(self):
        stop = self.interrupted(long_model())
        self.assertGreater(stop.results.impacts.size, 1)
        self.assertEqual(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_what_a_handler_of_the_host_raises_ends_the_run(self):
        class Enough(Exception):
            pass

        def handler(*_):
            raise Enough

        before = signal.signal(signal.SIGALRM, handler)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with self.assertRaises(Enough):
            pounding.run(long_model())

    def test_progress_is_told_and_may_end_the_run(self):
        told = []

        def progress(now, duration, impacts):
            told.append((now, duration, impacts))
            if len(told) == 3:
                raise RuntimeError("enough")

        with raises(RuntimeError):
            pounding.run(long_model(), progress=progress, output=self.folder / "out.h5")
        self.assertEqual(len(told), 3)
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[0][1], 500.0)
        self.assertIn("stopped", pounding.read(self.folder / "out.h5").status)

    def test_what_would_wait_for_the_run_is_refused_inside_progress(self):
        for ask in (pounding.check, pounding.modes, pounding.run):
            with self.subTest(ask.__name__), raises(RuntimeError):
                pounding.run(long_model(), progress=lambda *_: ask(TWO_OSCILLATORS))
        self.assertEqual(pounding.run(TWO_OSCILLATORS, progress=False).status, "done")

    def test_ctrl_c_ends_the_wait_for_the_run_of_another_thread(self):
        stops = threading.Event()

        def progress(*_):
            if stops.is_set():
                raise RuntimeError("enough")

        def run():
            with contextlib.suppress(RuntimeError):
                pounding.run(long_model(), progress=progress, options={"ts_pounding_base": "modal"})

        other = threading.Thread(target=run)
        other.start()
        time.sleep(0.5)
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                pounding.check(TWO_OSCILLATORS)
            self.assertTrue(other.is_alive())
        finally:
            stops.set()
            timer.join()
            other.join()

    def test_an_empty_name_of_the_output_is_refused(self):
        with raises(pounding.InputError):
            pounding.run(TWO_OSCILLATORS, output="")

    def test_what_ended_a_run_can_be_sent_to_another_process(self):
        results = pounding.run(two_oscillators())
        for kind in (pounding.Interrupted, pounding.SolverError):
            for copied in (pickle.loads(pickle.dumps(kind("enough", results))), copy.copy(kind("enough", results))):
                self.assertIsInstance(copied, kind)
                self.assertEqual(str(copied), "enough")
                np.testing.assert_array_equal(copied.results.impacts, results.impacts)
        checked = pounding.check(TWO_OSCILLATORS)
        self.assertEqual(pickle.loads(pickle.dumps(checked)), checked)
        found = pounding.modes(TWO_OSCILLATORS)
        self.assertEqual(pickle.loads(pickle.dumps(found))["left"][0].period, found["left"][0].period)

    def test_progress_is_one_line_that_goes_away(self):
        with mock.patch("sys.stderr") as screen:
            screen.isatty.return_value = True
            with self.assertRaises(pounding.Interrupted):
                threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
                pounding.run(long_model())
            written = [call.args[0] for call in screen.write.call_args_list]
        self.assertRegex(written[0], r"^\r\[#*\.+\] \d+\.\d\d of 500.00 s, \d")
        self.assertRegex(written[-1], r"^\r +\r$")
        with mock.patch("sys.stderr") as screen:
            screen.isatty.return_value = False
            pounding.run(two_oscillators())
            screen.write.assert_not_called()

    def test_progress_in_a_notebook_is_a_bar_that_goes_away(self):
        shell = type("ZMQInteractiveShell", (), {})()
        ipython = mock.Mock(get_ipython=lambda: shell)
        with mock.patch.dict("sys.modules", {"IPython": ipython, "IPython.display": ipython.display}):
            self.interrupted(long_model())
        [shown] = ipython.display.display.call_args_list
        assert_mentions(shown.args[0]["text/html"], ["max=", "500", "500.00 s"])
        updates = [call.args[0] for call in ipython.display.display.return_value.update.call_args_list]
        assert_mentions(updates[0]["text/plain"], "500.00 s")
        self.assertEqual(updates[-1], {"text/plain": "", "text/html": ""})

    def test_a_session_is_told_where_the_results_are(self):
        self.assertNotIn("sys.last_value", str(self.interrupted(long_model())))
        with mock.patch.object(sys, "ps1", ">>> ", create=True):
            assert_mentions(str(self.interrupted(long_model())), "sys.last_value.results")


class Threads(RunTest):
    def test_others_run_meanwhile(self):
        ticks, over = [], threading.Event()

        def tick():
            while not over.wait(1e-3):
                ticks.append(time.monotonic())

        ticker = threading.Thread(target=tick)
        ticker.start()
        try:
            begin = time.monotonic()
            pounding.run(long_model(10.0), progress=False)
            taken = time.monotonic() - begin
        finally:
            over.set()
            ticker.join()
        inside = [t for t in ticks if begin < t < begin + taken]
        self.assertGreater(taken, 0.05)
        self.assertLess(np.diff([begin, *inside, begin + taken]).max(), 0.5 * taken)

    def test_runs_of_several_threads_do_not_meet(self):
        alone = without_times(pounding.run(two_oscillators(), tolerance=1e-4).summary)
        rough = without_times(pounding.run(two_oscillators(), tolerance=1e-3).summary)
        found = {}

        def work(i):
            found[i] = without_times(pounding.run(two_oscillators(), tolerance=1e-4 if i % 2 else 1e-3).summary)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, {i: alone if i % 2 else rough for i in range(6)})

    def test_runs_of_several_threads_proceed_in_parallel(self):
        alone = pounding.run(two_oscillators(), progress=False)
        with ThreadPoolExecutor(8) as pool:

            def run_others(*_):
                if not others:
                    # They end while this run is between two steps.
                    runs = [pool.submit(pounding.run, two_oscillators(), progress=False) for _ in range(7)]
                    others.extend(run.result(timeout=60) for run in runs)

            others = []
            self.assertEqual(pounding.run(long_model(20.0), progress=run_others).status, "done")
        self.assertEqual(len(others), 7)
        summary = without_times(alone.summary)
        for other in others:
            self.assertEqual(without_times(other.summary), summary)
            np.testing.assert_array_equal(other.links["left-right"].force, alone.links["left-right"].force)

    def test_options_apply_to_one_run_only(self):
        options = {"ts_rtol": 1e-3}
        alone = without_times(pounding.run(two_oscillators()).summary)
        rough = without_times(pounding.run(two_oscillators(), options=options).summary)
        self.assertNotEqual(alone["links"], rough["links"])
        with ThreadPoolExecutor(8) as pool:
            runs = [pool.submit(pounding.run, two_oscillators(), options=options if i % 2 else {}) for i in range(8)]
            found = [without_times(run.result(timeout=60).summary) for run in runs]
        self.assertEqual(found, [rough if i % 2 else alone for i in range(8)])


class Pictures(RunTest):
    @classmethod
    def setUpClass(cls):
        cls.results = pounding.run(two_oscillators(), tolerance=1e-4)

    def test_pictures_are_figures_of_the_numbers(self):
        figure = self.results.plot("force")
        line = figure.axes[0].lines[0]
        np.testing.assert_allclose(1e6 * line.get_ydata(), self.results.links["left-right"].force, rtol=1e-12)
        self.assertEqual(len(self.results.plot("loops").axes[0].lines), 5)
        for picture in ("run", "displacement", "gap", "energy", "model", "profiles"):
            self.results.plot(picture, title="A title").savefig(self.folder / f"{picture}.png")
            self.assertGreater((self.folder / f"{picture}.png").stat().st_size, 5000)
        with raises(pounding.InputError, "forse"):
            self.results.plot("forse")

    def test_a_picture_fits_a_column_of_a_paper(self):
        figure = self.results.plot("gap", title="", size=(3.3, 2.3))
        np.testing.assert_array_equal(figure.get_size_inches(), (3.3, 2.3))
        axes = figure.axes[0]
        self.assertEqual((axes.get_title(loc="left"), figure.get_suptitle()), ("", ""))
        self.assertEqual(axes.get_xlim(), (0.0, 3.0))
        # The legend leaves the width to the axes.
        self.assertIsNone(axes.get_legend())
        self.assertEqual([text.get_text() for text in figure.legends[0].get_texts()], ["left-right", "touch (5)"])
        figure.savefig(self.folder / "gap.pdf")
        self.assertGreater(axes.get_position().width, 0.75)
        # TrueType instead of Type 3 outlines, which journals refuse.
        written = (self.folder / "gap.pdf").read_bytes()
        self.assertIn(b"CIDFontType2", written)
        self.assertNotIn(b"/Type3", written)
        for picture in ("run", "model", "profiles"):
            np.testing.assert_array_equal(self.results.plot(picture, size=(5.0, 4.0)).get_size_inches(), (5.0, 4.0))

    def test_notebooks_show_tables(self):
        page = self.results._repr_html_()
        self.assertIn("<b>Two oscillators", page)
        [link] = self.results.summary["links"]
        assert_mentions(
            page,
            [
                "5",
                f"{link['peak_force'] / 1000.0:.4g}",
                f"{1000.0 * np.abs(self.results.structures['left'].displacement).max():.4g}",
                f"{self.results.energy['input'][-1] / 1000.0:.4g}",
            ],
        )
        model = two_oscillators()
        model.title = "<b> & co"
        self.assertIn("&lt;b&gt; &amp; co", model._repr_html_())
        assert_mentions(pounding.modes(model)._repr_html_(), ["5 %", "0.8", "0.4"])

    def test_notebooks_show_rigid_impacts_and_walls(self):
        model = two_oscillators()
        model.structures["right"] = {"wall": {}}
        model.links[0] = {"between": ["left", "right"], "gap": "20 mm", "law": "stereomechanical", "restitution": 0.6}
        self.assertRegex(pounding.run(model)._repr_html_(), r"<td>left-right</td><td>\d+</td><td>-</td>")
        self.assertNotIn("right", pounding.modes(model)._repr_html_())

    def test_notebooks_play_films(self):
        page = self.results.animate(frames=3, start=1.0, end=1.5)._repr_html_()
        data = page.partition("base64,")[2].partition('"')[0]
        self.assertTrue(base64.b64decode(data).startswith(b"GIF8"))

    def test_animation_is_a_film(self):
        film = self.results.animate(self.folder / "film.gif", frames=5, start=1.0, end=1.5)
        self.assertEqual(film.frames, 5)
        self.assertTrue((self.folder / "film.gif").read_bytes().startswith(b"GIF8"))

    def test_missing_packages_say_what_to_type(self):
        with mock.patch.dict("sys.modules", {"matplotlib": None, "pandas": None}):
            with raises(ImportError, "pip install matplotlib"):
                self.results.plot()
            with raises(ImportError, "pip install pandas"):
                self.results.to_pandas()


class Tables(RunTest):
    @classmethod
    def setUpClass(cls):
        model = two_oscillators()
        model.structures["left"] = {
            "shear_building": {"storeys": 2, "mass": "50 t", "stiffness": "20 MN/m", "height": 3.0},
            "damping": "5 %",
        }
        model.links[0]["between"] = ["left.2", "right"]
        cls.results = pounding.run(model, tolerance=1e-4)

    def test_pandas(self):
        tables = self.results.to_pandas()
        self.assertEqual(
            set(tables),
            {
                "impacts",
                "ground",
                "energy",
                f"links/{next(iter(self.results.links))}",
                "structures/left",
                "structures/right",
                "envelopes/left",
                "envelopes/right",
            },
        )
        left = tables["structures/left"]
        np.testing.assert_array_equal(
            left["displacement", "2", "x"].to_numpy(), self.results.structures["left"].displacement[:, 1]
        )
        np.testing.assert_array_equal(left["drift", "2"].to_numpy(), self.results.structures["left"].drift[:, 1])
        self.assertEqual(left.attrs["velocity"]["units"], "m/s")
        np.testing.assert_array_equal(left.index, self.results.time)
        self.assertEqual(tables["impacts"]["link"][0], "left.2-right")
        np.testing.assert_array_equal(tables["impacts"]["restitution"], self.results.impacts["restitution"])

    def test_xarray(self):
        sets = self.results.to_xarray()
        drift = sets["structures/left"]["drift"]
        self.assertEqual((drift.dims, drift.attrs["units"]), (("time", "floor"), "m"))
        np.testing.assert_array_equal(drift.sel(floor="2"), self.results.structures["left"].drift[:, 1])
        self.assertEqual(float(sets["energy"]["input"][-1]), self.results.energy["input"][-1])
        self.assertEqual(str(sets["impacts"]["link"].values[0]), "left.2-right")

    def test_nodes_and_members_are_there_where_the_input_asked_for_them(self):
        model = pounding.Model.from_file(FRAMES)
        model.analysis = {**model.analysis, "duration": "1 s"}
        run = pounding.run(model)
        tables, sets = run.to_pandas(), run.to_xarray()
        for name, structure in run.structures.items():
            for part in ("nodes", "members", "reactions"):
                self.assertEqual(f"structures/{name}/{part}" in tables, getattr(structure, part) is not None)
                self.assertEqual(f"structures/{name}/{part}" in sets, getattr(structure, part) is not None)
        name, structure = next((name, one) for name, one in run.structures.items() if one.nodes and one.members)
        node, member = structure.nodes.names[-1], structure.members.names[-1]
        direction, component = structure.nodes.directions[1], structure.members.components[2]
        moved, forces = structure.nodes.velocity[:, -1, 1], structure.members.end_forces[:, -1, 2]
        np.testing.assert_array_equal(tables[f"structures/{name}/nodes"]["velocity", node, direction], moved)
        members = tables[f"structures/{name}/members"]
        np.testing.assert_array_equal(members["end_forces", member, component], forces)
        self.assertEqual(members.attrs["end_forces"]["units"], "N")
        np.testing.assert_array_equal(
            sets[f"structures/{name}/nodes"]["velocity"].sel(node=node, node_direction=direction), moved
        )
        found = sets[f"structures/{name}/members"]["end_forces"]
        np.testing.assert_array_equal(found.sel(member=member, component=component), forces)
        self.assertEqual(found.dims, ("time", "member", "component"))

    def test_files_without_dimensions_have_no_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "run.h5"
            frame_samples.write(path, 3)
            with raises(pounding.InputError, ["earlier", "run the model again"]):
                pounding.read(path).to_pandas()

    def test_bodies_without_storeys_have_tables_too(self):
        model = UNSOLVABLE.copy()
        model.links[0]["stiffness"] = 1e9
        model.structures["wall"] = {"wall": {}}
        results = pounding.run(model)
        self.assertEqual(results.to_pandas()["structures/wall"].shape[1], 0)
        self.assertTrue(np.isnan(results.to_xarray()["structures/a"]["drift"]).all())


if __name__ == "__main__":
    unittest.main()
