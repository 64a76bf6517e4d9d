#!/usr/bin/env python3
"""Random rows of two to five bodies, all laws: every run ends, closes its energy and lets nobody through.

    python3 tests/program/stress.py build/pounding --seed 1 --count 10000 --jobs 2
    python3 tests/program/stress.py build/pounding --seed 1 --against-independent 200

Mass ratios from 1e-3 to 1e3, stiffness over six decades, restitutions 0.05 to 1, gaps from zero to wide, and the contacts
that are hard to integrate: bodies that graze, rest, and touch at one instant or nearly. A case that goes wrong is printed
whole, as an input file. Exit code 1 when there is one.

--against-independent compares impacts with the integrator of independent.py, which needs scipy.
"""
import argparse
import json
import math
import multiprocessing
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import h5py
import numpy as np

#: Laws by the unit of their stiffness, with the formulas that follow from a restitution.
LINEAR = {
    "linear_spring": [],
    "kelvin_voigt": ["exact", "anagnostopoulos"],
    "kelvin_voigt_no_tension": ["exact", "anagnostopoulos"],
    "komodromos": ["exact", "anagnostopoulos"],
    "modified_linear_viscoelastic": ["exact", "mahmoud_jankowski_2011", "simple"],
    "modified_kelvin": ["exact", "ye_2009_linear"],
}
HERTZ = {
    "hertz": [],
    "hertz_damped": ["exact", "lankarani_nikravesh", "hunt_crossley", "ye_2009", "hu_guo", "gonthier", "herbert_mcwhannell",
                     "lee_wang", "zhiying_qishao", "gharib_hurmuzlu"],
    "jankowski": ["exact", "jankowski_2005", "jankowski_2006"],
    "bilinear_hertz": ["exact", "muthukumar_desroches"],
    "viscous_hertz": ["exact", "antypov_elliott"],
    "kuwabara_kono": ["exact"],
    "adams_impact": ["exact"],
    "limited_damper": ["exact"],
}
LAWS = [*LINEAR, *HERTZ, "stereomechanical"]
DIRECT = {
    "kelvin_voigt": ("damping_ratio", 0, 0.9),
    "kelvin_voigt_no_tension": ("damping_ratio", 0, 3),
    "komodromos": ("damping_ratio", 0, 3),
    "modified_linear_viscoelastic": ("damping_ratio", 0, 5),
    "modified_kelvin": ("damping_factor", 0, 10),
    "hertz_damped": ("damping_factor", 0, 10),
    "jankowski": ("damping_ratio", 0, 5),
    "viscous_hertz": ("damping_ratio", 0, 4),
}
WITH_DESIGN_SPEED = ["modified_kelvin", "hertz_damped", "bilinear_hertz", "kuwabara_kono", "adams_impact", "limited_damper"]
RESTITUTIONS = [0.05, 0.1, 0.3, 0.5, 0.65, 0.8, 0.95, 1.0]
#: The loop of bilinear_hertz cannot lose more.
LEAST_BILINEAR = 0.5
#: A run may take this long [s].
SECONDS = 60
#: The balance and the impacts are sums over contacts that amplify one another's errors: this many tolerances.
SPREAD = 10

#: Comparisons are made at this tolerance, and may take the independent integrator so long [s].
FINE, LONGEST = 1e-6, 10


# ---- cases --------------------------------------------------------------------------------------------------------------


def decades(chance, low, high):
    return 10 ** chance.uniform(low, high)


def link(chance, left, right, gap, restitutions=RESTITUTIONS, laws=LAWS):
    law = chance.choice(laws)
    own = {"left": left, "right": right, "gap": gap, "law": law}
    if law != "stereomechanical":
        own["stiffness"] = decades(chance, 5, 11) if law in LINEAR else decades(chance, 6, 12)
    if law == "adams_impact":
        own["depth"] = decades(chance, -4, -2.5)
    if law in DIRECT and chance.random() < 0.08:
        name, low, high = DIRECT[law]
        own[name] = chance.uniform(low, high)
        return own
    if law in ("linear_spring", "hertz"):
        return own
    own["restitution"] = chance.choice(restitutions)
    formulas = LINEAR.get(law) or HERTZ.get(law) or ["exact"]
    if chance.random() < 0.3:
        own["formula"] = chance.choice(formulas) if law != "stereomechanical" else "exact"
    if law == "stereomechanical":
        own.pop("formula", None)
    if law == "bilinear_hertz":
        own["restitution"] = max(own["restitution"], LEAST_BILINEAR)
    if law in WITH_DESIGN_SPEED and chance.random() < 0.08:
        own["impact_velocity"] = decades(chance, -2, 0.5)
    return own


