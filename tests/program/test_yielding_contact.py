"""Contacts that yield at a force, contacts and storeys by a table: runs of the program against closed forms and numpy."""

import json
import math

import h5py
import numpy as np

from support import ProgramTest
from messages import assert_mentions

STIFFNESS, YIELD, MASS = 1e8, 2e6, 50e3


def ball(law, speed=1.5, gap="10 mm", more=""):
    """A body that runs against a wall, thrown back by a spring."""
    return (
        f"structures:\n  ball: {{body: {{mass: {MASS}}}, initial_velocity: {speed}}}\n  wall: {{wall: {{}}}}\n"
        f"links: [{{between: [ball, wall], gap: {gap}, {law}}}]\n{more}"
        "analysis: {duration: 0.3, tolerance: 1e-8, output_step: 0.5 ms}\n"
    )


def bouncing(law):
    """An oscillator that pounds on a wall several times under a harmonic motion."""
    return (
        "ground_motion: {harmonic: {amplitude: 6, period: 0.7, duration: 4}}\n"
        "structures:\n  a: {oscillator: {mass: 50 t, period: 0.6 s}, damping: 3 %}\n  wall: {wall: {}}\n"
        f"links: [{{between: [a, wall], gap: 10 mm, {law}}}]\n"
        "analysis: {duration: 4, tolerance: 1e-8, output_step: 1 ms}\n"
    )


class ElasticPpGap:
    """OpenSees' EPPGapMaterial in compression, with opposite signs; `commit` after each small step."""

    def __init__(self, gap, hardening, damage):
        self.gap, self.a, self.damage = gap, hardening, damage
        self.low, self.high = gap, gap + YIELD / STIFFNESS

    def force(self, x):
        if x > self.high:
            return YIELD + (x - self.gap - YIELD / STIFFNESS) * self.a * STIFFNESS
        return max(STIFFNESS * (x - self.low), 0.0)

    def commit(self, x):
        if x > self.high:
            self.high, self.low = x, x - self.force(x) / STIFFNESS
        elif not self.damage and self.low > x > self.gap:
            self.high, self.low = (x - self.a * self.gap) / (1 - self.a) + YIELD / STIFFNESS, x
        elif not self.damage and x <= self.gap < self.low:
            # OpenSees leaves `low` if one step jumps over the rest of the way; the limit of small steps is the gap.
            self.high, self.low = self.gap + YIELD / STIFFNESS, self.gap


