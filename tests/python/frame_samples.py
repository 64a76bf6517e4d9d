"""Results files of frames, written with h5py in the program's format: two frames 25 mm apart, plane or in space, with
prescribed motions. All numbers follow from `displacement_of`."""

import h5py
import numpy as np

from sealed import seal

GAP = 0.025  #: [m]
TIME = np.linspace(0, 4, 201)  #: [s]
BAY, STOREY = 5.0, 3.2  #: [m]
DIRECTIONS = {2: ["x", "z", "ry"], 3: ["x", "y", "z", "rx", "ry", "rz"]}
COMPONENTS = ["N", "Vy", "Vz", "T", "My", "Mz"]


def sway(name, time=TIME):
    """{x, y, rz}: motions of the roof of a structure [m], [rad], which bring the roofs into contact."""
    slow = name == "tall"
    turn = 2 * np.pi * time / (1.1 if slow else 0.7)
    return {
        "x": (0.03 if slow else -0.015) * np.sin(turn),
        "y": 0.01 * np.sin(0.5 * turn),
        "rz": (0.002 if slow else -0.001) * np.sin(turn),
    }


def grid(dimension, storeys, x0):
    """(nodes [N,3], members [M,2], floor_of_node [N], names) of a frame of two bays, and in space one more along y."""
    rows = [0.0] if dimension == 2 else [0.0, 4.0]
    nodes, floors, names, numbers = [], [], [], {}
    for s in range(storeys + 1):
        for i in range(3):
            for k, y in enumerate(rows):
                numbers[s, i, k] = len(nodes)
                nodes.append([x0 + BAY * i, y, STOREY * s])
                floors.append(s - 1)
                names.append(f"{s}.{i}" + (f".{k}" if dimension == 3 else ""))
    members = []
    for (s, i, k), number in numbers.items():
        for other in ((s - 1, i, k), (s, i - 1, k) if s else None, (s, i, k - 1) if s else None):
            if other in numbers:
                members.append([numbers[other], number])
    return np.array(nodes), np.array(members), np.array(floors), names


def displacement_of(name, nodes, storeys, dimension, time=TIME):
    """[n, N, 3]: the roof's motion scaled by the height, floors rigid about the mean of their nodes."""
    motion = sway(name, time)
    share = nodes[:, 2] / (STOREY * storeys)
    moved = np.zeros((len(time), len(nodes), 3))
    arm = nodes - np.array([nodes[:, 0].mean(), nodes[:, 1].mean(), 0])
    moved[:, :, 0] = np.outer(motion["x"], share)
    if dimension == 3:
        moved[:, :, 1] = np.outer(motion["y"], share)
        moved[:, :, 0] -= np.outer(motion["rz"], share * arm[:, 1])
        moved[:, :, 1] += np.outer(motion["rz"], share * arm[:, 0])
    return moved


#: Extremes tracked within steps exceed those of the outputs.
BETWEEN_OUTPUTS = 1.1
#: Ratio of the motion without links to the motion with them.
WITHOUT_LINKS = 0.7


def write(path, dimension=2, nodes="all", members=True, wall=False, compare=False, rigid=False):
    """One file. `nodes`: all, none, or the number of reported nodes; `compare`: with a run without links; `rigid`:
    rigid floors in space, so that the file contains their plans."""
    storeys = {"tall": 5, "low": 3}
    with h5py.File(path, "w", track_order=True) as file:
        file.attrs.update(
            program="pounding",
            version="0.1.0",
            created="2026-01-02T03:04:05Z",
            status="done",
            title=f"Two frames in {'space' if dimension == 3 else 'the plane'}, 25 mm apart",
            command="",
        )
        put(file, "time", TIME)
        put(file, "ground/acceleration", 2 * np.sin(2 * np.pi * TIME))
        file.create_group("structures", track_order=True)
        file.create_group("links", track_order=True)
        for name, x0 in (("tall", 0.0), ("low", 2 * BAY + GAP)):
            write_structure(file["structures"].create_group(name), name, storeys[name], x0, dimension, nodes, members)
        if wall:
            write_wall(file["structures"].create_group("wall"))
        rows = [
            write_link(file, floor, y, dimension)
            for floor in (1, 2, 3)
            for y in ([0.0] if dimension == 2 else [0.0, 4.0])
        ]
        if wall:
            write_wall_link(file)
        if rigid:
            put(file, "ground/acceleration_y", np.sin(3 * np.pi * TIME))
            for name in storeys:
                write_plan(file["structures"][name], storeys[name])
        for name in file["structures"]:
            write_envelope(file.create_group(f"envelopes/structures/{name}"), file["structures"][name])
        write_impacts(file, [row for link in rows for row in link])
        for key in ("time", "input", "kinetic", "strain", "damping", "hysteretic", "impact", "error"):
            put(
                file,
                f"energy/{key}",
                TIME if key == "time" else np.linspace(0, 1e3, TIME.size) * (key in ("input", "damping")),
            )
        file["summary"] = "{}"
        if compare:
            write_without_links(file, file.create_group("no_pounding", track_order=True))
    seal(path)


