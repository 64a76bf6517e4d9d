"""Reports of suites: their numbers, their verdict, their pages, and the command."""

import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding import _yaml_text as yaml_text
from pounding.errors import InputError
from pounding._report.html_page import html_page
from pounding._report.pdf_pages import page_figures
from pounding._report.suite_content import report_of_suite
from pounding._studies.batches import FAILED
from pounding._studies.suite import Suite
from pounding._studies.suite_report import summary
from messages import assert_mentions, raises
from study_samples import bents, pair, write_records

sys.path.append(str(Path(__file__).parents[2] / "program"))
from small_models import HINGES  # noqa: E402
from test_report import NUMBER, Page, missing_numbers, pdf_text  # noqa: E402

NAMES = [f"r{i}.csv" for i in range(4)]
TARGET = {"periods": ["0.05 s", "0.5 s", "5 s"], "sa": ["0.9 g", "0.8 g", "0.1 g"]}
SCALE = {"spectrum": TARGET, "from": "0.1 s", "to": "1 s"}
PERCENT = (16.0, 50.0, 84.0)


def page_of(suite, percent=84.0):
    """Texts of the report as HTML."""
    return Page(html_page(report_of_suite(suite, percent)))


def verdict_of(suite, percent=84.0):
    return report_of_suite(suite, percent).blocks[0].text


