"""Taking the hands away."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture


class LetGo(Motion):
    """Hands that let go of all rings."""

    def __init__(self, _: moves.LetGo, sculpture: Sculpture) -> None:
        """Let go."""
        sculpture.hands.let_go(sculpture.all_joints)
