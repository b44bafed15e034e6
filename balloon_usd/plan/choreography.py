"""Choreography: the steps of a recipe as a timeline of a few hand moves.

Every operation of the vocabulary is made of these moves, and only these reach the solver. Seen by the maker
the balloons lie along x with the knot at the far end: forward is -x, up is +z, left is -y.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING

from balloon_usd.language.problem import RecipeError
from balloon_usd.plan.lengths import cm

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.plan.rings import RingTable
    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe
    from balloon_usd.recipe.steps import PushedBubble, Step

Vector = tuple[float, float, float]

INFLATE_SPEED = 0.38
"""Inflated length blown up per second, m/s: a maker with a hand pump."""
SETTLE_SECONDS = 0.4
"""Pause after inflating, gathering or bending, in which the rubber comes to rest, s."""
PINCH_SECONDS = 0.55
"""Closing of a neck between two fingers, s."""
TURN_SECONDS = 0.14
"""One full turn of a twist, s."""
HAND_SPEED = 0.22
"""Mean speed of a hand that brings joints together, m/s; its peak is 1.9 times this."""
CARRYING_SPEED = 0.08
"""The same in model kosaka, where air particles must follow the bubble that carries them, m/s."""
DRAWING_SECONDS = 1.0
"""Closing of a ring by force in model kosaka, with time for the air to leave, s."""
GATHER_LEAST = 0.8
"""Shortest gathering, s."""
BEND_SECONDS = 0.9
"""Bending one bubble, s."""
PUSH_SECONDS = 1.0
"""Pressing with a finger, holding and releasing, s."""
SPREAD_SECONDS = 1.5
"""Time in which the air particles of a balloon that starts blown up spread, s."""
FAR_FROM_FINGER = 1.0 / 3.0
"""Share of a pushed bubble's length beyond which the other hand holds its ends."""

POINTS: dict[str, Vector] = {
    "up": (0.0, 0.0, 1.0),
    "down": (0.0, 0.0, -1.0),
    "left": (0.0, -1.0, 0.0),
    "right": (0.0, 1.0, 0.0),
    # Along the balloon nothing can fold; these lean between up and the way named.
    "forward": (-math.sqrt(0.5), 0.0, math.sqrt(0.5)),
    "back": (math.sqrt(0.5), 0.0, math.sqrt(0.5)),
}
"""Directions as seen by the maker."""


@dataclass(frozen=True)
class Move:
    """One move of the hands."""

    start: float
    """Time at which it begins, s."""
    seconds: float
    """Time that it takes, s; 0 for an instant."""
    step: int
    """Step of the recipe that it belongs to; -1 before the first."""
    text: str
    """What the hands do, for people."""

    @property
    def end(self) -> float:
        """Time at which it ends, s."""
        return self.start + self.seconds


@dataclass(frozen=True)
class Inflate(Move):
    """Blow up a balloon with a pump, its knot held."""

    balloon: str = ""


@dataclass(frozen=True)
class Pinch(Move):
    """Close the neck at a ring between two fingers."""

    ring: int = 0


@dataclass(frozen=True)
class Spin(Move):
    """Turn the balloon beyond a closed ring about its own axis."""

    ring: int = 0
    turns: float = 0.0


@dataclass(frozen=True)
class Gather(Move):
    """Bring the first ring of a chain to its last, which is held, and lead what is between to a side."""

    corners: tuple[int, ...] = ()
    """Rings of the chain from the moving one to the held one."""
    cheeks: tuple[tuple[int, int], ...] = ()
    """Guide rings in the middle of sides that are pressed outwards, with the index of the side."""
    point: Vector = (0.0, 0.0, 1.0)
    """Unit direction to which the chain rises."""


@dataclass(frozen=True)
class Bring(Move):
    """Bring a ring of one balloon to a ring of another, which is held."""

    ring: int = 0
    to: int = 0


@dataclass(frozen=True)
class Bend(Move):
    """Bend a bubble by leading its start and middle onto an arc, its end held."""

    rings: tuple[int, ...] = ()
    angle: float = 0.0
    """Angle between the directions of its ends, radians."""
    point: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Push(Move):
    """Press a finger into a wall, hold it there, and take it away, while the other hand holds some rings."""

    balloon: str = ""
    along: float = 0.0
    """Place of the finger: unstressed distance from the knot, m."""
    point: Vector = (0.0, 0.0, -1.0)
    """Unit direction in which the finger moves."""
    force: float = 0.0
    """How hard it presses, N; 0 where depth is given."""
    depth: float = 0.0
    """How deep it presses, m; 0 where force is given."""
    holds: tuple[int, ...] = ()
    """Rings that the other hand holds."""


@dataclass(frozen=True)
class Weld(Move):
    """Twist joints that lie together into one."""

    rings: tuple[int, ...] = ()
    turns: float = 0.0


