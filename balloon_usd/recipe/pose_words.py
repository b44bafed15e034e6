"""Which words of a recipe belong to which pose of the finished figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import one_of
from balloon_usd.language.problem import Complaint
from balloon_usd.operations.moves import LET_GO

if TYPE_CHECKING:
    from collections.abc import Iterator

ONLY: dict[str, tuple[str, ...]] = {"height": LET_GO, "speed": ("throw",)}
"""Keys that go with these poses only."""


def pose_complaints(data: object) -> Iterator[Complaint]:
    """Yield what does not go with the pose of a recipe, given as plain data of whatever shape it is."""
    if not isinstance(data, dict):
        return
    pose = data.get("pose", "as made")
    for key, poses in ONLY.items():
        if key in data and pose not in poses:
            yield Complaint((key,), f"goes with a figure that falls, expected pose: {' or '.join(poses)}")
    physics = data.get("physics")
    if pose not in LET_GO or not isinstance(physics, dict):
        return
    if physics.get("model") == "kosaka":
        others = one_of(("as made", "stand", "hang", "hold"))
        what = "makes no sense with model kosaka, whose springs have no weight"
        yield Complaint(("pose",), f"{what}, expected {others}")
    elif physics.get("gravity") == 0:
        what = f"is 0, and so nothing falls in pose {pose}, expected more than 0, or no such line"
        yield Complaint(("physics", "gravity"), what)
