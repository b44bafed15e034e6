"""Setting a net of latex, whose welds keep the pose that it gets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.motions.set_net import SetNet

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class LatexSetNet(SetNet):
    """A net of latex that is set."""

    def __init__(self, move: moves.SetNet, sculpture: LatexSculpture) -> None:
        """Turn the bubbles in their welds, against their friction: they keep no pose until hands let go."""
        super().__init__(move, sculpture)
        sculpture.struts.loosen(set(sculpture.joints))
