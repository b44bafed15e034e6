"""`lock`: the lock twist, which holds neighbouring bubbles, or any joints, together."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Discriminator, Tag

from balloon_usd.language.joint import Joint, JointEntry, readable_joints
from balloon_usd.language.lengths import cm
from balloon_usd.language.names import Name
from balloon_usd.operations.caution import Caution, unequal
from balloon_usd.operations.modifiers import Entries, OnBalloon, Pointed, Timed, Turned
from balloon_usd.operations.operation import Operation

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class LockJoints(Entries):
    """The general form of a lock: any joints, also of different balloons."""

    joints: tuple[JointEntry, ...]
    """Joints that become one, each written bubble.start or bubble.end."""


BUBBLES, JOINTS = "a list of bubbles", "joints of any"
"""Tags of the forms of a lock, which never occur as keys of a recipe."""


def _form(value: object) -> str | None:
    if isinstance(value, (dict, LockJoints)):
        return JOINTS
    return BUBBLES if isinstance(value, (list, tuple)) else None


class Lock(OnBalloon, Pointed, Turned, Timed, Operation):
    """Fold these neighbouring bubbles and twist the start of the first to the end of the last."""

    word: ClassVar[str] = "lock"
    called: ClassVar[tuple[str, ...]] = ("link", "lock_twist", "connect", "join")
    on_rounds: ClassVar[bool] = True
    value_model: ClassVar[type[Entries] | None] = LockJoints
    example: ClassVar[str] = """\
format: 1
name: mouse
units: cm
balloons:
  main: {size: 260, color: light_blue, length: 17, tail: 7}
steps:
  - bubbles: {nose: 5, left_ear: 7, right_ear: 7}
  - lock: [left_ear, right_ear]
    point: up
  - bubbles: {neck: 3, left_paw: 6, right_paw: 6}
  - lock: [left_paw, right_paw]
    point: down
  - rest: body
"""
    sources: ClassVar[tuple[str, ...]] = (
        "Kosaka 2008, fig. 2.2: the lock twist",
        "balloonhq.com: Twists 101, the lock twist",
        "mbfloyd.com: Different twists",
    )

    lock: Annotated[
        Annotated[tuple[Name, ...], Tag(BUBBLES)] | Annotated[LockJoints, Tag(JOINTS)],
        Discriminator(_form),
    ]
    """Fold these neighbouring bubbles and twist the start of the first to the end of the last."""

    @property
    def ends(self) -> tuple[Joint, ...]:
        """Joints that it brings together."""
        if isinstance(self.lock, LockJoints):
            return self.lock.joints
        return Joint(self.lock[0], "start"), Joint(self.lock[-1], "end")

    @property
    def names(self) -> tuple[str, ...]:
        """Bubbles or joints that it brings together."""
        return tuple(map(str, self.ends)) if isinstance(self.lock, LockJoints) else self.lock

    @classmethod
    def value_of(cls, units: Units, /, *bubbles: str, joints: Sequence[str] | None = None) -> object:
        """Return its value as it stands in a file: neighbouring bubbles, or joints such as "nose.end"."""
        return list(bubbles) if joints is None else {"joints": list(joints)}

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles that it names."""
        names, joints = _names_in(value), _joints_in(value)
        return (*(names or ()), *(each.bubble for each in joints or ()))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Bring joints together that are there and are not one yet."""
        path = (*place.path, cls.word)
        if (names := _names_in(value)) is not None:
            _check_bubbles(names, _is_read(names, value), path, bench)
        if (joints := _joints_in(value)) is not None:
            _check_joints(joints, _is_read(joints, value), (*path, "joints"), bench)

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of a pair of unequal length, and of a direction that nothing can take."""
        balloons = [layout.bubble(end.bubble).balloon for end in self.ends]
        if self.point is not None and 1 < len(balloons) == len(set(balloons)):
            yield Caution(
                index,
                f"point: {self.point} changes nothing",
                "joints of different balloons are brought straight to each other, and no bubble lies between",
                "leave out point",
            )
        if (pair := self._pair(layout)) is None:
            return
        first, second = pair
        one, other = layout.bubble(first).length, layout.bubble(second).length
        if unequal((one, other)):
            yield Caution(
                index,
                f"{first} ({cm(one)}) and {second} ({cm(other)}) are an unequal pair",
                "the longer one bows out and turns the pair aside",
                f"make both {cm(0.5 * (one + other))} long",
            )

    def _pair(self, layout: Layout) -> tuple[str, str] | None:
        """Return the two bubbles of which it makes a pair, None where it makes something else."""
        if not isinstance(self.lock, LockJoints):
            return (self.lock[0], self.lock[1]) if len(self.lock) == 2 else None
        starts = [each.bubble for each in self.ends if each.end == "start"]
        ends = [each.bubble for each in self.ends if each.end == "end"]
        if (len(starts), len(ends)) != (1, 1):
            return None
        between = layout.joint(Joint(starts[0], "end"))
        behind = between is not None and between == layout.joint(Joint(ends[0], "start"))
        return (starts[0], ends[0]) if behind else None

    def perform(self, score: Score, index: int) -> None:
        """Bring each joint to the next, and twist all into one.

        Where balloons share several joints, those of each are twisted into one first: brought from one hand
        to another they would leave the others behind.
        """
        rings = score.twistable(self.ends, self.word, index)
        text = f"lock twist: {', '.join(str(end.bubble) for end in self.ends)}"
        by_balloon = score.by_balloon(rings)
        for own in by_balloon:
            for first, last in pairwise(own):
                score.together(first, last, self.point, text, index)
            if 1 < len(own) < len(rings):
                score.weld(own, self.turns, text, index)
        for one, other in pairwise(by_balloon):
            score.together(one[-1], other[-1], self.point, text, index)
        score.weld(rings, self.turns, text, index)


