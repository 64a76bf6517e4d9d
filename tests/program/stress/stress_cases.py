"""Random cases for stress.py: rows of bodies and oscillators, yielding shear buildings, and frames with and without
hinges and friction, under all laws."""

import math
import random

import numpy as np

#: Laws by the unit of their stiffness, with their formulas for a given restitution.
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
    "hertz_damped": """
        exact lankarani_nikravesh hunt_crossley ye_2009 hu_guo gonthier herbert_mcwhannell lee_wang
        zhiying_qishao gharib_hurmuzlu
    """.split(),
    "jankowski": ["exact", "jankowski_2005", "jankowski_2006"],
    "bilinear_hertz": ["exact", "muthukumar_desroches"],
    "viscous_hertz": ["exact", "antypov_elliott"],
    "kuwabara_kono": ["exact"],
    "adams_impact": ["exact"],
    "limited_damper": ["exact"],
    "elastoplastic": ["exact"],
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
#: Laws of storeys and of hinges in series, with values of their parameters in addition to the yield force or moment and
#: the hardening.
SPRINGS = {
    "bilinear": {},
    "menegotto_pinto": {"memory": ["nested", "last"], "R0": [14, 20]},
    "peak_oriented": {"unloading": [0, 0.3, 0.5]},
    "bouc_wen": {"exponent": [1, 1.5, 2, 5], "gamma_share": [0, 0.3, 0.5]},
}
WITH_DESIGN_SPEED = [
    "modified_kelvin",
    "hertz_damped",
    "bilinear_hertz",
    "kuwabara_kono",
    "adams_impact",
    "limited_damper",
]
RESTITUTIONS = [0.05, 0.1, 0.3, 0.5, 0.65, 0.8, 0.95, 1.0]
#: The loop of bilinear_hertz cannot dissipate more.
LEAST_BILINEAR = 0.5
#: The energy balance and the impacts are sums over contacts that amplify one another's errors: allowed error in
#: tolerances.
SPREAD = 10


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
    # Its stiffness follows from the closing speed, which a closed gap does not have.
    if law == "bilinear_hertz" and gap <= 1e-3:
        own.setdefault("impact_velocity", 0.5)
    return own


def body(chance, number, speed):
    return {"name": f"b{number}", "kind": "body", "mass": decades(chance, 3, 6), "velocity": speed}


def oscillator(chance, number, speed):
    return {
        "name": f"b{number}",
        "kind": "oscillator",
        "mass": decades(chance, 3, 6),
        "period": decades(chance, -1.3, 0.5),
        "damping": chance.choice([0, 0.02, 0.05, 0.1]),
        "velocity": speed,
    }


def wall(number):
    return {"name": f"b{number}", "kind": "wall", "velocity": 0.0}


def storeys_of(chance, storeys, low, high):
    """A value for each storey, or one for all."""
    first = decades(chance, low, high)
    return [first * chance.uniform(0.5, 2) for _ in range(storeys)] if chance.random() < 0.3 else first


def building(chance, number, storeys, yields):
    """A shear building whose first period is about 0.1 s per storey; a yielding one yields at 2 to 40 % of its
    weight."""
    mass = storeys_of(chance, storeys, 4, 6)
    least = min(mass) if isinstance(mass, list) else mass
    stiffness = storeys_of(chance, storeys, math.log10(least) + 2.7, math.log10(least) + 4)
    own = {
        "name": f"b{number}",
        "kind": "shear_building",
        "storeys": storeys,
        "mass": mass,
        "stiffness": stiffness,
        "damping": chance.choice([0, 0.02, 0.05]),
        "velocity": chance.choice([0.0, chance.uniform(-0.5, 0.5)]),
    }
    if yields:
        own["yield_force"] = chance.uniform(0.02, 0.4) * 9.81 * least * storeys
        own["hardening"] = chance.choice([0, 0.02, 0.2])
    if yields == "by any law":
        law = chance.choice(list(SPRINGS))
        words = ", ".join(f"{key}: {chance.choice(values)}" for key, values in SPRINGS[law].items())
        own["spring"] = (
            f"{{{law}: {{yield_force: {own.pop('yield_force')}, hardening: {own.pop('hardening')}"
            f"{', ' if words else ''}{words}}}}}"
        )
    return own


def quake(chance):
    """A harmonic, a pulse or an artificial earthquake."""
    if chance.random() < 0.5:
        return shaking(chance)
    duration = chance.uniform(2, 5)
    return {
        "kind": "synthetic",
        "seed": chance.randrange(10**6),
        "duration": duration,
        "pga": chance.uniform(0.5, 6),
        "soil": chance.choice(["firm", "medium", "soft"]),
        "step": 0.02,
    }


