"""Conversion of OpenSeesPy models to Model."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from pounding._arguments import flag, listed, number, optional, takes, text
from pounding._opensees.frames import Frames
from pounding._opensees.materials import GAPS
from pounding._opensees.printed import Printed
from pounding._opensees.springs import between_words
from pounding.errors import InputError
from pounding.models import Model
from pounding.opensees import Link, links, openseespy


@takes(
    rayleigh=optional(listed(number(), "the four factors of ops.rayleigh")),
    names=optional(listed(text, "a list of names")),
    without_loads=flag,
    title=optional(text),
)
def from_opensees(
    *,
    ground_motion: Mapping[str, Any] | None = None,
    analysis: Mapping[str, Any] | None = None,
    rayleigh: Sequence[float] | None = None,
    damping: Any = None,
    names: Sequence[str] | None = None,
    without: Iterable[int] = (),
    without_loads: bool = False,
    title: str | None = None,
    face: Any = None,
) -> Model:
    """The OpenSeesPy model of this process as a Model. Each connected part is converted to a structure of kind `frame`, and
    links of `pounding.opensees.link` become its links.

    Supported: nodes, masses, fix, elasticBeamColumn and ElasticTimoshenkoBeam with the transformation Linear, releases,
    joint offsets and mass per length, equalDOF, rigidLink and rigidDiaphragm. Yielding parts: a rotational zeroLength
    whose nodes are tied by equalDOF is a hinge at the end of its member; forceBeamColumn with HingeRadau and bilinear
    end sections is a member with hinges; truss, twoNodeLink and other zeroLength elements are devices. Their materials
    are Steel01, Steel02, ElasticPP, BoucWen, Hysteretic (two lines, without pinching, damage and beta), Elastic,
    ElasticMultiLinear (of devices), Viscous and ViscousDamper. A zeroLength along x of HyperbolicGapMaterial is a wall with backfill, of ElasticPPGap a
    contact that yields. A member has equal hinges at both ends, or a hinge at one end.

    The model is in N, m, kg, s; y is up in the plane, z in space. Names of nodes, members and devices follow from their
    tags: n24, e7, d12.

    Mass per length, joint offsets, BoucWen, Hysteretic, ElasticMultiLinear, HyperbolicGapMaterial and the hardening of
    ElasticPPGap have the six digits that OpenSees prints; all other values are exact. In OpenSees the
    stiffness-proportional part of Rayleigh damping excludes the springs of members; here it includes them.

    Parameters
    ----------
    ground_motion, analysis : mapping, optional
        As for Model. OpenSees does not return the motion of a UniformExcitation.
    rayleigh : sequence of float, optional
        Arguments of ops.rayleigh (alphaM, betaK, betaKinit, betaKcomm), which OpenSees does not return.
    damping : object, optional
        Damping with the keys of the input, instead of `rayleigh`; the default is undamped.
    names : sequence of str, optional
        Names of the structures by smallest x. By default two structures are called left and right, more of them
        frame1, frame2, ...
    without : iterable of int
        Tags of elements to omit.
    without_loads : bool
        True omits load patterns.
    title : str, optional
        Title of the model.
    face : object, optional
        Distance from the axes of the outer columns to the faces, such as "0.3 m", for all frames or by name: gaps are
        measured between faces.

    Returns
    -------
    Model
        The model.

    Raises
    ------
    InputError
        The model has an unsupported part.
    ImportError
        openseespy is missing.

    Examples
    --------
    >>> pounding.from_opensees(damping="5 %").structures.keys()  # doctest: +SKIP
    dict_keys(['left', 'right'])
    """
    ops = openseespy()
    printed = Printed(ops)
    frames = Frames(ops, printed, set(without))
    frames.require_rest()
    printed.require_nothing_else(ground_motion is not None, without_loads)
    if rayleigh is not None:
        if damping is not None:
            raise InputError("rayleigh and damping both define the damping; pass one of them")
        damping = rayleigh_words(rayleigh)
    elif damping is None and printed.alpha_m != 0:
        raise InputError(
            f"the nodes have Rayleigh damping with alphaM = {printed.alpha_m:g}; OpenSees does not return the other "
            "factors, so give rayleigh=(alphaM, betaK, betaKinit, betaKcomm), or damping="
        )
    parts = frames.parts()
    if names is None:
        names = ("left", "right") if len(parts) == 2 else [f"frame{i + 1}" for i in range(len(parts))]
    if len(names) != len(parts):
        raise InputError(f"names has {len(names)} names, and the model has {len(parts)} parts")
    structures = {name: frames.structure(part, damping) for name, part in zip(names, parts)}
    for name, distance in (face if isinstance(face, Mapping) else dict.fromkeys(structures, face)).items():
        if name not in structures:
            raise InputError(f"face: unknown frame {name!r} among {', '.join(structures)}")
        if distance is not None:
            structures[name]["face"] = distance
    home = {node: name for name, part in zip(names, parts) for node in part}
    between = [_link_words(each, home) for each in links() if each.tag not in frames.without]
    walls, gaps, devices = _joints(frames, home)
    return Model(
        structures | walls,
        between + gaps,
        ground_motion=ground_motion,
        analysis=analysis,
        title=title,
        devices=devices or None,
    )


def _joints(frames: Frames, home: Mapping[int, str]) -> tuple[dict[str, Any], list[dict[str, Any]], dict[str, Any]]:
    """Walls, gaps, and devices between two frames."""
    walls: dict[str, Any] = {}
    gaps: list[dict[str, Any]] = []
    devices: dict[str, Any] = {}
    fixed = {node for node, held in frames.held.items() if node not in home and len(held) == len(frames.dofs)}
    for spring in frames.springs:
        ends = [home.get(node) for node in spring.nodes]
        if any(material.kind in GAPS for material in spring.materials.values()):
            words = between_words(spring, home, fixed)
            for i, end in enumerate(words["between"]):
                if end == "ground":
                    words["between"][i] = f"wall{spring.tag}"
                    walls[f"wall{spring.tag}"] = {"wall": {}}
            gaps.append(words)
        elif None not in ends and ends[0] != ends[1]:
            if not spring.has_length:
                raise InputError(
                    f"element {spring.tag} joins {ends[0]} and {ends[1]} by a zeroLength; replace it by a twoNodeLink between nodes "
                    "with different coordinates"
                )
            spring.direction(frames.dimension)
            devices[f"d{spring.tag}"] = {
                "between": [{"structure": end, "node": f"n{node}"} for end, node in zip(ends, spring.nodes)],
                **spring.words(),
            }
        elif set(spring.nodes) - set(home) - fixed or ends == [None, None]:
            raise InputError(f"element {spring.tag}: one of its nodes belongs to no frame and is not fixed")
    return walls, gaps, devices


def rayleigh_words(factors: Sequence[float]) -> dict[str, Any] | None:
    """Damping with input keys from alphaM [1/s] and the betas [s], whose sum acts on elastic members."""
    by_mass, by_stiffness = float(factors[0]), float(sum(factors[1:]))
    if not all(math.isfinite(factor) and factor >= 0 for factor in (by_mass, by_stiffness)):
        raise InputError(f"rayleigh is {tuple(factors)}, but takes factors that are not negative")
    if by_mass == by_stiffness == 0:
        return None
    return {"rayleigh": {"alpha": by_mass, "beta": by_stiffness}}


def _link_words(link: Link, home: Mapping[int, str]) -> dict[str, Any]:
    for node in link.nodes:
        if node not in home:
            raise InputError(f"element {link.tag}: node {node} belongs to no frame")
    if link.dof != 1:
        raise InputError(
            f"element {link.tag} acts along degree of freedom {link.dof}; only links along x are supported"
        )
    law = link.law
    given = dict.fromkeys(("formula", "restitution", "impact_velocity", "reduced_mass")) | law.given()
    return {
        "between": [{"structure": home[node], "node": f"n{node}"} for node in link.nodes],
        "gap": link.gap,
        "law": law.kind.name,
        **{name: value for name, value in {**given, "reduced_mass": link.reduced_mass}.items() if value is not None},
    }
