"""Restrainers, supports that lift off, devices between walls, and openings of joints: against closed forms and scipy."""

import importlib.util
import json
import math
import unittest

import h5py
import numpy as np
from support import ProgramTest

WITHOUT_SCIPY = importlib.util.find_spec("scipy") is None
G = 9.80665


class Restrained(ProgramTest):
    def run_model(self, model):
        """Summary and results file."""
        self.write(model)
        summary = json.loads(self.pounding("run", "model.yaml", "--json", "-o", "out.h5").stdout)
        return summary, h5py.File(self.folder / "out.h5")


def integrate(rates, state, times, margins, enter):
    """States at `times` of y' = rates(branch, t, y), in pieces between events.

    `margins(branch)` are functions of (t, y) that are positive in the branch; `enter(branch, index, t, y)` is the branch
    after the one with this index falls to zero, and the state there."""
    from scipy.integrate import solve_ivp

    branch, t, found = enter(None, None, 0.0, state), 0.0, []
    if isinstance(branch, tuple):
        branch, state = branch
    at = 0
    while at < len(times):
        events = margins(branch)
        for event in events:
            event.terminal, event.direction = True, -1
        done = solve_ivp(
            lambda s, y: rates(branch, s, y),
            (t, times[-1]),
            state,
            "DOP853",
            rtol=1e-11,
            atol=1e-14,
            events=events,
            dense_output=True,
            max_step=0.01,
        )
        end = done.t[-1]
        while at < len(times) and times[at] <= end:
            found.append(done.sol(times[at]))
            at += 1
        if at >= len(times):
            break
        index = next(i for i, hit in enumerate(done.t_events) if len(hit))
        branch, state = enter(branch, index, end, done.y[:, -1].copy())
        t = end
    return np.array(found)


class Restrainers(Restrained):
    def test_a_body_is_stopped_by_a_cable_that_yields(self):
        m, v, slack, k, strength = 1e5, 1.2, 0.03, 2e7, 6e5
        summary, file = self.run_model(
            f"""\
structures: {{a: {{body: {{mass: 100 t}}, initial_velocity: {v} m/s}}, w: {{wall: {{}}}}}}
devices: {{cable: {{between: [w, a], restrainer: {{stiffness: 20 MN/m, slack: 30 mm, strength: 600 kN}}}}}}
analysis: {{duration: 2, tolerance: 1e-7, output_step: 10 ms}}
"""
        )
        lost = 0.5 * m * v * v - 0.5 * strength**2 / k
        farthest = slack + strength / k + lost / strength
        with file:
            velocity = file["structures/a/velocity"][:, 0, 0]
        device = summary["devices"][0]
        self.assertAlmostEqual(device["elongation"]["max"] / farthest, 1, delta=1e-6)
        self.assertAlmostEqual(device["force"]["max"] / strength, 1, delta=1e-6)
        # Extremes are those of parabolas through the ends and the middle of steps.
        self.assertGreater(device["force"]["min"], -1e-6 * strength)
        self.assertAlmostEqual(summary["energy"]["hysteretic"] / lost, 1, delta=1e-6)
        self.assertAlmostEqual(velocity[-1], -strength / math.sqrt(k * m), delta=1e-6)
        self.assertLess(summary["energy"]["error"], 1e-6)

    @unittest.skipIf(WITHOUT_SCIPY, "needs scipy")
    def test_an_oscillator_on_a_cable_moves_as_an_independent_integration(self):
        m, w, slack, k, strength, a = 1e5, 2 * math.pi / 0.8, 0.02, 8e6, 2e5, 0.1
        stiffness = m * w * w
        damping = 2 * 0.05 * w * m
        hardening = a * k / (1 - a)

        def ground(t):
            return 3 * math.sin(2 * math.pi * t / 0.7)

        # The state contains the yielded elongation.
        def rates(branch, t, y):
            u, v, p = y
            stretch = u - slack - p
            force = 0 if branch == "slack" else k * stretch
            acceleration = -ground(t) - (stiffness * u + damping * v + force) / m
            # k (v - p') = H p'
            return [v, acceleration, v * k / (k + hardening) if branch == "yields" else 0]

        def margins(branch):
            def taut(t, y):
                return slack + y[2] - y[0]

            def loose(t, y):
                return y[0] - slack - y[2]

            def yields(t, y):
                return strength + hardening * y[2] - k * (y[0] - slack - y[2])

            def turns(t, y):
                return y[1]

            return {"slack": [taut], "elastic": [loose, yields], "yields": [turns]}[branch]

        def enter(branch, index, t, y):
            if branch is None:
                return "slack"
            if branch == "elastic":
                return ("slack", "yields")[index], y
            return "elastic", y

        summary, file = self.run_model(
            """\
ground_motion: {harmonic: {amplitude: 3, period: 0.7, duration: 6}}
structures: {a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}, w: {wall: {}}}
devices:
  cable:
    between: [w, a]
    restrainer: {stiffness: 8 MN/m, slack: 20 mm, strength: 200 kN, hardening: 10 %}
analysis: {duration: 6, tolerance: 1e-8, output_step: 10 ms}
"""
        )
        with file:
            time, found = file["time"][:], file["structures/a/displacement"][:, 0, 0]
            force = file["devices/cable/force"][:]
        expected = integrate(rates, [0.0, 0.0, 0.0], time, margins, enter)
        self.assertGreater(expected[-1, 2], 0.01, "it yields")
        largest = np.abs(expected[:, 0]).max()
        self.assertLess(np.abs(found - expected[:, 0]).max() / largest, 1e-6)
        tension = np.maximum(0, k * (expected[:, 0] - slack - expected[:, 2]))
        self.assertLess(np.abs(force - tension).max() / strength, 1e-5)
        self.assertLess(summary["energy"]["error"], 1e-6)

    def test_a_cable_inside_a_building_limits_the_storey(self):
        """A taut elastic cable is a spring in one direction: half a period of each stiffness."""
        m, k, v = 1e5, 1e7, 0.5
        summary, file = self.run_model(
            f"""\
structures:
  a:
    shear_building:
      {{storeys: 1, mass: 100 t, stiffness: 10 MN/m, devices: {{tie: {{storey: 1, restrainer: {{stiffness: 30 MN/m, slack: 0}}}}}}}}
    damping: 0
    initial_velocity: {v}
analysis: {{duration: 2, tolerance: 1e-8, output_step: 5 ms}}
"""
        )
        stiff, soft = math.sqrt((k + 3e7) / m), math.sqrt(k / m)
        with file:
            time, found = file["time"][:], file["structures/a/displacement"][:, 0, 0]
        late = time % (math.pi / stiff + math.pi / soft)
        expected = np.where(
            late < math.pi / stiff,
            v / stiff * np.sin(stiff * late),
            -v / soft * np.sin(soft * (late - math.pi / stiff)),
        )
        self.assertLess(np.abs(found - expected).max(), 1e-6 * v / soft)

    def test_hardening_needs_a_strength(self):
        self.write(
            """\
structures: {a: {body: {mass: 100 t}, initial_velocity: 1}, w: {wall: {}}}
devices: {cable: {between: [w, a], restrainer: {stiffness: 20 MN/m, slack: 30 mm, hardening: 5 %}}}
analysis: {duration: 1}
"""
        )
        self.refused(2, ["model.yaml:2", "hardening", "strength"], "run", "model.yaml")


