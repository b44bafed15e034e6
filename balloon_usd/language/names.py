"""Names and free text: what may become a file name, a prim name, or a line on a terminal."""

import re
import unicodedata
from collections.abc import Container, Sequence
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from balloon_usd.language.problem import quoted

NAME_PATTERN = "[A-Za-z_][A-Za-z0-9_]*"
NAME_LIMIT = 64
TEXT_LIMIT = 2000

_NAME = re.compile(NAME_PATTERN, re.ASCII)
_CONTROLS = frozenset({"Cc", "Cs", "Zl", "Zp"})
"""Unicode categories that no title needs and that could steer a terminal."""


def is_name(value: str) -> bool:
    """Tell whether a text can be a name."""
    return len(value) <= NAME_LIMIT and _NAME.fullmatch(value) is not None


def name(value: object) -> str:
    """Check a name: an identifier, since it becomes a prim name in the stage.

    Raises:
        ValueError: if it is none.
    """
    rule = "letters, digits and _ not beginning with a digit"
    if not isinstance(value, str):
        raise ValueError(f"{quoted(value)} is no name, expected {rule}")
    if len(value) > NAME_LIMIT:
        raise ValueError(f"{quoted(value)} is too long, expected a name of at most {NAME_LIMIT} characters")
    if not _NAME.fullmatch(value):
        likeness = re.sub(r"[^A-Za-z0-9]+", "_", value).strip("_")
        likeness = f"_{likeness}" if likeness[:1].isdigit() else likeness
        near = f", such as {quoted(likeness)}" if likeness else ""
        raise ValueError(f"{quoted(value)} is no name, expected {rule}{near}")
    return value


def text(value: object) -> str:
    """Check free text: no control characters but line breaks.

    Raises:
        ValueError: if it is no text, too long, or holds control characters.
    """
    if not isinstance(value, str):
        raise ValueError(f'{quoted(value)} is no text, expected it in quotes: "{quoted(value)}"')
    if len(value) > TEXT_LIMIT:
        raise ValueError(f"{len(value)} characters, expected at most {TEXT_LIMIT}")
    for letter in value:
        if letter not in "\n\t" and unicodedata.category(letter) in _CONTROLS:
            raise ValueError(f"character U+{ord(letter):04X} is not allowed, expected printable text")
    return value


def name_of_end(balloon: str, what: Literal["rest", "tip"], taken: Container[str]) -> str:
    """Return the name of a balloon's last bubble where no step gives one: `main_rest`, made unique."""
    found = f"{balloon}_{what}"
    while found in taken:
        found += "_"
    return found


def listed(value: object) -> object:
    """Return one name that stands alone as a list of one, and anything else as it is."""
    return (value,) if isinstance(value, str) else value


def shortest(names: Sequence[str]) -> str | list[str]:
    """Return names as they stand in a file: one by itself, several as a list."""
    return names[0] if len(names) == 1 else list(names)


Name = Annotated[
    str,
    BeforeValidator(name),
    WithJsonSchema({"type": "string", "pattern": f"^{NAME_PATTERN}$", "maxLength": NAME_LIMIT}),
]
Text = Annotated[str, BeforeValidator(text), Field(max_length=TEXT_LIMIT)]