def body(chance, number, speed):
    return {"name": f"b{number}", "kind": "body", "mass": decades(chance, 3, 6), "velocity": speed}


def oscillator(chance, number, speed):
    return {"name": f"b{number}", "kind": "oscillator", "mass": decades(chance, 3, 6), "period": decades(chance, -1.3, 0.5),
            "damping": chance.choice([0, 0.02, 0.05, 0.1]), "velocity": speed}


def wall(number):
    return {"name": f"b{number}", "kind": "wall", "velocity": 0.0}


def shaking(chance):
    if chance.random() < 0.75:
        return {"kind": "harmonic", "amplitude": chance.uniform(0.5, 5), "period": chance.uniform(0.1, 1.5),
                "duration": chance.uniform(0.5, 3)}
    return {"kind": "pulse", "shape": chance.choice(["half_sine", "sine", "rectangle"]), "amplitude": chance.uniform(-5, 5),
            "start": chance.choice([0.0, chance.uniform(0, 1)]), "duration": chance.uniform(0.2, 1.5)}


def mixed(chance):
    """Anything beside anything."""
    count, structures = chance.randint(2, 5), []
    for k in range(count):
        speed = chance.choice([0.0, chance.uniform(-1, 1)])
        if count > 2 and k in (0, count - 1) and chance.random() < 0.2:
            structures.append(wall(k))
        else:
            structures.append((oscillator if chance.random() < 0.8 else body)(chance, k, speed))
    gap = chance.choice([0, 1e-3, 5e-3, 0.02, 0.1, 0.5])
    links = []
    for k in range(count - 1):
        own = gap if chance.random() < 0.5 else gap + chance.choice([1e-6, chance.uniform(0, 0.02)])
        links.append(link(chance, f"b{k}", f"b{k + 1}", own))
    return {"structures": structures, "links": links, "ground": shaking(chance) if chance.random() < 0.7 else None,
            "duration": 3.0}


def grazing(chance):
    """Two oscillators in free vibration whose nearest approach is the gap but for a millionth to a hundredth."""
    left = oscillator(chance, 0, chance.uniform(0.1, 1))
    right = oscillator(chance, 1, chance.choice([0.0, chance.uniform(-1, 1)]))
    if chance.random() < 0.3:
        right = wall(1)
    duration = chance.uniform(1.0, 3) * left["period"]

    def closure(t):
        total = 0.0
        for sign, s in ((1, left), (-1, right)):
            if s["kind"] == "oscillator":
                w, z = 2 * math.pi / s["period"], s["damping"]
                damped = w * math.sqrt(1 - z * z)
                total = total + sign * s["velocity"] / damped * np.exp(-z * w * t) * np.sin(damped * t)
        return total

    t, width = np.linspace(0, duration, 20001), duration / 20000
    for _ in range(4):
        nearest = t[np.argmax(closure(t))]
        t, width = np.linspace(max(0, nearest - width), min(duration, nearest + width), 201), width / 50
    peak = float(np.max(closure(t)))
    part = chance.choice([-1, 1]) * decades(chance, -6, -2)
    tolerance = chance.choice([1e-4, 1e-5, 1e-6])
    case = {"structures": [left, right], "links": [link(chance, "b0", "b1", peak * (1 + part))], "ground": None,
            "duration": duration, "tolerance": tolerance}
    swing = sum(abs(s["velocity"]) * s.get("period", 0) / (2 * math.pi) for s in (left, right))
    if abs(part) * peak > SPREAD * tolerance * swing and nearest < 0.99 * duration:
        case["touches"] = part < 0
    return case


def resting(chance):
    """Bodies at zero gap, or nearly, that the ground presses on a wall, for good or until it turns."""
    count = chance.randint(2, 5)
    structures = [(body if chance.random() < 0.7 else oscillator)(chance, k, 0.0) for k in range(count - 1)] + [wall(count - 1)]
    links = [link(chance, f"b{k}", f"b{k + 1}", chance.choice([0, 0, 0, 1e-9, 1e-6, 1e-3]), [0.05, 0.1, 0.2, 0.3])
             for k in range(count - 1)]
    ground = {"kind": "pulse", "shape": chance.choice(["rectangle", "rectangle", "half_sine", "sine"]),
              "amplitude": -chance.uniform(0.1, 5), "start": 0.0, "duration": chance.choice([1.0, 2.5])}
    return {"structures": structures, "links": links, "ground": ground, "duration": 2.0}


