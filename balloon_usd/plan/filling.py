"""How far a tube is blown up, in the words of its recipe: by its tail, its length or a share of it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.language.lengths import at_least, at_most

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.recipe.balloons import Balloon


def fuller(balloon: Balloon, size: BalloonSize, rubber: Rubber, tail: float) -> str:
    """Say that a flat tail may be so long (m) at most: `a tail of at most 6 cm`."""
    if balloon.filled is not None:
        return f"filled: at least {math.ceil(100.0 * _share(size, tail))} %"
    if balloon.inflated is not None:
        return f"inflated: at least {at_least(_inflated(size, rubber, tail))}"
    return f"a tail of at most {at_most(tail)}"


def emptier(balloon: Balloon, size: BalloonSize, rubber: Rubber, tail: float) -> str:
    """Say that a flat tail has to be so long (m) at least: `leave a tail of at least 9 cm`."""
    if balloon.filled is not None:
        return f"write filled: at most {math.floor(100.0 * _share(size, tail))} %"
    if balloon.inflated is not None:
        return f"write inflated: at most {at_most(_inflated(size, rubber, tail))}"
    return f"leave a tail of at least {at_least(tail)}"


def _share(size: BalloonSize, tail: float) -> float:
    return 1.0 - min(tail, size.length) / size.length


def _inflated(size: BalloonSize, rubber: Rubber, tail: float) -> float:
    return size.length * maxwell_state(rubber).bulged.b * _share(size, tail)
