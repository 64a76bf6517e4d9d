"""Time integration of models."""

from __future__ import annotations

import contextlib
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from numbers import Real
from os import PathLike, fspath
from typing import Any

from pounding import _arguments as arguments
from pounding._arguments import optional
from pounding._native import core
from pounding._runs import Run
from pounding.errors import AccuracyWarning, ImplausibleWarning, InputError, Interrupted, SolverError, excerpt
from pounding.models import Model, as_model

#: Called at intervals with the simulated time [s], the duration [s] and the number of impacts.
Progress = Callable[[float, float, int], None]
File = str | PathLike[str]


def run(
    model: Model | File,
    *,
    tolerance: float | None = None,
    output: File | None = None,
    options: Mapping[str, Any] | None = None,
    progress: Progress | bool | None = None,
) -> Run:
    """Time integration of a model or an input file.

    Histories become arrays on first access. The GIL is released, and models of several threads run in parallel; a run
    with `options` waits for the others. Under mpirun, all processes call this function with the same arguments, and an
    error of one is raised in all.

    Parameters
    ----------
    model : Model, str or os.PathLike
        A model, or the name of its file.
    tolerance : float, optional
        Relative tolerance instead of that of the model.
    output : str or os.PathLike, optional
        Results file, which is updated during the run; by default no file is written.
    options : mapping, optional
        Options of PETSc without the prefix -pounding_: {"ts_max_steps": 100}; True is an option without a value.
    progress : callable or bool, optional
        Function of time [s], duration [s] and number of impacts; False hides the progress in terminals and notebooks.

    Returns
    -------
    Run
        The results.

    Raises
    ------
    InputError
        The model is wrong.
    SolverError
        The run failed; the error has the partial results, which are also in `output`.
    Interrupted
        Ctrl-C; as SolverError.

    Warns
    -----
    AccuracyWarning
        Energies do not close.
    ImplausibleWarning
        A value is implausible.

    Examples
    --------
    >>> results = pounding.run(model)
    >>> results.status
    'done'
    """
    with _refused_by_all():
        model = as_model(model)
        tolerance = optional(arguments.number(0, open=True))("tolerance", tolerance)
        if tolerance is not None:
            model = model.copy()
            arguments.mapping("model.analysis", model.analysis or {})
            model.analysis = {**(model.analysis or {}), "tolerance": tolerance}
        words = _words(options)
        source = model._source()
        call = " ".join(["pounding.run", source.name, *words])
        place = _place(output)
    with _Shown(progress) as shown:
        ran = core.run(source, place, words, call, shown.report)
    return _results(ran, place)


def resume(
    results: File,
    *,
    output: File | None = None,
    options: Mapping[str, Any] | None = None,
    progress: Progress | bool | None = None,
) -> Run:
    """Resumes a killed, interrupted or shortened run, bitwise identical to an uninterrupted run.

    Parameters
    ----------
    results : str or os.PathLike
        Results file of the run.
    output : str or os.PathLike, optional
        Another file to write.
    options : mapping, optional
        Options in addition to the original ones, as for `run`.
    progress : callable or bool, optional
        As for `run`.

    Returns
    -------
    Run
        The results.

    Raises
    ------
    InputError, SolverError, Interrupted
        As for `run`.

    Examples
    --------
    >>> pounding.resume("out.h5").status  # doctest: +SKIP
    'done'
    """
    with _refused_by_all():
        place, words, other = fspath(arguments.file("results", results)), _words(options), _place(output)
    with _Shown(progress) as shown:
        ran = core.resume(place, other, words, " ".join(["pounding.resume", place, *words]), shown.report)
    return _results(ran, other or place)


def _place(output: File | None) -> str:
    """Name of a results file; empty for None. Raises InputError for an empty name."""
    if output is None:
        return ""
    if not fspath(arguments.file("output", output)):
        raise InputError("the name of the output is empty: name a file, or write output=None")
    return fspath(output)


