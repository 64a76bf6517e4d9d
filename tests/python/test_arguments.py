"""Invalid values for every argument of the public functions: each raises InputError, or another ValueError, with a
message of a few lines."""

import math
import os
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import pounding
from pounding import plan
from pounding.errors import LONGEST_MESSAGE
from pounding._spectra import spectra_figure
from pounding._studies.separation import separation
from messages import raises

MODEL = """\
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 0.6}}
structures:
  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
links: [{between: [left, right], gap: 2 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]
analysis: {duration: 0.6, output_step: 5 ms}
"""
YIELDING = """\
structures:
  building:
    shear_building: {storeys: 2, mass: 100 t, stiffness: 100 MN/m, height: 3 m, yield_force: 500 kN, hardening: 5 %}
    damping: 5 %
analysis: {duration: 1}
"""


class Broken:
    def __repr__(self):
        raise RuntimeError("no text")


LOOP = []
LOOP.append(LOOP)
WRONG = (
    None,
    math.nan,
    math.inf,
    -math.inf,
    -1,
    -1.5,
    0,
    10**400,
    1e300,
    "",
    "nonsense",
    "\0",
    "\ud800",
    "x" * 1_000_000,
    b"bytes",
    b"x" * 1_000_000,
    True,
    1j,
    {},
    {"a": 1},
    {1: 2},
    {"x" * 1_000_000: 1},
    [],
    [None],
    [math.nan],
    [1, "a"],
    [[1], [1, 2]],
    list(range(100_000)),
    LOOP,
    Broken(),
    (),
    set(),
    np.array([[1.0]]),
    np.array(["a"]),
    np.array([1j]),
    np.datetime64("2020-01-01"),
    lambda *_: None,
    Ellipsis,
    range(3),
)
#: For functions that take long for a valid value.
FEW = (math.nan, -1.5, 10**400, "nonsense", "\ud800", b"bytes", 1j, {"a": 1}, [None], [[1], [1, 2]], Broken())
FRAME = {"frame": {"grid": {"storeys": 2, "bays": 2, "storey_height": "3 m", "bay_width": "6 m"}}}


