"""Plots of the benchmarks, small PNG."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from measure import at_error

PEER, OURS = "#b5483a", {"generalized_alpha": "#2f6b9a", "esdirk4": "#2e8b57"}


def good(points):
    return [p for p in points if "failed" not in p]


def save(figure, file):
    figure.tight_layout()
    figure.savefig(file, dpi=80)
    plt.close(figure)


def work_precision(laws, title, file):
    figure, axes = plt.subplots(2, 3, figsize=(11, 6.4), sharex=True, sharey=True)
    for axis, (law, curves) in zip(axes.flat, laws.items()):
        lines = [("OpenSees", PEER, curves["opensees"])]
        lines += [(f"pounding, {name}", OURS[name], points) for name, points in curves["pounding"].items()]
        for label, colour, points in lines:
            points = sorted(good(points), key=lambda p: p["seconds"])
            axis.loglog(
                [p["error"] for p in points],
                [p["seconds"] for p in points],
                "o-",
                ms=4,
                lw=1.3,
                color=colour,
                label=label,
            )
        axis.set_title(law, fontsize=10)
        axis.grid(alpha=0.3)
    axes[0, 0].invert_xaxis()
    for axis in axes[-1]:
        axis.set_xlabel("largest error of displacements and peak forces [-]", fontsize=9)
    for axis in axes[:, 0]:
        axis.set_ylabel("seconds", fontsize=9)
    handles = {label: line for axis in axes.flat for line, label in zip(*axis.get_legend_handles_labels())}
    figure.legend(handles.values(), handles.keys(), loc="upper right", ncol=3, fontsize=9, frameon=False)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    save(figure, file)


def ratio(laws, file):
    """Ratio of OpenSees' time to that of the quickest integrator, where both curves are measured."""
    figure, axis = plt.subplots(figsize=(7, 4.6))
    for law, curves in laws.items():
        ours = [good(points) for points in curves["pounding"].values()]
        peer = good(curves["opensees"])
        xs, ys = [], []
        for error in np.logspace(-2, -8, 49):
            a = at_error(peer, error)
            b = [
                at
                for at in (at_error(points, error) for points in ours)
                if at["seconds"] is not None and not at["bound"]
            ]
            if a["seconds"] is not None and not a["bound"] and b:
                xs.append(error)
                ys.append(a["seconds"] / min(at["seconds"] for at in b))
        axis.loglog(xs, ys, "-", lw=1.5, label=law)
    axis.axhline(100, color="0.5", lw=0.8, ls="--")
    axis.axhline(1000, color="0.5", lw=0.8, ls=":")
    axis.invert_xaxis()
    axis.set_xlabel("error [-]")
    axis.set_ylabel("time of OpenSees over time of pounding [-]")
    axis.set_title("Two oscillators; lines at 100 and 1000", fontsize=10)
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8, frameon=False)
    save(figure, file)


def space(rows, file):
    figure, axis = plt.subplots(figsize=(7, 4.6))
    groups = {}
    for row in rows:
        if "seconds_per_step" in row:
            label = "pounding" if row["program"] == "pounding" else f"{row['system']}, {row['algorithm']}"
            groups.setdefault(label, []).append((row["unknowns"], row["seconds_per_step"]))
    colours = {"SparseSYM": "#b5483a", "Mumps": "#8a6d1d", "UmfPack": "#6b4c9a", "pounding": OURS["generalized_alpha"]}
    for label, points in groups.items():
        axis.loglog(
            *zip(*sorted(points)),
            "o--" if "Modified" in label else "o-",
            ms=4,
            lw=1.3,
            color=colours[label.split(",")[0]],
            label=label,
        )
    axis.set_xlabel("equations")
    axis.set_ylabel("seconds a step")
    axis.set_title("3D frames in contact", fontsize=10)
    axis.grid(alpha=0.3, which="both")
    axis.legend(fontsize=8, frameon=False)
    save(figure, file)


def draw(pairs, frames, folder):
    folder.mkdir(exist_ok=True)
    work_precision(pairs, "Two oscillators, 10 s", folder / "two_oscillators.png")
    ratio(pairs, folder / "ratio.png")
    work_precision(frames["plane"], "Plane frames, 20 s", folder / "plane_frames.png")
    space(frames["space"], folder / "space_frames.png")
