#!/usr/bin/env python3
"""Rewrites the measured section of tests/benchmarks/README.md and its plots from build/benchmarks/*.json (called by
run.py)."""

import json
import re
import sys
from pathlib import Path

import problem
from measure import ERRORS, FOLDER, at_error, factor, verdict
from plots import draw

PROCESS_WANTED = 0.2  # whole `pounding run` at 1e-4 [s]
FRAME_ERROR, FRAME_WANTED = 1e-3, 100
YIELDING_WANTED, STEP_SOLVES = {"frame": 30, "pair": 20}, 3
SPACE_WANTED = {"4536": 100, "19440": 500}


def good(points):
    return [p for p in points if "failed" not in p]


def best(curves, error, key="seconds"):
    """(integrator, result of at_error) of the quickest pounding curve that reaches the error."""
    found = [(name, at_error(good(points), error, key)) for name, points in curves.items()]
    reached = [f for f in found if f[1]["seconds"] is not None]
    return min(reached, key=lambda f: f[1]["seconds"], default=(None, {"seconds": None, "best": None}))


def seconds(value):
    if value is None:
        return "-"
    return f"{value:.3g} s" if value >= 0.1 else f"{1e3 * value:.3g} ms"


def timed(at):
    if at["seconds"] is not None:
        return ("at most " if at["bound"] else "") + seconds(at["seconds"])
    if not at.get("best"):
        return "not reached"
    return f"not reached: {at['best']['error']:.1e} in {seconds(at['best']['seconds'])}"


def table(head, rows):
    return "\n".join("| " + " | ".join(str(c) for c in row) + " |" for row in [head, ["---"] * len(head), *rows])


def oscillators(laws):
    text = []
    for error in ERRORS:
        rows = []
        for law, curves in laws.items():
            peer = at_error(good(curves["opensees"]), error)
            name, ours = best(curves["pounding"], error)
            process = best(curves["pounding"], error, "process_seconds")[1]["seconds"]
            value, shown, sense = factor(peer, ours)
            row = [f"`{law}`", timed(peer), timed(ours), name or "-", shown]
            if error == 1e-4:
                row += [
                    problem.WANTED[law],
                    verdict(value, sense, problem.WANTED[law]),
                    seconds(process),
                    "-" if process is None else "yes" if process < PROCESS_WANTED else "no",
                ]
            else:
                row += [seconds(process)]
            rows.append(row)
        head = ["law", "OpenSees", "pounding", "integrator", "ratio"]
        head += (
            ["target", "reached", "whole process", f"under {PROCESS_WANTED} s"] if error == 1e-4 else ["whole process"]
        )
        text.append(f"Error {error:.0e}:\n\n{table(head, rows)}")
    return "\n\n".join(text)


def failures(laws):
    rows = [
        [
            f"`{law}`",
            ", ".join(f"{p['step']:g} s" for p in curves["opensees"] if "failed" in p) or "none",
            ", ".join(f"{p['step']:g} s" for p in curves["opensees"] if p.get("peak_error") == 1.0) or "none",
        ]
        for law, curves in laws.items()
    ]
    return table(["law", "Newton fails at steps of", "impacts lost or invented at"], rows)


def plane(laws):
    rows = []
    for law, curves in laws.items():
        peer = at_error(good(curves["opensees"]), FRAME_ERROR)
        name, ours = best(curves["pounding"], FRAME_ERROR)
        value, shown, sense = factor(peer, ours)
        failed = ", ".join(f"{p['step']:g} s" for p in curves["opensees"] if "failed" in p) or "none"
        rows.append(
            [
                f"`{law}`",
                timed(peer),
                failed,
                timed(ours) if curves["pounding"] else "not measured",
                name or "-",
                shown,
                FRAME_WANTED,
                verdict(value, sense, FRAME_WANTED),
            ]
        )
    return table(
        ["law", "OpenSees", "Newton fails at steps of", "pounding", "integrator", "ratio", "target", "reached"], rows
    )


