"""Damping that gives a restitution e, by the published formulas and in closed form, independent of the program.

SI units; k [N/m^n] stiffness, m [kg] reduced mass, v [m/s] closing speed.
"""

import math
from functools import lru_cache

from scipy.optimize import brentq


def hunt_crossley_exact(e):
    """a of F = k d^n (1 + a d'/v): root of a (1 + e) = ln[(1 + a)/(1 - a e)]."""
    if e == 1:
        return 0.0
    return brentq(
        lambda a: a * (1 + e) - math.log1p(a) + math.log1p(-a * e), 0.2 * (1 - e), (1 - 1e-15) / e, xtol=1e-15
    )


def _phase(z):
    """arccos(z)/sqrt(1 - z^2), continued beyond z = 1."""
    if abs(z - 1) < 1e-9:
        return 1.0
    return math.acos(z) / math.sqrt(1 - z * z) if z < 1 else math.acosh(z) / math.sqrt(z * z - 1)


def approach_only_exact(e):
    """z of a linear oscillator damped during approach only: e = exp(-z arccos z/sqrt(1 - z^2))."""
    return 0.0 if e == 1 else brentq(lambda z: z * _phase(z) + math.log(e), 0, 2 / e, xtol=1e-15)


def cut_exact(e):
    """z of a linear oscillator released at zero force: e = exp(-2 z arccos z/sqrt(1 - z^2))."""
    return approach_only_exact(math.sqrt(e))


def anagnostopoulos(e):
    return -math.log(e) / math.hypot(math.pi, math.log(e))


#: a of F = k d^n (1 + a d'/v) by formula.
HERTZ_DAMPING = {
    "exact": hunt_crossley_exact,
    "lankarani_nikravesh": lambda e: 3 * (1 - e * e) / 4,
    "hunt_crossley": lambda e: 3 * (1 - e) / 2,
    "ye_2009": lambda e: 8 * (1 - e) / (5 * e),
    "hu_guo": lambda e: 3 * (1 - e) / (2 * e),
    "gonthier": lambda e: (1 - e * e) / e,
    "herbert_mcwhannell": lambda e: 6 * (1 - e) / ((2 * e - 1) ** 2 + 3),
    "lee_wang": lambda e: 3 * (1 - e) / 4,
    "zhiying_qishao": lambda e: 3 * (1 - e * e) * math.exp(2 * (1 - e)) / 4,
    "gharib_hurmuzlu": lambda e: 1 / e,
}
LINEAR_DAMPING = {"exact": hunt_crossley_exact, "ye_2009_linear": lambda e: 3 * (1 - e) / (2 * e)}
#: zeta of c = 2 zeta sqrt(k m) by formula.
VISCOUS_RATIO = {"exact": anagnostopoulos, "anagnostopoulos": anagnostopoulos}
CUT_RATIO = {"exact": cut_exact, "anagnostopoulos": anagnostopoulos}
APPROACH_RATIO = {
    "exact": approach_only_exact,
    "mahmoud_jankowski_2011": lambda e: (1 - e * e) / (e * (e * (math.pi - 2) + 2)),
    "simple": lambda e: (1 - e * e) / (math.pi * e),
}
JANKOWSKI_RATIO = {
    "exact": lambda e: math.sqrt(5) / 2 * approach_only_exact(e),
    "jankowski_2005": lambda e: math.sqrt(5) * (1 - e * e) / (2 * math.pi * e),
    "jankowski_2006": lambda e: 9 * math.sqrt(5) / 2 * (1 - e * e) / (e * (e * (9 * math.pi - 16) + 16)),
}
#: alpha of the viscous Hertz law, n = 1.5. In stretched time it is a linear oscillator of damping ratio alpha/sqrt(5).
VISCOUS_HERTZ = {
    "exact": lambda e: math.sqrt(5) * cut_exact(e),
    "antypov_elliott": lambda e: math.sqrt(5) * anagnostopoulos(e),
}


def _twice(ratios):
    """c/sqrt(k m) = 2 zeta."""
    return {formula: lambda e, ratio=ratio: 2 * ratio(e) for formula, ratio in ratios.items()}


#: Damping number by law and formula: a, or c/sqrt(k m).
FORMULAS = {
    "kelvin_voigt": _twice(VISCOUS_RATIO),
    "kelvin_voigt_no_tension": _twice(CUT_RATIO),
    "komodromos": _twice(CUT_RATIO),
    "modified_linear_viscoelastic": _twice(APPROACH_RATIO),
    "jankowski": _twice(JANKOWSKI_RATIO),
    "viscous_hertz": VISCOUS_HERTZ,
    "modified_kelvin": LINEAR_DAMPING,
    "hertz_damped": HERTZ_DAMPING,
}
#: The parameter that gives the damping directly, and the factor from it to the damping number.
GIVEN = {
    "kelvin_voigt": ("damping_ratio", 2),
    "kelvin_voigt_no_tension": ("damping_ratio", 2),
    "komodromos": ("damping_ratio", 2),
    "modified_linear_viscoelastic": ("damping_ratio", 2),
    "jankowski": ("damping_ratio", 2),
    "viscous_hertz": ("damping_ratio", 1),
    "modified_kelvin": ("damping_factor", 1),
    "hertz_damped": ("damping_factor", 1),
    "kuwabara_kono": ("dissipation_time", 1),
    "adams_impact": ("damping_coefficient", 1),
    "limited_damper": ("damping_coefficient", 1),
}


def bilinear_curve(k, v, m, loss, yield_ratio=0.1):
    """K1, K2 [N/m] and d_y [m] of the bilinear law designed for the penetration of a Hertz spring at v."""
    d_m = (5 * m * v * v / (4 * k)) ** 0.4
    k_eff, d_e = k * math.sqrt(d_m), loss * k * d_m**2.5 / 2.5
    return k_eff + d_e / (yield_ratio * d_m**2), k_eff - d_e / ((1 - yield_ratio) * d_m**2), yield_ratio * d_m


def bilinear_work(curve, d):
    """Work of the first loading to d [J]."""
    k1, k2, d_y = curve
    return 0.5 * k1 * d * d if d <= d_y else 0.5 * k1 * d_y**2 + k1 * d_y * (d - d_y) + 0.5 * k2 * (d - d_y) ** 2


@lru_cache(maxsize=None)
def bilinear_exact(e):
    """loss = dE (n + 1)/(k d_m^(n+1)) for which the law gives e at its design speed, for k = m = v = 1."""

    def miss(loss):
        curve = bilinear_curve(1, 1, 1, loss)
        high = 1.0
        while bilinear_work(curve, high) < 0.5:
            high *= 2
        d = brentq(lambda d: bilinear_work(curve, d) - 0.5, 0, high, xtol=1e-16)
        k1, k2, d_y = curve
        return 1 - 2 * (k1 - k2) * d_y * (d - d_y) - e * e

    return 0.0 if e == 1 else brentq(miss, 0, 2.25 * (1 - 1e-12), xtol=1e-15)