def together(chance):
    """Rows that close everywhere at one instant, or within gaps that differ by 1e-9 to 1e-5 m."""
    count, speed = chance.randint(3, 5), chance.uniform(0.1, 1)
    period, damping, bodies = decades(chance, -1, 0.5), chance.choice([0, 0.05]), chance.random() < 0.4
    structures = []
    for k in range(count):
        own = (speed * ((count - 1) / 2 - k))
        structures.append(body(chance, k, own) if bodies else
                          {"name": f"b{k}", "kind": "oscillator", "mass": decades(chance, 3, 6), "period": period,
                           "damping": damping, "velocity": own})
    gap = chance.choice([0, 1e-3, 0.1 * speed * period])
    links = []
    for k in range(count - 1):
        more = 0 if chance.random() < 0.4 else decades(chance, -9, -5)
        links.append(link(chance, f"b{k}", f"b{k + 1}", gap + more))
    if chance.random() < 0.2:  # a second link beside the first
        links.append(link(chance, "b0", "b1", gap + chance.choice([0, decades(chance, -9, -5)])) | {"name": "beside"})
    return {"structures": structures, "links": links, "ground": shaking(chance) if chance.random() < 0.3 else None,
            "duration": chance.uniform(0.5, 3)}


def free(chance):
    """Bodies without a ground motion: undisturbed impacts, where the asked restitution must come out."""
    count = chance.choice([2, 2, 2, 3, 4, 5])
    structures = [body(chance, k, chance.uniform(-1, 1)) for k in range(count)]
    structures[0]["velocity"] = chance.uniform(0.2, 2)
    if chance.random() < 0.3:
        structures[-1] = wall(count - 1)
    links = [link(chance, f"b{k}", f"b{k + 1}", chance.choice([0, chance.uniform(1e-3, 0.05)])) for k in range(count - 1)]
    return {"structures": structures, "links": links, "ground": None, "duration": 2.0}


FAMILIES = {mixed: 45, grazing: 12, resting: 13, together: 15, free: 15}


def case_of(seed, number):
    chance = random.Random(seed * 1_000_000 + number)
    family = chance.choices(list(FAMILIES), FAMILIES.values())[0]
    case = family(chance)
    case.setdefault("tolerance", chance.choice([1e-4, 1e-4, 1e-4, 1e-3, 1e-5]))
    return case | {"family": family.__name__}


def input_file(case):
    """The case as the program reads it."""
    def flow(pairs):
        return "{" + ", ".join(f"{key}: {value}" for key, value in pairs.items()) + "}"

    text = f"title: {case['family']}\n"
    if case["ground"]:
        ground = {key: value for key, value in case["ground"].items() if key != "kind"}
        text += f"ground_motion: {{{case['ground']['kind']}: {flow(ground)}}}\n"
    text += "structures:\n"
    for s in case["structures"]:
        if s["kind"] == "wall":
            text += f"  {s['name']}: {{wall: {{}}}}\n"
            continue
        own = flow({key: s[key] for key in ("mass", "period", "damping") if key in s})
        text += f"  {s['name']}: {{{s['kind']}: {own}, initial_velocity: {s['velocity']}}}\n"
    text += "links:\n"
    for l in case["links"]:
        own = {"between": f"[{l['left']}, {l['right']}]"} | {k: v for k, v in l.items() if k not in ("left", "right")}
        text += f"  - {flow(own)}\n"
    return text + f"analysis: {{duration: {case['duration']}, tolerance: {case['tolerance']}}}\n"


# ---- what must hold -----------------------------------------------------------------------------------------------------