def buildings(chance, yields):
    """A row of shear buildings, or of one and oscillators, linked floor by floor."""
    count = chance.choice([2, 2, 2, 3])
    structures = [building(chance, k, chance.randint(1, 8), yields) for k in range(count)]
    gap = chance.choice([0, 1e-3, 5e-3, 0.02, 0.05])
    links = []
    for k in range(count - 1):
        shared = min(structures[k]["storeys"], structures[k + 1]["storeys"])
        like = link(chance, f"b{k}", f"b{k + 1}", gap)
        for floor in range(1, shared + 1):
            own = like | {"left": f"b{k}.{floor}", "right": f"b{k + 1}.{floor}"}
            links.append(own | {"gap": gap + chance.choice([0, 0, 1e-6, chance.uniform(0, 0.01)])})
    ground = quake(chance)
    return {"structures": structures, "links": links, "ground": ground, "duration": min(4.0, ground["duration"] + 1)}


def towers(chance):
    return buildings(chance, None)


def yielding(chance):
    return buildings(chance, chance.choice(["bilinear", "by any law", "by any law"]))


def frames(chance):
    """Two plane frames of equal storey height. Under their weight they lean by micrometres, and a gap separates
    them."""
    height, width = chance.choice([3.0, 3.5]), chance.choice([4.0, 6.0])
    storeys, bays = [chance.randint(1, 4) for _ in range(2)], [chance.randint(1, 2) for _ in range(2)]
    gravity = chance.random() < 0.5
    gap = chance.choice([1e-3, 5e-3, 0.02] if gravity else [0, 0, 1e-3, 5e-3, 0.02])
    deep = [chance.choice([0.3, 0.4, 0.5]) for _ in range(2)]
    structures = [
        {
            "name": f"b{k}",
            "kind": "frame",
            "storeys": storeys[k],
            "bays": bays[k],
            "height": height,
            "width": width,
            "depth": deep[k],
            "origin": k * (bays[0] * width + gap),
            "floor_mass": decades(chance, 4, 5),
            "damping": chance.choice([0.02, 0.05]),
            "gravity": gravity,
            "velocity": chance.choice([0.0, chance.uniform(-0.3, 0.3)]),
        }
        for k in range(2)
    ]
    if chance.random() < 0.2:  # equal frames, whose floors touch at the same instant
        structures[1] = structures[0] | {
            "name": "b1",
            "origin": structures[1]["origin"],
            "velocity": structures[1]["velocity"],
        }
    like = link(chance, "b0", "b1", gap, laws=[law for law in LAWS if law != "stereomechanical"])
    links = [
        like | {"left": f"b0.{floor}", "right": f"b1.{floor}"}
        for floor in range(1, min(s["storeys"] for s in structures) + 1)
    ]
    ground = quake(chance)
    return {"structures": structures, "links": links, "ground": ground, "duration": min(2.0, ground["duration"])}


def hinges(chance, s):
    """Hinges of a frame that carries 4 to 40 % of its weight as a sway mechanism of its storeys and feet, all by one
    law."""
    weight = 9.81 * s["storeys"] * (s["floor_mass"] + 5e3 * (s["bays"] + 1))
    moment = chance.uniform(0.04, 0.4) * weight * s["height"] / (2 * (s["bays"] + 1))
    hardening = chance.choice([0, 0.01, 0.05, 0.2])
    law, stiff = chance.choice(["rigid_plastic", "rigid_plastic", *SPRINGS]), chance.choice([1, 10, 100])

    def entry(at, strength):
        if law == "rigid_plastic":
            return f"{{at: {at}, yield_moment: {strength}, hardening: {hardening}}}"
        words = {"yield_moment": strength, "spring_hardening": hardening, "stiffness_factor": stiff}
        words |= {key: chance.choice(values) for key, values in SPRINGS[law].items()}
        return f"{{at: {at}, {law}: {{{', '.join(f'{key}: {value}' for key, value in words.items())}}}}}"

    beams = moment * chance.uniform(0.3, 1)
    both_ways = (
        f"[{beams}, {-beams * chance.uniform(0.5, 2)}]" if law == "rigid_plastic" and chance.random() < 0.3 else beams
    )
    return {
        "beams": entry(chance.choice(["both", "both", "start"]), both_ways),
        "columns": entry(chance.choice(["feet", "feet", "both"]), moment),
    }


def hinged(chance):
    """Two plane frames whose members yield at their ends; the second one sometimes remains elastic."""
    case = frames(chance)
    for s in case["structures"]:
        s["gravity"] = False
    for s in case["structures"][: chance.choice([1, 2, 2])]:
        s["hinges"] = hinges(chance, s)
    return case


