"""Frames with hinges for the benchmarks: data and models. SI units.

frame: three storeys of 3.2 m and a bay of 6 m, E 30 GPa, columns 0.4 x 0.4 m, beams 0.3 x 0.5 m, 20 t at every node, no
shear deformation; hinges at the ends of beams (180 kN m) and at feet (250 kN m); El Centro 1940 times 1.5 for 12 s.
towers: the pair in space of towers.py, pressed together, with 240 rigid-plastic hinges that all yield, or without.
pair: the plane frames of plane_frames.py, 20 mm apart, with hinges at the same locations; their motion, 20 s, elastic
contacts.

A hinge is a bilinear spring of 10 times 6EI/L with a hardening of 0.003. Damping is proportional to mass only, for
which both programs agree.
"""

import math

import plane_frames
import problem
from plane_frames import BAY, BEAM, COLUMN, ELASTICITY, HEIGHT

HARDENING, STIFFER_THAN_MEMBERS = 0.003, 10.0

FRAME_STOREYS, FRAME_END, FRAME_SCALE = 3, 12.0, 1.5
FRAME_E, FRAME_MASS = 30e9, 20e3  # Pa, kg per node
FRAME_COLUMN, FRAME_BEAM = (0.4**2, 0.4**4 / 12), (0.3 * 0.5, 0.3 * 0.5**3 / 12)
FRAME_MOMENTS = 180e3, 250e3  # of beams and of feet [N m]
#: First period [s], from the independent integration, with 5 % damping.
FRAME_PERIOD, DAMPING = 0.6818603273427927, 0.05

#: Yield moments of beams and of feet [N m] of both frames, and the period with a damping of 5 % [s].
PAIR_MOMENTS, PAIR_PERIOD = ((200e3, 320e3), (260e3, 420e3)), 1.0

#: Storeys of both towers whose beams along x have hinges, 60 per storey, and the yield moment that all of them exceed
#: simultaneously [N m].
TOWER_STOREYS, TOWER_MOMENT = (1, 2), 1e2

#: A period so short that 5 % damping there adds no significant stiffness-proportional damping.
NO_PERIOD = 1e-12


def by_mass(period):
    """a [1/s] of the damping a M."""
    return 2 * DAMPING * 2 * math.pi / period


def hinges(beams, feet):
    law = lambda moment: (
        f"bilinear: {{yield_moment: {moment!r}, hardening: {HARDENING}, stiffness_factor: {STIFFER_THAN_MEMBERS}}}"
    )
    return f"      hinges:\n        beams: {{at: both, {law(beams)}}}\n        columns: {{at: feet, {law(feet)}}}\n"


def damping(period):
    return f"    damping: {{rayleigh: {{ratio: {DAMPING}, periods: [{period!r}, {NO_PERIOD}]}}}}\n"


def section(area, inertia):
    return f"{{area: {area!r}, inertia_y: {inertia!r}}}"


def towers(yield_moment):
    """The pair of towers.py with flexible floors, pressed together, with a hinge at both ends of every beam along x of
    TOWER_STOREYS; no hinges if the yield moment is None."""
    import towers as of

    text = of.model(2, 5, False)
    if yield_moment is None:
        return text
    words = "".join(
        f"\n        beam x {storey}.{i}.{k}: {{at: both, axis: y, yield_moment: {yield_moment!r}, hardening: 0.03}}"
        for storey in TOWER_STOREYS
        for i in range(5)
        for k in range(6)
    )
    return text.replace("rigid_floors: false}", f"rigid_floors: false}}\n      hinges:{words}")


def frame(tolerance, record, integrator):
    """The single frame in pounding's input format."""
    return (
        f"ground_motion: {{record: {record}, units: m/s^2, scale: {FRAME_SCALE}}}\nstructures:\n  frame:\n    frame:\n      material: {{E: {FRAME_E!r}}}\n"
        f"      grid: {{storeys: {FRAME_STOREYS}, bays: 1, storey_height: {HEIGHT}, bay_width: {BAY}, columns: {section(*FRAME_COLUMN)}, "
        f"beams: {section(*FRAME_BEAM)}, floor_mass: {2 * FRAME_MASS!r}}}\n{hinges(*FRAME_MOMENTS)}{damping(FRAME_PERIOD)}"
        f"analysis: {{duration: {FRAME_END}, tolerance: {tolerance}, integrator: {integrator}}}\n"
    )


def pair(tolerance, record, integrator):
    """The two frames in pounding's input format."""
    text = f"ground_motion: {{record: {record}, units: m/s^2}}\nstructures:\n"
    for k in range(2):
        storeys, bays, stiffer = plane_frames.STOREYS[k], plane_frames.BAYS[k], plane_frames.STIFFER[k]
        text += (
            f"  {'left' if k == 0 else 'right'}:\n    frame:\n      origin: [{k * (plane_frames.BAYS[0] * BAY + problem.GAP)!r}, 0]\n"
            f"      material: {{E: {ELASTICITY!r}}}\n"
            f"      grid: {{storeys: {storeys}, bays: {bays}, storey_height: {HEIGHT}, bay_width: {BAY}, columns: {section(COLUMN[0], COLUMN[1] * stiffer)}, "
            f"beams: {section(BEAM[0], BEAM[1] * stiffer)}, floor_mass: {bays * problem.FLOOR_MASS!r}}}\n{hinges(*PAIR_MOMENTS[k])}{damping(PAIR_PERIOD)}"
        )
    return (
        text
        + f"links: [{{between: [left, right], floors: all, gap: {problem.GAP}, law: linear_spring, stiffness: {problem.LINEAR_STIFFNESS!r}}}]\n"
        f"analysis: {{duration: {problem.FRAME_DURATION}, tolerance: {tolerance}, integrator: {integrator}, output_step: {problem.FRAME_SAMPLE}}}\n"
    )
