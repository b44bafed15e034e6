"""Walls that pierce walls, counted in every frame of a stage."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from balloon_usd.check.opening import UnreadableError, open_whole
from balloon_usd.check.place import stage_file
from balloon_usd.check.stage_walls import StageWalls
from balloon_usd.openusd import Tf, usd_access
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.stage.opening import said_by, streaming
from balloon_usd.stage.properties import StageKind, kind_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.quality.pierced_walls import Crossings, Pair

    Times = list[float | None]
    Choose = Callable[[Times], Times]


@dataclass
class CrossingReport:
    """The crossings of one stage."""

    stage: str
    """The stage as it was named."""
    kind: StageKind = StageKind.ASSET
    unreadable: str = ""
    """Why they cannot be counted, in one line; empty if they can."""
    frames: dict[float | None, Crossings] = field(default_factory=dict)
    """By time code, in order; None of a stage that stands still."""
    depth: dict[float | None, float] = field(default_factory=dict)
    """How deep the deepest vertex lies inside a wall, m: in the worst frame and in the last one."""
    left_out: list[str] = field(default_factory=list)
    """Paths of meshes that are not closed, or whose topology changes: they were not counted."""

    @property
    def worst(self) -> float | None:
        """The first of the frames with most crossings."""
        return max(self.frames, key=lambda time: self.frames[time].count)

    @property
    def last(self) -> float | None:
        """The last frame."""
        return next(reversed(self.frames))

    @property
    def any(self) -> bool:
        """Whether there is a crossing in any frame, but for those in necks."""
        return not self.unreadable and self.frames[self.worst].count > 0

    def pairs(self) -> list[tuple[Pair, int]]:
        """Return the bubbles that cross, and how often in the worst frame of each pair, the most first."""
        most: Counter[Pair] = Counter()
        for found in self.frames.values():
            most |= Counter(found.pairs)
        return most.most_common()


@usd_access()
def count_crossings(name: str, choose: Choose | None = None) -> CrossingReport:
    """Count the crossings of a stage, in its own selection of variants: a USD file, or a folder NAME.

    Args:
        name: of the stage.
        choose: returns those time codes that are wanted, of all; None wants all of them.
    """
    report = CrossingReport(name)
    with streaming():
        try:
            stage = open_whole(stage_file(name))
            report.kind = kind_of(stage)
            _count(stage, choose, report)
        except UnreadableError as error:
            said = str(error)
            report.unreadable = said if name in said else f"{name}: {said}"
        except (Tf.ErrorException, UnicodeDecodeError) as error:
            said = said_by(error) if isinstance(error, Tf.ErrorException) else "text that is no UTF-8"
            report.unreadable = f"{name}: damaged: a value cannot be read: {said}".removesuffix(": ")
    return report


def _count(stage: Any, choose: Choose | None, report: CrossingReport) -> None:
    walls = StageWalls(stage)
    report.left_out = walls.left_out
    times = choose(walls.times) if choose else walls.times
    if not times:
        raise UnreadableError(f"has frames {walls.times[0]:g} to {walls.times[-1]:g} only")
    counter = CrossingCounter(walls.walls, len(times), "auto")
    for time in times:
        points = walls.points(time)
        report.frames[time] = counter.count(points, walls.necks_in(points))
    for time in {report.worst, report.last}:
        points, some = walls.points(time), report.frames[time].count > 0
        report.depth[time] = counter.depth(points, walls.necks_in(points)) if some else 0.0
