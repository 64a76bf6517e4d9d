"""Yielding parts as `pounding check` reports them before any run."""

import json
import unittest

from support import ProgramTest
from messages import assert_mentions


class Check(ProgramTest):
    PORTAL = """\
structures:
  portal:
    frame:
      material: {E: 30 GPa, poisson: 0.2}
      grid: {storeys: 1, bays: 1, storey_height: 4 m, bay_width: 6 m, columns: {rectangle: [0.4 m, 0.4 m]}, beams: {rectangle: [0.4 m, 0.6 m]},
             floor_mass: 60 t}
      hinges: {HINGES}
    damping: 5 %
  left: {shear_building: {storeys: 2, mass: 200 t, stiffness: 60 MN/m, yield_force: [0.9 MN, 0.6 MN], hardening: 0.05}, damping: 5 %}
analysis: {duration: 1}
"""

    def check(self, hinges, *words):
        self.write(self.PORTAL.replace("HINGES", hinges))
        done = self.pounding("check", "model.yaml", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def found(self, hinges):
        return json.loads(self.check(hinges, "--json"))["yielding"]

    def test_tells_stiffness_rotation_and_hardening_of_hinges(self):
        ei = 30e9 * 0.4**4 / 12
        [one, *others] = self.found("columns: {at: both, yield_moment: 200 kN m, hardening: 3 %}")["portal"]["parts"]
        self.assertEqual(
            (one["name"], one["law"], one["hinge"], len(others)), ("column 1.0 start", "rigid-plastic", True, 3)
        )
        # With the other end fixed, a member resists a rotation with (4 + p)/(1 + p) EI/L, p = 12EI/(G 5/6 A L^2); the
        # spring of the plastic rotation is h = a 6EI/L/(1 - a).
        p = 12 * ei / (30e9 / 2.4 * 5 / 6 * 0.4**2 * 4**2)
        k, h = (4 + p) / (1 + p) * ei / 4, 0.03 * 6 * ei / 4 / 0.97
        for name, expected in (
            ("stiffness", k),
            ("yield_force", 200e3),
            ("yield_deformation", 200e3 / k),
            ("hardening", h / (k + h)),
        ):
            self.assertAlmostEqual(one[name] / expected, 1, delta=1e-9, msg=name)
        [one, *_] = self.found(
            "columns: {at: feet, bouc_wen: {yield_moment: 200 kN m, spring_hardening: 0.02, stiffness_factor: 10}}"
        )["portal"]["parts"]
        for name, expected in (
            ("stiffness", 60 * ei / 4),
            ("yield_deformation", 200e3 / (60 * ei / 4)),
            ("hardening", 0.02),
        ):
            self.assertAlmostEqual(one[name] / expected, 1, delta=1e-9, msg=name)

    def test_prints_the_tangent_of_member_ends_with_one_meaning_of_hardening(self):
        of_member = 6 * 30e9 * 0.4**4 / 12 / 4
        for hinges, elastic, ratio in (
            ("yield_moment: 200 kN m, hardening: 3 %", of_member, 0.03),
            ("bilinear: {yield_moment: 200 kN m, hardening: 3 %}", of_member * 10 / 11, 0.03),
            ("peak_oriented: {yield_moment: 200 kN m, hardening: 3 %, stiffness_factor: 2}", of_member * 2 / 3, 0.03),
            ("bouc_wen: {yield_moment: 200 kN m, spring_hardening: 3 %}", of_member * 10 / 11, 0.03 * 11 / 1.3),
        ):
            with self.subTest(hinges=hinges):
                self.write(self.PORTAL.replace("HINGES", f"columns: {{at: both, {hinges}}}"))
                done = self.pounding("check", "model.yaml", "--json")
                one = json.loads(done.stdout)["yielding"]["portal"]["parts"][0]
                self.assertAlmostEqual(one["end_stiffness"] / elastic, 1, delta=1e-9)
                self.assertAlmostEqual(one["end_tangent"] / (ratio * elastic), 1, delta=1e-9)
                text = self.pounding("check", "model.yaml")
                assert_mentions(
                    text.stdout,
                    [
                        "1.0",
                        "3",
                        f"{ratio * elastic / 1000000.0:.4g}",
                        f"{100 * ratio:.3g}",
                        f"{elastic / 1000000.0:.4g}",
                    ],
                )
                changed = "hinges.columns.bilinear.hardening" in text.stderr and "version 0.2.0 used 3 %" in text.stderr
                self.assertEqual(changed, hinges.startswith("bilinear"))

    def test_tells_the_strength_of_storeys_that_can_sway(self):
        [storey] = self.found("columns: {at: both, yield_moment: [200 kN m, -150 kN m]}")["portal"]["storey_mechanisms"]
        # Each column sags at one end and hogs at the other.
        self.assertAlmostEqual(storey["shear"], 2 * (200e3 + 150e3) / 4, delta=1e-6)
        [storey] = self.found("columns: {at: feet, yield_moment: 200 kN m}, beams: {at: both, yield_moment: 200 kN m}")[
            "portal"
        ]["storey_mechanisms"]
        self.assertEqual(storey, {"storey": "1", "shear": None, "elastic": "column 1.0 end"})
        text = self.check("columns: {at: both, yield_moment: 200 kN m}")
        assert_mentions(text, ["200 kN", "1", "1.0", "3"])

    def test_tells_the_yield_shear_over_the_weight_that_is_carried(self):
        parts = self.found("columns: {at: feet, yield_moment: 200 kN m}")["left"]["parts"]
        for part, expected in zip(parts, (0.9e6 / (400e3 * 9.80665), 0.6e6 / (200e3 * 9.80665)), strict=True):
            self.assertAlmostEqual(part["over_weight"], expected, delta=1e-12)
            self.assertAlmostEqual(part["hardening"], 0.05, delta=1e-12)

    def test_says_nothing_where_nothing_yields(self):
        self.write("structures: {a: {oscillator: {mass: 100 t, period: 0.5}, damping: 5 %}}\nanalysis: {duration: 1}\n")
        self.assertNotIn("yielding", json.loads(self.pounding("check", "model.yaml", "--json").stdout))


if __name__ == "__main__":
    unittest.main()
