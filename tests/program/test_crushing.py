"""Time integration of a crushing contact, compared with the second integrator and with closed forms of its memory."""

import importlib.util
import json
import math
import unittest

import h5py

from book import Book
from support import ProgramTest

WITHOUT_SCIPY = importlib.util.find_spec("scipy") is None
OSCILLATORS = """\
ground_motion: {{harmonic: {{amplitude: 3.0, period: 0.6, duration: 3.0}}}}
structures:
  left:  {{oscillator: {{mass: 100 t, period: 0.8, damping: 5 %}}}}
  right: {{oscillator: {{mass: 150 t, period: 0.4, damping: 5 %}}}}
links: [{{between: [left, right], gap: 20 mm, law: elastoplastic, stiffness: 2.75e9, restitution: {restitution}}}]
analysis: {{duration: 3.0, tolerance: 1e-7}}
"""
#: A ball bounces between two walls; a second one follows it and hits it from behind.
BALL = """\
structures:
  ball: {{body: {{mass: 50 t}}, initial_velocity: {first}}}
  late: {{body: {{mass: 50 t}}, initial_velocity: {second}}}
  wall: {{wall: {{}}}}
links:
  - {{between: [ball, wall], gap: 10 mm, law: elastoplastic, stiffness: 3e9, exponent: 1, restitution: 0.6, name: wall}}
  - {{between: [late, ball], gap: 100 mm, law: stereomechanical, restitution: 1, name: swap}}
analysis: {{duration: {duration}, tolerance: 1e-7}}
"""


class Crushing(ProgramTest):
    def impacts(self, model):
        """Rows of the impacts, and the summary."""
        self.write(model)
        summary = json.loads(self.pounding("run", "model.yaml", "--json", "-o", "out.h5").stdout)
        with h5py.File(self.folder / "out.h5") as file:
            return file["impacts"][()], summary

    @unittest.skipIf(WITHOUT_SCIPY, "needs scipy")
    def test_two_oscillators_as_the_second_integrator_has_them(self):
        import independent
        import judging

        book = Book(
            self,
            "Elastoplastic contact: crushing, memory",
            "an independent integration with DOP853 (relative tolerance 1e-11), each branch of the law between located instants",
            "run at tolerance 1e-7, errors that impacts amplify",
        )
        for restitution in (0.4, 0.65):
            w = [2 * math.pi / 0.8, 2 * math.pi / 0.4]
            masses = [(m, m * x * x, 0.1 * m * x, 0.0, 0.0) for m, x in zip((1e5, 1.5e5), w)]
            ground, corners, longest = judging.ground_of(
                {"kind": "harmonic", "amplitude": 3.0, "period": 0.6, "duration": 3.0}
            )
            law = independent.Law(
                "elastoplastic", {"law": "elastoplastic", "stiffness": 2.75e9, "restitution": restitution}
            )
            row = independent.Row(masses, [independent.Link(0, 1, 0.02, law)], ground, corners, longest)
            row.run(3.0)
            expected = row.links[0].impacts
            rows, summary = self.impacts(OSCILLATORS.format(restitution=restitution))
            book.equal("impacts [-]", len(rows), len(expected))
            largest = max(impact.peak for impact in expected)
            for obtained, impact in zip(rows, expected):
                book.near("touch [s]", obtained["t_start"], impact.start, 1e-6)
                book.near(
                    "peak force over the largest one [-]", obtained["peak_force"] / largest, impact.peak / largest, 1e-5
                )
                book.near("separation speed [m/s]", obtained["v_separation"], impact.separation, 1e-5)
            energy = summary["energy"]
            parts = sum(energy[key] for key in ("kinetic", "strain", "damping", "hysteretic", "impact"))
            book.near("sum of the energies over the input [-]", parts / energy["input"], 1, 1e-6)

    def test_sound_surfaces_give_what_is_asked_and_crushed_ones_what_their_energy_says(self):
        e, m, k = 0.6, 5e4, 3e9
        book = Book(
            self,
            "Elastoplastic contact: crushing, memory",
            "closed forms: e on sound surfaces; then sqrt(e^2 [1 + (1 - e^2) E1/E2]) above the energy e^2 E1, else 1",
            "run at tolerance 1e-7",
        )
        # The ball rebounds with 0.6 m/s, meets the other one at 2 m/s, and returns with its speed.
        rows, _ = self.impacts(BALL.format(first=1.0, second=2.0, duration=0.5))
        wall = [row for row in rows if row["link"] == b"wall"]
        self.assertEqual(len(wall), 2)
        book.near("restitution on sound surfaces [-]", wall[0]["restitution"], e, 1e-6)
        book.near("second closing speed [m/s]", wall[1]["v_approach"], 2.0, 1e-6)
        book.near(
            "restitution on crushed surfaces, harder than before [-]",
            wall[1]["restitution"],
            e * math.sqrt(1 + (1 - e * e) / 4),
            1e-6,
        )
        # The gap has grown by (1 - e^2) d_m, from which peaks are measured.
        crushed = math.sqrt(m / k)
        deepest = crushed * math.sqrt(1 + 4 - e * e)
        book.near(
            "second largest penetration, from the widened gap [m]",
            wall[1]["peak_penetration"],
            deepest - (1 - e * e) * crushed,
            1e-8,
        )
        book.near("second largest force [N]", wall[1]["peak_force"], k * deepest, 1e-6 * k * deepest)
        # Nothing crushes below the first rebound speed.
        rows, _ = self.impacts(BALL.format(first=1.0, second=0.5, duration=1.2))
        wall = [row for row in rows if row["link"] == b"wall"]
        self.assertEqual(len(wall), 2)
        book.near("restitution on crushed surfaces, softer than before [-]", wall[1]["restitution"], 1, 1e-6)


if __name__ == "__main__":
    unittest.main()
