"""Yielding OpenSees models converted to pounding: hinges, members with plastic lengths, devices, walls with backfill.

OpenSees uses Newmark and Newton: its error decreases with the step, relative to the program at a tolerance of 1e-7.
Damping is proportional to mass only, since OpenSees' stiffness-proportional damping excludes the springs.
"""

import math
import unittest

import numpy as np

try:
    import openseespy.opensees as ops
except ImportError as error:
    raise unittest.SkipTest(f"openseespy is not installed: {error}") from error

import pounding
from opensees_models import newmark
from messages import raises

A0 = 0.4  # of Rayleigh [1/s]
DURATION, AMPLITUDE, PERIOD = 2.4, 5.0, 0.55
SECTION = (0.09, 30e9, 6.75e-4)  # A, E, I
FY, K = 1.2e5, 1.2e8  # of hinges [N m], [N m/rad]
MATERIALS = {
    "bilinear": ("Steel01", FY, K, 0.02),
    "elastic-plastic": ("ElasticPP", K, FY / K),
    "menegotto_pinto": ("Steel02", FY, K, 0.02, 18.5, 0.925, 0.15),
    "bouc_wen": ("BoucWen", 0.05, K, 2.0, 0.4 * (K / FY) ** 2, 0.6 * (K / FY) ** 2, 1.0, 0.0, 0.0, 0.0),
    "peak_oriented": (
        "Hysteretic",
        FY,
        FY / K,
        1.4 * FY,
        21 * FY / K,
        -FY,
        -FY / K,
        -1.4 * FY,
        -21 * FY / K,
        1.0,
        1.0,
        0.0,
        0.0,
        0.0,
    ),
}


def portal(hinge=None, x=0.0, first=0, stiffer=1.0):
    """A portal of 6 m and 3.5 m; nodes 1 to 4 from the left foot to the right one, with hinges of this material at its
    feet and at both ends of the beam. Two at a joint could both lose their stiffness and leave it unsupported."""
    for tag, (dx, y) in enumerate(((0, 0), (0, 3.5), (6, 3.5), (6, 0)), first + 1):
        ops.node(tag, x + dx, y)
    for foot in (first + 1, first + 4):
        ops.fix(foot, 1, 1, 1)
    for top in (first + 2, first + 3):
        ops.mass(top, 2e4, 2e4, 0.0)
    area, e, inertia = SECTION
    for i, (a, b) in enumerate(((1, 2), (2, 3), (4, 3)), first + 1):
        ends = [first + a, first + b]
        if hinge is not None:
            for side, node in enumerate(ends if b == 3 and a == 2 else ends[:1]):
                inner = 10 * (10 * i + side) + 1
                ops.node(inner, *ops.nodeCoord(node))
                ops.equalDOF(node, inner, 1, 2)
                ops.element("zeroLength", inner, node, inner, "-mat", hinge, "-dir", 6)
                ends[side] = inner
        ops.element("elasticBeamColumn", i, *ends, area, e * stiffer, inertia, 1)


def plane():
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)


def shaken():
    """Adds mass damping and a harmonic ground motion to the current model."""
    ops.rayleigh(A0, 0.0, 0.0, 0.0)
    ops.timeSeries("Trig", 1, 0.0, DURATION + 1, PERIOD, "-factor", AMPLITUDE)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)


def histories(step, nodes):
    """Displacements along x every 10 ms by Newmark [time, node]."""
    newmark(increment=1e-10)
    rows = []
    for _ in range(round(DURATION / 0.01)):
        for _ in range(round(0.01 / step)):
            if ops.analyze(1, step):
                raise RuntimeError(f"OpenSees stopped at {ops.getTime()} s")
        rows.append([ops.nodeDisp(node, 1) for node in nodes])
    return np.array(rows)


def ours(**words):
    return pounding.from_opensees(
        rayleigh=(A0, 0.0),
        ground_motion={"harmonic": {"amplitude": AMPLITUDE, "period": PERIOD, "duration": DURATION + 1}},
        analysis={"duration": DURATION, "tolerance": "1e-7", "output_step": "10 ms"},
        **words,
    )


