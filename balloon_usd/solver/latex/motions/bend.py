"""Bending a bubble of latex, which keeps part of its curve."""

from __future__ import annotations

from balloon_usd.operations import moves
from balloon_usd.solver.latex.motions.curve import LatexCurve
from balloon_usd.solver.motions.bend import Bend


class LatexBend(LatexCurve[moves.Bend], Bend):
    """A bubble of latex that is led onto an arc."""
