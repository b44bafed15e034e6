"""Bending a bubble of a net, whose springs keep part of its curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.kosaka.memory import BEND_SET, set_bend
from balloon_usd.solver.motions.bend import Bend

if TYPE_CHECKING:
    from balloon_usd.solver.kosaka.sculpture import KosakaSculpture


class KosakaBend(Bend):
    """A bubble of a net that is led onto an arc."""

    _sculpture: KosakaSculpture

    def set_bend(self, bubble: str) -> None:
        """Let its springs keep their lengths, in part."""
        body, faces = self._sculpture.faces(bubble)
        set_bend(self._sculpture.scene, body, faces, BEND_SET)