class Walls(Restrained):
    def test_a_bar_between_two_walls_follows_their_motion(self):
        w, v = 2 * math.pi / 0.5, 2 * math.pi / 0.8
        summary, file = self.run_model(
            """\
structures:
  a: {oscillator: {mass: 100 t, period: 0.5, damping: 5 %}}
  west: {wall: {}, ground_motion: {harmonic: {amplitude: 2, period: 0.5, duration: 2}}}
  east: {wall: {}, ground_motion: {harmonic: {amplitude: 3, period: 0.8, duration: 2}}}
ground_motion: {harmonic: {amplitude: 1, period: 0.5, duration: 2}}
devices: {strut: {between: [west, east], bar: {stiffness: 50 MN/m}}}
analysis: {duration: 2, tolerance: 1e-6, output_step: 10 ms}
"""
        )
        with file:
            time, found = file["time"][:], file["devices/strut/elongation"][:]
            force = file["devices/strut/force"][:]
        expected = 3 / v**2 * (v * time - np.sin(v * time)) - 2 / w**2 * (w * time - np.sin(w * time))
        self.assertLess(np.abs(found - expected).max() / np.abs(expected).max(), 1e-9)
        np.testing.assert_allclose(force, 5e7 * found, rtol=1e-12)
        self.assertLess(summary["energy"]["error"], 1e-6)

    def test_a_link_between_two_walls_is_refused(self):
        self.write(
            """\
structures: {a: {body: {mass: 100 t}, initial_velocity: 1}, w: {wall: {}}, e: {wall: {}}}
links: [{between: [w, e], gap: 10 mm, law: linear_spring, stiffness: 1e9}]
analysis: {duration: 1}
"""
        )
        self.refused(2, ["model.yaml:2", "device"], "run", "model.yaml")


