"""Uniaxial materials of an OpenSees model as hysteretic laws."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding._opensees.printed import PRINTED, Printed
from pounding.errors import InputError

#: Printed values of a material, and the parameters for their exact values.
EXACT = {
    "Steel01": {"fy": "Fy", "E": "E", "b": "b"},
    "Steel02": {"fy": "Fy", "E": "E", "b": "b", "R0": "R0", "cR1": "cR1", "cR2": "cR2"},
    "ElasticMaterial": {"Epos": "E", "eta": "eta"},
    "ElasticPPMaterial": {"E": "E"},
    "EPPGap": {"E": "E", "fy": "Fy", "gap": "gap"},
    "Viscous": {"C": "C", "Alpha": "Alpha", "minVel": "minVel"},
    "ViscousDamper": {"K": "K", "C": "C", "Alpha": "Alpha"},
}


@dataclass(frozen=True)
class Law:
    """A hysteretic law with its input values, named as for a force; `moments` and `times` convert them."""

    name: str
    values: Mapping[str, Any]

    #: Exponents of force and length in the units of input keys.
    UNITS = {"stiffness": (1, -1), "yield_force": (1, 0), "deformation": (0, 1), "force": (1, 0)}

    def times(self, force: float, length: float) -> Law:
        """The law with scaled forces and deformations."""

        def scaled(word: str, value: Any) -> Any:
            of_force, of_length = self.UNITS.get(word, (0, 0))
            factor = force**of_force * length**of_length
            if isinstance(value, list):
                return [one * factor for one in value]
            return value * factor if of_force or of_length else value

        return Law(self.name, {word: scaled(word, value) for word, value in self.values.items()})

    def words(self) -> dict[str, Any]:
        """Input keys of a device or a storey."""
        return {self.name: dict(self.values)}

    def moments(self) -> dict[str, Any]:
        """Input keys of a hinge; the hardening ratio of OpenSees is that of the spring alone."""
        if self.name == "multilinear_elastic":
            raise InputError("hinges take no ElasticMultiLinear material; use it in a device, or a yielding material")
        names = {"yield_force": "yield_moment", "hardening": "spring_hardening"}
        return {self.name: {names.get(word, word): value for word, value in self.values.items()}}


@dataclass(frozen=True)
class Material:
    """A uniaxial material as printed, with exact values of the numbers that OpenSees returns as parameters."""

    tag: str
    kind: str
    values: Mapping[str, Any]

    def refuse(self, reason: str) -> InputError:
        """The error with the reason why the material is not supported."""
        return InputError(f"material {self.tag} ({self.kind}): {reason}")

    def require(self, **wanted: float) -> None:
        """Raises InputError if a value differs from the one that the law assumes."""
        for name, value in wanted.items():
            if self.values[name] != value:
                raise self.refuse(f"{name} is {self.values[name]:g}, and only {value:g} is supported")

    def law(self) -> Law:
        """The equivalent hysteretic law. Raises InputError for other materials."""
        if self.kind not in LAWS:
            raise self.refuse(f"it is not supported here; {', '.join(_plain(kind) for kind in LAWS)} are")
        return LAWS[self.kind](self)


def read_material(printed: Printed, name: str, ask: Callable[[str, float], float]) -> Material:
    """A material of the printed model, with exact values from `ask(parameter, value)`."""
    line = next(each for each in printed.model["properties"]["uniaxialMaterials"] if each["name"] == name)
    exact = {key: ask(word, line[key]) for key, word in EXACT.get(line["type"], {}).items()}
    return Material(
        name, line["type"], {key: value for key, value in line.items() if key not in ("name", "type")} | exact
    )


def _plain(kind: str) -> str:
    return kind.removesuffix("Material")


def _steel01(of: Material) -> Law:
    of.require(a1=0, a3=0)
    return Law("bilinear", {"stiffness": of.values["E"], "yield_force": of.values["fy"], "hardening": of.values["b"]})


def _steel02(of: Material) -> Law:
    bilinear = _steel01(of).values
    of.require(sigini=0)
    curve = {name: of.values[name] for name in ("R0", "cR1", "cR2")}
    return Law("menegotto_pinto", {**bilinear, **curve, "memory": "last"})


def _elastic_plastic(of: Material) -> Law:
    of.require(eps0=0, epsyn=-of.values["epsyp"])
    return Law(
        "bilinear", {"stiffness": of.values["E"], "yield_force": of.values["E"] * of.values["epsyp"], "hardening": 0.0}
    )


def _bouc_wen(of: Material) -> Law:
    of.require(Ao=1, deltaA=0, deltaNu=0, deltaEta=0)
    stiffness, n, beta, gamma = (of.values[name] for name in ("ko", "n", "beta", "gamma"))
    if not beta + gamma > 0:
        raise of.refuse(f"beta + gamma is {beta + gamma:g}, so it never yields")
    # OpenSees' z is a deformation that ends at (beta + gamma)^(-1/n).
    return Law(
        "bouc_wen",
        {
            "stiffness": stiffness,
            "yield_force": stiffness * (beta + gamma) ** (-1 / n),
            "hardening": of.values["alpha"],
            "exponent": n,
            "gamma_share": gamma / (beta + gamma),
        },
    )


def _hysteretic(of: Material) -> Law:
    values = of.values
    of.require(pinchX=1, pinchY=1, damfc1=0, damfc2=0)
    if values["beta"] != 0:
        raise of.refuse(f"beta is {values['beta']:g}, and small cycles follow peak_oriented only for beta = 0")
    for name in ("s1", "e1", "s2", "e2", "s3", "e3"):
        if abs(values[name + "p"] + values[name + "n"]) > PRINTED * abs(values[name + "p"]):
            raise of.refuse("its two sides differ")
    slopes = [values[name] for name in ("E1p", "E2p", "E3p")]
    # OpenSees splits the second of two lines at its middle.
    if abs(slopes[2] - slopes[1]) > PRINTED * slopes[0]:
        raise of.refuse(
            "its backbone has three lines, between which it unloads differently from peak_oriented; two are supported"
        )
    stiffness = values["s1p"] / values["e1p"]
    hardening = (values["s3p"] - values["s1p"]) / (values["e3p"] - values["e1p"]) / stiffness
    return Law(
        "peak_oriented",
        {"stiffness": stiffness, "yield_force": values["s1p"], "hardening": hardening, "unloading": 0.0},
    )


def _multilinear(of: Material) -> Law:
    of.require(eta=0)
    strains, stresses = of.values["strainPoints"], of.values["stressPoints"]
    if abs(np.interp(0.0, strains, stresses)) > PRINTED * max(map(abs, stresses)):
        raise of.refuse("its curve does not pass through the origin")
    return Law("multilinear_elastic", {"deformation": list(strains), "force": list(stresses)})


LAWS: dict[str, Callable[[Material], Law]] = {
    "Steel01": _steel01,
    "Steel02": _steel02,
    "ElasticPPMaterial": _elastic_plastic,
    "BoucWenMaterial": _bouc_wen,
    "HystereticMaterial": _hysteretic,
    "ElasticMultiLinear": _multilinear,
}


def device_words(of: Material, force: float = 1.0, length: float = 1.0) -> dict[str, Any]:
    """Input keys of a device with this material. Stresses are multiplied by `force` [m^2], 1 for forces, and strains
    by `length` [m]."""
    values = of.values
    if of.kind == "ElasticMaterial":
        of.require(Eneg=float(f"{values['Epos']:g}"))
        words: dict[str, Any] = {"bar": {"stiffness": values["Epos"] * force / length}} if values["Epos"] else {}
        return words | ({"damper": {"coefficient": values["eta"] * force / length}} if values["eta"] else {})
    if of.kind == "Viscous":
        return {"damper": _damper(values, force, length)}
    if of.kind == "ViscousDamper":
        of.require(LGap=0)
        return {"damper": {**_damper(values, force, length), "stiffness": values["K"] * force / length}}
    return of.law().times(force, length).words()


def _damper(values: Mapping[str, Any], force: float, length: float) -> dict[str, Any]:
    words = {"coefficient": values["C"] * force / length ** values["Alpha"]}
    return words if values["Alpha"] == 1 else {**words, "exponent": values["Alpha"]}


def gap_words(of: Material) -> dict[str, Any]:
    """Input keys of a link with the law of a gap material, such as the soil behind a wall."""
    if of.kind not in GAPS:
        raise of.refuse(
            f"only {' and '.join(GAPS)} act between two structures along one axis; use pounding.opensees.link for other gaps"
        )
    return GAPS[of.kind](of)


def _elastic_plastic_gap(of: Material) -> dict[str, Any]:
    values = of.values
    if not values["fy"] < 0 or values["gap"] > 0:
        raise of.refuse(
            f"Fy is {values['fy']:g} and gap {values['gap']:g}; a contact is compressed: Fy < 0 and gap <= 0"
        )
    return {
        "gap": -values["gap"],
        "law": "elastic_plastic_gap",
        "stiffness": values["E"],
        "yield_force": -values["fy"],
        "hardening": values["eta"],
        "damage": bool(values["damageFlag"]),
    }


def _backfill(of: Material) -> dict[str, Any]:
    values = of.values
    if not 0 < values["Kmax"] <= values["Kur"]:
        raise of.refuse(f"Kmax is {values['Kmax']:g} and Kur {values['Kur']:g}; a soil has 0 < Kmax <= Kur")
    return {
        "gap": abs(values["gap"]),
        "law": "backfill",
        "stiffness": values["Kmax"],
        "unloading": values["Kur"],
        "failure_ratio": values["Rf"],
        "strength": abs(values["Fult"]),
    }


#: Materials of gaps between two structures.
GAPS: dict[str, Callable[[Material], dict[str, Any]]] = {
    "HyperbolicGapMaterial": _backfill,
    "EPPGap": _elastic_plastic_gap,
}
