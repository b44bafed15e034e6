"""Twisting joints of a net into one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.kosaka.memory import LOOP_SET, set_bend
from balloon_usd.solver.motions.weld import Weld

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.kosaka.sculpture import KosakaSculpture


class KosakaWeld(Weld):
    """Joints that become one; a bubble whose own ends they are keeps its curve."""

    def __init__(self, move: moves.Weld, sculpture: KosakaSculpture) -> None:
        """Weld them; a net has no other stiffness that would hold a loop open."""
        super().__init__(move, sculpture)
        table = sculpture.plan.table
        bubble = table.rings[max(move.rings)].bubble
        if set(table.ends(bubble)) == set(move.rings):
            body, faces = sculpture.faces(bubble)
            set_bend(sculpture.scene, body, faces, LOOP_SET)