class Openings(Restrained):
    MODEL = """\
structures:
  a: {{oscillator: {{mass: 100 t, period: 0.8}}, damping: 0, initial_velocity: 0.5 m/s}}
  w: {{wall: {{}}}}
links: [{{between: [w, a], gap: 20 mm, law: linear_spring, stiffness: 1e9, name: joint{seat}}}]
analysis: {{duration: 0.5, tolerance: 1e-8}}
"""

    def test_the_largest_opening_is_the_displacement_away_from_the_wall(self):
        largest = 0.5 * 0.8 / (2 * math.pi)
        for seat, falls in ("", False), (", seat: 60 mm", True), (", seat: 65 mm", False):
            with self.subTest(seat=seat):
                summary, file = self.run_model(self.MODEL.format(seat=seat))
                [link] = summary["links"]
                self.assertAlmostEqual(link["largest_opening"], largest, delta=1e-7)
                self.assertAlmostEqual(link["t_opening"], 0.2, delta=1e-5)
                self.assertEqual(link["unseated"], falls)
                self.assertEqual(any("seat" in text for text in summary["warnings"]), falls)
                self.assertEqual(link["seat"] is None, not seat)
                with file:
                    at = file["links/joint"].attrs
                    self.assertEqual(at["largest_opening"], link["largest_opening"])
                    self.assertEqual(at["t_opening"], link["t_opening"])
                    self.assertEqual(math.isnan(at["seat"]), not seat)
                text = self.pounding("run", "model.yaml").stdout
                self.assertIn("63.66", text)
                self.assertEqual("unseated" in text, falls)

    def test_permanent_indentation_does_not_count_as_opening(self):
        """A ball between two walls that crush: it opens one joint by the gap and penetration of the other."""
        summary, file = self.run_model(
            """\
structures: {ball: {body: {mass: 50 t}, initial_velocity: 1 m/s}, west: {wall: {}}, east: {wall: {}}}
links:
  - {between: [west, ball], name: west, gap: 10 mm, law: elastoplastic, stiffness: 3e8, exponent: 1, restitution: 0.5}
  - {between: [ball, east], name: east, gap: 30 mm, law: elastoplastic, stiffness: 3e8, exponent: 1, restitution: 0.5}
analysis: {duration: 0.5, tolerance: 1e-8}
"""
        )
        with file:
            rows = file["impacts"][()]
        west, east = summary["links"]
        self.assertGreater(len(rows), 2)
        depth = {}
        for row in rows:
            depth.setdefault(row["link"], row["peak_penetration"])
        first_east, first_west = list(depth.values())[:2]
        self.assertAlmostEqual(west["largest_opening"], 0.03 + first_east, delta=1e-7)
        self.assertAlmostEqual(east["largest_opening"], 0.01 + first_west, delta=1e-7)

    def test_a_seat_is_positive(self):
        self.write(self.MODEL.format(seat=", seat: -1 mm"))
        self.refused(2, ["model.yaml:4", "seat"], "run", "model.yaml")


