"""A model whose runs take milliseconds, and helpers of the tests of studies."""

import os

import numpy as np

import pounding
from pounding.studies.template import Template


def pair(**changes):
    """Two oscillators under half a second of an artificial earthquake."""
    parts = {"structures": {"left": {"oscillator": {"mass": "100 t", "period": "0.8 s", "damping": "5 %"}},
                            "right": {"oscillator": {"mass": "150 t", "period": "0.4 s", "damping": "5 %"}}},
             "links": [{"between": ["left", "right"], "gap": "1 mm", "law": "hertz_damped", "stiffness": "2.75e9", "restitution": "0.65"}],
             "ground_motion": {"synthetic": {"seed": 1, "duration": "0.8 s", "pga": "0.3 g", "soil": "firm"}},
             "analysis": {"tolerance": "1e-3"}}
    return pounding.Model(**{**parts, **changes})


FACTORS = {"ratio": {"of": "structures.right.oscillator.period", "times": "structures.left.oscillator.period", "list": [0.4, 0.8]},
           "gap": {"of": "links.*.gap", "list": ["1 mm", "3 mm", "9 mm"]}}
WORDS = {"records": {"synthetic": {"count": 3, "duration": "0.8 s", "pga": "0.3 g"}}, "intensity": {"measure": "pga", "levels": ["0.2 g", "0.4 g"]},
         "keep": ["displacement", "force", "impacts"]}


class Deadly(Template):
    """A template whose rows with this gap end their process."""

    gap = 3e-3

    def begin(self, values):
        if np.isclose(values[1], self.gap):
            os.abort()
