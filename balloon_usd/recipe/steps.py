"""Steps of a recipe: one operation each, and how it is done."""

import re
from dataclasses import dataclass
from typing import Annotated, Any, Literal, cast

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    PlainSerializer,
    Tag,
    WithJsonSchema,
)

from balloon_usd.language.names import NAME_PATTERN, Name, Text
from balloon_usd.language.problem import quoted
from balloon_usd.language.quantities import Angle, Between, Force, Length

End = Literal["start", "end"]
Kind = Literal["bubbles", "lock", "loop", "fold", "ear", "rest", "bend", "push", "wait"]
Point = Literal["up", "down", "left", "right", "forward", "back"]

KINDS: tuple[Kind, ...] = ("bubbles", "lock", "loop", "fold", "ear", "rest", "bend", "push", "wait")
MAKING: tuple[Kind, ...] = ("bubbles", "loop", "fold", "ear", "rest")
"""Operations that make bubbles."""
MERGING: tuple[Kind, ...] = ("loop", "fold", "ear")
"""Operations that make bubbles and merge the two ends of each."""

MANNERS: dict[Kind, tuple[str, ...]] = {
    "bubbles": ("balloon", "turns", "seconds", "note"),
    "lock": ("balloon", "point", "turns", "seconds", "note"),
    "loop": ("balloon", "point", "turns", "seconds", "note"),
    "fold": ("balloon", "point", "turns", "seconds", "note"),
    "ear": ("balloon", "point", "turns", "seconds", "note"),
    "rest": ("balloon", "seconds", "note"),
    "bend": ("balloon", "point", "seconds", "note"),
    "push": ("balloon", "point", "seconds", "note"),
    "wait": ("note",),
}
"""What may stand beside each operation."""

PRESSING = ("depth", "force")
"""Keys that say how a finger pushes: exactly one of them."""

TURNS = 3.0
"""Full turns of a twist: the common advice of makers."""

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


JointEntry = Annotated[
    Joint,
    BeforeValidator(joint),
    PlainSerializer(str),
    WithJsonSchema({"type": "string", "pattern": rf"^{NAME_PATTERN}\.(start|end)$"}),
]


class LockJoints(BaseModel):
    """The general form of a lock: any joints, also of different balloons."""

    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)

    joints: tuple[JointEntry, ...]
    """Joints that become one, each written bubble.start or bubble.end."""


class PushedBubble(BaseModel):
    """What a finger pushes: a bubble, the place on it, and how deep or how hard."""

    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)

    bubble: Name
    """The bubble that is pushed."""
    at: Length | None = None
    """Distance from the bubble's start along the inflated bubble; its middle when absent; m in Python."""
    depth: Length | None = None
    """How deep the finger goes; m in Python."""
    force: Force | None = None
    """How hard it pushes, instead of depth; N."""


def _lock_form(value: object) -> str | None:
    if isinstance(value, (dict, LockJoints)):
        return "joints"
    return "bubbles" if isinstance(value, (list, tuple)) else None


Lock = Annotated[
    Annotated[tuple[Name, ...], Tag("bubbles")] | Annotated[LockJoints, Tag("joints")],
    Discriminator(_lock_form),
]

Seconds = Annotated[float, Between(0.2, 60.0, "s")]
Lengths = Annotated[dict[Name, Length], Field(min_length=1)]


def _exactly_one_operation(schema: dict[str, Any]) -> None:
    schema["oneOf"] = [{"required": [kind]} for kind in KINDS]


class Step(BaseModel):
    """One step: exactly one operation, and the manner of doing it."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        use_attribute_docstrings=True,
        json_schema_extra=_exactly_one_operation,
    )

    bubbles: Lengths | None = None
    """Twist off bubbles of these lengths, one after another."""
    lock: Lock | None = None
    """Fold these neighbouring bubbles and twist the start of the first to the end of the last."""
    loop: Lengths | None = None
    """Make a long bubble and twist its two ends together."""
    fold: Lengths | None = None
    """As loop, but bent sharply in its middle so that both halves lie side by side."""
    ear: Lengths | None = None
    """Pinch a short soft bubble and twist its two ends together."""
    rest: Name | None = None
    """Name what is left of the balloon: nothing more is made of it."""
    bend: Annotated[dict[Name, Angle], Field(min_length=1)] | None = None
    """Bend bubbles by an angle (degrees; radians in Python), their ends towards point."""
    push: PushedBubble | None = None
    """Push a finger into a bubble, hold it there, and take it away."""
    wait: Seconds | None = None
    """Do nothing for some seconds."""

    balloon: Name | None = None
    """The balloon worked on; needed when there are several."""
    point: Point | None = None
    """Where the folded or bent bubbles or the pushing finger go, as seen by the maker."""
    turns: Annotated[float, Between(0.5, 10.0, "turns", step=0.5)] = TURNS
    """Full turns of each twist."""
    seconds: Seconds | None = None
    """Time the hands take; chosen by the plan when absent."""
    note: Text | None = None
    """A remark for the reader."""

    @property
    def kind(self) -> Kind:
        """The operation."""
        return next(kind for kind in KINDS if getattr(self, kind) is not None)

    @property
    def lengths(self) -> dict[str, float]:
        """Bubbles made by bubbles, loop, fold or ear: inflated length (m) by name; else empty."""
        return self.bubbles or self.loop or self.fold or self.ear or {}

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Joints that a lock brings together; else empty."""
        if self.lock is None:
            return ()
        if isinstance(self.lock, LockJoints):
            return self.lock.joints
        return Joint(self.lock[0], "start"), Joint(self.lock[-1], "end")
