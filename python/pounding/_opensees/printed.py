"""Properties that OpenSees returns only in the printed model."""

from __future__ import annotations

import json
import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pounding.errors import InputError

#: Number of printed digits, to which exact values are compared.
PRINTED = 1e-5


@dataclass
class Constraint:
    """u[constrained dofs] = matrix u[retained dofs]; dofs from 1, the matrix in six digits."""

    node: int
    retained: int
    dofs: tuple[int, ...]
    retained_dofs: tuple[int, ...]
    matrix: np.ndarray


def _as_json(material: re.Match[str]) -> str:
    kind, tag, values, comma = material.groups()
    pairs = re.findall(r"(\w+): (\S+)", values)
    return json.dumps({"name": tag, "type": kind, **{name: float(value) for name, value in pairs}}) + comma + "\n"


class Printed:
    """The text of printModel and its contents. `ops` is the module openseespy."""

    def __init__(self, ops: Any) -> None:
        self._ops = ops
        self._text = self._print()
        # The lines of genericClient and of some materials are not JSON.
        lines = re.sub(r"^.*\"GenericClient\".*\n", "", self._print("-JSON"), flags=re.MULTILINE)
        lines = re.sub(r"^(\w+),? tag: (\d+)\n((?:  \w+: \S+\n)+)(,?)\n?", _as_json, lines, flags=re.MULTILINE)
        self.model = json.loads(re.sub(r",(\s*\])", r"\1", lines))["StructuralAnalysisModel"]
        factors = [float(value) for value in re.findall(r"Rayleigh Factor: alphaM: (\S+)", self._text)]
        self.alpha_m = max(factors, default=0.0)
        whole, _, self._patterns = self._text.partition("LOAD PATTERNS:")
        self._supports = whole.partition("SP_Constraints: numConstraints:")[2].partition(
            "MP_Constraints: numConstraints:"
        )
        self.constraints = list(self._read_constraints(self._supports[2]))

    def consistent_mass(self, element: int) -> bool:
        """True if the mass of an element is consistent. Raises InputError if the text does not state it."""
        parts = re.split(
            r"^(?:ElasticBeam[23]d|Element): (\d+)", self._text.partition("ELEMENT DATA:")[2], flags=re.MULTILINE
        )
        of = dict(zip(parts[1::2], parts[2::2])).get(str(element), "")
        found = re.search(r"cMass: (\d)", of)
        if not found:
            raise InputError(f"element {element}: OpenSees does not state whether its mass is consistent")
        return found[1] == "1"

    def require_nothing_else(self, with_motion: bool, without_loads: bool) -> None:
        """Raises InputError for support displacements, ground motions and loads, which are not supported."""
        for node, dof, value in re.findall(r"Node: (\d+) DOF: (\d+) ref value: (\S+)", self._supports[0]):
            if float(value) != 0:
                raise InputError(
                    f"node {node}, degree of freedom {dof}: a support with the displacement {value} is not supported"
                )
        for pattern in re.split(r"^(?=Load Pattern: |UniformExcitation )", self._patterns, flags=re.MULTILINE)[1:]:
            kind, tag = re.match(r"(Load Pattern|UniformExcitation)\D+(\d+)", pattern).groups()  # type: ignore[union-attr]
            if kind == "UniformExcitation":
                if not with_motion:
                    raise InputError(
                        f"pattern {tag}: OpenSees does not return the motion of a UniformExcitation; pass ground_motion="
                    )
            elif re.search(r"numComponents: [1-9]", pattern) and not without_loads:
                raise InputError(
                    f"pattern {tag}: loads are not supported; type without_loads=True, and add them to the model "
                    "as `loads`"
                )

    def _print(self, *words: str) -> str:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "model"
            self._ops.printModel(*words, "-file", str(file))
            return file.read_text()

    def _read_constraints(self, text: str) -> Iterator[Constraint]:
        blocks = text.split("MP_Constraint: ")[1:]
        count = int(text.split()[0])
        if len(blocks) != count:
            raise InputError(f"OpenSees prints {len(blocks)} of {count} constraints")
        for block in blocks:
            found = re.search(
                r"Node Constrained: (\d+) node Retained: (\d+)\s+constrained dof:([\d ]*)\s+retained dof:([\d ]*)\s+"
                r"constraint matrix:\s+([-+.\deE\s]*)",
                block,
            )
            if not found:
                raise InputError(f"a constraint is printed as {block.strip()!r}, which is not understood")
            node, retained = int(found[1]), int(found[2])
            dofs, retained_dofs = (tuple(map(int, found[i].split())) for i in (3, 4))
            matrix = np.array([float(word) for word in found[5].split()]).reshape(len(dofs), len(retained_dofs))
            yield Constraint(node, retained, dofs, retained_dofs, matrix)