@contextlib.contextmanager
def _refused_by_all() -> Iterator[None]:
    """Raises an error of this process in all of them; under mpirun the others would otherwise wait for it."""
    try:
        yield
    except InputError as error:
        core.refuse(str(error))
        raise
    except Exception as error:
        with contextlib.suppress(InputError):
            core.refuse(f"{type(error).__name__}: {error}")
        raise


def _words(options: Mapping[str, Any] | None) -> list[str]:
    words = []
    for name, value in arguments.mapping("options", {} if options is None else options).items():
        if not re.fullmatch("[A-Za-z][A-Za-z0-9_-]*", name):
            raise InputError(f'options: the name of an option is one such as "ts_max_steps"; {excerpt(name)} was given')
        words.append(f"-pounding_{name}")
        if value is not True:
            if not isinstance(value, (str, PathLike, Real)) or str(value) in ("", "nan"):
                raise arguments.refuse(
                    f"options[{name!r}]", "a number, a text, or True for an option without a value", value
                )
            words.append(arguments.text(f"options[{name!r}]", str(value)))
    return words


def _results(ran: core.RunOutcome, output: str) -> Run:
    """The results. Raises the error that ended the run, with its partial results."""
    results = Run._of_outcome(ran)
    raised, text = ran.raised, ran.failure
    if raised is not None and not isinstance(raised, KeyboardInterrupt):
        raise raised
    if text and output:
        text += f'\nTo resume: pounding.resume("{output}")' if ran.resumable else f"\nPartial results are in {output}"
    # In an interactive session this is the only access to the results.
    elif text and hasattr(sys, "ps1"):
        text += "\nPartial results are sys.last_value.results"
    if raised is not None:
        raise Interrupted(text or "stopped by the user", results) from None
    if text:
        raise SolverError(text, results)
    for doubt in ran.implausible:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=3)
    if ran.warning:
        warnings.warn(ran.warning, AccuracyWarning, stacklevel=3)
    return results


class _Shown:
    """Progress on one line of a terminal, or a bar in a notebook; removed at the end."""

    def __init__(self, progress: Progress | bool | None) -> None:
        if not (progress is None or isinstance(progress, bool) or callable(progress)):
            raise arguments.refuse(
                "progress", "True, False, None or a function of time, duration and impacts", progress
            )
        notebook = _is_notebook()
        shows = notebook or sys.stderr.isatty() if progress is None else progress
        shown = self._show_bar if notebook else self._write
        self.report: Progress | None = progress if callable(progress) else shown if shows else None
        self._width = 0
        self._bar: Any = None

    def __enter__(self) -> _Shown:
        return self

    def __exit__(self, *failure: object) -> None:
        if self._width:
            self._show(" " * self._width + "\r")
        if self._bar is not None:
            self._bar.update({"text/plain": "", "text/html": ""}, raw=True)

    def _write(self, time: float, duration: float, impacts: int) -> None:
        filled = int(30 * time / duration)
        line = f"[{'#' * filled}{'.' * (30 - filled)}] {_words_of(time, duration, impacts)}"
        self._width = max(self._width, len(line))
        self._show(line)

    def _show_bar(self, time: float, duration: float, impacts: int) -> None:
        from IPython.display import display

        words = _words_of(time, duration, impacts)
        seen = {"text/plain": words, "text/html": f'<progress value="{time}" max="{duration}"></progress> {words}'}
        if self._bar is None:
            self._bar = display(seen, raw=True, display_id=True)
        else:
            self._bar.update(seen, raw=True)

    @staticmethod
    def _show(text: str) -> None:
        sys.stderr.write("\r" + text)
        sys.stderr.flush()


def _words_of(time: float, duration: float, impacts: int) -> str:
    return f"{time:.2f} of {duration:.2f} s, {impacts} impacts"


def _is_notebook() -> bool:
    """True in a notebook cell, which displays objects but is not a terminal."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return type(shell).__name__ == "ZMQInteractiveShell"