class Run:
    """The results of a case, as plain arrays."""

    def __init__(self, case, path, summary):
        self.case, self.imbalance, self.steps = case, summary["energy"]["error"], summary["solver"]["steps"]
        with h5py.File(path) as file:
            rows = file["impacts"][()]
            names = [l.get("name", f"{l['left']}-{l['right']}") for l in case["links"]]
            labels = rows["link"].astype(str)
            self.rows = [rows[labels == name] for name in names]
            self.impacts = len(rows)
            self.histories = [{key: data[()] for key, data in file["links"][name].items()} for name in names]
            self.energy = {key: data[()] for key, data in file["energy"].items()}
            self.ground = file["ground/acceleration"][()] if "ground" in file else np.zeros(1)
            self.time = file["time"][()]
            self.motion = {}
            for s in case["structures"]:
                own = file["structures"][s["name"]]
                self.motion[s["name"]] = tuple(own[key][()].reshape(len(self.time), -1) for key in ("displacement", "velocity"))
        self.structures = {s["name"]: s for s in case["structures"]}
        self.tolerance = case["tolerance"]
        self.reach = max(float(np.max(np.abs(u), initial=0)) for u, _ in self.motion.values())
        self.speed = max(float(np.max(np.abs(v), initial=0)) for _, v in self.motion.values())
        # The input is known at the output times; between them it may rise by what the ground does in one of them.
        push = sum(s.get("mass", 0) for s in case["structures"]) * float(np.max(np.abs(self.ground), initial=0))
        self.available = float(np.max(self.energy["input"])) + push * self.speed * float(np.max(np.diff(self.time)))

    def ends(self, l):
        return [self.structures[l["left"]], self.structures[l["right"]]]

    def reduced_mass(self, l):
        return 1 / sum(1 / s["mass"] for s in self.ends(l) if s["kind"] != "wall")

    def disturbance(self, l):
        """Largest relative acceleration of the two ends by anything but this contact and its neighbours [m/s^2]."""
        total = 0.0
        for s in self.ends(l):
            if s["kind"] == "wall":
                total += float(np.max(np.abs(self.ground)))
            if s["kind"] == "oscillator":
                w, (u, v) = 2 * math.pi / s["period"], self.motion[s["name"]]
                total += w * w * float(np.max(np.abs(u))) + 2 * s["damping"] * w * float(np.max(np.abs(v)))
        return total

    def alone(self, index, row):
        """No other link presses on these bodies during the impact."""
        own = self.case["links"][index]
        moving = {s["name"] for s in self.ends(own) if s["kind"] != "wall"}
        for other, rows in zip(self.case["links"], self.rows):
            if other is own or not moving & {other["left"], other["right"]}:
                continue
            if np.any((rows["t_start"] <= row["t_end"]) & ~(rows["t_end"] < row["t_start"])):
                return False
        return True


def pressing_work(l, d, mass, speed):
    """Least work that presses a link from touch to the penetration d [J]; nothing that is known for bilinear_hertz."""
    if l["law"] == "bilinear_hertz":
        # K1 >= K_eff up to d_y, and beyond it the force does not fall.
        v = max(l.get("impact_velocity", speed), 1e-6)
        design = (1.25 * mass * v * v / l["stiffness"]) ** 0.4
        stiffness, d_y = l["stiffness"] * math.sqrt(design), 0.1 * design
        return 0.5 * stiffness * min(d, d_y) ** 2 + stiffness * d_y * max(0.0, d - d_y)
    n = 1.0 if l["law"] in LINEAR else 1.5
    return l["stiffness"] * d ** (n + 1) / (n + 1)


def asked_exactly(l):
    """The restitution that an undisturbed impact must give, or nothing."""
    if l["law"] in ("linear_spring", "hertz"):
        return 1.0
    if "restitution" not in l or l.get("formula", "exact") != "exact" or "impact_velocity" in l:
        return None
    return l["restitution"]


