"""Limits of screening rules for existing buildings, as data. Their texts were not read in a public source: check the
edition."""

from __future__ import annotations

INCH = 0.0254  #: [m]
FOOT = 12 * INCH  #: [m]
#: Seismicity of a site, from the lowest.
SEISMICITIES = ("low", "moderate", "moderately_high", "high", "very_high")

#: FEMA P-154 (2015): pounding counts if the gap is below a width per storey of the lower building, and one of three
#: further conditions holds.
FEMA_P154 = {
    "name": "FEMA P-154",
    "source": "professional knowledge of the third edition (2015)",
    "width_per_storey": dict(zip(SEISMICITIES, (0.5 * INCH, 0.5 * INCH, 1.0 * INCH, 1.5 * INCH, 2.0 * INCH))),
    "floor_offset": 2 * FOOT,  #: floors that differ by more are not aligned [m]
    "storeys_taller": 2,  #: difference of storeys
    "row": 3,  #: number of buildings in a row from which its ends count
}

#: ASCE 41-17 and 41-23, tier 1: the gap as a fraction of the height of the lower building.
ASCE_41 = {
    "name": "ASCE 41-17/23 tier 1",
    "source": "professional knowledge",
    "fraction": dict(zip(SEISMICITIES, (0.0025, 0.005, 0.015, 0.015, 0.015))),
}

#: NZSEE/MBIE initial evaluation procedure, factor D: rows for gaps up to a fraction of the height.
NZSEE = {
    "name": "NZSEE/MBIE IEP",
    "source": "professional knowledge of part B of the guidelines (2017), tables of factor D",
    "severe": 0.005,  #: gap below this fraction of the height of the lower building
    "significant": 0.01,
    "alignment": 0.2,  #: floors within this fraction of the storey height are aligned
    #: factor D1 for severe, significant and insignificant gaps
    "aligned": (0.7, 0.8, 1.0),
    "offset": (0.4, 0.7, 0.8),
    #: factor D2: difference of storeys above which a row applies, and its factors
    "height": ((4, (0.4, 0.7, 1.0)), (1, (0.7, 0.9, 1.0)), (-1, (1.0, 1.0, 1.0))),
}

#: Cole, Dhakal and Turner (2012), critical configurations. The paper has no limits for masses and heights; those here
#: are of this program.
COLE = {
    "name": "Cole, Dhakal, Turner 2012",
    "source": "professional knowledge; limits of masses and heights are of this program",
    "mass_ratio": 1.5,  #: of facing floors
    "height_ratio": 1.25,
}

#: Conditions that a model does not decide.
NOT_ASSESSED = ("brittle or unreinforced masonry", "torsion by an eccentric contact")