def _names_in(value: object) -> tuple[str, ...] | None:
    if not isinstance(value, (list, tuple)):
        return None
    return tuple(name for name in value if isinstance(name, str))


def _joints_in(value: object) -> tuple[Joint, ...] | None:
    written = value.get("joints") if isinstance(value, dict) else None
    return readable_joints(written) if isinstance(written, (list, tuple)) else None


def _is_read(found: Sequence[object], value: object) -> bool:
    """Whether every entry could be read."""
    written = value["joints"] if isinstance(value, dict) else value
    return isinstance(written, (list, tuple)) and len(found) == len(written)


def _check_bubbles(names: Sequence[str], read: bool, path: Path, bench: Workbench) -> None:
    found = [bench.find_firm(name, path) for name in names]
    if not read or not all(found):
        return
    if len(set(names)) < len(names):
        bench.complain(path, "names a bubble twice, expected each once")
    elif len(names) < 2:
        what = "expected at least two bubbles; one bubble closes on itself with loop, fold or ear"
        bench.complain(path, f"{len(names)} bubbles cannot be locked, {what}")
    else:
        _check_neighbours(names, path, bench)


def _check_neighbours(names: Sequence[str], path: Path, bench: Workbench) -> None:
    if not bench.knows(names):
        return
    made = bench.piece.bubbles
    last = Joint(names[-1], "start" if bench.is_round_end(names[-1]) else "end")
    joints = f"lock: {{joints: [{names[0]}.start, {last}]}}"
    balloons = list(dict.fromkeys(made[name].balloon for name in names))
    if len(balloons) > 1:
        bench.complain(path, f"bubbles of different balloons ({', '.join(balloons)}), expected {joints}")
        return
    row = bench.piece.row(balloons[0])
    places = [row.index(name) for name in names]
    run = row[min(places) : max(places) + 1]
    if list(run) == list(names):
        bench.join(path, [Joint(names[0], "start"), Joint(names[-1], "end")], names)
    elif len(run) == len(names):
        bench.complain(path, f"not in the order of the balloon, expected [{', '.join(run)}]")
    else:
        between = ", ".join(name for name in run if name not in names)
        joints = f"lock: {{joints: [{run[0]}.start, {run[-1]}.end]}}"
        expected = joints if bench.piece.popped.intersection(run) else f"[{', '.join(run)}] or {joints}"
        bench.complain(path, f"no neighbours ({between} between them), expected {expected}")


def _check_joints(joints: Sequence[Joint], read: bool, path: Path, bench: Workbench) -> None:
    found = [bench.find_joint(each, path) for each in joints]
    if not read or not all(found):
        return
    if len(joints) < 2:
        bench.complain(path, f"{len(joints)} joints cannot be locked, expected at least two")
        return
    if bench.knows(each.bubble for each in joints):
        bench.join(path, joints, [str(each) for each in joints])
