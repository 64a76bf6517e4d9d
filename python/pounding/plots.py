"""Pictures of a run: `python3 -m pounding.plots RESULTS.h5 -o OUT.png [--title TEXT]`.

`standard_figure` is the whole picture; the other functions draw one panel each on given axes, for notebooks and
papers. Lengths are drawn in mm, forces and energies in the unit that suits their size. The command line also draws the
model and the profiles over its height (`--picture`).
"""

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from pounding.model_picture import model_figure
from pounding.profiles import profiles_figure
from pounding.results import Link, NotResults, Run, Structure, read
from pounding.style import (
    ENERGY_UNITS, FORCE_UNITS, GREEN, IMPULSE_UNITS, LINK_COLOURS, MM, ORANGE, PURPLE, QUIET, SKY, STRUCTURE_COLOURS, STYLE,
    TIME_UNITS, VERMILION, BadRequest, Picture, engineering, head, largest, write_picture)


#: More displacements than these in one panel cannot be told apart.
MOST_STRUCTURES = 4


def standard_figure(run: Run, title: str | None = None, floors: dict[str, str] | None = None,
                    size: tuple[float, float] | None = None) -> Figure:
    """Ground motion, displacements, openings, contact forces, energies and the error of their balance against time;
    below them the loop of the strongest impact and the restitution of all.

    What a run does not have is left out: the ground when it is still, links, impacts.
    A run that is not done says so below the title. `floors` maps names of structures to the labels of the floors whose
    displacements are drawn instead of the linked ones; BadRequest when there are none such. `size` is that of the figure [in]."""
    chosen = _chosen_floors(run, floors or {})
    over_time: list[tuple[Callable[[Axes, Run], None], float]] = [
        (lambda axes, run: draw_displacements(axes, run, chosen), 1.3), (draw_energies, 1.0), (draw_balance_error, 0.4)]
    over_impacts: list[Callable[[Axes, Run], None]] = []
    if run.links:
        over_time[1:1] = [(draw_openings, 0.9), (draw_forces, 0.9)]
    if run.impacts.size:
        over_impacts = [draw_strongest_loop, draw_restitution]
    if largest([run.ground_acceleration]) > 0:
        over_time.insert(0, (draw_ground, 0.45))
    heights = [height for _, height in over_time] + [1.6] * bool(over_impacts)

    with rc_context(STYLE):
        figure = Picture(figsize=size or (7.5, 0.7 + 1.5 * sum(heights)), layout="constrained")
        rows = figure.add_gridspec(len(heights), 1, height_ratios=heights)
        histories: list[Axes] = []
        for row, (draw, _) in enumerate(over_time):
            histories.append(figure.add_subplot(rows[row], sharex=histories[0] if histories else None))
            draw(histories[-1], run)
            histories[-1].tick_params(labelbottom=False)
        histories[-1].tick_params(labelbottom=True)
        label_time(histories[-1], run)
        if over_impacts:
            places = rows[-1].subgridspec(1, 2, wspace=0.08)
            for column, draw in enumerate(over_impacts):
                draw(figure.add_subplot(places[column]), run)
        for letter, axes in zip("abcdefgh", figure.axes):
            axes.set_title(f"({letter}) {axes.get_title(loc='left')}")
        _write_heading(figure, run, title)
        figure.align_ylabels(histories)
        return figure


def draw_ground(axes: Axes, run: Run) -> None:
    """Acceleration of the ground."""
    _plot_time(axes, run, run.time, run.ground_acceleration, color="0.25", linewidth=0.7)
    axes.set_title("Ground")
    axes.set_ylabel("Acceleration\n[m/s²]")


