"""Compares the impacts found by the program with those of independent.py."""

import math
import time
from dataclasses import dataclass

from independent import Law, Link, Row

#: Allowed difference of peak forces and separation speeds, in tolerances of the largest force and approach of their
#: link.
ALLOWED = 10
#: An approach grazes if a displacement by this many tolerances of the largest one could change its outcome.
GRAZING = 10
#: Growth of an input disturbance beyond which runs cannot agree to ALLOWED tolerances.
LARGEST_GAIN = 10
DISTURBANCE, DISTURBED = 1e-8, ("mass", "velocity", "gap", "amplitude")


def ground_of(motion):
    """ground(t), its corners and its longest step for the ground motion of a case (None: ground at rest)."""
    if not motion:
        return None, (), math.inf
    if motion["kind"] == "harmonic":
        a, period, end = motion["amplitude"], motion["period"], motion["duration"]
        return lambda t: a * math.sin(2 * math.pi * t / period) if t < end else 0.0, (end,), period / 20
    a, begin, length = motion["amplitude"], motion["start"], motion["duration"]
    shape = {
        "rectangle": lambda s: 1.0,
        "half_sine": lambda s: math.sin(math.pi * s),
        "sine": lambda s: math.sin(2 * math.pi * s),
    }[motion["shape"]]
    return (
        lambda t: a * shape((t - begin) / length) if begin <= t < begin + length else 0.0,
        (begin, begin + length),
        length / 20,
    )


def row_of(case):
    """A Row for a case of stress.py."""
    masses, index = [], {}
    for s in case["structures"]:
        if s["kind"] == "wall":
            index[s["name"]] = None
            continue
        index[s["name"]] = len(masses)
        k = s["mass"] * (2 * math.pi / s["period"]) ** 2 if s["kind"] == "oscillator" else 0.0
        masses.append((s["mass"], k, 2 * s.get("damping", 0.0) * math.sqrt(k * s["mass"]), 0.0, s["velocity"]))
    links = [Link(index[l["left"]], index[l["right"]], l["gap"], Law(l["law"], l)) for l in case["links"]]
    ground, corners, longest = ground_of(case.get("ground"))
    return Row(masses, links, ground, corners, min(longest, case["duration"] / 50))


@dataclass
class Verdict:
    """agreed: whole | cut at grazing | cut at growth | no. The latter two compare the impacts before `until` [s]
    only."""

    agreed: str
    until: float
    compared: int
    impacts: int
    why: str = ""


def grazing_time(row, tolerance, end):
    """First time at which GRAZING tolerances of the displacements could add or remove a touch, a miss or a
    separation."""
    reach = GRAZING * tolerance * row.reach

    def earlier(speed, opening_acceleration):
        """Time by which such a displacement advances the closing, or opening, of the gap."""
        by_speed = reach / abs(speed) if speed else math.inf
        by_acceleration = math.sqrt(2 * reach / abs(opening_acceleration)) if opening_acceleration else math.inf
        return min(by_speed, by_acceleration, end)

    times = [row.t if row.stopped else math.inf]
    for link in row.links:
        times += [t for t, distance in link.near_misses if distance < reach]
        for impact in link.impacts:
            if (
                impact.approach**2 < 2 * reach * abs(impact.deceleration)
                or impact.approach * (end - impact.start) < reach
            ):
                times.append(impact.start - earlier(impact.approach, impact.deceleration))
            if impact.separation**2 < 2 * reach * abs(impact.return_acceleration):
                times.append(impact.end - earlier(impact.separation, impact.return_acceleration))
    return min(times)


def disturbed(case, quantity, size):
    """A copy of the case with a quantity changed by this relative amount, in alternating directions along the row."""
    sign = [1]

    def changed(values):
        sign[0] = -sign[0]
        return values | ({quantity: values[quantity] * (1 + sign[0] * size)} if quantity in values else {})

    return case | {
        "structures": [changed(s) for s in case["structures"]],
        "links": [changed(l) for l in case["links"]],
        "ground": changed(case["ground"]) if case["ground"] else None,
    }