def faults_of_impacts(run, index):
    """Faults in the rows of one link."""
    l, rows, mass = run.case["links"][index], run.rows[index], run.reduced_mass(run.case["links"][index])
    spread = SPREAD * run.tolerance
    disturbance = run.disturbance(l)
    for number, row in enumerate(rows):
        at = f"link {index} ({l['law']}), impact {number} at {row['t_start']:.9g}:"
        if not math.isnan(row["t_end"]):
            if not row["t_end"] >= row["t_start"]:
                yield f"{at} ends before it begins, at {row['t_end']:.17g}"
            if not row["t_start"] <= row["t_release"] <= row["t_end"]:
                yield f"{at} is released outside itself, at {row['t_release']:.17g}"
            if not row["v_separation"] >= -spread * run.speed:
                yield f"{at} ends while the bodies close, at {-row['v_separation']:.6g} m/s"
            if not row["energy_lost"] >= -spread * run.available:
                yield f"{at} gives {-row['energy_lost']:.6g} J"
        elif number + 1 < len(rows):
            yield f"{at} does not end, but another one follows"
        if number and not row["t_start"] >= rows[number - 1]["t_end"]:
            yield f"{at} begins inside the one before"
        if not row["v_approach"] >= -1e-12 * run.speed:
            yield f"{at} closes with {row['v_approach']:.6g} m/s"
        if not row["impulse"] >= -1e-9 * mass * run.speed and l["law"] != "kelvin_voigt":
            yield f"{at} pulls, {row['impulse']:.6g} N s"
        if l["law"] == "stereomechanical":
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
        expected = asked_exactly(l)
        if expected is not None and pushed < 1e-3 and not abs(row["restitution"] - expected) <= spread + 5 * pushed:
            yield f"{at} restitution {row['restitution']:.9g} where {expected} was asked and nothing disturbs"


def faults_of_histories(run, index):
    """Faults in the motion and the force of one link."""
    l, rows, h = run.case["links"][index], run.rows[index], run.histories[index]
    t, d, force = h["time"], h["penetration"], h["force"]
    trace = 1e-9 * run.reach + 1e-12
    if not all(np.all(np.isfinite(series)) for series in h.values()):
        yield f"link {index} ({l['law']}): its history holds values that are not finite"
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
    # A located separation may lie behind the true one by rounding of the motion; the spring then pulls so much.
    rounding = 1e-9 * float(np.max(force, initial=0)) + l["stiffness"] * (1e-11 * run.reach) ** (1 if l["law"] in LINEAR else 1.5)
    if l["law"] != "kelvin_voigt" and np.min(force, initial=0) < -rounding:
        k = int(np.argmin(force))
        yield f"link {index} ({l['law']}): it pulls with {-force[k]:.6g} N at {t[k]:.9g}"
    apart = inside & (d < -trace)
    if np.any(apart):
        k = int(np.argmax(apart))
        yield f"link {index} ({l['law']}): the impact goes on at {t[k]:.9g} across an opening of {-d[k]:.6g} m"


def faults_of_bodies(run):
    """A free body gains the impulses of its links and of the ground, no more."""
    times = run.time
    for name, s in run.structures.items():
        u, v = run.motion[name]
        if not (np.all(np.isfinite(u)) and np.all(np.isfinite(v))):
            yield f"{name}: its motion holds values that are not finite"
        if s["kind"] != "body":
            continue
        if run.case["ground"]:  # the record is sampled; its integral is known to the samples only
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
    """Everything that is wrong with a run, one line each."""
    if not run.imbalance < SPREAD * run.tolerance:
        yield f"the energies do not close: {run.imbalance}, {SPREAD * run.tolerance} is allowed"
    for index in range(len(run.case["links"])):
        yield from faults_of_impacts(run, index)
        yield from faults_of_histories(run, index)
    yield from faults_of_bodies(run)
    expected = run.case.get("touches")
    if expected is not None and bool(run.impacts) != expected:
        yield f"{run.impacts} impacts where the nearest approach {'overlaps' if expected else 'leaves a gap'}"


# ---- the run ------------------------------------------------------------------------------------------------------------