def draw_displacements(axes: Axes, run: Run, chosen: dict[str, int] | None = None) -> None:
    """Displacements of up to four structures where their links are, each a gap away from its left neighbour, so that
    two lines meet when the structures touch. A top above the links is drawn thin. `chosen` maps names of structures to
    numbers of floors, from 0, that are drawn instead; structures with a chosen floor come first.

    In space the displacements are those of the middle of the floors in the direction of the first link; where a floor
    turns, its ends may touch before the lines meet."""
    chosen = chosen or {}
    drawn = sorted(run.structures.values(), key=lambda structure: structure.name not in chosen)[:MOST_STRUCTURES]
    drawn = [structure for structure in run.structures.values() if any(structure is one for one in drawn)]
    names = [structure.name for structure in drawn]
    floors = {structure.name: chosen.get(structure.name, _linked_floor(run, structure)) for structure in drawn}
    offsets = _offsets(run, names)
    sides = {name: MM * (offsets[name] + _displacement(run, name, floors[name])) for name in names}
    for structure, colour in zip(drawn, STRUCTURE_COLOURS):
        name, floor, top = structure.name, floors[structure.name], len(structure.floors) - 1
        axes.axhline(MM * offsets[name], color=colour, linewidth=0.5, linestyle=(0, (4, 4)))
        label = name if top <= 0 else f"{name}, floor {structure.floors[floor]}"
        _plot_time(axes, run, run.time, sides[name], color=colour, label=label)
        if floor != top and name not in chosen:
            _plot_time(axes, run, run.time, MM * (offsets[name] + _displacement(run, name, top)), color=colour,
                       linewidth=0.5, alpha=0.7, label=f"{name}, top")
    facing = _facing(run, floors)
    sizes = ", ".join(f"{MM * gap:.4g}" for _, _, gap in facing)
    for i, (left, right, _) in enumerate(facing):
        axes.fill_between(run.time / _time_unit(run)[0], sides[left], sides[right], where=sides[right] >= sides[left],
                          color="0.55", alpha=0.22, linewidth=0, label=f"gap, {sizes} mm at rest" if i == 0 else None)
    more = len(run.structures) - len(drawn)
    title = "Displacements" if not more else f"Displacements of {len(drawn)} of {len(run.structures)}"
    if any(structure.dimension == 3 for structure in drawn):
        title += f" along {_axis_words(_direction(run))}"
    axes.set_title(title)
    axes.set_ylabel("Displacement\n[mm]")
    _legend_beside(axes)


def draw_openings(axes: Axes, run: Run) -> None:
    """Opening of the links; a mark at each touch."""
    for link, style in _link_styles(run):
        _plot_time(axes, run, link.time, -MM * link.penetration, **style)
    size, _ = _time_unit(run)
    axes.axhline(0, color="black", linewidth=0.6)
    touches = run.impacts["t_start"] / size
    if touches.size:
        axes.plot(touches, np.zeros_like(touches), linestyle="none", marker="^", markersize=3.5, color="black",
                  clip_on=False, zorder=5, label=f"touch ({touches.size})")
    axes.set_title("Opening of the links")
    axes.set_ylabel("Opening\n[mm]")
    _legend_beside(axes)


def draw_forces(axes: Axes, run: Run) -> None:
    """Contact force of each link; the impulses instead when all contacts were rigid."""
    axes.set_title("Contact forces")
    peak = largest([link.force for link in run.links.values()])
    size, unit = engineering(peak, FORCE_UNITS)
    if peak == 0 and run.impacts.size:
        _draw_impulses(axes, run)
    elif peak == 0:
        _say(axes, f"No impact; closest approach {_closest(run)}")
        axes.set_ylabel("Force")
    else:
        for link, style in _link_styles(run):
            _plot_time(axes, run, link.time, link.force / size, **{**style, "linewidth": 0.9})
        axes.set_ylabel(f"Force\n[{unit}]")
        axes.set_ylim(bottom=min(0, axes.get_ylim()[0]) if _pulls(run) else 0)
        _legend_beside(axes)


def draw_strongest_loop(axes: Axes, run: Run) -> None:
    """Force over penetration of the impact with the largest force."""
    axes.set_title("Strongest impact")
    peak = largest([run.impacts["peak_force"]])
    if peak == 0:
        _say(axes, "Rigid contact: no loop" if run.impacts.size else "No impact")
        axes.set(xlabel="Penetration", ylabel="Force")
        return
    impact = run.impacts[np.nanargmax(run.impacts["peak_force"])]
    link = run.links[impact["link"].decode()]
    inside = (link.time >= impact["t_start"]) & (link.time <= impact["t_end"])
    size, unit = engineering(peak, FORCE_UNITS)
    penetration, force = MM * link.penetration[inside], link.force[inside] / size
    axes.fill(penetration, force, color=VERMILION, alpha=0.12, linewidth=0)
    axes.plot(penetration, force, color=VERMILION)
    _arrow(axes, penetration, force)
    lost_size, lost_unit = engineering(abs(impact["energy_lost"]), ENERGY_UNITS)
    axes.set_ylabel(f"Force [{unit}]")
    axes.set_xlabel(f"Penetration [mm]\n{link.name} at {impact['t_start']:.3f} s: {impact['v_approach']:.3g} m/s in, "
                    f"{impact['v_separation']:.3g} m/s out,\nrestitution {impact['restitution']:.3f}, "
                    f"{impact['energy_lost'] / lost_size:.3g} {lost_unit} lost")


