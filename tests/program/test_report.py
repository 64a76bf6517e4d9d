"""Reports of runs: their numbers, their formats, and runs of every kind."""

import hashlib
import json
import math
import os
import re
import zlib
from html.parser import HTMLParser
from pathlib import Path

from small_models import HINGES, ISOLATORS, STOREYS
from support import MASTS, OSCILLATORS, UNSOLVABLE, ProgramTest, assert_mentions

COMPARED = HINGES.replace("duration: 0.6 s", "duration: 1.2 s") + "compare: no_pounding\n"
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w])")
#: Units of the report in SI: kN and t, mm, %, g; and one.
UNITS = (1.0, 1e-3, 1e3, 1e2, 1 / 9.80665)
LONG_NAME = "the northern wing of the old town hall with its clock tower"
SPATIAL = """\
ground_motion: {components: {x: {harmonic: {amplitude: 5.0, period: 0.5 s, duration: 0.6 s}}, y: {harmonic: {amplitude: 3.0, period: 0.4 s, duration: 0.6 s}}}}
structures:
  west:
    frame:
      material: {E: 30 GPa, poisson: 0.2}
      grid: {storeys: 2, bays: [1, 1], storey_height: 3.2 m, bay_width: {x: 6 m, y: 5 m}, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, floor_mass: 60 t, rigid_floors: true}
    damping: 5 %
  east:
    frame:
      origin: [6.01 m, 1 m, 0 m]
      material: {E: 30 GPa, poisson: 0.2}
      grid: {storeys: 1, bays: [1, 1], storey_height: 3.2 m, bay_width: {x: 6 m, y: 5 m}, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, floor_mass: 40 t, rigid_floors: true}
    damping: 5 %
links: [{between: [west, east], floors: level, law: hertz_damped, stiffness: 1e9, restitution: 0.65}]
analysis: {duration: 0.6 s, output_step: 10 ms}
compare: no_pounding
"""


class Page(HTMLParser):
    """Texts of a report without its pictures and styles."""

    def __init__(self, text):
        super().__init__()
        self.hidden, self.texts, self.tags, self.labels = 0, [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.hidden += tag in ("svg", "style")
        self.labels += [value for name, value in attributes if name == "aria-label"]

    def handle_endtag(self, tag):
        self.hidden -= tag in ("svg", "style")

    def handle_data(self, data):
        if not self.hidden and data.strip():
            self.texts.append(data.strip())

    def text(self):
        return "\n".join(self.texts)


def pdf_text(data):
    """Texts of a PDF of matplotlib, one line each."""
    lines = []
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.S):
        try:
            content = zlib.decompress(stream)
        except zlib.error:
            continue
        for block in re.findall(rb"BT(.*?)ET", content, re.S):
            pieces = re.findall(rb"\(((?:[^()\\]|\\.)*)\)", block)
            lines.append(re.sub(rb"\\(.)", rb"\1", b"".join(pieces)).replace(b"\0", b"").decode("latin-1"))
    return "\n".join(lines)


def numbers_of(summary):
    """All numbers of a JSON object, those in texts included."""
    if isinstance(summary, dict):
        return [n for key, value in summary.items() for n in numbers_of(key) + numbers_of(value)]
    if isinstance(summary, list):
        return [n for value in summary for n in numbers_of(value)]
    if isinstance(summary, str):
        return [float(n) for n in NUMBER.findall(summary)]
    return [] if summary is None or isinstance(summary, bool) else [float(summary)]


def missing_numbers(text, summary):
    """Numbers in the text of a report that are not, rounded, in a JSON object in any unit. Numbers of omitted rows and
    the time and version of the run are ignored."""
    text = re.sub(
        r"and \d+ more|\d+ more|[Rr]un (of )?\d{4}-\S+( [\d:]+ UTC)?|pounding \d+\.\d+\.\d+\S*|SHA-256|\b[0-9a-f]{64}\b",
        "",
        text,
    )
    known = [abs(n) for n in numbers_of(summary)]
    lacking = []
    for found in NUMBER.findall(text):
        value = abs(float(found))
        mantissa, _, exponent = found.partition("e")
        decimals = len(mantissa.partition(".")[2])
        half = 0.5000001 * 10 ** (int(exponent or 0) - decimals)
        # Trailing zeros are cut: "50" may be 50.2 with three digits only if it is written "50.2".
        if not any(abs(n * unit - value) <= half for n in known for unit in UNITS):
            lacking.append(found)
    return lacking


