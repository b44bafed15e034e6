"""`tie`: an end of a balloon is tied to a joint by its own nozzle or flat tip."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.joint import JointEntry, readable_joints
from balloon_usd.operations.modifiers import TURNS, Entries, OnBalloon, Pointed, Timed
from balloon_usd.operations.operation import Operation

if TYPE_CHECKING:
    from balloon_usd.language.joint import Joint
    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece

LEAST_STRING = 5.0
"""Least flat rubber at the tip that two fingers can wind and tie, in R0: 22 mm of a 260. Judged."""
PLACES = 7
"""At how many places hands hold what is left of a balloon as they tie its tip, as a loop."""


class TiedEnd(Entries):
    """What is tied to what."""

    end: JointEntry
    """The start of the first bubble of a balloon, tied by its nozzle, or the end of its rest, tied by what is
    left of its flat tail.
    """
    to: JointEntry
    """The joint that it is tied to, also of another balloon."""


class Tie(OnBalloon, Pointed, Timed, Operation):
    """Tie an end of a balloon to a joint, by its nozzle or by its flat tip."""

    word: ClassVar[str] = "tie"
    called: ClassVar[tuple[str, ...]] = ("knot", "hook", "attach")
    on_rounds: ClassVar[bool] = True
    value_model: ClassVar[type[Entries] | None] = TiedEnd
    across: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: hoop
units: cm
balloons:
  main: {size: 260, color: green, length: 24, tail: 7}
steps:
  - bubbles: {handle: 10, left_ball: 4, right_ball: 4}
  - lock: [left_ball, right_ball]
    point: down
  - rest: ring
  - tie: {end: ring.end, to: ring.start}
    point: up
"""
    sources: ClassVar[tuple[str, ...]] = (
        "balloonhq.com: Twists 101, the hook and the nozzle wrapped round a joint",
        "instructables.com: the turtle, whose end is tied to its shell",
        "bpmizuki.hatenablog.jp, 29: the nozzle wound round a joint",
    )

    tie: TiedEnd
    """Tie an end of a balloon to a joint, by its nozzle or by its flat tip."""

    @property
    def names(self) -> tuple[str, ...]:
        """The end that is tied, and the joint."""
        return str(self.tie.end), str(self.tie.to)

    def held_at(self, piece: Workpiece) -> dict[str, int]:
        """Return at how many places hands hold what they bend round to tie its tip."""
        return {self.tie.end.bubble: PLACES} if self.tie.end.end == "end" else {}

    @classmethod
    def value_of(cls, units: Units, /, end: str, to: str) -> object:
        """Return its value as it stands in a file: two joints such as "tail.end"."""
        return {"end": end, "to": to}

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles whose ends it names."""
        return tuple(each.bubble for each in _joints_in(value))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Tie what is an end of a balloon by now."""
        path, joints = (*place.path, cls.word), _joints_in(value)
        if len(joints) < 2:
            return
        end, to = joints
        found = [
            bench.has_name(end.bubble, (*path, "end")) and bench.find_firm(end.bubble, (*path, "end")),
            bench.has_name(to.bubble, (*path, "to")) and bench.find_joint(to, (*path, "to")),
        ]
        if not all(found) or not bench.knows(each.bubble for each in joints):
            return
        if _is_end(joints[0], (*path, "end"), bench):
            bench.join(path, joints, [str(each) for each in joints])

    def perform(self, score: Score, index: int) -> None:
        """Close a tip, bring the end to the joint, and tie it there."""
        first, last = sorted(score.twistable((self.tie.end, self.tie.to), self.word, index))
        far = 0.0
        if self.tie.end.end == "end":
            score.twist(self.tie.end.bubble, TURNS, index)
            far = score.layout.bubble(self.tie.end.bubble).length
        score.together(first, last, self.point, self.label, index, far=far)
        score.weld((first, last), TURNS, self.label, index, by_string=True)


def _joints_in(value: object) -> tuple[Joint, ...]:
    written = [value.get("end"), value.get("to")] if isinstance(value, dict) else []
    return readable_joints(written)


def _is_end(end: Joint, path: Path, bench: Workbench) -> bool:
    """Say whether a joint is an end of a balloon, and let a tip be closed there; complain if it is none."""
    made = bench.piece.bubbles[end.bubble]
    if end.end == "end" and made.last:
        return bench.close_tip(end.bubble, path)
    if end.end == "start" and bench.piece.row(made.balloon)[0] == end.bubble:
        return True
    first = bench.piece.row(made.balloon)[0]
    ends = [] if first in bench.piece.popped else [f"{first}.start"]
    if not bench.is_of_round(end.bubble):
        ends.append("the end of what a step rest names")
    what = f"{end} is no end of balloon {made.balloon}, expected {', or '.join(ends)}"
    bench.complain(path, f"{what}; other joints are locked: lock: {{joints: [...]}}")
    return False