def draw_loops(axes: Axes, run: Run) -> None:
    """Force over penetration of every impact."""
    axes.set_title("Contact loops")
    size, unit = engineering(largest([run.impacts["peak_force"]]), FORCE_UNITS)
    axes.set(xlabel="Penetration [mm]", ylabel=f"Force [{unit}]")
    if largest([run.impacts["peak_force"]]) == 0:
        _say(axes, "Rigid contact: no loop" if run.impacts.size else "No impact")
        return
    for link, style in _link_styles(run):
        for impact in run.impacts_of(link.name):
            inside = (link.time >= impact["t_start"]) & (link.time <= impact["t_end"])
            axes.plot(MM * link.penetration[inside], link.force[inside] / size, **{**style, "linewidth": 0.8})
            style["label"] = None
    _legend_beside(axes)


def draw_restitution(axes: Axes, run: Run) -> None:
    """Restitution that each impact obtained, over its closing speed."""
    axes.set_title("Restitution of each impact")
    axes.set(xlabel="Closing speed [m/s]", ylabel="Restitution")
    moving = run.impacts[np.isfinite(run.impacts["restitution"])]
    if not moving.size:
        _say(axes, "No impact")
        return
    for link, style in _link_styles(run):
        impacts = moving[moving["link"] == link.name.encode()]
        axes.plot(impacts["v_approach"], impacts["restitution"], linestyle="none", marker="o", markersize=3.5,
                  markerfacecolor="none", markeredgewidth=0.9, color=style["color"], zorder=style["zorder"])
    axes.set_xlim(0, 1.05 * moving["v_approach"].max() or 1)
    axes.set_ylim(min(0, moving["restitution"].min()), max(1, 1.05 * moving["restitution"].max()))


def draw_energies(axes: Axes, run: Run) -> None:
    """Where the energy is: dissipated and stored parts stacked, below the line of the input."""
    energy = run.energy
    parts = [("damping", "damping", SKY), ("hysteretic", "yielding", ORANGE), ("impact", "impact", VERMILION),
             ("strain", "strain", GREEN), ("kinetic", "kinetic", PURPLE)]
    parts = [part for part in parts if largest([energy[part[0]]]) > 0]
    size, unit = engineering(largest([energy["input"]]), ENERGY_UNITS)
    time_size, _ = _time_unit(run)
    if parts:
        axes.stackplot(energy["time"] / time_size, *[energy[key] / size for key, _, _ in parts],
                       labels=[label for _, label, _ in parts], colors=[colour for _, _, colour in parts], alpha=0.75,
                       linewidth=0)
        axes.plot(energy["time"] / time_size, energy["input"] / size, color="black", linewidth=0.8, label="input")
    axes.set_title("Energy")
    axes.set_ylabel(f"Energy\n[{unit}]")
    axes.margins(x=0)
    _legend_beside(axes, reverse=True)


def draw_balance_error(axes: Axes, run: Run) -> None:
    """Error of the energy balance in per cent of the largest input."""
    energy = run.energy
    scale = largest([energy["input"]])
    if scale > 0:
        time_size, _ = _time_unit(run)
        axes.plot(energy["time"] / time_size, 100 * energy["error"] / scale, color="black", linewidth=0.7)
    axes.set_title("Error of the energy balance")
    axes.set_ylabel("Error\n[% of input]")
    axes.yaxis.set_major_locator(MaxNLocator(3))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:.2g}".replace("-", "\N{MINUS SIGN}"))
    axes.margins(x=0)


def _time_unit(run: Run) -> tuple[float, str]:
    span = run.time[-1] - run.time[0] if run.time.size else 0.0
    return TIME_UNITS[1] if 0 < span < 0.5 else TIME_UNITS[0]


def _plot_time(axes: Axes, run: Run, time: np.ndarray, values: np.ndarray, **style: Any) -> None:
    axes.plot(time / _time_unit(run)[0], values, **style)
    axes.margins(x=0)


