"""What may stand beside an operation: how, where and how long it is done."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict

from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Between, PercentWithin

Point = Literal["up", "down", "left", "right", "forward", "back"]
Seconds = Annotated[float, Between(0.2, 60.0, "s")]

TURNS = 3.0
"""Full turns of a twist: the common advice of makers."""
HOLDING_TURNS = 2.0
"""Turns below which a twist unwinds: makers advise 2 to 4, three as a rule."""
MODIFIERS = ("balloon", "point", "turns", "burp", "spin", "disc", "strokes", "seconds", "note")
"""All modifiers, in the order in which they are written."""


class Entries(BaseModel):
    """Keys of a recipe, of which none is unknown."""

    # Models are built when they are first used: all of them at every start take 0.1 s.
    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)


class OnBalloon(Entries):
    """Of an operation on one balloon."""

    balloon: Name | None = None
    """The balloon worked on; needed where there are several and no bubble says which."""


class Pointed(Entries):
    """Of an operation with a direction."""

    point: Point | None = None
    """Where the folded or bent bubbles, or the pressing finger or hand go, as seen by the maker."""


class Turned(Entries):
    """Of an operation that twists."""

    turns: Annotated[float, Between(0.5, 10.0, "turns", step=0.5)] = TURNS
    """Full turns of each twist."""

    @property
    def holds(self) -> bool:
        """Whether the friction of the wound necks holds when the hands let go."""
        return self.turns >= HOLDING_TURNS


class Burped(Entries):
    """Of an operation that twists bubbles off."""

    burp: Annotated[float, PercentWithin(1.0, 50.0)] | None = None
    """Share of its gas that hands press out of each bubble before its twist, on into the balloon; percent."""


class Timed(Entries):
    """Of an operation that takes time."""

    seconds: Seconds | None = None
    """Time the hands take; chosen by the plan when absent."""
