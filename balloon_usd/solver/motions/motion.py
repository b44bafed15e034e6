"""What all motions share: a motion is a move of a plan under way."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from balloon_usd.operations.moves import Move


class Motion:
    """A move of a plan under way: made when the move begins, with the state that it needs meanwhile.

    A subclass takes the move and the sculpture, and at once does what is done once.
    """

    @property
    def ended(self) -> bool:
        """Whether nothing is left to do once the time of the move is over."""
        return True

    def advance(self, share: float, /) -> None:
        """Set the hands' goals for the coming frame; `share`: of the move's time that is over then."""


Motions = Mapping[type[Move], Callable[[Any, Any], Motion]]
"""Motion of every kind of move, made of the move and the sculpture."""