class WrongArguments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        warnings.simplefilter("ignore")
        made = tempfile.TemporaryDirectory()
        cls.addClassCleanup(made.cleanup)
        cls.folder = Path(made.name)
        # Some invalid values are file names.
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(cls.folder)
        (cls.folder / "model.yaml").write_text(MODEL)
        (cls.folder / "record.csv").write_text(
            "# time (s), acceleration (m/s^2)\n" + "".join(f"{0.01 * i}, {math.sin(0.3 * i)}\n" for i in range(200))
        )
        cls.run_ = pounding.run(str(cls.folder / "model.yaml"), output=str(cls.folder / "out.h5"))
        cls.study = pounding.sweep(
            pounding.Model.from_yaml(MODEL), {"links.*.gap": ["1 mm", "2 mm"]}, keep=["force", "required_gap"]
        )

    def refuses(self, function, allowed=(), values=WRONG, **right):
        """Every argument with every invalid value: no errors but ValueError, ImportError of an optional package, and
        the allowed ones."""
        for name in right:
            for wrong in values:
                try:
                    function(**{**right, name: wrong})
                except (ValueError, ImportError, *allowed) as error:
                    self.assertLess(len(str(error)), LONGEST_MESSAGE + 1000)
                    self.assertTrue(str(error))
                except Exception as error:
                    with self.subTest(
                        function=getattr(function, "__qualname__", function), name=name, wrong=repr_of(wrong)
                    ):
                        self.fail(f"{type(error).__name__}: {str(error)[:300]}")

    def test_of_laws(self):
        law = pounding.laws["hertz_damped"]
        self.refuses(lambda name: pounding.laws[name], name="hertz")
        self.refuses(law, restitution=0.5, stiffness=1e9, formula="exact", impact_velocity=1.0, exponent=1.5)
        self.refuses(pounding.laws["jankowski"], restitution=0.5, stiffness=1e9, reduced_mass=1e4)
        made = pounding.laws["kelvin_voigt"](stiffness=1e8, restitution=0.5, reduced_mass=1e4)
        for ask in (made.force, made.respond):
            self.refuses(
                ask, penetration=[1e-3, 2e-3], rate=0.3, approach_velocity=0.5, reduced_mass=1e4, in_order=False
            )
        self.refuses(made.free_impact, closing_speed=0.5, reduced_mass=1e4)
        self.refuses(made.describe, closing_speed=1.0)
        self.refuses(
            pounding.calibrate,
            law="hertz_damped",
            m1="100 t",
            m2="wall",
            restitution=0.5,
            stiffness=1e9,
            velocity=0.5,
            exponent=1.5,
        )
        self.refuses(lambda name: pounding.hysteresis[name], name="bilinear")
        bilinear = pounding.hysteresis["bilinear"]
        self.refuses(bilinear, stiffness=1e7, yield_force=1e5, hardening=0.05)
        self.refuses(bilinear(stiffness=1e7, yield_force=1e5, hardening=0.05).follow, path=[0, 0.1])

    def test_a_mass_that_is_no_mass_is_refused_by_every_law(self):
        for name, kind in pounding.laws.items():
            given = {p.name: p.typical for p in kind.parameters if p.need in ("required", "instead of restitution")}
            first = next((p.name for p in kind.parameters if p.need == "instead of restitution"), None)
            given = {
                key: value
                for key, value in given.items()
                if key == first or next(p.need for p in kind.parameters if p.name == key) == "required"
            }
            if kind.takes_restitution and first is None:
                given["restitution"] = 0.5
            for bad in (math.nan, math.inf, -1.0):
                with self.subTest(law=name, mass=bad), raises(pounding.InputError, "reduced_mass"):
                    kind(**given, reduced_mass=bad)

    def test_of_models(self):
        self.refuses(pounding.Model.from_file, path=str(self.folder / "model.yaml"))
        self.refuses(pounding.Model.from_yaml, text=MODEL)
        model = pounding.Model.from_yaml(MODEL)
        parts = {
            part: getattr(model, part)
            for part in (
                "structures",
                "links",
                "ground_motion",
                "analysis",
                "title",
                "compare",
                "checkpoint",
                "accept",
                "devices",
            )
        }
        self.refuses(lambda **words: pounding.check(pounding.Model(**words)), **parts)
        self.refuses(lambda **words: pounding.Model(**words).to_yaml(), **parts)
        self.refuses(pounding.check, model=model)
        self.refuses(pounding.modes, model=model, count=3)
        self.refuses(
            pounding.pushover,
            model=pounding.Model.from_yaml(YIELDING),
            structure="building",
            to="100 mm",
            cyclic=["10 mm", "-10 mm"],
            load=[1.0, 2.0],
            direction="x",
            output=str(self.folder / "push.h5"),
        )
        self.refuses(pounding.record, name="elcentro")
        self.refuses(
            pounding.record_spectrum,
            file=str(self.folder / "record.csv"),
            damping=0.05,
            periods=[0.1, 1.0],
            units="m/s^2",
            channel="",
        )

    def test_of_runs(self):
        model = pounding.Model.from_yaml(MODEL)
        self.refuses(
            pounding.run,
            values=FEW,
            model=model,
            tolerance=1e-3,
            output=str(self.folder / "run.h5"),
            options={"ts_max_steps": 100000},
            progress=False,
        )
        self.refuses(
            lambda value: pounding.run(model, options={"ts_max_steps": value}),
            allowed=(pounding.SolverError,),
            values=FEW,
            value=100000,
        )
        self.refuses(
            pounding.resume,
            results=str(self.folder / "out.h5"),
            output=str(self.folder / "more.h5"),
            options={},
            progress=False,
        )
        self.refuses(pounding.read, allowed=(OSError,), path=str(self.folder / "out.h5"), checked=True)
        self.refuses(pounding.read_pushover, allowed=(OSError,), path=str(self.folder / "out.h5"))
        run = self.run_
        self.refuses(run.plot, values=FEW, picture="run", title="A", size=(6, 4), compare=False)
        self.refuses(run.spectrum, floor="left.1", damping=0.05, periods=[0.1, 1.0], direction="x")
        self.refuses(
            run.animate,
            allowed=(OSError,),
            values=FEW,
            path=str(self.folder / "film.gif"),
            frames=2,
            start=0.0,
            end=0.5,
            scale=1.0,
            title="A",
        )
        self.refuses(run.impacts_of, link="left-right")
        self.refuses(run.save, allowed=(OSError,), path=str(self.folder / "copy.h5"))
        self.refuses(type(run).from_image, image=(self.folder / "out.h5").read_bytes())
        spectrum = run.spectrum("left.1")
        self.refuses(spectrum.plot, values=FEW, title="A", size=(6, 3))
        self.refuses(spectra_figure, values=FEW, spectra=[spectrum], title="A", size=(6, 3))

    def test_of_studies(self):
        study = self.study
        self.refuses(lambda column: study[column], column="force")
        self.refuses(study.model_of, row=1)
        self.refuses(study.choose, gap=0.001)
        self.refuses(study.limit_of, column="force", limit="1 MN")
        self.refuses(study.percentiles, column="force", percent=(16, 50))
        self.refuses(study.fragility, values=FEW, column="force", limit=1e6, bootstrap=10, seed=1)
        self.refuses(study.map, column="force", across="gap", along="gap", percent=50)
        self.refuses(study.plot, values=FEW, picture="gap", column="force")
        self.refuses(study.evaluate, factors={"gap": 0.001})
        self.refuses(study.indices, column="force")
        curve = study.gaps()
        self.refuses(curve.exceedance, gap=0.001)
        self.refuses(curve.band, gap=0.001, confidence=0.9)
        self.refuses(curve.percentile, percent=84, confidence=0.9)
        self.refuses(curve.ratio, rule="abs")

    def test_of_a_study_that_runs(self):
        model = pounding.Model.from_yaml(MODEL)
        factors = {"gap": {"of": "links.*.gap", "list": ["1 mm"]}}
        self.refuses(
            pounding.study,
            values=(*FEW, LOOP, np.array(1j)),
            model=model,
            factors=factors,
            records=None,
            intensity=None,
            keep=["force"],
            sampling=None,
            without_links=False,
            limits=None,
            seed=1,
            stop_after="5 %",
            output=None,
            workers=0,
            executor=None,
            chunk=None,
            progress=False,
        )
        self.refuses(
            pounding.sweep,
            values=(*FEW, LOOP, np.array(1j)),
            model=model,
            factors={"links.*.gap": ["1 mm"]},
            records=None,
            keep=["force"],
            workers=0,
        )
        for function in (
            lambda value: pounding.sweep(model, {"links.*.gap": value}),
            lambda value: pounding.sweep(model, {"links.*.gap": [value]}),
            lambda value: pounding.sweep(model, {"links.*.gap": ["1 mm"]}, records=[value]),
        ):
            self.refuses(function, values=(*FEW, LOOP, np.array(1j)), value="1 mm")
        self.refuses(separation, values=FEW, model=str(self.folder / "model.yaml"), records=None, workers=0)
        self.refuses(self.study.to_csv, allowed=(OSError,), values=FEW, path=str(self.folder / "rows.csv"))
        self.refuses(type(self.study).open, allowed=(OSError,), values=FEW, path=str(self.folder / "missing.h5"))
        self.refuses(lambda across: self.study.plot("map", "force", across=across), across="gap")
        self.refuses(lambda size: self.study.plot("gap", size=size), values=FEW, size=(5, 3))
        self.refuses(lambda value: self.study.plot("tornado", "force", limit=value), value=1)

    def test_that_are_right_run(self):
        record = self.folder / "record.csv"
        model = pounding.Model.from_file(self.folder / "model.yaml")
        for gaps in (["1 mm", "2 mm"], (1e-3, 2e-3), np.array([1e-3, 2e-3]), [np.float32(1e-3), 1]):
            self.assertEqual(len(pounding.sweep(model, {"links.*.gap": gaps}, keep=("force",), workers=np.int64(0))), 2)
        for records in ([record], (str(record),), self.folder.glob("record.csv")):
            study = pounding.sweep(model=self.folder / "model.yaml", factors={"links.*.gap": [1e-3]}, records=records)
            self.assertEqual(study.records["name"], ["record.csv"])
        study = pounding.study(
            model,
            {"gap": {"of": "links.*.gap", "list": [1, 2]}},
            stop_after=1,
            seed=np.int64(2),
            output=self.folder / "table.h5",
            workers=0,
            progress=lambda *_: None,
        )
        self.assertEqual(study.finished.sum(), 2)

    def test_of_plans(self):
        self.refuses(plan.extent, structures={"a": FRAME})
        self.refuses(
            plan.row, structures={"a": FRAME, "b": FRAME}, gap="30 mm", along="x", start=(0.0, 0.0), align="low"
        )
        for key in ("grid", "nodes", "origin"):
            self.refuses(
                lambda value: plan.extent({"a": {"frame": {**FRAME["frame"], key: value}}}),
                value=FRAME["frame"].get(key, []),
            )
        for key in ("bays", "bay_width"):
            self.refuses(
                lambda value: plan.extent({"a": {"frame": {"grid": {**FRAME["frame"]["grid"], key: value}}}}), value=2
            )

    def test_a_row_that_is_not_there_is_no_other_row(self):
        for row in (-1, 2, 10**9, 0.5, "0", None, True):
            with raises(pounding.InputError, "row"):
                self.study.model_of(row)
        self.assertIn("0.002", self.study.model_of(np.int64(1)))


class LinksOfANumber(unittest.TestCase):
    def swept(self, names, path):
        model = pounding.Model.from_yaml(MODEL)
        link = dict(model.links[0])
        model.links = [{**link, "name": name, "gap": f"{2 + i} mm"} for i, name in enumerate(names)]
        return pounding.sweep(model, {path: ["1 mm"]}, keep=["force"])

    def test_are_refused_where_they_are_the_number_of_another(self):
        with raises(pounding.InputError, "1"):
            self.swept(["1", "b"], "links.1.gap")

    def test_are_links_by_their_names_elsewhere(self):
        for names, path, gaps in (
            (["a", "1"], "links.1.gap", ("2 mm", "0.001")),
            (["7", "b"], "links.7.gap", ("0.001", "3 mm")),
            (["1", "b"], "links.*.gap", ("0.001", "0.001")),
            (["1", "b"], "links.b.gap", ("2 mm", "0.001")),
        ):
            text = self.swept(names, path).model_of(0)
            self.assertEqual(tuple(link["gap"] for link in pounding.Model.from_yaml(text).links), gaps, text)


def repr_of(value):
    try:
        return repr(value)[:60]
    except RuntimeError:
        return "broken"


if __name__ == "__main__":
    unittest.main()
