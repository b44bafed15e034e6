"""What a step of a recipe says, read as far as possible even where parts of it are wrong.

The checks of meaning work on this, so that one slip does not hide all the others.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .steps import KINDS, MANNERS, MERGING, PRESSING, Joint, Kind, joint

if TYPE_CHECKING:
    from balloon_usd.language.problem import Path


@dataclass(frozen=True)
class StepOutline:
    """The readable parts of one step; `made` holds what each operation makes, in order."""

    path: Path
    kinds: tuple[Kind, ...]
    keys: tuple[str, ...]
    made: tuple[tuple[str, Path, bool], ...]
    """Name, place, and whether both ends are merged, of each bubble."""
    lock: tuple[str, ...] | None
    joints: tuple[Joint, ...] | None
    bent: tuple[str, ...]
    pushed: str | None
    pressing: tuple[str, ...] | None
    """What of depth and force a push is given; None without a readable push."""
    rest: str | None
    balloon: str | None
    well_formed: bool
    """Every entry of the lock could be read."""


def balloons_in(data: object) -> dict[str, object]:
    """Entries of `balloons`, as far as they are a mapping."""
    balloons = data.get("balloons") if isinstance(data, dict) else None
    return balloons if isinstance(balloons, dict) else {}


def outlines_in(data: object) -> list[StepOutline]:
    """Outlines of all steps that are mappings."""
    steps = data.get("steps") if isinstance(data, dict) else None
    entries = steps if isinstance(steps, (list, tuple)) else ()
    return [_outline(("steps", at), step) for at, step in enumerate(entries) if isinstance(step, dict)]


def _outline(path: Path, step: dict[str, object]) -> StepOutline:
    kinds = tuple(kind for kind in KINDS if kind in step)
    lock, joints, well_formed = _lock(step.get("lock"))
    bend, rest, balloon = step.get("bend"), step.get("rest"), step.get("balloon")
    push = step.get("push")
    pushed = push.get("bubble") if isinstance(push, dict) else None
    return StepOutline(
        path=path,
        kinds=kinds,
        keys=tuple(key for key in step if key in MANNERS["lock"] or key in kinds),
        made=tuple(made for kind in kinds for made in _made(path, kind, step[kind])),
        lock=lock,
        joints=joints,
        bent=tuple(bend) if isinstance(bend, dict) else (),
        pushed=pushed if isinstance(pushed, str) else None,
        pressing=tuple(key for key in PRESSING if key in push) if isinstance(push, dict) else None,
        rest=rest if isinstance(rest, str) else None,
        balloon=balloon if isinstance(balloon, str) else None,
        well_formed=well_formed,
    )


def _made(path: Path, kind: Kind, value: object) -> list[tuple[str, Path, bool]]:
    if kind == "rest" and isinstance(value, str):
        return [(value, (*path, kind), False)]
    if kind in {"bubbles", *MERGING} and isinstance(value, dict):
        return [(name, (*path, kind, name), kind in MERGING) for name in value]
    return []


def _lock(value: object) -> tuple[tuple[str, ...] | None, tuple[Joint, ...] | None, bool]:
    if isinstance(value, (list, tuple)):
        names = tuple(name for name in value if isinstance(name, str))
        return names, None, len(names) == len(value)
    written = value.get("joints") if isinstance(value, dict) else None
    if not isinstance(written, (list, tuple)):
        return None, None, False
    joints = []
    for entry in written:
        try:
            joints.append(joint(entry))
        except ValueError:
            continue
    return None, tuple(joints), len(joints) == len(written)
