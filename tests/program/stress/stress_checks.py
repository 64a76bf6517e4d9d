"""Checks that every run of a random case must pass, whatever its numbers."""

import math

import h5py
import numpy as np
from stress_cases import LINEAR, SPREAD


#: Round-off of velocities at rest [m/s].
STILL = 1e-15

#: Round-off of positions in a run of one step, relative to the longest path; it grows with the square root of the
#: number of steps.
OF_POSITIONS = 4 * np.finfo(float).eps


def mass_of(s):
    """Mass of all floors [kg]; for a frame about twice that of floors and members."""
    if s["kind"] == "frame":
        return s["storeys"] * (s["floor_mass"] + 5e3 * (s["bays"] + 1))
    mass = s.get("mass", 0)
    return sum(mass) if isinstance(mass, list) else mass * s.get("storeys", 1)


class Run:
    """The results of a case as plain arrays."""

    def __init__(self, case, path, summary):
        self.case, self.imbalance, self.steps = case, summary["energy"]["error"], summary["solver"]["steps"]
        with h5py.File(path) as file:
            rows = file["impacts"][()]
            # Only bodies and oscillators have closed forms.
            self.simple = all(s["kind"] in ("body", "oscillator", "wall") for s in case["structures"])
            names = [l.get("name", f"{l['left']}-{l['right']}") for l in case["links"]]
            labels = rows["link"].astype(str)
            self.rows = [rows[labels == name] for name in names]
            self.impacts = len(rows)
            self.histories = [
                {key: data[()] for key, data in file["links"][name].items() if data.dtype.kind == "f"} for name in names
            ]
            self.energy = {key: data[()] for key, data in file["energy"].items()}
            self.ground = file["ground/acceleration"][()] if "ground" in file else np.zeros(1)
            self.time = file["time"][()]
            self.motion = {}
            for s in case["structures"]:
                own = file["structures"][s["name"]]
                self.motion[s["name"]] = tuple(
                    own[key][()].reshape(len(self.time), -1) for key in ("displacement", "velocity")
                )
        self.structures = {s["name"]: s for s in case["structures"]}
        self.tolerance = case["tolerance"]
        self.reach = max(float(np.max(np.abs(u), initial=0)) for u, _ in self.motion.values())
        self.speed = max(float(np.max(np.abs(v), initial=0)) for _, v in self.motion.values())
        # The input energy is known at output times; between them it may rise by the work of the ground in one output
        # step.
        push = sum(mass_of(s) for s in case["structures"]) * float(np.max(np.abs(self.ground), initial=0))
        self.available = float(np.max(self.energy["input"])) + push * self.speed * float(np.max(np.diff(self.time)))

    def ends(self, l):
        return [self.structures[l["left"]], self.structures[l["right"]]]

    def reduced_mass(self, l):
        return 1 / sum(1 / s["mass"] for s in self.ends(l) if s["kind"] != "wall")

    def disturbance(self, l):
        """Largest relative acceleration of the two ends due to anything but this contact and its neighbours [m/s^2]."""
        total = 0.0
        for s in self.ends(l):
            if s["kind"] == "wall":
                total += float(np.max(np.abs(self.ground)))
            if s["kind"] == "oscillator":
                w, (u, v) = 2 * math.pi / s["period"], self.motion[s["name"]]
                total += w * w * float(np.max(np.abs(u))) + 2 * s["damping"] * w * float(np.max(np.abs(v)))
        return total

    def alone(self, index, row):
        """True if no other link presses on these bodies during the impact."""
        own = self.case["links"][index]
        moving = {s["name"] for s in self.ends(own) if s["kind"] != "wall"}
        for other, rows in zip(self.case["links"], self.rows):
            if other is own or not moving & {other["left"], other["right"]}:
                continue
            if np.any((rows["t_start"] <= row["t_end"]) & ~(rows["t_end"] < row["t_start"])):
                return False
        return True


def touches_in(path):
    """Start times of the impacts in a results file [s]; empty without a file."""
    if not path.exists():
        return np.zeros(0)
    with h5py.File(path) as file:
        return file["impacts"]["t_start"]


