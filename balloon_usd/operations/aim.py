"""`aim`: limbs are turned about the joints at which they hang, until they point somewhere."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, get_args

import numpy as np
from pydantic import BeforeValidator, Field, WithJsonSchema

from balloon_usd.language.choices import all_of, one_of, unknown
from balloon_usd.language.names import Name
from balloon_usd.language.problem import quoted
from balloon_usd.language.quantities import Between
from balloon_usd.operations import moves
from balloon_usd.operations.modifiers import OnBalloon, Timed
from balloon_usd.operations.moves import FRONTS, Front
from balloon_usd.operations.operation import WorksByBubble
from balloon_usd.operations.reach import SECONDS_PER_METRE, limb_reach
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench

AIM_SECONDS = 1.2
"""Shortest time in which a limb is turned, s."""

SIDES: tuple[Front, ...] = get_args(Front)


def _sides(value: object) -> tuple[Front, ...]:
    """Read a side, or a list of sides between which a limb points."""
    given = [value] if isinstance(value, str) else value
    if not isinstance(given, (list, tuple)) or not given:
        raise ValueError(f"{quoted(value)} is no direction, expected up, or a list such as [back, up]")
    for side in given:
        if side not in SIDES:
            raise ValueError(unknown("direction", side, SIDES))
    found = tuple(dict.fromkeys(given))
    if not np.any(np.sum([FRONTS[side] for side in found], axis=0)):
        raise ValueError(f"{all_of(found)} cancel each other, expected {one_of(SIDES)}")
    return found


_SIDE: dict[str, Any] = {"enum": list(SIDES)}
Sides = Annotated[
    tuple[Front, ...],
    BeforeValidator(_sides),
    WithJsonSchema({"anyOf": [_SIDE, {"type": "array", "items": _SIDE, "minItems": 1, "maxItems": 3}]}),
]


class Aim(OnBalloon, Timed, WorksByBubble):
    """Turn bubbles, with all that hangs on them, about the joints at which they hang on the figure."""

    word: ClassVar[str] = "aim"
    called: ClassVar[tuple[str, ...]] = ("turn", "point_to")
    on_rounds: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: clover
units: cm
balloons:
  main: {size: 260, color: green, length: 32, tail: 6}
steps:
  - bubbles: {stalk: 20}
  - loop: {left_leaf: 28}
    point: left
  - loop: {middle_leaf: 28}
    point: up
  - loop: {right_leaf: 28}
    point: right
  - rest: spare
  - pop: spare
  - aim: {stalk: down, middle_leaf: up}
  - aim: {left_leaf: [left, up], right_leaf: [right, up]}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "essortment.com elephant-51924: the trunk is pointed forward",
        "mbfloyd.com: the ear twist aims a limb",
    )

    aim: Annotated[dict[Name, Sides], Field(min_length=1)]
    """Turn bubbles, with all that hangs on them, about the joints at which they hang on the figure."""

    spin: Annotated[float, Between(-360.0, 360.0, "degrees")] = 0.0
    """How far each is turned about itself, right-handed about the way it points then, degrees."""

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        return {name: way[0] if len(way) == 1 else list(way) for name, way in self.aim.items()}

    @classmethod
    def value_of(cls, units: Units, ways: Mapping[str, object] | None = None, /, **more: object) -> object:
        """Return its value as it stands in a file: a side to which each bubble points, or a list of sides."""
        return {**(ways or {}), **more}

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Turn bubbles that are there and hang on a single joint."""
        for name in cls.uses(value):
            path = (*place.path, cls.word, name)
            if not (bench.has_name(name, path) and bench.find_firm(name, path) and bench.knows((name,))):
                continue
            if (limb := bench.piece.limb(name)) is None:
                what = f"no joint is there about which {name} could be turned against its figure"
                bench.complain(path, f"{what}, expected a bubble that hangs on one joint")
            elif parted := bench.piece.left_by(limb.bubbles):
                bench.complain(path, f"{name} {parted.would_leave}: expected this step before that one")

    def perform(self, score: Score, index: int) -> None:
        """Turn one limb after another."""
        calm = {
            name: max(AIM_SECONDS, SECONDS_PER_METRE * limb_reach(score, name, index)) for name in self.aim
        }
        waits = SETTLE_SECONDS * len(calm)
        score.refuse_haste(index, self.seconds, sum(calm.values()) + waits, f"turn {all_of(self.names)}")
        for bubble, way in self.aim.items():
            seconds = calm[bubble] / score.pace.leading
            text = f"{self.word}: {bubble}"
            x, y, z = np.sum([FRONTS[side] for side in way], axis=0).tolist()
            size = math.sqrt(x * x + y * y + z * z)
            toward = score.sided((x / size, y / size, z / size))
            spin = math.radians(-self.spin if score.mirrored else self.spin)
            move = moves.Aim(score.now, seconds, index, text, bubble=bubble, toward=toward, spin=spin)
            score.settle(move)
