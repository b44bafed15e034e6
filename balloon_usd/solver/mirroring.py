"""The mirror of a figure: the plane in which its twins come nearest to being mirror images of each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class Mirror(NamedTuple):
    """A plane."""

    through: Floats
    """A place in it, (3,) m."""
    normal: Floats
    """Its unit normal, (3,)."""

    @classmethod
    def between(cls, pairs: Sequence[tuple[Floats, Floats]]) -> Mirror:
        """Return the plane in which places, (N, 3) m, come nearest to being mirror images of each other.

        For a plane through m with normal n the sum of squared distances is a constant and
        4 sum(n.(p-m) n.(q-m)).
        """
        p, q = (np.concatenate([pair[side] for pair in pairs]) for side in (0, 1))
        through = 0.5 * (p + q).mean(axis=0)
        together = (p - through).T @ (q - through)
        return cls(through, np.linalg.eigh(together + together.T)[1][:, 0])

    @classmethod
    def of_twins(cls, twins: Iterable[tuple[Floats, Floats]]) -> Mirror:
        """Return that of twins: places along both, (N, 3) m, of which one may run either way."""
        twins = list(twins)
        mirror = cls.between([(a.mean(axis=0)[None], b.mean(axis=0)[None]) for a, b in twins])
        return cls.between([(a, mirror.ordered(a, b)) for a, b in twins])

    def image(self, places: Floats) -> Floats:
        """Return the mirror images of some places, (N, 3), m."""
        image: Floats = places - 2.0 * ((places - self.through) @ self.normal)[:, None] * self.normal
        return image

    def misses(self, p: Floats, q: Floats) -> Floats:
        """Return the distances (m) of the mirror images of some places, (N, 3) m, from others."""
        return np.asarray(np.linalg.norm(self.image(p) - q, axis=1))

    def runs_back(self, p: Floats, q: Floats) -> bool:
        """Tell whether a bubble runs against the image of its twin."""
        return bool(self.misses(p, q[::-1]).sum() < self.misses(p, q).sum())

    def ordered(self, p: Floats, q: Floats) -> Floats:
        """Return the places of a bubble in that order in which they are nearer to the image of its twin."""
        return q[::-1] if self.runs_back(p, q) else q


def ways_to_symmetry(
    places: Floats, twins: Sequence[tuple[Ints, Ints]], between: Iterable[Ints], near: float
) -> Floats:
    """Return how far places of a figure are led, (N, 3), m, to make it symmetric: half way to the image
    of their twins. A row of places without twins goes as a whole with the nearest place that has one.

    Args:
        places: those places, (N, 3), m.
        twins: numbers of the places along two bubbles, (K,) each, for every pair.
        between: those along other bubbles, which are symmetric to themselves if they nearly are.
        near: farthest that one of these may lie from its image, m.
    """
    mirror = Mirror.of_twins([(places[a], places[b]) for a, b in twins])

    def along(a: Ints, b: Ints) -> Ints:
        return b[::-1] if mirror.runs_back(places[a], places[b]) else b

    pairs: list[tuple[Ints, Ints]] = []
    for a, b in twins:
        image = along(a, b)
        pairs += [(a, image), (image, a)]
    for own in between:
        image = along(own, own)
        if mirror.misses(places[own], places[image]).max() <= near:
            pairs.append((own, image))
    at, other = (np.concatenate([pair[side] for pair in pairs]) for side in (0, 1))
    total, count = np.zeros_like(places), np.zeros(len(places))
    np.add.at(total, at, 0.5 * (mirror.image(places[other]) - places[at]))
    np.add.at(count, at, 1.0)
    led = np.flatnonzero(count)
    ways = np.zeros_like(places)
    ways[led] = total[led] / count[led, None]
    alone = np.flatnonzero(count == 0)
    for row in np.split(alone, np.flatnonzero(np.diff(alone) > 1) + 1) if len(alone) else ():
        apart = np.linalg.norm(places[row, None] - places[led], axis=2)
        ways[row] = ways[led[apart.min(axis=0).argmin()]]
    return ways
