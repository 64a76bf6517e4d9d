"""Constraints of an OpenSees model as rigid floors and ties."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pounding._opensees.printed import PRINTED, Constraint
from pounding.errors import InputError

#: Names of degrees of freedom by the dimension. In the plane OpenSees has x, y and a rotation from x to y.
DOFS = {2: ("ux", "uz", "ry"), 3: ("ux", "uy", "uz", "rx", "ry", "rz")}


def floors_and_ties(
    constraints: Sequence[Constraint], nodes: Mapping[int, Sequence[float]], dimension: int
) -> tuple[dict[int, list[int]], list[dict[str, Any]]]:
    """Nodes of rigid floors by their retained node, and ties. `nodes` are coordinates [m]. Raises InputError for
    other constraints."""
    floors: dict[int, list[int]] = defaultdict(list)
    ties: list[dict[str, Any]] = []
    in_plan = (1, 2, 6) if dimension == 3 else ()
    above: list[Constraint] = []  # a node in the plane of its retained node is a node of the floor
    for c in constraints:
        arm = np.subtract(nodes[c.node], nodes[c.retained])
        if c.dofs == in_plan and c.retained_dofs == in_plan and not arm.any():
            above.append(c)
        elif c.dofs == c.retained_dofs and np.array_equal(c.matrix, np.eye(len(c.dofs))):
            ties.append(_tie(c, {"dofs": [DOFS[dimension][dof - 1] for dof in c.dofs]}))
        elif c.dofs != c.retained_dofs or not _is_rigid(c, arm, dimension):
            raise InputError(
                f"the constraint of node {c.node} to node {c.retained}, degrees of freedom {list(c.dofs)}, is "
                "neither an equalDOF, a rigidLink nor a rigidDiaphragm that is level"
            )
        elif c.dofs == in_plan:
            floors[c.retained].append(c.node)
        else:
            ties.append(_tie(c, {"rigid": True}))
    for c in above:
        if c.retained in floors:
            floors[c.retained].append(c.node)
        else:
            ties.append(_tie(c, {"dofs": ["ux", "uy", "rz"]}))
    return dict(floors), ties


def _tie(constraint: Constraint, words: dict[str, Any]) -> dict[str, Any]:
    return {"all": [constraint.retained, constraint.node], "words": words}


def _is_rigid(constraint: Constraint, arm: np.ndarray, dimension: int) -> bool:
    """True if the matrix is a rigid-body motion to six digits."""
    full = np.eye(len(DOFS[dimension]))
    if dimension == 2:
        full[:2, 2] = -arm[1], arm[0]
    else:
        x, y, z = arm
        full[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    rows = [dof - 1 for dof in constraint.dofs]
    if len(rows) < len(full) and not (dimension == 3 and constraint.dofs == (1, 2, 6)):
        return False
    wanted = full[np.ix_(rows, rows)]
    return bool(np.allclose(constraint.matrix, wanted, rtol=PRINTED, atol=PRINTED * max(1.0, np.abs(arm).max())))
