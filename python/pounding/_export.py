"""Export of a run to ParaView: `python3 -m pounding._export RESULTS.h5 [-o NAME.xdmf]`.

NAME.xdmf is a text that refers to datasets in the results file. Data of another shape (displacements of sticks, of
plane frames, of frames with a subset of their nodes) are written to NAME.data.h5. Every structure is a grid of lines
with the point vectors `displacement` [m], relative to the ground. If the results have end forces of members, each
component is a cell array, such as `start N` [N], [N m], as is `axial force`, positive in tension [N]; other members
are NaN. In ParaView select the reader "XDMF Reader" and warp by `displacement`."""

from __future__ import annotations

import argparse
import os
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable
from os import PathLike
from pathlib import Path

import h5py
import numpy as np

from pounding._ended import exit_code
from pounding._outputs import Kind, output_for, replaced, tell
from pounding._pictures.geometry import LineModel, displaced_at, node_displacements
from pounding._pictures.scene import Scene
from pounding._pictures.style import BadRequest
from pounding._texts import text
from pounding.results import RunData

#: Attribute that identifies the data of an earlier export.
MARK = "pounding export"
#: Number of output times in memory.
BLOCK = 200


def export(results: str | PathLike[str], run: RunData, path: str | PathLike[str]) -> Path:
    """Writes `path` for the run read from the file `results`, and its data file, whose name is returned.

    Raises InputError if the suffix is not .xdmf, if the run has no output times, or if an existing file is not an
    export; OSError if a file cannot be written."""
    path = Path(path)
    if path.suffix != ".xdmf":
        raise BadRequest(f'cannot write {path}: "{path.suffix}" is not .xdmf')
    if not run.time.size:
        raise BadRequest("nothing to export: the results have no output times")
    companion = path.with_name(f"{path.stem}.data.h5")
    if companion.resolve() == Path(results).resolve():
        raise BadRequest(f"cannot write {companion} for {path}: it is the results file. Type another name after -o")
    with replaced(path, XDMF) as text_file, replaced(companion, DATA) as data_file:
        with h5py.File(data_file, "w") as data:
            data.attrs["program"] = MARK
            scene = Scene(run)
            grids = [_Grid(name, scene, Path(results), companion, data) for name in run.structures]
            grids = [grid for grid in grids if grid.has_points]
        ElementTree.ElementTree(_xdmf(grids, run)).write(text_file, encoding="utf-8", xml_declaration=True)
    return companion


def _xdmf(grids: list[_Grid], run: RunData) -> ElementTree.Element:
    root = ElementTree.Element("Xdmf", Version="2.0")
    domain = ElementTree.SubElement(root, "Domain")
    for grid in grids:
        # A series for each structure: names of grids within one series would be numbered by the reader.
        series = ElementTree.SubElement(
            domain, "Grid", Name=grid.name, GridType="Collection", CollectionType="Temporal"
        )
        for i, time in enumerate(run.time):
            grid.write(series, i, float(time))
    ElementTree.indent(root)
    return root


def _is_data(place: Path, _: bytes) -> bool:
    try:
        with h5py.File(place) as earlier:
            return text(earlier.attrs.get("program", "")) == MARK
    except OSError:
        return False


XDMF = Kind("export", lambda _, start: b"<Xdmf" in start)
DATA = Kind("export", _is_data)


class _Data:
    """A dataset [time, item, ...] in one of the two files, with its name from the .xdmf."""

    def __init__(self, file: Path, place: str, shape: tuple[int, ...], beside: Path) -> None:
        self.shape = shape
        self.name = f"{Path(os.path.relpath(file.resolve(), beside.resolve().parent)).as_posix()}:{place}"

    def whole(self, parent: ElementTree.Element, kind: dict[str, str]) -> None:
        item = ElementTree.SubElement(parent, "DataItem", {"Format": "HDF", "Dimensions": _numbers(self.shape), **kind})
        item.text = self.name

    def at(self, parent: ElementTree.Element, step: int, first: int, count: int) -> None:
        """`count` values of the last axis from `first`, at one time: [item, count]."""
        items = self.shape[1]
        shape = (items, count) if count > 1 else (items,)
        slab = ElementTree.SubElement(
            parent, "DataItem", ItemType="HyperSlab", Type="HyperSlab", Dimensions=_numbers(shape)
        )
        choice = ElementTree.SubElement(slab, "DataItem", Dimensions="3 3", Format="XML", NumberType="Int")
        choice.text = " ".join(map(_numbers, ((step, 0, first), (1, 1, 1), (1, items, count))))
        self.whole(slab, FLOATS)


FLOATS = {"NumberType": "Float", "Precision": "8"}
INTEGERS = {"NumberType": "Int", "Precision": "8"}