def sticking(chance, coefficient):
    """Friction with a tangential stiffness, a ratio more often than a constant one."""
    friction = {"coefficient": coefficient}
    if chance.random() < 0.6:
        friction["tangential_ratio"] = chance.uniform(0.3, 1.2)
    else:
        friction["tangential_stiffness"] = decades(chance, 6, 9)
    if chance.random() < 0.4:
        friction |= {"static": coefficient * chance.uniform(1, 1.6), "stribeck_velocity": decades(chance, -3, -1)}
    return friction


def rubbing(chance):
    """Two plane frames under horizontal and vertical ground motion with friction at their links; the members usually yield."""
    case = hinged(chance) if chance.random() < 0.7 else frames(chance)
    for own in case["links"]:
        own["friction"] = chance.choice([0.05, 0.2, 0.3, 0.6])
        if chance.random() < 0.3:
            own["sliding_velocity"] = decades(chance, -3, -1.5)
        elif chance.random() < 0.5:
            own["friction"] = sticking(chance, own["friction"])
    return case | {"vertical": quake(chance)}


def shaking(chance):
    if chance.random() < 0.75:
        return {
            "kind": "harmonic",
            "amplitude": chance.uniform(0.5, 5),
            "period": chance.uniform(0.1, 1.5),
            "duration": chance.uniform(0.5, 3),
        }
    return {
        "kind": "pulse",
        "shape": chance.choice(["half_sine", "sine", "rectangle"]),
        "amplitude": chance.uniform(-5, 5),
        "start": chance.choice([0.0, chance.uniform(0, 1)]),
        "duration": chance.uniform(0.2, 1.5),
    }


def mixed(chance):
    """Any structure next to any other."""
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
    return {
        "structures": structures,
        "links": links,
        "ground": shaking(chance) if chance.random() < 0.7 else None,
        "duration": 3.0,
    }


def grazing(chance):
    """Two oscillators in free vibration whose closest approach differs from the gap by a fraction of 1e-6 to 1e-2."""
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
    case = {
        "structures": [left, right],
        "links": [link(chance, "b0", "b1", peak * (1 + part))],
        "ground": None,
        "duration": duration,
        "tolerance": tolerance,
    }
    swing = sum(abs(s["velocity"]) * s.get("period", 0) / (2 * math.pi) for s in (left, right))
    if abs(part) * peak > SPREAD * tolerance * swing and nearest < 0.99 * duration:
        case["touches"] = part < 0
    return case


def resting(chance):
    """Bodies at zero or nearly zero gap that the ground presses against a wall, permanently or until it reverses."""
    count = chance.randint(2, 5)
    structures = [(body if chance.random() < 0.7 else oscillator)(chance, k, 0.0) for k in range(count - 1)] + [
        wall(count - 1)
    ]
    links = [
        link(chance, f"b{k}", f"b{k + 1}", chance.choice([0, 0, 0, 1e-9, 1e-6, 1e-3]), [0.05, 0.1, 0.2, 0.3])
        for k in range(count - 1)
    ]
    ground = {
        "kind": "pulse",
        "shape": chance.choice(["rectangle", "rectangle", "half_sine", "sine"]),
        "amplitude": -chance.uniform(0.1, 5),
        "start": 0.0,
        "duration": chance.choice([1.0, 2.5]),
    }
    return {"structures": structures, "links": links, "ground": ground, "duration": 2.0}


def together(chance):
    """Rows that close everywhere at the same instant, or with gaps that differ by 1e-9 to 1e-5 m."""
    count, speed = chance.randint(3, 5), chance.uniform(0.1, 1)
    period, damping, bodies = decades(chance, -1, 0.5), chance.choice([0, 0.05]), chance.random() < 0.4
    structures = []
    for k in range(count):
        own = speed * ((count - 1) / 2 - k)
        structures.append(
            body(chance, k, own)
            if bodies
            else {
                "name": f"b{k}",
                "kind": "oscillator",
                "mass": decades(chance, 3, 6),
                "period": period,
                "damping": damping,
                "velocity": own,
            }
        )
    gap = chance.choice([0, 1e-3, 0.1 * speed * period])
    links = []
    for k in range(count - 1):
        more = 0 if chance.random() < 0.4 else decades(chance, -9, -5)
        links.append(link(chance, f"b{k}", f"b{k + 1}", gap + more))
    if chance.random() < 0.2:  # a second link parallel to the first
        links.append(link(chance, "b0", "b1", gap + chance.choice([0, decades(chance, -9, -5)])) | {"name": "beside"})
    return {
        "structures": structures,
        "links": links,
        "ground": shaking(chance) if chance.random() < 0.3 else None,
        "duration": chance.uniform(0.5, 3),
    }