@dataclass(frozen=True)
class LetGo(Move):
    """Take the hands away."""

    for_good: bool = False
    """Whether nothing is made any more: until then makers hold by hand what would come undone."""


@dataclass(frozen=True)
class Choreography:
    """All moves of a sculpture in time."""

    moves: tuple[Move, ...]
    seconds: float
    """Length of the animation, s."""


@dataclass
class _Score:
    """Moves written so far, and the time reached."""

    recipe: Recipe
    table: RingTable
    strips: Mapping[str, Strip]
    lengths: dict[str, float]
    now: float = 0.0
    moves: list[Move] = field(default_factory=list)

    @property
    def blown_up(self) -> bool:
        """Whether balloons start blown up and joints freeze instead of being wound, as in model kosaka."""
        return self.recipe.physics.model == "kosaka"

    @property
    def hand_speed(self) -> float:
        """Mean speed of a hand that brings joints together, m/s."""
        return CARRYING_SPEED if self.blown_up else HAND_SPEED

    def add(self, move: Move) -> None:
        self.moves.append(move)
        self.now = move.end


def choreograph(recipe: Recipe, strips: Mapping[str, Strip], table: RingTable) -> Choreography:
    """Return the timeline of hand moves that make a recipe.

    Raises:
        RecipeError: a lock asks for the tip of a balloon, or a finger pushes beyond a bubble, with its place
            in the file.
    """
    score = _Score(recipe, table, strips, {b.name: b.length for s in strips.values() for b in s.bubbles})
    if score.blown_up:
        score.add(Move(0.0, SPREAD_SECONDS, -1, "air spreads"))
    else:
        _inflate(score, strips)
    for index, step in enumerate(recipe.steps):
        begin, first = score.now, len(score.moves)
        _STEPS[step.kind](score, step, index)
        if step.seconds is not None and step.kind not in {"push", "wait"}:
            _retime(score, first, begin, step.seconds)
    score.add(LetGo(score.now, 0.0, len(recipe.steps), "let go", for_good=True))
    score.add(Move(score.now, recipe.physics.hold, len(recipe.steps), "hold"))
    return Choreography(tuple(score.moves), score.now)


def _inflate(score: _Score, strips: Mapping[str, Strip]) -> None:
    longest = 0.0
    for name, strip in strips.items():
        seconds = max(1.0, (strip.bubbles[-1].end - strip.bubbles[0].start) / INFLATE_SPEED)
        seconds = seconds if strip.shape is None else strip.shape.seconds
        score.moves.append(Inflate(0.0, seconds, -1, f"inflate: {name}", balloon=name))
        longest = max(longest, seconds)
    score.now = longest
    score.add(Move(score.now, SETTLE_SECONDS, -1, "inflated"))
    score.add(LetGo(score.now, 0.0, -1, "let go"))


def _twist(score: _Score, step: Step, index: int, bubble: str) -> None:
    """Pinch and, where joints are wound, turn at the end of a bubble, unless that is the tip."""
    ring = score.table.ends(bubble)[1]
    if ring is not None:
        seconds = DRAWING_SECONDS if score.blown_up else PINCH_SECONDS
        score.add(Pinch(score.now, seconds, index, f"pinch: {bubble}", ring=ring))
        if not score.blown_up:
            seconds = step.turns * TURN_SECONDS
            score.add(Spin(score.now, seconds, index, f"twist: {bubble}", ring=ring, turns=step.turns))
        score.add(LetGo(score.now, 0.0, index, "let go"))


def _bubbles(score: _Score, step: Step, index: int) -> None:
    for bubble in step.lengths:
        _twist(score, step, index, bubble)


def _lock(score: _Score, step: Step, index: int) -> None:
    rings = [score.table.joint(end) for end in step.joints]
    found = [ring for ring in rings if ring is not None]
    if len(found) < len(rings):
        tip = next(end for end, ring in zip(step.joints, rings, strict=True) if ring is None)
        text = f"{tip} is the tip of its balloon and cannot be twisted, expected a joint between two bubbles"
        raise RecipeError([score.recipe.problem(("steps", index, "lock"), text)])
    text = f"lock twist: {', '.join(str(end.bubble) for end in step.joints)}"
    for first, last in pairwise(found):
        _together(score, step, index, text, min(first, last), max(first, last))
    _weld(score, step, index, text, tuple(found))


def _merge(score: _Score, step: Step, index: int) -> None:
    for bubble in step.lengths:
        _twist(score, step, index, bubble)
        start, end = score.table.ends(bubble)
        if end is not None:
            text = f"{step.kind} twist: {bubble}"
            _together(score, step, index, text, start, end)
            _weld(score, step, index, text, (start, end))


