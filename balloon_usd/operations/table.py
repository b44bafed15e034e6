"""The table of operations: the only list of them."""

from __future__ import annotations

import functools
import operator
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import Discriminator, Tag

from balloon_usd.operations.aim import Aim
from balloon_usd.operations.bend import Bend
from balloon_usd.operations.braid import Braid
from balloon_usd.operations.bubbles import Bubbles
from balloon_usd.operations.curl import Curl
from balloon_usd.operations.cut import Cut
from balloon_usd.operations.ear import Ear
from balloon_usd.operations.fold import Fold
from balloon_usd.operations.gather import Gather
from balloon_usd.operations.inflate import Inflate
from balloon_usd.operations.insert import Insert
from balloon_usd.operations.lock import Lock
from balloon_usd.operations.loop import Loop
from balloon_usd.operations.marriage import Marriage
from balloon_usd.operations.modifiers import Burped, OnBalloon, Pointed, Timed, Turned
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.pop import Pop
from balloon_usd.operations.press import Press
from balloon_usd.operations.push import Push
from balloon_usd.operations.rest import Rest
from balloon_usd.operations.roll import Roll
from balloon_usd.operations.spiral import Spiral
from balloon_usd.operations.split import Split
from balloon_usd.operations.squeeze import Squeeze
from balloon_usd.operations.tail_ball import TailBall
from balloon_usd.operations.thread import Thread
from balloon_usd.operations.tie import Tie
from balloon_usd.operations.tuck import Tuck
from balloon_usd.operations.tulip import Tulip
from balloon_usd.operations.tulip_link import TulipLink
from balloon_usd.operations.wait import Wait
from balloon_usd.operations.weave import Weave
from balloon_usd.operations.wrap import Wrap

if TYPE_CHECKING:
    from pydantic import GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue

OPERATIONS: tuple[type[Operation], ...] = (
    Bubbles,
    Lock,
    Tie,
    Loop,
    Fold,
    Ear,
    Split,
    Gather,
    Tulip,
    TulipLink,
    Weave,
    Marriage,
    Rest,
    Bend,
    Curl,
    Aim,
    Spiral,
    Braid,
    Press,
    Squeeze,
    Push,
    Roll,
    Tuck,
    Thread,
    Wrap,
    Pop,
    Cut,
    TailBall,
    Insert,
    Inflate,
    Wait,
)

BY_WORD: dict[str, type[Operation]] = {operation.word: operation for operation in OPERATIONS}
WORDS: tuple[str, ...] = tuple(BY_WORD)
CALLED: dict[str, str] = {name: each.word for each in OPERATIONS for name in each.called}
"""Words of operations by what makers call them, too."""
NOT_THERE: dict[str, str] = {
    "raisin": "a bump twisted off the side of a bubble, expected an ear, or a balloon tied to a joint",
    "split_apple": "a tulip with a waist, expected tulip, or split, which divides an ear",
    "overblow": "blowing up too far, and letting air out again, expected overblown: of a round balloon",
    "stretch": "stretching a balloon before use, expected no such step: hands do it with each tube",
    "string": "a string between two joints, expected tie, which brings them together",
}
"""What makers do that no operation does, by its word, and what there is instead."""
BY_KIND = {each.bubble_kind: each for each in reversed(OPERATIONS) if each.bubble_kind is not None}
"""Operations that make bubbles, by the kind of these: the first of the table, where several do."""


class NoOperation(OnBalloon, Pointed, Turned, Burped, Timed, Operation):
    """A step without a word of the table: never right, but what stands in it is looked at all the same."""

    word = ""
    example = ""


def words_in(step: object) -> tuple[str, ...]:
    """Return the words of operations in the plain data of a step, in the order of the table."""
    return tuple(word for word in WORDS if word in step) if isinstance(step, dict) else ()


def _tag(step: object) -> str:
    if isinstance(step, Operation):
        return f"the step {step.word}"
    return f"the step {next(iter(words_in(step)), '')}"


class _WithoutNoOperation:
    """Leaves what is never right out of the schema."""

    def __get_pydantic_json_schema__(self, core: Any, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        schema = handler(core)
        schema["oneOf"] = [each for each in schema["oneOf"] if NoOperation.__name__ not in each["$ref"]]
        return schema


if TYPE_CHECKING:
    Step = Operation
else:
    # Tags never occur as keys of a recipe: so they can be told from these in the place of an error.
    _TAGGED = [Annotated[each, Tag(f"the step {each.word}")] for each in (*OPERATIONS, NoOperation)]
    Step = Annotated[functools.reduce(operator.or_, _TAGGED), Discriminator(_tag), _WithoutNoOperation()]
