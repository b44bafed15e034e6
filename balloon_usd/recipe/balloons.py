"""A balloon as it is taken from the bag and inflated, before the first twist."""

from typing import Annotated, Literal, get_args

from pydantic import BeforeValidator, ConfigDict, Field, WithJsonSchema

from balloon_usd.language.colors import ColorEntry, color
from balloon_usd.language.names import Text
from balloon_usd.language.quantities import (
    LONGEST,
    Between,
    FlatTail,
    Length,
    LengthWithin,
    PercentWithin,
    Units,
)
from balloon_usd.operations.modifiers import Entries

FinishName = Literal["latex", "clear", "chrome"]
BalloonSizeName = Literal["160", "260", "321", "350", "360", "646", "R5", "R11", "H6", "H11"]

FILLINGS = ("tail", "inflated", "filled", "capsule")
"""Keys that say how far a balloon is blown up: exactly one of them."""
FLAT_ONLY = ("length", "thickness")
"""Keys of a flat tube that a capsule does not have."""
MESH_ONLY = ("unit", "swell", "at")
"""Keys of a balloon from a mesh file that tubes do not have."""
MESH_KEYS = ("mesh", *MESH_ONLY, "color", "finish", "thickness")
"""Keys that a balloon from a mesh file has."""
USUAL_SWELL = 1.2
"""Size to which a balloon from a mesh is blown up: taut, and still of its own shape."""

ROUNDS: tuple[BalloonSizeName, ...] = ("R5", "R11", "H6", "H11")
"""Sizes of round balloons."""
HEARTS: tuple[BalloonSizeName, ...] = ("H6", "H11")
"""Those of them that have two lobes."""
ROUND_KEYS = ("size", "inflated", "filled", "overblown", "color", "finish", "radius", "thickness")
"""Keys that a round balloon has."""

SIZE_CODES: tuple[str, ...] = get_args(BalloonSizeName)
"""Codes of all sizes."""
_SIZE_SCHEMA = {"enum": [*(int(code) for code in SIZE_CODES if code.isdecimal()), *SIZE_CODES]}


Place = Annotated[float, LengthWithin(-LONGEST, LONGEST, low_included=True)]


def _size_text(value: object) -> object:
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


class Balloon(Entries):
    """One balloon of the recipe: a tube of some size, or any closed shape from a mesh file.

    Of a tube, `tail`, `inflated`, `filled` or `capsule` says how far it is blown up.
    """

    model_config = ConfigDict(
        json_schema_extra={"oneOf": [{"required": ["size"]}, {"required": ["mesh"]}]},
    )

    size: Annotated[BalloonSizeName, BeforeValidator(_size_text), WithJsonSchema(_SIZE_SCHEMA)] | None = None
    """Size code of the trade: 260 is 2 inches by 60."""
    mesh: Annotated[Text, Field(min_length=1)] | None = None
    """File with the closed surface of the flat balloon, instead of size; found from the recipe's folder."""
    unit: Units | None = None
    """Unit of the mesh file, where it is not that of the recipe."""
    swell: Annotated[float, Between(0.5, 5.0)] | None = None
    """How far a mesh is blown up: to so many times the size of a ball with as much unstretched wall."""
    at: tuple[Place, Place, Place] | None = None
    """Where the origin of the mesh file is; m in Python."""
    color: Annotated[ColorEntry, Field(json_schema_extra={"default": "red"})] = color("red")
    finish: FinishName = "latex"
    """What its wall looks like: shiny latex, latex that one sees through, or metal."""
    tail: FlatTail | None = None
    """Flat rubber left empty at the end; m in Python."""
    inflated: Length | None = None
    """Length of the inflated part, instead of tail; of a round balloon its width; m in Python."""
    filled: Annotated[float, PercentWithin(1.0, 100.0)] | None = None
    """Share of its full length, or of a round balloon of its full width, instead of tail; percent."""
    overblown: Length | None = None
    """Width to which a round balloon is blown up first, before air is let out; m in Python."""
    capsule: Length | None = None
    """Length of a closed capsule before it is twisted, instead of one with knot and tail; m in Python."""
    radius: Annotated[float, LengthWithin(0.001, 0.1, low_included=True)] | None = None
    """Unstressed radius, where a brand differs; m in Python."""
    length: Length | None = None
    """Unstressed length, where a brand differs; m in Python."""
    thickness: Annotated[float, LengthWithin(0.00002, 0.003)] | None = None
    """Unstressed wall thickness, where a brand differs; m in Python."""


def balloons_in(data: object) -> dict[str, object]:
    """Return the entries of `balloons` in the plain data of a recipe, as far as they are a mapping."""
    balloons = data.get("balloons") if isinstance(data, dict) else None
    return balloons if isinstance(balloons, dict) else {}


def rounds_in(data: object) -> dict[str, bool]:
    """Names of the round balloons in the plain data of a recipe, and whether they are hearts."""
    sizes = {name: entry.get("size") for name, entry in balloons_in(data).items() if isinstance(entry, dict)}
    return {name: size in HEARTS for name, size in sizes.items() if size in ROUNDS}
