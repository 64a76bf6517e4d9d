"""`pounding section`: text, JSON, curves and pictures of sections of fibres, and refusals."""

import csv
import json
import os
import re
import unittest
from pathlib import Path

import numpy as np
from support import ProgramTest
from messages import assert_mentions

MODEL = """\
structures:
  old:
    frame:
      materials:
        core: {concrete02: {fpc: -36 MPa, epsc0: -0.004, fpcu: -28 MPa, epsU: -0.03, lambda: 0.1, ft: 2.5 MPa, Ets: 1.5 GPa}}
        cover: {concrete02: {fpc: -28 MPa, epsc0: -0.002, fpcu: -5.6 MPa, epsU: -0.006, lambda: 0.1, ft: 2.5 MPa, Ets: 1.5 GPa}}
        bars: {steel01: {Fy: 460 MPa, E0: 200 GPa, b: 0.01}}
        steel: {steel01: {Fy: 250 MPa, E0: 200 GPa, b: 0}}
      sections:
        column: {rc_rectangle: {width: 0.4 m, depth: 0.4 m, cover: 40 mm, core: core, shell: cover, bars: bars,
                 top: 4 d19.544100476116796, bottom: 4 d19.544100476116796, sides: 2 d22.567583341910253}}
        block: {rectangle: [0.2 m, 0.4 m], material: steel, layers: 200}
      grid: {storeys: 2, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: column, beams: block, floor_mass: 20 t}
    damping: 5 %
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 0.1}}
analysis: {duration: 0.1}
"""


