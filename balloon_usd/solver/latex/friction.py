"""Which rings the rotational friction of welds keeps at their distances."""

from __future__ import annotations

from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.operations.moves import Weld
from balloon_usd.operations.table import BY_KIND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from balloon_usd.plan import Plan
    from balloon_usd.solver.hands import Hands


class _Bubble(NamedTuple):
    """A bubble by its joints in the scene."""

    name: str
    ends: tuple[int, ...]
    """Rings at its start and at its end; the tip has none."""
    guides: tuple[int, ...]
    """Rings inside, from its start to its end."""
    folded: bool
    """Whether its two halves lie side by side."""


class _Met(NamedTuple):
    """A bubble with an end in a weld."""

    bubble: _Bubble
    inside: int
    """How many of its ends are in the weld."""
    outside: int | None
    """The ring of the other end, if there is one."""


class Friction:
    """The bubbles of one sculpture that its welds keep from turning."""

    def __init__(self, plan: Plan, rings: Sequence[int]) -> None:
        """Take note of them; `rings`: joint of the scene of every planned ring."""
        self._plan = plan
        self._rings = rings
        self.popped: set[str] = set()
        """Bubbles that have been burst and keep nothing apart."""

    @cached_property
    def _bubbles(self) -> list[_Bubble]:
        table, rings = self._plan.table, self._rings
        return [
            _Bubble(
                bubble.name,
                tuple(rings[r] for r in table.ends(bubble.name) if r is not None),
                tuple(rings[g] for g in table.guides(bubble.name)),
                BY_KIND[bubble.kind].folds if bubble.kind in BY_KIND else False,
            )
            for bubble in self._plan.bubbles
        ]

    def pairs(self, hands: Hands) -> set[tuple[int, int]]:
        """Return the pairs of joints (of the scene) whose distance the friction of a weld keeps."""
        return set().union(*self.kept(hands).values())

    def kept(self, hands: Hands) -> dict[tuple[int, ...], set[tuple[int, int]]]:
        """Return the pairs of joints (of the scene) whose distance friction keeps, weld by weld."""
        return self._pairs(hands.welds_of(self._rings), lambda ring: hands.radius_goal[ring] > 0.0)

    def most_pairs(self) -> set[tuple[int, int]]:
        """Return all pairs that `pairs` may return while the plan is made: every joint counts as closed."""
        found: set[tuple[int, int]] = set()
        moves = [move for move in self._plan.choreography.moves if isinstance(move, Weld)]
        holding = [move for move in moves if move.step not in self._plan.slipping]
        for some in (moves, holding) if len(holding) < len(moves) else (moves,):
            welds: list[tuple[int, ...]] = []
            for move in some:
                one = {self._rings[ring] for ring in move.rings}
                beside = [weld for weld in welds if not one.isdisjoint(weld)]
                welds = [weld for weld in welds if weld not in beside] + [tuple(sorted(one.union(*beside)))]
                found.update(*self._pairs(welds, lambda _: True).values())
        return found

    def _pairs(
        self, welds: Iterable[tuple[int, ...]], closed: Callable[[int], bool]
    ) -> dict[tuple[int, ...], set[tuple[int, int]]]:
        """Return the pairs of joints that each weld keeps; `closed`: whether a joint is closed by now."""
        met = {weld: self._meeting(set(weld)) for weld in welds}
        ends = {weld: _neighbours(meeting, closed) for weld, meeting in met.items()}
        pairs = {
            weld: set(combinations(sorted(ends[weld] | _cheeks(meeting, ends[weld])), 2)) | _halves(meeting)
            for weld, meeting in met.items()
        }
        for (weld, near), (other, far) in combinations(ends.items(), 2):
            if near.intersection(other):
                both = {(min(a, b), max(a, b)) for a in near.difference(other) for b in far.difference(weld)}
                both = {(a, b) for a, b in both if a != b}
                pairs[weld] |= both
                pairs[other] |= both
        return pairs

    def _meeting(self, weld: set[int]) -> list[_Met]:
        """Return the bubbles that meet in a weld."""
        found = []
        for bubble in self._bubbles:
            if bubble.name in self.popped:
                continue
            inside = sum(ring in weld for ring in bubble.ends)
            if inside:
                found.append(_Met(bubble, inside, next((r for r in bubble.ends if r not in weld), None)))
        return found


def _neighbours(meeting: Sequence[_Met], closed: Callable[[int], bool]) -> set[int]:
    """Joints at the far ends of the bubbles that meet in a weld; of a loop or an open end, a ring inside."""
    found: set[int] = set()
    for (_, _, guides, _), inside, outside in meeting:
        if outside is not None and closed(outside):
            found.add(outside)
        elif guides and inside == 2:
            found.add(guides[len(guides) // 2])
        elif guides and outside is None:
            found.add(guides[0])
    return found


def _halves(meeting: Sequence[_Met]) -> set[tuple[int, int]]:
    """Middles of the halves of folds: the twist that their ends are wound into keeps them side by side."""
    folds = [bubble for bubble, inside, _ in meeting if bubble.folded and inside == 2]
    return {(bubble.guides[0], bubble.guides[-1]) for bubble in folds}


def _cheeks(meeting: Sequence[_Met], near: set[int]) -> set[int]:
    """Middles of bubbles that lie side by side: two that share both a weld and the joint beyond it."""
    met = [(bubble, outside) for bubble, _, outside in meeting if outside in near]
    beyond = [outside for _, outside in met]
    return {bubble.guides[len(bubble.guides) // 2] for bubble, outside in met if beyond.count(outside) > 1}
