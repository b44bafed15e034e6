"""A balloon as it is taken from the bag and inflated, before the first twist."""

from typing import Annotated, Literal, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema

from .colors import ColorEntry, color
from .quantities import FlatTail, Length, LengthWithin

BalloonSizeName = Literal["160", "260", "321", "350", "360", "646"]

FILLINGS = ("tail", "inflated", "capsule")
"""Keys that say how far a balloon is blown up: exactly one of them."""
FLAT_ONLY = ("length", "thickness")
"""Keys of a flat tube that a capsule does not have."""

_SIZE_CODES = get_args(BalloonSizeName)
_SIZE_SCHEMA = {"enum": [*map(int, _SIZE_CODES), *_SIZE_CODES]}


def _size_text(value: object) -> object:
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


class Balloon(BaseModel):
    """One balloon of the recipe; `tail`, `inflated` or `capsule` says how far it is blown up."""

    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)

    size: Annotated[BalloonSizeName, BeforeValidator(_size_text), WithJsonSchema(_SIZE_SCHEMA)]
    """Size code of the trade: 260 is 2 inches by 60."""
    color: Annotated[ColorEntry, Field(json_schema_extra={"default": "red"})] = color("red")
    tail: FlatTail | None = None
    """Flat rubber left empty at the end; m in Python."""
    inflated: Length | None = None
    """Length of the inflated part, instead of tail; m in Python."""
    capsule: Length | None = None
    """Length of a closed capsule before it is twisted, instead of one with knot and tail; m in Python."""
    radius: Annotated[float, LengthWithin(0.001, 0.1, low_included=True)] | None = None
    """Unstressed radius, where a brand differs; m in Python."""
    length: Length | None = None
    """Unstressed length, where a brand differs; m in Python."""
    thickness: Annotated[float, LengthWithin(0.00002, 0.003)] | None = None
    """Unstressed wall thickness, where a brand differs; m in Python."""