def space(rows):
    text = []
    for size in dict.fromkeys(r["size"] for r in rows):
        peers = [r for r in rows if r["size"] == size and r["program"] == "opensees" and "seconds_per_step" in r]
        ours = next((r for r in rows if r["size"] == size and r["program"] == "pounding"), None)
        lines = []
        for r in rows:
            if r["size"] == size and r["program"] == "opensees":
                lines.append(
                    [
                        r["system"],
                        r["algorithm"],
                        seconds(r.get("seconds_per_step")),
                        f"{r['iterations_per_step']:.1f}"
                        if "seconds_per_step" in r
                        else r.get("failed", f"Newton failed at {r.get('failed_at', 0):.3f} s"),
                    ]
                )
        part = f"{size} equations, seconds per step:\n\n" + table(
            ["system", "algorithm", "per step", "iterations"], lines
        )
        if ours and "seconds_per_step" in ours and peers:
            least = min(r["seconds_per_step"] for r in peers)
            value = least / ours["seconds_per_step"]
            part += (
                f"\n\npounding, {ours['unknowns']} unknowns: {seconds(ours['seconds_per_step'])} per step, "
                f"{seconds(ours['seconds_per_solve'])} per back-solve, {ours['memory_mb']:.0f} MB; {value:.3g} times less than "
                f"OpenSees' quickest (target {SPACE_WANTED[size]}: {verdict(value, '=', SPACE_WANTED[size])})."
            )
        elif ours:
            part += f"\n\npounding: {ours.get('failed')}"
        else:
            part += "\n\npounding: not measured, the program `frames` was not built."
        text.append(part)
    return "\n\n".join(text)


def growth(rows):
    """Comparison of the smallest and the largest model with flexible floors on one process."""
    ours = [
        r
        for r in rows
        if r["program"] == "pounding" and r["ranks"] == 1 and "pressed" in r and not r["case"].endswith("rigid")
    ]
    if len(ours) < 2:
        return ""
    small, large = (pick(ours, key=lambda r: r["unknowns"]) for pick in (min, max))
    per = lambda row, how: row[how]["seconds_per_step"] / row["unknowns"]
    memory = lambda row: row["pressed"]["memory_mb"] / row["unknowns"]
    return (
        f"From {small['unknowns']} to {large['unknowns']} unknowns the time per step and unknown grows {per(large, 'apart') / per(small, 'apart'):.2g} times "
        f"without contact and {per(large, 'pressed') / per(small, 'pressed'):.2g} times in contact, memory per unknown "
        f"{memory(large) / memory(small):.2g} times (of which the process itself takes some 70 MB), reading per unknown "
        f"{large['seconds_reading'] / large['unknowns'] / (small['seconds_reading'] / small['unknowns']):.2g} times."
    )


def tower_steps(rows):
    head = [
        "towers, floors",
        "unknowns",
        "processes",
        "reading",
        "set-up",
        "per step, apart",
        "per step, pressed",
        "pressed links",
        "memory",
    ]
    lines = []
    for r in (r for r in rows if r["program"] == "pounding"):
        if "failed" in r:
            lines.append([r["case"], r["unknowns"], r["ranks"], r["failed"]] + [""] * 5)
            continue
        lines.append(
            [
                r["case"],
                r["unknowns"],
                r["ranks"],
                seconds(r["seconds_reading"]),
                seconds(r["pressed"]["seconds_setup"]),
                *(f"{1e6 * r[how]['seconds_per_step']:.0f} us" for how in ("apart", "pressed")),
                f"{r['pressed']['pressed']} of {r['pressed']['links']}",
                f"{r['pressed']['memory_mb']:.0f} MB",
            ]
        )
    return table(head, lines)


