"""The benchmark problems: data shared by the reference, OpenSees and pounding. SI units.

Two oscillators (100 t, 0.5 s; 150 t, 1.0 s; 5 %; 20 mm apart) under 0.4 g at 1.5 Hz for 10 s, and two plane frames (8
storeys with 3 bays, 6 storeys with 2 bays) under a synthetic record of 20 s; restitution 0.65, six laws of both
programs.
"""

import math

MASSES = (100e3, 150e3)
PERIODS = (0.5, 1.0)
DAMPING = 0.05
GAP = 0.02
AMPLITUDE, FREQUENCY = 0.4 * 9.81, 1.5
DURATION = 10.0
SAMPLE = 0.05  # displacements are compared at multiples of it [s]

RESTITUTION = 0.65
LINEAR_STIFFNESS = 93.5e6  # N/m
HERTZ_STIFFNESS = 2.75e9  # N/m^1.5
EXPONENT = 1.5
DESIGN_SPEED = 0.5  # of the bilinear law [m/s]
YIELD_RATIO = 0.1  # of the bilinear law

# One storey of the facing frames: 36 t for a full bay, half of it at an edge column.
FLOOR_MASS = 36e3
FRAME_DURATION = 20.0
FRAME_SAMPLE = 0.1

LINEAR = f"stiffness: {LINEAR_STIFFNESS}"
HERTZ = f"stiffness: {HERTZ_STIFFNESS}"
ASKED = f"restitution: {RESTITUTION}, formula: "
# The law in pounding's input format.
LAWS = {
    "linear_spring": LINEAR,
    "kelvin_voigt": f"{LINEAR}, {ASKED}anagnostopoulos",
    "hertz": HERTZ,
    "hertz_damped": f"{HERTZ}, {ASKED}ye_2009",
    "jankowski": f"{HERTZ}, {ASKED}jankowski_2006",
    "bilinear_hertz": f"{HERTZ}, impact_velocity: {DESIGN_SPEED}, yield_ratio: {YIELD_RATIO}, {ASKED}muthukumar_desroches",
}
# In OpenSees hertz_damped pulls if bodies separate faster than v/a; pounding cuts the tension. Each has its own
# reference.
OPENSEES_REFERENCE = {law: law for law in LAWS} | {"hertz_damped": "hertz_damped_pulling"}
# Target ratio to OpenSees at an error of 1e-4: larger if the force jumps at the touch.
WANTED = {law: 1000 if law == "kelvin_voigt" else 100 for law in LAWS}


def reduced_mass(m1, m2):
    return m1 * m2 / (m1 + m2)


OSCILLATOR_MASS = reduced_mass(*MASSES)
FRAME_MASS = reduced_mass(3 * FLOOR_MASS, 2 * FLOOR_MASS)


def kelvin_coefficient(mass, e=RESTITUTION):
    """c [N s/m], Anagnostopoulos 1988."""
    ratio = -math.log(e) / math.sqrt(math.pi**2 + math.log(e) ** 2)
    return 2 * ratio * math.sqrt(LINEAR_STIFFNESS * mass)


def ye_factor(e=RESTITUTION):
    """a [-] of F = k d^n (1 + a d'/v), Ye 2009."""
    return 8 * (1 - e) / (5 * e)


def jankowski_ratio(e=RESTITUTION):
    """xi [-], Jankowski 2006."""
    return 9 * math.sqrt(5) / 2 * (1 - e * e) / (e * (e * (9 * math.pi - 16) + 16))


def bilinear_curve(mass, e=RESTITUTION):
    """K1, K2 [N/m] and d_y [m], Muthukumar & DesRoches 2006, designed for the design speed."""
    n, k, a = EXPONENT, HERTZ_STIFFNESS, YIELD_RATIO
    deepest = ((n + 1) * mass * DESIGN_SPEED**2 / (2 * k)) ** (1 / (n + 1))
    loss = k * deepest ** (n + 1) * (1 - e * e) / (n + 1)
    middle = k * deepest ** (n - 1)
    return middle + loss / (a * deepest**2), middle - loss / ((1 - a) * deepest**2), a * deepest


def opensees_material(law, mass):
    """Name and arguments of the uniaxialMaterial, without its tag. Compression and the gap are negative."""
    k, kh, n = LINEAR_STIFFNESS, HERTZ_STIFFNESS, EXPONENT
    if law == "linear_spring":
        return "ElasticPPGap", k, -1e15, -GAP, 0.0
    if law == "kelvin_voigt":
        return "ViscoelasticGap", k, kelvin_coefficient(mass), -GAP
    if law == "hertz":
        return "Hertzdamp", kh, 0.0, -GAP, n
    if law == "hertz_damped":
        return "Hertzdamp", kh, ye_factor(), -GAP, n
    if law == "jankowski":
        return "JankowskiImpact", kh, jankowski_ratio(), mass, -GAP, n
    k1, k2, yielding = bilinear_curve(mass)
    return "ImpactMaterial", k1, k2, -yielding, -GAP
