"""Moves in which the hands wait."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations.moves import Move
    from balloon_usd.solver.sculpture import Sculpture


class Wait(Motion):
    """Hands that wait."""

    def __init__(self, _: Move, __: Sculpture) -> None:
        """Do nothing."""