def tower_reduced(rows):
    """Reduced towers compared with factors of all unknowns on one process; empty if they were not measured."""
    found = [r for r in rows if r["program"] == "reduced"]
    if not found:
        return ""
    head = [
        "reduced towers, floors",
        "coordinates of one",
        "set-up",
        "per step, apart",
        "per step, pressed",
        "by factors",
        "ratio",
        "apart / pressed, with impacts and recording",
        "memory",
    ]
    whole = {r["case"]: r for r in rows if r["program"] == "pounding" and r["ranks"] == 1 and "pressed" in r}
    body = []
    for r in found:
        ours = [r[name]["alone"]["seconds"] for name in ("apart", "pressed")]
        sparse = (
            [whole[r["case"]][name]["seconds_per_step"] for name in ("apart", "pressed")] if r["case"] in whole else []
        )
        body.append(
            [
                r["case"],
                f"{r['apart']['told']['coordinates']:.0f}",
                f"{r['pressed']['seconds_setup']:.2g} s",
                *(f"{1e3 * t:.2g} ms" for t in ours),
                " / ".join(f"{1e3 * t:.3g} ms" for t in sparse),
                " / ".join(f"{s / t:.2g}" for s, t in zip(sparse, ours)),
                " / ".join(f"{1e3 * r[name]['seconds_per_step']:.2g} ms" for name in ("apart", "pressed")),
                f"{r['pressed']['memory_mb'] / 1024:.2g} GB",
            ]
        )
    return table(head, body)


def tower_runs(rows):
    head = ["towers, floors", "processes", "run", "steps", "landings", "stepping", "in solves", "in factors"]
    lines = [
        [
            r["case"],
            r["ranks"],
            name,
            f"{r[name]['steps']:.0f}",
            f"{r[name]['events']:.0f}",
            seconds(r[name]["seconds"]),
            f"{100 * r[name]['solve_share']:.0f} %",
            f"{100 * r[name]['factor_share']:.0f} %",
        ]
        for r in rows
        if r["program"] == "pounding"
        for name in ("apart", "pressed", "stiff")
        if name in r
    ]
    return table(head, lines)


def tower_peers(rows):
    head = [
        "towers, floors",
        "equations",
        "OpenSees",
        "per step",
        "iterations",
        "memory",
        "pounding, per step",
        "ratio",
        "reduced",
        "ratio",
    ]
    ours = {r["case"]: r for r in rows if r["program"] == "pounding" and r["ranks"] == 1 and "pressed" in r}
    reduced = {r["case"]: r["pressed"]["alone"]["seconds"] for r in rows if r["program"] == "reduced"}
    lines = []
    for r in (r for r in rows if r["program"] == "opensees"):
        if "seconds_per_step" not in r:
            lines.append(
                [r["case"], "", r["system"], r.get("failed", f"Newton failed at {r.get('failed_at')} s")] + [""] * 6
            )
            continue
        less = reduced.get(r["case"])
        own = ours[r["case"]]["pressed"]["seconds_per_step"] if r["case"] in ours else None
        lines.append(
            [
                r["case"],
                r["unknowns"],
                r["system"],
                seconds(r["seconds_per_step"]),
                f"{r['iterations_per_step']:.1f}",
                f"{r['memory_mb']:.0f} MB",
                *(
                    cell
                    for t in (own, less)
                    for cell in ((seconds(t), f"{r['seconds_per_step'] / t:.3g}") if t else ("-", "-"))
                ),
            ]
        )
    return table(head, lines)