class Reports(ProgramTest):
    def report(self, model, *more):
        """HTML, PDF and --json of a run of a model."""
        name = self.write(model)
        done = self.pounding("run", name, "-o", "out.h5", "--report", "report.html", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions(done.stdout, ["report.html", "out.h5"])
        done = self.pounding("report", "out.h5", "-o", "report.pdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = self.summary(name, *more)
        page = Page((self.folder / "report.html").read_text(encoding="utf-8"))
        return page, pdf_text((self.folder / "report.pdf").read_bytes()), summary

    def test_every_number_is_in_the_json_object(self):
        for model in (COMPARED, OSCILLATORS, STOREYS + "compare: no_pounding\n", ISOLATORS, SPATIAL, MASTS):
            with self.subTest(model[:60]):
                page, pdf, summary = self.report(model)
                self.assertGreater(len(NUMBER.findall(page.text())), 40)
                self.assertEqual(missing_numbers(page.text(), summary), [])
                # The PDF has the same numbers, and those of its axes.
                self.assertLessEqual(set(NUMBER.findall(page.text())), set(NUMBER.findall(pdf)))

    def test_a_changed_number_would_be_noticed(self):
        page, _, summary = self.report(COMPARED)
        shown = next(text for text in page.texts if re.fullmatch(r"\d\d\d\.\d\d?", text))
        self.assertEqual(len(missing_numbers(page.text().replace(shown, "987.65"), summary)), page.texts.count(shown))

    def test_has_all_parts_with_alternative_texts(self):
        page, pdf, summary = self.report("project: Main Street 5, job 1234\n" + "title: Twin frames\n" + COMPARED)
        parts = ["Twin frames", "Main Street 5", "Assumptions", "hertz_damped", "Ground motion", "without", "Members with",
                 "Yielding parts", "Strongest impacts", "restitution", "Energy", "Warnings", "tolerance 0.0001"]  # fmt: skip
        assert_mentions(page.text(), parts)
        assert_mentions(pdf, [*parts, "page 1 of 2", "page 2 of 2"])
        checksum = hashlib.sha256((self.folder / "model.yaml").read_bytes()).hexdigest()
        self.assertEqual(summary["model"]["sha256"], checksum)
        assert_mentions(page.text(), [checksum])
        assert_mentions(pdf, [checksum])
        self.assertEqual(page.tags.count("svg"), len(page.labels))
        self.assertTrue(all(page.labels))
        text = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertNotIn("http", re.sub(r'xmlns(:\w+)?="[^"]*"', "", text))  # one file, no network
        ids = re.findall(r' id="([^"]+)"', text)
        self.assertEqual(len(ids), len(set(ids)))

    def test_states_the_tolerance_in_force(self):
        page, _, summary = self.report(COMPARED, "-pounding_ts_rtol", "2e-5")
        self.assertEqual(summary["solver"]["tolerance"], 2e-5)
        assert_mentions(page.text(), ["tolerance 2e-05"])

    def test_is_the_same_bit_by_bit_when_repeated(self):
        self.report(COMPARED)
        for suffix in ("html", "pdf"):
            first = (self.folder / f"report.{suffix}").read_bytes()
            self.assertEqual(self.pounding("report", "out.h5", "-o", f"report.{suffix}").returncode, 0)
            self.assertEqual((self.folder / f"report.{suffix}").read_bytes(), first)

    def test_fits_two_pages_with_letters_of_at_least_seven_points(self):
        self.report(COMPARED)
        data = (self.folder / "report.pdf").read_bytes()
        self.assertEqual(len(re.findall(rb"/Type /Page\b", data)), 2)
        sizes = set()
        for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.S):
            try:
                sizes |= {float(size) for size in re.findall(rb"/\S+ ([\d.]+) Tf", zlib.decompress(stream))}
            except zlib.error:
                continue
        self.assertGreaterEqual(min(sizes), 7)

    def test_compares_members_hinges_and_shears(self):
        summary = self.summary(self.write(COMPARED))
        for name, compared in summary["comparison"].items():
            both = [summary["structures"][name], summary["no_pounding"]["structures"][name]]
            for key, field in (("drift", "peak_drift"), ("acceleration", "peak_acceleration")):
                for row, with_links, without in zip(compared[key], *(one[field] for one in both), strict=True):
                    self.assertEqual((row["with"], row["without"]), (with_links, without))
                    self.assertEqual(row["ratio"], with_links / without)
            shears = [one["envelope"]["storey_shear"] for one in both]
            peaks = [[max(abs(a), abs(b)) for a, b in zip(one["min"], one["max"])] for one in shears]
            self.assertEqual([[row[k] for row in compared["storey_shear"]] for k in ("with", "without")], peaks)
            # The largest ratio of all members and components, independent of the ranking.
            ratios = {}
            forces = [one["envelope"]["member_force"] for one in both]
            members, components = both[0]["envelope"]["members"], both[0]["envelope"]["components"]
            peaks = [
                {
                    (member, kind): max(
                        max(abs(one["min"][m][c]), abs(one["max"][m][c]))
                        for c, component in enumerate(components)
                        if component.split(" ")[1] == kind
                    )
                    for m, member in enumerate(members)
                    for kind in {component.split(" ")[1] for component in components}
                }
                for one in forces
            ]
            for (member, kind), with_links in peaks[0].items():
                top = max(value for (_, other), value in peaks[0].items() if other == kind)
                if with_links >= 0.1 * top and peaks[1][member, kind] > 1e-9 * with_links:
                    ratios[member, kind] = with_links / peaks[1][member, kind]
            rows = compared["members"]["by_ratio"]
            self.assertEqual([row["ratio"] for row in rows], sorted(ratios.values(), reverse=True)[:5])
            self.assertEqual(rows[0]["ratio"], ratios[rows[0]["member"], rows[0]["component"]])
            springs = [{part["name"]: part for part in one["yielding"]["springs"]} for one in both]
            largest = max(springs[0].values(), key=lambda part: part["ductility"])
            worst = compared["hinges"]["by_demand"][0]
            self.assertEqual(worst["ductility"]["with"], largest["ductility"])
            self.assertEqual(worst["ductility"]["without"], springs[1][worst["part"]]["ductility"])
            self.assertEqual(worst["plastic"]["without"], springs[1][worst["part"]]["plastic"])

    def test_the_text_has_the_same_comparison(self):
        name = self.write(COMPARED)
        summary, text = self.summary(name), self.pounding("run", name).stdout
        row = summary["comparison"]["left"]["members"]["by_ratio"][0]
        assert_mentions(
            text, ["largest ratios", "largest forces", "largest ductilities", row["member"], f"{row['ratio']:.3f}"]
        )
        self.assertNotIn("largest ratios", self.pounding("run", self.write(HINGES)).stdout)


class Verdicts(ProgramTest):
    def verdict(self, model):
        name = self.write(model)
        done = self.pounding("run", name, "-q", "-o", "out.h5", "--report", "report.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        return re.search(r'class="verdict">([^<]*)<', (self.folder / "report.html").read_text(encoding="utf-8")).group(
            1
        )

    def test_names_the_gap_and_the_worst_member(self):
        model = (Path(os.environ["POUNDING_EXAMPLES"]) / "20_hinge_frames/model.yaml").read_text()
        summary = self.summary(self.write(model))
        separations = summary["no_pounding"]["separations"]
        needed = max(one["enough"] for one in separations)
        rows = [row for one in summary["comparison"].values() for row in one["members"]["by_ratio"]]
        worst = max(rows, key=lambda row: row["ratio"])
        assert_mentions(
            self.verdict(model),
            ["20 mm is not enough", f"{1e3 * needed:.3g} mm needed", worst["member"], f"{worst['ratio']:.3g} times"],
        )

    def test_names_a_storey_without_members(self):
        assert_mentions(
            self.verdict(OSCILLATORS + "compare: no_pounding\n"), ["20 mm is not enough", "storey 1 of right"]
        )

    def test_says_that_a_gap_is_enough(self):
        assert_mentions(
            self.verdict(OSCILLATORS.replace("20 mm", "2 m") + "compare: no_pounding\n"),
            ["No contact", "2000 mm is enough"],
        )
        assert_mentions(self.verdict(OSCILLATORS.replace("20 mm", "2 m")), ["No contact", "no link closes"])

    def test_asks_for_a_comparison(self):
        assert_mentions(self.verdict(OSCILLATORS), ["5 impacts", "7179 kN", "compare: no_pounding"])

    def test_of_a_model_without_links(self):
        assert_mentions(
            self.verdict(OSCILLATORS[: OSCILLATORS.index("links:")] + "analysis: {duration: 3.0}\n"), ["no links"]
        )

    def test_of_a_collapse_and_of_a_failed_run(self):
        drift = "analysis: {duration: 1.0, collapse_drift: 0.5 %"
        tall = STOREYS.replace("mass: 200 t", "mass: 200 t, height: 3 m").replace(
            "mass: 150 t", "mass: 150 t, height: 3 m"
        )
        assert_mentions(self.verdict(tall.replace("analysis: {duration: 1.0", drift)), ["collapse", "No contact"])
        self.assertNotEqual(self.pounding("run", self.write(UNSOLVABLE), "-o", "failed.h5").returncode, 0)
        done = self.pounding("report", "failed.h5", "-o", "failed.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions((self.folder / "failed.html").read_text(encoding="utf-8"), ["No verdict", "the run failed"])
        self.assertEqual(self.pounding("report", "failed.h5", "-o", "failed.pdf").returncode, 0)


class Extremes(ProgramTest):
    def test_many_structures_and_links_are_cut_with_a_note(self):
        names = [f"house {i}" for i in range(40)]
        row = "".join(f"  {name}: {{shear_building: {{storeys: 3, mass: 100 t, stiffness: {60 + i} MN/m}}, damping: 5 %}}\n" for i, name in enumerate(names))  # fmt: skip
        links = "".join(f"  - {{between: [{a}, {b}], floors: all, gap: 5 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.6}}\n" for a, b in zip(names, names[1:]))  # fmt: skip
        model = f"ground_motion: {{harmonic: {{amplitude: 4.0, period: 0.5, duration: 0.5}}}}\nstructures:\n{row}links:\n{links}analysis: {{duration: 0.5, tolerance: 1e-3}}\ncompare: no_pounding\n"
        done = self.pounding("run", self.write(model), "-q", "-o", "out.h5", "--report", "report.pdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = pdf_text((self.folder / "report.pdf").read_bytes())
        assert_mentions(text, ["28 more structures", "96 more", "107 more links", "house 1.1", "and 116 more"])
        self.assertLessEqual(text.count("page "), 3)

    def test_long_and_chinese_names(self):
        model = COMPARED.replace("left:", f"{LONG_NAME}:").replace("[left, right]", f"[{LONG_NAME}, right]")
        model = "title: 東京の二つの建物の衝突解析, Gebäude & <Nachbarn>\nproject: 項目\n" + model
        done = self.pounding("run", self.write(model), "-q", "-o", "out.h5", "--report", "report.html")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = Page((self.folder / "report.html").read_text(encoding="utf-8"))
        assert_mentions(page.text(), ["東京の二つの建物の衝突解析, Gebäude & <Nachbarn>", "項目", LONG_NAME])
        done = self.pounding("report", "out.h5", "-o", "report.pdf")
        self.assertEqual(done.returncode, 0)
        if done.stderr:  # without an East Asian font
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            assert_mentions(done.stderr, "fonts-noto-cjk")


class Requests(ProgramTest):
    def test_other_suffixes_are_refused_before_the_run(self):
        name = self.write(OSCILLATORS)
        for report in ("report.docx", "report", "report.png", ""):
            self.refused(2, [".pdf", ".html"], "run", name, "-o", "out.h5", "--report", report)
        self.assertFalse((self.folder / "out.h5").exists())
        self.assertEqual(self.pounding("run", name, "-q", "-o", "out.h5").returncode, 0)
        self.refused(2, [".pdf", ".html"], "report", "out.h5", "-o", "report.txt")

    def test_files_of_another_kind_are_not_replaced(self):
        self.write("precious", "report.pdf")
        self.refused(2, ["report.pdf", "report"], "run", self.write(OSCILLATORS), "--report", "report.pdf")
        self.assertEqual((self.folder / "report.pdf").read_text(), "precious")
        self.assertFalse((self.folder / "model.h5").exists())

    def test_other_results_are_refused(self):
        self.write("no results", "text.h5")
        self.refused(2, ["text.h5"], "report", "text.h5", "-o", "report.pdf")
        self.refused(2, ["missing.h5"], "report", "missing.h5", "-o", "report.pdf")
        self.assertFalse((self.folder / "report.pdf").exists())

    def test_a_report_keeps_the_results(self):
        done = self.pounding("run", self.write(OSCILLATORS), "--report", "report.pdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions(done.stdout, ["model.h5", "report.pdf"])
        self.assertTrue((self.folder / "model.h5").exists())
        self.assertEqual(self.pounding("report", "model.h5").returncode, 0)
        self.assertTrue((self.folder / "model.pdf").exists())

    def test_results_that_are_not_kept_are_said_to_be(self):
        name = self.write(OSCILLATORS)
        assert_mentions(self.pounding("run", name).stdout.splitlines()[-1], ["not kept", "-o model.h5"])
        self.assertNotIn("not kept", self.pounding("run", name, "-o", "out.h5").stdout)
        self.assertEqual(self.pounding("run", name, "-q").stdout, "")
        self.assertTrue(math.isfinite(json.loads(self.pounding("run", name, "--json").stdout)["energy"]["input"]))