class _Grid:
    """One structure."""

    def __init__(self, name: str, scene: Scene, results: Path, companion: Path, data: h5py.File) -> None:
        self.name, self.scene, self.data, self.beside = name, scene, data, companion
        structure = self.structure = scene.run.structures[name]
        model = scene.line_models[name]
        self.has_points = len(model.nodes) > 0
        if not self.has_points:
            return
        # Only cells are visible, so a body is a line of length zero.
        lines = model.members if len(model.members) else np.repeat(np.arange(len(model.nodes))[:, None], 2, axis=1)
        own = f"/structures/{name}"
        self.points = self._store("points", scene.at_rest(name))
        self.lines = self._store("members", lines.astype(np.int64))
        nodes = structure.nodes
        if nodes is not None and self._has_every_node():
            self.displacement = _Data(results, f"{own}/nodes/displacement", nodes.displacement.shape, companion)
        else:
            self.displacement = self._store_displacements(model)
        #: Datasets of forces of members, and their components.
        self.forces: list[tuple[_Data, list[str]]] = []
        members, geometry = structure.members, structure.geometry
        if members is not None and geometry is not None:
            if members.names == geometry.member_names:
                stored = _Data(results, f"{own}/members/end_forces", members.end_forces.shape, companion)
            else:
                stored = self._store_forces("end_forces", members.end_forces, members.names, geometry.member_names)
            axial = self._store_forces(
                "axial_force", members.axial_force[:, :, None], members.names, geometry.member_names
            )
            self.forces = [(stored, members.components), (axial, ["axial force"])]

    def write(self, parent: ElementTree.Element, step: int, time: float) -> None:
        grid = ElementTree.SubElement(parent, "Grid", Name=self.name, GridType="Uniform")
        ElementTree.SubElement(grid, "Time", Value=repr(time))
        topology = ElementTree.SubElement(
            grid, "Topology", TopologyType="Polyline", NodesPerElement="2", NumberOfElements=str(self.lines.shape[0])
        )
        self.lines.whole(topology, INTEGERS)
        self.points.whole(ElementTree.SubElement(grid, "Geometry", GeometryType="XYZ"), FLOATS)
        vectors = ElementTree.SubElement(grid, "Attribute", Name="displacement", AttributeType="Vector", Center="Node")
        self.displacement.at(vectors, step, 0, 3)
        for forces, components in self.forces:
            for i, component in enumerate(components):
                scalars = ElementTree.SubElement(
                    grid, "Attribute", Name=component, AttributeType="Scalar", Center="Cell"
                )
                forces.at(scalars, step, i, 1)

    def _has_every_node(self) -> bool:
        nodes, geometry = self.structure.nodes, self.structure.geometry
        return (
            nodes is not None
            and geometry is not None
            and nodes.names == geometry.node_names
            and nodes.directions[:3] == ["x", "y", "z"]
        )

    def _store(self, what: str, values: np.ndarray) -> _Data:
        place = f"/{self.name}/{what}"
        self.data[place] = values
        return _Data(self.beside, place, values.shape, self.beside)

    def _store_displacements(self, model: LineModel) -> _Data:
        time = self.scene.run.time
        stored = self.data.create_dataset(f"/{self.name}/displacement", (time.size, len(model.nodes), 3), "f8")
        for first in range(0, time.size, BLOCK):
            times = time[first : first + BLOCK]
            stored[first : first + BLOCK] = node_displacements(displaced_at(self.structure, time, times), model)
        return _Data(self.beside, stored.name, stored.shape, self.beside)

    def _store_forces(self, what: str, forces: np.ndarray, members: list[str], names: list[str]) -> _Data:
        """Stores forces [time, member, component] of some of the named members."""
        values = np.full((len(forces), len(names), forces.shape[2]), np.nan)
        values[:, [names.index(name) for name in members]] = forces
        return self._store(what, values)


def _numbers(values: Iterable[int]) -> str:
    return " ".join(map(str, values))


def main(arguments: list[str] | None = None) -> int:
    """Command line: writes the export. Raises InputError, OSError."""
    parser = argparse.ArgumentParser(
        prog="python3 -m pounding._export", description="Write the results of a run for ParaView."
    )
    parser.add_argument("results", help="file that `pounding run` wrote")
    parser.add_argument("-o", "--output", help="file to write: .xdmf (default: RESULTS.xdmf in the current folder)")
    options = parser.parse_args(arguments)
    output = output_for(options.results, options.output, ".xdmf")
    tell("export", output, export(options.results, RunData.read(options.results), output))
    return 0


if __name__ == "__main__":
    sys.exit(exit_code(main))