def exponent_of(l):
    """Exponent of the penetration in the force of a link."""
    return 1.0 if l["law"] in LINEAR else 1.5


def pressing_work(l, d, mass, speed):
    """Lower bound on the work from touch to the penetration d [J] in one loading."""
    if l["law"] == "bilinear_hertz":
        # K1 >= K_eff up to d_y, and beyond it the force does not decrease.
        v = max(l.get("impact_velocity", speed), 1e-6)
        design = (1.25 * mass * v * v / l["stiffness"]) ** 0.4
        stiffness, d_y = l["stiffness"] * math.sqrt(design), 0.1 * design
        return 0.5 * stiffness * min(d, d_y) ** 2 + stiffness * d_y * max(0.0, d - d_y)
    n = exponent_of(l)
    return l["stiffness"] * d ** (n + 1) / (n + 1)


def asked_exactly(l):
    """Restitution of an undisturbed impact; None if unknown."""
    if l["law"] in ("linear_spring", "hertz"):
        return 1.0
    if "restitution" not in l or l.get("formula", "exact") != "exact" or "impact_velocity" in l:
        return None
    return l["restitution"]


def faults_of_impacts(run, index):
    """Faults in the rows of one link."""
    l, rows = run.case["links"][index], run.rows[index]
    spread = SPREAD * run.tolerance
    mass = run.reduced_mass(l) if run.simple else max(mass_of(s) for s in run.case["structures"])
    disturbance = run.disturbance(l) if run.simple else math.inf
    # A spring next to a rigid contact at rest follows the round-off of positions.
    rounding = l.get("stiffness", 0) * (OF_POSITIONS * math.sqrt(run.steps) * run.reach) ** exponent_of(l)
    for number, row in enumerate(rows):
        at = f"link {index} ({l['law']}), impact {number} at {row['t_start']:.9g}:"
        if not math.isnan(row["t_end"]):
            if not row["t_end"] >= row["t_start"]:
                yield f"{at} ends before it begins, at {row['t_end']:.17g}"
            if not row["t_start"] <= row["t_release"] <= row["t_end"]:
                yield f"{at} is released outside itself, at {row['t_release']:.17g}"
            if not row["v_separation"] >= -spread * run.speed - STILL:
                yield f"{at} ends with the bodies still closing, at {-row['v_separation']:.6g} m/s"
            if not row["energy_lost"] >= -spread * run.available:
                yield f"{at} gives {-row['energy_lost']:.6g} J"
        elif number + 1 < len(rows):
            yield f"{at} does not end, but another one follows"
        if number and not row["t_start"] >= rows[number - 1]["t_end"]:
            yield f"{at} begins inside the one before"
        if not row["v_approach"] >= -1e-12 * run.speed:
            yield f"{at} closes with {row['v_approach']:.6g} m/s"
        duration = (run.time[-1] if math.isnan(row["t_end"]) else row["t_end"]) - row["t_start"]
        if not row["impulse"] >= -(1e-9 * mass * run.speed + rounding * duration) and l["law"] != "kelvin_voigt":
            yield f"{at} pulls, {row['impulse']:.6g} N s"
        if l["law"] == "stereomechanical" or not run.simple:
            continue
        d, v = row["peak_penetration"], row["v_approach"]
        work = pressing_work(l, d, mass, v)
        if not work <= (1 + spread) * run.available * 1.01:
            yield f"{at} penetrates {d:.6g} m, which takes {work:.6g} J; the run had {run.available:.6g}"
        if math.isnan(row["t_end"]) or not run.alone(index, row):
            continue
        allowed = 0.5 * mass * v * v + mass * 1.05 * disturbance * d
        if not work <= (1 + spread) * allowed + 1e-12 * run.available:
            yield f"{at} penetrates {d:.6g} m, which takes {work:.6g} J; the approach brought {allowed:.6g} J"
        pushed = disturbance * (row["t_end"] - row["t_start"]) / v if v > 1e-5 else math.inf
        # A crushed surface returns its stored energy.
        expected = asked_exactly(l) if l["law"] != "elastoplastic" or number == 0 else None
        if expected is not None and pushed < 1e-3 and not abs(row["restitution"] - expected) <= spread + 5 * pushed:
            yield f"{at} restitution {row['restitution']:.9g} instead of {expected} in an undisturbed impact"


