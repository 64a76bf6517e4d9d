"""The plan of a study: every row, fixed by file, records and seed before anything runs."""

from __future__ import annotations

import hashlib
import json
import math
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from pounding import yaml_text
from pounding._native import core
from pounding.errors import InputError
from pounding.models import PARTS, Model, as_model
from pounding.studies import words
from pounding.studies.cut_records import cut_records, with_cuts
from pounding.studies.engines import WORDS as ENGINES_OF_STUDIES
from pounding.studies.factors import Factor, read_factors
from pounding.studies.motions import Intensity, Motion, doubts, implausible, measured, read_intensity
from pounding.studies.quantities import COLLAPSED_COLUMN, UNITS, read_keep, read_limits
from pounding.studies.sampling import Points, read_points
from pounding.studies.sources import read_motions
from pounding.studies.template import Template


#: Rows of a study, at most.
MOST_ROWS = 1_000_000_000


@dataclass(frozen=True)
class Plan:
    """All rows of a study. Row i depends on the file, the records and the seed alone: on no number of workers, no chunk, no time.

    Rows follow each other by record, point of the factors, and level, the last one fastest: one chunk shares a record."""

    template: Template
    points: Points
    intensity: Intensity | None
    seed: int
    stop_after: float  #: share of failed rows after which the study stops
    text: str  #: the study as given
    warnings: tuple[str, ...] = field(default=(), compare=False)

    @property
    def levels(self) -> tuple[float, ...]:
        """Intensities to which every motion is scaled [m/s^2]; none for motions as they are."""
        return self.intensity.levels if self.intensity else ()

    @property
    def shape(self) -> tuple[int, int, int]:
        """Records, points, levels."""
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
            raise InputError(f"row {row} is none of the {self.count} rows, which count from 0")
        one = self.columns(np.array([row]))
        values = [float(one[factor.name][0]) for factor in self.points.factors]
        return self.template.case(values, int(one["record"][0]), float(one["scale"][0]))

    def yaml(self, row: int) -> str:
        """The input file of one row."""
        return yaml_text.emit(self.case(row))

    def description(self) -> dict[str, Any]:
        """Everything that the rows follow from, for the table and for comparing plans."""
        sample = np.ascontiguousarray(self.points.sample)
        return {"model": self.template.model, "factors": [asdict(factor) for factor in self.points.factors],
                "sampling": {"way": self.points.way, "count": len(sample), "digest": hashlib.sha256(sample.tobytes()).hexdigest()},
                "records": [{key: value for key, value in asdict(motion).items() if key != "warnings"} for motion in self.template.motions],
                "intensity": asdict(self.intensity) if self.intensity else None,
                "kept": asdict(self.template.kept), "seed": self.seed, "engine": self.template.engine,
                "version": core.version, "kernel": core.kernel_version}

    def digest(self) -> str:
        """A checksum of the description."""
        return hashlib.sha256(json.dumps(self.description(), sort_keys=True).encode()).hexdigest()


def read_plan(study: str | PathLike[str], store: Path | None = None) -> Plan:
    """The plan of a study file. Raises InputError."""
    name = str(study)
    text = core.read_file(name)
    parts = core.parse(core.Source(text, name))
    if not isinstance(parts, dict) or "study" not in parts:
        raise InputError(f"{name}: has no study:, so it is one model; type pounding run {name}, or add study: {{factors: "
                         f"{words.STUDY_WORDS['factors']}}}")
    folder = Path(name).parent
    rest = {key: value for key, value in parts.items() if key not in ("study", "model")}
    if "model" in parts:
        unknown = [key for key in rest if key != "title"]
        if unknown:
            raise InputError(f"{name}: beside model: there is {', '.join(unknown)}; put these into {parts['model']}, or all of the model here")
        model = Model.from_file(folder / str(parts["model"]))
    elif not rest:
        raise InputError(f"{name}: has study: and no model; type model: FILE.yaml beside it, or structures:, links: and ground_motion: of the model")
    else:
        model = Model._from_text(yaml_text.emit(rest), name)
    try:
        return make_plan(model, parts["study"] or {}, folder, text, store)
    except InputError as error:
        raise InputError(str(error) if str(error).startswith(name) else f"{name}: {error}") from None