def _together(score: _Score, step: Step, index: int, text: str, first: int, last: int) -> None:
    """Bring two joints together: along their balloon if it is the same, else straight."""
    rings = score.table.rings
    if rings[first].balloon != rings[last].balloon:
        score.add(Bring(score.now, 1.5, index, text, ring=last, to=first))
        return
    joints = [k for k in range(first, last + 1) if rings[k].joint]
    cheeks: tuple[tuple[int, int], ...] = ()
    corners = tuple(joints)
    if len(joints) == 2:
        corners = (first, *score.table.guides(rings[last].bubble), last)
    elif len(joints) == 3:
        cheeks = tuple((score.table.guides(rings[j].bubble)[0], k) for k, j in enumerate(joints[1:]))
    length = sum(score.lengths[rings[j].bubble] for j in joints[1:])
    seconds = max(GATHER_LEAST, length / score.hand_speed)
    point = POINTS[step.point or "up"]
    score.add(Gather(score.now, seconds, index, text, corners=corners, cheeks=cheeks, point=point))


def _weld(score: _Score, step: Step, index: int, text: str, rings: tuple[int, ...]) -> None:
    score.add(Weld(score.now, 0.0, index, text, rings=rings, turns=step.turns))
    score.add(Move(score.now, SETTLE_SECONDS, index, text))
    score.add(LetGo(score.now, 0.0, index, "let go"))


def _bend(score: _Score, step: Step, index: int) -> None:
    for bubble, angle in (step.bend or {}).items():
        start, end = score.table.ends(bubble)
        guides = score.table.guides(bubble)
        rings = (start, *guides) if end is None else (start, *guides, end)
        point = POINTS[step.point or "up"]
        score.add(
            Bend(score.now, BEND_SECONDS, index, f"bend: {bubble}", rings=rings, angle=angle, point=point)
        )
        score.add(LetGo(score.now, 0.0, index, "let go"))


def _push(score: _Score, step: Step, index: int) -> None:
    push = step.push
    assert push is not None, "a step of this kind has a push"
    strip, bubble = next((s, b) for s in score.strips.values() for b in s.bubbles if b.name == push.bubble)
    _check_push(score, strip, bubble, push, index)
    at = 0.5 * bubble.length if push.at is None else push.at
    start, end = score.table.ends(bubble.name)
    far_end = score.table.guides(bubble.name)[-1] if end is None else end
    ends = ((start, at), (far_end, bubble.length - at))
    move = Push(
        score.now,
        PUSH_SECONDS if step.seconds is None else step.seconds,
        index,
        f"push: {bubble.name}",
        balloon=strip.balloon,
        along=strip.rest_place(bubble, at),
        point=POINTS[step.point or "down"],
        force=push.force or 0.0,
        depth=push.depth or 0.0,
        holds=tuple(ring for ring, away in ends if away > FAR_FROM_FINGER * bubble.length),
    )
    score.add(move)
    score.add(Move(score.now, 2.0 * SETTLE_SECONDS, index, move.text))
    score.add(LetGo(score.now, 0.0, index, "let go"))


def _check_push(score: _Score, strip: Strip, bubble: PlannedBubble, push: PushedBubble, index: int) -> None:
    """Refuse a finger beside the bubble, or one that would come out at its other side."""
    problems = []
    if push.at is not None and push.at >= bubble.length:
        text = f"{cm(push.at)} does not lie inside {bubble.name}, expected less than {cm(bubble.length)}"
        problems.append(score.recipe.problem(("steps", index, "push", "at"), text))
    wide = 2.0 * strip.inflated_radius
    if push.depth is not None and push.depth >= wide:
        text = f"{cm(push.depth)} goes through a {strip.size.name}, expected less than {cm(wide)}"
        problems.append(score.recipe.problem(("steps", index, "push", "depth"), text))
    if problems:
        raise RecipeError(problems)


def _rest(score: _Score, step: Step, index: int) -> None:
    """Nothing is done to what is left of a balloon."""


def _wait(score: _Score, step: Step, index: int) -> None:
    score.add(Move(score.now, step.wait or 0.0, index, "wait"))


def _retime(score: _Score, first: int, begin: float, seconds: float) -> None:
    """Stretch the moves of one step to the time that the recipe gives them."""
    taken = score.now - begin
    if taken > 0.0:
        scale = seconds / taken
        for k in range(first, len(score.moves)):
            move = score.moves[k]
            score.moves[k] = replace(
                move, start=begin + scale * (move.start - begin), seconds=scale * move.seconds
            )
        score.now = begin + seconds


_STEPS = {
    "bubbles": _bubbles,
    "lock": _lock,
    "loop": _merge,
    "fold": _merge,
    "ear": _merge,
    "rest": _rest,
    "bend": _bend,
    "push": _push,
    "wait": _wait,
}