class Uplift(Restrained):
    COLUMN = """\
ground_motion: {{components: {{z: {{harmonic: {{amplitude: 14, period: 0.31, duration: 3}}}}}}}}
structures:
  a:
    frame:
      material: {{E: 1e10}}
      nodes: {{foot: [0, 0], top: [0, 3 m]}}
      members: {{column: {{between: [foot, top], section: {{area: 0.03 m^2, inertia_y: 1e-4 m^4}}}}}}
      supports: {{foot: {{fix: [ux, ry]}}, top: {{fix: [ux, ry]}}}}
      masses: {{foot: 20 t, top: 80 t}}
      springs: [{{node: foot, dof: uz, stiffness: {stiffness}, acts_in: {acts_in}}}]
      gravity: {gravity}
    damping: 0
analysis: {{duration: 3, tolerance: 1e-8, output_step: 10 ms}}
"""

    @unittest.skipIf(WITHOUT_SCIPY, "needs scipy")
    def test_a_column_bounces_on_its_support(self):
        k, member, m, top = 2e8, 1e10 * 0.03 / 3, 2e4, 8e4
        lifts = (m + top) * G / k

        def ground(t):
            return 14 * math.sin(2 * math.pi * t / 0.31)

        def rates(branch, t, y):
            z, u, v, w = y
            support = k * z if branch == "down" else (m + top) * G
            column = member * (z - u)
            return [v, w, -ground(t) - (support + column) / m, -ground(t) + column / top]

        def margins(branch):
            return [(lambda t, y: lifts - y[0]) if branch == "down" else (lambda t, y: y[0] - lifts)]

        def enter(branch, index, t, y):
            return "down" if branch is None else ("up" if branch == "down" else "down", y)

        summary, file = self.run_model(self.COLUMN.format(stiffness="200 MN/m", acts_in="compression", gravity="true"))
        with file:
            time, found = file["time"][:], file["structures/a/nodes/displacement"][:, :, 1]
            reaction = file["structures/a/reactions/force"][:, 0, 1]
        found = found - found[0]  # under gravity
        expected = integrate(rates, np.zeros(4), time, margins, enter)[:, :2]
        self.assertGreater(expected[:, 0].max(), 3 * lifts)
        largest = np.abs(expected).max()
        self.assertLess(np.abs(found - expected).max() / largest, 1e-5)
        self.assertLess(summary["energy"]["error"], 1e-6)
        # The ground never pulls.
        np.testing.assert_allclose(
            reaction, np.maximum(0, (m + top) * G - k * expected[:, 0]), atol=1e-4 * reaction.max()
        )

    @unittest.skipIf(WITHOUT_SCIPY, "needs scipy")
    def test_a_rigid_block_rocks_on_two_supports(self):
        b, h, k, kx = 1.0, 4.0, 1e8, 4e6
        masses = {"left": (2e3, -b, 0.0), "right": (2e3, b, 0.0), "top": (6e4, 0.0, h)}
        summary, file = self.run_model(
            """\
ground_motion: {harmonic: {amplitude: 4, period: 0.9, duration: 2.7}}
structures:
  block:
    frame:
      material: {E: 30 GPa}
      nodes: {left: [-1 m, 0], right: [1 m, 0], top: [0, 4 m]}
      members: {base: {between: [left, right], section: {rectangle: [0.5 m, 0.5 m]}}}
      ties: [{master: top, nodes: [left, right], rigid: true}]
      masses: {left: 2 t, right: 2 t, top: 60 t}
      springs:
        - {node: left, dof: uz, stiffness: 100 MN/m, acts_in: compression}
        - {node: right, dof: uz, stiffness: 100 MN/m, acts_in: compression}
        - {node: left, dof: ux, stiffness: 2 MN/m}
        - {node: right, dof: ux, stiffness: 2 MN/m}
      gravity: true
    damping: 0
analysis: {duration: 2.7, tolerance: 1e-8, output_step: 10 ms}
"""
        )
        # Rows of the displacements of each node: x, z and the rotation ry of the top, positive from z to x.
        rows = {name: (np.array([1, 0, z - h]), np.array([0, 1, -x])) for name, (_, x, z) in masses.items()}
        mass = sum(m * (np.outer(r, r) + np.outer(s, s)) for (m, _, _), (r, s) in zip(masses.values(), rows.values()))
        along = sum(m * r for (m, _, _), (r, _) in zip(masses.values(), rows.values()))
        sway = kx * np.outer(rows["left"][0], rows["left"][0])
        preload = sum(m for m, _, _ in masses.values()) * G / 2
        lifts = preload / k
        inverse = np.linalg.inv(mass)

        def rates(branch, t, y):
            q, v = y[:3], y[3:]
            force = sway @ q + along * 4 * math.sin(2 * math.pi * t / 0.9)
            for side, is_down in zip(("left", "right"), branch):
                force = force + rows[side][1] * (k * (rows[side][1] @ q) if is_down else preload)
            return [*v, *(-inverse @ force)]

        def margins(branch):
            def margin(side, is_down):
                return lambda t, y: (lifts - rows[side][1] @ y[:3]) * (1 if is_down else -1)

            return [margin(side, is_down) for side, is_down in zip(("left", "right"), branch)]

        def enter(branch, index, t, y):
            if branch is None:
                return (True, True), y
            return tuple(down != (i == index) for i, down in enumerate(branch)), y

        with file:
            time = file["time"][:]
            names = [name.decode() for name in file["structures/block/nodes/names"]]
            found = file["structures/block/nodes/displacement"][:, names.index("top"), :]
        found = found - found[0]  # under gravity
        expected = integrate(rates, np.zeros(6), time, margins, enter)[:, :3]
        tipped = expected @ rows["left"][1]
        self.assertGreater(np.abs(tipped).max(), 2 * lifts)
        self.assertLess(np.abs(found - expected).max() / np.abs(expected).max(), 1e-5)
        self.assertLess(summary["energy"]["error"], 1e-6)

    def test_without_load_or_mass_it_is_refused(self):
        for change, mentions in (
            ({"gravity": "false"}, ("gravity", "support foot")),
            ({"acts_in": "tension"}, ("compression", "tension")),
        ):
            with self.subTest(change=change):
                options = {"stiffness": "200 MN/m", "acts_in": "compression", "gravity": "true", **change}
                self.write(self.COLUMN.format(**options))
                self.refused(2, ["model.yaml:10", *mentions], "run", "model.yaml")
        options = {"stiffness": "200 MN/m", "acts_in": "compression", "gravity": "true"}
        self.write(self.COLUMN.format(**options).replace("foot: 20 t, ", ""))
        self.refused(2, ["model.yaml:10", "mass"], "run", "model.yaml")


if __name__ == "__main__":
    unittest.main()