def of_json(suite, percent=PERCENT):
    """The object of `pounding suite --json`."""
    return json.loads(json.dumps(summary(suite, percent)))


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        write_records(self.folder, NAMES)
        self.files = [str(self.folder / name) for name in NAMES]

    def suite(self, model, **more):
        return pounding.suite(model, {"files": self.files}, workers=0, **more)

    def command(self, *words, code=0, module=()):
        begin = [sys.executable, "-m", *module] if module else [os.environ["POUNDING_PROGRAM"], "suite"]
        done = subprocess.run([*begin, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def hinge_frames(self):
        """Two frames with plastic hinges, 0.5 s of an earthquake."""
        (self.folder / "hinges.yaml").write_text(HINGES + "compare: no_pounding\n")
        parts = pounding.Model.from_file(self.folder / "hinges.yaml")._parts()
        return pounding.Model(**{key: value for key, value in parts.items() if key != "ground_motion"})


class Numbers(Folder):
    def suites(self):
        compared = pair(compare="no_pounding", title="A pair", project="Main Street 5")
        yield self.suite(compared, scale_to=SCALE)
        yield self.suite(pair())
        yield self.suite(bents())
        yield self.suite(self.hinge_frames())

    def test_every_number_is_in_the_json_object(self):
        for one in self.suites():
            with self.subTest(one.description["model"].get("title", one.structures)):
                page, found = page_of(one), of_json(one)
                self.assertGreater(len(NUMBER.findall(page.text())), 30)
                self.assertEqual(missing_numbers(page.text(), found), [])
                one.report(self.folder / "report.pdf")
                pdf = pdf_text((self.folder / "report.pdf").read_bytes())
                self.assertLessEqual(set(NUMBER.findall(page.text())), set(NUMBER.findall(pdf)))

    def test_a_changed_number_would_be_noticed(self):
        one = self.suite(pair(compare="no_pounding"))
        page = page_of(one)
        shown = next(text for text in page.texts if re.fullmatch(r"\d\d\d?\.\d\d?", text))
        changed, count = re.subn(rf"(?<![\d.]){re.escape(shown)}(?![\d.])", "987.65", page.text())
        self.assertGreater(count, 0)
        self.assertEqual(len(missing_numbers(changed, of_json(one))), count)

    def test_worst_members_have_the_largest_ratios_of_means(self):
        write_records(self.folder, NAMES, peak=30.0)
        one = self.suite(self.compared_bents())
        ratios = {}
        for name in one.structures:
            both = [one.members(name, alone=alone).mean(axis=0) for alone in (False, True)]
            layout = one.structure(name)
            for i, member in enumerate(layout["members"]):
                for j, kind in enumerate(layout["components"]):
                    if both[0][i, j] >= 0.1 * both[0][:, j].max() and both[1][i, j] > 1e-9 * both[0][i, j]:
                        ratios[name, member, kind] = both[0][i, j] / both[1][i, j]
        rows = of_json(one)["worst"]["members"]
        self.assertGreater(rows[0]["ratio"], 1.05)
        # Sums of the means in another order.
        largest = sorted(ratios.values(), reverse=True)[:5]
        np.testing.assert_allclose([row["ratio"] for row in rows], largest, rtol=1e-13)
        for row in rows:
            own = ratios[row["structure"], row["member"], row["component"]]
            np.testing.assert_allclose(row["ratio"], own, rtol=1e-13)
            self.assertEqual(row["ratio"], row["with"]["mean"] / row["without"]["mean"])
        self.assertIn(f"{rows[0]['ratio']:.2f}", page_of(one).texts)

    def compared_bents(self):
        parts = bents()._parts()
        return pounding.Model(**{**{key: value for key, value in parts.items() if value}, "compare": "no_pounding"})

    def test_hinges_have_ductility_and_plastic_rotation(self):
        one = self.suite(self.hinge_frames())
        rows = of_json(one)["worst"]["hinges"]
        self.assertTrue(rows)
        for row in rows:
            place = one.structure(row["structure"])
            k = place["parts"].index(row["part"])
            values = one.parts(row["structure"], "ductility")[:, k]
            self.assertEqual(row["with"]["mean"], values.mean())
            self.assertEqual(row["with"]["max"], values.max())
            turns = one.parts(row["structure"], "plastic_rotation")[:, place["hinges"].index(row["part"])]
            self.assertEqual(row["plastic_rotation"]["84 %"], sorted(turns)[3])
        assert_mentions(page_of(one).text(), ["Yielding parts", "plastic rotation (mrad)", rows[0]["part"]])

    def test_records_have_their_largest_responses(self):
        one = self.suite(pair(compare="no_pounding"), scale_to=SCALE)
        for i, row in enumerate(of_json(one)["records"]):
            self.assertEqual(row["impacts"], one.of_links("impacts")[i].sum())
            self.assertEqual(row["force"], one.of_links("force")[i].max())
            self.assertEqual(row["required_gap"], one["required_gap"][i])
            self.assertEqual(row["factor"], one.scaling.factors[i])

    def test_another_percentile(self):
        one = self.suite(pair(compare="no_pounding"))
        assert_mentions(verdict_of(one, 50.0), ["50 %", f"{1e3 * sorted(one['required_gap'])[1]:.4g} mm"])
        self.assertEqual(missing_numbers(page_of(one, 95.0).text(), of_json(one, (95.0,))), [])


class Verdicts(Folder):
    def test_counts_the_records_that_exceed_the_gap(self):
        required = np.sort(self.suite(pair(compare="no_pounding"))["required_gap"])
        gap = float(required[1] + required[2]) / 2
        link = {**pair()._parts()["links"][0], "gap": f"{gap!r}"}
        one = self.suite(pair(compare="no_pounding", links=[link]))
        np.testing.assert_array_equal(one["required_gap"] > gap, one.of_links("impacts")[:, 0] > 0)
        facts = [f"{1e3 * gap:.4g} mm", "exceeded in 2 of 4 records", "84 %", f"{1e3 * required[3]:.4g} mm"]
        assert_mentions(verdict_of(one), facts)
        self.assertEqual(of_json(one)["records_with_contact"], 2)

    def test_says_that_the_gap_is_enough(self):
        link = {**pair()._parts()["links"][0], "gap": "2 m"}
        one = self.suite(pair(compare="no_pounding", links=[link]))
        assert_mentions(
            verdict_of(one), ["2000 mm", "enough in all 4 records", f"{1e3 * max(one['required_gap']):.4g} mm"]
        )

    def test_without_a_comparison_and_without_links(self):
        one = self.suite(pair())
        force = sorted(one.of_links("force").max(axis=1))[3] / 1e3
        assert_mentions(verdict_of(one), ["Contact in 4 of 4 records", "1 mm", f"{force:.0f} kN"])
        assert_mentions(page_of(one).text(), ["compare: no_pounding"])
        assert_mentions(verdict_of(self.suite(pair(links=[]))), ["no links"])
        links = [{**pair()._parts()["links"][0], "gap": gap, "name": gap[:1]} for gap in ("1 mm", "2 mm")]
        assert_mentions(verdict_of(self.suite(pair(links=links))), ["gaps of 1 to 2 mm"])

    def test_collapsed_records_are_infinite_and_named(self):
        building = {
            "shear_building": {"storeys": 1, "mass": "100 t", "stiffness": "20 MN/m", "height": "3 m"},
            "damping": "5 %",
        }
        model = pair(
            structures={"left": building, "right": {"wall": {}}},
            analysis={"tolerance": "1e-3", "collapse_drift": "0.2 %"},
            compare="no_pounding",
        )
        write_records(self.folder, ["weak.csv"], peak=0.01)
        one = pounding.suite(model, {"files": [*self.files[:2], str(self.folder / "weak.csv")]}, workers=0)
        page = page_of(one)
        assert_mentions(page.text(), ["Collapsed records", "r0.csv", "r1.csv", "∞", "1 done", "2 collapsed"])
        assert_mentions(verdict_of(one), ["no gap is sufficient", "84 %"])
        self.assertEqual(missing_numbers(page.text(), of_json(one)), [])
        # One third of the records does not collapse, and needs a finite gap.
        assert_mentions(verdict_of(one, 33.0), ["33 %", f"{1e3 * one['required_gap'][2]:.4g} mm"])

    def test_failed_records_are_named(self):
        one = self.suite(pair(compare="no_pounding"))
        one["status"][2] = FAILED
        one.reasons[2] = "the step is too small"
        for name in one.description["kept"]["columns"]:
            one[name][2] = np.nan
        page = page_of(one)
        assert_mentions(page.text(), ["Failed records", "r2.csv", "the step is too small", "3 done", "1 solve failed"])
        assert_mentions(verdict_of(one), ["3 records"])
        self.assertEqual(missing_numbers(page.text(), of_json(one)), [])
        one["status"][:] = FAILED
        assert_mentions(verdict_of(one), ["No verdict"])


class Pages(Folder):
    def test_has_all_parts_with_alternative_texts(self):
        one = self.suite(pair(compare="no_pounding", title="A pair", project="Main Street 5"), scale_to=SCALE)
        page = page_of(one)
        parts = ["A pair", "Main Street 5", "4 records", "Records", "factor", "peak (g)", "required gap (mm)", "least squares",
                 "Results", "displacement (mm)", "without", "Links", "opening (mm)", "Warnings", "tolerance 0.001"]  # fmt: skip
        assert_mentions(page.text(), [*parts, one.sha256, pounding.__version__])
        self.assertEqual(page.tags.count("svg"), len(page.labels))
        assert_mentions(" ".join(page.labels), ["over the height", "spectra"])

    def test_pictures_have_the_curves_of_the_suite(self):
        one = self.suite(pair(compare="no_pounding"), scale_to=SCALE)
        figure = page_figures(report_of_suite(one))[0]
        curves = {axes.get_ylabel(): [line.get_ydata() for line in axes.lines] for axes in figure.axes}
        np.testing.assert_allclose(curves["mean / target"][0], one.scaling.fit)
        self.assertEqual(len(curves["spectrum [g]"]), len(NAMES) + 2)
        np.testing.assert_allclose(curves["spectrum [g]"][-1], np.array(one.scaling.sa) / 9.80665)
        panel = next(axes for axes in figure.axes if axes.get_xlabel() == "displacement [mm]")
        widths = [line.get_xdata()[0] for line in panel.lines if line.get_linewidth() > 1]
        expected = [one.floors("left", "displacement", alone=alone).mean() * 1e3 for alone in (True, False)]
        np.testing.assert_allclose(widths[::2], expected)

    def test_a_pair_of_frames_with_eleven_records_fits_two_pages(self):
        model = pounding.Model.from_file(Path(__file__).parents[3] / "examples/17_uneven_pair/model.yaml")
        parts = {key: value for key, value in model._parts().items() if value and key != "ground_motion"}
        parts["analysis"] = {"output_step": "20 ms", "tolerance": "1e-3"}
        motions = {"synthetic": {"count": 11, "duration": "2 s", "pga": "0.35 g", "soil": "firm"}}
        one = pounding.suite(pounding.Model(**parts), motions)
        one.report(self.folder / "report.pdf")
        data = (self.folder / "report.pdf").read_bytes()
        self.assertEqual(len(re.findall(rb"/Type /Page\b", data)), 2)
        assert_mentions(pdf_text(data), ["tower@25m-annex.7", "page 2 of 2"])
        self.assertEqual(missing_numbers(page_of(one).text(), of_json(one)), [])

    def test_many_structures_and_records_are_cut_with_a_note(self):
        names = [f"house {i}" for i in range(10)]
        model = pounding.Model(
            structures={
                name: {"shear_building": {"storeys": 5, "mass": "100 t", "stiffness": f"{60 + i} MN/m"}, "damping": "5 %"}
                for i, name in enumerate(names)
            },
            links=[
                {"between": list(ends), "floors": "all", "gap": "5 mm", "law": "hertz_damped", "stiffness": "1e9", "restitution": "0.6"}
                for ends in zip(names, names[1:])
            ],
            analysis={"tolerance": "1e-3"},
        )  # fmt: skip
        motions = {"synthetic": {"count": 26, "duration": "0.3 s", "pga": "0.3 g"}}
        page = page_of(pounding.suite(model, motions, workers=0))
        facts = ["4 more structures", "1 more floors", "37 more links", "2 more records"]
        assert_mentions(page.text(), facts)


class Command(Folder):
    def file(self, name="suite.yaml", **changes):
        parts = pair(ground_motion=None, analysis=None, compare="no_pounding", **changes)._parts()
        text = yaml_text.emit({"records": {"files": "r?.csv"}, **{key: value for key, value in parts.items() if value}})
        (self.folder / name).write_text(text)
        return name

    def test_writes_the_same_report_as_the_table(self):
        done = self.command(self.file(), "-o", "s.h5", "-j", "0", "--report", "one.html")
        assert_mentions(done.stdout, ["one.html", "s.h5"])
        self.command("s.h5", "-o", "two.html", module=["pounding._report"])
        first = (self.folder / "one.html").read_bytes()
        self.assertEqual((self.folder / "two.html").read_bytes(), first)
        program = [os.environ["POUNDING_PROGRAM"], "report", "s.h5"]
        done = subprocess.run([*program, "-o", "three.html"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        assert_mentions(done.stdout, ["three.html"])
        self.assertEqual((self.folder / "three.html").read_bytes(), first)
        self.assertEqual(subprocess.run(program, cwd=self.folder, capture_output=True).returncode, 0)
        self.assertGreater((self.folder / "s.pdf").stat().st_size, 10000)
        checksum = hashlib.sha256((self.folder / "suite.yaml").read_bytes()).hexdigest()
        assert_mentions(first.decode(), [checksum])
        for name in ("one.pdf", "two.pdf"):
            Suite.open(self.folder / "s.h5").report(self.folder / name)
        self.assertEqual((self.folder / "one.pdf").read_bytes(), (self.folder / "two.pdf").read_bytes())
        printed = json.loads(self.command("suite.yaml", "-o", "s.h5", "--json", "--report", "one.html").stdout)
        self.assertEqual(missing_numbers(Page(first.decode()).text(), printed), [])
        self.assertEqual(printed["sha256"], checksum)

    def test_uses_the_largest_of_the_percentiles(self):
        self.command(self.file(), "-j", "0", "-q", "--percentile", "50", "--percentile", "75", "--report", "one.html")
        assert_mentions((self.folder / "one.html").read_text(encoding="utf-8"), ["75 % of the records"])

    def test_the_checksum_of_a_model_in_memory_is_that_of_its_file(self):
        model = pair(compare="no_pounding", ground_motion=None)
        one = self.suite(model)
        typed = yaml_text.emit({"records": {"files": self.files}, **model._parts()})
        self.assertEqual(one.sha256, hashlib.sha256(typed.encode()).hexdigest())

    def test_wrong_names_are_refused_before_the_runs(self):
        file = self.file()
        for name in ("report.docx", "report", ""):
            done = self.command(file, "-o", "s.h5", "--report", name, code=2)
            assert_mentions(done.stderr, [".pdf", ".html"])
        (self.folder / "precious.pdf").write_text("precious")
        assert_mentions(self.command(file, "-o", "s.h5", "--report", "precious.pdf", code=2).stderr, ["precious.pdf"])
        self.assertEqual((self.folder / "precious.pdf").read_text(), "precious")
        self.assertFalse((self.folder / "s.h5").exists())

    def test_the_table_of_a_study_is_refused(self):
        study = pounding.study(
            pair(), {"gap": {"of": "links.*.gap", "list": ["1 mm"]}}, output=self.folder / "study.h5", workers=0
        )
        self.assertEqual(len(study), 1)
        done = self.command("study.h5", "-o", "report.pdf", module=["pounding._report"], code=2)
        assert_mentions(done.stderr, ["study.h5", "table of a study", "pounding study show"])
        self.assertFalse((self.folder / "report.pdf").exists())
        with raises(InputError, [".docx", ".pdf"]):
            self.suite(pair()).report(self.folder / "report.docx")


if __name__ == "__main__":
    unittest.main()