def free(chance):
    """Bodies without ground motion: undisturbed impacts, which must return the target restitution."""
    count = chance.choice([2, 2, 2, 3, 4, 5])
    structures = [body(chance, k, chance.uniform(-1, 1)) for k in range(count)]
    structures[0]["velocity"] = chance.uniform(0.2, 2)
    if chance.random() < 0.3:
        structures[-1] = wall(count - 1)
    links = [
        link(chance, f"b{k}", f"b{k + 1}", chance.choice([0, chance.uniform(1e-3, 0.05)])) for k in range(count - 1)
    ]
    return {"structures": structures, "links": links, "ground": None, "duration": 2.0}


FAMILIES = {
    mixed: 35,
    grazing: 11,
    resting: 12,
    together: 13,
    free: 9,
    towers: 8,
    yielding: 8,
    frames: 2,
    hinged: 1,
    rubbing: 1,
}


#: Families with structures that independent.py does not support.
BEYOND_INDEPENDENT = ("towers", "yielding", "frames", "hinged", "rubbing")


def case_of(seed, number, only=None):
    """The case of this seed and number; with `only`, its next random numbers generate a case of that family."""
    chance = random.Random(seed * 1_000_000 + number)
    family = chance.choices(list(FAMILIES), FAMILIES.values())[0]
    family = next((one for one in FAMILIES if one.__name__ == only), family)
    case = family(chance)
    case.setdefault("tolerance", chance.choice([1e-4, 1e-4, 1e-4, 1e-3, 1e-5]))
    return case | {"family": family.__name__}


#: More impacts than this are systematic if a rigid contact dissipates no energy.
MANY_BOUNCES = 2000


def bounces_of(case, touches):
    """The case cut after MANY_BOUNCES of its impacts, which began at these times; None if there are fewer, or if all
    contacts are soft or dissipate energy."""
    lossless = any(l["law"] == "stereomechanical" and l["restitution"] == 1 for l in case["links"])
    if not lossless or len(touches) <= MANY_BOUNCES:
        return None
    return case | {"duration": float(sorted(touches)[MANY_BOUNCES])}


def frame_text(s):
    """A frame in the program's input format."""
    hinges = "".join(f"        {group}: {words}\n" for group, words in s.get("hinges", {}).items())
    hinges = f"      hinges:\n{hinges}" if hinges else ""
    sections = f"columns: {{rectangle: [{s['depth']}, {s['depth']}]}}, beams: {{rectangle: [0.3, 0.5]}}"
    return (
        f"  {s['name']}:\n    frame:\n      material: {{E: 30 GPa, density: 2500 kg/m^3}}\n      origin: [{s['origin']}]\n"
        f"      gravity: {str(s['gravity']).lower()}\n"
        f"      grid: {{storeys: {s['storeys']}, bays: {s['bays']}, storey_height: {s['height']}, bay_width: {s['width']}, {sections}, "
        f"floor_mass: {s['floor_mass']}}}\n{hinges}"
        f"    damping: {s['damping']}\n    initial_velocity: {s['velocity']}\n"
    )


def input_file(case):
    """The case in the program's input format."""

    def flow(pairs):
        return "{" + ", ".join(f"{key}: {value}" for key, value in pairs.items()) + "}"

    def motion(ground):
        return f"{{{ground['kind']}: {flow({key: value for key, value in ground.items() if key != 'kind'})}}}"

    text = f"title: {case['family']}\n"
    if "vertical" in case:
        text += f"ground_motion: {{components: {{x: {motion(case['ground'])}, z: {motion(case['vertical'])}}}}}\n"
    elif case["ground"]:
        text += f"ground_motion: {motion(case['ground'])}\n"
    text += "structures:\n"
    for s in case["structures"]:
        if s["kind"] == "wall":
            text += f"  {s['name']}: {{wall: {{}}}}\n"
            continue
        if s["kind"] == "frame":
            text += frame_text(s)
            continue
        own = flow(
            {
                key: s[key]
                for key in ("storeys", "mass", "period", "stiffness", "yield_force", "hardening", "spring", "damping")
                if key in s
            }
        )
        text += f"  {s['name']}: {{{s['kind']}: {own}, initial_velocity: {s['velocity']}}}\n"
    text += "links:\n"
    for l in case["links"]:
        own = {"between": f"[{l['left']}, {l['right']}]"} | {k: v for k, v in l.items() if k not in ("left", "right")}
        text += f"  - {flow(own)}\n"
    return text + f"analysis: {{duration: {case['duration']}, tolerance: {case['tolerance']}}}\n"
