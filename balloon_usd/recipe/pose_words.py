"""Which words of a recipe belong to which pose of the finished figure."""

from __future__ import annotations

from typing import TYPE_CHECKING, get_args

from balloon_usd.language.choices import one_of
from balloon_usd.language.problem import Complaint
from balloon_usd.operations.moves import FRONTS, LET_GO, Pose

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.moves import Vector

USUAL: Pose = "as made"
"""The pose of a recipe that names none."""
WEAKEST = 0.1
"""Least gravity by which figures fall, m/s2: they take ten times as long as on the earth."""
ONLY: dict[str, tuple[str, ...]] = {"height": LET_GO, "speed": ("throw",)}
"""Keys that go with these poses only."""


def pose_complaints(data: object) -> Iterator[Complaint]:
    """Yield what does not go with the pose of a recipe, given as plain data of whatever shape it is."""
    if not isinstance(data, dict) or data.get("pose", USUAL) not in get_args(Pose):
        return
    pose, physics = data.get("pose", USUAL), data.get("physics")
    physics = physics if isinstance(physics, dict) else {}
    kosaka = physics.get("model") == "kosaka"
    yield from _same_axis(data)
    for key, poses in ONLY.items():
        if key in data and pose not in poses:
            expected = "no such line" if kosaka else f"pose: {' or '.join(poses)}"
            yield Complaint((key,), f"goes with a figure that falls, expected {expected}")
    yield from _kosaka(pose, physics) if kosaka else _weightless(pose, physics)


def _same_axis(data: dict[object, object]) -> Iterator[Complaint]:
    ways: dict[str, Vector] = {str(side): way for side, way in FRONTS.items()}
    front, top = (_way(ways, data.get(key)) for key in ("front", "top"))
    if front is not None and top is not None and _is_along(front, top):
        across = [side for side, way in FRONTS.items() if not _is_along(front, way)]
        what = f"{data['top']} cannot be up where {data['front']} is the front"
        yield Complaint(("top",), f"{what}, expected {one_of(across)}")


def _way(ways: dict[str, Vector], side: object) -> Vector | None:
    return ways.get(side) if isinstance(side, str) else None


def _is_along(one: Vector, other: Vector) -> bool:
    """Tell whether two sides lie on one line."""
    return any(a and b for a, b in zip(one, other, strict=True))


def _kosaka(pose: Pose, physics: dict[str, object]) -> Iterator[Complaint]:
    if pose in LET_GO:
        others = one_of(each for each in get_args(Pose) if each not in LET_GO)
        what = "makes no sense with model kosaka, whose figures have no true weight"
        yield Complaint(("pose",), f"{what}, expected {others}")
    if pose == "stand" and _number(physics.get("gravity", 0)) > 0:
        what = "draws a figure of model kosaka through the ground, which only latex knows"
        yield Complaint(("physics", "gravity"), f"{what}, expected 0, or no such line")


def _weightless(pose: Pose, physics: dict[str, object]) -> Iterator[Complaint]:
    gravity = physics.get("gravity", WEAKEST)
    if pose in LET_GO and 0.0 <= _number(gravity) < WEAKEST:
        what = f"is too little for a figure to fall in pose {pose}, expected at least {WEAKEST:g}"
        yield Complaint(("physics", "gravity"), f"{what}, or no such line")


def _number(value: object) -> float:
    """Return a number, and -1 for what is none: that is told elsewhere."""
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else -1.0
