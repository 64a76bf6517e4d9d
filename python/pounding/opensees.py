"""OpenSeesPy models with our gap links, in the process that holds the model.

    import openseespy.opensees as ops
    import pounding

    ...                                                            # nodes, masses, elements of two structures
    link = pounding.opensees.link(100, 24, 1004, gap="20 mm", law="jankowski", stiffness=2.75e9, restitution=0.65)
    ...                                                            # a transient analysis with Newton
    ops.analyze(3000, 1e-3)
    link.impacts["restitution"]

Everything is in SI: the model has to be in N, m, kg, s.
"""

from __future__ import annotations

import contextlib
import json
import math
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from pounding import _printing as printing
from pounding._arguments import quantity, refuse, takes, whole
from pounding._law_parameters import Quantity, number_in
from pounding._opensees.link_process import Impact
from pounding.contact import Law, laws
from pounding.errors import InputError, SolverError

__all__ = ["Link", "link", "links"]

#: The program that serves one link.
LINK_PROCESS = Path(__file__).parent / "_opensees/link_process.py"
#: Columns of Link.impacts, with the meaning and the units of those of Run.impacts; peaks are the largest at the ends of
#: steps.
IMPACT = np.dtype([(column.name, float) for column in fields(Impact)])


def openseespy() -> Any:
    """The module openseespy with the model of this process. Raises ImportError with the command to install it."""
    try:
        import openseespy.opensees as ops
    except ImportError as error:
        raise ImportError(
            f"openseespy cannot be loaded: {error}. Type `python3 -m pip install openseespy`; on Debian it needs "
            "libblas3 and liblapack3"
        ) from error
    return ops


