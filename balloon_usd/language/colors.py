"""Latex colours by name, and colours as artists write them, as linear RGB for the stage."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import BeforeValidator, PlainSerializer, WithJsonSchema

from balloon_usd.language.choices import one_of, unknown
from balloon_usd.language.problem import quoted

LATEX_COLORS: dict[str, str] = {
    "red": "#d7141e",
    "ruby": "#8e1023",
    "coral": "#ff6f61",
    "orange": "#ff7a14",
    "mustard": "#d9a42b",
    "yellow": "#ffd60a",
    "lime": "#a4d82f",
    "green": "#14943c",
    "forest": "#0c5430",
    "mint": "#9fe0c3",
    "turquoise": "#1fb5b5",
    "light_blue": "#8cc8f0",
    "blue": "#1f5fd0",
    "navy": "#152a63",
    "lilac": "#c3a4e0",
    "violet": "#7a3fa8",
    "purple": "#5c2482",
    "magenta": "#d61f86",
    "pink": "#ff8fb8",
    "peach": "#ffc8a0",
    "brown": "#6f4326",
    "mocha": "#a8805c",
    "ivory": "#f4ead2",
    "white": "#f7f7f5",
    "grey": "#8a8d91",
    "black": "#141416",
    "gold": "#c99a2e",
    "silver": "#b9bcc2",
}
"""Shades of latex balloons, sRGB, chosen by eye."""

_SPELLINGS = {"gray": "grey"}
_HEX = re.compile(r"#[0-9a-fA-F]{6}", re.ASCII)
_CHANNELS = 3


@dataclass(frozen=True)
class Color:
    """A colour: `name` as written ("" for a list of numbers), `rgb` linear, each 0 to 1."""

    name: str
    rgb: tuple[float, float, float]


def color(value: object) -> Color:
    """Read a colour: a name, "#rrggbb" (sRGB), or [r, g, b] (linear, each 0 to 1).

    Raises:
        ValueError: if it is none of these.
    """
    if isinstance(value, Color):
        return value
    if isinstance(value, str):
        return Color(value, _rgb_named(value))
    if isinstance(value, (list, tuple)) and len(value) == _CHANNELS:
        return Color("", _rgb_listed(value))
    raise ValueError(f'{quoted(value)} is no color, expected a name, "#rrggbb" or [r, g, b] with 0 to 1')


def _rgb_named(word: str) -> tuple[float, float, float]:
    code = LATEX_COLORS.get(_SPELLINGS.get(word, word), word)
    if not _HEX.fullmatch(code):
        if word.startswith("#"):
            raise ValueError(f'{quoted(word)} is no color, expected six hex digits such as "#d7141e"')
        more = "; finish: clear, beside a color, lets one see through" if word == "clear" else ""
        raise ValueError(unknown("color", word, LATEX_COLORS) + f' ("#rrggbb" and [r, g, b] work too{more})')
    red, green, blue = (_linear(int(code[at : at + 2], 16) / 255.0) for at in (1, 3, 5))
    return red, green, blue


def _rgb_listed(channels: Sequence[object]) -> tuple[float, float, float]:
    checked: list[float] = []
    for channel in channels:
        if isinstance(channel, bool) or not isinstance(channel, (int, float)) or not 0 <= channel <= 1:
            raise ValueError(f"{quoted(channel)} is no share of a color, expected 0 to 1")
        checked.append(float(channel))
    return checked[0], checked[1], checked[2]


def _linear(encoded: float) -> float:
    """Decode one sRGB channel (IEC 61966-2-1)."""
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4


def color_entry(value: Color) -> str | list[float]:
    """Write a colour as it stands in a recipe."""
    return value.name or list(value.rgb)


ColorEntry = Annotated[
    Color,
    BeforeValidator(color),
    PlainSerializer(color_entry),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "string", "enum": [*LATEX_COLORS, *_SPELLINGS]},
                {"type": "string", "pattern": "^#[0-9a-fA-F]{6}$"},
                {
                    "type": "array",
                    "items": {"type": "number", "minimum": 0, "maximum": 1},
                    "minItems": _CHANNELS,
                    "maxItems": _CHANNELS,
                },
            ],
            "description": f"A latex color ({one_of(LATEX_COLORS)}), #rrggbb, or linear [r, g, b].",
        }
    ),
]