class Section(ProgramTest):
    def found(self, *words):
        done = self.pounding("section", self.write(MODEL), *words, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)["sections"]

    def test_moments_are_those_of_the_reference(self):
        """Independent program, which agrees with OpenSees 3.7.1 to 3e-12: maxima on a path of 120 steps to 0.06 1/m."""
        (column,) = self.found("column", "--axial", "0,-1 MN,-2 MN,-3 MN,-4 MN,-5 MN", "--curvature", "0.06")
        reference = [253.578394695, 341.796148222, 377.675250863, 334.094638337, 253.322876233, 144.48287023]
        found = [curve["largest_moment"] / 1e3 for curve in column["curves"]]
        np.testing.assert_allclose(found, reference, rtol=0, atol=1e-6)
        self.assertAlmostEqual(column["area"], 0.16)

    def test_a_steel_rectangle_follows_closed_forms(self):
        """Elastic-plastic: My = fy b h^2/6 at 2 fy/(E h), Mp = 1.5 My, M/Mp = 1 - n^2."""
        (block,) = self.found("old.block", "--axial", "0", "--curvature", "0.2")
        (curve,) = block["curves"]
        yields, curvature = 250e6 * 0.2 * 0.4**2 / 6, 2 * 250e6 / 200e9 / 0.4
        layers = 200  # the outermost fibres are half a layer inside
        self.assertAlmostEqual(
            block["uncracked_stiffness"] / (200e9 * 0.2 * 0.4**3 / 12), 1 - 1 / layers**2, delta=1e-9
        )
        self.assertAlmostEqual(curve["yield_curvature"] / curvature, 1 / (1 - 1 / layers), delta=1e-9)
        self.assertAlmostEqual(curve["yield_moment"] / yields, (1 - 1 / layers**2) / (1 - 1 / layers), delta=1e-4)
        self.assertAlmostEqual(curve["largest_moment"] / (1.5 * yields), 1, delta=1e-3)
        self.assertEqual(curve["ultimate_curvature"], 0)
        forces = np.array(block["interaction"]["axial_force"]) / (250e6 * 0.2 * 0.4)
        moments = np.array(block["interaction"]["moment"]) / (1.5 * yields)
        np.testing.assert_allclose(moments, 1 - forces**2, rtol=0, atol=4e-3)

    def test_a_section_in_space_bends_about_both_axes(self):
        """Plastic moments fy b h^2/4 and fy h b^2/4."""
        steel = "{steel01: {Fy: 250 MPa, E0: 200 GPa, b: 0}}"
        shape = "{rectangle: [0.2 m, 0.4 m], material: steel, layers: 40, across: 40}"
        frame = f"{{dimension: 3, materials: {{steel: {steel}}}, sections: {{s: {shape}}}}}"
        model = self.write(f"structures: {{a: {{frame: {frame}}}}}\n")
        for axis, moment in (("y", 250e6 * 0.2 * 0.4**2 / 4), ("z", 250e6 * 0.4 * 0.2**2 / 4)):
            done = self.pounding("section", model, "--axial", "0", "--axis", axis, "--curvature", "0.5", "--json")
            (section,) = json.loads(done.stdout)["sections"]
            self.assertAlmostEqual(section["curves"][0]["largest_moment"] / moment, 1, delta=2e-3)

    def test_the_text_has_the_values_of_the_json(self):
        done = self.pounding("section", self.write(MODEL), "column", "--axial", "0, -1 MN", "--curvature", "0.06")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        (column,) = self.found("column", "--axial", "0, -1 MN", "--curvature", "0.06")
        for curve in column["curves"]:
            assert_mentions(
                done.stdout,
                [
                    f"{curve['largest_moment'] / 1e3:.6g}",
                    f"{curve['yield_curvature']:.4g}",
                    f"{curve['yield_moment'] / 1e3:.4g}",
                    f"{curve['moment'][-1] / 1e3:.6g}",
                ],
            )
        assert_mentions(done.stdout, ["old.column", "0.16 m^2", "concrete02", "steel01", "interaction"])

    def test_cracked_concrete_is_softer_and_fails_by_crushing(self):
        (column,) = self.found("column", "--axial", "-500 kN", "--curvature", "0.5")
        (curve,) = column["curves"]
        self.assertLess(curve["cracked_stiffness"], 0.6 * column["uncracked_stiffness"])
        strain = np.interp(curve["ultimate_curvature"], curve["curvature"], curve["axial_strain"])
        edge = strain - curve["ultimate_curvature"] * 0.16 * 23 / 24  # the outermost layer of the core
        self.assertAlmostEqual(edge, -0.03, delta=1e-4)

    def test_curves_are_written_as_a_table(self):
        done = self.pounding("section", self.write(MODEL), "--axial", "-1 MN", "--csv", "curves.csv")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(self.folder / "curves.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["section"] for row in rows}, {"old.block", "old.column"})
        (column,) = self.found("column", "--axial", "-1 MN")
        moments = [float(row["moment (N m)"]) for row in rows if row["section"] == "old.column"]
        np.testing.assert_allclose(moments, column["curves"][0]["moment"], rtol=1e-8)

    def test_a_picture_is_drawn(self):
        done = self.pounding("section", self.write(MODEL), "--picture", "sections.png")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue((self.folder / "sections.png").read_bytes().startswith(b"\x89PNG"))
        assert_mentions(done.stdout, "sections.png")

    def test_refusals(self):
        model = self.write(MODEL)
        self.refused(2, ["colum", "old.column"], "section", model, "colum")
        self.refused(2, ["--axial", "1 m"], "section", model, "--axial", "1 m")
        self.refused(2, ["--curvature", "-1"], "section", model, "--curvature", "-1")
        self.refused(2, ["old.column", "-9000 kN", "-6245 kN"], "section", model, "column", "--axial", "-9 MN")
        self.refused(2, ["--axis", "plane"], "section", model, "column", "--axis", "z")
        elastic = self.write("structures: {a: {frame: {sections: {s: {rectangle: [0.4, 0.4]}}}}}\n", "elastic.yaml")
        self.refused(2, ["elastic.yaml", "rc_rectangle"], "section", elastic)

    def test_the_example_of_the_documentation_is_read(self):
        page = (Path(os.environ["POUNDING_EXAMPLES"]) / "frames.md").read_text()
        (example,) = re.findall(r"(?ms)^## Fibre sections.*?^```yaml\n(.*?)^```", page)
        for command in ("check", "section"):
            done = self.pounding(command, self.write(example))
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            assert_mentions(done.stdout, ["column", "beam"])

    def test_an_elastic_run_has_the_uncracked_stiffness(self):
        done = self.pounding("check", self.write(MODEL))
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions(done.stdout, ["section column", "core: concrete02, E0 18 GPa (EN 1992-1-1: 32.31 GPa)"])
        assert_mentions(done.stderr, ["core", "44 %", "accept: [E0]"])


if __name__ == "__main__":
    unittest.main()
