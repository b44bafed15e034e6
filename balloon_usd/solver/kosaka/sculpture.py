"""One sculpture of the thesis's model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.sculpture import Sculpture

if TYPE_CHECKING:
    from balloon_usd.solver.kosaka.scene import KosakaScene


class KosakaSculpture(Sculpture):
    """A plan, its balloons in a scene of the thesis's model, and the hands on them."""

    scene: KosakaScene