#: Half widths of the floors about the mean of their nodes [m].
HALVES = (BAY, 2.0)


def write_plan(group, storeys):
    put(group, "plan", np.tile([-HALVES[0], HALVES[0], -HALVES[1], HALVES[1]], (storeys, 1)))


def edges_of(displacement):
    """[n, floor, edge] of the motion of floors [n, floor, x y rz]."""
    x, y, turn = np.moveaxis(displacement, -1, 0)
    return np.stack([x + turn * HALVES[1], x - turn * HALVES[1], y - turn * HALVES[0], y + turn * HALVES[0]], axis=-1)


def write_envelope(group, structure):
    """Extremes of the histories, BETWEEN_OUTPUTS times as large."""
    group.attrs["floors"] = structure.attrs["floors"]
    directions = list(structure.attrs["directions"])
    for key in ("displacement", "acceleration", "drift", "storey_shear"):
        history = structure[key][:]
        if not history.shape[1]:
            continue
        if history.ndim == 2:
            history = history[:, :, None]
        put(group, key, BETWEEN_OUTPUTS * np.stack([history.min(axis=0), history.max(axis=0)], axis=-1))
        put(group, f"{key}_time", TIME[np.stack([history.argmin(axis=0), history.argmax(axis=0)], axis=-1)])
        group[key].attrs["directions"] = directions[: history.shape[2]]
    if "plan" in structure:
        edges = edges_of(structure["displacement"][:])
        put(group, "edge_displacement", BETWEEN_OUTPUTS * np.stack([edges.min(axis=0), edges.max(axis=0)], axis=-1))
        put(group, "edge_displacement_time", TIME[np.stack([edges.argmin(axis=0), edges.argmax(axis=0)], axis=-1)])
    if "members" in structure:
        forces, ends = structure["members/end_forces"][:], structure["members/end_forces"].attrs["components"]
        group["members"] = structure["members/names"][:]
        put(group, "member_force", BETWEEN_OUTPUTS * np.stack([forces.min(axis=0), forces.max(axis=0)], axis=-1))
        put(group, "member_force_time", TIME[np.stack([forces.argmin(axis=0), forces.argmax(axis=0)], axis=-1)])
        group["member_force"].attrs["components"] = ends


def write_without_links(file, group):
    """Everything except links and impacts, WITHOUT_LINKS times as large."""
    group.attrs.update(file.attrs)
    for place in ("time", "ground", "structures", "energy", "envelopes"):
        file.copy(place, group)
    group.create_group("links")
    group["impacts"] = file["impacts"][:0]
    group["summary"] = "{}"
    for name in file["structures"]:
        for structure in (group["structures"][name], group["envelopes/structures"][name]):
            for key in ("displacement", "edge_displacement", "acceleration", "velocity", "drift", "storey_shear"):
                if key in structure:
                    structure[key][...] = WITHOUT_LINKS * structure[key][:]


def put(group, name, values):
    group[name] = values
    group[name].attrs.update(units="", long_name=name)


def rates(values):
    return np.gradient(values, TIME, axis=0)


def write_structure(group, name, storeys, x0, dimension, nodes_wanted, members_wanted):
    nodes, members, floors, names = grid(dimension, storeys, x0)
    directions = ["x"] if dimension == 2 else ["x", "y", "rz"]
    heights = STOREY * np.arange(1, storeys + 1)
    group.attrs.update(
        kind="frame",
        dimension=dimension,
        floors=[str(i + 1) for i in range(storeys)],
        elevations=heights,
        directions=directions,
    )
    motion = sway(name)
    floor_motion = np.stack([np.outer(motion[axis], heights / heights[-1]) for axis in directions], axis=2)
    put(group, "displacement", floor_motion)
    put(group, "velocity", rates(floor_motion))
    put(group, "acceleration", rates(rates(floor_motion)))
    lateral = floor_motion[:, :, :2]
    drift = np.diff(lateral, axis=1, prepend=0)
    shear = 4e7 * drift * np.linspace(1.5, 0.5, storeys)[:, None]
    put(group, "drift", drift if dimension == 3 else drift[:, :, 0])
    put(group, "storey_shear", shear if dimension == 3 else shear[:, :, 0])
    put(group, "base_shear", shear[:, 0])
    geometry = group.create_group("geometry")
    geometry["nodes"], geometry["members"], geometry["floor_of_node"] = nodes, members, floors
    member_names = [f"m{i}" for i in range(len(members))]
    geometry["node_names"], geometry["member_names"] = names, member_names
    if nodes_wanted != "none":
        count = len(nodes) if nodes_wanted == "all" else nodes_wanted
        moved = displacement_of(name, nodes, storeys, dimension)[:, :count]
        values = np.zeros((TIME.size, count, len(DIRECTIONS[dimension])))
        for j, axis in enumerate("xyz"):
            if axis in DIRECTIONS[dimension]:
                values[:, :, DIRECTIONS[dimension].index(axis)] = moved[:, :, j]
        reported = group.create_group("nodes")
        reported["names"] = names[:count]
        for key, data in (
            ("displacement", values),
            ("velocity", rates(values)),
            ("acceleration", rates(rates(values))),
        ):
            put(reported, key, data)
            reported[key].attrs["directions"] = DIRECTIONS[dimension]
    if members_wanted:
        components = [c for c in COMPONENTS if dimension == 3 or c in ("N", "Vz", "My")]
        components = [f"{end} {c}" for end in ("start", "end") for c in components]
        forces = group.create_group("members")
        forces["names"] = member_names
        put(
            forces,
            "end_forces",
            1e5
            * np.einsum(
                "t,m,c->tmc", motion["x"], np.arange(1.0, 1 + len(members)), np.arange(1.0, 1 + len(components))
            ),
        )
        forces["end_forces"].attrs["components"] = components


