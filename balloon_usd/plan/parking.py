"""Where balloons lie until a step joins them: the first before the maker, the others aside."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.plan.nesting import hosts_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.plan.strip import Strip

ELBOW = 0.3
"""Room to either side of the first balloon for the hands, beyond its longest bubble, m."""
APART = 0.14
"""Distance between two balloons that lie on the same side, m."""


def parked(strips: Mapping[str, Strip]) -> dict[str, float]:
    """Return how far to the side (+y) each balloon lies until it is joined, by its name, m.

    The first lies at 0, the others to its right and left in turn, beyond what is folded there; what lies in
    another lies where that does. Balloons from meshes lie where their files say, and are not among them.
    """
    lying = [strip for strip in strips.values() if strip.shape is None and strip.inside is None]
    longest = max((bubble.length for strip in lying for bubble in strip.bubbles[:-1]), default=0.0)
    places = {}
    wider = [_round_radius(lying[0])] * 2 if lying else []
    """What round balloons need more on either side, m."""
    for k, strip in enumerate(lying):
        row, left = divmod(k - 1, 2)
        aside = ELBOW + longest + APART * row + wider[left] + _round_radius(strip)
        places[strip.balloon] = 0.0 if k == 0 else -aside if left else aside
        wider[left] += 2.0 * _round_radius(strip) if k else 0.0
    hosts = hosts_of(strips).items()
    return places | {name: places[host.balloon] for name, host in hosts if host.balloon in places}


def _round_radius(strip: Strip) -> float:
    """Return how far the wall of a round balloon is from its axis at most, m; 0 of tubes."""
    return 0.0 if strip.blown is None else 0.5 * strip.blown.most.width
