"""Joints as recipes write them: a bubble and one of its ends."""

import re
from dataclasses import dataclass
from typing import Annotated, Literal, cast

from pydantic import BeforeValidator, PlainSerializer, WithJsonSchema

from balloon_usd.language.names import NAME_PATTERN
from balloon_usd.language.problem import quoted

End = Literal["start", "end"]

_JOINT = re.compile(rf"({NAME_PATTERN})\.(start|end)", re.ASCII)


@dataclass(frozen=True)
class Joint:
    """One end of a bubble: `start` is nearer to the knot."""

    bubble: str
    end: End

    def __str__(self) -> str:
        """Write as in a recipe: `nose.end`."""
        return f"{self.bubble}.{self.end}"


def joint(value: object) -> Joint:
    """Read a joint written `nose.end`.

    Raises:
        ValueError: if it is not written so.
    """
    if isinstance(value, Joint):
        return value
    found = _JOINT.fullmatch(value) if isinstance(value, str) else None
    if not found:
        raise ValueError(f"{quoted(value)} is no joint, expected a bubble and its end such as nose.end")
    return Joint(found[1], cast("End", found[2]))


def ends_of(bubble: str) -> tuple[Joint, Joint]:
    """Return both ends of a bubble."""
    return Joint(bubble, "start"), Joint(bubble, "end")


def readable_joints(written: object) -> tuple[Joint, ...]:
    """Return those entries of a list that are joints; none of what is no list."""
    found = []
    for entry in written if isinstance(written, (list, tuple)) else ():
        try:
            found.append(joint(entry))
        except ValueError:
            continue
    return tuple(found)


JointEntry = Annotated[
    Joint,
    BeforeValidator(joint),
    PlainSerializer(str),
    WithJsonSchema({"type": "string", "pattern": rf"^{NAME_PATTERN}\.(start|end)$"}),
]
