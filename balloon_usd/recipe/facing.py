"""Which side of a figure faces where: one of six, or that on which some of its bubbles lie."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BeforeValidator, Discriminator, Field, PlainSerializer, Tag, WithJsonSchema

from balloon_usd.language.choices import unknown
from balloon_usd.language.names import Name, is_name, listed, shortest
from balloon_usd.language.problem import Complaint, quoted
from balloon_usd.operations.moves import FRONTS, Facing, Front

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.workpiece import Workpiece

SIDE, BUBBLES = "one of six sides", "bubbles on a side"
"""Tags of the forms of a side, which never occur as keys of a recipe."""
FACING = ("front", "top")
"""Keys of a recipe that say a side."""


def _form(value: object) -> str:
    listed = isinstance(value, (list, tuple)) or (isinstance(value, str) and value not in FRONTS)
    return BUBBLES if listed else SIDE


def _written(facing: Facing) -> object:
    """Return a side as it stands in a file."""
    return facing if isinstance(facing, str) else shortest(facing)


_BUBBLE: dict[str, Any] = {"type": "string"}
FacingEntry = Annotated[
    Annotated[Front, Tag(SIDE)]
    | Annotated[tuple[Name, ...], BeforeValidator(listed), Field(min_length=1), Tag(BUBBLES)],
    Discriminator(_form),
    PlainSerializer(_written),
    WithJsonSchema(
        {"anyOf": [{"enum": list(FRONTS)}, _BUBBLE, {"type": "array", "items": _BUBBLE, "minItems": 1}]}
    ),
]


def _names(value: object) -> list[str]:
    """Return the bubbles of a side as it stands in a file; none where it is one of six."""
    several = value if isinstance(value, (list, tuple)) else [value]
    return [
        name
        for name in several
        if isinstance(name, str) and is_name(name) and (name not in FRONTS or several is value)
    ]


def facing_complaints(data: object, piece: Workpiece) -> Iterator[Complaint]:
    """Yield what of the front and the top is neither a side nor a bubble of the finished figure.

    `data`: plain data of a recipe, of whatever shape it is; `piece`: what its steps make.
    """
    if not isinstance(data, dict):
        return
    for key in FACING:
        several = isinstance(data.get(key), (list, tuple))
        for at, name in enumerate(_names(data.get(key))):
            path = (key, at) if several else (key,)
            if name in piece.popped:
                what = f"bubble {quoted(name)} was popped, expected one that has its gas"
                yield Complaint(path, what)
            elif name not in piece.bubbles:
                firm = [bubble for bubble in piece.bubbles if bubble not in piece.popped]
                choices = firm if several else [*FRONTS, *firm]
                yield Complaint(path, unknown("bubble" if several else key, name, choices))
    front, top = (frozenset(_names(data.get(key))) for key in FACING)
    if front and front == top:
        yield Complaint(("top",), "names what is the front already, expected another side of the figure")