def program_run(program, case, folder):
    """(run, message): the run is None when the program fails, with the reason."""
    model, results = Path(folder) / "model.yaml", Path(folder) / "results.h5"
    model.write_text(input_file(case))
    try:
        done = subprocess.run([program, "run", model, "-o", results, "--json"], capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return None, f"it took more than {SECONDS} s"
    if done.returncode != 0:
        return None, f"exit code {done.returncode}: {done.stderr}"
    return Run(case, results, json.loads(done.stdout)), None


def examine(task):
    """One case: what is wrong with it, and what it took."""
    program, seed, number = task
    case, begin = case_of(seed, number), time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        run, message = program_run(program, case, folder)
        outcome = {"number": number, "family": case["family"], "seconds": time.perf_counter() - begin, "text": input_file(case)}
        if message:
            return outcome | {"faults": [message]}
        return outcome | {"faults": list(faults_of(run)), "impacts": run.impacts, "steps": run.steps,
                          "imbalance": run.imbalance / case["tolerance"]}


def progress(text):
    if sys.stderr.isatty():
        print(f"\r{text}", end="", file=sys.stderr)


def report(outcome, kept):
    print(f"case {outcome['number']} ({outcome['family']}):")
    for fault in outcome["faults"][:5]:
        print(f"  {fault.strip()}")
    print(outcome["text"], flush=True)
    if kept:
        kept.mkdir(parents=True, exist_ok=True)
        lines = "".join(f"# {line}\n" for fault in outcome["faults"] for line in fault.strip().splitlines())
        (kept / f"case{outcome['number']}.yaml").write_text(lines + outcome["text"])


def stress(chosen):
    tasks = [(chosen.program, chosen.seed, number) for number in range(chosen.first, chosen.first + chosen.count)]
    impacts = steps = faults = done = 0
    slowest, worst, families = (0.0, -1), (0.0, -1), Counter()
    begin = time.perf_counter()
    with multiprocessing.Pool(chosen.jobs) as pool:
        for outcome in pool.imap_unordered(examine, tasks, chunksize=4):
            done += 1
            families[outcome["family"]] += 1
            impacts += outcome.get("impacts", 0)
            steps += outcome.get("steps", 0)
            slowest = max(slowest, (outcome["seconds"], outcome["number"]))
            worst = max(worst, (outcome.get("imbalance", 0.0), outcome["number"]))
            if outcome["faults"]:
                faults += 1
                report(outcome, chosen.keep)
            progress(f"{done} of {chosen.count}, {faults} faults")
    progress("\n")
    print(f"{chosen.count} cases ({', '.join(f'{n} {name}' for name, n in families.items())}), {impacts} impacts, {steps} steps, "
          f"{time.perf_counter() - begin:.0f} s")
    print(f"slowest case {slowest[1]}: {slowest[0]:.2f} s; worst imbalance, case {worst[1]}: {worst[0]:.3g} tolerances")
    print(f"{faults} faults")
    return faults


def compare_one(task):
    """One case against independent.py: (number, verdict, text, message)."""
    from independent import TooLong
    from judging import judge
    program, seed, number = task
    case = case_of(seed, number) | {"tolerance": FINE}
    text = input_file(case)
    with tempfile.TemporaryDirectory() as folder:
        run, message = program_run(program, case, folder)
    if message:
        return number, None, text, message
    try:
        return number, judge(case, run.rows, LONGEST), text, None
    except TooLong:
        return number, None, text, None


def compare(chosen):
    """Compares cases until the wanted number has been judged; prints how each agreed. Returns the number of faults."""
    wanted, verdicts, faults, skipped = chosen.against_independent, Counter(), 0, 0
    compared, present = Counter(), Counter()
    tasks = ((chosen.program, chosen.seed, number) for number in range(chosen.first, chosen.first + 100 * wanted))
    with multiprocessing.Pool(chosen.jobs) as pool:
        for number, verdict, text, message in pool.imap(compare_one, tasks):
            if verdict is None and message is None:
                skipped += 1
                continue
            agreed = verdict.agreed if verdict else "no results"
            verdicts[agreed] += 1
            if verdict:
                compared[agreed] += verdict.compared
                present[agreed] += verdict.impacts
            if agreed in ("no", "no results"):
                faults += 1
                report({"number": number, "family": "against independent", "faults": [message or verdict.why], "text": text},
                       chosen.keep)
            progress(f"{verdicts.total()} of {wanted}, {faults} faults")
            if verdicts.total() == wanted:
                pool.terminate()
                break
    progress("\n")
    print(f"{wanted} cases at tolerance {FINE} against the independent integrator; {skipped} more took it over {LONGEST} s")
    for agreed, count in verdicts.most_common():
        print(f"  {agreed}: {count} cases, {compared[agreed]} of {present[agreed]} impacts compared")
    print(f"{faults} faults")
    return faults


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("program")
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--count", type=int, default=10000)
    words.add_argument("--first", type=int, default=0, help="number of the first case")
    words.add_argument("--jobs", type=int, default=1)
    words.add_argument("--keep", type=Path, metavar="FOLDER", help="write the cases that go wrong there")
    words.add_argument("--against-independent", type=int, metavar="COUNT", help="compare so many cases with independent.py")
    chosen = words.parse_args()
    sys.exit(1 if (stress if chosen.against_independent is None else compare)(chosen) else 0)


if __name__ == "__main__":
    main()