def label_time(axes: Axes, run: Run) -> None:
    """Names the axis of time, in the unit that the run is drawn in; it goes over the whole run."""
    size, unit = _time_unit(run)
    axes.set_xlabel(f"Time [{unit}]")
    if run.time.size > 1:
        axes.set_xlim(run.time[0] / size, run.time[-1] / size)


def _linked_floor(run: Run, structure: Structure) -> int:
    """Index of the highest linked floor; the top when no link names a floor; -1 for a wall, which has no floor."""
    numbers = [link.left_floor for link in run.links.values() if link.left == structure.name]
    numbers += [link.right_floor for link in run.links.values() if link.right == structure.name]
    top = len(structure.floors)
    return min(max(numbers, default=0) or top, top) - 1


def _chosen_floors(run: Run, labels: dict[str, str]) -> dict[str, int]:
    """Numbers of the floors, from 0, by structure."""
    chosen = {}
    for name, label in labels.items():
        if name not in run.structures:
            raise BadRequest(f"there is no structure {name}; there is {', '.join(run.structures)}")
        floors = run.structures[name].floors
        if label not in floors:
            raise BadRequest(f"{name} has no floor {label}; it has {', '.join(floors) or 'none'}")
        chosen[name] = floors.index(label)
    return chosen


def _direction(run: Run) -> np.ndarray:
    """Horizontal direction in which the first link opens; x without links."""
    return next((link.direction for link in run.links.values()), np.array([1.0, 0, 0]))


def _axis_words(direction: np.ndarray) -> str:
    x, y = direction[:2]
    for words, value, other in (("x", x, y), ("y", y, x)):
        if abs(other) < 1e-9:
            return words if value > 0 else f"\N{MINUS SIGN}{words}"
    return f"({x:.2g}, {y:.2g})"


def _displacement(run: Run, name: str, floor: int) -> np.ndarray:
    """Displacement of a floor relative to the ground, in the direction of the links; a wall moves with the ground."""
    along = run.structures[name].along
    parts = [(along[axis].displacement, factor) for axis, factor in zip("xy", _direction(run)) if axis in along]
    if floor < 0:
        return np.zeros_like(run.time)
    return sum(factor * displacement[:, floor] for displacement, factor in parts)


def _offsets(run: Run, names: list[str]) -> dict[str, float]:
    """Where each structure rests, a gap to the right of its left neighbour [m]."""
    offsets = {names[0]: 0.0} if names else {}
    for _ in names:
        for link in run.links.values():
            if link.left in offsets and link.right in names:
                offsets.setdefault(link.right, offsets[link.left] + link.gap)
            elif link.right in offsets and link.left in names:
                offsets.setdefault(link.left, offsets[link.right] - link.gap)
    return {name: offsets.get(name, 0.0) for name in names}


def _facing(run: Run, floors: dict[str, int]) -> list[tuple[str, str, float]]:
    """Drawn pairs (left, right, gap) that one link joins at the floors that are drawn."""
    pairs: dict[tuple[str, str], float] = {}
    for link in run.links.values():
        if link.left not in floors or link.right not in floors:
            continue
        ends = ((link.left, link.left_floor), (link.right, link.right_floor))
        if all(number in (0, floors[name] + 1) for name, number in ends):
            pairs.setdefault((link.left, link.right), link.gap)
    return [(left, right, gap) for (left, right), gap in pairs.items()]


def _link_styles(run: Run) -> Iterator[tuple[Link, dict[str, Any]]]:
    """Each link with its line: the hardest hit ones in colour, the others grey and below them."""
    peaks = {name: largest([run.impacts_of(name)["peak_force"]]) for name in run.links}
    chosen = sorted(run.links, key=lambda name: -peaks[name])[:len(LINK_COLOURS)]
    chosen = [name for name in run.links if name in chosen]
    others = [name for name in run.links if name not in chosen]
    for i, name in enumerate(others):
        words = f"{len(others)} other link" + ("s" if len(others) > 1 else "")
        yield run.links[name], {"color": QUIET, "linewidth": 0.7, "label": words if i == 0 else None, "zorder": 1}
    for name, colour in zip(chosen, LINK_COLOURS):
        # Weaker spikes stay visible in front of stronger ones of the same moment.
        rank = sum(peaks[other] > peaks[name] for other in chosen)
        yield run.links[name], {"color": colour, "label": name, "zorder": 2 + 0.1 * rank}