def measure(row):
    """(start, end, values) of each impact by link; values are the peak force (rigid: the impulse) and the separation
    speed."""
    return [
        [
            (i.start, i.end, (link.law.mass * (i.approach + i.separation) if link.law.rigid else i.peak, i.separation))
            for i in link.impacts
        ]
        for link in row.links
    ]


def largest_of(link, impacts):
    """Scales of errors: the largest force or impulse, and the largest closing speed."""
    return (
        max((values[0] for *_, values in impacts), default=0.0),
        max((impact.approach for impact in link.impacts[: len(impacts)]), default=0.0),
    )


def growth_time(row, other):
    """First time at which a peak has changed by more than LARGEST_GAIN times the disturbance, or the impacts differ."""
    times = [r.t if r.stopped else math.inf for r in (row, other)]
    for link, mine, theirs in zip(row.links, measure(row), measure(other)):
        largest = largest_of(link, mine)
        for (start, _, values), (_, _, changed) in zip(mine, theirs):
            if any(abs(v - c) > LARGEST_GAIN * DISTURBANCE * l for v, c, l in zip(values, changed, largest)):
                times.append(start)
        if len(mine) != len(theirs):
            longer = max(mine, theirs, key=len)
            times.append(longer[min(len(mine), len(theirs))][0])
    return min(times)


def difference(row, program, tolerance, until):
    """(difference before `until`, impacts compared). program: arrays of the rows of each link in the results."""
    before = until * (1 - ALLOWED * tolerance)
    compared = 0
    for index, (link, mine, theirs) in enumerate(zip(row.links, measure(row), program)):
        mine = [m for m in mine if m[0] < before]
        theirs = [t for t in theirs if t["t_start"] < before]
        name = f"link {index} ({link.law.name})"
        if len(mine) != len(theirs):
            return f"{name}: {len(theirs)} impacts, {len(mine)} expected before {before:.9g} s", compared
        largest = largest_of(link, mine)
        for number, ((start, end, values), row_there) in enumerate(zip(mine, theirs)):
            if not end < before and math.isfinite(until):
                continue  # its peak may follow the cut
            for value, key, scale in zip(
                values, ("impulse" if link.law.rigid else "peak_force", "v_separation"), largest
            ):
                found = row_there[key]
                if math.isnan(value) and math.isnan(found):
                    continue  # pressed until the end of the run
                if not abs(found - value) <= ALLOWED * tolerance * scale:
                    return (
                        f"{name}, impact {number} at {start:.9g}: {key} {found:.12g}, {value:.12g} expected, off by "
                        f"{abs(found - value) / scale / tolerance if scale else math.inf:.3g} tolerances"
                    ), compared
            compared += 1
    return "", compared


def judge(case, program, seconds=math.inf):
    """Compares the impacts found by the program with those of this integrator. Raises TooLong after `seconds`."""
    deadline, tolerance, end = time.monotonic() + seconds, case["tolerance"], case["duration"]

    def integrated(case):
        row = row_of(case)
        row.deadline = deadline
        row.run(end)
        return row

    row = integrated(case)
    impacts = sum(len(rows) for rows in program)
    if not row.stopped:
        wrong, compared = difference(row, program, tolerance, math.inf)
        if not wrong:
            return Verdict("whole", end, compared, impacts)
    grazes = grazing_time(row, tolerance, end)
    wrong, compared = difference(row, program, tolerance, grazes)
    if not wrong:
        return Verdict("cut at grazing", grazes, compared, impacts)
    grows = min(growth_time(row, integrated(disturbed(case, quantity, DISTURBANCE))) for quantity in DISTURBED)
    grows = min(grazes, grows)
    later, compared = difference(row, program, tolerance, grows)
    return Verdict("no" if later else "cut at growth", grows, compared, impacts, later or wrong)
