"""Twisting joints that lie together into one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture


class Weld(Motion):
    """Joints that become one."""

    def __init__(self, move: moves.Weld, sculpture: Sculpture) -> None:
        """Weld them."""
        sculpture.hands.weld(tuple(sculpture.joints[ring] for ring in move.rings))