def _draw_impulses(axes: Axes, run: Run) -> None:
    size, unit = engineering(largest([run.impacts["impulse"]]), IMPULSE_UNITS)
    time_size, _ = _time_unit(run)
    for link, style in _link_styles(run):
        impacts = run.impacts_of(link.name)
        if impacts.size:
            axes.vlines(impacts["t_start"] / time_size, 0, impacts["impulse"] / size, color=style["color"],
                        label=style["label"])
    axes.set_title("Impulses of rigid contacts")
    axes.set_ylabel(f"Impulse\n[{unit}]")
    axes.set_ylim(bottom=0)
    _legend_beside(axes)


def _pulls(run: Run) -> bool:
    return any(link.force.size and link.force.min() < 0 for link in run.links.values())


def _closest(run: Run) -> str:
    openings = [-MM * link.penetration.max() for link in run.links.values() if link.penetration.size]
    return f"{min(openings):.4g} mm" if openings else "not recorded"


def _arrow(axes: Axes, x: np.ndarray, y: np.ndarray) -> None:
    """Direction of a loop, on its rising branch."""
    if x.size < 4:
        return
    rising = int(np.argmax(y))
    middle = max(1, min(int(np.searchsorted(y[:rising + 1], 0.55 * y[rising])), x.size - 2))
    axes.annotate("", (x[middle + 1], y[middle + 1]), (x[middle - 1], y[middle - 1]),
                  arrowprops={"arrowstyle": "-|>", "color": VERMILION, "linewidth": 0.8})


def _say(axes: Axes, words: str) -> None:
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center", color="0.35", fontsize=9)
    axes.set_yticks([])


def _legend_beside(axes: Axes, reverse: bool = False) -> None:
    """Outside, at the right: never over data."""
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        axes.legend(handles, labels, loc="upper left", bbox_to_anchor=(1.01, 1), reverse=reverse)


def _write_heading(figure: Figure, run: Run, title: str | None) -> None:
    title = run.title if title is None else title
    if run.status == "done":
        head(figure, title)
        return
    reached = f"t = {run.time[-1]:.4g} s" if run.time.size else "its start"
    state = f"This run is not complete: it was still running at {reached}."
    if run.status != "running":
        state = f"This run is not complete, it {run.status} (results up to {reached})"
    words = [*textwrap.wrap(title, 80), *textwrap.wrap(state, 85)]
    figure.suptitle("\n".join(words), fontsize=9.5, fontweight="bold", color=VERMILION)


def _floor_choice(text: str) -> dict[str, str]:
    """{structure: label} of "A.3,B.2"; argparse reports what is not of this form."""
    pairs = [part.strip().partition(".") for part in text.split(",")]
    if not all(name and label for name, _, label in pairs):
        raise argparse.ArgumentTypeError(f'"{text}" should name structures and floors, as in A.3,B.2')
    return {name: label for name, _, label in pairs}


def main(arguments: list[str] | None = None) -> int:
    """Command line. Returns 0, or 2 after a message when the results cannot be read or the picture not written."""
    parser = argparse.ArgumentParser(prog="python3 -m pounding.plots", description="Draw the results of a run.")
    parser.add_argument("results", help="file that `pounding run` wrote")
    parser.add_argument("-o", "--output", required=True, help="picture to write: .png, .pdf or .svg")
    parser.add_argument("--title", help="title instead of that of the run")
    parser.add_argument("--picture", choices=("run", "model", "profiles"), default="run",
                        help="the standard picture, the structures at rest, or extreme values over the height")
    parser.add_argument("--floors", type=_floor_choice, help="of whose displacements the standard picture shows: A.3,B.2")
    options = parser.parse_args(arguments)
    if options.floors and options.picture != "run":
        print(f"--floors belongs to --picture run; --picture {options.picture} shows every floor", file=sys.stderr)
        return 2
    try:
        run = read(options.results)
        if options.picture == "run":
            figure = standard_figure(run, options.title, options.floors)
        else:
            figure = (model_figure if options.picture == "model" else profiles_figure)(run, options.title)
    except (OSError, NotResults) as error:
        print(f"cannot read {options.results}: {error}", file=sys.stderr)
        return 2
    except BadRequest as error:
        print(error, file=sys.stderr)
        return 2
    return write_picture(figure, options.output)


if __name__ == "__main__":
    sys.exit(main())