def yielding(measured):
    """Frames with hinges."""
    rows, about = [], measured["about"]
    for problem, words in (
        ("frame", "3 storeys, 8 hinges, El Centro, 12 s"),
        ("pair", "8 and 6 storeys, 79 hinges, impacts, 20 s"),
    ):
        part = measured[problem]
        peer = at_error(good(part["opensees"]), FRAME_ERROR)
        name, ours = best(part["pounding"], FRAME_ERROR)
        value, shown, sense = factor(peer, ours)
        rows.append(
            [
                words,
                timed(peer),
                timed(ours),
                name or "-",
                shown,
                YIELDING_WANTED[problem],
                verdict(value, sense, YIELDING_WANTED[problem]),
            ]
        )
    elastic, hinges = measured["towers"]["elastic"], measured["towers"]["hinges"]
    solves = hinges["seconds_per_step"] / hinges["seconds_per_solve"]
    busy = (
        " Other work shared the cores: the ratios are rough."
        if max(about["load_before"], about["load_after"]) > about["cores"]
        else ""
    )
    short = " Shortened runs (`--quick`)." if measured["quick"] else ""
    return (
        f"Measured {about['date']}, {about['cores']} cores; load average {about['load_before']:.1f} before, {about['load_after']:.1f} after.{busy}{short}\n\n"
        + table(["problem", "OpenSees", "pounding", "integrator", "ratio", "target", "reached"], rows)
        + f"\n\nThe towers in space, {hinges['hinges']} hinges, {hinges['yielded']} of which yield: {seconds(hinges['seconds_per_step'])} per step, "
        f"{solves:.2g} back-solves of {seconds(hinges['seconds_per_solve'])} for all unknowns (target {STEP_SOLVES}: {'yes' if solves <= STEP_SOLVES else 'no'}); "
        f"without hinges {seconds(elastic['seconds_per_step'])} per step, {elastic['seconds_per_step'] / elastic['seconds_per_solve']:.2g} back-solves."
    )


def page(out):
    measured = {
        name: json.loads((out / f"{name}.json").read_text()) for name in ("machine", "two_oscillators", "frames")
    }
    about, pairs, frames = (measured[name] for name in ("machine", "two_oscillators", "frames"))
    file = out / "towers.json"
    towers = json.loads(file.read_text()) if file.exists() else None
    draw(pairs["laws"], frames, FOLDER / "plots")
    quick = [
        name
        for name, part in (("two oscillators", pairs), ("frames", frames), ("towers", towers))
        if part and part["quick"]
    ]
    short = f" Shortened runs (`--quick`) of {' and '.join(quick)}." if quick else ""
    refused = "".join(f"\n\nLeft out: `{name}` ({why})" for name, why in pairs["refused"].items())
    busy = ""
    if max(about["load_before"], about["load_after"]) > about["cores"]:
        busy = " Other work shared the cores: the ratios are rough."
    parts = [
        f"Measured {about['date']}: {about['cpu']}, {about['cores']} cores, {about['system']}; OpenSees {about['opensees']}; "
        f"load average {about['load_before']:.1f} before, {about['load_after']:.1f} after.{short}{busy}{refused}",
        "### Two oscillators\n\n" + oscillators(pairs["laws"]),
        failures(pairs["laws"]),
        "![Error against time, six laws](plots/two_oscillators.png)\n\n![Ratio of times](plots/ratio.png)",
        f"### Plane frames, error {FRAME_ERROR:.0e}\n\n" + plane(frames["plane"]),
        "![Error against time, plane frames](plots/plane_frames.png)",
        "### 3D frames in contact\n\n" + space(frames["space"]),
        "![Cost of a step](plots/space_frames.png)",
    ]
    if towers:
        rows = towers["rows"]
        parts += [
            f"### Towers in space, through the program\n\n{towers.get('about', '')}",
            tower_steps(rows),
            growth(rows),
            tower_reduced(rows),
            tower_runs(rows),
            tower_peers(rows),
        ]
    if "overhead" in about:
        parts.append(f"### Overhead of a step\n\n```\n{about['overhead']}\n```")
    return "\n\n".join(parts)


def main(out):
    file = FOLDER / "README.md"
    texts = {}
    if (out / "machine.json").exists():
        texts["results"] = page(out)
    if (out / "yielding.json").exists():
        texts["yielding"] = yielding(json.loads((out / "yielding.json").read_text()))
    for name, text in texts.items():
        block = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
        file.write_text(block.sub(lambda m: f"{m[1]}{text}\n{m[2]}", file.read_text()))
    print(f"{file} and {FOLDER / 'plots'} written")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
