"""A model whose runs take milliseconds, and helpers for tests of studies."""

import os

import numpy as np

import pounding
from pounding._studies.template import Template


def pair(**changes):
    """Two oscillators under half a second of an artificial earthquake."""
    parts = {
        "structures": {
            "left": {"oscillator": {"mass": "100 t", "period": "0.8 s", "damping": "5 %"}},
            "right": {"oscillator": {"mass": "150 t", "period": "0.4 s", "damping": "5 %"}},
        },
        "links": [
            {
                "between": ["left", "right"],
                "gap": "1 mm",
                "law": "hertz_damped",
                "stiffness": "2.75e9",
                "restitution": "0.65",
            }
        ],
        "ground_motion": {"synthetic": {"seed": 1, "duration": "0.8 s", "pga": "0.3 g", "soil": "firm"}},
        "analysis": {"tolerance": "1e-3"},
    }
    return pounding.Model(**{**parts, **changes})


FACTORS = {
    "ratio": {
        "of": "structures.right.oscillator.period",
        "times": "structures.left.oscillator.period",
        "list": [0.4, 0.8],
    },
    "gap": {"of": "links.*.gap", "list": ["1 mm", "3 mm", "9 mm"]},
}
WORDS = {
    "records": {"synthetic": {"count": 3, "duration": "0.8 s", "pga": "0.3 g"}},
    "intensity": {"measure": "pga", "levels": ["0.2 g", "0.4 g"]},
    "keep": ["displacement", "force", "impacts"],
}


class Deadly(Template):
    """A template whose rows with this gap end their process."""

    gap = 3e-3

    def begin(self, values):
        if np.isclose(values[1], self.gap):
            os.abort()


def write_records(folder, names, peak=3.0):
    """Records of one second each, all different."""
    t = np.arange(0, 1, 0.01)
    for i, name in enumerate(names, 1):
        acceleration = peak * np.sin((4 + 3 * i) * t) * np.sin(np.pi * t) * (1 + 0.1 * i)
        lines = "".join(f"{a!r},{b!r}\n" for a, b in zip(t.tolist(), acceleration.tolist()))
        (folder / name).write_text("time [s],acceleration [m/s2]\n" + lines)


def bent(x):
    """A portal with columns at x and x + 6 m."""
    return {
        "frame": {
            "material": {"E": "30 GPa", "density": "2500 kg/m^3"},
            "nodes": {"a": [x, 0], "b": [x, 3], "c": [x + 6, 3], "d": [x + 6, 0]},
            "members": {
                name: {"between": ends, "section": {"rectangle": ["0.4 m", "0.6 m"]}}
                for name, ends in (("c1", ["a", "b"]), ("b1", ["b", "c"]), ("c2", ["d", "c"]))
            },
            "supports": {"a": "fixed", "d": "fixed"},
            "masses": {"b": "60 t", "c": "60 t"},
            "floors": [{"nodes": ["b", "c"]}],
        },
        "damping": "5 %",
    }


def bents(**ground):
    """Two portals, 10 mm apart."""
    return pounding.Model(
        structures={"left": bent(0.0), "right": {**bent(6.01), "delay": "10 ms"}},
        ground_motion=ground or None,
        links=[{"between": ["left.1", "right.1"], "law": "hertz_damped", "stiffness": "2.75e9", "restitution": "0.65"}],
    )


def blocks(**ground):
    """Two portals in space with different floors."""

    def block(x, mass):
        section = {"rectangle": ["0.4 m", "0.6 m"]}
        return {
            "frame": {
                "origin": [x, 0],
                "material": {"E": "30 GPa"},
                "grid": {
                    "storeys": 1,
                    "bays": [1, 1],
                    "storey_height": "3 m",
                    "bay_width": "6 m",
                    "columns": section,
                    "beams": section,
                    "floor_mass": mass,
                },
            },
            "damping": "5 %",
        }

    return pounding.Model(
        structures={"left": block(0.0, "120 t"), "right": block(6.005, "40 t")},
        ground_motion=ground or None,
        links=[
            {
                "between": ["left", "right"],
                "floors": "all",
                "law": "hertz_damped",
                "stiffness": "2.75e9",
                "restitution": "0.65",
            }
        ],
    )
