"""Classes of studies that `pounding.Study` returns, and fits of fragility curves to data of other programs."""

from pounding._studies import fragility
from pounding._studies.engines import Engine
from pounding._studies.fragility import Fragility
from pounding._studies.gaps import GapCurve

__all__ = ["Engine", "Fragility", "GapCurve", "fragility"]