class YieldingContact(ProgramTest):
    def results(self, model, name="out.h5"):
        self.write(model)
        done = self.pounding("run", "model.yaml", "--json", "-o", name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout), self.folder / name

    def test_one_impact_loses_the_plastic_work(self):
        for damage in ("true", "false"):
            for a in (0, 0.02):
                with self.subTest(damage=damage, hardening=a):
                    law = f"law: elastic_plastic_gap, stiffness: 100 MN/m, yield_force: 2 MN, hardening: {a}, damage: {damage}"
                    summary, _ = self.results(ball(law))
                    left = 0.5 * MASS * 1.5**2 - 0.5 * YIELD**2 / STIFFNESS
                    x = 2 * left / (YIELD + math.sqrt(YIELD**2 + 2 * a * STIFFNESS * left))
                    peak = YIELD + a * STIFFNESS * x
                    link = summary["links"][0]
                    self.assertEqual(link["impacts"], 1)
                    self.assertAlmostEqual(link["peak_force"] / peak, 1, delta=1e-6)
                    self.assertAlmostEqual(link["energy_lost"] / (0.5 * (YIELD + peak) * (1 - a) * x), 1, delta=1e-6)
                    self.assertLess(summary["energy"]["error"], 1e-6)

    def test_repeated_impacts_follow_the_material_of_opensees(self):
        w, m, h = 2 * math.pi / 0.6, 50e3, 2e-5
        for damage in (True, False):
            with self.subTest(damage=damage):
                law = (
                    "law: elastic_plastic_gap, stiffness: 100 MN/m, yield_force: 2 MN, hardening: 5 %, "
                    f"damage: {str(damage).lower()}"
                )
                summary, path = self.results(bouncing(law))
                with h5py.File(path) as file:
                    u = file["structures/a/displacement"][:, 0, 0]
                material, x, v, found = ElasticPpGap(0.01, 0.05, damage), 0.0, 0.0, [0.0]

                def acceleration(t, x, v):
                    return -6 * math.sin(2 * math.pi / 0.7 * t) - w * w * x - 0.06 * w * v - material.force(x) / m

                for i in range(200000):
                    t = i * h
                    k1 = acceleration(t, x, v)
                    k2 = acceleration(t + h / 2, x + h / 2 * v, v + h / 2 * k1)
                    k3 = acceleration(t + h / 2, x + h / 2 * v + h * h / 4 * k1, v + h / 2 * k2)
                    k4 = acceleration(t + h, x + h * v + h * h / 2 * k2, v + h * k3)
                    x, v = x + h * v + h * h / 6 * (k1 + k2 + k3), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
                    material.commit(x)
                    if (i + 1) % 50 == 0:
                        found.append(x)
                self.assertGreater(summary["links"][0]["impacts"], 2)
                self.assertLess(np.abs(u - found).max() / np.abs(found).max(), 2e-5)
                self.assertLess(summary["energy"]["error"], 1e-5)

    def test_a_table_is_followed_up_and_down(self):
        points = [(0, 0), (1e-3, 1e6), (5e-3, 8e6), (6e-3, 8e6)]
        law = "law: tabulated, penetration: [1 mm, 5 mm, 6 mm], force: [1 MN, 8 MN, 8 MN]"
        summary, _ = self.results(ball(law, speed=0.8))
        energy, depth = 0.5 * MASS * 0.8**2, 0.0
        for (d0, f0), (d1, f1) in zip(points, points[1:]):
            part = 0.5 * (f0 + f1) * (d1 - d0)
            if energy <= part:
                k = (f1 - f0) / (d1 - d0)
                depth = d0 + 2 * energy / (f0 + math.sqrt(f0 * f0 + 2 * k * energy))
                break
            energy -= part
        link = summary["links"][0]
        self.assertAlmostEqual(link["peak_penetration"] / depth, 1, delta=1e-6)
        self.assertAlmostEqual(link["peak_force"], np.interp(depth, *zip(*points)), delta=10)
        self.assertLess(abs(link["energy_lost"]), 1e-6 * 0.5 * MASS * 0.8**2)

    def test_storeys_and_devices_by_points_move_as_a_numpy_integration(self):
        k, m, h = 20e6, 100e3, 5e-5
        for force, storey in (("[200 kN, 300 kN]", (2e5, 3e5)), ("[200 kN, 800 kN]", (2e5, 8e5))):
            curve = f"deformation: [10 mm, 40 mm], force: {force}"
            models = {
                "storey": f"shear_building: {{storeys: 1, mass: 100 t, stiffness: 20 MN/m, spring: {{multilinear_elastic: {{{curve}}}}}}}",
                "device": "shear_building: {storeys: 1, mass: 100 t, stiffness: 1 N/m, devices: {d: {storey: 1, "
                f"multilinear_elastic: {{{curve}}}}}}}}}",
            }
            for kind, structure in models.items():
                with self.subTest(force=force, kind=kind):
                    summary, path = self.results(
                        "accept: [period]\n"
                        "ground_motion: {harmonic: {amplitude: 3, period: 0.5, duration: 3}}\n"
                        f"structures: {{a: {{{structure}, damping: 0}}}}\n"
                        "analysis: {duration: 3, tolerance: 1e-8, output_step: 10 ms}\n"
                    )
                    last = (storey[1] - storey[0]) / 0.03

                    def acceleration(t, x):
                        d = abs(x)
                        f = k * d if d < 0.01 else storey[0] + last * (d - 0.01)
                        return -3 * math.sin(4 * math.pi * t) - math.copysign(f, x) / m - (kind == "device") * x / m

                    x, v, found = 0.0, 0.0, [0.0]
                    for i in range(60000):
                        t = i * h
                        k1 = acceleration(t, x)
                        k2 = acceleration(t + h / 2, x + h / 2 * v)
                        k3 = acceleration(t + h / 2, x + h / 2 * v + h * h / 4 * k1)
                        k4 = acceleration(t + h, x + h * v + h * h / 2 * k2)
                        x, v = x + h * v + h * h / 6 * (k1 + k2 + k3), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
                        if (i + 1) % 200 == 0:
                            found.append(x)
                    with h5py.File(path) as file:
                        u = file["structures/a/displacement"][:, 0, 0]
                    self.assertGreater(np.abs(u).max(), 0.03)
                    self.assertLess(np.abs(u - found).max() / np.abs(u).max(), 2e-5)
                    self.assertEqual(summary["energy"]["hysteretic"], 0)
                    self.assertLess(summary["energy"]["error"], 1e-6)

    def test_wrong_tables_are_named_with_their_place(self):
        for law, facts in (
            ("law: tabulated, penetration: [1 mm, 1 mm], force: [1 MN, 8 MN]", ["links[0].penetration", "0.001"]),
            ("law: tabulated, penetration: [1 mm, 5 mm], force: [1 MN]", ["links[0].force", "2"]),
            ("law: tabulated, penetration: [1 mm, 5 mm]", ["links[0].law", "force"]),
            ("law: tabulated, penetration: [1 MN, 5 mm], force: [1, 2]", ["links[0].penetration[0]", "1 MN"]),
            (
                "law: elastic_plastic_gap, stiffness: 1e8, yield_force: 2 MN, hardening: 0, damage: maybe",
                ["links[0].damage", "maybe", "true", "false"],
            ),
            (
                "law: elastic_plastic_gap, stiffness: 1e8, yield_force: 2 MN, hardening: 0, damage: true, restitution: 0.5",
                ["restitution", "elastic_plastic_gap"],
            ),
        ):
            with self.subTest(law=law):
                self.write(ball(law))
                done = self.pounding("check", "model.yaml")
                self.assertEqual(done.returncode, 2)
                assert_mentions(done.stderr, facts)

    def test_a_storey_with_another_stiffness_than_its_points_is_refused(self):
        self.write(
            "structures: {a: {shear_building: {storeys: 2, mass: 1 t, stiffness: [20 MN/m, 21 MN/m], "
            "spring: {multilinear_elastic: {deformation: [10 mm], force: [200 kN]}}}, damping: 0}}\n"
            "analysis: {duration: 1}\n"
        )
        done = self.pounding("check", "model.yaml")
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, ["multilinear_elastic", "stiffness", "2e+07"])