def make_plan(model: Model | str | PathLike[str], given: Any, folder: Path, text: str = "", store: Path | None = None) -> Plan:
    """The plan of a model and of the words of `study:`. Raises InputError."""
    one = words.only(yaml_text.plain(given), words.STUDY_WORDS, "study")
    model = as_model(model)
    # A model that leaves its motion and its duration to the records is whole with one of them.
    lacks_motion = "records" in one and model.ground_motion is None and "duration" not in (model.analysis or {})
    of_model: list[str] = []
    if not lacks_motion:
        of_model = core.check(model._source())[2]
    parts = _absolute(model)
    seed = words.whole(one.get("seed", 1), "study.seed", 0)
    motions = read_motions(one.get("records"), parts, folder, seed, store)
    if lacks_motion:
        model = Model._from_text(yaml_text.emit({**parts, "ground_motion": motions[0].scaled(1.0)}), model._file or "model")
        of_model = core.check(model._source())[2]
    factors = read_factors(one.get("factors"), parts)
    if "records" in one:
        for factor in factors:
            if any(path.split(".")[0] in ("ground_motion", "*") for path in factor.of):
                raise InputError(f"study.factors.{factor.name}.of: the records replace the ground motion of the model; vary intensity instead")
    _require_free_names(factors)
    points = read_points(factors, one.get("sampling"), seed, parts, folder)
    factors = list(points.factors)
    intensity = read_intensity(one.get("intensity"), _first_periods(model) if "intensity" in one else ())
    motions = measured(motions, intensity)
    _require_scales(motions, intensity)
    moved = {**parts, **({"ground_motion": motions[0].scaled(1.0)} if motions[0].words else {})}
    layout = core.layout(core.Source(yaml_text.emit(moved), model._file or "model"))
    kept = read_keep(one.get("keep"), words.yes(one.get("without_links", False), "study.without_links"), layout, read_limits(one.get("limits")))
    engine = str(one.get("engine", "auto"))
    if engine not in ENGINES_OF_STUDIES:
        raise InputError(f'study.engine: takes {", ".join(ENGINES_OF_STUDIES)}; "{engine}" was read.{words.meant(engine, ENGINES_OF_STUDIES)}')
    parts.pop("compare", None)
    if kept.needs_comparison:
        parts["compare"] = "no_pounding"
    stop, _ = words.quantity(one.get("stop_after", 0.05), "study.stop_after")
    plan = Plan(Template(parts, model._file or "model", tuple(factors), tuple(motions), kept, engine), points, intensity, seed, stop,
                text or yaml_text.emit({"study": one}), (*implausible(motions, parts.get("accept") or ()), *doubts(motions, intensity)))
    if plan.count > MOST_ROWS:
        raise InputError(f"study: has {plan.count} rows, and {MOST_ROWS} are the most; take fewer values, samples, levels or records")
    # A wrong unit or bound in the first row is told here, not by a thousand rows.
    first = plan.yaml(0)
    of_first = core.check(core.Source(first, _place(plan.template)))[2]
    return replace(plan, warnings=(*with_cuts(of_model, of_first, cut_records(plan.template, plan.points, layout.last_arrival)), *plan.warnings))


def _require_free_names(factors: list[Factor]) -> None:
    """A factor is a column of the table and needs a name of its own there."""
    taken = (*UNITS, COLLAPSED_COLUMN, "point", "record", "scale", "im", "status", "engine")
    for factor in factors:
        if factor.name in taken:
            raise InputError(f"study.factors.{factor.name}: the table has a column of this name already; call the factor, for example, {factor.name}_factor")


def _require_scales(motions: Sequence[Motion], intensity: Intensity | None) -> None:
    """Raises InputError where no factor brings a motion to a level."""
    levels = intensity.levels if intensity else ()
    for motion in motions if levels else ():
        if not motion.intensity > 0 or not math.isfinite(max(levels) / motion.intensity) or min(levels) / motion.intensity == 0:
            raise InputError(f"study.intensity: {motion.name} has the intensity {motion.intensity:g} m/s^2, which no factor brings to "
                             f"{min(levels):g} to {max(levels):g} m/s^2; type other levels, another measure or period, or leave the motion out")


def _place(template: Template) -> str:
    return str(Path(template.place).with_name("row")) if template.place != "model" else "row"


def _absolute(model: Model) -> dict[str, Any]:
    """The parts of the model, whose files are named from the root: workers may stand elsewhere."""
    folder = Path(model._file).parent if model._file else Path()

    def named(part: Any) -> Any:
        if isinstance(part, dict):
            return {key: str((folder / value).resolve()) if key in ("record", "file") and isinstance(value, str) and os.path.isfile(folder / value)
                    else named(value) for key, value in part.items()}
        return [named(one) for one in part] if isinstance(part, list) else part

    return {key: value for key, value in named(model._parts()).items() if key in PARTS}


def _first_periods(model: Model) -> list[float]:
    found = core.modes(model._source(), 1)
    return [structure.modes[0].period for structure in found if structure.modes]