def faults_of_histories(run, index):
    """Faults in the motion and the force of one link."""
    l, rows, h = run.case["links"][index], run.rows[index], run.histories[index]
    t, d, force = h["time"], h["penetration"], h["force"]
    trace = 1e-9 * run.reach + 1e-12
    if not all(np.all(np.isfinite(series)) for series in h.values()):
        yield f"link {index} ({l['law']}): its history contains non-finite values"
    if l["law"] == "stereomechanical":
        if np.max(d, initial=0) > trace:
            yield f"link {index} ({l['law']}): rigid bodies overlap by {np.max(d):.6g} m at {t[np.argmax(d)]:.9g}"
        return
    begins = rows["t_start"]
    ends = np.where(np.isnan(rows["t_end"]), np.inf, rows["t_end"])
    which = np.searchsorted(begins, t, side="right") - 1
    inside = (which >= 0) & (t <= ends[np.maximum(which, 0)]) if len(rows) else np.zeros(len(t), bool)
    through = ~inside & (d > trace)
    if np.any(through):
        k = int(np.argmax(through))
        yield f"link {index} ({l['law']}): an overlap of {d[k]:.6g} m at {t[k]:.9g} outside every impact"
    if np.any(~inside & (force != 0)):
        k = int(np.argmax(~inside & (force != 0)))
        yield f"link {index} ({l['law']}): a force of {force[k]:.6g} N at {t[k]:.9g} outside every impact"
    # A located separation may follow the true one by round-off of the motion; the spring then pulls by this force.
    rounding = 1e-9 * float(np.max(force, initial=0)) + l["stiffness"] * (1e-11 * run.reach) ** exponent_of(l)
    if l["law"] != "kelvin_voigt" and np.min(force, initial=0) < -rounding:
        k = int(np.argmin(force))
        yield f"link {index} ({l['law']}): it pulls with {-force[k]:.6g} N at {t[k]:.9g}"
    apart = inside & (d < -trace)
    if np.any(apart):
        k = int(np.argmax(apart))
        yield f"link {index} ({l['law']}): the impact continues at {t[k]:.9g} s across an opening of {-d[k]:.6g} m"


def faults_of_bodies(run):
    """The momentum of a free body changes by the impulses of its links and of the ground only."""
    times = run.time
    for name, s in run.structures.items():
        u, v = run.motion[name]
        if not (np.all(np.isfinite(u)) and np.all(np.isfinite(v))):
            yield f"{name}: its motion contains non-finite values"
        if s["kind"] != "body":
            continue
        if run.case["ground"]:  # the record is sampled; its integral is known at the samples only
            continue
        gained = s["mass"] * (v[-1, 0] - s["velocity"])
        given = scale = 0.0
        for l, rows in zip(run.case["links"], run.rows):
            sign = (l["right"] == name) - (l["left"] == name)
            given += sign * float(np.sum(rows["impulse"]))
            scale += abs(sign) * float(np.sum(np.abs(rows["impulse"])))
        if not abs(gained - given) <= SPREAD * run.tolerance * scale + 1e-12 * s["mass"] * run.speed:
            yield f"{name}: gains {gained:.9g} N s where its links give {given:.9g}, until {times[-1]:.6g} s"


def faults_of(run):
    """All faults of a run, one per line."""
    if not run.imbalance < SPREAD * run.tolerance:
        yield f"the energies do not close: {run.imbalance}, {SPREAD * run.tolerance} is allowed"
    for index in range(len(run.case["links"])):
        yield from faults_of_impacts(run, index)
        yield from faults_of_histories(run, index)
    yield from faults_of_bodies(run)
    expected = run.case.get("touches")
    if expected is not None and bool(run.impacts) != expected:
        yield f"{run.impacts} impacts where the nearest approach {'overlaps' if expected else 'leaves a gap'}"