def write_wall(group):
    group.attrs.update(kind="wall", dimension=1, floors=h5py.Empty("S1"), elevations=h5py.Empty("f8"), directions=["x"])
    for key in ("displacement", "velocity", "acceleration"):
        put(group, key, np.zeros((TIME.size, 0, 1)))
    for key in ("drift", "storey_shear"):
        put(group, key, np.zeros((TIME.size, 0)))


def write_link(file, floor, y, dimension):
    """Link between the two frames at a floor. Returns the rows of its impacts: (link, start, end, peak force)."""
    place = f".{'ab'[int(y > 0)]}" if dimension == 3 else ""
    name = f"tall.{floor}-low.{floor}{place}"
    time = np.linspace(0, 4, 4001)
    ends = []
    for structure, storeys, x in (("tall", 5, 2 * BAY), ("low", 3, 2 * BAY + GAP)):
        nodes, _, _, _ = grid(dimension, storeys, 0.0 if structure == "tall" else 2 * BAY + GAP)
        here = np.argmin(np.linalg.norm(nodes - [x, y, STOREY * floor], axis=1))
        ends.append(displacement_of(structure, nodes, storeys, dimension, time)[:, here, 0])
    penetration = ends[0] - ends[1] - GAP
    force = np.maximum(0, 5e8 * penetration)
    group = file["links"].create_group(name)
    group.attrs.update(
        left="tall",
        right="low",
        left_floor=floor,
        right_floor=floor,
        gap=GAP,
        gap_units="m",
        law="linear_spring",
        position=[2 * BAY + GAP / 2, y, STOREY * floor],
        direction=[1.0, 0, 0],
        left_end=f"floor {floor}",
        right_end=f"floor {floor}",
    )
    for key, data in (
        ("time", time),
        ("penetration", penetration),
        ("velocity", np.gradient(penetration, time)),
        ("force", force),
        ("energy", 0 * force),
    ):
        put(group, key, data)
    put(group, "friction", 0.3 * force[:, None])
    edges = np.flatnonzero(np.diff(np.concatenate([[0], (penetration > 0).astype(int), [0]])))
    return [(name, time[a], time[min(b, len(time) - 1)], force[a:b].max()) for a, b in edges.reshape(-1, 2)]


def write_wall_link(file):
    """Link from the low frame to a wall on its right, which it never reaches."""
    group = file["links"].create_group("low.3-wall")
    group.attrs.update(
        left="low",
        right="wall",
        left_floor=3,
        right_floor=0,
        gap=0.1,
        gap_units="m",
        law="linear_spring",
        position=[4 * BAY + GAP, 0, 3 * STOREY],
        direction=[1.0, 0, 0],
        left_end="floor 3",
        right_end="",
    )
    for key in ("time", "penetration", "velocity", "force", "energy"):
        put(group, key, {"time": TIME, "penetration": np.full(TIME.size, -0.1)}.get(key, np.zeros(TIME.size)))


def write_impacts(file, rows):
    numbers = """
        t_start t_end t_release v_approach v_separation restitution peak_force t_peak peak_penetration
        impulse energy_lost energy_stored
    """.split()
    impacts = np.zeros(len(rows), dtype=[("link", "S32"), *((key, "f8") for key in numbers)])
    for impact, (link, start, end, force) in zip(impacts, sorted(rows, key=lambda row: row[1])):
        impact["link"], impact["t_start"], impact["t_end"], impact["t_release"] = link.encode(), start, end, end
        impact["v_approach"], impact["v_separation"], impact["restitution"] = 0.2, 0.1, 0.5
        impact["peak_force"], impact["t_peak"], impact["peak_penetration"] = force, (start + end) / 2, force / 5e8
    file["impacts"] = impacts