def of_springs(springs):
    """Largest deformation of each spring relative to its yield deformation."""
    return np.abs(springs.largest["peak_deformation"]) / springs.yield_deformation


class Yielding(unittest.TestCase):
    def compare(self, build, nodes, limit, step=5e-4, order=1.6):
        """The models of pounding and OpenSees agree: errors of OpenSees decrease with its step. `nodes`: those of
        OpenSees by structure."""
        build()
        shaken()
        run = pounding.run(ours())
        got = np.column_stack(
            [
                run.structures[name].nodes.displacement[1:, list(run.structures[name].nodes.names).index(f"n{tag}"), 0]
                for name, tags in nodes.items()
                for tag in tags
            ]
        )

        def error(of):
            build()
            shaken()
            theirs = histories(of, [tag for tags in nodes.values() for tag in tags])
            return np.abs(theirs - got).max() / np.abs(got).max()

        coarse, fine = error(2 * step), error(step)
        self.assertLess(fine, limit)
        self.assertGreater(coarse, order * fine)
        return run

    def test_hinges_of_every_law_answer_an_earthquake_as_in_opensees(self):
        for law, material in MATERIALS.items():
            with self.subTest(law):

                def build(material=material):
                    plane()
                    ops.uniaxialMaterial(material[0], 1, *material[1:])
                    portal(hinge=1)

                run = self.compare(build, {"frame1": [3]}, 1e-3)
                self.assertGreater(max(of_springs(run.structures["frame1"].springs)), 2.5)
                ops.wipe()
                build()
                [frame] = pounding.from_opensees(analysis={"duration": 1}).structures.values()
                for hinge in frame["frame"]["hinges"].values():
                    [numbers] = [value for value in hinge.values() if isinstance(value, dict)]
                    self.assertIn("spring_hardening", numbers)

    def test_members_with_plastic_lengths_yield_as_in_opensees(self):
        area, e, inertia = SECTION

        def build():
            plane()
            for node, x, y in ((1, 0, 0), (2, 0, 3.5), (3, 6, 3.5), (4, 6, 0)):
                ops.node(node, x, y)
            for foot in (1, 4):
                ops.fix(foot, 1, 1, 1)
            for top in (2, 3):
                ops.mass(top, 2e4, 2e4, 0.0)
            ops.uniaxialMaterial("Elastic", 1, e * area)
            ops.uniaxialMaterial("Steel01", 2, FY, e * inertia, 0.03)
            ops.section("Elastic", 1, e, area, inertia)
            ops.section("Aggregator", 2, 1, "P", 2, "Mz")
            ops.beamIntegration("HingeRadau", 1, 2, 0.35, 1, 0.3, 1)
            ops.beamIntegration("HingeRadau", 2, 2, 0.4, 2, 0.4, 1)
            for member, (a, b), integration in ((1, (1, 2), 1), (2, (2, 3), 2), (3, (4, 3), 1)):
                ops.element("forceBeamColumn", member, a, b, 1, integration)

        run = self.compare(build, {"frame1": [3]}, 1e-4)
        springs = run.structures["frame1"].springs
        self.assertEqual(springs.names, ["e1 start", "e2 start", "e2 end", "e3 start"])
        self.assertGreater(min(springs.largest["peak_plastic"]), 5e-3)

    def test_hinges_about_two_axes_yield_as_in_opensees(self):
        area, e, inertia = SECTION

        def build():
            ops.wipe()
            ops.model("basic", "-ndm", 3, "-ndf", 6)
            ops.geomTransf("Linear", 1, 1.0, 0.0, 0.0)
            for node, z in ((1, 0.0), (11, 0.0), (2, 3.5)):
                ops.node(node, 0.0, 0.0, z)
            ops.fix(1, *6 * [1])
            ops.mass(2, 2e4, 2.5e4, 2e4, 0.0, 0.0, 1e2)
            ops.equalDOF(1, 11, 1, 2, 3, 6)
            ops.uniaxialMaterial("Steel01", 1, FY, K, 0.02)
            ops.element("zeroLength", 5, 1, 11, "-mat", 1, 1, "-dir", 4, 5)
            ops.element("elasticBeamColumn", 1, 11, 2, area, e, 12e9, 1e-3, inertia, 1.6 * inertia, 1)
            ops.timeSeries("Trig", 2, 0.0, DURATION + 1, 0.8, "-factor", 3.0)
            ops.pattern("UniformExcitation", 2, 2, "-accel", 2)

        build()
        ops.rayleigh(A0, 0.0, 0.0, 0.0)
        ops.timeSeries("Trig", 1, 0.0, DURATION + 1, PERIOD, "-factor", AMPLITUDE)
        ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
        model = pounding.from_opensees(
            rayleigh=(A0, 0.0),
            analysis={"duration": DURATION, "tolerance": "1e-7", "output_step": "10 ms"},
            ground_motion={
                "components": {
                    name: {"harmonic": {"amplitude": amplitude, "period": period, "duration": DURATION + 1}}
                    for name, amplitude, period in (("x", AMPLITUDE, PERIOD), ("y", 3.0, 0.8))
                }
            },
        )
        hinges = model.structures["frame1"]["frame"]["hinges"]
        self.assertEqual((hinges["e1"]["at"], hinges["e1"]["axis"]), ("start", "both"))
        run = pounding.run(model)
        nodes = run.structures["frame1"].nodes
        got = nodes.displacement[1:, list(nodes.names).index("n2"), :2]
        newmark()
        theirs = []
        for _ in range(len(got)):
            self.assertEqual(ops.analyze(20, 5e-4), 0)
            theirs.append([ops.nodeDisp(2, 1), ops.nodeDisp(2, 2)])
        np.testing.assert_allclose(theirs, got, rtol=0, atol=2e-4 * np.abs(got).max())
        self.assertGreater(min(of_springs(run.structures["frame1"].springs)), 2)

    def test_bars_and_dampers_within_a_frame_and_between_two_act_as_in_opensees(self):
        def build():
            plane()
            portal()
            portal(x=6.5, first=20, stiffer=4.0)
            ops.uniaxialMaterial("Steel01", 1, 40e3, 8e6, 0.05)
            ops.uniaxialMaterial("Elastic", 2, 3e6, 2e4)
            ops.uniaxialMaterial("Viscous", 3, 6e4, 1.0)
            ops.uniaxialMaterial("Steel01", 4, 250e6, 200e9, 0.01)
            ops.element("twoNodeLink", 51, 1, 3, "-mat", 1, "-dir", 1)
            ops.element("twoNodeLink", 52, 21, 23, "-mat", 2, "-dir", 1)
            ops.element("twoNodeLink", 53, 3, 22, "-mat", 3, "-dir", 1)
            ops.element("truss", 54, 24, 22, 1.5e-4, 4)

        build()
        model = pounding.from_opensees(analysis={"duration": 1})
        self.assertEqual(
            model.structures["left"]["frame"]["devices"],
            {"d51": {"between": ["n1", "n3"], "bilinear": {"stiffness": 8e6, "yield_force": 40e3, "hardening": 0.05}}},
        )
        self.assertEqual(
            model.structures["right"]["frame"]["devices"]["d52"],
            {"between": ["n21", "n23"], "bar": {"stiffness": 3e6}, "damper": {"coefficient": 2e4}},
        )
        length = math.hypot(6, 3.5)
        np.testing.assert_allclose(
            list(model.structures["right"]["frame"]["devices"]["d54"]["bilinear"].values()),
            [200e9 * 1.5e-4 / length, 250e6 * 1.5e-4, 0.01],
            rtol=1e-15,
        )
        self.assertEqual(
            model.devices,
            {
                "d53": {
                    "between": [{"structure": "left", "node": "n3"}, {"structure": "right", "node": "n22"}],
                    "damper": {"coefficient": 6e4},
                }
            },
        )
        run = self.compare(build, {"left": [3], "right": [22]}, 1e-3)
        self.assertGreater(max(run.structures["left"].springs.largest["ductility"]), 1.5)

    def test_a_wall_with_backfill_is_pressed_as_in_opensees(self):
        def build():
            plane()
            portal()
            ops.node(9, 6.0, 3.5)
            ops.fix(9, 1, 1, 1)
            ops.uniaxialMaterial("HyperbolicGapMaterial", 1, 30e6, 60e6, 0.7, -4e5, -0.02)
            ops.element("zeroLength", 51, 3, 9, "-mat", 1, "-dir", 1)

        build()
        [link] = pounding.from_opensees(analysis={"duration": 1}).links
        self.assertEqual(
            link,
            {
                "between": [{"structure": "frame1", "node": "n3"}, "wall51"],
                "gap": 0.02,
                "law": "backfill",
                "stiffness": 30e6,
                "unloading": 60e6,
                "failure_ratio": 0.7,
                "strength": 4e5,
            },
        )
        run = self.compare(build, {"frame1": [3]}, 2e-3, order=1.3)
        self.assertGreater(len(run.impacts), 1)

    def test_a_contact_that_yields_is_pressed_as_in_opensees(self):
        for damage in ("damage", "noDamage"):
            with self.subTest(damage):

                def build():
                    plane()
                    portal()
                    ops.node(9, 6.0, 3.5)
                    ops.fix(9, 1, 1, 1)
                    ops.uniaxialMaterial("ElasticPPGap", 1, 30e6, -2e5, -0.02, 0.125, damage)
                    ops.element("zeroLength", 51, 3, 9, "-mat", 1, "-dir", 1)

                build()
                [link] = pounding.from_opensees(analysis={"duration": 1}).links
                self.assertEqual(
                    link,
                    {
                        "between": [{"structure": "frame1", "node": "n3"}, "wall51"],
                        "gap": 0.02,
                        "law": "elastic_plastic_gap",
                        "stiffness": 30e6,
                        "yield_force": 2e5,
                        "hardening": 0.125,
                        "damage": damage == "damage",
                    },
                )
                run = self.compare(build, {"frame1": [3]}, 2e-3, order=1.3)
                self.assertGreater(len(run.impacts), 1)

    def test_the_material_of_a_contact_that_yields_has_the_force_of_its_law(self):
        turns = (0.05, 0.031, 0.06, 0.04, 0.035, 0.07, 0.02, 0.09)
        path = np.concatenate([np.linspace(a, b, 4001)[1:] for a, b in zip((0.0,) + turns, turns)])
        for flag in (True, False):
            with self.subTest(damage=flag):
                ops.wipe()
                ops.uniaxialMaterial("ElasticPPGap", 1, 1e8, -2e6, -1e-9, 0.1, "damage" if flag else "noDamage")
                ops.testUniaxialMaterial(1)
                forces = []
                for x in path:
                    ops.setStrain(-x)
                    forces.append(-ops.getStress())
                law = pounding.laws["elastic_plastic_gap"](stiffness=1e8, yield_force=2e6, hardening=0.1, damage=flag)
                found = law.force(path, np.ones_like(path), in_order=True)
                # The gap of 1 nm shifts the force by 0.1 N.
                np.testing.assert_allclose(found, forces, rtol=0, atol=0.3)
                self.assertGreater(np.count_nonzero(found == 0), 100)

    def test_a_nonlinear_elastic_device_pulls_as_in_opensees(self):
        def build():
            plane()
            portal()
            ops.node(9, 0.0, 3.5)
            ops.fix(9, 1, 1, 1)
            strain, stress = (-0.04, -0.01, 0.0, 0.01, 0.04), (-7e5, -4e5, 0.0, 4e5, 7e5)
            ops.uniaxialMaterial("ElasticMultiLinear", 1, 0.0, "-strain", *strain, "-stress", *stress)
            ops.element("zeroLength", 52, 9, 3, "-mat", 1, "-dir", 1)

        build()
        model = pounding.from_opensees(analysis={"duration": 1})
        law = {"deformation": [-0.04, -0.01, 0.0, 0.01, 0.04], "force": [-7e5, -4e5, 0.0, 4e5, 7e5]}
        self.assertIn(
            {"multilinear_elastic": law},
            [
                {"multilinear_elastic": device.get("multilinear_elastic")}
                for structure in model.structures.values()
                for device in (structure.get("frame", {}).get("devices") or model.devices or {}).values()
            ],
        )

    def refused(self, message):
        with self.subTest(message), raises(pounding.InputError, message):
            pounding.from_opensees(analysis={"duration": 1})

    def test_what_yields_otherwise_is_named(self):
        def frame(*material):
            plane()
            ops.uniaxialMaterial(material[0], 1, *material[1:])
            portal(hinge=1)

        frame("Steel01", FY, K, 0.02, 0.1, 10.0, 0.1, 10.0)
        self.refused(["Steel01", "a1", "0"])
        frame("Hysteretic", *MATERIALS["peak_oriented"][1:-1], 0.5)
        self.refused(["0", "beta", "5"])
        frame(
            "Hysteretic",
            FY,
            FY / K,
            1.4 * FY,
            21 * FY / K,
            -0.8 * FY,
            -FY / K,
            -1.4 * FY,
            -21 * FY / K,
            1.0,
            1.0,
            0.0,
            0.0,
            0.0,
        )
        self.refused([])
        frame(
            "Hysteretic",
            0.4 * FY,
            0.4 * FY / K,
            FY,
            3 * FY / K,
            1.1 * FY,
            21 * FY / K,
            -0.4 * FY,
            -0.4 * FY / K,
            -FY,
            -3 * FY / K,
            -1.1 * FY,
            -21 * FY / K,
            1.0,
            1.0,
            0.0,
            0.0,
            0.0,
        )
        self.refused([])
        frame("BoucWen", 0.05, K, 2.0, 1e3, 1e3, 0.5, 0.0, 0.0, 0.0)
        self.refused(["0", "Ao", "5"])
        frame("ENT", K)
        self.refused(["ENTMaterial", "Steel01", "Steel02"])

        def loose(*words):
            plane()
            portal()
            ops.uniaxialMaterial("Steel01", 1, FY, K, 0.02)
            ops.node(9, 0.0, 3.5)
            ops.element("zeroLength", 51, 2, 9, "-mat", 1, "-dir", 6, *words)

        loose()
        self.refused(["51", "2", "9"])
        ops.equalDOF(2, 9, 1, 2)
        self.refused("51")
        loose("-orient", 0.0, 1.0, 0.0, -1.0, 0.0, 0.0)
        self.refused("51")
        frame("Steel01", FY, K, 0.02)
        ops.uniaxialMaterial("Steel01", 2, 2 * FY, K, 0.02)
        ops.node(9, 6.0, 3.5)
        ops.equalDOF(3, 9, 1, 2)
        ops.remove("element", 3)
        ops.element("elasticBeamColumn", 3, 301, 9, *SECTION, 1)
        ops.element("zeroLength", 51, 3, 9, "-mat", 2, "-dir", 6)
        self.refused("3")

    def test_periods_are_those_with_the_springs(self):
        plane()
        ops.uniaxialMaterial("Steel01", 1, FY, K, 0.02)
        portal(hinge=1)
        [modes] = pounding.modes(ours()).values()
        wanted = [2 * math.pi / math.sqrt(x) for x in ops.eigen("-fullGenLapack", 2)]
        np.testing.assert_allclose([mode.period for mode in modes[:2]], wanted, rtol=1e-11)


if __name__ == "__main__":
    unittest.main()
