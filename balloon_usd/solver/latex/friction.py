"""Which rings the rotational friction of welds keeps at their distances."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.plan import Plan
    from balloon_usd.solver.hands import Hands


def friction_pairs(plan: Plan, hands: Hands, rings: Sequence[int]) -> set[tuple[int, int]]:
    """Return the pairs of joints (of the scene) whose distance the friction of a weld keeps.

    `rings`: joint of the scene of every planned ring.
    """
    return _Welded(plan, hands, rings).pairs()


class _Welded:
    """The welds of one sculpture and the bubbles that meet in them."""

    def __init__(self, plan: Plan, hands: Hands, rings: Sequence[int]) -> None:
        self.plan = plan
        self.hands = hands
        self._ring = rings

    def pairs(self) -> set[tuple[int, int]]:
        """Pairs of rings whose distance the friction of a weld keeps."""
        welds = [set(group) for group in self.hands.welds_of(self._ring)]
        ends = [self._neighbours(weld) for weld in welds]
        pairs = set()
        for weld, near in zip(welds, ends, strict=True):
            pairs |= set(combinations(sorted(near | self._cheeks(weld, near)), 2))
        for (weld, near), (other, far) in combinations(zip(welds, ends, strict=True), 2):
            if near & other:
                pairs |= {(min(a, b), max(a, b)) for a in near - other for b in far - weld if a != b}
        return pairs

    def _neighbours(self, weld: set[int]) -> set[int]:
        """Joints at the far ends of the bubbles that meet in a weld; of a loop or an open end, a ring
        inside.
        """
        found: set[int] = set()
        for bubble, inside, outside in self._meeting(weld):
            guides = [self._ring[g] for g in self.plan.table.guides(bubble)]
            if outside is not None and self.hands.radius_goal[outside] > 0.0:
                found.add(outside)
            elif guides and inside == 2:
                found.add(guides[len(guides) // 2])
            elif guides and outside is None:
                found.add(guides[0])
        return found

    def _cheeks(self, weld: set[int], near: set[int]) -> set[int]:
        """Middles of bubbles that lie side by side: two that share both a weld and the joint beyond it."""
        met = [(bubble, outside) for bubble, _, outside in self._meeting(weld) if outside in near]
        beyond = [outside for _, outside in met]
        folded = [bubble for bubble, outside in met if beyond.count(outside) > 1]
        return {self._ring[self.plan.table.guides(bubble)[0]] for bubble in folded}

    def _meeting(self, weld: set[int]) -> list[tuple[str, int, int | None]]:
        """Bubbles with an end in a weld: name, number of ends in it, and the ring of the other end if
        there is one.
        """
        found = []
        for bubble in self.plan.bubbles:
            start, end = self.plan.table.ends(bubble.name)
            rings = [self._ring[r] for r in (start, end) if r is not None]
            inside = [ring for ring in rings if ring in weld]
            if inside:
                found.append((bubble.name, len(inside), next((r for r in rings if r not in weld), None)))
        return found