class Link(printing.ReportLines, lines=printing.opensees_link):
    """A gap link in an OpenSees model, created by `link`."""

    def __init__(
        self, tag: int, nodes: tuple[int, int], dof: int, gap: float, law: Law, reduced_mass: float | None
    ) -> None:
        self.tag, self.nodes, self.dof, self.gap, self.law = tag, nodes, dof, gap, law
        self.reduced_mass = reduced_mass  #: [kg]; None if the law needs none
        self._last: dict[str, Any] | None = None
        values = {**law.given(), "reduced_mass": reduced_mass}
        asked = {
            "law": law.kind.name,
            "formula": values.pop("formula", ""),
            "gap": gap,
            "values": {name: value for name, value in values.items() if value is not None},
        }
        # In a separate session, since OpenSees would wait forever for a link that Ctrl-C has ended. Started as a file,
        # since -m would import this package first.
        self._process = subprocess.Popen(
            [sys.executable, str(LINK_PROCESS)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        answer = self._ask(json.dumps(asked))
        if "error" in answer:
            raise InputError(f"element {tag}: {answer['error']}")
        self.port: int = answer["port"]

    @property
    def impacts(self) -> np.ndarray:
        """One row per impact, until now or until the model was wiped, with the columns of IMPACT.

        t_end, v_separation and restitution of an unfinished impact are NaN.

        Raises
        ------
        SolverError
            The link received states that are not finite.
        """
        answer = self._tell()
        if answer["error"]:
            raise SolverError(f"element {self.tag}: {answer['error']}")
        return np.array([tuple(row[name] for name in IMPACT.names or ()) for row in answer["impacts"]], dtype=IMPACT)

    def _tell(self) -> dict[str, Any]:
        if self._last is None:
            ops = openseespy()
            if self.tag in ops.getEleTags():
                answer = self._ask("")
                if not answer.get("connected"):
                    return answer
                # The element answers after everything it had sent, so the next request includes all of it.
                ops.eleResponse(self.tag, "force")
                return self._ask("")
            self._last = self._rest()
        return self._last

    def _ask(self, line: str) -> dict[str, Any]:
        assert self._process.stdin and self._process.stdout
        try:
            self._process.stdin.write(line + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            pass
        answer = self._process.stdout.readline()
        if not answer:
            raise SolverError(f"element {self.tag}: its process has ended, with {self._process.wait()}")
        return json.loads(answer)

    def _rest(self) -> dict[str, Any]:
        """Stores the last answer of the process after the end of its element."""
        assert self._process.stdin and self._process.stdout
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        lines = self._process.stdout.readlines()
        self._process.wait()
        return json.loads(lines[-1]) if lines else {"error": "", "impacts": []}


#: Tags of OpenSees.
_INT = whole(-(2**31), 2**31 - 1)
#: All links of this process: a link serves its element even if no variable refers to it.
_made: list[Link] = []


def links() -> list[Link]:
    """Links of the current OpenSees model in the order of their creation.

    Returns
    -------
    list of Link
        The links.

    Raises
    ------
    ImportError
        openseespy is missing.
    """
    ops = openseespy()
    tags = set(ops.getEleTags())
    of_tag = {each.tag: each for each in _made if each.tag in tags and tuple(ops.eleNodes(each.tag)) == each.nodes}
    return [each for each in _made if of_tag.get(each.tag) is each]


@takes(tag=_INT, node_i=_INT, node_j=_INT, gap=quantity, dof=whole(1))
def link(
    tag: int,
    node_i: int,
    node_j: int,
    *,
    gap: Quantity,
    law: str | Law,
    dof: int = 1,
    reduced_mass: Quantity | None = None,
    **parameters: Quantity,
) -> Link:
    """Adds a gap link between two nodes of the OpenSees model, as its element of type genericClient.

    For implicit transient integrators: the element returns its stiffness dF/dd and its damping dF/dd', so that Newton's
    method has the exact slopes. Contact and separation are detected at the ends of steps; impact speeds are located
    within them. OpenSees reports that the element cannot revert when a step fails; the analysis may continue with
    another step. Its `force` in a recorder lacks the damping part, so use the impacts of the Link. The link ends with
    the model (ops.wipe).

    Parameters
    ----------
    tag : int
        Tag of the element.
    node_i, node_j : int
        Tags of the nodes, on the body with the smaller and with the larger coordinate. The gap closes if node_i moves
        towards node_j. A fixed node is a wall.
    gap : float or str
        Gap, not negative [m].
    law : str or Law
        Name of a law with its `parameters`, or a law such as laws["hertz"](stiffness=2e9).
    dof : int
        Degree of freedom along which the gap closes (1: x).
    reduced_mass : float or str, optional
        Reduced mass [kg], by default that of the masses at the two nodes.
    **parameters
        restitution, formula, impact_velocity, stiffness, ...

    Returns
    -------
    Link
        The link.

    Raises
    ------
    InputError
        A value is wrong.
    ImportError
        openseespy is missing.
    """
    ops = openseespy()
    if isinstance(law, str):
        given: dict[str, Any] = {**parameters, "reduced_mass": reduced_mass}
        law = laws[law](**given)
    elif not isinstance(law, Law):
        raise refuse("law", "the name of a law or a law", law)
    elif parameters:
        raise InputError(f"law has its own parameters; remove {', '.join(parameters)}")
    if law.kind.instantaneous:
        raise InputError(
            f"{law.kind.name} is a jump of the velocity, which OpenSees elements cannot represent; use another law"
        )
    opening = number_in("gap", gap, "m")
    if not (math.isfinite(opening) and opening >= 0):
        raise InputError(f"gap is {gap}, but must be finite and not negative")
    nodes = set(ops.getNodeTags())
    for node in (node_i, node_j):
        if node not in nodes:
            raise InputError(f"element {tag}: unknown node {node}")
        if not 1 <= dof <= ops.getNDF(node)[0]:
            raise InputError(f"element {tag}: node {node} has no degree of freedom {dof}")
    if tag in ops.getEleTags():
        raise InputError(f"element {tag} exists already; choose another tag")
    _require_order(ops, tag, node_i, node_j, dof)
    mass = law.reduced_mass
    if law.kind.takes_reduced_mass and mass is None:
        mass = _reduced_mass(ops, tag, node_i, node_j, dof)
    made = Link(tag, (node_i, node_j), dof, opening, law, mass if law.kind.takes_reduced_mass else None)
    words = ["-node", node_i, node_j, "-dof", dof, "-dof", dof, "-server", made.port, "-dataSize", 8, "-noRayleigh"]
    ops.element("genericClient", tag, *words)
    _made.append(made)
    return made


def _require_order(ops: Any, tag: int, node_i: int, node_j: int, dof: int) -> None:
    at_i, at_j = ops.nodeCoord(node_i), ops.nodeCoord(node_j)
    if dof <= len(at_i) and at_i[dof - 1] > at_j[dof - 1]:
        raise InputError(
            f"element {tag}: node {node_i} at {at_i[dof - 1]:g} lies beyond node {node_j} at {at_j[dof - 1]:g} "
            f"along degree of freedom {dof}; type link({tag}, {node_j}, {node_i}, ...)"
        )


def _reduced_mass(ops: Any, tag: int, node_i: int, node_j: int, dof: int) -> float:
    inverse = 0.0
    for node in (node_i, node_j):
        if node in ops.getFixedNodes() and dof in ops.getFixedDOFs(node):
            continue
        mass = ops.nodeMass(node, dof)
        if not mass > 0:
            raise InputError(
                f"element {tag}: node {node} has no mass in degree of freedom {dof}, and the damping depends on it; "
                "give reduced_mass, m1 m2/(m1 + m2)"
            )
        inverse += 1 / mass
    if inverse == 0:
        raise InputError(f"element {tag}: both nodes are fixed")
    return 1 / inverse
