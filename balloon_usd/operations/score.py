"""The score: the timeline of moves that operations write."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import chain, pairwise, product
from typing import TYPE_CHECKING, NoReturn

from balloon_usd.language.problem import RecipeError
from balloon_usd.operations.disjoint_sets import DisjointSets
from balloon_usd.operations.distances import distances
from balloon_usd.operations.moves import (
    ACROSS,
    POINTS,
    PUSHING,
    Bring,
    BringInside,
    Gather,
    Hold,
    Inflate,
    LeadIn,
    LetDown,
    LetGo,
    Move,
    Pinch,
    Spin,
    TurnFold,
    Vector,
    Weld,
    mirror_image,
)
from balloon_usd.operations.tempo import PACES, Pace

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from balloon_usd.language.joint import Joint
    from balloon_usd.language.problem import Path, Problem
    from balloon_usd.operations.layout import Layout, PlacedBubble
    from balloon_usd.operations.modifiers import Point
    from balloon_usd.operations.workpiece import Workpiece

STROKE_SECONDS = 0.7
"""A stroke of a hand pump, there and back, s."""
LET_DOWN_SECONDS = 2.0
"""Time in which air is let out of a balloon that was blown up farther, s."""
SETTLE_SECONDS = 0.4
"""Pause after inflating, gathering or bending, in which the rubber comes to rest, s."""
PINCH_SECONDS = 0.55
"""Closing of a neck between two fingers, s."""
HAND_SPEED = 0.16
"""Mean speed of a hand that brings joints together, m/s: no point of the bubbles goes faster than 1.5 m/s."""
CARRYING_SPEED = 0.08
"""The same in model kosaka, where air particles must follow the bubble that carries them, m/s."""
DRAWING_SECONDS = 1.0
"""Closing of a ring by force in model kosaka, with time for the air to leave, s."""
GATHER_LEAST = 1.1
"""Shortest gathering, s."""
BOWED, BOWED_PAIR = 1.0, 2.0
"""Length of a bubble of a chain, in that of all its others together, from which on hands bend it round; of a
pair, whose two bubbles lie on each other.
"""
LEAST_TURNED = 0.8
"""Length of the shortest bubble of a fold that hands turn, in widths of its tube; of a fold of one, twice."""
BRING_SECONDS = 1.5
"""Bringing a joint to one of another balloon, s."""
BRING_SPEED = 0.5
"""Mean speed of a hand that does so from far off, m/s: 0.9 at most."""
HASTE = 0.5
"""Share of the time that a maker takes below which walls would be torn past others."""
LEADING_IN_SPEED = 0.3
"""Mean speed of a hand that leads a balloon in, m/s: nothing is bent on the way."""
LEAD_IN_LEAST = 1.0
"""Shortest leading in, s."""


@dataclass
class Score:
    """Moves written so far, and the time reached."""

    layout: Layout
    problem: Callable[[Path, str], Problem]
    """Makes a problem at its place in the recipe."""
    piece: Workpiece
    """What the recipe makes, and how it comes about."""
    blown_up: bool
    """Whether balloons start blown up and joints freeze instead of being wound, as in model kosaka."""
    pace: Pace = PACES["calm"]
    mirrored: bool = False
    """Whether hands make the mirror image of what the recipe says."""
    now: float = 0.0
    moves: list[Move] = field(default_factory=list)
    pieces: DisjointSets[str] = field(default_factory=DisjointSets)
    """Balloons that are joined so far; the root is the one that was not led in."""
    joints: DisjointSets[int] = field(default_factory=DisjointSets)
    """Rings that have become one joint so far."""

    def add(self, move: Move) -> None:
        """Write a move behind those that are there."""
        self.moves.append(move)
        self.now = move.end

    def let_go(self, index: int) -> None:
        """Take the hands away."""
        self.add(LetGo(self.now, 0.0, index, "let go"))

    def retouch(self, move: Move, seconds: float) -> None:
        """Let hands work on the finished figure once more, and let it come to rest for some seconds."""
        self.add(move)
        self.let_go(move.step)
        self.add(Hold(self.now, seconds, move.step, move.text))

    def refuse(self, index: int, told: Mapping[tuple[str, ...], str]) -> NoReturn:
        """Refuse a step for what is wrong at some of its keys; raises `RecipeError`."""
        raise RecipeError([self.problem(("steps", index, *keys), text) for keys, text in told.items()])

    def twistable(self, ends: Sequence[Joint], word: str, index: int) -> tuple[int, ...]:
        """Return the rings of joints that a step of a word twists; refuses the tip of a balloon."""
        rings = [self.layout.joint(end) for end in ends]
        found = tuple(ring for ring in rings if ring is not None)
        if len(found) < len(rings):
            tip = ends[rings.index(None)]
            text = "is the tip of its balloon and cannot be twisted, expected another joint"
            if not self.layout.bubble(tip.bubble).of_round:
                text += ", or a step tie"
            self.refuse(index, {(word,): f"{tip} {text}"})
        return found

    def settle(self, move: Move) -> None:
        """Write a move, wait until the rubber is at rest, and take the hands away."""
        self.add(move)
        self.add(Move(self.now, SETTLE_SECONDS, move.step, move.text))
        self.let_go(move.step)

    def refuse_haste(self, index: int, given: float | None, calm: float, doing: str) -> None:
        """Refuse a step with too short a time (s) in the recipe; raises `RecipeError`.

        `calm`: time that a calm maker takes, s; `doing`: what for, in words.
        """
        if given is not None and given < HASTE * calm:
            least = math.ceil(10.0 * HASTE * calm) / 10.0
            told = f"{given:g} s are too short a time to {doing}, expected at least {least:g} s"
            self.refuse(index, {("seconds",): told})

    def inflate(
        self,
        balloons: Sequence[str],
        index: int,
        seconds: float | None = None,
        strokes: int | None = None,
    ) -> None:
        """Blow balloons up at the same time, each in so long, or as long as a maker takes.

        `strokes`: of a hand pump; None for a steady flow.
        """
        for balloon in balloons:
            pumping = self.layout.pump_seconds(balloon)
            if strokes is not None:
                pumping = max(pumping / PUSHING, strokes * STROKE_SECONDS)
            pumping = pumping if seconds is None else seconds
            text = f"inflate: {balloon}"
            self.moves.append(Inflate(self.now, pumping, index, text, balloon=balloon, strokes=strokes))
        self.now = max(move.end for move in self.moves if isinstance(move, Inflate))
        self.add(Move(self.now, SETTLE_SECONDS, index, "inflated"))
        self._let_down(balloons, index)
        for balloon in balloons:
            if seconds := self.layout.bring_seconds(balloon):
                text = f"centre the contents: {balloon}"
                self.add(BringInside(self.now, seconds, index, text, balloon=balloon))
        self.let_go(index)

    def _let_down(self, balloons: Sequence[str], index: int) -> None:
        """Let air out of those that were blown up farther than they will be, at the same time."""
        overblown = [balloon for balloon in balloons if self.layout.is_let_down(balloon)]
        for balloon in overblown:
            text = f"let air out: {balloon}"
            self.moves.append(LetDown(self.now, LET_DOWN_SECONDS, index, text, balloon=balloon))
        if overblown:
            self.now += LET_DOWN_SECONDS
            self.add(Move(self.now, SETTLE_SECONDS, index, "let down"))

    def twist(self, bubble: str, turns: float, index: int, *, pinches: int = 1) -> None:
        """Pinch and, where joints are wound, turn at the end of a bubble, unless that is the tip.

        `pinches`: times in which others are pinched that this pinch takes, as it draws in more.
        """
        ring = self.layout.ends(bubble)[1]
        if ring is None:
            return
        seconds = DRAWING_SECONDS if self.blown_up else pinches * PINCH_SECONDS / self.pace.leading
        self.add(Pinch(self.now, seconds, index, f"pinch: {bubble}", ring=ring))
        if not self.blown_up:
            seconds = self.pace.turning_seconds(turns)
            self.add(Spin(self.now, seconds, index, f"twist: {bubble}", ring=ring, turns=turns))
        self.let_go(index)

    def by_balloon(self, rings: Iterable[int]) -> list[tuple[int, ...]]:
        """Return rings in the order in which hands bring them together, those of each balloon: first those of
        the figure, to which others are led in.
        """
        found: dict[str, list[int]] = {}
        for ring in sorted(rings):
            found.setdefault(self.layout.ring(ring).balloon, []).append(ring)
        ordered = sorted(found, key=lambda balloon: abs(self.layout.parked(self.pieces.root(balloon))))
        return [tuple(found[balloon]) for balloon in ordered]

    def together(
        self, first: int, last: int, point: Point | None, text: str, index: int, *, far: float = 0.0
    ) -> None:
        """Bring two joints together: along their balloon if it is the same, the first to the last, else
        straight, the last to the first where they hang together, which are so far apart (m).
        """
        if self._same_balloon(first, last):
            self.gather(*self._nearest(first, last), point, text, index)
            return
        ring, to = self.lead_in(first, last, index)
        seconds = max(BRING_SECONDS, far / HAND_SPEED, self._way(ring, to) / BRING_SPEED) / self.pace.leading
        self.add(Bring(self.now, seconds, index, text, ring=ring, to=to))

    def longest_with(self, balloon: str) -> float:
        """Return how long the longest balloon is of those that are joined to one so far, and itself, m."""
        return max(map(self.layout.length, self._with(balloon)))

    def _with(self, balloon: str) -> list[str]:
        """Return the balloons that are joined to one so far, and itself."""
        blown = dict.fromkeys(move.balloon for move in self.moves if isinstance(move, Inflate))
        piece = self.pieces.root(balloon)
        return [each for each in blown if self.pieces.root(each) == piece]

    def _way(self, ring: int, to: int) -> float:
        """Return how far two joints of a figure lie from each other along its bubbles, m; 0 where they have
        just been led to each other.
        """
        if any(isinstance(move, LeadIn) and {move.ring, move.to} == {ring, to} for move in self.moves[-1:]):
            return 0.0
        sides = [
            (
                self.joints.root(one),
                self.joints.root(other),
                self.layout.place(other)[0] - self.layout.place(one)[0],
            )
            for balloon in self._with(self.layout.ring(ring).balloon)
            for one, other in pairwise(self.layout.joints_of(balloon))
        ]
        return distances(sides, self.joints.root(ring)).get(self.joints.root(to), 0.0)

    def lead_in(self, first: int, last: int, index: int) -> tuple[int, int]:
        """Lead in what lies aside with one of two rings of different balloons, unless they hang together;
        return the ring that moves and the one that is held.
        """
        homes = [(self.pieces.root(self.layout.ring(ring).balloon), ring) for ring in (first, last)]
        (figure, to), (guest, ring) = sorted(homes, key=lambda each: abs(self.layout.parked(each[0])))
        if figure == guest:
            return last, first
        self.pieces.merge((figure, guest))
        speed = CARRYING_SPEED if self.blown_up else LEADING_IN_SPEED
        (here, aside), (there, middle) = map(self.layout.place, (ring, to))
        far = math.hypot(here + self._gathered(ring) - there - self._gathered(to), aside - middle)
        seconds = max(LEAD_IN_LEAST, far / speed) / self.pace.leading
        text = f"lead in: {self.layout.ring(ring).balloon}"
        self.add(LeadIn(self.now, seconds, index, text, ring=ring, to=to))
        return ring, to

    def _nearest(self, first: int, last: int) -> tuple[int, int]:
        """Return the nearest two rings of their balloon that are of the same joints as two of its rings: what
        is folded between others is twisted already.
        """
        ones, others = (
            {ring, *(each for weld in self._welds() for each in weld if self._is_same_joint(each, ring))}
            for ring in (first, last)
        )
        one, other = min(product(sorted(ones), sorted(others)), key=lambda pair: abs(pair[1] - pair[0]))
        return min(one, other), max(one, other)

    def _is_same_joint(self, ring: int, other: int) -> bool:
        return self._same_balloon(ring, other) and self.joints.root(ring) == self.joints.root(other)

    def _gathered(self, ring: int) -> float:
        """Return how far a ring has come along its balloon as chains behind it were closed, m."""
        chains = (move.corners for move in self.moves if isinstance(move, Gather))
        behind = (c for c in chains if ring <= c[0] and self._same_balloon(ring, c[0]))
        return sum(bubble.length for c in behind for bubble in self._between(c[0], c[-1]))

    def _same_balloon(self, ring: int, other: int) -> bool:
        return self.layout.ring(ring).balloon == self.layout.ring(other).balloon

    def gather(
        self,
        first: int,
        last: int,
        point: Point | None,
        text: str,
        index: int,
        *,
        fold: str | None = None,
        pulled: float = 0.0,
    ) -> None:
        """Bring two joints of one balloon together, what is between them to a side.

        `fold`: the bubble between them, where its two halves are laid side by side; `pulled`: how far its
        middle is pulled out, m, as that of an ear.
        """
        layout = self.layout
        joints = self._without_closed([k for k in range(first, last + 1) if layout.ring(k).joint])
        corners = self._bowed(joints)
        cheeks: tuple[tuple[int, int], ...] = ()
        if fold is not None:
            corners, cheeks = folded(layout, fold, first, last)
        elif len(joints) == len(corners) == 3:
            guides = [layout.guides(layout.ring(j).bubble) for j in joints[1:]]
            cheeks = tuple((inside[len(inside) // 2], k) for k, inside in enumerate(guides))
        length = sum(layout.bubble(layout.ring(j).bubble).length for j in joints[1:])
        seconds = max(GATHER_LEAST, length / (CARRYING_SPEED if self.blown_up else HAND_SPEED))
        seconds /= self.pace.leading
        aim = point or "up"
        gather = Gather(self.now, seconds, index, text, corners=corners, cheeks=cheeks, pulled=pulled)
        self.add(replace(gather, point=self.towards(aim), across=self.sided(ACROSS[aim])))

    def _without_closed(self, joints: Sequence[int]) -> list[int]:
        """Return the rings of a chain without those of rows that are closed in it already, such as a lock:
        these hang on it. Single bubbles, such as ears, are kept: both their ends lie on it.
        """
        kept: list[int] = []
        at = 0
        while at < len(joints):
            kept.append(joints[at])
            same = [k for k in range(at, len(joints)) if self._is_same_joint(joints[k], joints[at])]
            at = same[-1] + 1 if same[-1] > at + 1 else at + 1
        return kept

    def _bowed(self, joints: Sequence[int]) -> tuple[int, ...]:
        """Return the corners of a chain: its joints, and the guides of a bubble that has to be bent round for
        the others to close it.
        """
        bubbles = [self.layout.ring(joint).bubble for joint in joints[1:]]
        lengths = [self.layout.bubble(bubble).length for bubble in bubbles]
        at = lengths.index(max(lengths))
        inside: tuple[int, ...] = ()
        if lengths[at] > (BOWED if len(lengths) > 2 else BOWED_PAIR) * (sum(lengths) - lengths[at]):
            inside = self.layout.guides(bubbles[at])
        return (*joints[: at + 1], *inside, *joints[at + 1 :])

    def towards(self, point: Point) -> Vector:
        """Return the unit direction in which hands lead what the recipe points somewhere."""
        return self.sided(POINTS[point])

    def sided(self, direction: Vector) -> Vector:
        """Return a direction as hands take it: its mirror image where they make that of the figure."""
        return mirror_image(direction) if self.mirrored else direction

    def weld(
        self, rings: tuple[int, ...], turns: float, text: str, index: int, *, by_string: bool = False
    ) -> None:
        """Twist joints that lie together into one; `by_string`: what is folded between them is not turned."""
        if len(rings) == 2 and self._same_balloon(*rings):
            rings = self._nearest(*rings)
        free = not self.blown_up and not by_string and self._can_turn(rings)
        self.joints.merge(rings)
        self.add(Weld(self.now, 0.0, index, text, rings=rings, turns=turns))
        if free:
            first, last = sorted(rings)
            seconds = self.pace.turning_seconds(turns, self._reach(first, last))
            self.add(TurnFold(self.now, seconds, index, text, rings=(first, last), turns=turns))
        self.add(Move(self.now, SETTLE_SECONDS, index, text))
        self.let_go(index)

    def _can_turn(self, rings: tuple[int, ...]) -> bool:
        """Tell whether joints of one balloon come together, with a fold between them that is long enough to
        be turned: the wall of a short one would fold over at its ends. A loop would go through what is folded
        where it hangs, and another balloon that hangs on the fold would be swung round.
        """
        if len(rings) != 2 or not self._same_balloon(*rings) or self._others_hang_between(*sorted(rings)):
            return False
        bubbles = self._between(*sorted(rings))
        if len(bubbles) == 1 and self._folded_at(rings):
            return False
        shortest = LEAST_TURNED if len(bubbles) > 1 else 2.0 * LEAST_TURNED
        return min(bubble.length / bubble.width for bubble in bubbles) >= shortest

    def _others_hang_between(self, first: int, last: int) -> bool:
        """Tell whether a joint between two rings of a balloon is one with a joint of another balloon."""
        between = {self.joints.root(ring) for ring in range(first + 1, last)}
        others = (ring for ring in chain(*self._welds()) if not self._same_balloon(ring, first))
        return any(self.joints.root(ring) in between for ring in others)

    def _folded_at(self, rings: tuple[int, ...]) -> bool:
        """Tell whether a fold hangs already where one of the rings is."""
        here = {self.joints.root(ring) for ring in rings}
        folds = (weld for weld in self._welds() if len(weld) == 2 and self._same_balloon(*weld))
        return any(self.joints.root(fold[0]) in here for fold in folds)

    def _welds(self) -> Iterator[tuple[int, ...]]:
        """Yield the rings of every twist so far."""
        return (move.rings for move in self.moves if isinstance(move, Weld))

    def _reach(self, first: int, last: int) -> float:
        """Return about how far what is folded between two rings reaches from the axis of its turn, m:
        a pair lies side by side, a ring or a loop opens as it is turned.
        """
        bubbles = self._between(first, last)
        width = max(bubble.width for bubble in bubbles)
        if len(bubbles) == 2:
            return width
        return 0.5 * width + 0.25 * sum(bubble.length for bubble in bubbles)

    def _between(self, first: int, last: int) -> list[PlacedBubble]:
        """Return the bubbles between two rings of a balloon."""
        rings = map(self.layout.ring, range(first + 1, last + 1))
        return [self.layout.bubble(ring.bubble) for ring in rings if ring.joint]

    def retime(self, first: int, begin: float, seconds: float) -> None:
        """Stretch the moves from a first one on to the time that the recipe gives their step."""
        taken = self.now - begin
        if taken > 0.0:
            scale = seconds / taken
            for k in range(first, len(self.moves)):
                move = self.moves[k]
                start = begin + scale * (move.start - begin)
                self.moves[k] = replace(move, start=start, seconds=scale * move.seconds)
            self.now = begin + seconds


def folded(
    layout: Layout, bubble: str, first: int, last: int
) -> tuple[tuple[int, int, int], tuple[tuple[int, int], ...]]:
    """Return the corners of a chain of the two halves of a bubble between two rings, and its cheeks: none
    where hands hold it at its middle alone.
    """
    inside = layout.guides(bubble)
    quarter = len(inside) // 4
    cheeks = ((inside[quarter], 0), (inside[-1 - quarter], 1)) if len(inside) > 1 else ()
    return (first, inside[len(inside) // 2], last), cheeks
